//! What `query` reports of one datum.

use super::datum::{Datum, check};
use super::truth::{Best, Greatest, Known, best, greatest_of, least};
use super::{Kind, PhPath};
use crate::curve::vector::{length, sub};
use crate::curve::{Candidate, Choice, EqualLength, Hermite, equal_length, hermite};
use crate::error::Result;
use crate::family::{Answer, Value, Values, verdict};
use crate::num::{Ball, Interval, TWIN_BITS, Twin, climb};

pub(super) fn answer(kind: Kind, point: &[f64]) -> Result<Answer> {
    let code = verdict(&PhPath(kind), 0, point)?;
    for (axis, value) in point.iter().enumerate() {
        check(kind, axis, *value)?;
    }
    let datum = Datum::new(kind, point);
    let mut derived = Vec::new();
    for (name, paper) in [("kappa_max", false), ("kappa_max_paper", true)] {
        if let Some(value) = rounded(&datum, paper)? {
            derived.push((name, value.into()));
        }
    }
    let choice = solutions(&datum)?;
    let middle = |i: usize| choice.candidates[i].curve.preimage[1];
    let chosen = chosen(&datum, &middle)?;
    let by_twins = greatest_of::<Twin>(&datum, TWIN_BITS, |_| true).unwrap_or_default();
    let mut solutions = Vec::with_capacity(choice.candidates.len());
    for (i, candidate) in choice.candidates.iter().enumerate() {
        // Doubles call a curve irregular that comes near to standing still.
        let regular = candidate.regular || chosen == Some(i);
        let most = if regular { Some(greatest(&datum, i, &middle, &by_twins)?) } else { None };
        solutions.push(values(candidate, most));
    }
    Ok(Answer { code, derived, solutions, chosen })
}

/// The candidate that a solution is: the first two have `w2` with the positive sign, and of mirror images it is the
/// first.
fn index(known: &Known, middle: impl Fn(usize) -> [f64; 2]) -> usize {
    let first = if known.paper { 0 } else { 2 };
    let off = |i: usize| length(sub(middle(i), known.middle));
    if known.alone || off(first) <= off(first + 1) { first } else { first + 1 }
}

/// The solution that bends least, proved; of those that tie the first.
fn chosen(datum: &Datum, middle: &impl Fn(usize) -> [f64; 2]) -> Result<Option<usize>> {
    let found = match best::<Ball>(datum, 53).or_else(|| best::<Twin>(datum, TWIN_BITS)) {
        Some(found) => found,
        None => climb(datum, "which solution bends least", |bits| best::<Interval>(datum, bits))?.0,
    };
    Ok(match found {
        Best::None => None,
        // Only the larger middle moves on.
        Best::Straight => Some(if middle(0)[0] >= middle(1)[0] { 0 } else { 1 }),
        Best::Bent(all) => all.iter().map(|known| index(known, middle)).min(),
    })
}

/// The greatest curvature of a candidate, rounded to nearest: by two doubles, or else by intervals. Where no solution
/// that bends is like it, it is a straight line.
fn greatest(
    datum: &Datum,
    candidate: usize,
    middle: &impl Fn(usize) -> [f64; 2],
    by_twins: &[(Known, Option<Twin>)],
) -> Result<f64> {
    let is = |known: &Known| {
        let first = index(known, middle);
        first == candidate || known.alone && first / 2 == candidate / 2
    };
    let twin = by_twins.iter().find(|(known, _)| is(known)).map(|(_, most)| most.and_then(|most| most.to_f64()));
    match twin {
        Some(Some(most)) => return Ok(most),
        None if !by_twins.is_empty() => return Ok(0.0),
        _ => {}
    }
    let attempt = |bits| match greatest_of::<Interval>(datum, bits, is)?.into_iter().next() {
        Some((_, most)) => most?.to_f64(),
        None => Some(0.0),
    };
    Ok(climb(datum, "a greatest curvature", attempt)?.0)
}

/// The proved value, rounded to nearest: by two doubles, or else by intervals.
fn rounded(datum: &Datum, paper: bool) -> Result<Option<f64>> {
    let by_twins = match least::<Twin>(datum, paper, TWIN_BITS) {
        Some(Greatest::None) => return Ok(None),
        Some(Greatest::Value(value)) => value.to_f64(),
        None => None,
    };
    if by_twins.is_some() {
        return Ok(by_twins);
    }
    let attempt = |bits| match least::<Interval>(datum, paper, bits)? {
        Greatest::None => Some(None),
        Greatest::Value(value) => value.to_f64().map(Some),
    };
    climb(datum, "a greatest curvature", attempt).map(|(value, _)| value)
}

/// The curves in doubles, from (0, 0) to (1, 0).
fn solutions(datum: &Datum) -> Result<Choice> {
    let (start, end, [first, last]) = ([0.0, 0.0], [1.0, 0.0], datum.theta);
    match datum.kind {
        Kind::EqualLength => equal_length(&EqualLength {
            start,
            end,
            start_direction: first,
            end_direction: last,
            length: datum.size[0],
        }),
        Kind::Hermite => {
            let derivative = |size: f64, angle: f64| [size * angle.cos(), size * angle.sin()];
            let [start_derivative, end_derivative] =
                [derivative(datum.size[0], first), derivative(datum.size[1], last)];
            hermite(&Hermite { start, end, start_derivative, end_derivative })
        }
    }
}

fn values(candidate: &Candidate, kappa_max: Option<f64>) -> Values {
    let mut values: Values = vec![("regular", kappa_max.is_some().into())];
    // Where it stands still, the curvature is infinite or nothing at all.
    values.extend(kappa_max.map(|most| ("kappa_max", most.into())));
    let points: Value = candidate.curve.control_points().into();
    values.extend([
        ("absolute_rotation", candidate.absolute_rotation.into()),
        ("length", candidate.curve.length().into()),
        ("control_points", points),
    ]);
    values
}
