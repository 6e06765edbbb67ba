//! Verdicts over boxes for paths of both kinds: no point contradicts its box, and sampled curves agree.

use crate::boxes::Subject;
use crate::oracle::ph_path::{Given, Peak, peaks};
use crate::oracle::random::Random;
use spiral_atlas::family::Facts;
use spiral_atlas::family::ph_path::{Kind, ONE_WAY, PAPER, PEAK_INSIDE, PhPath, REGULAR};
use spiral_atlas::family::verdict;
use std::f64::consts::PI;

const LENGTH: Subject<3> = Subject { family: &PhPath(Kind::EqualLength), chart: 0, draw: length };
const SPEEDS: Subject<4> = Subject { family: &PhPath(Kind::Hermite), chart: 0, draw: speeds };

/// Two angles: any, symmetric in one way or the other, near to these, both near 0, and at the ends of their range.
fn angles(r: &mut Random, round: u64) -> [f64; 2] {
    let first = r.uniform(-PI, PI);
    let tiny = 10f64.powf(-r.uniform(1.0, 10.0));
    match round % 12 {
        0 => [first, first],
        1 => [first, -first],
        2 => [first, first + tiny],
        3 => [first, -first - tiny],
        4 => [tiny * first, tiny * r.uniform(-1.0, 1.0)],
        5 => [0.0, first],
        6 => [PI, first],
        7 => [-PI, PI],
        _ => [first, r.uniform(-PI, PI)],
    }
}

/// A side of random size around a number, within limits, some of no size and some that begin or end there.
fn around(r: &mut Random, x: f64, size: f64, [least, most]: [f64; 2]) -> [f64; 2] {
    let half = size * r.uniform(0.1, 1.0);
    let [before, after] = match r.below(8) {
        0 => [0.0, 0.0],
        1 => [0.0, half],
        2 => [half, 0.0],
        _ => [half * r.uniform(0.0, 1.0), half],
    };
    [(x - before).clamp(least, most), (x + after).clamp(least, most)]
}

fn length(r: &mut Random, round: u64) -> [[f64; 2]; 3] {
    let scale = 10f64.powf(-r.uniform(0.5, 6.0));
    let theta = angles(r, round).map(|theta| around(r, theta, scale, [-PI, PI]));
    let beyond = 10f64.powf(r.uniform(if round.is_multiple_of(7) { -6.0 } else { -2.0 }, 1.0));
    let [first, last] = around(r, beyond, scale * beyond, [1e-6, 1e6]);
    [theta[0], theta[1], [(1.0 + first).max(1.0 + 1e-6), 1.0 + last]]
}

/// Speeds of this ratio at which Z is nearest to 0.
fn meeting([first, last]: [f64; 2], ratio: f64) -> [f64; 2] {
    let [x, y] = [0, 1].map(|part| {
        let of = |angle: f64| if part == 0 { angle.cos() } else { angle.sin() };
        15.0 * of(first) + 15.0 * ratio * of(last) - 10.0 * ratio.sqrt() * of(0.5 * (first + last))
    });
    let size = (120.0 / x.hypot(y)).min(1e3);
    [size, ratio * size]
}

fn speeds(r: &mut Random, round: u64) -> [[f64; 2]; 4] {
    let scale = 10f64.powf(-r.uniform(0.5, 6.0));
    let theta = angles(r, round);
    let wide = if round.is_multiple_of(7) { 6.0 } else { 1.0 };
    let (l0, ratio) = (10f64.powf(r.uniform(-wide, wide)), 10f64.powf(r.uniform(-1.0, 1.0)));
    let size = match round % 5 {
        0 => [l0, l0],
        1 => meeting(theta, if round.is_multiple_of(2) { 1.0 } else { ratio }),
        _ => [l0, l0 * ratio],
    };
    let size = size.map(|l| around(r, l, scale * l, [1e-6, 1e6]));
    let theta = theta.map(|theta| around(r, theta, scale, [-PI, PI]));
    [theta[0], theta[1], size[0], size[1]]
}

#[test]
fn no_point_of_a_box_contradicts_it() {
    for (points, inside, outside) in [LENGTH.attacked(1, 2500, 0), SPEEDS.attacked(2, 700, 0)] {
        assert!(points > 100_000 && inside[0] > 500, "{points} {inside:?}");
        assert!(inside[1..].iter().chain(&outside[1..]).all(|n| *n > 50), "{inside:?} {outside:?}");
    }
}

/// The oracle samples all solutions; where two of them tie, flags may be those of either.
fn confirm<const N: usize>(subject: &Subject<N>, given: fn(&[f64; N]) -> Given, seed: u64) {
    let wanted = |facts: &Facts, _| (facts.inside | facts.outside) & !REGULAR != 0;
    subject.confirm(seed, [500, 1], wanted, |point| {
        // The oracle's samples are even ones, too sparse for what is nearly a line.
        if point[..2].iter().any(|theta| theta.abs() <= 1e-3) || point[2..].iter().any(|l| *l >= 100.0) {
            return vec![];
        }
        let all = peaks([point[0], point[1]], given(&point));
        let least = all.iter().map(|p| p.most).fold(f64::INFINITY, f64::min);
        let flags = |p: &Peak| {
            let set = |holds: bool, bit: u8| if holds { bit } else { 0 };
            REGULAR | set(p.one_way, ONE_WAY) | set(p.at > 0.0 && p.at < 1.0, PEAK_INSIDE) | set(p.paper, PAPER)
        };
        all.iter().filter(|p| p.most <= least * (1.0 + 1e-12)).map(flags).collect()
    });
}

#[test]
fn sampled_curves_of_given_lengths_agree() {
    confirm(&LENGTH, |point| Given::Length(point[2]), 3);
}

#[test]
fn sampled_curves_of_given_speeds_agree() {
    confirm(&SPEEDS, |point| Given::Speeds(point[2], point[3]), 4);
}

/// Of small boxes few are open; what is, mostly has two solutions that bend alike somewhere.
#[test]
fn small_boxes_are_decided() {
    let (mut r, mut open) = (Random(5), [0; 4]);
    for _ in 0..1000 {
        let theta = [0; 2].map(|_| r.uniform(-2.0, 2.0));
        let size = [0; 2].map(|_| 0.3 * 8f64.powf(r.uniform(0.0, 1.0)));
        let facts = SPEEDS.facts(&[theta[0], theta[1], size[0], size[1]].map(|x| [x, x + 1e-3]));
        open.iter_mut().enumerate().for_each(|(bit, open)| *open += 1 - ((facts.inside | facts.outside) >> bit & 1));
    }
    println!("of 1000 small boxes open: {open:?}");
    assert!(open[0] == 0 && open[1..].iter().all(|n| *n < 100), "{open:?}");
}

/// Straight lines, which solve data of two angles 0 alone, and what bends beside them.
#[test]
fn lines_inside_a_box_leave_flags_open() {
    let flat = [-1e-3, 1e-3];
    for size in [[0.8, 1.1], [4.9, 5.1], [15.9, 16.1], [30.0, 31.0]] {
        for theta in [[flat, flat], [flat, [0.0; 2]], [[0.0; 2], [0.0; 2]]] {
            let sides = [theta[0], theta[1], size, [3.99, 4.01]];
            let facts = SPEEDS.facts(&sides);
            let known = facts.inside | facts.outside;
            for place in [[0.0, 0.0], [0.0, 1e-3], [-1e-3, 1e-3]] {
                let inside = |x: f64, side: [f64; 2]| x.clamp(side[0], side[1]);
                let point = [inside(place[0], theta[0]), inside(place[1], theta[1]), size[0], 4.0];
                let flags = verdict(SPEEDS.family, 0, &point).unwrap().flags();
                assert_eq!(flags & known, facts.inside, "{sides:?} {point:?}");
            }
            // A line that moves on is the best, and bends neither way.
            assert!(size[0] > 1.0 || known == REGULAR | PAPER, "{sides:?} {facts:?}");
        }
    }
}

#[test]
fn nothing_is_said_outside_the_domain() {
    let all = [[0.7, 0.701], [1.4, 1.401], [1.1, 1.101], [2.0, 2.001]];
    let outside = [[0.0, f64::NAN], [f64::NAN; 2], [1.0, f64::INFINITY], [-7.0, -6.0], [2e6, 2e6]];
    for which in 0..4 {
        SPEEDS.says_nothing_outside(all, 4, &outside.map(|side| (which, side)));
    }
    let refused = [(0, [1e-11, 1e-10]), (1, [-1e-10, -1e-11]), (2, [0.5, 1.0]), (2, [1e7, 1e8])];
    LENGTH.says_nothing_outside([all[0], all[1], [1.3, 1.301]], 4, &refused);
    // What leaves the domain speaks of the rest.
    let beyond = SPEEDS.facts(&[all[0], all[1], all[2], [9.99e5, 2e6]]);
    assert_eq!(beyond.inside & REGULAR, REGULAR);
    let region = SPEEDS.family.region();
    let (mut low, mut high) = ([1e-11, -1e-11, 0.0, 1.0], [4.0, 1e-11, 1.0, 9e9]);
    assert!(region.clip(0, &mut low, &mut high));
    assert_eq!((low, high), ([1e-9, 0.0, 1e-6, 1.0], [PI, 0.0, 1.0, 1e6]));
}
