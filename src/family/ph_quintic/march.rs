//! All solutions with A, B > 0, counted with proof: where the two concave curves of [`super::curves`] meet.
//!
//! Let `D = ζ0 - ζ1` be their distance. Between a and b, L apart in x, two certificates need values and slopes at the
//! ends only:
//! - **No meeting.** A concave function lies above its chord, and below it by no more than `L/4` times the fall of its
//!   slope: so does the tent of its two tangents. If D > 0 at both ends, ζ0 above its chord and ζ1 below its tent leave
//!   `D > 0` while `min(D(a), D(b)) > (s1(b) - s1(a)) L/4`; likewise with the curves exchanged.
//! - **At most one.** `D' = s1 - s0`, and both s increase: `s1(a) > s0(b)` makes D rise throughout, `s0(a) > s1(b)`
//!   fall. Then the signs of D at the ends decide whether there is one.
//!
//! Before the first and behind the last knot the curves are bounded by their limits: A falls and B rises along both.
//! Intervals with neither certificate are halved. ([`super::narrow`] has two more, for φ0 + φ1 close to π, and
//! [`super::fork`] those for where solutions merge.) Distances are bounded by `|ln r| >= 2 |r - 1|/(r + 1)`.
//!
//! A double meeting would need an algebraic relation between sines of the angles and the curvatures. By the theorem of
//! Lindemann and Weierstrass the numbers `e^{iφ0/2}`, `e^{iφ1/2}` of doubles with irrational ratio are algebraically
//! independent, and for a rational ratio one of them is still transcendental: so the relation would have to hold for
//! all angles at once. None such is known; one would end as undecided at the precision cap.

use super::curves::Curves;
use super::knot::{Knot, length};
use super::{cuts, fork, narrow};
use crate::num::{Real, Verdict, formula};
use crate::steps::step as count;
use std::cmp::Ordering::{self, Greater};
use std::f64::consts::LN_2;

/// A solution: t and Z, enclosed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root<N> {
    pub t: N,
    pub z: N,
}

/// The equations of a datum, with a copy in doubles for guesses.
pub(super) struct March<N> {
    pub curves: Curves<N>,
    fast: Curves<f64>,
}

/// How near two knots may come before more precision is asked for, as a power of two.
fn nearest(bits: usize) -> i32 {
    if bits <= 53 { -16 } else { -(bits as i32) / 2 }
}

/// Newton steps from a guess that may be poor where doubles have no range.
const MOST_STEPS: usize = 200;

/// Looks at intervals in one attempt, about two for each knot: the most that were seen to be needed is 60 knots, beside
/// a fold, and intervals also reach further.
fn most_looks(bits: usize) -> usize {
    if bits <= 53 { 160 } else { 400 }
}

impl<N: Real> March<N> {
    pub(super) fn new(curves: Curves<N>) -> March<N> {
        let fast = curves.approx();
        March { curves, fast }
    }

    fn bits(&self) -> usize {
        self.curves.cos.bits()
    }

    /// Both curves at t.
    pub(super) fn knot(&self, t: N) -> Option<Knot<N>> {
        count();
        let (near, exact) = (self.fast.at(&t.approx()), self.curves.at(&t));
        let side = |i: usize| {
            let z = exact[i].height(&self.curves.right[i], near[i].guess(self.fast.right[i]))?;
            let s = exact[i].slope_at(&z)?;
            Some((z, s))
        };
        let ((z0, s0), (z1, s1)) = (side(0)?, side(1)?);
        let gap = formula!(2.0 * (z0 - z1)).over(&z0.add(&z1))?;
        Some(Knot { t, z: [z0, z1], s: [s0, s1], gap })
    }

    /// Heights of both curves at t = 0; the first is `None` when κ0 = 0, for then it has no limit.
    fn limits(curves: &Curves<N>, fast: &Curves<f64>) -> Option<(Option<N>, N)> {
        let zero = N::of(0.0, curves.cos.bits());
        let (near, exact) = (fast.at(&0.0), curves.at(&zero));
        let height = |i: usize| exact[i].height(&curves.right[i], near[i].guess(fast.right[i]));
        Some((if fast.bend[0] > 0.0 { Some(height(0)?) } else { None }, height(1)?))
    }

    /// All solutions, by increasing t; `None` when the precision does not suffice.
    pub(super) fn roots(&self) -> Option<Vec<Root<N>>> {
        let mut roots = Vec::new();
        for (a, b) in self.brackets()? {
            roots.push(self.enclose(&a, &b)?);
        }
        Some(roots)
    }

    /// How many solutions there are, each between two knots.
    pub(super) fn brackets(&self) -> Option<Vec<(Knot<N>, Knot<N>)>> {
        let mut brackets = Vec::new();
        let (mut a, last) = (self.first()?, self.last()?);
        let mut waiting = vec![last];
        for _ in 0..most_looks(self.bits()) {
            let Some(b) = waiting.last() else { return Some(brackets) };
            let proved = meets(&a, b).decided().or_else(|| narrow::meets(&self.curves, &a, b).decided());
            match proved.map_or_else(|| fork::meets(&self.curves, &a, b), Ok) {
                Ok(once) => {
                    let b = waiting.pop()?;
                    if once {
                        brackets.push((a, b.clone()));
                    }
                    a = b;
                }
                Err(open) => {
                    let cuts = if N::ORDERS == 0 {
                        cuts::cuts(&self.curves, |t| self.knot(t), [&a, b], open)?
                    } else {
                        vec![]
                    };
                    if !cuts.is_empty() {
                        waiting.extend(cuts.into_iter().rev());
                        continue;
                    }
                    let knot = self.knot(between(&a.t, &b.t)?)?;
                    let vague = N::ORDERS > 0 && knot.gap.certain_sign(0.0).is_none();
                    let knot = if vague { self.aside(&a, b)? } else { knot };
                    waiting.push(knot);
                }
            }
        }
        None
    }

    /// A knot elsewhere between two, for data that vary, some of which have a solution where halving led.
    pub(super) fn aside(&self, a: &Knot<N>, b: &Knot<N>) -> Option<Knot<N>> {
        let (low, ratio) = (a.t.approx(), b.t.approx() / a.t.approx());
        let knot = |share: f64| self.knot(N::of(low * ratio.powf(share), self.bits()));
        [0.3, 0.7, 0.15, 0.85, 0.05, 0.95]
            .into_iter()
            .find_map(|share| knot(share).filter(|k| k.gap.certain_sign(0.0).is_some()))
    }

    /// A knot before which there is no solution.
    fn first(&self) -> Option<Knot<N>> {
        let (low, high) = March::limits(&self.curves, &self.fast)?;
        self.outermost(-1, |knot| {
            let [z0, z1] = &knot.z;
            formula!(z0 - high).is_positive() || low.as_ref().is_some_and(|low| formula!(z1 - low).is_positive())
        })
    }

    /// A knot behind which there is none: the same for b² = t² Z.
    fn last(&self) -> Option<Knot<N>> {
        let (low, high) = March::limits(&self.curves.reversed(), &self.fast.reversed())?;
        self.outermost(1, |knot| {
            let square = formula!(knot.t * knot.t);
            let [y0, y1] = [formula!(square * knot.z[0]), formula!(square * knot.z[1])];
            formula!(y1 - high).is_positive() || low.as_ref().is_some_and(|low| formula!(y0 - low).is_positive())
        })
    }

    fn outermost(&self, side: i32, clear: impl Fn(&Knot<N>) -> bool) -> Option<Knot<N>> {
        let knot = |exponent: i32| self.knot(N::power_of_two(side * exponent, self.bits()));
        // t, in scaled units, is a product of few powers of the data: below 2^1100 each, but doubles square it.
        let last = if self.bits() <= 53 { 9 } else { 13 };
        (2..=last).find_map(|i| knot(1 << i).filter(&clear))
    }

    /// The one solution between two knots.
    fn enclose(&self, a: &Knot<N>, b: &Knot<N>) -> Option<Root<N>> {
        let side = a.gap.certain_sign(0.0)?;
        let (mut low, mut high) = (a.t.clone(), b.t.clone());
        let within = |t: &N, low: &N, high: &N| formula!(t - low).is_positive() && formula!(high - t).is_positive();
        let guess = Some(self.guess(a, b)).filter(|t| t.is_normal()).map(|t| N::of(t, self.bits()));
        let mut knot =
            self.knot(guess.filter(|t| within(t, &low, &high)).map_or_else(|| middle(&low, &high), Some)?)?;
        let step = |knot: &Knot<N>| knot.gap.over(&formula!(knot.s[1] - knot.s[0]));
        let bits = self.bits() as i32;
        let enough = N::power_of_two(bits / 4 * 3, self.bits());
        for _ in 0..MOST_STEPS {
            let moved = step(&knot)?;
            if formula!(moved * enough).most() < 1.0 {
                break;
            }
            match knot.gap.certain_sign(0.0) {
                Some(sign) if sign == side => low = knot.t.clone(),
                Some(_) => high = knot.t.clone(),
                None => break,
            }
            // Near the solution in t; far from it in ln t, where both curves are nearly straight and D is no longer its
            // bound.
            let newton = if moved.most() < 0.25 {
                Some(formula!(knot.t - knot.t * moved).middle())
            } else {
                let turn = formula!(knot.s[0] - knot.s[1]).approx();
                times_exp(&knot.t, (knot.z[0].ln() - knot.z[1].ln()) / turn)
            };
            knot = self.knot(newton.filter(|t| within(t, &low, &high)).map_or_else(|| middle(&low, &high), Some)?)?;
        }
        let inside = |t: &N| within(t, &a.t, &b.t);
        // Twice as far as the error of D may move the solution; the signs decide what is needed.
        let moved = step(&knot)?;
        // It may be too small for a double.
        let scaled = |power: i32| moved.mul(&N::power_of_two(power, self.bits())).most();
        let power = (0..bits).step_by(500).find(|power| scaled(*power) > 2f64.powi(-500)).unwrap_or(bits);
        let most = (2.0 * scaled(power)).max(2f64.powi(4 - bits + power));
        let mut reach = N::power_of_two(-power, self.bits()).times(most);
        for _ in 0..4 {
            let delta = formula!(knot.t * reach);
            let (left, right) = (formula!(knot.t - delta).middle(), formula!(knot.t + delta).middle());
            if !(inside(&left) && inside(&right)) {
                return None;
            }
            let (left, right) = (self.knot(left)?, self.knot(right)?);
            let sign = |knot: &Knot<N>| knot.gap.certain_sign(0.0);
            if sign(&left) == Some(side) && sign(&right) == Some(side.reverse()) {
                // Z falls along both curves.
                return Some(Root { t: left.t.union(&right.t), z: left.z[0].union(&right.z[0]) });
            }
            reach = reach.times(16.0);
        }
        None
    }

    /// About where D is 0: Newton's method for D as a function of ln t, kept between the knots.
    pub(super) fn guess(&self, a: &Knot<N>, b: &Knot<N>) -> f64 {
        let (mut low, mut high) = (a.t.approx(), b.t.approx());
        let side = a.gap.approx() > 0.0;
        let mut t = (low * high).sqrt();
        for _ in 0..60 {
            let cubics = self.fast.at(&t);
            let z = [0, 1].map(|i| cubics[i].guess(self.fast.right[i]));
            let gap = (z[0] / z[1]).ln();
            if (gap > 0.0) == side {
                low = t;
            } else {
                high = t;
            }
            let newton = t * (gap / (cubics[0].slope(z[0]) - cubics[1].slope(z[1]))).exp();
            let next = if newton > low && newton < high { newton } else { (low * high).sqrt() };
            let moved = (next - t).abs();
            t = next;
            if moved <= t * 2f64.powi(-50) {
                break;
            }
        }
        t
    }
}

/// Whether the curves meet, and then once, or do not between two knots, when a certificate proves it.
pub(super) fn meets<N: Real>(a: &Knot<N>, b: &Knot<N>) -> Verdict {
    let (Some(at_a), Some(at_b)) = (a.gap.certain_sign(0.0), b.gap.certain_sign(0.0)) else {
        return Verdict::Undecided;
    };
    if at_a == at_b {
        // The lower curve's tent.
        let lower = usize::from(at_a == Greater);
        let reach = formula!((b.s[lower] - a.s[lower]) * { 0.25 * length(&a.t, &b.t) });
        let apart = |gap: &N| if at_a == Greater { gap.sub(&reach) } else { formula!(-(gap + reach)) };
        if apart(&a.gap).is_positive() && apart(&b.gap).is_positive() {
            return Verdict::No;
        }
    }
    let monotone = formula!(a.s[1] - b.s[0]).is_positive() || formula!(a.s[0] - b.s[1]).is_positive();
    if monotone { Verdict::of(at_a != at_b && at_a != Ordering::Equal) } else { Verdict::Undecided }
}

/// `t exp(x)`, about; `None` when x is too large or no number.
fn times_exp<N: Real>(t: &N, x: f64) -> Option<N> {
    let exponent = (x / LN_2).round();
    let rest = (x - exponent * LN_2).exp();
    (exponent.abs() < 2f64.powi(14))
        .then(|| formula!(t * N::power_of_two(exponent as i32, t.bits()) * { rest }).middle())
}

/// The middle of two in ln t, whatever their sizes.
fn middle<N: Real>(low: &N, high: &N) -> Option<N> {
    Some(low.sqrt()?.mul(&high.sqrt()?).middle())
}

/// A point between two, not in their middle, where symmetric data have solutions; `None` when they are too close.
fn between<N: Real>(a: &N, b: &N) -> Option<N> {
    let (low, high) = (a.approx(), b.approx());
    if !(low.is_normal() && high.is_normal()) && b.ln() - a.ln() > 0.2 {
        return times_exp(a, 0.493 * (b.ln() - a.ln()));
    }
    if high > 1.2 * low {
        let t = low.sqrt() * high.sqrt() * 1.037;
        return Some(N::of(t, a.bits()));
    }
    let apart = formula!(b - a);
    formula!(apart - a * N::power_of_two(nearest(a.bits()), a.bits()))
        .is_positive()
        .then(|| formula!(a + 0.469 * apart).middle())
}
