//! Where a path may have corners away from all obstacles, which it needs when it must turn more gently than around
//! vertices.

use super::obstacles::Obstacles;
use super::places::Place;
use super::search::{Limits, is_clear};
use crate::curve::vector::sub;
use std::cmp::Reverse;

type Point = [f64; 2];

/// How far places are from an end, and from the box around everything, in least radii.
const FAR: [f64; 7] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
/// Neighbouring directions from an end are no further apart, radians.
const APART: f64 = 0.8;

/// Places that the ends see far ahead, in directions at least `close` radians apart, and places around everything.
///
/// So there are no more than 7 for each `close` of a turn around either end, and 56 around everything, however crowded
/// it is.
pub(super) fn open(
    obstacles: &Obstacles,
    ends: [Point; 2],
    beside: &[Place],
    limits: &Limits,
    close: f64,
) -> Vec<Place> {
    let ahead = ends.into_iter().flat_map(|end| ahead(obstacles, end, beside, limits, close));
    ahead.chain(around(obstacles, ends, limits.most)).map(|at| Place { at, vertex: None, wide: true }).collect()
}

/// What an end sees in directions to places beside vertices and between those, so through the middle of gaps, too; of
/// close directions in the one where it sees furthest.
fn ahead(obstacles: &Obstacles, end: Point, beside: &[Place], limits: &Limits, close: f64) -> Vec<Point> {
    let clear = |at: Point| is_clear(obstacles, [end, at], limits.keep);
    let seen = beside.iter().filter(|place| clear(place.at)).map(|place| sub(place.at, end));
    let mut angles: Vec<f64> = seen.map(|d| d[1].atan2(d[0])).collect();
    angles.sort_by(f64::total_cmp);
    if angles.is_empty() {
        angles.push(0.0);
    }
    angles.push(angles[0] + std::f64::consts::TAU);
    let between = |w: &[f64]| {
        let parts = ((w[1] - w[0]) / APART).ceil().max(2.0);
        let (from, step) = (w[0], (w[1] - w[0]) / parts);
        (0..parts as i32).map(move |i| from + step * f64::from(i))
    };
    let points = |angle: f64| {
        let at = move |far: &f64| [end[0] + far / limits.most * angle.cos(), end[1] + far / limits.most * angle.sin()];
        (angle, FAR.iter().map(at).take_while(|at| clear(*at)).collect::<Vec<_>>())
    };
    let mut rays: Vec<(f64, Vec<Point>)> = angles.windows(2).flat_map(between).map(points).collect();
    rays.sort_by_key(|(_, points)| Reverse(points.len()));
    let mut kept: Vec<(f64, Vec<Point>)> = vec![];
    for ray in rays {
        if kept.iter().all(|(angle, _)| (ray.0 - angle).cos() < close.cos()) {
            kept.push(ray);
        }
    }
    kept.into_iter().flat_map(|(_, points)| points).collect()
}

/// Corners and middles of the sides of growing boxes around everything.
fn around(obstacles: &Obstacles, ends: [Point; 2], most: f64) -> impl Iterator<Item = Point> {
    let points = obstacles.rings.iter().flatten().copied().chain(ends);
    let bounds =
        |[low, high]: [Point; 2], p: Point| [[0, 1].map(|i| p[i].min(low[i])), [0, 1].map(|i| p[i].max(high[i]))];
    let [low, high] = points.fold([ends[0]; 2], bounds);
    let steps = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j])).filter(|step| *step != [0, 0]);
    FAR.iter().flat_map(move |far| {
        let at = move |step: [i32; 2]| {
            [0, 1].map(|i| 0.5 * (low[i] + high[i]) + f64::from(step[i]) * (0.5 * (high[i] - low[i]) + far / most))
        };
        steps.clone().map(at)
    })
}
