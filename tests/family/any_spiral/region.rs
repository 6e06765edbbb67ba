//! Verdicts over boxes in both charts: no point contradicts its box, and the judge of the tests' own agrees.

use super::judge::judge;
use crate::boxes::Subject;
use crate::oracle::random::Random;
use spiral_atlas::family::Facts;
use spiral_atlas::family::any_spiral::AnySpiral;
use std::f64::consts::PI;

const CHORD: Subject<4> = Subject { family: &AnySpiral, chart: 0, draw };
const CURVATURE: Subject<4> = Subject { family: &AnySpiral, chart: 1, draw };

/// A box of random size: anywhere, along ω = 0, at an angle of ±π, around curvatures of 0, and of no size.
fn draw(r: &mut Random, round: u64) -> [[f64; 2]; 4] {
    let scale = 10f64.powf(-r.uniform(0.3, 5.0));
    let mut side = |low: f64, high: f64| {
        let middle = r.uniform(low, high);
        let half = scale * r.uniform(0.2, 1.0) * (high - low);
        [middle - half, middle + half]
    };
    let clip = |side: [f64; 2]| side.map(|x| x.clamp(-PI, PI));
    let [first, beta] = [side(-3.1, 3.1), side(-3.1, 3.1)].map(clip);
    let [k1, k2] = [side(-2.0, 2.0), side(-3.0, 3.0)];
    match round % 8 {
        0 => [first, clip([-first[1], -first[0]].map(|x| x + first[1] - first[0])), k1, k2],
        1 => [[PI - (first[1] - first[0]), PI], beta, k1, k2],
        2 => [first, [-PI, -PI + (beta[1] - beta[0])], k1.map(|k| 100.0 * k), k2],
        3 => [first, beta, k1.map(|k| k - 0.5 * (k1[0] + k1[1])), k2],
        4 => [first, beta, k1, [0.0, k2[1] - k2[0]]],
        5 => [first, beta, k1, k2].map(|side| [side[0]; 2]),
        6 => [first.map(|x| 1e-7 * x), beta.map(|x| 1e-7 * x), k1.map(|k| 1e-7 * k), k2.map(|k| 1e-7 * k)],
        _ => [first, beta, k1, k2],
    }
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    CHORD.attack(1, 5_000, 1, 1_500_000, 200);
    CURVATURE.attack(2, 5_000, 1, 1_500_000, 200);
}

#[test]
fn the_oracle_confirms_boxes() {
    // Those of which all is known, and mostly those where a spiral exists.
    let mut round = 0;
    let wanted = |facts: &Facts, _| {
        round += 1;
        facts.inside | facts.outside == 0b111 && (facts.inside & 1 != 0 || round % 8 == 0)
    };
    CHORD.confirm(3, [1000, 2], wanted, |point| vec![judge(point)]);
}

/// Small boxes are nearly all decided, and boxes of the other chart are those of the mirrored first angle.
#[test]
fn small_boxes_are_decided_alike_in_both_charts() {
    let (mut r, mut open) = (Random(4), 0);
    for _ in 0..4000 {
        let [a, b, k1, k2] = [3.0, 3.0, 2.0, 2.0].map(|most| r.uniform(-most, most)).map(|x| [x, x + 1e-4]);
        let facts = CHORD.facts(&[a, b, k1, k2]);
        let other = CURVATURE.facts(&[[-a[1], -a[0]], b, k1, k2]);
        assert_eq!((facts.inside, facts.outside), (other.inside, other.outside));
        open += u32::from(facts.inside | facts.outside != 0b111);
    }
    assert!((1..40).contains(&open), "{open}");
}

#[test]
fn nothing_is_said_outside_the_domain() {
    let all = [[-0.7, -0.69], [1.4, 1.41], [0.4, 0.41], [4.0, 4.1]];
    assert_eq!(CHORD.facts(&all).inside, 0b011);
    for (which, side) in
        [(0, [-3.2, -0.6]), (1, [1.0, 3.2]), (1, [f64::NAN, 1.0]), (2, [f64::NAN, 0.2]), (3, [4.0, f64::INFINITY])]
    {
        let mut sides = all;
        sides[which] = side;
        let facts = CHORD.facts(&sides);
        assert_eq!((facts.inside, facts.outside), (0, 0), "{side:?}");
    }
}
