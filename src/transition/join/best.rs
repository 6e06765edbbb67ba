//! The best of the joins that are tried.

use super::super::piece::Piece;
use super::costs::Costs;
use super::measure::{Measures, bending_energy, greatest_curvature, greatest_rate};
use super::request::{Join, Objective, Request};
use crate::error::Result;

/// How many of the best ways by each objective are built. Curvatures are known, rates of cubics and PH quintics to a
/// tenth; the rest is what clothoids would have.
const BUILT: [(Objective, usize); 4] = [
    (Objective::Length, 1),
    (Objective::GreatestCurvature, 2),
    (Objective::GreatestRate, 6),
    (Objective::BendingEnergy, 8),
];

/// Keeps the best join that is within the bounds.
pub(super) struct Best<'r> {
    request: &'r Request,
    /// The best so far.
    found: Option<Found>,
}

struct Found {
    pieces: Vec<Piece>,
    length: f64,
    /// What is to be least.
    value: f64,
}

impl<'r> Best<'r> {
    pub(super) fn new(request: &'r Request) -> Best<'r> {
        Best { request, found: None }
    }

    /// Of equal ones the first is kept. The length, if it is within the bounds.
    pub(super) fn offer(&mut self, pieces: Vec<Piece>) -> Option<f64> {
        let Request { objective, longest, most_pieces, greatest_curvature: limit, .. } = *self.request;
        let length = pieces.iter().map(Piece::length).sum::<f64>();
        if pieces.len() > most_pieces || length.is_nan() || length > longest {
            return None;
        }
        let value = match objective {
            Objective::Length => length,
            Objective::GreatestCurvature => greatest_curvature(&pieces, limit),
            Objective::GreatestRate => greatest_rate(&pieces),
            Objective::BendingEnergy => bending_energy(&pieces),
        };
        if self.found.as_ref().is_none_or(|best| value < best.value) {
            self.found = Some(Found { pieces, length, value });
        }
        Some(length)
    }

    /// Builds and offers the best ways by each objective, or the shortest alone: the same ones whatever is asked for.
    /// `build` has nothing for a way that is not to be had.
    pub(super) fn build<W>(
        &mut self,
        ways: &[(Costs, W)],
        shortest_alone: bool,
        mut build: impl FnMut(&W) -> Result<Option<Vec<Piece>>>,
    ) -> Result<()> {
        let mut order: Vec<usize> = (0..ways.len()).collect();
        // Lengths of those that were built, in least radii, should they be within the bounds.
        let mut built: Vec<Option<Option<f64>>> = vec![None; ways.len()];
        for (objective, enough) in BUILT.into_iter().take(if shortest_alone { 1 } else { BUILT.len() }) {
            let by = |i: usize, objective| ways[i].0.by(objective);
            // The shortest of equals come first.
            order.sort_by(|&i, &j| {
                let length = || by(i, Objective::Length).total_cmp(&by(j, Objective::Length));
                by(i, objective).total_cmp(&by(j, objective)).then_with(length)
            });
            let (mut kept, mut shortest) = (0, f64::INFINITY);
            for &i in &order {
                let shorter = objective == Objective::Length && ways[i].0.length[0] < shortest;
                if kept >= enough && !shorter {
                    continue;
                }
                let length = match built[i] {
                    Some(length) => length,
                    None => {
                        let pieces = build(&ways[i].1)?;
                        let length = pieces.and_then(|pieces| self.offer(pieces));
                        *built[i].insert(length.map(|length| length * self.request.greatest_curvature))
                    }
                };
                if let Some(length) = length {
                    kept += 1;
                    shortest = shortest.min(length);
                }
            }
        }
        Ok(())
    }

    /// Length of the best so far.
    pub(super) fn length(&self) -> Option<f64> {
        self.found.as_ref().map(|best| best.length)
    }

    /// The best, with all its numbers.
    pub(super) fn join(self) -> Option<Join> {
        let limit = self.request.greatest_curvature;
        self.found.map(|Found { pieces, length, .. }| Join { measures: Measures::of(&pieces, length, limit), pieces })
    }
}
