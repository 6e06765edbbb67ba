//! Whether a file of cells is true: by making it anew, and by points that know nothing of boxes.

use super::build::Built;
use super::file::Cells;
use super::tree::Known;
use crate::error::{Error, Result};
use crate::family::{Code, Family};
use crate::grid::{Axis, Grid, Spacing};
use std::sync::atomic::{AtomicBool, Ordering};

/// What an attack found.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Attack {
    /// Points that were asked about.
    pub points: u64,
    /// Verdicts of cells that were compared with the truth.
    pub verdicts: u64,
    /// Those that are wrong.
    pub wrong: u64,
    /// The first of them, in words.
    pub first: Option<String>,
}

/// In how many words a file differs from cells made anew, and the first of them in words.
pub fn differences(cells: &Cells, fresh: &Built) -> (u64, Option<String>) {
    let words = cells.words();
    if words.shape != fresh.shape {
        return (1, Some("the cells made anew have another shape".into()));
    }
    let mut found = (0, None);
    let mut compare = |name: &str, stored: Vec<u32>, fresh: &[u32]| {
        let differ = stored.iter().zip(fresh).enumerate().filter(|(_, (a, b))| a != b);
        let mut count = stored.len().abs_diff(fresh.len()) as u64;
        let mut first =
            (count > 0).then(|| format!("`{name}` has {} words, made anew it has {}", stored.len(), fresh.len()));
        for (i, (a, b)) in differ {
            count += 1;
            first.get_or_insert_with(|| format!("`{name}` at {i} is {a:#010x}, made anew {b:#010x}"));
        }
        found.0 += count;
        found.1 = found.1.take().or(first);
    };
    let wide = |top: &[[u8; 2]]| top.iter().map(|pair| u32::from(u16::from_le_bytes(*pair))).collect::<Vec<u32>>();
    let numbers = |words: &[[u8; 4]]| words.iter().map(|word| u32::from_le_bytes(*word)).collect::<Vec<u32>>();
    compare("top", wide(words.top), &wide(&fresh.top));
    compare("roots", numbers(words.roots), &fresh.roots);
    compare("trees", numbers(words.trees), &fresh.trees);
    found
}

/// Asks the family itself about points and compares its answers with those of the cells: a third of the coordinates
/// are anywhere in the box, a third are edges of cells, a third are doubles beside edges. Where a point leaves the
/// family's domain, it is left out.
///
/// # Arguments
/// - `rounds`: each asks about all combinations of four coordinates an axis, up to 256 points.
///
/// # Errors
/// [`Error::Undecided`], [`Error::Interrupted`].
pub fn attack(cells: &Cells, rounds: u64, seed: u64, stop: &AtomicBool) -> Result<Attack> {
    let mut random = Random(seed);
    let mut found = Attack { points: 0, verdicts: 0, wrong: 0, first: None };
    for _ in 0..rounds {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let axes = cells.grid().axes().iter().map(|axis| {
            let mut values: Vec<f64> = (0..4).map(|_| random.coordinate(axis)).collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            Axis::new(axis.name(), Spacing::Values(values))
        });
        let grid = Grid::new(axes.collect::<Result<_>>()?)?;
        let Some(codes) = truth(cells.family(), &grid)? else { continue };
        for (i, code) in codes.iter().enumerate() {
            let node = grid.node(i as u64);
            let Some(Known { inside, outside }) = cells.lookup(&node[..grid.axes().len()]) else { continue };
            let wrong = inside & !code.flags() | outside & code.flags();
            found.points += 1;
            found.verdicts += u64::from((inside | outside).count_ones());
            found.wrong += u64::from(wrong.count_ones());
            if wrong != 0 {
                let flag = cells.family().about().flags[wrong.trailing_zeros() as usize].name;
                let said = if inside & wrong != 0 { "INSIDE" } else { "OUTSIDE" };
                found
                    .first
                    .get_or_insert_with(|| format!("{}: its cell says {said} of {flag}", grid.describe(i as u64)));
            }
        }
    }
    Ok(found)
}

/// The codes of all nodes; `None` where the grid leaves the family's domain.
fn truth(family: &dyn Family, grid: &Grid) -> Result<Option<Vec<Code>>> {
    let Ok(table) = family.table(grid) else { return Ok(None) };
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    table.filter(0, &mut codes);
    for (i, code) in codes.iter_mut().enumerate().filter(|(_, code)| **code == Code::UNDECIDED) {
        *code = table.exact(i as u64)?.0;
    }
    Ok(Some(codes))
}

/// Splitmix64: small, seeded, the same everywhere.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % n
    }

    /// A coordinate of an axis: anywhere in a cell, an edge, or beside one.
    fn coordinate(&mut self, axis: &Axis) -> f64 {
        let edges = axis.values();
        if let [only] = edges {
            return *only;
        }
        let i = self.below(edges.len() as u64 - 1) as usize;
        let (low, high) = (edges[i], edges[i + 1]);
        match self.below(6) {
            0 | 1 => low + (high - low) * (self.below(1 << 40) as f64 / (1u64 << 40) as f64),
            2 => low,
            3 => high,
            4 => low.next_up(),
            _ => high.next_down(),
        }
    }
}
