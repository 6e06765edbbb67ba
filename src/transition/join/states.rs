//! The join of two states.

use super::super::piece::{Arc, Line, Piece};
use super::super::placement::Ends;
use super::request::{Join, Objective, Outcome, Request, State};
use super::spiral::{Pose, Spiral, between, pinned, reversed};
use super::turns::{Turn, reach, turns, wrapped};
use crate::curve::vector::{Vector, add, dot, length, scale, sub, turn};
use crate::error::Result;
use std::f64::consts::PI;

/// A line shorter than this, in least radii, would not show its direction to 1e-12 by its ends.
const LEAST_LINE: f64 = 2e-3;
/// The middle turn of three.
const MIDDLE: Spiral = Spiral { from: 1.0, to: 0.0, length: 0.4 };

/// A way that is found but not built yet: turns by their places in the lists, and how far their arcs go round.
#[derive(Debug, Clone, Copy)]
struct Way {
    cost: f64,
    first: usize,
    last: usize,
    arcs: [f64; 2],
    /// The side of a middle turn, +1 left, and its arc; without it there is a line.
    middle: Option<(f64, f64)>,
}

/// The best join found between two states.
///
/// # Accuracy
/// Each spiral is proved to have monotone curvature, so |κ| stays within the limit. Pieces meet to 1e-12 in position, direction and
/// curvature, relative to the extent of coordinates in least radii; both ends are met exactly. The join is the best of those tried, not
/// of all.
///
/// # Errors
/// [`crate::Error::Domain`] naming a number that is not finite or not above 0, and where lengths leave the range of doubles. That there is no join is
/// no error.
pub fn join(request: &Request) -> Result<Outcome> {
    request.check()?;
    let Request { from, to, greatest_curvature: most, family, objective, longest, most_pieces } = *request;
    for (name, state) in [("start", &from), ("end", &to)] {
        if state.curvature.abs() > most {
            let k = state.curvature;
            return Ok(Outcome::None(format!("the {name} curvature {k:?} is beyond the greatest curvature {most:?}")));
        }
    }
    let across = scale(sub(to.point, from.point), most);
    if !length(across).is_finite() || length(across) > 1e12 {
        let radii = length(across);
        return Ok(Outcome::None(format!("the ends are {radii:?} least radii apart; joins are sought up to 1e12")));
    }
    let mut best: Option<Join> = None;
    let keep = |join: &Join| join.pieces.len() <= most_pieces && join.measures.length <= longest;
    for pieces in simple(request)? {
        let join = Join::new(vec![pieces]);
        if keep(&join) && best.as_ref().is_none_or(|b| value(&join, objective) < value(b, objective)) {
            best = Some(join);
        }
    }
    let here = Pose { at: [0.0, 0.0], direction: from.direction };
    let there = Pose { at: across, direction: to.direction + PI };
    let starts = turns(family, here, from.curvature / most, objective);
    let ends = turns(family, there, -to.curvature / most, objective);
    let mut ways = Vec::new();
    for (i, a) in starts.iter().enumerate() {
        for (j, b) in ends.iter().enumerate() {
            ways.extend(by_line(a, b, objective).map(|way| Way { first: i, last: j, ..way }));
            if a.exit == b.exit || (a.curvature.abs() == 1.0 && b.curvature.abs() == 1.0) {
                ways.extend(by_turn(request, a, b).into_iter().flatten().map(|way| Way { first: i, last: j, ..way }));
            }
        }
    }
    // A model of the cost orders them; those a little dearer than a join at hand are not built.
    ways.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let (mut shut, mut found) = ([vec![false; starts.len()], vec![false; ends.len()]], 0);
    for way in ways {
        let (a, b) = (&starts[way.first], &ends[way.last]);
        let between = if way.middle.is_some_and(|(_, arc)| arc > 0.0) { 3 } else { 1 + usize::from(way.middle.is_some()) };
        if shut[0][way.first] || shut[1][way.last] || a.pieces(way.arcs[0]) + b.pieces(way.arcs[1]) + between > most_pieces {
            continue;
        }
        match build(request, a, b, &way)? {
            Built::Join(pieces) => {
                let join = Join::new(pieces);
                if keep(&join) {
                    found += 1;
                    if best.as_ref().is_none_or(|b| value(&join, objective) < value(b, objective)) {
                        best = Some(join);
                    }
                    // Length is told by the model to a thousandth; the other objectives see the first of equals.
                    if found == 1 || objective == Objective::Length {
                        break;
                    }
                }
            }
            Built::Shut(end) => shut[end][if end == 0 { way.first } else { way.last }] = true,
        }
    }
    Ok(match best {
        Some(join) => Outcome::Join(join),
        None => Outcome::None(excluded(request)),
    })
}

fn value(join: &Join, objective: Objective) -> f64 {
    match objective {
        Objective::Length => join.measures.length,
        Objective::GreatestCurvature => join.measures.greatest_curvature,
        Objective::GreatestRate => join.measures.greatest_rate(),
        Objective::BendingEnergy => join.measures.bending_energy,
    }
}

/// Why nothing is left.
fn excluded(request: &Request) -> String {
    let free = Request { longest: f64::INFINITY, most_pieces: Request::MOST_PIECES, ..*request };
    let limited = request.longest.is_finite() || request.most_pieces < Request::MOST_PIECES;
    match if limited { join(&free) } else { Ok(Outcome::None(String::new())) } {
        Ok(Outcome::Join(join)) => format!(
            "no join found keeps to {} pieces and a length of {:?}; without these bounds one has {} pieces and is {:?} long",
            request.most_pieces,
            request.longest,
            join.pieces.len(),
            join.measures.length
        ),
        _ => "no turns and lines of those tried fit between these states; a greater limit of curvature gives them room".into(),
    }
}

/// Joins of one piece.
fn simple(request: &Request) -> Result<Vec<Piece>> {
    let Request { from, to, family, .. } = *request;
    let across = sub(to.point, from.point);
    let apart = length(across);
    let mut all = Vec::new();
    if apart == 0.0 {
        return Ok(all);
    }
    let turned = wrapped_even(to.direction - from.direction);
    if from.curvature == to.curvature {
        let k = from.curvature;
        if k == 0.0 {
            let along = [from.direction.cos(), from.direction.sin()];
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
    let State { point, direction, curvature } = to;
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

/// An angle within a half turn to either side.
fn wrapped_even(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}

/// Two turns with a line between.
fn by_line(a: &Turn, b: &Turn, objective: Objective) -> Option<Way> {
    let (across, reach) = (sub(b.centre, a.centre), add(a.reach, b.reach));
    let along = (dot(across, across) - reach[1] * reach[1]).max(-1.0).sqrt();
    let line = along - reach[0];
    if line.is_nan() || line < LEAST_LINE {
        return None;
    }
    let direction = across[1].atan2(across[0]) - reach[1].atan2(along);
    let arcs = [a.arc(direction), b.arc(direction + PI)];
    let cost = together(objective, [a.cost(arcs[0], objective), b.cost(arcs[1], objective)]);
    let cost = if objective == Objective::Length { cost + line } else { cost };
    Some(Way { cost, first: 0, last: 0, arcs, middle: None })
}

/// Costs of parts in one.
fn together<const N: usize>(objective: Objective, costs: [f64; N]) -> f64 {
    match objective {
        Objective::Length | Objective::BendingEnergy => costs.iter().sum(),
        _ => costs.into_iter().fold(0.0, f64::max),
    }
}

/// Two turns with a third between, of the limit of curvature, to either side.
fn by_turn(request: &Request, a: &Turn, b: &Turn) -> [Option<Way>; 4] {
    let mut ways = [None; 4];
    let objective = request.objective;
    let across = sub(b.centre, a.centre);
    let apart = length(across);
    for (n, way) in ways.iter_mut().enumerate() {
        let (side, flank) = (if n < 2 { 1.0 } else { -1.0 }, if n % 2 == 0 { 1.0 } else { -1.0 });
        let exit = Spiral { from: side, ..MIDDLE };
        // Seen backwards it turns the other way.
        let (ahead, behind) = (reach(request.family, &exit), reach(request.family, &Spiral { from: -side, ..exit }));
        let (into, out) = (add(a.reach, behind), add(ahead, b.reach));
        let (r, s) = (length(into), length(out));
        if apart == 0.0 || apart >= r + s || apart <= (r - s).abs() {
            continue;
        }
        let x = (apart * apart + r * r - s * s) / (2.0 * apart);
        let y = flank * (r * r - x * x).max(0.0).sqrt();
        let centre = add(a.centre, scale(turn(across, [x, y]), 1.0 / apart));
        let angle = |v: Vector| v[1].atan2(v[0]);
        let first = angle(sub(centre, a.centre)) - angle(into);
        let second = angle(sub(b.centre, centre)) - angle(out);
        let arc = wrapped(side * (second - first) - 2.0 * exit.angle().abs());
        let arcs = [a.arc(first), b.arc(second + PI)];
        let model = Turn { before: [Some(exit), None], curvature: side, ..*a };
        let model = Turn { exit, ..model };
        let costs = [a.cost(arcs[0], objective), model.cost(arc, objective), b.cost(arcs[1], objective)];
        *way = Some(Way { cost: together(objective, costs), first: 0, last: 0, arcs, middle: Some((side, arc)) });
    }
    ways
}

/// A way in pieces, or the end, 0 or 1, whose turn is not to be had.
enum Built {
    Join(Vec<Piece>),
    Shut(usize),
}

fn build(request: &Request, a: &Turn, b: &Turn, way: &Way) -> Result<Built> {
    let Request { from, to, greatest_curvature: most, family, .. } = *request;
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
    let Some((piece, end)) = turn.exit.piece(family, at, most)? else { return Ok(None) };
    pieces.push(piece);
    Ok(Some((pieces, end)))
}

/// Adds an arc that goes round by an angle, if it does.
fn add_arc(pieces: &mut Vec<Piece>, at: Pose, curvature: f64, angle: f64) -> Pose {
    if angle == 0.0 {
        return at;
    }
    let arc = Piece::Arc(Arc { start: at.at, start_direction: at.direction, curvature, length: angle / curvature.abs() });
    let end = Pose { at: arc.end(), direction: at.direction + angle.copysign(curvature) };
    pieces.push(arc);
    end
}
