//! The outer bound, ANY_SPIRAL of `cubic` and `ph-quintic`, over a box.
//!
//! The flag is `φ0 < φ1`, `u = sin φ0 - κ0 > 0`, `v = κ1 - sin φ1 > 0` and `f = u v - sin²((φ1-φ0)/2) > 0`
//! (`outer.rs`). There φ0 < π/2.
//!
//! **Corners.** Where κ0 >= 0 or φ1 <= π/2, and φ0 < φ1 all over the box, the flag rises with φ0 and κ1 and falls
//! with φ1 and κ0. On the way, where the flag holds, `∂f/∂κ1 = u > 0`, `∂f/∂κ0 = -v < 0`, `∂f/∂φ0 = v cos φ0 +
//! sin(φ1-φ0)/2 > 0` and `∂f/∂φ1 = -u cos φ1 - sin(φ1-φ0)/2`. The last is negative for φ1 <= π/2. Beyond, κ0 >= 0
//! gives `u <= sin φ0`, and it is at most `(sin φ0 |cos φ1| - sin φ1 cos φ0) / 2 = -sin(φ0+φ1)/2 < 0`. So f only
//! grows on the way from a point where the flag holds to the corner of greatest φ0, κ1 and least φ1, κ0, moving κ1,
//! κ0, φ1, φ0 in turn (u grows or stays, and f > 0 with u > 0 keeps v > 0). Hence the flag holds all over the box
//! when it holds at the opposite corner, and nowhere when it does not hold at this one. For κ0 < 0 and φ1 > π/2 this
//! is not so.
//!
//! **Forms.** Where the curvatures depend on the angles, or the domain is larger, u, v and f are forms of second order
//! in the four coordinates (`num/form.rs`), whose signs are proofs for every real point of the box.
//!
//! **Factors.** Always, u, v and the square lie between the values that their own coordinates allow.

use super::hermite::holds_box;
use super::region::{Facts, MOST_SIDES, add_pull, positive, sides};
use crate::num::sines::{SIN_ERROR, sin};
use crate::num::{Ball, Certain, Form, Number, Verdict, formula};
use std::cmp::Ordering::{Greater, Less};
use std::f64::consts::{FRAC_PI_2, PI};

fn sine(x: f64) -> Ball {
    Ball::near(sin(x), SIN_ERROR)
}

/// Holds and fails: what is certain of `u v > sin²(δ/2)`, where `delta` is a bound of `δ >= 0`, from below or above.
///
/// The rounding of δ is one unit of it. A sine changes by no larger share than its angle, since `x cot x <= 1` up to
/// π/2; so two units more are enough for it.
fn compare(u: &Ball, v: &Ball, delta: f64) -> (bool, bool) {
    let half = Ball::near(sin(0.5 * delta.max(0.0)), SIN_ERROR + 2.0);
    let over = formula!(u * v - half * half);
    let sign = |x: &Ball| x.certain_sign(0.0);
    let [u_positive, v_positive] = [u, v].map(|x| sign(x) == Some(Greater));
    let negative = sign(u) == Some(Less) || sign(v) == Some(Less);
    let below = (u_positive || v_positive) && sign(&over) == Some(Less);
    (u_positive && v_positive && sign(&over) == Some(Greater), negative || below)
}

/// The least and the greatest sine of a range within (0, π).
fn sines([low, high]: [f64; 2]) -> [Ball; 2] {
    let [first, last] = [low, high].map(sine);
    // The double next to π/2 lies below it.
    let over = low <= FRAC_PI_2 && high >= FRAC_PI_2;
    let least = if first.value < last.value { first } else { last };
    let greatest = if over {
        Ball { value: 1.0, error: 0.0 }
    } else if first.value < last.value {
        last
    } else {
        first
    };
    // Both may be the extreme one where they are equal to a rounding.
    let error = first.error + last.error;
    [Ball { error: least.error + 2.0 * error, ..least }, Ball { error: greatest.error + 2.0 * error, ..greatest }]
}

/// Whether the flag holds at no datum of the domain in a box that may reach beyond `φ0 + φ1 = π`.
///
/// Where it holds, φ0 < π/2. So larger ones are left out. The way of the corners (above) then needs `φ0 + φ1 < π` only
/// while φ1 falls, and there it stays so.
fn fails_within_domain([phi0, phi1, kappa0, kappa1]: &[[f64; 2]; 4]) -> bool {
    let angles = phi0[0] > 0.0 && phi1[0] > 0.0 && phi1[1] <= PI;
    let most = phi0[1].min(FRAC_PI_2.next_up());
    let finite = [kappa0, kappa1].into_iter().flatten().all(|x| x.is_finite());
    angles && finite && (phi0[0] > most || any(&[[phi0[0], most], *phi1, *kappa0, *kappa1]).0.is_no())
}

/// [`super::Region::facts`] of a family with the domain of [`super::hermite`]: what `prove` says of a box in it, and of
/// other boxes that the flags `none` hold nowhere, where no spiral of any kind fits.
pub(super) fn facts(low: &[f64], high: &[f64], none: u8, prove: impl FnOnce(&[[f64; 2]; 4]) -> Facts) -> Facts {
    let mut facts = Facts::default();
    match sides(low, high) {
        Some(sides) if holds_box(&sides) => return prove(&sides),
        Some(sides) if fails_within_domain(&sides) => facts.note(none, Verdict::No),
        _ => {}
    }
    facts
}

/// Whether the flag holds all over a box of the domain, or nowhere; and how much each coordinate moves f, about.
pub(super) fn any(box_: &[[f64; 2]; 4]) -> (Verdict, [f64; MOST_SIDES]) {
    let [phi0, phi1, kappa0, kappa1] = *box_;
    if phi0[0] >= phi1[1] {
        return (Verdict::No, [0.0; MOST_SIDES]);
    }
    let exact = |value| Ball { value, error: 0.0 };
    let below = phi0[1] < phi1[0];
    let corner = |p0: f64, p1: f64, k0: f64, k1: f64| compare(&sine(p0).plus(-k0), &exact(k1).sub(&sine(p1)), p1 - p0);
    if below && (kappa0[0] >= 0.0 || phi1[1] <= FRAC_PI_2) {
        if corner(phi0[0], phi1[1], kappa0[1], kappa1[0]).0 {
            return (Verdict::Yes, [0.0; MOST_SIDES]);
        }
        if corner(phi0[1], phi1[0], kappa0[0], kappa1[1]).1 {
            return (Verdict::No, [0.0; MOST_SIDES]);
        }
    }
    let ([s0, s0_most], [s1, s1_most]) = (sines([phi0[0], phi0[1].min(FRAC_PI_2.max(phi0[0]))]), sines(phi1));
    let (u, u_most) = (s0.plus(-kappa0[1]), s0_most.plus(-kappa0[0]));
    let (v, v_most) = (exact(kappa1[0]).sub(&s1_most), exact(kappa1[1]).sub(&s1));
    if below && compare(&u, &v, phi1[1] - phi0[0]).0 {
        return (Verdict::Yes, [0.0; MOST_SIDES]);
    }
    if compare(&u_most, &v_most, phi1[0] - phi0[1]).1 {
        return (Verdict::No, [0.0; MOST_SIDES]);
    }
    let (u, v) = (u_most.value.max(0.0), v_most.value.max(0.0));
    let width = |side: [f64; 2]| side[1] - side[0];
    (Verdict::Undecided, [width(phi0) * v, width(phi1) * u, width(kappa0) * v, width(kappa1) * u, 0.0])
}

/// Whether a spiral of rising curvature exists, wherever `φ0 < φ1`, for forms of φ0, φ1, κ0, κ1.
pub(super) fn rising([phi0, phi1, kappa0, kappa1]: &[Form<4, 10>; 4], pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let (u, v) = (phi0.sine().sub(kappa0), kappa1.sub(&phi1.sine()));
    // Halving is exact but for what underflows, which the forms' errors cover.
    let half = phi1.times(0.5).sine_of_sum(&phi0.times(-0.5));
    let f = formula!(u * v - half * half);
    let known = Verdict::all([positive(&u), positive(&v), positive(&f)]);
    if known.is_open() {
        [u, v, f].iter().filter(|form| positive(form).is_open()).for_each(|form| add_pull(pull, form));
    }
    known
}
