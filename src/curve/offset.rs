//! Offset curves of Pythagorean-hodograph quintics.

use super::PhQuintic;
use super::hodograph::complex;
use super::quintic::value;
use serde::Serialize;

/// A rational curve of degree 9 in homogeneous coordinates, as Bernstein coefficients.
///
/// The point at t is `numerator(t) / weight(t)`. Where all weights are positive, `numerator[i] / weight[i]` are its
/// control points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Offset {
    /// X and Y.
    pub numerator: Vec<[f64; 2]>,
    /// W.
    pub weight: Vec<f64>,
}

impl Offset {
    /// The point at t; NaN where the weight is 0, which is where the path stands still.
    pub fn point(&self, t: f64) -> [f64; 2] {
        let component = |i: usize| self.numerator.iter().map(|p| p[i]).collect::<Vec<_>>();
        let weight = value(self.weight.clone(), t);
        [0, 1].map(|i| value(component(i), t) / weight)
    }
}

impl PhQuintic {
    /// The curve at signed distance `d` to the left, `r + d i t`: rational of degree 9, weight σ.
    pub fn offset(&self, d: f64) -> Offset {
        let speed = self.speed_coefficients();
        let [w0, w1, w2] = complex(&self.preimage);
        let hodograph = [w0 * w0, w0 * w1, (2.0 * w1 * w1 + w0 * w2) / 3.0, w1 * w2, w2 * w2];
        // i w² is (-Im, Re).
        let normal = [hodograph.map(|z| -z.im), hodograph.map(|z| z.re)];
        let points = self.control_points();
        let component = |i: usize| {
            let moved = product(&speed, &points.map(|p| p[i]));
            moved.into_iter().zip(product(&normal[i], &[1.0; 6])).map(|(p, n)| p + d * n).collect::<Vec<_>>()
        };
        let (x, y) = (component(0), component(1));
        Offset { numerator: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(), weight: product(&speed, &[1.0; 6]) }
    }
}

/// Bernstein coefficients of a product.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
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
