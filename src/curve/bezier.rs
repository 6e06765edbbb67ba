//! Cubic Bézier curves in any frame.

use super::extrema;
use super::jet::Jet;
use super::length::arc_length;
use super::vector::{add, lerp, scale, sub};
use serde::Serialize;

/// A cubic Bézier curve, `P(t) = Σ C(3,i) t^i (1-t)^(3-i) p_i` for t in [0, 1]: Habib & Sakai, (3.1).
///
/// Any unit of length, any place; but far from the origin the rounding of the control points themselves, relative to
/// the curve's size, is what limits derivatives and curvature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(transparent)]
pub struct CubicBezier {
    /// The control points.
    pub p: [[f64; 2]; 4],
}

impl CubicBezier {
    /// The curve in the normalised frame, from (-1, 0) to (1, 0), with the given tangent angles and tangent lengths.
    ///
    /// # Arguments
    /// - `phi0`, `phi1`: angles of the end tangents against the chord, radians, positive, `phi0 + phi1 < π`.
    /// - `f0`, `f1`: `|P'(0)| / d0` and `|P'(1)| / d1`, in (0, 3) for a curve without inflection.
    ///
    /// # Accuracy
    /// A few ulp of the control points. A tangent much shorter than the chord is therefore known only to
    /// `2^-52 / length`, and so is the curvature at its end.
    ///
    /// # Source
    /// Habib & Sakai, (3.3).
    pub fn from_ratios(phi0: f64, phi1: f64, f0: f64, f1: f64) -> CubicBezier {
        let [h0, h1] = outer_legs(phi0, phi1, f0, f1);
        CubicBezier {
            p: [
                [-1.0, 0.0],
                [-1.0 + h0 * phi0.cos(), -h0 * phi0.sin()],
                [1.0 - h1 * phi1.cos(), -h1 * phi1.sin()],
                [1.0, 0.0],
            ],
        }
    }

    /// The sides of the control polygon of [`CubicBezier::from_ratios`] for the same numbers and the end
    /// curvatures of the normalised frame, which (f0, f1) must meet.
    ///
    /// # Accuracy
    /// A few ulp of each. The middle one is made from the end curvatures, so that the sides meet those and the end
    /// directions to a few ulp over `sin(phi0 + phi1)` and `1 - f/3` of the other end, however short an end's tangent
    /// is; their sum is the chord as nearly as the root is one.
    ///
    /// # Source
    /// Habib & Sakai, (3.3), (3.4).
    pub fn legs([phi0, phi1]: [f64; 2], [kappa0, kappa1]: [f64; 2], [f0, f1]: [f64; 2]) -> [[f64; 2]; 3] {
        let [h0, h1] = outer_legs(phi0, phi1, f0, f1);
        // κ0 = 2/3 (p1 - p0) × (p2 - p1) / |p1 - p0|³.
        let [g0, g1] = [kappa1 * h1 * h1, kappa0 * h0 * h0].map(|x| 1.5 * x / (phi0 + phi1).sin());
        let (along0, along1) = ([phi0.cos(), -phi0.sin()], [phi1.cos(), phi1.sin()]);
        [scale(along0, h0), add(scale(along0, g0), scale(along1, g1)), scale(along1, h1)]
    }

    /// The point at t; exact at 0 and 1.
    pub fn point(&self, t: f64) -> [f64; 2] {
        self.jet(t).point
    }

    /// Point and derivatives at t.
    pub fn jet(&self, t: f64) -> Jet {
        let p = &self.p;
        let mix = |a, b| lerp(a, b, t);
        let (a, b, c) = (mix(p[0], p[1]), mix(p[1], p[2]), mix(p[2], p[3]));
        // Differences first: they are exact for neighbouring points, so nothing cancels later.
        let q = [sub(p[1], p[0]), sub(p[2], p[1]), sub(p[3], p[2])];
        let r = [sub(q[1], q[0]), sub(q[2], q[1])];
        Jet {
            point: mix(mix(a, b), mix(b, c)),
            first: scale(mix(mix(q[0], q[1]), mix(q[1], q[2])), 3.0),
            second: scale(mix(r[0], r[1]), 6.0),
            third: scale(sub(r[1], r[0]), 6.0),
        }
    }

    /// Signed curvature at t; see [`Jet::curvature`].
    pub fn curvature(&self, t: f64) -> f64 {
        self.jet(t).curvature()
    }

    /// Arc length, to 1e-14 relative; see [`arc_length`].
    pub fn length(&self) -> f64 {
        self.length_between(0.0, 1.0)
    }

    /// Arc length from parameter `from` to parameter `to`; see [`arc_length`].
    pub fn length_between(&self, from: f64, to: f64) -> f64 {
        arc_length(|t| self.jet(t).speed(), from, to)
    }

    /// The parameters in (0, 1), increasing, where the curvature has an extremum: none on a spiral.
    ///
    /// # Accuracy
    /// Isolated in double precision by Bernstein subdivision; close to a pair of extrema that merge, rounding decides
    /// whether both or none are found. [`crate::family::cubic::solve`] proves what this only shows.
    pub fn curvature_extrema(&self) -> Vec<f64> {
        extrema::curvature_extrema(&self.p)
    }

    /// The parameters in (0, 1), increasing, where the curvature changes its sign.
    ///
    /// # Accuracy
    /// As [`CubicBezier::curvature_extrema`].
    pub fn inflections(&self) -> Vec<f64> {
        extrema::inflections(&self.p)
    }
}

/// Lengths of the outer sides of the control polygon.
fn outer_legs(phi0: f64, phi1: f64, f0: f64, f1: f64) -> [f64; 2] {
    let third = 2.0 / (3.0 * (phi0 + phi1).sin());
    [third * phi1.sin() * f0, third * phi0.sin() * f1]
}
