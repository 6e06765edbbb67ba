//! Any spiral at all: whether some curve of monotone curvature joins two ends, and the involute that does (Kurnosenko
//! 2026).
//!
//! # How it is done
//! - Existence is `Q < 0` and the sign of ω = (α+β)/2: `outer.rs` on the data, mirrored where ω < 0, so that curvature
//!   rises. `side` has the exact sign of the sum of two doubles. Signs of curvatures and their order are plain
//!   comparisons.
//! - θ is the root of `F = cos ω P - sin ω X` (`arc.rs`) with `P = sin θ - θ cos θ`, `X = t0 sin θ`: (5) without
//!   arctangent or branches. The bracket follows from ω alone. Doubles guess it (`num/roots.rs`), sums of two doubles
//!   enclose it, or intervals where those leave a rounding open.
//! - `sin x - x cos x`, `x² - sin² x`, `x - sin x` cancel near 0: series there (`differences.rs`).
//! - Scalars are proved in doubles for most nodes (`fast.rs`) because intervals for each node would cost far more.
//! - `involute/` evaluates each half of the curve in a form seen from its own end (`half.rs`), where all that cancels
//!   does so in letters; ends and end curvatures are met to a rounding. Each half has the width of its own peak of
//!   speed as unit, so that nothing leaves the range of doubles. The turns of a direction are a closed form. `track.rs`
//!   tabulates the length once, over the logarithm of the parameter.
//! - No work depends on how near the data are to a limit: `involute/steps.rs` counts precision, evaluations and pieces
//!   there.
//! - `region.rs` proves the flags over boxes.
//! - `involute/turns.rs` is the rule for turns about the ends, which the paper does not have.

mod arc;
mod bound;
mod differences;
mod exact;
mod fast;
mod involute;
mod pair;
mod region;
mod shader;
mod table;

pub use bound::least_end_curvature;
pub use exact::Datum;
pub use involute::{GREATEST, Image, Involute, InvolutePoint, Spiral, Split, WhyNone, involute};

use super::{About, Answer, Chart, Code, Family, Flag, Region, Scalar, Table, coordinates, verdict};
use crate::error::Result;
use crate::grid::Grid;

/// The family of all spirals.
#[derive(Debug, Clone, Copy)]
pub struct AnySpiral;

/// Bit of EXISTS.
pub const EXISTS: u8 = 1;
/// Bit of RISING.
pub const RISING: u8 = 1 << 1;
/// Bit of INFLECTION.
pub const INFLECTION: u8 = 1 << 2;

const FLAGS: &[Flag] = &[
    Flag {
        name: "EXISTS",
        label: "some spiral",
        doc: "some short spiral has these ends: Q < 0, and omega has the sign of k2 - k1, which is not 0; necessary \
              and sufficient",
    },
    Flag {
        name: "RISING",
        label: "rising curvature",
        doc: "k1 < k2: the curvature of a spiral with these ends increases (M = 1)",
    },
    Flag {
        name: "INFLECTION",
        label: "with an inflection",
        doc: "EXISTS, and k1 and k2 have opposite signs: every such spiral has an inflection strictly inside",
    },
];

const SCALARS: &[Scalar] = &[
    Scalar {
        name: "Q",
        doc: "(k1 + sin alpha)(k2 - sin beta) + sin^2((alpha + beta)/2), no unit; at every node; beyond +-1e38 stored \
              as +-1e38",
    },
    Scalar { name: "omega", doc: "(alpha + beta)/2, radians; at every node" },
    Scalar {
        name: "theta",
        doc: "half the range of the involute's parameter on the arc with the same Q and omega, radians, in (0, 4.5); \
              where EXISTS",
    },
    Scalar { name: "t0", doc: "middle of that range, radians, above theta; where EXISTS; beyond 1e38 stored as 1e38" },
];

const CHARTS: &[Chart] = &[
    Chart {
        name: "chord",
        axes: &["alpha", "beta", "k1", "k2"],
        doc: "alpha, beta: directions at start and end against the chord, radians, counter-clockwise, from -pi to pi; \
              k1, k2: signed end curvatures times half the chord",
    },
    Chart {
        name: "curvature",
        axes: &["phi0", "phi1", "kappa0", "kappa1"],
        doc: "the axes of `cubic`: phi0 = -alpha, phi1 = beta, radians, each from -pi to pi; kappa0 = k1, kappa1 = k2",
    },
];

impl Family for AnySpiral {
    fn about(&self) -> &'static About {
        &About {
            name: "any-spiral",
            title: "spirals of any kind between two ends, and the involute that makes one (Kurnosenko)",
            charts: CHARTS,
            conventions: "end points (-1, 0) and (1, 0); directions alpha and beta in radians, counter-clockwise from \
                          the chord; curvature positive to the left, increasing or decreasing along the curve; short \
                          spirals: no point strictly inside the curve lies on the chord's line outside the chord; the \
                          doubles nearest to +-pi lie just inside, so a half turn of falling curvature is written with \
                          the other sign than one of rising curvature",
            flags: FLAGS,
            yes: &["EXISTS"],
            nested: &["EXISTS", "INFLECTION"],
            counts: &[],
            scalars: SCALARS,
            control_points: 0,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::AnyTable::new(grid)?))
    }
    fn region(&self) -> &dyn Region {
        self
    }
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        let code = verdict(self, chart, point)?;
        let [first, beta, k1, k2] = *coordinates(point)?;
        let found = involute(&Datum { alpha: if chart == 0 { first } else { -first }, beta, k1, k2 }, [0, 0])?;
        let other = CHARTS[1 - chart].axes.iter().zip([-first, beta, k1, k2]);
        // A double nearest to ±π lies just inside here, as in every table, and is no half turn as it is to `involute`.
        let exists = code.flags() & EXISTS != 0;
        let omega = 0.5 * (found.chord.alpha + found.chord.beta) + 0.0;
        let invariants = [("Q", found.q), ("omega", omega)];
        let solution = |curve: &Involute| {
            let [rho, lambda] = curve.map();
            let values = [
                ("theta", curve.theta()),
                ("t0", curve.t0()),
                ("rho", rho),
                ("lambda", lambda),
                ("length", curve.length()),
            ];
            values.map(|(name, x)| (name, x.into())).to_vec()
        };
        Ok(Answer {
            code,
            derived: other.map(|(name, x)| (*name, x)).chain(invariants).map(|(name, x)| (name, x.into())).collect(),
            solutions: found.curve().filter(|_| exists).map(solution).into_iter().collect(),
            chosen: found.curve().filter(|_| exists).map(|_| 0),
        })
    }
}
