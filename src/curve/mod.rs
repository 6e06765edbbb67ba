//! The curves themselves: points, curvature and arc length, placement in the user's plane, and the transition spiral
//! between two given ends: cubic (Habib & Sakai, section 3.2), or an involute's image (Kurnosenko).
//!
//! ```
//! use spiral_atlas::curve::{Ends, Placement};
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

mod bezier;
mod bound;
mod extrema;
mod figure;
mod involute;
mod jet;
mod length;
mod none;
mod offset;
mod ph;
mod piece;
mod placement;
mod quintic;
pub mod reach;
mod remedy;
mod spiral;
mod stations;
pub mod trig;
mod vector;
mod why;
mod words;

pub use bezier::CubicBezier;
pub use bound::least_end_curvature;
pub use figure::{EndCircle, Figure, Sample};
pub use involute::{
    Chord, Frame, Involute, InvolutePoint, Outcome as InvoluteOutcome, Spiral, Split, WhyNone, involute, involute_between,
};
pub use jet::Jet;
pub use length::arc_length;
pub use none::{Bound, Need, NoSpiral};
pub use offset::Offset;
pub use ph::{PhAnswer, PhOutcome, PhSolution, ph_spiral};
pub use piece::{Arc, At, Cubic, InvoluteBetween, Kind, Line, Piece, TrigPart};
pub use placement::{Ends, Placement, direction_of};
pub use quintic::PhQuintic;
pub use remedy::Remedy;
pub use spiral::{Answer, Outcome, Solution, spiral};
pub use stations::{Station, stations};
pub use why::{Turn, Waver, Which, Why};
