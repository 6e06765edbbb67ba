//! The sides of control polygons: whether they meet the ends, wherever those lie, and whether curvature is monotone.

use super::EPS;
use proptest::prelude::*;
use spiral_atlas::curve::Jet;
use spiral_atlas::transition::{Ends, spiral};
use std::f64::consts::PI;

/// A spiral's ends in some position: turned, scaled and moved, mirrored and travelled backwards or not.
pub(super) fn ends(
    [phi0, phi1, kappa0, kappa1]: [f64; 4],
    turned: f64,
    half: f64,
    mirrored: bool,
    reversed: bool,
) -> Ends {
    let at = |x: f64| [3.0 + x * half * turned.cos(), -2.0 + x * half * turned.sin()];
    let side = if mirrored { -1.0 } else { 1.0 };
    let (first, last) = ((-side * phi0, side * kappa0 / half), (side * phi1, side * kappa1 / half));
    if reversed {
        return Ends {
            start: at(1.0),
            end: at(-1.0),
            start_direction: turned + last.0 + PI,
            end_direction: turned + first.0 + PI,
            start_curvature: -last.1,
            end_curvature: -first.1,
        };
    }
    Ends {
        start: at(-1.0),
        end: at(1.0),
        start_direction: turned + first.0,
        end_direction: turned + last.0,
        start_curvature: first.1,
        end_curvature: last.1,
    }
}

/// How far, relative to the curvature's own size, the curve is from its ends, and whether its curvature is monotone at
/// 400 points.
pub(super) fn check(ends: &Ends, legs: &[[f64; 2]]) -> (f64, bool) {
    let degree = legs.len() as f64;
    // The derivative, and the second, over the degree.
    let curvature = |t: f64| {
        let Jet { point: a, first: b, .. } = Jet::of_bezier(legs, t);
        (a[0] * b[1] - a[1] * b[0]) / (degree * a[0].hypot(a[1]).powi(3))
    };
    let last = legs.len() - 1;
    let turn = |leg: [f64; 2], direction: f64| (leg[1].atan2(leg[0]) - direction).sin().abs();
    // (n - 1)/n of the cross product of the first two sides over the cube of the first.
    let bend = |own: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (1.0 - 1.0 / degree) * (a[0] * b[1] - a[1] * b[0]) / own[0].hypot(own[1]).powi(3)
    };
    let sharp = ends.start_curvature.abs().max(ends.end_curvature.abs());
    let off = [
        turn(legs[0], ends.start_direction),
        turn(legs[last], ends.end_direction),
        (bend(legs[0], legs[0], legs[1]) - ends.start_curvature).abs() / sharp,
        (bend(legs[last], legs[last - 1], legs[last]) - ends.end_curvature).abs() / sharp,
    ];
    let growth = (ends.end_curvature - ends.start_curvature).signum();
    let curvatures: Vec<f64> = (0..=400).map(|i| growth * curvature(f64::from(i) / 400.0)).collect();
    (off.into_iter().fold(0.0, f64::max), curvatures.windows(2).all(|w| w[0] <= w[1] + 1e-12 * sharp))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        rng_seed: proptest::test_runner::RngSeed::Fixed(9),
        ..ProptestConfig::default()
    })]

    /// Also with an end tangent far shorter than the chord, where control points cannot.
    #[test]
    fn cubics_meet_their_ends(
        (phi0, phi1) in (0.05..1.3f64, 0.1..1.6f64), (x, y) in (0.0..1.0f64, 0.0..1.0f64), turned in -3.0..3.0f64,
        half in 0.1..50.0f64,
        mirrored: bool, reversed: bool,
    ) {
        let kappa0 = x * phi0.sin();
        let kappa1 = phi1.sin() * (1.0 + (16.0 * y * y).exp());
        let ends = ends([phi0, phi1, kappa0, kappa1], turned, half, mirrored, reversed);
        for solution in &spiral(&ends).unwrap().solutions {
            let (off, monotone) = check(&ends, &solution.legs);
            let straight = 1.0 - solution.f0.max(solution.f1) / 3.0;
            prop_assert!(off < 1e-14 / ((phi0 + phi1).sin() * straight), "{off}: {solution:?}");
            prop_assert!(off < 1e-12 || !solution.spiral, "{off}: {solution:?}");
            prop_assert!(monotone || !solution.spiral);
            // The sides and the control points are of one curve.
            let sides = solution.local_control_points.p.windows(2).map(|w| [w[1][0] - w[0][0], w[1][1] - w[0][1]]);
            let apart = sides.zip(&solution.legs).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
            prop_assert!(apart < 64.0 * EPS * half, "{apart}");
            let mut wrong = solution.legs;
            wrong[1] = wrong[1].map(|x| x * (1.0 + 1e-9));
            prop_assert!(check(&ends, &wrong).0 > 1e-10);
        }
    }
}
