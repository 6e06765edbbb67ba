//! Scalars from doubles, with proof, for most nodes.

use super::arc::bracket;
use super::differences::Differences;
use super::pair::Pair;
use crate::num::roots::find;
use crate::num::sines::{cos, sin};
use std::cell::OnceCell;

/// 2^-53.
const UNIT: f64 = 0.5 * f64::EPSILON;
/// The root of tan θ = θ after 0, rounded down: up to there ω(θ) <= π.
const FIRST_TANGENT_ROOT: f64 = 4.493;

/// Numbers that lie from the first to the second.
type Range = (f64, f64);

/// The scalars of one datum as doubles can prove them.
pub(super) struct Fast {
    q: Range,
    omega: f64,
    /// θ and t0.
    arc: OnceCell<Option<[Range; 2]>>,
}

impl Fast {
    /// For curvatures times half the chord, and the constants of both angles.
    pub(super) fn new(k1: f64, k2: f64, pair: &Pair) -> Fast {
        let (q, error) = pair.q(k1, k2);
        Fast { q: (q - error, q + error), omega: pair.omega, arc: OnceCell::new() }
    }

    /// Scalar 0 (Q), 2 (θ) or 3 (t0), if doubles prove its nearest f32; the last two need Q < 0 and ω ≠ 0.
    pub(super) fn scalar(&self, which: usize) -> Option<f32> {
        let (low, high) = match which {
            0 => self.q,
            2 | 3 => (*self.arc.get_or_init(|| self.arc()))?[which - 2],
            _ => return None,
        };
        // One more unit for the rounding of the ends themselves. One zero, whatever the sign of what underflowed.
        let (low, high) = ((low - low.abs() * f64::EPSILON) as f32, (high + high.abs() * f64::EPSILON) as f32);
        (low == high).then_some(low + 0.0)
    }

    fn arc(&self) -> Option<[Range; 2]> {
        // Q between two negative numbers, known to a thousandth.
        let (q, spread) = (-0.5 * (self.q.0 + self.q.1), 0.5 * (self.q.1 - self.q.0));
        if !(self.q.1 < 0.0 && q.is_finite() && spread * 1024.0 < q) {
            return None;
        }
        let equation =
            Equation { q, spread: spread / q, omega: self.omega, sin: sin(self.omega), cos: cos(self.omega) };
        let [low, high] = bracket(0.0, self.omega);
        let guess = find(|theta| equation.at(theta).value, low, high.min(4.7), low * 2f64.powi(-46));
        [-40, -34, -28].into_iter().find_map(|exponent| {
            let reach = guess * 2f64.powi(exponent);
            let (low, high) = (guess - reach, guess + reach);
            if high > FIRST_TANGENT_ROOT {
                return None;
            }
            let (below, above) = (equation.at(low), equation.at(high));
            // F rises through its one root up to there; t0 rises with θ.
            let proved = below.value < -below.error && above.value > above.error;
            proved.then_some([(low, high), (below.t0 * (1.0 - below.t0_error), above.t0 * (1.0 + above.t0_error))])
        })
    }
}

/// F of [`super::arc`] in doubles.
struct Equation {
    q: f64,
    /// Relative error of q.
    spread: f64,
    /// To a rounding.
    omega: f64,
    sin: f64,
    cos: f64,
}

struct Value {
    value: f64,
    /// How far it may be off.
    error: f64,
    t0: f64,
    /// Relative.
    t0_error: f64,
}

impl Equation {
    /// For 0 < θ <= 4.7. Counts of roundings are those of [`Differences`], with a little more for their products.
    fn at(&self, theta: f64) -> Value {
        let (sin, cos) = (sin(theta), cos(theta));
        let shape = Differences::new(theta, sin, cos);
        let p_error = if theta < 1.0 { 8.0 * UNIT * shape.p } else { 14.0 * UNIT * (sin.abs() + theta * cos.abs()) };
        let t0 = (theta * theta + shape.w / self.q).sqrt();
        let t0_error = 48.0 * UNIT + 0.51 * self.spread;
        let x = t0 * sin.abs();
        let (first, second) = (self.cos * shape.p, self.sin * t0 * sin);
        // sin ω and cos ω: 10 units each, and the rounding of ω itself, 1 unit of it.
        let turned = UNIT * self.omega;
        let error = (10.0 * UNIT * self.cos.abs() + turned) * shape.p.abs()
            + self.cos.abs() * p_error
            + (10.0 * UNIT * self.sin + turned) * x
            + self.sin * x * (t0_error + 12.0 * UNIT)
            + 4.0 * UNIT * (first.abs() + second.abs());
        Value { value: first - second, error: 1.02 * error, t0, t0_error: 1.02 * t0_error }
    }
}
