//! Paths as files that other programs read.

#[cfg(feature = "dxf")]
mod dxf;
mod lattice;
mod opendrive;

#[cfg(feature = "dxf")]
pub use dxf::dxf;
pub use lattice::{Lattice, LatticeOptions, Primitive, lattice};
pub use opendrive::{Fit, OpenDrive, opendrive};
