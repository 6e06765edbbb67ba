//! The polynomials of the family, on any numbers: the sides of the control polygon, the hodograph, the numerator of κ'.
//!
//! # The curve in τ
//! With `τ = tan(πt/4)`, `S = sin(πt/2) = 2τ/V` and `C = cos(πt/2) = (1-τ²)/V`, `V = 1 + τ²`, the basis (2) of Misro,
//! Ramli and Ali becomes rational. Summed from the end, `z = P0 + Σ ΔPi Gi` with `Gi = g(i+1) + .. + g5`; here
//! `g0 + g1 = (1-S)³(1+3S)` and `g4 + g5 = (1-C)³(1+3C)` are free of p and q, so p enters through
//! `G0' = C(1-S)³(4 + p - 5pS)` alone and q through `G4' = S(1-C)³(4 + q - 5qC)`. All `V⁵ Gi'` (derivative by πt/2) are
//! of degree 10 with non-negative coefficients in `τ^i (1-τ)^(10-i)`, for p and q in [-4, 1]: the rows of
//! [`hodograph`], divided by 8.
//!
//! # Forms
//! A list c stands for `Σ ci τ^i (1-τ)^(n-i)`: products are plain convolutions, and Bernstein coefficients are
//! `ci / C(n, i)`.
//!
//! # Curvature
//! By τ, `z'` is a constant times `A / V⁶`, so κ one times `X V⁶ / D^(3/2)`, `X = A × A'` (degree 18), `D = |A|²`
//! (degree 20). That is of degree 0 as a form in (τ, 1-τ), so κ' has the sign of the form of degree 38 with the
//! coefficients `Σ (2i - 3j + 12a) Xi Dj Va`, `i + j + a = k + 1`. X0 and X1 vanish, because the first two sides are
//! parallel; so κ'(0) = 0 always, and a factor τ is left out: degree 37.
//!
//! # Sides
//! (3) with (9) are sums of products of `u0 = mu1`, `u1` and `u2 + iv2 = d e^(iθ/2)`. Over `d² cos²(θ/2)/15` they are
//! 3m²y², 3my², `y(2y + mω)`, `3yω`, `3ω²` with `ω = 1 + i tan(θ/2)` and `y = u1/(d cos(θ/2)) = ratio / (4 cos²(θ/2))`.
//! Their upward parts are taken in units of `tan(θ/2)`; so X loses a positive factor, and D takes the square of it.

use crate::num::{Number, formula};
use std::array::from_fn;

/// Number of coefficients of the numerator.
pub(super) const K: usize = 38;
/// Sides up to this have no upward part, and so the first coefficients of the hodograph.
const LEVEL: usize = 3;

/// What follows from the ratio and the angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame<N> {
    /// `y = ratio / (2(1 + cos θ))`.
    pub y: N,
    /// `3 (1 - tan²(θ/2)) = 6 cos θ / (1 + cos θ)`: the last side's forward part; its upward part is 6.
    pub last: N,
    /// `tan²(θ/2)`.
    pub square: N,
}

/// The hodograph A.
pub(super) struct Hodograph<N> {
    /// Forward.
    pub x: [N; 11],
    /// Upward in units of `tan(θ/2)`, from coefficient [`LEVEL`] on; those before are 0.
    pub y: [N; 8],
}

/// What the last three sides add from coefficient 3 on.
#[inline(always)]
fn tail<N: Number>([s2, s3, s4]: [&N; 3], [q1, q4, q9]: [&N; 3]) -> [N; 8] {
    [
        s2.times(17.0),
        s2.times(84.0),
        formula!(168.0 * s2 + 12.0 * s3),
        formula!(168.0 * s2 + 60.0 * s3),
        formula!(68.0 * s2 + 120.0 * s3 + 8.0 * (s4 * q1)),
        formula!(120.0 * s3 + 24.0 * (s4 * q1)),
        formula!(48.0 * s3 + s4 * q9),
        formula!(4.0 * (s4 * q4)),
    ]
}

/// Of the curve with these shape parameters: sums of positive terms in all that follows from the parameters.
///
/// Counting roundings, with those of the sides (s), `4 + p`, `1 - p`, `4 + q`, `1 - q` (one each): at most s + 6.
#[inline(always)]
pub(super) fn hodograph<N: Number>(frame: &Frame<N>, m: &N, p: &N, q: &N) -> Hodograph<N> {
    let y = &frame.y;
    let my = m.mul(y);
    let sides = [
        formula!(3.0 * (my * my)),
        formula!(3.0 * (my * y)),
        formula!((2.0 * y + m) * y),
        y.times(3.0),
        frame.last.clone(),
    ];
    let up = [my, y.times(3.0), formula!(0.0 * y + 6.0)];
    let [p4, p1, q4, q1] = [p.plus(4.0), formula!(1.0 - p), q.plus(4.0), formula!(1.0 - q)];
    let q9 = formula!(16.0 * q1 + 4.0 * q4);
    let [s0, s1, s2, s3, s4] = &sides;
    let [a, b, c, d, e, f, g, h] = tail([s2, s3, s4], [&q1, &q4, &q9]);
    let x = [
        formula!(0.125 * (s0 * p4)),
        formula!(s0 * (p1 + 0.25 * p4) + 3.0 * s1),
        formula!(3.0 * (s0 * p1) + 15.0 * s1),
        formula!(2.0 * (s0 * p1) + 30.0 * s1 + a),
        formula!(30.0 * s1 + b),
        formula!(12.0 * s1 + c),
        d,
        e,
        f,
        g,
        h,
    ];
    Hodograph { x, y: tail([&up[0], &up[1], &up[2]], [&q1, &q4, &q9]) }
}

/// One more term of a sum.
#[inline(always)]
fn add<N: Number>(sum: &mut Option<N>, term: N) {
    *sum = Some(match sum.take() {
        Some(sum) => sum.add(&term),
        None => term,
    });
}

// What follows runs on vectors: loops, since a closure is not always inlined into code for a wider level, and then
// every operation becomes a call.

/// `X2 .. X18`: `Xk = Σ (j - i) Ai × Aj` over `i < j`, `i + j = k + 1`. With `sign` 1 instead of -1 the sums of the
/// absolute values of their terms.
#[inline(always)]
fn turning<N: Number>(a: &Hodograph<N>, zero: &N, sign: f64) -> [N; 17] {
    let mut all = from_fn(|_| zero.clone());
    for (k, place) in all.iter_mut().enumerate() {
        let s = k + 3;
        let mut sum = None;
        for i in s.saturating_sub(10)..s.div_ceil(2) {
            let j = s - i;
            if j >= LEVEL {
                let mut cross = a.x[i].mul(&a.y[j - LEVEL]);
                if i >= LEVEL {
                    cross = formula!(cross + a.x[j] * a.y[i - LEVEL] * { sign });
                }
                add(&mut sum, cross.times((j - i) as f64));
            }
        }
        if let Some(sum) = sum {
            *place = sum;
        }
    }
    all
}

/// Coefficient k of the square of a form.
#[inline(always)]
fn square_of<N: Number>(v: &[N], k: usize) -> Option<N> {
    let mut sum = None;
    for i in k.saturating_sub(v.len() - 1)..=k / 2 {
        add(&mut sum, formula!(v[i] * v[k - i] * { if 2 * i == k { 1.0 } else { 2.0 } }));
    }
    sum
}

/// `D0 .. D20`: sums of positive terms.
#[inline(always)]
fn speed<N: Number>(a: &Hodograph<N>, zero: &N, square: &N) -> [N; 21] {
    let mut all = from_fn(|_| zero.clone());
    for (k, place) in all.iter_mut().enumerate() {
        if let Some(forward) = square_of(&a.x, k) {
            *place = forward;
        }
        if (2 * LEVEL..=2 * LEVEL + 14).contains(&k)
            && let Some(upward) = square_of(&a.y, k - 2 * LEVEL)
        {
            *place = formula!(place + upward * square);
        }
    }
    all
}

/// The coefficients of the numerator, or, with `sign` 1 instead of -1, the sums of the absolute values of their terms.
///
/// Counting roundings, with h those of the hodograph and t those of the square: products of two have 2h + 1, X three
/// more for difference, factor and up to five terms (2h + 8 in all), D with the square 2h + t + 3 and up to 8 terms
/// (2h + t + 11), the sums below at most 21 terms, a factor and a product (24), and four terms at last: 4h + t + 48.
#[inline(always)]
pub(super) fn numerator<N: Number>(a: &Hodograph<N>, square: &N, sign: f64) -> [N; K] {
    let zero = square.times(0.0);
    let (turning, speed) = (turning(a, &zero, sign), speed(a, &zero, square));
    let mut all: [Option<N>; K] = [const { None }; K];
    for s in 0..37usize {
        // Σ Xi Dj and Σ (2i - 3j) Xi Dj over i + j = s + 2.
        let (mut plain, mut weighed) = (None, None);
        for i in s.saturating_sub(20)..=s.min(16) {
            let product = turning[i].mul(&speed[s - i]);
            let factor = 2.0 * (i + 2) as f64 - 3.0 * (s - i) as f64;
            add(&mut weighed, product.times(if sign > 0.0 { factor.abs() } else { factor }));
            add(&mut plain, product);
        }
        // V = (1, 2, 2): the coefficient of τ^(i+1) takes the sums s = i, i-1 and i-2.
        if let (Some(plain), Some(weighed)) = (plain, weighed) {
            let double = weighed.times(2.0);
            if s + 1 < K {
                add(&mut all[s + 1], formula!(double + 24.0 * plain));
            }
            if s + 2 < K {
                add(&mut all[s + 2], formula!(double + 48.0 * plain));
            }
            add(&mut all[s], weighed);
        }
    }
    all.map(|c| c.unwrap_or_else(|| zero.clone()))
}

/// `L / C(37, i)`, L the least common multiple of these binomials (lcm(1..38)/38): whole numbers, so that Bernstein
/// coefficients are exact multiples.
pub(super) const BERNSTEIN: [f64; K] = {
    let mut factors = [0.0; K];
    let (mut i, mut binomial) = (0u64, 1u64);
    while i < K as u64 {
        factors[i as usize] = (140_603_459_396_400 / binomial) as f64;
        i += 1;
        // Exact: C(37, i).
        binomial = binomial * (K as u64 - i) / i;
    }
    factors
};
