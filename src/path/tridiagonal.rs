//! Complex tridiagonal systems, with or without the two corners of a closed loop.

use num_complex::Complex64;

const ZERO: Complex64 = Complex64::new(0.0, 0.0);

/// `lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1]`; `lower[0]` and the last of `upper` are the corners of a
/// closed loop, else 0.
#[derive(Debug, Clone)]
pub(super) struct Tridiagonal {
    pub lower: Vec<Complex64>,
    pub diagonal: Vec<Complex64>,
    pub upper: Vec<Complex64>,
}

impl Tridiagonal {
    /// The solution; numbers that are not finite where the matrix is singular.
    ///
    /// Elimination with row exchanges. The corners are a change of rank one (Sherman and Morrison), for at least three
    /// unknowns.
    pub(super) fn solve(&self, right: &[Complex64]) -> Vec<Complex64> {
        let last = self.diagonal.len() - 1;
        let (corner, other) = (self.lower[0], self.upper[last]);
        if corner == ZERO && other == ZERO {
            return eliminate(&self.lower, self.diagonal.clone(), &self.upper, [right.to_vec()])
                .into_iter()
                .flatten()
                .collect();
        }
        // A = T + u vᵀ with u = (γ, 0 .. 0, other), v = (1, 0 .. 0, corner / γ).
        let gamma = -self.diagonal[0];
        let mut diagonal = self.diagonal.clone();
        diagonal[0] -= gamma;
        diagonal[last] -= corner * other / gamma;
        let mut column = vec![ZERO; last + 1];
        (column[0], column[last]) = (gamma, other);
        let [mut x, q] = eliminate(&self.lower, diagonal, &self.upper, [right.to_vec(), column]);
        let share = (x[0] + corner / gamma * x[last]) / (1.0 + q[0] + corner / gamma * q[last]);
        for (x, q) in x.iter_mut().zip(&q) {
            *x -= share * q;
        }
        x
    }
}

/// Solves for several right-hand sides; corners are left out of account.
fn eliminate<const K: usize>(
    lower: &[Complex64],
    mut diagonal: Vec<Complex64>,
    upper: &[Complex64],
    mut right: [Vec<Complex64>; K],
) -> [Vec<Complex64>; K] {
    let n = diagonal.len();
    let mut upper = upper.to_vec();
    let mut second = vec![ZERO; n];
    for i in 0..n - 1 {
        let mut below = lower[i + 1];
        if below.norm_sqr() > diagonal[i].norm_sqr() {
            std::mem::swap(&mut below, &mut diagonal[i]);
            let (next, after) = (diagonal[i + 1], if i + 2 < n { upper[i + 1] } else { ZERO });
            (diagonal[i + 1], upper[i]) = (upper[i], next);
            if i + 2 < n {
                (second[i], upper[i + 1]) = (after, ZERO);
            }
            right.iter_mut().for_each(|r| r.swap(i, i + 1));
        }
        let factor = below / diagonal[i];
        let (across, far) = (upper[i], second[i]);
        diagonal[i + 1] -= factor * across;
        if i + 2 < n {
            upper[i + 1] -= factor * far;
        }
        for r in &mut right {
            let above = r[i];
            r[i + 1] -= factor * above;
        }
    }
    for r in &mut right {
        for i in (0..n).rev() {
            let mut sum = r[i];
            if i + 1 < n {
                sum -= upper[i] * r[i + 1];
            }
            if i + 2 < n {
                sum -= second[i] * r[i + 2];
            }
            r[i] = sum / diagonal[i];
        }
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    #[test]
    fn solutions_satisfy_the_equations_whatever_the_pivots() {
        let mut noise = Noise(7);
        let mut exchanged = 0;
        for n in 1..40 {
            for closed in [false, n >= 3] {
                let mut row = || (0..n).map(|_| Complex64::new(noise.signed(), noise.signed())).collect::<Vec<_>>();
                let (mut lower, diagonal, mut upper, right) = (row(), row(), row(), row());
                if !closed {
                    (lower[0], upper[n - 1]) = (ZERO, ZERO);
                }
                exchanged += (1..n).filter(|i| lower[*i].norm() > diagonal[*i - 1].norm()).count();
                let system = Tridiagonal { lower, diagonal, upper };
                let x = system.solve(&right);
                let most = x.iter().map(|x| x.norm()).fold(1.0, f64::max);
                for i in 0..n {
                    let mut got = system.diagonal[i] * x[i];
                    if n > 1 {
                        got += system.lower[i] * x[(i + n - 1) % n] + system.upper[i] * x[(i + 1) % n];
                    }
                    // The rank-one change may cost digits: a few of these random matrices are far from any good one.
                    assert!((got - right[i]).norm() < 1e-10 * most, "{n} {closed}: {got} is not {}", right[i]);
                }
            }
        }
        assert!(exchanged > 100);
    }
}
