//! Why no spiral of any kind joins two ends, and which end curvatures would do, in the user's units.

use super::placement::Ends;
use super::turn::Which;
use super::words::{above, below, degrees};
use crate::curve::vector::length;
use crate::error::Result;
use crate::family::any_spiral::{Involute, involute};
use serde::Serialize;
use std::f64::consts::PI;
use std::fmt;

/// Why no spiral of any kind joins two ends without going round one of them; the first condition that fails.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "cause", rename_all = "kebab-case")]
pub enum NoSpiral {
    /// Both end curvatures are the same, so that the curvature could neither rise nor fall.
    EqualCurvatures {
        /// Both.
        curvature: f64,
    },
    /// The directions ask for a curvature that changes the other way: for one that rises, half the sum of both
    /// directions against the chord must be positive.
    WrongSide {
        /// Start direction against the chord, radians, positive to the left.
        start_angle: f64,
        /// End direction against the chord.
        end_angle: f64,
        /// Whether the curvature rises from start to end.
        rising: bool,
        /// The turns about start and end of an involute that goes once round one of them; none where none does.
        turns: Option<[u32; 2]>,
    },
    /// The circles of curvature at the ends cross or touch; those of a spiral lie apart or one inside the other.
    CirclesCross {
        /// What would help. Empty where the curvatures that would are beyond the range of doubles.
        needs: Vec<Need>,
        /// Whether each of `needs` alone suffices; if not, both are needed, and both together suffice.
        alone: bool,
    },
}

/// A bound that an end's curvature must pass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Need {
    /// The end.
    pub which: Which,
    /// Its curvature as it is, user units.
    pub curvature: f64,
    /// What it should be instead.
    #[serde(flatten)]
    pub bound: Bound,
}

/// A bound, user units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Bound {
    /// More than this.
    Above(f64),
    /// Less than this.
    Below(f64),
}

/// Two ends in the chord's frame, mirrored where curvature falls, so that it rises.
struct Seen<'e> {
    ends: &'e Ends,
    /// Directions against the chord, not mirrored.
    angles: [f64; 2],
    /// Half the sum of the directions: must be positive.
    omega: f64,
    /// `-(k1 + sin α)`: by how much the start's circle is flat enough to reach round the end point.
    room: f64,
    /// `k2 - sin β`: by how much the end's circle is sharp enough.
    over: f64,
    /// `-sin α`, below which k1 must be, and `sin β`, above which k2 must be.
    limits: [f64; 2],
    /// Brings a curvature of this frame back to the user's.
    back: f64,
}

impl Seen<'_> {
    /// None where both curvatures are the same.
    fn new(ends: &Ends) -> Result<Option<Seen<'_>>> {
        let (chord, half_chord) = ends.chord()?;
        if chord.k1 == chord.k2 {
            return Ok(None);
        }
        let sign = if chord.k1 < chord.k2 { 1.0 } else { -1.0 };
        let [alpha, beta, k1, k2] = [chord.alpha, chord.beta, chord.k1, chord.k2].map(|x| sign * x);
        Ok(Some(Seen {
            ends,
            angles: [chord.alpha, chord.beta],
            omega: 0.5 * (alpha + beta),
            room: -(k1 + alpha.sin()),
            over: k2 - beta.sin(),
            limits: [-alpha.sin(), beta.sin()],
            back: sign / length(half_chord),
        }))
    }

    fn rising(&self) -> bool {
        self.back > 0.0
    }

    /// Whether the circles of curvature cross or touch.
    fn crossing(&self) -> bool {
        !(self.room > 0.0 && self.over > 0.0 && self.room * self.over > self.omega.sin().powi(2))
    }

    /// What an end's curvature must pass, the other being as it is; none where it cannot help.
    fn need(&self, which: Which) -> Option<Need> {
        let product = self.omega.sin().powi(2);
        match which {
            Which::Start => (self.over > 0.0).then(|| self.limits[0] - product / self.over),
            Which::End => (self.room > 0.0).then(|| self.limits[1] + product / self.room),
        }
        .and_then(|at| self.passing(which, at))
    }

    /// That an end's curvature must pass a number of this frame, in the user's units. The start's must be below, the
    /// end's above; where curvature falls that is mirrored.
    fn passing(&self, which: Which, at: f64) -> Option<Need> {
        let (bound, up) = (at * self.back, (which == Which::End) == self.rising());
        let curvature = if which == Which::Start { self.ends.start_curvature } else { self.ends.end_curvature };
        let bound = if up { Bound::Above(bound) } else { Bound::Below(bound) };
        bound.value().is_finite().then_some(Need { which, curvature, bound })
    }
}

impl NoSpiral {
    /// The reason, as far as double precision can decide: none within rounding of a boundary where a spiral seems to
    /// exist.
    ///
    /// Seen so that curvature rises, a spiral exists exactly where `ω > 0`, `room > 0`, `over > 0` and
    /// `room over > sin² ω`: that is Q < 0; see [`crate::family::any_spiral::least_end_curvature`] for why both cannot
    /// be negative.
    ///
    /// # Errors
    /// Those of [`super::Placement::normalise`].
    pub fn of(ends: &Ends) -> Result<Option<NoSpiral>> {
        NoSpiral::with_turns(ends, 0)
    }

    /// The same of spirals with so many turns about both ends together, each of which adds π to ω.
    pub(super) fn with_turns(ends: &Ends, turns: u32) -> Result<Option<NoSpiral>> {
        let Some(seen) = Seen::new(ends)? else {
            return Ok(Some(NoSpiral::EqualCurvatures { curvature: ends.start_curvature }));
        };
        let crossing = seen.crossing();
        if seen.omega + f64::from(turns) * PI <= 0.0 {
            let [start_angle, end_angle] = seen.angles;
            // Which end it goes round is for the curve to say.
            let once = involute(&ends.chord()?.0, [0, 1]).ok().filter(|_| !crossing);
            let turns = once.and_then(|found| found.curve().map(Involute::turns));
            return Ok(Some(NoSpiral::WrongSide { start_angle, end_angle, rising: seen.rising(), turns }));
        }
        if !crossing {
            return Ok(None);
        }
        let needs: Vec<Need> = [Which::End, Which::Start].into_iter().filter_map(|which| seen.need(which)).collect();
        if !needs.is_empty() {
            return Ok(Some(NoSpiral::CirclesCross { needs, alone: true }));
        }
        // Neither helps alone, since `room` and `over` are both 0 or less. Where both are above |sin ω|, their product
        // is above its square; and the curvature rises still.
        let share = seen.omega.sin().abs();
        let both = [(Which::Start, seen.limits[0] - share), (Which::End, seen.limits[1] + share)];
        let needs: Vec<Need> = both.into_iter().filter_map(|(which, at)| seen.passing(which, at)).collect();
        Ok(Some(NoSpiral::CirclesCross { needs: if needs.len() == 2 { needs } else { Vec::new() }, alone: false }))
    }

    /// What an end's curvature must pass for a spiral of some kind, the other being as it is.
    pub(super) fn bound(ends: &Ends, which: Which) -> Result<Option<Bound>> {
        Ok(Seen::new(ends)?.and_then(|seen| seen.need(which)).map(|need| need.bound))
    }
}

impl Bound {
    /// The number.
    pub fn value(self) -> f64 {
        match self {
            Bound::Above(x) | Bound::Below(x) => x,
        }
    }
}

impl Need {
    /// `the end curvature 0.1 above 0.2`, with a verb before `above` or without.
    fn stated(&self, verb: &str) -> String {
        let Need { which, curvature, bound } = self;
        let (side, limit) = match bound {
            Bound::Above(x) => ("above", above(*x)),
            Bound::Below(x) => ("below", below(*x)),
        };
        format!("the {which} curvature {curvature:?}{verb} {side} {limit}{}", radius(*bound))
    }
}

/// The bound as one of the radius, in brackets.
fn radius(bound: Bound) -> String {
    let (arm, words) = match bound {
        Bound::Above(x) => (
            1.0 / x,
            if x > 0.0 { "turning left with a radius of at most" } else { "or, turning right, a radius of at least" },
        ),
        Bound::Below(x) => (
            1.0 / x,
            if x < 0.0 { "turning right with a radius of at most" } else { "or, turning left, a radius of at least" },
        ),
    };
    if !arm.is_finite() {
        return String::new();
    }
    let most = words.ends_with("most");
    format!(" ({words} {})", if most { below(arm.abs()) } else { above(arm.abs()) })
}

impl fmt::Display for NoSpiral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoSpiral::EqualCurvatures { curvature } => {
                write!(
                    f,
                    "the curvature is {curvature:?} at both ends, so that it could neither rise nor fall between them"
                )
            }
            NoSpiral::WrongSide { start_angle, end_angle, rising, turns } => {
                let (goes, sign) = if *rising { ("rises", "above") } else { ("falls", "below") };
                write!(
                    f,
                    "against the chord the start direction is {} and the end direction {} (positive to the left); \
                     where the curvature {goes} from start to end, as here, their sum must be {sign} 0, and it is {}",
                    degrees(*start_angle),
                    degrees(*end_angle),
                    degrees(start_angle + end_angle)
                )?;
                turns.map_or(Ok(()), |[start, end]| {
                    write!(f, "; only a spiral that goes round an end does: `curve involute --turns {start},{end}`")
                })
            }
            NoSpiral::CirclesCross { needs, alone } => {
                f.write_str("the circles of curvature at the ends cross or touch, and those of a spiral do not")?;
                let stated = |verb| needs.iter().map(|need| need.stated(verb)).collect::<Vec<_>>();
                match (needs.as_slice(), alone) {
                    ([], _) => Ok(()),
                    (_, true) => write!(f, ": {}", stated(" must be").join(", or ")),
                    (_, false) => write!(f, "; it is enough to bring {}", stated("").join(" and ")),
                }
            }
        }
    }
}
