//! Which other end curvature would do, where only one family of curves fails.

use super::none::{Bound, NoSpiral};
use super::placement::Ends;
use super::turn::Which;
use super::words::{rounded, short};
use crate::error::Result;
use serde::Serialize;

/// Doublings away from the curvature in question that are tried, to either side.
const DOUBLINGS: i32 = 24;
/// Greatest curvature times half the chord for which others are tried: each answer beyond it takes numbers of hundreds
/// of digits.
const GREATEST: f64 = 1e30;
/// Halvings, in logarithms, of the last doubling.
const HALVINGS: u32 = 8;

/// A curvature of one end that gives a spiral of the family, all else being as it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Remedy {
    /// The end.
    pub which: Which,
    /// Its curvature as it is, user units.
    pub curvature: f64,
    /// What it could be: the nearest of those tried. A curve exists for it; nothing is said of those between.
    pub instead: f64,
}

impl Remedy {
    /// For either end. `exists` must be a proof.
    ///
    /// Curvatures are given by their distance from the bound that a spiral of any kind asks for: it is doubled and
    /// halved until the family has a spiral, and the last doubling is halved so that the answer is within a few
    /// thousandths of the nearest.
    ///
    /// It asks at most `2 (2 * 24 + 8) = 112` times, so `exists` must be cheap, and batches do without.
    ///
    /// # Errors
    /// Those of [`super::Placement::normalise`].
    pub(super) fn nearest(ends: &Ends, exists: impl Fn(&Ends) -> bool) -> Result<Vec<Remedy>> {
        let mut all = Vec::new();
        let (chord, _) = ends.chord()?;
        if chord.k1.abs().max(chord.k2.abs()) > GREATEST {
            return Ok(all);
        }
        for which in [Which::End, Which::Start] {
            let curvature = of(ends, which);
            let Some(bound) = NoSpiral::bound(ends, which)?.map(Bound::value) else { continue };
            // Rounded first, so that what is reported is what was tried.
            let at = |power: f64| rounded(bound + (curvature - bound) * power.exp2());
            let works = |power: f64| {
                let instead = at(power);
                // Not through a straight end to the other side.
                instead != curvature
                    && instead * curvature > 0.0
                    && instead.is_finite()
                    && exists(&with(ends, which, instead))
            };
            let powers = (1..=DOUBLINGS).flat_map(|n| [f64::from(n), f64::from(-n)]);
            let Some(mut good) = powers.into_iter().find(|power| works(*power)) else { continue };
            let mut bad = good - good.signum();
            for _ in 0..HALVINGS {
                let middle = 0.5 * (good + bad);
                if works(middle) { good = middle } else { bad = middle }
            }
            all.push(Remedy { which, curvature, instead: at(good) });
        }
        Ok(all)
    }
}

/// What would help, as the end of a sentence.
pub(super) fn advice(remedies: &[Remedy]) -> String {
    let one = |r: &Remedy| format!("{} in place of the {} curvature {:?}", short(r.instead), r.which, r.curvature);
    match remedies {
        [] => String::new(),
        some => format!("; {} would give a spiral", some.iter().map(one).collect::<Vec<_>>().join(", or ")),
    }
}

fn of(ends: &Ends, which: Which) -> f64 {
    if which == Which::Start { ends.start_curvature } else { ends.end_curvature }
}

fn with(ends: &Ends, which: Which, curvature: f64) -> Ends {
    match which {
        Which::Start => Ends { start_curvature: curvature, ..*ends },
        Which::End => Ends { end_curvature: curvature, ..*ends },
    }
}
