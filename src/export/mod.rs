//! Paths as files that other programs read.

mod opendrive;

pub use opendrive::{Fit, OpenDrive, opendrive};
