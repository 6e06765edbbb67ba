//! Signs and least values of quintics in Bernstein form on [0, 1], with proof.

use super::{Interval, Number};
use std::cmp::Ordering;

/// Bernstein coefficients of a quintic.
pub type Quintic<N> = [N; 6];

/// A number whose comparison with zero can be certain or not.
pub trait Certain: Number {
    /// The sign if it is certain, given that the value may be off by `error` in either direction.
    fn certain_sign(&self, error: f64) -> Option<Ordering>;
}

impl Certain for f64 {
    #[inline(always)]
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        if *self > error {
            Some(Ordering::Greater)
        } else if *self < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }
}

impl Certain for Interval {
    /// Intervals carry their own error; `error` must be 0.
    fn certain_sign(&self, _error: f64) -> Option<Ordering> {
        self.sign()
    }
}

/// Splits at `t`: the coefficients on `[0, t]` and on `[t, 1]` (de Casteljau).
///
/// At `t = 1/2` each step adds two numbers of at most the largest coefficient's size and halves exactly, so five steps
/// are off by at most 5 units of 2^-53 of the largest coefficient, and pass on errors of the input undiminished but not grown.
#[inline]
pub fn halve<N: Number>(c: &Quintic<N>) -> (Quintic<N>, Quintic<N>) {
    let (mut left, mut right) = (c.clone(), c.clone());
    for step in 1..6 {
        left[step - 1] = right[0].clone();
        for i in 0..6 - step {
            right[i] = right[i].add(&right[i + 1]).times(0.5);
        }
    }
    left[5] = right[0].clone();
    (left, right)
}

/// Whether the quintic is positive on [0, 1] (`Some(true)`), negative somewhere (`Some(false)`), or not decided.
///
/// # Arguments
/// - `error`: how far each coefficient may be from the truth (0 for intervals).
/// - `rounding`: error added by each halving: 5 units of 2^-53 of the largest coefficient for doubles, 0 for intervals.
/// - `depth`: most halvings of a piece before giving up.
///
/// Coefficients bound the quintic from below on their piece (convex hull); the outer two are its values there.
/// A zero is never decided: the truth at a tie needs more than this test.
pub fn positive<N: Certain>(c: &Quintic<N>, error: f64, rounding: f64, depth: u32) -> Option<bool> {
    if [&c[0], &c[5]].iter().any(|v| v.certain_sign(error) == Some(Ordering::Less)) {
        return Some(false);
    }
    if c.iter().all(|v| v.certain_sign(error) == Some(Ordering::Greater)) {
        return Some(true);
    }
    if depth == 0 {
        return None;
    }
    let (left, right) = halve(c);
    let error = error + rounding;
    match positive(&left, error, rounding, depth - 1) {
        Some(false) => Some(false),
        Some(true) => positive(&right, error, rounding, depth - 1),
        // One half may still prove it negative.
        None => match positive(&right, error, rounding, depth - 1) {
            Some(false) => Some(false),
            _ => None,
        },
    }
}
