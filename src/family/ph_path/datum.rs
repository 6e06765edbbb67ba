//! Data of both kinds, their domains and their symmetries.

use super::Kind;
use crate::error::{Error, Result};
use crate::num::sines::{SIN_ERROR, cos, sin};
use crate::num::{Ball, Interval, Real, Twin};
use std::f64::consts::PI;

/// Speeds beyond these are refused, and lengths over the chord nearer to 1 or larger: peaks would be more narrow than
/// doubles show.
pub(super) const MOST: f64 = 1e6;
pub(super) const LEAST: f64 = 1e-6;

/// Angles below are refused but for 0: a line that turns back would bend there beyond singles, and more narrowly than
/// doubles show.
pub(super) const LEAST_ANGLE: f64 = 1e-9;

/// A datum, taken as exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Datum {
    pub kind: Kind,
    /// Angles of the end tangents to the chord.
    pub theta: [f64; 2],
    /// End speeds over the chord; of an arc length, both are that over the chord.
    pub size: [f64; 2],
}

impl Datum {
    pub(super) fn new(kind: Kind, node: &[f64]) -> Datum {
        let size = [node[2], node[kind.axes().len() - 1]];
        Datum { kind, theta: [node[0], node[1]], size }
    }

    pub(super) fn symmetry(&self) -> Symmetry {
        let [first, last] = self.theta;
        match (first, last) {
            _ if first == 0.0 && last == 0.0 => Symmetry::Line,
            _ if self.size[0] != self.size[1] => Symmetry::None,
            _ if first == -last => Symmetry::Arch,
            _ if first == last => Symmetry::Wave,
            _ => Symmetry::None,
        }
    }
}

/// Which symmetries map the ends to themselves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Symmetry {
    None,
    /// `θ1 = -θ0`, equal speeds: reflection across the chord's bisector.
    Arch,
    /// `θ1 = θ0`, equal speeds: half a turn about the chord's middle.
    Wave,
    /// Both angles 0: reflection in the chord; with equal speeds both others too.
    Line,
}

/// Refuses what lies outside the domain, by name.
pub(super) fn check(kind: Kind, axis: usize, value: f64) -> Result<()> {
    let name = kind.axes()[axis];
    let (fits, range) = match (axis, kind) {
        (0 | 1, _) => {
            let fits = value == 0.0 || (LEAST_ANGLE..=PI).contains(&value.abs());
            (fits, "0, or 1e-9 to pi in size (radians; beyond, add or subtract a turn)")
        }
        (_, Kind::EqualLength) => {
            ((1.0 + LEAST..=MOST).contains(&value), "above 1, the straight line's, by 1e-6 at least, and at most 1e6")
        }
        (_, Kind::Hermite) => ((LEAST..=MOST).contains(&value), "1e-6 to 1e6, in chords"),
    };
    if fits { Ok(()) } else { Err(Error::domain(name, value, range)) }
}

/// Numbers that have sines.
pub(super) trait Turned: Real {
    /// `(cos θ/2, sin θ/2)` for |θ| <= π, the sine of 0 exactly.
    fn half_turn(theta: f64, bits: usize) -> [Self; 2];
}

impl Turned for Ball {
    fn half_turn(theta: f64, bits: usize) -> [Ball; 2] {
        // Halving is exact but for subnormal numbers, which cost at most what `near` adds.
        let half = 0.5 * theta.abs();
        let sine = if theta == 0.0 { Ball::of(0.0, bits) } else { Ball::near(sin(half).copysign(theta), SIN_ERROR) };
        [Ball::near(cos(half), SIN_ERROR), sine]
    }
}

impl Turned for Twin {
    fn half_turn(theta: f64, _bits: usize) -> [Twin; 2] {
        // Halving is exact: angles other than 0 are 1e-9 and more.
        let (sin, cos) = Twin::sin_cos(0.5 * theta);
        [cos, sin]
    }
}

impl Turned for Interval {
    fn half_turn(theta: f64, bits: usize) -> [Interval; 2] {
        let (sin, cos) = Interval::new(theta, bits).scale(0.5).sine_cosine();
        [cos, if theta == 0.0 { Interval::new(0.0, bits) } else { sin }]
    }
}
