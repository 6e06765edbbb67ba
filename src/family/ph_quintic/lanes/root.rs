//! Solutions of a vector of nodes, enclosed, and whether their curves are spirals.

use super::knot::Equations;
use super::march::Bracket;
use crate::family::ph_quintic::factors::{CLOSE, HEIGHT, POWERS, ROOM};
use crate::family::ph_quintic::shape::CurveShape;
use crate::num::bernstein::positive;
use crate::num::bernstein_lanes::negative_lanes;
use crate::num::{Lanes, Verdict};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};

/// Newton steps for a solution.
const MOST_STEPS: usize = 16;
/// Halvings of a quintic: as fine as the bounds show.
const DEPTH: u32 = 20;

/// A solution: t and Z, with how far each may be off, relative.
pub(super) struct Root<S: Simd> {
    pub t: S::f64s,
    pub z: S::f64s,
    pub t_off: S::f64s,
    pub z_off: S::f64s,
    pub proved: u64,
}

/// Lanes where the curve of a solution is a spiral, and where it is none.
#[inline(always)]
pub(super) fn spirals<S: Simd>(equations: &Equations<S>, bracket: &Bracket<S>, wanted: u64) -> (u64, u64) {
    let root = root(equations, bracket, wanted);
    let wanted = wanted & root.proved;
    let (value, error) = quintic(equations, &root);
    let zero = equations.splat(0.0);
    let falls = |i: usize| value[i].simd_lt(zero - error[i]);
    let mut rises = value[0].simd_gt(error[0]);
    for i in 1..6 {
        rises &= value[i].simd_gt(error[i]);
    }
    let mut yes = rises.to_bitmask() & wanted;
    let mut no = (falls(0) | falls(5)).to_bitmask() & wanted;
    let mut open = wanted & !(yes | no);
    if open != 0 {
        // Most of those that are no spirals, without halving. Products and Horner's scheme add less than 16 units.
        const BINOMIALS: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        let (mut terms, mut errors) = (value, error);
        for i in 0..6 {
            terms[i] *= BINOMIALS[i];
            errors[i] = error[i] * BINOMIALS[i] + terms[i].abs() * (8.0 * f64::EPSILON);
        }
        for s in [0.5, 1.0, 2.0] {
            no |= negative_lanes(equations.simd, &terms, &errors, s) & open;
        }
        open &= !no;
    }
    while open != 0 {
        let lane = open.trailing_zeros() as usize;
        open &= open - 1;
        let mut c = [0.0; 6];
        let (mut most, mut size) = (0.0f64, 0.0f64);
        for i in 0..6 {
            c[i] = value[i].as_slice()[lane];
            most = most.max(error[i].as_slice()[lane]);
            size = size.max(c[i].abs());
        }
        // A halving adds five roundings.
        match positive(&c, most, 2.5 * f64::EPSILON * (size + most), DEPTH) {
            Verdict::Yes => yes |= 1 << lane,
            Verdict::No => no |= 1 << lane,
            Verdict::Undecided => {}
        }
    }
    (yes, no)
}

/// Bernstein coefficients of κ' up to a positive function, and how far each may be off.
#[inline(always)]
pub(super) fn quintic<S: Simd>(equations: &Equations<S>, root: &Root<S>) -> ([S::f64s; 6], [S::f64s; 6]) {
    let (one, third) = (Lanes(equations.splat(1.0)), Lanes(equations.splat(1.0 / 3.0)));
    let shape = CurveShape::of(&equations.curves, &Lanes(root.t), &Lanes(root.z), [&one, &third]);
    let relative = (root.t_off * 10.0 + root.z_off * 3.0) * POWERS + equations.bounds.quintic;
    let mut value = [equations.splat(0.0); 6];
    let mut error = value;
    for (i, [gain, loss]) in shape.sums().into_iter().enumerate() {
        value[i] = gain.0 - loss.0;
        error[i] = (gain.0 + loss.0) * relative;
    }
    (value, error)
}

/// Newton's method for both equations in logarithms of t and Z, then what the residuals prove.
///
/// The residuals put the heights of both curves at t within `off0` and `off1` of Z ([`HEIGHT`]). So |D| there is at
/// most `-ln(1 - off0) - ln(1 - off1)`. As |D'| is at least the bracket's pace, the solution is no further than |D|
/// over that in ln t; and along the first curve ln Z changes by no more than its steepest slope times it. All these are
/// below [`CLOSE`], where logarithms and errors differ by less than a part in 2000; [`ROOM`] covers that and the
/// roundings.
#[inline(always)]
pub(super) fn root<S: Simd>(equations: &Equations<S>, bracket: &Bracket<S>, wanted: u64) -> Root<S> {
    let [gap_a, gap_b] = bracket.gap;
    let share = gap_a / (gap_a + gap_b);
    let mut t = bracket.from + (bracket.to - bracket.from) * share;
    let mut z = bracket.z[0] + (bracket.z[1] - bracket.z[0]) * share;
    let right = [equations.curves.right[0].0, equations.curves.right[1].0];
    let (half, minus_half, one) = (equations.splat(0.5), equations.splat(-0.5), equations.splat(1.0));
    let (mut r0, mut r1) = (one, one);
    for step in 0..=MOST_STEPS {
        let [first, second] = equations.curves.at(&Lanes(t));
        let (f0, k0, j0) = values(&first, z);
        let (f1, k1, j1) = values(&second, z);
        (r0, r1) = ((f0 - right[0]) / right[0], (f1 - right[1]) / right[1]);
        let near = r0.abs().max(r1.abs()).simd_lt(equations.splat(2f64.powi(-44)));
        // The residuals are those of the place that is left.
        if step == MOST_STEPS || near.to_bitmask() & wanted == wanted {
            break;
        }
        let (k0, j0, k1, j1) = (k0 / right[0], j0 / right[0], k1 / right[1], j1 / right[1]);
        let inverse = one / (k0 * j1 - k1 * j0);
        let up = ((r1 * j0 - r0 * j1) * inverse).max(minus_half).min(half);
        let along = ((k1 * r0 - k0 * r1) * inverse).max(minus_half).min(half);
        t = (t * (along * (along * 0.5 + one) + one)).max(bracket.from).min(bracket.to);
        z *= up * (up * 0.5 + one) + one;
    }
    let close = equations.splat(CLOSE);
    let off0 = r0.abs() * HEIGHT + equations.bounds.height;
    let off1 = r1.abs() * HEIGHT + equations.bounds.height;
    let t_off = (off0 + off1) * ROOM / bracket.pace;
    let z_off = (off0 + bracket.steepest * t_off) * ROOM;
    let inside = t.simd_ge(bracket.from) & t.simd_le(bracket.to);
    let proved = inside & off0.simd_lt(close) & off1.simd_lt(close) & t_off.simd_lt(close) & z_off.simd_lt(close);
    Root { t, z, t_off, z_off, proved: proved.to_bitmask() }
}

/// A left-hand side, and the sums of its terms times their powers of Z and of t.
#[inline(always)]
fn values<S: Simd>(cubic: &super::super::curves::Cubic<Lanes<S>>, z: S::f64s) -> (S::f64s, S::f64s, S::f64s) {
    let [c0, c1, c2] = [cubic.c[0].0, cubic.c[1].0, cubic.c[2].0];
    let [j0, j1, j2] = [cubic.j[0].0, cubic.j[1].0, cubic.j[2].0];
    (((c2 * z + c1) * z + c0) * z, ((c2 * z * 3.0 + c1 * 2.0) * z + c0) * z, ((j2 * z + j1) * z + j0) * z)
}
