//! What the proofs rest on: intervals of any precision, certified elementary functions, Bernstein sign tests, roots.

mod ball;
pub mod bernstein;
mod form;
mod formula;
mod interval;
mod number;
pub mod roots;
pub mod sines;
mod twin;
pub(crate) mod verdict;
mod ziv;

pub use ball::Ball;
pub use form::{Form, Quadratic};
pub(crate) use formula::{Letter, formula};
pub use interval::Interval;
pub use number::{Lanes, Number, Real};
pub use twin::{TWIN_BITS, Twin};
pub use verdict::Verdict;
pub use ziv::climb;

/// Covers the roundings of an error bound's own computation, in doubles and in singles.
pub(crate) const COVER: f64 = 1.01;

/// `lo (hi / lo)^(i / (count - 1))`, the ends exact; the same doubles on every machine.
pub(crate) fn log_space(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    interval::log_space(lo, hi, count - 1)
}
