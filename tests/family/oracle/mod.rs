//! An arbitrary-precision judge of one datum, from the Bézier curve itself: it shares no code and no formula with the
//! library.
//!
//! Everything is decided on outward-rounded intervals, from 320 bits on; whatever is still open starts again with twice
//! as many. Source of the questions: Habib & Sakai (the flags), Kneser and Kurnosenko (any spiral at all).

pub(crate) mod compare;
mod curve;
pub(crate) mod data;
pub(crate) mod iv;
mod margin;
pub(crate) mod ph;
pub(crate) mod ph_path;
pub(crate) mod poly;
pub(crate) mod random;
pub(crate) mod reach;
pub(crate) mod trig;

pub(crate) use curve::Ends;

use curve::{Frame, non_negative, share};
use iv::{Iv, Sure, Unsure};
use margin::margin;
use poly::Poly;

pub(crate) const SOLVABLE: u8 = 1;
pub(crate) const THEOREM31: u8 = 2;
pub(crate) const THEOREM31_ANY: u8 = 4;
pub(crate) const SPIRAL: u8 = 8;
pub(crate) const ANY_SPIRAL: u8 = 16;

const FIRST_BITS: usize = 320;
const LAST_BITS: usize = 40960;

/// One root `(f0, f1)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RootVerdict {
    /// Nearest double.
    pub f0: f64,
    /// Nearest double.
    pub f1: f64,
    pub theorem31: bool,
    pub spiral: bool,
    /// Least value of the numerator of κ' on [0, 1] over its largest Bernstein coefficient: the nearest double.
    pub margin: f64,
}

/// All that can be said of a datum.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Verdict {
    pub flags: u8,
    /// By increasing f0.
    pub roots: Vec<RootVerdict>,
    /// Least scale-free distance of any decision to its boundary; about 0 on a boundary, at most 1.
    pub gap: f64,
    /// The precision at which everything was decided.
    pub bits: usize,
}

impl Verdict {
    /// The `solutions` byte: roots, and spirals from bit 2 on.
    pub(crate) fn solutions(&self) -> u8 {
        self.roots.len() as u8 | (self.roots.iter().filter(|r| r.spiral).count() as u8) << 2
    }

    /// The spiral with the largest margin, the first of equals.
    pub(crate) fn chosen(&self) -> Option<&RootVerdict> {
        self.roots.iter().filter(|r| r.spiral).reduce(|best, r| if r.margin > best.margin { r } else { best })
    }
}

/// Whether the angles lie in the domain `0 < φ0, 0 < φ1, φ0 + φ1 < π`, the sum and π taken exactly.
pub(crate) fn in_domain(phi0: f64, phi1: f64) -> bool {
    let under = |bits| (&(&Iv::pi(bits) - &Iv::new(phi0, bits)) - &Iv::new(phi1, bits)).positive();
    phi0.is_finite() && phi1.is_finite() && phi0 > 0.0 && phi1 > 0.0 && climb(under).0
}

/// Judges `(φ0, φ1, κ0, κ1)`, all taken as exact.
pub(crate) fn judge(phi0: f64, phi1: f64, kappa0: f64, kappa1: f64) -> Verdict {
    judge_ends(phi0, phi1, Ends::Curvature { kappa0, kappa1 })
}

/// Judges angles with end curvatures in either form.
///
/// # Panics
/// Outside the domain, and when something is still open at the last precision.
pub(crate) fn judge_ends(phi0: f64, phi1: f64, ends: Ends) -> Verdict {
    assert!(in_domain(phi0, phi1), "angles {phi0:?}, {phi1:?} are outside the domain");
    let (verdict, bits) = climb(|bits| attempt(phi0, phi1, ends, bits, false));
    Verdict { bits, ..verdict }
}

/// The same without the shortcut that end data in the wrong order have no spirals: every curve is examined.
pub(crate) fn judge_thoroughly(phi0: f64, phi1: f64, ends: Ends) -> Verdict {
    let (verdict, bits) = climb(|bits| attempt(phi0, phi1, ends, bits, true));
    Verdict { bits, ..verdict }
}

fn climb<T>(decide: impl Fn(usize) -> Sure<T>) -> (T, usize) {
    let mut bits = FIRST_BITS;
    while bits <= LAST_BITS {
        match decide(bits) {
            Ok(answer) => return (answer, bits),
            Err(Unsure) => bits *= 2,
        }
    }
    panic!("the oracle decides nothing with {LAST_BITS} bits");
}

fn attempt(phi0: f64, phi1: f64, ends: Ends, bits: usize, thorough: bool) -> Sure<Verdict> {
    let frame = Frame::new(phi0, phi1, bits)?;
    let (solvable, mut gap) = frame.solvable(ends)?;
    let (kappa0, kappa1) = frame.curvatures(ends)?;
    let ordered = phi0 < phi1 && (&kappa1 - &kappa0).positive()?;
    let mut roots = vec![];
    for (x, y) in frame.solve(ends)? {
        let q = frame.numerator(&x, &y);
        let (mut spiral, mut theorem31) = (false, false);
        if ordered || thorough {
            spiral = non_negative(&q, bits)?;
            let (passes, distance) = theorem(&q, bits)?;
            theorem31 = passes;
            gap = gap.min(distance);
        }
        let margin = margin(&q, bits)?;
        if ordered {
            gap = gap.min(margin.abs());
        }
        roots.push(RootVerdict { f0: x.to_f64()?, f1: y.to_f64()?, theorem31, spiral, margin });
    }
    let any = ordered && {
        let (any, distance) = any_spiral(&frame, &kappa0, &kappa1)?;
        gap = gap.min(distance);
        any
    };
    let flags = [
        solvable,
        // The smaller positive root of (A.10) is the first in the box: g(0) > 0 there, and g < 0 wherever f1 leaves it.
        solvable && roots.first().ok_or(Unsure)?.theorem31,
        roots.iter().any(|r| r.theorem31),
        roots.iter().any(|r| r.spiral),
        any,
    ];
    let flags = flags.iter().enumerate().map(|(bit, yes)| u8::from(*yes) << bit).sum();
    Ok(Verdict { flags, roots, gap, bits })
}

fn any_spiral(frame: &Frame, kappa0: &Iv, kappa1: &Iv) -> Sure<(bool, f64)> {
    if kappa0.positive()? {
        return frame.nested(kappa0, kappa1);
    }
    let (q, gap) = frame.q(kappa0, kappa1);
    Ok((q.sign()?.is_lt(), gap))
}

/// Theorem 3.1 for the coefficients in s of `(1 + s)^5 q(1 / (1 + s))`, and its distance from its boundary.
fn theorem(q: &Poly, bits: usize) -> Sure<(bool, f64)> {
    let h = in_s(q, bits);
    let zero = Iv::new(0.0, bits);
    let largest = h.iter().fold(&zero, |m, c| if c.approx().abs() > m.approx().abs() { c } else { m });
    let whole = |middle: &Iv, left: &Iv, right: &Iv| middle + &(left * right).sqrt().times(2.0);
    let plain = [0, 2, 3, 5].map(|i| h[i].clone());
    // Where a product below the root is negative, H0, H2, H3 or H5 has failed already.
    let rooted = [whole(&h[1], &h[0], &h[2]), whole(&h[4], &h[3], &h[5])];
    let gap = plain.iter().chain(&rooted).map(|c| share(c, largest)).fold(1.0, f64::min);
    for c in plain.iter().chain(&rooted) {
        if !c.at_least_zero()? {
            return Ok((false, gap));
        }
    }
    Ok((true, gap))
}

/// `H0 ..= H5` up to a common positive factor: `t^j` becomes `(1 + s)^(5 - j)`.
fn in_s(q: &Poly, bits: usize) -> Vec<Iv> {
    let shift = Poly::new(vec![Iv::new(1.0, bits), Iv::new(1.0, bits)]);
    let mut power = Poly::new(vec![Iv::new(1.0, bits)]);
    let mut sum = Poly::new(vec![]);
    for j in (0..=5).rev() {
        if let Some(c) = q.0.get(j) {
            sum = sum.add(&power.mul(&Poly::new(vec![c.clone()])));
        }
        power = power.mul(&shift);
    }
    let mut h = sum.0;
    h.resize(6, Iv::new(0.0, bits));
    h
}

/// `H0 ..= H5` of a curve with a common positive factor, for comparison with printed values.
pub(crate) fn h_values(phi0: f64, phi1: f64, f0: f64, f1: f64) -> [f64; 6] {
    let frame = Frame::new(phi0, phi1, FIRST_BITS).expect("enough bits");
    let q = frame.numerator(&Iv::new(f0, FIRST_BITS), &Iv::new(f1, FIRST_BITS));
    let h = in_s(&q, FIRST_BITS);
    std::array::from_fn(|i| h[i].approx())
}
