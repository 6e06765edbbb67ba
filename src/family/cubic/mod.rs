//! Cubic Bézier spirals matching G² Hermite data (Habib & Sakai).

mod angles;
mod exact;
mod filter;
mod pair;
mod poly;
mod precision;
mod root;
mod shader;
mod solve;
mod table;

pub use solve::{Datum, Root, Solutions, solve};

use super::{Answer, Chart, Code, Count, Family, Flag, Scalar, Table, coordinates};
use crate::error::Result;
use crate::grid::Grid;
use fearless_simd::Level;

/// The cubic family.
#[derive(Debug, Clone, Copy)]
pub struct Cubic;

/// Bit of SOLVABLE.
pub const SOLVABLE: u8 = 1;
/// Bit of THEOREM31.
pub const THEOREM31: u8 = 1 << 1;
/// Bit of THEOREM31_ANY.
pub const THEOREM31_ANY: u8 = 1 << 2;
/// Bit of SPIRAL.
pub const SPIRAL: u8 = 1 << 3;
/// Bit of ANY_SPIRAL.
pub const ANY_SPIRAL: u8 = 1 << 4;

const FLAGS: &[Flag] = &[
    Flag {
        name: "SOLVABLE",
        label: "solvable (A.9)",
        doc: "the discriminant of (A.3) is not negative and kappa1 > e0/3: Habib & Sakai (A.9)",
    },
    Flag {
        name: "THEOREM31",
        label: "Theorem 3.1",
        doc: "SOLVABLE, and the smaller positive root of (A.10) passes Theorem 3.1: the paper's whole recipe",
    },
    Flag { name: "THEOREM31_ANY", label: "Theorem 3.1, any root", doc: "some root (f0, f1) in (0, 3)^2 passes Theorem 3.1" },
    Flag {
        name: "SPIRAL",
        label: "exact cubic spiral",
        doc: "some root (f0, f1) in (0, 3)^2 has a curve of monotone curvature: necessary and sufficient",
    },
    Flag {
        name: "ANY_SPIRAL",
        label: "any spiral at all",
        doc: "some spiral of any kind has these ends: Q < 0, phi0 < phi1, kappa0 < kappa1 (Kurnosenko)",
    },
];

const COUNTS: &[Count] = &[
    Count { name: "roots", doc: "number of different roots (f0, f1) in (0, 3)^2", shift: 0, bits: 2 },
    Count { name: "spirals", doc: "number of roots whose curve is a spiral", shift: 2, bits: 2 },
];

const SCALARS: &[Scalar] = &[
    Scalar { name: "f0", doc: "f0 of the chosen spiral, in (0, 3), no unit" },
    Scalar { name: "f1", doc: "f1 of the chosen spiral, in (0, 3), no unit" },
    Scalar {
        name: "margin",
        doc: "margin of the chosen spiral, in [0, 1], no unit: least value of the spiral polynomial on [0, 1] over its largest Bernstein coefficient",
    },
];

const CHARTS: &[Chart] = &[
    Chart {
        name: "curvature",
        axes: &["phi0", "phi1", "kappa0", "kappa1"],
        doc: "phi0, phi1: angles of the end tangents against the chord, radians, positive, phi0 + phi1 < pi; kappa0, kappa1: signed end curvatures times half the chord",
    },
    Chart {
        name: "normalised",
        axes: &["phi0", "phi1", "a", "k"],
        doc: "phi0, phi1 as in `curvature`; a = kappa0 d0^2 / (4 sin phi0), k = kappa1 d1^2 / (4 sin phi1), no unit",
    },
];

impl Cubic {
    /// [`Family::table`] with a SIMD level of the caller's choice, to compare levels: all of them prove the same codes.
    ///
    /// # Errors
    /// As [`Family::table`].
    #[doc(hidden)]
    pub fn table_at<'g>(&self, grid: &'g Grid, level: Level) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::CubicTable::new(grid, level)?))
    }
}

impl Family for Cubic {
    fn name(&self) -> &'static str {
        "cubic"
    }
    fn title(&self) -> &'static str {
        "cubic Bezier spirals matching G2 Hermite data (Habib & Sakai)"
    }
    fn charts(&self) -> &'static [Chart] {
        CHARTS
    }
    fn conventions(&self) -> &'static str {
        "end points (-1, 0) and (1, 0); start direction (cos phi0, -sin phi0), end direction (cos phi1, sin phi1); \
         curvature positive to the left and increasing along the curve; lengths in half chords, angles in radians"
    }
    fn flags(&self) -> &'static [Flag] {
        FLAGS
    }
    fn yes(&self) -> &'static [&'static str] {
        &["SPIRAL"]
    }
    fn nested(&self) -> &'static [&'static str] {
        &["ANY_SPIRAL", "SPIRAL", "THEOREM31_ANY", "THEOREM31"]
    }
    fn counts(&self) -> &'static [Count] {
        COUNTS
    }
    fn scalars(&self) -> &'static [Scalar] {
        SCALARS
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        self.table_at(grid, Level::new())
    }
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        solve::answer(chart, coordinates(point)?)
    }
}
