//! The greatest |curvature| of a PH quintic, enclosed.
//!
//! With pre-image w the curvature is `h/σ²`, `σ = |w|²`, `h = 2 Im(conj(w) w')`. It stays below v on a piece where both
//! `v σ² - h` and `v σ² + h`, of degree 8, are positive: where their Bernstein coefficients are, or those of the halves, and so on. The pieces
//! are pieces of w, from which σ and h are formed anew: where the curve is slow, |w| is small, and so are its errors.

use crate::num::Real;
use num_complex::Complex64;
use std::cmp::Ordering::{Greater, Less};

/// A complex number.
pub(super) type Complex<N> = [N; 2];

/// A piece of a curve, as the Bernstein coefficients of its pre-image.
#[derive(Debug, Clone)]
pub(super) struct Arc<N> {
    pub w: [Complex<N>; 3],
    /// Which part of the whole curve's parameters it has: h shrinks by this.
    pub width: f64,
}

/// How a curve compares with a curvature.
pub(super) enum Bound {
    /// It stays below.
    Below,
    /// It does not, at this parameter of the piece.
    Above(f64),
    /// The precision does not tell.
    Open,
}

/// The same of a piece, from its coefficients alone.
enum Compared {
    Below,
    /// At the start, 0, or at the end, 1.
    Above(f64),
    /// Halves may tell.
    Open,
    Hopeless,
}

/// `Re(conj(a) b)`.
fn re<N: Real>(a: &Complex<N>, b: &Complex<N>) -> N {
    a[0].mul(&b[0]).add(&a[1].mul(&b[1]))
}

/// `Im(conj(a) b)`.
fn im<N: Real>(a: &Complex<N>, b: &Complex<N>) -> N {
    a[0].mul(&b[1]).sub(&a[1].mul(&b[0]))
}

fn mean<N: Real>(a: &Complex<N>, b: &Complex<N>) -> Complex<N> {
    [0, 1].map(|i| a[i].add(&b[i]).times(0.5))
}

/// The absolute value, if its number is certainly not 0.
pub(super) fn size<N: Real>(x: &N) -> Option<N> {
    match x.certain_sign(0.0)? {
        Greater => Some(x.clone()),
        Less => Some(x.times(-1.0)),
        _ => None,
    }
}

/// Of polynomials as Bernstein coefficients times binomials: those of the product are the plain convolution.
fn product<N: Real, const A: usize, const B: usize, const C: usize>(a: &[N; A], b: &[N; B]) -> [N; C] {
    std::array::from_fn(|k| {
        let terms = (k.saturating_sub(B - 1)..=k.min(A - 1)).map(|i| a[i].mul(&b[k - i]));
        terms.reduce(|sum, x| sum.add(&x)).unwrap_or_else(|| a[0].clone())
    })
}

impl<N: Real> Arc<N> {
    fn bits(&self) -> usize {
        self.w[0][0].bits()
    }

    /// h: three Bernstein coefficients, as of the whole curve where the width is 1.
    pub fn turn(&self) -> [N; 3] {
        let [w0, w1, w2] = &self.w;
        [im(w0, w1).times(4.0), im(w0, w2).times(2.0), im(w1, w2).times(4.0)]
    }

    /// `σ²` and h as polynomials of degree 8, times binomials.
    fn sides(&self) -> ([N; 9], [N; 9]) {
        let [w0, w1, w2] = &self.w;
        let middle = re(w1, w1).times(2.0).add(&re(w0, w2)).times(2.0);
        let speed = [re(w0, w0), re(w0, w1).times(4.0), middle, re(w1, w2).times(4.0), re(w2, w2)];
        let [h0, h1, h2] = self.turn();
        let ones = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0].map(|x| N::of(x, self.bits()));
        (product(&speed, &speed), product(&[h0, h1.times(2.0), h2], &ones))
    }

    pub fn halves(&self) -> [Arc<N>; 2] {
        let [w0, w1, w2] = &self.w;
        let (left, right) = (mean(w0, w1), mean(w1, w2));
        let middle = mean(&left, &right);
        let width = 0.5 * self.width;
        [Arc { w: [w0.clone(), left, middle.clone()], width }, Arc { w: [middle, right, w2.clone()], width }]
    }

    /// The same the other way.
    pub fn reversed(self) -> Arc<N> {
        let [w0, w1, w2] = self.w;
        Arc { w: [w2, w1, w0], ..self }
    }

    /// w, w' and w'' at t.
    fn jet(&self, t: &N) -> [Complex<N>; 3] {
        let [w0, w1, w2] = &self.w;
        let back = t.times(-1.0).plus(1.0);
        let mix = |a: &Complex<N>, b: &Complex<N>| [0, 1].map(|i| a[i].mul(&back).add(&b[i].mul(t)));
        let twice = |a: &Complex<N>, b: &Complex<N>| [0, 1].map(|i| b[i].sub(&a[i]).times(2.0));
        let (first, last) = (twice(w0, w1), twice(w1, w2));
        [mix(&mix(w0, w1), &mix(w1, w2)), mix(&first, &last), [0, 1].map(|i| last[i].sub(&first[i]))]
    }

    /// |κ| at t; `None` where it may be 0 or infinite.
    pub fn curvature(&self, t: &N) -> Option<N> {
        let [w, slope, _] = self.jet(t);
        let speed = re(&w, &w).times(self.width);
        size(&im(&w, &slope).times(2.0 * self.width).over(&speed.mul(&speed))?)
    }

    /// An extremum of the curvature near t by Newton's method on `σh' - 2hσ'`: a guess.
    fn polished(&self, t: f64) -> N {
        let mut t = N::of(t, self.bits());
        if t.approx() <= 0.0 || t.approx() >= 1.0 {
            return t;
        }
        // Each step doubles the digits of what doubles gave.
        for _ in 0..(self.bits() / 26).ilog2() {
            let [w, v, a] = self.jet(&t);
            let (speed, rise, turn, bend) = (re(&w, &w), re(&w, &v).times(2.0), im(&w, &v), im(&w, &a));
            let lift = re(&v, &v).add(&re(&w, &a)).times(2.0);
            let f = speed.mul(&bend).sub(&turn.mul(&rise).times(2.0));
            let slope = speed.mul(&im(&v, &a)).sub(&rise.mul(&bend)).sub(&turn.mul(&lift).times(2.0));
            let next = f.over(&slope).map(|step| t.sub(&step).middle());
            match next {
                Some(next) if next.approx() > 0.0 && next.approx() < 1.0 => t = next,
                _ => break,
            }
        }
        t
    }

    /// Whether |κ| stays below v. With `touching`, v is the curvature at the start, where it may be equal.
    pub fn below(&self, v: &N, touching: bool) -> Bound {
        // No margin needs more halvings.
        let most = if self.bits() <= 53 { 40 } else { 640 };
        let mut waiting = vec![(self.clone(), v.times(self.width), 0.0, 0)];
        while let Some((piece, v, from, depth)) = waiting.pop() {
            match piece.compared(&v, touching && from == 0.0) {
                Compared::Below => {}
                Compared::Open if depth < most => {
                    let ([first, second], half) = (piece.halves(), v.times(0.5));
                    let middle = from + second.width;
                    waiting.push((second, half.clone(), middle, depth + 1));
                    waiting.push((first, half, from, depth + 1));
                }
                Compared::Above(part) => return Bound::Above((from + part * piece.width) / self.width),
                _ => return Bound::Open,
            }
        }
        Bound::Below
    }

    /// The same as far as the coefficients tell, for v times the width.
    fn compared(&self, v: &N, touching: bool) -> Compared {
        let (square, turn) = self.sides();
        let left = turn[0].certain_sign(0.0) == Some(Greater);
        let (mut all, mut some) = (true, false);
        for (k, (s, h)) in square.iter().zip(&turn).enumerate() {
            let most = v.mul(s);
            for (side, touches) in [(most.sub(h), left), (most.add(h), !left)] {
                // Exactly 0.
                if k == 0 && touching && touches {
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

    /// w in doubles.
    fn plain(&self) -> [Complex64; 3] {
        [0, 1, 2].map(|i| Complex64::new(self.w[i][0].approx(), self.w[i][1].approx()))
    }

    /// Where the curvature is greatest, and how great: a guess.
    pub fn guess(&self) -> (f64, f64) {
        let w = self.plain();
        let inside = (1..16).map(|i| f64::from(i) / 16.0).chain(roots(&w).into_iter().filter(|t| *t > 0.0 && *t < 1.0));
        let best = inside.map(|t| (t, bend(&w, t))).fold((0.5, 0.0), better).0;
        [0.0, best, 1.0].map(|t| self.climbed(t)).into_iter().fold((0.0, 0.0), better)
    }

    /// Where the curvature is about greatest inside, by samples and one step of Newton's method.
    pub fn sampled(&self) -> f64 {
        let w = self.plain();
        let inside = (1..16).map(|i| f64::from(i) / 16.0).map(|t| (t, bend(&w, t)));
        self.polished(inside.fold((0.5, 0.0), better).0).approx()
    }

    /// `∫ σ`.
    pub fn length(&self) -> N {
        let [w0, w1, w2] = &self.w;
        let inner = re(w1, w1).times(2.0).add(&re(w0, w2));
        let outer = re(w0, w0).add(&re(w0, w1)).add(&re(w1, w2)).add(&re(w2, w2));
        // A third and a fifth, to a rounding: not for proofs of more than doubles' digits.
        outer.times(3.0).add(&inner).times(1.0 / 15.0)
    }

    /// From t up to the next peak, and how great that is: a guess.
    pub fn climbed(&self, t: f64) -> (f64, f64) {
        let (t, k) = climbed(&self.plain(), t);
        (t, k / self.width)
    }

    /// The greatest |κ|; `None` where the precision does not suffice.
    ///
    /// `margin` is how much more than the value at the guess is proved, relative.
    pub fn greatest(&self, guess: f64, margin: &N) -> Option<N> {
        let mut t = self.polished(guess);
        // Each round begins where the last was found too low.
        for _ in 0..8 {
            let value = self.curvature(&t)?;
            let most = value.mul(&margin.plus(1.0));
            match self.below(&most, false) {
                Bound::Below => return Some(value.union(&most)),
                Bound::Above(at) => t = self.polished(self.climbed(at).0),
                Bound::Open => return None,
            }
        }
        None
    }
}

fn better(best: (f64, f64), next: (f64, f64)) -> (f64, f64) {
    if next.1 > best.1 { next } else { best }
}

/// The real parts of the roots of w: near them the curve is slow, and bends most.
fn roots([c, w1, w2]: &[Complex64; 3]) -> [f64; 2] {
    let (a, b) = (w2 - 2.0 * w1 + c, w1 - c);
    let root = (b * b - a * c).sqrt();
    [((root - b) / a).re, ((-root - b) / a).re]
}

/// w, w', w''.
fn jet([w0, w1, w2]: &[Complex64; 3], t: f64) -> [Complex64; 3] {
    let (first, last) = (2.0 * (w1 - w0), 2.0 * (w2 - w1));
    let (a, b) = (w0 * (1.0 - t) + w1 * t, w1 * (1.0 - t) + w2 * t);
    [a * (1.0 - t) + b * t, first * (1.0 - t) + last * t, last - first]
}

/// |κ|; infinite where the curve stands still.
fn bend(w: &[Complex64; 3], t: f64) -> f64 {
    let [w, slope, _] = jet(w, t);
    let size = 2.0 * (w.conj() * slope).im.abs() / w.norm_sqr().powi(2);
    if size.is_nan() { f64::INFINITY } else { size }
}

/// From t up to a local maximum of |κ|: Newton's method, as long as it climbs.
fn climbed(w: &[Complex64; 3], from: f64) -> (f64, f64) {
    let (mut t, mut best) = (from, bend(w, from));
    let mut reach = 1.0 / 32.0;
    for _ in 0..40 {
        let [z, v, a] = jet(w, t);
        let (speed, rise, turn, bent) = (z.norm_sqr(), 2.0 * (z.conj() * v).re, (z.conj() * v).im, (z.conj() * a).im);
        let f = (speed * bent - 2.0 * turn * rise) * turn.signum();
        let slope = speed * (v.conj() * a).im - rise * bent - 2.0 * turn * 2.0 * (v.norm_sqr() + (z.conj() * a).re);
        let slope = slope * turn.signum();
        // Up the slope where the curve is not concave.
        let step = if slope < 0.0 { (-f / slope).clamp(-reach, reach) } else { reach * f.signum() };
        let next = (t + step).clamp(0.0, 1.0);
        let value = bend(w, next);
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
