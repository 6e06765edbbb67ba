//! Signs of polynomials on vectors: what most nodes of a grid need, before single ones are halved further.

use super::COVER;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};

/// Unit roundoff.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// Lanes where polynomials are certainly positive on [0, 1], given Bernstein coefficients that may each be off by
/// `error`, after so many halvings at most.
///
/// As in [`super::bernstein::positive`]: coefficients bound a piece from below, and a halving adds `K - 1` units of its
/// largest coefficient. All lanes share the pieces. A lane that is not among them may be positive too. A lane with a
/// coefficient or an error that is no number is never among them.
#[inline(always)]
pub(crate) fn positive_lanes<S: Simd, const K: usize>(
    simd: S,
    c: &[S::f64s; K],
    error: S::f64s,
    wanted: u64,
    halvings: usize,
) -> u64 {
    let rounding = COVER * ((K - 1) as f64 * UNIT);
    let mut waiting = Vec::with_capacity(8);
    waiting.push((*c, error, wanted));
    let (mut left, mut failed) = (halvings, 0);
    while let Some((c, error, lanes)) = waiting.pop() {
        // Compared one by one, so that a coefficient that is no number counts as not positive.
        let (mut above, mut largest) = (c[0].simd_gt(error), c[0].abs());
        for c in &c[1..] {
            above &= c.simd_gt(error);
            largest = largest.max(c.abs());
        }
        let open = lanes & !failed & !above.to_bitmask();
        // Where an end is not positive, no halving makes it so.
        let ends = (c[0].simd_gt(error) & c[K - 1].simd_gt(error)).to_bitmask();
        failed |= open & if left == 0 { open } else { !ends };
        let open = open & !failed;
        if open == 0 {
            continue;
        }
        left -= 1;
        let half = S::f64s::splat(simd, 0.5);
        let (mut first, mut second) = (c, c);
        for step in 1..K {
            first[step - 1] = second[0];
            for i in 0..K - step {
                second[i] = (second[i] + second[i + 1]) * half;
            }
        }
        first[K - 1] = second[0];
        let error = error + largest * rounding;
        waiting.push((second, error, open));
        waiting.push((first, error, open));
    }
    wanted & !failed
}

/// Lanes where `Σ ci s^i` is certainly negative at some s > 0, given how far each coefficient may be off, with what
/// follows from its size: Horner's scheme adds less than `2K` units of the absolute terms. A value that is infinite or
/// no number is never certain.
#[inline(always)]
pub(crate) fn negative_lanes<S: Simd, const K: usize>(simd: S, c: &[S::f64s; K], errors: &[S::f64s; K], s: f64) -> u64 {
    let (mut value, mut bound) = (c[K - 1], errors[K - 1]);
    for i in (0..K - 1).rev() {
        value = value * s + c[i];
        bound = bound * s + errors[i];
    }
    let finite = value.simd_ge(S::f64s::splat(simd, f64::MIN));
    (finite & value.simd_lt(S::f64s::splat(simd, 0.0) - bound)).to_bitmask()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use crate::num::Interval;
    use crate::num::bernstein::positive;
    use fearless_simd::{Level, dispatch};

    #[inline(always)]
    fn signs<S: Simd>(simd: S, c: &[f64; 8]) -> (bool, bool) {
        const BINOMIALS: [f64; 8] = [1.0, 7.0, 21.0, 35.0, 35.0, 21.0, 7.0, 1.0];
        let zero = S::f64s::splat(simd, 0.0);
        let (mut lanes, mut powers, mut errors) = ([zero; 8], [zero; 8], [zero; 8]);
        for i in 0..8 {
            lanes[i] = S::f64s::splat(simd, c[i]);
            powers[i] = lanes[i] * BINOMIALS[i];
            // One unit for the product.
            errors[i] = powers[i].abs() * (COVER * 17.0 * UNIT);
        }
        let low = [0.2, 0.5, 1.0, 2.0, 5.0].map(|s| negative_lanes(simd, &powers, &errors, s) & 1 == 1);
        (positive_lanes(simd, &lanes, zero, 1, 12) == 1, low.contains(&true))
    }

    /// Wherever the number that is none stands, and where a sum leaves the range of doubles.
    #[test]
    fn no_sign_of_what_is_no_number() {
        for place in 0..8 {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for sign in [1.0, -1.0] {
                    let mut c = [sign; 8];
                    c[place] = bad;
                    let found = dispatch!(Level::new(), simd => signs(simd, &c));
                    assert!(!found.0 || bad == f64::INFINITY && sign == 1.0, "{c:?}");
                    assert!(!found.1, "{c:?}");
                }
            }
        }
        let large = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e308, -1e308];
        assert_eq!(dispatch!(Level::new(), simd => signs(simd, &large)), (false, false));
    }

    /// Random polynomials of degree 7, many of them close to 0 somewhere.
    #[test]
    fn signs_are_true() {
        let mut noise = Noise(9);
        let (mut yes, mut no) = (0, 0);
        for round in 0..20_000 {
            let mut c: [f64; 8] = std::array::from_fn(|_| noise.signed());
            if round % 2 == 0 {
                // A square, shifted by little.
                let [a, b, d] = [noise.signed(), noise.signed(), noise.signed()];
                let small = noise.signed() * 2f64.powi(-((noise.next() * 50.0) as i32));
                let square = |i: f64| (a + b * i) * (a + b * i) + d * d * i * (7.0 - i) / 7.0 + small;
                c = std::array::from_fn(|i| square(i as f64));
            }
            let (certain, dips) = dispatch!(Level::new(), simd => signs(simd, &c));
            let truth = positive(&c.map(|x| Interval::new(x, 200)), 0.0, 0.0, 300);
            assert!(!certain || !truth.is_no(), "{c:?}");
            assert!(!dips || !truth.is_yes(), "{c:?}");
            yes += usize::from(certain);
            no += usize::from(dips);
        }
        println!("{yes} positive, {no} negative");
        assert!(yes > 2000 && no > 4000);
    }
}
