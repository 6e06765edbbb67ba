//! Where a path may have its corners: beside the convex vertices of obstacles.

use super::obstacles::{Obstacles, along, meet};
use crate::curve::vector::sub;
use crate::path::Turn;

type Point = [f64; 2];

/// Turns sharper than this need more room than anyone has: cosine of half the angle.
const SHARPEST: f64 = 0.1;
/// The turn at a vertex is also cut into this many, each above 20 degrees.
const PARTS: i32 = 2;
const LEAST_PART: f64 = 0.35;
/// The turn at a vertex sharper than this is cut further off, too.
const SHARP: f64 = 2.1;

/// The bits of a double that are its exponent.
const EXPONENT: u64 = 0x7ff << 52;
/// Bends below this are gentle.
const GENTLE: f64 = 0.26;

/// A vertex of an obstacle and its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub at: Point,
    pub obstacle: usize,
    before: Point,
    after: Point,
}

/// A point where a path may turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub at: Point,
    /// The vertex that it turns around; none at start and goal.
    pub vertex: Option<Vertex>,
    /// Whether it is further off than the turn needs: then lines may lead there that only begin beside the sides around
    /// the vertex.
    pub wide: bool,
}

/// Places beside vertices nearly coincide where they and their vertices lie in one cell of a lattice; its step is this
/// share of their distance, or up to half of that. One of them will do for all: a leg to it is as clear as one to
/// another but for the diagonal of a cell, √2 2^-16 of the distance, and places are 1.001 times as far off the sides as
/// the turn needs, which is 0.1 of the distance at least ([`SHARPEST`]).
const CELL: f64 = 1.0 / 65536.0;

impl Place {
    /// The step of the lattice, and the cell in which the place and its vertex lie; none for places without a vertex.
    pub(super) fn cell(&self) -> Option<[u64; 5]> {
        let vertex = self.vertex?.at;
        let far = sub(self.at, vertex);
        // The power of 2 below it.
        let step = f64::from_bits((CELL * far[0].hypot(far[1])).to_bits() & EXPONENT);
        let [x, y, u, v] = [self.at[0], self.at[1], vertex[0], vertex[1]].map(|x| ((x / step).floor() + 0.0).to_bits());
        Some([step.to_bits(), x, y, u, v])
    }

    /// On which side of a line through the place its vertex is, when the obstacle's boundary stays there for a while: 1
    /// is left; 0 for start and goal. `None` when it does not: shortest paths do not turn there.
    pub(super) fn side(&self, along: Point) -> Option<i8> {
        let Some(Vertex { at, before, after, .. }) = self.vertex else { return Some(0) };
        let from = |p: Point| sub(p, self.at);
        let across = |v: Point| along[0] * v[1] - along[1] * v[0];
        let vertex = from(at);
        // Places are not equally far off, so lines that come near a wall slowly must do.
        let awhile = 4.0 * vertex[0].hypot(vertex[1]);
        let wall = |p: Point| {
            let leg = sub(p, at);
            let share = (awhile / leg[0].hypot(leg[1])).min(1.0);
            across([vertex[0] + share * leg[0], vertex[1] + share * leg[1]])
        };
        let (here, walls) = (across(vertex), [wall(before), wall(after)]);
        match here {
            _ if self.wide && here != 0.0 => Some(if here > 0.0 { 1 } else { -1 }),
            _ if here > 0.0 && walls.iter().all(|w| *w >= 0.0) => Some(1),
            _ if here < 0.0 && walls.iter().all(|w| *w <= 0.0) => Some(-1),
            _ => None,
        }
    }
}

/// Places beside convex vertices.
///
/// # Arguments
/// - `keep`: distance to keep.
/// - `most`: greatest curvature.
/// - `wide`: how much further off, in least radii.
pub(super) fn places(obstacles: &Obstacles, keep: f64, most: f64, wide: f64) -> Vec<Place> {
    let vertices = obstacles.rings.iter().enumerate().flat_map(|(obstacle, ring)| convex(obstacle, ring));
    vertices.flat_map(|v| beside(v, keep, most, wide)).collect()
}

/// The convex vertices of a polygon. Of gentle bends in a row there is one, where the sides around them would meet: so
/// round things have few.
fn convex(obstacle: usize, ring: &[Point]) -> Vec<Vertex> {
    let n = ring.len();
    let at = |i: usize| ring[i % n];
    let bend = |i: usize| Turn::new(sub(at(i), at(i + n - 1)), sub(at(i + 1), at(i))).map_or(0.0, |turn| turn.angle());
    let gentle = |bend: f64| bend > 0.0 && bend < GENTLE;
    let (mut all, mut first) = (vec![], 0);
    while first < n {
        let (mut last, mut sum) = (first, bend(first));
        while gentle(bend(first)) && last + 1 < n && gentle(bend(last + 1)) && sum + bend(last + 1) < 2.0 * GENTLE {
            last += 1;
            sum += bend(last);
        }
        let (before, after) = (at(first + n - 1), at(last + 1));
        let sides = [[before, at(first)], [after, at(last)]];
        let corner = if first == last { at(first) } else { along(sides[0], meet(sides[0], sides[1])) };
        if sum > 0.0 {
            all.push(Vertex { at: corner, obstacle, before, after });
        }
        first = last + 1;
    }
    all
}

/// The corners of the offset polygon: one, and those that cut it off in two and three.
fn beside(vertex: Vertex, keep: f64, most: f64, wide: f64) -> Vec<Place> {
    let Vertex { at, before, after, .. } = vertex;
    let (incoming, outgoing) = (sub(at, before), sub(after, at));
    let Some(whole) = Turn::new(incoming, outgoing) else { return vec![] };
    let (angle, first) = (whole.angle(), incoming[1].atan2(incoming[0]) - std::f64::consts::FRAC_PI_2);

    let most_parts = if wide > 0.0 && angle < SHARP { 1 } else { PARTS };
    let parts = (1..=most_parts).map(|parts| (f64::from(parts), angle / f64::from(parts)));
    let offset = |(parts, part): (f64, f64)| {
        let turn = Turn::new([1.0, 0.0], [part.cos(), part.sin()])?;
        let fair = (0.5 * part).cos() > SHARPEST && (parts == 1.0 || part > LEAST_PART);
        // A little more than the curve needs, which is known to 1e-3.
        let offset = 1.001 * turn.least_offset(keep, most).max(keep) + wide / most;
        fair.then_some((parts, part, offset / (0.5 * part).cos()))
    };
    let points = |(parts, part, far): (f64, f64, f64)| {
        (0..parts as i32).map(move |i| {
            let direction = first + part * (f64::from(i) + 0.5);
            Place {
                at: [at[0] + far * direction.cos(), at[1] + far * direction.sin()],
                vertex: Some(vertex),
                wide: wide > 0.0,
            }
        })
    };
    parts.filter_map(offset).flat_map(points).collect()
}
