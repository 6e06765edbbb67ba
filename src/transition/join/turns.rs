//! Turns: from a state over an arc to a straight end.

use super::costs::{Costs, Known, wrapped};
use super::request::Family;
use super::spiral::{Pose, Spiral};
use super::third::{Hop, SIDES, Third};
use crate::curve::vector::{Vector, add, cross, dot, turn};
use std::f64::consts::PI;
use std::sync::OnceLock;

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
/// What a line depends on that leaves a turn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    /// Length of the turn's spirals, at least.
    pub spirals: f64,
    /// Centre of its arc.
    pub centre: Vector,
    /// From the centre to where it ends, for the direction (1, 0) there.
    pub reach: Vector,
    /// Where it would end without an arc, the vector of length 1 along it; and curvature of the arc.
    pub along: Vector,
    pub bend: f64,
}

impl Round {
    /// At least as long as the arc is, where it is left along a vector of a length.
    ///
    /// An arc is no shorter than its chord, and one of more than a half turn is no shorter than a half turn and the
    /// chord of the rest.
    pub(super) fn arc(&self, direction: Vector, length: f64) -> f64 {
        let [cosine, sine] = [dot(self.along, direction), cross(self.along, direction) * self.bend.signum()];
        // Roundings of 0 are not to be full turns.
        let (half, cosine) = if sine < -1e-9 * length { (PI, -cosine) } else { (0.0, cosine) };
        (half + (2.0 - 2.0 * cosine / length).max(0.0).sqrt()) / self.bend.abs()
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
    /// From the arc to curvature 0; a turn by nothing has none.
    pub exit: Option<Spiral>,
    /// What its spirals cost.
    pub spirals: Costs,
    pub round: Round,
    /// To a third turn, where that is known.
    pub hops: Option<[Hop; 2]>,
}

impl Turn {
    /// Left in a direction, how far its arc goes round, radians from 0 to a full turn.
    pub(super) fn arc(&self, direction: f64) -> f64 {
        let exit = self.exit.map_or(0.0, |exit| exit.angle());
        wrapped(self.curvature.signum() * (direction - exit - self.heading))
    }

    /// What it costs with an arc.
    pub(super) fn costs(&self, arc: f64) -> Costs {
        if arc == 0.0 { self.spirals } else { self.spirals.and(Costs::arc(self.curvature.abs(), arc)) }
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

/// What leads from an arc to curvature 0.
#[derive(Clone, Copy)]
struct Exit {
    known: Known,
    reach: Vector,
    hops: Option<[Hop; 2]>,
}

/// A curvature of an arc and a length of spirals, to the left and to the right.
pub(super) struct Rung {
    entries: [Known; 2],
    exits: [Exit; 2],
}

/// What a family has whatever the ends are.
pub(super) struct Shapes {
    rungs: Vec<Rung>,
    pub third: Third,
}

impl Shapes {
    pub(super) fn of(family: Family) -> &'static Shapes {
        static ALL: [OnceLock<Shapes>; Family::ALL.len()] = [const { OnceLock::new() }; Family::ALL.len()];
        ALL[family as usize].get_or_init(|| {
            let third = Third::new(family);
            let rung = |(peak, length): (f64, f64)| {
                let entries = SIDES.map(|side| Known::of(family, 0.0, peak, length).rated(family).to(side));
                let exits = entries.map(|entry| {
                    let known = entry.back();
                    let reach = known.reach();
                    Exit { known, reach, hops: Some(third.hops(reach)) }
                });
                Rung { entries, exits }
            };
            let rungs = RUNGS.iter().copied().chain([(1.0, LEAST)]).map(rung).collect();
            Shapes { rungs, third }
        })
    }

    /// Those tried where a place is at a distance, in units of the least radius.
    pub(super) fn rungs(&self, apart: f64) -> &[Rung] {
        &self.rungs[..if apart < NEAR { self.rungs.len() } else { RUNGS.len() }]
    }
}

/// All turns from a pose with a curvature, both in units of the least radius; the shortest spirals come first. The
/// rates are [`Known::rated`] where they are asked for.
pub(super) fn turns(family: Family, at: Pose, curvature: f64, rungs: &[Rung], rated: bool) -> Vec<Turn> {
    let mut all = Vec::with_capacity(5 * rungs.len());
    let mut add_turn = |before: [Option<Known>; 2], exit: Exit| {
        let Exit { known: Known { spiral: exit, costs, along: end, .. }, reach, hops } = exit;
        let (mut place, mut heading, mut along, mut spirals) = (at.at, at.direction, at.along(), costs);
        for known in before.iter().flatten() {
            place = add(place, turn(along, known.step));
            heading += known.spiral.angle();
            along = turn(along, known.along);
            spirals = spirals.and(known.costs);
        }
        let centre = add(place, turn(along, [0.0, 1.0 / exit.from]));
        let before = before.map(|known| known.map(|known| known.spiral));
        let left = turn(along, end);
        let round = Round { spirals: spirals.length[0], centre, reach, along: left, bend: exit.from };
        all.push(Turn { before, curvature: exit.from, heading, exit: Some(exit), spirals, round, hops });
    };
    let known = |from: f64, to: f64, length: f64| {
        let known = Known::of(family, from, to, length);
        if rated { known.rated(family) } else { known }
    };
    let mut to_line: Option<Known> = None;
    for Rung { entries, exits } in rungs {
        let Spiral { to: peak, length, .. } = entries[0].spiral;
        let short = length.min(SHORT).max(0.5 * length);
        // Rungs of one length follow each other.
        if curvature != 0.0 && to_line.is_none_or(|known| known.spiral.length != short) {
            to_line = Some(known(curvature, 0.0, short));
        }
        for ((side, entry), exit) in SIDES.into_iter().zip(entries).zip(exits) {
            let k = side * peak;
            if Spiral::between_round(family, k, curvature) {
                add_turn([Some(known(curvature, k, length)), None], *exit);
            }
            add_turn(if to_line.is_some() { [to_line, Some(*entry)] } else { [Some(*entry), None] }, *exit);
        }
        if curvature.abs() >= HELD && curvature.abs() * length <= 1.2 {
            let known = known(curvature, 0.0, length);
            add_turn([None, None], Exit { known, reach: known.reach(), hops: None });
        }
    }
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|a, b| all[*a].round.spirals.total_cmp(&all[*b].round.spirals));
    order.into_iter().map(|i| all[i]).collect()
}
