//! How accurate the constants of a pair are, and the error bounds that follow.

use super::pair::{PAIR_ERROR, Pair};
use super::poly::Bounds;

/// Errors of F in the δ that is tried for a root: the value at the guess may take one half, and the proof needs one.
pub(super) const TRIED: f64 = 2.5;
/// A root's δ stays below one over this of the root.
pub(super) const SMALL: f64 = 64.0;
/// `|y - y*| <= a (2x + δ) δ + η`, and δ with the rounded ends is below x/54: so many `a x δ`.
pub(super) const THROUGH_X: f64 = 2.1;
/// Units by which the rounded ends x - δ and x + δ may be off: up to 2 each, for x up to 3.
pub(super) const ENDS: f64 = 4.0;
/// Units of rounding in `8 w B0 B2 - B1²`, and in a term of the spiral polynomial's value.
pub(super) const ROUNDINGS: f64 = 16.0;
/// Of `8 w B0 B2`: eight of what its factors' errors make, and a little for products of errors and for roundings.
pub(super) const THROUGH: f64 = 8.1;

/// Constants of the error bounds; the f32 shader has its own set, derived the same way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Precision {
    /// Unit roundoff u.
    pub unit: f64,
    /// Relative error of a, k, κ0, κ1 and the constants of a pair, in units.
    pub input: f64,
}

impl Precision {
    /// f64: a pair constant and a product ([`PAIR_ERROR`] + 2).
    pub(super) const F64: Precision = Precision { unit: 1.0 / (1u64 << 53) as f64, input: PAIR_ERROR + 2.0 };
    /// f64 with correctly rounded pair constants ([`Pair::precise`]): 1 and a product.
    pub(super) const FINE: Precision = Precision { input: 3.0, ..Precision::F64 };
    /// f32: constants rounded once from f64, κ rounded once, one product: 3, and a little for the f64 errors below.
    pub(super) const F32: Precision = Precision { unit: 1.0 / (1u32 << 24) as f64, input: 4.0 };

    /// Γ of [`Bounds`].
    pub(super) fn gamma(self) -> f64 {
        (self.input + 12.0) * self.unit
    }
    /// `3k` against 1: the input and one product.
    pub(super) fn third(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// The discriminant: up to four inputs and eight operations a term.
    pub(super) fn discriminant(self) -> f64 {
        (4.0 * self.input + 10.0) * self.unit
    }
    /// `s - κ` for a sine s, and their product: input and two operations.
    pub(super) fn outer(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// `y = 3 - a x²` for `a x² <= 3`: (input + 2) 3 + 3 + 3 units, doubled: the same constant stands in for |y| in the
    /// residual's bound.
    pub(super) fn eta(self) -> f64 {
        (6.0 * self.input + 16.0) * self.unit
    }
    /// F: the factor of `k y² + 2 k y (V + y)`, where `V = a x²`.
    pub(super) fn residual(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// F: what does not depend on k: two subtractions of numbers up to 3, and x itself, however they are reassociated.
    pub(super) fn residual_floor(self) -> f64 {
        10.0 * self.unit
    }
}

/// A pair of angles ready for [`super::filter::classify`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Prepared {
    /// The constants.
    pub pair: Pair,
    /// Bounds of the φ0 side and of the φ1 side.
    pub bounds: (Bounds, Bounds),
    /// How accurate the constants are.
    pub precision: Precision,
}

impl Prepared {
    /// A pair by the quick sines: for grids.
    pub(super) fn new(phi0: f64, phi1: f64) -> Option<Prepared> {
        Pair::new(phi0, phi1).map(|pair| Prepared::with(pair, Precision::F64))
    }

    /// A correctly rounded pair, half a millisecond when its angles are new: where bounds must be close.
    pub(super) fn precise(phi0: f64, phi1: f64) -> Option<Prepared> {
        Pair::precise(phi0, phi1).map(|pair| Prepared::with(pair, Precision::FINE))
    }

    fn with(pair: Pair, precision: Precision) -> Prepared {
        Prepared { pair, bounds: Bounds::of_pair(&pair, precision.gamma()), precision }
    }
}
