//! The two spiral quintics and the map from a segment's shape to its end point, in a form without the angle's size.
//!
//! A segment of Habib & Sakai (CGIV'04) has the shape (m, q). With `q = L x`, `L = sin θ` (cubic) or `tan(θ/2)` (PH
//! quintic), and `u = 1/x`, the numerator of κ'(t), `t = 1/(1+s)`, is `Σ c_i s^i` (case 1) or `-Σ c_i s^(5-i)` (case 2)
//! with, up to the positive factor `L² x²` and with `g = cos θ` (cubic) or `cos²(θ/2)` (PH),
//!
//! ```text
//! cubic  c0 = 4u(3g - (4+m)u)        c1 = 2(6 - 2(5-4m)gu - 10mu²)       c2 = 2(13m - 2 - 4m(4-m)gu)
//!        c3 = 2m(10m - 3 - 4mgu)     c4 = 5m³                            c5 = m³
//! PH     c0 = 16gu(2 - (6+m)u)       c1 = 16(1 - (4-3m)gu - 7mgu²)       c2 = 4(9m - 2 - 6m(4-m)gu)
//!        c3 = 4m(7m - 3 - 6mgu)      c4 = m²(7m - 2)                     c5 = m³
//! ```
//!
//! Nothing but (m, u, g) is left of the angle, so a small θ is no special case.
//!
//! # End points
//! With `h = ξ sin θ - η cos θ`, case 1 has `(a, b) = (η, h)` and case 2, its mirror, `(a, b) = (h, η)`. The end point
//! is then
//!
//! ```text
//! cubic  α = 3a/L²     αu  = 1                 β = 6b/L²     βu² = 1 + m
//! PH     α = 60a/L²    αu² = 3 + m + 24gu      β = 120b/L²   βu³ = 2(3+m)u + 2 + 3m + 3m²
//! ```
//!
//! The cubic's inverse is explicit. For the PH quintic put `m = αu² - 24gu - 3` into
//! `G(u) = 2(3+m)u + 2 + 3m + 3m² - βu³`. With α fixed and `n = 3 + m`, the end point's β as a function of `x = 1/u`
//! has the derivative `-48g + (360 - 144n)gx + (60 - 15n - 3n²)x²`, negative for `n > 2.63`; there m rises with u too.
//! So `G/u³` increases wherever `m > -0.37`, at most one u is a root there, and [`LEAST_M`] is a safe place from which
//! to look for it.
//!
//! # Conditions
//! Since `sin θ > 0` (and `cos θ > 0` for the cubic), the four terms of Theorems 2.1 and 3.1 and their `m > 3/10` or
//! `3/7` say just `c0, c1, c2, c3 >= 0`: c3 >= 0 implies the bound on m, the second term is c2 >= 0, and the fourth is
//! the positive root of c1 = 0, a quadratic in q with a negative constant term. The first term A1 is c0 >= 0, and the
//! drawn region adds `m >= m*`.

use super::Kind;
use crate::num::{Number, formula};

/// Where the search for the PH quintic's root starts: m at the lower end, between -0.377 and 0.
pub(super) const LEAST_M: f64 = -0.25;
/// What the proof needs of m there: above -0.377, where the end point is still monotone.
pub(super) const MONOTONE_M: f64 = -0.35;

/// `c0 .. c5`; with `sign = 1` instead of -1, for `m, u, g >= 0`, the sums of the absolute values of their terms.
#[inline(always)]
pub(super) fn coefficients<N: Number>(kind: Kind, m: &N, u: &N, g: &N, sign: f64) -> [N; 6] {
    let (gu, mu) = (g.mul(u), m.mul(u));
    let (m2, m4) = (m.mul(m), m.plus(4.0 * sign));
    let m3 = m2.mul(m);
    match kind {
        Kind::Cubic => [
            formula!(4.0 * (u * (3.0 * g + (m + 4.0) * u * { sign }))),
            formula!(4.0 * (gu * (4.0 * m + { 5.0 * sign })) + mu * u * { 20.0 * sign } + 12.0),
            formula!(2.0 * (13.0 * m + { 2.0 * sign } + 4.0 * (gu * m) * m4)),
            formula!(2.0 * m * (10.0 * m + { 3.0 * sign } + gu * m * { 4.0 * sign })),
            m3.times(5.0),
            m3,
        ],
        Kind::Ph => [
            formula!(16.0 * gu * ((m + 6.0) * u * { sign } + 2.0)),
            formula!(16.0 * (gu * (3.0 * m + { 4.0 * sign }) + mu * gu * { 7.0 * sign } + 1.0)),
            formula!(4.0 * (9.0 * m + { 2.0 * sign } + 6.0 * (gu * m) * m4)),
            formula!(4.0 * m * (7.0 * m + { 3.0 * sign } + gu * m * { 6.0 * sign })),
            formula!(m2 * (7.0 * m + { 2.0 * sign })),
            m3,
        ],
    }
}

/// What turns `c_i` into Bernstein coefficients on [0, 1], times 10: the binomials of degree 5 divide them.
pub(super) const BERNSTEIN: [f64; 6] = [10.0, 2.0, 1.0, 1.0, 2.0, 10.0];

/// m of a PH quintic at u.
#[inline(always)]
pub(super) fn ph_m<N: Number>(alpha: &N, g: &N, u: &N) -> N {
    formula!(u * (alpha * u - 24.0 * g) - 3.0)
}

/// `(2(3+m)u + 2 + 3m + 3m², βu³)`, whose difference is G.
#[inline(always)]
pub(super) fn ph_sides<N: Number>(beta: &N, m: &N, u: &N) -> (N, N) {
    let left = formula!(2.0 * ((m + 3.0) * u) + 3.0 * (m * (m + 1.0)) + 2.0);
    (left, formula!(beta * (u * u) * u))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's coefficients (with the factor m restored in the PH c2).
    fn printed(kind: Kind, m: f64, q: f64, theta: f64) -> [f64; 6] {
        let (s, c, s2, half) = (theta.sin(), theta.cos(), (2.0 * theta).sin(), (theta / 2.0).sin().powi(2));
        match kind {
            Kind::Cubic => [
                4.0 * (3.0 * q * c - (4.0 + m) * s) * s,
                2.0 * (6.0 * q * q - q * (5.0 - 4.0 * m) * s2 - 10.0 * m * s * s),
                2.0 * q * ((13.0 * m - 2.0) * q - 2.0 * m * (4.0 - m) * s2),
                2.0 * m * q * ((10.0 * m - 3.0) * q - 2.0 * m * s2),
                5.0 * m.powi(3) * q * q,
                m.powi(3) * q * q,
            ],
            Kind::Ph => [
                16.0 * (q * s - (6.0 + m) * half),
                8.0 * (2.0 * q * q - q * (4.0 - 3.0 * m) * s - 14.0 * m * half),
                4.0 * q * ((9.0 * m - 2.0) * q - 3.0 * m * (4.0 - m) * s),
                4.0 * m * q * ((7.0 * m - 3.0) * q - 3.0 * m * s),
                m * m * q * q * (7.0 * m - 2.0),
                m.powi(3) * q * q,
            ],
        }
    }

    #[test]
    fn coefficients_are_the_papers_up_to_a_factor() {
        let mut compared = 0;
        for kind in [Kind::Cubic, Kind::Ph] {
            for theta in [0.01, 0.4, 1.1, 1.5] {
                for m in [0.1, 0.4, 1.0, 6.0] {
                    for q in [0.05, 0.7, 5.0] {
                        let (scale, g) = match kind {
                            Kind::Cubic => (f64::sin(theta), f64::cos(theta)),
                            Kind::Ph => (f64::tan(theta / 2.0), f64::cos(theta / 2.0).powi(2)),
                        };
                        let u = scale / q;
                        let ours = coefficients(kind, &m, &u, &g, -1.0).map(|c| c * q * q);
                        let sizes = coefficients(kind, &m, &u, &g, 1.0).map(|c| c * q * q);
                        for ((a, b), size) in ours.into_iter().zip(printed(kind, m, q, theta)).zip(sizes) {
                            assert!((a - b).abs() <= 1e-13 * size, "{kind:?} {theta} {m} {q}: {a} is not {b}");
                            assert!(a.abs() <= size * 1.000001);
                            compared += 1;
                        }
                    }
                }
            }
        }
        assert_eq!(compared, 2 * 4 * 4 * 3 * 6);
    }

    /// The sums of absolute terms, by evaluating every term apart.
    #[test]
    fn sums_of_terms_match_the_largest_values_over_signs() {
        // With u and g of either sign every combination of signs of the monomials' parities is met; none exceeds the
        // sum.
        for kind in [Kind::Cubic, Kind::Ph] {
            let sizes = coefficients(kind, &0.7, &0.3, &0.6, 1.0);
            for (u, g) in [(0.3, 0.6), (-0.3, 0.6), (0.3, -0.6), (-0.3, -0.6)] {
                for m in [0.7, -0.7] {
                    for (value, size) in coefficients(kind, &m, &u, &g, -1.0).iter().zip(&sizes) {
                        assert!(value.abs() <= size * 1.000001, "{kind:?}: {value} over {size}");
                    }
                }
            }
        }
    }
}
