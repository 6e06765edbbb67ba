//! What the shader `cubic.wgsl` reads: constants and tables, generated from the same Rust as the f64 step.

use super::pair::Pair;
use super::poly::Bounds;
use super::precision::Precision;
use super::{ANY_SPIRAL, SOLVABLE, SPIRAL, THEOREM31, THEOREM31_ANY};
use crate::family::kernel::{constants, tables};
use crate::family::{Shader, ShaderInputs, outer};
use crate::grid::Grid;

/// Numbers of a pair in the table; the order is that of `read_pair`.
const PAIR_STRIDE: usize = 23;
/// f32 leaves a, k outside 2^±20 to f64: within, nothing overflows, and the smallest terms stay above the denormals.
const MOST: f64 = (1u32 << 20) as f64;
/// Constants of pairs must lie within 2^±30, apart from the two that may be 0 or negative.
const PAIR_MOST: f64 = (1u32 << 30) as f64;
/// Curvatures beyond this are left to f64: the product of two stays finite. The table holds at most twice as much, which the
/// shader sees to be beyond, in the normalised chart too: there a factor of at most 2^30 follows.
const KAPPA_MOST: f64 = 1e17;
/// Nonzero curvatures are at least this, so that none turns into 0; likewise left to f64.
const KAPPA_LEAST: f64 = 1e-24;

pub(super) fn shader() -> Shader {
    const P: Precision = Precision::F32;
    let flags = [
        ("SOLVABLE", SOLVABLE),
        ("THEOREM31", THEOREM31),
        ("THEOREM31_ANY", THEOREM31_ANY),
        ("SPIRAL", SPIRAL),
        ("ANY_SPIRAL", ANY_SPIRAL),
    ];
    let numbers = [
        ("UNIT", P.unit),
        ("THIRD", P.third()),
        ("DISCRIMINANT", P.discriminant()),
        ("OUTER", P.outer()),
        ("ETA", P.eta()),
        ("RESIDUAL", P.residual()),
        ("RESIDUAL_FLOOR", P.residual_floor()),
        ("MOST", MOST),
        ("LEAST", 1.0 / MOST),
        ("KAPPA_MOST", KAPPA_MOST),
    ];
    let constants = constants(&flags, &[("PAIR_STRIDE", PAIR_STRIDE)], &numbers);
    Shader {
        constants,
        fragments: vec![
            outer::FRAGMENT,
            ("lib/bernstein.wgsl", include_str!("../../../shaders/lib/bernstein.wgsl")),
            ("cubic.wgsl", include_str!("../../../shaders/cubic.wgsl")),
        ],
    }
}

/// Pairs of the chunk, then the third and fourth axis; the last offset is 1 in the normalised chart.
pub(super) fn inputs(grid: &Grid, normalised: bool, start: u64, len: u64) -> ShaderInputs {
    let pair = |[phi0, phi1]: [f64; 2]| pair_words(phi0, phi1, normalised);
    let words = |v| vec![curvature(v)];
    let mut inputs = tables(grid, (start, len), pair, &[&words, &words]);
    inputs.offsets[3] = u32::from(normalised);
    inputs
}

fn curvature(value: f64) -> f32 {
    let kept = if value == 0.0 { 0.0 } else { value.signum() * value.abs().clamp(KAPPA_LEAST, 2.0 * KAPPA_MOST) };
    kept as f32
}

/// One row of the table; the last flag is 0 when the pair is left to f64.
fn pair_words(phi0: f64, phi1: f64, normalised: bool) -> [f32; PAIR_STRIDE] {
    let mut row = [0.0; PAIR_STRIDE];
    let Some(pair) = Pair::new(phi0, phi1) else { return row };
    let sizes = [pair.g0, pair.g1, pair.curve0, pair.curve1, pair.sin0, pair.sin1, pair.r.abs().max(pair.p.abs())];
    if sizes.iter().any(|v| !(1.0 / PAIR_MOST..=PAIR_MOST).contains(v)) {
        return row;
    }
    let (start, end) = Bounds::of_pair(&pair, Precision::F32.gamma());
    // What turns the given curvature coordinates into the other two: a product either way, as divisions prove nothing.
    let [to0, to1] = [pair.curve0, pair.curve1].map(|c| if normalised { 1.0 / c } else { c });
    let constants = [pair.p, pair.r, pair.g0, pair.g1, to0, to1, pair.sin0, pair.sin1, pair.sin2_half];
    let flags = [f64::from(u8::from(pair.rising)), 1.0];
    // Bounds are rounded to f32 and then multiplied and added in f32: three more units.
    let bounds = [start.rounding, end.rounding, start.slope, end.slope].concat().into_iter().map(|b| b * (1.0 + 1e-6));
    for (word, value) in row.iter_mut().zip(constants.into_iter().chain(flags).chain(bounds)) {
        *word = value as f32;
    }
    row
}
