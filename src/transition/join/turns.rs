//! Turns: from a state over an arc to a straight end.

use super::request::{Family, Objective};
use super::spiral::{Pose, Spiral};
use crate::curve::vector::{Vector, add, scale, turn, unit};
use std::f64::consts::TAU;

/// Curvatures of arcs in units of the limit, and lengths of spirals in units of the least radius. The short ones make
/// the shortest joins and the long ones gentle joins. A spiral turns by at most 0.6 rad, where both families' are
/// proved.
const RUNGS: &[(f64, f64)] = &[
    (1.0, 0.4),
    (0.5, 0.4),
    (1.0, 0.8),
    (0.5, 0.8),
    (0.25, 0.8),
    (0.125, 0.8),
    (1.0, 1.2),
    (0.5, 2.4),
    (0.25, 2.4),
    (0.125, 2.4),
    (0.25, 4.8),
    (0.125, 4.8),
];
/// Of spirals to a straight place on the way to an arc.
const SHORT: f64 = 0.4;
/// So near, spirals of the usual length may have no room.
const NEAR: f64 = 2.0;
/// The length of the spirals there.
pub(super) const LEAST: f64 = 0.1;
/// Below this an arc goes on about a centre too far away to be of use.
const HELD: f64 = 1.0 / 64.0;
/// An arc of less than this, radians, is a rounding.
const ROUNDING: f64 = 1e-13;

/// What a path costs, nearly: all but the length as if its spirals were clothoids.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Costs {
    pub length: f64,
    /// Greatest |κ|.
    pub curvature: f64,
    /// Greatest |dκ/ds|.
    pub rate: f64,
    /// ∫ κ² ds.
    pub energy: f64,
}

impl Costs {
    pub(super) fn of(spiral: &Spiral, length: f64) -> Costs {
        let (curvature, rate) = (spiral.from.abs().max(spiral.to.abs()), spiral.rate());
        Costs { length, curvature, rate, energy: spiral.bending_energy() }
    }

    /// Of one path and then another.
    pub(super) fn and(self, other: Costs) -> Costs {
        Costs {
            length: self.length + other.length,
            curvature: self.curvature.max(other.curvature),
            rate: self.rate.max(other.rate),
            energy: self.energy + other.energy,
        }
    }

    pub(super) fn by(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Length => self.length,
            Objective::GreatestCurvature => self.curvature,
            Objective::GreatestRate => self.rate,
            Objective::BendingEnergy => self.energy,
        }
    }
}

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
    /// What its spirals cost.
    pub spirals: Costs,
    /// From the centre to where it ends, for the direction (1, 0) there.
    pub reach: Vector,
}

impl Turn {
    /// Left in a direction, how far its arc goes round, radians from 0 to a full turn.
    pub(super) fn arc(&self, direction: f64) -> f64 {
        let exit = self.exit.map_or(0.0, |exit| exit.angle());
        wrapped(self.curvature.signum() * (direction - exit - self.heading))
    }

    /// What it costs with an arc.
    pub(super) fn costs(&self, arc: f64) -> Costs {
        if arc == 0.0 {
            return self.spirals;
        }
        let bend = self.curvature.abs();
        self.spirals.and(Costs { length: arc / bend, curvature: bend, rate: 0.0, energy: arc * bend })
    }

    /// The same with the costs of its spirals.
    pub(super) fn costed(self, family: Family) -> Turn {
        let all = self.before.iter().chain([&self.exit]).flatten();
        let spirals = all.map(|spiral| Costs::of(spiral, spiral.long(family))).fold(Costs::default(), Costs::and);
        Turn { spirals, ..self }
    }

    /// Whether it is of those that a third turn is tried with, whatever the other is.
    pub(super) fn is_sharp(&self) -> bool {
        self.curvature.abs() == 1.0 && self.exit.is_some_and(|exit| exit.length <= 0.8)
    }

    /// How many pieces it has.
    pub(super) fn pieces(&self, arc: f64) -> usize {
        self.before.iter().chain([&self.exit]).flatten().count() + usize::from(arc > 0.0)
    }
}

/// An angle within 0 and a full turn; a rounding from either is 0.
pub(super) fn wrapped(angle: f64) -> f64 {
    let angle = angle.rem_euclid(TAU);
    if angle <= ROUNDING || angle >= TAU - ROUNDING { 0.0 } else { angle }
}

/// A spiral with what is known of it.
#[derive(Clone, Copy)]
struct Known {
    spiral: Spiral,
    step: Vector,
    costs: Costs,
}

impl Known {
    fn of(family: Family, from: f64, to: f64, length: f64) -> Known {
        let spiral = Spiral { from, to, length };
        Known { spiral, step: spiral.step(family), costs: Costs::of(&spiral, spiral.long(family)) }
    }

    /// The same way back, and mirrored: it turns as it did.
    fn back(self) -> Known {
        let Known { spiral: Spiral { from, to, length }, step, costs } = self;
        let [x, y] = turn(unit(-self.spiral.angle()), step);
        Known { spiral: Spiral { from: to, to: from, length }, step: [x, -y], costs }
    }

    /// Turning to a side, +1 as it does.
    fn to(self, side: f64) -> Known {
        let Known { spiral: Spiral { from, to, length }, step: [x, y], costs } = self;
        Known { spiral: Spiral { from: side * from, to: side * to, length }, step: [x, side * y], costs }
    }

    /// From the centre of a turn to its straight end, seen along the direction there.
    fn reach(&self) -> Vector {
        let ([x, y], (sin, cos)) = (self.step, self.spiral.angle().sin_cos());
        turn([cos, -sin], [x, y - 1.0 / self.spiral.from])
    }
}

/// A curvature of an arc and a length of spirals, with the spiral from curvature 0 to the arc.
pub(super) struct Rung(Known);

/// Those tried where a place is at a distance, in units of the least radius.
pub(super) fn rungs(family: Family, apart: f64) -> Vec<Rung> {
    let near = (apart < NEAR).then_some((1.0, LEAST));
    RUNGS.iter().copied().chain(near).map(|(peak, length)| Rung(Known::of(family, 0.0, peak, length))).collect()
}

/// All turns from a pose with a curvature, both in units of the least radius.
pub(super) fn turns(family: Family, at: Pose, curvature: f64, rungs: &[Rung]) -> Vec<Turn> {
    let mut all = Vec::with_capacity(5 * rungs.len());
    let mut add_turn = |before: [Option<Known>; 2], exit: Known| {
        let (mut place, mut heading, mut spirals) = (at.at, at.direction, exit.costs);
        for Known { spiral, step, costs } in before.iter().flatten() {
            place = add(place, turn(unit(heading), *step));
            heading += spiral.angle();
            spirals = spirals.and(*costs);
        }
        let k = exit.spiral.from;
        let centre = add(place, scale([-heading.sin(), heading.cos()], 1.0 / k));
        let (before, exit, reach) = (before.map(|known| known.map(|known| known.spiral)), exit.spiral, exit.reach());
        all.push(Turn { before, curvature: k, heading, centre, exit: Some(exit), spirals, reach });
    };
    let known = |from: f64, to: f64, length: f64| Known::of(family, from, to, length);
    let mut to_line: Option<Known> = None;
    for &Rung(entry) in rungs {
        let (exit, Spiral { to: peak, length, .. }) = (entry.back(), entry.spiral);
        let short = length.min(SHORT).max(0.5 * length);
        // Rungs of one length follow each other.
        if curvature != 0.0 && to_line.is_none_or(|known| known.spiral.length != short) {
            to_line = Some(known(curvature, 0.0, short));
        }
        for side in [1.0, -1.0] {
            let k = side * peak;
            if Spiral::between_round(family, k, curvature) {
                add_turn([Some(known(curvature, k, length)), None], exit.to(side));
            }
            let entry = Some(entry.to(side));
            let before = if to_line.is_some() { [to_line, entry] } else { [entry, None] };
            add_turn(before, exit.to(side));
        }
        if curvature.abs() >= HELD && curvature.abs() * length <= 1.2 {
            add_turn([None, None], known(curvature, 0.0, length));
        }
    }
    all
}

/// The third turn between two others: its spirals are of this length, between curvature 0 and the limit.
pub(super) const MIDDLE: f64 = 0.4;

/// A third turn between two, of the limit of curvature, to the left or to the right.
pub(super) struct Middle {
    /// +1 left.
    pub side: f64,
    pub angle: f64,
    pub spirals: Costs,
    /// As of a [`Turn`]: ahead, and seen backwards, where it turns the other way.
    pub ahead: Vector,
    pub behind: Vector,
}

impl Middle {
    pub(super) fn new(family: Family, side: f64) -> Middle {
        let exit = Known::of(family, 1.0, 0.0, MIDDLE);
        let (ahead, behind) = (exit.to(side).reach(), exit.to(-side).reach());
        Middle { side, angle: exit.spiral.angle(), spirals: exit.costs.and(exit.costs), ahead, behind }
    }

    /// What it costs with an arc.
    pub(super) fn costs(&self, arc: f64) -> Costs {
        self.spirals.and(Costs { length: arc, curvature: 1.0, rate: 0.0, energy: arc })
    }
}
