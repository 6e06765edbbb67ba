//! What the shader of `shaders/trig_quintic/` reads.

use super::FLAGS;
use super::filter::coefficient_error;
use super::plain::{PRINTED_Q, end_slope, printed_ratio};
use super::poly::{BERNSTEIN, Frame, K};
use crate::family::kernel::{constants, fragment, tables};
use crate::family::record::{Record, record};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
use std::cmp::Ordering::Less;

/// Halvings of a piece: one of 2^-10 shows features that the error of f32 coefficients does not hide anyway.
const MOST_LEVELS: usize = 10;
/// Halvings of one polynomial in all; see `positive` in the shader.
const MOST_HALVINGS: usize = 32;
/// 2^-24.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// m, y and their inverses stay below this, and `1/(4 + p)`, `1/(4 + q)` below [`MOST_END`]. Then the sides,
/// normalised, lie within 2^-42 and 1 and the hodograph's coefficients between 2^-66 and 170.
const MOST: f64 = (1u32 << 10) as f64;
const MOST_END: f64 = (1u32 << 20) as f64;
/// Words come rounded from doubles, sides are normalised (one operation more), and so are Bernstein factors.
const ERROR: f64 = (coefficient_error([1.1, 1.1, 1.1], 1.0, 2.0) + 1.0) * UNIT;
/// What flushed denormals may do to a coefficient: D is off by 2^-120, each of up to 21 terms has an X below 2^22 and a
/// factor of up to 60, and of those sums there are seven.
const FLOOR: f64 = 1.0 / (1u128 << 80) as f64;

pub(super) fn shader() -> Shader {
    let counts = [("COEFFICIENTS", K), ("MOST_LEVELS", MOST_LEVELS), ("MOST_HALVINGS", MOST_HALVINGS)];
    let constants = constants(FLAGS, &counts, &[("UNIT", UNIT), ("ERROR", ERROR), ("FLOOR", FLOOR)]);
    Shader {
        constants: constants + &Pair::wgsl() + &End::wgsl(),
        fragments: vec![fragment!("trig_quintic/poly.wgsl"), fragment!("trig_quintic/filter.wgsl")],
    }
}

/// The factors of Bernstein's basis, then pairs, then the axes of m, p and q.
pub(super) fn inputs(grid: &Grid, start: u64, len: u64) -> ShaderInputs {
    let [ratios, _, m, _, q] = grid.axes() else { return ShaderInputs { words: vec![], offsets: [0; 4] } };
    let (m, q) = (m.values(), q.values());
    // How many m and q have a flag, which those of larger values lack; at most 2^24, exact in f32.
    let firsts: Vec<(f64, [f32; 2])> = ratios
        .values()
        .iter()
        .map(|ratio| {
            let printed = m.partition_point(|m| printed_ratio(*ratio, *m));
            let rising = q.partition_point(|q| end_slope(*ratio, *q) != Less);
            (*ratio, [printed as f32, rising as f32])
        })
        .collect();
    let counts = |ratio: f64| firsts[firsts.partition_point(|(r, _)| *r < ratio)].1;
    let own = tables(
        grid,
        (start, len),
        |[ratio, theta]| Pair::new(ratio, theta, counts(ratio)),
        &[&|m| vec![within(m, MOST)], &|p| End::new(p).words(), &|q| End::new(q).words()],
    );
    let factors = BERNSTEIN.map(|factor| (factor / BERNSTEIN[0]) as f32);
    let [first, rest @ ..] = own.offsets;
    let [m, p, q] = rest.map(|offset| offset + K as u32);
    ShaderInputs { words: factors.into_iter().chain(own.words).collect(), offsets: [first, m, p, q] }
}

/// A positive number, or 0 where it or its inverse is not below `most`.
fn within(value: f64, most: f64) -> f32 {
    if value > 1.0 / most && value < most { value as f32 } else { 0.0 }
}

record! {
    /// The constants of a ratio and an angle.
    Pair {
        /// See [`Frame`]; 0 where it is left to f64.
        y: f32,
        last: f32,
        square: f32,
        /// How many m have the flag PRINTED_RATIO: those of smaller index.
        printed: f32,
        /// How many q have the flag END_RISES: those of smaller index.
        rising: f32,
    }
}

record! {
    /// A parameter p or q.
    End {
        /// `4 + p`; 0 where it is left to f64.
        over: f32,
        /// `1 - p`.
        less: f32,
        /// q lies where the end curvature counts as printed.
        as_printed: bool,
    }
}

impl Pair {
    fn new(ratio: f64, theta: f64, [printed, rising]: [f32; 2]) -> Pair {
        let [y, last, square] = Frame::new(ratio, theta).map_or([0.0; 3], |f| [f.y, f.last, f.square]);
        Pair { y: within(y, MOST), last: last as f32, square: square as f32, printed, rising }
    }
}

impl End {
    fn new(p: f64) -> End {
        let as_printed = (PRINTED_Q[0]..=PRINTED_Q[1]).contains(&p);
        End { over: within(4.0 + p, MOST_END), less: (1.0 - p) as f32, as_printed }
    }
}
