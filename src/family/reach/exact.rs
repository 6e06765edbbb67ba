//! The top of the ladder: the truth of one datum in intervals of growing precision.

use super::angle::{ExactAngle, factors};
use super::poly::{BERNSTEIN, LEAST_M, MONOTONE_M, coefficients, ph_m, ph_sides};
use super::{EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::num::Interval;
use crate::num::bernstein::{MOST_HALVINGS, positive};
use std::cmp::Ordering::{Equal, Greater, Less};

/// The segment of a case: `u`, `m > 0`.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    pub u: Interval,
    pub m: Interval,
}

impl Shape {
    /// q.
    pub fn q(&self, angle: &ExactAngle) -> Option<Interval> {
        angle.length.over(&self.u)
    }
}

/// One attempt at one case (0 or 1): its bits and its segment; `None` when something is undecided at this precision.
pub(super) fn judge(kind: Kind, [theta, xi, eta]: [f64; 3], case: usize, bits: usize) -> Option<(u8, Option<Shape>)> {
    let angle = ExactAngle::cached(kind, theta, bits)?;
    let shape = shape(kind, &angle, xi, eta, case)?;
    let flags = match &shape {
        Some(shape) => judge_shape(kind, &angle, shape)?,
        None => 0,
    };
    Some((flags, shape))
}

/// The segment with this end point, if there is one.
fn shape(kind: Kind, angle: &ExactAngle, xi: f64, eta: f64, case: usize) -> Option<Option<Shape>> {
    let bits = angle.sin.bits();
    let h = &angle.sin.scale(xi) - &angle.cos.scale(eta);
    let eta = Interval::new(eta, bits);
    let (a, b) = if case == 0 { (eta, h) } else { (h, eta) };
    if a.sign()? != Greater {
        return Some(None);
    }
    let (to_alpha, to_beta) = factors(kind);
    let square = angle.length.square();
    let (alpha, beta) = (a.scale(to_alpha).over(&square)?, b.scale(to_beta).over(&square)?);
    let shape = match kind {
        Kind::Cubic => {
            let u = Interval::new(1.0, bits).over(&alpha)?;
            let m = (&beta * &u.square()).plus(-1.0);
            Shape { u, m }
        }
        Kind::Ph => match ph_root(&alpha, &beta, &angle.g)? {
            Some(u) => Shape { m: ph_m(&alpha, &angle.g, &u), u },
            None => return Some(None),
        },
    };
    Some((shape.m.sign()? == Greater).then_some(shape))
}

/// The four levels of an existing segment.
pub(super) fn judge_shape(kind: Kind, angle: &ExactAngle, shape: &Shape) -> Option<u8> {
    let c = coefficients(kind, &shape.m, &shape.u, &angle.g, -1.0);
    if c[0].sign()? == Less {
        return Some(EXISTS);
    }
    if shape.m.compare(&least_drawn_m(kind, shape.m.bits())?)? != Less {
        return Some(EXISTS | EXACT | THEOREM | PAPER);
    }
    let signs = [c[1].sign(), c[2].sign(), c[3].sign()];
    let theorem = if signs.contains(&Some(Less)) {
        false
    } else if signs.iter().all(Option::is_some) {
        true
    } else {
        return None;
    };
    let mut bernstein = c;
    for (c, factor) in bernstein.iter_mut().zip(BERNSTEIN) {
        *c = c.scale(factor);
    }
    let exact = theorem || positive(&bernstein, 0.0, 0.0, MOST_HALVINGS)?;
    Some(EXISTS | if exact { EXACT } else { 0 } | if theorem { THEOREM } else { 0 })
}

/// m*: `2(√6 - 1)/5` or `2(√30 - 3)/7`.
fn least_drawn_m(kind: Kind, bits: usize) -> Option<Interval> {
    let (under, less, over) = match kind {
        Kind::Cubic => (6.0, -1.0, 5.0),
        Kind::Ph => (30.0, -3.0, 7.0),
    };
    Interval::new(under, bits).sqrt()?.plus(less).scale(2.0).over(&Interval::new(over, bits))
}

/// The only u with m above [`MONOTONE_M`] where G is 0; `Some(None)` when there is none with `m > 0`.
fn ph_root(alpha: &Interval, beta: &Interval, g: &Interval) -> Option<Option<Interval>> {
    let bits = alpha.bits();
    let value = |u: &Interval| {
        let (left, right) = ph_sides(beta, &ph_m(alpha, g, u), u);
        &left - &right
    };
    // αu² - 24gu = 3 + LEAST_M
    let twelve = g.scale(12.0);
    let under = &twelve.square() + &alpha.scale(3.0 + LEAST_M);
    let from = (&twelve + &under.sqrt()?).over(alpha)?.middle();
    let start = ph_m(alpha, g, &from);
    if start.plus(-MONOTONE_M).sign()? != Greater || start.sign()? != Less {
        return None;
    }
    if value(&from).sign()? != Less {
        return Some(None);
    }
    let (mut low, mut high) = (from.clone(), from.scale(2.0));
    let mut power = 1;
    while value(&high).sign()? != Greater {
        power *= 2;
        if power > 1 << 16 {
            return None;
        }
        low = high;
        high = &from * &Interval::power_of_two(power, bits);
    }
    // Newton's method for G/u³, nearly straight in u, kept inside the bracket.
    let inside = |x: &Interval, low: &Interval, high: &Interval| x.compare(low) == Some(Greater) && x.compare(high) == Some(Less);
    let mut u = (&low + &high).scale(0.5).middle();
    let tiny = Interval::power_of_two(-(bits as isize), bits);
    for _ in 0..4 * bits {
        let g_u = value(&u);
        let Some(sign) = g_u.sign().filter(|s| *s != Equal) else { break };
        if sign == Less {
            low = u.clone();
        } else {
            high = u.clone();
        }
        let step = slope(alpha, beta, g, &u, &g_u);
        let newton = (&u * &g_u).over(&step).map(|step| (&u - &step).middle());
        let next = newton.filter(|n| inside(n, &low, &high)).unwrap_or_else(|| (&low + &high).scale(0.5).middle());
        let (moved, limit) = (&next - &u, &u * &tiny);
        u = next;
        if moved.compare(&limit) != Some(Greater) && (-&moved).compare(&limit) != Some(Greater) {
            break;
        }
    }
    enclose(&u, &from, value)
}

/// `u G' - 3G`, the slope of G/u³ times u⁴.
fn slope(alpha: &Interval, beta: &Interval, g: &Interval, u: &Interval, value: &Interval) -> Interval {
    let m = ph_m(alpha, g, u);
    let (_, right) = ph_sides(beta, &m, u);
    let m_slope = &u.scale(2.0) * &(&(alpha * u) - &g.scale(12.0));
    let direct = &(&m.plus(3.0) * u).scale(2.0) - &right.scale(3.0);
    let through_m = &(&u.scale(2.0) + &m.scale(6.0).plus(3.0)) * &m_slope;
    &(&direct + &through_m) - &value.scale(3.0)
}

/// Proves the root around a guess: certain signs at `u(1 - δ)` and `u(1 + δ)`, with the least δ that works.
fn enclose(guess: &Interval, from: &Interval, value: impl Fn(&Interval) -> Interval) -> Option<Option<Interval>> {
    let bits = guess.bits();
    let mut exponent = -(bits as isize) + 12;
    while exponent < -(bits as isize) / 4 {
        let delta = guess * &Interval::power_of_two(exponent, bits);
        let (low, high) = ((guess - &delta).lower(), (guess + &delta).upper());
        if value(&low).sign() == Some(Less) && value(&high).sign() == Some(Greater) {
            return (low.compare(from)? != Less).then(|| Some(low.union(&high)));
        }
        exponent += 10 + (bits / 64) as isize;
    }
    None
}
