//! C² splines.

use super::*;
use spiral_atlas::path::{Spline, spline};

/// By how much neighbours differ in point, first or second derivative, relative to the largest at any joint.
fn jumps(spline: &Spline, closed: bool) -> f64 {
    let n = spline.spans.len();
    let joints: Vec<(Jet, Jet)> = (0..n - usize::from(!closed))
        .map(|i| (bezier(&spline.spans[i], 1.0), bezier(&spline.spans[(i + 1) % n], 0.0)))
        .collect();
    let values = |jets: Vec<&Jet>| jets.iter().flat_map(|j| [j.point, j.first, j.second]).flatten().collect::<Vec<_>>();
    apart(&values(joints.iter().map(|j| &j.0).collect()), &values(joints.iter().map(|j| &j.1).collect()))
}

/// By how much the integral of a span's pre-image misses its end, relative to its legs.
fn missed(spline: &Spline) -> f64 {
    let miss = |c: &PhQuintic| {
        let end = PhQuintic::new([0.0, 0.0], c.preimage).end;
        let want = [c.end[0] - c.start[0], c.end[1] - c.start[1]];
        let legs = c.preimage.iter().flatten().map(|x| x * x).sum::<f64>();
        (end[0] - want[0]).hypot(end[1] - want[1]) / legs
    };
    spline.spans.iter().map(miss).fold(0.0, f64::max)
}

#[test]
fn published_splines() {
    let all = published("spline");
    assert_eq!(all.as_array().unwrap().len(), 4);
    for row in all.as_array().unwrap() {
        let closed = row["closed"].as_bool().unwrap();
        let pts = points(&row["pts"]);
        let found = spline(&pts, closed).unwrap();
        let spans = &found.spans;
        let sum = |f: fn(&PhQuintic) -> f64| spans.iter().map(f).sum::<f64>();
        let got = [sum(PhQuintic::length), sum(PhQuintic::bending_energy), sum(PhQuintic::absolute_rotation)];
        assert_near("measures", &got, &[number(&row["S"]), number(&row["energy"]), number(&row["abs_rot"])], DIGITS);
        let middle: Vec<_> = spans.iter().map(|c| c.point(0.5)).collect();
        assert_near("middles", &flat(&middle), &flat(&points(&row["mid"])), DIGITS);
        let mut slopes: Vec<_> = spans.iter().map(|c| c.jet(0.0).first).collect();
        slopes.push(spans[spans.len() - 1].jet(1.0).first);
        assert_near("derivatives", &flat(&slopes), &flat(&points(&row["node_deriv"])), DIGITS);
        let sign =
            |c: &PhQuintic, d: &PhQuintic| c.preimage[2][0] * d.preimage[0][0] + c.preimage[2][1] * d.preimage[0][1];
        assert_eq!(sign(&spans[spans.len() - 1], &spans[0]) < 0.0 && closed, row["anti_periodic"].as_bool().unwrap());
        assert!(jumps(&found, closed) < 1e-13 && missed(&found) < 1e-14);
        // An open end is cubic: its third derivative is constant.
        if !closed {
            let thirds = [0.0, 1.0].map(|t| bezier(&spans[0], t).third);
            assert_near("a cubic end", &thirds[0], &thirds[1], 1e-10);
        }
    }
}

#[test]
fn checks_of_joints_can_fail() {
    let mut found = spline(&[[0.0, 0.0], [1.0, 0.3], [2.0, 0.0], [3.0, 1.0]], false).unwrap();
    assert!(jumps(&found, false) < 1e-14 && missed(&found) < 1e-15);
    found.spans[1].preimage[0][0] += 1e-9;
    assert!(jumps(&found, false) > 1e-11 && missed(&found) > 1e-11);
}

#[test]
fn few_points_and_straight_ones() {
    let line = spline(&[[1.0, 2.0], [4.0, 6.0]], false).unwrap();
    assert_eq!(line.spans.len(), 1);
    assert!((line.spans[0].length() - 5.0).abs() < 1e-14 && line.spans[0].absolute_rotation() < 1e-14);
    let three = spline(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]], false).unwrap();
    assert!(jumps(&three, false) < 1e-14 && missed(&three) < 1e-14);
    let straight: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
    let straight = spline(&straight, false).unwrap();
    assert!(straight.spans.iter().all(|s| s.absolute_rotation() < 1e-13));
    // A triangle, with and without the first point again; and a figure of eight, whose tangent turns by nothing in all.
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.9], [0.0, 0.0]];
    let closed = spline(&triangle, true).unwrap();
    assert_eq!(closed, spline(&triangle[..3], true).unwrap());
    assert!(jumps(&closed, true) < 1e-13);
    let turning = |s: &Spline| s.spans.iter().map(PhQuintic::rotation).sum::<f64>();
    assert!((turning(&closed) - std::f64::consts::TAU).abs() < 1e-12);
    let eight: Vec<[f64; 2]> =
        (0..16).map(|i| f64::from(i) * std::f64::consts::TAU / 16.0).map(|a| [a.sin(), (2.0 * a).sin()]).collect();
    let eight = spline(&eight, true).unwrap();
    assert!(jumps(&eight, true) < 1e-13 && turning(&eight).abs() < 1e-12);
}

#[test]
fn ten_thousand_points_at_once() {
    for closed in [false, true] {
        let n = 10_000;
        let at = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        let radius = |a: f64| 100.0 + 10.0 * (17.0 * a).sin() + 0.2 * (311.0 * a).cos();
        let pts: Vec<[f64; 2]> = (0..n).map(|i| [radius(at(i)) * at(i).cos(), radius(at(i)) * at(i).sin()]).collect();
        let found = spline(&pts, closed).unwrap();
        println!("{n} points, closed {closed}: {} steps", found.steps);
        assert!(jumps(&found, closed) < 1e-12 && missed(&found) < 1e-14);
    }
}

/// Bends fade away along a straight line, down to the least doubles.
#[test]
fn long_straight_lines_turn_by_next_to_nothing() {
    let corner = |n: i32| {
        let line = (0..n).map(|i| [f64::from(i - n), 0.0]);
        let found = spline(&line.chain([[0.0, 0.0], [0.0, 1.0], [0.0, 2.0]]).collect::<Vec<_>>(), false).unwrap();
        let sum = |f: fn(&PhQuintic) -> f64| found.spans.iter().map(f).sum::<f64>();
        [sum(PhQuintic::absolute_rotation), sum(PhQuintic::bending_energy), sum(PhQuintic::length) - f64::from(n)]
    };
    let short = corner(40);
    assert!(short[0] > 1.5 && short[1] > 1.0);
    for n in [200, 541, 542, 543, 1200] {
        assert_near("measures", &corner(n), &short, 1e-12 * f64::from(n));
    }
}

#[test]
fn random_points_give_a_right_curve_or_an_error() {
    let mut noise = Noise(11);
    let mut fine = 0;
    for i in 0..600 {
        let closed = i % 2 == 0;
        // From nearly even to hopeless.
        let wild = if i < 400 { f64::from(i) / 40.0 } else { 25.0 };
        let pts: Vec<[f64; 2]> = (0..3 + i % 12)
            .map(|k| {
                let [x, y] = noise.point();
                let a = f64::from(k) * 0.4;
                let size = (wild * noise.next()).exp();
                [a.cos() * 5.0 + x * wild * size, a.sin() * 5.0 + y * wild * size]
            })
            .collect();
        match spline(&pts, closed) {
            Ok(found) => {
                fine += 1;
                assert!(missed(&found) < 1e-12, "{} {pts:?}", missed(&found));
                assert!(jumps(&found, closed) < 1e-9, "{} {pts:?}", jumps(&found, closed));
            }
            Err(e) => {
                assert!(e.to_string().contains("did not converge") && e.to_string().contains("points["), "{e}");
            }
        }
    }
    assert!(fine > 350, "{fine}");
}

#[test]
fn what_has_no_spline_is_named() {
    let says = |pts: &[[f64; 2]], closed: bool, parts: &[&str]| {
        let error = spline(pts, closed).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    says(&[], false, &["0 points", "at least 2"]);
    says(&[[1.0, 1.0]], false, &["1 point;", "at least 2"]);
    says(&[], true, &["0 points", "at least 3"]);
    says(&[[1.0, 1.0], [2.0, 0.0]], true, &["2 points", "at least 3"]);
    says(&[[1.0, 1.0], [2.0, 0.0], [1.0, 1.0]], true, &["at least 3"]);
    says(&[[1.0, 1.0], [2.0, 0.0], [2.0, 0.0]], false, &["points[1] and points[2]", "[2.0, 0.0]"]);
    says(&[[1.0, 1.0], [f64::NAN, 0.0]], false, &["points[1]", "NaN"]);
    says(&[[-1e308, 1.0], [1e308, 0.0]], false, &["points[0]", "range of doubles"]);
}
