//! What families on any grid share: the loop over nodes, the constants and the tables of a shader.

use super::Code;
use crate::grid::{Grid, MAX_AXES};
use fearless_simd::{Simd, SimdBase};

/// A family that classifies vectors of nodes which differ in their last coordinate alone.
pub(super) trait Rows {
    /// What depends on the first [`Rows::ANGLES`] coordinates alone.
    type Constants: Copy;
    /// How many axes that are.
    const ANGLES: usize;

    /// The constants at a node; `None` leaves all nodes with these angles undecided.
    fn constants(&self, node: &[f64; MAX_AXES]) -> Option<Self::Constants>;

    /// The codes of the nodes with these last coordinates, as many as `out` has; surplus lanes repeat the last.
    ///
    /// `node` is the first of a row; its own last coordinate means nothing here.
    fn codes<S: Simd>(&self, simd: S, constants: &Self::Constants, node: &[f64; MAX_AXES], last: S::f64s, out: &mut [Code]);
}

/// Fills the nodes from `start` on.
#[inline(always)]
pub(super) fn fill<S: Simd, R: Rows>(simd: S, rows: &R, grid: &Grid, start: u64, out: &mut [Code]) {
    let dimension = grid.axes().len();
    let values = grid.axes()[dimension - 1].values();
    let mut done = 0;
    let mut shared = None;
    while done < out.len() {
        let at = start + done as u64;
        let (index, node) = (grid.index(at), grid.node(at));
        let from = index[dimension - 1];
        let length = (values.len() - from).min(out.len() - done);
        let (codes, values) = (&mut out[done..done + length], &values[from..from + length]);
        let angles = std::array::from_fn::<_, MAX_AXES, _>(|i| if i < R::ANGLES { index[i] } else { 0 });
        if shared.is_none_or(|(at, _)| at != angles) {
            shared = Some((angles, rows.constants(&node)));
        }
        match shared {
            Some((_, Some(constants))) => row(simd, rows, &constants, &node, values, codes),
            _ => codes.fill(Code::UNDECIDED),
        }
        done += length;
    }
}

/// Nodes that share all but the last coordinate, which runs over `last`.
#[inline(always)]
fn row<S: Simd, R: Rows>(simd: S, rows: &R, constants: &R::Constants, node: &[f64; MAX_AXES], last: &[f64], out: &mut [Code]) {
    const { assert!(S::f64s::LEN <= 8, "room for one vector") };
    let width = S::f64s::LEN;
    let mut padded = [0.0; 8];
    for (values, codes) in last.chunks(width).zip(out.chunks_mut(width)) {
        let lanes = if values.len() == width {
            S::f64s::from_slice(simd, values)
        } else {
            // The last lanes repeat the row's last value; their codes are dropped.
            padded[..values.len()].copy_from_slice(values);
            padded[values.len()..width].fill(values[values.len() - 1]);
            S::f64s::from_slice(simd, &padded[..width])
        };
        rows.codes(simd, constants, node, lanes, codes);
    }
}

/// A shader's constants in WGSL: flags, whole numbers, numbers, and what marks an undecided node.
#[cfg(feature = "gpu")]
pub(super) fn constants(flags: &[(&str, u8)], counts: &[(&str, usize)], numbers: &[(&str, f64)]) -> String {
    let whole = |name: &str, value: usize| format!("const {name}: u32 = {value}u;\n");
    let mut text = whole("UNDECIDED", Code::UNDECIDED.0.into());
    text.extend(flags.iter().map(|(name, bit)| whole(name, (*bit).into())));
    text.extend(counts.iter().map(|(name, count)| whole(name, *count)));
    text.extend(numbers.iter().map(|(name, value)| format!("const {name}: f32 = {value:e};\n")));
    text
}

/// A shader's tables: the constants that the nodes `start .. start + len` need, by the index of their first `angles` axes, then the
/// words of each further axis, by index.
///
/// The offsets: the first of these indices, then where each further axis begins; the rest is the family's own, and 0 here.
#[cfg(feature = "gpu")]
pub(super) fn tables<const A: usize, const P: usize>(
    grid: &Grid,
    (start, len): (u64, u64),
    constants: impl Fn([f64; A]) -> [f32; P],
    words_of: &[&dyn Fn(f64) -> Vec<f32>],
) -> super::ShaderInputs {
    let (angles, further) = grid.axes().split_at(A);
    let each = further.iter().map(|axis| axis.values().len() as u64).product::<u64>();
    let (first, last) = (start / each, (start + len.max(1) - 1) / each);
    let mut words = Vec::with_capacity((last - first + 1) as usize * P);
    for at in first..=last {
        let mut rest = at as usize;
        let mut node = [0.0; A];
        for (slot, axis) in node.iter_mut().zip(angles).rev() {
            *slot = axis.values()[rest % axis.values().len()];
            rest /= axis.values().len();
        }
        words.extend(constants(node));
    }
    // The first index wraps as the shader's own does.
    let mut offsets = [first as u32, 0, 0, 0];
    for ((axis, offset), words_of) in further.iter().zip(&mut offsets[1..]).zip(words_of) {
        *offset = words.len() as u32;
        words.extend(axis.values().iter().flat_map(|v| words_of(*v)));
    }
    super::ShaderInputs { words, offsets }
}
