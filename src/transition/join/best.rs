//! The best of the joins that are tried.

use super::super::piece::Piece;
use super::measure::{Measures, bending_energy, greatest_curvature, greatest_rate};
use super::request::{Join, Objective, Request};

/// Keeps the best join that is within the bounds.
pub(super) struct Best<'r> {
    request: &'r Request,
    /// The best so far.
    found: Option<Found>,
    /// How many were within the bounds.
    pub kept: usize,
}

struct Found {
    pieces: Vec<Piece>,
    length: f64,
    /// What is to be least.
    value: f64,
}

impl<'r> Best<'r> {
    pub(super) fn new(request: &'r Request) -> Best<'r> {
        Best { request, found: None, kept: 0 }
    }

    /// Of equal ones the first is kept. The length, if it is within the bounds.
    pub(super) fn offer(&mut self, pieces: Vec<Piece>) -> Option<f64> {
        let Request { objective, longest, most_pieces, greatest_curvature: limit, .. } = *self.request;
        let length = pieces.iter().map(Piece::length).sum::<f64>();
        if pieces.len() > most_pieces || length.is_nan() || length > longest {
            return None;
        }
        self.kept += 1;
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
