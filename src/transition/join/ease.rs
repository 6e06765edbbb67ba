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
use super::link::{LEAST_LINE, SHORTEST};
use super::request::Family;
use super::spiral::{Pose, Spiral};
use super::turns::{Costs, LEAST, Turn};
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
    before: Option<Spiral>,
    at: Pose,
    /// Of a spiral.
    length: f64,
    /// The cosine of the most it turns.
    narrow: f64,
    /// From the straight place to the corner, for the smallest angles.
    leg: f64,
    /// Length of what leads to the straight place.
    long: f64,
}

/// The length of two gentle turns and the line between is known to this share before they are found.
const NEARLY: f64 = 0.1;

impl Easing {
    /// All of those tried from a pose with a curvature towards a place at a distance.
    pub(super) fn all(family: Family, at: Pose, curvature: f64, apart: f64) -> Vec<Easing> {
        // Two turns and what leads to them, should both ends be curved, take nearly all of the way.
        let spirals = if curvature == 0.0 { 4.0 } else { 6.0 };
        let room = 0.96 * apart / (spirals * Spiral { from: 0.0, to: 0.1, length: 1.0 }.stretched(family));
        let usual = USUAL.iter().copied().filter(|length| *length <= room);
        let lengths = usual.chain([room, 0.5 * room, LEAST].into_iter().filter(|length| *length >= SHORTEST));
        let easing = |length: f64| {
            let before = (curvature != 0.0).then_some(Spiral { from: curvature, to: 0.0, length });
            let at = before.map_or(at, |spiral| Pose {
                at: add(at.at, turn(at.along(), spiral.step(family))),
                direction: at.direction + spiral.angle(),
            });
            let long = before.map_or(0.0, |before| before.long(family));
            Easing { before, at, length, narrow: MOST.min(length).cos(), leg: leg(family, 1e-3, length), long }
        };
        let turns_little = |length: &f64| 0.5 * curvature.abs() * length <= 0.5 * MOST;
        lengths.filter(turns_little).map(easing).collect()
    }

    /// The turn with a corner at a distance ahead.
    fn with_leg(&self, leg: f64, k: f64) -> Turn {
        let Easing { before, at, length, long, .. } = *self;
        let spirals = (k != 0.0).then_some([Spiral { from: 0.0, to: k, length }, Spiral { from: k, to: 0.0, length }]);
        Turn {
            before: [before, spirals.map(|s| s[0])],
            curvature: k,
            heading: at.direction,
            centre: add(at.at, scale(at.along(), leg)),
            exit: spirals.map(|s| s[1]),
            spirals: Costs { length: long + 2.0 * leg, ..Costs::default() },
            reach: [leg, 0.0],
        }
    }

    /// The turn into a direction, if it is a gentle one.
    fn towards(&self, family: Family, direction: f64) -> Option<Turn> {
        let angle = principal(direction - self.at.direction);
        if angle.abs() > MOST.min(self.length) {
            return None;
        }
        if angle.abs() <= ROUNDING {
            return Some(self.with_leg(0.0, 0.0));
        }
        Some(self.with_leg(leg(family, angle, self.length), angle / self.length))
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
    /// Of a gentle one what is hardly wrong for any small angle.
    turn: &'a Turn,
    easing: Option<&'a Easing>,
}

impl Part<'_> {
    fn towards(&self, family: Family, direction: f64) -> Option<Turn> {
        self.easing.map_or(Some(*self.turn), |easing| easing.towards(family, direction))
    }

    /// Whether a line may follow.
    fn faces(&self, line: &Tangent, sign: f64) -> bool {
        self.easing.is_none_or(|easing| sign * dot(line.along, easing.at.along()) >= easing.narrow * line.square)
    }

    /// With its arc, and what it costs.
    fn left(&self, family: Family, turn: Turn, direction: f64) -> (Turn, f64) {
        if self.easing.is_some() { (turn.costed(family), 0.0) } else { (turn, turn.arc(direction)) }
    }
}

/// All gentle turns with each other and with the given turns at the other end, but for paths that are longer than
/// `most` by far.
pub(super) fn eased(family: Family, turns: [&[Turn]; 2], easings: &[Vec<Easing>; 2], most: f64) -> Vec<Eased> {
    let firsts = [0, 1].map(|end| easings[end].iter().map(|easing| easing.with_leg(easing.leg, 0.0)));
    let firsts = firsts.map(|firsts| firsts.collect::<Vec<_>>());
    let gentle = |end: usize| firsts[end].iter().zip(&easings[end]).map(|(turn, e)| Part { turn, easing: Some(e) });
    let given = |end: usize| turns[end].iter().map(|turn| Part { turn, easing: None });
    let first = gentle(0).flat_map(|a| gentle(1).chain(given(1)).map(move |b| [a, b]));
    let second = given(0).flat_map(|a| gentle(1).map(move |b| [a, b]));
    first.chain(second).filter_map(|parts| joined(family, parts, most * (1.0 + NEARLY))).collect()
}

fn joined(family: Family, parts: [Part; 2], most: f64) -> Option<Eased> {
    let line = tangent(parts.map(|part| part.turn), most)?;
    if !parts[0].faces(&line, 1.0) || !parts[1].faces(&line, -1.0) {
        return None;
    }
    let mut before = line.direction();
    for _ in 0..ROUNDS {
        let turns = [parts[0].towards(family, before)?, parts[1].towards(family, before + PI)?];
        let line = tangent([&turns[0], &turns[1]], most)?;
        let direction = line.direction();
        if principal(direction - before).abs() <= SETTLED {
            let [a, b] = [0, 1].map(|i| parts[i].left(family, turns[i], direction + PI * i as f64));
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
    pub(super) fn direction(&self) -> f64 {
        angle_of(self.along)
    }
}

/// The line between two turns, where there is one in a path of a length at most.
pub(super) fn tangent([a, b]: [&Turn; 2], most: f64) -> Option<Tangent> {
    let spirals = a.spirals.length + b.spirals.length;
    let (across, reach) = (sub(b.centre, a.centre), add(a.reach, b.reach));
    let square = dot(across, across);
    let along = (square - reach[1] * reach[1]).max(-1.0).sqrt();
    let length = along - reach[0];
    let fits = length >= LEAST_LINE && spirals + length <= most;
    fits.then(|| Tangent { along: turn(across, [along, -reach[1]]), square, length })
}
