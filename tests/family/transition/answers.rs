//! The whole of section 3.2: examples, reference data, reasons, errors.

use super::{EPS, answer, length, minus, roots};
use serde::Deserialize;
use spiral_atlas::curve::CubicBezier;
use spiral_atlas::family::any_spiral::least_end_curvature;
use spiral_atlas::family::cubic::Root;
use spiral_atlas::transition::{Answer, Bound, Ends, Figure, NoSpiral, Placement, Turn, Which, Why, spiral};
use std::f64::consts::{PI, TAU};

/// Section 4 of the paper: φ0, φ1, κ0, κ1, and the root, found with 40 digits.
const EXAMPLES: [([f64; 4], [f64; 2]); 3] = [
    ([0.7, 1.4, 0.4, 4.0], [1.660102747681678, 0.7698506660841348]),
    ([0.1, 1.5, 0.035, 100.0], [2.6072780172841217, 0.6266669788278348]),
    ([0.8, 0.9, 0.6, 0.874], [1.6996600696416262, 1.4923626405195534]),
];

fn ends_of([phi0, phi1, kappa0, kappa1]: [f64; 4]) -> Ends {
    Ends {
        start: [-1.0, 0.0],
        end: [1.0, 0.0],
        start_direction: -phi0,
        end_direction: phi1,
        start_curvature: kappa0,
        end_curvature: kappa1,
    }
}

/// The same ends travelled backwards, and mirrored in the x axis.
fn backwards(e: &Ends) -> Ends {
    Ends {
        start: e.end,
        end: e.start,
        start_direction: e.end_direction + PI,
        end_direction: e.start_direction - 3.0 * PI,
        start_curvature: -e.end_curvature,
        end_curvature: -e.start_curvature,
    }
}

fn mirrored(e: &Ends) -> Ends {
    Ends {
        start: [e.start[0], -e.start[1]],
        end: [e.end[0], -e.end[1]],
        start_direction: -e.start_direction,
        end_direction: TAU - e.end_direction,
        start_curvature: -e.start_curvature,
        end_curvature: -e.end_curvature,
    }
}

fn why(ends: &Ends) -> Why {
    match answer(ends).outcome {
        Err(why) => why,
        Ok(i) => panic!("solution {i} was chosen for {ends:?}"),
    }
}

#[test]
fn the_papers_examples_are_spirals_in_every_orientation() {
    for (data, [f0, f1]) in EXAMPLES {
        let plain = ends_of(data);
        let all = [plain, mirrored(&plain), backwards(&plain), mirrored(&backwards(&plain))];
        for (i, ends) in all.iter().enumerate() {
            let found = answer(ends);
            assert_eq!((found.placement.reversed, found.placement.mirrored), (i >= 2, i % 2 == 1), "orientation {i}");
            let d = found.datum;
            // The datum is that of the paper: to the bit in its own orientation, else within the rounding of ±π and
            // ±2π.
            let off =
                [d.phi0, d.phi1, d.kappa0, d.kappa1].iter().zip(data).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= if i == 0 { 0.0 } else { 8.0 * EPS }, "{d:?}");
            let chosen = found.chosen().expect("a spiral");
            // 8 EPS of the datum, times a condition number below 100 away from double roots.
            assert!((chosen.f0 - f0).abs() < 1e-12 && (chosen.f1 - f1).abs() < 1e-12, "{chosen:?}");

            let figure = Figure::new(ends, chosen, 401).unwrap();
            // Magnitude of curvature grows in the normalised direction of travel, whatever the user's.
            let side = if ends.start_curvature > 0.0 { 1.0 } else { -1.0 };
            let growth = if i >= 2 { -side } else { side };
            assert!(figure.samples.iter().all(|s| growth * s.curvature_ds > 0.0 && growth * s.curvature_dt > 0.0));
            assert!(
                !figure
                    .samples
                    .windows(2)
                    .any(|w| w[0].s >= w[1].s || growth * (w[1].curvature - w[0].curvature) <= 0.0)
            );
            let (first, last) = (figure.samples[0], figure.samples[400]);
            assert_eq!((first.t, first.s, last.t, first.point), (0.0, 0.0, 1.0, ends.start));
            // 400 pieces, each within 1e-14 of its own length.
            assert!((last.s / chosen.control_points.length() - 1.0).abs() < 2e-14);
            // Shortest tangent over the chord is 0.02 here: curvature within 3 · 2 EPS / 0.02 and as much for the root.
            assert!((first.curvature / ends.start_curvature - 1.0).abs() < 1e-12, "{first:?}");
            assert!((last.curvature / ends.end_curvature - 1.0).abs() < 1e-12, "{last:?}");
            assert_eq!(figure.circles, ends.circles());
        }
    }
}

#[derive(Deserialize)]
struct Point {
    phi0: f64,
    phi1: f64,
    kappa0: f64,
    kappa1: f64,
    roots: Vec<[f64; 2]>,
    thm31: Vec<bool>,
    spiral: Vec<bool>,
    kneser: bool,
}

fn points() -> Vec<Point> {
    serde_json::from_str(include_str!("../../fixtures/cubic_points.json")).unwrap()
}

impl Point {
    fn ends(&self) -> Ends {
        ends_of([self.phi0, self.phi1, self.kappa0, self.kappa1])
    }

    /// The reference roots; margins are not in the reference, so their sign alone is filled in.
    fn roots(&self) -> Vec<Root> {
        let one = |(i, [f0, f1]): (usize, &[f64; 2])| Root {
            f0: *f0,
            f1: *f1,
            theorem31: self.thm31[i],
            spiral: self.spiral[i],
            margin: if self.spiral[i] { 0.1 } else { -0.1 },
        };
        self.roots.iter().enumerate().map(one).collect()
    }
}

/// Reference data computed elsewhere with 40 digits; their least distance from any boundary is 1e-7, far above
/// rounding.
#[test]
fn curves_agree_with_the_reference() {
    let (mut curves, mut spirals) = (0, 0);
    for point in points() {
        for root in point.roots() {
            let curve = CubicBezier::from_ratios(point.phi0, point.phi1, root.f0, root.f1);
            assert_eq!(curve.curvature_extrema().is_empty() && point.kappa0 < point.kappa1, root.spiral, "{root:?}");
            let wrong = |f0: f64, f1: f64| {
                let curve = CubicBezier::from_ratios(point.phi0, point.phi1, f0, f1);
                let p = curve.p;
                let size = p.iter().map(|z| length(*z)).fold(0.0, f64::max);
                let shortest = (0..3).map(|i| length(minus(p[i + 1], p[i]))).fold(f64::INFINITY, f64::min);
                // Points to 4 EPS of the largest, over the shortest side and the least sine; f itself, over its
                // distance from 3.
                let sine = point.phi0.sin().min((point.phi0 + point.phi1).sin()).min(0.1);
                let tolerance = 32.0 * EPS * (size / shortest / sine + 3.0 / (3.0 - f0) + 3.0 / (3.0 - f1));
                assert!(tolerance < 1e-6, "{tolerance}");
                let off = |t: f64, kappa: f64| (curve.curvature(t) / kappa - 1.0).abs() > tolerance;
                off(0.0, point.kappa0) || off(1.0, point.kappa1)
            };
            assert!(!wrong(root.f0, root.f1), "{root:?}");
            assert!(wrong(root.f0 * (1.0 - 1e-5), root.f1) && wrong(root.f0, root.f1 * (1.0 - 1e-5)), "{root:?}");
            curves += 1;
            spirals += u32::from(root.spiral);
        }
    }
    assert!(curves > 300 && spirals > 30, "{curves} {spirals}");
}

#[test]
fn reasons_agree_with_the_reference() {
    let mut seen = std::collections::BTreeMap::new();
    for point in points() {
        let roots = point.roots();
        let found = Answer::from_roots(&point.ends(), &roots, roots.iter().find(|r| r.spiral)).unwrap();
        // Decreasing curvature is normalised by reversal, for which the reference has no roots.
        if found.placement.reversed {
            continue;
        }
        let name = match (&found.outcome, point.kneser) {
            (Ok(_), true) => "spiral",
            (Err(Why::NoRoot { .. }), true) if roots.is_empty() => "no root",
            (Err(Why::NotMonotone { roots: all, .. }), true) => {
                assert!(all.len() == roots.len() && all.iter().all(|r| !r.extrema.is_empty() && r.margin < 0.0));
                "not monotone"
            }
            (Err(Why::NoSpiralOfAnyKind(none)), false) => match none {
                NoSpiral::EqualCurvatures { .. } => "equal",
                NoSpiral::WrongSide { .. } => "angles",
                NoSpiral::CirclesCross { needs, alone } => {
                    let least = least_end_curvature(point.phi0, point.phi1, point.kappa0);
                    let end = needs.iter().find(|need| need.which == Which::End);
                    // Where the start is too sharp, the end cannot help, at least not alone.
                    assert_eq!(*alone && end.is_some(), least.is_some(), "{needs:?}");
                    let Some((end, Bound::Above(bound))) = end.map(|end| (end, end.bound)) else { continue };
                    assert!(end.curvature == point.kappa1 && end.curvature <= bound);
                    // Both round sin φ1 and the fraction beside it, a few ulp of the larger.
                    assert!(
                        least.is_none_or(|least| (least - bound).abs() <= 8.0 * EPS * least.abs().max(1.0)),
                        "{least:?} {bound}"
                    );
                    if *alone { "nested" } else { "both" }
                }
            },
            (outcome, kneser) => panic!("{outcome:?}, nested circles {kneser}"),
        };
        *seen.entry(name).or_insert(0) += 1;
    }
    assert!(["spiral", "no root", "not monotone", "nested"].iter().all(|name| seen.get(name) >= Some(&30)), "{seen:?}");
}

#[test]
fn reasons_name_the_condition_with_its_numbers() {
    let with = |change: fn(&mut Ends)| {
        let mut ends = ends_of(EXAMPLES[0].0);
        change(&mut ends);
        ends
    };
    let says = |ends: Ends, parts: &[&str]| {
        let reason = why(&ends);
        let text = reason.to_string();
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
        reason
    };
    says(with(|e| (e.start_direction, e.start_curvature) = (0.25, -1.0)), &["14.3239°", "80.2141°", "opposite sides"]);
    says(with(|e| e.end_direction = 0.0), &["-40.107°", "0°", "the curvature rises", "above 0, and it is -40.107°"]);
    says(with(|e| e.end_direction = 2.5), &["turn by 183.346° in all", "below 180°"]);
    let straight = says(with(|e| e.start_curvature = 0.0), &["start curvature is 0"]);
    assert_eq!(straight, Why::Straight { which: Which::Start });
    let bent = says(
        mirrored(&with(|e| e.start_curvature = -2.0)),
        &["start curvature 2.0 is to the left", "turn right", "must be below 0"],
    );
    assert_eq!(bent, Why::Inflection { which: Which::Start, curvature: 2.0, turn: Turn::Right });
    says(with(|e| e.end_curvature = 0.4), &["the curvature is 0.4 at both ends", "neither rise nor fall"]);
    says(
        with(|e| e.start_direction = -1.5),
        &["the start direction is -85.9437° and the end direction 80.2141°", "above 0, and it is -5.72958°"],
    );
    says(
        with(|e| e.start_curvature = 0.65),
        &["circles of curvature", "the start curvature 0.65 must be below 0.605213"],
    );
    says(with(|e| e.end_curvature = 1.2), &["the end curvature 1.2 must be above 1.4669"]);
    let far = says(
        ends_of([0.179064, 0.792727, 0.0231982, 32.2928]),
        &["no root of 3 - f1 = a f0^2", "the discriminant is "],
    );
    let Why::NoRoot { a, k, discriminant, .. } = far else { panic!("{far:?}") };
    // (A.3) at a maximum of F: no real root between 0 and 3 leaves F of one sign there.
    let sign = |x: f64| 3.0 - x - k * (3.0 - a * x * x).powi(2) > 0.0;
    assert!((0..3000).all(|i| sign(f64::from(i) / 1000.0) == sign(0.0)) && discriminant.is_finite());
    // Some spiral exists, and one cubic, which wavers.
    let wavy = says(
        with(|e| e.end_curvature = 2.2),
        &["the only cubic that has these ends is not monotone (root (", "margin -0.1", "curvature extrem", "at t = 0."],
    );
    let Why::NotMonotone { roots, .. } = wavy else { panic!("{wavy:?}") };
    assert!(!roots.is_empty());
}

#[test]
fn the_reason_turns_with_the_data() {
    let plain = Ends { end_curvature: 2.2, ..ends_of(EXAMPLES[0].0) };
    let times = |ends: &Ends| match why(ends) {
        Why::NotMonotone { roots, .. } => roots[0].extrema.clone(),
        other => panic!("{other}"),
    };
    let (forth, back) = (times(&plain), times(&backwards(&plain)));
    assert_eq!(forth.len(), back.len());
    // Extrema are simple zeros of a quintic here, to rounding of the root; 1e-9 is far below their distance from 1/2.
    assert!(
        forth.iter().zip(back.iter().rev()).all(|(a, b)| (a + b - 1.0).abs() < 1e-9 && (a - b).abs() > 1e-3),
        "{forth:?} {back:?}"
    );
    let reversed = |ends: &Ends| answer(ends).to_string();
    assert!(reversed(&backwards(&plain)).contains("reversed") && !reversed(&plain).contains("reversed"));
}

#[test]
fn errors_name_the_value() {
    let ends = ends_of(EXAMPLES[0].0);
    let says = |ends: Ends, parts: &[&str]| {
        let text = Placement::normalise(&ends).unwrap_err().to_string();
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
        assert_eq!(spiral(&ends).unwrap_err().to_string(), text);
    };
    says(Ends { start: [f64::NAN, 0.0], ..ends }, &["start x is NaN"]);
    says(Ends { end_direction: f64::INFINITY, ..ends }, &["end direction is inf"]);
    says(Ends { end: [-1.0, -0.0], ..ends }, &["start and end are both (-1.0, 0.0)"]);
    says(
        Ends { start: [-1e-310, 0.0], end: [1e-310, 0.0], ..ends },
        &["half the chord", "is 1e-310;", "change the unit"],
    );
    says(Ends { start: [-1.5e308, -1.5e308], end: [1.5e308, 1.5e308], ..ends }, &["half the chord", "is inf;"]);
    says(Ends { end: [1e200, 0.0], end_curvature: 1e200, ..ends }, &["end curvature 1e200", "is inf"]);
    says(Ends { end: [-1.0 + 1e-10, 0.0], start_curvature: 1e-305, ..ends }, &["start curvature 1e-305"]);
    let (d, _) = Placement::normalise(&ends).unwrap();
    let all = roots(&d);
    let stranger = Root { f0: 1.0, ..all[0] };
    assert!(Answer::from_roots(&ends, &all, Some(&stranger)).unwrap_err().to_string().contains("not among"));
    assert!(
        Figure::new(&ends, answer(&ends).chosen().unwrap(), 1)
            .unwrap_err()
            .to_string()
            .contains("the number of samples of a curve is 1; it must be at least 2")
    );
}

/// Chords near both ends of the range of doubles.
#[test]
fn tiny_and_huge_chords() {
    let (data, [f0, _]) = EXAMPLES[0];
    for half in [1e-300, 1e-150, 1e150, 1e300, 8e307] {
        let unit = ends_of(data);
        let ends = Ends {
            start: [-half, 0.0],
            end: [half, 0.0],
            start_curvature: 0.4 / half,
            end_curvature: 4.0 / half,
            ..unit
        };
        let found = answer(&ends);
        // Even 0.4 / 8e307, subnormal, keeps 50 bits.
        assert!((found.datum.kappa1 - 4.0).abs() < 16.0 * EPS, "{half:e}: {:?}", found.datum);
        let Some(chosen) = found.chosen() else { panic!("{half:e}: {found}") };
        assert!((chosen.f0 - f0).abs() < 1e-12);
        assert_eq!((chosen.control_points.p[0], chosen.control_points.p[3]), (ends.start, ends.end));
    }
}

#[test]
fn answers_are_told_in_json() {
    let json = |ends: &Ends| serde_json::to_value(answer(ends)).unwrap();
    let yes = json(&ends_of(EXAMPLES[0].0));
    assert_eq!(yes["chosen"], 0);
    assert_eq!(yes["datum"]["kappa1"], 4.0);
    assert_eq!(yes["placement"]["reversed"], false);
    assert_eq!(yes["solutions"][0]["control_points"][3][0], 1.0);
    assert!(yes.get("why").is_none());
    let no = json(&Ends { end_curvature: 1.2, ..ends_of(EXAMPLES[0].0) });
    assert!(no.get("chosen").is_none());
    assert_eq!(
        (&no["why"]["condition"], &no["why"]["cause"]),
        (&"no-spiral-of-any-kind".into(), &"circles-cross".into())
    );
    let need = &no["why"]["needs"][0];
    assert_eq!((&need["which"], &need["curvature"]), (&"end".into(), &1.2.into()));
    assert!((need["above"].as_f64().unwrap() - 1.466_901).abs() < 1e-6, "{need}");
    assert!(no["why"]["text"].as_str().unwrap().contains("must be above 1.4669"));
}

/// With the proved solver in place of this file's own.
#[test]
fn the_proved_solver_gives_the_same_curves() {
    for (data, [f0, f1]) in EXAMPLES {
        for ends in [ends_of(data), mirrored(&ends_of(data)), backwards(&ends_of(data))] {
            let (got, want) = (spiral(&ends).unwrap(), answer(&ends));
            let chosen = got.chosen().unwrap();
            assert!((chosen.f0 - f0).abs() < 1e-12 && (chosen.f1 - f1).abs() < 1e-12, "{chosen:?}");
            assert_eq!(got.solutions.len(), want.solutions.len());
            assert!(chosen.spiral && chosen.margin > 0.0 && chosen.local_control_points.curvature_extrema().is_empty());
        }
    }
    for end_curvature in [0.2, 1.2, 1.5, 2.2, -1.0, 0.0] {
        let ends = Ends { end_curvature, ..ends_of(EXAMPLES[0].0) };
        let name = |a: &Answer| serde_json::to_value(a).unwrap()["why"]["condition"].clone();
        let (got, want) = (spiral(&ends).unwrap(), answer(&ends));
        assert!(name(&want).is_string());
        assert_eq!(name(&got), name(&want), "{end_curvature}");
    }
}
