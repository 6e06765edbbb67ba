//! The least greatest curvature of paths: published figures, an oracle that samples, symmetric and extreme data.

use crate::oracle::data::Random;
use crate::oracle::ph_path::{Given, Peak, peaks};
use serde_json::Value;
use spiral_atlas::family::ph_path::{Kind, ONE_WAY, PAPER, PEAK_INSIDE, PhPath, REGULAR};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::PI;

const LENGTH: PhPath = PhPath(Kind::EqualLength);
const SPEEDS: PhPath = PhPath(Kind::Hermite);

/// Everything an atlas would store of one node, after all steps have been found to agree.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    flags: u8,
    scalars: [f32; 2],
    /// Doubles decided the flags.
    quick: bool,
}

fn node(family: PhPath, datum: &[f64]) -> Node {
    let axis = |(name, x): (&&str, &f64)| Axis::new(name, Spacing::Values(vec![*x])).unwrap();
    let grid = Grid::new(family.about().charts[0].axes.iter().zip(datum).map(axis).collect()).unwrap();
    let table = family.table(&grid).unwrap_or_else(|e| panic!("{datum:?}: {e}"));
    let mut code = [Code::UNDECIDED];
    table.filter(0, &mut code);
    let (exact, _) = table.exact(0).unwrap_or_else(|e| panic!("{datum:?}: {e}"));
    assert!(code[0] == Code::UNDECIDED || code[0] == exact, "{datum:?}");
    let (mut quick, mut slow) = ([0.0; 2], [0.0; 2]);
    table.scalars(0, exact, &[0, 1], &mut quick).unwrap_or_else(|e| panic!("{datum:?}: {e}"));
    table.exact_scalars(0, exact, &[0, 1], &mut slow).unwrap_or_else(|e| panic!("{datum:?}: {e}"));
    assert_eq!(quick.map(f32::to_bits), slow.map(f32::to_bits), "{datum:?}");
    Node { flags: exact.flags(), scalars: quick, quick: code[0] != Code::UNDECIDED }
}

fn given(family: PhPath, datum: &[f64]) -> Given {
    if family.0 == Kind::EqualLength { Given::Length(datum[2]) } else { Given::Speeds(datum[2], datum[3]) }
}

/// What is wrong with a node, by the oracle; where two solutions nearly tie, either may be meant.
fn faults(found: &Node, all: &[Peak]) -> Vec<String> {
    let least = |paper: bool| all.iter().filter(|p| p.paper || !paper).map(|p| p.most).fold(f64::INFINITY, f64::min);
    let mut faults = vec![];
    for (which, paper) in [(0, false), (1, true)] {
        let want = least(paper);
        // The nearest single, or one of the two where 1e-13 decides.
        let near = [want * (1.0 - 1e-13), want * (1.0 + 1e-13)].map(|x| x as f32);
        if !near.contains(&found.scalars[which]) {
            faults.push(format!("scalar {which} is {:?}, must be {want:?}", found.scalars[which]));
        }
    }
    let flags = |p: &Peak| {
        let set = |holds: bool, bit: u8| if holds { bit } else { 0 };
        REGULAR | set(p.one_way, ONE_WAY) | set(p.at > 0.0 && p.at < 1.0, PEAK_INSIDE) | set(p.paper, PAPER)
    };
    let best = all.iter().filter(|p| p.most <= least(false) * (1.0 + 1e-12));
    let wanted: Vec<u8> = best.map(flags).collect();
    if !wanted.contains(&found.flags) {
        faults.push(format!("flags are {:#06b}, must be one of {wanted:?}", found.flags));
    }
    faults
}

fn check(family: PhPath, datum: &[f64]) -> Node {
    let found = node(family, datum);
    let all = peaks([datum[0], datum[1]], given(family, datum));
    let faults = faults(&found, &all);
    assert!(faults.is_empty(), "{} {datum:?}: {faults:?}\n{all:?}", family.about().name);
    found
}

fn angle(random: &mut Random, i: u64) -> f64 {
    match i % 3 {
        0 => random.uniform(-PI, PI),
        1 => random.uniform(-0.8, 0.8),
        _ => random.decades(-6.0, 0.0) * if random.below(2) == 0 { 1.0 } else { -1.0 },
    }
}

/// A second angle: free, or equal, opposite, or nearly so.
fn other(random: &mut Random, first: f64, i: u64) -> f64 {
    let tiny = random.decades(-16.0, -3.0);
    let near = match i % 8 {
        0 => first,
        1 => -first,
        2 => first + tiny,
        3 => -first - tiny,
        4 => 0.0,
        _ => return angle(random, i / 8),
    };
    if near.abs() < 1e-9 { 0.0 } else { near.clamp(-PI, PI) }
}

/// Checks so many data: most are decided by doubles, and some have each flag, but not all.
fn check_many(family: PhPath, seed: u64, count: u64, draw: fn(&mut Random, u64) -> Vec<f64>) {
    let mut random = Random(seed);
    let (mut kinds, mut quick) = ([0; 4], 0);
    for i in 0..count {
        let found = check(family, &draw(&mut random, i));
        quick += u64::from(found.quick);
        for (bit, kind) in kinds.iter_mut().enumerate() {
            *kind += u32::from(found.flags >> bit & 1);
        }
    }
    println!("{kinds:?} {quick}");
    assert!(
        kinds[1..].iter().all(|k| *k > 5 && u64::from(*k) < count - 5) && quick * 10 > count * 7,
        "{kinds:?} {quick}"
    );
}

#[test]
fn lengths_agree_with_sampling() {
    check_many(LENGTH, 7, 32, |random, i| {
        let first = angle(random, i);
        let length = 1.0 + random.decades(if i % 5 == 0 { -5.9 } else { -2.0 }, 1.0);
        vec![first, other(random, first, i), length]
    });
}

#[test]
fn speeds_agree_with_sampling() {
    check_many(SPEEDS, 11, 48, |random, i| {
        let first = angle(random, i);
        let wide = if i % 5 == 0 { 5.0 } else { 1.0 };
        let l0 = random.decades(-wide, wide);
        let l1 = if i % 8 < 4 { l0 } else { random.decades(-wide, wide) };
        vec![first, other(random, first, i), l0, l1]
    });
}

/// Both ends of such curves bend alike to the last bit of doubles, and beyond.
#[test]
fn neighbours_of_symmetric_data_are_decided() {
    let mut random = Random(5);
    let step = |x: f64, i: u64| match i % 5 {
        0 => x,
        1 => x.next_up(),
        2 => x.next_down(),
        3 => x * (1.0 + 1e-15),
        _ => x * (1.0 - 1e-14),
    };
    let mut slow = 0;
    for i in 0..120 {
        let first = random.uniform(-3.1, 3.1);
        let second = step(if i % 2 == 0 { first } else { -first }, i / 2);
        let size = random.decades(-1.0, 0.7);
        let other = step(size, i / 10);
        slow += u32::from(!node(LENGTH, &[first, second, 1.0 + size]).quick);
        slow += u32::from(!node(SPEEDS, &[first, second, size, other]).quick);
    }
    // Two doubles decide all of these.
    assert_eq!(slow, 0);
    // Directions within rounding of straight back: the peak is next to an end, nearer than doubles tell parameters from
    // 1.
    for (l0, l1) in [(4.0, 1.0), (2.0, 0.5), (1.0, 4.0), (0.25, 1.0), (4.000000000000001, 1.0)] {
        for theta in [PI, -PI] {
            slow += u32::from(!node(SPEEDS, &[theta, theta, l0, l1]).quick);
        }
    }
    // Two doubles leave some of these to intervals.
    assert!(slow > 0, "{slow}");
    // Along the chord, where the curvature's slope at an end is exactly 0.
    for (l0, l1) in [(4.0, 16.0), (16.0, 4.0), (3.0, 12.0), (40.0, 10.0), (4.0, 16.000000000000004)] {
        check(SPEEDS, &[0.0, 0.0, l0, l1]);
    }
    // From whole degrees by steps of ninety 37ths.
    node(LENGTH, &[1.3962634015954634, -1.3962634015954636, 1.05]);
}

#[test]
fn the_comparison_can_fail() {
    let datum = [0.4, 0.9, 1.3];
    let (found, all) = (node(LENGTH, &datum), peaks([0.4, 0.9], Given::Length(1.3)));
    assert!(faults(&found, &all).is_empty());
    let [one, two] = found.scalars;
    let spoilt = [
        Node { scalars: [f32::from_bits(one.to_bits() + 1), two], ..found },
        Node { scalars: [one, f32::from_bits(two.to_bits() - 1)], ..found },
        Node { flags: found.flags ^ PEAK_INSIDE, ..found },
        Node { flags: found.flags ^ ONE_WAY, ..found },
        Node { flags: found.flags ^ PAPER, ..found },
    ];
    for node in spoilt {
        assert_eq!(faults(&node, &all).len(), 1, "{node:?}");
    }
}

fn published(key: &str) -> Value {
    let all: Value = serde_json::from_str(include_str!("../fixtures/ph_paths.json")).unwrap();
    all[key].clone()
}

/// Figures 5 to 8: all of them are those of the paper's two solutions, and all but the last also the least of four.
#[test]
fn figures_are_reproduced() {
    let figures = published("figures");
    let number = |v: &Value| v.as_f64().unwrap_or_else(|| v.as_str().unwrap().parse().unwrap());
    let mut compared = 0;
    for row in figures["fig5_6"].as_array().unwrap() {
        let (length, k, t) = (number(&row[0]), number(&row[1]), number(&row[2]));
        let found = node(LENGTH, &[PI / 3.0, -0.75 * PI, length]);
        assert_eq!(found.scalars, [k as f32; 2], "S = {length}");
        assert_eq!(found.flags & PEAK_INSIDE != 0, t < 1.0);
        compared += 1;
    }
    for row in figures["fig7_8"].as_array().unwrap() {
        let (size, k, t) = (number(&row[0]), number(&row[1]), number(&row[2]));
        let found = node(SPEEDS, &[PI / 6.0, PI / 4.0, size, size]);
        assert_eq!(found.scalars[1], k as f32, "l = {size}");
        assert_eq!(found.scalars[0], if size == 4.0 { 9.900_135 } else { k as f32 });
        assert_eq!(found.flags & PAPER != 0, size != 4.0);
        assert!(found.flags & PAPER == 0 || (found.flags & PEAK_INSIDE != 0) == (t < 1.0));
        compared += 1;
    }
    assert_eq!(compared, 13);
    // The maximum leaves the end at S = 1.21500, and is least at l = 1.41325888.
    let inside = |length| node(LENGTH, &[PI / 3.0, -0.75 * PI, length]).flags & PEAK_INSIDE != 0;
    assert!(!inside(1.21499) && inside(1.21501));
    let (least, at) = (number(&figures["fig8_min"]["kmax"]), number(&figures["fig8_min"]["l"]));
    let kappa = |size: f64| node(SPEEDS, &[PI / 6.0, PI / 4.0, size, size]).scalars[0];
    assert_eq!(kappa(at), least as f32);
    assert!(kappa(at - 0.01) > kappa(at) && kappa(at + 0.01) > kappa(at));
}

/// The largest curvature of the paper's better path, of 44 published ones; it has least rotation, so another may bend
/// less.
#[test]
fn published_paths_bend_no_less() {
    let (mut equal, mut less) = (0, 0);
    for row in
        ["equal_arc", "equal_arc_special"].iter().flat_map(|key| published(key)["rows"].as_array().unwrap().clone())
    {
        let x = |v: &Value| v.as_f64().unwrap();
        let chord = [0, 1].map(|i| x(&row[1][i]) - x(&row[0][i]));
        let (size, along) = (chord[0].hypot(chord[1]), chord[1].atan2(chord[0]));
        let theta = |v: &Value| (x(v) - along + 3.0 * PI).rem_euclid(2.0 * PI) - PI;
        let datum = [theta(&row[2]), theta(&row[3]), x(&row[4]) / size];
        let (found, published) = (node(LENGTH, &datum), x(&row[7]) * size);
        let off = f64::from(found.scalars[1]) / published - 1.0;
        assert!(off < 1e-6, "{row}");
        if off.abs() < 1e-6 { equal += 1 } else { less += 1 }
    }
    println!("{equal} {less}");
    assert!(equal > 35 && equal + less == 44);
}

/// Straight ahead: on a line, back and forth, and in loops.
#[test]
fn both_angles_zero() {
    let found = node(SPEEDS, &[0.0, 0.0, 1.0, 1.0]);
    assert_eq!(found, Node { flags: REGULAR | ONE_WAY | PAPER, scalars: [0.0; 2], quick: true });
    // At l0 = l1 = 5 the line stops for a moment; loops with w2 < 0 are left.
    let stops = node(SPEEDS, &[0.0, 0.0, 5.0, 5.0]);
    assert!(
        stops.scalars[0] > 1.0 && stops.scalars[1] == NO_VALUE && stops.flags & (REGULAR | PAPER) == REGULAR,
        "{stops:?}"
    );
    assert_eq!(node(SPEEDS, &[0.0, 0.0, 5f64.next_down(), 5.0]).scalars, [0.0; 2]);
    // Nothing but lines that turn back.
    assert_eq!(node(SPEEDS, &[0.0, 0.0, 6.0, 0.001]), Node { flags: 0, scalars: [NO_VALUE; 2], quick: true });
    for datum in [[6.5, 6.5], [7.0, 6.0], [6.0, 6.0], [0.01, 9.0]] {
        node(SPEEDS, &[0.0, 0.0, datum[0], datum[1]]);
    }
    check(SPEEDS, &[0.0, 0.0, 9.0, 7.5]);
    check(SPEEDS, &[0.0, 0.0, 7.5, 7.5]);
    check(LENGTH, &[0.0, 0.0, 1.5]);
}

/// Corners of the domain, and symmetric data beside them, are decided.
#[test]
fn extremes_are_decided() {
    let angles = [0.0, 1e-9, 2.0, PI];
    let lengths = [1.000001, 1.5, 1e6];
    let sizes = [1e-6, 1.0, 5.0, 1e6];
    let mut count = 0;
    for first in angles {
        for last in angles.into_iter().flat_map(|x| [x, -x]) {
            for length in lengths {
                node(LENGTH, &[first, last, length]);
                count += 1;
            }
            for l0 in sizes {
                for l1 in [l0, 1.0] {
                    node(SPEEDS, &[first, last, l0, l1]);
                    count += 1;
                }
            }
        }
    }
    println!("{count}");
}

#[test]
fn what_lies_outside_is_named() {
    let says = |family: PhPath, datum: &[f64], parts: &[&str]| {
        let error = family.answer(0, datum).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    says(LENGTH, &[0.3, 0.4, 1.0], &["S is 1;", "above 1"]);
    says(LENGTH, &[0.3, 0.4, 0.5], &["S is 0.5"]);
    says(SPEEDS, &[1e-10, 0.4, 0.5, 1.0], &["theta0 is 1e-10", "0, or 1e-9"]);
    says(LENGTH, &[0.3, 3.2, 1.5], &["theta1 is 3.2", "to pi"]);
    says(SPEEDS, &[0.3, 0.4, 1.0, 0.0], &["l1 is 0;", "1e-6"]);
    says(SPEEDS, &[0.3, 0.4, -1.0, 1.0], &["l0 is -1;"]);
    says(SPEEDS, &[0.3, 0.4, 1.0], &["no chart", "theta0, theta1, l0, l1"]);
    assert!(LENGTH.answer(0, &[0.3, 0.4, f64::NAN]).is_err());
}

#[test]
fn an_answer_has_all_curves_and_the_proved_value() {
    for (family, datum) in [(LENGTH, vec![PI / 6.0, PI / 4.0, 1.1]), (SPEEDS, vec![PI / 6.0, PI / 4.0, 4.0, 4.0])] {
        let answer = family.answer(0, &datum).unwrap();
        let found = node(family, &datum);
        let value = answer.number("kappa_max").unwrap();
        assert_eq!((value as f32, answer.solutions.len()), (found.scalars[0], 4));
        assert_eq!(answer.number("kappa_max_paper").unwrap() as f32, found.scalars[1]);
        assert_eq!(answer.chosen.unwrap() < 2, found.flags & PAPER != 0);
        told(&answer);
    }
}

/// That the chosen solution is the one that the flags and the least greatest curvature are said of.
fn told(answer: &spiral_atlas::family::Answer) {
    use spiral_atlas::family::Value;
    let most = |values: &spiral_atlas::family::Values| match values.iter().find(|(name, _)| *name == "kappa_max") {
        Some((_, Value::Number(most))) => *most,
        _ => f64::INFINITY,
    };
    let all: Vec<f64> = answer.solutions.iter().map(most).collect();
    let Some(chosen) = answer.chosen else {
        assert!(answer.code.flags() & REGULAR == 0 && answer.number("kappa_max").is_none());
        return;
    };
    assert_eq!(chosen < 2, answer.code.flags() & PAPER != 0, "{answer:?}");
    assert_eq!(answer.number("kappa_max"), Some(all[chosen]), "{answer:?}");
    assert!(all.iter().all(|most| all[chosen] <= *most), "{answer:?}");
    assert_eq!(answer.number("kappa_max_paper").unwrap_or(f64::INFINITY), all[0].min(all[1]), "{answer:?}");
}

/// Where doubles cannot tell which solution bends least, the proofs do; and numbers are those of the proofs.
#[test]
fn answers_agree_with_their_flags() {
    let mut random = Random(12);
    for i in 0..160 {
        let first = random.uniform(-3.1, 3.1);
        let near = [first, first.next_up(), -first, (-first).next_down()][i % 4];
        let second = if i % 3 == 0 { random.uniform(-3.1, 3.1) } else { near };
        let size = random.decades(-1.0, 0.7);
        told(&LENGTH.answer(0, &[first, second, 1.0 + size]).unwrap());
        told(&SPEEDS.answer(0, &[first, second, size, if i % 2 == 0 { size } else { size.next_up() }]).unwrap());
    }
    for datum in [[0.0, 0.0, 4.0, 16.0], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 5.0, 5.0], [PI, PI, 2.0, 0.5]] {
        told(&SPEEDS.answer(0, &datum).unwrap());
    }
}
