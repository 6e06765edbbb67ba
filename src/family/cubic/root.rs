//! Roots of the two parabolas in SIMD lanes: guessed by Newton's method, proved by signs, and the spiral polynomial
//! there.

use super::poly::{Bounds, side};
use super::precision::{ENDS, Precision, Prepared, SMALL, THROUGH_X, TRIED};
use crate::family::rows::bits;
use crate::num::bernstein::Quintic;
use crate::num::{COVER, Lanes, Number};
use fearless_simd::{Simd, SimdBase};

/// A vector of data: κ0, κ1 and the normalised a, k, each within [`Precision::input`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Data<S: Simd> {
    /// a = κ0 d0² / (4 sin φ0).
    pub a: S::f64s,
    /// k = κ1 d1² / (4 sin φ1).
    pub k: S::f64s,
    /// κ0.
    pub kappa0: S::f64s,
    /// κ1.
    pub kappa1: S::f64s,
    /// How accurate the four are.
    pub precision: Precision,
}

/// A root known to lie within `delta` of (x, y), in both coordinates.
#[derive(Clone, Copy)]
pub(super) struct Root<S: Simd> {
    pub x: S::f64s,
    pub y: S::f64s,
    pub delta: S::f64s,
    pub low: S::f64s,
    pub high: S::f64s,
    pub proved: u64,
}

/// `F = 3 - x - k y²` with its error, `y = 3 - a x²`, and `J = F' = 4akxy - 1`.
#[inline(always)]
pub(super) fn residual<S: Simd>(simd: S, d: &Data<S>, x: S::f64s) -> (S::f64s, S::f64s, S::f64s, S::f64s) {
    let three = S::f64s::splat(simd, 3.0);
    let v = d.a * x * x;
    let y = three - v;
    let wide = y.abs() + d.precision.eta();
    let kw = d.k * wide;
    // y is off by at most (input + 2) V + y units, x by 1, k by `input`; products and the final difference as counted
    // in `Precision`.
    let error = (kw * wide + kw * (v + wide) * 2.0) * d.precision.residual() + d.precision.residual_floor();
    let slope = d.a * x * (d.k * y) * 4.0 - 1.0;
    ((three - x) - d.k * (y * y), error, y, slope)
}

/// Newton from `start`: a guess of a root.
#[inline(always)]
pub(super) fn settle<S: Simd>(simd: S, d: &Data<S>, start: S::f64s, wanted: u64) -> S::f64s {
    const MOST_STEPS: u32 = 24;
    let mut x = start;
    for _ in 0..MOST_STEPS {
        let y = S::f64s::splat(simd, 3.0) - d.a * x * x;
        let ky = d.k * y;
        let step = ((S::f64s::splat(simd, 3.0) - x) - ky * y) / (d.a * x * ky * 4.0 - 1.0);
        x -= step;
        // The next error is the square of this step times F''/2F', usually below 100: under 2^-52 with this limit.
        if bits::<S>(step.abs().simd_lt(x * 2f64.powi(-30))) & wanted == wanted {
            break;
        }
    }
    x
}

/// Newton from `start`, then a proof: F has opposite certain signs at `x - δ` and `x + δ`, both inside the box.
#[inline(always)]
pub(super) fn root<S: Simd>(simd: S, d: &Data<S>, start: S::f64s, wanted: u64) -> Root<S> {
    let x = settle(simd, d, start, wanted);
    let (_, error, y, slope) = residual(simd, d, x);
    // Any δ would do that the proof accepts; this one it usually does.
    let delta = error * TRIED / slope.abs() + x * 2f64.powi(-50);
    let (low, high) = (x - delta, x + delta);
    let (f_low, e_low, _, _) = residual(simd, d, low);
    let (f_high, e_high, y_high, _) = residual(simd, d, high);
    let crossing = (f_low.simd_gt(e_low) & f_high.simd_lt(-e_high)) | (f_low.simd_lt(-e_low) & f_high.simd_gt(e_high));
    let zero = S::f64s::splat(simd, 0.0);
    let inside = low.simd_gt(zero)
        & high.simd_le(S::f64s::splat(simd, 3.0))
        & y_high.simd_gt(S::f64s::splat(simd, d.precision.eta()));
    let small = (delta * SMALL).simd_lt(x);
    // The root lies between the rounded x - δ and x + δ.
    let delta = delta * COVER + ENDS * Precision::F64.unit;
    let delta_y = d.a * x * delta * THROUGH_X + d.precision.eta();
    Root { x, y, delta: delta.max(delta_y), low, high, proved: bits::<S>(crossing & inside & small) }
}

/// B0, B1, B2 of one side with their errors.
#[derive(Clone, Copy)]
pub(super) struct Side<S: Simd> {
    pub value: [S::f64s; 3],
    pub error: [S::f64s; 3],
}

/// The two sides of the spiral polynomial at a root; the second is already negated (H5, H4, H3 up to positive factors).
#[inline(always)]
pub(super) fn sides<S: Simd>(simd: S, prepared: &Prepared, root: &Root<S>) -> (Side<S>, Side<S>) {
    let pair = &prepared.pair;
    let n = |value: f64| Lanes::<S>::splat(simd, value);
    let (x, y) = (Lanes::<S>(root.x), Lanes::<S>(root.y));
    let start = side(&x, &y, &n(pair.p), &n(pair.g0), &n(pair.r));
    let end = side(&y, &x, &n(pair.r), &n(pair.g1), &n(pair.p));
    let error = |b: &Bounds| {
        let of = |i: usize| root.delta * b.slope[i] + b.rounding[i];
        [of(0), of(1), of(2)]
    };
    (
        Side { value: start.map(|v| v.0), error: error(&prepared.bounds.0) },
        Side { value: end.map(|v| v.times(-1.0).0), error: error(&prepared.bounds.1) },
    )
}

impl<S: Simd> Side<S> {
    /// `w² B0, w B1, w B2`, and how far each may be off before its own rounding: w and the B are off by `delta` and
    /// their errors.
    #[inline(always)]
    pub(super) fn weighed(&self, w: S::f64s, delta: S::f64s) -> [(S::f64s, S::f64s); 3] {
        let ([b0, b1, b2], [e0, e1, e2], near) = (self.value, self.error, w + delta);
        let square = (near * near * e0 + (w + near) * delta * b0.abs()) * COVER;
        let first = (near * e1 + delta * b1.abs()) * COVER;
        let second = (near * e2 + delta * b2.abs()) * COVER;
        [(w * w * b0, square), (w * b1, first), (w * b2, second)]
    }
}

/// The Bernstein coefficients of the spiral polynomial (times 5) in one lane, and how far each may be off.
///
/// `b = (5y²B0, yB1, yB2, xC2, xC1, 5x²C0)`: the binomials of degree 5 divide `H_i`.
#[inline(always)]
pub(super) fn bernstein<S: Simd>(start: &Side<S>, end: &Side<S>, root: &Root<S>, lane: usize) -> (Quintic<f64>, f64) {
    let halves = [start.weighed(root.y, root.delta), end.weighed(root.x, root.delta)];
    let mut c = [0.0; 6];
    let mut worst = 0.0f64;
    for (half, places) in halves.iter().zip([[0, 1, 2], [5, 4, 3]]) {
        for ((value, error), (place, factor)) in half.iter().zip(places.into_iter().zip([5.0, 1.0, 1.0])) {
            let (value, error) = (factor * value.as_slice()[lane], factor * error.as_slice()[lane]);
            c[place] = value;
            // Up to four roundings a coefficient.
            worst = worst.max(error + 4.0 * Precision::F64.unit * value.abs());
        }
    }
    (c, worst)
}
