//! What the shader of `shaders/ph_quintic/` reads: constants and tables.

use super::FLAGS;
use super::factors::{ALONG, FAR, GAP, HEIGHT, LENGTH, SINGLE_GAP, SINGLE_POWERS, SINGLE_SLOPE, TENT};
use super::pair;
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
use crate::num::Ball;

/// Unit roundoff of f32.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// Relative error of a left-hand side against its right one, and of both sums in a slope. A slope is at most 2, so its
/// quotient is off by 4 of these; what they leave over is more than the 10 units of the quotient itself.
///
/// Roundings in the longest term, `2Cβ'² t⁶ Z³`: cos Φ 1, β' 3 (table, 1/(4 sin Φ), product), twice; their products 3;
/// t⁶ 5 and its product 1; three sums in the coefficient and around, Horner's rule 6; the right-hand side 1 and the
/// difference 1: 27. What is left is more than the factor 1.04 that [`HEIGHT`] proves for these.
const TERM: f64 = 36.0 * UNIT;
/// The quintic. Its longest term is a turn of `u t Z` and a speed of `u² Z²`, with `u = β't³`. Each u has 3 of β' and 3
/// of its products, 18 for all three. What else the speed is made of takes 8, one third included, the turn 2, their
/// product and its factor 2, and sums 3: 33.
const SHAPE: f64 = 40.0 * UNIT;
/// Sines and curvatures: one rounding, four operations, and a little for the f64 errors below.
const OUTER: f64 = 6.0 * UNIT;
/// Curvatures beyond this, or nonzero ones below [`LEAST_KAPPA`], are left to f64.
const MOST: f64 = (1u32 << 24) as f64;
const LEAST_KAPPA: f64 = 1.0 / (1u64 << 60) as f64;
/// Heights Z outside are left to f64: what is flushed below 2^-126 in a coefficient stays below 2^-50 in a sum that
/// must be at least [`LEAST`].
const MOST_Z: f64 = (1u32 << 24) as f64;
const LEAST_Z: f64 = 1.0 / MOST_Z;
/// Constants of a pair must be at least this.
const LEAST: f64 = 1.0 / (1u32 << 10) as f64;

pub(super) fn shader() -> Shader {
    let numbers = [
        ("UNIT", UNIT),
        ("TERM", TERM),
        ("SHAPE", SHAPE),
        ("OUTER", OUTER),
        ("MOST", MOST),
        ("MOST_Z", MOST_Z),
        ("LEAST_Z", LEAST_Z),
        ("FAR", FAR),
        ("HEIGHT", HEIGHT),
        ("SLOPE", SINGLE_SLOPE),
        ("GAP", GAP),
        ("GAP_ROUNDINGS", SINGLE_GAP),
        ("ALONG", ALONG),
        ("POWERS", SINGLE_POWERS),
        ("LENGTH", LENGTH),
        ("TENT", TENT),
    ];
    Shader {
        constants: constants(FLAGS, &[], &numbers) + &Pair::wgsl() + &Curvature::wgsl(),
        fragments: vec![
            fragment!("lib/outer.wgsl"),
            fragment!("lib/bernstein.wgsl"),
            fragment!("ph_quintic/curves.wgsl"),
            fragment!("ph_quintic/march.wgsl"),
            fragment!("ph_quintic/shape.wgsl"),
            fragment!("ph_quintic/truth.wgsl"),
        ],
    }
}

pub(super) fn inputs(grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let words = |kappa: f64| Curvature::new(kappa).words();
    tables(grid, (start, len), |[phi0, phi1]: [f64; 2]| Pair::new(phi0, phi1), &[&words, &words])
}

record! {
    /// A curvature.
    Curvature {
        kappa: f32,
        /// A power of two p for which κp³ is from 1/8 to 1 where κ is above 1.
        scale: f32,
        /// κp³.
        bend: f32,
    }
}

record! {
    /// The constants of a pair of angles, as [`pair::Pair`] has them.
    Pair {
        cos: f32,
        right: [f32; 2],
        /// `1/(4 sin Φ)`.
        quarter: f32,
        sines: [f32; 3],
        /// φ0 < φ1.
        rising: bool,
        /// The constants fit f32; other pairs are left to f64.
        usable: bool,
    }
}

impl Curvature {
    fn new(kappa: f64) -> Curvature {
        if kappa != 0.0 && !(LEAST_KAPPA..=MOST).contains(&kappa.abs()) {
            return Curvature { kappa: 2.0 * MOST as f32, scale: 1.0, bend: 0.0 };
        }
        let p = if kappa > 1.0 { 2f64.powi(-((kappa.log2() / 3.0).ceil() as i32)) } else { 1.0 };
        Curvature { kappa: kappa as f32, scale: p as f32, bend: (kappa * p.powi(3)) as f32 }
    }
}

impl Pair {
    fn new(phi0: f64, phi1: f64) -> Pair {
        let Some(pair) = pair::Pair::<Ball>::new(phi0, phi1) else { return Pair::default() };
        let [sin0, sin1, square] = pair.outer.map(|b| b.value);
        let [right0, right1] = pair.right.map(|b| b.value);
        let (sin, cos) = (pair.sin.value, pair.cos.value);
        let square_fits = !pair.rising || square >= LEAST * LEAST * LEAST * LEAST;
        if [sin0, sin1, right0, right1, sin, cos].iter().any(|v| *v < LEAST) || !square_fits {
            return Pair::default();
        }
        Pair {
            cos: cos as f32,
            right: [right0, right1].map(|x| x as f32),
            quarter: (0.25 / sin) as f32,
            sines: [sin0, sin1, square].map(|x| x as f32),
            rising: pair.rising,
            usable: true,
        }
    }
}
