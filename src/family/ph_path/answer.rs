//! What `query` reports of one datum.

use super::datum::{Datum, check};
use super::truth::{Greatest, least};
use super::{Kind, PhPath};
use crate::curve::{Candidate, Choice, EqualLength, Hermite, equal_length, hermite};
use crate::error::Result;
use crate::family::{Answer, Value, Values, verdict};
use crate::num::{Interval, TWIN_BITS, Twin, climb};

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
    let sizes: Vec<f64> = choice.candidates.iter().map(|c| c.curve.greatest_curvature().1).collect();
    let regular = |i: &usize| choice.candidates[*i].regular;
    let chosen = (0..sizes.len()).filter(regular).min_by(|i, j| sizes[*i].total_cmp(&sizes[*j]));
    Ok(Answer { code, derived, solutions: choice.candidates.iter().zip(sizes).map(values).collect(), chosen })
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

fn values((candidate, kappa_max): (&Candidate, f64)) -> Values {
    let mut values: Values = vec![("regular", candidate.regular.into())];
    // Where it stands still, the curvature is infinite or nothing at all.
    if candidate.regular {
        values.push(("kappa_max", kappa_max.into()));
    }
    let points: Value = candidate.curve.control_points().into();
    values.extend([
        ("absolute_rotation", candidate.absolute_rotation.into()),
        ("length", candidate.curve.length().into()),
        ("control_points", points),
    ]);
    values
}
