//! The five templates of transition curves, placed in the plane.

use super::words::degrees;
use super::{EndCircle, Sample, Turn};
use crate::curve::Jet;
use crate::curve::TrigBezier;
use crate::curve::vector::{add, turn};
use crate::error::{Error, OTHER_UNIT, Result, finite, positive, samples, written};
use crate::family::trig_quintic::Scaling;
use crate::family::trig_quintic::{SPIRAL, Shape, flags, least_ratio};
use crate::num::roots::find;
use serde::Serialize;

/// One spiral of a template: its shape and the radius of its circle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Segment {
    /// Its shape.
    pub shape: Shape,
    /// Radius of the circle at its round end, positive.
    pub radius: f64,
}

/// What is joined: sections III to VII of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Template {
    /// From a straight line to a circle.
    LineCircle(Segment),
    /// From a straight line to another: two spirals that meet with the curvature 1/radius, the second run backwards.
    LineLine {
        /// From the first line.
        first: Segment,
        /// Towards the second line; its radius must be the first one's.
        second: Segment,
    },
    /// From a circle to another that turns the other way: the first spiral run backwards.
    S {
        /// From the first circle.
        first: Segment,
        /// Towards the second circle.
        second: Segment,
    },
    /// From a circle to another that turns the same way, with curvature 0 between: the first spiral run backwards.
    C {
        /// From the first circle.
        first: Segment,
        /// Towards the second circle.
        second: Segment,
    },
    /// From a circle to a smaller one inside: the part of a spiral where the curvature has reached that of the outer
    /// circle.
    CircleInCircle {
        /// The spiral; its radius is that of the inner circle.
        inner: Segment,
        /// Radius of the outer circle, larger than that.
        outer: f64,
    },
}

/// A template and its place in the plane, in the user's units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Request {
    /// What is joined.
    pub template: Template,
    /// Where: the start of the path, or for S and C the point between the two spirals, where the curvature is 0.
    pub at: [f64; 2],
    /// Direction of travel there: counter-clockwise angle from the x axis, radians.
    pub direction: f64,
    /// To which side the first spiral turns.
    pub turn: Turn,
    /// How (9) is scaled.
    pub scaling: Scaling,
}

/// A curve of a path, run through from one parameter to another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Part {
    /// In the user's frame.
    pub curve: TrigBezier,
    /// Parameter where the path enters it, 0 but for circles in circles.
    pub from: f64,
    /// Parameter where the path leaves it: 1.
    pub to: f64,
    /// Whether its curvature is proved to be monotone.
    pub spiral: bool,
}

impl Part {
    /// Where the path enters and leaves it.
    pub fn ends(&self) -> [Jet; 2] {
        [self.from, self.to].map(|t| self.curve.jet(t))
    }
}

/// A path, in the direction of travel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Path {
    /// Its curves, each starting where the one before ends.
    pub parts: Vec<Part>,
    /// The circles or lines that it was to join, at its start and its end, and between its parts.
    pub circles: Vec<EndCircle>,
}

/// A path whose parts are not all spirals that meet their circles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoSpirals {
    /// What the request describes all the same.
    pub path: Path,
    /// Which condition fails, with its numbers.
    pub why: String,
}

/// Builds a template: a path each part of which is a spiral and meets its circles, or why there is none.
///
/// # Accuracy
/// That parts are spirals is proved for the shapes as given. Places, directions and curvatures at the ends and between
/// parts are those of [`Path::circles`] to 1e-12 of the path's size.
///
/// # Errors
/// [`Error::Domain`] naming a value outside its domain; [`Error::Undecided`] at the precision cap. That the curves are
/// no spirals is no error.
///
/// # Source
/// Misro, Ramli and Ali, sections III to VII, with (9) scaled as [`Scaling`] says and, for circles in circles, the
/// start moved to where the curvature is that of the outer circle.
pub fn path(request: &Request) -> Result<std::result::Result<Path, NoSpirals>> {
    let Request { template, at, direction, turn: side, scaling } = *request;
    for (name, value) in [("x", at[0]), ("y", at[1]), ("direction", direction)] {
        finite(name, value)?;
    }
    let (local, round) = local(&template, scaling)?;
    let along = [direction.cos(), direction.sin()];
    let map = |z: [f64; 2]| turn(along, if side == Turn::Right { [z[0], -z[1]] } else { z });
    let place = |part: &Part| Part { curve: part.curve.mapped(add(at, map(part.curve.start)), map), ..*part };
    let parts: Vec<Part> = local.iter().map(place).collect();
    if !parts.iter().flat_map(|part| part.curve.points()).flatten().all(|x| x.is_finite()) {
        return Err(Error::beyond_doubles(format!("the curve through {at:?}"), OTHER_UNIT));
    }
    let hand = if side == Turn::Right { -1.0 } else { 1.0 };
    let circles = circles(&parts, &round.map(|k| hand * k));
    let path = Path { parts, circles };
    Ok(match why_not(&template, scaling)? {
        None => Ok(path),
        Some(why) => Err(NoSpirals { path, why }),
    })
}

/// The circles at the start, at the end and between, of the curvatures that were asked for.
fn circles(parts: &[Part], curvatures: &[f64; 3]) -> Vec<EndCircle> {
    let mut places: Vec<(Jet, f64)> = Vec::new();
    if let (Some(first), Some(last)) = (parts.first(), parts.last()) {
        places.extend([(first.ends()[0], curvatures[0]), (last.ends()[1], curvatures[2])]);
        places.extend(parts[1..].iter().map(|part| (part.ends()[0], curvatures[1])));
    }
    places.into_iter().map(|(jet, curvature)| EndCircle::new(jet.point, jet.direction(), curvature)).collect()
}

/// The parts for a path that starts at the origin along (1, 0) (S and C: passes there) and turns left, with the
/// curvatures asked for at its start, between its parts and at its end.
fn local(template: &Template, scaling: Scaling) -> Result<(Vec<Part>, [f64; 3])> {
    let part = |segment: &Segment| -> Result<Part> {
        positive("radius", segment.radius)?;
        let spiral = flags(&segment.shape)? & SPIRAL != 0;
        Ok(Part { curve: segment.shape.curve(segment.radius, scaling), from: 0.0, to: 1.0, spiral })
    };
    Ok(match template {
        Template::LineCircle(segment) => (vec![part(segment)?], [0.0, 0.0, 1.0 / segment.radius]),
        Template::LineLine { first, second } => {
            if first.radius != second.radius {
                let (one, two) = (first.radius, second.radius);
                return Err(Error::invalid(format!(
                    "the radii are {one:?} and {two:?}; between two lines they must be equal"
                )));
            }
            let (one, two) = (part(first)?, part(second)?);
            let back = flipped(&two.curve, [1.0, -1.0]).reversed();
            // It starts along π - θ and is to start where and as the first one ends.
            let (sine, cosine) = (first.shape.theta + second.shape.theta).sin_cos();
            let curve = back.mapped(one.curve.points()[5], |z| turn([-cosine, -sine], z));
            (vec![one, Part { curve, ..two }], [0.0, 1.0 / first.radius, 0.0])
        }
        Template::S { first, second } | Template::C { first, second } => {
            let (one, two) = (part(first)?, part(second)?);
            let other = if matches!(template, Template::S { .. }) { -1.0 } else { 1.0 };
            let parts = vec![
                Part { curve: flipped(&one.curve, [-1.0, 1.0]).reversed(), ..one },
                Part { curve: flipped(&two.curve, [1.0, other]), ..two },
            ];
            (parts, [1.0 / first.radius, 0.0, other / second.radius])
        }
        Template::CircleInCircle { inner, outer } => {
            positive("outer", *outer)?;
            if *outer <= inner.radius {
                let radius = inner.radius;
                return Err(Error::invalid(format!(
                    "the outer radius is {outer:?}; it must be above that of the inner circle, {radius:?}"
                )));
            }
            let whole = part(inner)?;
            // The paper starts where the curvature is 0.
            if scaling == Scaling::AsPrinted {
                return Ok((vec![whole], [1.0 / outer, 0.0, 1.0 / inner.radius]));
            }
            let from = find(|t| whole.curve.jet(t).curvature() * outer - 1.0, 0.0, 1.0, 1e-17);
            let jet = whole.curve.jet(from);
            let along = [jet.first[0] / jet.speed(), -jet.first[1] / jet.speed()];
            let back = turn(along, jet.point);
            let curve = whole.curve.mapped([-back[0], -back[1]], |z| turn(along, z));
            (vec![Part { curve, from, ..whole }], [1.0 / outer, 0.0, 1.0 / inner.radius])
        }
    })
}

/// Mirrored in the axes where a sign is -1; it starts at the origin.
fn flipped(curve: &TrigBezier, [x, y]: [f64; 2]) -> TrigBezier {
    curve.mapped(curve.start, |z| [x * z[0], y * z[1]])
}

/// The first condition that fails, if any.
fn why_not(template: &Template, scaling: Scaling) -> Result<Option<String>> {
    let segments = match template {
        Template::LineCircle(segment) | Template::CircleInCircle { inner: segment, .. } => vec![segment],
        Template::LineLine { first, second } | Template::S { first, second } | Template::C { first, second } => {
            vec![first, second]
        }
    };
    for Segment { shape, radius } in segments {
        let Shape { ratio, theta, m, p, q } = *shape;
        let printed = if scaling == Scaling::AsPrinted { "as printed: " } else { "" };
        if flags(shape)? & SPIRAL == 0 {
            let hint = match least_ratio(shape)? {
                Some(least) => format!("ratios from {least} up to 64 give spirals"),
                None => "and neither does 64".into(),
            };
            return Ok(Some(format!(
                "{printed}not a spiral: the ratio {} gives none for the angle {}, m = {}, p = {}, q = {}; {hint}",
                written(ratio),
                degrees(theta),
                written(m),
                written(p),
                written(q)
            )));
        }
        if scaling == Scaling::AsPrinted {
            let end = 15.0 / (4.0 + q).powi(2);
            return Ok(Some(format!(
                "as printed: the end curvature is {end} / r, r = {}, and not 1 / r",
                written(*radius)
            )));
        }
    }
    Ok(None)
}

impl Path {
    /// Points at equal steps of the parameter of each part, both ends included; `s` runs on from part to part, `t` is
    /// each part's own.
    ///
    /// # Errors
    /// [`Error::Domain`] for fewer than 2 samples a part or more than [`super::MOST_SAMPLES`].
    pub fn samples(&self, count: usize) -> Result<Vec<Vec<Sample>>> {
        samples(count)?;
        let mut s = 0.0;
        let part = |part: &Part| {
            let t = |i: usize| {
                if i + 1 == count { part.to } else { part.from + (part.to - part.from) * i as f64 / (count - 1) as f64 }
            };
            let sample = |i: usize| {
                s += if i == 0 { 0.0 } else { part.curve.length_between(t(i - 1), t(i)) };
                let jet = part.curve.jet(t(i));
                let [curvature, curvature_dt, curvature_ds] = [jet.curvature(), jet.curvature_dt(), jet.curvature_ds()];
                Sample { t: t(i), s, point: jet.point, curvature, curvature_dt, curvature_ds }
            };
            (0..count).map(sample).collect()
        };
        Ok(self.parts.iter().map(part).collect())
    }
}
