//! Both curves of [`super::curves`] at one parameter.

use crate::num::Real;

/// Both curves at one t.
#[derive(Debug, Clone, Copy)]
pub(super) struct Knot<N> {
    /// t, exactly.
    pub t: N,
    /// Heights Z of the two curves.
    pub z: [N; 2],
    /// Slopes s.
    pub s: [N; 2],
    /// Of the sign of D, and no larger: `2 (Z0 - Z1)/(Z0 + Z1)`.
    pub gap: N,
}

/// No less than `ln(b/a)`: `(r - 1)/√r` for their ratio r, with a little for rounding.
pub(super) fn length<N: Real>(a: &N, b: &N) -> f64 {
    b.sub(a).approx() / (a.approx().sqrt() * b.approx().sqrt()) * 1.0001
}
