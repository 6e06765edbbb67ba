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
            // As in `times` of [`super::Form`].
            error: (self.error * k + (self.size() * k) * UNIT) * GROW + TINY,
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
            // As in `times` of [`super::Form`].
            error: (self.error * k.abs() + (self.size() * k.abs()) * UNIT) * GROW + TINY,
        }
    }
    #[inline(always)]
    fn plus(&self, k: f64) -> Self {
        let value = self.value + k;
        FormLanes { value, error: (self.error + value.abs() * UNIT) * GROW, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use crate::num::{Interval, Quadratic};
    use fearless_simd::{Level, dispatch};

    /// The first lane of a form, with what it holds at least and at most.
    fn first<S: Simd>(form: &FormLanes<S>) -> (Quadratic, [f64; 2]) {
        let lane = |x: S::f64s| x.as_slice()[0];
        let plain = Quadratic {
            value: lane(form.value),
            slope: form.slope.map(lane),
            bend: form.bend.map(lane),
            error: lane(form.error),
        };
        (plain, [lane(form.low()), lane(form.high())])
    }

    /// `((p q + c)² - 0.3 p) s + q`, and its least half in Bernstein's form with p and q.
    fn expressions<S: Simd>(simd: S, [p, q]: [[f64; 2]; 2], c: f64, s: f64) -> [(Quadratic, [f64; 2]); 2] {
        let along = |[low, high]: [f64; 2], symbol: usize| {
            let mut form = FormLanes::exact(simd, S::f64s::splat(simd, 0.5 * (low + high)));
            form.slope[symbol] = S::f64s::splat(simd, 0.5 * (high - low));
            form.off(S::f64s::splat(simd, 2.0 * f64::EPSILON * (low.abs() + high.abs())))
        };
        let (p, q) = (along(p, 0), along(q, 1));
        let sum = p.mul(&q).plus(c);
        let long = sum.mul(&sum).sub(&p.times(0.3)).scaled(S::f64s::splat(simd, s)).add(&q);
        let [half, _] = halve_forms(&[p, long, q]);
        [first(&long), first(&half[2])]
    }

    /// Of random expressions over ranges of any width: the truth is held, and not by being far too large.
    #[test]
    fn lanes_hold_the_truth() {
        let mut noise = Noise(8);
        let (mut worst, mut tight) = (0.0f64, 0);
        for _ in 0..3000 {
            let width = 2f64.powi((40.0 * (noise.signed() - 1.0)) as i32);
            let ranges = [0, 1].map(|_| {
                let (middle, half) = (4.0 * noise.signed(), width * noise.next());
                [middle - half * middle.abs(), middle + half * middle.abs()]
            });
            let (c, s) = (noise.signed(), noise.next());
            let found = dispatch!(Level::new(), simd => expressions(simd, ranges, c, s));
            for _ in 0..4 {
                let place = [0, 1].map(|_| (2.0 * noise.signed()).clamp(-1.0, 1.0));
                let [p, q] = [0, 1].map(|i| {
                    let [low, high] = ranges[i].map(|x| Interval::new(x, 300));
                    &low.scale(0.5 - 0.5 * place[i]) + &high.scale(0.5 + 0.5 * place[i])
                });
                let long = &(&(&p * &q).plus(c).square() - &p.scale(0.3)).scale(s) + &q;
                let half = &(&p + &q).scale(0.25) + &long.scale(0.5);
                for ((form, [low, high]), truth) in found.iter().zip([long, half]) {
                    let symbols = place.map(|x| Interval::new(x, 300));
                    let [x, y] = &symbols;
                    let terms = [(form.slope[0], x.clone()), (form.slope[1], y.clone())];
                    let squares = [(form.bend[0], x.square()), (form.bend[1], x * y), (form.bend[2], y.square())];
                    let held = terms
                        .iter()
                        .chain(&squares)
                        .fold(Interval::new(form.value, 300), |sum, (k, term)| &sum + &term.scale(*k));
                    let (off, truth) = ((&truth - &held).approx().abs(), truth.approx());
                    assert!(off <= form.error, "{ranges:?} at {place:?}: {form:?} is off by {off}");
                    assert!(*low <= truth && truth <= *high, "{ranges:?} at {place:?}: {form:?} {low} {high}");
                    worst = worst.max(off / form.error);
                    tight += usize::from(high - low < 4.0 * form.range().error + 1e-12);
                }
            }
        }
        assert!(worst > 0.1 && tight > 20_000, "{worst} {tight}");
    }
}
