//! What is proved of one cell.

use super::tree::Known;
use crate::family::{self, Facts, Family, MOST_SIDES, Region};
use std::collections::VecDeque;

/// Most boxes that are tried for a cell before it is MIXED.
///
/// The first is the cell itself. A cell whose flag is uniform but was not proved so is often proved by its halves;
/// one where a half has the flag and another has not is MIXED at once.
///
/// Cells of the finest size get more than those that are divided if they stay MIXED. Where one flag is asked for, its
/// verdicts at the corners are compared first: most cells that a boundary crosses cost no more than that.
const MOST_TESTS: [u32; 2] = [20, 12];

/// A box, as its least and its greatest coordinates; those beyond the axes mean nothing.
pub(super) type Bounds = [[f64; MOST_SIDES]; 2];

/// The proofs of a family on some axes.
#[derive(Clone, Copy)]
pub(super) struct Prover {
    pub family: &'static dyn Family,
    pub region: &'static dyn Region,
    pub chart: usize,
    pub axes: usize,
    /// Axes whose halves have equal ratios.
    pub log: [bool; MOST_SIDES],
}

impl Prover {
    fn facts(&self, bounds: &Bounds, wanted: u8) -> Facts {
        self.region.facts(self.chart, &bounds[0][..self.axes], &bounds[1][..self.axes], wanted)
    }

    /// What is known of the wanted flags all over a cell, by the cell itself and its halves, breadth first.
    ///
    /// `size` is 0 for a cell of the finest size.
    pub(super) fn classify(&self, cell: &Bounds, size: u32, wanted: u8) -> Known {
        let most = MOST_TESTS[usize::from(size > 0)];
        // Flags that some part of the cell has, that some part has not, and that some part leaves open.
        let (mut some, mut none, mut open) = (0, 0, 0);
        let mut queue = VecDeque::from([(*cell, wanted)]);
        let mut tests = 0;
        while let Some((bounds, wanted)) = queue.pop_front() {
            let wanted = wanted & !(some & none) & !open;
            if wanted == 0 {
                continue;
            }
            if tests == most {
                open |= wanted;
                continue;
            }
            tests += 1;
            let facts = self.facts(&bounds, wanted);
            some |= facts.inside & wanted;
            none |= facts.outside & wanted;
            let left = wanted & !(facts.inside | facts.outside);
            if tests == 1 && left.count_ones() == 1 && self.crosses(cell, left) {
                open |= left;
            } else if left != 0 {
                match self.halves(&bounds, &facts) {
                    Some(halves) => queue.extend(halves.map(|half| (half, left))),
                    None => open |= left,
                }
            }
        }
        Known { inside: wanted & some & !none & !open, outside: wanted & none & !some & !open }
    }

    /// Whether two corners differ in a flag: no proof can succeed then, and none need be tried.
    fn crosses(&self, cell: &Bounds, flag: u8) -> bool {
        let has = |corner: usize| {
            let point: [f64; MOST_SIDES] = std::array::from_fn(|i| cell[corner >> i & 1][i]);
            Some(family::quick(self.family, self.chart, &point[..self.axes])?.flags() & flag != 0)
        };
        // Opposite corners first, which differ most; along a side without width there is one.
        let fixed = (0..self.axes).fold(0, |fixed, i| if cell[0][i] < cell[1][i] { fixed } else { fixed | 1 << i });
        let corners = (0..1 << (self.axes - 1)).flat_map(|i| [i, (1 << self.axes) - 1 - i]);
        let mut known = corners.filter(|corner| corner & fixed == 0).filter_map(has);
        known.next().is_some_and(|first| known.any(|other| other != first))
    }

    /// Halves along the axis that moves most what is open; `None` where that axis has no number between its ends.
    fn halves(&self, bounds: &Bounds, facts: &Facts) -> Option<[Bounds; 2]> {
        let width =
            |i: usize| (bounds[1][i] - bounds[0][i]) / (bounds[0][i].abs() + bounds[1][i].abs()).max(f64::MIN_POSITIVE);
        // The relative width decides ties, and where no pull is known.
        let pull = |i: usize| if facts.pull[i].is_finite() { facts.pull[i] } else { 0.0 } + 1e-6 * width(i);
        let sides = (0..self.axes).filter(|i| bounds[0][*i] < bounds[1][*i]);
        let axis = sides.max_by(|i, j| pull(*i).total_cmp(&pull(*j)))?;
        let [low, high] = [bounds[0][axis], bounds[1][axis]];
        let middle = if self.log[axis] { low.sqrt() * high.sqrt() } else { 0.5 * low + 0.5 * high };
        (low < middle && middle < high).then_some(())?;
        let (mut first, mut second) = (*bounds, *bounds);
        (first[1][axis], second[0][axis]) = (middle, middle);
        Some([first, second])
    }
}
