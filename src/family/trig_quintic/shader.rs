//! What the shader `trig_quintic.wgsl` reads.

use super::filter::coefficient_error;
use super::plain::{PRINTED_Q, end_slope, printed_ratio};
use super::poly::{BERNSTEIN, Frame, K};
use super::{END_CURVATURE_AS_PRINTED, END_RISES, PRINTED_RATIO, SPIRAL};
use crate::family::kernel::{constants, tables};
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
use std::cmp::Ordering::Less;

/// Numbers of a pair of ratio and angle, of a p and of a q.
const PAIR_STRIDE: usize = 5;
const P_STRIDE: usize = 2;
const Q_STRIDE: usize = 3;
/// Pieces that wait: a piece of 2^-10 shows features that the error of f32 coefficients does not hide anyway.
const MOST_LEVELS: usize = 12;
/// Halvings of one polynomial; see `positive` in the shader.
const MOST_HALVINGS: usize = 32;
/// 2^-24.
const UNIT: f64 = 1.0 / (1u32 << 24) as f64;
/// m, y and their inverses stay below this, and `1/(4 + p)`, `1/(4 + q)` below [`MOST_END`]. Then the sides, normalised, lie within
/// 2^-42 and 1 and the hodograph's coefficients between 2^-66 and 170.
const MOST: f64 = (1u32 << 10) as f64;
const MOST_END: f64 = (1u32 << 20) as f64;
/// Words come rounded from doubles, sides are normalised (one operation more), and so are Bernstein factors.
const ERROR: f64 = (coefficient_error([1.1, 1.1, 1.1], 1.0, 2.0) + 1.0) * UNIT;
/// What flushed denormals may do to a coefficient: D is off by 2^-120, each of up to 21 terms has an X below 2^22 and a factor of
/// up to 60, and of those sums there are seven.
const FLOOR: f64 = 1.0 / (1u128 << 80) as f64;

pub(super) fn shader() -> Shader {
    let flags = [
        ("END_RISES", END_RISES),
        ("SPIRAL", SPIRAL),
        ("PRINTED_RATIO", PRINTED_RATIO),
        ("END_CURVATURE_AS_PRINTED", END_CURVATURE_AS_PRINTED),
    ];
    let counts = [
        ("NEGATIVE", 0),
        ("POSITIVE", 1),
        ("UNKNOWN", 2),
        ("COEFFICIENTS", K),
        ("MOST_LEVELS", MOST_LEVELS),
        ("MOST_HALVINGS", MOST_HALVINGS),
        ("PAIR_STRIDE", PAIR_STRIDE),
        ("P_STRIDE", P_STRIDE),
        ("Q_STRIDE", Q_STRIDE),
    ];
    let constants = constants(&flags, &counts, &[("UNIT", UNIT), ("ERROR", ERROR), ("FLOOR", FLOOR)]);
    let own = ("trig_quintic.wgsl", include_str!("../../../shaders/trig_quintic.wgsl"));
    Shader { constants, fragments: vec![own] }
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
        |[ratio, theta]| pair_words(ratio, theta, counts(ratio)),
        &[&|m| vec![within(m, MOST)], &|p| end_words(p).to_vec(), &q_words],
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

fn pair_words(ratio: f64, theta: f64, [printed, rising]: [f32; 2]) -> [f32; PAIR_STRIDE] {
    let [y, last, square] = Frame::new(ratio, theta).map_or([0.0; 3], |f| [f.y, f.last, f.square]);
    [within(y, MOST), last as f32, square as f32, printed, rising]
}

/// `4 + p` and `1 - p`.
fn end_words(p: f64) -> [f32; P_STRIDE] {
    [within(4.0 + p, MOST_END), (1.0 - p) as f32]
}

fn q_words(q: f64) -> Vec<f32> {
    let [q4, q1] = end_words(q);
    vec![q4, q1, f32::from((PRINTED_Q[0]..=PRINTED_Q[1]).contains(&q))]
}
