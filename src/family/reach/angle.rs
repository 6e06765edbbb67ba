//! What depends on the angle alone.

use super::Kind;
use crate::error::{Error, Result};
use crate::family::last::{Last, kept};
use crate::num::sines::{cos, sin};
use crate::num::{Interval, Real, Twin, formula};
use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::rc::Rc;

/// Relative error of `to_alpha` and `to_beta`, in units of 2^-53: tan is 10 + 10 + 1, squared and divided into a
/// constant 44.
pub(super) const SCALE_ERROR: f64 = 45.0;

/// The constants of an angle; see [`super::poly`] for L, g, α, β.
#[derive(Debug, Clone, Copy)]
pub(super) struct Angle {
    /// sin θ.
    pub sin: f64,
    /// cos θ; negative beyond a right angle (PH only).
    pub cos: f64,
    /// cos θ, or cos²(θ/2) within 21 units: above 0.
    pub g: f64,
    /// `q = length / u`.
    pub length: f64,
    /// α / a.
    pub to_alpha: f64,
    /// β / b.
    pub to_beta: f64,
}

/// α L²/a and β L²/b.
pub(super) fn factors(kind: Kind) -> (f64, f64) {
    match kind {
        Kind::Cubic => (3.0, 6.0),
        Kind::Ph => (60.0, 120.0),
    }
}

impl Angle {
    /// The constants, or `None` where a sine is under 2^-50: such angles are left to intervals.
    pub(super) fn new(kind: Kind, theta: f64) -> Option<Angle> {
        let least = 2f64.powi(-50);
        let (sin_theta, cos_theta) = (sin(theta), cos(theta));
        let half = cos(0.5 * theta);
        let (length, g) = match kind {
            Kind::Cubic => (sin_theta, cos_theta),
            Kind::Ph => (sin(0.5 * theta) / half, half * half),
        };
        let (alpha, beta) = factors(kind);
        let square = length * length;
        (sin_theta >= least && length >= least).then_some(Angle {
            sin: sin_theta,
            cos: cos_theta,
            g,
            length,
            to_alpha: alpha / square,
            to_beta: beta / square,
        })
    }
}

/// [`Angle`] in two doubles or in intervals.
#[derive(Debug)]
pub(super) struct ExactAngle<N> {
    pub sin: N,
    pub cos: N,
    pub g: N,
    pub length: N,
}

impl ExactAngle<Interval> {
    /// Kept for the next call.
    pub(super) fn cached(kind: Kind, theta: f64, bits: usize) -> Option<Rc<ExactAngle<Interval>>> {
        thread_local!(static LAST: Last<(Kind, u64, usize), ExactAngle<Interval>> = const { RefCell::new(None) });
        kept(&LAST, (kind, theta.to_bits(), bits), || ExactAngle::new(kind, theta, bits))
    }

    fn new(kind: Kind, theta: f64, bits: usize) -> Option<ExactAngle<Interval>> {
        ExactAngle::of(kind, Interval::sin_cos(theta, bits))
    }
}

impl ExactAngle<Twin> {
    /// In two doubles each.
    pub(super) fn twins(kind: Kind, theta: f64) -> Option<ExactAngle<Twin>> {
        ExactAngle::of(kind, Twin::sin_cos(theta))
    }
}

impl<N: Real> ExactAngle<N> {
    fn of(kind: Kind, (sin, cos): (N, N)) -> Option<ExactAngle<N>> {
        let (length, g) = match kind {
            Kind::Cubic => (sin.clone(), cos.clone()),
            // tan(θ/2) = sin θ / (1 + cos θ)
            Kind::Ph => (sin.over(&cos.plus(1.0))?, formula!(0.5 * (cos + 1.0))),
        };
        Some(ExactAngle { sin, cos, g, length })
    }
}

/// The greatest double below what an angle must stay below, which is no double, and that in words.
pub(super) fn greatest(kind: Kind) -> (f64, &'static str) {
    match kind {
        Kind::Cubic => (FRAC_PI_2, "pi/2"),
        Kind::Ph => (PI, "pi"),
    }
}

/// An angle must be positive and below π/2 (cubic) or π (PH); both lie just above their doubles.
pub(super) fn check(kind: Kind, theta: f64) -> Result<()> {
    let (most, name) = greatest(kind);
    if theta > 0.0 && theta <= most {
        return Ok(());
    }
    let limit = format!("above 0 and below {name} for `{}`", kind.name());
    Err(Error::angle("theta", theta, limit, "radians; write `40deg` for degrees"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_keep_their_bounds() {
        let mut worst: f64 = 0.0;
        for kind in [Kind::Cubic, Kind::Ph] {
            let mut compared = 0;
            let near_right = (1..9).map(|i| FRAC_PI_2 - 1e-3 * 2f64.powi(-6 * i));
            let near_straight = (1..9).map(|i| PI - 1e-3 * 2f64.powi(-6 * i));
            let angles = (1..300).map(|i| f64::from(i) * 0.0105).chain(near_right).chain(near_straight);
            for theta in angles.chain([1e-9, 1e-14, FRAC_PI_2, PI]).filter(|t| check(kind, *t).is_ok()) {
                let Some(angle) = Angle::new(kind, theta) else { continue };
                let truth = ExactAngle::new(kind, theta, 320).expect("enough bits");
                let (to_alpha, to_beta) = factors(kind);
                let square = truth.length.square();
                let over = |x: f64| Interval::new(x, 320).over(&square).expect("positive");
                let pairs = [
                    (angle.sin, truth.sin.clone(), 10.0),
                    (angle.cos, truth.cos.clone(), 10.0),
                    (angle.g, truth.g.clone(), 21.0),
                    (angle.length, truth.length.clone(), 21.0),
                    (angle.to_alpha, over(to_alpha), SCALE_ERROR),
                    (angle.to_beta, over(to_beta), SCALE_ERROR),
                ];
                for (value, truth, bound) in pairs {
                    let off = truth.plus(-value).over(&truth).expect("not zero").approx().abs() * 2f64.powi(53);
                    assert!(off <= bound, "{kind:?} {theta}: {off} units over {bound}");
                    worst = worst.max(off / bound);
                }
                compared += 1;
            }
            assert!(compared > 140, "{compared}");
        }
        assert!(worst > 0.05, "the bounds were not tested: {worst}");
    }
}
