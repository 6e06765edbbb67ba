//! Pythagorean-hodograph quintic spirals matching G² Hermite data: all of them, counted with proof.
//!
//! # How it is done
//! - The two equations, taken across the two end tangents, have positive terms only, for all φ0 + φ1 < π: level lines
//!   of posynomials, so in (ln(B/A), ln A²) two graphs of concave functions (`curves.rs`). Values and slopes at two
//!   points prove "no meeting" (chord against tent) or "at most one" (monotone distance); `march.rs` halves until one
//!   of them holds. No resultant of degree 18, nothing cancels, and f32, f64 and intervals run the same steps.
//! - `lanes` runs the march on vectors of nodes, with relative errors that are counted beforehand. What it leaves open
//!   goes node by node. `factors.rs` proves the factors of their bounds and of the shader's.
//! - `num::Ball` is a double with its error; `num::Real` is what it shares with `Interval`, so the algorithm is written
//!   once. The shader is its twin.
//! - `narrow.rs` has more certificates for nearly parallel tangents, where both equations almost coincide.
//! - `fork.rs` has those for where solutions merge, and `cuts.rs` finds by Newton's method where to ask them.
//! - `region.rs` runs the same march over boxes of data; `dismiss.rs` has plain bounds that show where no spirals are.
//! - Curvature is positive for A, B > 0, so a spiral is the sign of one quintic, as in `cubic`. Energies are Taylor
//!   series on pieces with a remainder bound.

mod curves;
mod cuts;
mod dismiss;
mod factors;
mod fork;
mod knot;
mod lanes;
mod march;
mod narrow;
mod pair;
mod region;
mod shader;
mod shape;
mod solve;
mod table;
mod truth;

pub use super::cubic::Datum;
pub use solve::{Quintic, Solutions, flags, solve};

use super::hermite::holds_box;
use super::{About, Answer, Chart, Code, Count, Family, Flag, Region, Scalar, Table, coordinates};
use crate::error::Result;
use crate::grid::Grid;

/// The family of PH quintics with G² Hermite ends.
#[derive(Debug, Clone, Copy)]
pub struct PhQuintic;

/// Bit of SOLVABLE.
pub const SOLVABLE: u8 = 1;
/// Bit of SPIRAL.
pub const SPIRAL: u8 = 1 << 1;
/// Bit of ANY_SPIRAL.
pub const ANY_SPIRAL: u8 = 1 << 2;

const FLAGS: &[Flag] = &[
    Flag {
        name: "SOLVABLE",
        label: "solvable",
        doc: "some PH quintic with w0 = A e^(-i phi0/2), w2 = B e^(i phi1/2), A, B > 0 has these ends, none of whose \
              curvatures is negative",
    },
    Flag {
        name: "SPIRAL",
        label: "exact PH quintic spiral",
        doc: "and the curvature of some such curve is monotone: necessary and sufficient",
    },
    Flag {
        name: "ANY_SPIRAL",
        label: "any spiral at all",
        doc: "some spiral of any kind has these ends: Q < 0, phi0 < phi1, kappa0 < kappa1 (Kurnosenko)",
    },
];

const COUNTS: &[Count] = &[
    Count {
        name: "solutions",
        doc: "number of different solutions A, B > 0; 7 stands for 7 and more (3 are the most seen)",
        shift: 0,
        bits: 3,
    },
    Count {
        name: "spirals",
        doc: "number of solutions whose curve is a spiral; 7 stands for 7 and more",
        shift: 3,
        bits: 3,
    },
];

const SCALARS: &[Scalar] = &[
    Scalar {
        name: "A",
        doc: "|w0| of the spiral of least bending energy, above 0; A^2 is the start's speed in half chords",
    },
    Scalar {
        name: "B",
        doc: "|w2| of the spiral of least bending energy, above 0; B^2 is the end's speed in half chords",
    },
    Scalar {
        name: "energy",
        doc: "bending energy of that spiral, above 0: the integral of the squared curvature over arc length, times \
              half the chord",
    },
    Scalar { name: "length", doc: "arc length of that spiral in half chords, above 2" },
    Scalar {
        name: "margin",
        doc: "margin of that spiral, in [0, 1], no unit: least value of the numerator of the curvature's derivative on \
              [0, 1] over its largest Bernstein coefficient",
    },
];

const CHARTS: &[Chart] = &[Chart {
    name: "curvature",
    axes: &["phi0", "phi1", "kappa0", "kappa1"],
    doc: "phi0, phi1: angles of the end tangents against the chord, radians, positive, phi0 + phi1 < pi; kappa0, \
          kappa1: signed end curvatures times half the chord",
}];

impl Family for PhQuintic {
    fn about(&self) -> &'static About {
        &About {
            name: "ph-quintic",
            title: "Pythagorean-hodograph quintic spirals matching G2 Hermite data",
            charts: CHARTS,
            conventions: "end points (-1, 0) and (1, 0); start direction (cos phi0, -sin phi0), end direction (cos \
                          phi1, sin phi1); curvature positive to the left and increasing along the curve; the curve's \
                          derivative is w^2 for a quadratic w with Bernstein coefficients w0, w1, w2; lengths in half \
                          chords, angles in radians",
            flags: FLAGS,
            yes: &["SPIRAL"],
            nested: &["ANY_SPIRAL", "SPIRAL"],
            counts: COUNTS,
            scalars: SCALARS,
            control_points: 6,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::PhTable::new(grid)?))
    }
    fn shortcut(&self, _chart: usize, point: &[f64]) -> Option<Code> {
        let inside = coordinates(point).ok().filter(|point| holds_box(&point.map(|x| [x; 2])));
        Some(inside.map_or(Code::UNDECIDED, table::code))
    }
    fn region(&self) -> &dyn Region {
        self
    }
    fn compute(&self, _chart: usize, point: &[f64]) -> Result<Answer> {
        solve::answer(coordinates(point)?)
    }
}

#[cfg(test)]
mod steps;
