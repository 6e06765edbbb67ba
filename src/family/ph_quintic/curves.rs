//! The two equations of a datum, as two curves in the plane of the tangents' ratio and size.
//!
//! With `w0 = A e^{-iφ0/2}`, `w2 = B e^{iφ1/2}` the end curvatures fix `w1 = αA³ e^{iφ1/2} + βB³ e^{-iφ0/2}`,
//! `α = κ0/(4 sin Φ)`, `β = κ1/(4 sin Φ)`, `Φ = (φ0 + φ1)/2`. What remains is `∫ w² = 2`, the chord. Its components
//! across `e^{-iφ0}` and across `e^{iφ1}`, divided by sin Φ, are
//!
//! ```text
//! M + 2 cos Φ E1 = 30 sin φ0 / sin Φ      E1 = 3B² + 3αA³B + 2α²A⁶
//! M + 2 cos Φ E0 = 30 sin φ1 / sin Φ      E0 = 3A² + 3βAB³ + 2β²B⁶      M = AB + 3αA⁴ + 3βB⁴ + 4αβA³B³
//! ```
//!
//! For κ0, κ1 >= 0 no coefficient is negative: these are level curves of posynomials. In `x = ln(B/A)` and `ζ = ln A²`
//! each is the graph of a function ζ(x), and concave, because `ln Σ exp(linear)` is convex. Its slope is `-s`,
//! `s = Σ w j / Σ w k` over its terms `w ∝ A^(2k) (B/A)^j`, and s increases with x. Everything that counts solutions
//! rests on that (see [`super::march`]); no term is subtracted, so nothing cancels either.
//!
//! Sizes are scaled by powers of two: `A = p a`, `B = q b`, `α' = αp³`, `β' = βq³`, both at most 1.

use super::factors::{FAR, HEIGHT};
use super::knot::Knot;
use super::pair::Pair;
use crate::num::{Number, Real, formula};
use crate::steps::step;
use std::f64::consts::LN_2;

/// The equations of a datum with κ0, κ1 >= 0, scaled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curves<N> {
    /// p and q, powers of two.
    pub scale: [f64; 2],
    /// α' and β'.
    pub bend: [N; 2],
    /// cos Φ.
    pub cos: N,
    /// The right-hand sides.
    pub right: [N; 2],
    /// `30 sin((φ1 - φ0)/2) / sin Φ`.
    pub skew: N,
    /// Coefficients, by the powers of t in the comments of [`Curves::at`].
    flat: [N; 2],
    own: [N; 2],
    across: [N; 2],
    both: N,
    last: [N; 2],
}

/// A left-hand side at one t = b/a: `c[0] Z + c[1] Z² + c[2] Z³` in Z = a², and the same with each term times its power
/// of t.
pub(super) struct Cubic<N> {
    pub c: [N; 3],
    pub j: [N; 3],
}

/// A power of two p with `αp³` from 1/8 to 1, or 1 where α is less.
fn scale(alpha: f64) -> f64 {
    if alpha > 1.0 { 2f64.powi(-((alpha.log2() / 3.0).ceil().min(400.0) as i32)) } else { 1.0 }
}

impl<N: Real> Curves<N> {
    /// The equations; `None` when the precision does not suffice.
    pub(super) fn of(pair: &Pair<N>, kappa: [f64; 2]) -> Option<Curves<N>> {
        let quarter = pair.sin.times(4.0);
        let bend = |kappa: f64| N::of(kappa, quarter.bits()).over(&quarter);
        Some(Curves::bent([bend(kappa[0])?, bend(kappa[1])?], pair.cos.clone(), pair.right.clone(), pair.skew.clone()))
    }

    /// The same from α, β and what the angles give.
    pub(super) fn bent(bend: [N; 2], cos: N, right: [N; 2], skew: N) -> Curves<N> {
        Curves::scaled([bend[0].approx(), bend[1].approx()], bend, cos, right, skew)
    }

    /// About the same in doubles, for guesses.
    pub(super) fn approx(&self) -> Curves<f64> {
        let near = |x: &[N; 2]| [x[0].approx(), x[1].approx()];
        Curves::new(self.scale, near(&self.bend), self.cos.approx(), near(&self.right), self.skew.approx())
    }

    /// Every number by itself as a double.
    pub(super) fn each(&self, of: impl Fn(&N) -> f64) -> Curves<f64> {
        let both = |x: &[N; 2]| [of(&x[0]), of(&x[1])];
        Curves {
            scale: self.scale,
            bend: both(&self.bend),
            cos: of(&self.cos),
            right: both(&self.right),
            skew: of(&self.skew),
            flat: both(&self.flat),
            own: both(&self.own),
            across: both(&self.across),
            both: of(&self.both),
            last: both(&self.last),
        }
    }
}

impl<N: Number> Curves<N> {
    /// The same, where α and β are about `largest` or less.
    #[inline(always)]
    pub(super) fn scaled(largest: [f64; 2], [alpha, beta]: [N; 2], cos: N, right: [N; 2], skew: N) -> Curves<N> {
        let [p, q] = largest.map(scale);
        let bend = [formula!(alpha * { p } * { p } * { p }), formula!(beta * { q } * { q } * { q })];
        Curves::new([p, q], bend, cos, right, skew)
    }

    #[inline(always)]
    fn new(scale: [f64; 2], bend: [N; 2], cos: N, right: [N; 2], skew: N) -> Curves<N> {
        let [p, q] = scale;
        let c = cos.times(2.0);
        let [alpha, beta] = &bend;
        Curves {
            flat: [c.times(3.0 * p * p), c.times(3.0 * q * q)],
            own: [alpha.times(3.0 * p), beta.times(3.0 * q)],
            across: [formula!(c * alpha * { 3.0 * q }), formula!(c * beta * { 3.0 * p })],
            both: formula!(4.0 * (alpha * beta)),
            last: [formula!(2.0 * (c * alpha * alpha)), formula!(2.0 * (c * beta * beta))],
            scale,
            bend,
            cos,
            right,
            skew,
        }
    }

    /// The same datum with its ends exchanged: Z and t become b² and 1/t, and the curves change places.
    #[inline(always)]
    pub(super) fn reversed(&self) -> Curves<N> {
        let swap = |x: &[N; 2]| [x[1].clone(), x[0].clone()];
        Curves {
            scale: [self.scale[1], self.scale[0]],
            bend: swap(&self.bend),
            cos: self.cos.clone(),
            right: swap(&self.right),
            skew: self.skew.times(-1.0),
            flat: swap(&self.flat),
            own: swap(&self.own),
            across: swap(&self.across),
            both: self.both.clone(),
            last: swap(&self.last),
        }
    }

    /// Both left-hand sides at t.
    #[inline(always)]
    pub(super) fn at(&self, t: &N) -> [Cubic<N>; 2] {
        let t2 = formula!(t * t);
        let t3 = formula!(t2 * t);
        let first = t.times(self.scale[0] * self.scale[1]);
        let fourth = formula!(self.own[1] * (t2 * t2));
        let second = formula!(self.own[0] + fourth);
        let fourth = fourth.times(4.0);
        let (flat, bent) = (formula!(self.flat[1] * t2), formula!(self.across[0] * t));
        let both = formula!(self.both * t3);
        let thrice = both.times(3.0);
        let bent_end = formula!(self.across[1] * t3);
        let sixth = formula!(self.last[1] * (t3 * t3));
        [
            // pq t + 3Cq² t²,  3α'p + 3β'q t⁴ + 3Cα'q t,  4α'β' t³ + 2Cα'²
            Cubic {
                c: [formula!(first + flat), formula!(second + bent), formula!(both + self.last[0])],
                j: [formula!(first + 2.0 * flat), fourth.add(&bent), thrice.clone()],
            },
            // pq t + 3Cp²,  3α'p + 3β'q t⁴ + 3Cβ'p t³,  4α'β' t³ + 2Cβ'² t⁶
            Cubic {
                c: [formula!(first + self.flat[0]), formula!(second + bent_end), formula!(both + sixth)],
                j: [first, formula!(fourth + 3.0 * bent_end), formula!(thrice + 6.0 * sixth)],
            },
        ]
    }
}

/// How the slope s of a curve changes with x: s' and s'' at one t, or enclosures of them over an interval.
pub(super) struct Changes<N> {
    pub first: N,
    pub second: N,
}

impl<N: Real> Curves<N> {
    /// `s' = Σ w m² / Σ w k` and `s'' = (Σ w m³ - 3 s' Σ w m k) / Σ w k`, `m = j - ks`, of both curves at t, with their
    /// heights and slopes there; all may be enclosures over an interval. For w changes with x as `w m`, m as `-k s'`,
    /// and `Σ w m = 0`.
    pub(super) fn slope_changes(&self, t: &N, at: impl Fn(usize) -> (N, N)) -> Option<[Changes<N>; 2]> {
        let t2 = formula!(t * t);
        let t3 = formula!(t2 * t);
        let first = t.times(self.scale[0] * self.scale[1]);
        let fourth = formula!(self.own[1] * (t2 * t2));
        let both = formula!(self.both * t3);
        let shared = [(first, 1, 1), (self.own[0].clone(), 0, 2), (fourth, 4, 2), (both, 3, 3)];
        let own = [
            [(formula!(self.flat[1] * t2), 2, 1), (formula!(self.across[0] * t), 1, 2), (self.last[0].clone(), 0, 3)],
            [(self.flat[0].clone(), 0, 1), (self.across[1].mul(&t3), 3, 2), (formula!(self.last[1] * (t3 * t3)), 6, 3)],
        ];
        let change = |i: usize| {
            let (z, s) = at(i);
            let z2 = formula!(z * z);
            let powers = [z.clone(), z2.clone(), formula!(z2 * z)];
            let turned = [1.0, 2.0, 3.0].map(|k| s.times(-k));
            let none = z.times(0.0);
            let [mut weight, mut square, mut cube, mut mixed] = [none.clone(), none.clone(), none.clone(), none];
            for (coefficient, j, k) in shared.iter().chain(&own[i]) {
                let w = formula!(coefficient * powers[k - 1]);
                let m = turned[k - 1].plus(f64::from(*j));
                let (wm, k) = (formula!(w * m), *k as f64);
                let wm2 = formula!(wm * m);
                weight = formula!(weight + w * { k });
                mixed = formula!(mixed + wm * { k });
                cube = formula!(cube + wm2 * m);
                square = formula!(square + wm2);
            }
            let first = square.over(&weight)?;
            let second = formula!(cube - 3.0 * (first * mixed)).over(&weight)?;
            Some(Changes { first, second })
        };
        Some([change(0)?, change(1)?])
    }

    /// D'' and D''' at a knot.
    pub(super) fn change(&self, knot: &Knot<N>) -> Option<[N; 2]> {
        let [from, to] = self.slope_changes(&knot.t, |i| (knot.z[i].clone(), knot.s[i].clone()))?;
        Some([formula!(to.first - from.first), formula!(to.second - from.second)])
    }
}

impl Cubic<f64> {
    /// About where the cubic reaches `right`: Newton's method, which comes down to it from the least height one term
    /// alone would need.
    pub(super) fn guess(&self, right: f64) -> f64 {
        let [c0, c1, c2] = self.c;
        let mut z = (right / c0).min((right / c1).sqrt());
        // A cube root costs more than all the rest, and is seldom the least.
        if right / c2 < z * z * z {
            z = (right / c2).cbrt();
        }
        for _ in 0..60 {
            let step = (((c2 * z + c1) * z + c0) * z - right) / ((3.0 * c2 * z + 2.0 * c1) * z + c0);
            z -= step;
            // The next step is about the square of this one.
            if step.abs() <= z * 2f64.powi(-28) {
                break;
            }
        }
        z
    }

    /// s at height z.
    pub(super) fn slope(&self, z: f64) -> f64 {
        let ([c0, c1, c2], [j0, j1, j2]) = (self.c, self.j);
        ((j2 * z + j1) * z + j0) / ((3.0 * c2 * z + 2.0 * c1) * z + c0)
    }
}

impl<N: Real> Cubic<N> {
    /// Where the cubic reaches `right`, enclosed; `None` when the precision does not suffice.
    ///
    /// A relative residual r below [`FAR`] puts Z within `1 ± 1.05 r`: see [`HEIGHT`].
    pub(super) fn height(&self, right: &N, guess: f64) -> Option<N> {
        let [c0, c1, c2] = &self.c;
        let value = |z: &N| formula!(((c2 * z + c1) * z + c0) * z);
        let rise = |z: &N| formula!((3.0 * (c2 * z) + 2.0 * c1) * z + c0);
        let newton = |z: &N| Some(z.sub(&value(z).sub(right).over(&rise(z))?).guess());
        let mut z = if guess.is_normal() && guess > 0.0 { N::of(guess, right.bits()) } else { self.start(right)? };
        for _ in 0..polishing(right.bits()).max(N::ORDERS) {
            z = newton(&z)?;
        }
        let off = value(&z).sub(right).over(right)?.size();
        (formula!(-(off + { -FAR })).is_positive() && z.is_positive()).then(|| formula!(z + { HEIGHT } * (z * off)))
    }

    /// About where the cubic reaches `right`, when coefficients or heights are no doubles: none of their size, only
    /// logarithms and the cubic's shape, `Σ ck y^(k+1) = 1` with coefficients up to 1, are computed in doubles. So the
    /// work does not grow with their size.
    ///
    /// `|ln Z|` stays below 2^13, so that its rounding leaves more than 38 bits of Z.
    fn start(&self, right: &N) -> Option<N> {
        step();
        let bits = (right.bits() > 53).then_some(right.bits())?;
        // Of the coefficients the first is positive; the others may be 0.
        let logs = [0, 1, 2].map(|k| right.ln() - self.c[k].ln());
        let least = logs.iter().zip([1.0, 2.0, 3.0]).fold(f64::INFINITY, |least, (log, power)| least.min(log / power));
        let c = [0, 1, 2].map(|k| ((k + 1) as f64 * least - logs[k]).exp());
        let y = Cubic { c, j: [0.0; 3] }.guess(1.0);
        let exponent = (least / LN_2).round();
        let rest = y * (least - exponent * LN_2).exp();
        (exponent.is_finite() && rest.is_normal()).then(|| N::power_of_two(exponent as i32, bits).times(rest))
    }

    /// s at height z.
    pub(super) fn slope_at(&self, z: &N) -> Option<N> {
        let ([c0, c1, c2], [j0, j1, j2]) = (&self.c, &self.j);
        let rise = formula!((3.0 * (c2 * z) + 2.0 * c1) * z + c0);
        formula!((j2 * z + j1) * z + j0).over(&rise)
    }
}

/// Newton steps from a good double to a precision.
pub(super) fn polishing(bits: usize) -> usize {
    if bits <= 53 { 0 } else { (bits / 44).ilog2() as usize + 1 }
}
