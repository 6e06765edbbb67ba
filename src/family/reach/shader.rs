//! What the shaders read: constants and tables, generated from the same Rust as the f64 step.

use super::angle;
use super::filter::{LOOSE, Precision, SMALL, THROUGH_M, THROUGH_U, TRIED, least_drawn_m};
use super::poly::{LEAST_M, MONOTONE_M};
use super::{CASE_BITS, EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;

/// Coordinates other than 0 must lie above this and below its inverse, or they are left to f64.
const LEAST: f64 = 1e-12;
/// Coordinates are clamped to [`LEAST`] / 2 and its inverse, which the shader takes for what they are.
const KEPT: f64 = LEAST / 2.0;
/// m must stay below this, so that its third power stays in range.
const MOST_M: f64 = (1u32 << 30) as f64;
/// Constants of angles must lie within this and its inverse.
const MOST: f64 = (1u32 << 30) as f64;

pub(super) fn shader(kind: Kind) -> Shader {
    const P: Precision = Precision::F32;
    // Of each case, whose bits are CASE_BITS apart.
    let levels = [("EXISTS", EXISTS), ("EXACT", EXACT), ("THEOREM", THEOREM), ("PAPER", PAPER)];
    let levels = levels.map(|(name, bit)| (name, usize::from(bit)));
    let counts = [&levels[..], &[("CASE_BITS", CASE_BITS as usize)]].concat();
    let star = least_drawn_m(kind);
    let numbers = [
        ("UNIT", P.unit),
        ("SCALE", P.scale()),
        ("SIDE", P.side()),
        ("SHAPE", P.shape()),
        ("RESIDUAL", P.residual()),
        ("COEFFICIENT", P.coefficient()),
        ("FLOOR", P.floor),
        ("MOST_ALPHA", P.most_alpha),
        ("MOST_BETA", P.most_beta),
        ("LEAST_U", P.range_u.0),
        ("MOST_U", P.range_u.1),
        ("MOST_M", MOST_M),
        ("SMALL", SMALL),
        ("TRIED", TRIED),
        ("LOOSE", LOOSE),
        ("THROUGH_U", THROUGH_U),
        ("THROUGH_M", THROUGH_M),
        ("LEAST", LEAST),
        ("LEAST_M", LEAST_M),
        ("MONOTONE_M", MONOTONE_M),
        ("DRAWN_ABOVE", star * (1.0 + 4.0 * P.unit)),
        ("DRAWN_BELOW", star * (1.0 - 4.0 * P.unit)),
    ];
    let own = match kind {
        Kind::Cubic => fragment!("reach/poly_cubic.wgsl"),
        Kind::Ph => fragment!("reach/poly_ph.wgsl"),
    };
    Shader {
        constants: constants(&[], &counts, &numbers) + &Angle::wgsl(),
        fragments: vec![fragment!("lib/bernstein.wgsl"), fragment!("reach/filter.wgsl"), own],
    }
}

/// Angles of the chunk, then the axes of ξ and η.
pub(super) fn inputs(kind: Kind, grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let words = |v| vec![coordinate(v)];
    tables(grid, (start, len), |[theta]| Angle::new(kind, theta), &[&words, &words])
}

fn coordinate(value: f64) -> f32 {
    let kept = if value == 0.0 { 0.0 } else { value.signum() * value.abs().clamp(KEPT, 1.0 / KEPT) };
    kept as f32
}

record! {
    /// The constants of an angle, as [`angle::Angle`] has them.
    Angle {
        sin: f32,
        cos: f32,
        g: f32,
        to_alpha: f32,
        to_beta: f32,
        /// The constants fit f32; other angles are left to f64.
        usable: bool,
    }
}

impl Angle {
    fn new(kind: Kind, theta: f64) -> Angle {
        let Some(angle) = angle::Angle::new(kind, theta) else { return Angle::default() };
        let angle::Angle { sin, cos, g, to_alpha, to_beta, .. } = angle;
        if [sin, cos.abs(), g, to_alpha, to_beta].iter().any(|v| !(1.0 / MOST..=MOST).contains(v)) {
            return Angle::default();
        }
        let [sin, cos, g, to_alpha, to_beta] = [sin, cos, g, to_alpha, to_beta].map(|x| x as f32);
        Angle { sin, cos, g, to_alpha, to_beta, usable: true }
    }
}
