use super::{Subject, grid, lin, log, values};
use spiral_atlas::family::any_spiral::{AnySpiral, EXISTS};
use spiral_atlas::grid::Grid;
use std::f64::consts::PI;

/// The first grid has angles that are opposite but for a rounding, too close for f32.
pub(super) fn subject() -> Subject {
    Subject { family: &AnySpiral, grids: grids(), nodes: 2_000_000, rare: 300, flag: EXISTS, often: 10 }
}

/// Grids with four different counts, angles of both signs and up to a half turn, opposite angles, equal curvatures,
/// zeros.
fn grids() -> Vec<(&'static str, Grid)> {
    vec![
        (
            "all angles",
            grid(vec![
                lin("alpha", -PI, PI, 25),
                lin("beta", -PI, PI, 29),
                lin("k1", -3.0, 3.0, 41),
                lin("k2", -3.0, 3.0, 61),
            ]),
        ),
        (
            "the cubic's chart",
            grid(vec![
                lin("phi0", -0.5, 1.1, 17),
                lin("phi1", -0.4, 2.0, 19),
                lin("kappa0", -1.0, 1.3, 43),
                log("kappa1", 1e-3, 80.0, 53),
            ]),
        ),
        (
            "tiny angles and huge curvatures",
            grid(vec![
                log("alpha", 1e-130, 1e-3, 14),
                values("beta", &[-1e-3, -1e-10, -1e-90, 0.0, 1e-150, 1e-20, 1e-9, 0.1]),
                values(
                    "k1",
                    &[-1e300, -1e19, -1.0, -1e-17, -1e-40, 0.0, 1e-300, 1e-3, 1.0, 1.0 + f64::EPSILON, 1e17, 1e300],
                ),
                values("k2", &[-1e200, -1e18, -1.0, -1e-5, 0.0, 1e-300, 1e-12, 1.0, 1.0 + f64::EPSILON, 1e19]),
            ]),
        ),
    ]
}
