//! Turns: from a state over an arc to a straight end.

use super::request::{Family, Objective};
use super::spiral::{Pose, Spiral};
use crate::curve::vector::{Vector, add, scale, turn, unit};
use std::f64::consts::TAU;

/// Curvatures of arcs in units of the limit, and lengths of spirals in units of the least radius, for the shortest
/// join.
const SHORT: &[(f64, f64)] = &[(1.0, 0.4), (1.0, 0.8), (0.5, 0.4), (0.25, 0.8), (0.125, 0.8)];
/// The same for gentle joins. A spiral turns by at most 0.6 rad, where both families' are proved.
const GENTLE: &[(f64, f64)] = &[
    (1.0, 0.4),
    (1.0, 1.2),
    (0.5, 0.8),
    (0.5, 2.4),
    (0.25, 0.8),
    (0.25, 2.4),
    (0.25, 4.8),
    (0.125, 2.4),
    (0.125, 4.8),
];
/// So near, spirals of the usual length may have no room.
const NEAR: f64 = 2.0;
/// The length of the spirals there.
pub(super) const LEAST: f64 = 0.1;
/// Below this an arc goes on about a centre too far away to be of use.
const HELD: f64 = 1.0 / 64.0;
/// An arc of less than this, radians, is a rounding.
const ROUNDING: f64 = 1e-13;

/// A turn that may be left in any direction, in units of the least radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// What leads to the arc.
    pub before: [Option<Spiral>; 2],
    /// Curvature of the arc.
    pub curvature: f64,
    /// Direction at the arc's start.
    pub heading: f64,
    /// Centre of the arc.
    pub centre: Vector,
    /// From the arc to curvature 0; a turn by nothing has none.
    pub exit: Option<Spiral>,
    /// Length of its spirals, nearly.
    pub long: f64,
    /// From the centre to where it ends, for the direction (1, 0) there.
    pub reach: Vector,
}

impl Turn {
    /// Left in a direction, how far its arc goes round, radians from 0 to a full turn.
    pub(super) fn arc(&self, direction: f64) -> f64 {
        let exit = self.exit.map_or(0.0, |exit| exit.angle());
        wrapped(self.curvature.signum() * (direction - exit - self.heading))
    }

    fn spirals(&self) -> impl Iterator<Item = &Spiral> {
        self.before.iter().chain([&self.exit]).flatten()
    }

    /// Left after an arc, its length, nearly.
    pub(super) fn length(&self, arc: f64) -> f64 {
        let round = if arc == 0.0 { 0.0 } else { arc / self.curvature.abs() };
        self.long + round
    }

    /// What it costs, nearly.
    pub(super) fn cost(&self, arc: f64, objective: Objective) -> f64 {
        match objective {
            Objective::Length => self.length(arc),
            Objective::GreatestCurvature => self.curvature.abs(),
            Objective::GreatestRate => self.spirals().map(Spiral::rate).fold(0.0, f64::max),
            Objective::BendingEnergy => {
                self.spirals().map(Spiral::bending_energy).sum::<f64>() + arc * self.curvature.abs()
            }
        }
    }

    /// How many pieces it has.
    pub(super) fn pieces(&self, arc: f64) -> usize {
        self.spirals().count() + usize::from(arc > 0.0)
    }
}

/// An angle within 0 and a full turn; a rounding from either is 0.
pub(super) fn wrapped(angle: f64) -> f64 {
    let angle = angle.rem_euclid(TAU);
    if angle <= ROUNDING || angle >= TAU - ROUNDING { 0.0 } else { angle }
}

/// From the centre of a turn to its straight end, seen along the direction there.
pub(super) fn reach(family: Family, exit: &Spiral) -> Vector {
    let [x, y] = exit.step(family);
    let (sin, cos) = exit.angle().sin_cos();
    turn([cos, -sin], [x, y - 1.0 / exit.from])
}

/// All turns from a pose with a curvature, both in units of the least radius, towards a place at a distance.
pub(super) fn turns(family: Family, at: Pose, curvature: f64, objective: Objective, apart: f64) -> Vec<Turn> {
    let rungs = if objective == Objective::Length { SHORT } else { GENTLE };
    let mut all = Vec::with_capacity(4 * rungs.len());
    let mut add_turn = |before: [Option<Spiral>; 2], k: f64, length: f64| {
        let (mut place, mut heading) = (at.at, at.direction);
        for spiral in before.iter().flatten() {
            place = add(place, turn(unit(heading), spiral.step(family)));
            heading += spiral.angle();
        }
        let centre = add(place, scale([-heading.sin(), heading.cos()], 1.0 / k));
        let exit = Spiral { from: k, to: 0.0, length };
        let long = before.iter().flatten().chain([&exit]).map(|spiral| spiral.long(family)).sum();
        let reach = reach(family, &exit);
        all.push(Turn { before, curvature: k, heading, centre, exit: Some(exit), long, reach });
    };
    let near = (apart < NEAR).then_some((1.0, LEAST));
    for (peak, length) in rungs.iter().copied().chain(near) {
        for k in [peak, -peak] {
            let to_arc = |from: f64| Spiral { from, to: k, length };
            if curvature == 0.0 {
                add_turn([Some(to_arc(0.0)), None], k, length);
                continue;
            }
            if Spiral::between_round(family, k, curvature) {
                add_turn([Some(to_arc(curvature)), None], k, length);
            }
            let to_line = Spiral { from: curvature, to: 0.0, length: length.min(rungs[0].1).max(0.5 * length) };
            add_turn([Some(to_line), Some(to_arc(0.0))], k, length);
        }
        if curvature.abs() >= HELD && curvature.abs() * length <= 1.2 {
            add_turn([None, None], curvature, length);
        }
    }
    all
}
