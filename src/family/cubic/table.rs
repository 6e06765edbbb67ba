//! The cubic family on a grid.

use super::exact::{Ends, ExactDatum, truth};
use super::filter::classify;
use super::pair::Pair;
use super::precision::{Precision, Prepared};
use super::root::Data;
use super::{Code, Cubic};
use crate::error::Result;
use crate::family::blocks::fill_by_blocks;
use crate::family::hermite::check_grid;
use crate::family::rows::{Rows, level};
use crate::family::{Kernel, NO_VALUE, Shader, ShaderInputs, Table, chart_of};
use crate::grid::{Grid, MAX_AXES};
use fearless_simd::{Level, Simd, SimdBase, dispatch};

/// The cubic family on one grid.
pub(super) struct CubicTable<'g> {
    grid: &'g Grid,
    /// Whether the last two axes are a and k.
    normalised: bool,
    level: Level,
}

impl<'g> CubicTable<'g> {
    pub(super) fn new(grid: &'g Grid, level: Level) -> Result<CubicTable<'g>> {
        let chart = chart_of(&Cubic, grid)?;
        check_grid(grid)?;
        Ok(CubicTable { grid, normalised: chart == 1, level })
    }

    fn datum(&self, node: u64) -> ExactDatum {
        let [phi0, phi1, u, v, _] = self.grid.node(node);
        let ends = if self.normalised { Ends::Normalised(u, v) } else { Ends::Curvature(u, v) };
        ExactDatum { phi0, phi1, ends }
    }

    /// Vectors of the last two coordinates, for one pair of angles.
    #[inline(always)]
    pub(super) fn data<S: Simd>(&self, simd: S, pair: &Pair, third: S::f64s, fourth: S::f64s) -> Data<S> {
        data(simd, self.normalised, pair, third, fourth)
    }

    /// The scalars of a node, or none where there is no spiral.
    fn fill(
        &self,
        node: u64,
        code: Code,
        out: &mut [f32],
        by: impl Fn(&ExactDatum, &mut [f32]) -> Result<()>,
    ) -> Result<()> {
        if super::COUNTS[1].of(code.counts()) == 0 {
            out.fill(NO_VALUE);
            return Ok(());
        }
        by(&self.datum(node), out)
    }
}

/// Vectors of the last two coordinates, which may be a and k (`normalised`), for one pair of angles.
#[inline(always)]
fn data<S: Simd>(simd: S, normalised: bool, pair: &Pair, third: S::f64s, fourth: S::f64s) -> Data<S> {
    let (curve0, curve1) = (S::f64s::splat(simd, pair.curve0), S::f64s::splat(simd, pair.curve1));
    // A constant here, so that every bound folds into one.
    let precision = Precision::F64;
    if normalised {
        Data { a: third, k: fourth, kappa0: third / curve0, kappa1: fourth / curve1, precision }
    } else {
        Data { a: third * curve0, k: fourth * curve1, kappa0: third, kappa1: fourth, precision }
    }
}

/// The f64 step for one datum of the domain.
pub(super) fn code(chart: usize, point: &[f64; 4]) -> Code {
    let mut code = [Code::UNDECIDED];
    if let Some(prepared) = Prepared::new(point[0], point[1]) {
        dispatch!(level(), simd => alone(simd, chart == 1, &prepared, point, &mut code));
    }
    code[0]
}

#[inline(always)]
fn alone<S: Simd>(simd: S, normalised: bool, prepared: &Prepared, point: &[f64; 4], out: &mut [Code]) {
    let [third, fourth] = [S::f64s::splat(simd, point[2]), S::f64s::splat(simd, point[3])];
    classify(simd, prepared, &data(simd, normalised, &prepared.pair, third, fourth)).store(out);
}

impl Rows for CubicTable<'_> {
    type Constants = Prepared;
    const ANGLES: usize = 2;

    fn constants(&self, [phi0, phi1, ..]: &[f64; MAX_AXES]) -> Option<Prepared> {
        Prepared::new(*phi0, *phi1)
    }

    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, prepared: &Prepared, node: &[f64; MAX_AXES], fourth: S::f64s, out: &mut [Code]) {
        let data = self.data(simd, &prepared.pair, S::f64s::splat(simd, node[2]), fourth);
        classify(simd, prepared, &data).store(out);
    }
}

impl Table for CubicTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill_by_blocks(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        truth(&self.datum(node)).map(|(truth, bits)| (truth.code, bits))
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.fill(node, code, out, |datum, out| super::solve::scalars(datum, which, out))
    }

    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.fill(node, code, out, |datum, out| super::solve::exact_scalars(datum, which, out))
    }
}

impl Kernel for CubicTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader()
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.grid, self.normalised, start, len)
    }
}
