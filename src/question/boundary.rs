//! The outline of the region of a slice in which a property holds.

use super::property::{Cell, Property};
use crate::error::{Error, Result};
use crate::num::{Verdict, demand_ieee};
use std::collections::{HashMap, VecDeque};

/// Most cells along a side.
const MOST_CELLS: usize = 4096;
/// Most boxes that a cell without a crossing is divided into before it counts as open.
const MOST_PARTS: usize = 64;
/// Halvings of an edge towards a crossing: to a millionth of a cell.
const HALVINGS: usize = 20;

/// The outline of a region of a slice.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Boundary {
    /// Its curves.
    pub outlines: Vec<Outline>,
    /// Cells, as their least and greatest corners, in which the property may change although it is the same at their
    /// four corners: mostly beside an outline that bends, or where the region is narrower than a cell.
    pub open: Vec<[[f64; 2]; 2]>,
    /// The sides of a cell. Proved: the property changes only in cells that an outline passes and in open ones. So the
    /// outline is off by the diagonal of a cell at most. Its vertices are off by a millionth of a side.
    pub cell: [f64; 2],
    /// How many boxes were looked at.
    pub boxes: usize,
}

/// A polyline.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Outline {
    /// Whether its last point joins the first. Others end at the border of the slice.
    pub closed: bool,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

/// An edge of the lattice: its lower end, and along which side it runs.
type Edge = ([usize; 2], usize);

/// A slice, and what is known at the corners of its cells.
struct Slice<'p> {
    property: &'p Property,
    whole: Cell,
    axes: [usize; 2],
    /// Coordinates of the lattice along both sides.
    lines: [Vec<f64>; 2],
    corners: HashMap<[usize; 2], bool>,
}

/// The outline of a property in a slice: two coordinates vary, the others are given.
///
/// # Arguments
/// - `point`: the datum; its coordinates `axes` do not matter.
/// - `within`: the interval of each of the two. What lies outside the family's domain counts as failing.
/// - `cells`: cells along each side, a power of two up to 4096. The work grows with the length of the outline in cells.
///
/// # Errors
/// [`Error::Domain`] for a datum, a slice or a number of cells that is none; [`Error::Undecided`] at the precision cap.
pub fn boundary(
    property: &Property,
    point: &[f64],
    axes: [usize; 2],
    within: [[f64; 2]; 2],
    cells: usize,
) -> Result<Boundary> {
    demand_ieee()?;
    let mut slice = Slice::new(property, point, axes, within, cells)?;
    let (mixed, boxes) = slice.mixed(cells);
    let mut segments = Vec::new();
    let mut found = Boundary {
        outlines: Vec::new(),
        open: Vec::new(),
        cell: within.map(|[low, high]| (high - low) / cells as f64),
        boxes,
    };
    for cell in mixed {
        let edges = slice.crossed(cell)?;
        if edges.is_empty() {
            let (changes, boxes) = slice.may_change(cell);
            found.boxes += boxes;
            if changes {
                let corner = |[i, j]: [usize; 2]| [slice.lines[0][i], slice.lines[1][j]];
                found.open.push([corner(cell), corner([cell[0] + 1, cell[1] + 1])]);
            }
        }
        segments.extend(edges);
    }
    let mut points = HashMap::new();
    for edge in segments.iter().flatten() {
        if !points.contains_key(edge) {
            points.insert(*edge, slice.crossing(*edge)?);
        }
    }
    for (edges, closed) in linked(&segments) {
        found.outlines.push(Outline { closed, points: edges.iter().map(|edge| points[edge]).collect() });
    }
    Ok(found)
}

impl<'p> Slice<'p> {
    fn new(
        property: &'p Property,
        point: &[f64],
        axes: [usize; 2],
        within: [[f64; 2]; 2],
        cells: usize,
    ) -> Result<Slice<'p>> {
        if !(cells.is_power_of_two() && (2..=MOST_CELLS).contains(&cells)) {
            let limit = format!("a power of two from 2 to {MOST_CELLS}");
            return Err(Error::domain("the number of cells a side", cells as f64, limit));
        }
        let mut point = point.to_vec();
        if axes[0] == axes[1] || axes.iter().any(|axis| *axis >= point.len()) {
            return Err(Error::invalid(format!(
                "the coordinates are numbers {} and {}; they must be two of {}",
                axes[0],
                axes[1],
                point.len()
            )));
        }
        for (axis, [low, high]) in axes.into_iter().zip(within) {
            point[axis] = low;
            let step = (high - low) / cells as f64;
            if !(low < high && step.is_normal() && step > high.abs().max(low.abs()) * 4.0 * f64::EPSILON) {
                return Err(Error::invalid(format!(
                    "{} goes from {low:?} to {high:?}; it must have two finite, increasing ends and room for {cells} \
                     cells",
                    property.axes()[axis]
                )));
            }
        }
        let whole = property.point(&point)?;
        let line = |[low, high]: [f64; 2]| {
            let at = |i: usize| if i == cells { high } else { low + (high - low) * (i as f64 / cells as f64) };
            (0..=cells).map(at).collect()
        };
        Ok(Slice { property, whole, axes, lines: within.map(line), corners: HashMap::new() })
    }

    /// The box of `size` cells a side at a corner of the lattice.
    fn cell(&self, at: [usize; 2], size: usize) -> Cell {
        let mut cell = self.whole;
        for (side, axis) in self.axes.into_iter().enumerate() {
            (cell.low[axis], cell.high[axis]) = (self.lines[side][at[side]], self.lines[side][at[side] + size]);
        }
        cell
    }

    /// The cells in which the property may change, by a quadtree, and the boxes that were looked at.
    fn mixed(&self, cells: usize) -> (Vec<[usize; 2]>, usize) {
        let (mut mixed, mut boxes, mut waiting) = (Vec::new(), 0, VecDeque::from([([0, 0], cells)]));
        while let Some((at, size)) = waiting.pop_front() {
            let mut cell = self.cell(at, size);
            let whole = cell;
            // Where a part lies outside the domain, the property changes at the domain's border.
            if !self.property.clip(&mut cell) {
                continue;
            }
            boxes += 1;
            match self.property.over(&cell) {
                Verdict::No => {}
                Verdict::Yes if cell == whole => {}
                _ if size == 1 => mixed.push(at),
                _ => {
                    let half = size / 2;
                    let quarters = [[0, 0], [half, 0], [0, half], [half, half]];
                    waiting.extend(quarters.map(|[i, j]| ([at[0] + i, at[1] + j], half)));
                }
            }
        }
        (mixed, boxes)
    }

    fn corner(&mut self, at: [usize; 2]) -> Result<bool> {
        if let Some(known) = self.corners.get(&at) {
            return Ok(*known);
        }
        let known = self.at([self.lines[0][at[0]], self.lines[1][at[1]]])?;
        self.corners.insert(at, known);
        Ok(known)
    }

    fn at(&self, place: [f64; 2]) -> Result<bool> {
        let mut point = self.whole.low;
        for (axis, x) in self.axes.into_iter().zip(place) {
            point[axis] = x;
        }
        Ok(self.property.at(&point[..self.property.axes().len()])? == Some(true))
    }

    /// The pairs of edges between which the outline passes a cell: none, one or two (marching squares).
    fn crossed(&mut self, [i, j]: [usize; 2]) -> Result<Vec<[Edge; 2]>> {
        // Corners counter-clockwise; edge k follows corner k.
        let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        let edges: [Edge; 4] = [([i, j], 0), ([i + 1, j], 1), ([i, j + 1], 0), ([i, j], 1)];
        let mut holds = [false; 4];
        for (holds, corner) in holds.iter_mut().zip(corners) {
            *holds = self.corner(corner)?;
        }
        let changed: Vec<Edge> = (0..4).filter(|k| holds[*k] != holds[(k + 1) % 4]).map(|k| edges[k]).collect();
        Ok(match changed[..] {
            [a, b] => vec![[a, b]],
            [a, b, c, d] => {
                let middle = |side: usize, k: usize| 0.5 * self.lines[side][k] + 0.5 * self.lines[side][k + 1];
                // The middle goes with two opposite corners; the outline passes around the other two.
                if self.at([middle(0, i), middle(1, j)])? == holds[0] {
                    vec![[a, b], [c, d]]
                } else {
                    vec![[d, a], [b, c]]
                }
            }
            _ => Vec::new(),
        })
    }

    /// Whether the property may change in a cell whose corners are all alike, by its parts; and the boxes looked at.
    fn may_change(&self, at: [usize; 2]) -> (bool, usize) {
        let mut cell = self.cell(at, 1);
        if !self.property.clip(&mut cell) {
            return (false, 0);
        }
        let holds = Verdict::from(self.corners.get(&at).copied());
        let (mut boxes, mut waiting) = (0, VecDeque::from([cell]));
        while let Some(cell) = waiting.pop_front() {
            boxes += 1;
            match self.property.over(&cell) {
                known if known == holds && !known.is_open() => {}
                Verdict::Undecided if boxes < MOST_PARTS => {
                    let relative = |axis: &usize| {
                        (cell.high[*axis] - cell.low[*axis]) / (self.whole_side(*axis)).max(f64::MIN_POSITIVE)
                    };
                    let widest = self.axes.into_iter().max_by(|a, b| relative(a).total_cmp(&relative(b)));
                    match widest.and_then(|axis| Some((axis, cell.middle(axis)?))) {
                        Some((axis, middle)) => waiting.extend(cell.parts(axis, middle)),
                        None => return (true, boxes),
                    }
                }
                _ => return (true, boxes),
            }
        }
        (false, boxes)
    }

    /// The length of a side of the slice.
    fn whole_side(&self, axis: usize) -> f64 {
        let line = &self.lines[usize::from(axis == self.axes[1])];
        line[line.len() - 1] - line[0]
    }

    /// Where the property changes on an edge.
    fn crossing(&mut self, (at, side): Edge) -> Result<[f64; 2]> {
        let holds = self.corner(at)?;
        let mut place = [self.lines[0][at[0]], self.lines[1][at[1]]];
        let (mut low, mut high) = (place[side], self.lines[side][at[side] + 1]);
        for _ in 0..HALVINGS {
            place[side] = 0.5 * low + 0.5 * high;
            if self.at(place)? == holds {
                low = place[side];
            } else {
                high = place[side];
            }
        }
        place[side] = 0.5 * low + 0.5 * high;
        Ok(place)
    }
}

/// Chains of edges, and whether each comes back to its start. Each edge is in two segments at most.
fn linked(segments: &[[Edge; 2]]) -> Vec<(Vec<Edge>, bool)> {
    let mut at: HashMap<Edge, Vec<usize>> = HashMap::new();
    for (n, segment) in segments.iter().enumerate() {
        segment.iter().for_each(|edge| at.entry(*edge).or_default().push(n));
    }
    let mut used = vec![false; segments.len()];
    let mut chains = Vec::new();
    let follow = |start: usize, from: Edge, used: &mut Vec<bool>| {
        let (mut chain, mut next, mut edge) = (vec![from], Some(start), from);
        while let Some(n) = next {
            used[n] = true;
            let [a, b] = segments[n];
            edge = if a == edge { b } else { a };
            chain.push(edge);
            next = at[&edge].iter().copied().find(|m| !used[*m]);
        }
        chain
    };
    // From loose ends first; what is left is closed.
    for ends in [true, false] {
        for n in 0..segments.len() {
            let loose = segments[n].iter().find(|edge| at[*edge].len() == 1);
            if used[n] || ends && loose.is_none() {
                continue;
            }
            let mut chain = follow(n, *loose.unwrap_or(&segments[n][0]), &mut used);
            if !ends {
                chain.pop();
            }
            chains.push((chain, !ends));
        }
    }
    chains
}
