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
    let margin = margin(bits);
    let all = seen(&curves, paper);
    let Some(first) = all.first() else { return Some(Greatest::None) };
    let mut best = first.part.greatest(first.at, &margin)?;
    for other in &all[1..] {
        let at = N::of(other.at, bits);
        let apart = |value: &N, best: &N| value.sub(best).certain_sign(0.0);
        // A value is enough to be out.
        if other.part.curvature(&at).is_some_and(|k| apart(&k, &best) == Some(Greater)) {
            continue;
        }
        let value = other.part.greatest(other.at, &margin)?;
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
    if all.is_empty() {
        return Some(Code::new(0, 0));
    }
    // It stays below a curvature that all others exceed.
    let best = winner(&all, bits)?;
    let flag = |holds: bool, bit: u8| if holds { bit } else { 0 };
    let one_way = flag(one_way(&best.curve.whole)?, ONE_WAY);
    let inside = flag(peak_inside(best)?, PEAK_INSIDE);
    Some(Code::new(REGULAR | one_way | inside | flag(best.curve.paper, PAPER), 0))
}

/// The solution whose greatest |κ| is least: it stays below a curvature that all others exceed.
fn winner<'s, 'c, N: Turned>(all: &'s [Seen<'c, N>], bits: usize) -> Option<&'s Seen<'c, N>> {
    let least = all.first()?.most;
    // Guesses cannot tell these apart.
    let (close, clear) = all.split_at(all.partition_point(|seen| seen.most <= least * (1.0 + 1e-9)));
    let next = clear.first().map_or(f64::INFINITY, |seen| seen.most);
    let limit = (least * next.min(4.0 * least)).sqrt();
    limit.is_finite().then_some(())?;
    let limit = N::of(limit, bits);
    let exceeds = |value: &N, limit: &N| value.sub(limit).certain_sign(0.0) == Some(Greater);
    for other in clear {
        exceeds(&other.part.curvature(&N::of(other.at, bits))?, &limit).then_some(())?;
    }
    if let [only] = close {
        return matches!(only.part.below(&limit, false), Bound::Below).then_some(only);
    }
    let value = |seen: &Seen<'c, N>| seen.part.greatest(seen.at, &margin(bits));
    let values = close.iter().map(value).collect::<Option<Vec<_>>>()?;
    let wins = |i: &usize| exceeds(&limit, &values[*i]) && (0..close.len()).all(|j| j == *i || exceeds(&values[j], &values[*i]));
    (0..close.len()).find(wins).map(|i| &close[i])
}

/// How much above the value at a peak is tried, relative: half the digits, since the curvature is level there.
fn margin<N: Real>(bits: usize) -> N {
    let halvings = if bits <= 53 { 36 } else { (bits / 2).min(1200) as i32 };
    N::of(2f64.powi(-halvings / 2), bits).times(2f64.powi(halvings / 2 - halvings))
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
    // The greater end; that it is the greater one is proved with the rest.
    let turned = !seen.curve.folded && at(1.0)?.approx() > at(0.0)?.approx();
    let part = if turned { seen.part.clone().reversed() } else { seen.part.clone() };
    let below = part.below(&part.curvature(&N::of(0.0, bits))?, true);
    matches!(below, Bound::Below).then_some(false)
}
