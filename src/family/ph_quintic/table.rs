//! The family on a grid.

use super::pair::Pair;
use super::solve::{exact_scalars, scalars};
use super::truth::verdict;
use super::{PhQuintic, lanes};
use crate::error::Result;
use crate::family::cubic::Datum;
use crate::family::hermite::check_grid;
use crate::family::rows::{Rows, fill, level};
use crate::family::{Code, Kernel, NO_VALUE, Shader, ShaderInputs, Table, chart_of};
use crate::grid::{Grid, MAX_AXES};
use crate::num::{Ball, climb};
use fearless_simd::{Level, Simd, SimdBase, dispatch};

/// G² Hermite PH quintics on one grid.
pub(super) struct PhTable<'g> {
    grid: &'g Grid,
    level: Level,
}

impl<'g> PhTable<'g> {
    pub(super) fn new(grid: &'g Grid) -> Result<PhTable<'g>> {
        chart_of(&PhQuintic, grid)?;
        check_grid(grid)?;
        Ok(PhTable { grid, level: Level::new() })
    }

    fn datum(&self, node: u64) -> Datum {
        let [phi0, phi1, kappa0, kappa1, ..] = self.grid.node(node);
        Datum { phi0, phi1, kappa0, kappa1 }
    }

    /// The scalars of a node, or none where there is no spiral.
    fn fill(
        &self,
        node: u64,
        code: Code,
        out: &mut [f32],
        by: impl Fn(&Datum, &mut [f32]) -> Result<()>,
    ) -> Result<()> {
        if code.flags() & super::SPIRAL == 0 {
            out.fill(NO_VALUE);
            return Ok(());
        }
        by(&self.datum(node), out)
    }
}

impl Rows for PhTable<'_> {
    type Constants = Pair<Ball>;
    const ANGLES: usize = 2;

    fn constants(&self, [phi0, phi1, ..]: &[f64; MAX_AXES]) -> Option<Pair<Ball>> {
        Pair::<Ball>::new(*phi0, *phi1)
    }

    /// In lanes, then node by node what those leave.
    #[inline(always)]
    fn codes<S: Simd>(&self, simd: S, pair: &Pair<Ball>, node: &[f64; MAX_AXES], fourth: S::f64s, out: &mut [Code]) {
        lanes::codes(simd, pair, node[2], fourth, out);
        for (code, kappa1) in out.iter_mut().zip(fourth.as_slice()) {
            if *code == Code::UNDECIDED {
                *code = one(pair, node, *kappa1);
            }
        }
    }
}

/// The f64 step for one datum of the domain.
pub(super) fn code(&[phi0, phi1, kappa0, kappa1]: &[f64; 4]) -> Code {
    let Some(pair) = Pair::<Ball>::new(phi0, phi1) else { return Code::UNDECIDED };
    let mut code = [Code::UNDECIDED];
    dispatch!(level(), simd => alone(simd, &pair, kappa0, kappa1, &mut code));
    if code[0] == Code::UNDECIDED { one(&pair, &[phi0, phi1, kappa0, kappa1, 0.0], kappa1) } else { code[0] }
}

#[inline(always)]
fn alone<S: Simd>(simd: S, pair: &Pair<Ball>, kappa0: f64, kappa1: f64, out: &mut [Code]) {
    lanes::codes(simd, pair, kappa0, S::f64s::splat(simd, kappa1), out);
}

/// The code of one node, in doubles or sums of two.
fn one(pair: &Pair<Ball>, node: &[f64; MAX_AXES], kappa1: f64) -> Code {
    let kappa = [node[2], kappa1];
    let by_twins = || verdict(&Pair::twins(node[0], node[1])?, kappa);
    verdict(pair, kappa).or_else(by_twins).unwrap_or(Code::UNDECIDED)
}

impl Table for PhTable<'_> {
    fn filter(&self, start: u64, out: &mut [Code]) {
        dispatch!(self.level, simd => fill(simd, self, self.grid, start, out));
    }

    fn exact(&self, node: u64) -> Result<(Code, usize)> {
        let datum = self.datum(node);
        let Datum { phi0, phi1, kappa0, kappa1 } = datum;
        climb(&datum, "a verdict", |bits| verdict(&*Pair::cached(phi0, phi1, bits)?, [kappa0, kappa1]))
    }

    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.fill(node, code, out, |datum, out| scalars(datum, which, out))
    }

    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()> {
        self.fill(node, code, out, |datum, out| exact_scalars(datum, which, out))
    }
}

impl Kernel for PhTable<'_> {
    fn shader(&self) -> Shader {
        super::shader::shader()
    }

    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        super::shader::inputs(self.grid, start, len)
    }
}
