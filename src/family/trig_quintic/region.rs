//! What is proved of trigonometric quintics over boxes of all five coordinates.
//!
//! END_RISES and PRINTED_RATIO compare linear functions, which rise in the ratio and fall in q or m: two corners decide
//! them for every point of the box, exactly. END_CURVATURE_AS_PRINTED asks whether q lies between two irrational
//! numbers; `plain.rs` has the outermost doubles inside, so a side that holds neither these nor what is between lies
//! outside.
//!
//! SPIRAL asks for END_RISES and for the sign of a polynomial of degree 37 in τ. Its coefficients are forms of second
//! order in the coordinates (`num/form.rs`), by the formulas of `poly.rs`: so Bernstein coefficients that are
//! positive, on [0, 1] or on parts of it, prove it for every point of the box, and so does a value that is negative at
//! some τ refute it. κ'(0) = 0 is divided out. On the surface END_RISES = 0 the last coefficient is 0; a box that it
//! touches is not proved to have SPIRAL, and may be proved to have none.
//!
//! What leaves the closure of the domain is cut off first; on the border itself all formulas hold.

use super::exact::bernstein;
use super::plain::{PRINTED_Q, end_slope, printed_ratio};
use super::poly::{Frame, K, hodograph, numerator};
use super::{END_CURVATURE_AS_PRINTED, END_RISES, PRINTED_RATIO, SPIRAL, TrigQuintic};
use crate::family::region::{Facts, Region, add_pull, clip_side, positive, sides};
use crate::num::bernstein;
use crate::num::{Form, Verdict, formula};
use std::cmp::Ordering::Less;
use std::f64::consts::FRAC_PI_2;

/// A form in the ratio, θ, m, p and q.
type Five = Form<5, 15>;

/// Halvings of [0, 1]: beyond, errors of forms hide what there is, and a thread's stack must hold them.
const HALVINGS: u32 = 20;
/// Places, besides the ends, at which the polynomial is looked at first.
const PLACES: usize = 64;

/// Where each coordinate may be: the closure of the domain.
const CLOSURE: [[f64; 2]; 5] = [[0.0, f64::MAX], [0.0, FRAC_PI_2], [0.0, f64::MAX], [-4.0, 1.0], [-4.0, 1.0]];

/// The coefficients of the numerator; `None` where they are not known.
fn coefficients(sides: &[[f64; 2]; 5]) -> Option<[Five; K]> {
    let [ratio, theta, m, p, q]: [Five; 5] = std::array::from_fn(|i| Five::centred(sides[i], i));
    let frame = Frame::of(&ratio, (theta.sine(), theta.cosine()))?;
    Some(numerator(&hodograph(&frame, &m, &p, &q), &frame.square, -1.0))
}

/// The polynomial where in the middle of the box it is least for its terms, times a positive number.
///
/// It is a form in τ and 1 - τ: a polynomial in `τ/(1 - τ)`, or in the inverse. Any such number is that of some τ, so
/// that roundings do not matter.
fn lowest(c: &[Five; K]) -> Five {
    let term = |back: bool, i: usize| &c[if back { i } else { K - 1 - i }];
    let value = |back: bool, s: f64| {
        let (mut sum, mut size) = (0.0, 0.0);
        for i in 0..K {
            let c = term(back, i).value;
            (sum, size) = (sum * s + c, size * s + c.abs());
        }
        sum / size
    };
    let places = (0..=PLACES).flat_map(|i| [(false, i), (true, i)]).map(|(back, i)| (back, i as f64 / PLACES as f64));
    let least = |a: (f64, bool, f64), b: (f64, bool, f64)| if b.0 < a.0 { b } else { a };
    let start = (f64::INFINITY, false, 0.0);
    let (_, back, s) = places.map(|(back, s)| (value(back, s), back, s)).fold(start, least);
    (1..K).fold(*term(back, 0), |sum, i| formula!(sum * { s } + term(back, i)))
}

impl Region for TrigQuintic {
    fn covers(&self, _: &str) -> bool {
        true
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        low.iter_mut().zip(high).zip(CLOSURE).enumerate().all(|(i, ((low, high), [least, most]))| {
            // The lower ends do not belong to the domain.
            let least = if i < 3 { f64::from_bits(1) } else { least.next_up() };
            clip_side(low, high, least, most)
        })
    }

    fn facts(&self, _: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        let mut facts = Facts::default();
        let Some(mut sides) = sides::<5>(low, high) else { return facts };
        let finite = sides.iter().flatten().all(|x| x.is_finite());
        let inside = |(side, [least, most]): (&mut [f64; 2], [f64; 2])| {
            let [low, high] = side;
            clip_side(low, high, least, most)
        };
        if !finite || !sides.iter_mut().zip(CLOSURE).all(inside) || CLOSURE.iter().zip(&sides).any(beside) {
            return facts;
        }
        let [ratio, _, m, _, q] = sides;
        let [of_ratio, of_m, of_q] = [0, 2, 4].map(|i| Five::centred(sides[i], i));
        let rises = Verdict::proved(end_slope(ratio[0], q[1]) != Less, end_slope(ratio[1], q[0]) == Less);
        if rises.is_open() {
            add_pull(&mut facts.pull, &formula!(9.0 * of_ratio - 20.0 * of_q - 20.0));
        }
        let printed = Verdict::proved(printed_ratio(ratio[0], m[1]), !printed_ratio(ratio[1], m[0]));
        if printed.is_open() && wanted & PRINTED_RATIO != 0 {
            add_pull(&mut facts.pull, &formula!(2.0 * of_ratio - of_m - 6.0));
        }
        let [least, most] = PRINTED_Q;
        let curvature = Verdict::proved(q[0] >= least && q[1] <= most, q[1] < least || q[0] > most);
        if curvature.is_open() && wanted & END_CURVATURE_AS_PRINTED != 0 {
            facts.pull[4] += q[1] - q[0];
        }
        for (flag, known) in [(END_RISES, rises), (PRINTED_RATIO, printed), (END_CURVATURE_AS_PRINTED, curvature)] {
            facts.note(wanted & flag, known);
        }
        if rises.is_no() {
            facts.note(wanted & SPIRAL, rises);
        } else if wanted & SPIRAL != 0
            && let Some(c) = coefficients(&sides)
        {
            let lowest = lowest(&c);
            let known = match positive(&lowest) {
                Verdict::Yes if rises.is_yes() => bernstein::positive(&bernstein(c), 0.0, 0.0, HALVINGS),
                known => known.only_no(),
            };
            facts.note(SPIRAL, known);
            if known.is_open() {
                add_pull(&mut facts.pull, &lowest);
            }
        }
        facts
    }
}

/// Whether a side is a lower end alone, which does not belong to the domain.
fn beside((closure, side): (&[f64; 2], &[f64; 2])) -> bool {
    side[1] <= closure[0]
}
