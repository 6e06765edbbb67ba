//! The top of the ladder for any spiral: intervals of growing precision.

use super::arc::Equation;
use super::fast::Fast;
use super::pair::{Pair, side};
use super::{Code, EXISTS, INFLECTION, RISING};
use crate::error::Result;
use crate::family::{NO_VALUE, outer};
use crate::num::sines::two_sum;
use crate::num::{Interval, Number, Real, TWIN_BITS, Twin, climb, formula};
use serde::Serialize;

/// Two ends seen from their chord: the curve starts at (-1, 0) and ends at (1, 0). Its numbers are taken as exact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Datum {
    /// Direction at the start, counter-clockwise from the chord, radians, -π to π.
    pub alpha: f64,
    /// Direction at the end.
    pub beta: f64,
    /// Signed curvature at the start times half the chord, positive to the left.
    pub k1: f64,
    /// Signed curvature at the end times half the chord.
    pub k2: f64,
}

/// Scalars beyond this are stored as this: f32 ends soon after.
const MOST: f32 = 1e38;

/// The flags that plain comparisons decide, given whether a spiral exists.
pub(super) fn flags(exists: bool, k1: f64, k2: f64) -> u8 {
    let inflection = k1 < 0.0 && k2 > 0.0 || k1 > 0.0 && k2 < 0.0;
    let set = |condition: bool, flag: u8| if condition { flag } else { 0 };
    set(exists, EXISTS) | set(k1 < k2, RISING) | set(exists && inflection, INFLECTION)
}

impl Datum {
    /// The data seen in a mirror along the chord.
    pub(crate) fn mirrored(self) -> Datum {
        Datum { alpha: -self.alpha, beta: -self.beta, k1: -self.k1, k2: -self.k2 }
    }

    /// Proves all flags; returns the bits that were needed.
    ///
    /// With `k1 ≠ k2` and `α + β ≠ 0` Q is never 0, so that some precision suffices: expanded, Q is a sum of `e^(±iα)`,
    /// `e^(±iβ)`, `e^(±i(α-β))` and 1 with rational factors, that of `cos(α - β)` being -1/2, and by Lindemann and
    /// Weierstrass such a sum is 0 only if all terms cancel, which needs α = β; then `Q = k1 k2 + (k2 - k1) sin α`, and
    /// `k1 k2 = k2 - k1 = 0`.
    ///
    /// # Errors
    /// [`crate::Error::Undecided`] at the precision cap.
    pub(crate) fn code(&self) -> Result<(Code, usize)> {
        let code = |exists| Code::new(flags(exists, self.k1, self.k2), 0);
        let side = side(self.alpha, self.beta);
        if side == 0.0 || side * self.k1 >= side * self.k2 {
            return Ok((code(false), 0));
        }
        let this = if side < 0.0 { self.mirrored() } else { *self };
        let (exists, bits) = climb(self, "the existence of a spiral", |bits| {
            let (sin0, sin1, square) = this.sines(bits);
            outer::holds(&[-&sin0, sin1, square], &Interval::new(this.k1, bits), &Interval::new(this.k2, bits))
                .decided()
        })?;
        Ok((code(exists), bits))
    }

    /// sin α, sin β, sin² ω.
    fn sines(&self, bits: usize) -> (Interval, Interval, Interval) {
        let ((sin0, cos0), (sin1, cos1)) = (Interval::sin_cos(self.alpha, bits), Interval::sin_cos(self.beta, bits));
        // sin² ω = (1 - cos 2ω)/2; a sum of exactly 0 must give exactly 0.
        let square = match self.alpha + self.beta {
            0.0 => Interval::new(0.0, bits),
            // A small square would cancel.
            small if small.abs() < 1e-3 => self.omega(bits).sine_cosine().0.square(),
            _ => formula!(0.5 * (sin0 * sin1 - cos0 * cos1 + 1.0)),
        };
        (sin0, sin1, square)
    }

    /// Q; where it is rational it comes out exactly.
    pub(crate) fn q(&self, bits: usize) -> Interval {
        let (k1, k2) = (Interval::new(self.k1, bits), Interval::new(self.k2, bits));
        let (sin0, sin1, square) = self.sines(bits);
        if self.alpha == self.beta {
            return formula!(k1 * k2 + (k2 - k1) * sin0);
        }
        formula!((k1 + sin0) * (k2 - sin1) + square)
    }

    /// Q in two doubles; `None` where angles are so small that halving their sum might not be exact.
    pub(crate) fn q_of_twins(&self) -> Option<Twin> {
        let number = |x: f64| Twin::of(x, TWIN_BITS);
        let (k1, k2) = (number(self.k1), number(self.k2));
        let ((sin0, cos0), (sin1, cos1)) = (Twin::sin_cos(self.alpha), Twin::sin_cos(self.beta));
        if self.alpha == self.beta {
            return Some(formula!(k1 * k2 + (k2 - k1) * sin0));
        }
        let square = match two_sum(self.alpha, self.beta) {
            (0.0, _) => number(0.0),
            // A small square would cancel.
            (sum, 0.0) if sum.abs() < 1e-3 && sum.abs() > 1e-300 => {
                let sine = Twin::sin_cos(0.5 * sum).0;
                sine.mul(&sine)
            }
            (sum, _) if sum.abs() < 1e-3 => return None,
            _ => formula!(0.5 * (sin0 * sin1 - cos0 * cos1 + 1.0)),
        };
        Some(formula!((k1 + sin0) * (k2 - sin1) + square))
    }

    /// `(α + β)/2`.
    pub(crate) fn omega(&self, bits: usize) -> Interval {
        formula!(0.5 * (Interval::new(self.alpha, bits) + Interval::new(self.beta, bits)))
    }

    /// Q, ω, θ, t0 (0 to 3), each rounded to nearest f32 with proof.
    ///
    /// # Errors
    /// [`crate::Error::Undecided`] at the precision cap.
    pub(crate) fn scalars(&self, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        let fast = Pair::new(self.alpha, self.beta).map(|pair| Fast::new(self.k1, self.k2, &pair));
        self.fill(code, which, out, |which| match (which, &fast) {
            (1, _) => self.rounded_omega(),
            (_, fast) => fast.as_ref()?.scalar(which),
        })
    }

    /// The same by intervals alone.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn exact_scalars(&self, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.fill(code, which, out, |_| None)
    }

    /// Each scalar from doubles, where they can prove it, or from intervals.
    fn fill(&self, code: Code, which: &[usize], out: &mut [f32], fast: impl Fn(usize) -> Option<f32>) -> Result<()> {
        for (slot, which) in out.iter_mut().zip(which) {
            *slot = if *which >= 2 && code.flags() & EXISTS == 0 {
                NO_VALUE
            } else {
                let value = match fast(*which) {
                    Some(value) => value,
                    None => climb(self, "a scalar", |bits| self.scalar(*which, bits))?.0,
                };
                value.clamp(-MOST, MOST)
            };
        }
        Ok(())
    }

    /// ω, which lies between the halves of both neighbours of the rounded sum of the angles, or is its half.
    fn rounded_omega(&self) -> Option<f32> {
        let (sum, low) = two_sum(self.alpha, self.beta);
        let ends = if low == 0.0 { [sum; 2] } else { [sum.next_down(), sum.next_up()] };
        let [from, to] = ends.map(|x| (0.5 * x) as f32 + 0.0);
        (from == to).then_some(from)
    }

    fn scalar(&self, which: usize, bits: usize) -> Option<f32> {
        let q = self.q(bits);
        if which == 0 {
            return q.to_f32();
        }
        let omega = self.omega(bits);
        if which == 1 {
            return omega.to_f32();
        }
        let omega = if omega.approx() < 0.0 { -&omega } else { omega };
        let arc = Equation::new(-&q, omega, 0).solve()?;
        if which == 2 { &arc.theta } else { &arc.t0 }.to_f32()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    /// Opposite angles whose sum is small: `1 - cos 2ω` would have lost twice as many digits as that.
    #[test]
    fn small_sums_of_angles_keep_their_digits() {
        for sum in [1e-4, 1e-12, 1e-16] {
            let datum = Datum { alpha: 1.0, beta: -1.0 + sum, k1: 0.0, k2: 1.0 };
            let (_, _, square) = datum.sines(128);
            let width = &square.upper() - &square.lower();
            assert!(width.approx() < 2f64.powi(-115) * square.approx(), "{sum}");
        }
    }

    /// Random angles, those whose sum is far smaller, and sums beside the middle between two singles.
    #[test]
    fn omega_is_the_nearest_single() {
        let mut noise = Noise(4);
        let mut open = 0;
        for round in 0..3000 {
            let alpha = 3.0 * noise.signed();
            // Exactly between two singles: the sign of the last summand decides.
            let tie = 2.0 * (f64::from(alpha as f32) + f64::from((alpha as f32).next_up()));
            let (alpha, beta) = match round % 3 {
                0 => (alpha, 3.0 * noise.signed()),
                1 => (alpha, -alpha * (1.0 + 1e-9 * noise.signed())),
                _ => (0.25 * tie, [1e-30, -1e-30, 1e-10, 0.0][round % 4]),
            };
            let datum = Datum { alpha, beta, k1: 0.0, k2: 1.0 };
            match datum.rounded_omega() {
                Some(value) => assert_eq!(Some(value), datum.omega(2000).to_f32(), "{datum:?}"),
                None => open += 1,
            }
        }
        assert!(open > 100 && open < 1000, "{open}");
    }
}
