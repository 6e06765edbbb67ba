//! The truth of one datum: in two doubles, and in intervals of growing precision at the top of the ladder.

use super::angle::{ExactAngle, factors};
use super::poly::{BERNSTEIN, LEAST_M, MONOTONE_M, coefficients, ph_m, ph_sides};
use super::{EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::num::bernstein::{MOST_HALVINGS, positive};
use crate::num::roots::{Curve, bracketed, enclose, find, near};
use crate::num::{Interval, Real, Twin, formula};
use std::cmp::Ordering::{Greater, Less};

/// The segment of a case: `u`, `m > 0`.
#[derive(Debug, Clone)]
pub(super) struct SegmentShape<N> {
    pub u: N,
    pub m: N,
}

impl<N: Real> SegmentShape<N> {
    /// q.
    pub(super) fn q(&self, angle: &ExactAngle<N>) -> Option<N> {
        angle.length.over(&self.u)
    }
}

/// One attempt at one case (0 or 1): its bits and its segment; `None` when something is undecided at this precision.
pub(super) fn judge<N: Rooted>(
    kind: Kind,
    angle: &ExactAngle<N>,
    end: [f64; 2],
    case: usize,
) -> Option<(u8, Option<SegmentShape<N>>)> {
    let shape = shape(kind, angle, end, case)?;
    let flags = match &shape {
        Some(shape) => judge_shape(kind, angle, shape)?,
        None => 0,
    };
    Some((flags, shape))
}

/// The segment with this end point, if there is one.
fn shape<N: Rooted>(
    kind: Kind,
    angle: &ExactAngle<N>,
    [xi, eta]: [f64; 2],
    case: usize,
) -> Option<Option<SegmentShape<N>>> {
    let bits = angle.sin.bits();
    let h = formula!(angle.sin * { xi } - angle.cos * { eta });
    let eta = N::of(eta, bits);
    let (a, b) = if case == 0 { (eta, h) } else { (h, eta) };
    if a.certain_sign(0.0)? != Greater {
        return Some(None);
    }
    let (to_alpha, to_beta) = factors(kind);
    let square = formula!(angle.length * angle.length);
    let (alpha, beta) = (a.times(to_alpha).over(&square)?, b.times(to_beta).over(&square)?);
    let shape = match kind {
        Kind::Cubic => {
            let u = N::of(1.0, bits).over(&alpha)?;
            let m = formula!(beta * (u * u) - 1.0);
            SegmentShape { u, m }
        }
        Kind::Ph => match ph_root(&alpha, &beta, &angle.g)? {
            Some(u) => SegmentShape { m: ph_m(&alpha, &angle.g, &u), u },
            None => return Some(None),
        },
    };
    Some((shape.m.certain_sign(0.0)? == Greater).then_some(shape))
}

/// The four levels of an existing segment.
pub(super) fn judge_shape<N: Real>(kind: Kind, angle: &ExactAngle<N>, shape: &SegmentShape<N>) -> Option<u8> {
    let c = coefficients(kind, &shape.m, &shape.u, &angle.g, -1.0);
    let sign = |x: &N| x.certain_sign(0.0);
    if sign(&c[0])? == Less {
        return Some(EXISTS);
    }
    if sign(&shape.m.sub(&least_drawn_m(kind, shape.m.bits())?))? != Less {
        return Some(EXISTS | EXACT | THEOREM | PAPER);
    }
    let signs = [sign(&c[1]), sign(&c[2]), sign(&c[3])];
    let theorem = if signs.contains(&Some(Less)) {
        false
    } else if signs.iter().all(Option::is_some) {
        true
    } else {
        return None;
    };
    let mut bernstein = c;
    for (c, factor) in bernstein.iter_mut().zip(BERNSTEIN) {
        *c = c.times(factor);
    }
    let exact = theorem || positive(&bernstein, 0.0, 0.0, MOST_HALVINGS).decided()?;
    Some(EXISTS | if exact { EXACT } else { 0 } | if theorem { THEOREM } else { 0 })
}

/// m*: `2(√6 - 1)/5` or `2(√30 - 3)/7`.
fn least_drawn_m<N: Real>(kind: Kind, bits: usize) -> Option<N> {
    let (under, less, over) = match kind {
        Kind::Cubic => (6.0, -1.0, 5.0),
        Kind::Ph => (30.0, -3.0, 7.0),
    };
    N::of(under, bits).sqrt()?.plus(less).times(2.0).over(&N::of(over, bits))
}

/// The only u with m above [`MONOTONE_M`] where G is 0; `Some(None)` when there is none with `m > 0`.
fn ph_root<N: Rooted>(alpha: &N, beta: &N, g: &N) -> Option<Option<N>> {
    let residual = Residual { alpha, beta, g };
    // αu² - 24gu = 3 + LEAST_M
    let twelve = g.times(12.0);
    let under = formula!(twelve * twelve + alpha * { 3.0 + LEAST_M });
    let from = twelve.add(&under.sqrt()?).over(alpha)?.middle();
    let start = ph_m(alpha, g, &from);
    let sign = |x: &N| x.certain_sign(0.0);
    if sign(&start.plus(-MONOTONE_M))? != Greater || sign(&start)? != Less {
        return None;
    }
    if sign(&residual.value(&from))? != Less {
        return Some(None);
    }
    let root = N::root(&residual, &from)?;
    (sign(&formula!(root - from))? == Greater).then_some(Some(root))
}

/// Numbers that find the root of G above a place where G is negative.
pub(super) trait Rooted: Real {
    fn root(residual: &Residual<'_, Self>, from: &Self) -> Option<Self>;
}

impl Rooted for Twin {
    fn root(residual: &Residual<'_, Twin>, from: &Twin) -> Option<Twin> {
        let (low, guess) = (from.approx(), residual.about());
        let high = (1..200).map(|i| low * 2f64.powi(i)).find(|u| guess(*u) > 0.0)?;
        near(|u| Some(residual.value_and_slope(u)), find(guess, low, high, low * f64::EPSILON))
    }
}

impl Rooted for Interval {
    fn root(residual: &Residual<'_, Interval>, from: &Interval) -> Option<Interval> {
        let (mut low, mut high) = (from.clone(), from.scale(2.0));
        let mut power = 1;
        while residual.value(&high).sign()? != Greater {
            power *= 2;
            if power > 1 << 16 {
                return None;
            }
            low = high;
            high = from * &Interval::power_of_two(power, from.bits());
        }
        enclose(residual, &bracketed(&low, &high, residual)?)
    }
}

/// G/u³, nearly straight in u.
pub(super) struct Residual<'i, N> {
    alpha: &'i N,
    beta: &'i N,
    g: &'i N,
}

impl<N: Real> Residual<'_, N> {
    /// G.
    fn value(&self, u: &N) -> N {
        let (left, right) = ph_sides(self.beta, &ph_m(self.alpha, self.g, u), u);
        formula!(left - right)
    }

    /// `uG` and `uG' - 3G`: value and slope, both times u⁴, which changes neither signs nor Newton's steps.
    fn value_and_slope(&self, u: &N) -> (N, N) {
        let value = self.value(u);
        let m = ph_m(self.alpha, self.g, u);
        let (_, right) = ph_sides(self.beta, &m, u);
        let m_slope = formula!(2.0 * u * (self.alpha * u - 12.0 * self.g));
        let direct = formula!(2.0 * ((m + 3.0) * u) - 3.0 * right);
        let through_m = formula!((2.0 * u + (6.0 * m + 3.0)) * m_slope);
        (u.mul(&value), formula!(direct + through_m - 3.0 * value))
    }

    /// G/u³ in doubles.
    fn about(&self) -> impl Fn(f64) -> f64 {
        let (alpha, beta, g) = (self.alpha.approx(), self.beta.approx(), self.g.approx());
        move |u| {
            let (left, right) = ph_sides(&beta, &ph_m(&alpha, &g, &u), &u);
            (left - right) / u.powi(3)
        }
    }
}

impl Curve for Residual<'_, Interval> {
    fn at(&self, u: &Interval) -> Option<(Interval, Interval)> {
        Some(self.value_and_slope(u))
    }

    fn guess(&self, u: f64) -> f64 {
        self.about()(u)
    }
}
