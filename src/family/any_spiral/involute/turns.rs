//! How many turns about either end a spiral can take, and how many the involute's image does, proved.

use super::super::Datum;
use super::super::arc::Arc;
use super::numbers::{Map, polar};
use crate::error::Result;
use crate::num::{Interval, climb, formula};
use serde::Serialize;
use std::cmp::Ordering::{Greater, Less};
use std::f64::consts::PI;

/// Whether a curve takes its turns about the two ends as asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Split {
    /// As asked.
    Asked,
    /// Not this curve: it has as many turns in all, but others about each end. Some other spiral can do as asked.
    Other,
    /// No spiral can: one with so many turns in all takes from `least` to `most` of them about the start.
    Impossible {
        /// Fewest turns about the start.
        least: u32,
        /// Most turns about the start.
        most: u32,
    },
}

/// Fewest and most turns about the start among all spirals of increasing curvature with `turns` in all.
///
/// The spiral stays outside of, or inside, both end circles of curvature, as the signs of the curvatures say. With
/// k1 >= 0 it lies within the first circle, which the line beyond the start meets nowhere else, so that it never turns
/// about the start; likewise for k2 <= 0 and the end. Between, its tangent at the inflection parts the two circles:
/// directions of such lines lie in an interval within (-π, 0), and the curve turns right from its start, and left to
/// its end, from or to one of them. Without a turn about the start (the end) α (β) must lie above the least of these
/// directions.
///
/// # Errors
/// [`crate::Error::Undecided`] at the precision cap.
pub(super) fn range(chord: &Datum, turns: u32) -> Result<(u32, u32)> {
    let Datum { alpha, beta, k1, k2 } = *chord;
    if turns == 0 || k1 >= 0.0 {
        return Ok((0, 0));
    }
    if k2 <= 0.0 {
        return Ok((turns, turns));
    }
    Ok((u32::from(lies_below(chord, alpha, beta, k2)?), turns - u32::from(lies_below(chord, beta, alpha, -k1)?)))
}

/// Whether the direction x of one end lies below all directions of lines that part the two circles; `y` is that of the
/// other end, k the size of its curvature.
///
/// With the centres apart by D and the radii r1, r2, lines of the direction δ part the circles where `f(δ) = D × δ -
/// r1 - r2` is not negative: on an interval around the direction of its only maximum, within (-π, 0). At `δ = x`, where
/// the line is the tangent at that end, the other radius is left: `f = -2 sin x - 2 sin²((x - y)/2)/k`, and
/// `f' = -2 cos x + sin(y - x)/k`. So x lies below where it is in (-π, 0), f is negative and f' positive. Neither is
/// ever 0, so that some precision suffices (Lindemann and Weierstrass): both are sums of powers of e with different
/// exponents, whose factors are imaginary from sines and real from cosines and so do not cancel.
fn lies_below(chord: &Datum, x: f64, y: f64, k: f64) -> Result<bool> {
    // A half turn is that to the other side.
    if x >= 0.0 || x == -PI {
        return Ok(false);
    }
    let signs = |bits: usize| {
        let (number, k) = (|x: f64| Interval::new(x, bits), Interval::new(k, bits));
        let (sin, cos) = Interval::sin_cos(x, bits);
        let apart = &number(y) - &number(x);
        let half = apart.scale(0.5).sine_cosine().0;
        if formula!(k * sin + half.square()).sign()? != Greater {
            return Some(false);
        }
        Some((&apart.sine_cosine().0 - &formula!(2.0 * (k * cos))).sign()? == Greater)
    };
    Ok(climb(chord, "which turns are possible", signs)?.0)
}

/// Turns about the start of the image with increasing curvature and `turns` in all.
///
/// By the direction of the curve, which changes by `β - α` and 2π for each turn about the end, less 2π for each about
/// the start. With the pole W of the map the direction is that of the involute z, `-t`, less twice the argument of
/// `z - W`. So only that must be followed along the arc. It is the argument of z and that of `1 - W/z` where `|z| >
/// |W|`, and that of -W and of `1 - z/W` where `|z| < |W|`; the second of each keeps within a quarter turn. |z| grows
/// with t, so that there is at most one passage, at `t² = |W|² - 1`. There z/W, on the unit circle, gives both, and on
/// which side of the pole the arc passes: the one thing that is discrete.
///
/// # Errors
/// [`crate::Error::Undecided`] at the precision cap.
pub(super) fn about_start(datum: &Datum, half_turns: u32, turns: u32) -> Result<u32> {
    if turns == 0 {
        return Ok(0);
    }
    let attempt = |bits: usize| {
        let map = Map::by_intervals(datum, half_turns, bits)?.0;
        let swing = followed(&map)?;
        let up = |x: f64| if x == -PI { 2.0 } else { 0.0 };
        let [alpha, beta] = [datum.alpha, datum.beta].map(|x| formula!(Interval::pi(bits) * { up(x) } + { x }));
        let turned = formula!(-2.0 * (map.arc.theta + swing) - (beta - alpha));
        // The end's less the start's.
        let more = turned.over(&Interval::pi(bits).scale(2.0))?;
        let first = formula!({ 0.5 * f64::from(turns) } - 0.5 * more);
        let ends = [first.lower(), first.upper()].map(|x| x.approx());
        (ends[1] - ends[0] < 0.25).then(|| ends[0].midpoint(ends[1]).round().clamp(0.0, f64::from(turns)) as u32)
    };
    Ok(climb(datum, "the turns about the start", attempt)?.0)
}

type Complex = [Interval; 2];

fn times([a, b]: &Complex, [c, d]: &Complex) -> Complex {
    [formula!(a * c - b * d), formula!(a * d + b * c)]
}

fn conjugate([a, b]: &Complex) -> Complex {
    [a.clone(), -b]
}

fn square([a, b]: &Complex) -> Interval {
    &a.square() + &b.square()
}

/// The argument, between -π and π, to about as many digits as doubles show; `None` where its side is open.
///
/// With a guess g, turned back by which the number is `x + iy`, x > 0, it is g and at most `|y/x|` more or less.
fn argument(number: &Complex) -> Option<Interval> {
    let ([a, b], bits) = (number, number[0].bits());
    let side = match a.sign() {
        Some(Greater) => 0.0,
        _ if b.sign()? == Less => -1.0,
        _ if b.sign()? == Greater => 1.0,
        _ => return None,
    };
    // Both may lie beyond the range of doubles.
    let most = -a.magnitude().max(b.magnitude())?;
    let [x, y] = [a, b].map(|part| (part * &Interval::power_of_two(most, bits)).approx());
    let mut guess = y.atan2(x);
    if side * guess < 0.0 {
        guess = -guess;
    }
    let [x, y] = times(number, &polar(&Interval::new(1.0, bits), &Interval::new(-guess, bits)));
    Some(y.over(&x).filter(|_| x.sign() == Some(Greater))?.size().plus(guess))
}

/// By how much the argument of `z - W` changes along the arc.
///
/// Everything is seen turned by t0: the arc begins at `(1 + i t1) e^(iθ)`, ends at `(1 + i t2) e^(-iθ)` and has the
/// chord `c = 2(X - iP)`. From `(1 + w)/(1 - w) = m (z - z1)/(z2 - z)` follow `W = a/b`, `a = m z1 - z2`, `b = m - 1`,
/// `b z1 - a = c`, `b z2 - a = m c`.
fn followed(map: &Map<Interval>) -> Option<Interval> {
    let (Arc { theta, sin, p, t0, t1, .. }, bits) = (&map.arc, map.arc.theta.bits());
    let one = Interval::new(1.0, bits);
    let t2 = t0 + theta;
    let place = |t: &Interval, back: &Interval| times(&[one.clone(), t.clone()], &polar(&one, back));
    let [first, last] = [place(t1, theta), place(&t2, &-theta)];
    let m = polar(&map.rho, &map.lambda);
    let ([x, y], b) = (times(&m, &first), [&m[0] - &one, m[1].clone()]);
    let a = [&x - &last[0], &y - &last[1]];
    let chord = [formula!(2.0 * (t0 * sin)), formula!(-2.0 * p)];
    let away = [chord.clone(), times(&m, &chord)];
    let within = |t: &Interval| Some(formula!(square(&a) - square(&b) * (1.0 + t.square())).sign()? == Greater);
    let inside = |i: usize| argument(&times(&away[i], &conjugate(&a)).map(|x| -&x));
    let outside = |i: usize, z: &Complex| argument(&times(&away[i], &conjugate(&times(&b, z))));
    let winding = |t: &Interval| Some(&argument(&[one.clone(), t.clone()])? - t);
    match (within(t1)?, within(&t2)?) {
        (true, true) => Some(&inside(1)? - &inside(0)?),
        (false, _) => Some(&(&winding(&t2)? - &winding(t1)?) + &(&outside(1, &last)? - &outside(0, &first)?)),
        (true, false) => {
            let passage = square(&a).over(&square(&b))?.plus(-1.0).sqrt()?;
            // The argument of 1 - z/W less that of 1 - W/z.
            let z = place(&passage, &(t0 - &passage));
            let step = argument(&times(&times(&conjugate(&a), &b), &z).map(|x| -&x))?;
            let [by_pole, by_turning] = [&outside(1, &last)? - &inside(0)?, &winding(&t2)? - &winding(&passage)?];
            Some(formula!(step + by_pole + by_turning))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::numbers::Numbers;
    use super::*;
    use crate::noise::Noise;
    use std::f64::consts::TAU;

    /// The turns about the start as doubles see them: both halves have the same direction where they meet.
    fn by_doubles(datum: &Datum, half_turns: u32, turns: u32) -> f64 {
        let numbers = Numbers::by_intervals(datum, half_turns).unwrap().0.0;
        let meet = numbers.halves.map(|half| half.direction(1.0));
        let up = |x: f64| if x == -PI { 1.0 } else { 0.0 };
        let difference = (meet[1] - meet[0]) / TAU - up(datum.alpha) + up(datum.beta);
        0.5 * (f64::from(turns) + difference)
    }

    #[test]
    fn turns_are_those_of_the_followed_direction() {
        let mut noise = Noise(23);
        let mut seen = [0; 3];
        for round in 0..1500 {
            let [alpha, beta] =
                [0, 1].map(|i| if round % 7 == 0 && i == round % 2 { -PI } else { PI * noise.signed() });
            let wide = 10f64.powf(2.0 * noise.signed());
            let [k1, k2] = [noise.signed(), noise.signed()].map(|x| wide * x);
            let (datum, turns) = (Datum { alpha, beta, k1, k2 }, 1 + round as u32 % 5);
            let half_turns = turns + [alpha, beta].iter().filter(|x| **x == -PI).count() as u32;
            if k1 >= k2 || datum.q(200).sign() != Some(Less) {
                continue;
            }
            let first = about_start(&datum, half_turns, turns).unwrap();
            let about = by_doubles(&datum, half_turns, turns);
            assert!((f64::from(first) - about).abs() < 1e-6, "{datum:?} {turns}: {first} {about}");
            seen[usize::from(first > 0) + usize::from(first == turns)] += 1;
        }
        assert!(seen.iter().all(|n| *n > 10), "{seen:?}");
    }

    /// Towards the last double before the arc passes the pole on the other side.
    #[test]
    fn turns_are_proved_beside_the_pole() {
        let mut noise = Noise(5);
        let (mut found, mut misled) = (0, 0);
        for _ in 0..60 {
            let [alpha, beta] = [PI * noise.signed(), PI * noise.signed()];
            let (k1, mut low, mut high) = (-3.0 * noise.next(), 0.01, 100.0);
            let at = |k2: f64| Datum { alpha, beta, k1, k2 };
            let first = |k2: f64| match at(k2).q(200).sign() {
                Some(Less) => about_start(&at(k2), 1, 1).ok(),
                _ => None,
            };
            let (Some(one), Some(other)) = (first(low), first(high)) else { continue };
            if one == other {
                continue;
            }
            while high.next_down() > low {
                let middle = 0.5 * (low + high);
                let Some(turns) = first(middle) else { break };
                if turns == one { low = middle } else { high = middle }
            }
            if high.next_down() > low {
                continue;
            }
            found += 1;
            for (k2, turns) in [(low, one), (high, other)] {
                misled += usize::from((f64::from(turns) - by_doubles(&at(k2), 1, 1)).abs() > 0.5);
            }
        }
        assert!(found > 0 && misled > 0, "{found} {misled}");
    }
}
