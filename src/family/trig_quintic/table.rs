//! The family on a grid.

use super::exact::{Shape, judge};
use super::filter::classify;
use super::frame::check;
use super::poly::Frame;
use super::{TrigQuintic, threshold};
use crate::error::Result;
use crate::family::rows::{Rows, fill};
use crate::family::{Code, Kernel, Shader, ShaderInputs, Table, chart_of};
use crate::grid::{Grid, MAX_AXES};
use crate::num::climb;
use fearless_simd::{Level, Simd, dispatch};

/// Quintic trigonometric curves on one grid.
pub(super) struct TrigTable<'g> {
    grid: &'g Grid,
    level: Level,
}

impl<'g> TrigTable<'g> {
    pub(super) fn new(grid: &'g Grid) -> Result<TrigTable<'g>> {
        chart_of(&TrigQuintic, grid)?;
        for (which, axis) in grid.axes().iter().enumerate() {
            check(which, axis.values()[0])?;
            check(which, axis.values()[axis.values().len() - 1])?;
        }
        Ok(TrigTable { grid, level: Level::new() })
    }

    fn shape(&self, node: u64) -> Shape {
        Shape::from(self.grid.node(node))
    }
}

impl Rows for TrigTable<'_> {
    type Constants = Frame<f64>;
    /// Ratio and θ.
    const ANGLES: usize = 2;

    fn constants(&self, [ratio, theta, ..]: &[f64; MAX_AXES]) -> Option<Frame<f64>> {
        Frame::new(*ratio, *theta)
    }

    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, frame: &Frame<f64>, node: &[f64; MAX_AXES], q: S::f64s, out: &mut [Code]) {
        classify(simd, frame, [node[0], node[2], node[3]], q, out);
    }
}

impl Table for TrigTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        let shape = self.shape(node);
        climb(&shape, "a verdict", |bits| judge(&shape, bits).map(|flags| Code::new(flags, 0)))
    }

    fn scalars(&self, node: u64, _: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        // There is one scalar.
        if !which.is_empty() {
            out.fill(threshold::least_ratio(&self.shape(node))?);
        }
        Ok(())
    }

    fn exact_scalars(&self, node: u64, _: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        if !which.is_empty() {
            out.fill(threshold::exact_least_ratio(&self.shape(node))?);
        }
        Ok(())
    }
}

impl Kernel for TrigTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader()
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.grid, start, len)
    }
}
