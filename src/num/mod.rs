//! What the proofs rest on: intervals of any precision, certified elementary functions, Bernstein sign tests, roots.

mod ball;
pub mod bernstein;
mod climb;
mod interval;
mod number;
mod quadratic;
pub mod root;
pub mod trig;

pub use ball::Ball;
pub use climb::climb;
pub use interval::Interval;
pub use number::{Lanes, Number, Real};
pub use quadratic::Quadratic;

/// `lo (hi / lo)^(i / (count - 1))`, the ends exact; the same doubles on every machine.
pub(crate) fn log_space(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    interval::log_space(lo, hi, count - 1)
}
