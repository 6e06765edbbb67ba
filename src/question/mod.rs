//! Questions about data between nodes: where a property holds along a line, the nearest datum that has it, the outline
//! of a slice.
//!
//! They rest on two things alone: the verdict of a family at a point, and its proofs over boxes
//! ([`crate::family::Region`]). So they know no mathematics of any family, and serve each that has such proofs. What
//! they say between points is proved, never sampled. Where the work would not end, they stop after a stated number of
//! boxes and say what is left open.
//!
//! ```
//! use spiral_atlas::question::{Property, ranges};
//!
//! // Which end curvatures allow a cubic spiral, the other numbers being given?
//! let spiral = Property::new("cubic", &["phi0", "phi1", "kappa0", "kappa1"], "SPIRAL")?;
//! let found = ranges(&spiral, &[0.7, 1.4, 0.4, 0.0], 3, [0.0, 100.0])?;
//! assert_eq!(found.ranges.len(), 1);
//! let [start, end] = found.ranges[0].ends;
//! assert!(2.0 < start && start < 3.0 && 15.0 < end && end < 16.0);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```

mod boundary;
mod nearest;
mod property;
mod ranges;

pub use boundary::{Boundary, Outline, boundary};
pub use nearest::{Nearest, nearest};
pub use property::Property;
pub use ranges::{Range, Ranges, ranges};
