//! The PH quintic spiral between two given ends, anywhere in the plane.

use super::none::NoSpiral;
use super::placement::{Ends, Placement};
use super::why::{Why, bends, chosen_or_why};
use crate::curve::PhQuintic;
use crate::error::{Error, OTHER_UNIT, Result};
use crate::family::cubic::Datum;
use crate::family::ph_quintic::{Quintic, SPIRAL, flags, solve};
use serde::Serialize;
use std::fmt;

/// All that is known of two ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhAnswer {
    /// What was asked.
    pub ends: Ends,
    /// The normalised data.
    pub datum: Datum,
    /// How the normalised frame lies in the user's.
    pub placement: Placement,
    /// Every PH quintic of this family that matches the ends, spirals or not, by increasing A.
    pub solutions: Vec<PhSolution>,
    /// The index, into [`PhAnswer::solutions`], of the spiral of least bending energy, or why there is no spiral.
    #[serde(flatten, serialize_with = "chosen_or_why")]
    pub outcome: std::result::Result<usize, Why>,
}

/// One PH quintic that matches the ends, in the user's units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhSolution {
    /// A of the normalised curve; see [`Quintic::a`].
    pub a: f64,
    /// B of the normalised curve.
    pub b: f64,
    /// Whether its curvature is monotone: necessary and sufficient.
    pub spiral: bool,
    /// Scale-free distance from losing it; see [`Quintic::margin`].
    pub margin: f64,
    /// Arc length.
    pub length: f64,
    /// Bending energy: the integral of the squared curvature over arc length, 1 / length.
    pub energy: f64,
    /// The curve itself.
    #[serde(skip)]
    pub curve: PhQuintic,
    /// Bézier control points in the user's direction of travel; the curve starts and ends exactly where asked.
    pub control_points: [[f64; 2]; 6],
    /// The same relative to the start point, for coordinates far from the origin.
    pub local_control_points: [[f64; 2]; 6],
    /// The sides of the control polygon, from the pre-image, each to a few ulp of itself: a fifth of the derivative's
    /// control points, and what to differentiate where an end's tangent is short.
    pub legs: [[f64; 2]; 5],
}

/// Finds the PH quintic spiral of least bending energy between two ends, or says why there is none. Straight ends
/// (curvature 0) are welcome.
///
/// # Accuracy
/// As [`crate::transition::spiral`]: existence is proved for the normalised doubles in [`PhAnswer::datum`]. End points
/// are the user's, exactly; end directions and curvatures of a spiral's [`PhSolution::legs`] are the user's to 1e-12,
/// relative. Control points are rounded at the size of the chord: what is computed from them is known to 1e-15 over the
/// end's leg in half chords (directions), or over its square (curvatures). Length and energy to 2^-36 relative, usually
/// a few ulp.
///
/// # Errors
/// Those of [`Placement::normalise`] and [`solve`], and [`Error::Domain`] when a control
/// point leaves the range of doubles. That no spiral exists is no error but a [`PhAnswer::outcome`].
pub fn ph_spiral(ends: &Ends) -> Result<PhAnswer> {
    let (datum, placement) = Placement::normalise(ends)?;
    let answer = |solutions, outcome| PhAnswer { ends: *ends, datum, placement, solutions, outcome };
    if let Some(why) = Why::no_convex_arc(ends, &datum, &placement)? {
        return Ok(answer(Vec::new(), Err(why)));
    }
    let solved = solve(&datum)?;
    let solutions = solved.all().iter().map(|q| PhSolution::new(&placement, q)).collect::<Result<Vec<_>>>()?;
    let outcome = match solved.chosen_index() {
        Some(i) => Ok(i),
        None => Err(why(ends, &placement, &solutions)?),
    };
    Ok(answer(solutions, outcome))
}

/// The spiral that [`ph_spiral`] chooses, without a reason where there is none.
///
/// # Errors
/// Those of [`ph_spiral`].
pub(super) fn chosen_spiral(ends: &Ends) -> Result<Option<PhSolution>> {
    let (datum, placement) = Placement::normalise(ends)?;
    if !Why::allows_convex_arc(&datum) {
        return Ok(None);
    }
    solve(&datum)?.chosen().map(|quintic| PhSolution::new(&placement, quintic)).transpose()
}

impl PhAnswer {
    /// The same where curves longer than this, in the user's unit, count as none.
    pub fn no_longer_than(mut self, longest: f64) -> PhAnswer {
        let spirals = || self.solutions.iter().enumerate().filter(|(_, s)| s.spiral);
        let best = spirals().filter(|(_, s)| s.length <= longest).min_by(|a, b| a.1.energy.total_cmp(&b.1.energy));
        if self.outcome.is_ok() {
            let length = spirals().map(|(_, s)| s.length).fold(f64::INFINITY, f64::min);
            self.outcome = best.map(|(i, _)| i).ok_or(Why::TooLong { length, longest });
        }
        self
    }

    /// The same with other end curvatures that would do, where there is no PH quintic spiral but one of some other
    /// kind.
    ///
    /// This asks [`flags`] about some hundred other data, so it is left out unless somebody reads it.
    ///
    /// # Errors
    /// Those of [`Placement::normalise`].
    pub fn with_remedies(mut self) -> Result<PhAnswer> {
        if let Err(why) = self.outcome {
            self.outcome = Err(why.remedied(&self.ends, exists)?);
        }
        Ok(self)
    }

    /// The chosen spiral, if there is one.
    pub fn chosen(&self) -> Option<&PhSolution> {
        self.solutions.get(*self.outcome.as_ref().ok()?)
    }
}

impl PhSolution {
    fn new(placement: &Placement, quintic: &Quintic) -> Result<PhSolution> {
        let Quintic { a, b, spiral, margin, length, energy, curve } = quintic;
        let control_points = curve.control_points();
        let (user, local) = (placement.to_user(&control_points), placement.to_user_local(&control_points));
        if !user.iter().chain(&local).flatten().all(|x| x.is_finite()) {
            return Err(Error::beyond_doubles(format!("the solution with A = {a:?}, B = {b:?}"), OTHER_UNIT));
        }
        Ok(PhSolution {
            a: *a,
            b: *b,
            spiral: *spiral,
            margin: *margin,
            length: length * placement.unit(),
            energy: energy / placement.unit(),
            curve: placement.ph_in_user_frame(curve),
            control_points: user,
            local_control_points: local,
            legs: placement.to_user_legs(&curve.legs()),
        })
    }
}

/// Whether a PH quintic spiral joins two ends, proved; no where that is not known.
pub(super) fn exists(ends: &Ends) -> bool {
    let known = Placement::normalise(ends).and_then(|(datum, _)| flags(&datum));
    known.is_ok_and(|flags| flags & SPIRAL != 0)
}

/// Explains a proved "no", in double precision: within rounding of a boundary it may name the neighbouring reason.
fn why(ends: &Ends, placement: &Placement, solutions: &[PhSolution]) -> Result<Why> {
    if let Some(none) = NoSpiral::of(ends)? {
        return Ok(Why::NoSpiralOfAnyKind(none));
    }
    if let Some((which, curvature)) = bends(ends, placement).find(|(_, curvature)| *curvature != 0.0) {
        return Ok(Why::Inflection { which, curvature, turn: placement.turn() });
    }
    let remedies = Vec::new();
    if solutions.is_empty() {
        return Ok(Why::NoPhQuintic { remedies });
    }
    Ok(Why::NoPhSpiral { margins: solutions.iter().map(|s| s.margin).collect(), remedies })
}

impl fmt::Display for PhAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.outcome, self.chosen()) {
            (Err(why), _) => writeln!(f, "{}", why.sentence("PH quintic spiral"))?,
            (_, Some(PhSolution { a, b, margin, length, energy, control_points, .. })) => {
                writeln!(
                    f,
                    "PH quintic spiral A = {a:?}, B = {b:?}, margin {margin:?}, length {length:?}, bending energy \
                     {energy:?}; control points"
                )?;
                for [x, y] in control_points {
                    writeln!(f, "  ({x:?}, {y:?})")?;
                }
            }
            (Ok(_), None) => writeln!(f, "no such solution")?,
        }
        write!(f, "{}", self.placement.described(&self.datum))
    }
}
