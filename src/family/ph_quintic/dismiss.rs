//! Proofs over boxes that no solution with t in some interval is a spiral, without counting solutions.
//!
//! All numbers of the two equations and of the quintic of κ' (`curves.rs`, `shape.rs`) are sums of products of positive
//! ones. So what they are at the least of all numbers of a box, and at the greatest, bounds them all over it, and plain
//! doubles do. Between two places t of the tangents' ratio:
//! - **Heights.** Along both curves Z falls as t rises. A solution lies on both: Z is at most the lower of both curves
//!   at the first place, by the least coefficients and the greatest right-hand side, and at least the higher of both at
//!   the last place, by the greatest coefficients and the least right-hand side. Where nothing is left there is no
//!   solution.
//! - **The quintic** has the coefficients gain - loss. Gains are at most those of the greatest t, Z and numbers, losses
//!   at least those of the least. Where the quintic of these is negative somewhere on [0, 1], so is each one's.
//!
//! Beside both ends of all t, where one end's speed vanishes:
//! - **t up to a.** With the terms of `shape.rs` the last coefficient is negative where `4 h2 s3 < h1 s4 + 3 h2 s4`.
//!   Divided by `q² t²` that follows from `8 u Z² (v + cu) < pq t`, `u = βt³`, `v = α`, `c = cos Φ`; and divided by t,
//!   the left side only grows with t. So it holds up to a if it does at a, with the greatest Z, that for t = 0.
//! - **t from 1/a on.** Of the reversed curve, t up to a; its quintic has the other sign, and must be positive
//!   somewhere. At `(1-x)/x = kt`, divided by t³, the losses become
//!   `l5/t³ + 5k l4/t² + 10k² l3/t + 10k³ l2 + 5k⁴ t l1 + k⁵ t² l0`: each of these grows with t, as the terms of
//!   `shape.rs` show (h1 and s3 have a factor t, s4 has t², h2 has t⁴; of l4 each term has t² at least, of l3 each has
//!   t). So they are largest at a. The gains are at least
//!   `5k · 8 h1 s3/t² + 10k² · 18 h1 s2/t + 10k³ · 6 h0 s2 >= 40k pq² vZ + 120k² pq v²Z² + 80k³ p v³Z³`, by
//!   `s3 >= qtvZ` and `s2 >= 2v²Z²/3`.
//!
//! **Roundings.** No number passes more than forty operations, so each is right to 2^-46 of itself, and [`MORE`] covers
//! them. Coefficients below [`LEAST`] are taken for 0 from below and are not accepted from above, t is from 2^-12 to
//! 2^12, and Z is at most 2^40, or nothing is said: so no product of theirs leaves the normal doubles but a 0.

use super::curves::{Cubic, Curves};
use super::shape::CurveShape;
use crate::num::Form;

/// 1 and more than all roundings.
const MORE: f64 = 1.0 + 1e-12;
/// Heights are bounded so far from where they are guessed.
const ASIDE: f64 = 1e-9;
/// No number but 0 is less.
const LEAST: f64 = 1.0 / (1u64 << 40) as f64;
/// No height is more.
const HIGHEST: f64 = (1u64 << 40) as f64;
/// The innermost and the outermost ends, as powers of two.
const ENDS: std::ops::RangeInclusive<i32> = -1..=12;
/// Where a quintic is looked at, as `x / (1 - x)`.
const PLACES: [f64; 12] = [0.0, 0.01, 0.03, 0.1, 0.2, 0.35, 0.6, 1.0, 1.7, 3.0, 6.0, 20.0];
const BINOMIALS: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];

/// The equations by the least and by the greatest of all their numbers over a box.
pub(super) struct Ends {
    least: Curves<f64>,
    most: Curves<f64>,
}

/// The equations of a box, and between which t its spirals are.
pub(super) fn spirals_within(curves: &Curves<Form<4, 10>>) -> Option<(Ends, [f64; 2])> {
    let least = curves.each(|x| if x.low() < LEAST { 0.0 } else { x.low() });
    let most = curves.each(Form::high);
    let sized = |x: f64| (LEAST..HIGHEST).contains(&x);
    let scale = curves.scale.iter().all(|x| sized(*x));
    (scale && most.cos <= 2.0 && most.bend.iter().all(|x| sized(*x)) && least.right.iter().all(|x| sized(*x)))
        .then_some(())?;
    let ends = Ends { least, most };
    let backwards = Ends { least: least.reversed(), most: most.reversed() };
    let first = ENDS.map(|i| 2f64.powi(-i)).find(|t| ends.vanishes(*t))?;
    let last = ENDS.map(|i| 2f64.powi(-i)).find(|t| backwards.vanishes_back(*t))?;
    (first < 1.0 / last).then_some((ends, [first, 1.0 / last]))
}

/// More than where the cubic reaches a right-hand side; infinite where that is not certain.
fn above(cubic: &Cubic<f64>, right: f64) -> f64 {
    let z = cubic.guess(right) * (1.0 + ASIDE);
    if z < HIGHEST && value(cubic, z) > right * MORE { z } else { f64::INFINITY }
}

/// Less than where the cubic reaches a right-hand side; 0 where that is not certain.
fn below(cubic: &Cubic<f64>, right: f64) -> f64 {
    let z = cubic.guess(right) * (1.0 - ASIDE);
    if z > LEAST && value(cubic, z) * MORE < right { z } else { 0.0 }
}

fn value(cubic: &Cubic<f64>, z: f64) -> f64 {
    let [c0, c1, c2] = cubic.c;
    ((c2 * z + c1) * z + c0) * z
}

impl Ends {
    /// More than the height of any solution from t on.
    fn highest(&self, t: f64) -> f64 {
        let [first, second] = self.least.at(&t);
        above(&first, self.most.right[0]).min(above(&second, self.most.right[1]))
    }

    /// Less than the height of any solution up to t.
    fn lowest(&self, t: f64) -> f64 {
        let [first, second] = self.most.at(&t);
        below(&first, self.least.right[0]).max(below(&second, self.least.right[1]))
    }

    /// Gains and losses of the quintic.
    fn sums(curves: &Curves<f64>, t: f64, z: f64) -> [[f64; 2]; 6] {
        CurveShape::of(curves, &t, &z, [&1.0, &(1.0 / 3.0)]).sums()
    }

    /// Whether no solution between two places is a spiral.
    pub(super) fn fails(&self, a: f64, b: f64) -> bool {
        let (low, high) = (self.lowest(b), self.highest(a));
        if low > high {
            return true;
        }
        if !high.is_finite() {
            return false;
        }
        let (gains, losses) = (Ends::sums(&self.most, b, high), Ends::sums(&self.least, a, low));
        let c: [f64; 6] = std::array::from_fn(|i| BINOMIALS[i] * (gains[i][0] * MORE - losses[i][1]));
        // Both sums, since what is left of them is not accurate.
        let size = (0..6).fold(0.0f64, |most, i| most.max(gains[i][0]).max(losses[i][1]));
        size < f64::MAX
            && PLACES.iter().any(|s| {
                let at = |order: fn(usize) -> usize| {
                    let power = |sum: (f64, f64), i: usize| (sum.0 * s + c[order(i)], sum.1 * s + c[order(i)].abs());
                    let (sum, size) = (0..6).fold((0.0, 0.0), power);
                    sum < -size * (MORE - 1.0)
                };
                at(|i| 5 - i) || at(|i| i)
            })
    }

    /// Whether no solution up to t is a spiral, by the last coefficient.
    fn vanishes(&self, t: f64) -> bool {
        let z = self.highest(0.0);
        let Curves { scale: [p, q], bend: [v, beta], cos, .. } = &self.most;
        8.0 * beta * t * t * z * z * (v + cos * beta * t * t * t) * MORE < p * q
    }

    /// Whether the quintic of each solution up to t is positive somewhere: these are the equations of reversed curves.
    fn vanishes_back(&self, t: f64) -> bool {
        let (low, high) = (self.lowest(t), self.highest(0.0));
        let Curves { scale: [p, q], bend: [v, _], .. } = self.least;
        let vz = v * low;
        if !(high.is_finite() && vz > LEAST) {
            return false;
        }
        let losses = Ends::sums(&self.most, t, high);
        [0.5, 1.0, 2.0].into_iter().any(|share| {
            let k = share * q / vz;
            let rho = k * t;
            let loss = (0..6).fold(0.0, |sum, i| sum * rho + BINOMIALS[i] * losses[i][1]) / (t * t * t);
            let gain =
                40.0 * k * p * q * q * vz + 120.0 * k * k * p * q * vz * vz + 80.0 * k * k * k * p * vz * vz * vz;
            loss * MORE < gain
        })
    }
}
