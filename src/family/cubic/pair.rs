//! What depends on the two tangent angles alone.

use super::angles::Angles;
use crate::num::sines::{cos, sin, sin_of_sum};
use std::f64::consts::PI;

/// Relative error of every constant of a [`Pair`], in units of 2^-53.
///
/// The worst is `curve0 = (sin φ1 / S)² / sin φ0`: two sines of 10 units and a division, twice, then a sine of 10
/// and two roundings: 2 · 21 + 1 + 10 + 1 = 54. A product with a curvature adds 1.
pub(super) const PAIR_ERROR: f64 = 64.0;

/// The constants of a pair of tangent angles; see [`super::poly`] for p, r, g0, g1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// sin φ0 cos φ1 / S; negative beyond φ1 = π/2.
    pub p: f64,
    /// cos φ0 sin φ1 / S.
    pub r: f64,
    /// (sin φ0 / S)².
    pub g0: f64,
    /// (sin φ1 / S)².
    pub g1: f64,
    /// a / κ0 = g1 / sin φ0.
    pub curve0: f64,
    /// k / κ1 = g0 / sin φ1.
    pub curve1: f64,
    /// sin φ0.
    pub sin0: f64,
    /// sin φ1.
    pub sin1: f64,
    /// sin²((φ1 - φ0)/2); 0 unless φ0 < φ1.
    pub sin2_half: f64,
    /// φ0 < φ1: without it no spiral of increasing curvature exists.
    pub rising: bool,
}

/// Smallest sine a pair may have for the f64 step: with it no constant leaves 2^±200.
const LEAST_SINE: f64 = 1.0 / ((1u64 << 50) as f64);

impl Pair {
    /// The constants of `0 < φ0`, `0 < φ1`, `φ0 + φ1 < π`, or `None` where a sine is under 2^-50 or the sum so close to
    /// π that it rounds to π: such pairs are left to intervals.
    pub(super) fn new(phi0: f64, phi1: f64) -> Option<Pair> {
        if phi0 + phi1 >= PI {
            return None;
        }
        let (sin0, sin1, sum) = (sin(phi0), sin(phi1), sin_of_sum(phi0, phi1));
        if !(sin0 >= LEAST_SINE && sin1 >= LEAST_SINE && sum >= LEAST_SINE) {
            return None;
        }
        let square = |x: f64| x * x;
        let (g0, g1) = (square(sin0 / sum), square(sin1 / sum));
        let rising = phi0 < phi1;
        Some(Pair {
            p: sin0 * cos(phi1) / sum,
            r: cos(phi0) * sin1 / sum,
            g0,
            g1,
            curve0: g1 / sin0,
            curve1: g0 / sin1,
            sin0,
            sin1,
            // The difference of two doubles is off by at most one rounding, relative; halving is exact.
            sin2_half: if rising { square(sin(0.5 * (phi1 - phi0))) } else { 0.0 },
            rising,
        })
    }

    /// The same, each constant correctly rounded from intervals; `None` also where 128 bits do not decide the nearest
    /// double.
    pub(super) fn precise(phi0: f64, phi1: f64) -> Option<Pair> {
        let rough = Pair::new(phi0, phi1)?;
        let angles = Angles::cached(phi0, phi1, 128)?;
        Some(Pair {
            p: angles.p.to_f64()?,
            r: angles.r.to_f64()?,
            g0: angles.g0.to_f64()?,
            g1: angles.g1.to_f64()?,
            curve0: angles.g1.over(&angles.outer[0])?.to_f64()?,
            curve1: angles.g0.over(&angles.outer[1])?.to_f64()?,
            sin0: angles.outer[0].to_f64()?,
            sin1: angles.outer[1].to_f64()?,
            sin2_half: if rough.rising { angles.outer[2].to_f64()? } else { 0.0 },
            rising: rough.rising,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Interval;

    #[test]
    fn constants_keep_their_bound() {
        let mut worst: f64 = 0.0;
        let mut compared = 0;
        let angles = [
            1e-12,
            1e-3,
            0.1,
            0.3,
            0.7,
            0.7000000001,
            0.8,
            0.9,
            1.4,
            1.5,
            1.56,
            std::f64::consts::FRAC_PI_2,
            1.6,
            2.2,
            3.0,
            3.1,
        ];
        for phi0 in angles {
            for phi1 in angles {
                let Some(pair) = Pair::new(phi0, phi1) else { continue };
                let truth = Angles::new(phi0, phi1, 320).expect("enough bits");
                let values = [pair.p, pair.r, pair.g0, pair.g1, pair.sin0, pair.sin1];
                let truths = [&truth.p, &truth.r, &truth.g0, &truth.g1, &truth.outer[0], &truth.outer[1]];
                for (value, truth) in values.into_iter().zip(truths) {
                    worst = worst.max(units(value, truth));
                }
                if pair.rising {
                    worst = worst.max(units(pair.sin2_half, &truth.outer[2]));
                }
                worst = worst.max(units(pair.curve0, &truth.g1.over(&truth.outer[0]).expect("positive")));
                worst = worst.max(units(pair.curve1, &truth.g0.over(&truth.outer[1]).expect("positive")));
                compared += 1;
            }
        }
        assert!(compared > 100 && worst > 1.0 && worst <= PAIR_ERROR, "{compared} pairs, worst {worst} units");
    }

    #[test]
    fn precise_constants_are_the_nearest_doubles() {
        let mut worst: f64 = 0.0;
        for (phi0, phi1) in [(0.7, 1.4), (0.1, 1.5), (0.8, 0.9), (1e-9, 1.6), (0.7, 0.7000000001)] {
            let pair = Pair::precise(phi0, phi1).expect("an ordinary pair");
            let truth = Angles::new(phi0, phi1, 320).expect("enough bits");
            let curve0 = truth.g1.over(&truth.outer[0]).expect("positive");
            for (value, truth) in
                [(pair.p, &truth.p), (pair.g1, &truth.g1), (pair.curve0, &curve0), (pair.sin2_half, &truth.outer[2])]
            {
                worst = worst.max(units(value, truth));
            }
        }
        assert!(worst > 0.1 && worst <= 1.0, "worst {worst} units");
    }

    fn units(value: f64, truth: &Interval) -> f64 {
        truth.plus(-value).over(truth).expect("not zero").approx().abs() * 2f64.powi(53)
    }
}
