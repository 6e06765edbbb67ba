//! What is proved of paths over boxes of their data.
//!
//! The formulas of `curves.rs` run on forms of second order in the coordinates (`num/form.rs`), so each of the four
//! curves, and all that is asked of it, holds what belongs to every datum of the box. A sign that is certain there is
//! that of each datum.
//!
//! **Roots of Z.** At each datum the curves with +√Z and -√Z are its two solutions, whichever of both roots that is.
//! Where the root is enclosed, it is the one with a positive real part, or the one with a positive imaginary part, for
//! all data: the part is the root of a number that is certainly positive, and the other follows from it without a
//! root. Where the box comes near to Z = 0 there is no such part; then numbers hold both roots, and either curve both
//! solutions. Of given lengths `u² = p0 (a + r)/w`, `v² = q0 (r - a)/w` and `uv = gz` with `r² = a² + 4g²p0q0` and `z =
//! 2p0q0/w` belong together whatever the sign of a is (`a = over` or `-over` in `curves.rs`), so that choice is free,
//! too.
//!
//! **The one that bends least.** Let A bend least in the middle of the box, as doubles see it. Another curve B is left
//! out where `|κ_A| < v` all along A, for `v = |κ_B(t)|` at some t, a form, too: at no datum does B bend least. v is
//! larger than 0, so it says nothing of a straight line B. Or |κ_B| exceeds a number somewhere for all data, as where
//! B comes near to standing still (`needle` in `bound.rs`), and |κ_A| does not. A is regular wherever it is below
//! something: `|κ| < v` is proved as `v σ² ± h > 0`, and where σ = 0, h is 0. At each datum the solution that
//! bends least is one of those left: so a flag is known where it is for all of them, together with REGULAR. Of
//! solutions that tie all are left, so it does not matter which one the flags speak of. Mirror images, of which a datum
//! has one left out, agree in all flags.
//!
//! **The flags.** PAPER is the sign of w2. ONE_WAY is the sign of h. PEAK_INSIDE holds where |κ| at some t inside
//! exceeds both ends; it fails where |κ| is nowhere above the start's, if that exceeds the end's, or where it is not
//! in the first half and not above the end's in the second half: that proves both at once where ends tie inside the
//! box.
//!
//! **Straight lines.** With both angles 0 inside the box one of the curves may be a straight line, with h = 0. No sign
//! of it is certain. So where it could bend least it is left, and neither ONE_WAY nor PEAK_INSIDE is known; PAPER is,
//! only if all others that are left are the paper's, like every line that is regular.
//!
//! **REGULAR is never OUTSIDE.** Nobody proves that all solutions stand still, because that is hardly ever so in a box.
//! Let w vanish at t. With the angles, the ratio of the end speeds and t given, w is known up to a factor s > 0: from
//! `w(x) = (x - t)(u0 (1 - x) + u1 x)` with `u0 = -w0/t` and `u1 = w2/(1 - t)`. So `∫ w² = s² C`, where C is rational
//! in t, and `∫ w² = 1` asks that C be positive, which leaves one s. If `Im C` is not 0 for all t, it is 0 at finitely
//! many t only, so a curve stands still for finitely many s. `C = A w0² + B w0 w2 + D w2²` with `A = ∫ (1 - x)² (x -
//! t)²/t²`, `D = ∫ x² (x - t)²/(1 - t)²` and `B = -2 ∫ x (1 - x) (x - t)²/(t (1 - t)) < 0`. As t goes to 0, `t² C`
//! goes to `w0²/30`, and as t goes to 1, `(1 - t)² C` goes to `w2²/30`. So where Im C is always 0, w0², w2² and then
//! `w0 w2` are real: both angles are 0, or both are half turns. For half turns w0 and w2 are imaginary, and -C is a
//! quadratic form with `B² <= 4AD` (Cauchy and Schwarz), so `C <= 0`, and there is no such curve. Hence a box in which
//! both speeds vary has data all of whose solutions are regular, unless both angles are fixed at 0. Of a given length
//! the ratio of the speeds is 1. So at given angles, finitely many curves stand still, with finitely many lengths; with
//! both angles 0 they are lines of length 1, which is no datum. Hence a box in which S varies has such data, too.
//!
//! With both angles fixed at 0 all solutions may be lines that stand still, as with `l0 = 6.76` and `l1 = 0.01` and
//! around. Such boxes are left open.
//!
//! A box is first cut to the family's domain. Angles next to 0, which are refused, may be inside: they are like any
//! others here.

use super::bound::needle;
use super::curves::{Curve, boxed};
use super::datum::{LEAST, LEAST_ANGLE, MOST};
use super::truth::{Seen, exceeds, one_way, peak_inside, seen};
use super::{Kind, ONE_WAY, PAPER, PEAK_INSIDE, PhPath, REGULAR};
use crate::curve::hodograph::Bound;
use crate::family::region::{Facts, MOST_SIDES, Region, add_pull, clip_side};
use crate::num::{Form, Number, Real, Verdict};
use std::f64::consts::PI;

/// More than a curve bends in the middle of the box by so much that it may well stay below all over the box; for what
/// is nearly a line, one radian along the chord. What bends more than that is of no use.
fn beyond(most: f64) -> f64 {
    (4.0 * most).max(1.0)
}

/// Whether |κ| of a curve stays below v.
fn below<const K: usize, const H: usize>(seen: &Seen<'_, Form<K, H>>, v: &Form<K, H>) -> bool {
    matches!(seen.part.below(v, 0), Bound::Below)
}

/// |κ| at a peak in the middle of the box.
fn peak<const K: usize, const H: usize>(seen: &Seen<'_, Form<K, H>>) -> Option<Form<K, H>> {
    seen.part.curvature(&Form::of(seen.at, 53))
}

/// [`peak_inside`], also where either end may bend more.
fn inside<const K: usize, const H: usize>(seen: &Seen<'_, Form<K, H>>, pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let ends = [0.0, 1.0].map(|t| seen.part.curvature(&Form::of(t, 53)));
    let [Some(first), Some(last)] = &ends else {
        seen.part.turn.iter().for_each(|h| add_pull(pull, h));
        return Verdict::Undecided;
    };
    let known = if exceeds(first, last) {
        peak_inside(seen)
    } else {
        let over = peak(seen).filter(|_| seen.at > 0.0 && seen.at < 1.0);
        let over = over.is_some_and(|peak| exceeds(&peak, first) && exceeds(&peak, last));
        let [start, end] = seen.part.halves();
        let falls = || {
            [start, end.reversed()].iter().zip([first, last]).all(|(half, v)| matches!(half.below(v, 1), Bound::Below))
        };
        Verdict::proved(over, !over && falls())
    };
    if known.is_open() {
        add_pull(pull, &first.sub(last));
        if let Some(peak) = peak(seen) {
            add_pull(pull, &first.sub(&peak));
        }
    }
    known
}

/// The curves among which the one that bends least is, and whether that is regular.
fn contenders<'c, const K: usize, const H: usize>(
    curves: &'c [Curve<Form<K, H>>],
    pull: &mut [f64; MOST_SIDES],
) -> (Vec<Seen<'c, Form<K, H>>>, bool) {
    let mut all: Vec<_> = curves.iter().map(seen).collect();
    all.sort_by(|a, b| a.most.total_cmp(&b.most));
    let mut others = all.into_iter();
    let Some(first) = others.next().filter(|first| first.most.is_finite()) else { return (Vec::new(), false) };
    let mut left = Vec::with_capacity(4);
    let mut regular = false;
    for other in others {
        let limit = peak(&other);
        let needle = || needle(&other.part, beyond(first.most)).min(beyond(first.most));
        if limit.as_ref().is_some_and(|limit| below(&first, limit)) || below(&first, &Form::of(needle(), 53)) {
            regular = true;
            continue;
        }
        if let (Some(mine), Some(limit)) = (peak(&first), limit) {
            add_pull(pull, &limit.sub(&mine));
        }
        left.push(other);
    }
    let regular = regular || below(&first, &Form::of(beyond(first.most), 53));
    left.insert(0, first);
    (left, regular)
}

fn prove<const K: usize, const H: usize>(kind: Kind, low: &[f64], high: &[f64], wanted: u8) -> Facts {
    let mut facts = Facts::default();
    let side = |i: usize| Form::<K, H>::centred([low[i], high[i]], i);
    let half = [0, 1].map(|i| side(i).times(0.5)).map(|half| [half.cosine(), half.sine()]);
    let pull = &mut facts.pull;
    if let Some(curves) = boxed(kind, half, [side(2), side(K - 1)]) {
        let (left, regular) = contenders(&curves, pull);
        let known = |flag: u8, of: &mut dyn FnMut(&Seen<'_, Form<K, H>>) -> Verdict| {
            if wanted & flag == 0 {
                return Verdict::Undecided;
            }
            let mut each = left.iter().map(of);
            let first = each.next().unwrap_or(Verdict::Undecided);
            // The next is asked only where the flag may still be known.
            if !first.is_open() && each.all(|other| other == first) { first } else { Verdict::Undecided }
        };
        let regular = Verdict::proved(regular, false);
        let paper = known(PAPER, &mut |seen| Verdict::of(seen.curve.paper));
        let ways = known(ONE_WAY, &mut |seen| {
            let known = one_way(&seen.curve.whole);
            if known.is_open() {
                seen.curve.whole.turn.iter().for_each(|h| add_pull(pull, h));
            }
            known
        });
        let inside = known(PEAK_INSIDE, &mut |seen| inside(seen, pull));
        facts.note(wanted & REGULAR, regular);
        for (flag, known) in [(PAPER, paper), (ONE_WAY, ways), (PEAK_INSIDE, inside)] {
            facts.note(wanted & flag, regular.and(known));
        }
    }
    facts
}

impl Region for PhPath {
    fn covers(&self, _: &str) -> bool {
        true
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        let least = if self.0 == Kind::EqualLength { 1.0 + LEAST } else { LEAST };
        low.iter_mut().zip(high).enumerate().all(|(i, (low, high))| match i {
            0 | 1 => {
                (*low, *high) = (angle(*low, f64::max), angle(*high, f64::min));
                clip_side(low, high, -PI, PI)
            }
            _ => clip_side(low, high, least, MOST),
        })
    }

    fn facts(&self, _: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        let count = self.0.axes().len();
        let box_of_numbers = [low, high].iter().all(|end| end.len() == count && end.iter().all(|x| x.is_finite()));
        let (mut low, mut high) = (low.to_vec(), high.to_vec());
        match self.0 {
            _ if !box_of_numbers || !self.clip(0, &mut low, &mut high) => Facts::default(),
            Kind::EqualLength => prove::<3, 6>(self.0, &low, &high, wanted),
            Kind::Hermite => prove::<4, 10>(self.0, &low, &high, wanted),
        }
    }
}

/// An end of a side of angles, moved inwards out of the refused ones beside 0.
fn angle(end: f64, inwards: fn(f64, f64) -> f64) -> f64 {
    let refused = end != 0.0 && end.abs() < LEAST_ANGLE;
    if refused { inwards(0.0, LEAST_ANGLE.copysign(end)) } else { end }
}
