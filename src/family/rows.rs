//! Grids of four axes whose first two, the angles, share constants: the loop over nodes, and the tables of a shader.

use super::Code;
use crate::grid::Grid;
use fearless_simd::{Simd, SimdBase};

/// A family that classifies vectors of nodes which share their first three coordinates.
pub(super) trait Rows {
    /// What depends on the first two coordinates alone.
    type Pair: Copy;

    /// The constants of a pair; `None` leaves its nodes undecided.
    fn pair(&self, first: f64, second: f64) -> Option<Self::Pair>;

    /// The codes of the nodes with these fourth coordinates, as many as `out` has; surplus lanes repeat the last.
    fn codes<S: Simd>(&self, simd: S, pair: &Self::Pair, third: f64, fourth: S::f64s, out: &mut [Code]);
}

/// Fills the nodes from `start` on.
#[inline(always)]
pub(super) fn fill<S: Simd, R: Rows>(simd: S, rows: &R, grid: &Grid, start: u64, out: &mut [Code]) {
    let axes = grid.axes();
    let last = axes[3].values();
    let mut done = 0;
    let mut angles = None;
    while done < out.len() {
        let [i0, i1, i2, i3] = grid.index(start + done as u64);
        let length = (last.len() - i3).min(out.len() - done);
        let (codes, values) = (&mut out[done..done + length], &last[i3..i3 + length]);
        if angles.is_none_or(|(at, _)| at != (i0, i1)) {
            angles = Some(((i0, i1), rows.pair(axes[0].values()[i0], axes[1].values()[i1])));
        }
        match angles {
            Some((_, Some(pair))) => row(simd, rows, &pair, axes[2].values()[i2], values, codes),
            _ => codes.fill(Code::UNDECIDED),
        }
        done += length;
    }
}

/// Nodes that share the first three coordinates; the last runs over `last`.
#[inline(always)]
fn row<S: Simd, R: Rows>(simd: S, rows: &R, pair: &R::Pair, third: f64, last: &[f64], out: &mut [Code]) {
    let width = S::f64s::LEN;
    let mut padded = [0.0; 64];
    for (values, codes) in last.chunks(width).zip(out.chunks_mut(width)) {
        let fourth = if values.len() == width {
            S::f64s::from_slice(simd, values)
        } else {
            // The last lanes repeat the row's last value; their codes are dropped.
            padded[..values.len()].copy_from_slice(values);
            padded[values.len()..width].fill(values[values.len() - 1]);
            S::f64s::from_slice(simd, &padded[..width])
        };
        rows.codes(simd, pair, third, fourth, codes);
    }
}

/// A shader's tables: the pairs that the nodes `start .. start + len` need, then the third and the fourth axis, all by index.
///
/// The last of the four offsets, the family's own, is 0.
#[cfg(feature = "gpu")]
pub(super) fn tables<const P: usize, const T: usize, const F: usize>(
    grid: &Grid,
    (start, len): (u64, u64),
    pair: impl Fn(f64, f64) -> [f32; P],
    third: impl Fn(f64) -> [f32; T],
    fourth: impl Fn(f64) -> [f32; F],
) -> super::ShaderInputs {
    let axes = grid.axes();
    let [second_axis, third_axis, fourth_axis] = [1, 2, 3].map(|i: usize| axes[i].values());
    let nodes_per_pair = (third_axis.len() * fourth_axis.len()) as u64;
    let (first, last) = (start / nodes_per_pair, (start + len.max(1) - 1) / nodes_per_pair);
    let mut words = Vec::with_capacity((last - first + 1) as usize * P + third_axis.len() * T + fourth_axis.len() * F);
    for at in first..=last {
        let (i0, i1) = ((at / second_axis.len() as u64) as usize, (at % second_axis.len() as u64) as usize);
        words.extend(pair(axes[0].values()[i0], second_axis[i1]));
    }
    let third_at = words.len();
    words.extend(third_axis.iter().flat_map(|v| third(*v)));
    let fourth_at = words.len();
    words.extend(fourth_axis.iter().flat_map(|v| fourth(*v)));
    // The first pair's index wraps as the shader's own does.
    super::ShaderInputs { words, offsets: [first as u32, third_at as u32, fourth_at as u32, 0] }
}
