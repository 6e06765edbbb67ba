//! What the shaders of `shaders/ph_path/` read.

use super::{FLAGS, Kind};
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
use crate::num::sines::{cos, sin};

/// Unit roundoff of f32.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// Roundings in a coefficient of `v σ² ∓ h`: products of w 1, sums and factors in a σ coefficient 6, so 15 in a product
/// of two; the five products' sums 5, v, the binomial and the factor 2 each 1, the difference 9 with the terms of h:
/// 33, and a few for the error itself.
const SIDE: f64 = 40.0 * UNIT;
/// Of a modulus as computed: no less than the true one. The square root is good to nine units, and what is under it to
/// two.
const MODULUS: f64 = 1.001;
/// Errors e of w, over the largest modulus m, from here on say nothing: the next three factors are for less.
const FAR: f64 = 0.005;
/// Of `v m³ e`: how far a coefficient of `v σ²` may be off. It is a mean of products of four w, and `(m + e)⁴ - m⁴` is
/// at most 4.04 m³ e.
const FOURTH: f64 = 4.1;
/// Of `m e`: how far a coefficient of h may be off. It is a mean of terms up to `4 |w_i| |w_k|`, and `4 (m + e)² - 4
/// m²` is at most 8.02 m e.
const TURN: f64 = 8.2;
/// Of `m⁴` and the error of v: `(m + e)⁴` is at most 1.021 m⁴.
const LIMIT: f64 = 1.1;
/// Of the error e of h's coefficients and the size s of the largest: how far `h0 h2 - h1²` may be off. At its least it
/// is `(h0 - e)(h2 - e) - (|h1| + e)²`, where the squares of e cancel, and so they do at its greatest: so it is off by
/// `e (h0 + h2 + 2 |h1|)` at most, which is 4 s e.
const GAP: f64 = 4.1;
/// Of the error of √Z: a quarter of it is in w1.
const QUARTER: f64 = 0.26;
/// Of the errors of w0 and w2, for three quarters of both in w1.
const ENDS: f64 = 1.6;
/// Of a comparison's larger side: no product of three or four numbers is off by so much.
const ABOVE: f64 = 1.00001;
const UNDER: f64 = 2.0 - ABOVE;
/// More than flushed denormals can do.
const TINY: f64 = 1e-30;
/// Speeds, and lengths over the chord less 1, outside 2^±20 are left to f64, and sines of half angles below 2^-60.
const MOST: f64 = (1u32 << 20) as f64;
const LEAST_SINE: f64 = 1.0 / (1u64 << 60) as f64;

pub(super) fn shader(kind: Kind) -> Shader {
    let numbers = [
        ("UNIT", UNIT),
        ("SIDE", SIDE),
        ("TINY", TINY),
        ("MODULUS", MODULUS),
        ("FAR", FAR),
        ("FOURTH", FOURTH),
        ("TURN", TURN),
        ("LIMIT", LIMIT),
        ("GAP", GAP),
        ("QUARTER", QUARTER),
        ("ENDS", ENDS),
        ("ABOVE", ABOVE),
        ("UNDER", UNDER),
    ];
    let shared = [fragment!("ph_path/hodograph.wgsl"), fragment!("ph_path/truth.wgsl")];
    let (record, own) = match kind {
        Kind::EqualLength => {
            (Units::wgsl() + &Sums::wgsl() + &Lengths::wgsl(), fragment!("ph_path/curves_of_length.wgsl"))
        }
        Kind::Hermite => (Units::wgsl(), fragment!("ph_path/curves_of_speeds.wgsl")),
    };
    Shader {
        constants: constants(FLAGS, &[], &numbers) + &record,
        fragments: shared.into_iter().chain([own]).collect(),
    }
}

pub(super) fn inputs(kind: Kind, grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let chunk = (start, len);
    match kind {
        Kind::EqualLength => tables(grid, chunk, Sums::new, &[&|length| Lengths::new(length).words()]),
        Kind::Hermite => tables(grid, chunk, Units::new, &[&|l| vec![root(l)], &|l| vec![root(l)]]),
    }
}

record! {
    /// A length S.
    Lengths {
        /// `60 (S + 1)`, or 0 where it is left to f64.
        p0: f32,
        /// `60 (S - 1)`.
        q0: f32,
    }
}

record! {
    /// Cosine and sine of half of each angle.
    Units {
        first: [f32; 2],
        last: [f32; 2],
        /// They fit f32; other pairs are left to f64.
        usable: bool,
    }
}

record! {
    /// The same, and for each sign of w2, the positive one first, the two forms and g of `curves.rs`.
    Sums {
        first: [f32; 2],
        last: [f32; 2],
        /// They fit f32; other pairs are left to f64.
        usable: bool,
        forms: [f32; 3],
        other_forms: [f32; 3],
    }
}

impl Lengths {
    fn new(length: f64) -> Lengths {
        let over = length - 1.0;
        if !(1.0 / MOST..=MOST).contains(&over) {
            return Lengths::default();
        }
        Lengths { p0: (60.0 * (length + 1.0)) as f32, q0: (60.0 * over) as f32 }
    }
}

fn root(size: f64) -> f32 {
    if (1.0 / MOST..=MOST).contains(&size) { size.sqrt() as f32 } else { 0.0 }
}

fn half(theta: f64) -> [f64; 2] {
    let half = 0.5 * theta.abs();
    [cos(half), sin(half).copysign(theta)]
}

impl Units {
    fn new(theta: [f64; 2]) -> Units {
        let [first, last] = theta.map(half);
        let usable = first.iter().chain(&last).all(|x| *x == 0.0 || x.abs() >= LEAST_SINE);
        Units { first: first.map(|x| x as f32), last: last.map(|x| x as f32), usable }
    }
}

impl Sums {
    fn new(theta: [f64; 2]) -> Sums {
        let [[c0, s0], end] = theta.map(half);
        let forms = |sign: f64| {
            let [c1, s1] = end.map(|x| sign * x);
            let form = |x: f64, y: f64| 5.0 * (x - y) * (x - y) + 10.0 * (x * x + y * y);
            let g = 5.0 * (c0 * s1 + c1 * s0 - 3.0 * (c0 * s0 + c1 * s1));
            // What f32 would flush is nothing beside the other form.
            let floor = |x: f64| if x < 1e-30 { 0.0 } else { x };
            [floor(form(s0, s1)), floor(form(c0, c1)), g].map(|x| x as f32)
        };
        let Units { first, last, usable } = Units::new(theta);
        Sums { first, last, usable, forms: forms(1.0), other_forms: forms(-1.0) }
    }
}
