//! Geometry alone: points, vectors and derivatives, Bézier curves, Pythagorean-hodograph quintics and trigonometric
//! quintics, their length, extrema, offsets and bending energy. Nothing here asks whether a curve is a spiral.

mod bending;
mod bezier;
mod choice;
mod energy;
mod equal_length;
mod extrema;
mod hermite;
pub(crate) mod hodograph;
mod jet;
mod length;
mod offset;
mod peak;
mod quintic;
mod trig_bezier;
pub(crate) mod vector;

pub use bezier::CubicBezier;
pub use choice::{Candidate, Choice};
pub(crate) use energy::energy;
pub use equal_length::{EqualLength, equal_length};
pub use hermite::{Hermite, hermite};
pub use jet::Jet;
pub(crate) use jet::casteljau;
pub use length::arc_length;
pub(crate) use length::{gauss, parameter_of};
pub use offset::Offset;
pub use quintic::PhQuintic;
pub use trig_bezier::TrigBezier;
