//! Certified cells: an atlas whose verdicts hold at every point between its nodes, not at nodes alone.
//!
//! The box of a recipe is divided into cells, `resolution` along each axis, a power of two. Of each flag a cell says
//! INSIDE (it holds at every real point of the closed cell that lies in the family's domain), OUTSIDE (it holds at
//! none) or MIXED (neither is known). These are proofs of [`crate::family::Region`]. [`Cells::lookup`] gives what the
//! cell of a point says, in nanoseconds; [`Cells::verdict`] gives the truth, because it asks the family itself where
//! the cell is MIXED.
//!
//! # How it is done
//! - `tree.rs`: the file's words. A few top cells say what is known of all flags at once. Below, each flag has a tree
//!   of its own, whose nodes divide a MIXED cell in two along each axis. So it is coarse where a flag is uniform, and
//!   fine at its boundary.
//! - `classify.rs`: what is proved of one cell, also by halves of it.
//! - `build.rs`: the trees, level by level, the flags that matter most first, until the budget is used up. Cells are
//!   independent of each other and results are taken in order, so the bytes do not depend on the number of threads.
//! - `file.rs`: one safetensors file, mapped and checked. docs/cells.md states it byte by byte.
//! - `check.rs`: compares a file with cells made anew, and attacks it with points. `verify.rs` judges it by both, and
//!   by its recipe.

mod build;
mod check;
mod classify;
mod file;
mod tree;
#[cfg(feature = "recipe")]
mod verify;

pub use build::{Built, build};
pub use check::{Attack, attack, differences};
pub use file::{Cells, bytes, write};
pub use tree::Known;
#[cfg(feature = "recipe")]
pub use verify::{Verified, verify};

use crate::family::{self, Family};
use crate::grid::Grid;

/// What [`build`] must know.
#[derive(Clone, Copy)]
pub struct Spec<'a> {
    /// The atlas's name: letters, digits, `_` and `-`.
    pub name: &'a str,
    /// The family.
    pub family: &'static dyn Family,
    /// The edges of the finest cells: one more than the resolution along each axis, or a single value, at which all
    /// cells lie.
    pub grid: &'a Grid,
    /// Most bytes of the file.
    pub budget: u64,
    /// The recipe's text.
    pub recipe: &'a str,
}

/// Whether so many cells along each axis can be: a power of two from 2 to 2048.
///
/// # Errors
/// In words, what is allowed.
pub fn check_resolution(resolution: usize) -> Result<(), String> {
    let fits = resolution.is_power_of_two() && (2..=2048).contains(&resolution);
    if fits { Ok(()) } else { Err(format!("the resolution is {resolution}; it must be a power of two from 2 to 2048")) }
}

/// Checks, before any work, that cells of a specification can be made.
///
/// # Errors
/// [`crate::Error::Domain`] as of [`build`].
pub fn check(spec: &Spec) -> crate::Result<()> {
    region(spec.family, spec.grid)?;
    build::shape(spec.grid, spec.family.about().flags.len()).map(|_| ())
}

/// The flags in the order in which a budget is spent on them: those that answer the family's question first.
fn by_weight(family: &dyn Family) -> Vec<usize> {
    let answers = |bit: &usize| family.about().yes.contains(&family.about().flags[*bit].name);
    let (first, rest): (Vec<usize>, Vec<usize>) = (0..family.about().flags.len()).partition(answers);
    [first, rest].concat()
}

/// The proofs of a family over boxes, and the chart of a grid's axes.
///
/// # Errors
/// [`crate::Error::Domain`] where the family has none in a chart of these axes, or the box lies outside its domain.
fn region(family: &'static dyn Family, grid: &Grid) -> crate::Result<(&'static dyn family::Region, usize)> {
    let names: Vec<&str> = grid.axes().iter().map(|a| a.name()).collect();
    let (region, chart) = family::proofs(family, &names)?;
    let sides = || grid.axes().iter().filter_map(|axis| Some((*axis.values().first()?, *axis.values().last()?)));
    let (mut low, mut high): (Vec<f64>, Vec<f64>) = sides().unzip();
    if !region.clip(chart, &mut low, &mut high) {
        // No datum of the box is in the domain, so the family refuses this one, too. Each coordinate is one that the
        // domain has, where it can be: so what is named is the coordinate that shuts the box out.
        let point = low.iter().zip(sides()).map(|(clipped, (low, high))| if *clipped <= high { *clipped } else { low });
        family::verdict(family, chart, &point.collect::<Vec<f64>>())?;
    }
    Ok((region, chart))
}
