//! One half of the curve, seen from its own end: no difference of nearly equal numbers is taken on the way.
//!
//! Let v be the parameter's distance from the end, where the parameter is T, and let `a(v) = ±(z(end) -
//! z(t)) e^(iT)` for the involute z. Then
//! the map is `z' = -σ + 2σ A/(2 + pA)` with `A = r e^(iγ) a`. At the start σ = 1, t = T + v, γ = α, `r =
//! ρ/c` and `p = 1 - 1/m`; at the end
//! σ = -1, t = T - v, γ = β, `r = 1/(ρc)` and `p = 1 - m`. This is the form (m(1 + z) - (1 - z))/(m(1 + z) + (1 - z))
//! divided by its end's dominant terms. In the expansion of the image's curvature in a, everything that cancels does so
//! in letters:
//!
//! `t k = T k(0) + σ qr h - qi sin v + r|q|²/4 (v² - 2h + 2σT(v - sin v))`, `q = p e^(iγ)`, `h = 1 - cos v`.
//!
//! # Units
//! All these numbers may be far outside the range of doubles. So v is measured by a unit s, the width of the
//! peak that the speed may have at the
//! end: `w = v/s`, and a by `s(s + T)`, with `r max(1, |q|) s(s + T) <= 2` and s <= 1, s <= θ. The divisor `2 + pA` is
//! measured by `n = (1 + w)(1 + εw)`, `ε = s/(s + T)`, which grows like a does. What is left are numbers of moderate
//! size: [`Half`] has nothing else.

use super::super::differences::Differences;
use crate::curve::vector::{Vector, add, cross, dot, length, scale, sub, turn};
use crate::num::roots::find;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The curve from one end to the middle of the parameter's range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Half {
    /// σ: 1 from the start, -1 from the end.
    pub side: f64,
    /// T.
    pub t: f64,
    /// θ, the largest v.
    pub theta: f64,
    /// `θ/s`, the largest w.
    pub reach: f64,
    /// `T/(s + T)`.
    pub near: f64,
    /// `ε = s/(s + T)`.
    pub far: f64,
    /// `r s(s + T)`.
    pub scale: f64,
    /// That times q.
    pub grow: Vector,
    /// γ.
    pub angle: f64,
    /// `|q| θ²/s`.
    pub bend: f64,
    /// `qr θ`.
    pub swing: f64,
    /// `qi`.
    pub sway: f64,
    /// k(0).
    pub curvature: f64,
}

/// A point of a half, without the turns of its direction.
pub(super) struct Place {
    pub point: Vector,
    /// Without twice the argument of the divisor.
    pub direction: f64,
    pub curvature: f64,
}

/// What a place is computed from.
struct Seen {
    v: f64,
    w: f64,
    /// `1/(1 + εw)`.
    shrink: f64,
    /// `t/(s + T)`.
    t: f64,
    sinc: f64,
    /// `h/v²`.
    h: f64,
    /// `a/(n s(s + T))`.
    a: Vector,
    /// `(2 + pA)/n`.
    divisor: Vector,
}

impl Half {
    /// For `u = v/θ`, from 0 to 1.
    fn seen(&self, u: f64) -> Seen {
        let Half { side, near, far, grow, .. } = *self;
        let (v, w) = (self.theta * u, self.reach * u);
        let ratio = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
        let (sinc, half) = (ratio(v), ratio(0.5 * v));
        let h = 0.5 * half * half;
        let p = Differences::p_by_powers(v);
        let shrink = 1.0 / (1.0 + far * w);
        let a = [side * far * w * (sinc - h) + near * sinc, -v * (p * far * w + side * near * h)]
            .map(|x| w / (1.0 + w) * shrink * x);
        let divisor = add([2.0 / (1.0 + w) * shrink, 0.0], turn(grow, a));
        Seen { v, w, shrink, t: near + side * far * w, sinc, h, a, divisor }
    }

    /// The place at `u = v/θ`, from 0 to 1.
    pub(super) fn at(&self, u: f64) -> Place {
        let Half { side, near, far, angle, curvature, .. } = *self;
        if u == 0.0 {
            return Place { point: [-side, 0.0], direction: angle, curvature };
        }
        let Seen { v, w, t, sinc, h, a, divisor, .. } = self.seen(u);
        let (sin_angle, cos_angle) = angle.sin_cos();
        // 2σ A / divisor.
        let [x, y] = turn(turn([cos_angle, sin_angle], a), [divisor[0], -divisor[1]])
            .map(|x| 2.0 * side * self.scale * x / dot(divisor, divisor));
        // (v² - 2h)/v⁴ = (v² - 4 sin²(v/2))/v⁴.
        let square = 0.25 * Differences::others_by_powers(0.5 * v)[0];
        let last =
            0.25 * length(self.grow) * (square * far * w + 2.0 * side * near * Differences::others_by_powers(v)[1]);
        let bend = self.bend * u * u * (w * far * (last / t));
        let turning = side * self.swing * u * h - self.sway * sinc;
        Place {
            point: [x - side, y],
            direction: angle - side * v,
            curvature: (near * curvature + turning * far * w) / t + bend,
        }
    }

    /// Length for each unit of `y = ln(1 + w)`, and how far rounding may move it: about 8 units of the divisor's terms,
    /// twice. `grown` is the length of [`Half::grow`], for all.
    pub(super) fn speed(&self, u: f64, grown: f64) -> [f64; 2] {
        let Seen { w, shrink, t, divisor, .. } = self.seen(u);
        let size = length(divisor);
        let speed = 4.0 * self.scale * t * (shrink / size).powi(2) / (1.0 + w);
        let terms = (2.0 / (1.0 + w) + 2.0 * grown * t * w / (1.0 + w)) * shrink;
        [speed, speed * 16.0 * f64::EPSILON * terms / size]
    }

    /// Size of dκ/ds. Möbius maps keep `κ' ds²`, and for the involute that is `dt²/t`: its curvature is -1/t, and its
    /// speed t. So it is `(dt/ds)²/t`, with `dt = s(1 + w) dy` and `t = (s + T)` times what is seen. It has twice the
    /// roundings of the speed.
    pub(super) fn rate(&self, u: f64) -> f64 {
        let Seen { w, t, .. } = self.seen(u);
        let [speed, _] = self.speed(u, 0.0);
        let unit = self.theta / self.reach;
        unit * (self.far / t) * ((1.0 + w) / speed).powi(2)
    }

    /// Direction at u, followed from the end.
    #[cfg(test)]
    pub(super) fn direction(&self, u: f64) -> f64 {
        self.angle - self.side * self.theta * u - 2.0 * self.argument(u)
    }

    /// The argument of the divisor, followed from 0 at the end: its value up to full turns, and their number.
    pub(super) fn argument(&self, u: f64) -> f64 {
        let [x, y] = self.seen(u).divisor;
        let principal = y.atan2(x);
        if self.theta * u < FRAC_PI_2 { self.on_short_arc(u, principal) } else { self.on_long_arc(u, principal) }
    }

    /// The divisor runs along an arc that turns by v < π/2 only, clockwise for σ = 1. Its argument changes
    /// as along the chord of that arc,
    /// unless 0 lies between both. Then the chord has it within v of a half turn, on the arc's side.
    fn on_short_arc(&self, u: f64, principal: f64) -> f64 {
        if self.side * principal < PI - self.theta * u {
            return principal;
        }
        // The arc goes forward along the chord; where it passes 0 decides on which side.
        let end = self.seen(u).divisor;
        let chord = sub(end, [self.seen(u).shrink * 2.0 / (1.0 + self.reach * u), 0.0]);
        let y = find(|y| dot(self.seen(self.share(y)).divisor, chord), 0.0, self.stretched(u), 1e-15);
        let beyond = self.side * cross(chord, self.seen(self.share(y)).divisor) > 0.0;
        if beyond { principal - self.side * TAU } else { principal }
    }

    /// The divisor is `z(t) - W` for the pole W, up to a factor. With `z = (1 + it) e^(-it)`, the argument
    /// of `z - W` is that of z and of `1 - W/z`
    /// where `|z| > |W|`, and that of -W and of `1 - z/W` where `|z| < |W|`; the second of each keeps within
    /// a quarter turn. |z| grows with t, so
    /// that there is at most one passage, at `t = √(|W|² - 1)`, and there z/W alone gives both. So only the
    /// number of turns is found here.
    fn on_long_arc(&self, u: f64, principal: f64) -> f64 {
        let Half { side, t: end, theta, grow, .. } = *self;
        let s = theta / self.reach;
        let (v, t) = (theta * u, end + side * theta * u);
        // z - W, each in the frame of z(T) and in a unit that is no less than |z|, about.
        let unit = end + theta;
        let away =
            |divisor: Vector, by: f64| scale(turn(divisor, [grow[0], -grow[1]]), side * (by / unit) / dot(grow, grow));
        let first = away([2.0, 0.0], s * (s + end));
        let last = away(self.seen(u).divisor, (s + v) * (s + end + v));
        let (sin, cos) = (side * v).sin_cos();
        let z = [[1.0 / unit, end / unit], turn([1.0 / unit, t / unit], [cos, -sin])];
        let pole = sub(z[0], first);
        let over = |a: Vector, b: Vector| scale(turn(a, [b[0], -b[1]]), 1.0 / dot(b, b));
        let around = |x: Vector| x[1].atan2(x[0]);
        let share = [over(first, z[0]), over(last, z[1])];
        // |z| > |W|, by x = (z - W)/z: |1 - x| < 1.
        let [from_outside, to_outside] = share.map(|x| 2.0 * x[0] > dot(x, x));
        let outside = share.map(around);
        let inside = [first, last].map(|d| around(over(scale(d, -1.0), pole)));
        // The argument of z(t) less that of z(T): atan t - atan T less the turn of t.
        let winding = |ahead: f64| (ahead / (1.0 + end * (end + ahead))).atan() - ahead;
        // At the passage, t² - T² = |W|² - |z(T)|².
        let squares = dot(first, first) - 2.0 * dot(z[0], first);
        let first_t = end / unit;
        let passage = winding(unit * squares / (first_t + (first_t * first_t + squares).max(0.0).sqrt()));
        // From the inside to the outside.
        let step = (passage - around(over(pole, z[0]))).rem_euclid(TAU) - PI;
        let followed = match (from_outside, to_outside) {
            (true, true) => winding(side * v) + outside[1] - outside[0],
            (false, false) => inside[1] - inside[0],
            (false, true) => winding(side * v) - passage + step + outside[1] - inside[0],
            (true, false) => passage - step + inside[1] - outside[0],
        };
        let turns = ((followed - principal) / TAU).round();
        // Without a pole (q = 0) there is no turn.
        if turns.is_finite() { principal + TAU * turns } else { principal }
    }

    /// `y = ln(1 + w)`.
    pub(super) fn stretched(&self, u: f64) -> f64 {
        (self.reach * u).ln_1p()
    }

    /// u for y.
    pub(super) fn share(&self, y: f64) -> f64 {
        (y.exp_m1() / self.reach).min(1.0)
    }
}
