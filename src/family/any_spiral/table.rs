//! Any spiral on a grid.

use super::Datum;
use super::pair::{PAIR_ERROR, Pair};
use super::{AnySpiral, Code, EXISTS, INFLECTION, RISING};
use crate::error::{Error, Result};
use crate::family::rows::{Rows, fill};
use crate::family::{Kernel, Shader, ShaderInputs, Table, chart_of, outer};
use crate::grid::{Axis, Grid, MAX_AXES};
use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, SimdBase, dispatch};
use std::f64::consts::PI;

/// Any spiral on one grid.
pub(super) struct AnyTable<'g> {
    grid: &'g Grid,
    /// What turns the first coordinate into α: -1 in the cubic's chart.
    sign: f64,
    level: Level,
}

impl<'g> AnyTable<'g> {
    pub(super) fn new(grid: &'g Grid) -> Result<AnyTable<'g>> {
        let sign = if chart_of(&AnySpiral, grid)? == 0 { 1.0 } else { -1.0 };
        for axis in &grid.axes()[..2] {
            check_angles(axis)?;
        }
        Ok(AnyTable { grid, sign, level: Level::new() })
    }

    fn datum(&self, node: u64) -> Datum {
        let [first, beta, k1, k2, _] = self.grid.node(node);
        Datum { alpha: self.sign * first, beta, k1, k2 }
    }
}

/// Angles within [-π, π], that is at most the double below π.
fn check_angles(axis: &Axis) -> Result<()> {
    let values = axis.values();
    match [values[0], values[values.len() - 1]].into_iter().find(|x| x.abs() > PI) {
        None => Ok(()),
        Some(x) => {
            let way_out = "radians; write `180deg` for a half turn, and add or subtract 360deg beyond";
            Err(Error::angle(axis.name().to_owned(), x, "-pi to pi", way_out))
        }
    }
}

impl Rows for AnyTable<'_> {
    type Constants = Pair;
    const ANGLES: usize = 2;

    fn constants(&self, [first, beta, ..]: &[f64; MAX_AXES]) -> Option<Pair> {
        Pair::new(self.sign * first, *beta)
    }

    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, pair: &Pair, node: &[f64; MAX_AXES], k2: S::f64s, out: &mut [Code]) {
        let (all, third) = ((1 << S::f64s::LEN) - 1, node[2]);
        let (k1, zero) = (S::f64s::splat(simd, third), S::f64s::splat(simd, 0.0));
        let (rising, falling) = (k1.simd_lt(k2).to_bitmask(), k1.simd_gt(k2).to_bitmask());
        let (above, below) = (zero.simd_lt(k2).to_bitmask(), zero.simd_gt(k2).to_bitmask());
        let opposite = if third < 0.0 { above } else { 0 } | if third > 0.0 { below } else { 0 };
        const ERROR: f64 = PAIR_ERROR * 0.5 * f64::EPSILON;
        let (yes, no) = if pair.side > 0.0 {
            let (yes, no) = outer::lanes(simd, &pair.sines, k1, k2, ERROR);
            (yes & rising, no | !rising)
        } else if pair.side < 0.0 {
            let (yes, no) = outer::lanes(simd, &pair.sines, -k1, -k2, ERROR);
            (yes & falling, no | !falling)
        } else {
            (0, all)
        };
        for (lane, code) in out.iter_mut().enumerate() {
            let bit = |plane: u64, flag: u8| if plane >> lane & 1 == 1 { flag } else { 0 };
            let flags = bit(yes, EXISTS) | bit(rising, RISING) | bit(yes & opposite, INFLECTION);
            *code = if (yes | no) >> lane & 1 == 1 { Code::new(flags, 0) } else { Code::UNDECIDED };
        }
    }
}

impl Table for AnyTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        self.datum(node).code()
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.datum(node).scalars(code, which, out)
    }

    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.datum(node).exact_scalars(code, which, out)
    }
}

impl Kernel for AnyTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader()
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.grid, self.sign, start, len)
    }
}
