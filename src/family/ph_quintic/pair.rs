//! What depends on the two tangent angles alone.

use crate::family::last::{Last, kept};
use crate::family::outer::Sines;
use crate::num::sines::{SIN_ERROR, sin, sin_of_sum};
use crate::num::{Ball, Interval, Number, Real, Twin, formula};
use std::cell::RefCell;
use std::f64::consts::PI;
use std::rc::Rc;

/// The constants of a pair of tangent angles; `Φ = (φ0 + φ1)/2`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<N> {
    /// sin Φ.
    pub sin: N,
    /// cos Φ, positive.
    pub cos: N,
    /// The right-hand sides of the two equations: `30 sin φ0 / sin Φ`, `30 sin φ1 / sin Φ`.
    pub right: [N; 2],
    /// `30 sin((φ1 - φ0)/2) / sin Φ`: the right-hand sides differ by `-2 cos Φ` times this.
    pub skew: N,
    /// For the outer bound.
    pub outer: Sines<N>,
    /// φ0 < φ1: without it no spiral of increasing curvature exists.
    pub rising: bool,
}

fn right<N: Real>(sin0: &N, sin1: &N, sin: &N) -> Option<[N; 2]> {
    Some([sin0.times(30.0).over(sin)?, sin1.times(30.0).over(sin)?])
}

impl Pair<Ball> {
    /// The pair in doubles; `None` where the sum rounds to π.
    pub(super) fn new(phi0: f64, phi1: f64) -> Option<Pair<Ball>> {
        if phi0 + phi1 >= PI {
            return None;
        }
        let near = |value| Ball::near(value, SIN_ERROR);
        let (sin0, sin1) = (near(sin(phi0)), near(sin(phi1)));
        // Halving is exact but for subnormal numbers, which cost at most what `near` adds.
        let half = near(sin_of_sum(0.5 * phi0, 0.5 * phi1));
        let rising = phi0 < phi1;
        // The difference of two doubles is off by at most one rounding, relative.
        let apart = Ball::near(sin(0.5 * (phi1 - phi0).abs()), SIN_ERROR + 2.0);
        let sin_half = if rising { apart } else { Ball::of(0.0, 53) };
        Some(Pair {
            cos: near(sin_of_sum(phi0, phi1)).times(0.5).over(&half)?,
            right: right(&sin0, &sin1, &half)?,
            skew: apart.times(if rising { 30.0 } else { -30.0 }).over(&half)?,
            sin: half,
            outer: [sin0, sin1, sin_half.mul(&sin_half)],
            rising,
        })
    }
}

impl Pair<Interval> {
    /// [`Pair::exact`], kept for the next call.
    pub(super) fn cached(phi0: f64, phi1: f64, bits: usize) -> Option<Rc<Pair<Interval>>> {
        thread_local!(static LAST: Last<([u64; 2], usize), Pair<Interval>> = const { RefCell::new(None) });
        kept(&LAST, ([phi0, phi1].map(f64::to_bits), bits), || Pair::exact(phi0, phi1, bits))
    }

    /// The pair in intervals; `None` when the precision does not prove that cos Φ is positive.
    pub(super) fn exact(phi0: f64, phi1: f64, bits: usize) -> Option<Pair<Interval>> {
        let half = |phi: f64| Interval::new(phi, bits).scale(0.5).sine_cosine();
        Pair::of_halves([half(phi0), half(phi1)], phi0 < phi1)
    }
}

impl Pair<Twin> {
    /// The pair in two doubles each; `None` when they leave open that cos Φ is positive, or where halving an angle may
    /// not be exact.
    pub(super) fn twins(phi0: f64, phi1: f64) -> Option<Pair<Twin>> {
        let half = |phi: f64| (phi > 1e-300).then(|| Twin::sin_cos(0.5 * phi));
        Pair::of_halves([half(phi0)?, half(phi1)?], phi0 < phi1)
    }
}

impl<N: Real> Pair<N> {
    /// From sine and cosine of half of each angle.
    fn of_halves([(s0, c0), (s1, c1)]: [(N, N); 2], rising: bool) -> Option<Pair<N>> {
        let (sin, cos) = (formula!(s0 * c1 + c0 * s1), formula!(c0 * c1 - s0 * s1));
        let (sin0, sin1) = (formula!(2.0 * (s0 * c0)), formula!(2.0 * (s1 * c1)));
        let difference = formula!(s1 * c0 - c1 * s0);
        (sin.is_positive() && cos.is_positive()).then_some(())?;
        Some(Pair {
            cos,
            right: right(&sin0, &sin1, &sin)?,
            skew: difference.times(30.0).over(&sin)?,
            sin,
            outer: [sin0, sin1, difference.mul(&difference)],
            rising,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_hold_the_constants() {
        let mut worst: f64 = 0.0;
        let angles =
            [1e-300, 1e-12, 1e-3, 0.1, 0.7, 0.7000000001, 0.9, 1.5, std::f64::consts::FRAC_PI_2, 1.6, 2.2, 3.0, 3.1];
        let mut compared = 0;
        for phi0 in angles {
            for phi1 in angles {
                let Some(pair) = Pair::<Ball>::new(phi0, phi1) else { continue };
                let truth = Pair::exact(phi0, phi1, 1200).expect("enough bits");
                let [s0, s1, square] = &pair.outer;
                let [t0, t1, t2] = &truth.outer;
                let mut all = vec![(pair.sin, &truth.sin), (pair.cos, &truth.cos), (*s0, t0), (*s1, t1)];
                all.extend([
                    (pair.right[0], &truth.right[0]),
                    (pair.right[1], &truth.right[1]),
                    (pair.skew, &truth.skew),
                ]);
                if pair.rising {
                    all.push((*square, t2));
                }
                for (ball, truth) in all {
                    let off = truth.plus(-ball.value).approx().abs();
                    assert!(off <= ball.error, "{phi0} {phi1}: {ball:?} is off by {off}");
                    worst = worst.max(off / ball.error);
                    compared += 1;
                }
            }
        }
        assert!(compared > 500 && worst > 0.1, "{compared} {worst}");
    }
}
