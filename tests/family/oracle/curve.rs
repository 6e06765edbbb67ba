//! The Bézier curve itself: its frame, the two end curvatures, the numerator of the curvature's derivative.

use super::iv::{Iv, Sure, Unsure};
use super::poly::{Poly, Sturm};
use std::cmp::Ordering;

/// What is asked at the ends, besides the angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Ends {
    /// Curvatures times half the chord.
    Curvature { kappa0: f64, kappa1: f64 },
    /// `a = κ0 d0² / (4 sin φ0)`, `k = κ1 d1² / (4 sin φ1)`, exactly.
    Normalised { a: f64, k: f64 },
}

/// The angles: control points are `p0`, `p0 + x u`, `p3 - y v`, `p3` with `x = f0`, `y = f1`.
pub(super) struct Frame {
    pub sin0: Iv,
    pub cos0: Iv,
    pub sin1: Iv,
    pub cos1: Iv,
    d0: Iv,
    d1: Iv,
    u: [Iv; 2],
    v: [Iv; 2],
    chord: [Iv; 2],
}

fn cross(a: &[Iv; 2], b: &[Iv; 2]) -> Iv {
    &(&a[0] * &b[1]) - &(&a[1] * &b[0])
}

fn cube(x: &Iv) -> Iv {
    x * &x.square()
}

impl Frame {
    pub(super) fn new(phi0: f64, phi1: f64, bits: usize) -> Sure<Frame> {
        let ((sin0, cos0), (sin1, cos1)) = (Iv::sin_cos(phi0, bits), Iv::sin_cos(phi1, bits));
        let sum = &(&sin0 * &cos1) + &(&cos0 * &sin1);
        let d0 = sin1.times(2.0).over(&sum)?;
        let d1 = sin0.times(2.0).over(&sum)?;
        let (third0, third1) = (d0.over(&Iv::new(3.0, bits))?, d1.over(&Iv::new(3.0, bits))?);
        let u = [&third0 * &cos0, -&(&third0 * &sin0)];
        let v = [&third1 * &cos1, &third1 * &sin1];
        Ok(Frame { sin0, cos0, sin1, cos1, d0, d1, u, v, chord: [Iv::new(2.0, bits), Iv::new(0.0, bits)] })
    }

    /// `(κ0, κ1)`.
    pub(super) fn curvatures(&self, ends: Ends) -> Sure<(Iv, Iv)> {
        let bits = self.d0.bits();
        match ends {
            Ends::Curvature { kappa0, kappa1 } => Ok((Iv::new(kappa0, bits), Iv::new(kappa1, bits))),
            Ends::Normalised { a, k } => Ok((
                self.sin0.times(4.0).times(a).over(&self.d0.square())?,
                self.sin1.times(4.0).times(k).over(&self.d1.square())?,
            )),
        }
    }

    /// The end curvatures as equations `y = A - B x²`, `x = C - E y²`: `[A, B, C, E]`.
    ///
    /// With `κ(0) = (2/3) (Δ0 × Δ1) / |Δ0|³`, `Δ0 = x u`, `Δ1 = chord - x u - y v`, the first is
    /// `(3/2) κ0 |u|³ x² = u × chord - y u × v`, and so at the other end.
    fn equations(&self, ends: Ends) -> Sure<[Iv; 4]> {
        let bits = self.d0.bits();
        let (kappa0, kappa1) = match ends {
            Ends::Curvature { kappa0, kappa1 } => (kappa0, kappa1),
            Ends::Normalised { a, k } => {
                let three = Iv::new(3.0, bits);
                return Ok([three.clone(), Iv::new(a, bits), three, Iv::new(k, bits)]);
            }
        };
        let area = cross(&self.u, &self.v);
        let bend = |kappa: f64, d: &Iv| cube(&d.over(&Iv::new(3.0, bits))?).times(1.5).times(kappa).over(&area);
        Ok([
            cross(&self.u, &self.chord).over(&area)?,
            bend(kappa0, &self.d0)?,
            cross(&self.chord, &self.v).over(&area)?,
            bend(kappa1, &self.d1)?,
        ])
    }

    /// Every `(f0, f1)` in (0, 3)² whose curve has the end curvatures, by increasing f0.
    pub(super) fn solve(&self, ends: Ends) -> Sure<Vec<(Iv, Iv)>> {
        let [a, b, c, e] = self.equations(ends)?;
        // With a curvature that is not positive one of the equations needs a number of at least 3.
        if b.sign()?.is_le() || e.sign()?.is_le() {
            return Ok(vec![]);
        }
        let bits = a.bits();
        let (zero, three) = (Iv::new(0.0, bits), Iv::new(3.0, bits));
        let ab = &a * &b;
        let quartic = Poly::new(vec![
            &c - &(&e * &a.square()),
            Iv::new(-1.0, bits),
            (&e * &ab).times(2.0),
            zero.clone(),
            -&(&e * &b.square()),
        ]);
        // Beyond sqrt(A / B) y is negative; a power of two at least that large is easier to look at.
        let power = Iv::power_of_two(a.over(&b)?.sqrt().exponent() + 1, bits);
        let chain = Sturm::new(&quartic)?;
        let ends = [1.0, 1.25, 1.375].map(|w| power.times(w)).into_iter().filter(|e| e.between(&zero, &three));
        let end = ends.chain([three.clone()]).find(|e| chain.changes(e).is_ok()).ok_or(Unsure)?;
        let mut found = vec![];
        for x in chain.roots(&zero, &end)? {
            let y = &a - &(&b * &x.square());
            if y.positive()? {
                let same = (&c - &x).over(&e)?.sqrt();
                found.push((x, y.meet(&same)));
            }
        }
        Ok(found)
    }

    /// `|P'|² d/dt(P' × P'') - 3 (P' × P'') (P' · P'')`, up to a positive factor: the numerator of κ'(t).
    ///
    /// In the oblique frame `u, v` the chord is `3u + 3v`, which keeps the parabola `x = y = 2` exact.
    pub(super) fn numerator(&self, x: &Iv, y: &Iv) -> Poly {
        let leg = |f: &Iv| [f.clone(), (-f).plus(3.0), Iv::new(0.0, f.bits())];
        let along_u = hodograph(&leg(x));
        let mut backwards = leg(y);
        backwards.reverse();
        let along_v = hodograph(&backwards);
        let (du, dv) = (along_u.derivative(), along_v.derivative());
        let dot = |a: &[Iv; 2], b: &[Iv; 2]| &(&a[0] * &b[0]) + &(&a[1] * &b[1]);
        let (uu, uv, vv) = (dot(&self.u, &self.u), dot(&self.u, &self.v), dot(&self.v, &self.v));
        let inner = |pu: &Poly, pv: &Poly, qu: &Poly, qv: &Poly| {
            let cross_terms = pu.mul(qv).add(&pv.mul(qu));
            scaled(&pu.mul(qu), &uu).add(&scaled(&cross_terms, &uv)).add(&scaled(&pv.mul(qv), &vv))
        };
        let speed = inner(&along_u, &along_v, &along_u, &along_v);
        let pull = inner(&along_u, &along_v, &du, &dv);
        // u × v > 0 is a common factor. The cubic terms of P' × P'' cancel by themselves.
        let mut turn = along_u.mul(&dv).add(&along_v.mul(&du).times(-1.0));
        turn.0.truncate(3);
        speed.mul(&turn.derivative()).add(&turn.mul(&pull).times(-3.0))
    }

    /// Kneser: whether the circle of curvature at the end lies strictly inside the one at the start.
    pub(super) fn nested(&self, kappa0: &Iv, kappa1: &Iv) -> Sure<(bool, f64)> {
        let one = Iv::new(1.0, kappa0.bits());
        let (r0, r1) = (one.over(kappa0)?, one.over(kappa1)?);
        let across = &(&self.chord[0] - &(&r1 * &self.sin1)) - &(&r0 * &self.sin0);
        let up = &(&r1 * &self.cos1) - &(&r0 * &self.cos0);
        let apart = &across.square() + &up.square();
        let room = (&r0 - &r1).square();
        let inside = (&r0 - &r1).positive()? && (&room - &apart).positive()?;
        Ok((inside, share(&(&room - &apart), &(&room + &apart))))
    }

    /// Kurnosenko's `Q = (κ0 - sin φ0)(κ1 - sin φ1) + sin²((φ1 - φ0)/2)`.
    pub(super) fn q(&self, kappa0: &Iv, kappa1: &Iv) -> (Iv, f64) {
        let product = &(kappa0 - &self.sin0) * &(kappa1 - &self.sin1);
        // sin²(δ/2) = sin²δ / (2 (1 + cos δ)), which cancels nowhere but in sin δ itself.
        let sine = &(&self.sin1 * &self.cos0) - &(&self.cos1 * &self.sin0);
        let cosine = &(&self.cos1 * &self.cos0) + &(&self.sin1 * &self.sin0);
        let half = sine.square().over(&cosine.plus(1.0).times(2.0)).unwrap_or_else(|_| (-&cosine).plus(1.0).times(0.5));
        let q = &product + &half;
        let scale = &product.magnitude() + &half;
        let gap = share(&q, &scale);
        (q, gap)
    }

    /// (A.9), the paper's discriminant from its own c0, c1, c2, λ, μ, and `κ1 > e0/3`.
    pub(super) fn solvable(&self, ends: Ends) -> Sure<(bool, f64)> {
        let bits = self.d0.bits();
        let (first, four_lambda3, mu2) = match ends {
            Ends::Curvature { kappa0, kappa1 } => {
                let (kappa0, kappa1) = (Iv::new(kappa0, bits), Iv::new(kappa1, bits));
                if kappa0.sign()?.is_le() || kappa1.sign()?.is_le() {
                    return Ok((false, 1.0));
                }
                let e0 = self.sin1.times(4.0).over(&self.d1.square())?;
                let e1 = cube(&self.sin0.over(&self.sin1)?);
                let first = kappa1.times(3.0).over(&e0)?.plus(-1.0);
                let e01 = &e0 * &e1;
                let below = &kappa0.square() * &kappa1;
                let room = &kappa1 - &e0.over(&Iv::new(3.0, bits))?;
                let c0 = (&e01.square().times(9.0) * &room).over(&below)?;
                let c1 = (&e01.square() * &e0).over(&below)?;
                let c2 = e01.times(6.0).over(&kappa0)?;
                let lambda = &c0.times(12.0) + &c2.square();
                let mu = &(&c1.square().times(27.0) + &(&c0 * &c2).times(72.0)) - &cube(&c2).times(2.0);
                (first, cube(&lambda).times(4.0), mu.square())
            }
            Ends::Normalised { a, k } => {
                if a <= 0.0 || k <= 0.0 {
                    return Ok((false, 1.0));
                }
                // c0 = 9 (1 - 1/(3k)) / a², c1 = 1/(a² k), c2 = 6/a; λ times a²k, μ times a⁴k², so that D is
                // multiplied by a⁸k⁴ > 0 and dyadic a, k give it exactly.
                let (a, k) = (Iv::new(a, bits), Iv::new(k, bits));
                let lambda = k.times(4.0).plus(-1.0).times(36.0);
                let ak = &a * &k;
                let mu = &(&ak * &k).times(3456.0).plus(27.0) - &ak.times(1296.0);
                (k.times(3.0).plus(-1.0), &(&cube(&lambda) * &a.square()).times(4.0) * &k, mu.square())
            }
        };
        let d = &four_lambda3 - &mu2;
        let gap = share(&d, &(&four_lambda3 + &mu2)).min(share(&first, &first.plus(2.0)));
        Ok((first.positive()? && d.at_least_zero()?, gap))
    }
}

fn scaled(p: &Poly, factor: &Iv) -> Poly {
    Poly::new(p.0.iter().map(|c| c * factor).collect())
}

/// `P'/3` of one coordinate from the legs of its control polygon.
fn hodograph(leg: &[Iv; 3]) -> Poly {
    let [a, b, c] = leg;
    Poly::new(vec![a.clone(), (b - a).times(2.0), &(a - &b.times(2.0)) + c])
}

/// `|part| / |whole|` as a double: how far a decision is from its boundary.
pub(super) fn share(part: &Iv, whole: &Iv) -> f64 {
    part.middle().over(&whole.middle()).map_or(0.0, |r| r.approx().abs())
}

/// Whether `q >= 0` on [0, 1]: no root inside at which it changes sign, and positive ends.
///
/// The chain is complete only when `q` has no multiple root, so each root inside is a change of sign.
pub(super) fn non_negative(q: &Poly, bits: usize) -> Sure<bool> {
    let (zero, one) = (Iv::new(0.0, bits), Iv::new(1.0, bits));
    if q.at(&zero).sign()? != Ordering::Greater || q.at(&one).sign()? != Ordering::Greater {
        return Ok(false);
    }
    if q.0.len() < 2 {
        return Ok(true);
    }
    let chain = Sturm::new(q)?;
    if !chain.simple() {
        return Err(Unsure);
    }
    Ok(chain.count(&zero, &one)? == 0)
}
