//! The best of the joins that are tried.

use super::super::piece::Piece;
use super::request::{Join, Objective, Request};

/// Keeps the best join that is within the bounds.
pub(super) struct Best<'r> {
    request: &'r Request,
    /// The best so far.
    pub join: Option<Join>,
    /// How many were within the bounds.
    pub kept: usize,
}

impl<'r> Best<'r> {
    pub(super) fn new(request: &'r Request) -> Best<'r> {
        Best { request, join: None, kept: 0 }
    }

    /// Of equal ones the first is kept. The length, if it is within the bounds.
    pub(super) fn offer(&mut self, pieces: Vec<Piece>) -> Option<f64> {
        let Request { objective, longest, most_pieces, greatest_curvature, .. } = *self.request;
        let join = Join::new(pieces, greatest_curvature);
        if join.pieces.len() > most_pieces || join.measures.length.is_nan() || join.measures.length > longest {
            return None;
        }
        let length = join.measures.length;
        self.kept += 1;
        if self.join.as_ref().is_none_or(|best| value(&join, objective) < value(best, objective)) {
            self.join = Some(join);
        }
        Some(length)
    }
}

fn value(join: &Join, objective: Objective) -> f64 {
    match objective {
        Objective::Length => join.measures.length,
        Objective::GreatestCurvature => join.measures.greatest_curvature,
        Objective::GreatestRate => join.measures.greatest_rate(),
        Objective::BendingEnergy => join.measures.bending_energy,
    }
}
