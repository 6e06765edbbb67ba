//! Where a property holds along one coordinate.

use super::property::{Cell, Property};
use crate::error::{Error, Result};
use crate::num::{Verdict, demand_ieee};
use crate::queue::Queue;

/// Parts are halved until they are as narrow as this share of their larger end.
const NARROW: f64 = 1e-13;
/// Most boxes that one answer looks at. An edge needs some 100; only data on which the property is at its limit along a
/// whole stretch need so many, and angles so small that their products leave the range of doubles.
const MOST_BOXES: usize = 4_000;

/// An interval in which a property holds.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Range {
    /// Its ends: it holds at these doubles, and at their neighbours outside it does not, unless an open interval is
    /// here or the range is `cut`. Both by exact verdicts.
    pub ends: [f64; 2],
    /// Which of the ends are none of the property: the interval that was asked about ends there, and the property goes
    /// on beyond.
    pub cut: [bool; 2],
    /// It holds at each number from the first to the second, both included: proved.
    pub inner: [f64; 2],
    /// Below the first and above the second it fails up to the next range or open interval, or to the end of the
    /// interval that was asked about. Between `inner` and these it may change more than once.
    pub outer: [f64; 2],
}

/// All that is known of a property along one coordinate.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Ranges {
    /// Where it holds, in increasing order.
    pub ranges: Vec<Range>,
    /// Where it is not known whether it holds: mostly narrow intervals at which it only touches its limit. Everywhere
    /// else outside the ranges it is proved to fail.
    pub open: Vec<[f64; 2]>,
    /// How many boxes were looked at.
    pub boxes: usize,
}

/// All intervals of one coordinate in which a property holds, the others being given.
///
/// # Arguments
/// - `point`: the datum; the coordinate `axis` in it does not matter.
/// - `within`: the interval of that coordinate. What of it lies outside the family's domain counts as failing.
///
/// # Accuracy
/// `ends` are exact. `inner` and `outer` differ by some 1e-12 to 1e-10, relative, where the property crosses its limit
/// at an angle; by more where it comes near to its limit without crossing. All is proved by boxes, nothing is sampled.
///
/// # Errors
/// [`Error::Domain`] for a datum or an interval that is none; [`Error::Undecided`] at the precision cap.
pub fn ranges(property: &Property, point: &[f64], axis: usize, within: [f64; 2]) -> Result<Ranges> {
    demand_ieee()?;
    let mut point = point.to_vec();
    let Some(slot) = point.get_mut(axis) else {
        return Err(Error::invalid(format!("the coordinate is number {axis}; there are {}", point.len())));
    };
    *slot = within[0];
    let mut whole = property.point(&point)?;
    let [low, high] = within;
    if !(low < high && high.is_finite()) {
        return Err(Error::invalid(format!(
            "the interval is {low:?} to {high:?}; it must have two finite, increasing ends"
        )));
    }
    whole.high[axis] = high;
    if !property.clip(&mut whole) {
        return Ok(Ranges { ranges: Vec::new(), open: Vec::new(), boxes: 0 });
    }
    let (mut parts, boxes) = divided(property, whole, axis);
    parts.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut found = gathered(&parts, boxes);
    let beyond = [low.next_down(), high.next_up()];
    for range in &mut found.ranges {
        for side in 0..2 {
            let end = last(property, &mut point, axis, range.inner[side], range.outer[side])?;
            range.ends[side] = end;
            if end == within[side] {
                point[axis] = beyond[side];
                // What is not decided there is no end that is known.
                range.cut[side] = !matches!(property.at(&point), Ok(None | Some(false)));
            }
        }
    }
    Ok(found)
}

/// The last double from one at which the property holds towards one beyond which it fails, by exact verdicts.
fn last(property: &Property, point: &mut [f64], axis: usize, mut holds: f64, fails: f64) -> Result<f64> {
    let mut at = |x: f64| {
        point[axis] = x;
        Ok::<_, Error>(property.at(point)? == Some(true))
    };
    if at(fails)? {
        return Ok(fails);
    }
    let mut fails = fails;
    loop {
        let middle = 0.5 * holds + 0.5 * fails;
        if middle == holds || middle == fails {
            return Ok(holds);
        }
        if at(middle)? {
            holds = middle;
        } else {
            fails = middle;
        }
    }
}

/// The parts of an interval, each with what is known of it.
///
/// Wider parts come first, so that the budget is not spent on what hardly matters. Widths count on a scale that is even
/// up to 1, logarithmic beyond and bounded at last, so that neither tiny nor huge numbers take it all.
fn divided(property: &Property, whole: Cell, axis: usize) -> (Vec<([f64; 2], Verdict)>, usize) {
    let (mut parts, mut waiting, mut boxes) = (Vec::new(), Queue::new(), 0);
    let scale = |x: f64| x.asinh().atan();
    let push =
        |waiting: &mut Queue<Cell>, cell: Cell| waiting.push(scale(cell.low[axis]) - scale(cell.high[axis]), cell);
    push(&mut waiting, whole);
    while let Some((_, cell)) = waiting.pop() {
        let side = [cell.low[axis], cell.high[axis]];
        if boxes == MOST_BOXES {
            parts.push((side, Verdict::Undecided));
            continue;
        }
        boxes += 1;
        let known = property.over(&cell);
        let narrow = side[1] - side[0] <= NARROW * side[0].abs().max(side[1].abs());
        match cell.middle(axis) {
            Some(middle) if known.is_open() && !narrow => {
                cell.parts(axis, middle).into_iter().for_each(|part| push(&mut waiting, part));
            }
            _ => parts.push((side, known)),
        }
    }
    (parts, boxes)
}

/// Ranges from neighbouring parts.
fn gathered(parts: &[([f64; 2], Verdict)], boxes: usize) -> Ranges {
    let mut merged: Vec<([f64; 2], Verdict)> = Vec::new();
    for (side, known) in parts {
        match merged.last_mut() {
            Some((last, before)) if before == known => last[1] = side[1],
            _ => merged.push((*side, *known)),
        }
    }
    let part = |i: Option<usize>| i.and_then(|i| merged.get(i));
    let known = |i: Option<usize>| part(i).map_or(Verdict::Undecided, |(_, known)| *known);
    let mut found = Ranges { ranges: Vec::new(), open: Vec::new(), boxes };
    for (i, (side, verdict)) in merged.iter().enumerate() {
        let (before, after) = (i.checked_sub(1), Some(i + 1));
        match verdict {
            Verdict::Yes => {
                // An open interval beside it is its edge, unless another range begins beyond that.
                let edge = |next: Option<usize>, beyond: Option<usize>| {
                    part(next).filter(|(_, open)| open.is_open() && !known(beyond).is_yes()).map(|(gap, _)| gap)
                };
                let low = edge(before, i.checked_sub(2)).map_or(side[0], |gap| gap[0]);
                let high = edge(after, Some(i + 2)).map_or(side[1], |gap| gap[1]);
                found.ranges.push(Range { ends: *side, cut: [false; 2], inner: *side, outer: [low, high] });
            }
            Verdict::No => {}
            // Undecided between a yes and a no: the end of a range, already reported by its `outer`.
            Verdict::Undecided if !known(before).is_open() && known(after) == !known(before) => {}
            Verdict::Undecided => found.open.push(*side),
        }
    }
    found
}
