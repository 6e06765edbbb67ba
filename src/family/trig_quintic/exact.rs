//! The top of the ladder: the truth of one datum in intervals of growing precision.

use super::plain::{end_slope, flags};
use super::poly::{BERNSTEIN, Frame, K, hodograph, numerator};
use super::{END_RISES, SPIRAL};
use crate::num::bernstein::positive;
use crate::num::{Interval, Number};
use std::cmp::Ordering::Equal;

/// The shape of a curve, taken as exact.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Shape {
    /// `s / tan(θ/2)`, positive.
    pub ratio: f64,
    /// Angle between the end tangents, radians, in (0, π/2).
    pub theta: f64,
    /// `u0/u1` of Misro, Ramli and Ali, (9), positive.
    pub m: f64,
    /// Shape parameter of the start, in (-4, 1].
    pub p: f64,
    /// Shape parameter of the end, in (-4, 1].
    pub q: f64,
}

impl From<[f64; 5]> for Shape {
    fn from([ratio, theta, m, p, q]: [f64; 5]) -> Shape {
        Shape { ratio, theta, m, p, q }
    }
}

/// Halvings of intervals: 38 coefficients a level must fit a thread's stack, and nothing but a tie goes so deep.
pub(super) const HALVINGS: u32 = 120;

/// One attempt at all flags; `None` when something is undecided at this precision.
///
/// A numerator that only touches 0 inside would stay undecided. But then its discriminant is 0, a polynomial in cos θ
/// with rational coefficients; cos θ of a double θ is transcendental (Lindemann), so that it would have to vanish for
/// all θ. At the end κ'(1) = 0 does happen, and is divided out.
pub(super) fn judge(shape: &Shape, bits: usize) -> Option<u8> {
    let Shape { ratio, theta, m, p, q } = *shape;
    let plain = flags(ratio, m, q);
    if plain & END_RISES == 0 {
        return Some(plain);
    }
    let frame = Frame::exact(ratio, theta, bits)?;
    let number = |x| Interval::new(x, bits);
    let hodograph = hodograph(&frame, &number(m), &number(p), &number(q));
    let mut c = numerator(&hodograph, &frame.square, -1.0);
    if end_slope(ratio, q) == Equal {
        c = without_last(c);
    }
    let spiral = positive(&bernstein(c), 0.0, 0.0, HALVINGS).decided()?;
    Some(plain | if spiral { SPIRAL } else { 0 })
}

/// From a form's coefficients those of the same form in Bernstein's basis, up to a common factor.
pub(super) fn bernstein<N: Number>(c: [N; K]) -> [N; K] {
    let mut factors = BERNSTEIN.into_iter();
    c.map(|c| c.times(factors.next().unwrap_or(1.0)))
}

/// The form divided by `1 - τ`, its last coefficient being 0, times `(1 - τ) + τ`.
pub(super) fn without_last(c: [Interval; K]) -> [Interval; K] {
    let zero = c[0].scale(0.0);
    std::array::from_fn(|i| {
        let this = if i + 1 < K { &c[i] } else { &zero };
        let before = if i > 0 { &c[i - 1] } else { &zero };
        this + before
    })
}
