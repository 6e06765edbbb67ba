//! Clearance and curvature at the very limit.

use super::*;

#[test]
fn verdicts_at_the_very_limit() {
    // A straight path, its distance from a side exact in doubles.
    let given =
        |clearance: f64| scene([0.0, 0.0], [8.0, 0.0], vec![vec![[2.0, 0.5], [5.0, 0.5], [3.0, 2.0]]], clearance, 1.0);
    let path = [line([0.0, 0.0], [8.0, 0.0])];
    let proved = |clearance: f64| prove(&given(clearance), &path);
    assert!(proved(0.5 - 1e-9).is_ok());
    // Exactly the clearance is kept, but doubles cannot prove it.
    for clearance in [0.5, 0.5 + 1e-12] {
        let error = proved(clearance).unwrap_err().to_string();
        assert!(error.contains("not proved") && error.contains("obstacles[0]"), "{error}");
    }
    assert!(audit(&given(0.4999), &path).is_ok() && audit(&given(0.5 + 1e-7), &path).is_err());
    // The curvature of a corner: its greatest is that of the middle to a few roundings.
    let turn = Turn::new([1.0, 0.0], [0.3, 1.0]).unwrap();
    let (at, reach) = ([2.0, 0.0], 1.5);
    let corner = turn.corner(at, reach).unwrap();
    let allowed = |share: f64| {
        let given = Scene {
            greatest_curvature: turn.curvature(reach) * share,
            ..scene(corner.start, corner.end, vec![], 0.0, 1.0)
        };
        prove(&given, &[corner])
    };
    assert!(allowed(1.0 + 1e-13).is_ok());
    let error = allowed(1.0 - 1e-13).unwrap_err().to_string();
    assert!(error.contains("span 0 has a curvature of"), "{error}");
}

#[test]
fn samples_that_miss_a_needle_fool_nobody() {
    // A needle reaches through the path between two of 2000 samples, or up to a hair's breadth of the clearance.
    let turn = Turn::new([1.0, 0.0], [0.0, 1.0]).unwrap();
    let corner = turn.corner([10.0, 0.0], 8.0).unwrap();
    let path = [line([0.0, 0.0], corner.start), corner, line(corner.end, [10.0, 12.0])];
    let t = 0.500_25;
    let (p, along) = (corner.point(t), corner.tangent(t));
    let place = |across: f64, ahead: f64| {
        [p[0] - along[1] * across + along[0] * ahead, p[1] + along[0] * across + along[1] * ahead]
    };
    let needle = |tip: f64| vec![vec![place(tip, 0.0), place(3.0, -1e-4), place(3.0, 1e-4)]];
    let given = |tip: f64, clearance: f64| scene([0.0, 0.0], [10.0, 12.0], needle(tip), clearance, 1.0);
    let sampled = |scene: &Scene| {
        (0..=2000).all(|i| apart_from_all(corner.point(f64::from(i) / 2000.0), &scene.obstacles) > 1e-4)
    };
    let through = given(-0.5e-4, 1e-5);
    assert!(sampled(&given(1e-4, 0.0)) && prove(&given(1e-4, 0.0), &path).is_ok());
    assert!(prove(&through, &path).is_err() && audit(&through, &path).is_err());
    for tip in [1e-3, 0.1, 0.5] {
        let clearance = tip + 1e-10;
        assert!(prove(&given(tip, tip - 1e-10), &path).is_ok());
        let error = prove(&given(tip, clearance), &path).unwrap_err().to_string();
        assert!(error.contains("is not proved"), "{error}");
        // Half a step from it no sample sees that.
        let scene = given(tip, clearance);
        assert!((0..=2000).all(|i| apart_from_all(corner.point(f64::from(i) / 2000.0), &scene.obstacles) >= clearance));
    }
    // And paths that do not lead there.
    assert!(prove(&given(0.1, 0.0), &path[..2]).unwrap_err().to_string().contains("not from `start` to `goal`"));
    let gap = [path[0], path[2]];
    assert!(prove(&given(0.1, 0.0), &gap).unwrap_err().to_string().contains("span 0 ends at"));
    assert!(prove(&given(0.1, 0.0), &[]).is_err());
}

#[test]
fn vehicles_in_step_on_planned_paths_are_told_apart_exactly() {
    // Lines and corners join with directions that differ by rounding; taken for corners, 400,000 stretches would not
    // do.
    let given = scene([-1.0, -0.8], [4.0, 3.7], field(&mut Noise(8), 4), 0.03, 9.0);
    let spans = plan(&given).unwrap().spans;
    let moved = |p: [f64; 2]| [p[0] + 0.3, p[1] + 0.4];
    let beside = spans.iter().map(|s| PhQuintic::between(moved(s.start), moved(s.end), s.preimage)).collect();
    let pair = [spans, beside].map(|spans| Motion::new(spans, 1.0, 0.0).unwrap());
    let found = separation(&pair[0], &pair[1], 0.5 - 1e-7).unwrap();
    let closest = found.closest;
    assert!(found.verdict == Verdict::Yes && (closest.at_most - 0.5).abs() < 1e-12, "{found:?}");
}
