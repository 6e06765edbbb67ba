//! What spirals, arcs and lines cost, before anything is built.

use super::request::{Family, Objective};
use super::spiral::Spiral;
use crate::curve::vector::{Vector, turn, unit};
use std::f64::consts::TAU;

/// An arc of less than this, radians, is a rounding.
const ROUNDING: f64 = 1e-13;

/// What a path costs, nearly: all but the length as if its spirals were clothoids, and the rate unless it is [`rated`].
///
/// [`rated`]: Known::rated
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Costs {
    /// At least and at most.
    pub length: [f64; 2],
    /// Greatest |κ|.
    pub curvature: f64,
    /// Greatest |dκ/ds|.
    pub rate: f64,
    /// ∫ κ² ds.
    pub energy: f64,
}

impl Costs {
    pub(super) fn of(spiral: &Spiral, length: [f64; 2]) -> Costs {
        let (curvature, rate) = (spiral.from.abs().max(spiral.to.abs()), spiral.mean_rate());
        Costs { length, curvature, rate, energy: spiral.bending_energy() }
    }

    /// Of a line.
    pub(super) fn line(length: f64) -> Costs {
        Costs { length: [length; 2], ..Costs::default() }
    }

    /// Of an arc.
    pub(super) fn arc(curvature: f64, angle: f64) -> Costs {
        Costs { length: [angle / curvature; 2], curvature, rate: 0.0, energy: angle * curvature }
    }

    /// Of one path and then another.
    pub(super) fn and(self, other: Costs) -> Costs {
        let [Costs { length: [a, b], .. }, Costs { length: [c, d], .. }] = [self, other];
        Costs {
            length: [a + c, b + d],
            curvature: self.curvature.max(other.curvature),
            rate: self.rate.max(other.rate),
            energy: self.energy + other.energy,
        }
    }

    pub(super) fn by(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Length => 0.5 * (self.length[0] + self.length[1]),
            Objective::GreatestCurvature => self.curvature,
            Objective::GreatestRate => self.rate,
            Objective::BendingEnergy => self.energy,
        }
    }
}

/// A spiral with what is known of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub spiral: Spiral,
    /// The vector that (1, 0) is turned to.
    pub along: Vector,
    pub step: Vector,
    pub costs: Costs,
}

impl Known {
    pub(super) fn of(family: Family, from: f64, to: f64, length: f64) -> Known {
        let spiral = Spiral { from, to, length };
        let (step, lengths) = spiral.measured(family);
        Known { spiral, along: unit(spiral.angle()), step, costs: Costs::of(&spiral, lengths) }
    }

    /// With the greatest rate of the family's own curve, which takes as long as all the rest.
    pub(super) fn rated(self, family: Family) -> Known {
        Known { costs: Costs { rate: self.spiral.rate(family), ..self.costs }, ..self }
    }

    /// The same way back, and mirrored: it turns as it did.
    pub(super) fn back(self) -> Known {
        let Known { spiral: Spiral { from, to, length }, along: [cos, sin], step, .. } = self;
        let [x, y] = turn([cos, -sin], step);
        Known { spiral: Spiral { from: to, to: from, length }, step: [x, -y], ..self }
    }

    /// Turning to a side, +1 as it does.
    pub(super) fn to(self, side: f64) -> Known {
        let Known { spiral: Spiral { from, to, length }, along: [cos, sin], step: [x, y], .. } = self;
        let spiral = Spiral { from: side * from, to: side * to, length };
        Known { spiral, along: [cos, side * sin], step: [x, side * y], ..self }
    }

    /// From the centre of a turn to its straight end, seen along the direction there.
    pub(super) fn reach(&self) -> Vector {
        let ([x, y], [cos, sin]) = (self.step, self.along);
        turn([cos, -sin], [x, y - 1.0 / self.spiral.from])
    }
}

/// An angle within 0 and a full turn; a rounding from either is 0.
pub(super) fn wrapped(angle: f64) -> f64 {
    // A remainder takes long; most angles need none.
    let angle = match angle {
        a if (0.0..TAU).contains(&a) => a,
        a if (-TAU..0.0).contains(&a) => a + TAU,
        a if (TAU..2.0 * TAU).contains(&a) => a - TAU,
        a => a.rem_euclid(TAU),
    };
    if angle <= ROUNDING || angle >= TAU - ROUNDING { 0.0 } else { angle }
}
