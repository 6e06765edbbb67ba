//! Two more certificates, for φ0 + φ1 close to π: there cos Φ is small, and the two curves of [`super::curves`] lie so
//! close that slopes at the ends of an interval hardly tell them apart.
//!
//! Along the second curve the first equation's residual is `2 cos Φ H`, `H = E1 - E0 + 30 sin δ / sin Φ`,
//! `δ = (φ1 - φ0)/2`: H has the sign of -D, and is not small. Between two knots A falls and B rises, so each of its
//! terms lies between its values at corners; and with `dζ/dx = -s` a term with the powers k of Z and j of t changes by
//! its (j - ks)-fold.

use super::curves::Curves;
use super::knot::Knot;
use crate::num::{Real, Verdict, formula};

/// Above this cos Φ the other certificates do as well.
const WIDE: f64 = 1.0 / 16.0;

/// Whether the curves meet, and then once, or do not between two knots, when H decides.
pub(super) fn meets<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Verdict {
    by_residual(curves, from, to).into()
}

fn by_residual<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Option<bool> {
    if curves.cos.approx() > WIDE {
        return None;
    }
    let same = from.gap.certain_sign(0.0)? == to.gap.certain_sign(0.0)?;
    let [p, q] = curves.scale;
    // a and b in the box, and 3A², 3B², 3αA³B, 3βAB³, 2α²A⁶, 2β²B⁶ there.
    let a = to.z[1].sqrt()?.union(&from.z[1].sqrt()?);
    let b = from.t.mul(&from.z[1].sqrt()?).union(&to.t.mul(&to.z[1].sqrt()?));
    let (a2, b2) = (formula!(a * a), formula!(b * b));
    let [alpha, beta] = &curves.bend;
    let (bend0, bend1) = (formula!(alpha * a2 * a), formula!(beta * b2 * b));
    let (flat0, flat1) = (a2.times(3.0 * p * p), b2.times(3.0 * q * q));
    let (mixed1, mixed0) = (formula!(bend0 * b * { 3.0 * q }), formula!(bend1 * a * { 3.0 * p }));
    let (last1, last0) = (formula!(2.0 * (bend0 * bend0)), formula!(2.0 * (bend1 * bend1)));
    let h = formula!(flat1 + mixed1 + last1 - (flat0 + mixed0 + last0) + curves.skew);
    if same && h.certain_sign(0.0).is_some_and(|sign| sign.is_ne()) {
        return Some(false);
    }
    let s = from.s[1].union(&to.s[1]);
    let rest = formula!(2.0 - s);
    let turns = |x: &N, j: f64, k: f64| formula!(x * (s * { -k } + { j }));
    let gains = formula!(flat1 * rest + turns(&mixed1, 1.0, 2.0) + flat0 * s);
    let losses = formula!(3.0 * (last1 * s) + turns(&mixed0, 3.0, 2.0) + 3.0 * (last0 * rest));
    let rise = formula!(gains - losses).certain_sign(0.0)?;
    // A rising H is a falling D.
    rise.is_ne().then_some(!same)
}
