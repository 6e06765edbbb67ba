//! The exact answer for one datum: all solutions, which are spirals, and their measures.

use super::curves::Curves;
use super::pair::Pair;
use super::truth::{self, Measured, Solution, Truth, by_energy, chosen, measure};
use crate::curve::PhQuintic;
use crate::error::{Error, Result};
use crate::family::cubic::Datum;
use crate::family::hermite::check;
use crate::family::{Answer, Code};
use crate::num::{Ball, Real, climb, demand_ieee};

/// One PH quintic with the ends of a datum, in its frame: from (-1, 0) to (1, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quintic {
    /// `|w0| = A`; the start's speed is A².
    pub a: f64,
    /// `|w2| = B`; the end's speed is B².
    pub b: f64,
    /// The curve itself.
    pub curve: PhQuintic,
    /// Whether its curvature is monotone: necessary and sufficient.
    pub spiral: bool,
    /// Bending energy, the integral of the squared curvature over arc length, times half the chord.
    pub energy: f64,
    /// Arc length in half chords.
    pub length: f64,
    /// Least value of the numerator of κ' on [0, 1] over its largest Bernstein coefficient: positive inside the region
    /// of spirals, 0 on its boundary, negative outside; in [-1, 1].
    pub margin: f64,
}

/// All that is known of a datum.
#[derive(Debug, Clone, PartialEq)]
pub struct Solutions {
    code: Code,
    all: Vec<Quintic>,
    chosen: Option<usize>,
}

impl Solutions {
    /// The flags, bits as in [`super::SOLVABLE`] and its siblings.
    pub fn flags(&self) -> u8 {
        self.code.flags()
    }

    /// All solutions with A, B > 0, by increasing A.
    pub fn all(&self) -> &[Quintic] {
        &self.all
    }

    /// The spiral of least bending energy.
    pub fn chosen(&self) -> Option<&Quintic> {
        self.chosen.map(|i| &self.all[i])
    }

    /// Where in [`Solutions::all`] the chosen one is.
    pub fn chosen_index(&self) -> Option<usize> {
        self.chosen
    }
}

/// Solves one datum exactly.
///
/// # Accuracy
/// Flags, the number of solutions, the verdict of each, and which has the least energy are proved. A, B, energy and
/// length are proved to 2^-36, relative, margins to 2^-30, absolute; pre-image and control points follow from them in
/// doubles.
///
/// # Errors
/// [`crate::Error::Domain`] for a datum that is not finite or has angles outside `0 < φ0, 0 < φ1, φ0 + φ1 < π`, or
/// where A, B, energy or length of a solution is above 0 in truth and leaves the range of doubles ([`flags`] answers
/// there too); [`crate::Error::Undecided`] at the precision cap.
///
/// # Source
/// Pythagorean-hodograph quintics in complex form (Farouki), (2)-(9); the two equations are in the module's `curves`.
pub fn solve(datum: &Datum) -> Result<Solutions> {
    demand_ieee()?;
    let Datum { phi0, phi1, kappa0, kappa1 } = *datum;
    check([("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)])?;
    let by_doubles = Pair::<Ball>::new(phi0, phi1).and_then(|pair| described(datum, &pair));
    if let Some(solutions) = by_doubles.or_else(|| described(datum, &Pair::twins(phi0, phi1)?)) {
        return Ok(solutions);
    }
    let (solutions, _) = climb(datum, "a solution", |bits| described(datum, &*Pair::cached(phi0, phi1, bits)?))?;
    solutions.all.iter().try_for_each(|quintic| within_range(datum, quintic))?;
    Ok(solutions)
}

/// No precision brings a number back that no double has.
fn within_range(datum: &Datum, quintic: &Quintic) -> Result<()> {
    let Quintic { a, b, energy, length, .. } = *quintic;
    let lost = [("A", a), ("B", b), ("the bending energy", energy), ("the length", length)];
    match lost.into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0)) {
        None => Ok(()),
        Some((name, _)) => {
            let Datum { phi0, phi1, kappa0, kappa1 } = *datum;
            let what = format!("{name} of a PH quintic");
            Err(Error::extreme(&what, [("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)]))
        }
    }
}

/// The flags of one datum, as of [`Solutions::flags`], without its curves: several hundred times cheaper than [`solve`]
/// where there is no spiral.
///
/// # Errors
/// Those of [`solve`].
pub fn flags(datum: &Datum) -> Result<u8> {
    demand_ieee()?;
    let Datum { phi0, phi1, kappa0, kappa1 } = *datum;
    check([("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)])?;
    let kappa = [kappa0, kappa1];
    if let Some(code) = Pair::<Ball>::new(phi0, phi1).and_then(|pair| truth::verdict(&pair, kappa)) {
        return Ok(code.flags());
    }
    if let Some(code) = Pair::twins(phi0, phi1).and_then(|pair| truth::verdict(&pair, kappa)) {
        return Ok(code.flags());
    }
    climb(datum, "a verdict", |bits| truth::verdict(&*Pair::cached(phi0, phi1, bits)?, kappa))
        .map(|(code, _)| code.flags())
}

/// All numbers as accurate as [`solve`] promises, or `None`.
fn described<N: Measured>(datum: &Datum, pair: &Pair<N>) -> Option<Solutions> {
    let truth = truth::solve(pair, [datum.kappa0, datum.kappa1])?;
    let best = by_energy(|energy| chosen(pair, &truth.solutions, energy))?;
    let mut all = Vec::new();
    if let Some(curves) = &truth.curves {
        // By increasing A: A falls as B/A rises.
        for solution in truth.solutions.iter().rev() {
            all.push(quintic(datum, pair, curves, solution)?);
        }
    }
    let last = all.len();
    Some(Solutions { code: truth.code, all, chosen: best.map(|i| last - 1 - i) })
}

/// The double in the middle of a number known to `2^-36` of itself plus `floor`.
fn known<N: Real>(x: &N, floor: f64) -> Option<f64> {
    let value = x.approx();
    // Intervals have numbers that doubles do not; their own overflow is another matter.
    let beyond = value.is_infinite() || value == 0.0 && x.is_positive();
    if beyond && x.bits() > 53 {
        return Some(value);
    }
    let off = x.sub(&x.middle()).most();
    (value.is_finite() && off <= 2f64.powi(-37) * value.abs() + floor).then_some(value)
}

fn quintic<N: Measured>(datum: &Datum, pair: &Pair<N>, curves: &Curves<N>, solution: &Solution<N>) -> Option<Quintic> {
    let measured = |which: usize| by_energy(|energy| measure(pair, curves, solution, energy, which));
    let number = |which: usize, floor: f64| known(&measured(which)?, floor);
    let [a, b] = [number(0, 0.0)?, number(1, 0.0)?];
    let quarter = 4.0 * pair.sin.approx();
    let bends = [datum.kappa0 * a.powi(3) / quarter, datum.kappa1 * b.powi(3) / quarter];
    Some(Quintic {
        a,
        b,
        curve: PhQuintic::between([-1.0, 0.0], [1.0, 0.0], preimage(datum, [a, b], bends)),
        spiral: solution.spiral,
        energy: number(2, 0.0)?,
        length: number(3, 0.0)?,
        margin: number(4, 2f64.powi(-31))?,
    })
}

fn preimage(datum: &Datum, [a, b]: [f64; 2], [start, end]: [f64; 2]) -> [[f64; 2]; 3] {
    let ((s0, c0), (s1, c1)) = ((0.5 * datum.phi0).sin_cos(), (0.5 * datum.phi1).sin_cos());
    [[a * c0, -a * s0], [start * c1 + end * c0, start * s1 - end * s0], [b * c1, b * s1]]
}

/// [`solve`] in the form of every family.
pub(super) fn answer(point: &[f64; 4]) -> Result<Answer> {
    let [phi0, phi1, kappa0, kappa1] = *point;
    let solutions = solve(&Datum { phi0, phi1, kappa0, kappa1 })?;
    let solution = |q: &Quintic| {
        vec![
            ("A", q.a.into()),
            ("B", q.b.into()),
            ("spiral", q.spiral.into()),
            ("energy", q.energy.into()),
            ("length", q.length.into()),
            ("margin", q.margin.into()),
            ("preimage", q.curve.preimage.into()),
            ("control_points", q.curve.control_points().into()),
        ]
    };
    let all = solutions.all.iter().map(solution).collect();
    Ok(Answer { code: solutions.code, derived: vec![], solutions: all, chosen: solutions.chosen })
}

/// The scalars A, B, energy, length, margin (0 to 4) of the chosen spiral of a datum that has one, each rounded to
/// nearest f32 with proof; what is beyond the largest f32 becomes the largest f32.
pub(super) fn scalars(datum: &Datum, which: &[usize], out: &mut [f32]) -> Result<()> {
    let by_doubles = Pair::<Ball>::new(datum.phi0, datum.phi1).and_then(|pair| rounded(datum, &pair, which));
    match by_doubles.or_else(|| rounded(datum, &Pair::twins(datum.phi0, datum.phi1)?, which)) {
        Some(values) => {
            out.copy_from_slice(&values);
            Ok(())
        }
        None => exact_scalars(datum, which, out),
    }
}

/// [`scalars`] by intervals alone.
pub(super) fn exact_scalars(datum: &Datum, which: &[usize], out: &mut [f32]) -> Result<()> {
    let attempt = |bits| rounded(datum, &*Pair::cached(datum.phi0, datum.phi1, bits)?, which);
    out.copy_from_slice(&climb(datum, "a scalar", attempt)?.0);
    Ok(())
}

fn rounded<N: Measured>(datum: &Datum, pair: &Pair<N>, which: &[usize]) -> Option<Vec<f32>> {
    let Truth { solutions, curves, .. } = truth::solve(pair, [datum.kappa0, datum.kappa1])?;
    let best = &solutions[by_energy(|energy| chosen(pair, &solutions, energy))??];
    let curves = curves?;
    by_energy(|energy| {
        let value = |i: &usize| Some(measure(pair, &curves, best, energy, *i)?.to_f32()?.min(f32::MAX));
        which.iter().map(value).collect()
    })
}
