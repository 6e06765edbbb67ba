//! Both curves of [`super::curves`] at one parameter.

use crate::num::Real;

/// Both curves at one t.
#[derive(Debug, Clone, Copy)]
pub(super) struct Knot<N> {
    /// t, exactly.
    pub t: N,
    /// Heights Z of the two curves.
    pub z: [N; 2],
    /// Slopes s.
    pub s: [N; 2],
    /// Of the sign of D, and no larger: `2 (Z0 - Z1)/(Z0 + Z1)`.
    pub gap: N,
}

impl<N: Real> Knot<N> {
    /// D'.
    pub(super) fn turn(&self) -> N {
        self.s[1].sub(&self.s[0])
    }
}

/// No less than `ln(b/a)`: `(r - 1)/√r` for their ratio r, with a little for rounding. At most 2^500: no certificate
/// holds so far.
pub(super) fn length<N: Real>(a: &N, b: &N) -> f64 {
    let (low, high) = (a.approx(), b.approx());
    // Not below the normal range, where it would lose digits.
    let length = (b.sub(a).approx() / (low.sqrt() * high.sqrt()) * 1.0001).max(f64::MIN_POSITIVE);
    if low.is_normal() && high.is_normal() {
        return length;
    }
    // Ends that are no doubles: logarithms of some thousands, right to 2^-39.
    let ln = b.ln() - a.ln();
    if ln < 600.0 { 2.0 * (0.5 * ln + 2f64.powi(-38)).sinh() * 1.0001 } else { 2f64.powi(500) }
}
