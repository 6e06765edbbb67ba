//! Adding a spiral segment to the end of a line or of a circle.

use super::Turn;
use super::piece::{Cubic, Piece};
use super::placement::{Ends, Placement};
use super::words::{above, degrees};
use crate::curve::vector::{Vector, add, scale, sub, turn};
use crate::curve::{CubicBezier, PhQuintic};
use crate::error::{Error, OTHER_UNIT, Result, finite, positive, written};
use crate::family::reach::{Datum, Kind, Level, legs, level_of_shape, preimage, solve};
use serde::{Deserialize, Serialize};

/// What the segment is added to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Base {
    /// The end of a straight line: curvature grows from 0 to 1/r (case 1).
    Line,
    /// The end of an arc of radius r: curvature falls from 1/r to 0 (case 2).
    Circle,
}

/// How the segment is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Target {
    /// By its shape.
    Shape {
        /// m, positive.
        m: f64,
        /// q, positive.
        q: f64,
    },
    /// By its end point, in the user's coordinates.
    Point([f64; 2]),
}

/// A segment to add, in the user's units and axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Request {
    /// What it is added to.
    pub base: Base,
    /// Where it starts: the end of the line or arc.
    pub start: [f64; 2],
    /// Direction of travel there: counter-clockwise angle from the x axis, radians.
    pub direction: f64,
    /// Which way it turns.
    pub turn: Turn,
    /// r: the radius of its round end, positive.
    pub radius: f64,
    /// How far it turns, radians, positive: below π/2 (cubic) or π (PH quintic).
    pub theta: f64,
    /// Its shape or its end point.
    pub target: Target,
}

impl Request {
    /// The segment between two ends one of which is straight. There is none where neither is or both are, and where no
    /// C-shaped curve that turns to the side of the round end joins them.
    ///
    /// # Accuracy
    /// [`Request::theta`] and [`Request::radius`] to 4e-15.
    ///
    /// # Errors
    /// Those of [`Placement::normalise`].
    pub fn between(ends: &Ends) -> Result<Option<Request>> {
        // There the straight end comes first.
        let (datum, placement) = Placement::normalise(ends)?;
        let fits = datum.kappa0 == 0.0 && datum.kappa1 > 0.0 && datum.phi0 > 0.0 && datum.phi1 > 0.0;
        Ok(fits.then(|| Request {
            base: if placement.reversed { Base::Circle } else { Base::Line },
            start: ends.start,
            direction: ends.start_direction,
            turn: placement.turn(),
            radius: 1.0 / ends.start_curvature.abs().max(ends.end_curvature.abs()),
            theta: datum.phi0 + datum.phi1,
            target: Target::Point(ends.end),
        }))
    }
}

/// A segment with everything asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Added {
    /// 1 or 2, as in the paper.
    pub case: u8,
    /// End point over r, in the frame of the start.
    pub xi: f64,
    /// See `xi`; positive on the side to which it turns.
    pub eta: f64,
    /// Shape.
    pub m: f64,
    /// Shape.
    pub q: f64,
    /// What is proved of it: of the given shape, or of the end point after rounding to (θ, ξ, η).
    #[serde(serialize_with = "level_name")]
    pub level: Level,
    /// Bézier control points in the user's units and axes: 4 (cubic) or 6 (PH quintic). The first is the start and,
    /// when an end point was given, the last is that.
    pub control_points: Vec<[f64; 2]>,
    /// The same relative to the start: what to differentiate, free of the rounding of far-away coordinates.
    pub local_control_points: Vec<[f64; 2]>,
    /// Arc length: by the formula for a PH quintic, else to 1e-13 relative.
    pub length: f64,
    /// The segment as a piece of a path.
    #[serde(skip)]
    pub piece: Piece,
    /// The sides of the control polygon, each to a few ulp of itself: what to differentiate where an end's tangent is
    /// short.
    pub legs: Vec<[f64; 2]>,
    /// Direction of travel at the end, radians.
    pub end_direction: f64,
}

fn level_name<S: serde::Serializer>(level: &Level, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(level.name())
}

/// Adds a segment to the end of a line or circle; [`Added::level`] says whether it is a spiral. Where no segment of
/// this family, angle and radius ends at the target, it names the condition that fails, with its numbers.
///
/// # Accuracy
/// Levels are proved (see [`Added::level`]). Control points are within a few ulp of the largest coordinate difference;
/// a given end point is met exactly, end directions of [`Added::legs`] to 1e-14, and curvatures times r to 1e-13 or, at
/// a short flat end, 4 ulp of the next leg over the square of its own; those of control points to some 2^-50 over that
/// square.
///
/// # Errors
/// [`Error::Domain`] naming a value that is not finite, not positive where it must be, or outside the family's range.
///
/// # Source
/// Habib & Sakai (CGIV 2004), cases 1 and 2, (4), (12), (17).
pub fn add_segment(kind: Kind, request: &Request) -> Result<std::result::Result<Added, String>> {
    let Request { start, direction, radius, theta, target, .. } = *request;
    for (name, value) in [("start x", start[0]), ("start y", start[1]), ("direction", direction)] {
        finite(name, value)?;
    }
    positive("radius", radius)?;
    let frame = Frame {
        start,
        direction,
        along: [direction.cos(), direction.sin()],
        right: request.turn == Turn::Right,
        radius,
    };
    let case = if request.base == Base::Line { 1 } else { 2 };
    let (xi, eta, m, q, level) = match target {
        Target::Shape { m, q } => {
            positive("m", m)?;
            positive("q", q)?;
            let level = level_of_shape(kind, theta, m, q)?;
            let end = last(&legs(kind, case, theta, m, q));
            (end[0], end[1], m, q, level)
        }
        Target::Point(point) => {
            let [xi, eta] = frame.to_local(point)?;
            let reached = solve(kind, &Datum { theta, xi, eta })?;
            let segment = if case == 1 { reached.case1 } else { reached.case2 };
            let Some(s) = segment else {
                return Ok(Err(why(kind, case, theta, point, [xi, eta], radius)));
            };
            (xi, eta, s.m, s.q, s.level)
        }
    };
    let sides = legs(kind, case, theta, m, q);
    let mut at = [0.0, 0.0];
    let mut local_control_points = vec![at];
    for leg in &sides {
        at = add(at, *leg);
        local_control_points.push(frame.step(at));
    }
    let legs: Vec<Vector> = sides.into_iter().map(|leg| frame.step(leg)).collect();
    let mut control_points: Vec<Vector> = local_control_points.iter().map(|p| add(start, *p)).collect();
    if let (Target::Point(point), Some(end)) = (target, control_points.last_mut()) {
        *end = point;
    }
    if !control_points.iter().flatten().all(|x| x.is_finite()) {
        let what = format!("the segment from {start:?} with the radius {radius:?}");
        return Err(Error::beyond_doubles(what, OTHER_UNIT));
    }
    let piece = piece(kind, &frame, preimage(case, theta, m, q), &control_points, &legs);
    let length = piece.length();
    if !length.is_finite() {
        return Err(Error::beyond_doubles("the segment's length", OTHER_UNIT));
    }
    let end_direction = direction + if frame.right { -theta } else { theta };
    Ok(Ok(Added {
        case,
        xi,
        eta,
        m,
        q,
        level,
        control_points,
        local_control_points,
        length,
        piece,
        legs,
        end_direction,
    }))
}

/// Why there is no segment: one of the two legs would have to run backwards.
fn why(kind: Kind, case: u8, theta: f64, point: Vector, [xi, eta]: Vector, radius: f64) -> String {
    let (s, c) = theta.sin_cos();
    let (round, name) = if case == 1 { (eta, "eta") } else { (xi * s - eta * c, "xi sin(theta) - eta cos(theta)") };
    let what = if round <= 0.0 {
        format!("has {name} = {}, which must be above 0: it lies behind the tangent of the flat end", written(round))
    } else {
        let other = if case == 1 { xi * s - eta * c } else { eta };
        let more = (least_height(kind, theta, round) - other) / s * radius;
        let direction = if case == 1 { "start" } else { "end" };
        let ahead = match more > 0.0 && more.is_finite() {
            true => format!("further ahead along the {direction} direction, by more than {}", above(more)),
            false => format!("further ahead along the {direction} direction"),
        };
        format!(
            "lies too near, so that the flat end's tangent would run backwards (m <= 0): the end point must be {ahead}"
        )
    };
    let ([x, y], [xi, eta], theta) = (point.map(written), [xi, eta].map(written), degrees(theta));
    format!(
        "the end point ({x}, {y}), which is (xi, eta) = ({xi}, {eta}) in radii from the start with theta = {theta}, \
         {what}"
    )
}

/// With the heights a and b of the end point over the tangents of the flat end and of the round end
/// (`family/reach/poly.rs`): the b above which m is positive, a being given.
///
/// For the cubic αu = 1 and βu² = 1 + m, so m > 0 where b > 3a²/(2 sin²θ). For the PH quintic m rises with u, and so
/// does β; at m = 0 the first equation αu² - 24gu - 3 = 0 has the positive root u, and βu³ = 6u + 2. Moving the end by
/// t along the tangent of the flat end adds t sin θ to b and keeps a.
fn least_height(kind: Kind, theta: f64, a: f64) -> f64 {
    match kind {
        Kind::Cubic => 1.5 * (a / theta.sin()).powi(2),
        Kind::Ph => {
            let (c, l) = ((0.5 * theta).cos(), (0.5 * theta).tan());
            let (g, alpha) = (c * c, 60.0 * a / (l * l));
            let u = (12.0 * g + (144.0 * g * g + 3.0 * alpha).sqrt()) / alpha;
            (6.0 * u + 2.0) / u.powi(3) * l * l / 120.0
        }
    }
}

/// The start's frame: radius 1, turning left from (0, 0) along (1, 0).
struct Frame {
    start: Vector,
    direction: f64,
    along: Vector,
    right: bool,
    radius: f64,
}

impl Frame {
    fn mirror(&self, z: Vector) -> Vector {
        if self.right { [z[0], -z[1]] } else { z }
    }

    /// The user's vector from the start.
    fn step(&self, z: Vector) -> Vector {
        scale(turn(self.along, self.mirror(z)), self.radius)
    }

    fn to_local(&self, point: Vector) -> Result<Vector> {
        let back = [self.along[0], -self.along[1]];
        let local = self.mirror(scale(turn(back, sub(point, self.start)), 1.0 / self.radius));
        if local.iter().all(|x| x.is_finite()) {
            return Ok(local);
        }
        let ([x, y], r) = (point, self.radius);
        Err(Error::invalid(format!("the end point ({x:?}, {y:?}) is out of range in units of the radius {r:?}")))
    }
}

/// The segment in the user's frame. A PH quintic is turned and stretched by the root of what its derivative is.
fn piece(kind: Kind, frame: &Frame, preimage: [Vector; 3], control_points: &[Vector], legs: &[Vector]) -> Piece {
    if let (Kind::Cubic, [a, b, c, d], [x, y, z]) = (kind, control_points, legs) {
        return Piece::Cubic(Cubic { points: CubicBezier { p: [*a, *b, *c, *d] }, legs: [*x, *y, *z] });
    }
    let half = 0.5 * frame.direction;
    let root = scale([half.cos(), half.sin()], frame.radius.sqrt());
    let end = control_points.last().copied().unwrap_or(frame.start);
    Piece::PhQuintic(PhQuintic::between(frame.start, end, preimage.map(|w| turn(root, frame.mirror(w)))))
}

fn last(legs: &[Vector]) -> Vector {
    legs.iter().fold([0.0, 0.0], |sum, leg| add(sum, *leg))
}
