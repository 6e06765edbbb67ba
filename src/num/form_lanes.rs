//! Forms in two symbols on vectors: a box in each lane.
//!
//! The operations, and what each adds to the error, are those of [`super::Form`]; what is derived there holds here.

use super::Number;
use super::form::{GROW, TINY, UNIT};
use fearless_simd::{Simd, SimdBase};

/// All functions of two symbols x and y from -1 to 1 within `error` of `value + slope · (x, y) + bend · (x², xy, y²)`.
#[derive(Clone, Copy)]
pub(crate) struct FormLanes<S: Simd> {
    pub value: S::f64s,
    pub slope: [S::f64s; 2],
    pub bend: [S::f64s; 3],
    /// At least 0.
    pub error: S::f64s,
}

impl<S: Simd> FormLanes<S> {
    /// Numbers known exactly.
    #[inline(always)]
    pub(crate) fn exact(simd: S, value: S::f64s) -> FormLanes<S> {
        let zero = S::f64s::splat(simd, 0.0);
        FormLanes { value, slope: [zero; 2], bend: [zero; 3], error: zero }
    }

    #[inline(always)]
    pub(crate) fn linear(&self) -> S::f64s {
        self.slope[0].abs() + self.slope[1].abs()
    }

    #[inline(always)]
    pub(crate) fn curved(&self) -> S::f64s {
        self.bend[0].abs() + self.bend[1].abs() + self.bend[2].abs()
    }

    #[inline(always)]
    fn size(&self) -> S::f64s {
        self.value.abs() + self.linear() + self.curved()
    }

    /// No number that it holds is larger in size.
    #[inline(always)]
    pub(crate) fn most(&self) -> S::f64s {
        (self.size() + self.error) * (GROW * GROW)
    }

    /// Less than every number it holds.
    #[inline(always)]
    pub(crate) fn low(&self) -> S::f64s {
        self.value - self.depth(1.0)
    }

    /// More than every number it holds.
    #[inline(always)]
    pub(crate) fn high(&self) -> S::f64s {
        self.value + self.depth(-1.0)
    }

    /// How far `sign` times the form falls below `sign` times its value, at most.
    ///
    /// Half of the mixed term goes to each symbol, as in [`super::Form`]. Then `s t + b t²` falls by `s - b` where
    /// `|s| >= 2b`, and by less than `|s|/2` elsewhere: so by no more than the larger of the two.
    #[inline(always)]
    fn depth(&self, sign: f64) -> S::f64s {
        let half = self.bend[1].abs() * 0.5;
        let (first, last) = (self.bend[0] * sign - half, self.bend[2] * sign - half);
        let (one, two) = (self.slope[0].abs(), self.slope[1].abs());
        let fall = (one - first).max(one * 0.5) + (two - last).max(two * 0.5);
        fall + (self.error + self.size() * (32.0 * UNIT)) * GROW + TINY
    }

    /// Off by so much more.
    #[inline(always)]
    pub(crate) fn off(mut self, error: S::f64s) -> FormLanes<S> {
        self.error = (self.error + error) * GROW;
        self
    }

    /// Product with an exact number for each lane, at least 0.
    #[inline(always)]
    pub(crate) fn scaled(&self, k: S::f64s) -> FormLanes<S> {
        FormLanes {
            value: self.value * k,
            slope: [self.slope[0] * k, self.slope[1] * k],
            bend: [self.bend[0] * k, self.bend[1] * k, self.bend[2] * k],
            error: (self.error + self.size() * UNIT) * k * GROW + TINY,
        }
    }
}

/// The halves of a polynomial in Bernstein's form, as [`super::bernstein::halve`] makes them.
#[inline(always)]
pub(crate) fn halve_forms<S: Simd, const K: usize>(c: &[FormLanes<S>; K]) -> [[FormLanes<S>; K]; 2] {
    let (mut left, mut right) = (*c, *c);
    for step in 1..K {
        left[step - 1] = right[0];
        for i in 0..K - step {
            right[i] = right[i].add(&right[i + 1]).times(0.5);
        }
    }
    left[K - 1] = right[0];
    [left, right]
}

/// The same operation for every coefficient of two forms.
macro_rules! zip {
    ($one:expr, $other:expr, $op:tt) => {{
        let (one, other) = ($one, $other);
        let sum = FormLanes {
            value: one.value $op other.value,
            slope: [one.slope[0] $op other.slope[0], one.slope[1] $op other.slope[1]],
            bend: [one.bend[0] $op other.bend[0], one.bend[1] $op other.bend[1], one.bend[2] $op other.bend[2]],
            error: one.error,
        };
        FormLanes { error: (one.error + other.error + sum.size() * UNIT) * GROW, ..sum }
    }};
}

impl<S: Simd> Number for FormLanes<S> {
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        zip!(self, other, +)
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        zip!(self, other, -)
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        let (x, y) = (self.value, other.value);
        let (one, two, own, its) = (self.linear(), other.linear(), self.curved(), other.curved());
        let (size, other_size) = (x.abs() + one + own, y.abs() + two + its);
        let cut = one * its + own * (two + its);
        let inputs = self.error * (other_size + other.error) + other.error * size;
        let ([a, b], [c, d]) = (self.slope, other.slope);
        FormLanes {
            value: x * y,
            slope: [x * c + a * y, x * d + b * y],
            bend: [
                x * other.bend[0] + a * c + self.bend[0] * y,
                x * other.bend[1] + (a * d + b * c) + self.bend[1] * y,
                x * other.bend[2] + b * d + self.bend[2] * y,
            ],
            error: (cut + inputs + size * other_size * (4.0 * UNIT)) * GROW + TINY,
        }
    }
    #[inline(always)]
    fn times(&self, k: f64) -> Self {
        FormLanes {
            value: self.value * k,
            slope: [self.slope[0] * k, self.slope[1] * k],
            bend: [self.bend[0] * k, self.bend[1] * k, self.bend[2] * k],
            error: (self.error + self.size() * UNIT) * (k.abs() * GROW) + TINY,
        }
    }
    #[inline(always)]
    fn plus(&self, k: f64) -> Self {
        let value = self.value + k;
        FormLanes { value, error: (self.error + value.abs() * UNIT) * GROW, ..*self }
    }
}
