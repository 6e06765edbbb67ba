//! The flags that comparisons of rational numbers decide, exactly.

use super::{END_CURVATURE_AS_PRINTED, END_RISES, PRINTED_RATIO};
use crate::num::{Interval, formula};
use std::cmp::Ordering::{self, Equal, Less};

/// Enough for any three doubles to be added exactly.
const BITS: usize = 2300;

/// How `factor x` compares with `constant + other y`, exactly: for small whole factors.
fn compare(factor: f64, x: f64, constant: f64, other: f64, y: f64) -> Ordering {
    let (left, right) = (factor * x, constant + other * y);
    // Three roundings at most, none of a term larger than these.
    let error = (left.abs() + constant.abs() + (other * y).abs()) * (2.0 * f64::EPSILON);
    if (left - right).abs() > error {
        return left.total_cmp(&right);
    }
    let exact = |x: f64| Interval::new(x, BITS);
    let right = formula!(exact(y) * { other } + { constant });
    // Thin intervals of enough bits have a sign.
    exact(x).scale(factor).compare(&right).unwrap_or(Equal)
}

/// How κ'(1) compares with 0: as 9 ratio with 20 (1 + q).
pub(super) fn end_slope(ratio: f64, q: f64) -> Ordering {
    compare(9.0, ratio, 20.0, 20.0, q)
}

/// Whether the printed condition holds, `s >= ((6 + m)/2) tan(θ/2)`.
pub(super) fn printed_ratio(ratio: f64, m: f64) -> bool {
    compare(2.0, ratio, 6.0, 1.0, m) != Less
}

/// The least and the greatest q with `|15/(4 + q)² - 1| <= 1/100`: between `√(1500/101) - 4` and `√(1500/99) - 4`,
/// rounded inwards. Both roots are irrational, so no double lies on a boundary.
pub(super) const PRINTED_Q: [f64; 2] = [-0.146_237_533_459_690_32, -0.107_505_279_192_385_16];

/// All of them but SPIRAL.
pub(super) fn flags(ratio: f64, m: f64, q: f64) -> u8 {
    let set = |holds: bool, flag: u8| if holds { flag } else { 0 };
    set(end_slope(ratio, q) != Less, END_RISES)
        | set(printed_ratio(ratio, m), PRINTED_RATIO)
        | set((PRINTED_Q[0]..=PRINTED_Q[1]).contains(&q), END_CURVATURE_AS_PRINTED)
}
