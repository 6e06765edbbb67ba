//! The image of an involute between two ends anywhere in the plane.

use super::placement::Ends;
use crate::curve::vector::{Vector, add, turn};
use crate::error::{Error, Result};
use crate::family::any_spiral::{GREATEST, Spiral, involute};
use serde::Serialize;

/// [`involute`] for ends anywhere in the plane, with what places the result there.
///
/// # Errors
/// Those of [`involute`], and [`crate::Error::Domain`] for coincident ends or lengths outside the range of doubles.
pub fn involute_between(ends: &Ends, turns: [u32; 2]) -> Result<(Spiral, Frame)> {
    let (chord, half_chord) = ends.chord()?;
    for (which, k) in [("start", chord.k1), ("end", chord.k2)] {
        if k.abs() > GREATEST {
            return Err(Error::Domain(format!(
                "the {which} curvature times half the chord is {k:?}; for an involute it must be at most {GREATEST:?} in magnitude"
            )));
        }
    }
    Ok((involute(&chord, turns)?, Frame { start: ends.start, end: ends.end, half_chord }))
}

/// How the chord's frame lies in the user's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Frame {
    /// Image of (-1, 0).
    pub start: [f64; 2],
    /// Image of (1, 0).
    pub end: [f64; 2],
    /// Half the chord as a vector.
    pub half_chord: [f64; 2],
}

impl Frame {
    /// A point of the chord's frame in the user's; the ends are met exactly, and others seen from the nearer one.
    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (near, origin): (Vector, f64) = if x <= 0.0 { (self.start, -1.0) } else { (self.end, 1.0) };
        add(near, turn(self.half_chord, [x - origin, y]))
    }
}
