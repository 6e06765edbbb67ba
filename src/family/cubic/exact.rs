//! The top of the ladder: the truth of one datum in intervals of growing precision.

use super::angles::Angles;
use super::poly::side;
use super::{ANY_SPIRAL, Code, SOLVABLE, SPIRAL, THEOREM31, THEOREM31_ANY};
use crate::error::Result;
use crate::family::outer;
use crate::num::bernstein::{MOST_HALVINGS, Quintic, positive};
use crate::num::roots::{Curve, bracketed, enclose};
use crate::num::{Interval, Number, Verdict, climb, formula};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// A datum in one of the two charts, its numbers taken as exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ExactDatum {
    /// Start angle.
    pub phi0: f64,
    /// End angle.
    pub phi1: f64,
    /// κ0, κ1, or the normalised a, k.
    pub ends: Ends,
}

/// The two curvature coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ends {
    /// κ0, κ1.
    Curvature(f64, f64),
    /// a, k.
    Normalised(f64, f64),
}

/// One root of the two parabolas with everything proved of it.
#[derive(Debug, Clone)]
pub(super) struct ExactRoot {
    pub x: Interval,
    pub y: Interval,
    pub theorem: bool,
    pub spiral: bool,
    pub quintic: Quintic<Interval>,
}

/// Everything proved of a datum.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    pub code: Code,
    pub roots: Vec<ExactRoot>,
}

/// Proves all verdicts, raising the precision until they are decided; returns the bits that were needed.
///
/// # Errors
/// [`crate::Error::Undecided`] at the precision cap.
pub(super) fn truth(datum: &ExactDatum) -> Result<(Truth, usize)> {
    climb(datum, "a verdict", |bits| at_precision(datum, bits))
}

/// One attempt: `None` when something is undecided at this precision.
pub(super) fn at_precision(datum: &ExactDatum, bits: usize) -> Option<Truth> {
    let angles = Angles::cached(datum.phi0, datum.phi1, bits)?;
    let number = |x: f64| Interval::new(x, bits);
    let (scale0, scale1) = (angles.g1.over(&angles.outer[0])?, angles.g0.over(&angles.outer[1])?);
    let (a, k, kappa0, kappa1) = match datum.ends {
        Ends::Curvature(kappa0, kappa1) => (scale0.scale(kappa0), scale1.scale(kappa1), number(kappa0), number(kappa1)),
        Ends::Normalised(a, k) => (number(a), number(k), number(a).over(&scale0)?, number(k).over(&scale1)?),
    };
    let any = datum.phi0 < datum.phi1 && outer::holds(&angles.outer, &kappa0, &kappa1).decided()?;
    let (solvable, parabolas) = match a.sign()? == Greater && k.sign()? == Greater {
        true => isolate(&a, &k)?,
        false => (false, Vec::new()),
    };
    let mut roots = Vec::new();
    for (x, y) in parabolas {
        roots.push(judge(&angles, x, y, any)?);
    }
    let mut flags = if solvable { SOLVABLE } else { 0 };
    let mut set = |condition: bool, flag: u8| flags |= if condition { flag } else { 0 };
    set(any, ANY_SPIRAL);
    set(solvable && roots.first().is_some_and(|r| r.theorem), THEOREM31);
    set(roots.iter().any(|r| r.theorem), THEOREM31_ANY);
    set(roots.iter().any(|r| r.spiral), SPIRAL);
    let spirals = roots.iter().filter(|r| r.spiral).count();
    let code = Code::new(flags, (roots.len() | spirals << 2) as u8);
    Some(Truth { code, roots })
}

/// F and y at x.
fn residual<N: Number>(a: &N, k: &N, x: &N) -> (N, N) {
    let y = formula!(3.0 - a * (x * x));
    (formula!(3.0 - k * (y * y) - x), y)
}

/// F' = 4akxy - 1.
fn slope<N: Number>(a: &N, k: &N, x: &N) -> N {
    formula!(4.0 * (a * k * (x * residual(a, k, x).1)) - 1.0)
}

/// F'' = 12ak(1 - ax²).
fn curvature<N: Number>(a: &N, k: &N, x: &N) -> N {
    formula!(12.0 * (a * k) * (1.0 - a * (x * x)))
}

/// SOLVABLE, and all roots in the box as intervals around x and y, by increasing x.
fn isolate(a: &Interval, k: &Interval) -> Option<(bool, Vec<(Interval, Interval)>)> {
    let bits = a.bits();
    let ak = a * k;
    let discriminant = (&ak * &(&ak.scale(768.0) - &(a + k).scale(256.0)).plus(96.0)).plus(-1.0);
    let third = |v: &Interval| formula!(3.0 * v - 1.0).sign();
    let (k_above, a_above) = (third(k)? == Greater, third(a)? == Greater);
    // Above 1/3 both, one of the two positive roots lies in the box and the other beyond: they differ.
    let sign = if k_above && a_above { Greater } else { discriminant.sign()? };
    let solvable = k_above && sign != Less;
    let (zero, three) = (Interval::new(0.0, bits), Interval::new(3.0, bits));
    if sign == Equal {
        return Some((solvable, double_roots(a, k, k_above || a_above)?));
    }
    // F < 0 or F > 0 at 0 as k or 1/3 is the larger, at `last` (y = 0) as 1/3 or a is, and F(3) < 0 unless a = 1/3.
    let last = || Some(Interval::new(3.0, bits).over(a)?.sqrt()?.middle());
    // The turning points of F part its roots; F' rises up to 1/√a and falls after.
    let bend = || Some(Interval::new(1.0, bits).over(&a.sqrt()?)?.middle());
    let turn = |from: Interval, to: Interval| bracketed(&from, &to, &Derivative { a, k });
    let brackets = match (k_above, a_above, sign) {
        (true, true, _) => vec![zero, last()?],
        (false, false, Less) => vec![zero, three],
        (_, _, Less) => return Some((solvable, Vec::new())),
        (true, false, _) => vec![zero, turn(bend()?, last()?)?, three],
        (false, true, _) => vec![zero.clone(), turn(zero, bend()?)?, last()?],
        (false, false, _) => vec![zero.clone(), turn(zero, bend()?)?, turn(bend()?, last()?)?, three],
    };
    let mut roots: Vec<(Interval, Interval)> = Vec::new();
    for ends in brackets.windows(2) {
        let root = prove(a, k, &bracketed(&ends[0], &ends[1], &Residual { a, k })?)?;
        if let Some((before, _)) = roots.last()
            && before.compare(&root.0)? != Less
        {
            return None;
        }
        roots.push(root);
    }
    Some((solvable, roots))
}

struct Residual<'i> {
    a: &'i Interval,
    k: &'i Interval,
}

impl Curve for Residual<'_> {
    fn at(&self, x: &Interval) -> Option<(Interval, Interval)> {
        Some((residual(self.a, self.k, x).0, slope(self.a, self.k, x)))
    }
    fn guess(&self, x: f64) -> f64 {
        residual(&self.a.approx(), &self.k.approx(), &x).0
    }
}

struct Derivative<'i> {
    a: &'i Interval,
    k: &'i Interval,
}

impl Curve for Derivative<'_> {
    fn at(&self, x: &Interval) -> Option<(Interval, Interval)> {
        Some((slope(self.a, self.k, x), curvature(self.a, self.k, x)))
    }
    fn guess(&self, x: f64) -> f64 {
        slope(&self.a.approx(), &self.k.approx(), &x)
    }
}

/// Proves a root of F around a guess, inside the box.
fn prove(a: &Interval, k: &Interval, guess: &Interval) -> Option<(Interval, Interval)> {
    let x = enclose(&Residual { a, k }, guess)?;
    let y = residual(a, k, &x).1;
    let inside = x.lower().sign()? == Greater && residual(a, k, &x.upper()).1.sign()? == Greater;
    inside.then_some((x, y))
}

/// The roots where the discriminant is exactly 0: a double root, and a simple one where neither a nor k exceeds 1/3.
///
/// At a double root F = F' = 0, that is `a x² - 4a x + 1 = 0`: `x = 2 ± √(4 - 1/a)`. The four roots of F sum to 0 and
/// multiply to `(9k - 3)/(k a²)`, which gives the other positive one.
fn double_roots(a: &Interval, k: &Interval, alone: bool) -> Option<Vec<(Interval, Interval)>> {
    let bits = a.bits();
    let offset = Interval::new(1.0, bits).over(a)?.scale(-1.0).plus(4.0);
    let offset = if offset.sign()? == Equal { offset } else { offset.sqrt()? };
    let candidates = [formula!(-offset + 2.0), offset.plus(2.0)];
    // The wrong sign is no root: F must not contain 0 there.
    let mut real = candidates.into_iter().filter(|x| residual(a, k, x).0.sign().is_none_or(Ordering::is_eq));
    let x = real.next()?;
    if real.next().is_some() && offset.sign()? != Equal {
        return None;
    }
    let with_y = |x: Interval| {
        let y = residual(a, k, &x).1;
        (x.sign()? == Greater && y.sign()? == Greater).then_some((x, y))
    };
    if alone || offset.sign()? == Equal {
        return Some(vec![with_y(x)?]);
    }
    let product = formula!(9.0 * k - 3.0).over(&formula!(k * a.square() * x.square()))?;
    let other = &(&x.square() - &product).sqrt()? - &x;
    let mut both = vec![with_y(x)?, with_y(other)?];
    match both[0].0.compare(&both[1].0)? {
        Greater => both.swap(0, 1),
        Equal => return None,
        Less => {}
    }
    Some(both)
}

/// Decides Theorem 3.1 and monotone curvature at one root; `any` is whether any spiral exists at all.
fn judge(angles: &Angles, x: Interval, y: Interval, any: bool) -> Option<ExactRoot> {
    let start = side(&x, &y, &angles.p, &angles.g0, &angles.r);
    let end = side(&y, &x, &angles.r, &angles.g1, &angles.p).map(|v| -&v);
    let x_or_y = [(&start, &y), (&end, &x)];
    let quintic = [
        formula!(5.0 * (y.square() * start[0])),
        &y * &start[1],
        &y * &start[2],
        &x * &end[2],
        &x * &end[1],
        formula!(5.0 * (x.square() * end[0])),
    ];
    let theorem = any && Verdict::all(x_or_y.iter().map(|(b, w)| half_theorem(b, w))).decided()?;
    let spiral = theorem || any && positive(&quintic, 0.0, 0.0, MOST_HALVINGS).decided()?;
    Some(ExactRoot { x, y, theorem, spiral, quintic })
}

/// One half of Theorem 3.1; see `filter::half_theorem`. Exact zeros count as holding, as in the paper.
fn half_theorem(b: &[Interval; 3], w: &Interval) -> Verdict {
    let not_negative = |v: &Interval| Verdict::from(v.sign().map(|s| s != Less));
    let root = || {
        let over = formula!(8.0 * (b[0] * b[2] * w) - b[1].square());
        not_negative(&b[1]).or(not_negative(&over))
    };
    Verdict::all([not_negative(&b[0]), not_negative(&b[2]), root()])
}
