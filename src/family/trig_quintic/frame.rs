//! The domain, and what depends on the ratio and the angle alone.

use super::poly::Frame;
use crate::error::{Error, Result};
use crate::family::hermite::told_angle;
use crate::num::sines::{cos, sin};
use crate::num::{Interval, told};
use std::f64::consts::FRAC_PI_2;

/// Names of the coordinates, in order.
pub(super) const NAMES: [&str; 5] = ["ratio", "theta", "m", "p", "q"];

/// Rounding errors in units of 2^-53: of `y`, of the last side, of the square.
///
/// Cosine 10, its sum with 1 11, their quotients with one or two more; the square of a tangent of 22.
pub(super) const FRAME_ERRORS: [f64; 3] = [12.0, 23.0, 45.0];

/// Checks one coordinate.
///
/// # Errors
/// [`Error::Domain`] outside the domain: ratio and m positive, θ in (0, π/2), p and q in (-4, 1]. At -4 a derivative at
/// an end is 0.
pub(super) fn check(which: usize, value: f64) -> Result<()> {
    let (fine, domain) = match which {
        // The double next to π/2 lies below it.
        1 => (value > 0.0 && value <= FRAC_PI_2, "above 0 and below pi/2 (radians; write `45deg` for degrees)"),
        3 | 4 => (value > -4.0 && value <= 1.0, "above -4 and at most 1"),
        _ => (value > 0.0 && value.is_finite(), "finite and above 0"),
    };
    if fine {
        return Ok(());
    }
    let value = if which == 1 { told_angle(value) } else { told(value) };
    Err(Error::Domain(format!("{} is {value}; it must be {domain}", NAMES[which])))
}

impl Frame<f64> {
    /// Within [`FRAME_ERRORS`]; `None` for angles so small that their squares might underflow.
    pub fn new(ratio: f64, theta: f64) -> Option<Frame<f64>> {
        let (sine, cosine) = (sin(theta), cos(theta));
        let whole = 1.0 + cosine;
        let tangent = sine / whole;
        let least = 2f64.powi(-200);
        (theta >= least).then_some(Frame {
            y: ratio / (2.0 * whole),
            last: 6.0 * cosine / whole,
            square: tangent * tangent,
        })
    }
}

impl Frame<Interval> {
    /// In intervals; `None` when the precision does not suffice.
    pub fn exact(ratio: f64, theta: f64, bits: usize) -> Option<Frame<Interval>> {
        let (sine, cosine) = Interval::sin_cos(theta, bits);
        let whole = cosine.plus(1.0);
        let y = Interval::new(ratio, bits).over(&whole.scale(2.0))?;
        Some(Frame { y, last: cosine.scale(6.0).over(&whole)?, square: sine.over(&whole)?.square() })
    }
}
