//! Path planning with Pythagorean-hodograph quintics: Hermite interpolation, paths of equal length, splines, separation,
//! corner rounding among obstacles.
//!
//! Everything is one curve type, [`PhQuintic`], in the user's plane and unit of length; angles are radians.
//!
//! Source: Farouki et al., Pythagorean-hodograph curves for path planning of unmanned vehicles.

mod corner;
mod course;
mod least_curvature;
mod plan;
mod queue;
mod separation;
mod spline;
mod tridiagonal;

pub use corner::Turn;
pub use course::{Course, OffsetCurve, Spot};
pub use least_curvature::{Directions, Free, LeastCurvature, least_curvature};
pub use plan::{Clearance, Corner, Plan, Proof, Scene, plan, prove};
pub use separation::{Closest, Motion, Separation, Verdict, separation, separations};
pub use spline::{Spline, spline};

use crate::curve::PhQuintic;
use crate::curve::vector::{complex, finite, pair};
use crate::error::{Error, Result};

/// Covers the roundings of a point, of a length, of a distance or of a tangent: none is the end of a chain of more than 60.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// How far the end of a span is from where its pre-image leads.
fn mismatch(span: &PhQuintic) -> f64 {
    let end = PhQuintic::new(span.start, span.preimage).end;
    distance(end, span.end)
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

/// Refuses spans that are not finite, or that do not join exactly.
fn check_joined(what: &str, spans: &[PhQuintic]) -> Result<()> {
    let fail = |told: String| Err(Error::Domain(format!("{what}: {told}")));
    if let Some(i) = spans.iter().position(|span| !span.is_finite()) {
        return fail(format!("span {i} of the path is not finite: {:?}", spans[i]));
    }
    match spans.windows(2).position(|w| w[0].end != w[1].start) {
        Some(i) => fail(format!("span {i} ends at {:?}, the next one starts at {:?}", spans[i].end, spans[i + 1].start)),
        None => Ok(()),
    }
}
