//! What depends on the two angles alone, in doubles.

use crate::family::outer::Sines;
use crate::num::sines::{sin, sin_of_sum, two_sum};

/// Relative error of [`Pair::sines`], in units of 2^-53, and four more for [`crate::family::outer`]: a sine of 10
/// units, its square of 21.
pub(super) const PAIR_ERROR: f64 = 32.0;

/// Angles smaller than this, and sums of angles, are left to intervals unless they are 0: their squares would
/// underflow.
const LEAST: f64 = 1e-120;

/// The constants of a pair of angles; spirals of falling curvature are looked at in the mirror.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// The sign of ω: 1, -1, or 0 where no short spiral exists.
    pub side: f64,
    /// `[-sin α, sin β, sin² ω]` of the data, mirrored if ω < 0.
    pub sines: Sines<f64>,
    /// |ω| to a rounding.
    pub omega: f64,
}

/// The sign of ω, exactly: 1, -1 or 0.
pub(super) fn side(alpha: f64, beta: f64) -> f64 {
    // A rounded sum has the sign of the sum.
    let (sum, _) = two_sum(alpha, beta);
    if sum == 0.0 { 0.0 } else { sum.signum() }
}

impl Pair {
    /// For angles in [-π, π]; `None` where they are too small for doubles.
    pub(super) fn new(alpha: f64, beta: f64) -> Option<Pair> {
        let side = side(alpha, beta);
        let sum = (alpha + beta).abs();
        if [alpha.abs(), beta.abs(), sum].iter().any(|x| *x != 0.0 && *x < LEAST) {
            return None;
        }
        let sine = |x: f64| x.signum() * sin(x.abs());
        let mirror = if side < 0.0 { -1.0 } else { 1.0 };
        let half = if side == 0.0 { 0.0 } else { sin_of_sum(0.5 * mirror * alpha, 0.5 * mirror * beta) };
        Some(Pair { side, sines: [-mirror * sine(alpha), mirror * sine(beta), half * half], omega: 0.5 * sum })
    }

    /// Q and how far it may be off.
    pub(super) fn q(&self, k1: f64, k2: f64) -> (f64, f64) {
        let mirror = if self.side < 0.0 { -1.0 } else { 1.0 };
        let ([sin0, sin1, square], kappa0, kappa1) = (self.sines, mirror * k1, mirror * k2);
        let (room0, room1) = (sin0 - kappa0, kappa1 - sin1);
        let unit = PAIR_ERROR * 2f64.powi(-53);
        let (error0, error1) = ((sin0.abs() + kappa0.abs()) * unit, (sin1.abs() + kappa1.abs()) * unit);
        let product = room0 * room1;
        let error = room0.abs() * error1 + room1.abs() * error0 + error0 * error1 + (product.abs() + square) * unit;
        // What may have underflowed.
        (square - product, error + 1e-300)
    }
}
