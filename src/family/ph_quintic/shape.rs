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
        let (Root { t, z }, [p, q], [alpha, beta]) = (root, curves.scale, &curves.bend);
        let t2 = t.mul(t);
        let t3 = t2.mul(t);
        // Coordinates of w1, divided by a³.
        let (u, v) = (beta.mul(&t3), alpha);
        let skew = |x: &N, y: &N| formula!(x + curves.cos * y);
        let cross = formula!(curves.cos * t * { p * q });
        let square = formula!(u * skew(&u, &v.times(2.0)) + v * v);
        Some(CurveShape {
            speed: [
                N::of(p * p, t.bits()),
                formula!(z * skew(&u, v) * { p }),
                formula!(2.0 * (square * (z * z)) + cross).over(&N::of(3.0, t.bits()))?,
                formula!(z * t * skew(v, &u) * { q }),
                t2.times(q * q),
            ],
            turn: [formula!(v * z * { 2.0 * p }), t.times(p * q), formula!(u * t * z * { 2.0 * q })],
        })
    }

    /// Bernstein coefficients of κ' up to a positive function, times 10.
    pub(super) fn quintic(&self) -> Quintic<N> {
        let start = half(&self.turn, &self.speed);
        // Reversing the curve changes the sign.
        let turn = std::array::from_fn(|i| self.turn[2 - i].clone());
        let end = half(&turn, &std::array::from_fn(|i| self.speed[4 - i].clone())).map(|c| c.times(-1.0));
        let ([b0, b1, b2], [b5, b4, b3]) = (start, end);
        [b0, b1, b2, b3, b4, b5]
    }
}

/// The first three coefficients of `h'σ - 2hσ'`, halved and times 10, 2, 1.
fn half<N: Number>([h0, h1, h2]: &[N; 3], speed: &[N; 5]) -> [N; 3] {
    let sum = |positive: [N; 3], negative: [N; 2]| {
        let [a, b, c] = positive;
        let [d, e] = negative;
        formula!(a + b + c - (d + e))
    };
    let none = h0.times(0.0);
    let by = |h: &N, i: usize, k: f64| formula!(h * speed[i] * { k });
    [
        sum([by(h1, 0, 10.0), by(h0, 0, 30.0), none.clone()], [by(h0, 1, 40.0), none]),
        sum([by(h0, 1, 16.0), by(h1, 0, 14.0), by(h2, 0, 2.0)], [by(h0, 2, 24.0), by(h1, 1, 8.0)]),
        sum([by(h0, 2, 6.0), by(h1, 1, 20.0), by(h2, 0, 4.0)], [by(h0, 3, 12.0), by(h1, 2, 18.0)]),
    ]
}
