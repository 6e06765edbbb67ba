//! Reachable end points of a spiral segment with given angle and end radius (Habib & Sakai, CGIV 2004): cubic and PH
//! quintic.
//!
//! # How it is done
//! - One module for both; `Kind` chooses the polynomials (`poly.rs`). With u = L/q, L = sin θ or tan(θ/2), nothing of
//!   the angle is left in the quintic but g = cos θ or cos²(θ/2), so a small angle is no special case.
//! - Case 2 is the mirror of case 1 with (a, b) exchanged: one code for both, four bits each.
//! - The cubic's inverse is explicit. That of the PH quintic is one root of a function that is monotone where m > -0.37
//!   (proof in `poly.rs`), so one certified bracket both finds and counts it.
//! - The four terms of the theorems are `c0..c3 >= 0`; the exact test is the sign of the same quintic, as in `cubic`.
//! - `region.rs` proves the flags over boxes.
//! - Cases 3 and 4 are unions over angles: a kind of picture (`union`), not flags, because a flag must be a fact about
//!   its node.

mod angle;
mod curve;
mod exact;
mod filter;
mod poly;
mod region;
mod shader;
mod solve;
mod table;

pub(crate) use curve::{legs, preimage};
pub use solve::{Datum, Level, Reached, Segment, level_of_shape, solve};

use super::{About, Answer, Chart, Family, Flag, Region, Scalar, Table, Value, coordinates, verdict};
use crate::error::Result;
use crate::grid::Grid;

/// Which curve the added segment is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A cubic Bézier curve.
    Cubic,
    /// A Pythagorean hodograph quintic.
    Ph,
}

impl Kind {
    /// The family's name.
    pub const fn name(self) -> &'static str {
        match self {
            Kind::Cubic => "reach-cubic",
            Kind::Ph => "reach-ph",
        }
    }
}

/// The families of reachable end points.
#[derive(Debug, Clone, Copy)]
pub struct Reach(pub Kind);

/// Bit of CASE1_EXISTS; case 2 is [`CASE_BITS`] bits higher.
pub const EXISTS: u8 = 1;
/// Bit of CASE1_EXACT.
pub const EXACT: u8 = 1 << 1;
/// Bit of CASE1_THEOREM.
pub const THEOREM: u8 = 1 << 2;
/// Bit of CASE1_PAPER.
pub const PAPER: u8 = 1 << 3;
/// Bits of a case.
pub const CASE_BITS: u32 = 4;

const FLAGS: &[Flag] = &[
    Flag {
        name: "CASE1_EXISTS",
        label: "case 1: some segment",
        doc: "case 1 (from an inflection to radius r): some m, q > 0 put the end point there",
    },
    Flag {
        name: "CASE1_EXACT",
        label: "case 1: exact spiral",
        doc: "case 1: and the segment's curvature is monotone: necessary and sufficient",
    },
    Flag {
        name: "CASE1_THEOREM",
        label: "case 1: the whole theorem",
        doc: "case 1: and all four terms of Theorem 2.1 (cubic) or 3.1 (PH) accept it",
    },
    Flag {
        name: "CASE1_PAPER",
        label: "case 1: drawn in the paper",
        doc: "case 1: and m >= m*, q >= A1: the region of the paper's figures",
    },
    Flag {
        name: "CASE2_EXISTS",
        label: "case 2: some segment",
        doc: "case 2 (from radius r to an inflection): some m, q > 0 put the end point there",
    },
    Flag {
        name: "CASE2_EXACT",
        label: "case 2: exact spiral",
        doc: "case 2: and the segment's curvature is monotone: necessary and sufficient",
    },
    Flag {
        name: "CASE2_THEOREM",
        label: "case 2: the whole theorem",
        doc: "case 2: and all four terms of Theorem 2.1 (cubic) or 3.1 (PH) accept it",
    },
    Flag {
        name: "CASE2_PAPER",
        label: "case 2: drawn in the paper",
        doc: "case 2: and m >= m*, q >= A1: the region of the paper's figures",
    },
];

const SCALARS: &[Scalar] = &[
    Scalar {
        name: "m1",
        doc: "shape m of the segment of case 1, above 0, no unit; the largest single where m is larger",
    },
    Scalar {
        name: "q1",
        doc: "shape q of the segment of case 1, above 0, no unit; the largest single where q is larger",
    },
    Scalar {
        name: "m2",
        doc: "shape m of the segment of case 2, above 0, no unit; the largest single where m is larger",
    },
    Scalar {
        name: "q2",
        doc: "shape q of the segment of case 2, above 0, no unit; the largest single where q is larger",
    },
];

const CUBIC_CHARTS: &[Chart] = &[Chart {
    name: "end-point",
    axes: &["theta", "xi", "eta"],
    doc: "theta: angle from the start to the end tangent, radians, in (0, pi/2); (xi, eta): end point over r, start at \
          (0, 0) along (1, 0)",
}];

const PH_CHARTS: &[Chart] = &[Chart {
    name: "end-point",
    axes: &["theta", "xi", "eta"],
    doc: "theta: angle from the start to the end tangent, radians, in (0, pi); (xi, eta): end point over r, start at \
          (0, 0) along (1, 0)",
}];

const CUBIC: About = About {
    name: Kind::Cubic.name(),
    title: "end points that a cubic spiral segment reaches (Habib & Sakai)",
    charts: CUBIC_CHARTS,
    conventions: "start point (0, 0), start direction (1, 0), end direction (cos theta, sin theta), curvature positive \
                  to the left; case 1: curvature 0 at the start and 1/r at the end, increasing; case 2: 1/r at the \
                  start and 0 at the end, decreasing; lengths in units of r, angles in radians",
    flags: FLAGS,
    yes: &["CASE1_EXACT", "CASE2_EXACT"],
    nested: &["CASE1_EXISTS", "CASE1_EXACT", "CASE1_THEOREM", "CASE1_PAPER"],
    counts: &[],
    scalars: SCALARS,
    control_points: 0,
};

const PH: About = About {
    name: Kind::Ph.name(),
    title: "end points that a PH quintic spiral segment reaches (Habib & Sakai)",
    charts: PH_CHARTS,
    ..CUBIC
};

impl Family for Reach {
    fn about(&self) -> &'static About {
        match self.0 {
            Kind::Cubic => &CUBIC,
            Kind::Ph => &PH,
        }
    }
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>> {
        Ok(Box::new(table::ReachTable::new(self.0, grid)?))
    }
    fn region(&self) -> &dyn Region {
        self
    }
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        let code = verdict(self, chart, point)?;
        let datum = Datum::from(*coordinates(point)?);
        let reached = solve(self.0, &datum)?;
        let solution = |(case, segment): (u8, Segment)| {
            let length = curve::length(self.0, case, datum.theta, segment.m, segment.q);
            let values = vec![
                ("case", Value::Whole(case.into())),
                ("m", segment.m.into()),
                ("q", segment.q.into()),
                ("spiral", (segment.level >= Level::Exact).into()),
                ("level", Value::Word(segment.level.name())),
            ];
            // The verdict stands where the length leaves the range of doubles.
            values.into_iter().chain(length.is_finite().then(|| ("length", length.into()))).collect()
        };
        let cases = [(1, reached.case1), (2, reached.case2)];
        let found = cases.into_iter().filter_map(|(case, segment)| Some((case, segment?)));
        Ok(Answer { code, derived: vec![], solutions: found.map(solution).collect(), chosen: None })
    }
}
