//! Curves by themselves: arc length, derivatives of curvature, extrema, end circles, the outer bound.

use super::{EPS, length, minus};
use proptest::prelude::*;
use spiral_atlas::curve::{CubicBezier, Jet, arc_length};
use spiral_atlas::family::any_spiral::least_end_curvature;
use spiral_atlas::transition::{EndCircle, Ends, direction_of};
use std::f64::consts::{FRAC_PI_2, PI};

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// The formula is `Q < 0` with `κ0 < κ1`, also where φ1 passes π/2.
    #[test]
    fn the_bound_is_the_invariant(
        phi0 in 0.01..1.5f64, more in 0.01..1.5f64, share in 0.0..2.0f64, kappa1 in 0.0..10.0f64,
    ) {
        let (phi1, kappa0) = (phi0 + more, share * phi0.sin());
        prop_assume!(phi0 + phi1 < PI - 0.01);
        let q = (kappa0 - phi0.sin()) * (kappa1 - phi1.sin()) + (0.5 * more).sin().powi(2);
        // Rounding of Q is below 8 EPS times its terms, at most 1 · 10 and 1.
        prop_assume!(q.abs() > 100.0 * EPS && (kappa0 - kappa1).abs() > 100.0 * EPS);
        let any = least_end_curvature(phi0, phi1, kappa0).is_some_and(|bound| kappa1 > bound);
        prop_assert_eq!(any, q < 0.0 && kappa0 < kappa1);
    }
}

#[test]
fn the_bound_has_the_values_of_the_three_cases() {
    let cases = [
        (0.7, 1.4, 0.0, 1.167964),
        (0.1, 1.5, 0.0, 5.154584),
        (0.8, 0.9, 0.0, 0.786809),
        (0.7, 1.4, 0.4, 1.466901),
        (0.1, 1.5, 0.035, 7.398768),
        (0.8, 0.9, 0.6, 0.804612),
    ];
    for (phi0, phi1, kappa0, bound) in cases {
        let close = |kappa0: f64| (least_end_curvature(phi0, phi1, kappa0).unwrap() - bound).abs() < 1e-6;
        assert!(close(kappa0) && !close(kappa0 + 1e-3));
        assert_eq!(least_end_curvature(phi0, phi1, phi0.sin()), None);
    }
}

/// Curves whose length is known in closed form or to 20 digits, each with it.
fn lengths() -> Vec<(&'static str, CubicBezier, f64)> {
    let bezier = |p: [[f64; 2]; 4]| CubicBezier { p };
    let cusp = 2.0 * (13f64.powf(1.5) - 8.0) / 27.0;
    vec![
        ("line", bezier([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]), 18f64.sqrt()),
        // (u, u²) for u in [0, 1].
        (
            "parabola",
            bezier([[0.0, 0.0], [1.0 / 3.0, 0.0], [2.0 / 3.0, 1.0 / 3.0], [1.0, 1.0]]),
            5f64.sqrt() / 2.0 + 2f64.asinh() / 4.0,
        ),
        // (u², u³) for u in [-1, 1]: a cusp in the middle; in [-1/2, 1]: one between the nodes of every halving, at
        // 1/3.
        ("cusp", bezier([[1.0, -1.0], [-1.0 / 3.0, 1.0], [-1.0 / 3.0, -1.0], [1.0, 1.0]]), cusp),
        (
            "cusp aside",
            bezier([[0.25, -0.125], [-0.25, 0.25], [0.0, -0.5], [1.0, 1.0]]),
            (13f64.powf(1.5) + 6.25f64.powf(1.5) - 16.0) / 27.0,
        ),
        // x = u² there and back: out to 1 and home.
        ("turning back", bezier([[1.0, 0.0], [-1.0 / 3.0, 0.0], [-1.0 / 3.0, 0.0], [1.0, 0.0]]), 2.0),
        // Example 1 of the paper, by quadrature with 40 digits.
        ("example", CubicBezier::from_ratios(0.7, 1.4, 1.66010274767, 0.76985066613), 2.297_628_051_381_841),
        ("point", bezier([[2.0, 2.0]; 4]), 0.0),
    ]
}

#[test]
fn arc_lengths_have_fourteen_digits() {
    for (name, curve, want) in lengths() {
        for size in [1.0, 1e-150, 1e150] {
            let scaled = CubicBezier { p: curve.p.map(|z| [z[0] * size, z[1] * size]) };
            let wrong = |got: f64| (got - want * size).abs() > 1e-14 * want * size;
            let got = scaled.length();
            assert!(!wrong(got), "{name}: {got} is not {}", want * size);
            assert!(want == 0.0 || wrong(got * (1.0 + 3e-14)), "{name}: the test cannot fail");
            let parts = scaled.length_between(0.0, 0.3) + scaled.length_between(0.3, 1.0);
            assert!(!wrong(parts) && scaled.length_between(0.3, 0.0) <= 0.0, "{name} in two parts: {parts}");
        }
    }
    let example = lengths()[5].1;
    assert!((example.length_between(0.0, 0.3) / 0.958_915_211_205_647_6 - 1.0).abs() < 1e-14);
    assert!((arc_length(|t| 5.0 * t.powi(4), 0.0, 2.0) - 32.0).abs() < 1e-13);
}

/// Derivatives of curvature against central differences of curvature, step 1e-4: error h²/6 κ''' + EPS κ / h.
#[test]
fn derivatives_of_curvature_are_those_of_curvature() {
    let curve = CubicBezier::from_ratios(0.7, 1.4, 1.66010274767, 0.76985066613);
    let h = 1e-4;
    for i in 1..20 {
        let t = f64::from(i) / 20.0;
        let rise = curve.curvature(t + h) - curve.curvature(t - h);
        let jet = curve.jet(t);
        let wrong = |dt: f64, ds: f64| {
            (dt - rise / (2.0 * h)).abs() > 1e-5 * dt.abs()
                || (ds - rise / curve.length_between(t - h, t + h)).abs() > 1e-5 * ds.abs()
        };
        assert!(!wrong(jet.curvature_dt(), jet.curvature_ds()), "at {t}");
        assert!(wrong(jet.curvature_dt() * 1.0001, jet.curvature_ds()), "at {t}");
        assert!(wrong(jet.curvature_dt(), Jet { third: [0.0; 2], ..jet }.curvature_ds()), "at {t}");
    }
}

#[test]
fn curvature_has_no_size_to_overflow_at() {
    let unit = CubicBezier::from_ratios(0.7, 1.4, 1.6, 0.8);
    for exponent in [-900, -500, 500, 900] {
        let size = 2f64.powi(exponent);
        let curve = CubicBezier { p: unit.p.map(|z| [z[0] * size, z[1] * size]) };
        for t in [0.0, 0.4, 1.0] {
            assert_eq!(curve.curvature(t), unit.curvature(t) / size);
            assert_eq!(curve.jet(t).curvature_dt(), unit.jet(t).curvature_dt() / size);
        }
        let wavy = CubicBezier::from_ratios(0.7, 0.7, 1.2, 1.2);
        assert_eq!(
            CubicBezier { p: wavy.p.map(|z| [z[0] * size, z[1] * size]) }.curvature_extrema(),
            wavy.curvature_extrema()
        );
    }
}

#[test]
fn extrema_are_where_the_derivative_changes_sign() {
    // Symmetrical: an extremum at 1/2, exactly.
    assert_eq!(CubicBezier::from_ratios(0.7, 0.7, 1.2, 1.2).curvature_extrema(), [0.5]);
    assert!(CubicBezier { p: [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]] }.curvature_extrema().is_empty());
    let mut seen = 0;
    for i in 1..15 {
        for j in 1..15 {
            let curve = CubicBezier::from_ratios(0.7, 1.4, 0.2 * f64::from(i), 0.2 * f64::from(j));
            let extrema = curve.curvature_extrema();
            for t in &extrema {
                let (before, after) = (curve.jet(t - 1e-6).curvature_dt(), curve.jet(t + 1e-6).curvature_dt());
                assert!(before * after < 0.0, "({i}, {j}) at {t}: {before} {after}");
            }
            let up = |n: i32| curve.jet(f64::from(n) / 1000.0).curvature_dt() > 0.0;
            let changes = (0..1000).filter(|n| up(*n) != up(n + 1)).count();
            assert_eq!(extrema.len(), changes, "({i}, {j})");
            seen += changes;
        }
    }
    assert!(seen > 100, "only {seen} extrema");
}

#[test]
fn end_circles_touch_their_ends() {
    let ends = Ends {
        start: [3.0, 4.0],
        end: [10.0, 4.0],
        start_direction: FRAC_PI_2,
        end_direction: -0.3,
        start_curvature: -0.5,
        end_curvature: 0.0,
    };
    let [EndCircle::Circle { centre, radius }, line] = ends.circles() else { panic!("{:?}", ends.circles()) };
    assert_eq!(radius, 2.0);
    // Up and turning right: the centre lies to the right.
    assert!(length(minus(centre, [5.0, 4.0])) < 4.0 * EPS && length(minus(centre, [1.0, 4.0])) > 3.9);
    assert_eq!(line, EndCircle::Line { point: [10.0, 4.0], direction: -0.3 });
    assert!(matches!(EndCircle::new([0.0; 2], 1.0, 1e-310), EndCircle::Line { .. }));
}

#[test]
fn directions_come_from_vectors_of_any_length() {
    assert_eq!(direction_of([0.0, 1e-320]).unwrap(), FRAC_PI_2);
    assert_eq!(direction_of([-1e300, 0.0]).unwrap(), PI);
    assert!((direction_of([1e300, 1e300]).unwrap() - PI / 4.0).abs() < EPS);
    for vector in [[0.0, -0.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        let message = direction_of(vector).unwrap_err().to_string();
        assert!(message.contains(&format!("({:?}, {:?})", vector[0], vector[1])), "{message}");
    }
}
