//! A path of a lattice.

use crate::error::Result;
use crate::transition::{Arc, Piece, Station, stations};

/// A path from the origin to a cell of the grid, straight at both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// Place of its first direction in [`super::Lattice::heading_angles`].
    pub start: usize,
    /// Place of its last direction.
    pub end: usize,
    /// Where it ends, in cells.
    pub cell: [i64; 2],
    /// Its pieces: a line; or a turn of two spirals with an arc between or none, with a line before it or behind it
    /// where there is room.
    pub pieces: Vec<Piece>,
}

impl Primitive {
    /// Arc length in metres.
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// Of its lines.
    pub fn straight_length(&self) -> f64 {
        self.pieces
            .iter()
            .filter(|piece| matches!(piece, Piece::Line(_)))
            .map(Piece::length)
            .fold(0.0, |sum, length| sum + length)
    }

    /// Greatest |κ|, in 1 / m, to 1e-12: at an end of a piece, since the curvature of each is monotone.
    pub fn greatest_curvature(&self) -> f64 {
        self.curvatures().fold(0.0, |most, k| most.max(k.abs()))
    }

    /// Whether it turns left; nav2 says so of lines, too.
    pub fn left_turn(&self) -> bool {
        self.curvatures().max_by(|a, b| a.abs().total_cmp(&b.abs())).is_none_or(|k| k >= 0.0)
    }

    /// Curvatures at the ends of its pieces.
    fn curvatures(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().flat_map(|piece| match piece {
            Piece::Line(_) => [0.0, 0.0],
            Piece::Arc(Arc { curvature, .. }) => [*curvature; 2],
            _ => piece.range().map(|t| piece.at(t).curvature),
        })
    }

    /// So many steps of equal length along it, and its start.
    ///
    /// # Errors
    /// [`Domain`](crate::Error::Domain) for no step.
    pub fn stations(&self, steps: usize) -> Result<Vec<Station>> {
        stations(&self.pieces, steps + 1)
    }
}
