//! Speed, bend and greatest |curvature| of a PH quintic or of a piece of one, over any kind of number: doubles for
//! values and guesses, enclosed numbers for proofs.
//!
//! With pre-image w the curvature is `h/σ²`, `σ = |w|²`, `h = 2 Im(conj(w) w')`. It stays below v on a piece where both
//! `v σ² - h` and `v σ² + h`, of degree 8, are positive: where their Bernstein coefficients are, or those of the
//! halves, and so on. The pieces are pieces of w, from which σ is formed anew (where the curve is slow, |w| is small,
//! and so are its errors), and of h, which is halved itself: from w on a short piece it would be a difference of almost
//! equal products.

use super::extrema::{self, product};
use crate::num::bernstein::halve;
use crate::num::{Ball, Number, Real, formula};
use crate::steps::step;
use num_complex::Complex64;
use std::cmp::Ordering::{Greater, Less};

/// A complex number.
pub(crate) type Complex<N> = [N; 2];

/// A curve or a piece of one, wherever it lies, as Bernstein coefficients.
#[derive(Debug, Clone)]
pub(crate) struct Hodograph<N> {
    /// The pre-image.
    pub w: [Complex<N>; 3],
    /// h of the whole curve's parameter.
    pub turn: [N; 3],
}

/// Three complex numbers.
pub(crate) fn complex(w: &[Complex<f64>; 3]) -> [Complex64; 3] {
    w.map(|[re, im]| Complex64::new(re, im))
}

/// How a curve compares with a curvature.
pub(crate) enum Bound {
    /// It stays below.
    Below,
    /// It does not, at this parameter of the piece.
    Above(f64),
    /// The precision does not decide.
    Open,
}

/// The same of a piece, from its coefficients alone.
enum Compared {
    Below,
    /// At the start, 0, or at the end, 1.
    Above(f64),
    /// Halves may decide.
    Open,
    Hopeless,
}

/// `Re(conj(a) b)`.
pub(crate) fn re<N: Number>(a: &Complex<N>, b: &Complex<N>) -> N {
    formula!(a[0] * b[0] + a[1] * b[1])
}

/// `Im(conj(a) b)`.
fn im<N: Number>(a: &Complex<N>, b: &Complex<N>) -> N {
    formula!(a[0] * b[1] - a[1] * b[0])
}

fn mean<N: Number>(a: &Complex<N>, b: &Complex<N>) -> Complex<N> {
    [0, 1].map(|i| formula!(0.5 * (a[i] + b[i])))
}

/// The absolute value, if its number is certainly not 0.
pub(crate) fn size<N: Real>(x: &N) -> Option<N> {
    match x.certain_sign(0.0)? {
        Greater => Some(x.clone()),
        Less => Some(x.times(-1.0)),
        _ => None,
    }
}

impl<N: Number> Hodograph<N> {
    /// A whole curve.
    pub(crate) fn new(w: [Complex<N>; 3]) -> Hodograph<N> {
        let [w0, w1, w2] = &w;
        let turn = [im(w0, w1).times(4.0), im(w0, w2).times(2.0), im(w1, w2).times(4.0)];
        Hodograph { w, turn }
    }

    /// σ as Bernstein coefficients times binomials.
    pub(crate) fn speed(&self) -> [N; 5] {
        let [w0, w1, w2] = &self.w;
        let middle = formula!(2.0 * (2.0 * re(w1, w1) + re(w0, w2)));
        [re(w0, w0), re(w0, w1).times(4.0), middle, re(w1, w2).times(4.0), re(w2, w2)]
    }

    /// Bernstein coefficients of `σh' - 2hσ'`, times 10.
    pub(crate) fn slopes(&self) -> [N; 6] {
        extrema::slopes(&self.speed(), &self.turn, 2.0)
    }

    pub(crate) fn halves(&self) -> [Hodograph<N>; 2] {
        let [w0, w1, w2] = &self.w;
        let (left, right) = (mean(w0, w1), mean(w1, w2));
        let middle = mean(&left, &right);
        let (first, last) = halve(&self.turn);
        [
            Hodograph { w: [w0.clone(), left, middle.clone()], turn: first },
            Hodograph { w: [middle, right, w2.clone()], turn: last },
        ]
    }

    /// The same the other way.
    pub(crate) fn reversed(self) -> Hodograph<N> {
        let ([w0, w1, w2], [h0, h1, h2]) = (self.w, self.turn);
        // Its sign does not matter.
        Hodograph { w: [w2, w1, w0], turn: [h2, h1, h0] }
    }

    /// σ, σ' and σ'' at t, and h, h' and h''.
    // Always inlined, so that guesses in doubles compute no more of these than they use.
    #[inline(always)]
    fn jets(&self, t: &N) -> [[N; 3]; 2] {
        let back = formula!(1.0 - t);
        let mix = |a: &N, b: &N| formula!(a * back + b * t);
        let jet = |[a, b, c]: [&N; 3]| {
            let (first, last) = (formula!(2.0 * (b - a)), formula!(2.0 * (c - b)));
            [mix(&mix(a, b), &mix(b, c)), mix(&first, &last), last.sub(&first)]
        };
        let part = |i: usize| jet([0, 1, 2].map(|k| &self.w[k][i]));
        let ([x, u, p], [y, v, q]) = (part(0), part(1));
        let both = |a: &N, b: &N, c: &N, d: &N| formula!(a * b + c * d);
        let rise = both(&x, &u, &y, &v).times(2.0);
        let lift = formula!(2.0 * (both(&u, &u, &v, &v) + both(&x, &p, &y, &q)));
        [[both(&x, &x, &y, &y), rise, lift], jet([0, 1, 2].map(|k| &self.turn[k]))]
    }

    /// `σh' - 2hσ'` at t.
    pub(crate) fn slope(&self, t: &N) -> N {
        let [[speed, rise, _], [turn, bent, _]] = self.jets(t);
        formula!(speed * bent - 2.0 * (turn * rise))
    }
}

impl<N: Real> Hodograph<N> {
    fn bits(&self) -> usize {
        self.w[0][0].bits()
    }

    /// `σ²` and h as polynomials of degree 8, times binomials.
    fn sides(&self) -> ([N; 9], [N; 9]) {
        let speed = self.speed();
        let [h0, h1, h2] = self.turn.clone();
        let ones = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0].map(|x| N::of(x, self.bits()));
        (product(&speed, &speed), product(&[h0, h1.times(2.0), h2], &ones))
    }

    /// |κ| at t; `None` where it may be 0 or infinite.
    pub(crate) fn curvature(&self, t: &N) -> Option<N> {
        let [[speed, ..], [turn, ..]] = self.jets(t);
        size(&turn.over(&speed.mul(&speed))?)
    }

    /// An extremum of the curvature near t by Newton's method on `σh' - 2hσ'`: a guess.
    fn polished(&self, t: f64) -> N {
        let mut t = N::of(t, self.bits());
        if t.approx() <= 0.0 || t.approx() >= 1.0 {
            return t;
        }
        // Each step doubles the digits of what doubles gave, which is half of theirs: values are level at a peak.
        for _ in 0..(self.bits() / 26).next_power_of_two().ilog2() {
            let [[speed, rise, lift], [turn, bent, bend]] = self.jets(&t);
            let f = formula!(speed * bent - 2.0 * (turn * rise));
            let slope = formula!(speed * bend - rise * bent - 2.0 * (turn * lift));
            let next = f.over(&slope).map(|step| t.sub(&step).middle());
            match next {
                Some(next) if next.approx() > 0.0 && next.approx() < 1.0 => t = next,
                _ => break,
            }
        }
        t
    }

    /// Whether |κ| stays below v. With `touching`, v is the curvature at the start, where it may be equal: so many
    /// orders of their difference are exactly 0 there.
    ///
    /// Doubles are tried first, whatever the precision: for most curvatures they suffice.
    pub(crate) fn below(&self, v: &N, touching: usize) -> Bound {
        let by_doubles =
            if self.bits() > 53 { self.rough().halved_below(&Ball::enclosing(v), touching) } else { Bound::Open };
        match by_doubles {
            Bound::Open => self.halved_below(v, touching),
            decided => decided,
        }
    }

    /// The same in doubles.
    pub(crate) fn rough(&self) -> Hodograph<Ball> {
        Hodograph {
            w: [0, 1, 2].map(|i| [0, 1].map(|k| Ball::enclosing(&self.w[i][k]))),
            turn: [0, 1, 2].map(|i| Ball::enclosing(&self.turn[i])),
        }
    }

    fn halved_below(&self, v: &N, touching: usize) -> Bound {
        // No margin needs more halvings.
        let most = if self.bits() <= 53 { 40 } else { 640 };
        let mut waiting = vec![(self.clone(), 0.0, 0)];
        while let Some((piece, from, depth)) = waiting.pop() {
            step();
            let width = 2f64.powi(-depth);
            match piece.compared(v, if from == 0.0 { touching } else { 0 }) {
                Compared::Below => {}
                Compared::Open if depth < most => {
                    let [first, second] = piece.halves();
                    waiting.push((second, from + 0.5 * width, depth + 1));
                    waiting.push((first, from, depth + 1));
                }
                Compared::Above(part) => return Bound::Above(from + part * width),
                _ => return Bound::Open,
            }
        }
        Bound::Below
    }

    /// The same as far as the coefficients decide.
    fn compared(&self, v: &N, touching: usize) -> Compared {
        let (square, turn) = self.sides();
        let left = turn[0].certain_sign(0.0) == Some(Greater);
        let (mut all, mut some) = (true, false);
        for (k, (s, h)) in square.iter().zip(&turn).enumerate() {
            let most = v.mul(s);
            for (side, touches) in [(most.sub(h), left), (most.add(h), !left)] {
                // Exactly 0.
                if k < touching && touches {
                    continue;
                }
                let sign = side.certain_sign(0.0);
                if sign == Some(Less) && (k == 0 || k == 8) {
                    return Compared::Above(if k == 0 { 0.0 } else { 1.0 });
                }
                all &= sign == Some(Greater);
                some |= sign.is_some();
            }
        }
        match (all, some) {
            (true, _) => Compared::Below,
            (false, true) => Compared::Open,
            (false, false) => Compared::Hopeless,
        }
    }

    /// In doubles, for guesses.
    pub(crate) fn plain(&self) -> Hodograph<f64> {
        Hodograph {
            w: [0, 1, 2].map(|i| [0, 1].map(|k| self.w[i][k].approx())),
            turn: [0, 1, 2].map(|i| self.turn[i].approx()),
        }
    }

    /// Where the curvature is greatest, and how great: a guess.
    pub(crate) fn guess(&self) -> (f64, f64) {
        let plain = self.plain();
        let inside =
            (1..16).map(|i| f64::from(i) / 16.0).chain(plain.slow().into_iter().filter(|t| *t > 0.0 && *t < 1.0));
        let best = inside.map(|t| (t, plain.bend(t))).fold((0.5, 0.0), better).0;
        [0.0, best, 1.0].map(|t| self.climbed(t)).into_iter().fold((0.0, 0.0), better)
    }

    /// `2 ∫ v²` with `w = u + iv`: by how much the curve is longer than its chord, where that is along the first axis.
    pub(crate) fn beyond_chord(&self) -> N {
        let [a, b, c] = [0, 1, 2].map(|i| &self.w[i][1]);
        let inner = formula!(2.0 * (b * b) + a * c);
        let outer = formula!(a * a + a * b + b * c + c * c);
        // Fifteenths to a rounding: not for proofs of more than doubles' digits.
        formula!({ 2.0 / 15.0 } * (3.0 * outer + inner))
    }

    /// From t up to the next peak, and how great that is: a guess.
    pub(crate) fn climbed(&self, t: f64) -> (f64, f64) {
        self.plain().climbed(t)
    }

    /// The greatest |κ|; `None` where the precision does not suffice.
    ///
    /// `margin` is how much more than the value at the peak is proved, relative.
    pub(crate) fn greatest(&self, guess: f64, margin: &N) -> Option<N> {
        let peak = self.polished(guess);
        if let Some(value) = self.only_peak(&peak, margin) {
            return Some(value);
        }
        let ends = [0.0, 1.0].map(|t| N::of(t, self.bits()));
        let mut best = self.curvature(&peak);
        best = ends.iter().fold(best, |best, t| higher(best, self.curvature(t)));
        // Each round begins where the last was found too low.
        for _ in 0..16 {
            let value = best?;
            let most = formula!(value * (margin + 1.0));
            match self.below(&most, 0) {
                Bound::Below => return Some(value.union(&most)),
                Bound::Above(at) => {
                    let from = [self.polished(self.climbed(at).0), self.polished(at), N::of(at, self.bits())];
                    best = from.iter().fold(None, |best, t| higher(best, self.curvature(t)));
                }
                Bound::Open => return None,
            }
        }
        None
    }
}

/// The greater of what is known.
fn higher<N: Real>(a: Option<N>, b: Option<N>) -> Option<N> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.sub(&a).approx() > 0.0 { b } else { a }),
        (a, b) => a.or(b),
    }
}

fn better(best: (f64, f64), next: (f64, f64)) -> (f64, f64) {
    if next.1 > best.1 { next } else { best }
}

impl Hodograph<f64> {
    /// Bernstein coefficients of σ.
    pub(crate) fn speed_coefficients(&self) -> [f64; 5] {
        let [s0, s1, s2, s3, s4] = self.speed();
        [s0, s1 / 4.0, s2 / 6.0, s3 / 4.0, s4]
    }

    /// The real parts of the roots of w: near them the curve is slow, and bends most.
    pub(crate) fn slow(&self) -> [f64; 2] {
        let [c, w1, w2] = complex(&self.w);
        let (a, b) = (w2 - 2.0 * w1 + c, w1 - c);
        let root = (b * b - a * c).sqrt();
        [((root - b) / a).re, ((-root - b) / a).re]
    }

    /// |κ|; infinite where the curve stands still.
    pub(crate) fn bend(&self, t: f64) -> f64 {
        let [[speed, ..], [turn, ..]] = self.jets(&t);
        let size = turn.abs() / speed.powi(2);
        if size.is_nan() { f64::INFINITY } else { size }
    }

    /// From t up to a local maximum of |κ|: Newton's method, as long as it climbs.
    pub(crate) fn climbed(&self, from: f64) -> (f64, f64) {
        let (mut t, mut best) = (from, self.bend(from));
        let mut reach = 1.0 / 32.0;
        for _ in 0..40 {
            let [[speed, rise, lift], [turn, bent, bend]] = self.jets(&t);
            let f = (speed * bent - 2.0 * turn * rise) * turn.signum();
            let slope = (speed * bend - rise * bent - 2.0 * turn * lift) * turn.signum();
            // Up the slope where the curve is not concave.
            let step = if slope < 0.0 { (-f / slope).clamp(-reach, reach) } else { reach * f.signum() };
            let next = (t + step).clamp(0.0, 1.0);
            let value = self.bend(next);
            if value >= best && next != t {
                (t, best) = (next, value);
            } else if (next - t).abs() < 1e-13 {
                break;
            } else {
                reach = 0.25 * (next - t).abs();
            }
        }
        (t, best)
    }
}
