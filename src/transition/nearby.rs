//! Ends near the given ones that a spiral joins, where none joins those.
//!
//! [`crate::question::nearest`] proves how near the nearest is, in normalised numbers, and takes a second to half a
//! minute. A page that follows a pointer has some 50 ms. So this looks at a few thousand ends, each of them with a
//! verdict in microseconds, and promises no more than that a spiral joins those it returns.

use super::placement::Ends;
use super::words::rounded;
use super::{Kind, cubic, fitted, ph_quintic};
use crate::curve::vector::length;
use crate::error::Result;
use crate::family::any_spiral::AnySpiral;
use crate::family::{Family, verdict};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Radius of the first ring, and how much each is wider than the one before.
const FIRST: f64 = 1.0 / 64.0;
const WIDER: f64 = 1.3;
/// Radius up to which curvatures alone are changed before directions are, too; and the widest of all.
const NEAR: f64 = 2.0;
const FAR: f64 = 8.0;
/// Ways from the middle, in the plane of both curvatures and in that of both directions.
const WAYS: [usize; 2] = [48, 12];
/// How a step is shared among curvatures and directions: angles from the former to the latter.
const SHARES: [f64; 3] = [FRAC_PI_2 / 3.0, FRAC_PI_2 * 2.0 / 3.0, FRAC_PI_2];
/// Halvings of the last step.
const HALVINGS: u32 = 10;

/// A step: of the start and end curvature, and of the start and end direction.
type Way = [f64; 4];

/// Ends that a spiral of a kind joins, near the given ones: the nearest of those that are tried. The points stay
/// as they are.
///
/// A distance is measured in directions (radians) and in the inverse hyperbolic sines of curvatures times half the
/// chord: these are as the curvatures themselves where those are small, and as their logarithms where they are large.
/// Curvatures alone are changed if a change by a factor of about 7 suffices. Rings of growing size are tried until one
/// has a spiral somewhere; the step to it is then shortened by halving. At most 7000 ends are tried.
///
/// # Arguments
/// - `kind`: [`Kind::Cubic`], [`Kind::PhQuintic`], or [`Kind::Involute`] for any spiral.
///
/// # Returns
/// `None` where none of those tried does. The existence of the spiral is proved, for the numbers returned, which have
/// six digits where they differ from the given ones.
///
/// # Errors
/// [`crate::Error::Domain`] for another kind, and those of [`super::Placement::normalise`].
pub fn nearby(ends: &Ends, kind: Kind) -> Result<Option<Ends>> {
    let exists: fn(&Ends) -> bool = match fitted("kind", kind.name())? {
        Kind::Cubic => cubic::exists,
        Kind::PhQuintic => ph_quintic::exists,
        _ => any,
    };
    let (_, half_chord) = ends.chord()?;
    if exists(ends) {
        return Ok(Some(*ends));
    }
    let around = Around { ends, unit: length(half_chord), exists };
    let (curvatures, all) = (around_circle(WAYS[0]), around_sphere(WAYS[1]));
    let found = around.first(&curvatures, [FIRST, NEAR]).or_else(|| around.first(&all, [FIRST, FAR]));
    Ok(found.or_else(|| around.first(&curvatures, [NEAR, FAR])))
}

/// Whether any spiral joins two ends, proved; no where that is not known.
fn any(ends: &Ends) -> bool {
    let code =
        ends.chord().and_then(|(chord, _)| verdict(&AnySpiral, 0, &[chord.alpha, chord.beta, chord.k1, chord.k2]));
    code.is_ok_and(|code| AnySpiral.holds(code))
}

/// Unit steps of both curvatures.
fn around_circle(count: usize) -> Vec<Way> {
    let at = |i: usize| (TAU * i as f64 / count as f64).sin_cos();
    (0..count).map(at).map(|(sin, cos)| [cos, sin, 0.0, 0.0]).collect()
}

/// Unit steps of curvatures and directions, some of them of directions alone.
fn around_sphere(count: usize) -> Vec<Way> {
    let circle = around_circle(count);
    let mixed = |share: f64| {
        let (sin, cos) = share.sin_cos();
        let both = move |k: Way, d: Way| [cos * k[0], cos * k[1], sin * d[0], sin * d[1]];
        let circle = &circle;
        circle.iter().flat_map(move |k| circle.iter().map(move |d| both(*k, *d)))
    };
    SHARES.into_iter().flat_map(mixed).collect()
}

/// The neighbourhood of two ends.
struct Around<'e> {
    ends: &'e Ends,
    /// Half the chord.
    unit: f64,
    exists: fn(&Ends) -> bool,
}

impl Around<'_> {
    /// The ends one step away, if a spiral joins them.
    fn try_at(&self, way: &Way, size: f64) -> Option<Ends> {
        let bent = |k: f64, step: f64| rounded(((k * self.unit).asinh() + step * size).sinh() / self.unit);
        let turned = |angle: f64, step: f64| if step == 0.0 { angle } else { rounded(angle + step * size) };
        let there = Ends {
            start_curvature: bent(self.ends.start_curvature, way[0]),
            end_curvature: bent(self.ends.end_curvature, way[1]),
            start_direction: turned(self.ends.start_direction, way[2]),
            end_direction: turned(self.ends.end_direction, way[3]),
            ..*self.ends
        };
        (self.exists)(&there).then_some(there)
    }

    /// The nearest on the first ring, between two radii, that has any.
    fn first(&self, ways: &[Way], [mut size, widest]: [f64; 2]) -> Option<Ends> {
        while size <= widest {
            let hits = ways.iter().filter(|way| self.try_at(way, size).is_some());
            let shorter = hits.map(|way| self.shortened(way, size));
            if let Some((_, ends)) = shorter.min_by(|a, b| a.0.total_cmp(&b.0)) {
                return ends;
            }
            size *= WIDER;
        }
        None
    }

    /// A step that leads to a spiral, shortened as far as halving shows.
    fn shortened(&self, way: &Way, size: f64) -> (f64, Option<Ends>) {
        let (mut bad, mut good) = (size / WIDER, size);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bad + good);
            if self.try_at(way, middle).is_some() { good = middle } else { bad = middle }
        }
        (good, self.try_at(way, good))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transition::fit;
    use crate::transition::fit::ENDS;

    /// A little out of the region, far out, at directions of no spiral, and with a straight end.
    #[test]
    fn what_is_found_has_a_spiral() {
        for kind in crate::transition::FITTED {
            assert_eq!(nearby(&ENDS, kind).unwrap(), Some(ENDS));
            for ends in [
                Ends { end_curvature: 0.012, ..ENDS },
                Ends { end_curvature: -0.5, ..ENDS },
                Ends { start_curvature: 0.0064, ..ENDS },
                Ends { start_curvature: 0.04, end_curvature: 0.004, ..ENDS },
                Ends { start_direction: 1.0, ..ENDS },
                Ends { start_direction: 3.0, end_direction: -2.0, start_curvature: 0.0, ..ENDS },
            ] {
                if fit(&ends, kind, f64::INFINITY).unwrap().curve().is_some() {
                    continue;
                }
                let found = nearby(&ends, kind).unwrap().unwrap_or_else(|| panic!("{kind:?}: none for {ends:?}"));
                let answer = fit(&found, kind, f64::INFINITY).unwrap();
                assert!(answer.curve().is_some(), "{kind:?}: {found:?} {:?}", answer.outcome);
                assert_eq!((found.start, found.end), (ends.start, ends.end));
            }
        }
    }

    /// Where one curvature has to change, no more does, and by no more than it must: the bound of any spiral is known.
    #[test]
    fn it_is_near() {
        let ends = Ends { end_curvature: 0.012, ..ENDS };
        let found = nearby(&ends, Kind::Involute).unwrap().unwrap();
        assert_eq!((found.start_direction, found.end_direction), (ends.start_direction, ends.end_direction));
        let step = |a: f64, b: f64| (100.0 * a).asinh() - (100.0 * b).asinh();
        let both =
            step(found.start_curvature, ends.start_curvature).hypot(step(found.end_curvature, ends.end_curvature));
        // With the start as it is, (sin 0.7 - 0.4) (κ1 - sin 1.4) > sin² 0.35 asks for an end curvature above 0.014673.
        let alone = step(0.014673, ends.end_curvature);
        assert!(both < alone && both > 0.5 * alone, "{both} {alone} {found:?}");
    }

    #[test]
    fn what_cannot_be_asked_is_refused() {
        assert!(nearby(&ENDS, Kind::Line).unwrap_err().to_string().contains("`line`"));
        assert!(nearby(&Ends { end: [0.0, 0.0], ..ENDS }, Kind::Cubic).is_err());
    }
}
