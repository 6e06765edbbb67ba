//! The families on a grid.

use super::Kind;
use super::angle::{Angle, ExactAngle, check};
use super::exact::judge;
use super::filter::classify;
use super::solve::Datum;
use super::{CASE_BITS, Reach};
use crate::error::Result;
use crate::family::rows::{Rows, fill};
use crate::family::{Code, Kernel, Shader, ShaderInputs, Table, chart_of};
use crate::grid::{Grid, MAX_AXES};
use crate::num::climb;
use fearless_simd::{Level, Simd, dispatch};

/// Reachable end points on one grid.
pub(super) struct ReachTable<'g> {
    kind: Kind,
    grid: &'g Grid,
    level: Level,
}

impl<'g> ReachTable<'g> {
    pub(super) fn new(kind: Kind, grid: &'g Grid) -> Result<ReachTable<'g>> {
        chart_of(&Reach(kind), grid)?;
        let theta = grid.axes()[0].values();
        check(kind, theta[0])?;
        check(kind, theta[theta.len() - 1])?;
        Ok(ReachTable { kind, grid, level: Level::new() })
    }

    fn datum(&self, node: u64) -> [f64; 3] {
        let [theta, xi, eta, ..] = self.grid.node(node);
        [theta, xi, eta]
    }
}

impl Rows for ReachTable<'_> {
    type Constants = Angle;
    const ANGLES: usize = 1;

    fn constants(&self, [theta, ..]: &[f64; MAX_AXES]) -> Option<Angle> {
        Angle::new(self.kind, *theta)
    }

    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, angle: &Angle, node: &[f64; MAX_AXES], eta: S::f64s, out: &mut [Code]) {
        classify(simd, self.kind, angle, node[1], eta, out);
    }
}

impl Table for ReachTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        let datum = self.datum(node);
        climb(&Datum::from(datum), "a verdict", |bits| {
            let angle = ExactAngle::cached(self.kind, datum[0], bits)?;
            let flags = |case| judge(self.kind, &*angle, [datum[1], datum[2]], case).map(|(flags, _)| flags);
            Some(Code::new(flags(0)? | flags(1)? << CASE_BITS, 0))
        })
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        super::solve::scalars(self.kind, self.datum(node), code, which, out)
    }

    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        super::solve::exact_scalars(self.kind, self.datum(node), code, which, out)
    }
}

impl Kernel for ReachTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader(self.kind)
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.kind, self.grid, start, len)
    }
}
