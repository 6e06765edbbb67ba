//! Paths of equal length.

use super::*;
use spiral_atlas::curve::{EqualLength, equal_length};
use std::f64::consts::PI;

fn ends(row: &Value) -> EqualLength {
    EqualLength {
        start: point(&row[0]),
        end: point(&row[1]),
        start_direction: number(&row[2]),
        end_direction: number(&row[3]),
        length: number(&row[4]),
    }
}

fn check(row: &Value) {
    let choice = equal_length(&ends(row)).unwrap();
    let paper = EqualLength::paper(&choice);
    let first = |i: usize| flat(&choice.candidates[i].curve.control_points()[1..3]);
    assert_near("the paper's", &first(paper), &flat(&points(&row[5])), DIGITS);
    let rotation = |i: usize| choice.candidates[i].absolute_rotation;
    assert_near("the paper's rotations", &[rotation(paper), rotation(1 - paper)], &numbers(&row[6]), DIGITS);
    assert_near(
        "greatest curvature",
        &[choice.candidates[paper].curve.greatest_curvature().1],
        &[number(&row[7])],
        DIGITS,
    );
    let mut all: Vec<f64> = (0..4).map(rotation).collect();
    all.sort_by(f64::total_cmp);
    assert_near("all rotations", &all, &numbers(&row[8]), DIGITS);
    assert_eq!(choice.best == paper, row[9].as_bool().unwrap(), "{row}");
    if choice.best != paper {
        assert_near("the best of four", &first(choice.best), &flat(&points(&row[10])), DIGITS);
    }
}

#[test]
fn published_paths() {
    rows("equal_arc").iter().for_each(check);
}

#[test]
fn published_paths_of_special_directions() {
    rows("equal_arc_special").iter().for_each(check);
}

#[test]
fn mirror_images_tie() {
    for row in published("equal_arc_mirror_tie").as_array().unwrap() {
        let (start_direction, end_direction, length) = (number(&row["th0"]), number(&row["th1"]), number(&row["S"]));
        let choice =
            equal_length(&EqualLength { start: [0.0, 0.0], end: [1.0, 0.0], start_direction, end_direction, length })
                .unwrap();
        let [first, second] = [0, 1].map(|i| choice.candidates[i]);
        assert_near("rotations", &[first.absolute_rotation, second.absolute_rotation], &[number(&row["R"]); 2], DIGITS);
        assert_near("|w0|²", &[first.curve.speed(0.0)], &[number(&row["w0_sq"])], DIGITS);
        let want = points(&row["p2_either"]);
        let got = [first, second].map(|c| c.curve.control_points()[2]);
        let swapped = [got[1], got[0]];
        assert!(
            apart(&flat(&got), &flat(&want)) < DIGITS || apart(&flat(&swapped), &flat(&want)) < DIGITS,
            "{got:?} {want:?}"
        );
    }
}

/// Figures 5 and 6.
#[test]
fn greatest_curvature_by_length() {
    let kmax = |length: f64| {
        let ends = EqualLength {
            start: [0.0, 0.0],
            end: [1.0, 0.0],
            start_direction: PI / 3.0,
            end_direction: -0.75 * PI,
            length,
        };
        let choice = equal_length(&ends).unwrap();
        choice.candidates[EqualLength::paper(&choice)].curve.greatest_curvature()
    };
    let printed = [57.36586, 19.01042, 10.04372, 6.694375, 5.139130, 4.337433];
    let figures = published("figures");
    let rows = figures["fig5_6"].as_array().unwrap();
    assert_eq!(rows.len(), printed.len());
    for (row, printed) in rows.iter().zip(printed) {
        let (t, k) = kmax(row[0].as_str().unwrap().parse().unwrap());
        assert_near("figure 5", &[k, t], &[number(&row[1]), number(&row[2])], 1e-10);
        assert!((k / printed - 1.0).abs() < 5e-7);
    }
    assert!(kmax(1.21499).0 == 1.0 && kmax(1.21501).0 < 1.0);
}

#[test]
fn random_ends_have_the_length_asked_for() {
    let mut noise = Noise(5);
    let mut others = 0;
    for i in 0..400 {
        let (start, end) = (noise.point(), noise.point());
        let distance = (end[0] - start[0]).hypot(end[1] - start[1]);
        let [first, mut last] = noise.point().map(|x| x * 4.0);
        // Near the special directions and near the chord's length too.
        let along = (end[1] - start[1]).atan2(end[0] - start[0]);
        let tiny = 10f64.powi(-(i % 17));
        match i % 4 {
            0 => last = first + tiny,
            1 => last = 2.0 * along - first + tiny,
            _ => {}
        }
        let length = distance * (1.0 + if i % 3 == 0 { tiny.max(1e-9) } else { 0.6 + 0.5 * noise.next() });
        let data = EqualLength { start, end, start_direction: first, end_direction: last, length };
        let choice = equal_length(&data).unwrap_or_else(|e| panic!("{e}: {data:?}"));
        others += usize::from(choice.best > 1);
        for c in &choice.candidates {
            let (jet0, jet1) = (bezier(&c.curve, 0.0), bezier(&c.curve, 1.0));
            let turned = |got: f64, want: f64| (got - want).sin().abs() + (1.0 - (got - want).cos());
            // Control points near 1 say no more of a short leg.
            let sure = 1e-12 + 2e-14 / jet0.speed();
            assert!(turned(jet0.direction(), first) < sure && turned(jet1.direction(), last) < sure, "{data:?}");
            assert!((jet0.speed() / jet1.speed() - 1.0).abs() < sure);
            let integral = PhQuintic::new(start, c.curve.preimage).end;
            let off = (integral[0] - end[0]).hypot(integral[1] - end[1]) + (c.curve.length() - length).abs();
            // What the sum of the legs cancels.
            let legs = c.curve.preimage.iter().flatten().map(|x| x * x).sum::<f64>();
            assert!(off < 1e-14 * (legs + 2.0), "{off} {data:?}");
        }
        let least =
            choice.candidates.iter().filter(|c| c.regular).map(|c| c.absolute_rotation).fold(f64::INFINITY, f64::min);
        assert!(choice.candidates[choice.best].absolute_rotation <= least * (1.0 + 1e-11));
    }
    assert!(others > 10, "{others}");
}

#[test]
fn what_has_no_solution_is_named() {
    let fine =
        EqualLength { start: [0.0, 0.0], end: [3.0, 4.0], start_direction: 0.3, end_direction: -1.0, length: 6.0 };
    assert!(equal_length(&fine).is_ok());
    let says = |ends: EqualLength, parts: &[&str]| {
        let error = equal_length(&ends).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    says(EqualLength { length: 5.0, ..fine }, &["`length` is 5;", "above the distance 5 of the ends"]);
    says(EqualLength { length: -6.0, ..fine }, &["`length` is -6;"]);
    says(EqualLength { end: [0.0, 0.0], ..fine }, &["`start` and `end` are both"]);
    says(EqualLength { end_direction: f64::NAN, ..fine }, &["`end_direction`", "NaN"]);
    says(EqualLength { length: f64::INFINITY, ..fine }, &["`length`", "inf"]);
}
