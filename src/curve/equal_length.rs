//! Paths of a given arc length between given points and directions: Farouki et al., (10)-(13).

use super::PhQuintic;
use super::choice::{Choice, best};
use super::vector::{complex, finite_ends, pair};
use crate::error::{Error, Result, written};
use num_complex::Complex64;

/// End points, directions of travel and arc length.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EqualLength {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends, elsewhere.
    pub end: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    pub start_direction: f64,
    /// Direction of travel at the end.
    pub end_direction: f64,
    /// Arc length, above the distance of the ends.
    pub length: f64,
}

/// The four PH quintics with these ends and this length whose end speeds are equal.
///
/// The first two are the paper's, with half the angles to the chord from (-π/2, π/2]; the other two have `w2` with the
/// other sign, and turn less for some ends. [`Choice::best`] is the best of all four, [`EqualLength::paper`] that of
/// the paper's two.
///
/// # Accuracy
/// End points exact; length and end directions to a few roundings of the length. No difference cancels as `θ1` comes
/// near `±θ0` or the length near the chord: with `p = P0 - P1 z`, `q = Q0 - Q1 z` of (12), (13) the discriminant of
/// `pq = 25g²z²` is the sum `(P0 Q1 - Q0 P1)² + 100 g² P0 Q0`, one of p and q is a sum as well, and the other follows
/// from `√p √q = 5 g z`, which has the right sign.
///
/// # Errors
/// [`Error::Domain`] naming a number that is not finite, ends that coincide, a length not above their distance, or
/// results beyond doubles.
///
/// ```
/// use spiral_atlas::curve::{EqualLength, equal_length};
/// let (start, end) = ([0.0, 0.0], [1.0, 0.0]);
/// let ends = EqualLength { start, end, start_direction: 1.0, end_direction: -2.0, length: 1.4 };
/// let choice = equal_length(&ends)?;
/// assert!((choice.best().length() - 1.4).abs() < 1e-14);
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn equal_length(ends: &EqualLength) -> Result<Choice> {
    let EqualLength { start, end, start_direction, end_direction, length } = *ends;
    finite_ends("equal length", [start, end], [start_direction, end_direction], ("length", length))?;
    let chord = complex(end) - complex(start);
    let distance = chord.norm();
    if distance == 0.0 {
        let what = format!("equal length: `start` and `end` are both {start:?}; the ends must be apart");
        return Err(Error::invalid(what));
    }
    if length <= distance {
        let limit = format!("above the distance {} of the ends", written(distance));
        return Err(Error::domain("equal length: `length`", length, limit));
    }
    let half = |direction: f64| 0.5 * (Complex64::cis(direction) * chord.conj()).arg();
    let (first, last) = (Complex64::cis(half(start_direction)), Complex64::cis(half(end_direction)));
    // Lengths in units of the distance; `length - distance` first, which cancels nothing that was rounded here.
    let sum = [60.0 * (length / distance + 1.0), 60.0 * ((length - distance) / distance)];
    let back = chord.sqrt();
    let curves = [1.0, -1.0].map(|sign| canonical(first, last * sign, sum));
    let placed = curves.into_iter().flatten().map(|w| PhQuintic::between(start, end, w.map(|w| pair(w * back))));
    Choice::of("equal length", placed)
}

impl EqualLength {
    /// Index of the better of the paper's two solutions.
    pub fn paper(choice: &Choice) -> usize {
        best(&choice.candidates, 0..2)
    }
}

/// Both solutions from 0 to 1 for half angles as unit vectors and `(P0, Q0) = 60 (S ± 1)`.
fn canonical(first: Complex64, last: Complex64, [p0, q0]: [f64; 2]) -> [[Complex64; 3]; 2] {
    let ((c0, s0), (c1, s1)) = ((first.re, first.im), (last.re, last.im));
    // 15a² + 15b² - 10ab.
    let form = |a: f64, b: f64| 5.0 * (a - b) * (a - b) + 10.0 * (a * a + b * b);
    let g = 5.0 * (c0 * s1 + c1 * s0 - 3.0 * c0 * s0 - 3.0 * c1 * s1);
    let (a, b) = (p0 * form(s0, s1), q0 * form(c0, c1));
    let root = (a - b).hypot(2.0 * g * (p0 * q0).sqrt());
    let z = 2.0 * p0 * q0 / (a + b + root);
    // The roots of p and q, the safe one first.
    let safe = |whole: f64, more: f64| (whole * (more + root) / (a + b + root)).sqrt();
    let other = |safe: f64| if safe == 0.0 { 0.0 } else { g * z / safe };
    let roots = if a >= b {
        let p = safe(p0, a - b);
        [p, other(p)]
    } else {
        let q = safe(q0, b - a);
        [other(q), q]
    };
    let size = z.sqrt();
    let (w0, w2) = (first * size, last * size);
    [1.0, -1.0].map(|sign| [w0, (Complex64::new(roots[0], roots[1]) * sign - 3.0 * (w0 + w2)) / 4.0, w2])
}
