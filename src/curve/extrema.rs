//! Interior extrema of curvature: the sign changes of a polynomial in Bernstein form.

use super::vector::{Vector, cross, length, scale, sub};
use crate::num::bernstein::halve;
use crate::num::{Number, formula};

/// Halvings at most: then an interval is narrower than a double near 1.
const DEPTH: u32 = 53;

/// Parameters in (0, 1), increasing, where the curvature of the cubic with these control points has an extremum.
///
/// The numerator of dκ/dt is `σ C' - 3/2 C σ'` with `σ = |P'|²`, `C = P' × P''`: a quintic, since the leading parts of
/// `P' × P''` cancel.
pub(super) fn curvature_extrema(p: &[Vector; 4]) -> Vec<f64> {
    let numerator = |q: [Vector; 3]| {
        let squared = |i: usize| {
            let side = [q[0][i], 2.0 * q[1][i], q[2][i]];
            product::<f64, 3, 3, 5>(&side, &side)
        };
        let (x, y) = (squared(0), squared(1));
        slopes(&std::array::from_fn(|k| x[k] + y[k]), &turning(&q), 1.5)
    };
    sides(p).map_or(Vec::new(), |q| sign_changes(&numerator(q)))
}

/// Parameters in (0, 1), increasing, where the curvature of the cubic with these control points changes its sign: as
/// that of `P' × P''`.
pub(super) fn inflections(p: &[Vector; 4]) -> Vec<f64> {
    sides(p).map_or(Vec::new(), |q| sign_changes(&turning(&q)))
}

/// Bernstein coefficients of `(P' × P'') / 18`, where those of `P' / 3` are q.
fn turning(q: &[Vector; 3]) -> [f64; 3] {
    [cross(q[0], q[1]), 0.5 * cross(q[0], q[2]), cross(q[1], q[2])]
}

/// Sides of the control polygon in units of the longest; `None` when there is none.
fn sides(p: &[Vector; 4]) -> Option<[Vector; 3]> {
    let q = [sub(p[1], p[0]), sub(p[2], p[1]), sub(p[3], p[2])];
    let longest = q.iter().map(|v| length(*v)).fold(0.0, f64::max);
    (longest.is_normal()).then(|| q.map(|v| scale(v, 1.0 / longest)))
}

/// Bernstein coefficients, times 10, of `s h' - p h s'`: the numerator of the slope of `h / s^p`. Those of h are given,
/// and those of s times binomials.
pub(super) fn slopes<N: Number>(s: &[N; 5], h: &[N; 3], p: f64) -> [N; 6] {
    let rise = |i: usize| formula!(2.0 * (h[i + 1] - h[i]));
    // s' from 1, 4, 6, 4, 1 times s: `4 (s1 - s0)`, `12 (s2 - s1)` and so on.
    let gain = [
        formula!(s[1] - 4.0 * s[0]),
        formula!(2.0 * s[2] - 3.0 * s[1]),
        formula!(3.0 * s[3] - 2.0 * s[2]),
        formula!(4.0 * s[4] - s[3]),
    ];
    let turn = [h[0].clone(), h[1].times(2.0), h[2].clone()];
    let (up, down): ([N; 6], [N; 6]) = (product(s, &[rise(0), rise(1)]), product(&turn, &gain));
    let binomial = [10.0, 2.0, 1.0, 1.0, 2.0, 10.0];
    std::array::from_fn(|i| formula!((up[i] - { p } * down[i]) * { binomial[i] }))
}

/// Of polynomials as Bernstein coefficients times binomials: those of the product are the plain convolution.
pub(super) fn product<N: Number, const A: usize, const B: usize, const C: usize>(a: &[N; A], b: &[N; B]) -> [N; C] {
    std::array::from_fn(|k| {
        let terms = (k.saturating_sub(B - 1)..=k.min(A - 1)).map(|i| a[i].mul(&b[k - i]));
        terms.reduce(|sum, x| sum.add(&x)).unwrap_or_else(|| a[0].clone())
    })
}

/// The parameters in (0, 1), increasing, where a polynomial changes its sign. A touching zero is no change. None where
/// a coefficient is not finite: a NaN has no sign, and infinite ones would be halved for ever.
pub(super) fn sign_changes<const K: usize>(c: &[f64; K]) -> Vec<f64> {
    let mut roots = Vec::new();
    if c.iter().all(|x| x.is_finite()) {
        isolate(c, 0.0, 1.0, DEPTH, &mut roots);
    }
    roots
}

/// Halves until the coefficients change sign at most once, then bisects.
fn isolate<const K: usize>(b: &[f64; K], lo: f64, hi: f64, depth: u32, roots: &mut Vec<f64>) {
    let signs = || b.iter().filter(|c| **c != 0.0).map(|c| *c > 0.0);
    let first = signs().next();
    if signs().all(|sign| Some(sign) == first) {
        return;
    }
    let middle = 0.5 * (lo + hi);
    if depth == 0 {
        // By the variation diminishing property an odd number of changes holds a change of the polynomial itself.
        if first != signs().next_back() {
            roots.push(middle);
        }
        return;
    }
    let (left, right) = halve(b);
    isolate(&left, lo, middle, depth - 1, roots);
    // A zero exactly in the middle belongs to neither half's inside.
    let (before, after) = (last_sign(left.iter().rev()), last_sign(right.iter()));
    if left.last() == Some(&0.0) && before != after {
        roots.push(middle);
    }
    isolate(&right, middle, hi, depth - 1, roots);
}

fn last_sign<'b>(mut b: impl Iterator<Item = &'b f64>) -> Option<bool> {
    b.find(|c| **c != 0.0).map(|c| *c > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of `h / s`: h = 1 + t, s = 1 + t⁴, so `s h' - h s' = 1 - 4t³ - 3t⁴`.
    #[test]
    fn products_and_slopes_of_bernstein_forms() {
        // t = (0, 1), t² = (0, 0, 1).
        assert_eq!(product::<f64, 2, 2, 3>(&[0.0, 1.0], &[0.0, 1.0]), [0.0, 0.0, 1.0]);
        assert_eq!(product::<f64, 3, 2, 4>(&[1.0, 0.0, 0.0], &[0.0, 1.0]), [0.0, 1.0, 0.0, 0.0]);
        let slopes = slopes(&[1.0, 4.0, 6.0, 4.0, 2.0], &[1.0, 1.5, 2.0], 1.0);
        assert_eq!(slopes.map(|x| x / 10.0), [1.0, 1.0, 1.0, 0.6, -1.2, -6.0]);
    }

    #[test]
    fn sign_changes_are_found_wherever_they_lie() {
        let line = |root: f64| [-root, 1.0 - root];
        for root in [0.5, 0.25, 1.0 / 3.0, 1e-9, 0.999] {
            let roots = sign_changes(&line(root));
            assert_eq!(roots.len(), 1, "{root}");
            assert!((roots[0] - root).abs() < 1e-15, "{root} {roots:?}");
        }
        let both = |a: f64, b: f64| {
            let [c0, c1, c2] = product(&line(a), &line(b));
            [c0, 0.5 * c1, c2]
        };
        let roots = sign_changes(&both(0.25, 0.8));
        assert_eq!(roots.len(), 2, "{roots:?}");
        assert!((roots[0] - 0.25).abs() < 1e-14 && (roots[1] - 0.8).abs() < 1e-14, "{roots:?}");
        // A double zero in the middle, and zeros at the very ends, are no changes of sign inside.
        assert!(sign_changes(&both(0.5, 0.5)).is_empty());
        assert!(sign_changes(&[0.0, 1.0, 2.0]).is_empty());
        assert!(sign_changes(&[0.0, 0.0]).is_empty() && sign_changes(&[f64::NAN, 1.0]).is_empty());
    }
}
