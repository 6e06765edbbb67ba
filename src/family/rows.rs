//! What families on any grid share: the loop over nodes.

use super::Code;
use crate::grid::{Grid, MAX_AXES};
use fearless_simd::{Level, Simd, SimdBase, SimdMask};
use std::sync::LazyLock;

/// What this processor can, asked for once.
pub(super) fn level() -> Level {
    static LEVEL: LazyLock<Level> = LazyLock::new(Level::new);
    *LEVEL
}

/// A mask as bits, one a lane.
#[inline(always)]
pub(super) fn bits<S: Simd>(mask: S::mask64s) -> u64 {
    mask.to_bitmask()
}

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
    fn codes<S: Simd>(
        &self,
        simd: S,
        constants: &Self::Constants,
        node: &[f64; MAX_AXES],
        last: S::f64s,
        out: &mut [Code],
    );
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
pub(super) fn row<S: Simd, R: Rows>(
    simd: S,
    rows: &R,
    constants: &R::Constants,
    node: &[f64; MAX_AXES],
    last: &[f64],
    out: &mut [Code],
) {
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
