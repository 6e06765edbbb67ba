//! What a join is asked for, and what it is.

use super::super::piece::Piece;
use super::measure::Measures;
use crate::error::{Error, Result};
use serde::Serialize;

/// A place on a path: point, direction of travel and signed curvature, in the user's units and axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct State {
    /// The point.
    pub point: [f64; 2],
    /// Direction of travel: counter-clockwise angle from the x axis, radians.
    pub direction: f64,
    /// Curvature, 1 / length, positive where the path turns left.
    pub curvature: f64,
}

/// The curves that the spirals of a join are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Cubic Bézier curves.
    #[default]
    Cubic,
    /// Pythagorean-hodograph quintics: exact length, rational offsets.
    PhQuintic,
    /// Images of an involute of a circle.
    Involute,
}

/// Of several joins that keep the limits, the one that has least of this.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Objective {
    /// Arc length.
    #[default]
    Length,
    /// Greatest |κ|.
    GreatestCurvature,
    /// Greatest |dκ/ds|: how fast the steering wheel must turn.
    GreatestRate,
    /// ∫ κ² ds.
    BendingEnergy,
}

/// A join of two states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Where it starts.
    pub from: State,
    /// Where it ends.
    pub to: State,
    /// Greatest |κ| allowed, above 0.
    pub greatest_curvature: f64,
    /// What its spirals are.
    pub family: Family,
    /// What is to be least.
    pub objective: Objective,
    /// Greatest length allowed; infinite for none.
    pub longest: f64,
    /// Most pieces allowed; [`Request::MOST_PIECES`] shuts nothing out.
    pub most_pieces: usize,
}

impl Request {
    /// As many pieces as a join of states can have: three turns of a spiral, an arc and a spiral, and a spiral more at both ends.
    pub const MOST_PIECES: usize = 11;

    /// With a limit of curvature alone: the shortest, of cubics.
    pub fn new(from: State, to: State, greatest_curvature: f64) -> Request {
        Request {
            from,
            to,
            greatest_curvature,
            family: Family::default(),
            objective: Objective::default(),
            longest: f64::INFINITY,
            most_pieces: Request::MOST_PIECES,
        }
    }

    /// # Errors
    /// [`Error::Domain`] naming the first number that is not finite or not above 0.
    pub(super) fn check(&self) -> Result<()> {
        for (name, state) in [("start", &self.from), ("end", &self.to)] {
            let State { point: [x, y], direction, curvature } = *state;
            for (what, value) in [("x", x), ("y", y), ("direction", direction), ("curvature", curvature)] {
                finite(&format!("{name} {what}"), value)?;
            }
        }
        positive("the greatest curvature", self.greatest_curvature)?;
        if self.longest.is_nan() || self.longest <= 0.0 {
            return Err(Error::Domain(format!("the longest length is {:?}; it must be above 0", self.longest)));
        }
        Ok(())
    }
}

pub(super) fn finite(name: &str, value: f64) -> Result<()> {
    if value.is_finite() { Ok(()) } else { Err(Error::Domain(format!("{name} is {value}; it must be finite"))) }
}

pub(super) fn positive(name: &str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::Domain(format!("{name} is {value:?}; it must be finite and above 0")))
}

/// A path of lines, arcs and proved spirals with continuous direction and curvature. As JSON it is a path: `length`,
/// `greatest_curvature`, and so on, and `pieces`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Join {
    /// Its numbers.
    #[serde(flatten)]
    pub measures: Measures,
    /// Its pieces, in the direction of travel.
    pub pieces: Vec<Piece>,
}

impl Join {
    pub(super) fn new(pieces: Vec<Piece>) -> Join {
        Join { measures: Measures::of(&pieces), pieces }
    }
}

/// The join, or why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It exists.
    Join(Join),
    /// Which condition excludes it, in words and numbers.
    None(String),
}

impl Outcome {
    /// The join, if there is one.
    pub fn join(&self) -> Option<&Join> {
        match self {
            Outcome::Join(join) => Some(join),
            Outcome::None(_) => None,
        }
    }
}

impl Serialize for Outcome {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Without<'a> {
            pieces: Option<()>,
            reason: &'a str,
        }
        match self {
            Outcome::Join(join) => join.serialize(serializer),
            Outcome::None(reason) => Without { pieces: None, reason }.serialize(serializer),
        }
    }
}
