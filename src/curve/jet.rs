//! A curve near one parameter: point, three derivatives, and the curvature they give.

use super::vector::{Vector, cross, dot, length, lerp, scale, sub};

/// Point and derivatives of a plane curve at one parameter; every family of curves yields these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// `P(t)`.
    pub point: [f64; 2],
    /// `P'(t)`.
    pub first: [f64; 2],
    /// `P''(t)`.
    pub second: [f64; 2],
    /// `P'''(t)`.
    pub third: [f64; 2],
}

impl Jet {
    /// Of a Bézier curve of any degree with these control points; exact at 0 and 1.
    ///
    /// Differences come first, then de Casteljau's algorithm: those of neighbouring points are exact, so nothing
    /// cancels later.
    pub fn of_bezier(p: &[[f64; 2]], t: f64) -> Jet {
        let differences = |p: &[Vector]| p.windows(2).map(|w| sub(w[1], w[0])).collect::<Vec<_>>();
        let mut first = differences(p);
        let mut second = differences(&first);
        let mut third = differences(&second);
        let degree = first.len() as f64;
        Jet {
            point: casteljau(&mut p.to_vec(), t),
            first: scale(casteljau(&mut first, t), degree),
            second: scale(casteljau(&mut second, t), degree * (degree - 1.0)),
            third: scale(casteljau(&mut third, t), degree * (degree - 1.0) * (degree - 2.0)),
        }
    }

    /// `|P'|`, in user lengths per unit of the parameter.
    pub fn speed(&self) -> f64 {
        length(self.first)
    }

    /// Angle of the tangent, radians, in (-π, π]; 0 where the speed is zero.
    pub fn direction(&self) -> f64 {
        self.first[1].atan2(self.first[0])
    }

    /// Signed curvature, positive where the curve turns left, in 1 / length; NaN where the speed is zero.
    ///
    /// # Accuracy
    /// For curves of any size from 1e-300 to 1e300 nothing overflows or vanishes unless the result itself leaves the
    /// range of doubles. Rounding errors of the derivatives are amplified by `1 / sin` of the angle between `P'` and
    /// `P''`.
    ///
    /// # Source
    /// Habib & Sakai, (2.4).
    pub fn curvature(&self) -> f64 {
        let (speed, unit, a, _) = self.by_speed();
        cross(unit, a) / speed
    }

    /// Derivative of the curvature with respect to the parameter, in 1 / length; NaN where the speed is zero.
    ///
    /// # Source
    /// Habib & Sakai, (2.5), with `d/dt (P' × P'') = P' × P'''`.
    pub fn curvature_dt(&self) -> f64 {
        let (speed, bend) = self.bend();
        bend / speed
    }

    /// Derivative of the curvature with respect to arc length, in 1 / length²; NaN where the speed is zero.
    pub fn curvature_ds(&self) -> f64 {
        let (speed, bend) = self.bend();
        bend / speed / speed
    }

    /// Speed, and the derivative of the curvature times it.
    fn bend(&self) -> (f64, f64) {
        let (speed, unit, a, b) = self.by_speed();
        (speed, cross(unit, b) - 3.0 * cross(unit, a) * dot(unit, a))
    }

    /// Speed, unit tangent, `P'' / speed` and `P''' / speed`: all but the first have no unit, so their products
    /// neither overflow nor vanish for curves of any size.
    fn by_speed(&self) -> (f64, Vector, Vector, Vector) {
        let speed = self.speed();
        let over = |v: Vector| [v[0] / speed, v[1] / speed];
        (speed, over(self.first), over(self.second), over(self.third))
    }
}

/// The point of a Bézier curve, (0, 0) without control points; they are used up.
pub(crate) fn casteljau(p: &mut [Vector], t: f64) -> Vector {
    for last in (1..p.len()).rev() {
        for i in 0..last {
            p[i] = lerp(p[i], p[i + 1], t);
        }
    }
    p.first().copied().unwrap_or([0.0, 0.0])
}
