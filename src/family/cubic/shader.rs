//! What the shader of `shaders/cubic/` reads: constants and tables, generated from the same Rust as the f64 step.

use super::FLAGS;
use super::pair;
use super::poly::Bounds;
use super::precision::{ENDS, Precision, ROUNDINGS, SMALL, THROUGH, THROUGH_X, TRIED};
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;

/// f32 leaves a, k outside 2^±20 to f64: within, nothing overflows, and the smallest terms stay above the denormals.
const MOST: f64 = (1u32 << 20) as f64;
/// Constants of pairs must lie within 2^±30, apart from the two that may be 0 or negative.
const PAIR_MOST: f64 = (1u32 << 30) as f64;
/// Curvatures beyond this are left to f64: the product of two stays finite. The table holds at most twice as much,
/// which the shader sees to be beyond, in the normalised chart too: there a factor of at most 2^30 follows.
const KAPPA_MOST: f64 = 1e17;
/// Nonzero curvatures are at least this, so that none turns into 0; likewise left to f64.
const KAPPA_LEAST: f64 = 1e-24;

pub(super) fn shader() -> Shader {
    const P: Precision = Precision::F32;
    let numbers = [
        ("UNIT", P.unit),
        ("THIRD", P.third()),
        ("DISCRIMINANT", P.discriminant()),
        ("OUTER", P.outer()),
        ("ETA", P.eta()),
        ("RESIDUAL", P.residual()),
        ("RESIDUAL_FLOOR", P.residual_floor()),
        ("ENDS", ENDS * P.unit),
        ("ROUNDINGS", ROUNDINGS * P.unit),
        ("TRIED", TRIED),
        ("SMALL", SMALL),
        ("THROUGH_X", THROUGH_X),
        ("THROUGH", THROUGH),
        ("MOST", MOST),
        ("LEAST", 1.0 / MOST),
        ("KAPPA_MOST", KAPPA_MOST),
    ];
    Shader {
        constants: constants(FLAGS, &[], &numbers) + &Pair::wgsl(),
        fragments: vec![
            fragment!("lib/outer.wgsl"),
            fragment!("lib/bernstein.wgsl"),
            fragment!("cubic/poly.wgsl"),
            fragment!("cubic/root.wgsl"),
            fragment!("cubic/filter.wgsl"),
        ],
    }
}

/// Pairs of the chunk, then the third and fourth axis; the last offset is 1 in the normalised chart.
pub(super) fn inputs(grid: &Grid, normalised: bool, start: u64, len: u64) -> ShaderInputs {
    let pair = |[phi0, phi1]: [f64; 2]| Pair::new(phi0, phi1, normalised);
    let words = |v| vec![curvature(v)];
    let mut inputs = tables(grid, (start, len), pair, &[&words, &words]);
    inputs.offsets[3] = u32::from(normalised);
    inputs
}

fn curvature(value: f64) -> f32 {
    let kept = if value == 0.0 { 0.0 } else { value.signum() * value.abs().clamp(KAPPA_LEAST, 2.0 * KAPPA_MOST) };
    kept as f32
}

record! {
    /// The constants of a pair of angles, as [`pair::Pair`] has them, and the bounds of its node's errors.
    Pair {
        p: f32,
        r: f32,
        g0: f32,
        g1: f32,
        /// a / κ0, or its inverse in the normalised chart.
        curve0: f32,
        /// k / κ1, or its inverse in the normalised chart.
        curve1: f32,
        sin0: f32,
        sin1: f32,
        sin2_half: f32,
        /// φ0 < φ1.
        rising: bool,
        /// The constants fit f32; other pairs are left to f64.
        usable: bool,
        rounding0: [f32; 3],
        rounding1: [f32; 3],
        slope0: [f32; 3],
        slope1: [f32; 3],
    }
}

impl Pair {
    fn new(phi0: f64, phi1: f64, normalised: bool) -> Pair {
        let Some(pair) = pair::Pair::new(phi0, phi1) else { return Pair::default() };
        let sizes = [pair.g0, pair.g1, pair.curve0, pair.curve1, pair.sin0, pair.sin1, pair.r.abs().max(pair.p.abs())];
        if sizes.iter().any(|v| !(1.0 / PAIR_MOST..=PAIR_MOST).contains(v)) {
            return Pair::default();
        }
        let (start, end) = Bounds::of_pair(&pair, Precision::F32.gamma());
        // What turns the given curvature coordinates into the other two: a product either way, as divisions prove
        // nothing.
        let [to0, to1] = [pair.curve0, pair.curve1].map(|c| if normalised { 1.0 / c } else { c });
        // Bounds are rounded to f32 and then multiplied and added in f32: three more units.
        let bound = |bounds: [f64; 3]| bounds.map(|b| (b * (1.0 + 1e-6)) as f32);
        Pair {
            p: pair.p as f32,
            r: pair.r as f32,
            g0: pair.g0 as f32,
            g1: pair.g1 as f32,
            curve0: to0 as f32,
            curve1: to1 as f32,
            sin0: pair.sin0 as f32,
            sin1: pair.sin1 as f32,
            sin2_half: pair.sin2_half as f32,
            rising: pair.rising,
            usable: true,
            rounding0: bound(start.rounding),
            rounding1: bound(end.rounding),
            slope0: bound(start.slope),
            slope1: bound(end.slope),
        }
    }
}
