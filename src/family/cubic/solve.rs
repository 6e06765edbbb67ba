//! The exact answer for one datum: all roots, which conditions hold, the margin, the chosen spiral.

use super::Code;
use super::exact::{self, Ends, ExactDatum, ExactRoot};
use super::filter::{RootLanes, visit};
use super::precision::Prepared;
use super::root::{Data, bernstein};
use crate::curve::CubicBezier;
use crate::error::Result;
use crate::family::Answer;
use crate::family::hermite::check;
use crate::family::rows::level;
use crate::num::bernstein::{exact_margin, margin};
use crate::num::{Interval, climb, demand_ieee};
use fearless_simd::{Simd, SimdBase, dispatch};
use std::cmp::Ordering;

/// G² Hermite data in the normalised frame: end points (-1, 0) and (1, 0).
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Datum {
    /// Start tangent angle below the chord, radians, positive.
    pub phi0: f64,
    /// End tangent angle above the chord, radians, positive; `phi0 + phi1 < π`.
    pub phi1: f64,
    /// Start curvature times half the chord.
    pub kappa0: f64,
    /// End curvature times half the chord.
    pub kappa1: f64,
}

impl Datum {
    /// The angle-free coordinates `(a, k)` of the `normalised` chart: `a = κ0 d0²/(4 sin φ0)`, `k = κ1 d1²/(4 sin φ1)`.
    ///
    /// # Accuracy
    /// A few ulp of doubles while `φ0 + φ1` keeps away from π; verdicts use the interval form instead.
    pub fn normalised(&self) -> (f64, f64) {
        let (sin0, sin1) = (self.phi0.sin(), self.phi1.sin());
        let sum = (self.phi0 + self.phi1).sin();
        (self.kappa0 * (sin1 / sum).powi(2) / sin0, self.kappa1 * (sin0 / sum).powi(2) / sin1)
    }
}

/// One root of the two curvature equations and what is proved of its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// `|P'(0)| / d0`, in (0, 3).
    pub f0: f64,
    /// `|P'(1)| / d1`, in (0, 3).
    pub f1: f64,
    /// Whether Theorem 3.1 accepts it.
    pub theorem31: bool,
    /// Whether its curve has monotone curvature: necessary and sufficient.
    pub spiral: bool,
    /// Least value of the spiral polynomial on [0, 1] over its largest Bernstein coefficient: positive inside the
    /// region of spirals, 0 on its boundary, negative outside; in [-1, 1].
    pub margin: f64,
}

/// All that is known of a datum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions {
    flags: u8,
    roots: [Root; 3],
    len: usize,
    chosen: Option<usize>,
}

impl Solutions {
    /// The flags, bits as in [`super::SOLVABLE`] and its siblings.
    pub fn flags(&self) -> u8 {
        self.flags
    }

    /// The different roots in (0, 3)², by increasing f0.
    pub fn roots(&self) -> &[Root] {
        &self.roots[..self.len]
    }

    /// The spiral with the largest margin; of equal ones that with the smaller f0.
    pub fn chosen(&self) -> Option<&Root> {
        self.chosen.map(|i| &self.roots[i])
    }

    /// Where in [`Solutions::roots`] the chosen one is.
    pub fn chosen_index(&self) -> Option<usize> {
        self.chosen
    }
}

/// Solves one datum exactly.
///
/// # Accuracy
/// Flags, counts and the verdicts of each root are proved. `f0` and `f1` are proved to 2^-34, `margin` to 2^-30,
/// absolute; they are usually within a few units in the last place. Where doubles cannot prove that, they are correctly
/// rounded from intervals.
///
/// # Errors
/// [`crate::Error::Domain`] for a datum that is not finite or has angles outside `0 < φ0, 0 < φ1, φ0 + φ1 < π`;
/// [`crate::Error::Undecided`] at the precision cap.
///
/// # Source
/// Habib & Sakai, (3.4), (A.9), (A.10) and Theorem 3.1; the exact test replaces the theorem by necessary and sufficient
/// signs.
pub fn solve(datum: &Datum) -> Result<Solutions> {
    demand_ieee()?;
    let Datum { phi0, phi1, kappa0, kappa1 } = *datum;
    check([("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)])?;
    solved(&ExactDatum { phi0, phi1, ends: Ends::Curvature(kappa0, kappa1) })
}

fn solved(datum: &ExactDatum) -> Result<Solutions> {
    match Solved::fast(datum, Prepared::new(datum.phi0, datum.phi1)).filter(Solved::is_fine) {
        Some(solved) => Ok(solved.solutions()),
        None => slow(datum),
    }
}

/// [`solve`] for a datum of either chart.
fn at(chart: usize, point: &[f64; 4]) -> Result<Solutions> {
    let [phi0, phi1, u, v] = *point;
    let axes = super::CHARTS[chart].axes;
    check(std::array::from_fn(|i| (axes[i], point[i])))?;
    let ends = if chart == 0 { Ends::Curvature(u, v) } else { Ends::Normalised(u, v) };
    solved(&ExactDatum { phi0, phi1, ends })
}

fn code(solved: &Solutions) -> Code {
    let spirals = solved.roots().iter().filter(|root| root.spiral).count();
    Code::new(solved.flags, (solved.len | spirals << super::COUNTS[1].shift) as u8)
}

/// What [`answer`] has of code and chosen curve: the same numbers, without the others.
pub(super) fn chosen(chart: usize, point: &[f64; 4]) -> Result<(Code, Option<Vec<[f64; 2]>>)> {
    let solved = at(chart, point)?;
    let curve = solved.chosen().map(|root| CubicBezier::from_ratios(point[0], point[1], root.f0, root.f1));
    Ok((code(&solved), curve.map(|curve| curve.p.to_vec())))
}

/// All that `query` prints of a datum of either chart.
pub(super) fn answer(chart: usize, point: &[f64; 4]) -> Result<Answer> {
    let [phi0, phi1, u, v] = *point;
    let solved = at(chart, point)?;
    // What turns the curvatures into a and k.
    let (a, k) = Datum { phi0, phi1, kappa0: 1.0, kappa1: 1.0 }.normalised();
    let derived = if chart == 0 { [("a", u * a), ("k", v * k)] } else { [("kappa0", u / a), ("kappa1", v / k)] };
    let solution = |root: &Root| {
        let curve = CubicBezier::from_ratios(phi0, phi1, root.f0, root.f1);
        vec![
            ("f0", root.f0.into()),
            ("f1", root.f1.into()),
            ("theorem31", root.theorem31.into()),
            ("spiral", root.spiral.into()),
            ("margin", root.margin.into()),
            ("length", curve.length().into()),
            ("control_points", curve.p.into()),
        ]
    };
    Ok(Answer {
        code: code(&solved),
        derived: derived.map(|(name, x)| (name, x.into())).to_vec(),
        solutions: solved.roots().iter().map(solution).collect(),
        chosen: solved.chosen,
    })
}

/// A number known to lie from `low` to `high`.
#[derive(Debug, Clone, Copy, Default)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn around(value: f64, error: f64) -> Range {
        // One more unit for the rounding of the ends themselves.
        let error = error + value.abs() * f64::EPSILON;
        Range { low: value - error, high: value + error }
    }

    fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    fn holds(self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// The nearest f32, when all numbers of the range have the same.
    fn to_f32(self) -> Option<f32> {
        let (low, high) = (self.low as f32, self.high as f32);
        // One zero, whatever the sign of what underflowed.
        (low == high).then_some(low + 0.0)
    }
}

#[derive(Clone, Copy, Default)]
struct SolvedRoot {
    x: Range,
    y: Range,
    margin: Range,
    theorem: bool,
    spiral: bool,
}

/// All roots of a datum as doubles can prove them.
struct Solved {
    /// a and k.
    ratios: [f64; 2],
    code: Code,
    roots: [SolvedRoot; 3],
    len: usize,
    chosen: Option<usize>,
}

impl Solved {
    /// The f64 step; `None` where it abstains.
    fn fast(datum: &ExactDatum, prepared: Option<Prepared>) -> Option<Solved> {
        let prepared = prepared?;
        let (curve0, curve1) = (prepared.pair.curve0, prepared.pair.curve1);
        let (a, k, kappa0, kappa1) = match datum.ends {
            Ends::Curvature(kappa0, kappa1) => (kappa0 * curve0, kappa1 * curve1, kappa0, kappa1),
            Ends::Normalised(a, k) => (a, k, a / curve0, k / curve1),
        };
        dispatch!(level(), simd => Solved::lane(simd, &prepared, [a, k, kappa0, kappa1]))
    }

    #[inline(always)]
    fn lane<S: Simd>(simd: S, prepared: &Prepared, [a, k, kappa0, kappa1]: [f64; 4]) -> Option<Solved> {
        let splat = |value| S::f64s::splat(simd, value);
        let data = Data {
            a: splat(a),
            k: splat(k),
            kappa0: splat(kappa0),
            kappa1: splat(kappa1),
            precision: prepared.precision,
        };
        let mut solved =
            Solved { ratios: [a, k], code: Code::UNDECIDED, roots: Default::default(), len: 0, chosen: None };
        let planes = visit::<S, true>(simd, prepared, &data, |found| {
            if found.wanted & 1 == 1 {
                solved.roots[solved.len] = SolvedRoot::new(&found);
                solved.len += 1;
            }
        });
        let mut code = [Code::UNDECIDED];
        planes.store(&mut code);
        solved.code = code[0];
        if solved.code == Code::UNDECIDED {
            return None;
        }
        solved.choose()?;
        Some(solved)
    }

    /// The spiral with the largest margin; `None` when doubles cannot tell two apart.
    fn choose(&mut self) -> Option<()> {
        for i in 0..self.len {
            let root = &self.roots[i];
            match self.chosen.map(|best| &self.roots[best]) {
                _ if !root.spiral => {}
                None => self.chosen = Some(i),
                Some(best) if root.margin.low > best.margin.high => self.chosen = Some(i),
                Some(best) if root.margin.high < best.margin.low => {}
                Some(_) => return None,
            }
        }
        Some(())
    }

    /// Whether all numbers are as accurate as [`solve`] promises.
    fn is_fine(&self) -> bool {
        let fine = |r: Range, error: f64| r.high - r.low <= error;
        let root =
            |r: &SolvedRoot| fine(r.x, 2f64.powi(-34)) && fine(r.y, 2f64.powi(-34)) && fine(r.margin, 2f64.powi(-30));
        self.roots[..self.len].iter().all(root)
    }

    /// (f0, f1) with the digits that a small one lacks when it comes from `3 - a f0²`: a step of Newton's method for
    /// the smaller of the two, on whose square the other depends.
    fn polished(&self, root: &SolvedRoot) -> [f64; 2] {
        let ([a, k], found) = (self.ratios, [root.x.middle(), root.y.middle()]);
        let step = |small: f64, near: f64, far: f64| {
            let large = 3.0 - far * small * small;
            let better = small - (3.0 - small - near * large * large) / (4.0 * near * far * large * small - 1.0);
            [better, 3.0 - far * better * better]
        };
        let [small, large] = if found[1] <= found[0] { step(found[1], a, k) } else { step(found[0], k, a) };
        let better = if found[1] <= found[0] { [large, small] } else { [small, large] };
        if root.x.holds(better[0]) && root.y.holds(better[1]) { better } else { found }
    }

    fn solutions(&self) -> Solutions {
        let root = |r: SolvedRoot| {
            let [f0, f1] = self.polished(&r);
            Root { f0, f1, theorem31: r.theorem, spiral: r.spiral, margin: r.margin.middle() }
        };
        let roots = self.roots.map(root);
        Solutions { flags: self.code.flags(), roots, len: self.len, chosen: self.chosen }
    }
}

impl SolvedRoot {
    #[inline(always)]
    fn new<S: Simd>(found: &RootLanes<'_, S>) -> SolvedRoot {
        let (c, error) = bernstein(found.start, found.end, found.root, 0);
        let at = |v: &S::f64s| v.as_slice()[0];
        let delta = at(&found.root.delta);
        SolvedRoot {
            x: Range::around(at(&found.root.x), delta),
            y: Range::around(at(&found.root.y), delta),
            margin: {
                let (value, error) = margin(&c, error);
                Range::around(value, error)
            },
            theorem: found.theorem & 1 == 1,
            spiral: found.spirals & 1 == 1,
        }
    }
}

/// An exact root with its margin.
struct Weighed {
    root: ExactRoot,
    margin: Interval,
}

/// All roots in intervals, and the chosen spiral; `None` at too low a precision.
fn weigh(datum: &ExactDatum, bits: usize) -> Option<(Code, Vec<Weighed>, Option<usize>)> {
    let truth = exact::at_precision(datum, bits)?;
    let roots: Option<Vec<Weighed>> = truth
        .roots
        .into_iter()
        .map(|root| exact_margin(&root.quintic).map(|margin| Weighed { root, margin }))
        .collect();
    let roots = roots?;
    let mut chosen: Option<usize> = None;
    for i in (0..roots.len()).filter(|i| roots[*i].root.spiral) {
        let better = match chosen {
            None => true,
            Some(best) => roots[i].margin.compare(&roots[best].margin)? == Ordering::Greater,
        };
        if better {
            chosen = Some(i);
        }
    }
    Some((truth.code, roots, chosen))
}

/// [`solve`] by intervals alone, every number correctly rounded.
fn slow(datum: &ExactDatum) -> Result<Solutions> {
    let attempt = |bits| {
        let (code, weighed, chosen) = weigh(datum, bits)?;
        let mut roots = [Root { f0: 0.0, f1: 0.0, theorem31: false, spiral: false, margin: 0.0 }; 3];
        for (slot, w) in roots.iter_mut().zip(&weighed) {
            let (f0, f1) = (w.root.x.to_f64()?, w.root.y.to_f64()?);
            *slot = Root { f0, f1, theorem31: w.root.theorem, spiral: w.root.spiral, margin: w.margin.to_f64()? };
        }
        Some(Solutions { flags: code.flags(), roots, len: weighed.len(), chosen })
    };
    climb(datum, "a root or its margin", attempt).map(|(solutions, _)| solutions)
}

/// The scalars f0, f1, margin (0, 1, 2) of the chosen spiral of a datum that has one, each rounded to nearest f32 with
/// proof.
///
/// Doubles, then doubles with correctly rounded constants, then intervals.
pub(super) fn scalars(datum: &ExactDatum, which: &[usize], out: &mut [f32]) -> Result<()> {
    let rounded = |prepared: Option<Prepared>| {
        let solved = Solved::fast(datum, prepared)?;
        let root = solved.roots[solved.chosen?];
        let ranges = [root.x, root.y, root.margin];
        which.iter().map(|i| ranges[*i].to_f32()).collect::<Option<Vec<f32>>>()
    };
    let fast =
        rounded(Prepared::new(datum.phi0, datum.phi1)).or_else(|| rounded(Prepared::precise(datum.phi0, datum.phi1)));
    match fast {
        Some(values) => {
            out.copy_from_slice(&values);
            Ok(())
        }
        None => exact_scalars(datum, which, out),
    }
}

/// [`scalars`] by intervals alone.
pub(super) fn exact_scalars(datum: &ExactDatum, which: &[usize], out: &mut [f32]) -> Result<()> {
    let attempt = |bits| {
        let (_, weighed, chosen) = weigh(datum, bits)?;
        let w = &weighed[chosen?];
        let ranges = [&w.root.x, &w.root.y, &w.margin];
        which.iter().map(|i| ranges[*i].to_f32()).collect::<Option<Vec<f32>>>()
    };
    out.copy_from_slice(&climb(datum, "a scalar", attempt)?.0);
    Ok(())
}
