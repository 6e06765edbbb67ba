//! What the shaders `ph_equal_length.wgsl` and `ph_hermite.wgsl` read.

use super::{Kind, ONE_WAY, PAPER, PEAK_INSIDE, REGULAR};
use crate::family::kernel::{constants, tables};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
use crate::num::sines::{cos, sin};

/// Unit roundoff of f32.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// Roundings in a coefficient of `v σ² ∓ h`: products of w 1, sums and factors in a σ coefficient 6, so 15 in a product of two; the five
/// products' sums 5, v, the binomial and the factor 2 each 1, the difference 9 with the terms of h: 33, and a few for the error itself.
const SIDE: f64 = 40.0 * UNIT;
/// More than flushed denormals can do.
const TINY: f64 = 1e-30;
/// Speeds, and lengths over the chord less 1, outside 2^±20 are left to f64, and sines of half angles below 2^-60.
const MOST: f64 = (1u32 << 20) as f64;
const LEAST_SINE: f64 = 1.0 / (1u64 << 60) as f64;

fn stride(kind: Kind) -> usize {
    if kind == Kind::EqualLength { 11 } else { 5 }
}

pub(super) fn shader(kind: Kind) -> Shader {
    let flags = [("REGULAR", REGULAR), ("ONE_WAY", ONE_WAY), ("PEAK_INSIDE", PEAK_INSIDE), ("PAPER", PAPER)];
    let numbers = [("UNIT", UNIT), ("SIDE", SIDE), ("TINY", TINY)];
    let own = match kind {
        Kind::EqualLength => ("ph_equal_length.wgsl", include_str!("../../../shaders/ph_equal_length.wgsl")),
        Kind::Hermite => ("ph_hermite.wgsl", include_str!("../../../shaders/ph_hermite.wgsl")),
    };
    let shared = ("lib/ph_path.wgsl", include_str!("../../../shaders/lib/ph_path.wgsl"));
    Shader { constants: constants(&flags, &[("PAIR_STRIDE", stride(kind))], &numbers), fragments: vec![shared, own] }
}

pub(super) fn inputs(kind: Kind, grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let chunk = (start, len);
    match kind {
        Kind::EqualLength => tables(grid, chunk, |theta: [f64; 2]| sums(theta), &[&lengths]),
        Kind::Hermite => tables(grid, chunk, |theta: [f64; 2]| units(theta), &[&|l| vec![root(l)], &|l| vec![root(l)]]),
    }
}

/// `60 (S ± 1)`, or zeros.
fn lengths(length: f64) -> Vec<f32> {
    let over = length - 1.0;
    let fits = (1.0 / MOST..=MOST).contains(&over);
    [length + 1.0, over].map(|x| if fits { (60.0 * x) as f32 } else { 0.0 }).to_vec()
}

fn root(size: f64) -> f32 {
    if (1.0 / MOST..=MOST).contains(&size) { size.sqrt() as f32 } else { 0.0 }
}

/// Cosine and sine of half of each angle; then 1, or 0 where they do not fit f32.
fn units(theta: [f64; 2]) -> [f32; 5] {
    let [[c0, s0], [c1, s1]] = theta.map(half);
    let fits = [c0, s0, c1, s1].iter().all(|x| *x == 0.0 || x.abs() >= LEAST_SINE);
    [c0 as f32, s0 as f32, c1 as f32, s1 as f32, f32::from(u8::from(fits))]
}

fn half(theta: f64) -> [f64; 2] {
    let half = 0.5 * theta.abs();
    [cos(half), sin(half).copysign(theta)]
}

/// The same, and for each sign of w2 the two forms and g of `curves.rs`.
fn sums(theta: [f64; 2]) -> [f32; 11] {
    let [[c0, s0], last] = theta.map(half);
    let of = |sign: f64| {
        let [c1, s1] = last.map(|x| sign * x);
        let form = |x: f64, y: f64| 5.0 * (x - y) * (x - y) + 10.0 * (x * x + y * y);
        let g = 5.0 * (c0 * s1 + c1 * s0 - 3.0 * (c0 * s0 + c1 * s1));
        // What f32 would flush is nothing beside the other form.
        let floor = |x: f64| if x < 1e-30 { 0.0 } else { x };
        [floor(form(s0, s1)), floor(form(c0, c1)), g].map(|x| x as f32)
    };
    let ([a0, a1, a2, a3, usable], [p, q, g], [r, s, h]) = (units(theta), of(1.0), of(-1.0));
    [a0, a1, a2, a3, usable, p, q, g, r, s, h]
}
