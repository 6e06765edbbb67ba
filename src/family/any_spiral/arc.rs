//! The arc of the involute with given Q and ω, in sums of two doubles and in intervals (Kurnosenko, arXiv 2603.29596).
//!
//! The involute `z(t) = (1 + it) e^(-it)`, run from `t0 - θ` to `t0 + θ`, has `Q = (θ² - sin² θ)/(θ² - t0²)` (4) and
//! half its chord is `X + iP = c e^(iω)` in a suitable frame, `X = t0 sin θ`, `P = sin θ - θ cos θ`; so θ is the root
//! of `F = cos ω P - sin ω X = c sin(ω(θ) - ω)`, where ω(θ) increases.

use super::differences::Differences;
use crate::num::roots::{Curve, bracketed, enclose, find, near};
use crate::num::{Angle, Interval, Number, Real, Twin, formula};
use std::cell::Cell;
use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};

/// The equation for θ.
#[derive(Debug, Clone)]
pub(crate) struct Equation<N> {
    /// |Q|, positive.
    q: N,
    /// ω less its half turns.
    rest: N,
    half_turns: u32,
    sin: N,
    cos: N,
    /// sin ω, cos ω and sin ω/√|Q|, about: what guesses are made of.
    about: [f64; 3],
    evaluations: Cell<usize>,
}

/// The arc and what follows from θ.
#[derive(Debug, Clone)]
pub(crate) struct Arc<N> {
    pub theta: N,
    pub sin: N,
    pub cos: N,
    /// P.
    pub p: N,
    /// `θ - sin θ cos θ`.
    pub a: N,
    pub t0: N,
    /// `t0 - θ`.
    pub t1: N,
}

/// Below this θ the functions that cancel near 0 are summed as series.
const SERIES_BELOW: f64 = 0.0625;

/// `1 - y/r1 (1 - y/r2 (1 - ...))` for `0 <= y < 1/64` and ratios r >= 7.5 that grow: its terms alternate
/// and decrease, so that two sums in a
/// row enclose it.
fn series<N: Angle>(y: &N, ratio: impl Fn(f64) -> f64) -> N {
    let (bits, mut k) = (y.bits(), 1.0);
    let tiny = N::power_of_two(-(bits as i32), bits);
    let (mut sum, mut term) = (N::of(1.0, bits), N::of(1.0, bits));
    loop {
        term = formula!(-(term * y)).over(&N::of(ratio(k), bits)).expect("a positive ratio");
        let next = formula!(sum + term);
        if tiny.sub(&term.size()).is_positive() {
            return sum.union(&next);
        }
        (sum, k) = (next, k + 1.0);
    }
}

impl<N: Angle> Arc<N> {
    fn new(theta: &N, q: &N) -> Option<Arc<N>> {
        let (sin, cos) = theta.sine_cosine();
        let (square, three) = (formula!(theta * theta), N::of(3.0, theta.bits()));
        // P, A and `1 - sin² θ/θ²`: their series near 0, where a small θ would cost the precision of its square.
        let (p, a, part) = if theta.most() < SERIES_BELOW {
            let third = formula!(square * theta).over(&three)?;
            let rest = series(&square.times(4.0), |k| (2.0 * k + 2.0) * (2.0 * k + 3.0));
            let w = series(&square, |k| (2.0 * k + 3.0) * (k + 2.0) * 0.5);
            let p = series(&square, |k| 2.0 * k * (2.0 * k + 3.0));
            (third.mul(&p), formula!(2.0 * (third * rest)), square.mul(&w).over(&three)?)
        } else {
            let part = formula!(square - sin * sin).over(&square)?;
            (formula!(sin - theta * cos), formula!(theta - sin * cos), part)
        };
        // t0 = θ √(1 + g), and t1 = t0 - θ = θ g/(1 + √(1 + g)).
        let g = part.over(q)?;
        let root = g.plus(1.0).sqrt()?;
        let (t0, t1) = (formula!(theta * root), theta.mul(&g.over(&root.plus(1.0))?));
        Some(Arc { theta: theta.clone(), sin, cos, p, a, t0, t1 })
    }
}

impl<N: Angle> Equation<N> {
    /// For |Q|, positive, and `ω = rest + iπ` for i half turns, `|rest| < π`, positive in all.
    pub(super) fn new(q: N, rest: N, half_turns: u32) -> Equation<N> {
        let (sin, cos) = rest.sine_cosine();
        let odd = half_turns % 2 == 1;
        let [sin, cos] = [sin, cos].map(|x| if odd { x.times(-1.0) } else { x });
        // From here on the rest is no longer negative.
        let (rest, half_turns) = match rest.certain_sign(0.0) {
            Some(Ordering::Less) if half_turns > 0 => (rest.add(&N::pi(rest.bits())), half_turns - 1),
            _ => (rest, half_turns),
        };
        let steep = q.sqrt().and_then(|root| sin.over(&root)).map_or(0.0, |x| x.approx());
        let about = [sin.approx(), cos.approx(), steep];
        Equation { q, rest, half_turns, sin, cos, about, evaluations: Cell::new(0) }
    }

    /// F and its slope.
    fn values(&self, theta: &N) -> Option<(N, N)> {
        self.evaluations.set(self.evaluations.get() + 1);
        let Arc { sin, cos, p, a, t0, .. } = Arc::new(theta, &self.q)?;
        let value = formula!(self.cos * p - self.sin * (t0 * sin));
        let rate = theta.add(&a.over(&self.q)?).over(&t0)?;
        let slope = formula!(self.cos * (theta * sin) - self.sin * (rate * sin + t0 * cos));
        Some((value, slope))
    }

    /// F, about.
    fn about(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let shape = Differences::new(theta, sin, cos);
        let [sin_omega, cos_omega, steep] = self.about;
        // t0 sin ω, by the quotient that may be moderate where both are not.
        let t0_sin = (theta * sin_omega).hypot(shape.w.sqrt() * steep).copysign(sin_omega);
        cos_omega * shape.p - t0_sin * sin
    }

    /// How often F was evaluated.
    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }
}

impl Equation<Twin> {
    /// The arc; `None` where two doubles do not suffice.
    pub(super) fn solve(&self) -> Option<Arc<Twin>> {
        self.rest.is_positive().then_some(())?;
        let [low, high] = bracket(f64::from(self.half_turns), self.rest.approx());
        let theta = near(|x| self.values(x), find(|x| self.about(x), low, high, low * 2f64.powi(-46)))?;
        // F has no other root in the bracket.
        (theta.plus(-low).is_positive() && theta.plus(-high).times(-1.0).is_positive()).then_some(())?;
        Arc::new(&theta, &self.q)
    }
}

impl Equation<Interval> {
    /// The arc; `None` at too low a precision.
    pub(super) fn solve(&self) -> Option<Arc<Interval>> {
        let bits = self.q.bits();
        // ⌊ω/π⌋ hangs on the sign of the rest, which near Q = 0 moves θ far: rounding may not decide.
        self.rest.sign().filter(|s| s.is_ge())?;
        let [low, high] = bracket(f64::from(self.half_turns), self.rest.approx()).map(|x| Interval::new(x, bits));
        // ω itself is below θ up to π, and may be below the range of doubles.
        let low = if self.half_turns == 0 { self.rest.lower() } else { low };
        let guess = bracketed(&low, &high, self)?;
        Arc::new(&enclose(self, &guess)?, &self.q)
    }
}

impl Curve for Equation<Interval> {
    fn at(&self, theta: &Interval) -> Option<(Interval, Interval)> {
        self.values(theta)
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
        self.about(theta)
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
