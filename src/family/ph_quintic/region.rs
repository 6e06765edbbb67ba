//! What is proved of PH quintics over boxes of (φ0, φ1, κ0, κ1).
//!
//! The march of [`super::march`] runs on forms of second order in the four coordinates (`num/form.rs`) as it does on
//! other numbers. A sign that is certain there is that of every datum of the box. So each of its certificates holds
//! for all of them, and where it ends it has counted the solutions of each datum, between knots that all share. Only
//! the heights of the curves need more than for plain numbers: Newton's method in forms, whose steps each add an
//! order, makes the guess, and the residual bounds what it is off, as for any number ([`Curves`]).
//!
//! **One solution.** Between two knots D changes its sign once, for every datum. A form T, made by Newton's method in
//! the same way, and a number e: where D has the sign of the first knot at T - e and the other at T + e, the first
//! before the last knot and the other behind the first one, the solution's t is within e of T at each place of the box:
//! a datum whose T - e lies before the first knot has its solution behind both. Its Z is then the height at T ± e.
//!
//! **Knots** are where halving leads. Where some data have a solution just there, no sign is certain; another place is
//! taken ([`March::brackets`]).
//!
//! **SPIRAL** holds where ANY_SPIRAL does and the quintic of some solution is positive; it fails where that of every
//! solution is negative somewhere. For neither need solutions be counted, and where they merge or where an end's speed
//! vanishes they cannot. So intervals of t are looked at one by one ([`survey`]), within what `dismiss.rs` leaves.
//! An interval has no spiral where the curves do not meet in it, where plain bounds dismiss it, or where the quintic is
//! negative somewhere for all of its t and Z ([`between`]): t is a number between its ends, and Z, which falls along
//! each curve, lies between the heights of a curve there. It has one where the quintic is positive for all of them and
//! D has different certain signs at its ends; or where the one solution, enclosed as above, has a positive quintic.
//! Other intervals are cut.
//!
//! ANY_SPIRAL is `family/outer_region.rs`. No solution has a negative curvature, and nothing is said of a box that a
//! curvature of 0 cuts. Where two solutions merge inside the box, the march does not end, and SOLVABLE stays open.
//! Where numbers are too large or small for `dismiss.rs`, the march's solutions decide SPIRAL.

use super::curves::Curves;
use super::dismiss::{Ends, spirals_within};
use super::knot::Knot;
use super::march::meets;
use super::march::{March, Root};
use super::shape::CurveShape;
use super::{ANY_SPIRAL, PhQuintic, SOLVABLE, SPIRAL};
use super::{fork, narrow};
use crate::family::hermite::clip;
use crate::family::outer_region::{any, facts};
use crate::family::region::{Facts, MOST_SIDES, Region, add_pull, positive, unit_sign};
use crate::num::{Certain, Form, Number, Real, Verdict, formula};

/// A form in φ0, φ1, κ0, κ1.
type Four = Form<4, 10>;

/// The equations over a box; `None` where it comes too near to the end of the domain.
fn curves([phi0, phi1, kappa0, kappa1]: &[[f64; 2]; 4]) -> Option<Curves<Four>> {
    let (first, second) = (Four::centred(*phi0, 0), Four::centred(*phi1, 1));
    let (half0, half1) = (first.times(0.5), second.times(0.5));
    let ((s0, c0), (s1, c1)) = ((half0.sine(), half0.cosine()), (half1.sine(), half1.cosine()));
    let (sin, cos) = (half0.sine_of_sum(&half1), formula!(c0 * c1 - s0 * s1));
    positive(&cos).is_yes().then_some(())?;
    let inverse = sin.inverse()?;
    let over = |x: &Four, k: f64| formula!(x * inverse * { k });
    let bend = [over(&Four::centred(*kappa0, 2), 0.25), over(&Four::centred(*kappa1, 3), 0.25)];
    let right = [over(&first.sine(), 30.0), over(&second.sine(), 30.0)];
    Some(Curves::bent(bend, cos, right, over(&formula!(s1 * c0 - s0 * c1), 30.0)))
}

/// The one solution between two knots.
fn root(march: &March<Four>, a: &Knot<Four>, b: &Knot<Four>) -> Option<Root<Four>> {
    let side = a.gap.certain_sign(0.0)?;
    let moved = |t: &Four| {
        let knot = march.knot(*t)?;
        Some(t.mul(&knot.gap.over(&formula!(knot.s[1] - knot.s[0]))?))
    };
    let mut t = Four::of(march.guess(a, b), 53);
    for _ in 0..Four::ORDERS {
        t = t.sub(&moved(&t)?).guess();
    }
    // As near as its own error lets the signs be told, which tell whether that is enough.
    let mut reach = 1.05 * moved(&t)?.most() + 1e-15 * t.value;
    let sign = |t: Four| march.knot(t)?.gap.certain_sign(0.0);
    for _ in 0..6 {
        let (left, right) = (t.plus(-reach), t.plus(reach));
        if !(left.is_positive() && formula!(b.t - left).is_positive() && formula!(right - a.t).is_positive()) {
            return None;
        }
        if sign(left) == Some(side) && sign(right) == Some(side.reverse()) {
            let t = t.off(reach);
            return Some(Root { t, z: march.knot(t)?.z[0] });
        }
        reach *= 1.5;
    }
    None
}

/// Whether the curvature of a solution rises all along, over the box.
fn rises(march: &March<Four>, a: &Knot<Four>, b: &Knot<Four>, pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let found = root(march, a, b).and_then(|root| Some((CurveShape::new(&march.curves, &root)?.quintic(), root)));
    let Some((quintic, root)) = found else { return Verdict::Undecided };
    let known = unit_sign(&quintic);
    if known.is_open() {
        quintic
            .iter()
            .filter(|form| positive(form).is_open())
            .chain([&root.t, &root.z])
            .for_each(|form| add_pull(pull, form));
    }
    known
}

/// Looks at intervals of t for one box.
const MOST_LOOKS: usize = 64;
/// Ratios of places that are not cut any more.
const NEAREST: f64 = 1.02;
/// Ratios of places between which the quintic is looked at.
const NEAR: f64 = 1.4;

/// Whether some solution of each datum is a spiral, or none of any.
fn survey(march: &March<Four>, (ends, [first, last]): &(Ends, [f64; 2]), pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let knot = |t: f64| march.knot(Four::of(t, 53));
    let (Some(mut a), Some(last)) = (knot(*first), knot(*last)) else { return Verdict::Undecided };
    let mut waiting = vec![last];
    let mut known = Verdict::No;
    for _ in 0..MOST_LOOKS {
        let Some(b) = waiting.last() else { return known };
        let here = look(march, ends, &a, b, pull);
        if here.is_yes() {
            return here;
        }
        if here.is_open() && b.t.value >= a.t.value * NEAREST {
            let Some(middle) = cut(march, &a, b) else { break };
            waiting.push(middle);
            continue;
        }
        if here.is_open() {
            known = here;
        }
        let Some(next) = waiting.pop() else { break };
        a = next;
    }
    Verdict::Undecided
}

/// [`survey`] between two knots.
fn look(march: &March<Four>, ends: &Ends, a: &Knot<Four>, b: &Knot<Four>, pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let meets = meets(a, b).decided().or_else(|| narrow::meets(&march.curves, a, b).decided());
    match meets.or_else(|| fork::meets(&march.curves, a, b).ok()) {
        Some(false) => Verdict::No,
        None if ends.fails(a.t.value, b.t.value) => Verdict::No,
        None => between(march, a, b),
        Some(true) => match rises(march, a, b, pull) {
            Verdict::Undecided => between(march, a, b),
            known => known,
        },
    }
}

/// A knot between two. Where both curves cross it is one on a certain side of them, if there is one; so what is left is
/// a bracket.
fn cut(march: &March<Four>, a: &Knot<Four>, b: &Knot<Four>) -> Option<Knot<Four>> {
    let middle = march.knot(Four::of((a.t.value * b.t.value).sqrt(), 53))?;
    let [first, inner, last] = [a, &middle, b].map(|knot| knot.gap.certain_sign(0.0));
    let bracket = first.is_some() && last.is_some() && first != last;
    let aside = if bracket && inner.is_none() { march.aside(a, b) } else { None };
    Some(aside.unwrap_or(middle))
}

/// Whether all curves between two knots rise, and one of them is a solution; or none rises.
fn between(march: &March<Four>, a: &Knot<Four>, b: &Knot<Four>) -> Verdict {
    if b.t.value > a.t.value * NEAR {
        return Verdict::Undecided;
    }
    let middle = |a: &Four, b: &Four| formula!(0.5 * (a + b)).off(0.5001 * a.sub(b).most());
    let curve = usize::from(a.z[1].value - b.z[1].value < a.z[0].value - b.z[0].value);
    let root = Root { t: middle(&b.t, &a.t), z: middle(&a.z[curve], &b.z[curve]) };
    let Some(shape) = CurveShape::new(&march.curves, &root) else { return Verdict::Undecided };
    let rises = unit_sign(&shape.quintic());
    let sides = [a, b].map(|knot| knot.gap.certain_sign(0.0));
    let crossed = sides[0].is_some() && sides[1].is_some() && sides[0] != sides[1];
    if crossed { rises } else { rises.only_no() }
}

fn prove(sides: &[[f64; 2]; 4], wanted: u8) -> Facts {
    let mut facts = Facts::default();
    let (any, pull) = any(sides);
    facts.note(wanted & ANY_SPIRAL, any);
    if any.is_no() {
        facts.note(wanted & SPIRAL, any);
    }
    let [_, _, kappa0, kappa1] = sides;
    if kappa0[1] < 0.0 || kappa1[1] < 0.0 {
        facts.note(wanted & (SOLVABLE | SPIRAL), Verdict::No);
    }
    if any.is_open() && wanted & ANY_SPIRAL != 0 {
        facts.pull = pull;
    }
    let open = wanted & (SOLVABLE | SPIRAL) & !facts.outside;
    if open == 0 {
        return facts;
    }
    // Where nothing better is known: what is widest for its size.
    let widths = sides.map(|[low, high]| (high - low) / (low.abs() + high.abs()).max(f64::MIN_POSITIVE));
    let Some(march) = curves(sides).filter(|_| kappa0[0] >= 0.0 && kappa1[0] >= 0.0).map(March::new) else {
        facts.pull[..4].copy_from_slice(&widths);
        return facts;
    };
    let within = if open & SPIRAL == 0 { None } else { spirals_within(&march.curves) };
    let counted = open & SOLVABLE != 0 || within.is_none();
    let brackets = if counted { march.brackets() } else { None };
    if let Some(found) = &brackets {
        facts.note(open & SOLVABLE, Verdict::of(!found.is_empty()));
    }
    if open & SPIRAL != 0 {
        let spiral = match (&within, &brackets) {
            (Some(within), _) => survey(&march, within, &mut facts.pull),
            (None, Some(found)) => {
                found.iter().fold(Verdict::No, |known, (a, b)| known.or(rises(&march, a, b, &mut facts.pull)))
            }
            (None, None) => Verdict::Undecided,
        };
        facts.note(SPIRAL, any.and(spiral));
    }
    if facts.pull == [0.0; MOST_SIDES] {
        facts.pull[..4].copy_from_slice(&widths);
    }
    facts
}

impl Region for PhQuintic {
    fn covers(&self, _: &str) -> bool {
        true
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        clip(low, high)
    }

    fn facts(&self, _: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        facts(low, high, wanted & (ANY_SPIRAL | SPIRAL), |sides| prove(sides, wanted))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    /// Of boxes a hundredth of a window wide 2809 in 3000 are decided; where solutions had to be counted it were 2720.
    #[test]
    fn most_boxes_are_decided() {
        let mut noise = Noise(7);
        let mut share = || 0.5 + 0.5 * noise.signed();
        let width = 0.01;
        let mut decided = 0;
        for _ in 0..3000 {
            let mut side = |low: f64, high: f64| {
                let start = low + (high - low) * share();
                [start, start + width * (high - low)]
            };
            let angles = [side(0.2, 1.2), side(0.3, 1.6), side(0.1, 1.0)];
            let last = 0.8 * 25f64.powf(share());
            let [phi0, phi1, kappa0] = angles;
            let facts = prove(&[phi0, phi1, kappa0, [last, last * (1.0 + width)]], SPIRAL);
            decided += usize::from((facts.inside | facts.outside) & SPIRAL != 0);
        }
        assert!(decided >= 2800, "{decided}");
    }
}
