//! Signs of polynomials and least values of quintics in Bernstein form on [0, 1], with proof.

use super::{Interval, Number};
use std::cmp::Ordering;

/// Most halvings of intervals: deeper pieces are ties for every purpose, and the recursion stays within a thread's stack.
pub const MOST_HALVINGS: u32 = 400;

/// Bernstein coefficients of a quintic.
pub type Quintic<N> = [N; 6];

/// A number whose comparison with zero can be certain or not.
pub trait Certain: Number {
    /// The sign if it is certain, given that the value may be off by `error` in either direction.
    fn certain_sign(&self, error: f64) -> Option<Ordering>;
    /// Its absolute value, as far as rounding errors depend on it: 0 where numbers carry their own.
    #[inline(always)]
    fn grain(&self) -> f64 {
        0.0
    }
}

impl Certain for f64 {
    #[inline(always)]
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        if *self > error {
            Some(Ordering::Greater)
        } else if *self < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }
    #[inline(always)]
    fn grain(&self) -> f64 {
        self.abs()
    }
}

impl Certain for Interval {
    /// Intervals carry their own error; `error` must be 0.
    fn certain_sign(&self, _error: f64) -> Option<Ordering> {
        self.sign()
    }
}

/// Splits at `t`: the coefficients on `[0, t]` and on `[t, 1]` (de Casteljau).
///
/// At `t = 1/2` each step adds two numbers of at most the largest coefficient's size and halves exactly, so the `K - 1` steps
/// are off by at most `K - 1` units of 2^-53 of the largest coefficient, and pass on errors of the input undiminished but not grown.
#[inline]
pub fn halve<N: Number, const K: usize>(c: &[N; K]) -> ([N; K], [N; K]) {
    let (mut left, mut right) = (c.clone(), c.clone());
    for step in 1..K {
        left[step - 1] = right[0].clone();
        for i in 0..K - step {
            right[i] = right[i].add(&right[i + 1]).times(0.5);
        }
    }
    left[K - 1] = right[0].clone();
    (left, right)
}

/// Whether the polynomial is positive on [0, 1] (`Some(true)`), negative somewhere (`Some(false)`), or not decided.
///
/// # Arguments
/// - `error`: how far each coefficient may be from the truth (0 for intervals).
/// - `rounding`: error added by the first halving: `K - 1` units of 2^-53 of the largest coefficient for doubles, 0 for intervals;
///   a piece's own is in proportion to its own largest coefficient.
/// - `depth`: most halvings of a piece before giving up.
///
/// Coefficients bound the polynomial from below on their piece (convex hull); the outer two are its values there.
/// A zero is never decided: the truth at a tie needs more than this test.
pub fn positive<N: Certain, const K: usize>(c: &[N; K], error: f64, rounding: f64, depth: u32) -> Option<bool> {
    // Relative from here on, because pieces may be much smaller than the whole.
    let unit = if rounding > 0.0 { 1.01 * rounding / largest(c).max(f64::MIN_POSITIVE) } else { 0.0 };
    positive_piece(c, error, unit, depth)
}

fn largest<N: Certain, const K: usize>(c: &[N; K]) -> f64 {
    c.iter().fold(0.0, |most, v| v.grain().max(most))
}

fn positive_piece<N: Certain, const K: usize>(c: &[N; K], error: f64, unit: f64, depth: u32) -> Option<bool> {
    if [&c[0], &c[K - 1]].iter().any(|v| v.certain_sign(error) == Some(Ordering::Less)) {
        return Some(false);
    }
    if c.iter().all(|v| v.certain_sign(error) == Some(Ordering::Greater)) {
        return Some(true);
    }
    // Where nothing is certain, halving cannot help; this also keeps the recursion from branching at a tie.
    if depth == 0 || c.iter().all(|v| v.certain_sign(error).is_none()) {
        return None;
    }
    let (left, right) = halve(c);
    let error = error + unit * largest(c);
    match positive_piece(&left, error, unit, depth - 1) {
        Some(false) => Some(false),
        Some(true) => positive_piece(&right, error, unit, depth - 1),
        // One half may still prove it negative.
        None => match positive_piece(&right, error, unit, depth - 1) {
            Some(false) => Some(false),
            _ => None,
        },
    }
}

/// The least value on [0, 1] and where it is taken, for coefficients taken as exact: `(value, t)`.
///
/// Branch and bound by halving: a piece is dropped when its lowest coefficient is not below the best value found by more than
/// 2^-50 of the largest coefficient.
///
/// # Accuracy
/// The value is at most `(5 · 64 + 8) 2^-53` of the largest coefficient from the least value: 5 units for each of up to 64
/// halvings, 8 units for the tolerance.
pub fn least(c: &Quintic<f64>) -> (f64, f64) {
    const DEPTH: u32 = 64;
    let tolerance = c.iter().fold(0.0f64, |m, v| m.max(v.abs())) * 2f64.powi(-50);
    let mut best = if c[0] <= c[5] { (c[0], 0.0) } else { (c[5], 1.0) };
    // Depth first: at most one waiting piece a level.
    let mut waiting = [(*c, 0.0, 1.0, 0); DEPTH as usize + 2];
    let mut count = 1;
    while count > 0 {
        count -= 1;
        let (piece, from, width, depth) = waiting[count];
        let lowest = piece.iter().fold(f64::INFINITY, |m, v| m.min(*v));
        if depth == DEPTH || lowest >= best.0 - tolerance {
            continue;
        }
        let (left, right) = halve(&piece);
        let (middle, width) = (from + 0.5 * width, 0.5 * width);
        if right[0] < best.0 {
            best = (right[0], middle);
        }
        waiting[count] = (left, from, width, depth + 1);
        waiting[count + 1] = (right, middle, width, depth + 1);
        count += 2;
    }
    best
}

/// Error of [`least`] for coefficients that may each be off by `error`.
pub fn least_error(c: &Quintic<f64>, error: f64) -> f64 {
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs())) + error;
    error + 340.0 * (0.5 * f64::EPSILON) * largest
}

/// The least value on [0, 1] of a quintic with interval coefficients, as an interval; `None` at too low a precision.
///
/// `guess` is where the least value is thought to be taken; Newton's method sharpens it to `t`. On a piece around `t` where
/// second differences prove the quintic convex, it stays above its tangent, hence above `c(t) - |c'(t)|`; elsewhere
/// [`positive`] proves it higher. A guess at an end is proved by [`positive`] alone, up to 2^-(bits/2) of its size; where that fails,
/// Newton's method starts from the end.
pub fn least_interval(c: &Quintic<Interval>, guess: f64) -> Option<Interval> {
    let bits = c[0].bits();
    let inside = if guess > 0.0 && guess < 1.0 { stationary(c, guess) } else { None };
    let t = match inside {
        Some(t) => t,
        None => {
            let (end, at_end) = if guess < 0.5 { (0.0, &c[0]) } else { (1.0, &c[5]) };
            let size = c.iter().fold(Interval::new(0.0, bits), |sum, v| &sum + &v.size().upper());
            let slack = &size * &Interval::power_of_two(-(bits as isize) / 2, bits);
            let floor = &at_end.lower() - &slack;
            if above(c, &floor) == Some(true) {
                return Some(floor.union(at_end));
            }
            // The least value may lie so little inside that doubles take the end for it.
            stationary(c, end)?
        }
    };
    let [value, slope, _] = at(c, &t);
    let floor = &value.lower() - &slope.size().upper();
    // Data at a small angle have a quintic that bends within that angle of an end, so the reach falls with the precision.
    let least_reach = (-(bits as f64) / 4.0).exp2().max(1e-300);
    let mut reach = 0.0625;
    while reach > least_reach {
        let (from, to) = (t.plus(-reach), t.plus(reach));
        let inner = from.sign() == Some(Ordering::Greater);
        let outer = to.plus(-1.0).sign() == Some(Ordering::Less);
        let (left, rest) = if inner { split(c, &from) } else { (c.clone(), c.clone()) };
        let (_, right) = if outer { split(c, &to) } else { (c.clone(), c.clone()) };
        let width =
            &(if outer { to } else { Interval::new(1.0, bits) }) - &(if inner { from.clone() } else { Interval::new(0.0, bits) });
        let scale = if inner { width.over(&(-&from).plus(1.0))? } else { width };
        let middle = if outer { split(&rest, &scale).0 } else { rest };
        let convex = middle.windows(3).all(|w| (&(&w[2] - &w[1]) - &(&w[1] - &w[0])).sign() == Some(Ordering::Greater));
        if convex {
            let sides = (!inner || above(&left, &floor)?) && (!outer || above(&right, &floor)?);
            return sides.then(|| floor.union(&value));
        }
        reach *= 0.25;
    }
    None
}

/// The margin of a quintic: its least value on [0, 1] over its largest coefficient, and how far that may be off, for coefficients that
/// may each be off by `error`.
pub fn margin(c: &Quintic<f64>, error: f64) -> (f64, f64) {
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let (value, _) = least(c);
    let ratio = value / largest;
    // d(m/M) <= (dm + |m/M| dM) / (M - dM), |m| <= M.
    (ratio, (least_error(c, error) + ratio.abs() * error) / (largest - error).max(0.0) + 0.5 * f64::EPSILON)
}

/// [`margin`] in intervals; `None` at too low a precision.
pub fn exact_margin(c: &Quintic<Interval>) -> Option<Interval> {
    let mut largest = Interval::new(0.0, c[0].bits());
    for c in c {
        let size = if c.sign()? == Ordering::Less { -c } else { c.clone() };
        // Of two that cannot be told apart either will do, as an interval around both.
        largest = match size.compare(&largest) {
            Some(Ordering::Greater) => size,
            Some(_) => largest,
            None => size.union(&largest),
        };
    }
    // Scaled to size 1 first: the coefficients of extreme angles leave the range of doubles.
    let mut scaled = c.clone();
    for c in &mut scaled {
        *c = c.over(&largest)?;
    }
    let (_, guess) = least(&scaled.clone().map(|c| c.approx()));
    least_interval(&scaled, guess)
}

/// Whether the quintic stays above `floor` on [0, 1].
fn above(c: &Quintic<Interval>, floor: &Interval) -> Option<bool> {
    positive(&c.clone().map(|v| &v - floor), 0.0, 0.0, MOST_HALVINGS)
}

/// Newton's method for a zero of the derivative, strictly inside; `None` when it leaves (0, 1) or the quintic does not bend upwards.
fn stationary(c: &Quintic<Interval>, guess: f64) -> Option<Interval> {
    let bits = c[0].bits();
    let mut t = Interval::new(guess, bits);
    for _ in 0..bits.ilog2() {
        let [_, slope, bend] = at(c, &t);
        if bend.sign() != Some(Ordering::Greater) {
            return None;
        }
        t = (&t - &slope.over(&bend)?).middle();
        let inside = t.sign() == Some(Ordering::Greater) && t.plus(-1.0).sign() == Some(Ordering::Less);
        if !inside {
            return None;
        }
    }
    Some(t)
}

/// Splits at `t`: the coefficients on `[0, t]` and on `[t, 1]`.
fn split(c: &Quintic<Interval>, t: &Interval) -> (Quintic<Interval>, Quintic<Interval>) {
    let (mut left, mut right) = (c.clone(), c.clone());
    for step in 1..6 {
        left[step - 1] = right[0].clone();
        for i in 0..6 - step {
            right[i] = &right[i] + &(t * &(&right[i + 1] - &right[i]));
        }
    }
    left[5] = right[0].clone();
    (left, right)
}

/// Value, first and second derivative at `t` (de Casteljau).
fn at(c: &Quintic<Interval>, t: &Interval) -> [Interval; 3] {
    let mut row: Vec<Interval> = c.to_vec();
    let (mut slope, mut bend) = (row[0].clone(), row[0].clone());
    while row.len() > 1 {
        match row.len() {
            3 => bend = (&(&row[2] - &row[1]) - &(&row[1] - &row[0])).scale(20.0),
            2 => slope = (&row[1] - &row[0]).scale(5.0),
            _ => {}
        }
        row = row.windows(2).map(|w| &w[0] + &(t * &(&w[1] - &w[0]))).collect();
    }
    [row[0].clone(), slope, bend]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(c: &Quintic<f64>, t: f64) -> f64 {
        let mut row = c.to_vec();
        while row.len() > 1 {
            row = row.windows(2).map(|w| w[0] + t * (w[1] - w[0])).collect();
        }
        row[0]
    }

    /// Bernstein coefficients of `(t - z)² + height` raised to degree 5.
    fn parabola(z: f64, height: f64) -> Quintic<f64> {
        let (b0, b1, b2) = (z * z + height, z * z - z + height, (1.0 - z) * (1.0 - z) + height);
        let raise = |i: f64| ((5.0 - i) * (4.0 - i) * b0 + 2.0 * i * (5.0 - i) * b1 + i * (i - 1.0) * b2) / 20.0;
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(raise)
    }

    #[test]
    fn halves_are_the_same_quintic() {
        let c = [1.0, -2.0, 3.0, 0.5, -1.0, 4.0];
        let (left, right) = halve(&c);
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            assert!((value(&left, t) - value(&c, t / 2.0)).abs() < 1e-14);
            assert!((value(&right, t) - value(&c, 0.5 + t / 2.0)).abs() < 1e-14);
        }
    }

    #[test]
    fn sign_is_right_or_withheld_close_to_tangency() {
        for z in [0.0, 1e-3, 0.3, 0.5, 0.7654321, 1.0] {
            for exponent in 1..15 {
                let height = 10f64.powi(-exponent);
                // The tie itself and anything within the error must be withheld; clear cases must be decided.
                for (height, truth) in [(height, true), (-height, false)] {
                    let verdict = positive(&parabola(z, height), 1e-15, 1e-15, 24);
                    assert!(verdict.is_none_or(|v| v == truth), "z {z} height {height}");
                    assert!(exponent > 12 || verdict == Some(truth), "z {z} height {height} is undecided");
                }
            }
            assert_eq!(positive(&parabola(z, 0.0), 1e-15, 1e-15, 24), None, "a tie at {z}");
        }
    }

    /// Its least value is less than that at an end by what no double next to the end's value can tell.
    #[test]
    fn a_least_value_just_inside_an_end_is_found() {
        for offset in [1e-7, 1e-9, 1e-18, 1e-40] {
            let bits = 512;
            let number = |x: f64| Interval::new(x, bits);
            let z = number(offset);
            // (t - z)², raised to degree 5.
            let b = [z.square(), &z.square() - &z, z.plus(-1.0).square()];
            let raise = |i: f64| {
                let sum = &b[0].scale((5.0 - i) * (4.0 - i)) + &b[1].scale(2.0 * i * (5.0 - i));
                (&sum + &b[2].scale(i * (i - 1.0))).over(&number(20.0)).expect("20 is not 0")
            };
            let c = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(raise);
            let mut back = c.clone();
            back.reverse();
            for c in [c, back] {
                let (_, guess) = least(&c.clone().map(|c| c.approx()));
                let least = least_interval(&c, guess).expect("enough bits");
                assert!(least.sign() != Some(Ordering::Greater) && least.size().upper().approx() < 1e-60, "{offset}: {least:?}");
            }
        }
    }

    #[test]
    fn least_values_agree_in_doubles_and_intervals() {
        for z in [0.0, 0.1, 0.5, 0.7654321, 1.0] {
            for height in [1.0, 1e-6, 0.0, -0.25] {
                let c = parabola(z, height);
                let (least, t) = least(&c);
                assert!((least - height).abs() <= least_error(&c, 1e-15), "{z} {height}: {least}");
                let exact = least_interval(&c.map(|v| Interval::new(v, 192)), t).expect("enough bits");
                assert!((exact.approx() - least).abs() <= least_error(&c, 0.0), "{z} {height}");
            }
        }
    }
}
