//! Paths as the tools report them.

use crate::curve::{Choice, PhQuintic};
use serde::Serialize;

/// A path, in numbers and in pieces.
#[derive(Debug, Clone, Serialize)]
pub struct PathReport {
    /// Arc length.
    pub length: f64,
    /// The integral of the squared curvature; NaN, which is written null, where the path stands still.
    pub bending_energy: f64,
    /// How far the direction turns, both ways added.
    pub absolute_rotation: f64,
    /// As of a [`CandidateReport`].
    pub greatest_curvature: f64,
    /// In order.
    pub pieces: Vec<PhQuintic>,
    /// Of how many it was chosen.
    #[serde(flatten)]
    pub choice: Option<ChoiceReport>,
}

/// All curves among which one was chosen.
#[derive(Debug, Clone, Serialize)]
pub struct ChoiceReport {
    /// Each of them.
    pub candidates: Vec<CandidateReport>,
    /// Index of the one of least absolute rotation.
    pub best: usize,
    /// Index of the one that the paper takes, where it takes one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paper: Option<usize>,
}

/// One of several curves.
#[derive(Debug, Clone, Serialize)]
pub struct CandidateReport {
    /// How far the direction turns, both ways added.
    pub absolute_rotation: f64,
    /// Whether it never stands still.
    pub regular: bool,
    /// Arc length.
    pub length: f64,
    /// NaN, which is written null, where it is not regular: curvature is unbounded there, or on a straight line there
    /// is none.
    pub greatest_curvature: f64,
    /// Its pre-image.
    pub preimage: [[f64; 2]; 3],
}

fn greatest_curvature(curve: &PhQuintic) -> f64 {
    if curve.is_regular() { curve.greatest_curvature().1 } else { f64::NAN }
}

impl PathReport {
    /// Of pieces in order.
    pub fn new(pieces: &[PhQuintic]) -> PathReport {
        let sum = |f: fn(&PhQuintic) -> f64| pieces.iter().map(f).sum();
        let most = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
        PathReport {
            length: sum(PhQuintic::length),
            bending_energy: sum(PhQuintic::bending_energy),
            absolute_rotation: sum(PhQuintic::absolute_rotation),
            greatest_curvature: pieces.iter().map(greatest_curvature).fold(0.0, most),
            pieces: pieces.to_vec(),
            choice: None,
        }
    }

    /// One of several.
    pub fn chosen(choice: &Choice, taken: usize, paper: Option<usize>) -> PathReport {
        let candidate = |c: &crate::curve::Candidate| CandidateReport {
            absolute_rotation: c.absolute_rotation,
            regular: c.regular,
            length: c.curve.length(),
            greatest_curvature: greatest_curvature(&c.curve),
            preimage: c.curve.preimage,
        };
        let candidates = choice.candidates.iter().map(candidate).collect();
        PathReport {
            choice: Some(ChoiceReport { candidates, best: choice.best, paper }),
            ..PathReport::new(&[choice.candidates[taken].curve])
        }
    }
}
