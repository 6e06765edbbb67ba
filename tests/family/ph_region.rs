//! Verdicts over boxes for PH quintics with G² Hermite ends: no point contradicts its box, and the oracle agrees.

use crate::boxes::Subject;
use crate::cubic_region::{self, OUTSIDE};
use crate::oracle::in_domain;
use crate::oracle::ph::judge;
use crate::oracle::random::Random;
use spiral_atlas::family::Facts;
use spiral_atlas::family::ph_quintic::{ANY_SPIRAL, Datum, PhQuintic, SOLVABLE, SPIRAL, solve};

const SUBJECT: Subject<4> = Subject { family: &PhQuintic, chart: 0, draw };

/// Anywhere in the box of the cubic's cells.
fn anywhere(r: &mut Random) -> [f64; 4] {
    [r.uniform(0.05, 1.5), r.uniform(0.06, 1.55), r.uniform(0.01, 1.0), 10f64.powf(r.uniform(-1.0, 2.0))]
}

/// The cubic's boxes, and as many of random size around data that have a spiral.
fn draw(r: &mut Random, round: u64) -> [[f64; 2]; 4] {
    if round.is_multiple_of(2) {
        return cubic_region::draw(r, round / 2);
    }
    loop {
        let [phi0, phi1, kappa0, kappa1] = anywhere(r);
        if solve(&Datum { phi0, phi1, kappa0, kappa1 }).unwrap().flags() & SPIRAL != 0 {
            let scale = 10f64.powf(-r.uniform(1.5, 4.0));
            return [phi0, phi1, kappa0, kappa1].map(|x| [x * (1.0 - scale * r.uniform(0.0, 1.0)), x * (1.0 + scale)]);
        }
    }
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    SUBJECT.attack(1, 480, 0, 100_000, 10);
}

#[test]
fn the_oracle_confirms_boxes() {
    // Mostly where some spiral exists, so that the curves themselves decide.
    let wanted = |facts: &Facts, judged: usize| {
        (facts.inside | facts.outside) & SPIRAL != 0 && (facts.outside & ANY_SPIRAL == 0 || judged.is_multiple_of(4))
    };
    let judged = SUBJECT.confirm(2, [1000, 1], wanted, |point| {
        if in_domain(point[0], point[1]) { vec![judge(point).flags] } else { vec![] }
    });
    let spirals = judged.iter().filter(|facts| facts.inside & SPIRAL != 0).count();
    assert!(spirals > 100, "{spirals}");
}

/// Of small boxes where some spiral exists none is open; whole cells of a grid of 64 an axis are often decided.
#[test]
fn small_boxes_are_decided() {
    let (mut r, mut open, mut coarse) = (Random(4), 0, 0);
    let mut counted = 0;
    while counted < 600 {
        let point = anywhere(&mut r);
        let wide = [1.45 / 64.0, 1.49 / 64.0, 0.99 / 64.0, point[3] * 0.11];
        let side = |share: f64| std::array::from_fn(|i| [point[i], point[i] + share * wide[i]]);
        let facts = SUBJECT.facts(&side(0.01));
        if facts.inside & ANY_SPIRAL == 0 {
            continue;
        }
        counted += 1;
        let left = |facts: Facts| (facts.inside | facts.outside) & (SPIRAL | SOLVABLE) != SPIRAL | SOLVABLE;
        open += u32::from(left(facts));
        coarse += u32::from(left(SUBJECT.facts(&side(1.0))));
    }
    println!("of {counted} small boxes {open} are open, of as many cells of 1/64 {coarse}");
    assert!(open == 0 && coarse < 250, "{open} {coarse}");
}

#[test]
fn nothing_is_said_outside_the_domain() {
    let all = [[0.7, 0.7001], [1.4, 1.4001], [0.4, 0.4001], [4.0, 4.001]];
    SUBJECT.says_nothing_outside(all, 3, &OUTSIDE);
    // A negative curvature leaves no solution.
    assert_eq!(SUBJECT.facts(&[all[0], all[1], [-0.2, -0.1], all[3]]).outside & (SOLVABLE | SPIRAL), SOLVABLE | SPIRAL);
}
