//! Joins: paths of few spirals, arcs and lines between two states, with continuous direction and curvature and a limit
//! of curvature.
//!
//! ```
//! use spiral_atlas::transition::Turn;
//! use spiral_atlas::transition::join::{End, Request, State, join};
//!
//! // A robot with a least radius of 2 turns a corner.
//! let from = State { point: [0.0, 0.0], direction: 0.0, curvature: 0.0 };
//! let to = State { point: [8.0, 6.0], direction: 1.5, curvature: 0.1 };
//! let found = join(&Request::new(from, to, 0.5))?;
//! let path = found.expect("there is room");
//! assert!(path.measures.greatest_curvature <= 0.5 && path.measures.length > 10.0);
//!
//! // From a straight line to a circle by one spiral.
//! let line = End::Line { point: [0.0, 0.0], direction: 0.0 };
//! let circle = End::Circle { centre: [0.0, 31.0], radius: 30.0, turn: Turn::Left };
//! let found = join(&Request { most_pieces: 1, ..Request::new(line, circle, 1.0 / 30.0) })?;
//! assert_eq!(found.map(|path| path.pieces.len()), Ok(1));
//! # Ok::<(), spiral_atlas::Error>(())
//! ```
//!
//! # How it is done
//! As Dubins paths are made of arcs and lines, these are made of *turns* and lines. A turn is a spiral from the
//! curvature at hand to that of an arc, the arc, and a spiral to curvature 0 (Fraichard & Scheuer 2004 have it with
//! clothoids). The centre of the arc does not depend on how long the arc is. So all places where the turn can end
//! straight lie on a circle about that centre, and are left at a fixed angle: `X = C + R(ψ) u` for the direction ψ
//! there. Two turns with a line between them have then `C2 - C1 = R(ψ) ((l, 0) + u1 - u2)`, and three turns have a
//! middle centre at two known distances: all closed forms.
//!
//! Turns of several curvatures and of spirals of several lengths are tried in all pairs, the same for each objective. A
//! model ranks them. The best by each objective are built and measured, so no answer is beaten by that to another
//! objective. Lengths are bounded before anything is built. So for the shortest join, pairs that must be longer than
//! another are left out early, and all that may be the shortest are built. A join is made of spirals that are proved.
//! In units of the least radius the spirals are 0.4 long or longer: from shorter ones, control points in doubles could
//! not show the curvature to 1e-12.
//!
//! Lines and circles are joined by the same spirals, laid out by the centres of circles: see `link.rs` and `shapes.rs`,
//! and `alone.rs` for what two lines need no arc for.

mod alone;
mod best;
mod costs;
mod ease;
mod lengths;
mod link;
mod locus;
mod measure;
mod request;
mod shapes;
mod spiral;
mod states;
mod third;
mod trig;
mod turns;

use super::piece::principal;
use crate::curve::vector::{length, scale, sub};
use crate::error::written;
use crate::error::{Error, Result};
use crate::num::demand_ieee;
use crate::plain::count;
use best::Best;
use std::f64::consts::TAU;

pub use measure::Measures;
pub use request::{End, Family, Join, Objective, Request, State};

/// Ends farther apart or from the origin, in least radii, would leave no digits for the spirals.
const FARTHEST: f64 = 1e12;

/// The best join found.
///
/// # Accuracy
/// Each spiral is proved to have monotone curvature, so |κ| stays within the limit. Pieces meet to 1e-12 in position,
/// direction and curvature, relative to the extent of coordinates in least radii; given points are met exactly. The
/// join is the best of those tried, not of all. So a given curvature of less than 1e-12 of the limit counts as 0: the
/// path is straight there.
///
/// # Errors
/// [`Error::Domain`] naming a number that is not finite or not above 0, where a state is to be joined with a
/// line or a circle, where the ends are more than 1e12 least radii apart or from the origin or circles are larger than
/// that, and where lengths leave the range of doubles. That there is no join is no error.
pub fn join(request: &Request) -> Result<std::result::Result<Join, String>> {
    demand_ieee()?;
    request.check()?;
    let limit = request.greatest_curvature;
    if let Some(why) = beyond(request) {
        return Ok(Err(why));
    }
    let request = &reckoned(request);
    let radii = |end: &End| if let End::Circle { radius, .. } = end { radius * limit } else { 0.0 };
    let [from, to] = [&request.from, &request.to].map(|end| scale(end.point(), limit));
    let far = [
        ("the ends are", " apart", length(sub(to, from))),
        ("the start is", " from the origin", length(from)),
        ("the end is", " from the origin", length(to)),
        ("the start radius is", "", radii(&request.from)),
        ("the end radius is", "", radii(&request.to)),
    ];
    if let Some((what, whence, far)) = far.into_iter().find(|(.., far)| far.is_nan() || *far > FARTHEST) {
        let far = if far.is_finite() { written(far) } else { "more than 1.8e308".into() };
        return Err(Error::invalid(format!(
            "{what} {far} least radii{whence}, where no join is sought: doubles have no digits left for spirals beyond \
             1e12 least radii (one over the greatest curvature); check the unit of length"
        )));
    }
    let mut best = Best::new(request);
    let none = tried(request, &mut best)?;
    if let Some(join) = best.join() {
        return Ok(Ok(join));
    }
    let free = Request { longest: f64::INFINITY, most_pieces: Request::MOST_PIECES, ..*request };
    let mut best = Best::new(&free);
    if free != *request {
        tried(&free, &mut best)?;
    }
    Ok(Err(match best.join() {
        Some(join) => {
            let most = (request.most_pieces < free.most_pieces).then(|| count(request.most_pieces, "piece"));
            let longest = request.longest.is_finite().then(|| format!("a length of {}", written(request.longest)));
            let bounds: Vec<String> = most.into_iter().chain(longest).collect();
            let without = if bounds.len() == 1 { "that bound" } else { "these bounds" };
            let (pieces, length) = (count(join.pieces.len(), "piece"), written(join.measures.length));
            format!(
                "no join found keeps to {}; without {without} one has {pieces} and is {length} long",
                bounds.join(" and ")
            )
        }
        None => none,
    }))
}

/// The same to the accuracy of joins, in numbers that are reckoned with: a curvature of less than 1e-12 of the limit is
/// 0, and a direction of more than a full turn is the same one within half a turn.
fn reckoned(request: &Request) -> Request {
    let reduced = |direction: f64| if direction.abs() > TAU { principal(direction) } else { direction };
    let end = |end: &End| match *end {
        End::State(State { point, direction, curvature }) => {
            let straight = curvature.abs() * FARTHEST < request.greatest_curvature;
            let curvature = if straight { 0.0 } else { curvature };
            End::State(State { point, direction: reduced(direction), curvature })
        }
        End::Line { point, direction } => End::Line { point, direction: reduced(direction) },
        circle => circle,
    };
    Request { from: end(&request.from), to: end(&request.to), ..*request }
}

/// Offers all joins that are tried, and says why there is none, should there be none.
fn tried(request: &Request, best: &mut Best) -> Result<String> {
    if let (End::State(from), End::State(to)) = (&request.from, &request.to) {
        if states::same(from, to) {
            return Ok("the two states are one: there is nothing to join".into());
        }
        states::states(request, [from, to], best)?;
        return Ok(
            "no turns and lines of those tried fit between these states; a greater limit of curvature gives them room"
                .into(),
        );
    }
    shapes::shapes(request, best)
}

/// A given curvature is beyond the limit.
fn beyond(request: &Request) -> Option<String> {
    let limit = request.greatest_curvature;
    let too_much = |(name, end): (&str, &End)| match *end {
        End::State(State { curvature, .. }) if curvature.abs() > limit => {
            Some(format!("the {name} curvature {curvature:?} is beyond the greatest curvature {limit:?}"))
        }
        End::Circle { radius, .. } if 1.0 / radius > limit => Some(format!(
            "the {name} circle has the radius {radius:?} and so the curvature {:?}, beyond the greatest curvature \
             {limit:?}",
            1.0 / radius
        )),
        _ => None,
    };
    [("start", &request.from), ("end", &request.to)].into_iter().find_map(too_much)
}
