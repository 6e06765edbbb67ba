//! Quadratic polynomials in a few symbols that know how far they may be off: doubles for proofs over boxes.
//!
//! A ball forgets on what its number depends; of a number that varies over a box it holds every combination of the
//! extremes. Here the first two orders of that dependence are kept, so that terms cancel as they should and what is
//! lost is of the third order in the size of the box.
//!
//! Every operation adds to the error what its roundings and the terms that it cuts off can do. So a form holds the
//! truth at every place of the symbols, whatever was computed with it.

mod angle;
mod real;

use super::formula::formula;
use super::{Ball, Number, Real};

/// Unit roundoff.
pub(super) const UNIT: f64 = 0.5 * f64::EPSILON;
/// Covers the roundings of an error's own computation: fewer than 28 additions and products of numbers that are not
/// negative. With four symbols the longest chain is that of a product: nine additions for a size, and eleven more
/// operations.
pub(super) const GROW: f64 = 1.0 + 32.0 * UNIT;
/// More than underflow can do to a result and to the terms of its error: at most forty products round below the
/// normal range, each by less than 2^-1074.
pub(super) const TINY: f64 = f64::MIN_POSITIVE;

/// All functions of `K` symbols from -1 to 1 within `error` of `value + slope · symbols + bend · products of two
/// symbols`.
///
/// `H` is `K (K + 1) / 2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Form<const K: usize, const H: usize> {
    /// In the middle of the box.
    pub value: f64,
    /// Of each symbol.
    pub slope: [f64; K],
    /// Of each product of two, row by row: of x, y, z those of x², xy, xz, y², yz, z².
    pub bend: [f64; H],
    /// At least 0.
    pub error: f64,
}

/// A form in two symbols.
pub(crate) type Quadratic = Form<2, 3>;

#[inline(always)]
fn sum<const N: usize>(terms: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for term in terms {
        sum += term.abs();
    }
    sum
}

impl<const K: usize, const H: usize> Form<K, H> {
    /// Numbers of a ball, which may depend on the symbols in any way.
    #[inline(always)]
    pub(crate) fn ball(ball: Ball) -> Form<K, H> {
        const { assert!(2 * H == K * (K + 1)) };
        Form { value: ball.value, slope: [0.0; K], bend: [0.0; H], error: ball.error }
    }

    /// The numbers from `low` to `high`, as a linear function of one symbol.
    pub(crate) fn along([low, high]: [f64; 2], symbol: usize) -> Form<K, H> {
        // More than the roundings of both.
        let error = 2.0 * f64::EPSILON * (low.abs() + high.abs()) + TINY;
        let mut form = Form::ball(Ball { value: 0.5 * (low + high), error });
        form.slope[symbol] = 0.5 * (high - low);
        form
    }

    #[inline(always)]
    fn linear(&self) -> f64 {
        sum(&self.slope)
    }

    #[inline(always)]
    fn curved(&self) -> f64 {
        sum(&self.bend)
    }

    /// How far its numbers are from `value`, at most.
    #[inline(always)]
    fn around(&self) -> f64 {
        (self.linear() + self.curved() + self.error) * GROW
    }

    /// Every number it holds.
    pub(crate) fn range(&self) -> Ball {
        Ball { value: self.value, error: self.around() }
    }

    /// Less than every number it holds, and not by much where it is convex or nearly linear.
    #[inline(always)]
    pub(crate) fn low(&self) -> f64 {
        self.value - self.depth(1.0)
    }

    /// More than every number it holds, and not by much where it is concave or nearly linear.
    #[inline(always)]
    pub(crate) fn high(&self) -> f64 {
        self.value + self.depth(-1.0)
    }

    /// How far `sign` times the form falls below `sign` times its value, at most.
    #[inline(always)]
    fn depth(&self, sign: f64) -> f64 {
        // |2xy| <= x² + y²: half of a mixed term goes to each of its symbols.
        let mut own = [0.0; K];
        let mut at = 0;
        for i in 0..K {
            own[i] += sign * self.bend[at];
            at += 1;
            for j in i + 1..K {
                let half = 0.5 * self.bend[at].abs();
                own[i] -= half;
                own[j] -= half;
                at += 1;
            }
        }
        let mut fall = 0.0;
        for (slope, bend) in self.slope.iter().zip(own) {
            let slope = slope.abs();
            fall += if slope < 2.0 * bend { 0.25 * slope * (slope / bend) } else { slope - bend };
        }
        // The roundings are below a few units of what they belong to: each term of a fall passes at most 3 + 2 K + 3
        // operations.
        let size = self.value.abs() + self.linear() + self.curved();
        fall + (self.error + 32.0 * UNIT * size) * GROW + TINY
    }

    /// Off by so much more.
    #[inline(always)]
    pub(crate) fn off(mut self, error: f64) -> Form<K, H> {
        self.error = (self.error + error) * GROW;
        self
    }

    #[inline(always)]
    fn zip(&self, other: &Form<K, H>, f: impl Fn(f64, f64) -> f64) -> Form<K, H> {
        let mut sum = Form::ball(Ball { value: f(self.value, other.value), error: 0.0 });
        for i in 0..K {
            sum.slope[i] = f(self.slope[i], other.slope[i]);
        }
        for i in 0..H {
            sum.bend[i] = f(self.bend[i], other.bend[i]);
        }
        let size = sum.value.abs() + sum.linear() + sum.curved();
        Form { error: (self.error + other.error + UNIT * size) * GROW, ..sum }
    }

    /// `1 / self`: with a double r near `1 / value` and `self r = 1 + u` that is `r (1 - u + u² - u³ / (1 + u))`.
    pub(crate) fn inverse(&self) -> Option<Form<K, H>> {
        let r = 1.0 / self.value;
        let u = formula!(self * { r } - 1.0);
        let most = u.most();
        // Not for NaN either.
        (most < 1.0).then_some(())?;
        let rest = most * most * most / (1.0 - most) * GROW;
        Some(formula!(u * u - u + 1.0).off(rest).times(r))
    }
}

impl<const K: usize, const H: usize> Number for Form<K, H> {
    #[inline(always)]
    fn add(&self, other: &Form<K, H>) -> Form<K, H> {
        self.zip(other, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(&self, other: &Form<K, H>) -> Form<K, H> {
        self.zip(other, |a, b| a - b)
    }
    /// Each coefficient is a sum of at most four products, and all these together are terms of the product of the
    /// sizes: four roundings of each.
    #[inline(always)]
    fn mul(&self, other: &Form<K, H>) -> Form<K, H> {
        let (x, y) = (self.value, other.value);
        let (one, two) = (self.linear(), other.linear());
        let (own, its) = (self.curved(), other.curved());
        let (size, other_size) = (x.abs() + one + own, y.abs() + two + its);
        let cut = one * its + own * two + own * its;
        let inputs = self.error * (other_size + other.error) + other.error * size;
        let error = (cut + inputs + 4.0 * UNIT * (size * other_size)) * GROW + TINY;
        let mut product = Form::ball(Ball { value: x * y, error });
        for i in 0..K {
            product.slope[i] = x * other.slope[i] + self.slope[i] * y;
        }
        let mut at = 0;
        for i in 0..K {
            let (a, c) = (self.slope[i], other.slope[i]);
            product.bend[at] = x * other.bend[at] + a * c + self.bend[at] * y;
            at += 1;
            for j in i + 1..K {
                let mixed = a * other.slope[j] + self.slope[j] * c;
                product.bend[at] = x * other.bend[at] + mixed + self.bend[at] * y;
                at += 1;
            }
        }
        product
    }
    #[inline(always)]
    fn times(&self, k: f64) -> Form<K, H> {
        let size = self.value.abs() + self.linear() + self.curved();
        Form {
            value: self.value * k,
            slope: self.slope.map(|x| x * k),
            bend: self.bend.map(|x| x * k),
            // A small size times the unit could underflow, and a large k would then make more of that than TINY.
            error: (self.error * k.abs() + UNIT * (size * k.abs())) * GROW + TINY,
        }
    }
    #[inline(always)]
    fn plus(&self, k: f64) -> Form<K, H> {
        let value = self.value + k;
        Form { value, error: (self.error + value.abs() * UNIT) * GROW, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use crate::num::Interval;

    use crate::num::Certain;
    use std::cmp::Ordering;

    /// Of any size.
    fn scaled(noise: &mut Noise) -> f64 {
        noise.signed() * 2f64.powi((20.0 * noise.signed()) as i32)
    }

    /// What it says of one place, without its error.
    fn at(q: &Quadratic, x: f64, y: f64) -> Interval {
        let number = |x: f64| Interval::new(x, 300);
        let (x, y) = (number(x), number(y));
        let terms = [
            (q.slope[0], x.clone()),
            (q.slope[1], y.clone()),
            (q.bend[0], x.square()),
            (q.bend[1], &x * &y),
            (q.bend[2], y.square()),
        ];
        terms.iter().fold(number(q.value), |sum, (k, term)| &sum + &term.scale(*k))
    }

    /// Two ranges, wide or narrow, and random expressions of both: at every place the truth is held, and not by being
    /// far too large.
    #[test]
    fn every_operation_holds_the_truth() {
        let mut noise = Noise(1);
        let mut worst = [0.0f64; 6];
        let mut held = [0; 6];
        for round in 0..6000 {
            let width = 2f64.powi((40.0 * (noise.signed() - 1.0)) as i32);
            let ranges = [0, 1].map(|_| {
                let (middle, half) = (scaled(&mut noise), width * noise.signed().abs());
                [middle - half * middle.abs(), middle + half * middle.abs()]
            });
            let (a, b, c) = (Quadratic::along(ranges[0], 0), Quadratic::along(ranges[1], 1), scaled(&mut noise));
            let kind = round % 6;
            let product = a.mul(&b).plus(c);
            let found = match kind {
                0 => Some(product.mul(&product)),
                1 => Some(product.sub(&a.times(0.3)).mul(&b.add(&a))),
                2 => product.over(&b.plus(0.7)),
                3 => a.mul(&a).plus(1e-9).sqrt(),
                4 => a.mul(&a).add(&b).sqrt(),
                _ => a.add(&b).mul(&product).over(&a.times(3.0).sub(&b)),
            };
            let Some(found) = found else { continue };
            for _ in 0..4 {
                // Ends and middles too.
                let place = [0, 1].map(|_| (2.0 * noise.signed()).clamp(-1.0, 1.0));
                let [p, q] = [0, 1].map(|i| {
                    let [low, high] = ranges[i].map(|x| Interval::new(x, 300));
                    &low.scale(0.5 - 0.5 * place[i]) + &high.scale(0.5 + 0.5 * place[i])
                });
                let product = (&p * &q).plus(c);
                let truth = match kind {
                    0 => product.square(),
                    1 => &(&product - &p.scale(0.3)) * &(&q + &p),
                    2 => product.over(&q.plus(0.7)).expect("not zero"),
                    3 => p.square().plus(1e-9).sqrt().expect("positive"),
                    4 => (&p.square() + &q).sqrt().expect("positive"),
                    _ => (&(&p + &q) * &product).over(&(&p.scale(3.0) - &q)).expect("not zero"),
                };
                let off = (&truth - &at(&found, place[0], place[1])).approx().abs();
                assert!(off <= found.error, "{kind} {ranges:?} {place:?}: {found:?} is off by {off}");
                assert!(
                    found.low() <= truth.approx() && (truth.approx() - found.value).abs() <= found.range().error,
                    "{kind} {ranges:?} {place:?}"
                );
                worst[kind] = worst[kind].max(off / found.error);
                held[kind] += 1;
            }
        }
        println!("{worst:?} {held:?}");
        assert!(worst.iter().all(|w| *w > 0.1) && held.iter().all(|n| *n > 1000), "{worst:?} {held:?}");
    }

    /// The least value of a quadratic: exact where it is a sum of two of one symbol, never too large.
    #[test]
    fn least_values_are_not_exceeded() {
        let mut noise = Noise(2);
        for round in 0..2000 {
            let mut random = || noise.signed();
            let mut q = Quadratic {
                value: random(),
                slope: [random(), random()],
                bend: [random(), random(), random()],
                error: 0.0,
            };
            if round % 2 == 0 {
                q.bend[1] = 0.0;
            }
            let step = |i: i32| f64::from(i) / 50.0;
            let value = |x: f64, y: f64| {
                let [a, b, c] = q.bend;
                q.value + q.slope[0] * x + q.slope[1] * y + a * x * x + b * x * y + c * y * y
            };
            let least = (-50..=50)
                .flat_map(|i| (-50..=50).map(move |j| (step(i), step(j))))
                .map(|(x, y)| value(x, y))
                .fold(f64::INFINITY, f64::min);
            assert!(q.low() <= least && (q.bend[1] != 0.0 || q.low() > least - 1e-3), "{q:?} {least}");
        }
    }

    /// In four symbols, each operation holds the truth at corners and inside, and the extremes hold every number.
    #[test]
    fn four_symbols_hold_the_truth() {
        type Four = Form<4, 10>;
        let mut noise = Noise(3);
        let (mut worst, mut held) = (0.0f64, 0);
        for _ in 0..1500 {
            let width = 2f64.powi((30.0 * (noise.signed() - 1.0)) as i32);
            let ranges = [0; 4].map(|_| {
                let (middle, half) = (scaled(&mut noise), width * noise.signed().abs());
                [middle - half * middle.abs(), middle + half * middle.abs()]
            });
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| Four::along(ranges[i], i));
            let Some(found) = a.mul(&b).sub(&c.times(0.3)).over(&d.plus(0.7)).map(|q| q.mul(&a).add(&b.mul(&d))) else {
                continue;
            };
            for _ in 0..3 {
                let place = [0; 4].map(|_| (2.0 * noise.signed()).clamp(-1.0, 1.0));
                let at: [Interval; 4] = std::array::from_fn(|i| {
                    let [low, high] = ranges[i].map(|x| Interval::new(x, 300));
                    &low.scale(0.5 - 0.5 * place[i]) + &high.scale(0.5 + 0.5 * place[i])
                });
                let quotient = (&(&at[0] * &at[1]) - &at[2].scale(0.3)).over(&at[3].plus(0.7)).expect("not zero");
                let truth = &(&quotient * &at[0]) + &(&at[1] * &at[3]);
                let symbols = place.map(|x| Interval::new(x, 300));
                let mut sum = Interval::new(found.value, 300);
                let mut next = 0;
                for i in 0..4 {
                    sum = &sum + &symbols[i].scale(found.slope[i]);
                    for other in &symbols[i..] {
                        sum = &sum + &(&symbols[i] * other).scale(found.bend[next]);
                        next += 1;
                    }
                }
                let off = (&truth - &sum).approx().abs();
                assert!(off <= found.error, "{ranges:?} {place:?}: {found:?} is off by {off}");
                assert!(
                    found.low() <= truth.approx() && truth.approx() <= found.high(),
                    "{ranges:?} {place:?}: {found:?}"
                );
                worst = worst.max(off / found.error);
                held += 1;
            }
        }
        assert!(worst > 0.05 && held > 2000, "{worst} {held}");
    }

    /// The same numbers as balls would lose what cancels.
    #[test]
    fn what_depends_on_the_same_cancels() {
        let x = Quadratic::along([1.0, 1.1], 0);
        let ratio = x.sqrt().unwrap().mul(&x.sqrt().unwrap()).over(&x).unwrap();
        assert!((ratio.value - 1.0).abs() < 1e-15 && ratio.range().error < 1e-3, "{ratio:?}");
        let (ball, other) = (Quadratic::ball(x.range()), Quadratic::ball(x.range()));
        assert!(ball.over(&other).unwrap().range().error > 0.1);
    }

    #[test]
    fn what_is_not_certain_is_not_said() {
        let wide = Quadratic::along([-1.0, 3.0], 0);
        assert!(
            wide.sqrt().is_none() && Quadratic::of(1.0, 53).over(&wide).is_none() && wide.certain_sign(0.0).is_none()
        );
        let huge = Quadratic::of(1e200, 53);
        assert!(huge.mul(&huge).certain_sign(0.0).is_none() && huge.mul(&huge).sqrt().is_none());
        assert!(Quadratic::of(1.0, 53).over(&Quadratic::of(0.0, 53)).is_none());
        assert_eq!(Quadratic::along([2.0, 3.0], 1).certain_sign(0.0), Some(Ordering::Greater));
    }
}
