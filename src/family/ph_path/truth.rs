//! Verdicts and values of a datum: doubles with error bounds and intervals of growing precision run the same steps.

use super::curves::{Curve, Curves, curves};
use super::datum::{Datum, Turned};
use super::{ONE_WAY, PAPER, PEAK_INSIDE, REGULAR};
use crate::curve::hodograph::{Bound, Complex, Hodograph};
use crate::family::Code;
use crate::num::Real;
use crate::num::Verdict;
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

/// The solutions that bend least.
pub(super) enum Best {
    /// Every solution stands still somewhere.
    None,
    /// A straight line.
    Straight,
    /// One, or several that tie.
    Bent(Vec<Known>),
}

/// Which solution of a datum is meant.
pub(super) struct Known {
    pub paper: bool,
    /// The middle of its pre-image, about.
    pub middle: Complex<f64>,
    /// The other one with this sign of w2 is its mirror image, or none.
    pub alone: bool,
}

impl Known {
    fn new<N: Real>(curve: &Curve<N>, all: &Curves<N>) -> Known {
        let alike = all.bent.iter().filter(|other| other.paper == curve.paper).count();
        let [x, y] = &curve.whole.w[1];
        Known { paper: curve.paper, middle: [x.approx(), y.approx()], alone: alike == 1 }
    }
}

/// A solution with the part that is looked at, from its greater end, and its guessed peak.
pub(super) struct Seen<'c, N> {
    pub curve: &'c Curve<N>,
    pub part: Hodograph<N>,
    pub at: f64,
    pub most: f64,
}

impl<N: Real> Seen<'_, N> {
    /// Whether |κ| certainly exceeds v somewhere: at the guess, or where halving leads.
    fn surpasses(&self, v: &N) -> bool {
        let at = N::of(self.at, v.bits());
        self.part.curvature(&at).is_some_and(|k| exceeds(&k, v)) || matches!(self.part.below(v, 0), Bound::Above(_))
    }
}

/// What is looked at of a curve, the end that bends more first: a peak may be closer to that than doubles resolve
/// parameters from 1. It may bend more by far less than doubles resolve, too.
fn oriented<N: Real>(curve: &Curve<N>) -> Hodograph<N> {
    let part = curve.part();
    let at = |t: f64| part.curvature(&N::of(t, part.turn[0].bits()));
    match (at(0.0), at(1.0)) {
        (Some(first), Some(last)) if !curve.folded && last.sub(&first).approx() > 0.0 => part.reversed(),
        _ => part,
    }
}

pub(super) fn seen<N: Real>(curve: &Curve<N>) -> Seen<'_, N> {
    let part = oriented(curve);
    let (at, most) = part.guess();
    Seen { curve, part, at, most }
}

pub(super) fn exceeds<N: Real>(value: &N, limit: &N) -> bool {
    value.sub(limit).certain_sign(0.0) == Some(Greater)
}

/// The solutions among which the best is: all others are proved to bend more than the first. None where all stand
/// still.
fn contenders<N: Real>(curves: &Curves<N>, paper: bool, bits: usize) -> Option<Vec<Seen<'_, N>>> {
    let mut all: Vec<_> = curves.bent.iter().filter(|c| c.paper || !paper).map(seen).collect();
    // Each round begins with a peak that the last one found to have been missed.
    for _ in 0..16 {
        all.sort_by(|a, b| a.most.total_cmp(&b.most));
        let Some(first) = all.first() else { return Some(all) };
        // Guesses cannot tell these apart.
        let close = all.partition_point(|seen| seen.most <= first.most * (1.0 + 1e-9));
        let next = all.get(close).map_or(f64::INFINITY, |seen| seen.most);
        let limit = (first.most * next.min(4.0 * first.most)).sqrt();
        limit.is_finite().then_some(())?;
        let bound = N::of(limit, bits);
        match first.part.below(&bound, 0) {
            Bound::Below => {
                let rest = all.split_off(close);
                return rest.iter().all(|seen| seen.surpasses(&bound)).then_some(all);
            }
            Bound::Above(at) => {
                let (at, most) = first.part.climbed(at);
                // Where doubles do not see the peak, it is above the limit all the same.
                (all[0].at, all[0].most) = (at, if most > limit { most } else { 2.0 * limit });
            }
            Bound::Open => return None,
        }
    }
    None
}

/// The least greatest |κ| of all solutions, or of the paper's; `None` where the precision does not suffice.
///
/// A curve that stands still in a bend has values beyond every bound. The least of enclosed numbers needs no winner:
/// where two enclosures overlap, their union holds it.
pub(super) fn least<N: Turned>(datum: &Datum, paper: bool, bits: usize) -> Option<Greatest<N>> {
    let curves = curves::<N>(datum, bits)?;
    if curves.straight {
        return Some(Greatest::Value(N::of(0.0, bits)));
    }
    let values =
        contenders(&curves, paper, bits)?.iter().map(|seen| greatest(seen, bits)).collect::<Option<Vec<_>>>()?;
    let lesser = |a: N, b: N| match a.sub(&b).certain_sign(0.0) {
        Some(Greater) => b,
        Some(Less) => a,
        _ => a.union(&b),
    };
    Some(values.into_iter().reduce(lesser).map_or(Greatest::None, Greatest::Value))
}

/// The greatest |κ|. Half the digits are tried above the value at the peak, since the curvature is level there.
fn greatest<N: Real>(seen: &Seen<'_, N>, bits: usize) -> Option<N> {
    let halvings = if bits <= 53 { 36 } else { (bits / 2).min(1200) as i32 };
    let margin = N::of(2f64.powi(-halvings / 2), bits).times(2f64.powi(halvings / 2 - halvings));
    seen.part.greatest(seen.at, &margin)
}

/// The greatest |κ| of each wanted solution that bends, mirror images left out; `None` where the precision does not
/// suffice.
pub(super) fn greatest_of<N: Turned>(
    datum: &Datum,
    bits: usize,
    wanted: impl Fn(&Known) -> bool,
) -> Option<Vec<(Known, Option<N>)>> {
    let curves = curves::<N>(datum, bits)?;
    let known = curves.bent.iter().map(|curve| (Known::new(curve, &curves), curve));
    Some(known.filter(|(known, _)| wanted(known)).map(|(known, curve)| (known, greatest(&seen(curve), bits))).collect())
}

/// The solutions that bend least; `None` where the precision does not suffice.
pub(super) fn best<N: Turned>(datum: &Datum, bits: usize) -> Option<Best> {
    let curves = curves::<N>(datum, bits)?;
    if curves.straight {
        return Some(Best::Straight);
    }
    let best = winners(contenders(&curves, false, bits)?, datum, bits)?;
    let known = |seen: &Seen<N>| Known::new(seen.curve, &curves);
    Some(if best.is_empty() { Best::None } else { Best::Bent(best.iter().map(known).collect()) })
}

/// The flags; `None` where the precision does not suffice.
pub(super) fn verdict<N: Turned>(datum: &Datum, bits: usize) -> Option<Code> {
    let curves = curves::<N>(datum, bits)?;
    if curves.straight {
        return Some(Code::new(REGULAR | ONE_WAY | PAPER, 0));
    }
    let close = contenders(&curves, false, bits)?;
    if close.is_empty() {
        return Some(Code::new(0, 0));
    }
    let best = winners(close, datum, bits)?;
    let flag = |holds: bool, bit: u8| if holds { bit } else { 0 };
    let ways = best.iter().map(|seen| one_way(&seen.curve.whole).decided()).collect::<Option<Vec<_>>>()?;
    let inside = flag(peak_inside(&best[0]).decided()?, PEAK_INSIDE);
    let paper = flag(best[0].curve.paper, PAPER);
    Some(Code::new(REGULAR | flag(ways.contains(&true), ONE_WAY) | inside | paper, 0))
}

/// The contenders that bend least: one, or two that tie.
///
/// With `θ1 = θ0` both ends of w are parallel, so that both signs of √Z give the same |κ| at each end. If that is the
/// greatest for both, they tie, whatever the precision. No other tie is known but mirror images, of which one is left
/// out.
fn winners<'c, N: Real>(mut close: Vec<Seen<'c, N>>, datum: &Datum, bits: usize) -> Option<Vec<Seen<'c, N>>> {
    let [first, others @ ..] = &close[..] else { return Some(close) };
    if others.is_empty() {
        return Some(close);
    }
    let alike = datum.theta[0] == datum.theta[1] && others.len() == 1 && others[0].curve.paper == first.curve.paper;
    if alike && close.iter().all(|seen| peak_inside(seen).is_no()) {
        return Some(close);
    }
    let values = close.iter().map(|seen| greatest(seen, bits)).collect::<Option<Vec<_>>>()?;
    let wins = |i: &usize| (0..close.len()).all(|j| j == *i || exceeds(&values[j], &values[*i]));
    (0..close.len()).find(wins).map(|i| vec![close.swap_remove(i)])
}

/// Whether h keeps its sign. Where no end's sign is certain, nothing is: h may have that of its middle all along.
pub(super) fn one_way<N: Real>(curve: &Hodograph<N>) -> Verdict {
    let turn = &curve.turn;
    let depth = if turn[0].bits() <= 53 { 20 } else { 100 };
    let mut ends = [0, 2].iter().filter_map(|i| turn[*i].certain_sign(0.0));
    match ends.find(|sign| sign.is_ne()) {
        Some(Greater) => positive(turn, 0.0, 0.0, depth),
        Some(_) => positive(&turn.clone().map(|h| h.times(-1.0)), 0.0, 0.0, depth),
        None => Verdict::Undecided,
    }
}

/// Whether |κ| is greatest strictly inside, and greater there than at both ends.
pub(super) fn peak_inside<N: Real>(seen: &Seen<'_, N>) -> Verdict {
    if seen.curve.tied {
        return Verdict::No;
    }
    above_ends(seen).into()
}

fn above_ends<N: Real>(seen: &Seen<'_, N>) -> Option<bool> {
    let part = &seen.part;
    let at = |t: f64| part.curvature(&N::of(t, part.turn[0].bits()));
    // The end of half a curve is no end.
    let ends: &[f64] = if seen.curve.folded { &[0.0] } else { &[0.0, 1.0] };
    let over_both = |t: f64| {
        let peak = at(t)?;
        Some(ends.iter().all(|end| at(*end).is_some_and(|k| exceeds(&peak, &k))))
    };
    if !ends.contains(&seen.at) && over_both(seen.at)? {
        return Some(true);
    }
    // That the start is the greater end is proved with the rest.
    match part.below(&at(0.0)?, if seen.curve.flat { 2 } else { 1 }) {
        Bound::Below => Some(false),
        Bound::Above(t) => (over_both(part.climbed(t).0)? || over_both(t)?).then_some(true),
        Bound::Open => None,
    }
}
