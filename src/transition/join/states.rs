//! The join of two states.

use super::super::piece::{Arc, Line, Piece, principal};
use super::super::placement::Ends;
use super::best::Best;
use super::costs::{Costs, wrapped};
use super::ease::{Eased, Easing, eased, tangent};
use super::link::{SHORTEST, add_arc, root};
use super::request::{Family, Objective, Request, State};
use super::spiral::{Pose, Spiral, between, pinned, reversed};
use super::third::{Between, LENGTH};
use super::turns::{Round, Shapes, Turn, turns};
use crate::curve::vector::{add, cross, dot, length, scale, sub, turn, unit};
use crate::error::Result;
use std::f64::consts::PI;

/// A way that is found but not built yet: turns by their places in the lists, and how far their arcs go round.
#[derive(Debug, Clone, Copy)]
struct Way {
    first: usize,
    last: usize,
    arcs: [f64; 2],
    /// The side of a middle turn, +1 left, and its arc; without it there is a line.
    middle: Option<(f64, f64)>,
}

/// Offers joins of two states.
///
/// # Errors
/// Those of the spirals, where lengths leave the range of doubles.
pub(super) fn states(request: &Request, ends: [&State; 2], best: &mut Best) -> Result<()> {
    for piece in simple(request.family, ends)? {
        best.offer(vec![piece]);
    }
    if let Some(pieces) = corner(request, ends)? {
        best.offer(pieces);
    }
    let shortest = request.objective == Objective::Length;
    let all_built = Ways::new(request, ends, shortest, best).build(best)?;
    // What is not to be had may have shut out what is longer.
    if shortest && !(all_built && best.length().is_some()) {
        Ways::new(request, ends, false, best).build(best)?;
    }
    Ok(())
}

/// All ways that are tried, or those that could be the shortest.
struct Ways<'r> {
    request: &'r Request,
    ends: [&'r State; 2],
    turns: [Vec<Turn>; 2],
    all: Vec<(Costs, Way)>,
    /// Only the shortest counts.
    shortest: bool,
    /// Longer ones need not be found.
    most: f64,
}

impl<'r> Ways<'r> {
    fn new(request: &'r Request, [from, to]: [&'r State; 2], shortest: bool, best: &Best) -> Ways<'r> {
        let Request { greatest_curvature: most, family, .. } = *request;
        let across = scale(sub(to.point, from.point), most);
        let here = Pose { at: [0.0, 0.0], direction: from.direction };
        let there = Pose { at: across, direction: to.direction + PI };
        let given = [(here, from.curvature / most), (there, -to.curvature / most)];
        let apart = length(across);
        let rungs = Shapes::of(family).rungs(apart);
        let turns = given.map(|(at, k)| turns(family, at, k, rungs, !shortest));
        // What is too long is not built: each takes the proofs of a few spirals.
        let longest = request.longest * most;
        let mut ways = Ways { request, ends: [from, to], turns, all: Vec::new(), shortest, most: longest };
        if let Some(length) = best.length() {
            ways.bound(length * most);
        }
        ways.find();
        let easings = given.map(|(at, k)| Easing::all(family, at, k, apart));
        let mut turns = std::mem::take(&mut ways.turns);
        let mut gentle: Vec<[Turn; 2]> = Vec::new();
        eased(family, &turns, &easings, ways.most, |Eased { turns: [a, b], arcs, line }| {
            let places = turns.each_ref().map(|turns| turns.len() + gentle.len());
            if ways.add([&a, &b], places, along([&a, &b], arcs, line)) {
                gentle.push([a, b]);
            }
            ways.most
        });
        for [a, b] in gentle {
            turns[0].push(a);
            turns[1].push(b);
        }
        ways.turns = turns;
        let most = ways.most;
        ways.all.retain(|(costs, _)| costs.length[0] <= most);
        ways
    }

    /// A path of a length at most is known.
    fn bound(&mut self, length: f64) {
        if self.shortest {
            self.most = self.most.min(length);
        }
    }

    /// Adds a way, if it is within the bounds.
    fn add(&mut self, [a, b]: [&Turn; 2], [first, last]: [usize; 2], (costs, way): (Costs, Way)) -> bool {
        let between =
            if way.middle.is_some_and(|(_, arc)| arc > 0.0) { 3 } else { 1 + usize::from(way.middle.is_some()) };
        let pieces = a.pieces(way.arcs[0]) + b.pieces(way.arcs[1]) + between;
        let fits = costs.length[0] <= self.most && pieces <= self.request.most_pieces;
        if fits {
            self.bound(costs.length[1]);
            self.all.push((costs, Way { first, last, ..way }));
        }
        fits
    }

    /// Finds those of two turns that are given, with a line or a third turn between.
    fn find(&mut self) {
        let third = &Shapes::of(self.request.family).third;
        let turns = std::mem::take(&mut self.turns);
        let rounds = turns.each_ref().map(|turns| turns.iter().map(|turn| turn.round).collect::<Vec<Round>>());
        for (i, a) in rounds[0].iter().enumerate() {
            for (j, b) in rounds[1].iter().enumerate() {
                // Those that follow are no shorter.
                if a.spirals + b.spirals > self.most {
                    break;
                }
                let room = self.most - a.spirals - b.spirals;
                if let Some(line) = tangent([a, b], self.most).filter(|line| line.length + line.arcs([a, b]) <= room) {
                    let (direction, [a, b]) = (line.direction(), [&turns[0][i], &turns[1][j]]);
                    let arcs = [a.arc(direction), b.arc(direction + PI)];
                    self.add([a, b], [i, j], along([a, b], arcs, line.length));
                }
            }
        }
        for (i, a) in turns[0].iter().enumerate() {
            for (j, b) in turns[1].iter().enumerate() {
                let spirals = a.round.spirals + b.round.spirals;
                if spirals + third.least() > self.most {
                    break;
                }
                if a.exit != b.exit && !(a.is_sharp() && b.is_sharp()) {
                    continue;
                }
                let [from, to] = [a, b].map(|turn| turn.hops.unwrap_or_else(|| third.hops(turn.round.reach)));
                let across = sub(b.round.centre, a.round.centre);
                for between in third.between(across, [&from, &to], self.most - spirals).into_iter().flatten() {
                    self.add([a, b], [i, j], by_turn([a, b], &between));
                }
            }
        }
        self.turns = turns;
    }

    /// Builds and offers the best. Whether all were to be had that were tried.
    fn build(&self, best: &mut Best) -> Result<bool> {
        let mut shut = self.turns.each_ref().map(|turns| vec![false; turns.len()]);
        best.build(&self.all, self.shortest, |way| {
            if shut[0][way.first] || shut[1][way.last] {
                return Ok(None);
            }
            let turns = [&self.turns[0][way.first], &self.turns[1][way.last]];
            Ok(match build(self.request, self.ends, turns, way)? {
                Built::Join(pieces) => Some(pieces),
                Built::Shut(end) => {
                    shut[end][if end == 0 { way.first } else { way.last }] = true;
                    None
                }
            })
        })?;
        Ok(!shut.iter().flatten().any(|shut| *shut))
    }
}

/// Whether both are one; a rounding of a full turn is none.
pub(super) fn same(from: &State, to: &State) -> bool {
    let turned = principal(to.direction - from.direction).abs();
    from.point == to.point && from.curvature == to.curvature && turned <= 4.0 * f64::EPSILON
}

/// Joins of one piece.
fn simple(family: Family, [from, to]: [&State; 2]) -> Result<Vec<Piece>> {
    let across = sub(to.point, from.point);
    let apart = length(across);
    let mut all = Vec::new();
    if apart == 0.0 {
        return Ok(all);
    }
    let turned = principal(to.direction - from.direction);
    if from.curvature == to.curvature {
        let k = from.curvature;
        if k == 0.0 {
            let along = unit(from.direction);
            let off = length(sub(across, scale(along, apart)));
            if off <= 4.0 * f64::EPSILON * apart && turned.abs() <= 4.0 * f64::EPSILON {
                all.push(Piece::Line(Line { start: from.point, end: to.point }));
            }
            return Ok(all);
        }
        let angle = wrapped(k.signum() * (to.direction - from.direction));
        let arc = Arc { start: from.point, start_direction: from.direction, curvature: k, length: angle / k.abs() };
        let end = Piece::Arc(arc).end();
        let size = apart + length(from.point) + length(to.point);
        if angle > 0.0 && length(sub(end, to.point)) <= 8.0 * f64::EPSILON * size {
            all.push(Piece::Arc(arc));
        }
        return Ok(all);
    }
    let State { point, direction, curvature } = *to;
    let ends = Ends {
        start: from.point,
        end: point,
        start_direction: from.direction,
        end_direction: direction,
        start_curvature: from.curvature,
        end_curvature: curvature,
    };
    // One that the family refuses for its size is none.
    all.extend(between(family, &ends).ok().flatten());
    Ok(all)
}

/// Between straight ends, two spirals without an arc: the legs from the ends to the corner may be unequal. The shares
/// of the angle are found so that the direction between the ends is right; then the size is.
fn corner(request: &Request, [from, to]: [&State; 2]) -> Result<Option<Vec<Piece>>> {
    let Request { greatest_curvature: most, family, .. } = *request;
    let turned = principal(to.direction - from.direction);
    let (angle, side) = (turned.abs(), turned.signum());
    let across = turn(unit(-from.direction), scale(sub(to.point, from.point), most));
    if from.curvature != 0.0 || to.curvature != 0.0 || angle == 0.0 || length(across) == 0.0 {
        return Ok(None);
    }
    let pair = |share: f64, k: f64| {
        let first = Spiral { from: 0.0, to: side * k, length: 2.0 * share / k };
        [first, Spiral { from: side * k, to: 0.0, length: 2.0 * (angle - share) / k }]
    };
    let step = |share: f64| {
        let [first, second] = pair(share, 1.0);
        add(first.step(family), turn(unit(first.angle()), second.step(family)))
    };
    let least = (angle - Spiral::most(family, 0.0, 1.0)).max(0.02 * angle);
    let Some(share) = root(|share| cross(step(share), across), least, angle - least) else { return Ok(None) };
    let k = length(step(share)) / length(across);
    if k > 1.0 || dot(step(share), across) < 0.0 || 2.0 * share.min(angle - share) < SHORTEST * k {
        return Ok(None);
    }
    let [first, second] = pair(share, k);
    let Some((first, at)) = first.piece(family, Pose { at: from.point, direction: from.direction }, most)? else {
        return Ok(None);
    };
    let Some((second, _)) = second.piece(family, at, most)? else { return Ok(None) };
    Ok(Some(vec![first, pinned(second, to.point)?]))
}

/// Two turns with a line between.
fn along([a, b]: [&Turn; 2], arcs: [f64; 2], line: f64) -> (Costs, Way) {
    let costs = a.costs(arcs[0]).and(b.costs(arcs[1])).and(Costs::line(line));
    (costs, Way { first: 0, last: 0, arcs, middle: None })
}

/// Two turns with a third between.
fn by_turn([a, b]: [&Turn; 2], between: &Between) -> (Costs, Way) {
    let Between { side, arc, directions: [from, to], costs } = *between;
    let arcs = [a.arc(from), b.arc(to + PI)];
    let costs = a.costs(arcs[0]).and(costs).and(b.costs(arcs[1]));
    (costs, Way { first: 0, last: 0, arcs, middle: Some((side, arc)) })
}

/// A way in pieces, or the end, 0 or 1, whose turn is not to be had.
enum Built {
    Join(Vec<Piece>),
    Shut(usize),
}

fn build(request: &Request, [from, to]: [&State; 2], [a, b]: [&Turn; 2], way: &Way) -> Result<Built> {
    let Request { greatest_curvature: most, family, .. } = *request;
    let start = Pose { at: from.point, direction: from.direction };
    let Some((mut pieces, here)) = built(request, a, start, way.arcs[0])? else { return Ok(Built::Shut(0)) };
    let end = Pose { at: to.point, direction: to.direction + PI };
    let Some((back, there)) = built(request, b, end, way.arcs[1])? else { return Ok(Built::Shut(1)) };
    match way.middle {
        None => pieces.push(Piece::Line(Line { start: here.at, end: there.at })),
        Some((side, arc)) => {
            let entry = Spiral { from: 0.0, to: side, length: LENGTH };
            let exit = Spiral { from: side, to: 0.0, length: LENGTH };
            let Some((first, at)) = entry.piece(family, here, most)? else { return Ok(Built::Shut(0)) };
            pieces.push(first);
            let at = add_arc(&mut pieces, at, side * most, arc);
            let Some((last, _)) = exit.piece(family, at, most)? else { return Ok(Built::Shut(0)) };
            pieces.push(pinned(last, there.at)?);
        }
    }
    for piece in back.into_iter().rev() {
        pieces.push(reversed(piece)?);
    }
    Ok(Built::Join(pieces))
}

/// A turn in pieces of the user's frame, and where it ends.
fn built(request: &Request, turn: &Turn, start: Pose, arc: f64) -> Result<Option<(Vec<Piece>, Pose)>> {
    let (family, most) = (request.family, request.greatest_curvature);
    let (mut pieces, mut at) = (Vec::with_capacity(8), start);
    for spiral in turn.before.iter().flatten() {
        let Some((piece, next)) = spiral.piece(family, at, most)? else { return Ok(None) };
        pieces.push(piece);
        at = next;
    }
    at = add_arc(&mut pieces, at, turn.curvature * most, arc);
    if let Some(exit) = turn.exit {
        let Some((piece, end)) = exit.piece(family, at, most)? else { return Ok(None) };
        pieces.push(piece);
        at = end;
    }
    Ok(Some((pieces, at)))
}
