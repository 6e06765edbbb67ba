//! From two ends to the curve.

use super::super::Datum;
use super::super::arc::{Arc, Equation};
use super::half::Half;
use super::track::Track;
use super::turns::{Split, range};
use super::{Image, Spiral, WhyNone};
use crate::error::{Result, samples};
use crate::num::bernstein::Certain;
use crate::num::{Interval, climb, formula};
use serde::Serialize;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::f64::consts::{PI, TAU};

/// The image of an arc of the involute, in the chord's frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    tracks: [Track; 2],
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
    rho: f64,
    lambda: f64,
    halves: [Half; 2],
}

/// What is asked of the arc: -Q, `-(k1 + sin α)` and ω, without its half turns in `rest`.
struct Wanted {
    q: Interval,
    room: Interval,
    rest: Interval,
    half_turns: u32,
}

/// How much a curve took to find.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(not(test), expect(dead_code, reason = "read by the tests that bound it"))]
pub(super) struct Work {
    /// Precision of the arc.
    pub bits: usize,
    /// Evaluations of its equation at that precision.
    pub evaluations: usize,
    /// Pieces of its length.
    pub pieces: usize,
}

pub(super) fn solve(chord: &Datum, turns: [u32; 2]) -> Result<(Spiral, Option<Work>)> {
    let rising = chord.k1 < chord.k2;
    let datum = if rising { *chord } else { chord.mirrored() };
    // Half-open ranges: what the mirror image has at -π is π.
    let cuts = [datum.alpha, datum.beta].iter().filter(|x| **x == -PI).count();
    let half_turns = turns[0] + turns[1] + cuts as u32;
    let total = |bits: usize| total(&datum, half_turns, bits);
    // Never 0 but where both parts are: π is irrational.
    let plain = datum.alpha + datum.beta;
    let side = match half_turns {
        // A rounded sum has the sign of the sum.
        0 => plain.partial_cmp(&0.0).unwrap_or(Equal),
        _ => climb(&datum, "omega", |b| total(b).sign())?.0,
    };
    let twin = datum.q_of_twins();
    let sign = match twin.and_then(|q| q.certain_sign(0.0)) {
        Some(sign) => sign,
        None => climb(&datum, "the sign of Q", |bits| datum.q(bits).sign())?.0,
    };
    let q = match twin.and_then(|q| q.to_f64()) {
        Some(q) => q,
        None => climb(&datum, "Q", |bits| datum.q(bits).to_f64())?.0,
    };
    let mirror = if rising { 1.0 } else { -1.0 };
    // Without half turns a rounded sum, halved.
    let omega = mirror * if half_turns == 0 { 0.5 * plain + 0.0 } else { total(128).approx() };
    let answer = |outcome| Spiral { chord: *chord, turns, q, omega, outcome };
    let why = match (side, sign) {
        _ if chord.k1 == chord.k2 => WhyNone::SameCurvature,
        (Less | Equal, _) => WhyNone::WrongSide,
        (_, Greater) => WhyNone::CirclesCross,
        (_, Equal) => WhyNone::CirclesTouch,
        (Greater, Less) => {
            let (curve, work) = found(&datum, half_turns, turns[0] + turns[1], !rising)?;
            let split = split(&datum, turns, &curve);
            return Ok((answer(Ok(Image { curve, split })), Some(work)));
        }
    };
    Ok((answer(Err(why)), None))
}

fn split(datum: &Datum, turns: [u32; 2], curve: &Involute) -> Split {
    let Datum { alpha, beta, k1, k2 } = *datum;
    let up = |x: f64| if x == -PI { PI } else { x };
    let (least, most) = range(&Datum { alpha: up(alpha), beta: up(beta), k1, k2 }, turns[0] + turns[1]);
    if curve.turns == turns {
        Split::Asked
    } else if (least..=most).contains(&turns[0]) {
        Split::Other
    } else {
        Split::Impossible { least, most }
    }
}

/// The curve of rising curvature with `turns` in all, to be mirrored or not.
fn found(datum: &Datum, half_turns: u32, turns: u32, mirrored: bool) -> Result<(Involute, Work)> {
    let ((numbers, evaluations), bits) = climb(datum, "the arc of the involute", |bits| {
        // Differences of the data may take far more bits than the arc does, but sines of two angles only.
        let wanted =
            climb(datum, "Q", |b| if b < bits { None } else { Wanted::new(datum, half_turns, b, bits) }).ok()?.0;
        Numbers::new(datum, &wanted, bits)
    })?;
    let curve = Involute::new(datum, numbers, turns, mirrored);
    let pieces = curve.tracks.iter().map(Track::pieces).sum();
    Ok((curve, Work { bits, evaluations, pieces }))
}

/// ω with the half turns that are added to it.
fn total(datum: &Datum, half_turns: u32, bits: usize) -> Interval {
    formula!(datum.omega(bits) + Interval::pi(bits) * { f64::from(half_turns) })
}

/// Whether a number is known to so many bits.
fn thin(x: &Interval, bits: usize) -> bool {
    let width = &x.upper() - &x.lower();
    let allowed = &x.size().upper() * &Interval::power_of_two(-(bits as isize), x.bits());
    width.compare(&allowed) == Some(Less)
}

/// `r e^(ix)`.
fn polar(r: &Interval, x: &Interval) -> [Interval; 2] {
    let (sin, cos) = x.sine_cosine();
    [r * &cos, r * &sin]
}

impl Wanted {
    /// At a precision that leaves three quarters of `wanted` bits.
    fn new(datum: &Datum, half_turns: u32, bits: usize, wanted: usize) -> Option<Wanted> {
        let q = -&datum.q(bits);
        let room = -&(&Interval::new(datum.k1, bits) + &Interval::sin_cos(datum.alpha, bits).0);
        let known = [&q, &room].into_iter().all(|x| thin(x, wanted - wanted / 4));
        // The sum of two doubles comes out to all bits, or to 0.
        known.then(|| Wanted {
            q: q.rounded(wanted),
            room: room.rounded(wanted),
            rest: datum.omega(bits).rounded(wanted),
            half_turns,
        })
    }
}

impl Numbers {
    fn new(datum: &Datum, wanted: &Wanted, bits: usize) -> Option<(Numbers, usize)> {
        let Wanted { q, room, rest, half_turns } = wanted;
        let equation = Equation::new(q.clone(), rest.clone(), *half_turns);
        let Arc { theta, sin, cos: _, p, a, t0, t1 } = equation.solve()?;
        let half_chord = (&(&t0 * &sin).square() + &p.square()).sqrt()?;
        // ρ = (k1* + sin α*)/(k1 + sin α), both negative.
        let rho = formula!(t0 * a + p * sin).over(&formula!(half_chord * t1 * room))?;
        if ![&theta, &t1, &rho, &half_chord].into_iter().all(|x| thin(x, 80)) {
            return None;
        }
        // λ = α - α*, α* = ω + θ; any full turns do.
        let [alpha, beta] = [datum.alpha, datum.beta].map(|x| Interval::new(x, bits));
        let omega = formula!(rest + Interval::pi(bits) * { f64::from(*half_turns) });
        let ahead = &omega + &theta;
        let lambda = &alpha - &ahead;
        let inverse = Interval::new(1.0, bits).over(&rho)?;
        // q = (1 - 1/m) e^(iα) at the start, and (1 - m) e^(iβ) at the end, where λ + β = ω - θ up to full turns.
        let factor = |angle: &Interval, by: &Interval, other: &Interval| {
            let ([x, y], [u, v]) = (polar(&Interval::new(1.0, bits), angle), polar(by, other));
            [&x - &u, &y - &v]
        };
        let start = End { side: 1.0, t: &t1, scale: rho.over(&half_chord)?, q: factor(&alpha, &inverse, &ahead) };
        let end = End {
            side: -1.0,
            t: &(&t0 + &theta),
            scale: inverse.over(&half_chord)?,
            q: factor(&beta, &rho, &(&omega - &theta)),
        };
        let halves = [start.half(&theta, datum.alpha, datum.k1)?, end.half(&theta, datum.beta, datum.k2)?];
        // θ from the nearest multiple of π.
        let turns = (theta.approx() / PI).round();
        let beyond = formula!(theta - Interval::pi(bits) * { turns });
        let numbers = Numbers {
            theta: theta.approx(),
            beyond: beyond.approx(),
            t0: t0.approx(),
            rho: rho.approx().clamp(f64::MIN_POSITIVE, f64::MAX),
            lambda: lambda.approx(),
            halves,
        };
        Some((numbers, equation.evaluations()))
    }
}

/// What a [`Half`] is made of: σ, T, r and q.
struct End<'i> {
    side: f64,
    t: &'i Interval,
    scale: Interval,
    q: [Interval; 2],
}

impl End<'_> {
    fn half(&self, theta: &Interval, angle: f64, curvature: f64) -> Option<Half> {
        let End { side, t, scale, q } = self;
        let bits = theta.bits();
        // s, a power of two, from the exponents of r max(1, |q|) and T.
        let exponent = |x: &Interval| x.magnitude().unwrap_or(isize::MIN / 4);
        let steep = exponent(scale) + exponent(&q[0]).max(exponent(&q[1])).max(0);
        let s = (-steep).div_euclid(2).min(-steep - exponent(t)).min(exponent(theta) - 1).min(0);
        let s = Interval::power_of_two(s, bits);
        let whole = &s + t;
        let unit = formula!(scale * s * whole);
        let size = (&q[0].square() + &q[1].square()).sqrt()?;
        Some(Half {
            side: *side,
            t: t.approx(),
            theta: theta.approx(),
            reach: theta.over(&s)?.approx(),
            near: t.over(&whole)?.approx(),
            far: s.over(&whole)?.approx(),
            scale: unit.approx(),
            grow: [(&unit * &q[0]).approx(), (&unit * &q[1]).approx()],
            angle,
            bend: (&(&size * theta) * &theta.over(&s)?).approx(),
            swing: (&q[0] * theta).approx(),
            sway: q[1].approx(),
            curvature,
        })
    }
}

impl Involute {
    fn new(datum: &Datum, n: Numbers, turns: u32, mirrored: bool) -> Involute {
        let Numbers { theta, beyond, t0, rho, lambda, halves } = n;
        // Both halves have the same direction where they meet, which tells the difference of the turns.
        let meet = halves.map(|half| half.direction(1.0));
        let up = |x: f64| if x == -PI { 1.0 } else { 0.0 };
        let difference = (meet[1] - meet[0]) / TAU - up(datum.alpha) + up(datum.beta);
        let first = (0.5 * (f64::from(turns) + difference)).round().clamp(0.0, f64::from(turns)) as u32;
        let turns = [first, turns - first];
        Involute { theta, beyond, t0, rho, lambda, turns, mirrored, tracks: halves.map(Track::new) }
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

    /// ρ and λ of Kurnosenko's map (6), whose factor is `m = ρ e^(iλ)`; of the mirror image where the curvature
    /// decreases. A ρ beyond the range of normal doubles is told as the nearest of them.
    pub fn map(&self) -> [f64; 2] {
        [self.rho, self.lambda]
    }

    /// Turns about the start and about the end: how often the line of the chord is met strictly inside the curve,
    /// before the start and beyond the end.
    pub fn turns(&self) -> [u32; 2] {
        self.turns
    }

    /// Length from end to end, in half chords.
    pub fn length(&self) -> f64 {
        // Rounding may leave it below the chord's.
        self.tracks.iter().map(Track::length).sum::<f64>().max(2.0)
    }

    /// The point at a parameter from 0 to 1.
    ///
    /// # Accuracy
    /// About 1e-14, relative to its distance from the nearer end and, if larger, times that distance; directions 1e-14
    /// times one plus the turns; curvatures 1e-13 relative to the largest term they are the sum of. The ends are exact,
    /// up to the rounding of their direction.
    pub fn at(&self, f: f64) -> InvolutePoint {
        let (which, u) = side(f);
        InvolutePoint { f, ..self.seen(which, u) }
    }

    /// The point on one of the halves.
    fn seen(&self, which: usize, u: f64) -> InvolutePoint {
        let half = &self.tracks[which].half;
        let place = half.at(u);
        let up = if half.angle == -PI { TAU } else { 0.0 };
        let mirror = if self.mirrored { -1.0 } else { 1.0 };
        let direction = place.direction - 2.0 * half.argument(u) + (up + TAU * f64::from(self.turns[which]));
        InvolutePoint {
            f: if which == 0 { 0.5 * u } else { 1.0 - 0.5 * u },
            point: [place.point[0], mirror * place.point[1] + 0.0],
            direction: mirror * direction + 0.0,
            curvature: mirror * place.curvature + 0.0,
        }
    }

    /// The point where a share, from 0 to 1, of the length is behind.
    ///
    /// # Accuracy
    /// 1e-13 of the length, and as [`Involute::at`], but that the point's parameter, rounded to a double, may tell less
    /// than the point where the curve begins or ends far within a rounding of the parameter.
    pub fn at_length(&self, share: f64) -> InvolutePoint {
        let wanted = share.max(0.0) * self.length();
        // The end itself, even where its half is shorter than a rounding.
        if share < 1.0 && wanted <= self.tracks[0].length() {
            self.seen(0, self.tracks[0].at(wanted))
        } else {
            self.seen(1, self.tracks[1].at((1.0 - share).max(0.0) * self.length()))
        }
    }

    /// Length from the start to a parameter, in half chords.
    ///
    /// # Accuracy
    /// 1e-14 of the length, and of the result in the first half.
    pub fn length_to(&self, f: f64) -> f64 {
        match side(f) {
            (0, u) => self.tracks[0].to(u),
            (_, u) => self.length() - self.tracks[1].to(u),
        }
    }

    /// Points at equal lengths, both ends included, and the length at each, in half chords.
    ///
    /// # Accuracy
    /// As [`Involute::at_length`].
    ///
    /// # Errors
    /// [`crate::Error::Domain`] for fewer than 2 points.
    pub fn samples(&self, count: usize) -> Result<Vec<(f64, InvolutePoint)>> {
        samples(count)?;
        let share = |i: usize| i as f64 / (count - 1) as f64;
        Ok((0..count).map(|i| (share(i) * self.length(), self.at_length(share(i)))).collect())
    }
}

/// The half that a parameter lies in, and its distance from that half's end as a share of θ.
fn side(f: f64) -> (usize, f64) {
    if f <= 0.5 { (0, 2.0 * f) } else { (1, 2.0 * (1.0 - f)) }
}
