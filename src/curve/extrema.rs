//! Interior extrema of curvature: the sign changes of a polynomial in Bernstein form.

use super::vector::{Vector, cross, length, scale, sub};

/// Halvings at most: then an interval is narrower than a double near 1.
pub(super) const DEPTH: u32 = 53;

/// Parameters in (0, 1), increasing, where the curvature of the cubic with these control points has an extremum.
///
/// The numerator of dκ/dt is `σ C' - 3/2 C σ'` with `σ = |P'|²`, `C = P' × P''`: a quintic, since the leading parts of
/// `P' × P''` cancel. Its Bernstein coefficients are found, and its sign changes isolated by halving.
pub(super) fn curvature_extrema(p: &[Vector; 4]) -> Vec<f64> {
    let mut roots = Vec::new();
    if let Some(q) = sides(p) {
        sign_changes(&numerator(&q), 0.0, 1.0, DEPTH, &mut roots);
    }
    roots
}

/// Parameters in (0, 1), increasing, where the curvature of the cubic with these control points changes its sign: as
/// that of `P' × P''`.
pub(super) fn inflections(p: &[Vector; 4]) -> Vec<f64> {
    let mut roots = Vec::new();
    if let Some(q) = sides(p) {
        sign_changes(&turning(&q), 0.0, 1.0, DEPTH, &mut roots);
    }
    roots
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

/// Bernstein coefficients of the numerator of dκ/dt, up to a positive factor.
fn numerator(q: &[Vector; 3]) -> Vec<f64> {
    let turning = turning(q);
    let coordinate = |i: usize| q.map(|v| v[i]);
    let (x, y) = (product(&coordinate(0), &coordinate(0)), product(&coordinate(1), &coordinate(1)));
    let squared: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x + y).collect();
    let rising = product(&squared, &derivative(&turning));
    let falling = product(&turning, &derivative(&squared));
    rising.iter().zip(&falling).map(|(r, f)| r - 1.5 * f).collect()
}

pub(super) fn derivative(b: &[f64]) -> Vec<f64> {
    b.windows(2).map(|w| (b.len() - 1) as f64 * (w[1] - w[0])).collect()
}

pub(super) fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let (m, n) = (a.len() - 1, b.len() - 1);
    let coefficient = |k: usize| {
        let terms = (k.saturating_sub(n)..=k.min(m)).map(|i| choose(m, i) * choose(n, k - i) * a[i] * b[k - i]);
        terms.sum::<f64>() / choose(m + n, k)
    };
    (0..=m + n).map(coefficient).collect()
}

fn choose(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64)
}

/// Halves until the coefficients change sign at most once, then bisects. A touching zero is no change.
pub(super) fn sign_changes(b: &[f64], lo: f64, hi: f64, depth: u32, roots: &mut Vec<f64>) {
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
    let (left, right) = halves(b);
    let (left, right) = (&left[..b.len()], &right[..b.len()]);
    sign_changes(left, lo, middle, depth - 1, roots);
    // A zero exactly in the middle belongs to neither half's inside.
    let (before, after) = (last_sign(left.iter().rev()), last_sign(right.iter()));
    if left.last() == Some(&0.0) && before != after {
        roots.push(middle);
    }
    sign_changes(right, middle, hi, depth - 1, roots);
}

fn last_sign<'b>(mut b: impl Iterator<Item = &'b f64>) -> Option<bool> {
    b.find(|c| **c != 0.0).map(|c| *c > 0.0)
}

/// The most coefficients of a form here, those of a degree of 7.
const MOST: usize = 8;

/// De Casteljau at 1/2; both halves have as many coefficients as b, at most [`MOST`].
pub(super) fn halves(b: &[f64]) -> ([f64; MOST], [f64; MOST]) {
    let (mut left, mut right) = ([0.0; MOST], [0.0; MOST]);
    right[..b.len()].copy_from_slice(b);
    for (step, first) in left[..b.len()].iter_mut().enumerate() {
        *first = right[0];
        for i in 0..b.len() - 1 - step {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_derivatives_of_bernstein_forms() {
        // t = (0, 1), t² = (0, 0, 1), (t²)' = 2t = (0, 2).
        assert_eq!(product(&[0.0, 1.0], &[0.0, 1.0]), [0.0, 0.0, 1.0]);
        assert_eq!(product(&[1.0, 0.0], &[0.0, 1.0]), [0.0, 0.5, 0.0]);
        assert_eq!(derivative(&[0.0, 0.0, 1.0]), [0.0, 2.0]);
        assert_ne!(product(&[1.0, 0.5], &[0.0, 1.0]), [0.0, 0.5, 0.0]);
    }

    #[test]
    fn sign_changes_are_found_wherever_they_lie() {
        let found = |b: &[f64]| {
            let mut roots = Vec::new();
            sign_changes(b, 0.0, 1.0, DEPTH, &mut roots);
            roots
        };
        let line = |root: f64| [-root, 1.0 - root];
        for root in [0.5, 0.25, 1.0 / 3.0, 1e-9, 0.999] {
            let roots = found(&line(root));
            assert_eq!(roots.len(), 1, "{root}");
            assert!((roots[0] - root).abs() < 1e-15, "{root} {roots:?}");
        }
        let two = product(&line(0.25), &line(0.8));
        let roots = found(&two);
        assert_eq!(roots.len(), 2, "{roots:?}");
        assert!((roots[0] - 0.25).abs() < 1e-14 && (roots[1] - 0.8).abs() < 1e-14, "{roots:?}");
        // A double zero in the middle, and zeros at the very ends, are no changes of sign inside.
        assert!(found(&product(&line(0.5), &line(0.5))).is_empty());
        assert!(found(&[0.0, 1.0, 2.0]).is_empty());
        assert!(found(&[0.0, 0.0]).is_empty());
    }
}
