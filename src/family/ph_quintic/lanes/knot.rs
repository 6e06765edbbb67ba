//! Both curves at one t, for a vector of nodes, with the errors of all numbers counted beforehand.

use crate::family::ph_quintic::curves::{Cubic, Curves};
use crate::family::ph_quintic::factors::{FAR, GAP, HEIGHT, SLOPE};
use crate::family::ph_quintic::pair::Pair;
use crate::num::{Ball, COVER, Lanes};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};

/// Unit roundoff.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// Relative errors. Every number is a sum of products of positive ones, so they add up along products and do not grow
/// in sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Heights, beside the residual: [`Equations::height`].
    pub height: f64,
    /// Slopes, beside the heights: [`Equations::slope_error`].
    pub slope: f64,
    /// Coefficients of the quintic of κ', beside those of its solution.
    pub quintic: f64,
    /// What the outer bound asks for.
    pub outer: f64,
}

impl Bounds {
    /// From the constants of a pair; `None` when they are hardly known.
    #[inline(always)]
    pub(super) fn of(pair: &Pair<Ball>) -> Option<Bounds> {
        let relative = |x: &Ball| x.error / x.value;
        let constants = [&pair.sin, &pair.cos, &pair.right[0], &pair.right[1]];
        let mut input = constants.into_iter().fold(0.0, |most: f64, x| most.max(relative(x)));
        // α and β: a quotient more. Not for NaN either.
        input += 2.0 * UNIT;
        (input < 2f64.powi(-24)).then_some(())?;
        // The longest product of a coefficient is 6 times 2Cβ² t⁶, of three constants: t⁶ takes five roundings, the
        // rest five, and sums two. For inputs so small the third power is within COVER.
        let coefficient = COVER * 3.0 * input + 14.0 * UNIT;
        let outer = pair.outer.iter().fold(0.0, |most: f64, x| most.max(if x.value > 0.0 { relative(x) } else { 1.0 }));
        Some(Bounds {
            // The cubic in Z takes five roundings, its difference to the right-hand side and the quotient two.
            height: HEIGHT * (coefficient + input + 8.0 * UNIT),
            // Numerator and denominator: a coefficient and up to six roundings each, and the quotient.
            slope: COVER * (2.0 * coefficient + 14.0 * UNIT),
            // A product of a turn and a speed: at most five constants, fewer than 40 roundings.
            quintic: COVER * (5.0 * input + 40.0 * UNIT),
            outer: COVER * outer + 4.0 * UNIT,
        })
    }
}

/// The two equations of a vector of nodes.
pub(super) struct Equations<S: Simd> {
    pub simd: S,
    pub curves: Curves<Lanes<S>>,
    pub bounds: Bounds,
}

/// Both curves at one t that all lanes share.
#[derive(Clone, Copy)]
pub(super) struct Knot<S: Simd> {
    pub t: f64,
    /// Heights Z of the two curves.
    pub z: [S::f64s; 2],
    /// Slopes s.
    pub s: [S::f64s; 2],
    /// `2 (Z0 - Z1)/(Z0 + Z1)`: of the sign of D, and no larger.
    pub gap: S::f64s,
    /// How far both heights may be off, relative; infinite where they are not known.
    pub off: S::f64s,
}

/// Newton steps for a height.
const MOST_STEPS: usize = 40;

impl<S: Simd> Equations<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, curves: Curves<Lanes<S>>, bounds: Bounds) -> Equations<S> {
        Equations { simd, curves, bounds }
    }

    #[inline(always)]
    pub(super) fn splat(&self, x: f64) -> S::f64s {
        S::f64s::splat(self.simd, x)
    }

    /// Where a cubic reaches `right`, and how far that may be off, relative.
    ///
    /// The residual and what its sums are off by, times [`HEIGHT`].
    #[inline(always)]
    pub(super) fn height(
        &self,
        cubic: &Cubic<Lanes<S>>,
        right: S::f64s,
        guess: S::f64s,
        wanted: u64,
    ) -> (S::f64s, S::f64s) {
        let [c0, c1, c2] = [cubic.c[0].0, cubic.c[1].0, cubic.c[2].0];
        let mut z = guess;
        for _ in 0..MOST_STEPS {
            let residual = ((c2 * z + c1) * z + c0) * z - right;
            let step = residual / ((c2 * z * 3.0 + c1 * 2.0) * z + c0);
            z -= step;
            // The next step is about the square of this one.
            if step.abs().simd_le(z * 2f64.powi(-27)).to_bitmask() & wanted == wanted {
                break;
            }
        }
        let residual = (((c2 * z + c1) * z + c0) * z - right).abs() / right;
        let known = residual.simd_lt(self.splat(FAR)) & z.simd_gt(self.splat(0.0));
        (z, known.select(residual * HEIGHT + self.bounds.height, self.splat(f64::INFINITY)))
    }

    /// A height from no guess: it is below what one of the terms alone would need.
    #[inline(always)]
    pub(super) fn lone_height(&self, cubic: &Cubic<Lanes<S>>, right: S::f64s, wanted: u64) -> (S::f64s, S::f64s) {
        let guess = (right / cubic.c[0].0).min((right / cubic.c[1].0).sqrt());
        self.height(cubic, right, guess, wanted)
    }

    /// Both curves at t; a guess of their heights helps.
    #[inline(always)]
    pub(super) fn knot(&self, t: f64, guess: Option<[S::f64s; 2]>, wanted: u64) -> Knot<S> {
        let [first, second] = self.curves.at(&Lanes(self.splat(t)));
        let right = [self.curves.right[0].0, self.curves.right[1].0];
        let ((z0, off0), (z1, off1)) = match guess {
            Some([z0, z1]) => (self.height(&first, right[0], z0, wanted), self.height(&second, right[1], z1, wanted)),
            None => (self.lone_height(&first, right[0], wanted), self.lone_height(&second, right[1], wanted)),
        };
        let s = [slope(&first, z0), slope(&second, z1)];
        Knot { t, z: [z0, z1], s, gap: (z0 - z1) * 2.0 / (z0 + z1), off: off0.max(off1) }
    }

    /// How far a gap may be off: by the heights, and by three roundings of a number up to 2; one more for taking this
    /// away from it.
    #[inline(always)]
    pub(super) fn gap_error(&self, knot: &Knot<S>) -> S::f64s {
        knot.off * GAP + 8.0 * UNIT
    }

    /// How far slopes may be off, relative.
    #[inline(always)]
    pub(super) fn slope_error(&self, knot: &Knot<S>) -> S::f64s {
        knot.off * SLOPE + self.bounds.slope
    }
}

#[inline(always)]
fn slope<S: Simd>(cubic: &Cubic<Lanes<S>>, z: S::f64s) -> S::f64s {
    let [c0, c1, c2] = [cubic.c[0].0, cubic.c[1].0, cubic.c[2].0];
    let [j0, j1, j2] = [cubic.j[0].0, cubic.j[1].0, cubic.j[2].0];
    ((j2 * z + j1) * z + j0) / ((c2 * z * 3.0 + c1 * 2.0) * z + c0)
}
