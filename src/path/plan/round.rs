//! From a polyline to a smooth path: how far each corner curve reaches, and the spans.

use super::obstacles::Obstacles;
use super::search::{Limits, ROOM};
use crate::curve::PhQuintic;
use crate::error::Result;
use crate::path::{Turn, distance};

/// Halvings in search of the largest reach that is clear.
const HALVINGS: usize = 12;

/// A polyline with its turns.
pub(super) struct Polyline<'p> {
    pub points: &'p [[f64; 2]],
    pub turns: &'p [Turn],
}

impl Polyline<'_> {
    /// Of each corner the largest reach that leaves room for its neighbours and keeps clear: large curves bend less and
    /// are shorter.
    ///
    /// What the least reaches leave of a leg is halved between its corners.
    pub(super) fn reaches(&self, limits: &Limits, obstacles: &Obstacles) -> Vec<f64> {
        let least: Vec<f64> = self.turns.iter().map(|turn| limits.reach(turn)).collect();
        let at = |i: Option<usize>| i.and_then(|i| least.get(i));
        let share = |corner: usize, other: Option<usize>, leg: usize| {
            let leg = ROOM * distance(self.points[leg], self.points[leg + 1]);
            at(other).map_or(leg, |other| 0.5 * (leg + least[corner] - other))
        };
        let largest = |i: usize| share(i, i.checked_sub(1), i).min(share(i, Some(i + 1), i + 1)).max(least[i]);
        let clear =
            |i: usize, reach: f64| limits.breach(&self.turns[i], self.points[i + 1], reach, obstacles).is_none();
        (0..least.len()).map(|i| largest_clear([least[i], largest(i)], |reach| clear(i, reach))).collect()
    }

    /// Lines and corner curves in turn.
    pub(super) fn spans(&self, reaches: &[f64]) -> Result<Vec<PhQuintic>> {
        let [first, .., last] = self.points else { return Ok(vec![]) };
        let Some(last_turn) = self.turns.last() else { return Ok(vec![PhQuintic::straight(*first, *last)]) };
        let mut spans: Vec<PhQuintic> = vec![];
        for ((turn, at), reach) in self.turns.iter().zip(&self.points[1..]).zip(reaches) {
            let corner = turn.corner(*at, *reach)?;
            let start = spans.last().map_or(*first, |span| span.end);
            spans.extend([turn.line(false, [start, corner.start]), corner]);
        }
        let start = spans[spans.len() - 1].end;
        spans.push(last_turn.line(true, [start, *last]));
        Ok(spans)
    }
}

/// The larger end if it will do, else the largest found by halving; the smaller end is known to do.
fn largest_clear([mut low, mut high]: [f64; 2], clear: impl Fn(f64) -> bool) -> f64 {
    if clear(high) {
        return high;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if clear(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
