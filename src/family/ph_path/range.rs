//! Solutions over ranges of sizes, for searches: doubles whose errors are the ranges.

use super::Kind;
use super::arc::Arc;
use super::curves::{boxed, curves};
use super::datum::Datum;
use crate::num::{Ball, Real};

/// Solutions with end directions (to the chord) whose lengths are at most `longest`, in chords.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    pub theta: [f64; 2],
    pub longest: f64,
}

/// One solution: its greatest |κ|, as doubles see it, its length and its pre-image, for the chord from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found {
    pub most: f64,
    pub length: f64,
    pub preimage: [[f64; 2]; 3],
}

/// All numbers from `low` to `high`.
fn range([low, high]: [f64; 2]) -> Ball {
    Ball { value: 0.5 * (low + high), error: 0.5 * (high - low) + f64::EPSILON * (low.abs() + high.abs()) }
}

impl Search {
    /// The solution at these sizes that bends least.
    pub fn at(&self, size: [f64; 2]) -> Option<Found> {
        let curves = curves::<Ball>(&Datum { kind: Kind::Hermite, theta: self.theta, size }, 53)?;
        if curves.straight {
            let [a, b] = size.map(f64::sqrt);
            let middle = ((120.0 - 15.0 * (a * a + b * b) + 10.0 * a * b).sqrt() - 3.0 * (a + b)) / 4.0;
            return Some(Found { most: 0.0, length: 1.0, preimage: [[a, 0.0], [middle, 0.0], [b, 0.0]] });
        }
        let found = |part: Arc<Ball>, whole: &Arc<Ball>| Found {
            most: part.guess().1,
            length: whole.length().value,
            preimage: whole.w.map(|z| z.map(|x| x.value)),
        };
        let all = curves.bent.iter().map(|c| found(c.part(), &c.whole));
        all.filter(|f| f.length <= self.longest * (1.0 + 1e-12) && f.most.is_finite()).min_by(|a, b| a.most.total_cmp(&b.most))
    }

    /// For all sizes in these ranges: what the greatest |κ| of every solution that is not too long certainly exceeds.
    ///
    /// Each is bounded by the curvature at three parameters, enclosed.
    pub fn least(&self, size: [[f64; 2]; 2]) -> f64 {
        let Some(arcs) = boxed(self.theta, size.map(range)) else { return 0.0 };
        let low = |x: Ball| (x.value - x.error) * (1.0 - 1e-15);
        let bends = |arc: &Arc<Ball>| {
            let at = [0.0, arc.sampled(), 1.0].map(|t| arc.curvature(&Ball::of(t, 53)).map_or(0.0, low));
            at.into_iter().fold(0.0, f64::max)
        };
        let short = |arc: &&Arc<Ball>| low(arc.length()) <= self.longest;
        arcs.iter().filter(short).map(bends).fold(f64::INFINITY, f64::min)
    }
}
