use super::{Subject, grid, lin, values};
use spiral_atlas::family::trig_quintic::{SPIRAL, TrigQuintic};
use spiral_atlas::grid::Grid;
use std::f64::consts::FRAC_PI_2;

/// A polynomial of degree 37 brings more rounding than the other families have: 1 node in 25 may be open.
pub(super) fn subject() -> Subject {
    Subject { family: &TrigQuintic, grids: grids(), nodes: 67_000, rare: 25, flag: SPIRAL, often: 10 }
}

/// Five axes of different counts; the paper's own data, ties of the plain flags and all ends of the domain among the
/// nodes.
fn grids() -> Vec<(&'static str, Grid)> {
    vec![
        (
            "around the thresholds",
            grid(vec![
                lin("ratio", 3.0, 9.0, 5),
                lin("theta", 0.1, 1.5, 7),
                lin("m", 0.3, 6.0, 9),
                lin("p", -3.9, 1.0, 11),
                lin("q", -3.9, 1.0, 19),
            ]),
        ),
        (
            "ties and ends",
            grid(vec![
                values("ratio", &[1e-5, 2.5, 3.5, 3.5f64.next_up(), 6.0, 30.0, 1e4, 1e13]),
                values("theta", &[1e-300, 1e-5, 42f64.to_radians(), FRAC_PI_2]),
                values("m", &[1e-3, 0.3, 1.0, 1.0f64.next_up(), 1e3]),
                values("p", &[(-4.0f64).next_up(), -3.9999999, 1.0]),
                values("q", &[(-4.0f64).next_up(), -3.99, -1.0, -0.14, 0.125, 0.125f64.next_up(), 1.0]),
            ]),
        ),
    ]
}
