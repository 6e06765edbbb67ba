//! Sums of two doubles that know how far they may be off: the rung between doubles and intervals, with some 100 bits.

use super::formula::formula;
use super::number::exponent;
use super::sines::two_sum;
use super::{Angle, Ball, Certain, Interval, Number, Real};
use std::cmp::Ordering::{self, Greater, Less};
use std::f64::consts::FRAC_1_PI;
use std::sync::{LazyLock, OnceLock};

/// Unit roundoff of doubles.
const UNIT: f64 = 0.5 * f64::EPSILON;
/// Covers the roundings of an error's own computation: at most ten, each relative.
const GROW: f64 = 1.0 + 16.0 * UNIT;
/// More than underflow can do to a result and to the terms of its error: some thirty products round below the normal
/// range, each by less than 2^-1074.
const TINY: f64 = f64::MIN_POSITIVE;
/// What results are about good to, in bits.
pub(crate) const TWIN_BITS: usize = 100;

/// All numbers within `error` of `high + low`, where `high` is the double next to that sum. Overflow makes it hold
/// all numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Twin {
    high: f64,
    low: f64,
    error: f64,
}

/// A rounded product and its rounding error, exactly but for underflow (Dekker).
#[inline(always)]
fn two_product(x: f64, y: f64) -> (f64, f64) {
    let split = |x: f64| {
        let scaled = x * 134_217_729.0;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let product = x * y;
    let ((a, b), (c, d)) = (split(x), split(y));
    (product, ((a * c - product) + a * d + b * c) + b * d)
}

impl Twin {
    /// All numbers.
    const ANY: Twin = Twin { high: 0.0, low: 0.0, error: f64::INFINITY };

    /// The sum of two doubles, exactly, within an error.
    #[inline(always)]
    fn sum(x: f64, y: f64, error: f64) -> Twin {
        let (high, low) = two_sum(x, y);
        // Not for NaN either.
        if low.abs() + error < f64::INFINITY { Twin { high, low, error } } else { Twin::ANY }
    }

    /// The same numbers.
    pub(crate) fn around(ball: &Ball) -> Twin {
        Twin::sum(ball.value, 0.0, ball.error)
    }

    /// `(sin x, cos x)` for |x| <= π.
    ///
    /// # Accuracy
    /// As its error says, some 2^-104. With `x = k/16 + r`, `|r| <= 1/32` (exact: both are multiples of the last bit
    /// of x, and the difference is smaller than x), the series in r stop at `r^15/15! < 2^-115` and `r^16/16! <
    /// 2^-124`.
    pub(crate) fn sin_cos(x: f64) -> (Twin, Twin) {
        let size = x.abs();
        let k = (size * 16.0).round();
        let r = size - k / 16.0;
        let Some(knot) = KNOTS.get(k as usize) else {
            return (Twin::ANY, Twin::ANY);
        };
        let (sin, cos) = knot.get_or_init(|| {
            let (sin, cos) = Interval::sin_cos(k / 16.0, 160);
            (of_interval(&sin), of_interval(&cos))
        });
        let r2 = Twin::of(r, TWIN_BITS).mul(&Twin::of(r, TWIN_BITS));
        // Σ (-1)^i r^2i / (2i + 1)! and the same of (2i)!, without their first terms.
        let series = |first: usize| {
            (1..8)
                .rev()
                .map(|i| &INVERSES[2 * i + first])
                .fold(Twin::of(0.0, TWIN_BITS), |sum, inverse| formula!(r2 * (inverse - sum)))
        };
        let rest = |x: Twin| Twin { error: x.error + 2f64.powi(-114), ..x };
        // sin r = r - r s, cos r = 1 - c.
        let (s, c) = (rest(series(1)), rest(series(0)));
        let sin_r = formula!((1.0 - s) * { r });
        let sine = formula!(sin - sin * c + cos * sin_r);
        let cosine = formula!(cos - cos * c - sin * sin_r);
        (if x < 0.0 { sine.times(-1.0) } else { sine }, cosine)
    }

    /// The nearest double, when that is certain.
    #[expect(clippy::wrong_self_convention, reason = "as `Interval::to_f64`: one of both is handed on")]
    pub(crate) fn to_f64(&self) -> Option<f64> {
        // Rounding is monotone: what lies between two numbers that round alike rounds like them.
        let error = self.error * GROW + self.low.abs() * (2.0 * f64::EPSILON);
        let ends = [self.high + (self.low - error), self.high + (self.low + error)];
        // Where subnormal numbers are involved, errors are no smaller than these.
        (ends[0] == ends[1] && ends[0].is_finite()).then(|| ends[0] + 0.0)
    }
}

impl Angle for Twin {
    /// Less the nearest multiple of π, which has no more digits than π itself, `sin(x + y)` and `cos(x + y)` for the
    /// high part x, up to 1.6, and the low part y, up to 2^-53 x: `y²/2` and `y³/6` are rests.
    fn sine_cosine(&self) -> (Twin, Twin) {
        let turns = (self.high * FRAC_1_PI).round();
        let rest = if turns == 0.0 { *self } else { self.sub(&Twin::pi(TWIN_BITS).times(turns)) };
        let (sin, cos) = Twin::sin_cos(rest.high);
        let y = Twin::of(rest.low, TWIN_BITS);
        let [sine, cosine] = [formula!(sin + cos * y), formula!(cos - sin * y)];
        // Neither is ever steeper than 1. The second term above is below `|y|`, whatever it multiplies.
        let square = 0.5 * rest.low * rest.low;
        let sign = if turns.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        let close = |x: Twin, around: Twin| {
            let error = x.error + rest.error + square * (around.most() + rest.low.abs());
            Twin { high: sign * x.high, low: sign * x.low, error: error * GROW }
        };
        (close(sine, sin), close(cosine, cos))
    }
    fn pi(_bits: usize) -> Twin {
        static PI: LazyLock<Twin> = LazyLock::new(|| of_interval(&Interval::pi(160)));
        *PI
    }
    fn magnitude(&self) -> Option<isize> {
        (self.high != 0.0).then(|| exponent(self.high))
    }
}

/// A number that is known to 160 bits, as two doubles: off by less than 2^-105 of itself.
fn of_interval(x: &Interval) -> Twin {
    let high = x.approx();
    let low = x.plus(-high).approx();
    Twin { high, low, error: high.abs() * 2f64.powi(-105) }
}

/// Sines and cosines of k/16 up to π, each computed when it is first needed.
static KNOTS: [OnceLock<(Twin, Twin)>; 52] = [const { OnceLock::new() }; 52];

/// One over the factorials up to 15!.
static INVERSES: LazyLock<Vec<Twin>> = LazyLock::new(|| {
    let one = Interval::new(1.0, 160);
    let factorials = (0..16).scan(1.0, |product, k| {
        *product *= f64::from(k.max(1));
        Some(*product)
    });
    factorials.map(|x| one.over(&Interval::new(x, 160)).map_or(Twin::of(0.0, TWIN_BITS), |x| of_interval(&x))).collect()
});

impl Number for Twin {
    /// The error of the low parts is what their two sums round.
    #[inline(always)]
    fn add(&self, other: &Twin) -> Twin {
        let ((sum, rest), low) = (two_sum(self.high, other.high), self.low + other.low);
        let tail = rest + low;
        Twin::sum(sum, tail, (self.error + other.error + (low.abs() + tail.abs()) * UNIT) * GROW)
    }
    #[inline(always)]
    fn sub(&self, other: &Twin) -> Twin {
        self.add(&Twin { high: -other.high, low: -other.low, error: other.error })
    }
    /// With `|low| <= u |high|`, u the unit: both cross products round by u² of the product, their sum by 2u², the
    /// sum with the rest of the main product by 3u², and the product of the lows is u²: 8u² in all.
    #[inline(always)]
    fn mul(&self, other: &Twin) -> Twin {
        let (product, rest) = two_product(self.high, other.high);
        let tail = rest + (self.high * other.low + self.low * other.high);
        let (size, by) = (self.high.abs() * (1.0 + 2.0 * UNIT), other.high.abs() * (1.0 + 2.0 * UNIT));
        let inputs = size * other.error + self.error * (by + other.error);
        Twin::sum(product, tail, (inputs + product.abs() * (9.0 * UNIT * UNIT)) * GROW + TINY)
    }
    #[inline(always)]
    fn times(&self, constant: f64) -> Twin {
        let (product, rest) = two_product(self.high, constant);
        let tail = rest + self.low * constant;
        Twin::sum(product, tail, (self.error * constant.abs() + product.abs() * (9.0 * UNIT * UNIT)) * GROW + TINY)
    }
    #[inline(always)]
    fn plus(&self, constant: f64) -> Twin {
        let (sum, rest) = two_sum(self.high, constant);
        let tail = rest + self.low;
        Twin::sum(sum, tail, (self.error + tail.abs() * UNIT) * GROW)
    }
}

impl Certain for Twin {
    #[inline(always)]
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        let error = (self.error + self.low.abs() + error) * GROW;
        if self.high > error {
            Some(Greater)
        } else if self.high < -error {
            Some(Less)
        } else {
            None
        }
    }
}

impl Real for Twin {
    fn of(x: f64, _bits: usize) -> Twin {
        Twin { high: x, low: 0.0, error: 0.0 }
    }
    fn bits(&self) -> usize {
        TWIN_BITS
    }
    /// With q about the quotient, `x/y - q = (x - q y) / y`.
    fn over(&self, divisor: &Twin) -> Option<Twin> {
        let least = (divisor.high.abs() * (1.0 - 2.0 * UNIT) - divisor.error) / GROW;
        // Not for NaN either.
        (least > 0.0).then_some(())?;
        let about = self.high / divisor.high;
        let first = Twin::of(about, TWIN_BITS);
        let q = Twin::sum(about, formula!(self - first * divisor).high / divisor.high, 0.0);
        let off = formula!(self - q * divisor).most() / least;
        Some(Twin::sum(q.high, q.low, (q.error + off) * GROW + TINY))
    }
    /// With q about the root, `|√x - q| <= |x - q²| / q`.
    fn sqrt(&self) -> Option<Twin> {
        (self.high * (1.0 - 2.0 * UNIT) > self.error * GROW).then_some(())?;
        let about = self.high.sqrt();
        let first = Twin::of(about, TWIN_BITS);
        let q = Twin::sum(about, formula!(self - first * first).high / (2.0 * about), 0.0);
        let off = formula!(self - q * q).most() / q.high;
        Some(Twin::sum(q.high, q.low, (q.error + off) * GROW + TINY))
    }
    /// Around the middle between both, by half their distance and their errors.
    fn union(&self, other: &Twin) -> Twin {
        let (middle, apart) = (formula!(0.5 * (self + other)), self.sub(other));
        Twin::sum(middle.high, middle.low, (middle.error + 0.5 * apart.most()) * GROW)
    }
    fn size(&self) -> Twin {
        Twin { high: 0.0, low: 0.0, error: self.most() }
    }
    fn most(&self) -> f64 {
        (self.high.abs() + self.low.abs() + self.error) * GROW
    }
    fn middle(&self) -> Twin {
        Twin { error: 0.0, ..*self }
    }
    fn approx(&self) -> f64 {
        self.high
    }
    /// All numbers beyond the normal range.
    fn power_of_two(exponent: i32, _bits: usize) -> Twin {
        let power = 2f64.powi(exponent);
        if power.is_normal() { Twin::of(power, TWIN_BITS) } else { Twin::ANY }
    }
    fn ln(&self) -> f64 {
        self.high.ln()
    }
    fn to_f32(&self) -> Option<f32> {
        let Ball { value, error } = Ball::enclosing(self);
        let error = error + value.abs() * f64::EPSILON;
        let (low, high) = ((value - error) as f32, (value + error) as f32);
        // One zero, whatever the sign of what underflowed.
        (low == high).then_some(low + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    const BITS: usize = 400;

    /// The middle of a twin, exactly.
    fn exactly(x: &Twin) -> Interval {
        Interval::new(x.high, BITS).plus(x.low)
    }

    /// Checks that a twin holds a number, and returns how much of its error is used, and its relative error.
    fn held(x: &Twin, truth: &Interval) -> (f64, f64) {
        let off = (truth - &exactly(x)).approx().abs();
        assert!(off <= x.error, "{x:?} is off by {off}");
        assert_eq!(x.high, x.high + x.low, "{x:?}");
        if let Some(nearest) = x.to_f64() {
            assert_eq!(Some(nearest), truth.to_f64());
        }
        if let Some(nearest) = x.to_f32() {
            assert_eq!(Some(nearest), truth.to_f32());
        }
        (off / x.error, x.error / x.most())
    }

    #[test]
    fn every_operation_holds_the_truth() {
        let mut noise = Noise(1);
        let mut random = || {
            let (high, low) = (noise.signed() * 2f64.powi((20.0 * noise.signed()) as i32), noise.signed());
            Twin::sum(high, high * low * 2f64.powi(-53), 0.0)
        };
        let (mut most, mut widest) = (0.0f64, 0.0f64);
        for round in 0..6000 {
            let (a, b, c) = (random(), random(), random());
            let [p, q, r] = [&a, &b, &c].map(exactly);
            let product = (a.mul(&b).add(&c), &(&p * &q) + &r);
            let (twin, truth) = match round % 6 {
                0 => product,
                1 => (product.0.sub(&a.times(0.3)), &product.1 - &p.scale(0.3)),
                2 => match product.0.over(&b.plus(0.7)) {
                    Some(twin) => (twin, product.1.over(&q.plus(0.7)).expect("not zero")),
                    None => continue,
                },
                3 => match a.mul(&a).plus(1e-9).sqrt() {
                    Some(twin) => (twin, p.square().plus(1e-9).sqrt().expect("positive")),
                    None => continue,
                },
                4 => (a.sub(&a.times(1.0 + f64::EPSILON)), p.scale(-f64::EPSILON)),
                _ => (product.0.mul(&product.0.mul(&a)), &product.1 * &(&product.1 * &p)),
            };
            let (used, width) = held(&twin, &truth);
            most = most.max(used);
            widest = widest.max(if round % 6 == 3 { width } else { 0.0 });
            let both = a.union(&b);
            held(&both, &p);
            held(&both, &q);
        }
        assert!(most > 0.2 && widest < 2f64.powi(-95), "{most} {widest}");
    }

    #[test]
    fn sines_hold_the_truth() {
        let mut noise = Noise(3);
        let mut worst: f64 = 0.0;
        let edges = [0.0, 1e-300, 1e-9, 1.0 / 32.0, 0.09375, std::f64::consts::FRAC_PI_2, std::f64::consts::PI];
        for x in edges.into_iter().chain((0..3000).map(|_| noise.signed() * std::f64::consts::PI)) {
            let ((sin, cos), (sine, cosine)) = (Twin::sin_cos(x), Interval::sin_cos(x, BITS));
            held(&sin, &sine);
            held(&cos, &cosine);
            worst = worst.max(sin.error).max(cos.error);
        }
        assert!(worst < 2f64.powi(-100), "{worst}");
    }

    /// Sums of two doubles as angles, also next to multiples of π, and the exponents of numbers.
    #[test]
    fn sines_of_sums_hold_the_truth() {
        let mut noise = Noise(11);
        let mut worst: f64 = 0.0;
        for round in 0..4000 {
            let size = [1e-200, 1e-9, 1.0, 10.0, 7000.0][round % 5];
            let high = if round % 7 == 0 {
                std::f64::consts::PI * (20.0 * noise.next()).round()
            } else {
                size * noise.signed()
            };
            let x = Twin::sum(high, high * noise.signed() * 2f64.powi(-54), 0.0);
            let ((sin, cos), (sine, cosine)) = (x.sine_cosine(), exactly(&x).sine_cosine());
            held(&sin, &sine);
            held(&cos, &cosine);
            worst = worst.max(sin.error.max(cos.error) / (1.0 + high.abs()));
            assert_eq!(x.magnitude(), Angle::magnitude(&exactly(&x)));
            // Of all angles around.
            let wide = Twin { error: 1e-3, ..x };
            let moved = exactly(&x).plus(9.9e-4).sine_cosine();
            held(&wide.sine_cosine().0, &moved.0);
            held(&wide.sine_cosine().1, &moved.1);
        }
        assert!(worst < 2f64.powi(-99), "{worst}");
        let one = Twin::sum(1.0, -1e-30, 0.0);
        assert_eq!((one.magnitude(), Angle::magnitude(&exactly(&one))), (Some(1), Some(1)));
        held(&Twin::pi(TWIN_BITS), &Interval::pi(BITS));
    }

    #[test]
    fn what_overflows_is_not_certain() {
        let huge = Twin::of(1e200, TWIN_BITS);
        for x in [
            huge.mul(&huge),
            huge.mul(&huge).sub(&huge.mul(&huge)),
            Twin::of(1e308, TWIN_BITS).times(2.0),
            Twin::sin_cos(9.0).0,
        ] {
            assert_eq!(
                (x.certain_sign(0.0), x.to_f64(), x.to_f32(), x.error),
                (None, None, None, f64::INFINITY),
                "{x:?}"
            );
        }
    }
}
