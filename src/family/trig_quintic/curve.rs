//! The curve of a shape.

use crate::curve::TrigBezier;
use crate::curve::vector::scale;
use crate::family::trig_quintic::Shape;
use serde::Serialize;

/// What stands for r in (9).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scaling {
    /// `15 r/(4 + q)²`: then the curvature at the end is 1/r.
    Corrected,
    /// r, as the paper has it: then it is `15/((4 + q)² r)`.
    AsPrinted,
}

impl Shape {
    /// The curve from (0, 0) along (1, 0), turning left, whose end circle is to have the given radius.
    ///
    /// # Accuracy
    /// A few ulp of each side; with [`Scaling::Corrected`] the end curvature is 1/radius to 1e-14.
    ///
    /// # Source
    /// Misro, Ramli and Ali, (3) and (9).
    pub fn curve(&self, radius: f64, scaling: Scaling) -> TrigBezier {
        let Shape { ratio, theta, m, p, q } = *self;
        let (sine, cosine) = (0.5 * theta).sin_cos();
        let r = match scaling {
            Scaling::Corrected => 15.0 / ((4.0 + q) * (4.0 + q)) * radius,
            Scaling::AsPrinted => radius,
        };
        // In units of d, d² = s r: u1 = d³/(4 r sin θ/2) = ratio/(4 cos θ/2) d.
        let square = ratio * (sine / cosine) * r;
        let (u1, [u2, v2]) = (0.25 * ratio / cosine, [cosine, sine]);
        let u0 = m * u1;
        let sides = [
            [3.0 * u0 * u0, 0.0],
            [3.0 * u0 * u1, 0.0],
            [2.0 * u1 * u1 + u0 * u2, u0 * v2],
            [3.0 * u1 * u2, 3.0 * u1 * v2],
            [3.0 * theta.cos(), 3.0 * theta.sin()],
        ];
        TrigBezier { start: [0.0, 0.0], sides: sides.map(|side| scale(side, square / 15.0)), p, q }
    }
}
