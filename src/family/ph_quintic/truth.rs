//! The verdicts of a datum: doubles with error bounds and intervals of growing precision run the same steps.

use super::curves::Curves;
use super::march::{March, Root};
use super::pair::Pair;
use super::shape::CurveShape;
use super::{ANY_SPIRAL, SOLVABLE, SPIRAL};
use crate::curve::energy;
use crate::family::{Code, outer};
use crate::num::bernstein::{MOST_HALVINGS, exact_margin, margin, positive};
use crate::num::{Ball, Interval, Real, Twin, Verdict, formula};

/// A solution and whether its curvature rises throughout.
#[derive(Debug, Clone)]
pub(super) struct Solution<N> {
    pub root: Root<N>,
    pub shape: CurveShape<N>,
    pub spiral: bool,
}

/// Everything proved of a datum.
#[derive(Debug, Clone)]
pub(super) struct Truth<N> {
    pub code: Code,
    /// By increasing B/A; all of them, also where none can be a spiral.
    pub solutions: Vec<Solution<N>>,
    pub curves: Option<Curves<N>>,
}

/// Halvings of the quintic: as fine as doubles show, or as far as it takes.
fn depth(bits: usize) -> u32 {
    if bits <= 53 { 20 } else { MOST_HALVINGS }
}

/// Flags and counts from what is proved: counts above 7 are stored as 7.
fn code(any: bool, solutions: usize, spirals: usize) -> Code {
    let flag = |holds: bool, bit: u8| if holds { bit } else { 0 };
    let flags = flag(solutions > 0, SOLVABLE) | flag(spirals > 0, SPIRAL) | flag(any, ANY_SPIRAL);
    Code::new(flags, (solutions.min(7) | spirals.min(7) << 3) as u8)
}

fn any_spiral<N: Real>(pair: &Pair<N>, [kappa0, kappa1]: [f64; 2]) -> Verdict {
    let bits = pair.sin.bits();
    if !(pair.rising && kappa0 < kappa1) {
        return Verdict::No;
    }
    outer::holds(&pair.outer, &N::of(kappa0, bits), &N::of(kappa1, bits))
}

fn march<N: Real>(pair: &Pair<N>, kappa: [f64; 2]) -> Option<Option<March<N>>> {
    if kappa.iter().any(|k| *k < 0.0) {
        return Some(None);
    }
    Curves::of(pair, kappa).map(|curves| Some(March::new(curves)))
}

/// The code alone: where no spiral is possible the solutions are counted, not found.
pub(super) fn verdict<N: Real>(pair: &Pair<N>, kappa: [f64; 2]) -> Option<Code> {
    let any = any_spiral(pair, kappa).decided()?;
    if any {
        return solve(pair, kappa).map(|truth| truth.code);
    }
    let count = match march(pair, kappa)? {
        Some(march) => march.brackets()?.len(),
        None => 0,
    };
    Some(code(false, count, 0))
}

/// All solutions; `None` when something is undecided at this precision.
pub(super) fn solve<N: Real>(pair: &Pair<N>, kappa: [f64; 2]) -> Option<Truth<N>> {
    let any = any_spiral(pair, kappa).decided()?;
    let Some(march) = march(pair, kappa)? else {
        return Some(Truth { code: code(any, 0, 0), solutions: Vec::new(), curves: None });
    };
    let mut solutions = Vec::new();
    for root in march.roots()? {
        let shape = CurveShape::new(&march.curves, &root)?;
        let spiral = any && positive(&shape.quintic(), 0.0, 0.0, depth(pair.sin.bits())).decided()?;
        solutions.push(Solution { root, shape, spiral });
    }
    let spirals = solutions.iter().filter(|s| s.spiral).count();
    Some(Truth { code: code(any, solutions.len(), spirals), solutions, curves: Some(march.curves) })
}

/// An energy in doubles that is off by this share of itself at most is taken: a sixteenth of what `solve` promises.
const ENOUGH: f64 = 1.0 / (1u64 << 40) as f64;

/// Numbers that have a margin and an energy.
pub(super) trait Measured: Real {
    fn margin(quintic: &[Self; 6]) -> Option<Self>;
    /// `∫ h²/σ³`.
    fn energy(speed: &[Self; 5], turn: &[Self; 3]) -> Option<Self>;
    /// The number to [`BRIEF`] bits, where it has many more.
    fn brief(&self) -> Option<Self> {
        None
    }
}

/// More bits than [`ENOUGH`] asks for, with what sums of positive terms and a series lose.
const BRIEF: usize = 160;

impl Measured for Ball {
    fn margin(c: &[Ball; 6]) -> Option<Ball> {
        let (value, error) = margin(&c.map(|b| b.value), c.iter().fold(0.0, |most, b| b.error.max(most)));
        Some(Ball { value, error })
    }
    fn energy(speed: &[Ball; 5], turn: &[Ball; 3]) -> Option<Ball> {
        energy(speed, turn)
    }
}

impl Measured for Twin {
    /// That of its coefficients as balls, which are as accurate as a margin need be.
    fn margin(c: &[Twin; 6]) -> Option<Twin> {
        Ball::margin(&[0, 1, 2, 3, 4, 5].map(|i| Ball::enclosing(&c[i]))).map(|margin| Twin::around(&margin))
    }
    fn energy(speed: &[Twin; 5], turn: &[Twin; 3]) -> Option<Twin> {
        energy(speed, turn)
    }
}

impl Measured for Interval {
    fn margin(c: &[Interval; 6]) -> Option<Interval> {
        exact_margin(c)
    }
    fn energy(speed: &[Interval; 5], turn: &[Interval; 3]) -> Option<Interval> {
        energy(speed, turn)
    }
    fn brief(&self) -> Option<Interval> {
        (self.bits() > BRIEF).then(|| self.rounded(BRIEF))
    }
}

/// An energy as accurate as [`super::solve`] promises, not more: in doubles where they do, since a series of intervals
/// costs a hundred times as much and more the longer they are; else in intervals of few bits. The f64 step seldom gets
/// so far, because its solution is off by more than the roundings of the series.
fn about<N: Measured>(speed: &[N; 5], turn: &[N; 3]) -> Option<N> {
    let bits = speed[0].bits();
    let ball = energy(&speed.each_ref().map(Ball::enclosing), &turn.each_ref().map(Ball::enclosing));
    let ends = |ball: Ball| Some(N::of(ball.value, bits).add(&N::of(ball.error, bits).size()));
    ball.filter(|ball| ball.error <= ball.value * ENOUGH)
        .and_then(ends)
        .or_else(|| briefly(speed, turn))
        .or_else(|| N::energy(speed, turn))
}

/// In few bits, where numbers have many: the same pieces, of which each takes as many terms as there are bits.
fn briefly<N: Measured>(speed: &[N; 5], turn: &[N; 3]) -> Option<N> {
    let [s0, s1, s2, s3, s4] = speed.each_ref().map(N::brief);
    let [h0, h1, h2] = turn.each_ref().map(N::brief);
    let energy = N::energy(&[s0?, s1?, s2?, s3?, s4?], &[h0?, h1?, h2?])?;
    let off = energy.sub(&energy.middle()).size();
    formula!(energy * { ENOUGH } - off).is_positive().then_some(energy)
}

/// How an energy is computed.
pub(super) type Energy<N> = fn(&[N; 5], &[N; 3]) -> Option<N>;

/// What energies decide: those that are cheap, else those as accurate as the numbers are.
pub(super) fn by_energy<N: Measured, T>(decide: impl Fn(Energy<N>) -> Option<T>) -> Option<T> {
    decide(about).or_else(|| decide(N::energy))
}

/// The energy alone.
pub(super) fn energy_of<N: Measured>(pair: &Pair<N>, solution: &Solution<N>, energy: Energy<N>) -> Option<N> {
    energy(&solution.shape.speed, &solution.shape.turn)?.mul(&pair.sin).mul(&pair.sin).times(4.0).over(&solution.root.z)
}

/// A, B, energy, length or margin (0 to 4) of a solution.
pub(super) fn measure<N: Measured>(
    pair: &Pair<N>,
    curves: &Curves<N>,
    solution: &Solution<N>,
    energy: Energy<N>,
    which: usize,
) -> Option<N> {
    let Root { t, z } = &solution.root;
    match which {
        0 => Some(z.sqrt()?.times(curves.scale[0])),
        1 => {
            let a = z.sqrt()?;
            Some(formula!(a * t * { curves.scale[1] }))
        }
        2 => energy_of(pair, solution, energy),
        3 => {
            let [s0, s1, s2, s3, s4] = &solution.shape.speed;
            formula!((s0 + s1 + s2 + s3 + s4) * z).over(&N::of(5.0, z.bits()))
        }
        _ => N::margin(&solution.shape.quintic()),
    }
}

/// The spiral of least energy, as an index; `None` when two cannot be told apart.
pub(super) fn chosen<N: Measured>(
    pair: &Pair<N>,
    solutions: &[Solution<N>],
    energy: Energy<N>,
) -> Option<Option<usize>> {
    let spirals: Vec<usize> = (0..solutions.len()).filter(|i| solutions[*i].spiral).collect();
    let (Some(first), true) = (spirals.first(), spirals.len() > 1) else { return Some(spirals.first().copied()) };
    let mut best = (*first, energy_of(pair, &solutions[*first], energy)?);
    for i in &spirals[1..] {
        let energy = energy_of(pair, &solutions[*i], energy)?;
        match formula!(energy - best.1).certain_sign(0.0)? {
            std::cmp::Ordering::Less => best = (*i, energy),
            std::cmp::Ordering::Greater => {}
            std::cmp::Ordering::Equal => return None,
        }
    }
    Some(Some(best.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Terms and digits of an energy do not grow with the precision that the solution took.
    #[test]
    fn energies_in_few_bits_hold_the_truth() {
        let mut compared = 0;
        for small in [1e-3, 1e-10, 1e-20] {
            let pair = Pair::exact(small, 2.0 * small, 400).expect("enough bits");
            for solution in solve(&pair, [small, 3.0]).expect("enough bits").solutions {
                let CurveShape { speed, turn } = &solution.shape;
                let (brief, full) =
                    (briefly(speed, turn).expect("accurate"), Interval::energy(speed, turn).expect("all"));
                assert!(brief.bits() == BRIEF && (&brief - &full).sign().is_none(), "{small}");
                compared += 1;
            }
        }
        assert!(compared >= 3, "{compared}");
    }
}
