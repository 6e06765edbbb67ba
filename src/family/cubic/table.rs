//! The cubic family on a grid.

use super::exact::{Ends, ExactDatum, truth};
use super::filter::{Data, Prepared, classify};
use super::pair::Pair;
use super::{Code, Cubic};
use crate::error::{Error, Result};
use crate::family::rows::{Rows, fill};
use crate::family::{Table, chart_of};
use crate::grid::Grid;
use crate::num::trig::two_sum;
use fearless_simd::{Level, Simd, SimdBase, dispatch};
use std::f64::consts::PI;

/// The cubic family on one grid.
pub(super) struct CubicTable<'g> {
    grid: &'g Grid,
    /// Whether the last two axes are a and k.
    normalised: bool,
    level: Level,
}

impl<'g> CubicTable<'g> {
    pub fn new(grid: &'g Grid) -> Result<CubicTable<'g>> {
        let chart = chart_of(&Cubic, grid)?;
        let (phi0, phi1) = (&grid.axes()[0], &grid.axes()[1]);
        for axis in [phi0, phi1] {
            check_angle(axis.name(), axis.values()[0])?;
        }
        let last = |axis: &crate::grid::Axis| axis.values()[axis.values().len() - 1];
        check_angles(last(phi0), last(phi1))?;
        Ok(CubicTable { grid, normalised: chart == 1, level: Level::new() })
    }

    fn datum(&self, node: u64) -> ExactDatum {
        let [phi0, phi1, u, v] = self.grid.node(node);
        let ends = if self.normalised { Ends::Normalised(u, v) } else { Ends::Curvature(u, v) };
        ExactDatum { phi0, phi1, ends }
    }
}

impl Rows for CubicTable<'_> {
    type Pair = Prepared;

    fn pair(&self, phi0: f64, phi1: f64) -> Option<Prepared> {
        Pair::new(phi0, phi1).map(Prepared::new)
    }

    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, prepared: &Prepared, third: f64, fourth: S::f64s, out: &mut [Code]) {
        let third = S::f64s::splat(simd, third);
        let (curve0, curve1) = (S::f64s::splat(simd, prepared.pair.curve0), S::f64s::splat(simd, prepared.pair.curve1));
        let data = if self.normalised {
            Data { a: third, k: fourth, kappa0: third / curve0, kappa1: fourth / curve1 }
        } else {
            Data { a: third * curve0, k: fourth * curve1, kappa0: third, kappa1: fourth }
        };
        let planes = classify(simd, prepared, &data);
        for (lane, code) in out.iter_mut().enumerate() {
            *code = planes.code(lane);
        }
    }
}

/// An angle must be positive and below π, which lies just above the double [`PI`]; the sum is checked by [`check_angles`].
pub(super) fn check_angle(name: &str, angle: f64) -> Result<()> {
    if angle > 0.0 && angle <= PI {
        return Ok(());
    }
    Err(Error::Domain(format!("{name} is {angle}; it must be above 0 and below pi (radians; write `40deg` for degrees)")))
}

/// The tangents must meet: φ0 + φ1 < π, decided exactly.
pub(super) fn check_angles(phi0: f64, phi1: f64) -> Result<()> {
    // π lies between the double PI and the next one up. Where the rounded sum equals PI, two-sum tells which side.
    let (sum, low) = two_sum(phi0, phi1);
    let below = sum < PI || sum == PI && low < 1.224_646_799_147_353_2e-16;
    if below {
        return Ok(());
    }
    Err(Error::Domain(format!("phi0 + phi1 reaches {phi0} + {phi1} = {sum}; it must stay below pi, so that the tangents meet")))
}

impl Table for CubicTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        truth(&self.datum(node)).map(|(truth, bits)| (truth.code, bits))
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        super::solve::scalars(&self.datum(node), code, which, out)
    }

    #[cfg(feature = "gpu")]
    fn shader(&self) -> crate::family::Shader {
        super::shader::shader()
    }

    #[cfg(feature = "gpu")]
    fn shader_inputs(&self, start: u64, len: u64) -> crate::family::ShaderInputs {
        super::shader::inputs(self.grid, self.normalised, start, len)
    }
}
