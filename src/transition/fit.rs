//! One question for all families: the spiral between two ends in the user's units, or why there is none.

use super::{Ends, InvoluteBetween, Kind, Piece, involute_between, ph_spiral, spiral, why_no_spiral};
use crate::error::{Result, above_zero, by_name};

/// What [`fit`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Every curve of the kind with these ends, spirals or not.
    pub solutions: Vec<Piece>,
    /// Which of them are spirals, proved.
    pub spirals: Vec<bool>,
    /// The index of the chosen spiral, or in a sentence why there is none.
    pub outcome: std::result::Result<usize, String>,
}

impl Fit {
    /// The chosen spiral.
    pub fn curve(&self) -> Option<&Piece> {
        self.outcome.as_ref().ok().map(|i| &self.solutions[*i])
    }
}

/// The kinds of curves that [`fit`] finds.
pub const FITTED: [Kind; 3] = [Kind::Cubic, Kind::PhQuintic, Kind::Involute];

/// The kind of a name, one of [`FITTED`].
///
/// # Arguments
/// - `what`: what the caller's users know the name as, such as "kind".
///
/// # Errors
/// [`crate::Error::Domain`], with the names that there are.
pub fn fitted(what: &str, name: &str) -> Result<Kind> {
    by_name(what, name, &FITTED, Kind::name)
}

/// The curves of one kind between two ends, and the chosen spiral among them.
///
/// # Arguments
/// - `kind`: [`Kind::Cubic`], of several spirals the one with the largest margin; [`Kind::PhQuintic`], that of least
///   bending energy; or [`Kind::Involute`], the image of an involute of a circle, which exists whenever any spiral
///   does.
/// - `longest`: a spiral longer than this counts as none; infinity for no limit.
///
/// # Errors
/// [`crate::Error::Domain`] for another kind, a limit that is not above 0, and what [`spiral`], [`ph_spiral`] and
/// [`involute_between`] refuse; [`crate::Error::Undecided`] at the precision cap. That there is no spiral is no error.
pub fn fit(ends: &Ends, kind: Kind, longest: f64) -> Result<Fit> {
    above_zero("the greatest length", longest)?;
    match fitted("kind", kind.name())? {
        Kind::Cubic => {
            let answer = spiral(ends)?.no_longer_than(longest);
            Ok(Fit {
                solutions: answer.solutions.iter().map(|s| s.piece()).collect(),
                spirals: answer.solutions.iter().map(|s| s.spiral).collect(),
                outcome: answer.outcome.map_err(|why| why.sentence("cubic spiral")),
            })
        }
        Kind::PhQuintic => {
            let answer = ph_spiral(ends)?.no_longer_than(longest);
            Ok(Fit {
                solutions: answer.solutions.iter().map(|s| Piece::PhQuintic(s.curve)).collect(),
                spirals: answer.solutions.iter().map(|s| s.spiral).collect(),
                outcome: answer.outcome.map_err(|why| why.sentence("PH quintic spiral")),
            })
        }
        _ => {
            let (found, frame) = involute_between(ends, [0, 0])?;
            let solutions: Vec<Piece> =
                InvoluteBetween::of(ends, &found, &frame).map(Piece::Involute).into_iter().collect();
            let length: f64 = solutions.iter().map(Piece::length).sum();
            let outcome = match found.outcome {
                Ok(_) if length <= longest => Ok(0),
                Ok(_) => Err(format!("the spiral is {length:?} long, longer than {longest:?}")),
                Err(_) => Err(why_no_spiral(ends, &found).unwrap_or_default()),
            };
            Ok(Fit { spirals: vec![true; solutions.len()], solutions, outcome })
        }
    }
}

/// Ends that a spiral of each kind joins.
#[cfg(test)]
pub(super) const ENDS: Ends = Ends {
    start: [0.0, 0.0],
    end: [200.0, 0.0],
    start_direction: -0.7,
    end_direction: 1.4,
    start_curvature: 0.004,
    end_curvature: 0.04,
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_has_its_spiral_or_a_reason() {
        for kind in FITTED {
            let found = fit(&ENDS, kind, f64::INFINITY).unwrap();
            let curve = found.curve().unwrap_or_else(|| panic!("{kind:?}: {:?}", found.outcome));
            assert!(curve.kind() == kind && (curve.start(), curve.end()) == (ENDS.start, ENDS.end));
            assert!(found.spirals.len() == found.solutions.len() && found.spirals[found.outcome.clone().unwrap()]);
            let shorter = fit(&ENDS, kind, 0.999 * curve.length()).unwrap();
            assert!(shorter.outcome.unwrap_err().contains("long"), "{kind:?}");
            let none = fit(&Ends { start_direction: 0.7, ..ENDS }, kind, f64::INFINITY).unwrap();
            assert!(none.curve().is_none() && none.outcome.unwrap_err().len() > 20);
        }
    }

    #[test]
    fn what_cannot_be_asked_is_refused() {
        assert!(fit(&ENDS, Kind::Arc, 1.0).unwrap_err().to_string().contains("`arc`"));
        assert!(fit(&ENDS, Kind::Cubic, f64::NAN).unwrap_err().to_string().contains("NaN"));
    }
}
