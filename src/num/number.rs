//! One notation for the arithmetic that doubles, SIMD lanes and intervals share, so that a formula is written once.

use super::Interval;
use fearless_simd::{Simd, SimdBase};

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
pub struct Lanes<S: Simd>(pub S::f64s);

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
    pub fn splat(simd: S, value: f64) -> Self {
        Lanes(S::f64s::splat(simd, value))
    }
}
