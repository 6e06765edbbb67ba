//! How near two vehicles come that travel along their paths at constant speeds: proved, not sampled.
//!
//! On a stretch of time with half-width h around a moment with the separation `r` and the relative velocity `v`, the separation stays above
//! both `|r| - L h`, `L = V1 + V2`, and `min |r + vτ| - K h²/2`, `K = V1² κ1 + V2² κ2` with bounds of the curvatures. Stretches are halved,
//! the one with the least bound first, until the least separation is enclosed and the verdict certain. Where both move in step the
//! second bound needs far fewer stretches than the first.

use super::queue::Queue;
use super::{ROUNDINGS, check_joined, complex, distance, finite, mismatch};
use crate::curve::PhQuintic;
use crate::error::{Error, Result};

/// Stretches at most.
const STRETCHES: usize = 400_000;
/// Stretches at first.
const FIRST: usize = 64;
/// Directions that differ by no more where spans join are a matter of rounding.
const SMOOTH: f64 = 1e-6;
/// The least separation is enclosed to this share of the greatest length and coordinate, or as rounding allows.
const TOLERANCE: f64 = 1e-10;

/// A vehicle on its way.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    spans: Vec<PhQuintic>,
    /// Lengths up to the start of each span, and of all.
    lengths: Vec<f64>,
    speed: f64,
    start_time: f64,
    /// Bound of its acceleration.
    acceleration: f64,
    /// Bound of what its direction changes by where spans join, all together.
    kinks: f64,
    /// Its length or its largest coordinate.
    extent: f64,
    /// Bound of its coordinates, lengths and legs.
    size: f64,
    /// How far the end of a span is from where its pre-image leads.
    mismatch: f64,
}

/// The difference of the directions that two values of w give, the squares of their unit vectors.
fn kink(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (a, b) = (complex(a), complex(b));
    2.0 * ((a.conj() * b).im / a.norm() / b.norm()).abs() + ROUNDINGS
}

/// Where a vehicle is: point, velocity, bounds of their errors, and of speed and acceleration from standing or moving as then.
struct State {
    point: [f64; 2],
    velocity: [f64; 2],
    off: f64,
    velocity_off: f64,
    speed: f64,
    acceleration: f64,
}

impl Motion {
    /// Along spans that join exactly, at a constant speed, from a time on.
    ///
    /// # Errors
    /// [`Error::Domain`] without a span, for a gap between spans, a path of no length, a speed not above 0, or a number not finite.
    pub fn new(spans: Vec<PhQuintic>, speed: f64, start_time: f64) -> Result<Motion> {
        let fail = |what: String| Err(Error::Domain(format!("motion: {what}")));
        finite("motion", "speed", &[speed])?;
        finite("motion", "start_time", &[start_time])?;
        if speed <= 0.0 {
            return fail(format!("`speed` is {speed:?}; it must be above 0"));
        }
        check_joined("motion", &spans)?;
        let mut lengths = vec![0.0];
        for span in &spans {
            lengths.push(lengths[lengths.len() - 1] + span.length());
        }
        let length = lengths[lengths.len() - 1];
        if !(length > 0.0 && length.is_finite()) {
            return fail(format!("its path is {length:?} long; it must have a length"));
        }
        let kinks: f64 = spans.windows(2).map(|w| kink(w[0].preimage[2], w[1].preimage[0])).sum();
        // A corner has no curvature; the bound by speeds alone still holds there.
        let smooth = kinks <= SMOOTH;
        let curvature = spans.iter().map(|s| s.curvature_bound(5)).fold(0.0, f64::max);
        let acceleration = if smooth { speed * speed * curvature } else { f64::INFINITY };
        let far = spans.iter().flat_map(|s| s.control_points()).flatten().fold(0.0f64, |far, x| far.max(x.abs()));
        // Coefficients of lengths are at most the sum of |w|², and so are legs.
        let sizes = |s: &PhQuintic| s.preimage.iter().flatten().map(|x| x * x).sum::<f64>();
        let size = far + length + spans.iter().map(sizes).fold(0.0, f64::max);
        let mismatch = spans.iter().map(mismatch).fold(0.0, f64::max);
        Ok(Motion { spans, lengths, speed, start_time, acceleration, kinks, extent: far.max(length), size, mismatch })
    }

    /// Length of the path.
    pub fn length(&self) -> f64 {
        self.lengths[self.spans.len()]
    }

    /// When it starts and arrives.
    pub fn times(&self) -> [f64; 2] {
        [self.start_time, self.start_time + self.length() / self.speed]
    }

    /// Its path.
    pub fn spans(&self) -> &[PhQuintic] {
        &self.spans
    }

    /// Where it is at a time: at the start before it starts, at the end once it has arrived.
    pub fn at(&self, time: f64) -> [f64; 2] {
        self.state(time).point
    }

    fn state(&self, time: f64) -> State {
        let [start, end] = self.times();
        let under_way = time.clamp(start, end);
        let travelled = (self.speed * (time - self.start_time)).clamp(0.0, self.length());
        let i = self.lengths.partition_point(|s| *s <= travelled).clamp(1, self.spans.len()) - 1;
        let (span, local) = (&self.spans[i], travelled - self.lengths[i]);
        let t = span.parameter_at(local);
        // Along the path by what the parameter misses, and the roundings of lengths, times and points. Spans are summed up one by one.
        let missed = (span.length_to(t) - local.min(span.length())).abs();
        let off = missed
            + self.mismatch
            + ROUNDINGS * self.size
            + f64::EPSILON
                * (self.spans.len() as f64 * self.length() + 4.0 * self.speed * (under_way.abs() + self.start_time.abs()));
        if time <= start || time >= end {
            return State { point: span.point(t), velocity: [0.0; 2], off, velocity_off: 0.0, speed: 0.0, acceleration: 0.0 };
        }
        let tangent = span.tangent(t);
        let tangent = if tangent[0].is_finite() && tangent[1].is_finite() { tangent } else { [1.0, 0.0] };
        State {
            point: span.point(t),
            velocity: tangent.map(|x| x * self.speed),
            off,
            velocity_off: self.acceleration / self.speed * off + (self.kinks + ROUNDINGS) * self.speed,
            speed: self.speed,
            acceleration: self.acceleration,
        }
    }
}

/// Whether a minimum distance is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// At all times: proved.
    Kept,
    /// At some time it is not: proved.
    Violated,
    /// The least separation is too close to the minimum to tell in doubles.
    Undecided,
}

/// The closest approach.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Closest {
    /// A time at which the separation is no more than `at_most`.
    pub time: f64,
    /// Where both are then.
    pub points: [[f64; 2]; 2],
    /// The least separation is no less than this.
    pub at_least: f64,
    /// The least separation is no more than this.
    pub at_most: f64,
}

/// What is known of two motions.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Separation {
    /// Whether the minimum distance is kept.
    pub verdict: Verdict,
    /// The closest approach.
    pub closest: Closest,
}

/// Whether two vehicles keep a minimum distance, and how near they come.
///
/// At all times: before its start time a vehicle stands at its start, and once it has arrived at its end.
///
/// # Accuracy
/// [`Verdict::Kept`] and [`Verdict::Violated`] are proved for the curves given, roundings included. The least separation is enclosed to 1e-10 of the
/// size of the scene (lengths and coordinates) where 400,000 stretches suffice; the enclosure holds in any case.
///
/// # Errors
/// [`Error::Domain`] for a minimum distance that is negative or not finite.
pub fn separation(a: &Motion, b: &Motion, minimum: f64) -> Result<Separation> {
    finite("separation", "minimum", &[minimum])?;
    if minimum < 0.0 {
        return Err(Error::Domain(format!("separation: `minimum` is {minimum:?}; a distance is at least 0")));
    }
    let mut events = [a.times(), b.times()].concat();
    events.sort_by(f64::total_cmp);
    let mut search = Search { a, b, waiting: Queue::new(), best: (f64::INFINITY, events[0], [[0.0; 2]; 2]) };
    // Where one starts or arrives the least separation often is. In between both keep standing or moving.
    for time in &events {
        search.look(*time);
    }
    for w in events.windows(2) {
        let time = |i: usize| if i == FIRST { w[1] } else { w[0] + (w[1] - w[0]) * (i as f64 / FIRST as f64) };
        (0..FIRST).for_each(|i| search.add(time(i), time(i + 1)));
    }
    let tolerance = TOLERANCE * a.extent.max(b.extent);
    let mut at_least = 0.0;
    for _ in 0..STRETCHES {
        let Some((bound, [from, to])) = search.waiting.pop() else { break };
        at_least = bound;
        let at_most = search.best.0;
        let decided = at_least >= minimum || at_most < minimum;
        let middle = 0.5 * (from + to);
        let halved = from < middle && middle < to;
        if (decided && at_most - at_least <= tolerance) || !halved {
            break;
        }
        search.add(from, middle);
        search.add(middle, to);
    }
    let (at_most, time, points) = search.best;
    let verdict = match () {
        () if at_least >= minimum => Verdict::Kept,
        () if at_most < minimum => Verdict::Violated,
        () => Verdict::Undecided,
    };
    Ok(Separation { verdict, closest: Closest { time, points, at_least, at_most } })
}

/// [`separation`] of all pairs, as `(first, second, what is known)` with `first < second`.
///
/// # Errors
/// Those of [`separation`].
pub fn separations(motions: &[Motion], minimum: f64) -> Result<Vec<(usize, usize, Separation)>> {
    let pairs = (0..motions.len()).flat_map(|i| (i + 1..motions.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| Ok((i, j, separation(&motions[i], &motions[j], minimum)?))).collect()
}

struct Search<'m> {
    a: &'m Motion,
    b: &'m Motion,
    /// Stretches of time.
    waiting: Queue<[f64; 2]>,
    /// Least upper bound, when, and where both are then.
    best: (f64, f64, [[f64; 2]; 2]),
}

impl Search<'_> {
    /// Both at a time; keeps the least separation.
    fn look(&mut self, time: f64) -> [State; 2] {
        let both = [self.a.state(time), self.b.state(time)];
        let apart = distance(both[0].point, both[1].point) + both[0].off + both[1].off;
        if apart < self.best.0 {
            self.best = (apart, time, [both[0].point, both[1].point]);
        }
        both
    }

    fn add(&mut self, from: f64, to: f64) {
        let middle = 0.5 * (from + to);
        let half = (middle - from).max(to - middle) * (1.0 + 4.0 * f64::EPSILON);
        let [a, b] = self.look(middle);
        let off = a.off + b.off;
        let r = [a.point[0] - b.point[0], a.point[1] - b.point[1]];
        let v = [a.velocity[0] - b.velocity[0], a.velocity[1] - b.velocity[1]];
        let by_speed = distance(a.point, b.point) - (a.speed + b.speed) * half;
        let bend = 0.5 * (a.acceleration + b.acceleration) * half * half;
        let by_curvature = nearest(r, v, half) - bend - (a.velocity_off + b.velocity_off) * half;
        let bound = if by_curvature > by_speed { by_curvature } else { by_speed };
        // Distances and bounds themselves round, by less than the roundings in `off`.
        self.waiting.push((bound - 2.0 * off).max(0.0), [from, to]);
    }
}

/// The least `|r + vτ|` for `|τ| <= half`.
fn nearest(r: [f64; 2], v: [f64; 2], half: f64) -> f64 {
    let square = v[0] * v[0] + v[1] * v[1];
    let tau = if square > 0.0 { (-(r[0] * v[0] + r[1] * v[1]) / square).clamp(-half, half) } else { 0.0 };
    (r[0] + v[0] * tau).hypot(r[1] + v[1] * tau)
}
