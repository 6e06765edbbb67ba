//! The oracle, and then the library, against reference data that neither of them made.

use crate::oracle::compare::Tally;
use crate::oracle::data::Case;
use crate::oracle::{
    ANY_SPIRAL, Ends, SOLVABLE, SPIRAL, THEOREM31, THEOREM31_ANY, Verdict, h_values, in_domain, judge,
};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
struct Point {
    phi0: f64,
    phi1: f64,
    kappa0: f64,
    kappa1: f64,
    solvable_paper: bool,
    roots: Vec<(f64, f64)>,
    thm31: Vec<bool>,
    spiral: Vec<bool>,
    thm31_paper: bool,
    thm31_any: bool,
    spiral_any: bool,
    kneser: bool,
    gap: f64,
}

impl Point {
    fn case(&self) -> Case {
        let Point { phi0, phi1, kappa0, kappa1, .. } = *self;
        Case { phi0, phi1, ends: Ends::Curvature { kappa0, kappa1 } }
    }
}

#[derive(Deserialize)]
struct Edge {
    flag: String,
    phi0: f64,
    phi1: f64,
    kappa0: f64,
    kappa1_true: f64,
    kappa1_false: f64,
}

fn points() -> Vec<Point> {
    serde_json::from_str(include_str!("../fixtures/cubic_points.json")).expect("valid fixtures")
}

fn edges() -> Vec<Edge> {
    serde_json::from_str(include_str!("../fixtures/cubic_edges.json")).expect("valid fixtures")
}

fn bit(flag: &str) -> u8 {
    match flag {
        "solvable_paper" => SOLVABLE,
        "thm31_paper" => THEOREM31,
        "thm31_any" => THEOREM31_ANY,
        "spiral_any" => SPIRAL,
        "kneser" => ANY_SPIRAL,
        _ => panic!("no flag `{flag}`"),
    }
}

/// Everything in which a verdict differs from a reference point.
fn point_faults(p: &Point, v: &Verdict) -> Vec<&'static str> {
    let roots: Vec<(f64, f64)> = v.roots.iter().map(|r| (r.f0, r.f1)).collect();
    let checks = [
        ("solvable_paper", p.solvable_paper == (v.flags & SOLVABLE != 0)),
        ("thm31_paper", p.thm31_paper == (v.flags & THEOREM31 != 0)),
        ("thm31_any", p.thm31_any == (v.flags & THEOREM31_ANY != 0)),
        ("spiral_any", p.spiral_any == (v.flags & SPIRAL != 0)),
        ("kneser", p.kneser == (v.flags & ANY_SPIRAL != 0)),
        ("roots", p.roots == roots),
        ("thm31", p.thm31 == v.roots.iter().map(|r| r.theorem31).collect::<Vec<_>>()),
        ("spiral", p.spiral == v.roots.iter().map(|r| r.spiral).collect::<Vec<_>>()),
    ];
    checks.into_iter().filter(|(_, same)| !same).map(|(name, _)| name).collect()
}

#[test]
fn the_oracle_agrees_with_every_reference_point() {
    let points = points();
    assert_eq!(points.len(), 378);
    for p in &points {
        let v = judge(p.phi0, p.phi1, p.kappa0, p.kappa1);
        assert_eq!(point_faults(p, &v), [""; 0], "{p:?}: {v:?}");
        assert!(v.gap > 0.0 && p.gap > 0.0);
    }
}

#[test]
fn a_changed_reference_point_is_noticed() {
    let point = points().into_iter().find(|p| p.roots.len() == 3).expect("one with three roots");
    let v = judge(point.phi0, point.phi1, point.kappa0, point.kappa1);
    let changed = |change: fn(&mut Point)| {
        let mut p = point.clone();
        change(&mut p);
        point_faults(&p, &v)
    };
    assert_eq!(changed(|_| ()), [""; 0]);
    assert_eq!(changed(|p| p.solvable_paper ^= true), ["solvable_paper"]);
    assert_eq!(changed(|p| p.thm31_paper ^= true), ["thm31_paper"]);
    assert_eq!(changed(|p| p.thm31_any ^= true), ["thm31_any"]);
    assert_eq!(changed(|p| p.spiral_any ^= true), ["spiral_any"]);
    assert_eq!(changed(|p| p.kneser ^= true), ["kneser"]);
    assert_eq!(changed(|p| p.roots[1].0 = p.roots[1].0.next_up()), ["roots"]);
    assert_eq!(changed(|p| p.thm31[2] ^= true), ["thm31"]);
    assert_eq!(changed(|p| p.spiral[0] ^= true), ["spiral"]);
}

#[test]
fn the_oracle_flips_between_the_doubles_of_every_edge() {
    let edges = edges();
    assert_eq!(edges.len(), 25);
    for e in &edges {
        let bit = bit(&e.flag);
        let at = |kappa1| judge(e.phi0, e.phi1, e.kappa0, kappa1).flags & bit != 0;
        assert!(at(e.kappa1_true), "{} at {:?}, {:?}, {:?}", e.flag, e.phi0, e.phi1, e.kappa0);
        assert!(!at(e.kappa1_false), "{} at {:?}, {:?}, {:?}", e.flag, e.phi0, e.phi1, e.kappa0);
        let apart = e.kappa1_true.to_bits().abs_diff(e.kappa1_false.to_bits());
        assert_eq!(apart, 1, "{} at {:?}", e.flag, e.phi0);
    }
}

/// The values in formulas of the spiral polynomial, at (f0, f1) = (1.3, 2.1), (φ0, φ1) = (0.7, 1.4); the oracle's are a
/// multiple of them.
#[test]
fn the_oracle_has_the_coefficients_of_the_spiral_polynomial() {
    let want = [-29.99579513, 42.85656703, 99.3175796, 72.19561479, 16.18816876, -0.21045624];
    let got = h_values(0.7, 1.4, 1.3, 2.1);
    let factor = got[2] / want[2];
    assert!(factor > 0.0);
    for (want, got) in want.iter().zip(got) {
        assert!((got / factor - want).abs() < 2e-8, "{} is not {want}", got / factor);
    }
}

/// The three examples of the paper's section 4, with (f0, f1) to 10 decimals.
#[test]
fn the_oracle_accepts_the_examples_of_the_paper() {
    let examples = [
        (0.7, 1.4, 0.4, 4.0, 1.66010274767, 0.76985066613),
        (0.1, 1.5, 0.035, 100.0, 2.60727801728, 0.62666697883),
        (0.8, 0.9, 0.6, 0.874, 1.69966006964, 1.49236264052),
    ];
    for (phi0, phi1, kappa0, kappa1, f0, f1) in examples {
        let v = judge(phi0, phi1, kappa0, kappa1);
        assert_eq!(v.flags, SOLVABLE | THEOREM31 | THEOREM31_ANY | SPIRAL | ANY_SPIRAL);
        assert_eq!(v.solutions(), 1 | 1 << 2);
        assert!((v.roots[0].f0 - f0).abs() < 1e-10 && (v.roots[0].f1 - f1).abs() < 1e-10);
        assert!(v.roots[0].theorem31 && v.roots[0].spiral && v.roots[0].margin > 0.0);
    }
}

#[test]
fn the_oracle_knows_its_domain() {
    assert!(in_domain(1.0, 2.0) && in_domain(1e-300, 3.0) && in_domain(5e-324, 5e-324));
    // The double nearest to π is below π, its successor above.
    assert!(in_domain(5e-324, std::f64::consts::PI) && !in_domain(5e-324, std::f64::consts::PI.next_up()));
    assert!(!in_domain(0.0, 1.0) && !in_domain(1.0, -1.0) && !in_domain(2.0, 2.0) && !in_domain(f64::NAN, 1.0));
}

#[test]
fn the_library_agrees_with_every_reference_point_and_edge() {
    let mut tally = Tally::default();
    for p in points() {
        let v = tally.case(&p.case());
        assert_eq!(point_faults(&p, &v), [""; 0]);
    }
    for e in edges() {
        for kappa1 in [e.kappa1_true, e.kappa1_false] {
            tally.case(&Case { phi0: e.phi0, phi1: e.phi1, ends: Ends::Curvature { kappa0: e.kappa0, kappa1 } });
        }
    }
    tally.finish("reference data", 378 + 2 * 25);
}
