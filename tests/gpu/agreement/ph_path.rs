use super::{Subject, grid, lin, log, values};
use spiral_atlas::family::ph_path::{Kind, ONE_WAY, PhPath};
use spiral_atlas::grid::{Axis, Grid};
use std::f64::consts::PI;

pub(super) fn equal_length() -> Subject {
    let angles = |m: usize, n: usize| [lin("theta0", -3.0, 3.1, m), lin("theta1", -2.9, 3.0, n)];
    let with = |[a, b]: [Axis; 2], c: Axis| grid(vec![a, b, c]);
    let grids = vec![
        ("all directions", with(angles(31, 33), log("S", 1.02, 6.0, 37))),
        (
            "nearly straight ahead",
            with([lin("theta0", -0.4, 0.5, 13), log("theta1", 1e-7, 0.5, 11)], log("S", 1.000002, 1.5, 29)),
        ),
        (
            "symmetric, and beyond f32",
            with(
                [values("theta0", &[-PI, -1.0, -1e-9, 0.0, 1.0]), values("theta1", &[-1.0, 0.0, 1e-9, 1.0, PI])],
                values("S", &[1.000001, 1.5, 1e6]),
            ),
        ),
    ];
    Subject { family: &PhPath(Kind::EqualLength), grids, nodes: 40_000, rare: 10, flag: ONE_WAY, often: 10 }
}

pub(super) fn hermite() -> Subject {
    let grids: Vec<(&'static str, Grid)> = vec![
        (
            "all directions",
            grid(vec![
                lin("theta0", -3.0, 3.1, 11),
                lin("theta1", -2.9, 3.0, 12),
                log("l0", 0.1, 12.0, 17),
                log("l1", 0.12, 11.0, 18),
            ]),
        ),
        (
            "small angles, unlike speeds",
            grid(vec![
                lin("theta0", -0.4, 0.5, 7),
                log("theta1", 1e-6, 0.5, 6),
                log("l0", 1e-3, 100.0, 13),
                log("l1", 1e-2, 1e3, 14),
            ]),
        ),
        (
            "lines, symmetric, and beyond f32",
            grid(vec![
                values("theta0", &[-1.0, 0.0, 1.0]),
                values("theta1", &[-1.0, 0.0, 1e-9, 1.0]),
                values("l0", &[1e-6, 1.0, 5.0, 1e6]),
                values("l1", &[1e-6, 1.0, 5.0, 6.0]),
            ]),
        ),
    ];
    Subject { family: &PhPath(Kind::Hermite), grids, nodes: 40_000, rare: 10, flag: ONE_WAY, often: 10 }
}
