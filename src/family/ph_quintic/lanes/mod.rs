//! The f64 step on vectors: nodes that differ in κ1 alone share the knots of one march, and each lane has its own
//! certificates.
//!
//! The algorithm is that of [`super::march`]. Its left-hand sides are sums of products of positive numbers, so that
//! every number here is known up to a relative error that is counted beforehand ([`knot::Bounds`]); no ball is needed.
//! Solutions are found by Newton's method for both equations at once ([`root`]). What the common certificates leave
//! open, near folds, where tangents are nearly parallel, and where numbers are very large or small, is left to the step
//! for one node.

mod knot;
mod march;
mod root;
#[cfg(test)]
mod tests;

use super::curves::Curves;
use super::pair::Pair;
use super::{ANY_SPIRAL, SOLVABLE, SPIRAL};
use crate::family::{Code, outer};
use crate::num::{Ball, Lanes};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};
use knot::{Bounds, Equations};

/// Below this cos Φ the certificates of [`super::narrow`] are needed.
const WIDE: f64 = 1.0 / 16.0;
/// Curvatures other than 0, and constants of a pair, are at least this, and at most its inverse: then no sum of terms
/// leaves the normal doubles, and what underflows is far below the last place of the sum that it enters.
const LEAST: f64 = 1.0 / (1u64 << 60) as f64;

/// The codes of nodes with these curvatures, as many as `out` has; some may be left undecided.
#[inline(always)]
pub(super) fn codes<S: Simd>(simd: S, pair: &Pair<Ball>, kappa0: f64, kappa1: S::f64s, out: &mut [Code]) {
    const { assert!(S::f64s::LEN <= 8, "a plane is a byte") };
    let Some(bounds) = Bounds::of(pair).filter(|_| usable(pair, kappa0)) else {
        out.fill(Code::UNDECIDED);
        return;
    };
    let all = (1 << out.len()) - 1;
    let start = S::f64s::splat(simd, kappa0);
    let (any, no) = match pair.rising {
        true => outer::lanes(simd, &pair.outer.map(|x| x.value), start, kappa1, bounds.outer),
        false => (0, all),
    };
    let zero = S::f64s::splat(simd, 0.0);
    let sized = kappa1.simd_ge(S::f64s::splat(simd, LEAST)) & kappa1.simd_le(S::f64s::splat(simd, 1.0 / LEAST));
    let negative = if kappa0 < 0.0 { all } else { kappa1.simd_lt(zero).to_bitmask() };
    let posed = (sized | kappa1.simd_eq(zero)).to_bitmask() & (any | no) & !negative & all;
    let mut planes = Planes { any, undecided: all & !(posed | negative & (any | no)), ..Planes::default() };
    if posed != 0 {
        // Others would set a scale that is far from theirs.
        let kappa1 = sized.select(kappa1, zero);
        let equations = Equations::new(simd, curves(simd, pair, kappa0, kappa1), bounds);
        let brackets = march::brackets(&equations, posed, kappa0 > 0.0);
        planes.undecided |= brackets.open;
        planes.solutions = brackets.count;
        for bracket in &brackets.slots {
            let wanted = bracket.lanes & any & !planes.undecided;
            if wanted == 0 {
                break;
            }
            let (spirals, not_spirals) = root::spirals(&equations, bracket, wanted);
            planes.undecided |= wanted & !(spirals | not_spirals);
            // A bit a lane, added to two-bit counters.
            planes.spirals = [planes.spirals[0] ^ spirals, planes.spirals[1] | planes.spirals[0] & spirals];
        }
    }
    planes.store(out);
}

/// Whether the numbers of a row are of a size that [`LEAST`] asks for.
#[inline(always)]
fn usable(pair: &Pair<Ball>, kappa0: f64) -> bool {
    let sized = |x: f64| (LEAST..=1.0 / LEAST).contains(&x);
    let [right0, right1] = pair.right.map(|x| x.value);
    pair.cos.value > WIDE && sized(pair.sin.value) && sized(right0) && sized(right1) && (kappa0 <= 0.0 || sized(kappa0))
}

/// The equations of a vector of nodes.
#[inline(always)]
fn curves<S: Simd>(simd: S, pair: &Pair<Ball>, kappa0: f64, kappa1: S::f64s) -> Curves<Lanes<S>> {
    let constant = |x: f64| Lanes::<S>(S::f64s::splat(simd, x));
    let quarter = 4.0 * pair.sin.value;
    let bend = [constant(kappa0 / quarter), Lanes(kappa1 / S::f64s::splat(simd, quarter))];
    let largest = [kappa0 / quarter, kappa1.reduce_max_precise() / quarter];
    let [right0, right1] = pair.right.map(|x| x.value);
    let right = [constant(right0), constant(right1)];
    Curves::scaled(largest, bend, constant(pair.cos.value), right, constant(pair.skew.value))
}

/// Verdicts of a vector of nodes, one bit a lane.
#[derive(Default)]
struct Planes {
    any: u64,
    /// Two bits each.
    solutions: [u64; 2],
    spirals: [u64; 2],
    undecided: u64,
}

impl Planes {
    #[inline(always)]
    fn store(&self, out: &mut [Code]) {
        for (lane, code) in out.iter_mut().enumerate() {
            let bit = |plane: u64| (plane >> lane & 1) as u8;
            if bit(self.undecided) == 1 {
                *code = Code::UNDECIDED;
                continue;
            }
            let number = |planes: [u64; 2]| bit(planes[0]) | bit(planes[1]) << 1;
            let (solutions, spirals) = (number(self.solutions), number(self.spirals));
            let flag = |holds: bool, bit: u8| if holds { bit } else { 0 };
            let flags =
                flag(solutions > 0, SOLVABLE) | flag(spirals > 0, SPIRAL) | flag(bit(self.any) == 1, ANY_SPIRAL);
            *code = Code::new(flags, solutions | spirals << 3);
        }
    }
}
