//! One half of the curve, seen from its own end: no difference of nearly equal numbers is taken on the way.
//!
//! With v the parameter's distance from the end where it is T, `a(v) = ±(z(end) - z(t)) e^(iT)` for the involute z, the map is
//! `z' = -σ + 2σ A/(2 + pA)`, `A = r e^(iγ) a`: σ = 1 at the start, where t = T + v, γ = α, `r = ρ/c`, `p = 1 - 1/m`, and σ = -1
//! at the end, where t = T - v, γ = β, `r = 1/(ρc)`, `p = 1 - m`. This is the form (m(1 + z) - (1 - z))/(m(1 + z) + (1 - z))
//! divided by its end's dominant terms. Expanding the curvature of the image in a, everything that cancels does so in letters:
//!
//! `t k = T k(0) + σ qr h - qi sin v + r|q|²/4 (v² - 2h + 2σT(v - sin v))`, `q = p e^(iγ)`, `h = 1 - cos v`.

use super::super::shape::Shape;
use crate::curve::vector::{Vector, add, cross, dot, length, turn};

/// The curve from one end to the middle of the parameter's range.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub(super) struct Half {
    /// 1 from the start, -1 from the end.
    pub side: f64,
    /// T.
    pub t: f64,
    /// r.
    pub scale: f64,
    /// γ.
    pub angle: f64,
    /// q.
    pub q: Vector,
    /// k(0).
    pub curvature: f64,
}

/// A point of a half, without the turns of its direction.
pub(super) struct Place {
    pub point: Vector,
    /// Without twice the argument of [`Place::divisor`].
    pub direction: f64,
    /// `2 + pA`.
    pub divisor: Vector,
    pub curvature: f64,
    /// Arc length for each unit of v.
    pub speed: f64,
}

impl Half {
    /// The place v >= 0 from the end.
    pub fn at(&self, v: f64) -> Place {
        let Half { side, t: end, scale, angle, q, curvature } = *self;
        let ((sin, cos), sin_half) = (v.sin_cos(), (0.5 * v).sin());
        let h = 2.0 * sin_half * sin_half;
        let whole = Shape::new(v, sin, cos);
        // v² - 2h = v² - 4 sin²(v/2).
        let square = 4.0 * Shape::new(0.5 * v, sin_half, (0.5 * v).cos()).w;
        let a = [side * (v * sin - h) + end * sin, -whole.p - side * end * h].map(|x| scale * x);
        let divisor = add([2.0, 0.0], turn(q, a));
        let size = dot(divisor, divisor);
        let t = end + side * v;
        let (sin_angle, cos_angle) = angle.sin_cos();
        // 2σ A / divisor.
        let [x, y] = turn(turn([cos_angle, sin_angle], a), [divisor[0], -divisor[1]]).map(|x| 2.0 * side * x / size);
        let bend = 0.25 * scale * dot(q, q) * (square + 2.0 * side * end * whole.rest);
        Place {
            point: [x - side, y],
            direction: angle - side * v,
            divisor,
            curvature: (end * curvature + side * q[0] * h - q[1] * sin + bend) / t,
            speed: scale * t * 4.0 / size,
        }
    }

    /// The argument of `2 + pA`, followed from 0 at the end to v: steps are so short that it cannot turn unseen.
    pub fn argument(&self, v: f64) -> f64 {
        let most = length(self.q) * self.scale * (self.t + if self.side > 0.0 { v } else { 0.0 });
        let (mut here, mut divisor, mut sum) = (0.0, [2.0, 0.0], 0.0);
        while here < v {
            let next = (here + 0.5 * length(divisor) / most).min(v);
            // Through the point at infinity: no doubles in between.
            if next <= here {
                break;
            }
            let ahead = self.at(next).divisor;
            sum += cross(divisor, ahead).atan2(dot(divisor, ahead));
            (here, divisor) = (next, ahead);
        }
        sum
    }
}
