//! The families on a grid.

use super::datum::{Datum, check};
use super::truth::{Greatest, least, verdict};
use super::{Kind, PhPath};
use crate::error::Result;
use crate::family::{Code, Kernel, NO_VALUE, Shader, ShaderInputs, Table, chart_of};
use crate::grid::Grid;
use crate::num::{Ball, Interval, Real, TWIN_BITS, Twin, climb};

/// Precision of doubles.
const DOUBLE: usize = 53;

/// Paths on one grid.
pub(super) struct PathTable<'g> {
    kind: Kind,
    grid: &'g Grid,
}

impl<'g> PathTable<'g> {
    pub(super) fn new(kind: Kind, grid: &'g Grid) -> Result<PathTable<'g>> {
        chart_of(&PhPath(kind), grid)?;
        for (which, axis) in grid.axes().iter().enumerate() {
            axis.values().iter().try_for_each(|value| check(kind, which, *value))?;
        }
        Ok(PathTable { kind, grid })
    }

    fn datum(&self, node: u64) -> Datum {
        Datum::new(self.kind, &self.grid.node(node))
    }
}

fn single<N: Real>(value: &Greatest<N>) -> Option<f32> {
    match value {
        Greatest::None => Some(NO_VALUE),
        Greatest::Value(value) => value.to_f32().map(|x| x.min(f32::MAX)),
    }
}

/// The scalar with this index, from intervals alone.
fn exact_scalar(datum: &Datum, which: usize) -> Result<f32> {
    climb(datum, "a greatest curvature", |bits| single(&least::<Interval>(datum, which == 1, bits)?))
        .map(|(value, _)| value)
}

/// The same, from doubles where they prove it.
fn scalar(datum: &Datum, which: usize) -> Result<f32> {
    let by_doubles = || single(&least::<Ball>(datum, which == 1, DOUBLE)?);
    let by_twins = || single(&least::<Twin>(datum, which == 1, TWIN_BITS)?);
    by_doubles().or_else(by_twins).map_or_else(|| exact_scalar(datum, which), Ok)
}

impl Table for PathTable<'_> {
    /// Node by node: how often a curve is halved differs too much for lanes.
    fn filter(&self, start: u64, out: &mut [Code]) {
        for (node, code) in (start..).zip(out) {
            let datum = self.datum(node);
            let code_of_node = verdict::<Ball>(&datum, DOUBLE).or_else(|| verdict::<Twin>(&datum, TWIN_BITS));
            *code = code_of_node.unwrap_or(Code::UNDECIDED);
        }
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        let datum = self.datum(node);
        climb(&datum, "a verdict", |bits| verdict::<Interval>(&datum, bits))
    }

    fn scalars(&self, node: u64, _: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        let datum = self.datum(node);
        for (slot, which) in out.iter_mut().zip(which) {
            *slot = scalar(&datum, *which)?;
        }
        Ok(())
    }

    fn exact_scalars(&self, node: u64, _: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        let datum = self.datum(node);
        for (slot, which) in out.iter_mut().zip(which) {
            *slot = exact_scalar(&datum, *which)?;
        }
        Ok(())
    }
}

impl Kernel for PathTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader(self.kind)
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.kind, self.grid, start, len)
    }
}
