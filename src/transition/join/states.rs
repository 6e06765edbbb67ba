//! The join of two states.

use super::super::piece::{Arc, Line, Piece, principal};
use super::super::placement::Ends;
use super::best::Best;
use super::ease::{Easing, eased, tangent};
use super::link::{SHORTEST, add_arc, root};
use super::request::{Family, Objective, Request, State};
use super::spiral::{Pose, Spiral, between, pinned, reversed};
use super::turns::{Turn, reach, turns, wrapped};
use crate::curve::vector::{Vector, add, angle_of, cross, dot, length, scale, sub, turn, unit};
use crate::error::Result;
use std::f64::consts::PI;

/// A way is built where the model has it no longer than this times the greatest length; it is off by a few hundredths.
const LONGER: f64 = 1.1;
/// The middle turn of three.
const MIDDLE: Spiral = Spiral { from: 1.0, to: 0.0, length: 0.4 };

/// A way that is found but not built yet: turns by their places in the lists, and how far their arcs go round.
#[derive(Debug, Clone, Copy)]
struct Way {
    cost: f64,
    /// Nearly.
    length: f64,
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
pub(super) fn states(request: &Request, [from, to]: [&State; 2], best: &mut Best) -> Result<()> {
    let Request { greatest_curvature: most, family, objective, most_pieces, .. } = *request;
    for piece in simple(family, [from, to])? {
        best.offer(vec![piece]);
    }
    if let Some(pieces) = corner(request, [from, to])? {
        best.offer(pieces);
    }
    let across = scale(sub(to.point, from.point), most);
    let here = Pose { at: [0.0, 0.0], direction: from.direction };
    let there = Pose { at: across, direction: to.direction + PI };
    let given = [(here, from.curvature / most), (there, -to.curvature / most)];
    let apart = length(across);
    let [mut starts, mut ends] = given.map(|(at, k)| turns(family, at, k, objective, apart));
    let middles = [1.0, -1.0].map(|side| Middle::new(family, side));
    let mut ways = Vec::new();
    for (i, a) in starts.iter().enumerate() {
        for (j, b) in ends.iter().enumerate() {
            ways.extend(by_line([a, b], objective).map(|way| Way { first: i, last: j, ..way }));
            if a.exit == b.exit || (a.curvature.abs() == 1.0 && b.curvature.abs() == 1.0) {
                ways.extend(by_turn(objective, &middles, a, b).into_iter().flatten().map(|way| Way {
                    first: i,
                    last: j,
                    ..way
                }));
            }
        }
    }
    let easings = given.map(|(at, k)| Easing::all(family, at, k, objective, apart));
    for eased in eased(family, [&starts, &ends], &easings) {
        let [a, b] = &eased.turns;
        let way = along([a, b], eased.arcs, eased.line, objective);
        ways.push(Way { first: starts.len(), last: ends.len(), ..way });
        starts.push(*a);
        ends.push(*b);
    }
    // Those that are much too long are not built, each of which takes the proofs of a few spirals.
    ways.retain(|way| way.length / most <= LONGER * request.longest);
    // A model of the cost orders them, and the shortest of equals come first.
    ways.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.length.total_cmp(&b.length)));
    // Length is told by the model to a thousandth, the others to a fifth.
    let enough = best.kept + if objective == Objective::Length { 1 } else { 6 };
    let mut shut = [vec![false; starts.len()], vec![false; ends.len()]];
    for way in ways {
        let (a, b) = (&starts[way.first], &ends[way.last]);
        let between =
            if way.middle.is_some_and(|(_, arc)| arc > 0.0) { 3 } else { 1 + usize::from(way.middle.is_some()) };
        if shut[0][way.first]
            || shut[1][way.last]
            || a.pieces(way.arcs[0]) + b.pieces(way.arcs[1]) + between > most_pieces
        {
            continue;
        }
        match build(request, [from, to], [a, b], &way)? {
            Built::Join(pieces) => {
                best.offer(pieces);
                if best.kept >= enough {
                    break;
                }
            }
            Built::Shut(end) => shut[end][if end == 0 { way.first } else { way.last }] = true,
        }
    }
    Ok(())
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
fn by_line(turns: [&Turn; 2], objective: Objective) -> Option<Way> {
    let (direction, line) = tangent(turns)?;
    Some(along(turns, [turns[0].arc(direction), turns[1].arc(direction + PI)], line, objective))
}

/// The same with arcs and a line of known lengths.
fn along([a, b]: [&Turn; 2], arcs: [f64; 2], line: f64, objective: Objective) -> Way {
    let length = a.length(arcs[0]) + line + b.length(arcs[1]);
    let cost = together(objective, [a.cost(arcs[0], objective), b.cost(arcs[1], objective)]);
    let cost = if objective == Objective::Length { length } else { cost };
    Way { cost, length, first: 0, last: 0, arcs, middle: None }
}

/// Costs of parts in one.
fn together<const N: usize>(objective: Objective, costs: [f64; N]) -> f64 {
    match objective {
        Objective::Length | Objective::BendingEnergy => costs.iter().sum(),
        _ => costs.into_iter().fold(0.0, f64::max),
    }
}

/// A third turn between two, of the limit of curvature, to the left or to the right.
struct Middle {
    side: f64,
    exit: Spiral,
    /// Length of its spirals, nearly.
    long: f64,
    /// As of a [`Turn`]: ahead, and seen backwards, where it turns the other way.
    ahead: Vector,
    behind: Vector,
}

impl Middle {
    fn new(family: Family, side: f64) -> Middle {
        let exit = Spiral { from: side, ..MIDDLE };
        let long = 2.0 * exit.long(family);
        Middle { side, exit, long, ahead: reach(family, &exit), behind: reach(family, &Spiral { from: -side, ..exit }) }
    }
}

/// Two turns with a third between.
fn by_turn(objective: Objective, middles: &[Middle; 2], a: &Turn, b: &Turn) -> [Option<Way>; 4] {
    let mut ways = [None; 4];
    let across = sub(b.centre, a.centre);
    let apart = length(across);
    for (n, way) in ways.iter_mut().enumerate() {
        let flank = if n % 2 == 0 { 1.0 } else { -1.0 };
        let Middle { side, exit, long, ahead, behind } = middles[n / 2];
        let (into, out) = (add(a.reach, behind), add(ahead, b.reach));
        let (r, s) = (length(into), length(out));
        if apart == 0.0 || apart >= r + s || apart <= (r - s).abs() {
            continue;
        }
        let x = (apart * apart + r * r - s * s) / (2.0 * apart);
        let y = flank * (r * r - x * x).max(0.0).sqrt();
        let centre = add(a.centre, scale(turn(across, [x, y]), 1.0 / apart));
        let first = angle_of(sub(centre, a.centre)) - angle_of(into);
        let second = angle_of(sub(b.centre, centre)) - angle_of(out);
        let arc = wrapped(side * (second - first) - 2.0 * exit.angle().abs());
        let arcs = [a.arc(first), b.arc(second + PI)];
        let model = Turn { before: [Some(exit), None], curvature: side, ..*a };
        let model = Turn { exit: Some(exit), long, ..model };
        let costs = [a.cost(arcs[0], objective), model.cost(arc, objective), b.cost(arcs[1], objective)];
        let length = a.length(arcs[0]) + model.length(arc) + b.length(arcs[1]);
        *way =
            Some(Way { cost: together(objective, costs), length, first: 0, last: 0, arcs, middle: Some((side, arc)) });
    }
    ways
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
            let entry = Spiral { from: 0.0, to: side, length: MIDDLE.length };
            let exit = Spiral { from: side, ..MIDDLE };
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
