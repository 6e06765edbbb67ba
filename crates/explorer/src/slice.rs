//! A slice of a region at given angles, made of boxes that are proved as a whole and, at the boundaries, of single pixels.

use serde::Deserialize;
use serde_json::{Value, json};
use spiral_atlas::family::{self, Chart, Code, Family, Table};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};
use std::collections::VecDeque;

/// Pixels along a side of the first tiles, and of the last: of those every pixel is asked for itself.
const FIRST: usize = 64;
const LAST: usize = 8;
/// Most pixels along a side.
const MOST: usize = 2048;
/// The axes of a slice.
const AXES: [&str; 4] = ["phi0", "phi1", "kappa0", "kappa1"];

/// What is asked for.
#[derive(Deserialize)]
pub struct Wanted {
    family: String,
    phi0: f64,
    phi1: f64,
    /// Range of κ0, with equal steps.
    kappa0: [f64; 2],
    /// Range of κ1, above 0, with equal ratios.
    kappa1: [f64; 2],
    width: usize,
    height: usize,
}

/// A square of pixels, or what is left of one at the border.
struct Tile {
    x: usize,
    y: usize,
    side: usize,
}

/// A slice in the making. Pixels are stored column by column, since κ1 is the grid's fastest axis.
pub struct Slice {
    family: &'static dyn Family,
    chart: usize,
    angles: [f64; 2],
    /// Edges of the pixels.
    edges: [Vec<f64>; 2],
    /// Their middles.
    grid: Grid,
    tiles: VecDeque<Tile>,
    flags: Vec<u8>,
    proved: usize,
}

impl Slice {
    /// # Errors
    /// [`Error::Domain`] for an unknown family, ranges that are none, or angles outside the family's domain.
    pub fn new(wanted: Wanted) -> Result<Slice> {
        let Wanted { family, phi0, phi1, kappa0, kappa1, width, height } = wanted;
        let family = family::by_name(&family).ok_or_else(|| Error::Domain(format!("no family is named `{family}`")))?;
        let chart = family.charts().iter().position(|chart: &Chart| chart.axes == AXES);
        let chart = chart.ok_or_else(|| Error::Domain(format!("`{}` has no axes kappa0 and kappa1", family.name())))?;
        if ![width, height].iter().all(|n| (2..=MOST).contains(n)) {
            return Err(Error::Domain(format!("the slice is {width} x {height} pixels; each side must be 2 to {MOST}")));
        }
        // Twice as fine: edges and middles in turn.
        let fine = |[lo, hi]: [f64; 2], count: usize, log: bool| {
            let count = 2 * count + 1;
            let spacing = if log { Spacing::Log { lo, hi, count } } else { Spacing::Linear { lo, hi, count } };
            Axis::new("kappa", spacing).map(|axis| axis.values().to_vec())
        };
        let (x, y) = (fine(kappa0, width, false)?, fine(kappa1, height, true)?);
        let every_other = |values: &[f64], from: usize| values.iter().copied().skip(from).step_by(2).collect::<Vec<f64>>();
        let axis = |(name, values): (&&str, Vec<f64>)| Axis::new(name, Spacing::Values(values));
        let middles = [vec![phi0], vec![phi1], every_other(&x, 1), every_other(&y, 1)];
        let grid = Grid::new(AXES.iter().zip(middles).map(axis).collect::<Result<_>>()?)?;
        // The angles are checked now rather than later.
        family.table(&grid)?;
        let corners = |n: usize| (0..n).step_by(FIRST);
        let tiles = corners(width).flat_map(|x| corners(height).map(move |y| Tile { x, y, side: FIRST })).collect();
        let edges = [every_other(&x, 0), every_other(&y, 0)];
        let flags = vec![0; width * height];
        Ok(Slice { family, chart, angles: [phi0, phi1], edges, grid, tiles, flags, proved: 0 })
    }

    /// The names and the order of what is drawn.
    pub fn about(&self) -> Value {
        let bit = |name: &&str| self.family.flags().iter().position(|flag| flag.name == *name);
        let flags: Vec<Value> = self.family.flags().iter().map(|f| json!({ "name": f.name, "label": f.label, "doc": f.doc })).collect();
        json!({ "flags": flags, "nested": self.family.nested().iter().filter_map(bit).collect::<Vec<_>>() })
    }

    /// The flags of each pixel, column by column, from below.
    pub fn flags(&self) -> &[u8] {
        &self.flags
    }

    /// Pixels all of whose points are proved.
    pub fn proved(&self) -> usize {
        self.proved
    }

    /// Works on so many tiles, and returns how many wait.
    pub fn refine(&mut self, tiles: usize) -> usize {
        let grid = self.grid.clone();
        // The angles were checked before.
        let Ok(table) = self.family.table(&grid) else { return 0 };
        for _ in 0..tiles {
            let Some(tile) = self.tiles.pop_front() else { break };
            self.work(&tile, &*table);
        }
        self.tiles.len()
    }

    fn work(&mut self, tile: &Tile, table: &dyn Table) {
        let Tile { x, y, side } = *tile;
        let [right, top] = [(x + side).min(self.edges[0].len() - 1), (y + side).min(self.edges[1].len() - 1)];
        let all = (0..self.family.flags().len()).fold(0, |mask, bit| mask | 1 << bit);
        if let Some(region) = self.family.region() {
            let [phi0, phi1] = self.angles;
            let low = [phi0, phi1, self.edges[0][x], self.edges[1][y]];
            let high = [phi0, phi1, self.edges[0][right], self.edges[1][top]];
            let facts = region.facts(self.chart, &low, &high, all);
            if facts.inside | facts.outside == all {
                self.fill([x, right, y, top], facts.inside);
                self.proved += (right - x) * (top - y);
                return;
            }
        }
        let rows = self.edges[1].len() - 1;
        if side <= LAST {
            for column in x..right {
                let start = column * rows + y;
                let mut codes = [Code::UNDECIDED; LAST];
                let codes = &mut codes[..top - y];
                table.filter(start as u64, codes);
                for (i, code) in codes.iter().enumerate() {
                    self.flags[start + i] = decided(table, start + i, *code);
                }
            }
            return;
        }
        // Until its parts are known, a tile looks like its middle.
        let middle = (x + right) / 2 * rows + (y + top) / 2;
        let mut code = [Code::UNDECIDED];
        table.filter(middle as u64, &mut code);
        self.fill([x, right, y, top], decided(table, middle, code[0]));
        let half = side / 2;
        for (x, y) in [(x, y), (x + half, y), (x, y + half), (x + half, y + half)] {
            if x < right && y < top {
                self.tiles.push_back(Tile { x, y, side: half });
            }
        }
    }

    fn fill(&mut self, [left, right, bottom, top]: [usize; 4], flags: u8) {
        let rows = self.edges[1].len() - 1;
        for column in left..right {
            self.flags[column * rows + bottom..column * rows + top].fill(flags);
        }
    }
}

/// The flags of a node: where doubles leave them open, by intervals. At the precision cap there are none.
fn decided(table: &dyn Table, node: usize, code: Code) -> u8 {
    if code != Code::UNDECIDED {
        return code.flags();
    }
    table.exact(node as u64).map_or(0, |(code, _)| code.flags())
}
