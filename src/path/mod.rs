//! Path planning with Pythagorean-hodograph quintics: Hermite interpolation, paths of equal length, splines,
//! separation, corner rounding among obstacles.
//!
//! Everything is one curve type, [`PhQuintic`], in the user's plane and unit of length; angles are radians.
//!
//! Source: Farouki et al., Pythagorean-hodograph curves for path planning of unmanned vehicles.
//!
//! # How it is done
//! - One PH quintic type, `curve::PhQuintic`: pre-image and both ends. Both, so that ends are met exactly; control
//!   points come from the nearer end.
//! - Its energy is that of the family (`curve/energy.rs`): a proved enclosure needs no partial fractions,
//!   which cancel where roots nearly coincide.
//! - `curve/equal_length.rs`: of √p and √q the one that is a sum, the other from their product; the discriminant as a
//!   sum of squares. Nothing cancels near `θ1 = ±θ0`.
//! - `path/separation.rs` bounds by speeds and by accelerations. By speeds alone, two vehicles in step need
//!   `1/tolerance` stretches; with both, its square root; and one, where their pieces have the same shapes. Errors of a
//!   point are those of its arc length, since a chord is no longer than its arc. Time is cut where one starts or
//!   arrives: on a stretch each stands or moves.
//! - `path/way.rs` knows where a vehicle is after a length. The quadrature for kinds without a formula is cut into
//!   cells by a proved bound, not until two values agree, so its error is proved too.
//! - `path/tridiagonal.rs` is our own 60 lines: the linear algebra crates bring dense matrices and no complex banded
//!   solver; a closed loop is a change of rank one.
//! - `path/plan/`: obstacles are their sides in an R-tree (`rstar`), and sight is a distance from them; no polygon is
//!   grown, united or clipped. So touching and overlapping obstacles are no special case, and nothing is degenerate
//!   where a path runs along a wall.
//! - The search (`search.rs`) is A* over legs, not places, since a turn needs two of them; a leg is looked at again
//!   only when the turn at its start takes less of it. `petgraph` has no such search. Corner curves are proved clear
//!   when their leg comes up, not before.
//! - Corners beside vertices give short paths, but at low curvature their curves reach across the gaps. Then a few
//!   places in the open (`open.rs`), on rays from the ends and on boxes around everything, find in a second what many
//!   places further off each vertex did not find, or found twice as long.
//! - Guesses end there. `proof.rs` encloses the distance of the spans from all sides by chords and |r''|, with exact
//!   orientations (`robust`) for crossings; `most σ² ± h > 0` for the curvature is what `family/ph_path` proves for its
//!   tables. A path that starts outside and touches no side stays outside.
//! - Of `rstar` the proof needs that a box holds what is in it; whether a box matters is decided by our own test.
//! - Least curvature is branch and bound over the lengths of the end derivatives (`family/ph_path/bound.rs`). A box is
//!   bounded by means of curvatures at fixed parameters, with the length as a multiplier, weighted so that their slopes
//!   cancel; `num::Quadratic` keeps two orders in two symbols, and its error. At needles `2|w'|/|w|³` holds however
//!   sharp they are.
//! - `num-complex` for complex numbers: w has square roots and quotients throughout.

mod corner;
mod course;
mod least_curvature;
mod motion;
mod plan;
mod separation;
mod spline;
mod tridiagonal;
mod way;

pub use crate::num::Verdict;
pub use corner::Turn;
pub use course::{Course, OffsetCurve, Spot, Summary};
pub use least_curvature::{Directions, Free, LeastCurvature, least_curvature};
pub use motion::Motion;
pub use plan::{Clearance, Corner, Plan, Proof, Scene, plan, prove};
pub(crate) use separation::kept;
pub use separation::{Closest, Separation, separation, separations};
pub use spline::{Spline, spline};

use crate::curve::PhQuintic;
use crate::curve::vector::{complex, finite, pair};
use crate::error::{Error, Result};

/// Covers the roundings of a point, of a length, of a distance or of a tangent: none is the end of a chain of more than
/// 60.
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
    let fail = |why: String| Err(Error::invalid(format!("{what}: {why}")));
    if let Some(i) = spans.iter().position(|span| !span.is_finite()) {
        return fail(format!("span {i} of the path is not finite: {:?}", spans[i]));
    }
    match spans.windows(2).position(|w| w[0].end != w[1].start) {
        Some(i) => {
            fail(format!("span {i} ends at {:?}, the next one starts at {:?}", spans[i].end, spans[i + 1].start))
        }
        None => Ok(()),
    }
}
