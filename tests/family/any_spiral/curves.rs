//! The involute's images: reference data, the ends they must meet, monotone curvature, and turns.

use super::Random;
use serde::Deserialize;
use spiral_atlas::family::any_spiral::{Datum, Image, Involute, InvolutePoint, Split, WhyNone, involute};
use spiral_atlas::transition::{Ends, involute_between};
use std::f64::consts::{PI, TAU};

#[derive(Deserialize)]
struct Reference {
    items: Vec<Item>,
    edge: Vec<Item>,
    samples: Vec<Samples>,
}

#[derive(Deserialize, Clone)]
#[serde(rename_all = "snake_case")]
struct Item {
    #[serde(default)]
    id: usize,
    alpha: Option<f64>,
    beta: Option<f64>,
    alpha_over_pi: Option<f64>,
    beta_over_pi: Option<f64>,
    k1: f64,
    k2: f64,
    /// Half the chord.
    c: Option<f64>,
    n1: u32,
    n2: u32,
    #[serde(rename = "Q")]
    q: f64,
    omega: Option<f64>,
    exists: bool,
    n1_range: Option<[u32; 2]>,
    curve_n1: Option<u32>,
    curve_n2: Option<u32>,
    theta: Option<f64>,
    t0: Option<f64>,
    rho: Option<f64>,
    lam: Option<f64>,
}

#[derive(Deserialize)]
struct Samples {
    id: usize,
    length: f64,
    by_parameter: Vec<[f64; 5]>,
    by_arclength: Vec<[f64; 5]>,
}

fn reference() -> Reference {
    serde_json::from_str(include_str!("../../fixtures/involute.json")).expect("valid fixtures")
}

impl Item {
    fn chord(&self) -> Datum {
        let angle = |plain: Option<f64>, over_pi: Option<f64>| plain.or(over_pi.map(|x| x * PI)).expect("an angle");
        let (alpha, beta) = (angle(self.alpha, self.alpha_over_pi), angle(self.beta, self.beta_over_pi));
        let c = self.c.unwrap_or(1.0);
        Datum { alpha, beta, k1: self.k1 * c, k2: self.k2 * c }
    }
}

fn near(got: f64, want: f64) -> bool {
    (got - want).abs() <= 1e-9 * want.abs().max(1e-3)
}

/// What differs from the reference.
fn faults(item: &Item) -> Vec<String> {
    let found = involute(&item.chord(), [item.n1, item.n2]).expect("in the domain");
    let mut faults = Vec::new();
    let mut check = |name: &str, got: f64, want: Option<f64>| {
        if let Some(want) = want.filter(|want| !near(got, *want)) {
            faults.push(format!("{name} is {got}, must be {want}"));
        }
    };
    check("Q", found.q, Some(item.q));
    if item.k1 != item.k2 {
        check("omega", found.omega, item.omega);
    }
    match &found.outcome {
        Ok(Image { curve, split }) => {
            check("theta", curve.theta(), item.theta);
            check("t0", curve.t0(), item.t0);
            check("rho", curve.map()[0], item.rho);
            // λ is known up to full turns.
            let turns = item.lam.map_or(0.0, |lam| ((curve.map()[1] - lam) / TAU).round());
            check("lambda", curve.map()[1] - TAU * turns, item.lam);
            check("turns about the start", f64::from(curve.turns()[0]), item.curve_n1.map(f64::from));
            check("turns about the end", f64::from(curve.turns()[1]), item.curve_n2.map(f64::from));
            let want = item.n1_range.map(|[least, most]| match (least..=most).contains(&item.n1) {
                true if curve.turns() == [item.n1, item.n2] => Split::Asked,
                true => Split::Other,
                false => Split::Impossible { least, most },
            });
            if want.is_some_and(|want| want != *split) {
                faults.push(format!("split is {split:?}, must be {want:?}"));
            }
            if !item.exists {
                faults.push("there must be no curve".into());
            }
        }
        Err(why) if item.exists => faults.push(format!("there must be a curve, not {why:?}")),
        Err(_) => {}
    }
    faults
}

#[test]
fn reference_data() {
    let (reference, mut curves) = (reference(), 0);
    // The double nearest to π/2 lies below it, where the circles that touch in the reference are already apart.
    let edges = reference.edge.iter().filter(|item| item.q != 0.0 || item.k1 == item.k2);
    for item in reference.items.iter().chain(edges) {
        let faults = faults(item);
        assert!(faults.is_empty(), "item {}: {faults:?}", item.id);
        curves += usize::from(item.exists);
    }
    println!("{} data, {curves} curves", reference.items.len() + reference.edge.len());
    assert!(curves > 100);
}

#[test]
fn a_changed_reference_is_noticed() {
    let item = reference().items[0].clone();
    let changed = |change: fn(&mut Item)| {
        let mut item = item.clone();
        change(&mut item);
        faults(&item).len()
    };
    assert_eq!(changed(|_| ()), 0);
    assert_eq!(changed(|item| item.q *= 1.0 + 1e-8), 1);
    assert_eq!(changed(|item| item.theta = item.theta.map(|x| x * (1.0 + 1e-8))), 1);
    assert_eq!(changed(|item| item.t0 = item.t0.map(|x| x * (1.0 - 1e-8))), 1);
    assert_eq!(changed(|item| item.rho = item.rho.map(|x| x + 1e-7)), 1);
    assert_eq!(changed(|item| item.lam = item.lam.map(|x| x + 1e-7)), 1);
    assert_eq!(changed(|item| item.curve_n1 = Some(1)), 1);
    assert_eq!(changed(|item| item.n1_range = Some([1, 1])), 1);
    assert_eq!(changed(|item| item.exists = false), 1);
}

#[test]
fn reference_points() {
    let mut compared = 0;
    for samples in &reference().samples {
        // The ends are the first and the last row; directions beyond ±π show the turns.
        let ends = [samples.by_parameter[0], samples.by_parameter[samples.by_parameter.len() - 1]];
        let (c, turns) = (ends[1][1], ends.map(|row| (row[3] / TAU).round()));
        let [alpha, beta] = [0, 1].map(|i| ends[i][3] - TAU * turns[i]);
        let chord = Datum { alpha, beta, k1: c * ends[0][4], k2: c * ends[1][4] };
        let found = involute(&chord, turns.map(|n| n.abs() as u32)).unwrap();
        let curve = found.curve().expect("a curve");
        assert!(near(c * curve.length(), samples.length), "{}", samples.id);
        // Neighbours found one from the other are those found one by one, however far apart.
        for count in [2, 3, 10, 1000] {
            for (i, (s, at)) in curve.samples(count).unwrap().into_iter().enumerate() {
                let alone = curve.at_length(i as f64 / (count - 1) as f64);
                assert!((curve.length_to(at.f) - s).abs() < 2e-13 * curve.length(), "{}: {at:?}", samples.id);
                let apart = (at.point[0] - alone.point[0]).hypot(at.point[1] - alone.point[1]);
                assert!(apart < 4e-13 * curve.length(), "{}: {at:?}, not {alone:?}", samples.id);
            }
        }
        assert!(curve.samples(1).unwrap_err().to_string().contains("at least 2"));
        let by_parameter = samples.by_parameter.iter().map(|row| (row, curve.at(row[0])));
        let by_length = samples.by_arclength.iter().map(|row| (row, curve.at_length(row[0])));
        for ([_, x, y, direction, k], at) in by_parameter.chain(by_length) {
            for (got, want) in
                [(c * at.point[0], x), (c * at.point[1], y), (at.direction, direction), (at.curvature / c, k)]
            {
                assert!(
                    (got - want).abs() < 1e-9 * want.abs().max(1.0),
                    "{}: {at:?}, not {x}, {y}, {direction}, {k}",
                    samples.id
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 200);
}

/// Where a curve fails its ends by more than 1e-12, or its curvature is not monotone.
fn broken(chord: &Datum, curve: &Involute) -> Option<String> {
    let (start, end) = (curve.at(0.0), curve.at(1.0));
    let meets = |at: &InvolutePoint, x: f64, angle: f64, k: f64| {
        // Within what the cumulative direction says of itself; the angle is that of an exact double.
        let turned = at.direction - angle;
        let off = (turned - TAU * (turned / TAU).round()).abs();
        let tolerance = 1e-12 * at.direction.abs().max(1.0);
        at.point == [x, 0.0] && off < tolerance && (at.curvature - k).abs() <= 1e-12 * k.abs().max(1.0)
    };
    if !meets(&start, -1.0, chord.alpha, chord.k1) || !meets(&end, 1.0, chord.beta, chord.k2) {
        return Some(format!("ends {start:?}, {end:?}"));
    }
    let rising = if chord.k1 < chord.k2 { 1.0 } else { -1.0 };
    let points: Vec<_> = (0..=1000).map(|i| curve.at(f64::from(i) / 1000.0)).collect();
    for pair in points.windows(2) {
        let [a, b] = [pair[0].curvature, pair[1].curvature];
        if rising * (b - a) < -1e-13 * (1.0 + a.abs().max(b.abs())) {
            return Some(format!("curvature {a} then {b} at {}", pair[0].f));
        }
    }
    // The point of the parameter's middle as either half has it.
    let [left, right] = [0.5, 0.5f64.next_up()].map(|f| curve.at(f));
    // Neighbouring parameters are still apart, and directions with them.
    let gap = (left.point[0] - right.point[0]).hypot(left.point[1] - right.point[1]);
    let size = left.point[0].hypot(left.point[1]).max(1.0);
    let bent = (left.curvature - right.curvature).abs() / left.curvature.abs().max(1.0);
    let turned = (left.direction - right.direction).abs() - 2.0 * left.curvature.abs() * gap;
    if gap > 1e-12 * size * size || bent > 1e-11 * size || turned > 1e-11 * size {
        return Some(format!("halves part by {gap}, {turned}, {bent}: {left:?}, {right:?}"));
    }
    None
}

/// Over all of Q from -1e6 to -1e-10, with and without turns.
#[test]
fn curves_meet_their_ends_with_monotone_curvature() {
    let (mut r, mut curves, mut least, mut most) = (Random(31), 0, f64::INFINITY, 0.0f64);
    for round in 0..600 {
        let [alpha, beta, _, _] = r.likely();
        let turns = if round % 3 == 0 { [r.below(4) as u32, r.below(4) as u32] } else { [0, 0] };
        let side = if alpha + beta > 0.0 { 1.0 } else { -1.0 };
        let wanted = 10f64.powf(r.uniform(-10.0, 6.0));
        let room0 = wanted.sqrt() * 10f64.powf(r.uniform(-1.0, 1.0));
        let room1 = (wanted + (0.5 * (alpha + beta)).sin().powi(2)) / room0;
        let chord = Datum { alpha, beta, k1: -side * room0 - alpha.sin(), k2: side * room1 + beta.sin() };
        let found = involute(&chord, turns).unwrap();
        let Some(curve) = found.curve() else { continue };
        if let Some(what) = broken(&chord, curve) {
            panic!("{chord:?}, {turns:?}, Q = {}: {what}", found.q);
        }
        assert_eq!(curve.turns()[0] + curve.turns()[1], turns[0] + turns[1]);
        assert!(curve.length() >= 2.0);
        (least, most) = (least.min(-found.q), most.max(-found.q));
        curves += 1;
    }
    println!("{curves} curves, -Q from {least:.1e} to {most:.1e}");
    assert!(curves > 500 && least < 3e-10 && most > 3e5);
}

#[test]
fn a_broken_curve_is_noticed() {
    let chord = Datum { alpha: 0.5, beta: 0.6, k1: -2.0, k2: 3.0 };
    let found = involute(&chord, [0, 0]).unwrap();
    let curve = found.curve().unwrap();
    assert_eq!(broken(&chord, curve), None);
    for (which, off) in [1e-11, 1e-11, 5e-12, 5e-12].into_iter().enumerate() {
        let mut chord = chord;
        *[&mut chord.alpha, &mut chord.beta, &mut chord.k1, &mut chord.k2][which] += off;
        assert!(broken(&chord, curve).is_some(), "{which}");
    }
    assert!(broken(&Datum { k1: 4.0, ..chord }, curve).is_some());
}

/// Directions and curvatures are those of the points: differences of neighbours; and crossings of the chord's line are
/// counted.
#[test]
fn points_directions_and_turns_agree() {
    let mut compared = 0;
    for item in reference().items.iter().filter(|item| item.exists).step_by(4) {
        let found = involute(&item.chord(), [item.n1, item.n2]).unwrap();
        let curve = found.curve().unwrap();
        let count = 10_000;
        let at: Vec<_> = (0..=count).map(|i| curve.at(f64::from(i) / f64::from(count))).collect();
        let mut crossings = [0u32, 0];
        let mut length = 0.0;
        for (i, pair) in at.windows(2).enumerate() {
            let d = [pair[1].point[0] - pair[0].point[0], pair[1].point[1] - pair[0].point[1]];
            let step = d[0].hypot(d[1]);
            length += step;
            let direction = 0.5 * (pair[0].direction + pair[1].direction);
            let curvature = pair[0].curvature.abs().max(pair[1].curvature.abs());
            if curvature * step < 0.05 {
                let along = d[0] * direction.cos() + d[1] * direction.sin();
                let across = d[1] * direction.cos() - d[0] * direction.sin();
                assert!(across.abs() < 0.02 * along, "{}: {pair:?}", item.id);
                let turned = pair[1].direction - pair[0].direction;
                let between = [0, 1].map(|j| pair[j].curvature * step);
                let room = 1e-9 + 1e-3 * curvature * step;
                assert!(
                    turned > between[0].min(between[1]) - room && turned < between[0].max(between[1]) + room,
                    "{}: {pair:?}",
                    item.id
                );
            }
            let [y0, y1] = [pair[0].point[1], pair[1].point[1]];
            if i > 0 && i + 1 < count as usize && (y0 < 0.0) != (y1 < 0.0) {
                let x = pair[0].point[0] + d[0] * y0 / (y0 - y1);
                crossings[0] += u32::from(x < -1.0);
                crossings[1] += u32::from(x > 1.0);
            }
            compared += 1;
        }
        assert_eq!(crossings, curve.turns(), "item {}", item.id);
        assert!((length / curve.length() - 1.0).abs() < 0.02, "item {}: {length}", item.id);
    }
    assert!(compared > 200_000);
}

#[test]
fn reasons_and_bad_input() {
    let chord = |alpha, beta, k1, k2| Datum { alpha, beta, k1, k2 };
    let why = |chord: Datum, turns| match involute(&chord, turns).unwrap().outcome {
        Err(why) => why,
        Ok(_) => panic!("{chord:?} has a curve"),
    };
    assert_eq!(why(chord(0.1, 0.2, 1.0, 1.0), [0, 0]), WhyNone::SameCurvature);
    assert_eq!(why(chord(0.1, 0.2, 3.0, -2.0), [0, 0]), WhyNone::WrongSide);
    assert_eq!(why(chord(-0.3, 0.3, -3.0, 2.0), [0, 0]), WhyNone::WrongSide);
    assert_eq!(why(chord(0.1, 0.2, 0.2, 0.3), [0, 0]), WhyNone::CirclesCross);
    assert_eq!(why(chord(0.0, 0.0, 0.0, 1.0), [0, 1]), WhyNone::CirclesTouch);
    assert!(involute(&chord(-0.3, 0.3, -3.0, 2.0), [0, 1]).unwrap().curve().is_some());
    let message = |chord, turns| involute(&chord, turns).expect_err("bad input").to_string();
    assert!(message(chord(4.0, 0.0, 0.0, 1.0), [0, 0]).contains("alpha is 4"));
    assert!(message(chord(0.0, f64::NAN, 0.0, 1.0), [0, 0]).contains("beta is NaN"));
    assert!(message(chord(0.0, 0.0, f64::INFINITY, 1.0), [0, 0]).contains("k1 is inf"));
    assert!(
        message(chord(0.0, 0.1, 0.0, 1.0), [0, 1001])
            .contains("the number of turns about an end is 1001; it must be at most 1000")
    );
    for why in [WhyNone::SameCurvature, WhyNone::WrongSide, WhyNone::CirclesCross, WhyNone::CirclesTouch] {
        assert!(why.to_string().len() > 40);
    }
}

/// Ends anywhere in the plane: the frame puts the curve there, end points exactly.
#[test]
fn ends_in_the_plane() {
    let ends = Ends {
        start: [500_000.0, 5_200_000.0],
        end: [500_120.0, 5_200_050.0],
        start_direction: 1.2,
        end_direction: -1.0,
        start_curvature: -0.001,
        end_curvature: -0.08,
    };
    let (found, frame) = involute_between(&ends, [0, 0]).unwrap();
    let curve = found.curve().expect("a spiral");
    assert_eq!((frame.point(curve.at(0.0).point), frame.point(curve.at(1.0).point)), (ends.start, ends.end));
    let unit = frame.half_chord[0].hypot(frame.half_chord[1]);
    let chord = frame.half_chord[1].atan2(frame.half_chord[0]);
    for (f, direction, curvature) in [(0.0, 1.2, -0.001), (1.0, -1.0, -0.08)] {
        let at = curve.at(f);
        assert!((at.direction + chord - direction).abs() < 1e-12 && (at.curvature / unit - curvature).abs() < 1e-14);
    }
}
