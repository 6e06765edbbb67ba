//! The families on a grid.

use super::Kind;
use super::angle::{Angle, check};
use super::exact::{climb, judge, place};
use super::filter::classify;
use super::{CASE_BITS, Reach};
use crate::error::{Error, Result};
use crate::family::{Code, Family, Table};
use crate::grid::Grid;
use fearless_simd::{Level, Simd, SimdBase, dispatch};

/// Reachable end points on one grid.
pub(super) struct ReachTable<'g> {
    kind: Kind,
    grid: &'g Grid,
    level: Level,
}

impl<'g> ReachTable<'g> {
    pub fn new(kind: Kind, grid: &'g Grid) -> Result<ReachTable<'g>> {
        let names: Vec<&str> = grid.axes().iter().map(|a| a.name()).collect();
        let axes = Reach(kind).charts()[0].axes;
        if names != axes {
            let (given, name) = (names.join(", "), kind.name());
            return Err(Error::Domain(format!("axes {given} are no chart of `{name}`; it has: {}", axes.join(", "))));
        }
        let theta = grid.axes()[0].values();
        check(kind, theta[0])?;
        check(kind, theta[theta.len() - 1])?;
        Ok(ReachTable { kind, grid, level: Level::new() })
    }

    fn datum(&self, node: u64) -> [f64; 3] {
        let [theta, xi, eta, _] = self.grid.node(node);
        [theta, xi, eta]
    }

    /// Fills the nodes of one row: all share θ and ξ, η runs over `etas`.
    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, angle: &Angle, xi: f64, etas: &[f64], out: &mut [Code]) {
        let width = S::f64s::LEN;
        let mut padded = [0.0; 64];
        for (values, codes) in etas.chunks(width).zip(out.chunks_mut(width)) {
            let eta = if values.len() == width {
                S::f64s::from_slice(simd, values)
            } else {
                // The last lanes repeat the row's last value; their codes are dropped.
                padded[..values.len()].copy_from_slice(values);
                padded[values.len()..width].fill(values[values.len() - 1]);
                S::f64s::from_slice(simd, &padded[..width])
            };
            classify(simd, self.kind, angle, xi, eta, codes);
        }
    }

    #[inline(always)]
    fn rows<S: Simd>(&self, simd: S, start: u64, out: &mut [Code]) {
        let axes = self.grid.axes();
        let etas = axes[2].values();
        let mut done = 0;
        let mut angle = None;
        while done < out.len() {
            let [i0, i1, i2, _] = self.grid.index(start + done as u64);
            let length = (etas.len() - i2).min(out.len() - done);
            let (codes, values) = (&mut out[done..done + length], &etas[i2..i2 + length]);
            if angle.is_none_or(|(at, _)| at != i0) {
                angle = Some((i0, Angle::new(self.kind, axes[0].values()[i0])));
            }
            match angle {
                Some((_, Some(angle))) => self.row(simd, &angle, axes[1].values()[i1], values, codes),
                _ => codes.fill(Code::UNDECIDED),
            }
            done += length;
        }
    }
}

impl Table for ReachTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => self.rows(simd, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        let datum = self.datum(node);
        climb(&place(&datum), "a verdict", |bits| {
            let flags = |case| judge(self.kind, datum, case, bits).map(|(flags, _)| flags);
            Some(Code::new(flags(0)? | flags(1)? << CASE_BITS, 0))
        })
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        super::solve::scalars(self.kind, self.datum(node), code, which, out)
    }

    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        super::solve::exact_scalars(self.kind, self.datum(node), code, which, out)
    }

    #[cfg(feature = "gpu")]
    fn shader(&self) -> crate::family::Shader {
        super::shader::shader(self.kind)
    }

    #[cfg(feature = "gpu")]
    fn shader_inputs(&self, start: u64, len: u64) -> crate::family::ShaderInputs {
        super::shader::inputs(self.kind, self.grid, start, len)
    }
}
