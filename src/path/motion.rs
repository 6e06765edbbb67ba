//! A vehicle that travels along its path at a constant speed: where it is, and by how much that may be wrong.

use super::way::{Reached, Way};
use super::{Course, ROUNDINGS, distance};
use crate::error::{Error, Result, finite, positive};
use crate::transition::Piece;

/// Times, and lengths covered in them, are at most this.
const LARGEST: f64 = 1e140;
/// Directions that differ by no more where pieces join are a matter of rounding.
const SMOOTH: f64 = 1e-6;

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
pub(super) struct State {
    pub point: [f64; 2],
    pub tangent: [f64; 2],
    pub off: f64,
    pub tangent_off: f64,
    pub speed: f64,
    pub curvature: f64,
}

impl Motion {
    /// Along pieces that join, at a constant speed, from a time on.
    ///
    /// # Errors
    /// [`Error::Domain`] without a piece, for an involute, for pieces that [`Course::new`] refuses, a path of no
    /// length, a speed not above 0, or a number not finite.
    pub fn new<P: Into<Piece>>(pieces: impl IntoIterator<Item = P>, speed: f64, start_time: f64) -> Result<Motion> {
        positive("motion: `speed`", speed)?;
        finite("motion: `start_time`", start_time)?;
        let course = Course::new(pieces.into_iter().map(Into::into).collect())?;
        let way = |(i, piece)| Way::new(piece).map_err(|e| Error::invalid(format!("pieces[{i}] {e}")));
        let ways = course.pieces().iter().enumerate().map(way).collect::<Result<Vec<Way>>>()?;
        let mut lengths = vec![0.0];
        for way in &ways {
            lengths.push(lengths[lengths.len() - 1] + way.length);
        }
        let length = lengths[lengths.len() - 1];
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::invalid(format!("motion: its path is {length:?} long; it must have a length")));
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
        let traveled = speed * (start.abs() + end.abs());
        // Written so that NaN is refused.
        let fits = start < end && start.abs().max(end.abs()).max(traveled) <= LARGEST;
        if !fits {
            return Err(Error::invalid(format!(
                "motion: its path of length {length:?} takes from time {start:?} to {end:?} at the `speed` {speed:?}; \
                 these must differ, and be at most {LARGEST:e}, as must be what it would cover in them: change the \
                 unit of time"
            )));
        }
        Ok(motion)
    }

    /// Length of the path.
    pub fn length(&self) -> f64 {
        self.lengths[self.ways.len()]
    }

    /// Its length or its largest coordinate.
    pub(super) fn extent(&self) -> f64 {
        self.extent
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

    /// The piece on which it is at a time, and how far along that.
    fn piece(&self, time: f64) -> (usize, f64) {
        let travelled = (self.speed * (time - self.start_time)).clamp(0.0, self.length());
        let i = self.lengths.partition_point(|s| *s <= travelled).clamp(1, self.ways.len()) - 1;
        (i, travelled - self.lengths[i])
    }

    pub(super) fn state(&self, time: f64) -> State {
        let [start, end] = self.times();
        let under_way = time.clamp(start, end);
        let (i, local) = self.piece(time);
        let Reached { point, tangent, missed } = self.ways[i].after(local);
        // Along the path by what the length misses, and the roundings of lengths, times and points. Pieces are summed
        // up one by one.
        let off = missed
            + self.mismatch
            + ROUNDINGS * self.size
            + f64::EPSILON
                * (self.ways.len() as f64 * self.length()
                    + 4.0 * self.speed * (under_way.abs() + self.start_time.abs()));
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

    /// By how much the way from one vehicle to the other changes in a time, at most, but for four times what both
    /// points may be off; infinite unless both go along pieces of the same shapes at the same speed.
    ///
    /// The other one is ahead along that shape by a constant length c, and `|x(s) - x(s + c)| <= |c|`: that changes by
    /// 2 |c|. Where shapes differ by roundings, points at the same length along a piece differ by no more than
    /// [`Way::unlike`] more than they did at its start, and so do lengths. What the points may be off covers the
    /// roundings of c, twice, and the jumps of both paths.
    pub(super) fn drift(&self, other: &Motion, [from, to]: [f64; 2]) -> f64 {
        let under_way = |motion: &Motion| motion.times()[0] <= from && to <= motion.times()[1];
        if self.speed != other.speed || !under_way(self) || !under_way(other) {
            return f64::INFINITY;
        }
        let [(first, along), (other_first, other_along)] = [self.piece(from), other.piece(from)];
        let [(last, _), (other_last, _)] = [self.piece(to), other.piece(to)];
        if last - first != other_last - other_first {
            return f64::INFINITY;
        }
        let mut drift = 2.0 * (along - other_along).abs();
        for (one, two) in self.ways[first..=last].iter().zip(&other.ways[other_first..=other_last]) {
            drift += 4.0 * one.unlike(two);
            if drift.is_infinite() {
                break;
            }
        }
        drift
    }
}
