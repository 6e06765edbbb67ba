//! Paths of Pythagorean-hodograph quintics by arc length or by end speeds: how little they can bend (Farouki et al.,
//! section 6).
//!
//! # How it is done
//! - One module (`ph_path`) for both: a length with equal end speeds is the other's datum once the speed is known
//!   (`curves.rs`).
//! - The scalar is the least of four greatest curvatures. A minimum needs no winner: overlapping enclosures are united.
//!   The flags need one, which is proved by a single curvature that it stays below and each other exceeds; two that tie
//!   for all precisions are decided by symmetry (`curves.rs`, `truth.rs`).
//! - One certificate, "|κ| stays below v": v σ² ∓ h on pieces of w (`curve/hodograph.rs`). v is just above the value at
//!   a peak (scalars), between two solutions (winner), or the end's own curvature, whose zero is left out
//!   (PEAK_INSIDE). Guesses are free: a missed peak is where the certificate fails, and the next start.
//! - Both angles 0 make straight lines, decided by exact signs (`straight.rs`).
//! - `range.rs` runs the same formulas on ranges of sizes, as doubles with that much error: the bounds of
//!   `path/least_curvature.rs`.

mod answer;
mod bound;
mod curves;
mod datum;
mod range;
mod region;
mod shader;
mod straight;
mod table;
#[cfg(test)]
mod tests;
mod truth;

pub(crate) use range::{Candidate, Search};

use super::{About, Answer, Chart, Family, Flag, Region, Scalar, Table};
use crate::error::Result;
use crate::grid::Grid;

/// What is given besides the directions of both ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The arc length; both ends have the same parametric speed.
    EqualLength,
    /// The parametric speeds of both ends.
    Hermite,
}

/// The families `ph-equal-length` and `ph-hermite`.
#[derive(Debug, Clone, Copy)]
pub struct PhPath(pub Kind);

/// Bit of REGULAR.
pub const REGULAR: u8 = 1;
/// Bit of ONE_WAY.
pub const ONE_WAY: u8 = 1 << 1;
/// Bit of PEAK_INSIDE.
pub const PEAK_INSIDE: u8 = 1 << 2;
/// Bit of PAPER.
pub const PAPER: u8 = 1 << 3;

const FLAGS: &[Flag] = &[
    Flag {
        name: "REGULAR",
        label: "some path",
        doc: "some solution stands still nowhere; what follows is said of the one whose greatest |curvature| is least",
    },
    Flag {
        name: "ONE_WAY",
        label: "turns one way",
        doc: "the curvature of that solution does not change its sign; of two that tie, that of one",
    },
    Flag {
        name: "PEAK_INSIDE",
        label: "bends most inside",
        doc: "its |curvature| is greatest strictly inside, greater than at both ends: end curvatures do not bound it",
    },
    Flag {
        name: "PAPER",
        label: "one of the paper's",
        doc: "it is one of the paper's two: w2 with the positive sign, for half angles in [-pi/2, pi/2]",
    },
];

const SCALARS: &[Scalar] = &[
    Scalar {
        name: "kappa_max",
        doc: "greatest |curvature| times the chord, the least of all solutions that stand still nowhere; at least 0; \
              beyond the largest single, that",
    },
    Scalar {
        name: "kappa_max_paper",
        doc: "the same of the two solutions with w2 of the positive sign, which the paper takes; none where both stand \
              still",
    },
];

const CHARTS: [&[Chart]; 2] = [
    &[Chart {
        name: "length",
        axes: &["theta0", "theta1", "S"],
        doc: "theta0, theta1: directions at start and end against the chord, radians, counter-clockwise, -pi to pi (0, \
              or 1e-9 and more); S: arc length over the chord, above 1 by at least 1e-6, at most 1e6",
    }],
    &[Chart {
        name: "speeds",
        axes: &["theta0", "theta1", "l0", "l1"],
        doc: "theta0, theta1: directions at start and end against the chord, radians, counter-clockwise, -pi to pi (0, \
              or 1e-9 and more); l0, l1: lengths of the end derivatives over the chord, 1e-6 to 1e6",
    }],
];

impl Kind {
    fn axes(self) -> &'static [&'static str] {
        CHARTS[self as usize][0].axes
    }
}

const EQUAL_LENGTH: About = About {
    name: "ph-equal-length",
    title: "the least greatest curvature of PH quintics of given arc length (Farouki et al.)",
    charts: CHARTS[Kind::EqualLength as usize],
    conventions: "start (0, 0), end (1, 0); the curve's derivative is w^2 for a quadratic w with Bernstein \
                  coefficients w0, w1, w2, |w0| = |w2|; lengths in chords, curvatures in their inverses, angles in \
                  radians",
    flags: FLAGS,
    yes: &["REGULAR"],
    nested: &["REGULAR", "ONE_WAY"],
    counts: &[],
    scalars: SCALARS,
    control_points: 6,
};

const HERMITE: About = About {
    name: "ph-hermite",
    title: "the least greatest curvature of PH quintics with given end derivatives (Farouki et al.)",
    charts: CHARTS[Kind::Hermite as usize],
    conventions: "start (0, 0), end (1, 0); the curve's derivative is w^2 for a quadratic w with Bernstein \
                  coefficients w0, w1, w2, |w0|^2 = l0, |w2|^2 = l1; lengths in chords, curvatures in their inverses, \
                  angles in radians",
    ..EQUAL_LENGTH
};

impl Family for PhPath {
    fn about(&self) -> &'static About {
        match self.0 {
            Kind::EqualLength => &EQUAL_LENGTH,
            Kind::Hermite => &HERMITE,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::PathTable::new(self.0, grid)?))
    }
    fn compute(&self, _chart: usize, point: &[f64]) -> Result<Answer> {
        answer::answer(self.0, point)
    }
    fn region(&self) -> &dyn Region {
        self
    }
}
