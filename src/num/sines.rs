//! Sines and cosines in f64 with a proved error, for angles from 0 to 3π/2.
//!
//! The standard library leaves the accuracy of `sin` unspecified, so no proof may rest on it.

use super::Interval;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// π - [`PI`], to 2^-106 relative.
pub(crate) const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;
/// π/2 - [`FRAC_PI_2`].
const FRAC_PI_2_LOW: f64 = 6.123_233_995_736_766e-17;

/// 3π/2 - `3.0 * FRAC_PI_2`.
const THREE_HALVES_PI_LOW: f64 = 1.8369701987210297e-16;

/// Relative error of [`sin`], [`cos`] and [`sin_of_sum`], in units of 2^-53.
pub(crate) const SIN_ERROR: f64 = 10.0;

struct Knot {
    sin: f64,
    sin_low: f64,
    cos: f64,
}

/// Knots k/16 from 0 to 27/16, past π/2.
static KNOTS: LazyLock<Vec<Knot>> = LazyLock::new(|| {
    let split = |x: &Interval| {
        let high = x.approx();
        (high, x.plus(-high).approx())
    };
    (0..28)
        .map(|k| {
            let (s, c) = Interval::sin_cos(f64::from(k) / 16.0, 160);
            let (sin, sin_low) = split(&s);
            Knot { sin, sin_low, cos: c.approx() }
        })
        .collect()
});

/// `sin x` for `0 <= x <= 1.65`.
///
/// # Accuracy
/// 6 units of 2^-53, relative. With `x = k/16 + r`, `|r| <= 1/32` (exact: both are multiples of the last bit of `x`,
/// and the difference is smaller than `x`), `sin x = S + (S (cos r - 1) + C sin r + S_low)`. The series stop at
/// relative 2^-58. The bracket is at most 1/32, its rounding errors at most 4 units of it, and it is at most `sin x` in
/// absolute value (equal only at k = 1, r = -1/32); the last addition costs 1 unit.
fn sin_quadrant(x: f64) -> f64 {
    let k = (x * 16.0).round();
    let r = x - k / 16.0;
    let knot = &KNOTS[k as usize];
    let r2 = r * r;
    let sin_r = r - r * r2 * (1.0 / 6.0 - r2 * (1.0 / 120.0 - r2 * (1.0 / 5040.0)));
    let cos_r_less_1 = -r2 * (0.5 - r2 * (1.0 / 24.0 - r2 * (1.0 / 720.0 - r2 * (1.0 / 40320.0))));
    knot.sin + (knot.cos * sin_r + (knot.sin * cos_r_less_1 + knot.sin_low))
}

/// `sin x` for `0 <= x <= 3π/2`.
///
/// # Accuracy
/// [`SIN_ERROR`] units of 2^-53, relative: beyond π/2 the angle is taken from π exactly (Sterbenz)
/// and rounded once; a relative error of the angle below π/2 costs at most as much in the sine.
pub(crate) fn sin(x: f64) -> f64 {
    if x <= FRAC_PI_2 {
        return sin_quadrant(x);
    }
    let rest = (PI - x) + PI_LOW;
    if rest >= 0.0 { sin_quadrant(rest) } else { -sin_quadrant(-rest) }
}

/// `cos x` for `0 <= x < 3π/2`.
///
/// # Accuracy
/// [`SIN_ERROR`] units of 2^-53, relative, also close to π/2: the complement is exact from π/4 on, and below π/4 its
/// rounding error, under 1.6 units, reaches the cosine times tan x < 1. Beyond π the same holds from 3π/2.
pub(crate) fn cos(x: f64) -> f64 {
    if x > PI {
        // The difference is exact.
        return -sin_quadrant((3.0 * FRAC_PI_2 - x) + THREE_HALVES_PI_LOW);
    }
    let complement = (FRAC_PI_2 - x) + FRAC_PI_2_LOW;
    if complement >= 0.0 { sin_quadrant(complement) } else { -sin_quadrant(-complement) }
}

/// A rounded sum and its rounding error, exactly (Knuth).
pub(crate) fn two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    let part = sum - x;
    (sum, (x - (sum - part)) + (y - part))
}

/// Whether `x + y < π`, decided exactly: π lies between the double [`PI`] and the next one up, so where the rounded sum
/// equals [`PI`] its rounding error decides.
pub(crate) fn sum_below_pi(x: f64, y: f64) -> bool {
    let (sum, low) = two_sum(x, y);
    sum < PI || sum == PI && low < PI_LOW
}

/// `sin(x + y)` for `0 <= x + y < π`, `|x|, |y| < π`.
///
/// # Accuracy
/// [`SIN_ERROR`] units of 2^-53, relative: the rounding error of the sum is recovered (Knuth's two-sum) and kept where
/// it matters, close to π.
pub(crate) fn sin_of_sum(x: f64, y: f64) -> f64 {
    let (sum, low) = two_sum(x, y);
    if sum <= FRAC_PI_2 { sin_quadrant(sum) } else { sin_quadrant((PI - sum) + (PI_LOW - low)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Enough for sums of tiny and ordinary angles.
    const BITS: usize = 256;

    /// Relative error in units of 2^-53.
    fn units(value: f64, truth: &Interval) -> f64 {
        let off = truth.plus(-value).over(truth).expect("not zero").approx();
        off.abs() * 2f64.powi(53)
    }

    fn angles() -> impl Iterator<Item = f64> {
        let near = [FRAC_PI_2, PI, 1.0 / 32.0, 3.0 / 32.0, 1.0 / 16.0];
        let close = near.into_iter().flat_map(|x| (1..40).map(move |i| x - f64::EPSILON * f64::from(i)));
        let beyond = (1..20).flat_map(|i| [FRAC_PI_2, PI].map(|x| x + 2.0 * f64::EPSILON * f64::from(i)));
        let tiny = (1..10).map(|i| 10f64.powi(-30 * i));
        close.chain(beyond).chain(tiny).chain((1..900).map(|i| f64::from(i) * 5.23e-3))
    }

    #[test]
    fn sine_and_cosine_keep_their_bound() {
        let mut worst: f64 = 0.0;
        for x in angles() {
            let (s, c) = Interval::sin_cos(x, BITS);
            worst = worst.max(units(sin(x), &s)).max(units(cos(x), &c));
        }
        assert!(worst > 0.3 && worst <= SIN_ERROR, "worst {worst} units");
    }

    #[test]
    fn sine_of_a_sum_keeps_its_bound_up_to_pi() {
        let mut worst: f64 = 0.0;
        for x in angles() {
            for y in [0.3, (PI - x) * (1.0 - 1e-13), 1e-9, -0.4 * x, -x * (1.0 - 1e-14)] {
                if x + y >= PI || x + y <= 0.0 || x > PI {
                    continue;
                }
                let ((s, c), (s2, c2)) = (Interval::sin_cos(x, BITS), Interval::sin_cos(y, BITS));
                worst = worst.max(units(sin_of_sum(x, y), &(&(&s * &c2) + &(&c * &s2))));
            }
        }
        assert!(worst > 0.3 && worst <= SIN_ERROR, "worst {worst} units");
    }
}
