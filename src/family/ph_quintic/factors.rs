//! Factors of the error bounds, for the f64 step on vectors ([`super::lanes`]), for balls, and for the f32 shader.
//!
//! Heights, slopes and t are positive, so their errors are relative: a number x of error e is within `x (1 ± e)`. In
//! logarithms that is `-ln(1 - e)` at most, which is below 1.0080 e for `e < FAR`.

/// Residuals and errors from here on say nothing.
pub(super) const FAR: f64 = 1.0 / 64.0;

/// Of a left-hand side's residual: how far its height may be off.
///
/// `d ln F / d ln Z >= 1`. So a true residual R puts Z within the factor `1 + R` or its inverse, that is within
/// `|R| / (1 - |R|)`, at most 1.0159 |R| for `|R| < FAR`. A residual r that was computed from sums off by c and a
/// right-hand side off by b has `|R - r| <= (1 + |r|) (b + c)` but for squares, at most 1.0157 (b + c). Both products
/// are below 1.04, and the rest is for squares and for the roundings of the bound itself.
pub(super) const HEIGHT: f64 = 1.05;

/// Of the errors of both heights: how far the gap may be off. It changes by no more than the logarithm of the heights'
/// ratio, so by 2 · 1.0080 of the larger error.
pub(super) const GAP: f64 = 2.1;

/// Of a height's error: how far a slope may be off, relative. Its numerator and its denominator are sums of positive
/// terms of Z⁰ to Z², each within `(1 ± e)²`. Their quotient is within `(1 + e)² / (1 - e)²`, so off by at most 4.14 e
/// for `e < 1.06 FAR`.
pub(super) const SLOPE: f64 = 4.3;

/// Of an error: room for the roundings of what is computed with it. The errors of heights and slopes are twenty
/// roundings at least, so a tenth more is two of the number itself.
pub(super) const ROOM: f64 = 1.1;

/// How near a solution on a lane must be known, t and Z: within the thirteen powers that a coefficient of κ' has, that
/// is `x = 13 CLOSE < 0.0032`, [`POWERS`] is enough.
pub(super) const CLOSE: f64 = 1.0 / (1u32 << 12) as f64;

/// Of `x = 10 e(t) + 3 e(Z)`: how far a coefficient of κ' may be off. No product of a turn and a speed has more than
/// ten factors t or three factors Z, and `(1 + e(t))^10 (1 + e(Z))^3 - 1 <= e^x - 1 <= 1.0017 x`. The rest is for the
/// product with the coefficient's own error and for the roundings of the bound.
pub(super) const POWERS: f64 = 1.01;

/// f32: of a height's error, how far a slope may be off, absolute.
///
/// With the weights `w k / Σ w k` the slope is the mean of `j/k`, and its derivative by ln Z is the covariance of
/// `j/k`, from 0 to 2, and k, from 1 to 3. So it is at most 1, and the slope moves by at most 1.0080 e.
pub(super) const SINGLE_SLOPE: f64 = 1.1;

/// f32: of the error of t, below a fiftieth, how far it moves Z along a curve, whose slope is at most 2.
///
/// `e^(-2 ln(1 - e)) - 1 <= 2.07 e` for `e < 0.0203`. With a height's own error h that is `2.07 e + 1.042 h`: for the
/// second [`HEIGHT`] will do.
pub(super) const ALONG: f64 = 2.1;

/// f32: the same as [`POWERS`] where the whole error, which is larger, is below a quarter. Then `x < 0.18` and
/// `e^x - 1 <= 1.1 x`. The rest is more than the product with the coefficient's own error.
pub(super) const SINGLE_POWERS: f64 = 1.4;

/// f32: the gap's roundings. Difference, sum and quotient of 2.5 units in the last place are seven units at most, of a
/// number up to 2; then one more for taking the error away from it.
pub(super) const SINGLE_GAP: f64 = 16.0 / (1u32 << 24) as f64;

/// f32: of `(b - a)/(√a √b)` as computed, so that it is no less. The difference is rounded once, square roots are good
/// to nine units each, the quotient to five: under thirty units of 2^-24.
pub(super) const LENGTH: f64 = 1.001;

/// f32: a quarter of the length times the fall of a slope, rounded up by more than four roundings.
pub(super) const TENT: f64 = 0.2501;

#[cfg(test)]
mod tests {
    use super::*;

    /// Each factor is enough at the largest error it is used for, where it is needed most, and not by far too large.
    #[test]
    fn factors_cover_what_they_are_for_and_not_much_more() {
        let enough = |factor: f64, needed: f64| assert!(factor >= needed && factor < 1.3 * needed, "{factor} {needed}");
        let far = 1.06 * FAR;
        enough(HEIGHT, 1.0 / (1.0 - far) * (1.0 + FAR));
        enough(GAP, -2.0 * (1.0 - far).ln() / far);
        enough(SLOPE, (((1.0 + far) / (1.0 - far)).powi(2) - 1.0) / far);
        let grown = |t: f64, z: f64| ((1.0 + t).powi(10) * (1.0 + z).powi(3) - 1.0) / (10.0 * t + 3.0 * z);
        enough(POWERS, grown(CLOSE, CLOSE));
        enough(SINGLE_SLOPE, -(1.0 - far).ln() / far);
        enough(ALONG, ((1.0f64 - 0.0203).powi(-2) - 1.0) / 0.0203);
        let most = 0.25 / SINGLE_POWERS;
        assert!(grown(most / 10.0, 0.0).max(grown(0.0, most / 3.0)) < SINGLE_POWERS - 0.25);
    }
}
