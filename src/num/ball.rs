//! Doubles that know how far they may be off: what the f64 step of a family computes with where counting roundings by
//! hand would not pay.

use super::{Certain, Number, Real};
use std::cmp::Ordering::{self, Greater, Less};

/// Unit roundoff.
const UNIT: f64 = 0.5 * f64::EPSILON;
/// Covers the roundings of an error's own computation: at most six, each relative.
const GROW: f64 = 1.0 + 8.0 * UNIT;
/// More than underflow can do to a result and to the terms of its error.
const TINY: f64 = f64::MIN_POSITIVE;

/// All numbers within `error` of `value`. Overflow makes it hold all numbers: no comparison is certain then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ball {
    /// The middle.
    pub value: f64,
    /// The radius, at least 0.
    pub error: f64,
}

impl Ball {
    /// The same number of another arithmetic, as well as doubles can hold it.
    #[inline(always)]
    pub(crate) fn enclosing<N: Real>(x: &N) -> Ball {
        let value = x.approx();
        if !value.is_finite() {
            // Beyond the range of doubles every number is possible.
            return Ball { value: 0.0, error: f64::INFINITY };
        }
        // `most` may be off by a rounding.
        let error = x.sub(&N::of(value, x.bits())).most() * (1.0 + 2.0 * f64::EPSILON) + f64::MIN_POSITIVE;
        Ball { value, error }
    }

    /// A number known to `units` of 2^-53, relative to the number; below 1000 units.
    ///
    /// Relative to the value these are `units / (1 - units UNIT)` units, at most `1 + 2^-43` times as many. Two
    /// roundings of the error itself are less than the rest of the factor.
    pub(crate) fn near(value: f64, units: f64) -> Ball {
        const RELATIVE_TO_VALUE: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
        Ball { value, error: value.abs() * (units * UNIT * RELATIVE_TO_VALUE) + TINY }
    }

    /// From the smallest to the largest of its numbers, a little widened.
    fn ends(&self) -> (f64, f64) {
        // Two units of each for the roundings of this sum and of the ends themselves.
        let error = self.error * GROW + self.value.abs() * f64::EPSILON;
        (self.value - error, self.value + error)
    }
}

impl Number for Ball {
    #[inline(always)]
    fn add(&self, other: &Ball) -> Ball {
        let value = self.value + other.value;
        Ball { value, error: (self.error + other.error + value.abs() * UNIT) * GROW }
    }
    #[inline(always)]
    fn sub(&self, other: &Ball) -> Ball {
        let value = self.value - other.value;
        Ball { value, error: (self.error + other.error + value.abs() * UNIT) * GROW }
    }
    #[inline(always)]
    fn mul(&self, other: &Ball) -> Ball {
        let value = self.value * other.value;
        let inputs = self.value.abs() * other.error + self.error * (other.value.abs() + other.error);
        Ball { value, error: (inputs + value.abs() * UNIT) * GROW + TINY }
    }
    #[inline(always)]
    fn times(&self, constant: f64) -> Ball {
        let value = self.value * constant;
        Ball { value, error: (self.error * constant.abs() + value.abs() * UNIT) * GROW + TINY }
    }
    #[inline(always)]
    fn plus(&self, constant: f64) -> Ball {
        let value = self.value + constant;
        Ball { value, error: (self.error + value.abs() * UNIT) * GROW }
    }
}

impl Certain for Ball {
    #[inline(always)]
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        let error = (self.error + error) * GROW;
        if self.value > error {
            Some(Greater)
        } else if self.value < -error {
            Some(Less)
        } else {
            None
        }
    }
}

impl Real for Ball {
    fn of(x: f64, _bits: usize) -> Ball {
        Ball { value: x, error: 0.0 }
    }
    fn bits(&self) -> usize {
        53
    }
    /// With q the rounded quotient of the middles, `x/y - q = (x - q y) / y`.
    #[inline(always)]
    fn over(&self, divisor: &Ball) -> Option<Ball> {
        let least = divisor.value.abs() - divisor.error;
        // Not for NaN either.
        (least > 0.0).then_some(())?;
        let value = self.value / divisor.value;
        let inputs = self.error + value.abs() * divisor.error;
        Some(Ball { value, error: (inputs / least * GROW + value.abs() * (2.0 * UNIT)) * GROW + TINY })
    }
    /// `|√x - √y| <= |x - y| / √y`.
    fn sqrt(&self) -> Option<Ball> {
        (self.value > self.error).then_some(())?;
        let value = self.value.sqrt();
        Some(Ball { value, error: (self.error / value + value * UNIT) * GROW + TINY })
    }
    fn union(&self, other: &Ball) -> Ball {
        let (one, two) = (self.ends(), other.ends());
        let (low, high) = (one.0.min(two.0), one.1.max(two.1));
        let value = 0.5 * (low + high);
        Ball { value, error: (0.5 * (high - low) + value.abs() * UNIT) * GROW }
    }
    fn size(&self) -> Ball {
        Ball { value: 0.0, error: self.most() }
    }
    fn most(&self) -> f64 {
        (self.value.abs() + self.error) * GROW
    }
    fn middle(&self) -> Ball {
        Ball { value: self.value, error: 0.0 }
    }
    fn approx(&self) -> f64 {
        self.value
    }
    fn power_of_two(exponent: i32, _bits: usize) -> Ball {
        Ball { value: 2f64.powi(exponent), error: 0.0 }
    }
    fn ln(&self) -> f64 {
        self.value.ln()
    }
    fn to_f32(&self) -> Option<f32> {
        let (low, high) = self.ends();
        let (low, high) = (low as f32, high as f32);
        // One zero, whatever the sign of what underflowed.
        (low == high).then_some(low + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use crate::num::Interval;

    /// Random expressions: the ball holds the truth, and not by being far too large.
    #[test]
    fn every_operation_holds_the_truth() {
        let mut noise = Noise(1);
        let mut random = || noise.signed() * 2f64.powi((20.0 * noise.signed()) as i32);
        let mut worst: f64 = 0.0;
        for round in 0..4000 {
            let (x, y, z) = (random(), random(), random());
            let (a, b, c) = (Ball::of(x, 53), Ball::of(y, 53), Ball::of(z, 53));
            let [p, q, r] = [x, y, z].map(|v| Interval::new(v, 300));
            let product = (a.mul(&b).add(&c), &(&p * &q) + &r);
            let (ball, truth) = match round % 5 {
                0 => product,
                1 => (product.0.sub(&a.times(0.3)), &product.1 - &p.scale(0.3)),
                2 => match product.0.over(&b.plus(0.7)) {
                    Some(ball) => (ball, product.1.over(&q.plus(0.7)).expect("not zero")),
                    None => continue,
                },
                3 => match a.mul(&a).plus(1e-9).sqrt() {
                    Some(ball) => (ball, p.square().plus(1e-9).sqrt().expect("positive")),
                    None => continue,
                },
                _ => (product.0.mul(&product.0.mul(&a)), &product.1 * &(&product.1 * &p)),
            };
            let off = truth.plus(-ball.value).approx().abs();
            assert!(off <= ball.error, "{x:?} {y:?} {z:?}: {ball:?} is off by {off}");
            worst = worst.max(off / ball.error);
        }
        assert!(worst > 0.3, "{worst}");
    }

    #[test]
    fn what_is_not_certain_has_no_sign() {
        let sign = |value, error| Ball { value, error }.certain_sign(0.0);
        assert_eq!((sign(1.0, 0.5), sign(-1.0, 0.5), sign(1.0, 1.5)), (Some(Greater), Some(Less), None));
        assert_eq!((sign(f64::NAN, 0.0), sign(f64::INFINITY, f64::INFINITY), sign(0.0, 0.0)), (None, None, None));
        let huge = Ball::of(1e200, 53);
        assert_eq!(huge.mul(&huge).certain_sign(0.0), None);
        assert!(huge.over(&Ball { value: 1.0, error: 1.0 }).is_none());
    }
}
