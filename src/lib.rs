//! Proved atlases of spiral regions: given two end points, tangents and curvatures, is there a transition curve with
//! monotone curvature of a given family, and which one?
//!
//! Where the curvature is monotone it never leaves the range between its two end values. So a limit of curvature that
//! both ends keep holds everywhere in between. The library answers for one datum, for grids of millions, and as a file
//! that other programs look answers up in. Every verdict is proved: it is a fact about the numbers given, not rounded
//! and not sampled.
//!
//! Lengths are in any unit, curvatures in one over that unit and positive to the left, angles in radians. Errors are
//! of one type, [`Error`], and say what is wrong, its value, and the way out. That there is no curve is no error but an
//! answer, with the reason.
//!
//! # A tour
//! **Two ends in the plane** ([`transition`]): a curve in your own units, or why there is none.
//!
//! ```
//! use spiral_atlas::transition::{Ends, spiral};
//!
//! let ends = Ends {
//!     start: [0.0, 0.0],
//!     end: [200.0, 0.0],
//!     start_direction: -40f64.to_radians(),
//!     end_direction: 80f64.to_radians(),
//!     start_curvature: 0.004,
//!     end_curvature: 0.04,
//! };
//! let answer = spiral(&ends)?;
//! let curve = answer.chosen().expect("a cubic spiral joins them");
//! assert_eq!((curve.control_points.p[0], curve.control_points.p[3]), (ends.start, ends.end));
//! assert!((curve.length - 229.564).abs() < 1e-3);
//!
//! let flat = spiral(&Ends { end_curvature: 0.01, ..ends })?;
//! assert!(flat.to_string().contains("the end curvature 0.01 must be above 0.0146662"));
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! **One datum of a family** ([`family`]): all solutions, in the frame of the paper, with what is proved of each.
//!
//! ```
//! use spiral_atlas::family::{cubic, ph_quintic};
//!
//! let found = cubic::solve(&cubic::Datum { phi0: 0.7, phi1: 1.4, kappa0: 0.4, kappa1: 4.0 })?;
//! assert!(found.chosen().is_some_and(|root| root.spiral && root.margin > 0.0));
//!
//! // A Pythagorean-hodograph quintic may even have three spirals with the same ends.
//! let found = ph_quintic::solve(&ph_quintic::Datum { phi0: 0.514, phi1: 1.536, kappa0: 0.2049, kappa1: 3.77 })?;
//! assert_eq!(found.all().iter().filter(|curve| curve.spiral).count(), 3);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! **A grid of data** ([`grid`], [`eval`]): every node decided, in chunks, on all threads and in bounded memory.
//!
//! ```
//! use spiral_atlas::eval::{Backend, Job, evaluate};
//! use spiral_atlas::family::cubic::{Cubic, SPIRAL};
//! use spiral_atlas::grid::{Axis, Grid, Spacing};
//! use std::sync::atomic::AtomicBool;
//!
//! let grid = Grid::new(vec![
//!     Axis::new("phi0", Spacing::Values(vec![0.7]))?,
//!     Axis::new("phi1", Spacing::Values(vec![1.4]))?,
//!     Axis::new("kappa0", Spacing::Linear { lo: 0.02, hi: 1.0, count: 99 })?,
//!     Axis::new("kappa1", Spacing::Log { lo: 1.0, hi: 100.0, count: 101 })?,
//! ])?;
//! let (mut spirals, never) = (0, AtomicBool::new(false));
//! evaluate(&Job { family: &Cubic, grid: &grid, scalars: &[] }, &Backend::Cpu, 2, &never, |chunk| {
//!     spirals += chunk.flags.iter().filter(|flags| *flags & SPIRAL != 0).count();
//!     Ok(())
//! })?;
//! assert!(spirals > 1000 && spirals < 99 * 101);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! **An atlas file** ([`atlas`]): mapped, checked in full, and looked up without allocation. `spiral-atlas generate`
//! makes one, and so does [`atlas::Writer`].
//!
//! ```no_run
//! use spiral_atlas::{atlas::Atlas, family::cubic::SPIRAL};
//!
//! let atlas = Atlas::open("out/quickstart.atlas.safetensors")?;
//! let (_node, entry) = atlas.nearest(&[0.7, 1.4, 0.4, 4.0]).expect("inside the grid");
//! assert!(entry.flags & SPIRAL != 0);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! **A path** ([`path`]): through points, among obstacles, of equal length, and apart from others, with
//! Pythagorean-hodograph quintics. Length, clearance and greatest curvature are known or proved.
//!
//! ```
//! use spiral_atlas::path::{Scene, plan};
//!
//! let wall = vec![[1.0, -9.0], [1.5, -9.0], [1.5, 1.0], [1.0, 1.0]];
//! let path = plan(&Scene {
//!     start: [0.0, 0.0],
//!     goal: [3.0, 0.0],
//!     obstacles: vec![wall],
//!     clearance: 0.2,
//!     greatest_curvature: 4.0,
//! })?;
//! let length: f64 = path.spans.iter().map(|span| span.length()).sum();
//! assert!(length > 3.0 && length < 5.0);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! The folder `examples/` has these as programs, such as `cargo run --release --example two_ends`.
//!
//! # Features
//! All of them are on by default. Without them the library builds in seconds, and still solves, evaluates on the
//! processor, plans, and reads and writes atlases.
//!
//! | feature | adds |
//! | --- | --- |
//! | `gpu` | the evaluator on GPUs, by wgpu |
//! | `cli` | the program, with `dxf`, `export` and `picture` |
//! | `dxf` | drawings in DXF, with `export` |
//! | `export` | paths as files of other programs: OpenDRIVE, motion primitives for nav2 |
//! | `picture` | pictures as PNG and SVG files, with `recipe` |
//! | `recipe` | the reader of recipes alone |

pub mod atlas;
pub mod cells;
pub mod curve;
pub mod error;
pub mod eval;
#[cfg(feature = "export")]
pub mod export;
pub mod family;
// For the program and the tests of this package alone: no part of what the library promises.
#[doc(hidden)]
pub mod files;
pub mod grid;
#[cfg(test)]
mod noise;
mod num;
pub mod path;
#[cfg(feature = "picture")]
pub mod picture;
#[doc(hidden)]
pub mod plain;
#[cfg(feature = "picture")]
pub mod plot;
pub mod question;
#[cfg(feature = "recipe")]
pub mod recipe;
pub mod tools;
pub mod transition;

mod queue;
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
