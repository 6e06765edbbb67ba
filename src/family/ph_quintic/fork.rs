//! Certificates for where solutions merge: two of them, at a fold, or three, as in symmetric data. There D' is small
//! over a whole interval, and slopes at its ends, which move by their own size, do not decide its sign.
//!
//! On a short interval the heights and slopes lie between those at its ends, which encloses how both slopes change
//! ([`Curves::slope_changes`]), and so `D'' = s1' - s0'` and `D''' = s1'' - s0''`.
//! - **D' keeps its sign**, the same at both ends, when `|D'(a)| + |D'(b)| > L max |D''|`: it can fall by no more from
//!   either.
//! - **D is convex** where D'' > 0: with different signs at its ends it is 0 once; below 0 at both it has no zero; and
//!   above 0 it has none when its two tangents meet above 0 ([`above`]). A concave D is convex with the other sign.
//! - **D' is convex** where D''' > 0. If it is not positive at both ends, D falls throughout; if it is above 0 by its
//!   own tangents, D rises. If it is not positive at b, D rises at most once, then falls: it is nowhere below both
//!   ends. If it is not positive at a, D is nowhere above them.
//!
//! With solutions as near each other as ε, D''' is as large as elsewhere. So these intervals need not be as short as ε:
//! only the ends must be well chosen, which is what `cuts.rs` does.

use super::curves::Curves;
use super::knot::{Knot, length};
use crate::num::{Real, Verdict, formula};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// Longer intervals are not tried: the enclosures would be wide.
const LONGEST: f64 = 0.25;

/// What is known where no certificate holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Open {
    /// Nothing.
    Vague,
    /// D' has one zero in between, and is monotone.
    Fold,
    /// D'' has one zero in between, and is monotone.
    Fork,
}

/// The sign, if it is certain and not 0.
pub(super) fn side<N: Real>(x: &N) -> Option<Ordering> {
    x.certain_sign(0.0).filter(|sign| *sign != Equal)
}

/// Whether a convex function is above 0 between two places no further apart than `length`, from values and slopes at
/// both: so is the higher of its tangents.
///
/// Where they meet is worth `(a q - p b + p q L) / (q - p)` for slopes p < 0 < q. Smaller values and a larger length
/// make that smaller.
fn above<N: Real>([a, b]: [&N; 2], [p, q]: [&N; 2], length: &N) -> bool {
    let meet = || formula!(a * q - p * b + p * q * length);
    a.is_positive() && b.is_positive() && (p.is_positive() || q.certain_sign(0.0) == Some(Less) || meet().is_positive())
}

/// Whether the curves meet once (`true`) or not (`false`) between two knots.
pub(super) fn meets<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Result<bool, Open> {
    if length(&from.t, &to.t) > LONGEST { Err(Open::Vague) } else { bent(curves, from, to).unwrap_or(Err(Open::Vague)) }
}

fn bent<N: Real>(curves: &Curves<N>, from: &Knot<N>, to: &Knot<N>) -> Option<Result<bool, Open>> {
    // No less than their distance in x, and as small as they are near each other, also where that is no double.
    let length = &to.t.sub(&from.t).over(&from.t)?;
    let gaps = [side(&from.gap)?, side(&to.gap)?];
    let once = gaps[0] != gaps[1];
    let change =
        curves.slope_changes(&from.t.union(&to.t), |i| (from.z[i].union(&to.z[i]), from.s[i].union(&to.s[i])))?;
    let [second, third] = [change[1].first.sub(&change[0].first), change[1].second.sub(&change[0].second)];
    let slopes = [from.turn(), to.turn()];
    if let Some(sign) = side(&slopes[0]).filter(|sign| side(&slopes[1]) == Some(*sign)) {
        let sum = formula!((slopes[0] + slopes[1]) * { if sign == Less { -1.0 } else { 1.0 } });
        if formula!(sum - second.size() * length).is_positive() {
            return Some(Ok(once));
        }
    }
    if let Some(bent) = side(&second) {
        return Some(convex([from, to], &slopes, gaps, bent, length).decided().ok_or(Open::Fold));
    }
    let bent = side(&third)?;
    // From here on signs are those for D''' > 0.
    let turned = |sign: Ordering| if bent == Less { sign.reverse() } else { sign };
    let up = |x: &N| if bent == Less { x.times(-1.0) } else { x.clone() };
    let [a, b] = slopes.each_ref().map(up);
    let ends = [curves.change(from)?, curves.change(to)?];
    let [p, q] = ends.each_ref().map(|changes| up(&changes[0]));
    let falls = [&a, &b].map(|x| x.certain_sign(0.0).is_some_and(|sign| sign != Greater));
    let (level, signs) = (gaps[0], falls.map(|falls| falls && once));
    match () {
        () if falls == [true; 2] || above([&a, &b], [&p, &q], length) => return Some(Ok(once)),
        () if signs[0] || signs[1] => return Some(Ok(true)),
        () if falls[1] && turned(level) == Greater && !once => return Some(Ok(false)),
        () if falls[0] && turned(level) == Less && !once => return Some(Ok(false)),
        () => {}
    }
    let convexity = match () {
        () if p.is_positive() => turned(Greater),
        () if side(&q) == Some(Less) => turned(Less),
        () if side(&p).is_some() && q.is_positive() => return Some(Err(Open::Fork)),
        () => return Some(Err(Open::Vague)),
    };
    Some(convex([from, to], &slopes, gaps, convexity, length).decided().ok_or(Open::Fold))
}

/// The same where D'' has one sign.
fn convex<N: Real>(knots: [&Knot<N>; 2], slopes: &[N; 2], gaps: [Ordering; 2], bent: Ordering, length: &N) -> Verdict {
    if gaps[0] != gaps[1] || gaps[0] != bent {
        return Verdict::of(gaps[0] != gaps[1]);
    }
    let up = |x: &N| if bent == Less { x.times(-1.0) } else { x.clone() };
    let ([a, b], [p, q]) = (knots.map(|knot| up(&knot.gap)), slopes.each_ref().map(up));
    Verdict::proved(false, above([&a, &b], [&p, &q], length))
}
