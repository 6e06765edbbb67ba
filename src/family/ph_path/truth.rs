//! Verdicts and values of a datum: doubles with error bounds and intervals of growing precision run the same steps.

use super::arc::{Arc, Bound};
use super::curves::{Curve, Curves, curves};
use super::datum::{Datum, Turned};
use super::{ONE_WAY, PAPER, PEAK_INSIDE, REGULAR};
use crate::family::Code;
use crate::num::Real;
use crate::num::bernstein::positive;
use std::cmp::Ordering::{Greater, Less};

/// The greatest curvature of the best solution.
#[derive(Debug, Clone)]
pub(super) enum Greatest<N> {
    /// Every solution stands still somewhere.
    None,
    /// Enclosed.
    Value(N),
}

/// A solution with the part that is looked at, and its guessed peak.
struct Seen<'c, N> {
    curve: &'c Curve<N>,
    part: Arc<N>,
    at: f64,
    most: f64,
}

/// The solutions, the best first as far as guesses tell.
fn seen<N: Real>(curves: &Curves<N>, paper: bool) -> Vec<Seen<'_, N>> {
    let one = |curve| {
        let part = Curve::part(curve);
        let (at, most) = part.guess();
        Seen { curve, part, at, most }
    };
    let mut all: Vec<_> = curves.bent.iter().filter(|c| c.paper || !paper).map(one).collect();
    all.sort_by(|a, b| a.most.total_cmp(&b.most));
    all
}

/// The least greatest |κ| of all solutions, or of the paper's; `None` where the precision does not suffice.
///
/// A curve that stands still in a bend has values beyond every bound. The least of enclosed numbers needs no winner: where two enclosures overlap,
/// their union holds it.
pub(super) fn least<N: Turned>(datum: &Datum, paper: bool, bits: usize) -> Option<Greatest<N>> {
    let curves = curves::<N>(datum, bits)?;
    if curves.straight {
        return Some(Greatest::Value(N::of(0.0, bits)));
    }
    // Half the digits, since near the peak the curvature is level.
    let margin = if bits <= 53 { 2f64.powi(-36) } else { 2f64.powi(-(bits.min(1800) as i32) / 2) };
    let all = seen(&curves, paper);
    let Some(first) = all.first() else { return Some(Greatest::None) };
    let mut best = first.part.greatest(first.at, margin)?;
    for other in &all[1..] {
        let at = N::of(other.at, bits);
        let apart = |value: &N, best: &N| value.sub(best).certain_sign(0.0);
        // A value is enough to be out.
        if other.part.curvature(&at).is_some_and(|k| apart(&k, &best) == Some(Greater)) {
            continue;
        }
        let value = other.part.greatest(other.at, margin)?;
        best = match apart(&value, &best) {
            Some(Greater) => best,
            Some(Less) => value,
            _ => value.union(&best),
        };
    }
    Some(Greatest::Value(best))
}

/// The flags; `None` where the precision does not suffice.
pub(super) fn verdict<N: Turned>(datum: &Datum, bits: usize) -> Option<Code> {
    let curves = curves::<N>(datum, bits)?;
    if curves.straight {
        return Some(Code::new(REGULAR | ONE_WAY | PAPER, 0));
    }
    let all = seen(&curves, false);
    let Some(best) = all.first() else { return Some(Code::new(0, 0)) };
    // It stays below a curvature that all others exceed.
    let limit = match all.get(1) {
        Some(second) if second.most < 4.0 * best.most => (best.most * second.most).sqrt(),
        _ => 2.0 * best.most,
    };
    limit.is_finite().then_some(())?;
    let limit = N::of(limit, bits);
    let Bound::Below = best.part.below(&limit, false) else { return None };
    for other in &all[1..] {
        let value = other.part.curvature(&N::of(other.at, bits))?;
        (value.sub(&limit).certain_sign(0.0) == Some(Greater)).then_some(())?;
    }
    let flag = |holds: bool, bit: u8| if holds { bit } else { 0 };
    let one_way = flag(one_way(&best.curve.whole)?, ONE_WAY);
    let inside = flag(peak_inside(best)?, PEAK_INSIDE);
    Some(Code::new(REGULAR | one_way | inside | flag(best.curve.paper, PAPER), 0))
}

/// Whether h keeps its sign.
fn one_way<N: Real>(curve: &Arc<N>) -> Option<bool> {
    let turn = curve.turn();
    let depth = if turn[0].bits() <= 53 { 20 } else { 100 };
    let [first, _, last] = [0, 1, 2].map(|i| turn[i].certain_sign(0.0));
    match (first, last) {
        (Some(Greater), Some(Less)) | (Some(Less), Some(Greater)) => Some(false),
        (Some(Less), _) | (_, Some(Less)) => positive(&turn.map(|h| h.times(-1.0)), 0.0, 0.0, depth),
        _ => positive(&turn, 0.0, 0.0, depth),
    }
}

/// Whether |κ| is greatest strictly inside, and greater there than at both ends.
fn peak_inside<N: Real>(seen: &Seen<'_, N>) -> Option<bool> {
    let bits = seen.part.turn()[0].bits();
    let at = |t: f64| seen.part.curvature(&N::of(t, bits));
    // The end of half a curve is no end.
    let ends: &[f64] = if seen.curve.folded { &[0.0] } else { &[0.0, 1.0] };
    let above = |k: &N, t: f64| Some(k.sub(&at(t)?).certain_sign(0.0) == Some(Greater));
    if !ends.contains(&seen.at) {
        let peak = at(seen.at)?;
        if ends.iter().map(|t| above(&peak, *t)).collect::<Option<Vec<_>>>()?.into_iter().all(|above| above) {
            return Some(true);
        }
    }
    let turned = !seen.curve.folded && above(&at(1.0)?, 0.0)?;
    if !(seen.curve.folded || turned || above(&at(0.0)?, 1.0)?) {
        return None;
    }
    let part = if turned { seen.part.clone().reversed() } else { seen.part.clone() };
    match part.below(&part.curvature(&N::of(0.0, bits))?, true) {
        Bound::Below => Some(false),
        Bound::Above(_) => None,
        Bound::Open => None,
    }
}
