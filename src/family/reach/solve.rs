//! The exact answer for one end point: the segments of both cases and how far each is proved.

use super::angle::{Angle, ExactAngle, check};
use super::exact::{Rooted, SegmentShape, judge, judge_shape};
use super::filter::{Near, shape, sides};
use super::{CASE_BITS, EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::error::{Error, Result, finite, positive};
use crate::family::{Code, NO_VALUE};
use crate::num::{Interval, Real, Twin, climb, demand_ieee};
use fearless_simd::{Level as SimdLevel, Simd, SimdBase, dispatch};
use std::cell::RefCell;
use std::collections::VecDeque;

/// So many levels of shapes are remembered.
const KEPT: usize = 64;

/// An end point in units of the given radius r; the start is (0, 0) along (1, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Angle from the start to the end tangent, radians: in (0, π/2) for cubics, in (0, π) for PH quintics.
    pub theta: f64,
    /// End point over r, along the start tangent.
    pub xi: f64,
    /// End point over r, to the left of it.
    pub eta: f64,
}

impl From<[f64; 3]> for Datum {
    fn from([theta, xi, eta]: [f64; 3]) -> Datum {
        Datum { theta, xi, eta }
    }
}

/// How much is true of a segment; each level contains the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Its curvature is not monotone.
    Exists,
    /// It is a spiral.
    Exact,
    /// All four terms of Theorem 2.1 or 3.1 accept it.
    Theorem,
    /// It lies in the region drawn in the paper: `m >= m*`, `q >= A1`.
    Paper,
}

impl Level {
    /// Its name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Level::Exists => "exists",
            Level::Exact => "exact",
            Level::Theorem => "theorem",
            Level::Paper => "paper",
        }
    }
}

/// The shape of a segment and its level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Ratio of the paper's u0 and u1, above 0.
    pub m: f64,
    /// Square of the paper's tangent parameter over r, above 0 (the cubic's end tangent is d = qr long).
    pub q: f64,
    /// What is proved of it.
    pub level: Level,
}

/// The segments that reach an end point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// The segment of case 1 (increasing curvature, 0 to 1/r).
    pub case1: Option<Segment>,
    /// The segment of case 2 (decreasing curvature, 1/r to 0).
    pub case2: Option<Segment>,
}

/// Finds the segments of both cases with an end point.
///
/// # Accuracy
/// Which exist, and their levels, are proved; m and q are correctly rounded.
///
/// # Errors
/// [`Error::Domain`] for an angle outside the family's range or a coordinate that is not finite, or a shape beyond the
/// range of doubles; [`Error::Undecided`] at the precision cap.
///
/// # Source
/// Habib & Sakai (CGIV 2004), (7) and (20); the exact test replaces the sufficient one.
pub fn solve(kind: Kind, datum: &Datum) -> Result<Reached> {
    demand_ieee()?;
    let Datum { theta, xi, eta } = *datum;
    check(kind, theta)?;
    finite("xi", xi)?;
    finite("eta", eta)?;
    let twins = ExactAngle::twins(kind, theta);
    let case = |case| {
        let found = match twins.as_ref().and_then(|angle| segment(kind, angle, [xi, eta], case, Twin::to_f64)) {
            Some(found) => found,
            None => {
                let attempt = |bits| {
                    let angle = ExactAngle::cached(kind, theta, bits)?;
                    segment(kind, &*angle, [xi, eta], case, Interval::to_f64)
                };
                climb(datum, "a segment", attempt)?.0
            }
        };
        match found {
            Some(s) if !(s.m.is_finite() && s.q.is_finite()) => {
                let what = if s.m.is_finite() { "q" } else { "m" };
                Err(Error::extreme(what, [("theta", theta), ("xi", xi), ("eta", eta)]))
            }
            other => Ok(other),
        }
    };
    Ok(Reached { case1: case(0)?, case2: case(1)? })
}

/// The segment of a case (0 or 1), if there is one, its numbers rounded to nearest; `None` when something is undecided.
fn segment<N: Rooted>(
    kind: Kind,
    angle: &ExactAngle<N>,
    end: [f64; 2],
    case: usize,
    rounded: fn(&N) -> Option<f64>,
) -> Option<Option<Segment>> {
    let (flags, shape) = judge(kind, angle, end, case)?;
    let Some(shape) = shape else { return Some(None) };
    Some(Some(Segment { m: rounded(&shape.m)?, q: rounded(&shape.q(angle)?)?, level: level(flags) }))
}

/// What is true of the segment with an angle and a shape, proved for these doubles.
///
/// # Errors
/// [`Error::Domain`] for an angle outside the family's range or a shape that is not finite and positive;
/// [`Error::Undecided`] at the precision cap.
pub fn level_of_shape(kind: Kind, theta: f64, m: f64, q: f64) -> Result<Level> {
    demand_ieee()?;
    check(kind, theta)?;
    positive("m", m)?;
    positive("q", q)?;
    let key = (kind, [theta, m, q].map(f64::to_bits));
    // Joins are made of a few shapes, again and again.
    type Known = VecDeque<((Kind, [u64; 3]), Level)>;
    thread_local!(static KNOWN: RefCell<Known> = const { RefCell::new(VecDeque::new()) });
    if let Some(level) = KNOWN.with_borrow(|known| known.iter().find(|(k, _)| *k == key).map(|(_, level)| *level)) {
        return Ok(level);
    }
    let flags = match ExactAngle::twins(kind, theta).and_then(|angle| judge_of_shape(kind, &angle, [m, q])) {
        Some(flags) => flags,
        None => {
            let attempt = |bits| judge_of_shape(kind, &*ExactAngle::cached(kind, theta, bits)?, [m, q]);
            climb(&format_args!("theta = {theta:?}, m = {m:?}, q = {q:?}"), "a segment's level", attempt)?.0
        }
    };
    let level = level(flags);
    KNOWN.with_borrow_mut(|known| {
        known.truncate(KEPT - 1);
        known.push_front((key, level));
    });
    Ok(level)
}

/// The bits of a shape; `None` when something is undecided.
fn judge_of_shape<N: Real>(kind: Kind, angle: &ExactAngle<N>, [m, q]: [f64; 2]) -> Option<u8> {
    let bits = angle.sin.bits();
    let u = angle.length.over(&N::of(q, bits))?;
    judge_shape(kind, angle, &SegmentShape { u, m: N::of(m, bits) })
}

fn level(flags: u8) -> Level {
    [(PAPER, Level::Paper), (THEOREM, Level::Theorem), (EXACT, Level::Exact)]
        .into_iter()
        .find(|(flag, _)| flags & flag != 0)
        .map_or(Level::Exists, |(_, level)| level)
}

/// The scalars m1, q1, m2, q2 (0 to 3), each rounded to nearest f32 with proof; what
/// is beyond the largest f32 becomes the largest f32.
pub(super) fn scalars(kind: Kind, datum: [f64; 3], code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
    let any = which.iter().any(|i| exists(code, i / 2));
    from_intervals(kind, datum, code, which, out, if any { fast(kind, datum) } else { [None; 4] })
}

/// [`scalars`] by intervals alone.
pub(super) fn exact_scalars(kind: Kind, datum: [f64; 3], code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
    from_intervals(kind, datum, code, which, out, [None; 4])
}

fn exists(code: Code, case: usize) -> bool {
    code.flags() >> (CASE_BITS * case as u32) & EXISTS != 0
}

/// The scalars that are not `known`, by intervals.
fn from_intervals(
    kind: Kind,
    datum: [f64; 3],
    code: Code,
    which: &[usize],
    out: &mut [f32],
    known: [Option<f32>; 4],
) -> Result<()> {
    for (slot, i) in out.iter_mut().zip(which) {
        let (case, of_q) = (i / 2, i % 2 == 1);
        *slot = match known[*i] {
            _ if !exists(code, case) => NO_VALUE,
            Some(value) => value,
            None => {
                let attempt = |bits| {
                    let angle = ExactAngle::cached(kind, datum[0], bits)?;
                    let shape = judge(kind, &*angle, [datum[1], datum[2]], case)?.1?;
                    let value = if of_q { shape.q(&angle)? } else { shape.m };
                    single(&value)
                };
                climb(&Datum::from(datum), "a scalar", attempt)?.0
            }
        };
    }
    Ok(())
}

fn single(value: &Interval) -> Option<f32> {
    value.to_f32().map(|x| x.min(f32::MAX))
}

/// The scalars that doubles prove.
fn fast(kind: Kind, [theta, xi, eta]: [f64; 3]) -> [Option<f32>; 4] {
    static LEVEL: std::sync::LazyLock<SimdLevel> = std::sync::LazyLock::new(SimdLevel::new);
    let Some(angle) = Angle::new(kind, theta) else { return [None; 4] };
    dispatch!(*LEVEL, simd => lane(simd, kind, &angle, xi, eta))
}

#[inline(always)]
fn lane<S: Simd>(simd: S, kind: Kind, angle: &Angle, xi: f64, eta: f64) -> [Option<f32>; 4] {
    let mut values = [None; 4];
    for (case, (a, b, none)) in sides(simd, angle, xi, S::f64s::splat(simd, eta)).into_iter().enumerate() {
        let shape = shape(simd, kind, angle, &a, &b, none);
        if shape.is_found(0) {
            let at = |v: &S::f64s| v.as_slice()[0];
            let Near { value: u, error: rho } = shape.u;
            let q = angle.length / at(&u);
            // The length is good to 21 units, the quotient to one.
            let q_error = q * (1.1 * at(&rho) + 24.0 * f64::EPSILON);
            values[2 * case] = rounded(at(&shape.m.value), at(&shape.m.error));
            values[2 * case + 1] = rounded(q, q_error);
        }
    }
    values
}

/// The nearest f32 of a number within `error` of `value`, when that is certain.
fn rounded(value: f64, error: f64) -> Option<f32> {
    // One more unit for the rounding of the ends themselves.
    let error = error + value.abs() * f64::EPSILON;
    let (low, high) = ((value - error) as f32, (value + error) as f32);
    (low == high).then(|| low.min(f32::MAX))
}
