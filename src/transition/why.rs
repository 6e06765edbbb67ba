//! Why two ends have no spiral, with numbers.

use super::Solution;
use super::placement::{Ends, Placement};
use crate::family::any_spiral::least_end_curvature;
use crate::family::cubic::Datum;
use serde::Serialize;
use std::f64::consts::PI;
use std::fmt;

/// One of the user's two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Which {
    /// Where the curve starts.
    Start,
    /// Where it ends.
    End,
}

/// The side to which the user's curve turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Turn {
    /// Counter-clockwise, positive curvature.
    Left,
    /// Clockwise, negative curvature.
    Right,
}

/// The first condition that fails; those further down assume the ones above.
///
/// Angles and curvatures called φ and κ are those of the normalised datum; the first four variants speak of the user's data.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "condition", rename_all = "kebab-case")]
pub enum Why {
    /// The end directions do not lie on opposite sides of the chord, so no arc of one turning joins them.
    NotConvex {
        /// Start direction against the chord, radians, positive to the left.
        start_angle: f64,
        /// End direction against the chord.
        end_angle: f64,
    },
    /// `φ0 + φ1 >= π`: the end tangents do not meet.
    TurnsTooFar {
        /// `φ0 + φ1`, radians.
        turning: f64,
    },
    /// An end curvature is zero: the limit f = 3 of the family, not in it.
    Straight {
        /// The end.
        which: Which,
    },
    /// An end curvature has the wrong sign: the curve would have an inflection.
    Inflection {
        /// The end.
        which: Which,
        /// Its curvature, user units.
        curvature: f64,
        /// Where the directions ask the curve to turn.
        turn: Turn,
    },
    /// `κ0 = κ1`: no spiral but a circle, which has no monotone growth.
    EqualCurvatures {
        /// Both.
        kappa: f64,
    },
    /// `φ0 >= φ1`.
    AnglesOrder {
        /// φ0, radians.
        phi0: f64,
        /// φ1, radians.
        phi1: f64,
    },
    /// `κ0 >= sin φ0`: the circle at the start does not reach round the end point.
    StartTooSharp {
        /// κ0.
        kappa0: f64,
        /// Its bound, `sin φ0`.
        bound: f64,
    },
    /// Kneser and Kurnosenko: the end circle is not inside the start circle.
    NotNested {
        /// κ1.
        kappa1: f64,
        /// Its bound, [`least_end_curvature`].
        bound: f64,
    },
    /// A spiral of some kind exists, but no cubic: the two curvature equations have no root in (0, 3)².
    NoRoot {
        /// `κ0 d0² / (4 sin φ0)`.
        a: f64,
        /// `κ1 d1² / (4 sin φ1)`; (A.9) asks `k > 1/3`.
        k: f64,
        /// D of (A.4), to double precision; (A.9) asks `D >= 0`.
        discriminant: f64,
    },
    /// Cubics with these ends exist, but the curvature of none is monotone.
    NotMonotone {
        /// All of them.
        roots: Vec<Waver>,
    },
}

/// A cubic that matches the ends and is no spiral.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Waver {
    /// f0 of the root.
    pub f0: f64,
    /// f1 of the root.
    pub f1: f64,
    /// Its margin, negative.
    pub margin: f64,
    /// Parameters of its curvature extrema in the user's direction of travel; empty when too faint for doubles.
    pub extrema: Vec<f64>,
}

impl Why {
    /// What forbids any C-shaped curve, before curvatures are looked at; [`crate::family::cubic::solve`] asks for data without it.
    pub(super) fn no_convex_arc(datum: &Datum, placement: &Placement) -> Option<Why> {
        let [start_angle, end_angle] = placement.against_chord(datum);
        let turning = datum.phi0 + datum.phi1;
        if !(datum.phi0 > 0.0 && datum.phi1 > 0.0) {
            return Some(Why::NotConvex { start_angle, end_angle });
        }
        (turning >= PI).then_some(Why::TurnsTooFar { turning })
    }

    /// Explains a proved "no". In double precision, so within rounding of a boundary it may name the neighbouring reason.
    pub(super) fn no_spiral(ends: &Ends, datum: &Datum, placement: &Placement, solutions: &[Solution]) -> Why {
        if let Some((which, curvature)) = bends(ends, placement).next() {
            let turn = placement.turn();
            return if curvature == 0.0 { Why::Straight { which } } else { Why::Inflection { which, curvature, turn } };
        }
        match Why::no_spiral_at_all(datum) {
            Some(why) => why,
            None if solutions.is_empty() => no_root(datum),
            None => Why::NotMonotone { roots: solutions.iter().map(Waver::from).collect() },
        }
    }

    /// What forbids a spiral of any kind.
    pub(super) fn no_spiral_at_all(datum: &Datum) -> Option<Why> {
        let Datum { phi0, phi1, kappa0, kappa1 } = *datum;
        if kappa0 == kappa1 {
            return Some(Why::EqualCurvatures { kappa: kappa0 });
        }
        if phi0 >= phi1 {
            return Some(Why::AnglesOrder { phi0, phi1 });
        }
        match least_end_curvature(phi0, phi1, kappa0) {
            None => Some(Why::StartTooSharp { kappa0, bound: phi0.sin() }),
            Some(bound) => (kappa1 <= bound).then_some(Why::NotNested { kappa1, bound }),
        }
    }
}

impl From<&Solution> for Waver {
    fn from(s: &Solution) -> Waver {
        Waver { f0: s.f0, f1: s.f1, margin: s.margin, extrema: s.extrema.clone() }
    }
}

/// The ends whose curvature is 0 or against the turn that the directions ask for, and that curvature.
pub(super) fn bends(ends: &Ends, placement: &Placement) -> impl Iterator<Item = (Which, f64)> {
    let turn = placement.turn();
    let with_turn = move |curvature: f64| if turn == Turn::Left { curvature } else { -curvature };
    let both = [(Which::Start, ends.start_curvature), (Which::End, ends.end_curvature)];
    both.into_iter().filter(move |(_, curvature)| with_turn(*curvature) <= 0.0)
}

/// The paper's discriminant in the angle-free coordinates: `c0 = (9 - 3/k)/a²`, `c1 = 1/(k a²)`, `c2 = 6/a`, (A.3) to (A.5).
fn no_root(datum: &Datum) -> Why {
    let (a, k) = datum.normalised();
    let (c0, c1, c2) = ((9.0 - 3.0 / k) / (a * a), 1.0 / (k * a * a), 6.0 / a);
    let lambda = 12.0 * c0 + c2 * c2;
    let mu = 27.0 * c1 * c1 + 72.0 * c0 * c2 - 2.0 * c2.powi(3);
    Why::NoRoot { a, k, discriminant: (4.0 * lambda.powi(3) - mu * mu) / 27.0 }
}

impl fmt::Display for Which {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Which::Start { "start" } else { "end" })
    }
}

impl fmt::Display for Turn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Turn::Left { "left" } else { "right" })
    }
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Why::NotConvex { start_angle, end_angle } => write!(
                f,
                "no C-shaped curve: against the chord the start direction is {start_angle:?} rad and the end direction \
                 {end_angle:?} rad (positive to the left); they must lie on opposite sides of it"
            ),
            Why::TurnsTooFar { turning } => {
                write!(f, "phi0 + phi1 = {turning:?} must be below pi = {PI:?}: the end tangents must meet")
            }
            Why::Straight { which } => write!(
                f,
                "the {which} curvature is 0: this family is the open box 0 < f0, f1 < 3, whose curves bend at both ends (a straight end \
                 is its limit f = 3; a small curvature comes as close as you like)"
            ),
            Why::Inflection { which, curvature, turn } => write!(
                f,
                "the {which} curvature {curvature:?} is {}, but the directions turn {turn}: the curve would have an inflection, and \
                 this family (0 < f0, f1 < 3) has none",
                if *curvature > 0.0 { "to the left" } else { "to the right" }
            ),
            Why::EqualCurvatures { kappa } => {
                write!(
                    f,
                    "kappa0 = kappa1 = {kappa:?}: curvature that is monotone between equal ends is a circle's, not a spiral's"
                )
            }
            Why::AnglesOrder { phi0, phi1 } => {
                write!(f, "phi0 >= phi1: {phi0:?} >= {phi1:?}, so no spiral of increasing curvature")
            }
            Why::StartTooSharp { kappa0, bound } => {
                write!(f, "kappa0 = {kappa0:?} must be below sin(phi0) = {bound:?}: no spiral starts so sharply")
            }
            Why::NotNested { kappa1, bound } => write!(
                f,
                "Kneser/Kurnosenko bound: kappa1 = {kappa1:?} must exceed {bound:?} = sin(phi1) + sin^2((phi1-phi0)/2)/(sin(phi0)-kappa0)"
            ),
            Why::NoRoot { a, k, discriminant } => write!(
                f,
                "no root (f0, f1) in (0, 3)^2 of 3 - f1 = a f0^2, 3 - f0 = k f1^2 with a = {a:?}, k = {k:?}: discriminant D = \
                 {discriminant:?} of (A.4); (A.9) asks D >= 0 and k > 1/3"
            ),
            Why::NotMonotone { roots } => {
                for (i, root) in roots.iter().enumerate() {
                    f.write_str(if i == 0 { "" } else { "; " })?;
                    root.fmt(f)?;
                }
                Ok(())
            }
        }
    }
}

impl fmt::Display for Waver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Waver { f0, f1, margin, extrema } = self;
        write!(f, "root ({f0:?}, {f1:?}) loses monotone curvature: margin {margin:?}, ")?;
        match extrema.as_slice() {
            [] => f.write_str("curvature extremum too faint to place in double precision"),
            [t] => write!(f, "curvature extremum at t = {t:?}"),
            [first, rest @ ..] => {
                write!(f, "curvature extrema at t = {first:?}")?;
                rest.iter().try_for_each(|t| write!(f, ", {t:?}"))
            }
        }
    }
}
