//! Spirals among the quintic trigonometric Bézier curves of Misro, Ramli and Ali, from a straight line to a circle.
//!
//! # How it is done
//! - With τ = tan(πt/4) the curve is rational and κ' has the sign of a polynomial of degree 38 in τ whose coefficients
//!   are sums of products of the hodograph's (positive) ones (`poly.rs`); θ enters through cos θ alone. Its sign on [0,
//!   1] is decided by Bernstein halving, as everywhere.
//! - The ratio s / tan(θ/2) is an axis, not a parameter: a fifth one. Shaders keep four digits; the two slowest axes
//!   are one digit to them (`gpu/slot.rs`).
//! - `threshold.rs` proves the least ratio from which all up to 64 give spirals; that a spiral stays one for larger
//!   ratios is false in general.

mod curve;
mod exact;
mod filter;
mod frame;
mod guess;
mod plain;
mod poly;
mod region;
mod shader;
mod table;
mod threshold;

pub use curve::Scaling;
pub use exact::Shape;

use super::{About, Answer, Chart, Family, Flag, NO_VALUE, Region, Scalar, Table, coordinates, verdict};
use crate::error::Result;
use crate::grid::Grid;
use crate::num::{Angle, Interval, TWIN_BITS, Twin, climb, demand_ieee};

/// The family of quintic trigonometric curves with the control points (3), (9).
#[derive(Debug, Clone, Copy)]
pub struct TrigQuintic;

/// Bit of END_RISES.
pub const END_RISES: u8 = 1;
/// Bit of SPIRAL.
pub const SPIRAL: u8 = 1 << 1;
/// Bit of PRINTED_RATIO.
pub const PRINTED_RATIO: u8 = 1 << 2;
/// Bit of END_CURVATURE_AS_PRINTED.
pub const END_CURVATURE_AS_PRINTED: u8 = 1 << 3;

const FLAGS: &[Flag] = &[
    Flag {
        name: "END_RISES",
        label: "curvature does not fall at the end",
        doc: "kappa'(1) >= 0, that is 9 ratio >= 20 (1 + q); necessary for a spiral, and by no means sufficient",
    },
    Flag {
        name: "SPIRAL",
        label: "spiral",
        doc: "the curvature is monotone on the whole curve: necessary and sufficient",
    },
    Flag {
        name: "PRINTED_RATIO",
        label: "condition as printed",
        doc: "ratio >= (6 + m)/2, for m = 1 the 7/2 that the paper takes: a condition for polynomial curves, which \
              says nothing here",
    },
    Flag {
        name: "END_CURVATURE_AS_PRINTED",
        label: "end curvature as printed",
        doc: "with (9) as printed the curvature at the end, 15/((4 + q)^2 r), is within a hundredth of the 1/r it \
              should be",
    },
];

const SCALARS: &[Scalar] = &[Scalar {
    name: "threshold",
    doc: "the least ratio from 1/64 on from which all ratios up to 64 give spirals, for this theta, m, p, q (whatever \
          the node's own ratio); none where 64 gives no spiral; no unit",
}];

const CHARTS: &[Chart] = &[Chart {
    name: "shape",
    axes: &["ratio", "theta", "m", "p", "q"],
    doc: "ratio: s / tan(theta/2) of (9), above 0; theta: angle from the start to the end tangent, radians, in (0, \
          pi/2); m: u0/u1, above 0; p, q: shape parameters at start and end, in (-4, 1]",
}];

/// The proved flags of one shape: END_RISES, SPIRAL and so on.
///
/// # Errors
/// [`crate::Error::Domain`] for a value outside the family's domain; [`crate::Error::Undecided`] at the precision cap.
pub fn flags(shape: &Shape) -> Result<u8> {
    let Shape { ratio, theta, m, p, q } = *shape;
    verdict(&TrigQuintic, 0, &[ratio, theta, m, p, q]).map(|code| code.flags())
}

/// The scalar `threshold` at one shape, whatever its own ratio: rounded to nearest with proof, none where the ratio 64
/// gives no spiral.
///
/// # Errors
/// As [`flags`].
pub fn least_ratio(shape: &Shape) -> Result<Option<f32>> {
    demand_ieee()?;
    let Shape { ratio, theta, m, p, q } = *shape;
    [ratio, theta, m, p, q].into_iter().enumerate().try_for_each(|(which, value)| frame::check(which, value))?;
    let value = threshold::least_ratio(shape)?;
    Ok((value != NO_VALUE).then_some(value))
}

impl Family for TrigQuintic {
    fn about(&self) -> &'static About {
        &About {
            name: "trig-quintic",
            title: "quintic trigonometric Bezier spirals from a line to a circle (Misro, Ramli & Ali)",
            charts: CHARTS,
            conventions: "start point (0, 0), start direction (1, 0), curvature 0 at the start and positive to the \
                          left; end direction (cos theta, sin theta); basis (2), control points (3) with (9); angles \
                          in radians; the radius scales out of every field: a curve has the end curvature 1/r when (9) \
                          is taken with 15 r / (4 + q)^2 in place of r",
            flags: FLAGS,
            yes: &["SPIRAL"],
            nested: &["END_RISES", "SPIRAL"],
            counts: &[],
            scalars: SCALARS,
            control_points: 6,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::TrigTable::new(grid)?))
    }
    fn region(&self) -> &dyn Region {
        self
    }
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        let code = verdict(self, chart, point)?;
        let shape = Shape::from(*coordinates(point)?);
        let mut derived = vec![
            ("s", nearest(&shape, s::<Twin>, s::<Interval>)?.into()),
            ("scale", nearest(&shape, scale::<Twin>, scale::<Interval>)?.into()),
        ];
        if let Some(threshold) = least_ratio(&shape)? {
            derived.push(("threshold", f64::from(threshold).into()));
        }
        let curve = shape.curve(1.0, Scaling::Corrected);
        let spiral = code.flags() & SPIRAL != 0;
        Ok(Answer {
            code,
            derived,
            solutions: vec![vec![
                ("spiral", spiral.into()),
                ("length", curve.length_between(0.0, 1.0).into()),
                ("control_points", curve.points().into()),
            ]],
            chosen: spiral.then_some(0),
        })
    }
}

/// s of (9): `ratio tan(θ/2)`, where halving is exact but for the least subnormal numbers.
fn s<N: Angle>(shape: &Shape, bits: usize) -> Option<N> {
    let (sin, cos) = N::of(shape.theta, bits).times(0.5).sine_cosine();
    sin.times(shape.ratio).over(&cos)
}

/// `15/(4 + q)²`.
fn scale<N: Angle>(shape: &Shape, bits: usize) -> Option<N> {
    let side = N::of(shape.q, bits).plus(4.0);
    N::of(15.0, bits).over(&side.mul(&side))
}

/// The double nearest to a number of a shape: by two doubles, or else by intervals.
fn nearest(
    shape: &Shape,
    twin: impl Fn(&Shape, usize) -> Option<Twin>,
    interval: impl Fn(&Shape, usize) -> Option<Interval>,
) -> Result<f64> {
    match twin(shape, TWIN_BITS).and_then(|x| x.to_f64()) {
        Some(x) => Ok(x),
        None => Ok(climb(shape, "a number of the shape", |bits| interval(shape, bits)?.to_f64())?.0),
    }
}

#[cfg(test)]
mod tests;
