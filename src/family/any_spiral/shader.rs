//! What the shader `any_spiral.wgsl` reads.

use super::pair::Pair;
use super::{EXISTS, INFLECTION, RISING};
use crate::family::kernel::{constants, tables};
use crate::family::{Shader, ShaderInputs, outer};
use crate::grid::Grid;

/// Numbers of a pair and of a k1; the order is that of `evaluate`.
const PAIR_STRIDE: usize = 5;
const FIRST_STRIDE: usize = 3;
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
    let flags = [("EXISTS", EXISTS), ("RISING", RISING), ("INFLECTION", INFLECTION)];
    let strides = [("PAIR_STRIDE", PAIR_STRIDE), ("FIRST_STRIDE", FIRST_STRIDE)];
    let constants = constants(&flags, &strides, &[("MOST", MOST), ("OUTER", OUTER)]);
    let own = ("any_spiral.wgsl", include_str!("../../../shaders/any_spiral.wgsl"));
    Shader { constants, fragments: vec![outer::FRAGMENT, own] }
}

pub(super) fn inputs(grid: &Grid, sign: f64, start: u64, len: u64) -> ShaderInputs {
    let k2 = grid.axes()[3].values();
    // Which k2 lie below and not above a k1, as indices: at most 2^24, so exact in f32, as the values are not.
    let first = |k1: f64| {
        let (below, upto) = (k2.partition_point(|v| *v < k1), k2.partition_point(|v| *v <= k1));
        vec![curvature(k1), below as f32, upto as f32]
    };
    tables(grid, (start, len), |[first, beta]| pair_words(sign * first, beta), &[&first, &|v| vec![curvature(v)]])
}

fn curvature(value: f64) -> f32 {
    if value == 0.0 || (1.0 / MOST..=MOST).contains(&value.abs()) { value as f32 } else { TOO_FAR }
}

/// One row of the table; the last number is 0 when the pair is left to f64.
fn pair_words(alpha: f64, beta: f64) -> [f32; PAIR_STRIDE] {
    let row = |pair: &Pair, usable: f32| {
        let [sin0, sin1, square] = pair.sines.map(|s| s as f32);
        [sin0, sin1, square, pair.side as f32, usable]
    };
    let fits = |pair: &Pair| {
        let sine = |s: f64| s == 0.0 || s.abs() >= LEAST_SINE;
        pair.side == 0.0 || sine(pair.sines[0]) && sine(pair.sines[1]) && pair.sines[2] >= LEAST_SQUARE
    };
    match Pair::new(alpha, beta) {
        Some(pair) if fits(&pair) => row(&pair, 1.0),
        _ => [0.0; PAIR_STRIDE],
    }
}
