//! A slice of a region at given angles, made of boxes that are proved as a whole and, at the boundaries, of single
//! pixels.

use serde::Deserialize;
use serde_json::{Value, json};
use spiral_atlas::family::{self, Chart, Code, Family, Table};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};
use std::collections::VecDeque;

/// Pixels along a side of the first tiles, of those whose pixels are asked each for itself, and of the least boxes.
const FIRST: usize = 64;
const LAST: usize = 16;
const LEAST: usize = 8;
/// Most pixels along a side.
const MOST: usize = 2048;
/// Boxes that may fail before the picture is whole, and how many more each one may that does not.
const PATIENCE: usize = 12;
const REWARD: usize = 3;
/// The axes of a slice.
const AXES: [&str; 4] = ["phi0", "phi1", "kappa0", "kappa1"];

/// What is asked for.
#[derive(Deserialize)]
pub(crate) struct Wanted {
    family: String,
    phi0: f64,
    phi1: f64,
    /// A place (κ0, κ1) that must be seen.
    at: [f64; 2],
    /// Ranges of κ0, with equal steps, and of κ1, above 0, with equal ratios. Left out: where the region is.
    ranges: Option<[[f64; 2]; 2]>,
    width: usize,
    height: usize,
}

/// A square of pixels, or what is left of one at the border.
#[derive(Clone, Copy)]
struct Tile {
    x: usize,
    y: usize,
    side: usize,
}

/// A slice in the making. Pixels are stored column by column, since κ1 is the grid's fastest axis.
pub(crate) struct Slice {
    family: &'static dyn Family,
    chart: usize,
    angles: [f64; 2],
    ranges: [[f64; 2]; 2],
    /// Edges of the pixels.
    edges: [Vec<f64>; 2],
    /// Their middles.
    grid: Grid,
    tiles: VecDeque<Tile>,
    /// The last tiles that look alike all over: boxes to be proved when the picture is whole.
    alike: VecDeque<Tile>,
    flags: Vec<u8>,
    proved: usize,
    /// How many boxes may fail before the picture is whole.
    patience: usize,
}

impl Slice {
    /// # Errors
    /// [`Error::Domain`] for an unknown family, ranges that are none, or angles outside the family's domain.
    pub(crate) fn new(wanted: Wanted) -> Result<Slice> {
        let Wanted { family, phi0, phi1, at, ranges, width, height } = wanted;
        let family = family::by_name(&family)?;
        let chart = family.about().charts.iter().position(|chart: &Chart| chart.axes == AXES);
        let chart =
            chart.ok_or_else(|| Error::invalid(format!("`{}` has no axes kappa0 and kappa1", family.about().name)))?;
        if ![width, height].iter().all(|n| (2..=MOST).contains(n)) {
            return Err(Error::invalid(format!(
                "the slice is {width} x {height} pixels; each side must be 2 to {MOST}"
            )));
        }
        let ranges = match ranges {
            Some(ranges) => ranges,
            None => seen(family, [phi0, phi1], at)?,
        };
        let [kappa0, kappa1] = ranges;
        // Twice as fine: edges and middles in turn.
        let fine = |[lo, hi]: [f64; 2], count: usize, log: bool| {
            let count = 2 * count + 1;
            let spacing = if log { Spacing::Log { lo, hi, count } } else { Spacing::Linear { lo, hi, count } };
            Axis::new("kappa", spacing).map(|axis| axis.values().to_vec())
        };
        let (x, y) = (fine(kappa0, width, false)?, fine(kappa1, height, true)?);
        let every_other =
            |values: &[f64], from: usize| values.iter().copied().skip(from).step_by(2).collect::<Vec<f64>>();
        let axis = |(name, values): (&&str, Vec<f64>)| Axis::new(name, Spacing::Values(values));
        let middles = [vec![phi0], vec![phi1], every_other(&x, 1), every_other(&y, 1)];
        let grid = Grid::new(AXES.iter().zip(middles).map(axis).collect::<Result<_>>()?)?;
        // The angles are checked now rather than later.
        family.table(&grid)?;
        let corners = |n: usize| (0..n).step_by(FIRST);
        let tiles = corners(width).flat_map(|x| corners(height).map(move |y| Tile { x, y, side: FIRST })).collect();
        let edges = [every_other(&x, 0), every_other(&y, 0)];
        let flags = vec![0; width * height];
        Ok(Slice {
            family,
            chart,
            angles: [phi0, phi1],
            ranges,
            edges,
            grid,
            tiles,
            alike: VecDeque::new(),
            flags,
            proved: 0,
            patience: PATIENCE,
        })
    }

    /// The names and the order of what is drawn.
    pub(crate) fn about(&self) -> Value {
        let bit = |name: &&str| self.family.about().bit(name);
        let flags: Vec<Value> = self
            .family
            .about()
            .flags
            .iter()
            .map(|f| json!({ "name": f.name, "label": f.label, "doc": f.doc }))
            .collect();
        let nested: Vec<usize> = self.family.about().nested.iter().filter_map(bit).collect();
        let family = self.family.about().name;
        json!({ "family": family, "ranges": self.ranges, "flags": flags, "nested": nested, "open": OPEN })
    }

    /// The flags of each pixel, column by column, from below.
    pub(crate) fn flags(&self) -> &[u8] {
        &self.flags
    }

    /// Pixels all of whose points are proved.
    pub(crate) fn proved(&self) -> usize {
        self.proved
    }

    /// Whether every pixel is known.
    pub(crate) fn drawn(&self) -> bool {
        self.tiles.is_empty()
    }

    /// Works on so many tiles, and returns how many wait. First all pixels become known, then boxes are proved.
    pub(crate) fn refine(&mut self, tiles: usize) -> usize {
        let grid = self.grid.clone();
        // The angles were checked before.
        let Ok(table) = self.family.table(&grid) else { return 0 };
        for _ in 0..tiles {
            if let Some(tile) = self.tiles.pop_front() {
                self.work(tile, &*table);
            } else if let Some(tile) = self.alike.pop_front().filter(|tile| !self.prove(tile) && tile.side > LEAST) {
                self.alike.extend(self.parts(&tile));
            }
        }
        self.tiles.len() + self.alike.len()
    }

    fn work(&mut self, tile: Tile, table: &dyn Table) {
        let Tile { x, y, side } = tile;
        let [right, top] = self.far(&tile);
        let rows = self.edges[1].len() - 1;
        if side <= LAST {
            for start in (x..right).map(|column| column * rows + y) {
                let mut codes = [Code::UNDECIDED; LAST];
                let codes = &mut codes[..top - y];
                table.filter(start as u64, codes);
                for (i, code) in codes.iter().enumerate() {
                    self.flags[start + i] = decided(table, start + i, *code);
                }
            }
            if self.is_alike(&tile) {
                self.alike.push_back(tile);
            } else {
                let parts: Vec<Tile> = self.parts(&tile).filter(|part| self.is_alike(part)).collect();
                self.alike.extend(parts);
            }
            return;
        }
        let code = |x: usize, y: usize| {
            let mut code = [Code::UNDECIDED];
            table.filter((x * rows + y) as u64, &mut code);
            code[0]
        };
        let middle = [(x + right) / 2, (y + top) / 2];
        let within = code(middle[0], middle[1]);
        // A box whose corners differ is not tried: a proof over a box takes as long as many pixels. Some families prove
        // small boxes alone, and there the large ones are soon given up.
        if self.patience > 0 {
            let corners = [(x, y), (x, top - 1), (right - 1, y), (right - 1, top - 1)];
            if corners.into_iter().all(|(x, y)| code(x, y).flags() == within.flags()) {
                if self.prove(&tile) {
                    self.patience += REWARD;
                    return;
                }
                self.patience -= 1;
            }
        }
        // Until its parts are known, a tile looks like its middle.
        self.fill([x, right, y, top], decided(table, middle[0] * rows + middle[1], within));
        self.tiles.extend(self.parts(&tile));
    }

    /// A tile in four, or less at the border.
    fn parts(&self, tile: &Tile) -> impl Iterator<Item = Tile> + use<> {
        let (Tile { x, y, side }, [right, top]) = (*tile, self.far(tile));
        let half = side / 2;
        let parts = [(x, y), (x + half, y), (x, y + half), (x + half, y + half)];
        parts.into_iter().filter(move |(x, y)| *x < right && *y < top).map(move |(x, y)| Tile { x, y, side: half })
    }

    /// Whether all pixels of a tile have the same flags.
    fn is_alike(&self, tile: &Tile) -> bool {
        let [right, top] = self.far(tile);
        let rows = self.edges[1].len() - 1;
        let first = self.flags[tile.x * rows + tile.y];
        (tile.x..right)
            .all(|column| self.flags[column * rows + tile.y..column * rows + top].iter().all(|f| *f == first))
    }

    /// Whether the verdicts of a tile are proved for all its points; then its pixels have them.
    fn prove(&mut self, tile: &Tile) -> bool {
        let (Tile { x, y, .. }, [right, top], [phi0, phi1]) = (*tile, self.far(tile), self.angles);
        let low = [phi0, phi1, self.edges[0][x], self.edges[1][y]];
        let high = [phi0, phi1, self.edges[0][right], self.edges[1][top]];
        let all = self.family.about().all_flags();
        let facts = self.family.region().facts(self.chart, &low, &high, all);
        if facts.inside | facts.outside != all {
            return false;
        }
        self.fill([x, right, y, top], facts.inside);
        self.proved += (right - x) * (top - y);
        true
    }

    /// Where a tile ends.
    fn far(&self, tile: &Tile) -> [usize; 2] {
        [(tile.x + tile.side).min(self.edges[0].len() - 1), (tile.y + tile.side).min(self.edges[1].len() - 1)]
    }

    fn fill(&mut self, [left, right, bottom, top]: [usize; 4], flags: u8) {
        let rows = self.edges[1].len() - 1;
        for column in left..right {
            self.flags[column * rows + bottom..column * rows + top].fill(flags);
        }
    }
}

/// Stands for the flags of a pixel that is not decided at the highest precision. No family has so many flags.
const OPEN: u8 = u8::MAX;

/// The flags of a node: where doubles leave them open, by intervals.
fn decided(table: &dyn Table, node: usize, code: Code) -> u8 {
    if code != Code::UNDECIDED {
        return code.flags();
    }
    table.exact(node as u64).map_or(OPEN, |(code, _)| code.flags())
}

/// Columns and rows of the sketch that shows where a region is, and the heights above sin φ1 that it spans.
const SKETCH: [usize; 2] = [20, 56];
const HEIGHTS: [f64; 2] = [1e-3, 1e5];

/// Ranges of κ0 and κ1 in which the family's region and a place are seen.
fn seen(family: &'static dyn Family, [phi0, phi1]: [f64; 2], at: [f64; 2]) -> Result<[[f64; 2]; 2]> {
    let (flat, sharp) = (phi0.sin().max(0.05), phi1.sin().max(0.05));
    let wide = [[-0.5 * flat, 1.06 * flat], [0.7 * sharp, 30.0 * sharp]];
    let [mut x, mut y] = if family.about().nested[0] == "EXISTS" {
        wide
    } else {
        region(family, [phi0, phi1], [flat, sharp])?.unwrap_or(wide)
    };
    let margin = 0.06 * (x[1] - x[0]);
    x = [x[0].min(at[0] - margin), x[1].max(at[0] + margin)];
    // Below a thousandth of the rest, no logarithmic axis shows it.
    y = [y[0].min(0.8 * at[1]).max(1e-4), y[1].max(1.25 * at[1])];
    Ok([x, y])
}

/// Where the family's answer is yes, with some room around.
fn region(family: &'static dyn Family, angles: [f64; 2], [flat, sharp]: [f64; 2]) -> Result<Option<[[f64; 2]; 2]>> {
    let [columns, rows] = SKETCH;
    let step = (HEIGHTS[1] / HEIGHTS[0]).ln() / (rows - 1) as f64;
    let across: Vec<f64> = (0..columns).map(|i| flat * (i as f64 + 0.5) / columns as f64).collect();
    let up: Vec<f64> = (0..rows).map(|i| sharp + HEIGHTS[0] * (step * i as f64).exp()).collect();
    let values = [vec![angles[0]], vec![angles[1]], across.clone(), up.clone()];
    let axis = |(name, values): (&&str, Vec<f64>)| Axis::new(name, Spacing::Values(values));
    let grid = Grid::new(AXES.iter().zip(values).map(axis).collect::<Result<_>>()?)?;
    let table = family.table(&grid)?;
    let mut codes = vec![Code::UNDECIDED; columns * rows];
    table.filter(0, &mut codes);
    let yes = |node: &usize| codes[*node] != Code::UNDECIDED && family.holds(codes[*node]);
    let hits: Vec<[usize; 2]> = (0..codes.len()).filter(yes).map(|node| [node / rows, node % rows]).collect();
    let range = |axis: usize| Some([hits.iter().map(|hit| hit[axis]).min()?, hits.iter().map(|hit| hit[axis]).max()?]);
    let (Some([left, right]), Some([low, high])) = (range(0), range(1)) else { return Ok(None) };
    let room = 0.2 * (across[right] - across[left]) + flat / columns as f64;
    let x = [(across[left] - room).max(0.0), (across[right] + room).min(1.06 * flat)];
    // A region without an upper end is shown as far as it begins.
    let high = if high + 1 == rows { (low + rows / 3).min(high) } else { high };
    let room = (up[high] / up[low]).powf(0.15).max(1.05);
    Ok(Some([x, [up[low.saturating_sub(1)] / room, up[(high + 1).min(rows - 1)] * room]]))
}
