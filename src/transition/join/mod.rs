//! Joins: paths of few spirals, arcs and lines between two states, with continuous direction and curvature and a limit of curvature.
//!
//! # How it is done
//! As Dubins paths are made of arcs and lines, these are made of *turns* and lines. A turn is a spiral from the curvature at hand to that
//! of an arc, the arc, and a spiral to curvature 0 (Fraichard & Scheuer 2004 have it with clothoids). The centre of the arc does not depend
//! on how long the arc is. So all places where the turn can end straight lie on a circle about that centre, and are left at a fixed
//! angle: `X = C + R(ψ) u` for the direction ψ there. Two turns with a line between them have then `C2 - C1 = R(ψ) ((l, 0) + u1 - u2)`,
//! and three turns have a middle centre at two known distances: all closed forms.
//!
//! Turns of several curvatures and of spirals of several lengths are tried in all pairs. The best pair whose spirals are proved is taken.
//! In units of the least radius the spirals are 0.4 long or longer: from shorter ones, control points in doubles could not show the
//! curvature to 1e-12.

mod measure;
mod request;
mod spiral;
mod states;
mod turns;

pub use measure::Measures;
pub use request::{Family, Join, Objective, Outcome, Request, State};
pub use states::join;
