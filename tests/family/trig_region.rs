//! Verdicts over boxes for trigonometric quintics: no point contradicts its box, and the oracle agrees.

use crate::boxes::Subject;
use crate::oracle::random::Random;
use crate::oracle::trig::judge;
use spiral_atlas::family::Facts;
use spiral_atlas::family::trig_quintic::{END_RISES, SPIRAL, TrigQuintic};
use std::f64::consts::FRAC_PI_2;

const SUBJECT: Subject<5> = Subject { family: &TrigQuintic, chart: 0, draw };

/// Where each coordinate may be, the lower ends excluded.
const DOMAIN: [[f64; 2]; 5] = [[0.0, 1e3], [0.0, FRAC_PI_2], [0.0, 1e3], [-4.0, 1.0], [-4.0, 1.0]];

/// A shape: ratios around where spirals begin, many with κ'(1) = 0, printed conditions at their limits, and angles and
/// parameters next to the ends of the domain.
fn shape(r: &mut Random, round: u64) -> [f64; 5] {
    let (p, m) = (r.uniform(-4.0, 1.0), 10f64.powf(r.uniform(-1.0, 1.0)));
    let q = if round.is_multiple_of(5) { -0.1265 + 0.03 * r.uniform(-1.0, 1.0) } else { r.uniform(-4.0, 1.0) };
    let theta = match round % 6 {
        0 => 10f64.powf(-r.uniform(1.0, 9.0)),
        1 => FRAC_PI_2 - 10f64.powf(-r.uniform(1.0, 9.0)),
        _ => r.uniform(0.01, FRAC_PI_2),
    };
    let ratio = match round % 4 {
        0 => (20.0 / 9.0 * (1.0 + q)).max(0.1),
        1 => 3.0 + 0.5 * m,
        _ => 2.0 * 10f64.powf(r.uniform(0.0, 1.0)),
    };
    match round % 11 {
        0 => [ratio, theta, m, -4.0 + 10f64.powf(-r.uniform(0.0, 9.0)), q],
        1 => [ratio, theta, m, 1.0, 1.0],
        _ => [ratio, theta, m, p, q],
    }
}

/// A box of random size around a shape, often with one side or more without width.
fn draw(r: &mut Random, round: u64) -> [[f64; 2]; 5] {
    let shape = shape(r, round);
    let scale = 10f64.powf(-r.uniform(0.5, 6.0));
    std::array::from_fn(|i| {
        let [least, most] = DOMAIN[i];
        let size = scale * if i < 3 { shape[i] } else { 1.0 };
        let half = if r.below(4) == 0 { 0.0 } else { size * r.uniform(0.1, 1.0) };
        let low = (shape[i] - half * r.uniform(0.0, 1.0)).clamp(least, most);
        [low, (low + half).clamp(least, most)]
    })
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    SUBJECT.attack(1, 2500, 0, 300_000, 100);
}

#[test]
fn the_oracle_confirms_boxes() {
    // Mostly where the polynomial decides.
    let wanted = |facts: &Facts, judged: usize| {
        (facts.inside | facts.outside) & SPIRAL != 0 && (facts.outside & END_RISES == 0 || judged.is_multiple_of(4))
    };
    let judged = SUBJECT.confirm(2, [1000, 1], wanted, |point| {
        let within = point.iter().zip(DOMAIN).all(|(x, [least, _])| *x > least);
        if within { vec![judge(point)] } else { vec![] }
    });
    let spirals = judged.iter().filter(|facts| facts.inside & SPIRAL != 0).count();
    assert!(spirals > 200, "{spirals}");
}

/// Of small boxes few are open.
#[test]
fn small_boxes_are_decided() {
    let (mut r, mut open) = (Random(3), [0; 4]);
    for _ in 0..1000 {
        let low = [r.uniform(2.5, 9.0), r.uniform(0.1, 1.5), r.uniform(0.2, 6.0), r.uniform(-3.0, 0.9), -0.2];
        let facts = SUBJECT.facts(&low.map(|x| [x, x + 1e-3]));
        open.iter_mut().enumerate().for_each(|(bit, open)| *open += 1 - ((facts.inside | facts.outside) >> bit & 1));
    }
    println!("of 1000 small boxes open: {open:?}");
    assert!(open.iter().all(|n| *n < 20), "{open:?}");
}

#[test]
fn nothing_is_said_outside_the_domain() {
    let all = [[6.0, 6.001], [0.7, 0.701], [1.0, 1.001], [0.0, 0.001], [-0.13, -0.129]];
    let outside = [
        (0, [-1.0, 0.0]),
        (0, [6.0, f64::INFINITY]),
        (1, [1.58, 1.6]),
        (1, [f64::NAN, 0.7]),
        (2, [-2.0, -1.0]),
        (3, [-5.0, -4.0]),
        (4, [1.1, 1.2]),
    ];
    SUBJECT.says_nothing_outside(all, 4, &outside);
    // What leaves the domain speaks of the rest.
    let mut sides = all;
    sides[1] = [0.0, 2.0];
    assert_eq!(SUBJECT.facts(&sides).inside & END_RISES, END_RISES);
    let (mut low, mut high) = ([0.0, -1.0, 1.0, -4.0, -9.0], [1.0, 2.0, 2.0, 1.0, 2.0]);
    assert!(SUBJECT.family.region().clip(0, &mut low, &mut high));
    assert!(
        low[0] > 0.0 && low[1] > 0.0 && low[3] > -4.0 && high == [1.0, FRAC_PI_2, 2.0, 1.0, 1.0],
        "{low:?} {high:?}"
    );
}
