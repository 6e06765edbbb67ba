//! Polynomials with interval coefficients, Sturm's theorem, roots.

use super::iv::{Iv, Sure, Unsure};
use std::cmp::Ordering;

/// Coefficients, constant first. The last one is never an exact zero, except that the zero polynomial is `[]`.
#[derive(Debug, Clone)]
pub(crate) struct Poly(pub Vec<Iv>);

impl Poly {
    pub(crate) fn new(mut c: Vec<Iv>) -> Poly {
        while c.last().is_some_and(Iv::is_exact_zero) {
            c.pop();
        }
        Poly(c)
    }

    pub(crate) fn add(&self, other: &Poly) -> Poly {
        let (long, short) = if self.0.len() < other.0.len() { (other, self) } else { (self, other) };
        let sum = long.0.iter().enumerate().map(|(i, c)| short.0.get(i).map_or_else(|| c.clone(), |d| c + d));
        Poly::new(sum.collect())
    }

    pub(crate) fn mul(&self, other: &Poly) -> Poly {
        let (Some(first), true) = (self.0.first(), !other.0.is_empty()) else { return Poly(vec![]) };
        let mut c = vec![Iv::new(0.0, first.bits()); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                c[i + j] = &c[i + j] + &(a * b);
            }
        }
        Poly::new(c)
    }

    pub(crate) fn times(&self, x: f64) -> Poly {
        Poly::new(self.0.iter().map(|c| c.times(x)).collect())
    }

    pub(crate) fn derivative(&self) -> Poly {
        Poly::new(self.0.iter().enumerate().skip(1).map(|(i, c)| c.times(i as f64)).collect())
    }

    pub(crate) fn at(&self, x: &Iv) -> Iv {
        self.0.iter().rev().fold(Iv::new(0.0, x.bits()), |sum, c| &(&sum * x) + c)
    }

    fn lead(&self) -> Sure<Ordering> {
        self.0.last().ok_or(Unsure)?.sign()
    }

    /// The remainder of `self` by `d`, times a positive number: no division, so dyadic coefficients stay exact.
    fn remainder(&self, d: &Poly) -> Sure<Poly> {
        let negative = d.lead()?.is_lt();
        let mut r = self.0.clone();
        while r.len() >= d.0.len() {
            let Some(top) = r.pop() else { break };
            let shift = r.len() + 1 - d.0.len();
            let size = d.0.len() - 1;
            let (factor, top) = if negative { (-&d.0[size], -&top) } else { (d.0[size].clone(), top) };
            for c in &mut r {
                *c = &*c * &factor;
            }
            for (c, below) in r[shift..].iter_mut().zip(&d.0[..size]) {
                *c = &*c - &(&top * below);
            }
        }
        Ok(Poly::new(r))
    }
}

/// A Sturm chain: the polynomial, its derivative, and negated remainders down to the greatest common divisor.
pub(crate) struct Sturm(Vec<Poly>);

impl Sturm {
    /// # Errors
    /// When a leading coefficient's sign is open.
    pub(crate) fn new(p: &Poly) -> Sure<Sturm> {
        let mut chain = vec![p.clone(), p.derivative()];
        while chain[chain.len() - 1].0.len() > 1 {
            let rest = chain[chain.len() - 2].remainder(&chain[chain.len() - 1])?;
            if rest.0.is_empty() {
                break;
            }
            // Without division coefficients are squared at every step; a power of two keeps their exponents in range.
            let largest = rest.0.iter().map(Iv::exponent).filter(|e| *e > i32::MIN).max().unwrap_or(0);
            let scale = Iv::power_of_two(-largest, rest.0[0].bits());
            chain.push(Poly(rest.0.iter().map(|c| &-c * &scale).collect()));
        }
        chain.last().expect("two at least").lead()?;
        Ok(Sturm(chain))
    }

    pub(crate) fn poly(&self) -> &Poly {
        &self.0[0]
    }

    /// Whether no root is multiple.
    pub(crate) fn simple(&self) -> bool {
        self.0.last().is_some_and(|p| p.0.len() == 1)
    }

    /// Sign changes at a point that is no root.
    pub(crate) fn changes(&self, x: &Iv) -> Sure<usize> {
        let mut signs = Vec::with_capacity(self.0.len());
        for p in &self.0 {
            signs.push(p.at(x).sign()?);
        }
        if signs[0].is_eq() {
            return Err(Unsure);
        }
        signs.retain(|s| s.is_ne());
        Ok(signs.windows(2).filter(|w| w[0] != w[1]).count())
    }

    /// The number of different roots between two points that are no roots.
    pub(crate) fn count(&self, lo: &Iv, hi: &Iv) -> Sure<usize> {
        Ok(self.changes(lo)? - self.changes(hi)?)
    }

    /// Encloses each root between `lo` and `hi`, lowest first, as narrowly as the precision allows.
    pub(crate) fn roots(&self, lo: &Iv, hi: &Iv) -> Sure<Vec<Iv>> {
        let (below, above) = (self.changes(lo)?, self.changes(hi)?);
        let mut open = vec![(lo.clone(), below, hi.clone(), above)];
        let mut roots = vec![];
        let mut left = 4 * lo.bits();
        while let Some((lo, below, hi, above)) = open.pop() {
            match below - above {
                0 => {}
                1 => roots.push(self.refine(lo, hi)?),
                _ => {
                    let (mid, at) = self.split(&lo, &hi)?;
                    left = left.checked_sub(1).ok_or(Unsure)?;
                    open.push((mid.clone(), at, hi, above));
                    open.push((lo, below, mid, at));
                }
            }
        }
        Ok(roots)
    }

    /// A point near the middle that is certainly no root, with its sign changes.
    fn split(&self, lo: &Iv, hi: &Iv) -> Sure<(Iv, usize)> {
        for weight in [0.5, 0.53125, 0.4375, 0.28125, 0.78125] {
            let mid = (lo + &(hi - lo).times(weight)).middle();
            if let Ok(at) = self.changes(&mid) {
                return Ok((mid, at));
            }
        }
        Err(Unsure)
    }

    /// Narrows the bracket of a single root: Newton's steps kept inside, the result proved by signs.
    fn refine(&self, lo: Iv, hi: Iv) -> Sure<Iv> {
        let p = self.poly();
        let (below, above) = (p.at(&lo).sign()?, p.at(&hi).sign()?);
        if below == above {
            return self.bisect(lo, hi);
        }
        let x = newton(p, &lo, &hi, below);
        // A root with few bits is met exactly: triple roots of dyadic data are such.
        let short = x.short_middle(64);
        if short.between(&lo, &hi) && p.at(&short).is_exact_zero() {
            return Ok(short);
        }
        let bits = x.bits();
        for lost in (8..bits).step_by(8) {
            let reach = Iv::power_of_two(x.exponent() - (bits - lost) as i32, bits);
            let (left, right) = ((&x - &reach).middle(), (&x + &reach).middle());
            if !(left.between(&lo, &hi) && right.between(&lo, &hi)) {
                break;
            }
            if p.at(&left).sign() == Ok(below) && p.at(&right).sign() == Ok(above) {
                return Ok(left.to(&right));
            }
        }
        Err(Unsure)
    }

    /// For a root of even multiplicity, which only exact data have: halves the bracket by counting.
    fn bisect(&self, mut lo: Iv, mut hi: Iv) -> Sure<Iv> {
        for _ in 0..120 {
            let (mid, at) = self.split(&lo, &hi)?;
            if at < self.changes(&lo)? { hi = mid } else { lo = mid }
        }
        Ok(lo.to(&hi))
    }
}

/// A guess at the only root between `lo` and `hi`, about as good as the precision allows.
fn newton(p: &Poly, lo: &Iv, hi: &Iv, below: Ordering) -> Iv {
    let slope = p.derivative();
    let (mut lo, mut hi) = (lo.clone(), hi.clone());
    let mut x = (&lo + &hi).halved(1);
    let mut last = &hi - &lo;
    for _ in 0..4 * x.bits() {
        let y = p.at(&x);
        match y.sign() {
            Err(_) | Ok(Ordering::Equal) => return x,
            Ok(s) if s == below => lo = x.clone(),
            Ok(_) => hi = x.clone(),
        }
        // Newton's step if it stays inside and halves the step before last; otherwise the middle.
        let step = y.middle().over(&slope.at(&x).middle()).map(|s| s.middle());
        match step.map(|step| ((&x - &step).middle(), step)) {
            Ok((next, step)) if next.between(&lo, &hi) && step.exponent() < last.exponent() => {
                last = step;
                x = next;
            }
            _ => {
                last = (&hi - &lo).halved(1);
                x = (&lo + &hi).halved(1);
            }
        }
        if last.exponent() < x.exponent() - x.bits() as i32 + 4 {
            return x;
        }
    }
    x
}
