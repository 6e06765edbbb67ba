//! How near two vehicles come that travel along their paths at constant speeds: proved, not sampled.
//!
//! On a stretch of time with half-width h around a moment with the separation `r` and the relative velocity `v`, the
//! separation stays above both `|r| - L h`, `L = V1 + V2`, and `min |r + vτ| - K h²/2`, `K = V1² κ1 + V2² κ2` with
//! bounds of the curvatures. Stretches are halved, the one with the least bound first, until the least separation is
//! enclosed and the verdict certain. Where both move in step the second bound needs far fewer stretches than the first.

use super::queue::Queue;
use super::way::{Reached, Way};
use super::{Course, ROUNDINGS, distance, finite};
use crate::error::{Error, Result};
use crate::steps::step;
use crate::transition::Piece;

/// Stretches at most.
const STRETCHES: usize = 100_000;
/// Times, and lengths covered in them, are at most this.
const LARGEST: f64 = 1e140;
/// Stretches at first.
const FIRST: usize = 64;
/// Directions that differ by no more where pieces join are a matter of rounding.
const SMOOTH: f64 = 1e-6;
/// The least separation is enclosed to this share of the greatest length and coordinate, or as rounding allows.
const TOLERANCE: f64 = 1e-10;

/// A vehicle on its way.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    course: Course,
    ways: Vec<Way>,
    /// Lengths up to the start of each piece, and of all.
    lengths: Vec<f64>,
    speed: f64,
    start_time: f64,
    /// Bound of its curvature; infinite for a path with corners.
    curvature: f64,
    /// Bound of what its direction changes by where pieces join, all together, and of the errors of directions.
    kinks: f64,
    /// Its length or its largest coordinate.
    extent: f64,
    /// Bound of its coordinates, lengths and legs.
    size: f64,
    /// Bound of what points, lengths and the gaps between pieces are off by.
    mismatch: f64,
}

/// Where a vehicle is: point, direction, bounds of their errors, and speed and curvature from standing or moving as
/// then.
struct State {
    point: [f64; 2],
    tangent: [f64; 2],
    off: f64,
    tangent_off: f64,
    speed: f64,
    curvature: f64,
}

impl Motion {
    /// Along pieces that join, at a constant speed, from a time on.
    ///
    /// # Errors
    /// [`Error::Domain`] without a piece, for an involute, for pieces that [`Course::new`] refuses, a path of no
    /// length, a speed not above 0, or a number not finite.
    pub fn new<P: Into<Piece>>(pieces: impl IntoIterator<Item = P>, speed: f64, start_time: f64) -> Result<Motion> {
        let fail = |what: String| Err(Error::Domain(format!("motion: {what}")));
        finite("motion", "speed", &[speed])?;
        finite("motion", "start_time", &[start_time])?;
        if speed <= 0.0 {
            return fail(format!("`speed` is {speed:?}; it must be above 0"));
        }
        let course = Course::new(pieces.into_iter().map(Into::into).collect())?;
        let way = |(i, piece)| Way::new(piece).map_err(|e| Error::Domain(format!("pieces[{i}] {e}")));
        let ways = course.pieces().iter().enumerate().map(way).collect::<Result<Vec<Way>>>()?;
        let mut lengths = vec![0.0];
        for way in &ways {
            lengths.push(lengths[lengths.len() - 1] + way.length);
        }
        let length = lengths[lengths.len() - 1];
        if !(length > 0.0 && length.is_finite()) {
            return fail(format!("its path is {length:?} long; it must have a length"));
        }
        let most = |of: fn(&Way) -> f64| ways.iter().map(of).fold(0.0, f64::max);
        let direction_off = most(|way| way.direction_off);
        // The difference of unit tangents, each of which may be off by what the place is.
        let kink = |w: &[Way]| {
            let [end, start] = [w[0].after(w[0].length), w[1].after(0.0)];
            let off = |way: &Way, at: &Reached| way.curvature * (at.missed + ROUNDINGS * way.sizes[1]);
            distance(end.tangent, start.tangent) + ROUNDINGS + off(&w[0], &end) + off(&w[1], &start)
        };
        let kinks = ways.windows(2).map(kink).sum::<f64>();
        // A corner has no curvature; the bound by speeds alone still holds there.
        let smooth = kinks <= SMOOTH;
        let curvature = if smooth { most(|way| way.curvature) } else { f64::INFINITY };
        let far = most(|way| way.sizes[0]);
        let gaps: f64 = course.pieces().windows(2).map(|w| distance(w[0].end(), w[1].start())).sum();
        // Points may jump where pieces join, and once more within a piece.
        let mismatch = gaps + ways.iter().map(|way| 2.0 * way.mismatch + way.length_off).sum::<f64>();
        // Each kink lies between two directions.
        let kinks = kinks + 2.0 * ways.len() as f64 * direction_off;
        let size = far + length + most(|way| way.sizes[1]);
        let extent = far.max(length);
        let motion = Motion { course, ways, lengths, speed, start_time, curvature, kinks, extent, size, mismatch };
        let [start, end] = motion.times();
        let told = speed * (start.abs() + end.abs());
        // Written so that NaN is refused.
        let fits = start < end && start.abs().max(end.abs()).max(told) <= LARGEST;
        if !fits {
            return fail(format!(
                "its path of length {length:?} takes from time {start:?} to {end:?} at the `speed` {speed:?}; these must differ, and be at most \
                 {LARGEST:e}, as must be what it would cover in them: change the unit of time"
            ));
        }
        Ok(motion)
    }

    /// Length of the path.
    pub fn length(&self) -> f64 {
        self.lengths[self.ways.len()]
    }

    /// When it starts and arrives.
    pub fn times(&self) -> [f64; 2] {
        [self.start_time, self.start_time + self.length() / self.speed]
    }

    /// Its path.
    pub fn course(&self) -> &Course {
        &self.course
    }

    /// Where it is at a time: at the start before it starts, at the end once it has arrived.
    pub fn at(&self, time: f64) -> [f64; 2] {
        self.state(time).point
    }

    fn state(&self, time: f64) -> State {
        let [start, end] = self.times();
        let under_way = time.clamp(start, end);
        let travelled = (self.speed * (time - self.start_time)).clamp(0.0, self.length());
        let i = self.lengths.partition_point(|s| *s <= travelled).clamp(1, self.ways.len()) - 1;
        let Reached { point, tangent, missed } = self.ways[i].after(travelled - self.lengths[i]);
        // Along the path by what the length misses, and the roundings of lengths, times and points. Pieces are summed
        // up one by one.
        let off = missed
            + self.mismatch
            + ROUNDINGS * self.size
            + f64::EPSILON
                * (self.ways.len() as f64 * self.length() + 4.0 * self.speed * (under_way.abs() + self.start_time.abs()));
        if time <= start || time >= end {
            return State { point, tangent: [0.0; 2], off, tangent_off: 0.0, speed: 0.0, curvature: 0.0 };
        }
        let tangent = if tangent[0].is_finite() && tangent[1].is_finite() { tangent } else { [1.0, 0.0] };
        State {
            point,
            tangent,
            off,
            tangent_off: self.curvature * off + self.kinks + ROUNDINGS,
            speed: self.speed,
            curvature: self.curvature,
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
/// [`Verdict::Kept`] and [`Verdict::Violated`] are proved for the curves given, roundings included. The least
/// separation is enclosed to 1e-10 of the size of the scene (lengths and coordinates) where 100,000 stretches suffice;
/// the enclosure holds in any case.
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
        step();
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
        // What they cover until the end of the stretch.
        let (along_a, along_b) = (a.speed * half, b.speed * half);
        let v = [0, 1].map(|i| a.tangent[i] * along_a - b.tangent[i] * along_b);
        let by_speed = r[0].hypot(r[1]) - (along_a + along_b);
        // No squares of a speed or a time: they may leave the range of doubles.
        let bend = |s: &State, along: f64| (0.5 * (s.curvature * along) + s.tangent_off) * along;
        let by_curvature = nearest(r, v) - bend(&a, along_a) - bend(&b, along_b);
        let bound = if by_curvature > by_speed { by_curvature } else { by_speed };
        // Distances and bounds themselves round, by less than the roundings in `off`.
        self.waiting.push((bound - 2.0 * off).max(0.0), [from, to]);
    }
}

/// The least `|r + vτ|` for `|τ| <= 1`.
fn nearest(r: [f64; 2], v: [f64; 2]) -> f64 {
    let far = v[0].hypot(v[1]);
    if far == 0.0 {
        return r[0].hypot(r[1]);
    }
    let unit = v.map(|x| x / far);
    let along = (-(r[0] * unit[0] + r[1] * unit[1])).clamp(-far, far);
    (r[0] + unit[0] * along).hypot(r[1] + unit[1] * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{CubicBezier, PhQuintic};
    use crate::steps::counted;
    use crate::transition::{Arc, Cubic, Line};

    fn cubic(p: [[f64; 2]; 4]) -> Piece {
        let legs = std::array::from_fn(|i| [0, 1].map(|k| p[i + 1][k] - p[i][k]));
        Piece::Cubic(Cubic { points: CubicBezier { p }, legs })
    }

    /// Curves that coincide, touch, move in step or stand still, and a path of 20,000 pieces: a bounded number of stretches, and of steps of
    /// Newton's method in each of its two moments.
    #[test]
    fn every_question_ends() {
        let shape = |up: f64| cubic([[0.0, up], [1.0, up], [2.0, 1.0 + up], [3.0, 1.0 + up]]);
        let arc = |length: f64| Piece::Arc(Arc { start: [0.0; 2], start_direction: 0.0, curvature: 1.0, length });
        let line = |from: f64, to: f64| Piece::Line(Line { start: [from, 0.0], end: [to, 0.0] });
        let still = cubic([[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]);
        let many: Vec<Piece> = (0..20_000).map(|i| line(f64::from(i), f64::from(i + 1))).collect();
        let quintic: Piece = PhQuintic::new([0.0; 2], [[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]).into();
        let pairs = [
            (vec![shape(0.0)], vec![shape(0.0)]),
            (vec![shape(0.0)], vec![shape(1e-9)]),
            (vec![shape(0.0)], vec![shape(0.1)]),
            (vec![arc(1e6)], vec![arc(1e9)]),
            (vec![arc(3.0)], vec![line(-1.0, 1.0)]),
            (vec![still], vec![line(0.5, 2.0)]),
            (vec![quintic], vec![shape(0.0)]),
            (many.clone(), vec![line(2e4, 0.0)]),
            (many.clone(), many),
        ];
        for (one, two) in pairs {
            let [a, b] = [&one, &two].map(|pieces| Motion::new(pieces.iter().cloned(), 1.0, 0.0).unwrap());
            for minimum in [0.0, 1e-300, 1e-9, 0.1, 1e300] {
                let (steps, found) = counted(|| separation(&a, &b, minimum).unwrap());
                assert!(steps <= 13 * STRETCHES + 10_000, "{steps} {minimum:e} {found:?}");
                assert!(found.closest.at_least <= found.closest.at_most, "{found:?}");
            }
        }
    }
}
