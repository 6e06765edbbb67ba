//! The spiral between two ends that is the Möbius image of an involute of a circle (Kurnosenko 2026): any ends that
//! some spiral joins, short or long, with increasing or decreasing curvature, with or without an inflection.
//!
//! ```
//! use spiral_atlas::family::any_spiral::{Datum, involute};
//!
//! // Fig. 5: the circles of curvature at the ends are concentric, with radii 2 : 1.
//! let (k, pi) = (0.75f64.sqrt() / 2.0, std::f64::consts::PI);
//! let chord = Datum { alpha: -2.0 * pi / 3.0, beta: pi, k1: k, k2: 2.0 * k };
//! let found = involute(&chord, [0, 0])?;
//! let curve = found.curve().expect("Q < 0 and omega = 30 degrees");
//! assert!((curve.theta() - 2.478559516339784).abs() < 1e-12);
//! assert!((curve.at(0.5).curvature - 0.5) > 0.0);
//! # Ok::<(), spiral_atlas::Error>(())
//! ```

mod half;
mod numbers;
#[cfg(test)]
mod rates;
mod solve;
#[cfg(test)]
mod steps;
mod track;
mod turns;

pub use solve::{Involute, InvolutePoint};
pub use turns::Split;

use super::Datum;
use crate::error::{Error, Result};
use crate::num::demand_ieee;
use serde::{Serialize, Serializer};
use std::f64::consts::PI;
use std::fmt;

/// Greatest curvature times half the chord.
pub const GREATEST: f64 = 1e100;
/// Most turns about one end.
const MOST_TURNS: u32 = 1000;

/// What is known of two ends and the turns that were asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spiral {
    /// The ends.
    pub chord: Datum,
    /// Turns about start and end that were asked for.
    pub turns: [u32; 2],
    /// `(k1 + sin α)(k2 - sin β) + sin²((α + β)/2)`: an invariant of the two circles of curvature, negative where they
    /// are disjoint.
    pub q: f64,
    /// `(α + β)/2`, and π for each turn, with the sign of k2 - k1; radians.
    pub omega: f64,
    /// The curve, or why no spiral of any kind joins the ends with so many turns.
    #[serde(flatten, serialize_with = "curve_or_none")]
    pub outcome: Result<Image, WhyNone>,
}

/// The involute's image between two ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Image {
    /// The curve.
    pub curve: Involute,
    /// Whether it turns about its ends as asked.
    pub split: Split,
}

/// `curve`, or `none` with the reason.
fn curve_or_none<S: Serializer>(outcome: &Result<Image, WhyNone>, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    #[serde(rename_all = "lowercase")]
    enum Fields<'a> {
        Curve(&'a Image),
        None(WhyNone),
    }
    match outcome {
        Ok(image) => Fields::Curve(image),
        Err(why) => Fields::None(*why),
    }
    .serialize(serializer)
}

/// Why no spiral of any kind joins two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhyNone {
    /// `k1 = k2`: the curvature can only stay as it is.
    SameCurvature,
    /// ω has not the sign of k2 - k1.
    WrongSide,
    /// Q > 0: the circles of curvature at the ends cross.
    CirclesCross,
    /// Q = 0: they touch, and only a curve of two arcs joins the ends.
    CirclesTouch,
}

impl Spiral {
    /// The curve, if there is one.
    pub fn curve(&self) -> Option<&Involute> {
        self.outcome.as_ref().ok().map(|image| &image.curve)
    }
}

/// Finds the involute's image between two ends with `turns[0]` turns about the start and `turns[1]` about the end (0,
/// 0: a short spiral, which meets the line of the chord outside the chord nowhere inside). Only their sum is sure to be
/// had: [`Image::split`] says whether the split is as asked.
///
/// Directions of exactly ±π (the double) are a half turn: they count as π where the curvature increases and as -π where
/// it decreases, as (1) in the paper has it.
///
/// # Accuracy
/// Existence is proved for the doubles given. θ, t0 and the factors of the map are correctly rounded;
/// see [`Involute::at`] for points.
///
/// # Errors
/// [`Error::Domain`] for a value that is not finite, an angle beyond ±π, a curvature beyond 1e100 or more than 1000
/// turns; [`Error::Undecided`] at the precision cap.
///
/// # Source
/// Kurnosenko, arXiv 2603.29596, (2) to (6), with the sign of z0 in (6) corrected.
pub fn involute(chord: &Datum, turns: [u32; 2]) -> Result<Spiral> {
    demand_ieee()?;
    for (name, angle) in [("alpha", chord.alpha), ("beta", chord.beta)] {
        if angle.is_nan() || angle.abs() > PI {
            return Err(Error::angle(name, angle, "-pi to pi", "radians"));
        }
    }
    for (name, k) in [("k1", chord.k1), ("k2", chord.k2)] {
        if k.is_nan() || k.abs() > GREATEST {
            return Err(Error::domain(name, k, format!("at most {GREATEST:?} in magnitude (times half the chord)")));
        }
    }
    if let Some(n) = turns.iter().find(|n| **n > MOST_TURNS) {
        let limit = format!("at most {MOST_TURNS}");
        return Err(Error::domain("the number of turns about an end", f64::from(*n), limit));
    }
    Ok(solve::solve(chord, turns)?.0)
}

impl fmt::Display for WhyNone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            WhyNone::SameCurvature => {
                "the curvatures at both ends are the same, so that it could neither rise nor \
                                       fall"
            }
            WhyNone::WrongSide => {
                "omega, half the sum of the end directions and turns, has not the sign of k2 - k1: a spiral of rising \
                 curvature bulges to the right at its start, and ever more to the left"
            }
            WhyNone::CirclesCross => {
                "Q > 0: the circles of curvature at the ends cross, but those of a spiral lie apart or one in the other"
            }
            WhyNone::CirclesTouch => {
                "Q = 0: the circles of curvature at the ends touch, so that only a curve of two arcs joins them"
            }
        })
    }
}
