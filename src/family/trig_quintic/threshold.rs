//! The least ratio from which on all curves of an angle and shape are spirals.
//!
//! The sides of the control polygon are polynomials in the ratio, so the numerator is one, too: `ratio f`, f of degree
//! 6. In every case looked at, f grows with the ratio from the threshold up to [`MOST`], everywhere on the curve; then
//! that it is positive at one ratio proves it positive above. That f grows is proved for each datum, by Bernstein's
//! basis in both variables; where it does not, pieces of the range are proved one by one.
//!
//! No theorem says that a smaller ratio gives no spiral, and for small m large ratios give none at all; hence the
//! definition.

use super::exact::{HALVINGS, Shape, bernstein, without_last};
use super::filter::{ERROR, UNIT, decide, is_ordinary};
use super::guess::{DEGREE, LEAST, MOST, guess};
use super::plain::end_slope;
use super::poly::{BERNSTEIN, Frame, K, hodograph, numerator};
use crate::error::Result;
use crate::family::NO_VALUE;
use crate::num::bernstein::positive;
use crate::num::{Certain, Interval, Number, Real, TWIN_BITS, Twin, Verdict, climb, formula};
use std::array::from_fn;
use std::cmp::Ordering::Equal;

/// Relative error of f and of its derivative, in Bernstein's basis or by Horner's rule, against their sums of absolute
/// terms: the coefficients, for which products of polynomials add up to 7 terms on three levels; powers (6), weights
/// (10), a product and a sum of 7.
const F_ERROR: f64 = ERROR + (21.0 + 24.0 + 3.0) * UNIT;
/// Pieces of the range are halved as often.
const PIECES: u32 = 12;
/// Attempts to find the last ratio that gives no spiral.
const ROUNDS: u32 = 24;

/// The scalar at a shape (its own ratio means nothing here), rounded to nearest with proof.
///
/// # Errors
/// [`crate::Error::Undecided`] at the precision cap.
pub(super) fn least_ratio(shape: &Shape) -> Result<f32> {
    let found = fast(shape).and_then(|sweep| {
        let hint = guess(&sweep.c);
        sweep.near(hint)
    });
    found.or_else(|| by_twins(shape)).map_or_else(|| exact_least_ratio(shape), Ok)
}

/// The same in sums of two doubles, where they prove it.
pub(super) fn by_twins(shape: &Shape) -> Option<f32> {
    let frame = Frame::of(&Twin::of(1.0, TWIN_BITS), Twin::sin_cos(shape.theta))?;
    let c = in_ratio(&frame, [shape.m, shape.p, shape.q].map(|x| Twin::of(x, TWIN_BITS)), -1.0).map(bernstein);
    Sweep { c, size: [[0.0; K]; DEGREE + 1], error: 0.0, tie: None }.near(hint(shape))
}

/// Where doubles say that it is; better numbers need not follow.
fn hint(shape: &Shape) -> Option<u32> {
    fast(shape).map(|sweep| sweep.bisect(LEAST.to_bits() - 1))
}

/// The same by intervals alone.
///
/// # Errors
/// As there.
pub(super) fn exact_least_ratio(shape: &Shape) -> Result<f32> {
    let (hint, tie) = (hint(shape), tie(shape.q));
    climb(shape, "a scalar", |bits| {
        let frame = Frame::exact(1.0, shape.theta, bits)?;
        let c = in_ratio(&frame, [shape.m, shape.p, shape.q].map(|x| Interval::new(x, bits)), -1.0);
        let tie = tie.map(|ratio| (ratio, c.clone().map(without_last).map(bernstein)));
        Sweep { c: c.map(bernstein), size: [[0.0; K]; DEGREE + 1], error: 0.0, tie }.near(hint)
    })
    .map(|(value, _)| value)
}

/// The ratio between two singles at which κ'(1) = 0, if it lies exactly there.
///
/// There f has the factor 1 - τ, and no precision decides its sign at the end. Elsewhere the tie is no ratio that is
/// asked.
fn tie(q: f64) -> Option<f64> {
    // The middle next to a ratio is that below its single or that above.
    let near = ((20.0 * (1.0 + q) / 9.0) as f32).to_bits();
    [near.saturating_sub(1), near].into_iter().map(middle).find(|&ratio| end_slope(ratio, q) == Equal)
}

/// In doubles; `None` where they might overflow.
fn fast(shape: &Shape) -> Option<Sweep<f64>> {
    let frame = Frame::new(1.0, shape.theta).filter(|_| is_ordinary(shape.m, 1.0))?;
    let [c, size] = [-1.0, 1.0]
        .map(|sign| in_ratio(&frame, [shape.m, shape.p, shape.q], sign).map(|c| from_fn(|i| c[i] * BERNSTEIN[i])));
    Some(Sweep { c, size, error: F_ERROR, tie: None })
}

/// The coefficients of f by powers of the ratio; a frame of ratio 1.
fn in_ratio<N: Number>(frame: &Frame<N>, [m, p, q]: [N; 3], sign: f64) -> [[N; K]; DEGREE + 1] {
    let zero = m.times(0.0);
    let constant = |x: &N| Power { c: from_fn(|i| if i == 0 { x.clone() } else { zero.clone() }), from: 0, to: 0 };
    let y = Power { c: from_fn(|i| if i == 1 { frame.y.clone() } else { zero.clone() }), from: 1, to: 1 };
    let frame = Frame { y, last: constant(&frame.last), square: constant(&frame.square) };
    let form = numerator(&hodograph(&frame, &constant(&m), &constant(&p), &constant(&q)), &frame.square, sign);
    // The constant terms cancel: with ratio 0 all but the last side are 0.
    from_fn(|power| from_fn(|i| form[i].c[power + 1].clone()))
}

/// A polynomial in the ratio.
#[derive(Clone)]
struct Power<N> {
    c: [N; DEGREE + 2],
    /// No coefficients other than 0 below this,
    from: usize,
    /// nor above this.
    to: usize,
}

impl<N: Number> Power<N> {
    fn zip(&self, other: &Self, with: impl Fn(&N, &N) -> N) -> Self {
        let (from, to) = (self.from.min(other.from), self.to.max(other.to));
        let at = |i| if (from..=to).contains(&i) { with(&self.c[i], &other.c[i]) } else { self.c[i].clone() };
        Power { c: from_fn(at), from, to }
    }
}

impl<N: Number> Number for Power<N> {
    fn add(&self, other: &Self) -> Self {
        self.zip(other, N::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.zip(other, N::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        let (from, to) = ((self.from + other.from).min(DEGREE + 1), (self.to + other.to).min(DEGREE + 1));
        let zero = self.c[0].times(0.0);
        let mut c: [N; DEGREE + 2] = from_fn(|_| zero.clone());
        for i in self.from..=self.to {
            for j in other.from..=other.to.min(DEGREE + 1 - i) {
                let product = self.c[i].mul(&other.c[j]);
                // The first of a place is the place's.
                c[i + j] = if i == self.from || j == other.to { product } else { c[i + j].add(&product) };
            }
        }
        Power { c, from, to }
    }
    fn times(&self, constant: f64) -> Self {
        let at = |i| if (self.from..=self.to).contains(&i) { self.c[i].times(constant) } else { self.c[i].clone() };
        Power { c: from_fn(at), from: self.from, to: self.to }
    }
    fn plus(&self, constant: f64) -> Self {
        let mut sum = Power { from: 0, ..self.clone() };
        sum.c[0] = sum.c[0].plus(constant);
        sum
    }
}

/// f for all ratios, in Bernstein's basis along the curve.
struct Sweep<N> {
    c: [[N; K]; DEGREE + 1],
    /// Sums of the absolute values of terms, of doubles.
    size: [[f64; K]; DEGREE + 1],
    /// Error relative to these; 0 for numbers that know their own.
    error: f64,
    /// [`tie`], and there f divided by 1 - τ, times (1 - τ) + τ.
    tie: Option<(f64, [[N; K]; DEGREE + 1])>,
}

/// What a piece of the range holds.
enum Piece {
    Spirals,
    /// No spiral at this ratio.
    None(f64),
    Unclear,
}

/// Between a single and the next one up.
fn middle(bits: u32) -> f64 {
    0.5 * (f64::from(f32::from_bits(bits)) + f64::from(f32::from_bits(bits + 1)))
}

/// The end of the numbers that round to a single, towards [`MOST`].
fn upper(bits: u32) -> f64 {
    middle(bits).min(f64::from(MOST))
}

impl<N: Certain> Sweep<N> {
    /// [`Sweep::search`] from a hint, which is nearly always right; else every ratio between may be tried.
    fn near(&self, hint: Option<u32>) -> Option<f32> {
        hint.and_then(|hint| self.search(Some(hint))).or_else(|| self.search(None))
    }

    /// Finds the single that the threshold rounds to, and proves it; `None` where something is not proved.
    fn search(&self, hint: Option<u32>) -> Option<f32> {
        if !self.spiral(f64::from(MOST)).decided()? {
            return Some(NO_VALUE);
        }
        // Here or above there is a ratio without a spiral.
        let mut floor = 0.0;
        let mut place = hint.unwrap_or_else(|| self.bisect(LEAST.to_bits() - 1));
        for _ in 0..ROUNDS {
            let below = middle(place - 1);
            let is_floor = place == LEAST.to_bits() || below <= floor || !self.spiral(below).decided()?;
            if !is_floor {
                return None;
            }
            match self.piece(upper(place), f64::from(MOST), PIECES) {
                // No ratio below the tie gives a spiral, so the tie is the threshold: its single is the even one.
                Piece::Spirals if self.tied(upper(place)).is_some() => return Some(f32::from_bits(place + place % 2)),
                Piece::Spirals => return Some(f32::from_bits(place)),
                Piece::Unclear => return None,
                Piece::None(ratio) => {
                    floor = ratio;
                    // A single at least half a step below it.
                    place = self.bisect((ratio as f32).to_bits() - 2);
                }
            }
        }
        None
    }

    /// The place above which a step from no spirals to spirals is found, by halving.
    fn bisect(&self, low: u32) -> u32 {
        let (mut low, mut high) = (low, MOST.to_bits());
        while high - low > 1 {
            let place = low + (high - low) / 2;
            if self.spiral(upper(place)).is_no() { low = place } else { high = place }
        }
        high
    }

    /// What stands for f at a ratio if that is the tie.
    fn tied(&self, ratio: f64) -> Option<&[[N; K]; DEGREE + 1]> {
        self.tie.as_ref().filter(|(tie, _)| *tie == ratio).map(|(_, c)| c)
    }

    /// Whether a ratio gives a spiral.
    fn spiral(&self, ratio: f64) -> Verdict {
        let c = self.tied(ratio).unwrap_or(&self.c);
        let mut powers = [1.0; DEGREE + 1];
        let value =
            from_fn(|i| c[..DEGREE].iter().rev().fold(c[DEGREE][i].clone(), |sum, c| formula!(sum * { ratio } + c[i])));
        for k in 1..=DEGREE {
            powers[k] = powers[k - 1] * ratio;
        }
        self.positive(&value, &powers, 0)
    }

    /// The sign of a form that combines the coefficients from `first` on with weights of about these sizes.
    fn positive(&self, value: &[N; K], weights: &[f64], first: usize) -> Verdict {
        if self.error == 0.0 {
            return positive(value, 0.0, 0.0, HALVINGS);
        }
        let size = from_fn(|i| self.size[first..].iter().zip(weights).map(|(c, w)| c[i] * w).sum::<f64>());
        decide(value, &size, self.error)
    }

    /// All ratios from `low`, which gives a spiral, to `high`.
    fn piece(&self, low: f64, high: f64, depth: u32) -> Piece {
        match self.spiral(low) {
            Verdict::Yes => {}
            Verdict::No => return Piece::None(low),
            Verdict::Undecided => return Piece::Unclear,
        }
        if low >= high || self.all(low, high, 1) || self.all(low, high, 0) {
            return Piece::Spirals;
        }
        let middle = (low * high).sqrt();
        if depth == 0 || middle <= low || middle >= high {
            return Piece::Unclear;
        }
        // The upper half first: the last ratio without a spiral is wanted.
        match self.piece(middle, high, depth - 1) {
            Piece::Spirals => self.piece(low, middle, depth - 1),
            other => other,
        }
    }

    /// Whether a derivative of f by the ratio (the first, or f itself for 0) is positive for all ratios from `low` to
    /// `high`.
    ///
    /// Its Bernstein coefficient number j is its polar form with j times `high` and otherwise `low`.
    fn all(&self, low: f64, high: f64, derivative: usize) -> bool {
        let degree = DEGREE - derivative;
        (0..=degree).all(|j| {
            let factor = |k: usize| if derivative == 1 { (k + 1) as f64 } else { 1.0 };
            let one = formula!(0.0 * self.c[0][0] + 1.0);
            let weights: Vec<N> =
                (0..=degree).map(|k| polar(&one, [low, high], [degree, j, k]).times(factor(k))).collect();
            let sizes: Vec<f64> = (0..=degree).map(|k| polar(&1.0, [low, high], [degree, j, k]) * factor(k)).collect();
            let value = from_fn(|i| {
                let terms = self.c[derivative..].iter().zip(&weights).map(|(c, w)| c[i].mul(w));
                terms.reduce(|a, b| a.add(&b)).unwrap_or_else(|| one.clone())
            });
            self.positive(&value, &sizes, derivative).is_yes()
        })
    }
}

/// The polar form of `x^k` as a polynomial of a degree, j times `high` and otherwise `low`, times [`WHOLE`]: a sum of
/// positive terms.
fn polar<N: Number>(one: &N, [low, high]: [f64; 2], [degree, j, k]: [usize; 3]) -> N {
    let term = |i: usize| {
        let power = (0..i).fold(one.clone(), |x, _| x.times(high));
        let power = (i..k).fold(power, |x, _| x.times(low));
        power.times((choose(j, i) * choose(degree - j, k - i) * (WHOLE / choose(degree, k))) as f64)
    };
    // Never empty.
    let terms = (k.saturating_sub(degree - j)..=k.min(j)).map(term);
    terms.reduce(|a, b| a.add(&b)).unwrap_or_else(|| one.times(0.0))
}

/// A multiple of all binomials of degrees 5 and 6.
const WHOLE: usize = 60;

fn choose(n: usize, k: usize) -> usize {
    (0..k).fold(1, |c, i| c * (n - i) / (i + 1))
}
