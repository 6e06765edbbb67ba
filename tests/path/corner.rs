//! Corner curves.

use super::*;
use spiral_atlas::path::Turn;
use std::f64::consts::{FRAC_PI_2, PI};

fn published(key: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(include_str!("../fixtures/ph_corners.json")).unwrap();
    let rows = all[key]["rows"].as_array().unwrap().clone();
    assert!(rows.len() > 5);
    rows
}

fn of_angle(theta: f64) -> Turn {
    Turn::new([1.0, 0.0], [theta.cos(), theta.sin()]).unwrap()
}

#[test]
fn published_numbers() {
    for row in published("corner") {
        let row = numbers(&row);
        let [theta, reach, d, r] = [row[0], row[1], row[2], row[3]];
        let turn = of_angle(theta);
        let curve = turn.corner([reach, 0.0], reach).unwrap();
        let got = [
            turn.curvature(reach),
            turn.length(reach),
            turn.deviation(reach),
            turn.reach_for_offset(d),
            turn.reach_for_curvature(1.0 / r),
            turn.least_offset(0.0, 1.0 / r),
            curve.bending_energy(),
        ];
        for (i, (got, want)) in got.iter().zip(&row[4..]).enumerate() {
            // Near θ = π the cosine of its half has lost digits.
            assert!((got / want - 1.0).abs() < 2e-11, "{i}: {got} {want} in {row:?}");
        }
        assert_near("angle", &[turn.angle()], &[theta], 1e-14);
        assert_near("the same of the curve", &[curve.curvature(0.5), curve.length()], &got[..2], 1e-12);
    }
    for row in published("corner_general") {
        let [before, at, after] = [0, 1, 2].map(|i| point(&row[i]));
        let turn = Turn::new([at[0] - before[0], at[1] - before[1]], [after[0] - at[0], after[1] - at[1]]).unwrap();
        let reach = (at[0] - before[0]).hypot(at[1] - before[1]);
        let points = turn.corner(at, reach).unwrap().control_points();
        let (p1, p3) = (point(&row[3]), point(&row[4]));
        assert_near("control points", &flat(&points), &flat(&[before, p1, p1, p3, p3, after]), DIGITS);
        assert_near("length", &[turn.length(reach)], &[number(&row[5])], DIGITS);
    }
    for row in published("theta_max") {
        let [d, r, theta] = [0, 1, 2].map(|i| number(&row[i]));
        assert_near("offset", &[of_angle(theta).least_offset(0.0, 1.0 / r)], &[d], 1e-11);
        assert!(apart(&[of_angle(theta * 1.0001).least_offset(0.0, 1.0 / r)], &[d]) > 1e-5);
    }
}

#[test]
fn curvature_rises_to_the_middle_and_joins_straight_lines() {
    for theta in [1e-6, 0.3, -1.0, FRAC_PI_2, -2.5, 3.1] {
        let turn = of_angle(theta);
        let curve = turn.corner([1.0, 2.0], 0.7).unwrap();
        assert_eq!((curve.curvature(0.0), curve.curvature(1.0)), (0.0, 0.0));
        let extrema = curve.curvature_extrema();
        assert!(extrema.len() == 1 && (extrema[0] - 0.5).abs() < 1e-7, "{theta}: {extrema:?}");
        let corner = 2.0 * 0.7 - turn.length(0.7);
        assert!((corner - turn.saved(0.7)).abs() < 1e-15 && turn.saved(0.7) > 0.0);
        let middle = curve.point(0.5);
        assert_near("deviation", &[(middle[0] - 1.0).hypot(middle[1] - 2.0)], &[turn.deviation(0.7)], 1e-12);
        assert_near("tangent", &curve.tangent(1.0), &[theta.cos(), theta.sin()], 1e-15);
        assert_near("bound", &[turn.curvature(turn.reach_for_curvature(3.0)).abs()], &[3.0], 1e-15);
    }
}

/// Whether a polyline around a right-angled or other vertex at the origin, its legs `offset` from the sides, keeps a
/// clearance when rounded.
fn keeps(theta: f64, offset: f64, clearance: f64, most: f64) -> bool {
    let turn = of_angle(theta);
    let reach = turn.reach_for_curvature(most);
    // The corner is on the outer bisector, to the right of the mean direction.
    let (far, mean) = (offset / (0.5 * theta).cos(), 0.5 * theta);
    let at = [far * mean.sin(), -far * mean.cos()];
    let curve = turn.corner(at, reach).unwrap();
    let leg = |s: f64| [at[0] - s, at[1]];
    let points = (0..=20_000).map(|i| bezier(&curve, f64::from(i) / 20_000.0).point);
    let legs = (0..=20_000).map(|i| leg(reach + 4.0 * (clearance + far) * f64::from(i) / 20_000.0));
    points.chain(legs).all(|p| p[0].hypot(p[1]) >= clearance)
}

#[test]
fn offsets_are_enough_and_no_more() {
    let mut by_leg = 0;
    for theta in [0.1, 0.5, 1.0, FRAC_PI_2, 2.0, 2.6] {
        for (clearance, most) in [(0.0, 2.0), (0.1, 1.0), (0.5, 2.0), (0.5, 1.8), (0.5, 1.4), (1.0, 20.0)] {
            let offset = of_angle(theta).least_offset(clearance, most);
            by_leg += usize::from(offset == clearance && clearance > 0.0);
            let fits = |share: f64| keeps(theta, offset * share, clearance, most);
            assert!(clearance == 0.0 || fits(1.001) && !fits(0.998), "{theta} {clearance} {most}: {offset}");
            assert!(offset >= clearance * (1.0 - 1e-12), "{offset} {clearance}");
        }
    }
    assert!(by_leg > 3);
}

#[test]
fn turns_that_are_none() {
    assert!(Turn::new([1.0, 0.0], [-1.0, 0.0]).is_none() && Turn::new([0.0, 0.0], [1.0, 0.0]).is_none());
    assert!(Turn::new([1.0, f64::NAN], [1.0, 0.0]).is_none());
    let straight = Turn::new([3.0, 4.0], [3.0, 4.0]).unwrap();
    assert_eq!((straight.angle(), straight.curvature(1.0), straight.reach_for_curvature(1.0)), (0.0, 0.0, 0.0));
    assert!(straight.reach_for_offset(1.0).is_infinite());
    let back = Turn::new([1.0, 0.0], [-1.0, 1e-12]).unwrap();
    assert!((back.angle() - PI).abs() < 1e-11 && back.reach_for_curvature(1.0) > 1e10);
    let says = |reach: f64, at: [f64; 2], part: &str| {
        let error = straight.corner(at, reach).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    };
    says(0.0, [0.0, 0.0], "reach is 0;");
    says(f64::NAN, [0.0, 0.0], "NaN");
    says(1.0, [f64::INFINITY, 0.0], "`at`");
    says(1e308, [1e308, 0.0], "range of doubles");
}
