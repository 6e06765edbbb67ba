//! Roots of functions on a bracket: a guess in doubles, and intervals that are proved to hold one.

use super::{Interval, Real, TWIN_BITS};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// Finds where `f` changes its sign between `low` and `high`, at which its signs must differ; a guess, nothing proved.
///
/// The ITP method (Oliveira & Takahashi, ACM TOMS 47, 2020): at most one evaluation more than bisection, and
/// superlinear on smooth functions. Written out because the crates that bracket roots are no longer kept, or bring a
/// whole framework for these lines.
///
/// # Accuracy
/// The sign changes within `tolerance` of the result.
pub(crate) fn find(f: impl Fn(f64) -> f64, low: f64, high: f64, tolerance: f64) -> f64 {
    // The usual parameters: κ1 = 0.2 / width, κ2 = 2, n0 = 1.
    let (mut low, mut high, mut below, mut above) = (low, high, f(low), f(high));
    let width = high - low;
    let steps = ((width / (2.0 * tolerance)).log2().ceil().max(0.0) + 1.0).min(2000.0);
    let mut reach = tolerance * steps.exp2();
    while high - low > 2.0 * tolerance {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let radius = (reach - 0.5 * (high - low)).max(0.0);
        let secant = (above * low - below * high) / (above - below);
        let pull = (0.2 / width * (high - low).powi(2)).min((middle - secant).abs());
        let toward = secant + (middle - secant).signum() * pull;
        let next =
            if (toward - middle).abs() <= radius { toward } else { middle - (middle - secant).signum() * radius };
        // Also where a secant was no number.
        let next = if next > low && next < high { next } else { middle };
        let value = f(next);
        if (value > 0.0) == (above > 0.0) {
            (high, above) = (next, value);
        } else {
            (low, below) = (next, value);
        }
        reach *= 0.5;
    }
    0.5 * (low + high)
}

/// A function with its derivative, in intervals and, for guesses, in doubles.
pub(crate) trait Curve {
    /// Value and slope; `None` where the precision does not suffice.
    fn at(&self, x: &Interval) -> Option<(Interval, Interval)>;
    /// An approximation of the value.
    fn guess(&self, x: f64) -> f64;
    /// The root, about, where a formula gives it; else it is looked for with the guessed values.
    fn start(&self) -> Option<Interval> {
        None
    }
}

/// A guess at the zero of `f` between two thin intervals: [`find`] in doubles, then Newton's method kept inside the
/// bracket.
///
/// `None` when f has no certain, opposite signs at the ends.
pub(crate) fn bracketed(from: &Interval, to: &Interval, f: &impl Curve) -> Option<Interval> {
    let (mut low, mut high) = (from.clone(), to.clone());
    let side = f.at(&low)?.0.sign()?;
    if side == Equal || f.at(&high)?.0.sign()? != side.reverse() {
        return None;
    }
    let bits = low.bits();
    let inside = |x: &Interval, low: &Interval, high: &Interval| {
        x.compare(low) == Some(Greater) && x.compare(high) == Some(Less)
    };
    let middle = |low: &Interval, high: &Interval| (low + high).scale(0.5).middle();
    let searched = || {
        let (first, last) = (low.approx(), high.approx());
        // Ends beyond the range of doubles leave no guess.
        let guess = Some(find(|x| f.guess(x), first, last, f64::EPSILON * first.abs().max(last.abs())))
            .filter(|x| x.is_finite());
        guess.map(|x| Interval::new(x, bits))
    };
    let guess = f.start().or_else(searched).filter(|x| inside(x, &low, &high));
    let mut x = guess.unwrap_or_else(|| middle(&low, &high));
    let tiny = Interval::power_of_two(-(bits as isize), bits);
    for _ in 0..4 * bits {
        let (value, slope) = f.at(&x)?;
        let Some(sign) = value.sign().filter(|s| *s != Equal) else { break };
        if sign == side {
            low = x.clone()
        } else {
            high = x.clone()
        }
        let step = value.over(&slope).map(|step| step.middle());
        let limit = &x.size() * &tiny;
        // A step within a rounding of x ends the search, even where it leads out of the bracket.
        if step.as_ref().is_some_and(|s| s.size().upper().compare(&limit.upper()) != Some(Greater)) {
            break;
        }
        let newton = step.map(|step| (&x - &step).middle());
        let next = newton.filter(|n| inside(n, &low, &high)).unwrap_or_else(|| middle(&low, &high));
        if next.compare(&x) == Some(Equal) {
            break;
        }
        x = next;
    }
    Some(x)
}

/// Proves a root around a guess: opposite certain signs at `x - δ` and `x + δ`, with about the least δ that works. The
/// first is what the value at the guess and its rounding ask for.
pub(crate) fn enclose(f: &impl Curve, guess: &Interval) -> Option<Interval> {
    let bits = guess.bits();
    let (value, slope) = f.at(guess)?;
    let most = &guess.size().upper() * &Interval::power_of_two(-(bits as isize) / 4, bits);
    let step = Interval::power_of_two(10 + (bits / 64) as isize, bits);
    let rounding = &guess.size().upper() * &Interval::power_of_two(12 - bits as isize, bits);
    let wanted = value.size().upper().scale(4.0).over(&slope.size().upper()).unwrap_or_else(|| rounding.clone());
    let mut delta = if wanted.compare(&rounding) == Some(Greater) { wanted.upper() } else { rounding };
    while delta.compare(&most) == Some(Less) {
        let (low, high) = ((guess - &delta).lower(), (guess + &delta).upper());
        let sign = |x: &Interval| f.at(x)?.0.sign().filter(|s| *s != Ordering::Equal);
        if sign(&low).is_some_and(|s| sign(&high) == Some(s.reverse())) {
            return Some(low.union(&high));
        }
        delta = (&delta * &step).upper();
    }
    None
}

/// Newton's method from a guess in doubles, and a proof as in [`enclose`]: for numbers of about twice their digits,
/// whose range doubles have.
///
/// `f` gives value and slope. Three steps double the digits of any guess that shows some 14 of them.
pub(crate) fn near<N: Real>(f: impl Fn(&N) -> Option<(N, N)>, guess: f64) -> Option<N> {
    let mut x = N::of(guess, TWIN_BITS);
    let bits = x.bits();
    let mut last = f(&x)?;
    for _ in 0..3 {
        let step = last.0.over(&last.1)?;
        x = x.sub(&step).middle();
        last = f(&x)?;
        if step.most() < x.most() * 2f64.powi(-(bits as i32) / 2) {
            break;
        }
    }
    // Twice what the value and its rounding may move the root, and no less than numbers show.
    let mut delta = (2.0 * last.0.over(&last.1)?.most()).max(x.most() * 2f64.powi(4 - bits as i32));
    for _ in 0..4 {
        let reach = N::of(delta, bits);
        let (low, high) = (x.sub(&reach).middle(), x.add(&reach).middle());
        let sign = |x: &N| f(x)?.0.certain_sign(0.0).filter(|s| *s != Equal);
        if sign(&low).is_some_and(|s| sign(&high) == Some(s.reverse())) {
            return Some(low.union(&high));
        }
        delta *= 16.0;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn no_more_evaluations_than_bisection_and_usually_far_fewer() {
        type Case<'f> = (&'f dyn Fn(f64) -> f64, f64, f64, f64);
        let functions: [Case; 5] = [
            (&|x| x.cos() - x, 0.0, 2.0, 0.7390851332151607),
            (&|x| x.powi(3) - 0.008, -1.0, 4.0, 0.2),
            (&|x| (x - 1e-6).powi(9), -1.0, 4.0, 1e-6),
            (&|x| if x < 0.3 { -1.0 } else { 1e9 }, 0.0, 1.0, 0.3),
            (&|x| 1.0 - 2.0 * x, 0.0, 1e9, 0.5),
        ];
        let mut fewest = usize::MAX;
        for (f, low, high, root) in functions {
            let (count, tolerance) = (Cell::new(0), 1e-13);
            let found = find(
                |x| {
                    count.set(count.get() + 1);
                    f(x)
                },
                low,
                high,
                tolerance,
            );
            assert!((found - root).abs() <= 2.0 * tolerance, "{found} is not {root}");
            let bisection = ((high - low) / tolerance).log2().ceil() as usize;
            assert!(count.get() <= bisection + 4, "{} evaluations, bisection {bisection}", count.get());
            fewest = fewest.min(count.get());
        }
        assert!(fewest < 15, "{fewest}");
    }
}
