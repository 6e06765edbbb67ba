//! Numbers in sentences: few digits, and a bound rounded so that whoever types it in keeps on the safe side.

use crate::error::written;

/// Digits that a bound is written with.
const DIGITS: i32 = 6;

/// Six digits, or fewer where they say the same.
pub(super) fn short(x: f64) -> String {
    written(rounded(x))
}

/// Six digits of a number above `x`.
pub(super) fn above(x: f64) -> String {
    short(beyond(x, 1.0))
}

/// Six digits of a number below `x`.
pub(super) fn below(x: f64) -> String {
    short(beyond(x, -1.0))
}

/// An angle given in radians, in degrees.
pub(super) fn degrees(angle: f64) -> String {
    short(angle.to_degrees()) + "°"
}

/// The nearest number of six digits.
pub(super) fn rounded(x: f64) -> f64 {
    format!("{x:.*e}", DIGITS as usize - 1).parse().unwrap_or(x)
}

/// `x` itself where it has six digits, or the next number of six digits on the side of `sign`.
fn beyond(x: f64, sign: f64) -> f64 {
    let near = rounded(x);
    if sign * (near - x) >= 0.0 {
        return near;
    }
    // The unit of the last digit: 10 to the power of that digit. Within a few ulp; rounding again makes it exact.
    let unit = 10f64.powi(x.abs().log10().floor() as i32 + 1 - DIGITS);
    rounded(near + sign * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_written_on_their_safe_side() {
        assert_eq!([0.0102, 33.5, 2.0, 1e-310, 1.5e300].map(short), ["0.0102", "33.5", "2", "1e-310", "1.5e300"]);
        assert_eq!([0.014666189071791766, -0.014666189071791766].map(above), ["0.0146662", "-0.0146661"]);
        assert_eq!([0.014666189071791766, -0.014666189071791766].map(below), ["0.0146661", "-0.0146662"]);
        assert_eq!([0.25, 9.99999e5, 0.0].map(above), ["0.25", "999999", "0"]);
        assert_eq!([9.999999, 1.0000001e-300].map(above), ["10", "1.00001e-300"]);
        assert_eq!([1.0000001, 1.0000001e300].map(below), ["1", "1e300"]);
        assert_eq!(degrees(std::f64::consts::FRAC_PI_3), "60°");
    }
}
