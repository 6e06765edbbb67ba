//! What depends on the two angles, as forms over their ranges.

use super::Four;
use crate::num::Number;
use crate::num::sines::{SIN_ERROR, cos, sin, sin_of_sum, sum_below_pi};

/// Unit roundoff.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// A range as `middle + half · symbol`, exactly: every number of the range is that for some place of the symbol.
///
/// The larger distance from the middle to an end is rounded once, by at most one unit; four units more cover that.
pub(super) fn centred([low, high]: [f64; 2], symbol: usize) -> Four {
    let middle = 0.5 * low + 0.5 * high;
    let half = (high - middle).max(middle - low);
    let mut form = Four::ball(crate::num::Ball { value: middle, error: 0.0 });
    form.slope[symbol] = half * (1.0 + 4.0 * UNIT) + f64::MIN_POSITIVE;
    form
}

/// A function f of `f'' = -f` and `|f| <= 1`, such as a sine, of an angle that moves by `by` around a middle, where
/// it is `value` and its derivative is `slope`, each to so many units (`value` relative, `slope` absolute).
///
/// Taylor: `value + slope by - value by² / 2`, and a rest of at most `|by|³ / 6`.
fn sine(value: f64, slope: f64, by: &Four, units: f64) -> Four {
    let most = crate::num::Real::most(by);
    let rounded = units * UNIT * (value.abs() + most + 0.5 * value.abs() * most * most);
    let form = by.mul(by).times(-0.5 * value).add(&by.times(slope)).plus(value);
    form.off(most * most * most / 6.0 + rounded)
}

/// The constants of [`super::super::pair::Pair`] over a range of angles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Angles {
    pub p: Four,
    pub r: Four,
    pub g0: Four,
    pub g1: Four,
    /// a / κ0.
    pub curve0: Four,
    /// k / κ1.
    pub curve1: Four,
}

impl Angles {
    /// `None` where the box leaves the domain, comes too near to its end, or is too wide for two orders.
    ///
    /// The cosine of the sum is taken from those of the angles: two products of numbers within 10 units each and a
    /// difference, all at most 1, are off by less than 44 units.
    pub fn new(phi0: [f64; 2], phi1: [f64; 2]) -> Option<Angles> {
        (phi0[0] > 0.0 && phi1[0] > 0.0 && sum_below_pi(phi0[1], phi1[1])).then_some(())?;
        let (first, second) = (centred(phi0, 0), centred(phi1, 1));
        let (c0, c1) = (first.value, second.value);
        let ((s0, t0), (s1, t1)) = ((sin(c0), cos(c0)), (sin(c1), cos(c1)));
        let (by0, by1) = (Four { value: 0.0, ..first }, Four { value: 0.0, ..second });
        let sum = sine(sin_of_sum(c0, c1), t0 * t1 - s0 * s1, &by0.add(&by1), 44.0);
        let (sin0, sin1) = (sine(s0, t0, &by0, SIN_ERROR), sine(s1, t1, &by1, SIN_ERROR));
        let inverse = sum.inverse()?;
        let (q0, q1) = (sin0.mul(&inverse), sin1.mul(&inverse));
        let (g0, g1) = (q0.mul(&q0), q1.mul(&q1));
        let p = q0.mul(&sine(t1, -s1, &by1, SIN_ERROR));
        Some(Angles { p, r: p.times(-1.0).plus(1.0), g0, g1, curve0: g1.mul(&sin0.inverse()?), curve1: g0.mul(&sin1.inverse()?) })
    }
}
