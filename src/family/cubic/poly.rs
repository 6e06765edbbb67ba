//! The spiral polynomial of Habib & Sakai's Theorem 3.1 in a form with few operations.
//!
//! With `S = sin(φ0+φ1)`, `p = sin φ0 cos φ1 / S`, `r = cos φ0 sin φ1 / S` (so `p + r = 1`), `g0 = (d1/2)²`,
//! `g1 = (d0/2)²`, dividing every `H_i` by the positive `2S` leaves
//!
//! ```text
//! H0 = y² B0(x, y; p, g0, r)     H5 = -x² B0(y, x; r, g1, p)
//! H1 = y  B1(x, y; p, g0, r)     H4 = -x  B1(y, x; r, g1, p)
//! H2 = 2y B2(x, y; p, g0, r)     H3 = -2x B2(y, x; r, g1, p)
//! ```
//!
//! with x = f0, y = f1. (`sin φ0 sin(φ0 + 2φ1) / S² = 2p - g0` turns H0 into B0.) Everything about a datum is then in
//! (p, g0) and the (a, k) of the two parabolas `3 - y = a x²`, `3 - x = k y²`.

use super::pair::Pair;
use crate::num::{Number, formula};

/// `[B0, B1, B2]` at (x, y) with `u = 3 - x`; for the other end pass (y, x; r, g1, p) and negate.
#[inline(always)]
pub(super) fn side<N: Number>(x: &N, y: &N, p: &N, g: &N, r: &N) -> [N; 3] {
    let u = formula!(3.0 - x);
    let u2 = u.mul(&u);
    let xu = x.mul(&u);
    // B0 = 2p u² + g (2xu + y(3x - 10))
    let b0 = formula!(2.0 * (p * u2) + g * (2.0 * xu + y * (3.0 * x - 10.0)));
    // B1 = 2p u (2u(3+x) + y(7x - 17)) + g (2xu(2x - 7y) + y²(22 - 9x)) + 4r u³
    let b1_p = formula!(2.0 * (u * (2.0 * (u * (x + 3.0)) + y * (7.0 * x - 17.0))));
    let b1_g = formula!(2.0 * xu * (2.0 * x - 7.0 * y) + y * y * (x * -9.0 + 22.0));
    let b1 = formula!(p * b1_p + g * b1_g + 4.0 * (r * (u2 * u)));
    // B2 = p (u(5x² + 3x - 6) + y(10x² - 32x + 12)) + g (x²(5x - 12) + y(12x - 10x² + y(5x - 2))) + r u²(5x - 2)
    let x5 = x.times(5.0);
    let x5_2 = x5.plus(-2.0);
    let b2_p = formula!(u * (x * (x5 + 3.0) - 6.0) + y * (x * (2.0 * x5 - 32.0) + 12.0));
    let b2_g = formula!(x * x * (x5 - 12.0) + y * (x * (x5 * -2.0 + 12.0) + y * x5_2));
    let b2 = formula!(p * b2_p + g * b2_g + r * (u2 * x5_2));
    [b0, b1, b2]
}

/// Bounds of what rounding and an uncertain root do to `[B0, B1, B2]`: `|error_i| <= rounding_i + slope_i δ`
/// where x and y are each within δ of the root and inside [0, 3].
///
/// # Derivation
/// `rounding_i` is Γ times the sum of the absolute values of all terms, at its largest over the box: 18|p| + 62g,
/// 420|p| + 563g + 108|r|, 628|p| + 774g + 30|r|. No term passes through more than 10 operations, and p, g, r carry a
/// relative error `coefficient` of their own, so `Γ = (coefficient + 12) unit` covers both and all second-order
/// terms. The bound counts terms, not the order of evaluation, so it holds with fused multiply-adds and with sums taken
/// in another order. `slope_i` is the sum of the largest |∂/∂x| and |∂/∂y| over the box, term by term:
/// 12|p| + 25g, (192 + 102)|p| + (207 + 132)g + 108|r|, (81 + 14)|p| + (81 + 54)g + 57|r|.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Error of evaluation.
    pub rounding: [f64; 3],
    /// Error per unit of uncertainty of the root.
    pub slope: [f64; 3],
}

impl Bounds {
    /// The bounds for one end; `gamma` is Γ above.
    pub(super) fn new(p: f64, g: f64, r: f64, gamma: f64) -> Bounds {
        let (p, r) = (p.abs(), r.abs());
        Bounds {
            rounding: [18.0 * p + 62.0 * g, 420.0 * p + 563.0 * g + 108.0 * r, 628.0 * p + 774.0 * g + 30.0 * r]
                .map(|b| b * gamma),
            slope: [12.0 * p + 25.0 * g, 294.0 * p + 339.0 * g + 108.0 * r, 95.0 * p + 135.0 * g + 57.0 * r],
        }
    }

    /// The two ends of a pair: (φ0 side, φ1 side).
    pub(super) fn of_pair(pair: &Pair, gamma: f64) -> (Bounds, Bounds) {
        (Bounds::new(pair.p, pair.g0, pair.r, gamma), Bounds::new(pair.r, pair.g1, pair.p, gamma))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(phi0: f64, phi1: f64) -> Pair {
        Pair::new(phi0, phi1).expect("an ordinary pair")
    }

    /// H_i at (1.3, 2.1), (0.7, 1.4), as published with the corrected formulas.
    #[test]
    fn agrees_with_published_values_of_h() {
        let (x, y, pair) = (1.3, 2.1, pair(0.7, 1.4));
        let scale = 2.0 * (0.7f64 + 1.4).sin();
        let a = side(&x, &y, &pair.p, &pair.g0, &pair.r);
        let b = side(&y, &x, &pair.r, &pair.g1, &pair.p);
        let h = [y * y * a[0], y * a[1], 2.0 * y * a[2], -2.0 * x * b[2], -x * b[1], -x * x * b[0]].map(|v| v * scale);
        let published = [-29.99579513, 42.85656703, 99.3175796, 72.19561479, 16.18816876, -0.21045624];
        for (h, published) in h.iter().zip(published) {
            assert!((h - published).abs() < 5.1e-9 * 100.0, "{h} is not {published}");
        }
    }

    /// The largest slopes over a fine grid of the box come close to the bound of each coefficient, and never above.
    #[test]
    fn slopes_and_sizes_stay_below_their_bounds_and_come_close() {
        let n = 120;
        let step = 3.0 / f64::from(n);
        for which in 0..3 {
            let unit = |i: usize| if i == which { 1.0 } else { 0.0 };
            let (p, g, r) = (unit(0), unit(1), unit(2));
            let bounds = Bounds::new(p, g, r, 1.0);
            let mut slope: [f64; 3] = [0.0; 3];
            for i in 0..n {
                for j in 0..n {
                    let (x, y) = (f64::from(i) * step, f64::from(j) * step);
                    let at = side(&x, &y, &p, &g, &r);
                    let east = side(&(x + step), &y, &p, &g, &r);
                    let north = side(&x, &(y + step), &p, &g, &r);
                    for b in 0..3 {
                        let slopes = ((east[b] - at[b]).abs() + (north[b] - at[b]).abs()) / step;
                        slope[b] = slope[b].max(slopes);
                        assert!(at[b].abs() <= bounds.rounding[b], "B{b} of coefficient {which} is {}", at[b]);
                    }
                }
            }
            for (slope, bound) in slope.into_iter().zip(bounds.slope) {
                assert!(slope <= bound * 1.000_001, "coefficient {which}: slope {slope} over {bound}");
                assert!(slope >= bound * 0.5, "coefficient {which}: bound {bound} is far from {slope}");
            }
        }
    }
}
