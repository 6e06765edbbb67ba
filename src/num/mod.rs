//! What the proofs rest on: intervals of any precision, certified elementary functions, Bernstein sign tests, roots.

mod ball;
pub(crate) mod bernstein;
pub(crate) mod bernstein_lanes;
mod form;
mod form_lanes;
mod formula;
mod ieee;
mod interval;
mod number;
pub(crate) mod roots;
pub(crate) mod sines;
mod twin;
mod verdict;
mod ziv;

pub(crate) use ball::Ball;
pub(crate) use form::{Form, Quadratic};
pub(crate) use form_lanes::{FormLanes, halve_forms};
pub(crate) use formula::{Letter, formula};
pub(crate) use ieee::demand_ieee;
pub(crate) use interval::Interval;
pub(crate) use number::{Angle, Certain, Lanes, Number, Real};
pub(crate) use twin::{TWIN_BITS, Twin};
pub use verdict::Verdict;
pub(crate) use ziv::climb;

/// Covers the roundings of an error bound's own computation, in doubles and in singles.
pub(crate) const COVER: f64 = 1.01;

/// `lo (hi / lo)^(i / (count - 1))`, the ends exact; the same doubles on every machine.
pub(crate) fn log_space(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    interval::log_space(lo, hi, count - 1)
}
