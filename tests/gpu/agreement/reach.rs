use super::{Subject, grid, lin, log};
use spiral_atlas::family::reach::{Kind, Reach};
use spiral_atlas::grid::Grid;
use std::f64::consts::{FRAC_PI_2, PI};

pub(super) fn cubic() -> Subject {
    subject(&Reach(Kind::Cubic), FRAC_PI_2)
}

pub(super) fn ph() -> Subject {
    subject(&Reach(Kind::Ph), PI)
}

/// A plane of end points has more boundary than four axes have: 1 node in 100 may be open.
fn subject(family: &'static Reach, most: f64) -> Subject {
    Subject { family, grids: grids(most), nodes: 2_000_000, rare: 100, flag: 1, often: 100 }
}

/// Grids of end points for angles up to `most`.
fn grids(most: f64) -> Vec<(&'static str, Grid)> {
    vec![
        (
            "the paper's window",
            grid(vec![lin("theta", 0.05, 0.97 * most, 61), lin("xi", 0.005, 4.0, 151), lin("eta", 0.01, 4.0, 163)]),
        ),
        (
            "all signs, up to the largest angle",
            grid(vec![lin("theta", 0.01, most, 37), lin("xi", -3.0, 9.0, 107), lin("eta", -0.5, 6.0, 131)]),
        ),
        (
            "tiny and huge",
            grid(vec![log("theta", 1e-9, most, 41), log("xi", 1e-15, 1e9, 113), log("eta", 1e-18, 1e8, 127)]),
        ),
    ]
}
