//! The top of the ladder: the truth of one datum in intervals of growing precision.

use super::angle::{ExactAngle, factors};
use super::poly::{BERNSTEIN, LEAST_M, MONOTONE_M, coefficients, ph_m, ph_sides};
use super::{EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::num::Interval;
use crate::num::bernstein::{MOST_HALVINGS, positive};
use crate::num::roots::{Curve, bracketed, enclose};
use std::cmp::Ordering::{Greater, Less};

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
    let residual = Residual { alpha, beta, g };
    // αu² - 24gu = 3 + LEAST_M
    let twelve = g.scale(12.0);
    let under = &twelve.square() + &alpha.scale(3.0 + LEAST_M);
    let from = (&twelve + &under.sqrt()?).over(alpha)?.middle();
    let start = ph_m(alpha, g, &from);
    if start.plus(-MONOTONE_M).sign()? != Greater || start.sign()? != Less {
        return None;
    }
    if residual.value(&from).sign()? != Less {
        return Some(None);
    }
    let (mut low, mut high) = (from.clone(), from.scale(2.0));
    let mut power = 1;
    while residual.value(&high).sign()? != Greater {
        power *= 2;
        if power > 1 << 16 {
            return None;
        }
        low = high;
        high = &from * &Interval::power_of_two(power, bits);
    }
    let root = enclose(&residual, &bracketed(&low, &high, &residual)?)?;
    (root.lower().compare(&from)? != Less).then_some(Some(root))
}

/// G/u³, nearly straight in u.
struct Residual<'i> {
    alpha: &'i Interval,
    beta: &'i Interval,
    g: &'i Interval,
}

impl Residual<'_> {
    /// G.
    fn value(&self, u: &Interval) -> Interval {
        let (left, right) = ph_sides(self.beta, &ph_m(self.alpha, self.g, u), u);
        &left - &right
    }
}

impl Curve for Residual<'_> {
    /// `uG` and `uG' - 3G`: value and slope, both times u⁴, which changes neither signs nor Newton's steps.
    fn at(&self, u: &Interval) -> Option<(Interval, Interval)> {
        let value = self.value(u);
        let m = ph_m(self.alpha, self.g, u);
        let (_, right) = ph_sides(self.beta, &m, u);
        let m_slope = &u.scale(2.0) * &(&(self.alpha * u) - &self.g.scale(12.0));
        let direct = &(&m.plus(3.0) * u).scale(2.0) - &right.scale(3.0);
        let through_m = &(&u.scale(2.0) + &m.scale(6.0).plus(3.0)) * &m_slope;
        Some((u * &value, &(&direct + &through_m) - &value.scale(3.0)))
    }

    fn guess(&self, u: f64) -> f64 {
        let m = ph_m(&self.alpha.approx(), &self.g.approx(), &u);
        let (left, right) = ph_sides(&self.beta.approx(), &m, &u);
        (left - right) / u.powi(3)
    }
}
