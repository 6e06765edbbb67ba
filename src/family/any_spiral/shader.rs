//! What the shader of `shaders/any_spiral/` reads.

use super::FLAGS;
use super::pair;
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;

/// Curvatures other than 0 outside 2^±60 are left to f64: within, no product overflows or underflows.
const MOST: f64 = (1u64 << 60) as f64;
/// What stands for such a curvature.
const TOO_FAR: f32 = 2.0 * MOST as f32;
/// Sines other than 0 below this are left to f64, and squares below its square root's.
const LEAST_SINE: f64 = 1.0 / (1u64 << 60) as f64;
const LEAST_SQUARE: f64 = LEAST_SINE / (1u32 << 20) as f64;
/// Relative error of sines and curvatures: one rounding, four operations, and a little for the f64 errors below.
const OUTER: f64 = 6.0 / (1u32 << 24) as f64;

pub(super) fn shader() -> Shader {
    let constants = constants(FLAGS, &[], &[("MOST", MOST), ("OUTER", OUTER)]) + &Pair::wgsl() + &First::wgsl();
    Shader { constants, fragments: vec![fragment!("lib/outer.wgsl"), fragment!("any_spiral/table.wgsl")] }
}

pub(super) fn inputs(grid: &Grid, sign: f64, start: u64, len: u64) -> ShaderInputs {
    let k2 = grid.axes()[3].values();
    // Which k2 lie below and not above a k1, as indices: at most 2^24, so exact in f32, as the values are not.
    let first = |k1: f64| {
        let (below, upto) = (k2.partition_point(|v| *v < k1), k2.partition_point(|v| *v <= k1));
        First { k1: curvature(k1), below: below as f32, upto: upto as f32 }.words()
    };
    tables(grid, (start, len), |[first, beta]| Pair::new(sign * first, beta), &[&first, &|v| vec![curvature(v)]])
}

fn curvature(value: f64) -> f32 {
    if value == 0.0 || (1.0 / MOST..=MOST).contains(&value.abs()) { value as f32 } else { TOO_FAR }
}

record! {
    /// The constants of a pair of angles, as [`pair::Pair`] has them.
    Pair {
        sines: [f32; 3],
        /// The sign of ω.
        side: f32,
        /// The constants fit f32; other pairs are left to f64.
        usable: bool,
    }
}

record! {
    /// A start curvature, and how many end curvatures lie below and not above it.
    First {
        k1: f32,
        below: f32,
        upto: f32,
    }
}

impl Pair {
    fn new(alpha: f64, beta: f64) -> Pair {
        let fits = |pair: &pair::Pair| {
            let sine = |s: f64| s == 0.0 || s.abs() >= LEAST_SINE;
            pair.side == 0.0 || sine(pair.sines[0]) && sine(pair.sines[1]) && pair.sines[2] >= LEAST_SQUARE
        };
        match pair::Pair::new(alpha, beta) {
            Some(pair) if fits(&pair) => {
                Pair { sines: pair.sines.map(|s| s as f32), side: pair.side as f32, usable: true }
            }
            _ => Pair::default(),
        }
    }
}
