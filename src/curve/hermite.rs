//! First-order Hermite interpolation: end points and derivatives.

use super::PhQuintic;
use super::choice::Choice;
use super::vector::{complex, finite, pair};
use crate::error::{Error, Result};
use num_complex::Complex64;

/// End points and end derivatives with respect to the parameter, which runs from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hermite {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends; may be where it starts.
    pub end: [f64; 2],
    /// Derivative at the start, not 0.
    pub start_derivative: [f64; 2],
    /// Derivative at the end, not 0.
    pub end_derivative: [f64; 2],
}

/// The four PH quintics with given ends and end derivatives: `w2 = √d1` with either sign of the inner root, then
/// `w2 = -√d1`.
///
/// # Accuracy
/// End points exact, end derivatives to a few roundings; inner control points to a few roundings of the largest of
/// chord and derivatives.
///
/// # Errors
/// [`Error::Domain`] naming a number that is not finite, a derivative of 0 (it has no direction), or results beyond
/// doubles.
///
/// ```
/// use spiral_atlas::curve::{Hermite, hermite};
/// let (start, end) = ([0.0, 0.0], [1.0, 0.0]);
/// let ends = Hermite { start, end, start_derivative: [1.0, 1.0], end_derivative: [1.0, -1.0] };
/// let choice = hermite(&ends)?;
/// assert!((choice.candidates[choice.best].absolute_rotation - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn hermite(ends: &Hermite) -> Result<Choice> {
    let Hermite { start, end, start_derivative, end_derivative } = *ends;
    finite("Hermite interpolation", "start", &start)?;
    finite("Hermite interpolation", "end", &end)?;
    let root = |name: &str, d: [f64; 2]| -> Result<Complex64> {
        finite("Hermite interpolation", name, &d)?;
        if d == [0.0, 0.0] {
            return Err(Error::invalid(format!(
                "Hermite interpolation: `{name}` is 0, which has no direction; give a vector along the path"
            )));
        }
        Ok(complex(d).sqrt())
    };
    let (w0, last) = (root("start_derivative", start_derivative)?, root("end_derivative", end_derivative)?);
    let chord = complex(end) - complex(start);
    let curve = |(sign, inner): (f64, f64)| {
        let w2 = last * sign;
        // 2 w1² + 3 (w0 + w2) w1 + 3 w0² + w0 w2 + 3 w2² = 15 Δp, the integral of w².
        let square = 120.0 * chord - 15.0 * w0 * w0 - 15.0 * w2 * w2 + 10.0 * w0 * w2;
        let w1 = (square.sqrt() * inner - 3.0 * (w0 + w2)) / 4.0;
        PhQuintic::between(start, end, [pair(w0), pair(w1), pair(w2)])
    };
    Choice::of("Hermite interpolation", [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(curve))
}
