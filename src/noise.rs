//! Numbers without a pattern, the same each time, for tests.

/// A linear congruential generator; what it holds is the seed.
pub(crate) struct Noise(pub u64);

impl Noise {
    /// From 0 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / 2f64.powi(53)
    }

    /// From -1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}
