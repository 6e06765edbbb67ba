//! Quintic trigonometric Bézier curves in any frame.

use crate::curve::Jet;
use crate::curve::length::arc_length;
use crate::curve::vector::{Vector, add, scale};
use crate::error::{Error, Result};
use serde::{Serialize, Serializer};
use std::f64::consts::FRAC_PI_2;

/// `z(t) = Σ Pi gi(t)`, t in [0, 1]: (1), (2) of Misro, Ramli and Ali. Kept as its start and the sides of its polygon,
/// so that nothing is lost far from the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrigBezier {
    /// P0.
    pub start: [f64; 2],
    /// `P(i+1) - Pi`.
    pub sides: [[f64; 2]; 5],
    /// Shape parameter of the start, in [-4, 1].
    pub p: f64,
    /// Shape parameter of the end.
    pub q: f64,
}

/// As p, q, its control points and, as `legs`, the sides of their polygon.
impl Serialize for TrigBezier {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Fields {
            p: f64,
            q: f64,
            control_points: [[f64; 2]; 6],
            legs: [[f64; 2]; 5],
        }
        Fields { p: self.p, q: self.q, control_points: self.points(), legs: self.sides }.serialize(serializer)
    }
}

/// A function of the angle `πt/2` and its first two derivatives.
#[derive(Clone, Copy)]
struct Rates([f64; 3]);

impl Rates {
    fn times(self, other: Rates) -> Rates {
        let (Rates([a, a1, a2]), Rates([b, b1, b2])) = (self, other);
        Rates([a * b, a1 * b + a * b1, a2 * b + 2.0 * a1 * b1 + a * b2])
    }

    /// `constant + factor self`.
    fn linear(self, factor: f64, constant: f64) -> Rates {
        let Rates([a, a1, a2]) = self;
        Rates([factor * a + constant, factor * a1, factor * a2])
    }

    fn plus(self, other: Rates) -> Rates {
        Rates(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    fn power(self, n: u32) -> Rates {
        (1..n).fold(self, |product, _| product.times(self))
    }
}

/// Sine and cosine of the angle, `1 - C`, `1 - S` and `S + C - 1`, each without cancellation.
struct Angle {
    s: Rates,
    c: Rates,
    less_c: Rates,
    less_s: Rates,
    over: Rates,
}

impl Angle {
    fn at(t: f64) -> Angle {
        let half = |t: f64| (0.5 * FRAC_PI_2 * t).sin();
        let (from, to) = (half(t), half(1.0 - t));
        let (s, c) = ((FRAC_PI_2 * t).sin(), (FRAC_PI_2 * (1.0 - t)).sin());
        // 1 - C = 2 sin²(φ/2), and S + C - 1 = 2√2 sin(φ/2) sin(π/4 - φ/2).
        Angle {
            s: Rates([s, c, -s]),
            c: Rates([c, -s, -c]),
            less_c: Rates([if t < 0.5 { 2.0 * from * from } else { 1.0 - c }, s, c]),
            less_s: Rates([if t > 0.5 { 2.0 * to * to } else { 1.0 - s }, -c, s]),
            over: Rates([8f64.sqrt() * from * to, c - s, -s - c]),
        }
    }
}

impl TrigBezier {
    /// From six control points.
    ///
    /// # Errors
    /// [`Error::Domain`] for a point that is not finite, or p or q outside [-4, 1].
    pub fn new(points: [[f64; 2]; 6], p: f64, q: f64) -> Result<TrigBezier> {
        for (name, value) in [("p", p), ("q", q)] {
            if !(-4.0..=1.0).contains(&value) {
                return Err(Error::domain(name, value, "-4 to 1"));
            }
        }
        if let Some([x, y]) = points.iter().find(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(Error::invalid(format!("a control point is ({x}, {y}); it must be finite")));
        }
        let sides = std::array::from_fn(|i| [points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]]);
        Ok(TrigBezier { start: points[0], sides, p, q })
    }

    /// The control points.
    pub fn points(&self) -> [[f64; 2]; 6] {
        let mut at = self.start;
        let mut sides = self.sides.iter();
        std::array::from_fn(|i| {
            if i > 0 {
                at = add(at, *sides.next().unwrap_or(&[0.0, 0.0]));
            }
            at
        })
    }

    /// The basis functions `g0 .. g5` at t: (2).
    pub fn basis(p: f64, q: f64, t: f64) -> [f64; 6] {
        let [s, c, less_c, less_s] = {
            let Angle { s, c, less_c, less_s, .. } = Angle::at(t);
            [s, c, less_c, less_s].map(|r| r.0[0])
        };
        [
            less_s.powi(4) * (1.0 - p * s),
            s * less_s.powi(3) * (4.0 + p * less_s),
            less_s * less_s * less_c * (8.0 * s + 3.0 * c + 9.0),
            less_c * less_c * less_s * (8.0 * c + 3.0 * s + 9.0),
            c * less_c.powi(3) * (4.0 + q * less_c),
            less_c.powi(4) * (1.0 - q * c),
        ]
    }

    /// Point and derivatives at t; the point is exact at 0 and that of [`TrigBezier::points`] at 1.
    pub fn jet(&self, t: f64) -> Jet {
        let angle = Angle::at(t);
        let (weights, rates) = (sums(self.p, self.q, &angle), rates(self.p, self.q, &angle));
        let combine = |weight: &dyn Fn(usize) -> f64| -> Vector {
            self.sides.iter().enumerate().fold([0.0, 0.0], |sum, (i, side)| add(sum, scale(*side, weight(i))))
        };
        let of = |order: usize| {
            let factor = FRAC_PI_2.powi(order as i32 + 1);
            combine(&|i| factor * rates[i].0[order])
        };
        Jet { point: add(self.start, combine(&|i| weights[i])), first: of(0), second: of(1), third: of(2) }
    }

    /// The speed at t, as [`TrigBezier::jet`] has it to a few roundings, in half the time.
    pub(crate) fn speed(&self, t: f64) -> f64 {
        let half = |t: f64| (0.5 * FRAC_PI_2 * t).sin_cos();
        let ((from, from_c), (to, to_c)) = (half(t), half(1.0 - t));
        let (s, c) = (2.0 * from * from_c, 2.0 * to * to_c);
        let less_c = if t < 0.5 { 2.0 * from * from } else { 1.0 - c };
        let less_s = if t > 0.5 { 2.0 * to * to } else { 1.0 - s };
        let over = 8f64.sqrt() * from * to;
        let weights = [
            c * (less_s * less_s * less_s) * (4.0 + self.p - 5.0 * self.p * s),
            12.0 * s * c * (less_s * less_s),
            less_s * less_c * over * (16.0 * (s + c) + 18.0),
            12.0 * s * c * (less_c * less_c),
            s * (less_c * less_c * less_c) * (4.0 + self.q - 5.0 * self.q * c),
        ];
        let sum = self.sides.iter().zip(weights).fold([0.0, 0.0], |sum, (side, w)| add(sum, scale(*side, w)));
        FRAC_PI_2 * sum[0].hypot(sum[1])
    }

    /// Arc length from parameter `from` to parameter `to`, to 1e-13 relative.
    pub fn length_between(&self, from: f64, to: f64) -> f64 {
        arc_length(|t| self.jet(t).speed(), from, to)
    }

    /// The same curve run backwards: control points in reverse order, p and q exchanged.
    pub fn reversed(&self) -> TrigBezier {
        let mut sides = self.sides.map(|side| scale(side, -1.0));
        sides.reverse();
        TrigBezier { start: self.points()[5], sides, p: self.q, q: self.p }
    }

    /// The image under a linear map, moved so that it starts at `start`.
    pub fn mapped(&self, start: [f64; 2], map: impl Fn([f64; 2]) -> [f64; 2]) -> TrigBezier {
        TrigBezier { start, sides: self.sides.map(map), ..*self }
    }
}

/// `G0 .. G4`, what each side is multiplied with: `Gi = g(i+1) + .. + g5`.
fn sums(p: f64, q: f64, angle: &Angle) -> [f64; 5] {
    let [s, c, less_c, less_s] = [angle.s, angle.c, angle.less_c, angle.less_s].map(|r| r.0[0]);
    let tail = less_c.powi(3) * (1.0 + 3.0 * c);
    [
        1.0 - less_s.powi(4) * (1.0 - p * s),
        1.0 - less_s.powi(3) * (1.0 + 3.0 * s),
        less_c * less_c * less_s * (8.0 * c + 3.0 * s + 9.0) + tail,
        tail,
        less_c.powi(4) * (1.0 - q * c),
    ]
}

/// Their derivatives by the angle, with two derivatives of these.
fn rates(p: f64, q: f64, angle: &Angle) -> [Rates; 5] {
    let Angle { s, c, less_c, less_s, over } = *angle;
    let both = s.times(c).linear(12.0, 0.0);
    [
        c.times(less_s.power(3)).times(s.linear(-5.0 * p, 4.0 + p)),
        both.times(less_s.power(2)),
        less_s.times(less_c).times(over).times(s.plus(c).linear(16.0, 18.0)),
        both.times(less_c.power(2)),
        s.times(less_c.power(3)).times(c.linear(-5.0 * q, 4.0 + q)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_is_that_of_the_jet() {
        let sides = [[0.2, 0.1], [-0.3, 0.4], [0.5, -0.7], [0.3, 0.3], [-0.6, 0.2]];
        let curve = TrigBezier { start: [1.0, 2.0], sides, p: 0.7, q: -3.2 };
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            let (got, want) = (curve.speed(t), curve.jet(t).speed());
            assert!((got - want).abs() < 1e-13, "{t} {got} {want}");
        }
    }
}
