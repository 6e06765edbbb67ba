//! Intervals of any precision, on correctly rounded directed arithmetic.

use crate::steps::step;
use dashu_float::round::mode::{Down, HalfEven, Up};
use dashu_float::{ConstCache, Context, FBig, FpResult, Repr};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// A closed interval that contains the number it stands for.
///
/// Every operation rounds its lower end down and its upper end up at the precision of its operands
/// (the larger of the two), so the result contains every value the operation takes on the operands.
#[derive(Debug, Clone)]
pub struct Interval {
    lo: Repr<2>,
    hi: Repr<2>,
    bits: usize,
}

thread_local! {
    /// Constants such as π, as far as they have been computed.
    static CONSTANTS: RefCell<ConstCache> = const { RefCell::new(ConstCache::new()) };
}

/// The nearest double, also below the least subnormal, where the conversion of `dashu-float` 0.6 always gives zero:
/// numbers above half of it round to it.
fn nearest_f64(x: &Repr<2>) -> f64 {
    match x.to_f64().value() {
        0.0 if beyond(x, -1075) => f64::from_bits(1).copysign(sign(x)),
        value => value,
    }
}

/// The same for singles.
fn nearest_f32(x: &Repr<2>) -> f32 {
    match x.to_f32().value() {
        0.0 if beyond(x, -150) => f32::from_bits(1).copysign(sign(x) as f32),
        value => value,
    }
}

fn sign(x: &Repr<2>) -> f64 {
    if *x < Repr::zero() { -1.0 } else { 1.0 }
}

/// Whether `|x| > 2^exponent`.
fn beyond(x: &Repr<2>, exponent: isize) -> bool {
    *x > Repr::new(1.into(), exponent) || *x < Repr::new((-1).into(), exponent)
}

fn repr(x: f64) -> Repr<2> {
    FBig::<HalfEven, 2>::try_from(x).expect("finite numbers only").into_repr()
}

macro_rules! directed {
    ($bits:expr, $op:ident, $mode:ty, $($arg:expr),*) => {
        Context::<$mode>::new($bits).$op($($arg),*).expect("finite operands in range").value().into_repr()
    };
}

impl Interval {
    /// The interval of one finite double, exactly.
    ///
    /// # Panics
    /// When `x` is NaN or infinite.
    pub fn new(x: f64, bits: usize) -> Interval {
        Interval { lo: repr(x), hi: repr(x), bits }
    }

    /// 2 to any power, exactly.
    pub fn power_of_two(exponent: isize, bits: usize) -> Interval {
        let power = Repr::new(1.into(), exponent);
        Interval { lo: power.clone(), hi: power, bits }
    }

    /// The precision its results are rounded to, in bits.
    pub fn bits(&self) -> usize {
        self.bits
    }

    /// `(sin x, cos x)` of a finite double.
    pub fn sin_cos(x: f64, bits: usize) -> (Interval, Interval) {
        Interval::new(x, bits).sine_cosine()
    }

    /// Sine and cosine: those at its middle, and up to half its width more, because neither is ever steeper than 1.
    pub fn sine_cosine(&self) -> (Interval, Interval) {
        let thin = self.lo == self.hi;
        let middle = if thin { self.lo.clone() } else { self.middle().lo };
        // The middle has a bit more than the precision; at least as many are asked for, so that it is taken as it is.
        let bits = self.bits + 2;
        let (sin, cos) =
            CONSTANTS.with_borrow_mut(|cache| Context::<HalfEven>::new(bits).sin_cos(&middle, Some(cache)));
        let half = (self - &Interval { lo: middle.clone(), hi: middle, bits: self.bits }).size();
        let around = |rounded: FpResult<FBig<HalfEven, 2>>| {
            let nearest = rounded.expect("finite argument").value().into_repr();
            let point = Interval { lo: nearest.clone(), hi: nearest, bits: self.bits }.widened();
            if thin { point } else { &point + &half }
        };
        (around(sin), around(cos))
    }

    /// π.
    pub fn pi(bits: usize) -> Interval {
        let nearest =
            CONSTANTS.with_borrow_mut(|cache| Context::<HalfEven>::new(bits).pi::<2>(Some(cache)).value().into_repr());
        Interval { lo: nearest.clone(), hi: nearest, bits }.widened()
    }

    /// From -m to m, where m is the largest absolute value of its numbers.
    pub fn size(&self) -> Interval {
        self.union(&-self)
    }

    /// Larger by more than one unit in the last place at both ends: around a correctly rounded number, contains the
    /// true one.
    fn widened(&self) -> Interval {
        self + &(self * &Interval::power_of_two(1 - self.bits as isize, self.bits)).size()
    }

    /// The least e with all its numbers below `2^e` in size; `None` for zero alone.
    pub fn magnitude(&self) -> Option<isize> {
        let digits = |x: &Repr<2>| (!x.significand().is_zero()).then(|| x.digits() as isize + x.exponent());
        digits(&self.lo).max(digits(&self.hi))
    }

    /// The same with both ends rounded outwards to so many bits.
    pub fn rounded(&self, bits: usize) -> Interval {
        let one = Interval::new(1.0, bits).lo;
        Interval { lo: directed!(bits, mul, Down, &self.lo, &one), hi: directed!(bits, mul, Up, &self.hi, &one), bits }
    }

    /// The common sign of all its numbers; `None` when it holds numbers of different signs (zero and others included).
    pub fn sign(&self) -> Option<Ordering> {
        let zero = Repr::zero();
        match (self.lo.cmp(&zero), self.hi.cmp(&zero)) {
            (Ordering::Greater, _) => Some(Ordering::Greater),
            (_, Ordering::Less) => Some(Ordering::Less),
            (Ordering::Equal, Ordering::Equal) => Some(Ordering::Equal),
            _ => None,
        }
    }

    /// How `self` compares with `other`, when that is certain.
    pub fn compare(&self, other: &Interval) -> Option<Ordering> {
        (self - other).sign()
    }

    /// Its square.
    pub fn square(&self) -> Interval {
        let product = self * self;
        if product.lo < Repr::zero() { Interval { lo: Repr::zero(), ..product } } else { product }
    }

    /// Times a double, exactly rounded outwards.
    pub fn scale(&self, factor: f64) -> Interval {
        self * &Interval::new(factor, self.bits)
    }

    /// Plus a double.
    pub fn plus(&self, x: f64) -> Interval {
        self + &Interval::new(x, self.bits)
    }

    /// The quotient; `None` when the divisor may be zero.
    pub fn over(&self, divisor: &Interval) -> Option<Interval> {
        if divisor.sign().is_none_or(Ordering::is_eq) {
            return None;
        }
        let bits = self.bits.max(divisor.bits);
        if divisor.hi < Repr::zero() {
            return (-self).over(&-divisor);
        }
        let zero = Repr::zero();
        // By a positive divisor: each end is farthest from or nearest to zero, as its sign says.
        let low_by = if self.lo < zero { &divisor.lo } else { &divisor.hi };
        let high_by = if self.hi < zero { &divisor.hi } else { &divisor.lo };
        Some(Interval {
            lo: directed!(bits, div, Down, &self.lo, low_by),
            hi: directed!(bits, div, Up, &self.hi, high_by),
            bits,
        })
    }

    /// The square root; `None` when it may be negative.
    pub fn sqrt(&self) -> Option<Interval> {
        if self.lo < Repr::zero() {
            return None;
        }
        let root = |x: &Repr<2>, up: bool| {
            if x.significand().is_zero() {
                return Repr::zero();
            }
            if up { directed!(self.bits, sqrt, Up, x) } else { directed!(self.bits, sqrt, Down, x) }
        };
        Some(Interval { lo: root(&self.lo, false), hi: root(&self.hi, true), bits: self.bits })
    }

    /// The least interval that contains both.
    pub fn union(&self, other: &Interval) -> Interval {
        Interval {
            lo: self.lo.clone().min(other.lo.clone()),
            hi: self.hi.clone().max(other.hi.clone()),
            bits: self.bits.max(other.bits),
        }
    }

    /// The thin interval at its middle (rounded): a good guess, nothing proved.
    pub fn middle(&self) -> Interval {
        let sum = directed!(self.bits + 1, add, HalfEven, &self.lo, &self.hi);
        let half = repr(0.5);
        let mid = directed!(self.bits + 1, mul, HalfEven, &sum, &half);
        Interval { lo: mid.clone(), hi: mid, bits: self.bits }
    }

    /// The thin interval at its lower end.
    pub fn lower(&self) -> Interval {
        Interval { lo: self.lo.clone(), hi: self.lo.clone(), bits: self.bits }
    }

    /// The thin interval at its upper end.
    pub fn upper(&self) -> Interval {
        Interval { lo: self.hi.clone(), hi: self.hi.clone(), bits: self.bits }
    }

    /// The nearest double of the number it stands for, when that is certain.
    pub fn to_f64(&self) -> Option<f64> {
        let (lo, hi) = (nearest_f64(&self.lo), nearest_f64(&self.hi));
        (lo == hi).then_some(lo + 0.0)
    }

    /// The nearest single of the number it stands for, when that is certain; what underflows from either side is +0.
    pub fn to_f32(&self) -> Option<f32> {
        let (lo, hi) = (nearest_f32(&self.lo), nearest_f32(&self.hi));
        (lo == hi).then_some(lo + 0.0)
    }

    /// The double nearest to its middle: a guess.
    pub fn approx(&self) -> f64 {
        self.middle().lo.to_f64().value()
    }
}

impl Add for &Interval {
    type Output = Interval;
    fn add(self, other: &Interval) -> Interval {
        let bits = self.bits.max(other.bits);
        Interval {
            lo: directed!(bits, add, Down, &self.lo, &other.lo),
            hi: directed!(bits, add, Up, &self.hi, &other.hi),
            bits,
        }
    }
}

impl Sub for &Interval {
    type Output = Interval;
    fn sub(self, other: &Interval) -> Interval {
        let bits = self.bits.max(other.bits);
        Interval {
            lo: directed!(bits, sub, Down, &self.lo, &other.hi),
            hi: directed!(bits, sub, Up, &self.hi, &other.lo),
            bits,
        }
    }
}

impl Mul for &Interval {
    type Output = Interval;
    fn mul(self, other: &Interval) -> Interval {
        let bits = self.bits.max(other.bits);
        let zero = Repr::zero();
        if self.lo >= zero && other.lo >= zero {
            return Interval {
                lo: directed!(bits, mul, Down, &self.lo, &other.lo),
                hi: directed!(bits, mul, Up, &self.hi, &other.hi),
                bits,
            };
        }
        let ends = [(&self.lo, &other.lo), (&self.lo, &other.hi), (&self.hi, &other.lo), (&self.hi, &other.hi)];
        let lo = ends.iter().map(|(a, b)| directed!(bits, mul, Down, a, b)).min().expect("four ends");
        let hi = ends.iter().map(|(a, b)| directed!(bits, mul, Up, a, b)).max().expect("four ends");
        Interval { lo, hi, bits }
    }
}

impl Neg for &Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { lo: -self.hi.clone(), hi: -self.lo.clone(), bits: self.bits }
    }
}

/// `lo (hi / lo)^(i / last)` for i in 0..=last, the ends exact, each other value rounded once from 256 bits; positive
/// `lo`, `last > 0`.
///
/// Integer arithmetic throughout, so the same doubles on every machine; within 1/2 ulp and 2^-200 of the true value:
/// the ratio is off by 2^-254 relative, its power by at most 2^24 times that, and each product adds 2^-255.
pub(super) fn log_space(lo: f64, hi: f64, last: usize) -> Vec<f64> {
    let context = Context::<HalfEven>::new(256);
    let number = |x: f64| FBig::<HalfEven, 2>::from_repr(repr(x), context);
    let ratio = ((number(hi).ln() - number(lo).ln()) / number(last as f64)).exp();
    let mut value = number(lo);
    (0..=last)
        .map(|i| {
            step();
            let here = value.to_f64().value();
            value = &value * &ratio;
            if i == last { hi } else { here }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_to_nearest_down_to_the_least_subnormals() {
        // 0.7, 0.5 and 0.3 of the least single and of the least double, and 1.5 of it (a tie, to even).
        let power = |exponent| Interval::power_of_two(exponent, 64);
        for (factor, steps) in [(0.7, 1), (0.5, 0), (0.3, 0), (1.4, 1), (1.5, 2), (2.6, 3)] {
            for sign in [1.0, -1.0] {
                let single = power(-149).scale(sign * factor).to_f32().unwrap();
                assert_eq!(single, sign as f32 * f32::from_bits(steps), "{factor}");
                let double = power(-1074).scale(sign * factor).to_f64().unwrap();
                assert_eq!(double, sign * f64::from_bits(u64::from(steps)), "{factor}");
            }
        }
        assert_eq!(power(-150).union(&power(-149)).to_f32(), None);
    }
}
