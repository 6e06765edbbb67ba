//! Path planning with Pythagorean-hodograph quintics: Hermite interpolation, paths of equal length, splines, separation,
//! corner rounding among obstacles.
//!
//! Everything is one curve type, [`PhQuintic`], in the user's plane and unit of length; angles are radians.
//!
//! Source: Farouki et al., Pythagorean-hodograph curves for path planning of unmanned vehicles.

mod corner;
mod equal;
mod hermite;
mod least_curvature;
mod plan;
mod queue;
mod separation;
mod spline;
mod tridiagonal;

pub use corner::Turn;
pub use equal::{EqualLength, equal_length};
pub use hermite::{Hermite, hermite};
pub use least_curvature::{Directions, Free, LeastCurvature, least_curvature};
pub use plan::{Clearance, Corner, Plan, Proof, Scene, plan, prove};
pub use separation::{Closest, Motion, Separation, Verdict, separation, separations};
pub use spline::{Spline, spline};

use crate::curve::PhQuintic;
use crate::error::{Error, Result};
use num_complex::Complex64;
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
    /// Index of the one with least absolute rotation among those that stand still nowhere; of mirror images that tie, the first.
    pub best: usize,
}

impl Choice {
    fn of(what: &str, curves: impl IntoIterator<Item = PhQuintic>) -> Result<Choice> {
        let candidate = |curve: PhQuintic| {
            let candidate = Candidate { absolute_rotation: curve.absolute_rotation(), regular: curve.is_regular(), curve };
            if curve.is_finite() && candidate.absolute_rotation.is_finite() {
                return Ok(candidate);
            }
            Err(Error::Domain(format!("{what}: a solution leaves the range of doubles (change the unit of length)")))
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

/// The regular one of least absolute rotation; without a regular one, of all. Rotations that differ by rounding alone tie.
fn best(candidates: &[Candidate], range: std::ops::Range<usize>) -> usize {
    let key = |i: usize| (!candidates[i].regular, candidates[i].absolute_rotation);
    let less = |a: (bool, f64), b: (bool, f64)| (a.0, a.1 * (1.0 + 1e-12)) < b;
    let first = range.start;
    range.fold(first, |best, i| if less(key(i), key(best)) { i } else { best })
}

/// Covers the roundings of a point, of a length, of a distance or of a tangent: none is the end of a chain of more than 60.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// How far the end of a span is from where its pre-image leads.
fn mismatch(span: &PhQuintic) -> f64 {
    let end = PhQuintic::new(span.start, span.preimage).end;
    distance(end, span.end)
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

fn complex([re, im]: [f64; 2]) -> Complex64 {
    Complex64::new(re, im)
}

fn pair(z: Complex64) -> [f64; 2] {
    [z.re, z.im]
}

/// Refuses numbers that are not finite, by name.
fn finite(what: &str, name: &str, numbers: &[f64]) -> Result<()> {
    match numbers.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(Error::Domain(format!("{what}: `{name}` is {numbers:?}; all numbers must be finite"))),
    }
}

/// Refuses spans that are not finite, or that do not join exactly.
fn check_joined(what: &str, spans: &[PhQuintic]) -> Result<()> {
    let fail = |told: String| Err(Error::Domain(format!("{what}: {told}")));
    if let Some(i) = spans.iter().position(|span| !span.is_finite()) {
        return fail(format!("span {i} of the path is not finite: {:?}", spans[i]));
    }
    match spans.windows(2).position(|w| w[0].end != w[1].start) {
        Some(i) => fail(format!("span {i} ends at {:?}, the next one starts at {:?}", spans[i].end, spans[i + 1].start)),
        None => Ok(()),
    }
}
