//! Signs of polynomials and least values of quintics in Bernstein form on [0, 1], with proof.

use super::formula::formula;
use super::{COVER, Certain, Interval, Number, Verdict};
use crate::steps::step;
use std::cmp::Ordering;

/// Most halvings of intervals: deeper pieces are ties for every purpose, and the recursion stays within a thread's
/// stack.
pub(crate) const MOST_HALVINGS: u32 = 400;

/// Bernstein coefficients of a quintic.
pub(crate) type Quintic<N> = [N; 6];

/// Splits at `t`: the coefficients on `[0, t]` and on `[t, 1]` (de Casteljau).
///
/// At `t = 1/2` each step adds two numbers of at most the largest coefficient's size and halves exactly, so the `K - 1`
/// steps are off by at most `K - 1` units of 2^-53 of the largest coefficient, and pass on errors of the input
/// undiminished but not grown.
#[inline]
pub(crate) fn halve<N: Number, const K: usize>(c: &[N; K]) -> ([N; K], [N; K]) {
    let (mut left, mut right) = (c.clone(), c.clone());
    for step in 1..K {
        left[step - 1] = right[0].clone();
        for i in 0..K - step {
            right[i] = formula!(0.5 * (right[i] + right[i + 1]));
        }
    }
    left[K - 1] = right[0].clone();
    (left, right)
}

/// Whether the polynomial is positive on [0, 1] (yes), negative somewhere (no), or not decided.
///
/// # Arguments
/// - `error`: how far each coefficient may be from the truth (0 for intervals).
/// - `rounding`: error added by the first halving: `K - 1` units of 2^-53 of the largest coefficient for doubles, 0 for
///   intervals; a piece's own is in proportion to its own largest coefficient.
/// - `depth`: most halvings of a piece before giving up.
///
/// Coefficients bound the polynomial from below on their piece (convex hull); the outer two are its values there.
/// A zero is never decided: the truth at a tie needs more than this test.
pub(crate) fn positive<N: Certain, const K: usize>(c: &[N; K], error: f64, rounding: f64, depth: u32) -> Verdict {
    // Relative from here on, because pieces may be much smaller than the whole.
    let unit = if rounding > 0.0 { COVER * rounding / largest(c).max(f64::MIN_POSITIVE) } else { 0.0 };
    positive_piece(c, error, unit, depth)
}

fn largest<N: Certain, const K: usize>(c: &[N; K]) -> f64 {
    c.iter().fold(0.0, |most, v| v.grain().max(most))
}

fn positive_piece<N: Certain, const K: usize>(c: &[N; K], error: f64, unit: f64, depth: u32) -> Verdict {
    if [&c[0], &c[K - 1]].iter().any(|v| v.certain_sign(error) == Some(Ordering::Less)) {
        return Verdict::No;
    }
    if c.iter().all(|v| v.certain_sign(error) == Some(Ordering::Greater)) {
        return Verdict::Yes;
    }
    // Where nothing is certain, halving cannot help; this also keeps the recursion from branching at a tie.
    if depth == 0 || c.iter().all(|v| v.certain_sign(error).is_none()) {
        return Verdict::Undecided;
    }
    let balanced = N::balanced(c);
    let (left, right) = halve(balanced.as_ref().unwrap_or(c));
    let error = error + unit * largest(c);
    match positive_piece(&left, error, unit, depth - 1) {
        Verdict::No => Verdict::No,
        Verdict::Yes => positive_piece(&right, error, unit, depth - 1),
        // One half may still prove it negative.
        Verdict::Undecided => positive_piece(&right, error, unit, depth - 1).only_no(),
    }
}

/// The least value on [0, 1] and where it is taken, for coefficients taken as exact: `(value, t)`.
///
/// Branch and bound by halving: a piece is dropped when its lowest coefficient is not below the best value found by
/// more than 2^-50 of the largest coefficient.
///
/// # Accuracy
/// The value is at most `(5 · 64 + 8) 2^-53` of the largest coefficient from the least value: 5 units for each of up to
/// 64 halvings, 8 units for the tolerance.
pub(crate) fn least(c: &Quintic<f64>) -> (f64, f64) {
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
pub(crate) fn least_error(c: &Quintic<f64>, error: f64) -> f64 {
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs())) + error;
    error + 340.0 * (0.5 * f64::EPSILON) * largest
}

/// The least value on [0, 1] of a quintic with interval coefficients, as an interval.
///
/// Branch and bound by halving, as [`least`]: a piece is dropped when its lowest coefficient is not below the best
/// value found by more than 2^-(bits/2) of the largest coefficient and twice the width of the widest, or after as many
/// halvings as there are bits.
///
/// # Accuracy
/// Near a least value inside, the lowest coefficient of a piece is below it by the square of the piece's width, so that
/// some bits/4 halvings suffice. A feature of width w asks for log2 1/w more.
pub(crate) fn least_interval(c: &Quintic<Interval>) -> Interval {
    let bits = c[0].bits();
    let less = |a: &Interval, b: &Interval| a.compare(b) == Some(Ordering::Less);
    let min = |a: Interval, b: Interval| if less(&b, &a) { b } else { a };
    let size = c.iter().fold(Interval::new(0.0, bits), |sum, v| &sum + &v.size().upper());
    // Halving widens no coefficient but by roundings, which are far below the first term.
    let width = c.iter().fold(Interval::new(0.0, bits), |sum, v| formula!(sum + (v.upper() - v.lower())));
    let tolerance = formula!(size * Interval::power_of_two(-(bits as isize) / 2, bits) + 2.0 * width);
    let lowest = |c: &Quintic<Interval>| c[1..].iter().fold(c[0].lower(), |low, v| min(low, v.lower()));
    let mut ceiling = min(c[0].upper(), c[5].upper());
    let mut floor = ceiling.clone();
    let mut waiting = vec![(lowest(c), c.clone(), 0)];
    while let Some((low, piece, depth)) = waiting.pop() {
        step();
        if depth == bits || !less(&low, &(&ceiling - &tolerance)) {
            floor = min(floor, low);
            continue;
        }
        let (left, right) = halve(&piece);
        ceiling = min(ceiling, right[0].upper());
        let mut halves = [left, right].map(|half| (lowest(&half), half, depth + 1));
        // The lower one is looked at first.
        if less(&halves[0].0, &halves[1].0) {
            halves.reverse();
        }
        waiting.extend(halves);
    }
    floor.union(&ceiling)
}

/// The margin of a quintic: its least value on [0, 1] over its largest coefficient, and how far that may be off, for
/// coefficients that may each be off by `error`.
pub(crate) fn margin(c: &Quintic<f64>, error: f64) -> (f64, f64) {
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let (value, _) = least(c);
    let ratio = value / largest;
    // d(m/M) <= (dm + |m/M| dM) / (M - dM), |m| <= M.
    (ratio, (least_error(c, error) + ratio.abs() * error) / (largest - error).max(0.0) + 0.5 * f64::EPSILON)
}

/// [`margin`] in intervals; `None` at too low a precision.
pub(crate) fn exact_margin(c: &Quintic<Interval>) -> Option<Interval> {
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
    Some(least_interval(&scaled))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::counted;

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
                    assert!(verdict != Verdict::of(!truth), "z {z} height {height}");
                    assert!(exponent > 12 || verdict == Verdict::of(truth), "z {z} height {height} is undecided");
                }
            }
            assert_eq!(positive(&parabola(z, 0.0), 1e-15, 1e-15, 24), Verdict::Undecided, "a tie at {z}");
        }
    }

    /// `((v - su)² + height s²u²)(u + v)³` has its dip at v/u = s, or at 1/s with the ends exchanged.
    #[test]
    fn halvings_do_not_grow_with_the_distance_of_scales() {
        for exponent in [0, 3, 40, 900, 5000] {
            for (height, verdict) in [(1e-6, true), (-1e-6, false)] {
                let bits = 256;
                let s = Interval::power_of_two(-exponent, bits);
                let dip = [s.square().scale(1.0 + height), s.scale(-2.0), Interval::new(1.0, bits)];
                let mut form: Quintic<Interval> = std::array::from_fn(|_| Interval::new(0.0, bits));
                for (i, d) in dip.iter().enumerate() {
                    for (j, binomial) in [1.0, 3.0, 3.0, 1.0].into_iter().enumerate() {
                        form[i + j] = &form[i + j] + &d.scale(binomial);
                    }
                }
                let binomials = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0].map(|x| Interval::new(x, bits));
                let c: Quintic<Interval> = std::array::from_fn(|i| form[i].over(&binomials[i]).expect("not 0"));
                let mut back = c.clone();
                back.reverse();
                for c in [c, back] {
                    assert_eq!(positive(&c, 0.0, 0.0, 16), Verdict::of(verdict), "2^-{exponent}, {height}");
                }
            }
        }
    }

    /// Its least value is less than that at an end by less than the distance of that value to the next double.
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
                let (steps, least) = counted(|| least_interval(&c));
                assert!(steps < 600, "{offset}: {steps} steps");
                assert!(
                    least.sign() != Some(Ordering::Greater) && least.size().upper().approx() < 1e-60,
                    "{offset}: {least:?}"
                );
            }
        }
    }

    /// No halving tells numbers apart that their intervals do not.
    #[test]
    fn wide_coefficients_are_not_halved_for_ever() {
        for z in [0.0, 0.3, 1.0] {
            let blurred = |v: f64| Interval::new(v - 1e-9, 128).union(&Interval::new(v + 1e-9, 128));
            let (steps, least) = counted(|| least_interval(&parabola(z, 0.25).map(blurred)));
            assert!(steps < 200 && (least.approx() - 0.25).abs() < 1e-7, "{z}: {steps} steps, {least:?}");
        }
    }

    #[test]
    fn least_values_agree_in_doubles_and_intervals() {
        for z in [0.0, 0.1, 0.5, 0.7654321, 1.0] {
            for height in [1.0, 1e-6, 0.0, -0.25] {
                let c = parabola(z, height);
                let (least, _) = least(&c);
                assert!((least - height).abs() <= least_error(&c, 1e-15), "{z} {height}: {least}");
                let exact = least_interval(&c.map(|v| Interval::new(v, 192)));
                assert!((exact.approx() - least).abs() <= least_error(&c, 0.0), "{z} {height}");
            }
        }
    }
}
