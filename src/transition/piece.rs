//! A piece of a path, of any kind that this program makes: the one shape that curves have in JSON.
//!
//! ```
//! use spiral_atlas::curve::PhQuintic;
//! use spiral_atlas::transition::{Line, Piece};
//!
//! let piece = Piece::PhQuintic(PhQuintic::new([0.0, 0.0], [[1.0, 0.0], [1.0, 0.5], [1.0, 1.0]]));
//! let text = serde_json::to_string(&piece).unwrap();
//! assert!(text.starts_with(r#"{"kind":"ph-quintic","start":[0.0,0.0],"end":["#));
//! assert_eq!(serde_json::from_str::<Piece>(&text).unwrap(), piece);
//!
//! let line: Piece = serde_json::from_str(r#"{"kind": "line", "start": [0, 0], "end": [3, 4]}"#).unwrap();
//! assert_eq!(line, Piece::Line(Line { start: [0.0, 0.0], end: [3.0, 4.0] }));
//! assert_eq!((line.length(), line.at(0.5).point), (5.0, [1.5, 2.0]));
//! ```

mod raw;

use super::{Clothoid, Ends, Frame, involute_between};
use crate::curve::vector::{Vector, add, length, lerp, scale, sub};
use crate::curve::{CubicBezier, Jet, PhQuintic, TrigBezier, arc_length, casteljau};
use crate::error::{Error, Result};
use crate::family::any_spiral::{Image, Involute, Spiral, Split};
use serde::{Deserialize, Serialize};

/// A curve between two points, in the user's plane and unit of length.
///
/// As JSON it has its `kind`, the numbers that rebuild it exactly, its `control_points` where it has them, and its
/// `length`.
#[expect(
    clippy::large_enum_variant,
    reason = "paths have few pieces, and a box for one kind would show in every match"
)]
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// A cubic Bézier curve.
    Cubic(Cubic),
    /// A Pythagorean-hodograph quintic.
    PhQuintic(PhQuintic),
    /// A quintic trigonometric Bézier curve, or a part of one.
    TrigQuintic(TrigPart),
    /// The image of an involute between two ends.
    Involute(InvoluteBetween),
    /// A straight line.
    Line(Line),
    /// An arc of a circle.
    Arc(Arc),
    /// A clothoid.
    Clothoid(Clothoid),
}

/// What kinds of pieces there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// [`Piece::Cubic`].
    Cubic,
    /// [`Piece::PhQuintic`].
    PhQuintic,
    /// [`Piece::TrigQuintic`].
    TrigQuintic,
    /// [`Piece::Involute`].
    Involute,
    /// [`Piece::Line`].
    Line,
    /// [`Piece::Arc`].
    Arc,
    /// [`Piece::Clothoid`].
    Clothoid,
}

impl Kind {
    /// Its name, as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Cubic => "cubic",
            Kind::PhQuintic => "ph-quintic",
            Kind::TrigQuintic => "trig-quintic",
            Kind::Involute => "involute",
            Kind::Line => "line",
            Kind::Arc => "arc",
            Kind::Clothoid => "clothoid",
        }
    }
}

/// A cubic Bézier curve with the sides of its polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// The control points; the outer ones are the ends, exactly.
    pub points: CubicBezier,
    /// The sides of the control polygon. Directions and curvatures come from them, since control points far from the
    /// origin lose digits.
    pub legs: [[f64; 2]; 3],
}

/// The part of a trigonometric curve between two parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrigPart {
    /// The whole curve.
    pub curve: TrigBezier,
    /// Where the part begins, at least 0.
    pub from: f64,
    /// Where it ends, above `from`, at most 1.
    pub to: f64,
}

/// An involute's image, with what it was made from.
#[derive(Debug, Clone, PartialEq)]
pub struct InvoluteBetween {
    ends: Ends,
    turns: [u32; 2],
    curve: Involute,
    frame: Frame,
}

impl InvoluteBetween {
    /// The curve that [`involute_between`] finds.
    ///
    /// # Errors
    /// Those of [`involute_between`], and [`Error::Domain`] with the reason where no spiral has these ends.
    pub fn new(ends: &Ends, turns: [u32; 2]) -> Result<InvoluteBetween> {
        let (found, frame) = involute_between(ends, turns)?;
        match found.outcome {
            Ok(Image { curve, .. }) => Ok(InvoluteBetween { ends: *ends, turns, curve, frame }),
            Err(why) => Err(Error::invalid(format!("no involute has these ends: {why}"))),
        }
    }

    /// The curve that [`involute_between`] has found between two ends, if there is one with the turns asked for.
    pub fn of(ends: &Ends, found: &Spiral, frame: &Frame) -> Option<InvoluteBetween> {
        let image = found.outcome.as_ref().ok().filter(|image| image.split == Split::Asked)?;
        Some(InvoluteBetween { ends: *ends, turns: found.turns, curve: image.curve.clone(), frame: *frame })
    }

    /// What it joins.
    pub fn ends(&self) -> &Ends {
        &self.ends
    }

    /// Its parameter where a share, from 0 to 1, of its length is behind.
    pub fn parameter_at(&self, share: f64) -> f64 {
        self.curve.at_length(share).f
    }

    /// dκ/ds where a share, from 0 to 1, of its length is behind.
    pub fn rate_at_length(&self, share: f64) -> f64 {
        self.curve.rate_at_length(share) / self.unit().powi(2)
    }

    /// Half the chord, the unit of the curve's own frame.
    fn unit(&self) -> f64 {
        length(self.frame.half_chord)
    }
}

/// A straight line from one point to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends, elsewhere.
    pub end: [f64; 2],
}

/// An arc of a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Where it starts.
    pub start: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    pub start_direction: f64,
    /// Signed curvature, positive to the left.
    pub curvature: f64,
    /// Arc length, above 0.
    pub length: f64,
}

impl Cubic {
    /// Point and derivatives at t.
    pub fn jet(&self, t: f64) -> Jet {
        Jet { point: self.points.point(t), ..of_legs(&self.legs, t) }
    }
}

impl From<PhQuintic> for Piece {
    fn from(curve: PhQuintic) -> Piece {
        Piece::PhQuintic(curve)
    }
}

impl From<Line> for Piece {
    fn from(line: Line) -> Piece {
        Piece::Line(line)
    }
}

impl Arc {
    /// The vector from the start after a length, and the direction there: by the chord, which needs no centre.
    fn after(&self, s: f64) -> (Vector, f64) {
        let half = 0.5 * s * self.curvature;
        let chord = if half == 0.0 { s } else { s * half.sin() / half };
        let along = self.start_direction + half;
        ([chord * along.cos(), chord * along.sin()], along + half)
    }
}

/// What is known of a curve at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct At {
    /// The point.
    pub point: [f64; 2],
    /// Direction of travel, radians in [-π, π]; NaN where the curve stands still.
    pub heading: f64,
    /// Signed curvature, positive to the left; NaN where the curve stands still.
    pub curvature: f64,
    /// Length for each unit of the parameter; NaN for an involute, whose lengths [`super::stations`] knows.
    pub speed: f64,
}

impl Piece {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Piece::Cubic(_) => Kind::Cubic,
            Piece::PhQuintic(_) => Kind::PhQuintic,
            Piece::TrigQuintic(_) => Kind::TrigQuintic,
            Piece::Involute(_) => Kind::Involute,
            Piece::Line(_) => Kind::Line,
            Piece::Arc(_) => Kind::Arc,
            Piece::Clothoid(_) => Kind::Clothoid,
        }
    }

    /// Where it starts.
    pub fn start(&self) -> [f64; 2] {
        self.at(self.range()[0]).point
    }

    /// Where it ends.
    pub fn end(&self) -> [f64; 2] {
        self.at(self.range()[1]).point
    }

    /// The range of its parameter: 0 to 1, but for a part of a trigonometric curve.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Piece::TrigQuintic(part) => [part.from, part.to],
            _ => [0.0, 1.0],
        }
    }

    /// Arc length.
    ///
    /// # Accuracy
    /// A few roundings where there is a formula (`ph-quintic`, `line`, `arc`, `clothoid`), else 1e-13 relative.
    pub fn length(&self) -> f64 {
        match self {
            Piece::Cubic(_) | Piece::TrigQuintic(_) => self.length_to(self.range()[1]),
            Piece::PhQuintic(curve) => curve.length(),
            Piece::Involute(between) => between.curve.length() * between.unit(),
            Piece::Line(Line { start, end }) => length(sub(*end, *start)),
            Piece::Arc(arc) => arc.length,
            Piece::Clothoid(clothoid) => clothoid.length,
        }
    }

    /// Arc length from the start to a parameter of [`Piece::range`].
    ///
    /// # Accuracy
    /// As [`Piece::length`].
    pub fn length_to(&self, t: f64) -> f64 {
        match self {
            Piece::Cubic(cubic) => arc_length(|t| of_legs(&cubic.legs, t).speed(), 0.0, t),
            Piece::TrigQuintic(part) => arc_length(|t| part.curve.jet(t).speed(), part.from, t),
            Piece::PhQuintic(curve) => curve.length_to(t),
            Piece::Involute(between) => between.curve.length_to(t) * between.unit(),
            Piece::Line(_) | Piece::Arc(_) | Piece::Clothoid(_) => self.length() * t,
        }
    }

    /// What is known at a parameter of [`Piece::range`]. Points at the ends are exact.
    pub fn at(&self, t: f64) -> At {
        match self {
            Piece::Cubic(cubic) => at(&cubic.jet(t)),
            Piece::PhQuintic(curve) => {
                let [x, y] = curve.tangent(t);
                At { point: curve.point(t), heading: y.atan2(x), curvature: curve.curvature(t), speed: curve.speed(t) }
            }
            Piece::TrigQuintic(part) => at(&part.curve.jet(t)),
            Piece::Involute(between) => {
                let (place, [x, y]) = (between.curve.at(t), between.frame.half_chord);
                let heading = principal(place.direction + y.atan2(x));
                At {
                    point: between.frame.point(place.point),
                    heading,
                    curvature: place.curvature / between.unit(),
                    speed: f64::NAN,
                }
            }
            Piece::Line(Line { start, end }) => {
                let [x, y] = sub(*end, *start);
                At { point: lerp(*start, *end, t), heading: y.atan2(x), curvature: 0.0, speed: x.hypot(y) }
            }
            Piece::Arc(arc) => {
                let (step, direction) = arc.after(t * arc.length);
                At {
                    point: add(arc.start, step),
                    heading: principal(direction),
                    curvature: arc.curvature,
                    speed: arc.length,
                }
            }
            Piece::Clothoid(clothoid) => {
                let (step, direction) = clothoid.after(t);
                At {
                    point: add(clothoid.start, step),
                    heading: principal(direction),
                    curvature: clothoid.curvature_at(t),
                    speed: clothoid.length,
                }
            }
        }
    }

    /// The control points, of a Bézier curve.
    pub fn control_points(&self) -> Option<Vec<[f64; 2]>> {
        match self {
            Piece::Cubic(cubic) => Some(cubic.points.p.to_vec()),
            Piece::PhQuintic(curve) => Some(curve.control_points().to_vec()),
            Piece::TrigQuintic(part) => Some(part.curve.points().to_vec()),
            _ => None,
        }
    }
}

/// Derivatives of a cubic from the sides of its polygon; the point is from its start.
pub(super) fn of_legs(legs: &[Vector; 3], t: f64) -> Jet {
    let bends = [sub(legs[1], legs[0]), sub(legs[2], legs[1])];
    Jet {
        point: [0.0, 0.0],
        first: scale(casteljau(&mut legs.clone(), t), 3.0),
        second: scale(casteljau(&mut bends.clone(), t), 6.0),
        third: scale(sub(bends[1], bends[0]), 6.0),
    }
}

fn at(jet: &Jet) -> At {
    let speed = jet.speed();
    let heading = if speed > 0.0 { jet.direction() } else { f64::NAN };
    At { point: jet.point, heading, curvature: jet.curvature(), speed }
}

/// The same direction within [-π, π].
pub(super) fn principal(direction: f64) -> f64 {
    direction.sin().atan2(direction.cos())
}
