//! Quintic trigonometric spirals against the oracle: random shapes, and places where a verdict is hard. Nothing may be
//! wrong.

use crate::oracle::data::Random;
use crate::oracle::trig::{END_CURVATURE_AS_PRINTED, END_RISES, PRINTED_RATIO, SPIRAL, judge};
use spiral_atlas::family::trig_quintic::{self, Shape, TrigQuintic, flags, least_ratio};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::FRAC_PI_2;

fn grid(shape: [f64; 5]) -> Grid {
    let axes = ["ratio", "theta", "m", "p", "q"].into_iter().zip(shape);
    Grid::new(axes.map(|(name, x)| Axis::new(name, Spacing::Values(vec![x])).unwrap()).collect()).unwrap()
}

/// What the f64 step and the intervals say.
fn codes(shape: [f64; 5]) -> (Code, Code) {
    let grid = grid(shape);
    let table = TrigQuintic.table(&grid).unwrap();
    let mut code = [Code::UNDECIDED];
    table.filter(0, &mut code);
    (code[0], table.exact(0).unwrap().0)
}

fn scalars(shape: [f64; 5]) -> [f32; 2] {
    let grid = grid(shape);
    let table = TrigQuintic.table(&grid).unwrap();
    let (mut fast, mut exact) = ([0.0], [0.0]);
    table.scalars(0, Code::new(0, 0), &[0], &mut fast).unwrap();
    table.exact_scalars(0, Code::new(0, 0), &[0], &mut exact).unwrap();
    [fast[0], exact[0]]
}

#[derive(Default)]
struct Tally {
    nodes: usize,
    open: usize,
    with: [usize; 4],
    faults: Vec<String>,
}

impl Tally {
    fn compare(&mut self, shape: [f64; 5], (fast, exact): (Code, Code)) {
        let want = judge(shape);
        self.nodes += 1;
        self.open += usize::from(fast == Code::UNDECIDED);
        for (bit, count) in self.with.iter_mut().enumerate() {
            *count += usize::from(want >> bit & 1 == 1);
        }
        if exact != Code::new(want, 0) || fast != Code::UNDECIDED && fast != exact {
            self.faults.push(format!("{shape:?}: {fast:?}, {exact:?}, must be {want:04b}"));
        }
    }
}

fn random(random: &mut Random) -> [f64; 5] {
    let end = |random: &mut Random| {
        if random.uniform(0.0, 1.0) < 0.7 {
            -4.0 + 5.0 * (1.0 - random.uniform(0.0, 1.0))
        } else {
            -4.0 + 10f64.powf(-9.0 * random.uniform(0.0, 1.0))
        }
    };
    let (p, q) = (end(random), end(random));
    [
        2.0 * 15f64.powf(random.uniform(0.0, 1.0)),
        (FRAC_PI_2 * random.uniform(0.0, 1.0)).max(1e-9),
        10f64.powf(2.0 * random.uniform(0.0, 1.0) - 1.0),
        p,
        q,
    ]
}

#[test]
fn random_shapes_are_judged_alike() {
    let (mut source, mut tally) = (Random(7), Tally::default());
    for _ in 0..400 {
        let shape = random(&mut source);
        tally.compare(shape, codes(shape));
    }
    assert!(tally.faults.is_empty(), "{:#?}", tally.faults);
    // Close to p = -4 or q = -4 the ends of the polynomial are too small beside its middle for doubles.
    assert!(tally.nodes == 400 && tally.open <= 24, "{}", tally.open);
    assert!(tally.with[..3].iter().all(|n| (40..390).contains(n)), "{:?}", tally.with);
}

#[test]
fn a_flipped_bit_is_noticed() {
    let shape = [6.0, 42f64.to_radians(), 1.0, 0.0, 0.0];
    for bit in 0..4 {
        let mut tally = Tally::default();
        let (fast, exact) = codes(shape);
        tally.compare(shape, (fast, Code(exact.0 ^ 1 << bit)));
        tally.compare(shape, (Code(fast.0 ^ 1 << bit), exact));
        tally.compare(shape, (fast, exact));
        assert_eq!(tally.faults.len(), 2, "bit {bit}");
    }
}

/// Neighbouring ratios between which SPIRAL flips, by halving with the library itself.
fn edge(shape: [f64; 5]) -> Option<[f64; 2]> {
    let [_, theta, m, p, q] = shape;
    let spiral = |ratio: f64| flags(&Shape { ratio, theta, m, p, q }).unwrap() & SPIRAL != 0;
    let (mut low, mut high) = (0.1, 64.0);
    if spiral(low) || !spiral(high) {
        return None;
    }
    while low.next_up() < high {
        let middle = 0.5 * (low + high);
        if spiral(middle) { high = middle } else { low = middle }
    }
    Some([low, high])
}

#[test]
fn verdicts_change_between_neighbouring_doubles_where_the_oracle_says() {
    let (mut source, mut tally) = (Random(11), Tally::default());
    while tally.nodes < 32 {
        let shape = random(&mut source);
        let Some(ratios) = edge(shape) else { continue };
        for (ratio, spiral) in ratios.into_iter().zip([false, true]) {
            let shape = [ratio, shape[1], shape[2], shape[3], shape[4]];
            tally.compare(shape, codes(shape));
            assert_eq!(judge(shape) & SPIRAL != 0, spiral, "{shape:?}");
        }
    }
    assert!(tally.faults.is_empty(), "{:#?}", tally.faults);
    // Doubles cannot decide so close to the boundary.
    assert!(tally.open > 16, "{}", tally.open);
}

#[test]
fn ties_and_ends_of_the_domain_are_judged_alike() {
    let mut tally = Tally::default();
    let edge_q = [-0.14623753345969035, -0.14623753345969032, -0.10750527919238516, -0.10750527919238514];
    for q in edge_q {
        tally.compare([6.0, 0.7, 1.0, 0.0, q], codes([6.0, 0.7, 1.0, 0.0, q]));
    }
    for ratio in [2.5, 3.5, 3.5f64.next_down(), 6.0, 1e-3, 1e3] {
        for theta in [1e-9, 42f64.to_radians(), FRAC_PI_2] {
            for (m, p) in [(1.0, 0.0), (1e-4, 1.0), (50.0, (-4.0f64).next_up())] {
                for q in [(-4.0f64).next_up(), -1.0, 0.125, 1.0] {
                    tally.compare([ratio, theta, m, p, q], codes([ratio, theta, m, p, q]));
                }
            }
        }
    }
    assert!(tally.faults.is_empty(), "{:#?}", tally.faults);
    assert_eq!(tally.nodes, 220);
    assert!(tally.with.iter().all(|n| *n > 1), "{:?}", tally.with);
}

/// Whether a threshold is right: no spiral half a step below, and spirals from half a step above on.
fn is_threshold(shape: [f64; 5], value: f32) -> bool {
    let spiral = |ratio: f64| judge([ratio, shape[1], shape[2], shape[3], shape[4]]) & SPIRAL != 0;
    if value == NO_VALUE {
        return !spiral(64.0);
    }
    let half = |other: f32| 0.5 * (f64::from(value) + f64::from(other));
    let (low, high) = (half(value.next_down()), half(value.next_up()));
    let above = (0..8).map(|i| high * (64.0 / high).powf(f64::from(i) / 7.0).min(64.0 / high));
    !spiral(low) && above.into_iter().all(spiral)
}

#[test]
fn thresholds_are_rounded_to_the_nearest_single() {
    let mut source = Random(5);
    let (mut with, mut without) = (0, 0);
    for i in 0..24 {
        let mut shape = random(&mut source);
        // Small m with small p has no spirals at large ratios.
        if i % 4 == 0 {
            (shape[2], shape[3]) = (0.02 + 0.1 * source.uniform(0.0, 1.0), -3.9 + source.uniform(0.0, 1.0));
        }
        let [fast, exact] = scalars(shape);
        assert_eq!(fast.to_bits(), exact.to_bits(), "{shape:?}");
        assert!(is_threshold(shape, fast), "{shape:?}: {fast}");
        if fast == NO_VALUE {
            without += 1;
        } else {
            with += 1;
            assert!(!is_threshold(shape, fast.next_up()) && !is_threshold(shape, fast.next_down()));
        }
    }
    assert!(with > 10 && without > 2, "{with} {without}");
}

#[test]
fn a_larger_ratio_need_not_keep_a_spiral() {
    let with = |ratio: f64| [ratio, 1.4513, 0.1027, -2.163, -2.437];
    for (ratio, spiral) in [(5.0, false), (15.0, true), (30.0, false), (64.0, false)] {
        let mut tally = Tally::default();
        tally.compare(with(ratio), codes(with(ratio)));
        assert!(tally.faults.is_empty() && (tally.with[1] == 1) == spiral, "{ratio}: {:?}", tally.faults);
    }
    assert_eq!(scalars(with(15.0)), [NO_VALUE; 2]);
}

#[test]
fn values_outside_the_domain_are_named() {
    let fine = [6.0, 0.7, 1.0, 0.0, 0.0];
    assert!(TrigQuintic.table(&grid(fine)).is_ok());
    let names = ["ratio", "theta", "m", "p", "q"];
    let bad = [[0.0, -1.0], [0.0, FRAC_PI_2.next_up()], [0.0, -2.0], [-4.0, 1.0f64.next_up()], [-4.0, 1.5]];
    for (which, values) in bad.into_iter().enumerate() {
        for value in values {
            let mut shape = fine;
            shape[which] = value;
            let error = TrigQuintic.table(&grid(shape)).err().expect("outside the domain").to_string();
            assert!(error.contains(names[which]) && error.contains(&format!("{value}")), "{error}");
            let [ratio, theta, m, p, q] = shape;
            let shape = Shape { ratio, theta, m, p, q };
            assert_eq!(flags(&shape).unwrap_err().to_string(), error);
            assert_eq!(least_ratio(&shape).unwrap_err().to_string(), error);
        }
    }
    assert_eq!(
        [
            trig_quintic::END_RISES,
            trig_quintic::SPIRAL,
            trig_quintic::PRINTED_RATIO,
            trig_quintic::END_CURVATURE_AS_PRINTED
        ],
        [END_RISES, SPIRAL, PRINTED_RATIO, END_CURVATURE_AS_PRINTED]
    );
}
