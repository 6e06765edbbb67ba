//! Proved atlases of spiral regions: given two end points, tangents and curvatures, is there a transition curve with
//! monotone curvature of a given family, and which one?

pub mod atlas;
pub mod cells;
pub mod curve;
pub mod error;
pub mod eval;
pub mod family;
pub mod files;
pub mod grid;
#[cfg(test)]
mod noise;
pub mod num;
pub mod path;
#[cfg(feature = "cli")]
pub mod picture;
#[cfg(feature = "cli")]
pub mod plot;
#[cfg(feature = "recipe")]
pub mod recipe;
pub mod transition;

mod steps;

pub use error::{Error, Result};

/// The examples of the pages compile and, where they need no file, run.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[doc = include_str!("../docs/cells.md")]
    struct Cells;
    #[doc = include_str!("../docs/any-spiral.md")]
    struct AnySpiral;
    #[doc = include_str!("../docs/reach.md")]
    struct Reach;
    #[doc = include_str!("../docs/path.md")]
    struct Path;
}
