//! From two ends to the curve.

use super::super::Datum;
use super::numbers::Numbers;
use super::track::Track;
use super::turns::{Split, about_start, range};
use super::{Image, Spiral, WhyNone};
use crate::error::{Result, samples};
use crate::num::{Certain, Interval, TWIN_BITS, climb, formula};
use serde::Serialize;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::f64::consts::{PI, TAU};

/// The image of an arc of the involute, in the chord's frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Involute {
    theta: f64,
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
            let split = split(&datum, turns, &curve)?;
            return Ok((answer(Ok(Image { curve, split })), Some(work)));
        }
    };
    Ok((answer(Err(why)), None))
}

fn split(datum: &Datum, turns: [u32; 2], curve: &Involute) -> Result<Split> {
    if curve.turns == turns {
        return Ok(Split::Asked);
    }
    let (least, most) = range(datum, turns[0] + turns[1])?;
    Ok(if (least..=most).contains(&turns[0]) { Split::Other } else { Split::Impossible { least, most } })
}

/// The curve of rising curvature with `turns` in all, to be mirrored or not.
fn found(datum: &Datum, half_turns: u32, turns: u32, mirrored: bool) -> Result<(Involute, Work)> {
    let ((numbers, evaluations), bits) = match Numbers::by_twins(datum, half_turns) {
        Some(found) => (found, TWIN_BITS),
        None => Numbers::by_intervals(datum, half_turns)?,
    };
    let first = about_start(datum, half_turns, turns)?;
    let curve = Involute::new(numbers, [first, turns - first], mirrored);
    let pieces = curve.tracks.iter().map(Track::pieces).sum();
    Ok((curve, Work { bits, evaluations, pieces }))
}

/// ω with the half turns that are added to it.
fn total(datum: &Datum, half_turns: u32, bits: usize) -> Interval {
    formula!(datum.omega(bits) + Interval::pi(bits) * { f64::from(half_turns) })
}

impl Involute {
    fn new(n: Numbers, turns: [u32; 2], mirrored: bool) -> Involute {
        let Numbers { theta, t0, rho, lambda, halves } = n;
        Involute { theta, t0, rho, lambda, turns, mirrored, tracks: halves.map(Track::new) }
    }

    /// θ: half the range of the involute's parameter, radians; nearest double.
    pub fn theta(&self) -> f64 {
        self.theta
    }

    /// t0: middle of the range of the involute's parameter, radians.
    pub fn t0(&self) -> f64 {
        self.t0
    }

    /// ρ and λ of Kurnosenko's map (6), whose factor is `m = ρ e^(iλ)`; of the mirror image where the curvature
    /// decreases. A ρ beyond the range of normal doubles is given as the nearest of them.
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
    /// 1e-13 of the length, and as [`Involute::at`], but that the point's parameter, rounded to a double, may say less
    /// than the point where the curve begins or ends far within a rounding of the parameter.
    pub fn at_length(&self, share: f64) -> InvolutePoint {
        let (which, u) = self.behind(share);
        self.seen(which, u)
    }

    /// dκ/ds where a share, from 0 to 1, of the length is behind; one over half chords squared.
    ///
    /// # Accuracy
    /// 1e-13 relative; less where the curve goes far away between its ends, as its speed has fewer digits there.
    pub fn rate_at_length(&self, share: f64) -> f64 {
        let (which, u) = self.behind(share);
        let rate = self.tracks[which].half.rate(u);
        if self.mirrored { -rate } else { rate }
    }

    /// The half where a share of the length is behind, and the place on it.
    fn behind(&self, share: f64) -> (usize, f64) {
        let wanted = share.max(0.0) * self.length();
        // The end itself, even where its half is shorter than a rounding.
        if share < 1.0 && wanted <= self.tracks[0].length() {
            (0, self.tracks[0].at(wanted))
        } else {
            (1, self.tracks[1].at((1.0 - share).max(0.0) * self.length()))
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
    /// [`crate::Error::Domain`] for fewer than 2 points or more than [`crate::transition::MOST_SAMPLES`].
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
