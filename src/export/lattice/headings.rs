//! The directions of a lattice: those from the centre of a square to the points of its border.

use crate::curve::vector::{Vector, angle_of, scale};
use std::f64::consts::TAU;

/// Directions of travel, counter-clockwise from (1, 0), so that a straight line along each meets points of the grid.
///
/// They are not spaced evenly. A quarter turn leads from each to the one `quarter` places further, exactly.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Headings {
    /// Points on the border of the square.
    steps: Vec<[i64; 2]>,
}

impl Headings {
    /// `count` directions: a multiple of 8.
    pub(super) fn new(count: usize) -> Headings {
        let reach = (count / 8) as i64;
        let side = (-reach..reach).map(|along| [reach, along]);
        let mut steps: Vec<[i64; 2]> = side.collect();
        for i in 0..3 * steps.len() {
            let [x, y] = steps[i];
            steps.push([-y, x]);
        }
        steps.rotate_left(count / 8);
        Headings { steps }
    }

    pub(super) fn count(&self) -> usize {
        self.steps.len()
    }

    /// So many places are a quarter turn.
    pub(super) fn quarter(&self) -> usize {
        self.count() / 4
    }

    /// The place of a direction, so many places to the left of another.
    pub(super) fn beside(&self, place: usize, left: i64) -> usize {
        (place as i64 + left).rem_euclid(self.count() as i64) as usize
    }

    /// Of a direction, as a vector of cells.
    pub(super) fn step(&self, place: usize) -> [i64; 2] {
        self.steps[place]
    }

    /// The same vector, shortened to the first point of the grid.
    pub(super) fn first_point(&self, place: usize) -> [i64; 2] {
        let [x, y] = self.steps[place];
        let (mut a, mut b) = (x.abs(), y.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        [x / a, y / a]
    }

    /// A direction in radians, from 0 up to and without a full turn.
    pub(super) fn angle(&self, place: usize) -> f64 {
        let angle = angle_of(metres(self.steps[place], 1.0));
        if angle < 0.0 { angle + TAU } else { angle }
    }
}

/// A vector of cells in the unit of the resolution.
pub(super) fn metres(cells: [i64; 2], resolution: f64) -> Vector {
    scale(cells.map(|n| n as f64), resolution)
}

/// x y' - y x'.
pub(super) fn cross(a: [i64; 2], b: [i64; 2]) -> i64 {
    a[0] * b[1] - a[1] * b[0]
}

/// x x' + y y'.
pub(super) fn dot(a: [i64; 2], b: [i64; 2]) -> i64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_go_round_and_meet_the_grid() {
        let headings = Headings::new(16);
        let steps: Vec<_> = (0..5).map(|i| headings.step(i)).collect();
        assert_eq!(steps, [[2, 0], [2, 1], [2, 2], [1, 2], [0, 2]]);
        assert_eq!((headings.first_point(2), headings.first_point(13)), ([1, 1], [1, -2]));
        for count in [16, 24, 64] {
            let headings = Headings::new(count);
            assert_eq!(headings.count(), count);
            let angles: Vec<f64> = (0..count).map(|i| headings.angle(i)).collect();
            assert!(angles[0] == 0.0 && angles.windows(2).all(|w| w[0] < w[1]) && angles[count - 1] < TAU);
            for i in 0..count {
                let [x, y] = headings.step(i);
                assert_eq!(headings.step(headings.beside(i, count as i64 / 4)), [-y, x]);
                assert_eq!(headings.step(headings.beside(0, -(i as i64))), [x, -y]);
            }
        }
    }
}
