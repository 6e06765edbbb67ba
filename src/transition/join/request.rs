//! What a join is asked for, and what it is.

use super::super::Turn;
use super::super::piece::{Kind, Piece};
use super::super::stations::{Station, stations};
use super::measure::{Measures, without_noise};
use crate::error::{Error, OTHER_UNIT, Result, above_zero, by_name, finite, positive};
use serde::{Deserialize, Serialize};

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

/// What a join leads from or to.
///
/// A join of two states has its ends given. One between lines and circles leaves the first and reaches the second where
/// it has to: the parts of them before and after are no pieces of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// A point with its direction and curvature.
    State(State),
    /// Anywhere on a straight line, along its direction.
    Line {
        /// A point of it.
        point: [f64; 2],
        /// Direction of travel, as in [`State`].
        direction: f64,
    },
    /// Anywhere on a circle.
    Circle {
        /// Its centre.
        centre: [f64; 2],
        /// Its radius, above 0.
        radius: f64,
        /// Which way it is travelled.
        turn: Turn,
    },
}

impl End {
    /// Its point; of a circle its centre.
    pub fn point(&self) -> [f64; 2] {
        match *self {
            End::State(State { point, .. }) | End::Line { point, .. } | End::Circle { centre: point, .. } => point,
        }
    }
}

impl From<State> for End {
    fn from(state: State) -> End {
        End::State(state)
    }
}

/// The curves that the spirals of a join are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Cubic Bézier curves.
    #[default]
    Cubic,
    /// Pythagorean-hodograph quintics: exact length, rational offsets.
    PhQuintic,
    /// Images of an involute of a circle.
    Involute,
    /// Quintic trigonometric Bézier curves, from or to a straight end, or the part of one between two circles; with the
    /// shape numbers ratio 6, m 1, p 0, q 0.
    TrigQuintic,
    /// Clothoids, for comparison.
    Clothoid,
}

impl Family {
    /// All that joins can use.
    pub const ALL: [Family; 5] =
        [Family::Cubic, Family::PhQuintic, Family::Involute, Family::TrigQuintic, Family::Clothoid];

    /// Its name, as in JSON.
    pub fn name(self) -> &'static str {
        let kind = match self {
            Family::Cubic => Kind::Cubic,
            Family::PhQuintic => Kind::PhQuintic,
            Family::Involute => Kind::Involute,
            Family::TrigQuintic => Kind::TrigQuintic,
            Family::Clothoid => Kind::Clothoid,
        };
        kind.name()
    }

    /// The family of a name.
    ///
    /// # Errors
    /// [`Error::Domain`], with the names that there are.
    pub fn by_name(name: &str) -> Result<Family> {
        by_name("kind", name, &Family::ALL, Family::name)
    }
}

/// Of several joins that keep the limits, the one that has least of this.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
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

impl Objective {
    /// All that joins can have least.
    pub const ALL: [Objective; 4] =
        [Objective::Length, Objective::GreatestCurvature, Objective::GreatestRate, Objective::BendingEnergy];

    /// Its name, as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Objective::Length => "length",
            Objective::GreatestCurvature => "greatest-curvature",
            Objective::GreatestRate => "greatest-rate",
            Objective::BendingEnergy => "bending-energy",
        }
    }

    /// The objective of a name.
    ///
    /// # Errors
    /// [`Error::Domain`], with the names that there are.
    pub fn by_name(name: &str) -> Result<Objective> {
        by_name("objective", name, &Objective::ALL, Objective::name)
    }
}

/// A join to be found, of two states or of two lines and circles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Where it starts.
    pub from: End,
    /// Where it ends.
    pub to: End,
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

/// Limits of curvature within 1 / this and this have squares in the range of doubles.
const WIDEST: f64 = 1e150;

impl Request {
    /// As many pieces as a join of states can have: three turns of a spiral, an arc and a spiral, and a spiral more at
    /// both ends.
    pub const MOST_PIECES: usize = 11;

    /// With a limit of curvature alone: the shortest, of cubics.
    pub fn new(from: impl Into<End>, to: impl Into<End>, greatest_curvature: f64) -> Request {
        Request {
            from: from.into(),
            to: to.into(),
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
        for (name, end) in [("start", &self.from), ("end", &self.to)] {
            let ([x, y], rest) = match *end {
                End::State(State { point, direction, curvature }) => {
                    (point, vec![("direction", direction), ("curvature", curvature)])
                }
                End::Line { point, direction } => (point, vec![("direction", direction)]),
                End::Circle { centre, radius, .. } => {
                    positive(format!("the {name} radius"), radius)?;
                    (centre, Vec::new())
                }
            };
            for (what, value) in [("x", x), ("y", y)].into_iter().chain(rest) {
                finite(format!("{name} {what}"), value)?;
            }
        }
        if matches!(self.from, End::State(_)) != matches!(self.to, End::State(_)) {
            return Err(Error::invalid(
                "one end is a state and the other is not; joined are two states, or two lines and circles",
            ));
        }
        positive("the greatest curvature", self.greatest_curvature)?;
        if !(1.0 / WIDEST..=WIDEST).contains(&self.greatest_curvature) {
            let most = Error::domain("the greatest curvature", self.greatest_curvature, "1e-150 to 1e150");
            return Err(most.or(OTHER_UNIT));
        }
        if self.most_pieces == 0 {
            return Err(Error::invalid("the most pieces are 0; a join has one at least"));
        }
        above_zero("the longest length", self.longest).map(drop)
    }
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
    /// `count` points at equal lengths: [`stations`], where the curvature of a straight joint or end is 0 and not a
    /// rounding of it.
    ///
    /// # Errors
    /// Those of [`stations`].
    pub fn stations(&self, count: usize) -> Result<Vec<Station>> {
        let mut all = stations(&self.pieces, count)?;
        for station in &mut all {
            station.curvature = without_noise(station.curvature, self.measures.greatest_curvature);
        }
        Ok(all)
    }
}
