//! Transition curves in the user's frame: placement in the plane, the spiral between two given ends or the reason why
//! there is none, segments added to a line or a circle, and templates made of two spirals.
//!
//! ```
//! use spiral_atlas::transition::{Ends, Placement};
//!
//! // A right turn whose curvature falls: normalised by reversal alone.
//! let ends = Ends {
//!     start: [500_000.0, 5_200_000.0],
//!     end: [500_200.0, 5_200_000.0],
//!     start_direction: 1.4,
//!     end_direction: -0.7,
//!     start_curvature: -0.04,
//!     end_curvature: -0.004,
//! };
//! let (datum, placement) = Placement::normalise(&ends)?;
//! assert_eq!((datum.phi0, datum.kappa0, datum.kappa1), (0.7, 0.4, 4.0));
//! assert!(placement.reversed && !placement.mirrored);
//! let curve = placement.place(&datum, 1.66010274767, 0.76985066613);
//! assert_eq!((curve.p[0], curve.p[3]), (ends.start, ends.end));
//! # Ok::<(), spiral_atlas::Error>(())
//! ```

mod clothoid;
mod cubic;
mod figure;
mod fit;
mod involute;
pub mod join;
mod nearby;
mod none;
mod others;
mod ph_quintic;
mod piece;
mod placement;
mod remedy;
pub mod segment;
mod stations;
pub mod templates;
mod turn;
mod why;
mod words;

pub use crate::error::MOST_SAMPLES;
pub use clothoid::Clothoid;
pub use cubic::{Answer, Solution, spiral};
pub use figure::{EndCircle, Figure, Sample};
pub use fit::{FITTED, Fit, fit, fitted};
pub use involute::{Frame, involute_between, polyline, why_no_spiral};
pub use nearby::nearby;
pub use none::{Bound, Need, NoSpiral};
pub use others::Others;
pub use ph_quintic::{PhAnswer, PhSolution, ph_spiral};
pub use piece::{Arc, At, Cubic, InvoluteBetween, Kind, Line, Piece, TrigPart};
pub use placement::{Ends, Placement, direction_of};
pub use remedy::Remedy;
pub use stations::{Station, stations};
pub use turn::{Turn, Which};
pub use why::{NonSpiral, Why};
