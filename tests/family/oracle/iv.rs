//! Intervals of big floats: every operation rounds outwards, so a sign that is decided is a fact.

use astro_float::{BigFloat, Consts, RoundingMode, Sign};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// A decision that this precision cannot make; the caller starts again with more bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsure;

/// What is decided, or not yet.
pub(crate) type Sure<T> = Result<T, Unsure>;

const DOWN: RoundingMode = RoundingMode::Down;
const UP: RoundingMode = RoundingMode::Up;

thread_local! {
    static CONSTS: RefCell<Consts> = RefCell::new(Consts::new().expect("a cache of constants"));
}

/// A closed interval. Results that fit the precision come out with equal ends, which is how exact ties are seen.
#[derive(Debug, Clone)]
pub struct Iv {
    lo: BigFloat,
    hi: BigFloat,
    bits: usize,
}

fn order(a: &BigFloat, b: &BigFloat) -> Ordering {
    a.cmp(b).expect("no NaN").cmp(&0)
}

fn sign_of(x: &BigFloat) -> Ordering {
    if x.is_zero() {
        Ordering::Equal
    } else if x.is_positive() {
        Ordering::Greater
    } else {
        Ordering::Less
    }
}

impl Iv {
    pub fn new(x: f64, bits: usize) -> Iv {
        assert!(x.is_finite());
        let mut point = BigFloat::from_f64(x, bits);
        if x.is_subnormal() {
            // These it reads wrongly: from a multiple that is normal.
            point = BigFloat::from_f64(x * 2f64.powi(60), bits);
            let exponent = point.exponent().expect("finite") - 60;
            point.set_exponent(exponent);
        }
        Iv::point(point, bits)
    }

    fn point(x: BigFloat, bits: usize) -> Iv {
        Iv { lo: x.clone(), hi: x, bits }
    }

    fn at(&self, x: f64) -> Iv {
        Iv::new(x, self.bits)
    }

    /// A value within 2^(exponent - bits - 8) of the truth, widened to contain it.
    fn widened(x: BigFloat, bits: usize) -> Iv {
        let mut ulp = BigFloat::from_f64(1.0, bits);
        ulp.set_exponent(x.exponent().expect("finite") - bits as i32);
        Iv { lo: x.sub(&ulp, bits, DOWN), hi: x.add(&ulp, bits, UP), bits }
    }

    /// `(sin x, cos x)`, from 64 more bits than are kept, so that it does not rest on the last bits of the series.
    pub fn sin_cos(x: f64, bits: usize) -> (Iv, Iv) {
        let (more, near) = (bits + 64, RoundingMode::ToEven);
        let x = BigFloat::from_f64(x, more);
        CONSTS.with_borrow_mut(|c| (Iv::widened(x.sin(more, near, c), bits), Iv::widened(x.cos(more, near, c), bits)))
    }

    pub fn pi(bits: usize) -> Iv {
        CONSTS.with_borrow_mut(|c| Iv::widened(c.pi(bits + 64, RoundingMode::ToEven), bits))
    }

    /// The sign that all its numbers have.
    pub fn sign(&self) -> Sure<Ordering> {
        let (lo, hi) = (sign_of(&self.lo), sign_of(&self.hi));
        if lo == hi { Ok(lo) } else { Err(Unsure) }
    }

    pub fn positive(&self) -> Sure<bool> {
        Ok(self.sign()?.is_gt())
    }

    /// Whether it is at least zero; decided also when it is `[0, hi]`.
    pub fn at_least_zero(&self) -> Sure<bool> {
        match (sign_of(&self.lo), sign_of(&self.hi)) {
            (Ordering::Less, Ordering::Less) => Ok(false),
            (Ordering::Less, _) => Err(Unsure),
            _ => Ok(true),
        }
    }

    pub fn is_exact_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }

    pub fn over(&self, d: &Iv) -> Sure<Iv> {
        match d.sign()? {
            Ordering::Equal => return Err(Unsure),
            Ordering::Less => return (-self).over(&-d),
            Ordering::Greater => {}
        }
        let low = if self.lo.is_negative() { &d.lo } else { &d.hi };
        let high = if self.hi.is_negative() { &d.hi } else { &d.lo };
        Ok(Iv { lo: self.lo.div(low, self.bits, DOWN), hi: self.hi.div(high, self.bits, UP), bits: self.bits })
    }

    /// The square root; a lower end below zero counts as zero, for numbers known to be at least zero.
    pub fn sqrt(&self) -> Iv {
        let root = |x: &BigFloat, mode| if x.is_positive() { x.sqrt(self.bits, mode) } else { self.at(0.0).lo };
        Iv { lo: root(&self.lo, DOWN), hi: root(&self.hi, UP), bits: self.bits }
    }

    pub fn square(&self) -> Iv {
        let m = self.magnitude();
        &m * &m
    }

    pub fn times(&self, x: f64) -> Iv {
        self * &self.at(x)
    }

    pub fn plus(&self, x: f64) -> Iv {
        self + &self.at(x)
    }

    /// The numbers in both; two enclosures of one number must meet.
    pub fn meet(&self, other: &Iv) -> Iv {
        let lo = self.lo.max(&other.lo);
        let hi = self.hi.min(&other.hi);
        assert!(
            order(&lo, &hi).is_le(),
            "two enclosures of one number do not meet: {} and {}",
            self.approx(),
            other.approx()
        );
        Iv { lo, hi, bits: self.bits }
    }

    /// The lesser of two numbers.
    pub fn lower(&self, other: &Iv) -> Iv {
        Iv { lo: self.lo.min(&other.lo), hi: self.hi.min(&other.hi), bits: self.bits }
    }

    /// The absolute value.
    pub fn magnitude(&self) -> Iv {
        match self.sign() {
            Ok(Ordering::Less) => -self,
            Ok(_) => self.clone(),
            Err(Unsure) => Iv { lo: self.at(0.0).lo, hi: self.lo.abs().max(&self.hi.abs()), bits: self.bits },
        }
    }

    /// From the low end of `self` to the high end of `other`.
    pub fn to(&self, other: &Iv) -> Iv {
        assert!(order(&self.lo, &other.hi).is_le());
        Iv { lo: self.lo.clone(), hi: other.hi.clone(), bits: self.bits }
    }

    /// A point inside, about the middle.
    pub fn middle(&self) -> Iv {
        let mut mid = self.lo.add(&self.hi, self.bits, RoundingMode::ToEven);
        if let (false, Some(e)) = (mid.is_zero(), mid.exponent()) {
            mid.set_exponent(e - 1);
        }
        Iv::point(mid, self.bits)
    }

    /// The point at its middle with the mantissa cut to `keep` bits.
    pub fn short_middle(&self, keep: usize) -> Iv {
        let mut mid = self.middle().lo;
        mid.set_precision(keep, RoundingMode::ToEven).expect("a precision");
        mid.set_precision(self.bits, RoundingMode::ToEven).expect("a precision");
        Iv::point(mid, self.bits)
    }

    /// Whether all of `self` lies strictly between the points `lo` and `hi`.
    pub fn between(&self, lo: &Iv, hi: &Iv) -> bool {
        order(&lo.hi, &self.lo).is_lt() && order(&self.hi, &hi.lo).is_lt()
    }

    /// Its middle divided by a power of two.
    pub fn halved(&self, times: usize) -> Iv {
        let mut x = self.middle();
        if !x.lo.is_zero() {
            let e = x.lo.exponent().expect("finite") - times as i32;
            x.lo.set_exponent(e);
            x.hi.set_exponent(e);
        }
        x
    }

    /// `e` with `2^(e-1) <= |middle| < 2^e`; zero gives `i32::MIN`.
    pub fn exponent(&self) -> i32 {
        let mid = self.middle().lo;
        if mid.is_zero() { i32::MIN } else { mid.exponent().expect("finite") }
    }

    /// Two to a power, exactly.
    pub fn power_of_two(exponent: i32, bits: usize) -> Iv {
        let mut one = BigFloat::from_f64(1.0, bits);
        one.set_exponent(exponent + 1);
        Iv::point(one, bits)
    }

    /// The double nearest to the middle.
    pub fn approx(&self) -> f64 {
        nearest(&self.middle().lo)
    }

    /// The double nearest to the number it stands for.
    pub fn to_f64(&self) -> Sure<f64> {
        let (lo, hi) = (nearest(&self.lo), nearest(&self.hi));
        if lo == hi { Ok(lo) } else { Err(Unsure) }
    }

    pub fn bits(&self) -> usize {
        self.bits
    }
}

/// Rounds to the nearest double, ties to even, also below the normal range.
fn nearest(x: &BigFloat) -> f64 {
    let (words, _, sign, exponent, _) = x.as_raw_parts().expect("finite");
    let Some(&top) = words.last().filter(|_| !x.is_zero()) else { return 0.0 };
    // |x| = 0.1xxx · 2^exponent; 53 bits are kept, fewer below 2^-1021.
    let keep = (i64::from(exponent) + 1074).min(53);
    if keep < 0 {
        return 0.0;
    }
    let rest = words[..words.len() - 1].iter().any(|w| *w != 0);
    let wide = u128::from(top) << 63 | u128::from(rest);
    let drop = 127 - keep as u32;
    let (kept, tail) = (wide >> drop, wide & ((1u128 << drop) - 1));
    let half = 1u128 << (drop - 1);
    let up = tail > half || tail == half && kept & 1 == 1;
    let magnitude = (kept + u128::from(up)) as f64;
    let scaled = scale(magnitude, i64::from(exponent) - keep);
    if sign == Sign::Neg { -scaled } else { scaled }
}

/// `x 2^e` in two steps, for a result that a double holds exactly (or that overflows).
fn scale(x: f64, e: i64) -> f64 {
    let e = e.clamp(-2000, 2000) as i32;
    x * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)
}

impl Add for &Iv {
    type Output = Iv;
    fn add(self, b: &Iv) -> Iv {
        Iv { lo: self.lo.add(&b.lo, self.bits, DOWN), hi: self.hi.add(&b.hi, self.bits, UP), bits: self.bits }
    }
}

impl Sub for &Iv {
    type Output = Iv;
    fn sub(self, b: &Iv) -> Iv {
        Iv { lo: self.lo.sub(&b.hi, self.bits, DOWN), hi: self.hi.sub(&b.lo, self.bits, UP), bits: self.bits }
    }
}

impl Neg for &Iv {
    type Output = Iv;
    fn neg(self) -> Iv {
        Iv { lo: self.hi.clone().neg(), hi: self.lo.clone().neg(), bits: self.bits }
    }
}

impl Mul for &Iv {
    type Output = Iv;
    fn mul(self, b: &Iv) -> Iv {
        let (a, bits) = (self, self.bits);
        let product = |x: &BigFloat, y: &BigFloat, x2: &BigFloat, y2: &BigFloat| Iv {
            lo: x.mul(y, bits, DOWN),
            hi: x2.mul(y2, bits, UP),
            bits,
        };
        // Ends by the signs of the factors: not below zero, not above zero, or both.
        let side = |v: &Iv| (!v.lo.is_negative() || v.lo.is_zero(), !v.hi.is_positive() || v.hi.is_zero());
        match (side(a), side(b)) {
            ((true, _), (true, _)) => product(&a.lo, &b.lo, &a.hi, &b.hi),
            ((true, _), (_, true)) => product(&a.hi, &b.lo, &a.lo, &b.hi),
            ((true, _), _) => product(&a.hi, &b.lo, &a.hi, &b.hi),
            ((_, true), (true, _)) => product(&a.lo, &b.hi, &a.hi, &b.lo),
            ((_, true), (_, true)) => product(&a.hi, &b.hi, &a.lo, &b.lo),
            ((_, true), _) => product(&a.lo, &b.hi, &a.lo, &b.lo),
            (_, (true, _)) => product(&a.lo, &b.hi, &a.hi, &b.hi),
            (_, (_, true)) => product(&a.hi, &b.lo, &a.lo, &b.lo),
            _ => {
                let (one, two) = (product(&a.lo, &b.hi, &a.lo, &b.lo), product(&a.hi, &b.lo, &a.hi, &b.hi));
                Iv { lo: one.lo.min(&two.lo), hi: one.hi.max(&two.hi), bits }
            }
        }
    }
}
