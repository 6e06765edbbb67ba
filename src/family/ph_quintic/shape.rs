//! The curve of a solution: its speed, how it turns, and whether its curvature is monotone.
//!
//! In the oblique basis `e^{-iφ0/2}`, `e^{iφ1/2}` the pre-image is `w0 = (A, 0)`, `w1 = (βB³, αA³)`, `w2 = (0, B)`. So
//! `σ = |w|²` and `κ = h/σ²` have Bernstein coefficients that are sums of products without a minus (`cos Φ > 0`), and
//! `h = 2 sin Φ η`, `η = (2αA⁴, AB, 2βB⁴)`. Then `κ' = (h'σ - 2hσ')/σ³`, of degree 5 over degree 12.

use super::curves::Curves;
use super::march::Root;
use crate::num::bernstein::Quintic;
use crate::num::{Number, Real, formula};

/// σ and η of a curve, both divided by Z.
#[derive(Debug, Clone)]
pub(super) struct CurveShape<N> {
    pub speed: [N; 5],
    pub turn: [N; 3],
}

impl<N: Real> CurveShape<N> {
    /// The curve; `None` only when a number leaves the range of its arithmetic.
    pub(super) fn new(curves: &Curves<N>, root: &Root<N>) -> Option<CurveShape<N>> {
        let one = N::of(1.0, root.t.bits());
        let third = one.over(&N::of(3.0, root.t.bits()))?;
        Some(CurveShape::of(curves, &root.t, &root.z, [&one, &third]))
    }
}

impl<N: Number> CurveShape<N> {
    /// The curve of a solution; the last are 1 and 1/3.
    #[inline(always)]
    pub(super) fn of(curves: &Curves<N>, t: &N, z: &N, [one, third]: [&N; 2]) -> CurveShape<N> {
        let ([p, q], [alpha, beta], cos) = (curves.scale, &curves.bend, &curves.cos);
        let t2 = formula!(t * t);
        let t3 = formula!(t2 * t);
        // Coordinates of w1, divided by a³.
        let (u, v) = (formula!(beta * t3), alpha);
        let cross = formula!(cos * t * { p * q });
        let square = formula!(u * (u + 2.0 * (cos * v)) + v * v);
        CurveShape {
            speed: [
                one.times(p * p),
                formula!(z * (u + cos * v) * { p }),
                formula!((2.0 * (square * (z * z)) + cross) * third),
                formula!(z * t * (v + cos * u) * { q }),
                t2.times(q * q),
            ],
            turn: [formula!(v * z * { 2.0 * p }), t.times(p * q), formula!(u * t * z * { 2.0 * q })],
        }
    }

    /// Bernstein coefficients of κ' up to a positive function, times 10.
    pub(super) fn quintic(&self) -> Quintic<N> {
        self.sums().map(|[gain, loss]| formula!(gain - loss))
    }

    /// The same as what adds to each and what is taken away: sums of positive terms.
    #[inline(always)]
    pub(super) fn sums(&self) -> [[N; 2]; 6] {
        let [h0, h1, h2] = &self.turn;
        let [s0, s1, s2, s3, s4] = &self.speed;
        let [b0, b1, b2] = half([h0, h1, h2], [s0, s1, s2, s3]);
        // Reversing the curve changes the sign.
        let [[l5, g5], [l4, g4], [l3, g3]] = half([h2, h1, h0], [s4, s3, s2, s1]);
        [b0, b1, b2, [g3, l3], [g4, l4], [g5, l5]]
    }
}

/// The first three coefficients of `h'σ - 2hσ'`, halved and times 10, 2, 1, as their positive and negative terms.
#[inline(always)]
fn half<N: Number>([h0, h1, h2]: [&N; 3], [s0, s1, s2, s3]: [&N; 4]) -> [[N; 2]; 3] {
    [
        [formula!(10.0 * (h1 * s0) + 30.0 * (h0 * s0)), formula!(40.0 * (h0 * s1))],
        [formula!(16.0 * (h0 * s1) + 14.0 * (h1 * s0) + 2.0 * (h2 * s0)), formula!(24.0 * (h0 * s2) + 8.0 * (h1 * s1))],
        [formula!(6.0 * (h0 * s2) + 20.0 * (h1 * s1) + 4.0 * (h2 * s0)), formula!(12.0 * (h0 * s3) + 18.0 * (h1 * s2))],
    ]
}
