//! Verdicts over boxes: no point of a box, and no corner, face or neighbour of one inside it, has another verdict
//! than its box.

use crate::boxes::Subject;
use crate::oracle::random::Random;
use crate::oracle::{in_domain, judge};
use spiral_atlas::family::Facts;
use spiral_atlas::family::cubic::{self, Cubic};

const SUBJECT: Subject<4> = Subject { family: &Cubic, chart: 0, draw };
/// Sides beyond the domain, by the axis, and sides of which an end is no number.
pub(crate) const OUTSIDE: [(usize, [f64; 2]); 5] =
    [(0, [-0.1, 0.6]), (0, [0.0, 0.6]), (1, [0.9, 2.7]), (2, [f64::NAN, 0.2]), (3, [4.0, f64::INFINITY])];
const NORMALISED: Subject<4> = Subject { family: &Cubic, chart: 1, draw: draw_normalised };

/// A box of random size somewhere: ordinary ones, and those that touch or cross where the flags have an end.
pub(crate) fn draw(r: &mut Random, round: u64) -> [[f64; 2]; 4] {
    let scale = 10f64.powf(-r.uniform(0.3, 4.0));
    let mut side = |low: f64, high: f64| {
        let middle = r.uniform(low, high);
        let half = scale * r.uniform(0.2, 1.0) * (high - low);
        [middle - half, middle + half]
    };
    let [phi0, mut phi1, kappa0, log] = [side(0.05, 1.5), side(0.06, 1.55), side(0.01, 1.0), side(-2.3, 4.6)];
    let kappa1 = log.map(f64::exp);
    match round % 8 {
        // Along φ0 = φ1.
        0 => phi1 = phi0.map(|x| x + 0.5 * (phi0[1] - phi0[0])),
        // Beyond π/2, up to φ0 + φ1 = π.
        1 => {
            let top = std::f64::consts::PI - phi0[1];
            phi1 = [top - (phi1[1] - phi1[0]), top.next_down().next_down()];
        }
        2 => return [phi0, phi1.map(|x| x + 0.8), kappa0.map(|x| x - 2.0), kappa1],
        // κ0 = 0.
        3 => return [phi0, phi1, kappa0.map(|x| x - 0.5 * (kappa0[0] + kappa0[1])), kappa1],
        _ => {}
    }
    [phi0, phi1, kappa0, kappa1]
}

/// The same in the chart (a, k), by the middle of the angles; and boxes around the triple root a = k = 1/4.
fn draw_normalised(r: &mut Random, round: u64) -> [[f64; 2]; 4] {
    let [phi0, phi1, kappa0, kappa1] = draw(r, round);
    let [p0, p1] = [phi0, phi1].map(|side| 0.5 * (side[0] + side[1]));
    let (s0, s1, sum) = (p0.sin(), p1.sin(), (p0 + p1).sin());
    let [a, k] = [s1 * s1 / (sum * sum * s0), s0 * s0 / (sum * sum * s1)];
    if round % 8 == 5 {
        let half = 0.25 * (phi0[1] - phi0[0]);
        return [phi0, phi1, [0.25 - half, 0.25], [0.25, 0.25 + half]];
    }
    [phi0, phi1, kappa0.map(|x| x * a), kappa1.map(|x| x * k)]
}

#[test]
fn no_point_of_a_normalised_box_contradicts_it() {
    NORMALISED.attack(5, 3_000, 1, 1_000_000, 5);
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    SUBJECT.attack(1, 13_000, 1, 4_000_000, 40);
}

/// The judge of the tests' own, at random points of a thousand boxes.
#[test]
fn the_oracle_confirms_boxes() {
    let wanted = |facts: &Facts, judged: usize| {
        (facts.inside | facts.outside) & cubic::SPIRAL != 0
            && (facts.outside & cubic::ANY_SPIRAL == 0 || judged.is_multiple_of(4))
    };
    SUBJECT.confirm(2, [1000, 2], wanted, |[phi0, phi1, kappa0, kappa1]| {
        if in_domain(phi0, phi1) { vec![judge(phi0, phi1, kappa0, kappa1).flags] } else { vec![] }
    });
}

#[test]
fn nothing_is_said_outside_the_domain() {
    SUBJECT.says_nothing_outside([[0.7, 0.71], [1.4, 1.41], [0.4, 0.41], [4.0, 4.1]], 5, &OUTSIDE);
}
