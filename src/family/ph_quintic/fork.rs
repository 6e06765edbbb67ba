//! A certificate for where one solution becomes three, as in symmetric data: there D' is small over a whole interval, and slopes at its
//! ends, which move by their own size, do not tell its sign.
//!
//! Over the terms w of a curve, with powers k of Z and j of t, `s' = Σ w (j - ks)² / Σ w k`. On a short interval the heights and slopes
//! lie between those at its ends, which encloses both s' and so `D'' = s1' - s0'`. With the same sign at both ends D' keeps it when
//! `|D'(a)| + |D'(b)| > L max |D''|`: it can fall by no more from either. Near a fork, D' like ε + x², that takes L like √ε or x, so
//! that halving needs some log 1/ε knots where slopes alone need 1/√ε.

use super::curves::Curves;
use super::knot::{Knot, length};
use crate::num::Real;
use std::cmp::Ordering::{Equal, Less};

/// Longer intervals are not tried: the enclosures would be wide.
const LONGEST: f64 = 0.25;

/// Whether the curves meet once (`true`) or not (`false`) between two knots, when D' keeps its sign.
pub(super) fn meets<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Option<bool> {
    let length = length(&from.t, &to.t);
    if length > LONGEST {
        return None;
    }
    let once = from.gap.certain_sign(0.0)? != to.gap.certain_sign(0.0)?;
    let slope = |knot: &Knot<N>| knot.s[1].sub(&knot.s[0]);
    let ends = [slope(from), slope(to)];
    let side = ends[0].certain_sign(0.0).filter(|side| *side != Equal && ends[1].certain_sign(0.0) == Some(*side))?;
    let change = curves.slope_changes(&from.t.union(&to.t), |i| (from.z[i].union(&to.z[i]), from.s[i].union(&to.s[i])))?;
    let most = change[1].sub(&change[0]).size().times(length * 1.0001);
    let sum = ends[0].add(&ends[1]).times(if side == Less { -1.0 } else { 1.0 });
    sum.sub(&most).is_positive().then_some(once)
}
