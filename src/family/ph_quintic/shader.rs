//! What the shader `ph_quintic.wgsl` reads: constants and tables.

use super::pair::Pair;
use super::{ANY_SPIRAL, SOLVABLE, SPIRAL};
use crate::family::kernel::{constants, tables};
use crate::family::{Shader, ShaderInputs, outer};
use crate::grid::Grid;
use crate::num::Ball;

/// Numbers of a pair and of a curvature; the order is that of `evaluate`.
const PAIR_STRIDE: usize = 9;
const AXIS_STRIDE: usize = 3;
/// Unit roundoff of f32.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// Relative error of a left-hand side against its right one, and of each of the four sums in a slope.
///
/// Roundings in the longest term, `2Cβ'² t⁶ Z³`: cos Φ 1, β' 3 (table, 1/(4 sin Φ), product), twice; their products 3; t⁶ 5 and its
/// product 1; three sums in the coefficient and around, Horner's rule 6; the right-hand side 1 and the difference 1: 27.
const TERM: f64 = 36.0 * UNIT;
/// The quintic: α', β' 3 each, up to three of them in a term; cos Φ 1; some 18 products and sums; 1/3 is off by 1 more.
const SHAPE: f64 = 40.0 * UNIT;
/// Sines and curvatures: one rounding, four operations, and a little for the f64 errors below.
const OUTER: f64 = 6.0 * UNIT;
/// Curvatures beyond this, or nonzero ones below [`LEAST_KAPPA`], are left to f64.
const MOST: f64 = (1u32 << 24) as f64;
const LEAST_KAPPA: f64 = 1.0 / (1u64 << 60) as f64;
/// Heights Z outside are left to f64: what is flushed below 2^-126 in a coefficient stays below 2^-50 in a sum that must be at least
/// [`LEAST`].
const MOST_Z: f64 = (1u32 << 24) as f64;
const LEAST_Z: f64 = 1.0 / MOST_Z;
/// Constants of a pair must be at least this.
const LEAST: f64 = 1.0 / (1u32 << 10) as f64;

pub(super) fn shader() -> Shader {
    let flags = [("SOLVABLE", SOLVABLE), ("SPIRAL", SPIRAL), ("ANY_SPIRAL", ANY_SPIRAL)];
    let strides = [("PAIR_STRIDE", PAIR_STRIDE), ("AXIS_STRIDE", AXIS_STRIDE)];
    let numbers = [
        ("UNIT", UNIT),
        ("TERM", TERM),
        ("SHAPE", SHAPE),
        ("OUTER", OUTER),
        ("MOST", MOST),
        ("MOST_Z", MOST_Z),
        ("LEAST_Z", LEAST_Z),
    ];
    let constants = constants(&flags, &strides, &numbers);
    Shader {
        constants,
        fragments: vec![
            outer::FRAGMENT,
            ("lib/bernstein.wgsl", include_str!("../../../shaders/lib/bernstein.wgsl")),
            ("ph_quintic.wgsl", include_str!("../../../shaders/ph_quintic.wgsl")),
        ],
    }
}

pub(super) fn inputs(grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let words = |kappa: f64| axis_words(kappa).to_vec();
    tables(grid, (start, len), |[phi0, phi1]: [f64; 2]| pair_words(phi0, phi1), &[&words, &words])
}

/// κ, a power of two p, and κp³, from 1/8 to 1 for κ above 1.
fn axis_words(kappa: f64) -> [f32; AXIS_STRIDE] {
    if kappa != 0.0 && !(LEAST_KAPPA..=MOST).contains(&kappa.abs()) {
        return [2.0 * MOST as f32, 1.0, 0.0];
    }
    let p = if kappa > 1.0 { 2f64.powi(-((kappa.log2() / 3.0).ceil() as i32)) } else { 1.0 };
    [kappa as f32, p as f32, (kappa * p.powi(3)) as f32]
}

/// One row of the table; the last number is 0 when the pair is left to f64.
fn pair_words(phi0: f64, phi1: f64) -> [f32; PAIR_STRIDE] {
    let mut row = [0.0; PAIR_STRIDE];
    let Some(pair) = Pair::<Ball>::new(phi0, phi1) else { return row };
    let [sin0, sin1, square] = pair.outer.map(|b| b.value);
    let [right0, right1] = pair.right.map(|b| b.value);
    let (sin, cos) = (pair.sin.value, pair.cos.value);
    let square_fits = !pair.rising || square >= LEAST * LEAST * LEAST * LEAST;
    if [sin0, sin1, right0, right1, sin, cos].iter().any(|v| *v < LEAST) || !square_fits {
        return row;
    }
    let rising = f64::from(u8::from(pair.rising));
    for (word, value) in row.iter_mut().zip([cos, right0, right1, 0.25 / sin, sin0, sin1, square, rising, 1.0]) {
        *word = value as f32;
    }
    row
}
