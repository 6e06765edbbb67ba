//! Why two ends have no spiral, with numbers.

use super::none::NoSpiral;
use super::placement::{Ends, Placement};
use super::remedy::{Remedy, advice};
use super::turn::{Turn, Which};
use super::words::degrees;
use crate::error::Result;
use crate::family::cubic::Datum;
use serde::{Serialize, Serializer};
use std::f64::consts::PI;
use std::fmt;

/// The first condition that fails; those further down assume the ones above. Angles and curvatures are the user's.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "condition", rename_all = "kebab-case")]
pub enum Why {
    /// No curve of whatever kind would do.
    NoSpiralOfAnyKind(NoSpiral),
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
        /// Its curvature.
        curvature: f64,
        /// Where the directions ask the curve to turn.
        turn: Turn,
    },
    /// A spiral of some kind exists, but no cubic: the two curvature equations have no root in (0, 3)².
    NoRoot {
        /// `κ0 d0² / (4 sin φ0)` of the normalised datum.
        a: f64,
        /// `κ1 d1² / (4 sin φ1)`; Habib & Sakai's (A.9) asks `k > 1/3`.
        k: f64,
        /// The discriminant `768a²k² - 256ak(a+k) + 96ak - 1` over `max(1,a)² max(1,k)²`: D of (A.4) but for a positive
        /// factor, to double precision. (A.9) asks that it is not negative.
        discriminant: f64,
        /// What would help; empty unless asked for.
        remedies: Vec<Remedy>,
    },
    /// Cubics with these ends exist, but the curvature of none is monotone.
    NotMonotone {
        /// All of them.
        roots: Vec<NonSpiral>,
        /// What would help; empty unless asked for.
        remedies: Vec<Remedy>,
    },
    /// A spiral of some kind exists, but no PH quintic with A, B > 0.
    NoPhQuintic {
        /// What would help; empty unless asked for.
        remedies: Vec<Remedy>,
    },
    /// PH quintics with these ends exist, but the curvature of none is monotone.
    NoPhSpiral {
        /// Their margins, negative.
        margins: Vec<f64>,
        /// What would help; empty unless asked for.
        remedies: Vec<Remedy>,
    },
    /// Spirals exist, but all are longer than was asked for.
    TooLong {
        /// The shortest one's length.
        length: f64,
        /// What was asked for.
        longest: f64,
    },
}

/// A cubic that matches the ends and is no spiral.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NonSpiral {
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
    /// As a sentence: that there is no curve of a kind, such as "cubic spiral", and why.
    pub fn sentence(&self, kind: &str) -> String {
        match self {
            Why::NoSpiralOfAnyKind(_) => self.to_string(),
            _ => format!("no {kind}: {self}"),
        }
    }

    /// Whether directions alone allow a C-shaped curve.
    pub(super) fn allows_convex_arc(datum: &Datum) -> bool {
        datum.phi0 > 0.0 && datum.phi1 > 0.0 && datum.phi0 + datum.phi1 < PI
    }

    /// What forbids any C-shaped curve, before curvatures are looked at; [`crate::family::cubic::solve`] asks for data
    /// without it.
    pub(super) fn no_convex_arc(ends: &Ends, datum: &Datum, placement: &Placement) -> Result<Option<Why>> {
        if Why::allows_convex_arc(datum) {
            return Ok(None);
        }
        let turning = datum.phi0 + datum.phi1;
        let convex = datum.phi0 > 0.0 && datum.phi1 > 0.0;
        let [start_angle, end_angle] = placement.against_chord(datum);
        let arc = if convex { Why::TurnsTooFar { turning } } else { Why::NotConvex { start_angle, end_angle } };
        Ok(Some(NoSpiral::of(ends)?.map_or(arc, Why::NoSpiralOfAnyKind)))
    }

    /// Explains a proved "no" of cubics, all of which are given. In double precision, so within rounding of a boundary
    /// it may name the neighbouring reason.
    pub(super) fn no_cubic(ends: &Ends, datum: &Datum, placement: &Placement, roots: Vec<NonSpiral>) -> Result<Why> {
        if let Some(none) = NoSpiral::of(ends)? {
            return Ok(Why::NoSpiralOfAnyKind(none));
        }
        if let Some((which, curvature)) = bends(ends, placement).next() {
            let turn = placement.turn();
            return Ok(if curvature == 0.0 {
                Why::Straight { which }
            } else {
                Why::Inflection { which, curvature, turn }
            });
        }
        Ok(if roots.is_empty() { no_root(datum) } else { Why::NotMonotone { roots, remedies: Vec::new() } })
    }

    /// With other curvatures that would do, for a reason that has a place for them; see [`Remedy::nearest`].
    pub(super) fn remedied(mut self, ends: &Ends, exists: impl Fn(&Ends) -> bool) -> Result<Why> {
        if let Why::NoRoot { remedies, .. }
        | Why::NotMonotone { remedies, .. }
        | Why::NoPhQuintic { remedies }
        | Why::NoPhSpiral { remedies, .. } = &mut self
        {
            *remedies = Remedy::nearest(ends, exists)?;
        }
        Ok(self)
    }
}

/// The ends whose curvature is 0 or against the turn that the directions ask for, and that curvature.
pub(super) fn bends(ends: &Ends, placement: &Placement) -> impl Iterator<Item = (Which, f64)> {
    let turn = placement.turn();
    let with_turn = move |curvature: f64| if turn == Turn::Left { curvature } else { -curvature };
    let both = [(Which::Start, ends.start_curvature), (Which::End, ends.end_curvature)];
    both.into_iter().filter(move |(_, curvature)| with_turn(*curvature) <= 0.0)
}

/// The discriminant in the angle-free coordinates, each term divided by the largest it can be, so that none overflows;
/// D of (A.4) is `27 / (k⁴ a⁸)` times it.
fn no_root(datum: &Datum) -> Why {
    // Where d is very long, at tangents that all but run against each other, they may leave the range of doubles.
    let (a, k) = datum.normalised();
    let (a, k) = (a.min(f64::MAX), k.min(f64::MAX));
    let (over, under) = (a.max(1.0), k.max(1.0));
    let (x, y) = (a / over, k / under);
    let discriminant = 768.0 * (x * y) * (x * y) - 256.0 * x * y * (x / under + y / over) + 96.0 * x / under * y / over
        - 1.0 / over / over / under / under;
    Why::NoRoot { a, k, discriminant, remedies: Vec::new() }
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Why::NoSpiralOfAnyKind(none) => write!(f, "no spiral of any kind joins these ends: {none}"),
            Why::NotConvex { start_angle, end_angle } => write!(
                f,
                "no C-shaped curve joins these ends: against the chord the start direction is {} and the end direction \
                 {} (positive to the left); they must lie on opposite sides of it",
                degrees(*start_angle),
                degrees(*end_angle)
            ),
            Why::TurnsTooFar { turning } => {
                write!(
                    f,
                    "the directions turn by {} in all, which must be below 180°, so that the end tangents meet",
                    degrees(*turning)
                )
            }
            Why::Straight { which } => write!(
                f,
                "the {which} curvature is 0, and the curves of this family bend at both ends, in the direction in \
                 which they turn"
            ),
            Why::Inflection { which, curvature, turn } => write!(
                f,
                "the {which} curvature {curvature:?} is to the {}, but the directions turn {turn}: the curve would \
                 have an inflection, and this family has none; it must be {} 0",
                if *curvature > 0.0 { "left" } else { "right" },
                if *curvature > 0.0 { "below" } else { "above" },
            ),
            Why::NoRoot { a, k, discriminant, remedies } => {
                write!(f, "no cubic without inflection has these ends and curvatures{}", advice(remedies))?;
                write!(f, " (no root of 3 - f1 = a f0^2, 3 - f0 = k f1^2 with 0 < f0, f1 < 3, a = {a:?}, k = {k:?}: ")?;
                write!(f, "the discriminant is {discriminant:?})")
            }
            Why::NotMonotone { roots, remedies } => {
                let how = if let [_] = roots.as_slice() { "the only cubic that has" } else { "every cubic that has" };
                write!(f, "the curvature of {how} these ends is not monotone{} (", advice(remedies))?;
                for (i, root) in roots.iter().enumerate() {
                    f.write_str(if i == 0 { "" } else { "; " })?;
                    root.fmt(f)?;
                }
                f.write_str(")")
            }
            Why::NoPhQuintic { remedies } => {
                write!(f, "no PH quintic with A, B > 0 has these ends and curvatures{}", advice(remedies))
            }
            Why::NoPhSpiral { margins, remedies } => {
                write!(
                    f,
                    "the curvature of no PH quintic with these ends is monotone{} (margins {margins:?})",
                    advice(remedies)
                )
            }
            Why::TooLong { length, longest } => {
                write!(
                    f,
                    "the shortest spiral of this family is {length:?} long, more than the {longest:?} that are allowed"
                )
            }
        }
    }
}

impl fmt::Display for NonSpiral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let NonSpiral { f0, f1, margin, extrema } = self;
        write!(f, "root ({f0:?}, {f1:?}), margin {margin:?}, ")?;
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

/// `chosen`, the index, or `why`: the reason's numbers and, as `text`, its words.
pub(super) fn chosen_or_why<S: Serializer>(outcome: &Result<usize, Why>, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    #[serde(rename_all = "lowercase")]
    enum Fields<'a> {
        Chosen(usize),
        Why {
            text: String,
            #[serde(flatten)]
            why: &'a Why,
        },
    }
    match outcome {
        Ok(chosen) => Fields::Chosen(*chosen),
        Err(why) => Fields::Why { text: why.to_string(), why },
    }
    .serialize(serializer)
}
