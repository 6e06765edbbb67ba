//! Gentle turns: by less than the spirals of a turn to a given arc need, from one straight line to another.
//!
//! Such a turn has no arc, and its two spirals lead to a lower curvature: just so low that they turn by the angle.
//! Their length stays, so they are no harder to build. They are each other's mirror image, and their legs, from the
//! ends to the corner of the two lines, are equal. So the turn is left on a line through that corner. Where the corner
//! lies depends on the angle, but hardly: a leg is the length of a spiral up to a share of the order of the angle's
//! square. So the direction of the line between two turns, at least one of them gentle, is found by going round: from
//! the direction to the corners, and from the corners to the direction. The change shrinks each time by a factor of
//! that order.

use super::super::piece::principal;
use super::costs::{Costs, Known};
use super::link::{LEAST_LINE, SHORTEST};
use super::request::Family;
use super::spiral::{Pose, Spiral};
use super::turns::{LEAST, Round, Turn};
use crate::curve::vector::{Vector, add, angle_of, dot, scale, sub, turn};
use std::f64::consts::PI;

/// Lengths of spirals in units of the least radius.
const USUAL: &[f64] = &[0.4, 1.2, 4.8];
/// The most that a turn turns, radians: its spirals are proved for half of it.
const MOST: f64 = 1.2;
/// A turn by less than this, radians, is a rounding.
const ROUNDING: f64 = 1e-13;
/// How often the direction is found anew at most, and by how much it may be off, radians.
const ROUNDS: usize = 12;
const SETTLED: f64 = 1e-14;

/// Turns from a straight place by any small angle to either side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Easing {
    /// What leads to the straight place.
    before: Option<Known>,
    at: Pose,
    /// Of a spiral.
    length: f64,
    /// The cosine of the most it turns.
    narrow: f64,
    /// From the straight place to the corner, for the smallest angles.
    leg: f64,
}

impl Easing {
    /// All of those tried from a pose with a curvature towards a place at a distance.
    pub(super) fn all(family: Family, at: Pose, curvature: f64, apart: f64) -> Vec<Easing> {
        // Two turns and what leads to them, should both ends be curved, take nearly all of the way.
        let spirals = if curvature == 0.0 { 4.0 } else { 6.0 };
        let room = 0.96 * apart / (spirals * Spiral { from: 0.0, to: 0.1, length: 1.0 }.stretched(family));
        let usual = USUAL.iter().copied().filter(|length| *length <= room);
        let lengths = usual.chain([room, 0.5 * room, LEAST].into_iter().filter(|length| *length >= SHORTEST));
        let easing = |length: f64| {
            let before = (curvature != 0.0).then(|| Known::of(family, curvature, 0.0, length).rated(family));
            let at = before.map_or(at, |known| Pose {
                at: add(at.at, turn(at.along(), known.step)),
                direction: at.direction + known.spiral.angle(),
            });
            Easing { before, at, length, narrow: MOST.min(length).cos(), leg: leg(family, 1e-3, length) }
        };
        let turns_little = |length: &f64| 0.5 * curvature.abs() * length <= 0.5 * MOST;
        lengths.filter(turns_little).map(easing).collect()
    }

    /// What the line depends on, for a turn with a corner at a distance ahead; without the length of spirals.
    fn round(&self, leg: f64) -> Round {
        let along = self.at.along();
        Round { spirals: 0.0, centre: add(self.at.at, scale(along, leg)), reach: [leg, 0.0], along, bend: 1.0 }
    }

    /// The turn into a direction, if it is a gentle one.
    fn towards(&self, family: Family, direction: f64) -> Option<(f64, Round)> {
        let angle = principal(direction - self.at.direction);
        if angle.abs() > MOST.min(self.length) {
            return None;
        }
        if angle.abs() <= ROUNDING {
            return Some((0.0, self.round(0.0)));
        }
        Some((angle / self.length, self.round(leg(family, angle, self.length))))
    }

    /// The turn that leads to a curvature and back.
    fn turn(&self, family: Family, k: f64, round: Round) -> Turn {
        let Easing { before, at, length, .. } = *self;
        let known = (k != 0.0).then(|| Known::of(family, 0.0, k, length).rated(family));
        let spirals = known.map(|known| known.spiral);
        let all = [before, known, known].into_iter().flatten().map(|known| known.costs);
        Turn {
            before: [before.map(|known| known.spiral), spirals],
            curvature: k,
            heading: at.direction,
            exit: spirals.map(|Spiral { from, to, length }| Spiral { from: to, to: from, length }),
            spirals: all.fold(Costs::default(), Costs::and),
            round,
            hops: None,
        }
    }
}

/// How far the corner of two spirals of a length that turn by an angle is from their ends.
pub(super) fn leg(family: Family, angle: f64, length: f64) -> f64 {
    // They meet on the line that halves the corner.
    let [x, y] = Spiral { from: 0.0, to: angle / length, length }.step(family);
    x + y * (0.5 * angle).tan()
}

/// Two turns with a line between, one of which at least is gentle.
pub(super) struct Eased {
    pub turns: [Turn; 2],
    pub arcs: [f64; 2],
    pub line: f64,
}

/// One of the two turns.
#[derive(Clone, Copy)]
struct Part<'a> {
    /// What the line depends on; of a gentle turn what is hardly wrong for any small angle.
    round: Round,
    /// Where the rest of the path begins, to a distance, and the length of the spirals that are no part of the rest.
    place: Vector,
    within: f64,
    spirals: f64,
    kind: Kind<'a>,
}

#[derive(Clone, Copy)]
enum Kind<'a> {
    Given(&'a Turn),
    Gentle(&'a Easing),
}

impl<'a> Part<'a> {
    fn given(turn: &'a Turn) -> Part<'a> {
        let Round { spirals, centre, reach, .. } = turn.round;
        Part { round: turn.round, place: centre, within: dot(reach, reach).sqrt(), spirals, kind: Kind::Given(turn) }
    }

    fn gentle(easing: &'a Easing) -> Part<'a> {
        let spirals = easing.before.map_or(0.0, |known| known.costs.length[0]);
        Part { round: easing.round(easing.leg), place: easing.at.at, within: 0.0, spirals, kind: Kind::Gentle(easing) }
    }

    /// With the curvature of a gentle one.
    fn towards(&self, family: Family, direction: f64) -> Option<(f64, Round)> {
        match self.kind {
            Kind::Given(turn) => Some((turn.curvature, self.round)),
            Kind::Gentle(easing) => easing.towards(family, direction),
        }
    }

    /// Whether a line may follow.
    fn faces(&self, line: &Tangent, sign: f64) -> bool {
        match self.kind {
            Kind::Given(_) => true,
            Kind::Gentle(easing) => sign * dot(line.along, easing.at.along()) >= easing.narrow * line.square,
        }
    }

    /// With its arc.
    fn left(&self, family: Family, (k, round): (f64, Round), direction: f64) -> (Turn, f64) {
        match self.kind {
            Kind::Given(turn) => (*turn, turn.arc(direction)),
            Kind::Gentle(easing) => (easing.turn(family, k, round), 0.0),
        }
    }
}

/// Offers all gentle turns with each other and with the given turns at the other end, but for paths that must be longer
/// than `most`, or than the answer to the last offer.
pub(super) fn eased(
    family: Family,
    turns: &[Vec<Turn>; 2],
    easings: &[Vec<Easing>; 2],
    mut most: f64,
    mut offer: impl FnMut(Eased) -> f64,
) {
    let gentle = easings.each_ref().map(|all| all.iter().map(Part::gentle).collect::<Vec<_>>());
    let given = turns.each_ref().map(|all| all.iter().map(Part::given).collect::<Vec<_>>());
    for (first, second) in [(&gentle[0], &gentle[1]), (&gentle[0], &given[1]), (&given[0], &gentle[1])] {
        for (a, b) in first.iter().flat_map(|a| second.iter().map(move |b| (a, b))) {
            // No path is shorter than the line between its ends.
            let across = sub(b.place, a.place);
            let rest = (most - a.spirals - b.spirals + a.within + b.within).max(0.0);
            if dot(across, across) <= rest * rest {
                most = joined(family, [a, b]).map_or(most, &mut offer);
            }
        }
    }
}

fn joined(family: Family, parts: [&Part; 2]) -> Option<Eased> {
    let line = tangent(parts.map(|part| &part.round), f64::INFINITY)?;
    if !parts[0].faces(&line, 1.0) || !parts[1].faces(&line, -1.0) {
        return None;
    }
    let mut before = line.direction();
    for _ in 0..ROUNDS {
        let rounds = [parts[0].towards(family, before)?, parts[1].towards(family, before + PI)?];
        let line = tangent([&rounds[0].1, &rounds[1].1], f64::INFINITY)?;
        let direction = line.direction();
        if principal(direction - before).abs() <= SETTLED {
            let [a, b] = [0, 1].map(|i| parts[i].left(family, rounds[i], direction + PI * i as f64));
            return Some(Eased { turns: [a.0, b.0], arcs: [a.1, b.1], line: line.length });
        }
        before = direction;
    }
    None
}

/// The line between two turns.
pub(super) struct Tangent {
    /// Along it, as long as `square`.
    along: Vector,
    /// The square of the distance of the two centres.
    square: f64,
    pub length: f64,
}

impl Tangent {
    /// At least as long as the arcs of the two turns are.
    pub(super) fn arcs(&self, [a, b]: [&Round; 2]) -> f64 {
        a.arc(self.along, self.square) + b.arc(scale(self.along, -1.0), self.square)
    }

    pub(super) fn direction(&self) -> f64 {
        angle_of(self.along)
    }
}

/// The line between two turns, where there is one in a path of a length at most.
pub(super) fn tangent([a, b]: [&Round; 2], most: f64) -> Option<Tangent> {
    let spirals = a.spirals + b.spirals;
    let (across, reach) = (sub(b.centre, a.centre), add(a.reach, b.reach));
    let square = dot(across, across);
    let along = (square - reach[1] * reach[1]).max(-1.0).sqrt();
    let length = along - reach[0];
    let fits = length >= LEAST_LINE && spirals + length <= most;
    fits.then(|| Tangent { along: turn(across, [along, -reach[1]]), square, length })
}
