//! The arc of the involute with given Q and ω, in intervals.
//!
//! The involute `z(t) = (1 + it) e^(-it)`, run from `t0 - θ` to `t0 + θ`, has `Q = (θ² - sin² θ)/(θ² - t0²)` (4) and half
//! its chord is `X + iP = c e^(iω)` in a suitable frame, `X = t0 sin θ`, `P = sin θ - θ cos θ`; so θ is the root of
//! `F = cos ω P - sin ω X = c sin(ω(θ) - ω)`, where ω(θ) increases.

use super::shape::Shape;
use crate::num::Interval;
use crate::num::roots::{Curve, bracketed, enclose};
use std::f64::consts::{FRAC_PI_2, PI};

/// The equation for θ.
#[derive(Debug, Clone)]
pub(crate) struct Equation {
    /// |Q|, positive.
    q: Interval,
    /// ω, positive.
    omega: Interval,
    sin: Interval,
    cos: Interval,
}

/// The arc and what follows from θ.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    pub theta: Interval,
    pub sin: Interval,
    pub cos: Interval,
    /// P.
    pub p: Interval,
    /// `θ - sin θ cos θ`.
    pub a: Interval,
    pub t0: Interval,
}

impl Arc {
    fn new(theta: &Interval, q: &Interval) -> Option<Arc> {
        let (sin, cos) = theta.sine_cosine();
        let p = &sin - &(theta * &cos);
        let a = theta - &(&sin * &cos);
        let square = theta.square();
        let t0 = (&square + &(&square - &sin.square()).over(q)?).sqrt()?;
        Some(Arc { theta: theta.clone(), sin, cos, p, a, t0 })
    }
}

impl Equation {
    /// For `|Q|` and ω, both positive.
    pub fn new(q: Interval, omega: Interval) -> Equation {
        let (sin, cos) = omega.sine_cosine();
        Equation { q, omega, sin, cos }
    }

    /// The arc; `None` at too low a precision.
    pub fn solve(&self) -> Option<Arc> {
        let [low, high] = bracket(self.omega.approx()).map(|x| Interval::new(x, self.q.bits()));
        let guess = bracketed(&low, &high, self)?;
        Arc::new(&enclose(self, &guess)?, &self.q)
    }
}

impl Curve for Equation {
    fn at(&self, theta: &Interval) -> Option<(Interval, Interval)> {
        let Arc { sin, cos, p, a, t0, .. } = Arc::new(theta, &self.q)?;
        let value = &(&self.cos * &p) - &(&self.sin * &(&t0 * &sin));
        let rate = (theta + &a.over(&self.q)?).over(&t0)?;
        let slope = &(&self.cos * &(theta * &sin)) - &(&self.sin * &(&(&rate * &sin) + &(&t0 * &cos)));
        Some((value, slope))
    }

    fn guess(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let shape = Shape::new(theta, sin, cos);
        let t0 = (theta * theta + shape.w / self.q.approx()).sqrt();
        self.cos.approx() * shape.p - self.sin.approx() * t0 * sin
    }
}

/// Between which θ lies: with `i = ⌊ω/π⌋`, between the root θi of tan θ = θ and (i+1)π, or between that and θi+1, where ω(θ)
/// is iπ, iπ + π/2 and (i+1)π. The ends are moved outwards by more than their error.
pub(super) fn bracket(omega: f64) -> [f64; 2] {
    const SLACK: f64 = 1e-9;
    let turns = (omega / PI).floor();
    let middle = (turns + 1.0) * PI;
    // ω(θ) < θ/2 up to π, so that ω itself lies below.
    let below = if turns == 0.0 { omega } else { tangent_root(turns) - SLACK };
    if omega - turns * PI <= FRAC_PI_2 { [below, middle + SLACK] } else { [middle - SLACK, tangent_root(turns + 1.0) + SLACK] }
}

/// The root of tan θ = θ in (iπ, iπ + π/2), i >= 1: `θ = iπ + π/2 - atan(1/θ)` contracts by 1/(1 + θ²) < 1/20.
fn tangent_root(i: f64) -> f64 {
    let most = (i + 0.5) * PI;
    (0..12).fold(most, |theta, _| most - (1.0 / theta).atan())
}
