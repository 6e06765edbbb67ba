//! The outer bound of every spiral region.

/// Outer bound of every spiral region: the least end curvature any spiral can have.
///
/// # Arguments
/// - `phi0`, `phi1`: tangent angles against the chord, radians, `0 < phi0 < phi1`, `phi0 + phi1 < π`.
/// - `kappa0`: start curvature times half the chord, no unit; must be below `sin(phi0)`.
///
/// # Returns
/// `None` when `kappa0 >= sin(phi0)`: then no spiral starts so sharply.
///
/// # Accuracy
/// A few ulp, except close to `kappa0 = sin(phi0)`: there the subtraction cancels, and the relative
/// error grows like `2^-52 * sin(phi0) / (sin(phi0) - kappa0)`. Verdicts use the interval form instead.
///
/// # Source
/// Kurnosenko (2026), eq. (2), in the frame of Habib & Sakai, section 3. Nothing changes beyond `phi1 = π/2`: `Q < 0`
/// with `kappa0 >= sin(phi0)` needs `(kappa0 - sin phi0)(sin phi1 - kappa1) > sin²δ`, `δ = (phi1 - phi0)/2`, and with
/// `kappa1 > kappa0` the left side is below `((sin phi1 - sin phi0)/2)² < sin²δ`.
pub fn least_end_curvature(phi0: f64, phi1: f64, kappa0: f64) -> Option<f64> {
    let room = phi0.sin() - kappa0;
    (room > 0.0).then(|| phi1.sin() + (0.5 * (phi1 - phi0)).sin().powi(2) / room)
}
