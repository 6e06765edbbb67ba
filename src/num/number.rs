//! One notation for the arithmetic that doubles, SIMD lanes and intervals share, so that a formula is written once.

use super::Interval;
use crate::steps::step;
use fearless_simd::{Simd, SimdBase};
use std::cmp::Ordering;

/// `+ - *` and nothing else: what proofs may use.
pub trait Number: Clone {
    /// Sum.
    fn add(&self, other: &Self) -> Self;
    /// Difference.
    fn sub(&self, other: &Self) -> Self;
    /// Product.
    fn mul(&self, other: &Self) -> Self;
    /// Product with a constant.
    fn times(&self, constant: f64) -> Self;
    /// Sum with a constant.
    fn plus(&self, constant: f64) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn add(&self, other: &f64) -> f64 {
        self + other
    }
    #[inline(always)]
    fn sub(&self, other: &f64) -> f64 {
        self - other
    }
    #[inline(always)]
    fn mul(&self, other: &f64) -> f64 {
        self * other
    }
    #[inline(always)]
    fn times(&self, constant: f64) -> f64 {
        self * constant
    }
    #[inline(always)]
    fn plus(&self, constant: f64) -> f64 {
        self + constant
    }
}

impl Number for Interval {
    fn add(&self, other: &Interval) -> Interval {
        self + other
    }
    fn sub(&self, other: &Interval) -> Interval {
        self - other
    }
    fn mul(&self, other: &Interval) -> Interval {
        self * other
    }
    fn times(&self, constant: f64) -> Interval {
        self.scale(constant)
    }
    fn plus(&self, constant: f64) -> Interval {
        Interval::plus(self, constant)
    }
}

/// A vector of doubles as wide as the processor likes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lanes<S: Simd>(pub S::f64s);

impl<S: Simd> Number for Lanes<S> {
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        Lanes(self.0 + other.0)
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        Lanes(self.0 - other.0)
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        Lanes(self.0 * other.0)
    }
    #[inline(always)]
    fn times(&self, constant: f64) -> Self {
        Lanes(self.0 * constant)
    }
    #[inline(always)]
    fn plus(&self, constant: f64) -> Self {
        Lanes(self.0 + constant)
    }
}

impl<S: Simd> Lanes<S> {
    /// One value in every lane.
    #[inline(always)]
    pub(crate) fn splat(simd: S, value: f64) -> Self {
        Lanes(S::f64s::splat(simd, value))
    }
}

/// A number whose comparison with zero can be certain or not.
pub(crate) trait Certain: Number {
    /// The sign if it is certain, given that the value may be off by `error` in either direction.
    fn certain_sign(&self, error: f64) -> Option<Ordering>;
    /// Its absolute value, as far as rounding errors depend on it: 0 where numbers carry their own.
    #[inline(always)]
    fn grain(&self) -> f64 {
        0.0
    }
    /// Coefficients of the same sign everywhere on (0, 1), for which halving parts what is to be told apart; `None`
    /// where it does already.
    #[inline(always)]
    fn balanced<const K: usize>(_c: &[Self; K]) -> Option<[Self; K]> {
        None
    }
}

impl Certain for f64 {
    #[inline(always)]
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        if *self > error {
            Some(Ordering::Greater)
        } else if *self < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }
    #[inline(always)]
    fn grain(&self) -> f64 {
        self.abs()
    }
}

impl Certain for Interval {
    /// Intervals carry their own error; `error` must be 0.
    fn certain_sign(&self, _error: f64) -> Option<Ordering> {
        self.sign()
    }
    /// In `x = t/(1 - t)` the coefficients are those of powers of x, but for binomials, and `x = 2^k y` multiplies them
    /// by powers of `2^k`. Newton's polygon, the hull above their logarithms, has a side for each size that x may have
    /// at a root. The middle of all sizes where signs differ becomes 1. So the halvings are as many as the roots'
    /// distances ask for, relative to their sizes, and do not grow with the logarithms of these.
    fn balanced<const K: usize>(c: &[Interval; K]) -> Option<[Interval; K]> {
        step();
        let points = c.iter().enumerate().filter_map(|(i, c)| Some((i, c.magnitude()?)));
        let mut hull: Vec<(usize, isize)> = Vec::with_capacity(K);
        for point in points {
            let rise = |a: (usize, isize), b: (usize, isize)| (b.1 - a.1, (b.0 - a.0) as isize);
            while let [.., before, last] = hull[..] {
                let ((up, along), (on, further)) = (rise(before, last), rise(last, point));
                if up * further > on * along {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        }
        let mixed = |from: usize, to: usize| {
            let first = c[from].sign();
            first.is_none() || c[from..=to].iter().any(|c| c.sign() != first)
        };
        let sides = hull.windows(2).filter(|side| mixed(side[0].0, side[1].0));
        let sizes = sides.map(|side| (side[0].1 - side[1].1).div_euclid((side[1].0 - side[0].0) as isize));
        let (least, most) = sizes.fold((isize::MAX, isize::MIN), |(least, most), k| (least.min(k), most.max(k)));
        let k = if least > most { 0 } else { least.midpoint(most) };
        // Next to the middle halving does as well.
        let power = |i: usize| Interval::power_of_two(k * i as isize, c[i].bits());
        (k.abs() > 1).then(|| std::array::from_fn(|i| &c[i] * &power(i)))
    }
}

/// Enclosed numbers of some precision: what a family computes with once, for doubles and for the top of the ladder.
pub(crate) trait Real: Certain + Sized {
    /// A double, exactly, with results rounded to `bits`.
    fn of(x: f64, bits: usize) -> Self;
    /// The precision of results.
    fn bits(&self) -> usize;
    /// The quotient; `None` when the divisor may be zero.
    fn over(&self, divisor: &Self) -> Option<Self>;
    /// The square root; `None` when it may not be real.
    fn sqrt(&self) -> Option<Self>;
    /// Holds the numbers of both.
    fn union(&self, other: &Self) -> Self;
    /// From -m to m, where m is the largest absolute value of its numbers.
    fn size(&self) -> Self;
    /// An approximation of that m.
    fn most(&self) -> f64;
    /// A number in its middle, exactly: a good guess.
    fn middle(&self) -> Self;
    /// Newton's steps from a double that add orders of a dependence, for numbers that depend on something.
    const ORDERS: usize = 0;
    /// The best guess of what it stands for: its middle, or for a form the form without its error.
    fn guess(&self) -> Self {
        self.middle()
    }
    /// The double next to its middle: a guess.
    fn approx(&self) -> f64;
    /// 2 to any power that the arithmetic has.
    fn power_of_two(exponent: i32, bits: usize) -> Self;
    /// The natural logarithm of its middle, which is above 0: a guess, also where the middle itself is no double.
    fn ln(&self) -> f64;
    /// The nearest single, when that is certain.
    fn to_f32(&self) -> Option<f32>;

    /// Whether it is certainly above 0.
    #[inline(always)]
    fn is_positive(&self) -> bool {
        self.certain_sign(0.0) == Some(std::cmp::Ordering::Greater)
    }
}

/// Enclosed numbers that may be angles.
pub(crate) trait Angle: Real {
    /// Sine and cosine.
    fn sine_cosine(&self) -> (Self, Self);
    /// π.
    fn pi(bits: usize) -> Self;
    /// The least e with the double next to its middle below `2^e` in size; `None` for zero alone. Beyond the range of
    /// normal doubles another number of its takes the place of that double.
    fn magnitude(&self) -> Option<isize>;
}

/// The least e with `2^e` above the size of a normal double.
pub(super) fn exponent(x: f64) -> isize {
    (x.abs().to_bits() >> 52) as isize - 1022
}

impl Angle for Interval {
    fn sine_cosine(&self) -> (Interval, Interval) {
        Interval::sine_cosine(self)
    }
    fn pi(bits: usize) -> Interval {
        Interval::pi(bits)
    }
    fn magnitude(&self) -> Option<isize> {
        let about = self.approx();
        if about.is_normal() { Some(exponent(about)) } else { Interval::magnitude(self) }
    }
}

impl Real for Interval {
    fn of(x: f64, bits: usize) -> Interval {
        Interval::new(x, bits)
    }
    fn bits(&self) -> usize {
        Interval::bits(self)
    }
    fn over(&self, divisor: &Interval) -> Option<Interval> {
        Interval::over(self, divisor)
    }
    fn sqrt(&self) -> Option<Interval> {
        Interval::sqrt(self)
    }
    fn union(&self, other: &Interval) -> Interval {
        Interval::union(self, other)
    }
    fn size(&self) -> Interval {
        Interval::size(self)
    }
    fn most(&self) -> f64 {
        Interval::size(self).upper().approx()
    }
    fn middle(&self) -> Interval {
        Interval::middle(self)
    }
    fn approx(&self) -> f64 {
        Interval::approx(self)
    }
    fn power_of_two(exponent: i32, bits: usize) -> Interval {
        Interval::power_of_two(exponent as isize, bits)
    }
    fn ln(&self) -> f64 {
        let Some(exponent) = self.magnitude() else { return f64::NEG_INFINITY };
        let scaled = self * &Interval::power_of_two(-exponent, self.bits());
        scaled.approx().ln() + exponent as f64 * std::f64::consts::LN_2
    }
    fn to_f32(&self) -> Option<f32> {
        Interval::to_f32(self)
    }
}
