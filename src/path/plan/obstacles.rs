//! Polygons among which a path is planned: checked once, their sides in a tree.

use super::fail;
use crate::curve::vector::sub;
use crate::error::Result;
use robust::{Coord, orient2d};
use rstar::{AABB, Envelope, PointDistance, RTree, RTreeObject, SelectionFunction};
use std::cell::Cell;
use std::collections::HashSet;

/// Most vertices of all obstacles together: beyond them the search would take hours.
pub(super) const MOST_VERTICES: usize = 10_000;

type Point = [f64; 2];

/// A side of an obstacle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    pub ends: [Point; 2],
    /// The obstacle.
    pub obstacle: usize,
    /// Index of the vertex where it starts, in the ring without repeated vertices.
    pub index: usize,
}

impl RTreeObject for Side {
    type Envelope = AABB<Point>;
    fn envelope(&self) -> AABB<Point> {
        AABB::from_corners(self.ends[0], self.ends[1])
    }
}

impl PointDistance for Side {
    fn distance_2(&self, point: &Point) -> f64 {
        let d = to_segment(*point, self.ends);
        d * d
    }
}

/// Simple polygons, seen as their boundaries.
#[derive(Debug)]
pub(super) struct Obstacles {
    /// Vertices without repetition, counterclockwise; none of obstacles that do not matter.
    pub rings: Vec<Vec<Point>>,
    /// The largest coordinate.
    pub size: f64,
    tree: RTree<Side>,
    /// How many sides were looked at by [`Obstacles::near`].
    looks: Cell<usize>,
}

impl Obstacles {
    /// Checks that every polygon has three different vertices at least and a boundary that does not meet itself.
    pub(super) fn new(polygons: &[Vec<Point>]) -> Result<Obstacles> {
        let total: usize = polygons.iter().map(Vec::len).sum();
        if total > MOST_VERTICES {
            return fail(format!(
                "`obstacles` have {total} vertices together; at most {MOST_VERTICES} are planned for"
            ));
        }
        let mut rings = polygons.iter().enumerate().map(|(i, p)| ring(i, p)).collect::<Result<Vec<_>>>()?;
        let size = rings.iter().flatten().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        let sides = rings.iter().enumerate().flat_map(|(i, ring)| sides(i, ring)).collect();
        let obstacles = Obstacles { rings: vec![], size, tree: RTree::bulk_load(sides), looks: Cell::new(0) };
        obstacles.check_simple(&rings)?;
        rings.iter_mut().for_each(|ring| counterclockwise(ring));
        let needed = obstacles.needed(&rings);
        rings.iter_mut().zip(&needed).filter(|(_, needed)| !**needed).for_each(|(ring, _)| ring.clear());
        let sides = obstacles.tree.iter().filter(|side| needed[side.obstacle]).copied().collect();
        Ok(Obstacles { rings, size, tree: RTree::bulk_load(sides), looks: Cell::new(0) })
    }

    /// Which polygons matter: not a copy of an earlier one, and none that lies wholly inside of another.
    ///
    /// From a point outside of that one it is no nearer than that, and a path that starts outside and touches no side
    /// never gets in. So what is left parts and blocks the same, and the work does not grow with what is redundant.
    fn needed(&self, rings: &[Vec<Point>]) -> Vec<bool> {
        let mut seen = HashSet::new();
        let mut needed: Vec<bool> = rings.iter().map(|ring| seen.insert(canonical(ring))).collect();
        let bounds: Vec<AABB<Point>> = rings.iter().map(AABB::from_points).collect();
        let within = |i: usize, j: usize| {
            let (inner, outer) = (&bounds[i], &bounds[j]);
            let meets = |side: Side| {
                let others = self.tree.locate_in_envelope_intersecting(side.envelope());
                others.filter(|other| other.obstacle == j).any(|other| cross(side.ends, other.ends))
            };
            outer.contains_envelope(inner) && holds(&rings[j], rings[i][0]) && !sides(i, &rings[i]).any(meets)
        };
        for (i, needed) in needed.iter_mut().enumerate() {
            // An outermost polygon is within none, so that what holds a polygon is never dropped for good.
            *needed = *needed && !(0..rings.len()).any(|j| j != i && within(i, j));
        }
        needed
    }

    /// All sides.
    pub(super) fn sides(&self) -> impl Iterator<Item = &Side> {
        self.tree.iter()
    }

    /// Sides that may be within a distance of a segment: all that are, and some more.
    pub(super) fn near(&self, segment: [Point; 2], within: f64) -> impl Iterator<Item = &Side> {
        self.tree
            .locate_with_selection_function(Near::new(segment, within, self.size))
            .inspect(|_| self.looks.set(self.looks.get() + 1))
    }

    /// How many sides [`Obstacles::near`] has given so far: what work is measured by where many sides nearly coincide.
    pub(super) fn looks(&self) -> usize {
        self.looks.get()
    }

    /// The side nearest to a point, about.
    pub(super) fn nearest(&self, point: Point) -> Option<&Side> {
        self.tree.nearest_neighbor(point)
    }

    /// The obstacle that holds a point, boundary included: exact.
    pub(super) fn holding(&self, point: Point) -> Option<usize> {
        self.rings.iter().position(|ring| holds(ring, point))
    }

    fn check_simple(&self, rings: &[Vec<Point>]) -> Result<()> {
        for side in self.tree.iter() {
            let count = rings[side.obstacle].len();
            let others = self.tree.locate_in_envelope_intersecting(side.envelope());
            for other in others.filter(|other| other.obstacle == side.obstacle && other.index > side.index) {
                let (apart, back) = (other.index - side.index, side.index + count - other.index);
                let meet = match (apart, back) {
                    (1, _) => folds(side.ends, other.ends[1]),
                    (_, 1) => folds(other.ends, side.ends[1]),
                    _ => cross(side.ends, other.ends),
                };
                if meet {
                    return fail(format!(
                        "obstacles[{}] meets itself: the side from {:?} to {:?} and the one from {:?} to {:?}; split \
                         it into simple polygons",
                        side.obstacle, side.ends[0], side.ends[1], other.ends[0], other.ends[1]
                    ));
                }
            }
        }
        Ok(())
    }
}

/// The vertices, without those that repeat their predecessor.
fn ring(i: usize, polygon: &[Point]) -> Result<Vec<Point>> {
    for (j, vertex) in polygon.iter().enumerate() {
        crate::path::finite("plan", &format!("obstacles[{i}][{j}]"), vertex)?;
    }
    let mut ring = polygon.to_vec();
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    match ring.len() {
        0..3 => fail(format!("obstacles[{i}] has {} different vertices; a polygon has 3 at least", ring.len())),
        _ => Ok(ring),
    }
}

fn sides(obstacle: usize, ring: &[Point]) -> impl Iterator<Item = Side> {
    (0..ring.len()).map(move |index| Side { ends: [ring[index], ring[(index + 1) % ring.len()]], obstacle, index })
}

/// The bits of a counterclockwise ring from its lowest, then leftmost, vertex on: the same for copies, wherever their
/// lists begin.
fn canonical(ring: &[Point]) -> Vec<[u64; 2]> {
    let mut all = ring.to_vec();
    all.rotate_left(lowest(ring));
    // Adding 0 makes -0 the ordinary 0.
    all.into_iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect()
}

/// The lowest, then leftmost, vertex.
fn lowest(ring: &[Point]) -> usize {
    let key = |p: &Point| (p[1], p[0]);
    (0..ring.len()).fold(0, |best, i| if key(&ring[i]) < key(&ring[best]) { i } else { best })
}

/// Turns the ring round where it runs clockwise. Its lowest, then leftmost, vertex is convex, so its turn decides.
fn counterclockwise(ring: &mut [Point]) {
    let (n, lowest) = (ring.len(), lowest(ring));
    if turn([ring[(lowest + n - 1) % n], ring[lowest]], ring[(lowest + 1) % n]) < 0.0 {
        ring.reverse();
    }
}

/// Positive for a point to the left of the line, negative to the right: the sign is exact.
pub(super) fn turn([a, b]: [Point; 2], c: Point) -> f64 {
    let coord = |p: Point| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether a side that goes on from the end of another runs back over it.
fn folds([a, b]: [Point; 2], c: Point) -> bool {
    let back = |i: usize| (c[i] - b[i]) * (b[i] - a[i]) < 0.0;
    turn([a, b], c) == 0.0 && (back(0) || back(1))
}

/// Whether two segments have a point in common: exact.
pub(super) fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let signs = [turn([a, b], c), turn([a, b], d), turn([c, d], a), turn([c, d], b)].map(sign);
    if signs == [0; 4] {
        // On one line: they meet where their boxes do.
        return (0..2).all(|i| a[i].max(b[i]) >= c[i].min(d[i]) && c[i].max(d[i]) >= a[i].min(b[i]));
    }
    signs[0] * signs[1] <= 0 && signs[2] * signs[3] <= 0
}

fn sign(x: f64) -> i32 {
    i32::from(x > 0.0) - i32::from(x < 0.0)
}

/// Whether a simple polygon holds a point, boundary included: exact.
fn holds(ring: &[Point], p: Point) -> bool {
    let mut inside = false;
    for side in sides(0, ring) {
        let [a, b] = side.ends;
        if cross([p, p], [a, b]) {
            return true;
        }
        // Each side that crosses the ray to the right, its upper end not counted.
        if (a[1] > p[1]) != (b[1] > p[1]) {
            let left = turn([a, b], p) > 0.0;
            inside ^= left == (b[1] > a[1]);
        }
    }
    inside
}

/// Distance of a point from a segment.
///
/// # Accuracy
/// 16 units of 2^-53 of the largest distance among the three points: an error of the foot moves it along the segment by
/// no more.
pub(super) fn to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (d, v, share) = (sub(b, a), sub(p, a), foot(p, [a, b]));
    (v[0] - share * d[0]).hypot(v[1] - share * d[1])
}

/// How far along a segment, as a share of it, its point nearest to p is: an error moves that along the segment.
pub(super) fn foot(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (d, v) = (sub(b, a), sub(p, a));
    let square = d[0] * d[0] + d[1] * d[1];
    if square > 0.0 { ((d[0] * v[0] + d[1] * v[1]) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// How far along the first line, as a share of the first segment, the second one crosses it, about; not finite for
/// parallel ones.
pub(super) fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let (p, q, r) = (sub(b, a), sub(d, c), sub(c, a));
    (r[0] * q[1] - r[1] * q[0]) / (p[0] * q[1] - p[1] * q[0])
}

/// The point at a share of a segment; its ends exactly.
pub(super) fn along([a, b]: [Point; 2], share: f64) -> Point {
    let d = sub(b, a);
    if share == 1.0 { b } else { [a[0] + share * d[0], a[1] + share * d[1]] }
}

/// Distance of two segments, as accurate as [`to_segment`]; whether they cross is exact.
pub(super) fn between(one: [Point; 2], two: [Point; 2]) -> f64 {
    let ends = [to_segment(one[0], two), to_segment(one[1], two), to_segment(two[0], one), to_segment(two[1], one)];
    let least = ends.into_iter().fold(f64::INFINITY, f64::min);
    if least > 0.0 && cross(one, two) { 0.0 } else { least }
}

/// Boxes that may be within a distance of a segment.
struct Near {
    start: Point,
    low: Point,
    high: Point,
    along: Point,
    length: f64,
    within: f64,
}

impl Near {
    /// Of boxes whose coordinates are no larger than `size`.
    fn new([a, b]: [Point; 2], within: f64, size: f64) -> Near {
        let along = sub(b, a);
        let size = a.iter().chain(&b).fold(size, |most, x| most.max(x.abs()));
        Near {
            start: a,
            low: [0, 1].map(|i| a[i].min(b[i])),
            high: [0, 1].map(|i| a[i].max(b[i])),
            along,
            length: along[0].hypot(along[1]),
            within: within + 1e-12 * size,
        }
    }
}

impl SelectionFunction<Side> for Near {
    /// Not when a line along an axis or along the segment keeps them further apart, by more than rounding.
    fn should_unpack_parent(&self, envelope: &AABB<Point>) -> bool {
        let Near { start: a, along: d, length, within, .. } = *self;
        let (low, high) = (envelope.lower(), envelope.upper());
        if (0..2).any(|i| self.low[i] - high[i] > within || low[i] - self.high[i] > within) {
            return false;
        }
        // Distance of the box's middle from the line, and how far the box reaches across it.
        let middle = [0.5 * (low[0] + high[0]) - a[0], 0.5 * (low[1] + high[1]) - a[1]];
        let across = (d[0] * middle[1] - d[1] * middle[0]).abs();
        let extent = 0.5 * (d[0].abs() * (high[1] - low[1]) + d[1].abs() * (high[0] - low[0]));
        across - extent <= within * length
    }

    fn should_unpack_leaf(&self, leaf: &Side) -> bool {
        self.should_unpack_parent(&leaf.envelope())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    #[test]
    fn no_side_is_overlooked() {
        let mut noise = Noise(1);
        let mut triangle = || {
            let [x, y] = [0, 1].map(|_| 9.0 * noise.next());
            [0, 1, 2].map(|_| [x + noise.next(), y + noise.next()]).to_vec()
        };
        let polygons: Vec<_> = (0..200).map(|_| triangle()).collect();
        let obstacles = Obstacles::new(&polygons).unwrap();
        let all: Vec<Side> = obstacles.tree.iter().copied().collect();
        let (mut found, mut left_out) = (0, 0);
        for i in 0..500 {
            let mut point = || [0, 1].map(|_| 10.0 * noise.next());
            let from = point();
            let segment = [from, if i % 5 == 0 { from } else { point() }];
            let within = noise.next().powi(3);
            let near: Vec<&Side> = obstacles.near(segment, within).collect();
            let close = all.iter().filter(|side| between(segment, side.ends) <= within).collect::<Vec<_>>();
            assert!(close.iter().all(|side| near.contains(side)));
            found += close.len();
            left_out += all.len() - near.len();
            let nearest = obstacles.nearest(from).unwrap();
            assert!(
                all.iter().all(|side| to_segment(from, side.ends) >= to_segment(from, nearest.ends) * (1.0 - 1e-12))
            );
        }
        assert!(found > 1000 && left_out > 100_000, "{found} {left_out}");
    }

    #[test]
    fn crossings_are_exact() {
        let (a, b) = ([0.1, 0.1], [0.7, 0.7]);
        // On the line to the last bit, and one bit beside it.
        let on = [0.3, 0.3];
        let beside = [0.3, 0.3f64.next_up()];
        assert!(cross([a, b], [on, [0.3, 5.0]]) && !cross([a, b], [beside, [0.3, 5.0]]));
        assert!(cross([a, b], [on, on]) && !cross([a, b], [beside, beside]));
        assert!(cross([a, b], [b, [0.9, 0.9]]) && !cross([a, b], [[0.8, 0.8], [0.9, 0.9]]));
        let ring = [a, [0.9, 0.1], b];
        assert!(holds(&ring, on) && !holds(&ring, beside) && holds(&ring, [0.3f64.next_up(), 0.3]));
        assert_eq!((between([a, b], [on, [0.3, 5.0]]), between([a, a], [[0.1, 0.4], [0.1, 0.3]])), (0.0, 0.3 - 0.1));
    }
}
