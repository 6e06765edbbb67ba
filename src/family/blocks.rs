//! Dense grids by blocks: where a family proves that all data of a block have one code, its nodes are not evaluated.
//!
//! The codes are those of [`super::rows::fill`]: both say what is proved, and only that. A block that is not proved is
//! halved; what is too small for that goes to the nodes.

use super::Code;
use super::rows::{Rows, fill, row};
use crate::grid::{Grid, MAX_AXES};
use fearless_simd::{Simd, SimdBase};

/// A family that proves codes over blocks of nodes that share all but the last two coordinates.
pub(super) trait Blocks: Rows {
    /// Fewest values of the last two axes for which blocks cost less than nodes.
    const LEAST: usize;
    /// Most nodes along each side of the first blocks.
    const FIRST: usize;
    /// Nodes of a block that cost less than its proof.
    const LEAF: usize;
    /// What blocks need beside the constants.
    type Plane;

    /// What the blocks of a pair of angles share; `None` leaves all of them to the nodes.
    fn plane(&self, constants: &Self::Constants) -> Option<Self::Plane>;

    /// The codes that all real points of these blocks have, given by their least and greatest last two coordinates;
    /// [`Code::UNDECIDED`] where they differ or nothing is proved. `out` may be shorter than the vectors.
    fn codes_on<S: Simd>(
        &self,
        simd: S,
        plane: &Self::Plane,
        third: [S::f64s; 2],
        fourth: [S::f64s; 2],
        out: &mut [Code],
    );
}

/// Rows below which no blocks are made.
const FEWEST_ROWS: usize = 8;

/// Fills the nodes from `start` on.
#[inline(always)]
pub(super) fn fill_by_blocks<S: Simd, R: Blocks>(simd: S, rows: &R, grid: &Grid, start: u64, out: &mut [Code]) {
    let [.., third, fourth] = grid.axes() else { return fill(simd, rows, grid, start, out) };
    assert_eq!(grid.axes().len(), R::ANGLES + 2, "the blocks lie in the last two coordinates");
    let (height, width) = (third.values().len(), fourth.values().len());
    if height.min(width) < R::LEAST {
        return fill(simd, rows, grid, start, out);
    }
    let mut done = 0;
    while done < out.len() {
        let at = start + done as u64;
        let index = grid.index(at);
        let [from, column] = [index[grid.axes().len() - 2], index[grid.axes().len() - 1]];
        let whole = if column == 0 { ((out.len() - done) / width).min(height - from) } else { 0 };
        if whole < FEWEST_ROWS {
            // To the end of the row, or of the plane.
            let length = if column == 0 { (height - from) * width } else { width - column }.min(out.len() - done);
            fill(simd, rows, grid, at, &mut out[done..done + length]);
            done += length;
            continue;
        }
        let node = grid.node(at);
        let (third, out) = (&third.values()[from..from + whole], &mut out[done..done + whole * width]);
        let constants = rows.constants(&node);
        match constants.as_ref().and_then(|constants| rows.plane(constants).map(|plane| (constants, plane))) {
            Some((constants, plane)) => {
                blocks(simd, rows, constants, &plane, &node, [third, fourth.values()], out);
            }
            None => fill(simd, rows, grid, at, out),
        }
        done += whole * width;
    }
}

/// Rows and columns, each from one up to before another.
#[derive(Clone, Copy)]
struct Block([[usize; 2]; 2]);

impl Block {
    fn sides(&self) -> [usize; 2] {
        self.0.map(|[from, to]| to - from)
    }

    /// Both halves of the longer side; columns come in whole vectors.
    fn halves(&self, vector: usize) -> [Block; 2] {
        let [rows, columns] = self.sides();
        let side = usize::from(columns > vector && columns >= 2 * rows || rows < 2);
        let [from, to] = self.0[side];
        let half = (to - from) / 2;
        let cut = from + if side == 1 && half > vector { half.next_multiple_of(vector) } else { half };
        let (mut first, mut second) = (*self, *self);
        first.0[side][1] = cut;
        second.0[side][0] = cut;
        [first, second]
    }
}

/// Fills whole rows of one plane.
#[inline(always)]
fn blocks<S: Simd, R: Blocks>(
    simd: S,
    rows: &R,
    constants: &R::Constants,
    plane: &R::Plane,
    node: &[f64; MAX_AXES],
    axes: [&[f64]; 2],
    out: &mut [Code],
) {
    const { assert!(S::f64s::LEN <= 8, "room for one vector") };
    let (vector, stride) = (S::f64s::LEN, axes[1].len());
    let parts = |axis: &[f64]| {
        let length = axis.len();
        (0..length).step_by(R::FIRST).map(move |from| [from, (from + R::FIRST).min(length)])
    };
    let mut waiting: Vec<Block> =
        parts(axes[0]).flat_map(|rows| parts(axes[1]).map(move |columns| Block([rows, columns]))).collect();
    let mut next = Vec::new();
    while !waiting.is_empty() {
        for some in waiting.chunks(vector) {
            let mut codes = [Code::UNDECIDED; 8];
            let codes = &mut codes[..some.len()];
            // Surplus lanes repeat the last block.
            let mut bounds = [[[0.0; 8]; 2]; 2];
            for (lane, block) in (0..vector).map(|lane| (lane, some[lane.min(some.len() - 1)])) {
                for ((bounds, axis), [from, to]) in bounds.iter_mut().zip(axes).zip(block.0) {
                    bounds[0][lane] = axis[from];
                    bounds[1][lane] = axis[to - 1];
                }
            }
            let [third, fourth] = &bounds;
            let third =
                [S::f64s::from_slice(simd, &third[0][..vector]), S::f64s::from_slice(simd, &third[1][..vector])];
            let fourth =
                [S::f64s::from_slice(simd, &fourth[0][..vector]), S::f64s::from_slice(simd, &fourth[1][..vector])];
            rows.codes_on(simd, plane, third, fourth, codes);
            for (block, code) in some.iter().zip(codes) {
                let [[top, bottom], [left, right]] = block.0;
                let sides = block.sides();
                if *code != Code::UNDECIDED {
                    (top..bottom).for_each(|i| out[i * stride + left..i * stride + right].fill(*code));
                } else if sides[0] * sides[1] > R::LEAF {
                    next.extend(block.halves(vector));
                } else {
                    for i in top..bottom {
                        let mut node = *node;
                        node[R::ANGLES] = axes[0][i];
                        let codes = &mut out[i * stride + left..i * stride + right];
                        row(simd, rows, constants, &node, &axes[1][left..right], codes);
                    }
                }
            }
        }
        waiting.clear();
        std::mem::swap(&mut waiting, &mut next);
    }
}
