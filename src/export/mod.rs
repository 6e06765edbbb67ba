//! Paths as files that other programs read.

mod lattice;
mod opendrive;

pub use lattice::{Lattice, LatticeOptions, Primitive, lattice};
pub use opendrive::{Fit, OpenDrive, opendrive};
