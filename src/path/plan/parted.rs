//! Whether obstacles, grown by the clearance, part start from goal: exact up to rounding, and independent of curvature.

use super::obstacles::{Obstacles, Side, along, between, cross, foot, meet, turn};
use crate::path::distance;

type Point = [f64; 2];

/// Pairs of sides looked at, at most.
const PAIRS: usize = 20_000_000;

/// A union-find structure whose members also know whether the way to their root crosses from one side of the segment to
/// the other.
struct Groups {
    parent: Vec<usize>,
    odd: Vec<bool>,
}

impl Groups {
    /// The root, and whether the way there is odd.
    fn root(&mut self, member: usize) -> (usize, bool) {
        let (mut at, mut odd) = (member, false);
        while self.parent[at] != at {
            // Halving the way keeps it short.
            let next = self.parent[at];
            self.odd[at] ^= self.odd[next];
            self.parent[at] = self.parent[next];
            odd ^= self.odd[at];
            at = self.parent[at];
        }
        (at, odd)
    }

    /// Joins two members by a way; false when that closes an odd loop.
    fn join(&mut self, one: usize, two: usize, odd: bool) -> bool {
        let ((a, from_one), (b, from_two)) = (self.root(one), self.root(two));
        let odd = odd ^ from_one ^ from_two;
        if a == b {
            return !odd;
        }
        (self.parent[a], self.odd[a]) = (b, odd);
        true
    }
}

/// Whether no path from start to goal keeps the clearance, proved: some loop of sides, and of steps between sides less
/// than twice the clearance apart, goes around one of the two alone.
///
/// Such a loop is nowhere as far as the clearance from obstacles, and it crosses the segment between the ends an odd
/// number of times. Without such a loop there is a path, for the plane is simply connected. `slack` covers the
/// roundings of distances.
pub(super) fn parted(obstacles: &Obstacles, ends: [Point; 2], clearance: f64, slack: f64) -> bool {
    let sides: Vec<&Side> = obstacles.sides().collect();
    let firsts = firsts(obstacles);
    let number = |side: &Side| firsts[side.obstacle] + side.index;
    let mut groups = Groups { parent: (0..sides.len()).collect(), odd: vec![false; sides.len()] };
    let within = 2.0 * clearance - slack;
    let mut pairs = 0;
    for one in sides {
        for two in obstacles.near(one.ends, within.max(0.0)) {
            if number(two) <= number(one) {
                continue;
            }
            pairs += 1;
            if pairs > PAIRS {
                return false;
            }
            let Some(way) = way(one, two, within) else { continue };
            let odd = way.windows(2).filter(|w| crosses([w[0], w[1]], ends)).count() % 2 == 1;
            if !groups.join(number(one), number(two), odd) {
                return true;
            }
        }
    }
    false
}

/// Of each obstacle the number of its first side.
fn firsts(obstacles: &Obstacles) -> Vec<usize> {
    let counts = obstacles.rings.iter().map(Vec::len);
    counts.scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count))).collect()
}

/// From the start of one side along it, over to another side, and along that to its start; none where they are too far
/// apart.
fn way(one: &Side, two: &Side, within: f64) -> Option<[Point; 4]> {
    let (one, two) = (one.ends, two.ends);
    let nearest = |p: Point, side: [Point; 2]| along(side, foot(p, side));
    let ([a, b], [c, d]) = (one, two);
    let steps = [(a, nearest(a, two)), (b, nearest(b, two)), (nearest(c, one), c), (nearest(d, one), d)];
    let length = |(p, q): &(Point, Point)| distance(*p, *q);
    let least = steps.into_iter().min_by(|x, y| length(x).total_cmp(&length(y)))?;
    if cross(one, two) {
        let share = meet(one, two).clamp(0.0, 1.0);
        let at = if share.is_finite() { along(one, share) } else { least.0 };
        return Some([a, at, at, c]);
    }
    (between(one, two) < within).then_some([a, least.0, least.1, c])
}

/// Whether a segment leads across the one between the ends. Points on their line count as right of it, so the loops
/// that this counts for may be moved a little; the ends are on none.
fn crosses([p, q]: [Point; 2], ends: [Point; 2]) -> bool {
    (turn(ends, p) > 0.0) != (turn(ends, q) > 0.0) && (turn([p, q], ends[0]) > 0.0) != (turn([p, q], ends[1]) > 0.0)
}
