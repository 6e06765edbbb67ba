//! From two ends to the curve.

use super::super::arc::{Arc, Equation};
use super::super::exact::Datum;
use super::half::Half;
use super::turns::{Split, range};
use super::{Chord, Outcome, Spiral, WhyNone};
use crate::curve::arc_length;
use crate::error::{Error, Result};
use crate::num::roots::find;
use crate::num::{Interval, climb};
use serde::Serialize;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::f64::consts::{PI, TAU};

/// The image of an arc of the involute, in the chord's frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Involute {
    theta: f64,
    beyond: f64,
    t0: f64,
    rho: f64,
    lambda: f64,
    turns: [u32; 2],
    /// Whether the curvature decreases; then what follows describes the mirror image.
    mirrored: bool,
    #[serde(skip)]
    halves: [Half; 2],
    #[serde(skip)]
    length: f64,
}

/// A point of the curve, in half chords.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct InvolutePoint {
    /// Parameter, 0 to 1: the involute's own, from end to end.
    pub f: f64,
    /// The point; the ends are (-1, 0) and (1, 0).
    pub point: [f64; 2],
    /// Direction, radians, followed along the curve from α and 2π for each turn about the start.
    pub direction: f64,
    /// Signed curvature.
    pub curvature: f64,
}

/// All numbers that the curve is made of, rounded from intervals.
struct Numbers {
    theta: f64,
    beyond: f64,
    t0: f64,
    t1: f64,
    t2: f64,
    rho: f64,
    lambda: f64,
    /// ρ/c and 1/(ρc).
    scales: [f64; 2],
    /// `(1 - 1/m) e^(iα)` and `(1 - m) e^(iβ)`.
    q: [[f64; 2]; 2],
}

pub(super) fn solve(chord: &Chord, turns: [u32; 2]) -> Result<Spiral> {
    let rising = chord.k1 < chord.k2;
    let datum = if rising { chord.datum() } else { chord.datum().mirrored() };
    // Half-open ranges: what the mirror image has at -π is π.
    let cuts = [datum.alpha, datum.beta].iter().filter(|x| **x == -PI).count();
    let half_turns = turns[0] + turns[1] + cuts as u32;
    let total = |bits: usize| &datum.omega(bits) + &Interval::pi(bits).scale(f64::from(half_turns));
    // Never 0 but where both parts are: π is irrational.
    let side = if half_turns == 0 && datum.alpha == -datum.beta { Equal } else { climb(&datum, "omega", |b| total(b).sign())?.0 };
    let sign = climb(&datum, "the sign of Q", |bits| datum.q(bits).sign())?.0;
    let (q, _) = climb(&datum, "Q", |bits| datum.q(bits).to_f64())?;
    let mirror = if rising { 1.0 } else { -1.0 };
    let omega = mirror * total(128).approx();
    let answer = |outcome| Spiral { chord: *chord, turns, q, omega, outcome };
    let why = match (side, sign) {
        _ if chord.k1 == chord.k2 => WhyNone::SameCurvature,
        (Less | Equal, _) => WhyNone::WrongSide,
        (_, Greater) => WhyNone::CirclesCross,
        (_, Equal) => WhyNone::CirclesTouch,
        (Greater, Less) => {
            let (numbers, _) = climb(&datum, "the arc of the involute", |bits| Numbers::new(&datum, total(bits), bits))?;
            let curve = Involute::new(&datum, &numbers, turns[0] + turns[1], !rising);
            let split = split(&datum, turns, &curve);
            return Ok(answer(Outcome::Curve { curve, split }));
        }
    };
    Ok(answer(Outcome::None(why)))
}

fn split(datum: &Datum, turns: [u32; 2], curve: &Involute) -> Split {
    let Datum { alpha, beta, k1, k2 } = *datum;
    let up = |x: f64| if x == -PI { PI } else { x };
    let (least, most) = range(&Chord { alpha: up(alpha), beta: up(beta), k1, k2 }, turns[0] + turns[1]);
    if curve.turns == turns {
        Split::Asked
    } else if (least..=most).contains(&turns[0]) {
        Split::Other
    } else {
        Split::Impossible { least, most }
    }
}

/// Whether a number is known to 80 bits.
fn thin(x: &Interval) -> bool {
    let width = &x.upper() - &x.lower();
    let allowed = &x.size().upper() * &Interval::power_of_two(-80, x.bits());
    width.compare(&allowed) == Some(Less)
}

impl Numbers {
    fn new(datum: &Datum, omega: Interval, bits: usize) -> Option<Numbers> {
        let q = datum.q(bits);
        let Arc { theta, sin, cos: _, p, a, t0 } = Equation::new(-&q, omega.clone()).solve()?;
        let (t1, t2) = (&t0 - &theta, &t0 + &theta);
        let half_chord = (&(&t0 * &sin).square() + &p.square()).sqrt()?;
        // ρ = (k1* + sin α*)/(k1 + sin α), both negative.
        let ((sin0, cos0), (sin1, cos1)) = (Interval::sin_cos(datum.alpha, bits), Interval::sin_cos(datum.beta, bits));
        let room = -&(&Interval::new(datum.k1, bits) + &sin0);
        let rho = (&(&t0 * &a) + &(&p * &sin)).over(&(&(&half_chord * &t1) * &room))?;
        // λ = α - α*, α* = ω + θ; any full turns do.
        let lambda = &Interval::new(datum.alpha, bits) - &(&omega + &theta);
        let (sin_l, cos_l) = lambda.sine_cosine();
        if ![&theta, &t1, &rho, &half_chord].into_iter().all(thin) {
            return None;
        }
        let one = Interval::new(1.0, bits);
        let inverse = one.over(&rho)?;
        let times = |a: [&Interval; 2], b: [&Interval; 2]| {
            [&(a[0] * b[0]) - &(a[1] * b[1]), &(a[0] * b[1]) + &(a[1] * b[0])].map(|x| x.approx())
        };
        let at_start = [&one - &(&inverse * &cos_l), &inverse * &sin_l];
        let at_end = [&one - &(&rho * &cos_l), -&(&rho * &sin_l)];
        // θ from the nearest multiple of π.
        let turns = (theta.approx() / PI).round();
        let beyond = &theta - &Interval::pi(bits).scale(turns);
        Some(Numbers {
            theta: theta.approx(),
            beyond: beyond.approx(),
            t0: t0.approx(),
            t1: t1.approx(),
            t2: t2.approx(),
            rho: rho.approx(),
            lambda: lambda.approx(),
            scales: [rho.over(&half_chord)?.approx(), inverse.over(&half_chord)?.approx()],
            q: [times([&at_start[0], &at_start[1]], [&cos0, &sin0]), times([&at_end[0], &at_end[1]], [&cos1, &sin1])],
        })
    }
}

impl Involute {
    fn new(datum: &Datum, n: &Numbers, turns: u32, mirrored: bool) -> Involute {
        let start = Half { side: 1.0, t: n.t1, scale: n.scales[0], angle: datum.alpha, q: n.q[0], curvature: datum.k1 };
        let end = Half { side: -1.0, t: n.t2, scale: n.scales[1], angle: datum.beta, q: n.q[1], curvature: datum.k2 };
        let Numbers { theta, beyond, t0, rho, lambda, .. } = *n;
        let mut curve = Involute { theta, beyond, t0, rho, lambda, turns: [0, 0], mirrored, halves: [start, end], length: 0.0 };
        // Both halves have the same direction where they meet, which tells the difference of the turns.
        let meet = [start, end].map(|half| half.direction(theta));
        let up = |x: f64| if x == -PI { 1.0 } else { 0.0 };
        let difference = (meet[1] - meet[0]) / TAU - up(datum.alpha) + up(datum.beta);
        let first = (0.5 * (f64::from(turns) + difference)).round().clamp(0.0, f64::from(turns)) as u32;
        curve.turns = [first, turns - first];
        curve.length = curve.length_to(1.0);
        curve
    }

    /// θ: half the range of the involute's parameter, radians; nearest double.
    pub fn theta(&self) -> f64 {
        self.theta
    }

    /// θ less the nearest multiple of π, to full accuracy where θ itself shows little of it (small |Q|).
    pub fn theta_beyond(&self) -> f64 {
        self.beyond
    }

    /// t0: middle of the range of the involute's parameter, radians.
    pub fn t0(&self) -> f64 {
        self.t0
    }

    /// ρ and λ of the map (6), whose factor is `m = ρ e^(iλ)`; of the mirror image where the curvature decreases.
    pub fn map(&self) -> [f64; 2] {
        [self.rho, self.lambda]
    }

    /// Turns about the start and about the end: how often the line of the chord is met strictly inside the curve, before the
    /// start and beyond the end.
    pub fn turns(&self) -> [u32; 2] {
        self.turns
    }

    /// Length from end to end, in half chords.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The point at a parameter from 0 to 1.
    ///
    /// # Accuracy
    /// About 1e-14, relative to its distance from the nearer end and, if larger, times that distance; directions 1e-14 times one plus the turns;
    /// curvatures 1e-13 relative to the largest term they are the sum of. The ends are exact, up to the rounding of their direction.
    pub fn at(&self, f: f64) -> InvolutePoint {
        let (half, v) = self.half(f);
        let place = half.at(v);
        let (up, turns) = (if half.angle == -PI { TAU } else { 0.0 }, self.turns[usize::from(half.side < 0.0)]);
        let mirror = if self.mirrored { -1.0 } else { 1.0 };
        InvolutePoint {
            f,
            point: [place.point[0], mirror * place.point[1] + 0.0],
            direction: mirror * (half.direction(v) + (up + TAU * f64::from(turns))) + 0.0,
            curvature: mirror * place.curvature + 0.0,
        }
    }

    /// The point where a share, from 0 to 1, of the length is behind.
    ///
    /// # Accuracy
    /// 1e-13 of the length, and as [`Involute::at`].
    pub fn at_length(&self, share: f64) -> InvolutePoint {
        let wanted = share * self.length;
        if share <= 0.0 || share >= 1.0 {
            return self.at(share.clamp(0.0, 1.0));
        }
        self.at(find(|f| self.length_to(f) - wanted, 0.0, 1.0, 1e-16))
    }

    /// Length from the start to a parameter, in half chords.
    ///
    /// # Accuracy
    /// 1e-14 relative.
    pub fn length_to(&self, f: f64) -> f64 {
        self.length_between(0.0, f)
    }

    /// Points at equal lengths, both ends included, and the length at each, in half chords.
    ///
    /// # Accuracy
    /// 1e-13 of the length, and as [`Involute::at`].
    ///
    /// # Errors
    /// [`Error::Domain`] for fewer than 2 points.
    pub fn samples(&self, count: usize) -> Result<Vec<(f64, InvolutePoint)>> {
        if count < 2 {
            return Err(Error::Domain(format!("{count} samples of a curve; it needs at least 2, the ends")));
        }
        let share = |i: usize| i as f64 / (count - 1) as f64;
        // Each from the one before: the length between neighbours is soon had.
        let (mut f, mut s) = (0.0, 0.0);
        let mut next = |i: usize| {
            let wanted = share(i) * self.length;
            (f, s) = self.step(f, s, wanted);
            (wanted, self.at(f))
        };
        let inside: Vec<_> = (1..count - 1).map(&mut next).collect();
        let ends = [(0.0, self.at(0.0)), (self.length, self.at(1.0))];
        Ok(ends[..1].iter().copied().chain(inside).chain(ends[1..].iter().copied()).collect())
    }

    /// The parameter where the length is `wanted`, and the length there, from a parameter whose length is known and less: Newton's method, or
    /// a bracket where that leaves the curve or does not settle.
    fn step(&self, from: f64, known: f64, wanted: f64) -> (f64, f64) {
        let (mut f, mut s) = (from, known);
        for _ in 0..8 {
            let (half, v) = self.half(f);
            let next = f + (wanted - s) / (2.0 * self.theta * half.at(v).speed);
            if !(next > from && next < 1.0) {
                break;
            }
            s = known + self.length_between(from, next);
            let settled = (next - f).abs() <= 1e-15 || (s - wanted).abs() <= 1e-15 * self.length;
            f = next;
            if settled {
                return (f, s);
            }
        }
        f = find(|f| known + self.length_between(from, f) - wanted, from, 1.0, 1e-16);
        (f, known + self.length_between(from, f))
    }

    /// Length from one parameter to a later one.
    fn length_between(&self, from: f64, to: f64) -> f64 {
        let part = |from: f64, to: f64| {
            let (half, v) = self.half(to);
            let other = 2.0 * self.theta * if half.side > 0.0 { from } else { 1.0 - from };
            arc_length(|v| half.at(v).speed, v.min(other), v.max(other))
        };
        let middle = 0.5;
        if from < middle && to > middle { part(from, middle) + part(middle, to) } else { part(from, to) }
    }

    /// The half that a parameter lies in, and its distance from that half's end.
    fn half(&self, f: f64) -> (&Half, f64) {
        let v = |share: f64| 2.0 * self.theta * share;
        if f <= 0.5 { (&self.halves[0], v(f)) } else { (&self.halves[1], v(1.0 - f)) }
    }
}

impl Half {
    /// Direction at v, followed from the end.
    fn direction(&self, v: f64) -> f64 {
        self.at(v).direction - 2.0 * self.argument(v)
    }
}
