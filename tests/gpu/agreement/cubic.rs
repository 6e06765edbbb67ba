use super::{Subject, grid, lin, log, values};
use spiral_atlas::family::cubic::{Cubic, Datum, SPIRAL, solve};
use spiral_atlas::grid::Grid;

/// More than ten million nodes in all: the family with the most work in its shader.
pub(super) fn subject() -> Subject {
    Subject { family: &Cubic, grids: grids(), nodes: 10_000_000, rare: 1000, flag: SPIRAL, often: 50 }
}

/// Grids with four different counts.
fn grids() -> Vec<(&'static str, Grid)> {
    vec![
        (
            "ordinary angles",
            grid(vec![
                lin("phi0", 0.05, 1.1, 41),
                lin("phi1", 0.1, 1.55, 53),
                lin("kappa0", 0.01, 0.9, 67),
                log("kappa1", 0.4, 80.0, 37),
            ]),
        ),
        (
            "beyond a right angle, signs of curvature, phi0 above phi1",
            grid(vec![
                lin("phi0", 0.02, 1.4, 23),
                lin("phi1", 0.03, 1.7, 29),
                lin("kappa0", -0.3, 1.3, 43),
                lin("kappa1", -1.0, 30.0, 61),
            ]),
        ),
        (
            "tiny angles and huge curvatures",
            grid(vec![
                log("phi0", 1e-9, 0.5, 19),
                log("phi1", 1e-7, 1.57, 37),
                log("kappa0", 1e-12, 10.0, 47),
                log("kappa1", 1e-6, 1e12, 59),
            ]),
        ),
        (
            "curvatures beyond f32, in both charts",
            grid(vec![
                values("phi0", &[1e-4, 0.7]),
                values("phi1", &[0.8, 1.4, 2.2]),
                values("kappa0", &[-1e300, -1e29, -1e-300, 0.0, 1e-300, 0.4, 1e16, 3e17, 1e300]),
                values("kappa1", &[-1e300, -1.0, 0.0, 1e-60, 1e-20, 4.0, 9e16, 1.1e17, 1e29, 1e300]),
            ]),
        ),
        (
            "a and k beyond f32",
            grid(vec![
                values("phi0", &[1e-4, 0.7]),
                values("phi1", &[0.8, 1.4, 2.2]),
                values("a", &[-1e300, -1e29, 1e-300, 0.35, 1e16, 1e300]),
                values("k", &[-1e300, 0.0, 1e-60, 1.0, 9e16, 1e29, 1e300]),
            ]),
        ),
        ("boundaries at the scale of f32", boundaries()),
        (
            "normalised, through cusp and fold",
            grid(vec![
                lin("phi0", 0.1, 0.9, 5),
                lin("phi1", 0.7, 1.5, 7),
                lin("a", 0.01, 0.5, 199),
                lin("k", 0.005, 1.0, 211),
            ]),
        ),
    ]
}

/// Values of κ1 packed around every boundary along κ1, a few f32 units apart: what an f32 bound that is too small gets
/// wrong.
fn boundaries() -> Grid {
    let (phi0, phi1, kappa0) = ([0.25, 0.6, 0.8], [0.9, 1.3, 1.65, 1.9], [0.08, 0.2, 0.33, 0.45, 0.6]);
    let mut kappa1 = Vec::new();
    for (phi0, phi1, kappa0) in phi0.iter().flat_map(|a| phi1.iter().flat_map(move |b| kappa0.map(|c| (*a, *b, c)))) {
        let verdict = |kappa1: f64| {
            let solutions = solve(&Datum { phi0, phi1, kappa0, kappa1 }).unwrap();
            (solutions.flags(), solutions.roots().iter().filter(|r| r.spiral).count(), solutions.roots().len())
        };
        let steps: Vec<f64> = (0..=60).map(|i| 0.3 * 1.12f64.powi(i)).collect();
        for pair in steps.windows(2) {
            let (mut low, mut high) = (pair[0], pair[1]);
            if verdict(low) == verdict(high) {
                continue;
            }
            while high - low > high * 1e-9 {
                let middle = 0.5 * (low + high);
                if verdict(middle) == verdict(low) { low = middle } else { high = middle }
            }
            kappa1.extend((-12..=12).map(|i| low * (1.0 + f64::from(i) * 3e-7)));
        }
    }
    kappa1.sort_by(f64::total_cmp);
    kappa1.dedup();
    assert!(kappa1.len() > 1000, "{} values", kappa1.len());
    grid(vec![values("phi0", &phi0), values("phi1", &phi1), values("kappa0", &kappa0), values("kappa1", &kappa1)])
}
