//! The transition spiral between two given ends: Habib & Sakai, section 3.2, for data anywhere in the plane.

use super::piece::{Cubic, Piece, of_legs};
use super::placement::{Ends, Placement};
use super::why::{NonSpiral, Why, chosen_or_why};
use crate::curve::CubicBezier;
use crate::curve::arc_length;
use crate::error::{Error, OTHER_UNIT, Result};
use crate::family::cubic::{Datum, Root, solve};
use serde::Serialize;
use std::fmt;

/// All that is known of two ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    /// What was asked.
    pub ends: Ends,
    /// The normalised data.
    pub datum: Datum,
    /// How the normalised frame lies in the user's.
    pub placement: Placement,
    /// Every cubic that matches the ends, spirals or not, by increasing f0.
    pub solutions: Vec<Solution>,
    /// The index, into [`Answer::solutions`], of the spiral with the largest margin (of equal margins, the one with the
    /// smaller f0), or why there is no spiral.
    #[serde(flatten, serialize_with = "chosen_or_why")]
    pub outcome: std::result::Result<usize, Why>,
}

/// One cubic that matches the ends: a root (f0, f1) and its curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Solution {
    /// `|P'| / d` at the normalised start (the user's end, when reversed), in (0, 3).
    pub f0: f64,
    /// The same at the normalised end.
    pub f1: f64,
    /// Whether Theorem 3.1 accepts it.
    pub theorem31: bool,
    /// Whether its curvature is monotone: necessary and sufficient.
    pub spiral: bool,
    /// Scale-free distance from losing it; see [`Root::margin`].
    pub margin: f64,
    /// Arc length, to 1e-13 relative.
    pub length: f64,
    /// The curve in the user's units, axes and direction of travel; it starts and ends exactly where asked.
    pub control_points: CubicBezier,
    /// The same relative to the start point, for coordinates far from the origin.
    pub local_control_points: CubicBezier,
    /// The sides of the control polygon, each to a few ulp of itself: a third of the derivative's control points, and
    /// what to differentiate where an end's tangent is short. See [`CubicBezier::legs`].
    pub legs: [[f64; 2]; 3],
    /// Parameters of its curvature extrema; empty on a spiral.
    pub extrema: Vec<f64>,
}

/// Finds the cubic spiral between two ends, or says why there is none.
///
/// # Accuracy
/// Existence is proved for the normalised doubles in [`Answer::datum`], which differ from the exact normal form of the
/// user's data by rounding; see [`Placement::normalise`]. The curve's end points are the user's, exactly; end
/// directions and curvatures of [`Solution::legs`] are the user's to 1e-14 over `sin(phi0 + phi1)` and `1 - f/3` of the
/// other end; those of control points to that over the length of the end's tangent in half chords (curvatures: its
/// square).
///
/// # Errors
/// Those of [`Placement::normalise`] and [`solve`], and [`Error::Domain`] when a control point leaves the range of
/// doubles. That no spiral exists is no error but an [`Answer::outcome`].
pub fn spiral(ends: &Ends) -> Result<Answer> {
    let (datum, placement) = Placement::normalise(ends)?;
    if let Some(why) = Why::no_convex_arc(ends, &datum, &placement)? {
        return Ok(Answer { ends: *ends, datum, placement, solutions: Vec::new(), outcome: Err(why) });
    }
    let solved = solve(&datum)?;
    Answer::from_roots(ends, solved.roots(), solved.chosen())
}

/// The spiral that [`spiral`] chooses, without a reason where there is none.
///
/// # Errors
/// Those of [`spiral`].
pub(super) fn chosen_spiral(ends: &Ends) -> Result<Option<Solution>> {
    let (datum, placement) = Placement::normalise(ends)?;
    if !Why::allows_convex_arc(&datum) {
        return Ok(None);
    }
    solve(&datum)?.chosen().map(|root| Solution::new(&datum, &placement, root)).transpose()
}

impl Answer {
    /// The answer when the roots are known already, from [`solve`] or an atlas; `chosen` is one of them.
    ///
    /// # Errors
    /// Those of [`Placement::normalise`], and [`Error::Domain`] when a control point leaves the range of doubles or
    /// `chosen` is not among the roots.
    pub fn from_roots(ends: &Ends, roots: &[Root], chosen: Option<&Root>) -> Result<Answer> {
        let (datum, placement) = Placement::normalise(ends)?;
        let solutions = roots.iter().map(|root| Solution::new(&datum, &placement, root)).collect::<Result<Vec<_>>>()?;
        let outcome = match chosen {
            Some(root) => Ok(index(roots, root)?),
            None => {
                let arc = Why::no_convex_arc(ends, &datum, &placement)?;
                let all = || solutions.iter().map(Solution::non_spiral).collect();
                Err(arc.map_or_else(|| Why::no_cubic(ends, &datum, &placement, all()), Ok)?)
            }
        };
        Ok(Answer { ends: *ends, datum, placement, solutions, outcome })
    }

    /// The same where curves longer than this, in the user's unit, count as none.
    pub fn no_longer_than(mut self, longest: f64) -> Answer {
        let spirals = || self.solutions.iter().enumerate().filter(|(_, s)| s.spiral);
        let best = spirals().filter(|(_, s)| s.length <= longest).max_by(|a, b| a.1.margin.total_cmp(&b.1.margin));
        if self.outcome.is_ok() {
            let length = spirals().map(|(_, s)| s.length).fold(f64::INFINITY, f64::min);
            self.outcome = best.map(|(i, _)| i).ok_or(Why::TooLong { length, longest });
        }
        self
    }

    /// The same with other end curvatures that would do, where there is no cubic spiral but one of some other kind.
    ///
    /// This asks [`solve`] about some hundred other data, so it is left out unless somebody reads it.
    ///
    /// # Errors
    /// Those of [`Placement::normalise`].
    pub fn with_remedies(mut self) -> Result<Answer> {
        if let Err(why) = self.outcome {
            self.outcome = Err(why.remedied(&self.ends, exists)?);
        }
        Ok(self)
    }

    /// The chosen spiral, if there is one.
    pub fn chosen(&self) -> Option<&Solution> {
        self.solutions.get(*self.outcome.as_ref().ok()?)
    }
}

/// Whether a cubic spiral joins two ends, proved; no where that is not known.
pub(super) fn exists(ends: &Ends) -> bool {
    let solved = Placement::normalise(ends).and_then(|(datum, _)| solve(&datum));
    solved.is_ok_and(|solved| solved.chosen().is_some())
}

fn index(roots: &[Root], chosen: &Root) -> Result<usize> {
    roots.iter().position(|root| root == chosen).ok_or_else(|| {
        Error::invalid(format!(
            "the chosen root ({:?}, {:?}) is not among the {} roots",
            chosen.f0,
            chosen.f1,
            roots.len()
        ))
    })
}

impl Solution {
    /// The curve as a piece of a path.
    pub fn piece(&self) -> Piece {
        Piece::Cubic(Cubic { points: self.control_points, legs: self.legs })
    }

    fn non_spiral(&self) -> NonSpiral {
        NonSpiral { f0: self.f0, f1: self.f1, margin: self.margin, extrema: self.extrema.clone() }
    }

    fn new(datum: &Datum, placement: &Placement, root: &Root) -> Result<Solution> {
        let Root { f0, f1, theorem31, spiral, margin } = *root;
        let control_points = placement.place(datum, f0, f1);
        let local_control_points = placement.place_local(datum, f0, f1);
        let legs = placement.to_user_legs(&CubicBezier::legs(
            [datum.phi0, datum.phi1],
            [datum.kappa0, datum.kappa1],
            [f0, f1],
        ));
        let mut all = control_points.p.iter().chain(&local_control_points.p).chain(&legs);
        if !all.all(|p| p[0].is_finite() && p[1].is_finite()) {
            return Err(Error::beyond_doubles(format!("the cubic of the root ({f0:?}, {f1:?})"), OTHER_UNIT));
        }
        let length = arc_length(|t| of_legs(&legs, t).speed(), 0.0, 1.0);
        // A proved spiral has none; rounding must not say otherwise.
        let extrema = if spiral { Vec::new() } else { local_control_points.curvature_extrema() };
        Ok(Solution { f0, f1, theorem31, spiral, margin, length, control_points, local_control_points, legs, extrema })
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.outcome, self.chosen()) {
            (Err(why), _) => writeln!(f, "{}", why.sentence("cubic spiral"))?,
            (_, Some(Solution { f0, f1, margin, length, control_points, .. })) => {
                writeln!(
                    f,
                    "cubic spiral (f0, f1) = ({f0:?}, {f1:?}), margin {margin:?}, length {length:?}; control points"
                )?;
                for [x, y] in control_points.p {
                    writeln!(f, "  ({x:?}, {y:?})")?;
                }
            }
            (Ok(_), None) => writeln!(f, "no such solution")?,
        }
        write!(f, "{}", self.placement.described(&self.datum))
    }
}
