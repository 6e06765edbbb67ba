//! The greatest |curvature| from one peak and its neighbourhood: what [`Hodograph::below`] alone proves only after many
//! halvings, because the curvature is level at a peak.
//!
//! With `|κ| = ±h/σ²` its slope is `N/σ³`, `N = ±(σh' - 2hσ')`, of degree 5. Around the peak, at t, a piece is taken
//! on which h keeps its sign and N falls, as its Bernstein coefficients do. On one side of t the slope then points
//! towards t throughout, and |κ| is at most |κ(t)|. On the other it is at most `|N(t)| / σ³`, so that |κ| exceeds
//! |κ(t)| by no more than that times the length of the piece. At an end of the curve it is enough that N does not
//! point inwards. All else must stay below |κ(t)|, by [`Hodograph::below`]: it is lower there by about the square of
//! the piece's length.
//!
//! Only the value at t and N(t) take the precision of the datum; certificates are in doubles.

use super::hodograph::{Bound, Hodograph};
use crate::num::{Ball, Certain, Number, Real, formula};
use std::cmp::Ordering::{Equal, Greater, Less};

/// How far the piece reaches from the peak, in order of trial.
const REACHES: [f64; 5] = [0.125, 0.03125, 0.00390625, 1.220703125e-4, 1e-6];

/// Covers the roundings of the few operations on bounds below, and of the place where a curve is split.
const GROW: f64 = 1.0 + 1e-9;

impl<N: Real> Hodograph<N> {
    /// The greatest |κ|, if it is proved to be taken at t, near it, or not to exceed the value at t by more than the
    /// share `margin`.
    pub(super) fn only_peak(&self, t: &N, margin: &N) -> Option<N> {
        let value = self.curvature(t)?;
        let (rough, most, at) = (self.rough(), Ball::enclosing(&value), t.approx());
        for reach in REACHES {
            let [first, last] = [(at - reach).max(0.0), (at + reach).min(1.0)];
            let (mut piece, mut others) = (rough.clone(), [None, None]);
            if last < 1.0 {
                let [before, after] = piece.split(last);
                (piece, others[0]) = (before, Some(after));
            }
            if first > 0.0 {
                let [before, after] = piece.split(first / last);
                (piece, others[1]) = (after, Some(before));
            }
            let Some(slopes) = piece.slopes_of_size() else { continue };
            let certain = |x: &Ball, side| x.certain_sign(0.0) == Some(side);
            let over = if at <= 0.0 && slopes.iter().all(|x| certain(x, Less))
                || at >= 1.0 && slopes.iter().all(|x| certain(x, Greater))
            {
                0.0
            } else if slopes.windows(2).all(|x| certain(&x[1].sub(&x[0]), Less))
                && let Some(slowest) = piece.slowest()
            {
                self.slope(t).most() * slowest.powi(-3) * reach * GROW + f64::MIN_POSITIVE
            } else {
                continue;
            };
            // A shorter piece may be faster, and leaves less room in any case.
            if over > value.mul(margin).approx() {
                continue;
            }
            let lower = others.iter().flatten().all(|arc| matches!(arc.below(&most, 0), Bound::Below));
            return lower.then(|| value.union(&value.add(&N::of(over, value.bits()))));
        }
        None
    }
}

impl Hodograph<Ball> {
    /// Both parts at t, inside.
    fn split(&self, t: f64) -> [Hodograph<Ball>; 2] {
        let mixed = |a: &Ball, b: &Ball| formula!(a + (b - a) * { t });
        let both = |[a, b, c]: [Ball; 3]| {
            let (left, right) = (mixed(&a, &b), mixed(&b, &c));
            let middle = mixed(&left, &right);
            [[a, left, middle], [middle, right, c]]
        };
        let ([x, y], turn) = ([0, 1].map(|k| both([0, 1, 2].map(|i| self.w[i][k]))), both(self.turn));
        [0, 1].map(|half| Hodograph { w: [0, 1, 2].map(|i| [x[half][i], y[half][i]]), turn: turn[half] })
    }

    /// N as Bernstein coefficients times 10; `None` where h may change its sign.
    fn slopes_of_size(&self) -> Option<[Ball; 6]> {
        let side = self.turn[0].certain_sign(0.0)?;
        let sign = if side == Less { -1.0 } else { 1.0 };
        let keeps = side != Equal && self.turn.iter().all(|h| h.certain_sign(0.0) == Some(side));
        keeps.then(|| self.slopes().map(|x| x.times(sign)))
    }

    /// Less than σ everywhere.
    fn slowest(&self) -> Option<f64> {
        let binomial = [1.0, 4.0, 6.0, 4.0, 1.0];
        let least =
            self.speed().iter().zip(binomial).map(|(s, by)| (s.value - s.error) / by).fold(f64::INFINITY, f64::min);
        (least > 0.0).then_some(least / GROW)
    }
}
