//! Where to cut an interval in which solutions merge, so that the certificates of [`super::fork`] hold on each part.
//!
//! A guess, like any knot. D' and D'' have zeros there that Newton's method finds, each step with twice the digits of
//! the last. Around the zero m of D'' the distance is `D0 + D1 h + D3 h³/6`, up to what is small where the solutions
//! are near each other. Divided by D3 that is a cubic without a square; all its zeros are within
//! `2 max(√|6 D1/D3|, ∛|6 D0/D3|)`. Its size is a power of two, and what is left are doubles. So the work does not grow
//! as the solutions come nearer.

use super::curves::Curves;
use super::fork::{Open, side};
use super::knot::Knot;
use crate::num::{Real, formula};
use std::cmp::Ordering::{Equal, Greater, Less};
use std::f64::consts::LN_2;

/// Newton steps at most: two for each doubling of the digits would do.
const MOST_STEPS: usize = 60;

/// A knot with D', D'' and D'''.
struct Bent<N> {
    knot: Knot<N>,
    d: [N; 3],
}

struct March<'c, N, F> {
    curves: &'c Curves<N>,
    knot: F,
}

/// Knots between two, in order; `None` when the precision does not suffice.
///
/// `knot` makes one.
pub(super) fn cuts<N: Real>(
    curves: &Curves<N>,
    knot: impl Fn(N) -> Option<Knot<N>>,
    [from, to]: [&Knot<N>; 2],
    open: Open,
) -> Option<Vec<Knot<N>>> {
    let march = &March { curves, knot };
    let cuts = match open {
        Open::Vague => vec![],
        Open::Fold => zero(march, 1, from, to).into_iter().map(|bent| bent.knot).collect(),
        Open::Fork => fork(march, from, to)?,
    };
    let mut kept: Vec<Knot<N>> = vec![];
    for knot in cuts {
        // Nearer to a double solution than the precision resolves.
        side(&knot.gap)?;
        let last = kept.last().map_or(&from.t, |knot| &knot.t);
        if formula!(knot.t - last).is_positive() && formula!(to.t - knot.t).is_positive() {
            kept.push(knot);
        }
    }
    Some(kept)
}

fn at<N: Real, F: Fn(N) -> Option<Knot<N>>>(march: &March<N, F>, knot: Knot<N>) -> Option<Bent<N>> {
    let [second, third] = march.curves.change(&knot)?;
    Some(Bent { d: [knot.turn(), second, third], knot })
}

/// The zero of the derivative of this order of D, which is monotone, between two knots.
fn zero<N: Real, F: Fn(N) -> Option<Knot<N>>>(
    march: &March<N, F>,
    order: usize,
    from: &Knot<N>,
    to: &Knot<N>,
) -> Option<Bent<N>> {
    let ends = [at(march, from.clone())?, at(march, to.clone())?];
    let [a, b] = ends.each_ref().map(|bent| &bent.d[order - 1]);
    let before = side(a)?;
    (side(b)? != before).then_some(())?;
    let (mut low, mut high) = (from.t.clone(), to.t.clone());
    let enough = N::power_of_two(from.t.bits() as i32 / 4 * 3, from.t.bits());
    let mut t = low.add(&formula!(high - low).mul(&a.over(&formula!(a - b))?)).middle();
    for _ in 0..MOST_STEPS {
        let bent = at(march, (march.knot)(t)?)?;
        let value = &bent.d[order - 1];
        match side(value) {
            None => return Some(bent),
            Some(sign) if sign == before => low = bent.knot.t.clone(),
            Some(_) => high = bent.knot.t.clone(),
        }
        let within = |t: &N| formula!(t - low).is_positive() && formula!(high - t).is_positive();
        let step = value
            .over(&bent.d[order])
            .map(|step| (step.mul(&enough).most(), formula!(bent.knot.t - bent.knot.t * step).middle()));
        t = match step.filter(|(_, t)| within(t)) {
            Some((most, _)) if most < 1.0 => return Some(bent),
            Some((_, next)) => next,
            None => formula!(0.5 * (low + high)).middle(),
        };
    }
    None
}

/// Around the zero of D'': at the sizes of its cubic, at the zeros of D', and between those.
fn fork<N: Real, F: Fn(N) -> Option<Knot<N>>>(
    march: &March<N, F>,
    from: &Knot<N>,
    to: &Knot<N>,
) -> Option<Vec<Knot<N>>> {
    let middle = zero(march, 2, from, to)?;
    let [d1, _, d3] = &middle.d;
    let [p, q] = [d1.over(d3)?.times(6.0), middle.knot.gap.over(d3)?.times(6.0)];
    let slope = side(&p)?;
    let exponent = (ln(&p) / 2.0).max(ln(&q) / 3.0) / LN_2;
    if !(exponent.is_finite() && exponent < 0.0) {
        return Some(vec![]);
    }
    let exponent = exponent.ceil() as i32;
    let bits = p.bits();
    let sized = |x: &N, power: i32| x.mul(&N::power_of_two(-power * exponent, bits)).approx();
    let (p, q) = (sized(&p, 2), sized(&q, 3));
    let size = middle.knot.t.mul(&N::power_of_two(exponent, bits));
    let knot = |h: f64| (march.knot)(formula!(middle.knot.t + size * { h }).middle());
    // Four times its size is around all zeros of the cubic.
    let inside = |knot: &Knot<N>| formula!(knot.t - from.t).is_positive() && formula!(to.t - knot.t).is_positive();
    let [left, right] = [knot(-4.0)?, knot(4.0)?];
    let outer = [if inside(&left) { &left } else { from }, if inside(&right) { &right } else { to }];
    let mut cuts = vec![left.clone()];
    if slope == Greater {
        // D is monotone.
        if q.abs() < 0.125 { cuts.extend([knot(-0.125)?, knot(0.125)?]) } else { cuts.push(middle.knot.clone()) }
    } else {
        // On the side of m to which D falls from it D is convex, or concave on the other, and so what merges
        // there is found.
        let between = 0.25 * (-p / 3.0).sqrt();
        cuts.extend(zero(march, 1, outer[0], &middle.knot).map(|bent| bent.knot));
        cuts.push(knot(if q > 0.0 { between } else { -between })?);
        cuts.extend(zero(march, 1, &middle.knot, outer[1]).map(|bent| bent.knot));
    }
    cuts.push(right.clone());
    Some(cuts)
}

/// The logarithm of the middle's absolute value.
fn ln<N: Real>(x: &N) -> f64 {
    let middle = x.middle();
    match middle.certain_sign(0.0) {
        Some(Greater) => middle.ln(),
        Some(Less) => middle.times(-1.0).ln(),
        Some(Equal) | None => f64::NEG_INFINITY,
    }
}
