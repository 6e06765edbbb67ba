//! Cubic Bézier spirals matching G² Hermite data (Habib & Sakai).
//!
//! # How it is done
//! ## Two numbers for two angles
//! Dividing every `H_i` by `2 sin(φ0+φ1)` and using `sin φ0 sin(φ0+2φ1)/S² = 2p - g0` leaves polynomials in (x, y) =
//! (f0, f1) with the coefficients p, g0, r = 1 - p and g1 = g0 + 1 - 2p (`poly.rs`). The two curvature equations become
//! `3 - y = a x²`, `3 - x = k y²`. So a datum is (p, g0, a, k), and H3..H5 are H2..H0 with the ends exchanged.
//!
//! ## Counting roots
//! With `F(x) = 3 - x - k(3 - a x²)²`: F(0) = 3 - 9k, at y = 0 (x = √(3/a)) F has the sign of a - 1/3, and F = 0 with
//! x > 0 implies x <= 3. Descartes' rule allows 0 or 2 positive roots for k > 1/3 and 1 or 3 otherwise, and the
//! discriminant of F divided by positive factors is `Δ = 768a²k² - 256ak(a+k) + 96ak - 1`. Negative roots are no
//! solutions. The same rule allows one of them for k < 1/3 and 0 or 2 for k > 1/3; there `F(-√(3/a)) > 0 > F(0)` shows
//! that there are 2. Roots with y < 0 are no solutions either. F' = 4akxy - 1 is negative there, so there is one such
//! root for a > 1/3 and none for a < 1/3. Hence:
//!
//! | | k > 1/3 | k < 1/3 |
//! | --- | --- | --- |
//! | a > 1/3 | 1 root, the smaller positive one; Δ > 0 always | 2 if Δ > 0, 0 if Δ < 0 |
//! | a < 1/3 | 2 if Δ > 0, 0 if Δ < 0 | 3 if Δ > 0, 1 if Δ < 0 |
//!
//! The paper's D is Δ times a positive factor, so SOLVABLE (A.9) is `k > 1/3 and Δ >= 0`: three signs, no root. Δ = 0
//! is met exactly only in the chart (a, k), for instance at the triple root a = k = 1/4; there the double root is a
//! closed form (`double_roots`). The number of roots being known, disjoint intervals with opposite certain signs of F,
//! one for each root, *are* the isolation.
//!
//! ## Deciding
//! - ANY_SPIRAL is `κ0 < sin φ0` and `(sin φ0 - κ0)(κ1 - sin φ1) > sin²((φ1-φ0)/2)`. For φ0 < φ1, φ0+φ1 < π and κ0 < κ1
//!   that is Q < 0 (both factors negative would need a product above `cos²Φ sin²δ`). No spiral of any kind outside, so
//!   no root is looked at there.
//! - Theorem 3.1: `H1 + 2√(H0 H2) >= 0` is `B1 >= 0 or B1² <= 8 y B0 B2`.
//! - The exact test is the sign of the quintic in Bernstein form, by halving, as deep as needed.
//! - `φ0 >= φ1` or `κ0 >= κ1`: the four spiral flags are No, while SOLVABLE and the number of roots stay the truth of
//!   the equations. κ0 <= 0 or κ1 <= 0: no root in the open box, SOLVABLE is No ((A.3) needs both positive), ANY_SPIRAL
//!   is still decided.
//! - margin = least value of the quintic on [0, 1] over its largest Bernstein coefficient, in [-1, 1], positive exactly
//!   for spirals (0 only on the boundary). Of several spirals the chosen one has the largest margin.
//!
//! ## Error bounds
//! Every bound is `count · unit · sum of absolute terms`: it counts operations per term, so it holds with fused
//! multiply-adds and reassociated sums. `Precision` has the counts; the f32 shader gets the same counts with its own
//! unit, generated from the same Rust. `Bounds` takes the sums at their largest over the box (0,3)², so a node costs no
//! extra work; a test checks the partial derivatives. The residual of F is bounded by its actual terms, because the
//! interval around a root decides how much the rest can prove.

mod angles;
mod blocks;
mod exact;
mod filter;
mod pair;
mod poly;
mod precision;
mod region;
mod root;
mod shader;
mod solve;
mod surface;
mod table;

pub use solve::{Datum, Root, Solutions, solve};

use super::hermite::holds_box;
use super::{About, Answer, Chart, Code, Count, Family, Flag, Region, Scalar, Table, coordinates};
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
    Flag {
        name: "THEOREM31_ANY",
        label: "Theorem 3.1, any root",
        doc: "some root (f0, f1) in (0, 3)^2 passes Theorem 3.1",
    },
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
        doc: "margin of the chosen spiral, in [0, 1], no unit: least value of the spiral polynomial on [0, 1] over its \
              largest Bernstein coefficient",
    },
];

const CHARTS: &[Chart] = &[
    Chart {
        name: "curvature",
        axes: &["phi0", "phi1", "kappa0", "kappa1"],
        doc: "phi0, phi1: angles of the end tangents against the chord, radians, positive, phi0 + phi1 < pi; kappa0, \
              kappa1: signed end curvatures times half the chord",
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
    fn about(&self) -> &'static About {
        &About {
            name: "cubic",
            title: "cubic Bezier spirals matching G2 Hermite data (Habib & Sakai)",
            charts: CHARTS,
            conventions: "end points (-1, 0) and (1, 0); start direction (cos phi0, -sin phi0), end direction (cos \
                          phi1, sin phi1); curvature positive to the left and increasing along the curve; lengths in \
                          half chords, angles in radians",
            flags: FLAGS,
            yes: &["SPIRAL"],
            nested: &["ANY_SPIRAL", "SPIRAL", "THEOREM31_ANY", "THEOREM31"],
            counts: COUNTS,
            scalars: SCALARS,
            control_points: 4,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        self.table_at(grid, Level::new())
    }
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        solve::answer(chart, coordinates(point)?)
    }
    fn chosen(&self, chart: usize, point: &[f64]) -> Result<(Code, Option<Vec<[f64; 2]>>)> {
        solve::chosen(chart, coordinates(point)?)
    }
    fn shortcut(&self, chart: usize, point: &[f64]) -> Option<Code> {
        let inside = coordinates(point).ok().filter(|point| holds_box(&point.map(|x| [x; 2])));
        Some(inside.map_or(Code::UNDECIDED, |point| table::code(chart, point)))
    }
    fn region(&self) -> &dyn Region {
        self
    }
}
