//! The domain, and what depends on the ratio and the angle alone.

use super::poly::Frame;
use crate::error::{Error, Result, positive};
use crate::num::sines::{cos, sin};
use crate::num::{Interval, Real};
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
    let name = NAMES[which];
    match which {
        // The double next to π/2 lies below it.
        1 if value > 0.0 && value <= FRAC_PI_2 => Ok(()),
        1 => Err(Error::angle(name, value, "above 0 and below pi/2", "radians; write `45deg` for degrees")),
        3 | 4 if value > -4.0 && value <= 1.0 => Ok(()),
        3 | 4 => Err(Error::domain(name, value, "above -4 and at most 1")),
        _ => positive(name, value).map(drop),
    }
}

impl Frame<f64> {
    /// Within [`FRAME_ERRORS`]; `None` for angles so small that their squares might underflow.
    pub(super) fn new(ratio: f64, theta: f64) -> Option<Frame<f64>> {
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
    pub(super) fn exact(ratio: f64, theta: f64, bits: usize) -> Option<Frame<Interval>> {
        Frame::of(&Interval::new(ratio, bits), Interval::sin_cos(theta, bits))
    }
}

impl<N: Real> Frame<N> {
    /// From sine and cosine of the angle.
    pub(super) fn of(ratio: &N, (sine, cosine): (N, N)) -> Option<Frame<N>> {
        let whole = cosine.plus(1.0);
        let tangent = sine.over(&whole)?;
        let y = ratio.over(&whole.times(2.0))?;
        Some(Frame { y, last: cosine.times(6.0).over(&whole)?, square: tangent.mul(&tangent) })
    }
}
