//! Making the trees, level by level.

use super::classify::{Bounds, Prover};
use super::tree::{Known, Layout, MOST_AXES, top_count};
use super::{Spec, by_weight, check_resolution, region};
use crate::error::{Error, Result};
use crate::family::MOST_SIDES;
use crate::grid::{Grid, Spacing};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Bytes of a word of the file.
const WORD: u64 = 4;
/// Cells that a worker takes at a time.
const PIECE: usize = 64;

/// The parts of a file of cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Built {
    pub(super) shape: Layout,
    pub(super) roots: Vec<u32>,
    pub(super) trees: Vec<u32>,
    pub(super) top: Vec<[u8; 2]>,
    /// Bytes of the tensors: less than the budget.
    pub bytes: u64,
}

/// A cell that a flag's tree divides.
struct Node {
    /// The index along each axis among the cells of its size.
    place: [u16; MOST_AXES],
    /// Children all over which the flag holds.
    yes: u16,
    /// Children in which it holds nowhere.
    no: u16,
    /// Whether its MIXED children are divided, too.
    divided: bool,
}

/// A flag's tree as far as it is made.
struct Tree {
    flag: u8,
    /// Whether each top cell that the flag leaves open is divided, in order.
    roots: Vec<bool>,
    levels: Vec<Vec<Node>>,
}

/// Makes the cells of a specification.
///
/// # Arguments
/// - `threads`: workers, at least 1. The result does not depend on their number.
/// - `stop`: when set, the work ends soon with [`Error::Interrupted`].
/// - `progress`: is told how many cells have been divided, whenever some more have.
///
/// # Errors
/// [`Error::Domain`] for a chart without proofs over boxes, axes of unlike or impossible counts, more than four
/// axes of several values, or a budget that is too small even for the top cells.
pub fn build(spec: &Spec, threads: usize, stop: &AtomicBool, progress: &(dyn Fn(u64) + Sync)) -> Result<Built> {
    let (region, chart) = region(spec.family, spec.grid)?;
    let (shape, prover) = (shape(spec.grid, spec.family.about().flags.len())?, prover(spec, region, chart));
    let (edges, all) = (Edges::new(spec.grid, shape), spec.family.about().all_flags());
    let work = Work { threads: threads.max(1), stop };
    let size = shape.depth - shape.top;
    let tops: Vec<[u16; MOST_AXES]> = (0..shape.top_cells()).map(|at| unpack(at, shape.top, shape.axes)).collect();
    let known = work.map(&tops, |place| prover.classify(&edges.bounds(place, size), size, all))?;
    let mut left = (spec.budget / WORD).saturating_sub(fixed_words(shape, &tops));
    if spec.budget / WORD < fixed_words(shape, &tops) {
        return Err(Error::invalid(format!(
            "the budget of `{}` is {} bytes; the {} top cells alone take {}",
            spec.name,
            spec.budget,
            shape.top_cells(),
            WORD * fixed_words(shape, &tops)
        )));
    }
    let open = |flag: u8, known: &Known| (known.inside | known.outside) >> flag & 1 == 0;
    let mut trees: Vec<Tree> = by_weight(spec.family)
        .iter()
        .map(|flag| Tree { flag: *flag as u8, roots: Vec::new(), levels: Vec::new() })
        .collect();
    let mut divided = 0;
    for size in (0..size).rev() {
        for tree in &mut trees {
            let words = Layout::words(size) as u64;
            // How many MIXED cells each parent has that would be divided: all of them or none.
            let counts: Vec<u64> = match tree.levels.last() {
                Some(parents) => parents.iter().map(|node| u64::from(node.mixed(shape).count_ones())).collect(),
                None => known.iter().filter(|known| open(tree.flag, known)).map(|_| 1).collect(),
            };
            let chosen = choose(&counts, words, &mut left);
            let places: Vec<[u16; MOST_AXES]> = match tree.levels.last_mut() {
                Some(parents) => {
                    parents.iter_mut().zip(&chosen).for_each(|(node, chosen)| node.divided = *chosen);
                    parents.iter().filter(|node| node.divided).flat_map(|node| node.mixed_places(shape)).collect()
                }
                None => {
                    let cells =
                        tops.iter().zip(&known).filter(|(_, known)| open(tree.flag, known)).map(|(place, _)| *place);
                    tree.roots = chosen;
                    cells.zip(&tree.roots).filter(|(_, chosen)| **chosen).map(|(place, _)| place).collect()
                }
            };
            let nodes = work.map(&places, |place| divide(&prover, &edges, shape, place, size, tree.flag))?;
            divided += nodes.len() as u64;
            progress(divided);
            tree.levels.push(nodes);
        }
    }
    trees.sort_by_key(|tree| tree.flag);
    Ok(lay_out(shape, &known, &trees))
}

/// Words that do not depend on the trees: top cells, roots, the axes' edges, and the header with a recipe of ordinary
/// length.
fn fixed_words(shape: Layout, tops: &[[u16; MOST_AXES]]) -> u64 {
    let header = 1 << 12;
    let axes = shape.axes as u64 * 2 * ((1 << shape.depth) + 1);
    tops.len() as u64 * (shape.flags as u64 + 1) + axes + header + 1
}

/// Which parents have their cells divided, within the words that are left, which it takes away: all of them, or an
/// even choice.
fn choose(counts: &[u64], words: u64, left: &mut u64) -> Vec<bool> {
    let needed = words * counts.iter().sum::<u64>();
    let share = if needed <= *left { 1 << 32 } else { ((*left as u128) << 32) as u64 / needed.max(1) };
    let chosen = counts.iter().enumerate().map(|(i, count)| {
        // By the golden ratio, so that the chosen lie among all.
        let fits = *count > 0 && u64::from((i as u32).wrapping_mul(0x9E37_79B9)) < share && count * words <= *left;
        if fits {
            *left -= count * words;
        }
        fits
    });
    chosen.collect()
}

impl Node {
    fn mixed(&self, shape: Layout) -> u32 {
        shape.children() & !u32::from(self.yes | self.no)
    }

    /// The places of the MIXED children, in order.
    fn mixed_places(&self, shape: Layout) -> impl Iterator<Item = [u16; MOST_AXES]> {
        let (mixed, place) = (self.mixed(shape), self.place);
        (0..1 << shape.axes)
            .filter(move |child| mixed >> child & 1 == 1)
            .map(move |child| child_place(&place, child, shape.axes))
    }
}

fn child_place(place: &[u16; MOST_AXES], child: u32, axes: usize) -> [u16; MOST_AXES] {
    let mut place = *place;
    for (i, index) in place[..axes].iter_mut().enumerate() {
        *index = *index << 1 | (child >> (axes - 1 - i) & 1) as u16;
    }
    place
}

fn unpack(mut at: usize, bits: u32, axes: usize) -> [u16; MOST_AXES] {
    let mut place = [0; MOST_AXES];
    for index in place[..axes].iter_mut().rev() {
        *index = (at & ((1 << bits) - 1)) as u16;
        at >>= bits;
    }
    place
}

/// The node of a cell, whose children have a size of 2 to the `size` finest cells.
fn divide(prover: &Prover, edges: &Edges, shape: Layout, place: &[u16; MOST_AXES], size: u32, flag: u8) -> Node {
    let mut node = Node { place: *place, yes: 0, no: 0, divided: false };
    for child in 0..1 << shape.axes {
        let known = prover.classify(&edges.bounds(&child_place(place, child, shape.axes), size), size, 1 << flag);
        node.yes |= u16::from(known.inside >> flag & 1) << child;
        node.no |= u16::from(known.outside >> flag & 1) << child;
    }
    node
}

fn lay_out(shape: Layout, known: &[Known], trees: &[Tree]) -> Built {
    let mut roots = vec![0; known.len() * shape.flags];
    let mut words = vec![0];
    // Of each flag, what is left of the top cells that it leaves open, and of each level: those of one top cell come
    // first.
    let mut left: Vec<(std::slice::Iter<bool>, Vec<std::slice::Iter<Node>>)> =
        trees.iter().map(|tree| (tree.roots.iter(), tree.levels.iter().map(|level| level.iter()).collect())).collect();
    for (cell, known) in known.iter().enumerate() {
        for (tree, (tops, levels)) in trees.iter().zip(&mut left) {
            if (known.inside | known.outside) >> tree.flag & 1 == 1 || tops.next() != Some(&true) {
                continue;
            }
            roots[cell * shape.flags + usize::from(tree.flag)] = words.len() as u32;
            let mut count = 1;
            for (level, size) in levels.iter_mut().zip((0..shape.depth - shape.top).rev()) {
                let mut next = words.len() + count * Layout::words(size);
                let mut below = 0;
                for node in level.take(count) {
                    words.push(u32::from(node.yes) | u32::from(node.no) << 16);
                    let mixed = if node.divided { node.mixed(shape).count_ones() as usize } else { 0 };
                    if size > 0 {
                        words.push(if mixed > 0 { next as u32 } else { 0 });
                        next += mixed * Layout::words(size - 1);
                        below += mixed;
                    }
                }
                count = below;
            }
        }
    }
    let top = known.iter().map(|known| [known.inside, known.outside]).collect::<Vec<_>>();
    let bytes = WORD * (roots.len() + words.len()) as u64 + 2 * top.len() as u64;
    Built { shape, roots, trees: words, top, bytes }
}

/// The shape of the cells between the nodes of a grid.
pub(super) fn shape(grid: &Grid, flags: usize) -> Result<Layout> {
    let counts: Vec<usize> = grid.shape().into_iter().filter(|count| *count > 1).collect();
    let Some(resolution) = counts.first().map(|count| count - 1) else {
        return Err(Error::invalid("all axes of cells have a single value; at least one must have a first and a last"));
    };
    check_resolution(resolution).map_err(Error::invalid)?;
    if counts.iter().any(|count| *count != counts[0]) {
        return Err(Error::invalid(format!("the axes of cells have {counts:?} edges; all must have the same number")));
    }
    if counts.len() > MOST_AXES {
        return Err(Error::invalid(format!(
            "cells have at most {MOST_AXES} axes, given: {}; give an axis a single value, as {{ values = [..] }}",
            counts.len()
        )));
    }
    let top = top_count(counts.len(), resolution);
    Ok(Layout { axes: counts.len(), flags, depth: resolution.ilog2(), top: top.ilog2() })
}

fn prover(spec: &Spec, region: &'static dyn crate::family::Region, chart: usize) -> Prover {
    let Spec { family, grid, .. } = *spec;
    let mut log = [false; MOST_SIDES];
    for (log, axis) in log.iter_mut().zip(grid.axes()) {
        *log = matches!(axis.spacing(), Spacing::Log { .. });
    }
    Prover { family, region, chart, axes: grid.axes().len(), log }
}

/// The edges of cells.
struct Edges<'g> {
    axes: Vec<&'g [f64]>,
}

impl<'g> Edges<'g> {
    fn new(grid: &'g Grid, shape: Layout) -> Edges<'g> {
        debug_assert!(grid.axes().len() >= shape.axes);
        Edges { axes: grid.axes().iter().map(|axis| axis.values()).collect() }
    }

    /// The box of the cell with these indices among those of 2 to the `size` finest cells.
    fn bounds(&self, place: &[u16; MOST_AXES], size: u32) -> Bounds {
        let mut bounds = [[0.0; MOST_SIDES]; 2];
        let mut places = place.iter();
        for (i, edges) in self.axes.iter().enumerate() {
            let sides = if let [only] = edges {
                [*only; 2]
            } else {
                let first = places.next().map_or(0, |place| usize::from(*place) << size);
                [edges[first], edges[first + (1 << size)]]
            };
            [bounds[0][i], bounds[1][i]] = sides;
        }
        bounds
    }
}

/// Workers.
struct Work<'s> {
    threads: usize,
    stop: &'s AtomicBool,
}

impl Work<'_> {
    /// The results of all items, in their order.
    fn map<T: Sync, R: Send>(&self, items: &[T], of: impl Fn(&T) -> R + Sync) -> Result<Vec<R>> {
        let next = AtomicUsize::new(0);
        let pieces: Mutex<Vec<(usize, Vec<R>)>> = Mutex::new(Vec::new());
        std::thread::scope(|scope| {
            for _ in 0..self.threads {
                scope.spawn(|| {
                    loop {
                        let start = next.fetch_add(PIECE, Ordering::Relaxed);
                        if start >= items.len() || self.stop.load(Ordering::Relaxed) {
                            return;
                        }
                        let piece = items[start..items.len().min(start + PIECE)].iter().map(&of).collect();
                        pieces.lock().unwrap_or_else(PoisonError::into_inner).push((start, piece));
                    }
                });
            }
        });
        if self.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let mut pieces = pieces.into_inner().unwrap_or_else(PoisonError::into_inner);
        pieces.sort_by_key(|piece| piece.0);
        Ok(pieces.into_iter().flat_map(|piece| piece.1).collect())
    }
}
