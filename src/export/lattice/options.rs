//! What a lattice is made for.

use crate::error::{Error, Result};
use crate::transition::join::Family;

/// Most headings.
const MOST_HEADINGS: usize = 128;
/// Most cells in a turning radius: the search looks at some 20 times its square.
const MOST_CELLS: f64 = 200.0;
/// Lengths in metres are from one over this to this.
const WIDEST: f64 = 1e6;

/// What primitives are made for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LatticeOptions {
    /// Least radius, in metres: no primitive bends more than one over this.
    pub turning_radius: f64,
    /// Length of a cell, in metres; that of the costmap.
    pub grid_resolution: f64,
    /// How many directions there are: a multiple of 8, from 16 to 128.
    pub headings: usize,
    /// From 0 to 1. Two primitives with the same directions end further apart than this times the length of the longer.
    pub distinctness: f64,
    /// What the spirals are.
    pub family: Family,
}

impl LatticeOptions {
    /// With nav2's usual numbers: 16 headings, distinctness 0.9; and cubic spirals.
    pub fn new(turning_radius: f64, grid_resolution: f64) -> LatticeOptions {
        LatticeOptions { turning_radius, grid_resolution, headings: 16, distinctness: 0.9, family: Family::Cubic }
    }

    /// # Errors
    /// [`Error::Domain`] naming the first that is out of range.
    pub(super) fn check(&self) -> Result<()> {
        let fail = |what: String| Err(Error::invalid(format!("lattice: {what}")));
        let LatticeOptions { turning_radius, grid_resolution, headings, distinctness, .. } = *self;
        for (name, x) in [("turning radius", turning_radius), ("grid resolution", grid_resolution)] {
            if !(1.0 / WIDEST..=WIDEST).contains(&x) {
                return fail(format!("the {name} is {x:?} m; it must be from 1e-6 to 1e6"));
            }
        }
        if headings % 8 != 0 || !(16..=MOST_HEADINGS).contains(&headings) {
            return fail(format!("{headings} headings; it must be a multiple of 8, from 16 to {MOST_HEADINGS}"));
        }
        if !(0.0..=1.0).contains(&distinctness) {
            return fail(format!("the distinctness is {distinctness:?}; it must be from 0 to 1"));
        }
        let cells = turning_radius / grid_resolution;
        if cells < 1.0 {
            return fail(format!(
                "the grid resolution {grid_resolution:?} m is larger than the turning radius {turning_radius:?} m; \
                 take a finer grid"
            ));
        }
        if cells > MOST_CELLS {
            return fail(format!(
                "the turning radius is {cells:.0} cells of {grid_resolution:?} m, and at most {MOST_CELLS} are \
                 searched; take a coarser grid"
            ));
        }
        Ok(())
    }
}
