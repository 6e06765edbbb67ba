//! Two more certificates, for φ0 + φ1 close to π: there cos Φ is small, and the two curves of [`super::curves`] lie so close that slopes
//! at the ends of an interval hardly tell them apart.
//!
//! Along the second curve the first equation's residual is `2 cos Φ H`, `H = E1 - E0 + 30 sin δ / sin Φ`, `δ = (φ1 - φ0)/2`: H has the
//! sign of -D, and is not small. Between two knots A falls and B rises, so each of its terms lies between its values at corners; and
//! with `dζ/dx = -s` a term with the powers k of Z and j of t changes by its (j - ks)-fold.

use super::curves::Curves;
use super::knot::Knot;
use crate::num::Real;

/// Above this cos Φ the other certificates do as well.
const WIDE: f64 = 1.0 / 16.0;

/// Whether the curves meet once (`true`) or not (`false`) between two knots, when H tells.
pub(super) fn meets<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Option<bool> {
    if curves.cos.approx() > WIDE {
        return None;
    }
    let same = from.gap.certain_sign(0.0)? == to.gap.certain_sign(0.0)?;
    let [p, q] = curves.scale;
    // a and b in the box, and 3A², 3B², 3αA³B, 3βAB³, 2α²A⁶, 2β²B⁶ there.
    let a = to.z[1].sqrt()?.union(&from.z[1].sqrt()?);
    let b = from.t.mul(&from.z[1].sqrt()?).union(&to.t.mul(&to.z[1].sqrt()?));
    let (a2, b2) = (a.mul(&a), b.mul(&b));
    let [alpha, beta] = &curves.bend;
    let (bend0, bend1) = (alpha.mul(&a2).mul(&a), beta.mul(&b2).mul(&b));
    let (flat0, flat1) = (a2.times(3.0 * p * p), b2.times(3.0 * q * q));
    let (mixed1, mixed0) = (bend0.mul(&b).times(3.0 * q), bend1.mul(&a).times(3.0 * p));
    let (last1, last0) = (bend0.mul(&bend0).times(2.0), bend1.mul(&bend1).times(2.0));
    let h = flat1.add(&mixed1).add(&last1).sub(&flat0.add(&mixed0).add(&last0)).add(&curves.skew);
    if same && h.certain_sign(0.0).is_some_and(|sign| sign.is_ne()) {
        return Some(false);
    }
    let s = from.s[1].union(&to.s[1]);
    let rest = s.times(-1.0).plus(2.0);
    let turns = |x: &N, j: f64, k: f64| x.mul(&s.times(-k).plus(j));
    let gains = flat1.mul(&rest).add(&turns(&mixed1, 1.0, 2.0)).add(&flat0.mul(&s));
    let losses = last1.mul(&s).times(3.0).add(&turns(&mixed0, 3.0, 2.0)).add(&last0.mul(&rest).times(3.0));
    let rise = gains.sub(&losses).certain_sign(0.0)?;
    // A rising H is a falling D.
    rise.is_ne().then_some(!same)
}
