//! Verdicts over boxes for the reachable end points of both curves: no point contradicts its box, and the oracle
//! agrees.

use crate::boxes::Subject;
use crate::oracle::random::Random;
use crate::oracle::reach::judge;
use spiral_atlas::family::Facts;
use spiral_atlas::family::reach::{Kind, Reach};
use std::f64::consts::{FRAC_PI_2, PI};

const CUBIC: Subject<3> =
    Subject { family: &Reach(Kind::Cubic), chart: 0, draw: |r, round| draw(Kind::Cubic, r, round) };
const PH: Subject<3> = Subject { family: &Reach(Kind::Ph), chart: 0, draw: |r, round| draw(Kind::Ph, r, round) };

/// The end point (ξ, η) of a segment of a case (0 or 1) by its shape; u over where c0 is 0.
fn end(kind: Kind, case: u64, theta: f64, m: f64, over: f64) -> [f64; 2] {
    let (s, c) = theta.sin_cos();
    let (a, b) = match kind {
        Kind::Cubic => {
            let u = over * 3.0 * c / (4.0 + m);
            (s * s / (3.0 * u), (1.0 + m) * s * s / (6.0 * u * u))
        }
        Kind::Ph => {
            let (u, g, l2) = (over * 2.0 / (6.0 + m), 0.5 + 0.5 * c, (0.5 * theta).tan().powi(2));
            let sides = 2.0 * (3.0 + m) * u + 2.0 + 3.0 * m + 3.0 * m * m;
            ((3.0 + m + 24.0 * g * u) * l2 / (60.0 * u * u), sides * l2 / (120.0 * u.powi(3)))
        }
    };
    let (eta, h) = if case == 0 { (a, b) } else { (b, a) };
    [(h + eta * c) / s, eta]
}

/// A box of random size: around end points of segments of all levels, at the ends of the angle's range, around η = 0,
/// and of no size.
fn draw(kind: Kind, r: &mut Random, round: u64) -> [[f64; 2]; 3] {
    let most = if kind == Kind::Cubic { FRAC_PI_2 } else { PI };
    let scale = 10f64.powf(-r.uniform(0.5, 5.0));
    let theta = match round % 6 {
        0 => r.uniform(1e-4, 0.05),
        1 => most - r.uniform(1e-4, 0.05),
        _ => r.uniform(0.05, most - 0.05),
    };
    let (m, over) = (10f64.powf(r.uniform(-1.5, 0.7)), r.uniform(0.2, 1.4));
    let [xi, eta] = end(kind, round % 2, theta, m, over);
    let mut around = |x: f64, size: f64| {
        let half = scale * size.abs() * r.uniform(0.2, 1.0);
        [x - half * r.uniform(0.0, 1.0), x + half * r.uniform(0.0, 1.0)]
    };
    let [low, high] = around(theta, theta.min(most - theta).min(0.5));
    let theta = [low, high.min(most)];
    match round % 12 {
        2 => [theta, around(xi, xi), around(0.0, eta)],
        3 => [theta, around(xi, 3.0 * xi), around(eta, 3.0 * eta)],
        4 => [theta, around(xi, xi), around(eta, eta)].map(|side| [side[0]; 2]),
        7 => [[most - (high - low), most], around(xi, xi), around(eta, eta)],
        _ => [theta, around(xi, xi), around(eta, eta)],
    }
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    CUBIC.attack(1, 12_000, 1, 1_000_000, 100);
    PH.attack(2, 12_000, 1, 1_000_000, 100);
}

#[test]
fn the_oracle_confirms_boxes() {
    for (subject, kind) in [(CUBIC, Kind::Cubic), (PH, Kind::Ph)] {
        let wanted = |facts: &Facts, _| (facts.inside | facts.outside) & 0x22 != 0 && facts.inside != 0;
        subject.confirm(3, [1000, 1], wanted, |point| {
            let verdict = judge(kind, point[0], point[1], point[2]);
            vec![verdict[0].map_or(0, |s| s.flags) | verdict[1].map_or(0, |s| s.flags) << 4]
        });
    }
}

/// Small boxes around segments are nearly all decided in every flag.
#[test]
fn small_boxes_are_decided() {
    for (subject, kind) in [(CUBIC, Kind::Cubic), (PH, Kind::Ph)] {
        let (mut r, mut open) = (Random(4), 0);
        for round in 0..2000 {
            let theta = r.uniform(0.1, 1.4);
            let [xi, eta] = end(kind, round % 2, theta, 10f64.powf(r.uniform(-1.0, 0.7)), r.uniform(0.3, 1.3));
            let facts = subject.facts(&[theta, xi, eta].map(|x| [x, x * 1.0001]));
            open += u32::from((facts.inside | facts.outside) != u8::MAX);
        }
        println!("{kind:?}: {open} of 2000 are open");
        assert!((1..100).contains(&open), "{kind:?}: {open}");
    }
}

#[test]
fn nothing_is_said_outside_the_domain() {
    let all = [[0.7, 0.7], end(Kind::Cubic, 0, 0.7, 1.0, 0.8), [0.0; 2]];
    let all = [all[0], [all[1][0]; 2], [all[1][1]; 2]];
    assert_eq!(CUBIC.facts(&all).inside & 0xf, 0xf);
    for (which, side) in
        [(0, [0.0, 0.7]), (0, [0.7, 1.6]), (0, [f64::NAN; 2]), (1, [1.0, f64::INFINITY]), (2, [f64::NAN, 1.0])]
    {
        let mut sides = all;
        sides[which] = side;
        let facts = CUBIC.facts(&sides);
        assert_eq!((facts.inside, facts.outside), (0, 0), "{side:?}");
    }
}
