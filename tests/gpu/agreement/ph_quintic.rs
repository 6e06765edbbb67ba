use super::{Subject, grid, lin, log, values};
use spiral_atlas::family::ph_quintic::{PhQuintic, SPIRAL};
use spiral_atlas::grid::Grid;

pub(super) fn subject() -> Subject {
    Subject { family: &PhQuintic, grids: grids(), nodes: 500_000, rare: 100, flag: SPIRAL, often: 50 }
}

/// Grids of four different counts.
fn grids() -> Vec<(&'static str, Grid)> {
    vec![
        (
            "ordinary angles",
            grid(vec![
                lin("phi0", 0.05, 1.1, 13),
                lin("phi1", 0.1, 1.55, 17),
                lin("kappa0", 0.01, 0.9, 29),
                log("kappa1", 0.4, 80.0, 37),
            ]),
        ),
        (
            "beyond a right angle, signs of curvature, phi0 above phi1",
            grid(vec![
                lin("phi0", 0.02, 1.4, 11),
                lin("phi1", 0.03, 1.7, 13),
                lin("kappa0", -0.3, 1.2, 31),
                lin("kappa1", -1.0, 30.0, 32),
            ]),
        ),
        (
            "tiny angles and huge curvatures",
            grid(vec![
                log("phi0", 1e-9, 0.5, 11),
                log("phi1", 1e-7, 1.57, 14),
                log("kappa0", 1e-12, 10.0, 29),
                log("kappa1", 1e-6, 1e12, 31),
            ]),
        ),
        (
            "curvatures beyond f32, and none",
            grid(vec![
                values("phi0", &[1e-4, 0.7]),
                values("phi1", &[0.8, 1.4, 2.2]),
                values("kappa0", &[-1e300, -1e29, -1e-300, 0.0, 1e-300, 0.4, 1e16, 3e17, 1e300]),
                values("kappa1", &[-1e300, -1.0, 0.0, 1e-60, 1e-20, 4.0, 9e16, 1.1e17, 1e29, 1e300]),
            ]),
        ),
    ]
}
