//! An oracle of existence: circles by centre and radius, at whatever precision it takes; no formula in common with the
//! library.

use super::Datum;
use super::iv::{Iv, Sure, Unsure};
use spiral_atlas::family::any_spiral::{EXISTS, INFLECTION, RISING};
use std::cmp::Ordering;

/// The flags in exact arithmetic.
pub(crate) fn judge(datum: Datum) -> u8 {
    let mut bits = 320;
    loop {
        match attempt(datum, bits) {
            Ok(flags) => return flags,
            Err(Unsure) => bits *= 2,
        }
        assert!(bits < 100_000, "{datum:?}");
    }
}

fn attempt(datum: Datum, bits: usize) -> Sure<u8> {
    let [alpha, beta, k1, k2] = datum;
    let order = (&Iv::new(k2, bits) - &Iv::new(k1, bits)).sign()?;
    let side = (&Iv::new(alpha, bits) + &Iv::new(beta, bits)).sign()?;
    // Only where it matters: elsewhere Q may be exactly 0.
    let exists = order == side && order != Ordering::Equal && q(datum, bits).sign()? == Ordering::Less;
    let product = (&Iv::new(k1, bits) * &Iv::new(k2, bits)).sign()?;
    let rising = if order == Ordering::Greater { RISING } else { 0 };
    let inflection = if exists && product == Ordering::Less { INFLECTION } else { 0 };
    Ok(if exists { EXISTS } else { 0 } | rising | inflection)
}

/// Q; from `4Q = k1 k2 (d² - (1/k1 - 1/k2)²)` with d the distance of the centres, or expanded where there is no circle.
pub(super) fn q([alpha, beta, k1, k2]: Datum, bits: usize) -> Iv {
    let ((sin0, cos0), (sin1, cos1)) = (Iv::sin_cos(alpha, bits), Iv::sin_cos(beta, bits));
    let (k1, k2) = (Iv::new(k1, bits), Iv::new(k2, bits));
    let one = Iv::new(1.0, bits);
    if let (Ok(r1), Ok(r2)) = (one.over(&k1), one.over(&k2)) {
        let x = &Iv::new(2.0, bits) - &(&(&r2 * &sin1) - &(&r1 * &sin0));
        let y = &(&r2 * &cos1) - &(&r1 * &cos0);
        let distance = &x.square() + &y.square();
        return (&(&k1 * &k2) * &(&distance - &(&r1 - &r2).square())).times(0.25);
    }
    let cos = &(&cos0 * &cos1) + &(&sin0 * &sin1);
    let half = (-&cos).plus(1.0).times(0.5);
    &(&(&k1 * &k2) + &half) + &(&(&k2 * &sin0) - &(&k1 * &sin1))
}
