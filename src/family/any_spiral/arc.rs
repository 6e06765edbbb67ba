//! The arc of the involute with given Q and ω, in intervals (Kurnosenko, arXiv 2603.29596).
//!
//! The involute `z(t) = (1 + it) e^(-it)`, run from `t0 - θ` to `t0 + θ`, has `Q = (θ² - sin² θ)/(θ² - t0²)` (4) and
//! half its chord is `X + iP = c e^(iω)` in a suitable frame, `X = t0 sin θ`, `P = sin θ - θ cos θ`; so θ is the root
//! of `F = cos ω P - sin ω X = c sin(ω(θ) - ω)`, where ω(θ) increases.

use super::differences::Differences;
use crate::num::roots::{Curve, bracketed, enclose};
use crate::num::{Interval, formula};
use std::cell::Cell;
use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};

/// The equation for θ.
#[derive(Debug, Clone)]
pub(crate) struct Equation {
    /// |Q|, positive.
    q: Interval,
    /// ω less its half turns.
    rest: Interval,
    half_turns: u32,
    sin: Interval,
    cos: Interval,
    evaluations: Cell<usize>,
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
    /// `t0 - θ`.
    pub t1: Interval,
}

/// Below this θ the functions that cancel near 0 are summed as series.
const SERIES_BELOW: f64 = 0.0625;

/// `1 - y/r1 (1 - y/r2 (1 - ...))` for `0 <= y < 1/64` and ratios r >= 7.5 that grow: its terms alternate
/// and decrease, so that two sums in a
/// row enclose it.
fn series(y: &Interval, ratio: impl Fn(f64) -> f64) -> Interval {
    let (bits, mut k) = (y.bits(), 1.0);
    let tiny = Interval::power_of_two(-(bits as isize), bits);
    let (mut sum, mut term) = (Interval::new(1.0, bits), Interval::new(1.0, bits));
    loop {
        term = -&(&term * y).over(&Interval::new(ratio(k), bits)).expect("a positive ratio");
        let next = &sum + &term;
        if term.size().upper().compare(&tiny) != Some(Ordering::Greater) {
            return sum.union(&next);
        }
        (sum, k) = (next, k + 1.0);
    }
}

impl Arc {
    fn new(theta: &Interval, q: &Interval) -> Option<Arc> {
        let (sin, cos) = theta.sine_cosine();
        let square = theta.square();
        // P, A and `1 - sin² θ/θ²`: their series near 0, where a small θ would cost the precision of its square.
        let small = theta.compare(&Interval::new(SERIES_BELOW, theta.bits())) == Some(Ordering::Less);
        let (p, a, part) = if small {
            let third = (&square * theta).over(&Interval::new(3.0, theta.bits()))?;
            let rest = series(&square.scale(4.0), |k| (2.0 * k + 2.0) * (2.0 * k + 3.0));
            let w = series(&square, |k| (2.0 * k + 3.0) * (k + 2.0) * 0.5);
            let p = series(&square, |k| 2.0 * k * (2.0 * k + 3.0));
            (&third * &p, formula!(2.0 * (third * rest)), (&square * &w).over(&Interval::new(3.0, theta.bits()))?)
        } else {
            let part = (&square - &sin.square()).over(&square)?;
            (formula!(sin - theta * cos), formula!(theta - sin * cos), part)
        };
        // t0 = θ √(1 + g), and t1 = t0 - θ = θ g/(1 + √(1 + g)).
        let g = part.over(q)?;
        let root = g.plus(1.0).sqrt()?;
        let (t0, t1) = (theta * &root, theta * &g.over(&root.plus(1.0))?);
        Some(Arc { theta: theta.clone(), sin, cos, p, a, t0, t1 })
    }
}

impl Equation {
    /// For |Q|, positive, and `ω = rest + iπ` for i half turns, `|rest| < π`, positive in all.
    pub(super) fn new(q: Interval, rest: Interval, half_turns: u32) -> Equation {
        let (sin, cos) = rest.sine_cosine();
        let odd = half_turns % 2 == 1;
        let [sin, cos] = [sin, cos].map(|x| if odd { -&x } else { x });
        // From here on the rest is no longer negative.
        let (rest, half_turns) = match rest.sign() {
            Some(Ordering::Less) if half_turns > 0 => (&rest + &Interval::pi(rest.bits()), half_turns - 1),
            _ => (rest, half_turns),
        };
        Equation { q, rest, half_turns, sin, cos, evaluations: Cell::new(0) }
    }

    /// The arc; `None` at too low a precision.
    pub(super) fn solve(&self) -> Option<Arc> {
        let bits = self.q.bits();
        // ⌊ω/π⌋ hangs on the sign of the rest, which near Q = 0 moves θ far: rounding may not decide.
        self.rest.sign().filter(|s| s.is_ge())?;
        let [low, high] = bracket(f64::from(self.half_turns), self.rest.approx()).map(|x| Interval::new(x, bits));
        // ω itself is below θ up to π, and may be below the range of doubles.
        let low = if self.half_turns == 0 { self.rest.lower() } else { low };
        let guess = bracketed(&low, &high, self)?;
        Arc::new(&enclose(self, &guess)?, &self.q)
    }

    /// How often F was evaluated.
    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }
}

impl Curve for Equation {
    fn at(&self, theta: &Interval) -> Option<(Interval, Interval)> {
        self.evaluations.set(self.evaluations.get() + 1);
        let Arc { sin, cos, p, a, t0, .. } = Arc::new(theta, &self.q)?;
        let value = formula!(self.cos * p - self.sin * (t0 * sin));
        let rate = (theta + &a.over(&self.q)?).over(&t0)?;
        let slope = formula!(self.cos * (theta * sin) - self.sin * (rate * sin + t0 * cos));
        Some((value, slope))
    }

    /// For small θ, `ω = θ/3 / √(1 + θ²/(3|Q|))` up to a factor `1 + O(θ²)`.
    fn start(&self) -> Option<Interval> {
        if self.half_turns > 0 {
            return None;
        }
        let square = self.rest.square().middle();
        let room = formula!(self.q.middle() - 3.0 * square).over(&self.q.middle())?;
        let theta = square.scale(9.0).over(&room).filter(|x| x.sign() == Some(Ordering::Greater))?.sqrt()?.middle();
        (theta.compare(&Interval::new(SERIES_BELOW, theta.bits())) == Some(Ordering::Less)).then_some(theta)
    }

    fn guess(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let shape = Differences::new(theta, sin, cos);
        // t0 sin ω, by the quotient that may be moderate where both are not.
        let side = self.sin.approx();
        let steep = self.q.sqrt().and_then(|root| self.sin.over(&root)).map_or(0.0, |x| x.approx());
        let t0_sin = (theta * side).hypot(shape.w.sqrt() * steep).copysign(side);
        self.cos.approx() * shape.p - t0_sin * sin
    }
}

/// Between which θ lies, for `ω = iπ + rest` with `0 <= rest < π`: between the root θi of tan θ = θ and
/// (i+1)π, or between that and θi+1, where ω(θ)
/// is iπ, iπ + π/2 and (i+1)π. The ends are moved outwards by more than their error.
pub(super) fn bracket(turns: f64, rest: f64) -> [f64; 2] {
    const SLACK: f64 = 1e-9;
    let middle = (turns + 1.0) * PI;
    // ω(θ) < θ/2 up to π, so that ω itself lies below.
    let below = if turns == 0.0 { rest } else { tangent_root(turns) - SLACK };
    if rest <= FRAC_PI_2 { [below, middle + SLACK] } else { [middle - SLACK, tangent_root(turns + 1.0) + SLACK] }
}

/// The root of tan θ = θ in (iπ, iπ + π/2), i >= 1: `θ = iπ + π/2 - atan(1/θ)` contracts by 1/(1 + θ²) < 1/20.
fn tangent_root(i: f64) -> f64 {
    let most = (i + 0.5) * PI;
    (0..12).fold(most, |theta, _| most - (1.0 / theta).atan())
}
