//! All curves that solve a problem, and the one to take.

use super::PhQuintic;
use crate::error::{Error, OTHER_UNIT, Result};
use serde::Serialize;

/// One of several curves that solve a problem.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Candidate {
    /// The curve.
    pub curve: PhQuintic,
    /// `∫|κ| ds`, radians: how much the tangent turns.
    pub absolute_rotation: f64,
    /// Whether it stands still nowhere: [`PhQuintic::is_regular`].
    pub regular: bool,
}

/// All curves that solve a problem, and the one to take.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Choice {
    /// In the order that the problem states.
    pub candidates: Vec<Candidate>,
    /// Index of the one with least absolute rotation among those that stand still nowhere; of mirror images that tie,
    /// the first.
    pub best: usize,
}

impl Choice {
    pub(super) fn of(what: &str, curves: impl IntoIterator<Item = PhQuintic>) -> Result<Choice> {
        let candidate = |curve: PhQuintic| {
            let candidate =
                Candidate { absolute_rotation: curve.absolute_rotation(), regular: curve.is_regular(), curve };
            if curve.is_finite() && candidate.absolute_rotation.is_finite() {
                return Ok(candidate);
            }
            Err(Error::beyond_doubles(format!("{what}: a solution"), OTHER_UNIT))
        };
        let candidates = curves.into_iter().map(candidate).collect::<Result<Vec<_>>>()?;
        let best = best(&candidates, 0..candidates.len());
        Ok(Choice { candidates, best })
    }

    /// The one to take.
    pub fn best(&self) -> &PhQuintic {
        &self.candidates[self.best].curve
    }
}

/// The regular one of least absolute rotation; without a regular one, of all. Rotations that differ by rounding alone
/// tie.
pub(super) fn best(candidates: &[Candidate], range: std::ops::Range<usize>) -> usize {
    let key = |i: usize| (!candidates[i].regular, candidates[i].absolute_rotation);
    let less = |a: (bool, f64), b: (bool, f64)| (a.0, a.1 * (1.0 + 1e-12)) < b;
    let first = range.start;
    range.fold(first, |best, i| if less(key(i), key(best)) { i } else { best })
}
