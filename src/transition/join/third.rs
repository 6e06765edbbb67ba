//! A third turn between two, of the limit of curvature. Its centre is at a known distance from either of theirs.

use super::costs::{Costs, Known, wrapped};
use super::request::Family;
use crate::curve::vector::{Vector, add, angle_of, dot};

/// To the left and to the right.
pub(super) const SIDES: [f64; 2] = [1.0, -1.0];
/// Its spirals are of this length, between curvature 0 and the limit.
pub(super) const LENGTH: f64 = 0.4;

/// From the centre of a turn to that of a third one to a side: how far, and in which direction, where the line between
/// them has the direction 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hop {
    far: f64,
    direction: f64,
}

/// Third turns, whatever they are between.
pub(super) struct Third {
    /// How far a spiral turns.
    angle: f64,
    /// What both spirals cost.
    spirals: Costs,
    /// As of a turn to each side.
    reach: [Vector; 2],
}

/// One between two turns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Between {
    /// +1 left.
    pub side: f64,
    /// How far its arc goes round.
    pub arc: f64,
    /// Directions of the places where it begins and ends.
    pub directions: [f64; 2],
    pub costs: Costs,
}

impl Third {
    pub(super) fn new(family: Family) -> Third {
        let exit = Known::of(family, 1.0, 0.0, LENGTH).rated(family);
        let reach = SIDES.map(|side| exit.to(side).reach());
        Third { angle: exit.spiral.angle(), spirals: exit.costs.and(exit.costs), reach }
    }

    /// Length of its spirals, at least.
    pub(super) fn least(&self) -> f64 {
        self.spirals.length[0]
    }

    /// From a turn of a reach: to third turns seen backwards, which turn to the left and to the right there.
    pub(super) fn hops(&self, reach: Vector) -> [Hop; 2] {
        self.reach.map(|other| {
            let hop = add(reach, other);
            Hop { far: dot(hop, hop).sqrt(), direction: angle_of(hop) }
        })
    }

    /// All between two turns, from the centre of the first to that of the second, that are no longer than `most`.
    ///
    /// The three centres are the corners of a triangle of known sides. `α` and `β` are its angles at the two centres.
    pub(super) fn between(&self, across: Vector, [a, b]: [&[Hop; 2]; 2], most: f64) -> [Option<Between>; 4] {
        let mut all = [None; 4];
        let apart = dot(across, across).sqrt();
        let mut straight = None;
        for (n, side) in SIDES.into_iter().enumerate() {
            // What is ahead of the first turn is seen backwards from there.
            let (into, out) = (a[1 - n], b[n]);
            let (r, s) = (into.far, out.far);
            if apart == 0.0 || apart >= r + s || apart <= (r - s).abs() {
                continue;
            }
            let straight = *straight.get_or_insert_with(|| angle_of(across));
            let x = 0.5 * (apart + (r - s) * (r + s) / apart);
            let y = ((r - x) * (r + x)).max(0.0).sqrt();
            let (alpha, beta) = (y.atan2(x), y.atan2(apart - x));
            for (m, flank) in SIDES.into_iter().enumerate() {
                let first = straight + flank * alpha - into.direction;
                let second = straight - flank * beta - out.direction;
                let arc = wrapped(side * (second - first) - 2.0 * self.angle);
                let costs = self.spirals.and(Costs::arc(1.0, arc));
                if costs.length[0] <= most {
                    all[2 * n + m] = Some(Between { side, arc, directions: [first, second], costs });
                }
            }
        }
        all
    }
}
