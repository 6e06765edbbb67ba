//! PH quintics with given ends, from the pre-image itself: the chord's two components are polynomials in A² and B/A, a
//! resultant leaves one in B/A, and Sturm's theorem finds its roots.

use super::curve::{Frame, non_negative};
use super::iv::{Iv, Sure, Unsure};
use super::margin::margin;
use super::poly::{Poly, Sturm};
use super::{any_spiral, climb};

/// One solution: nearest doubles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Curve {
    pub a: f64,
    pub b: f64,
    pub length: f64,
    /// By quadrature, about; NaN where one end is so much faster than the other that a peak of the curvature is too
    /// narrow for it.
    pub energy: f64,
    pub margin: f64,
    pub spiral: bool,
}

/// All that can be said of a datum; solutions by increasing A.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Verdict {
    pub flags: u8,
    pub curves: Vec<Curve>,
}

impl Verdict {
    pub(crate) fn solutions(&self) -> u8 {
        self.curves.len() as u8 | (self.curves.iter().filter(|c| c.spiral).count() as u8) << 3
    }

    /// The spiral of least energy.
    pub(crate) fn chosen(&self) -> Option<&Curve> {
        self.curves.iter().filter(|c| c.spiral).reduce(|best, c| if c.energy < best.energy { c } else { best })
    }
}

/// Judges `(φ0, φ1, κ0, κ1)`, all taken as exact; not both curvatures 0.
pub(crate) fn judge(datum: [f64; 4]) -> Verdict {
    climb(|bits| attempt(datum, bits)).0
}

fn attempt([phi0, phi1, kappa0, kappa1]: [f64; 4], bits: usize) -> Sure<Verdict> {
    let frame = Frame::new(phi0, phi1, bits)?;
    let (k0, k1) = (Iv::new(kappa0, bits), Iv::new(kappa1, bits));
    let any = phi0 < phi1 && kappa0 < kappa1 && any_spiral(&frame, &k0, &k1)?.0;
    let mut curves = vec![];
    if kappa0 >= 0.0 && kappa1 >= 0.0 {
        let ends = Ends::new(phi0, phi1, [&k0, &k1], bits)?;
        let solutions = if kappa1 == 0.0 {
            // The mirror image, run backwards: the resultant's degree falls when κ1 is 0, but not when κ0 is.
            let found = Ends::new(phi1, phi0, [&k1, &k0], bits)?.solutions(bits)?;
            found.into_iter().map(|(b, a)| (a, b)).collect()
        } else {
            ends.solutions(bits)?
        };
        for (a, b) in solutions {
            curves.push(ends.curve(&a, &b, bits)?);
        }
        curves.sort_by(|one, two| one.a.total_cmp(&two.a));
    }
    let spiral = curves.iter().any(|c| c.spiral);
    let flags = [!curves.is_empty(), spiral, any].iter().enumerate().map(|(bit, yes)| u8::from(*yes) << bit).sum();
    Ok(Verdict { flags, curves })
}

/// A polynomial in A whose coefficients are polynomials in ρ = B/A.
type Double = Vec<Poly>;

fn times(x: &Double, y: &Double) -> Double {
    let mut sum = vec![Poly(vec![]); x.len() + y.len()];
    for (i, p) in x.iter().enumerate() {
        for (j, q) in y.iter().enumerate() {
            sum[i + j] = sum[i + j].add(&p.mul(q));
        }
    }
    sum
}

fn plus(x: &Double, y: &Double) -> Double {
    let none = Poly(vec![]);
    (0..x.len().max(y.len())).map(|i| x.get(i).unwrap_or(&none).add(y.get(i).unwrap_or(&none))).collect()
}

/// The known parts of a datum's pre-image: `w1 = (β B³, α A³)` in the basis e^{-iφ0/2}, e^{iφ1/2}.
struct Ends {
    bends: [Iv; 2],
    /// Real and imaginary parts of the basis.
    basis: [[Iv; 2]; 2],
}

impl Ends {
    fn new(phi0: f64, phi1: f64, kappa: [&Iv; 2], bits: usize) -> Sure<Ends> {
        let ((s0, c0), (s1, c1)) = (Iv::sin_cos(0.5 * phi0, bits), Iv::sin_cos(0.5 * phi1, bits));
        // Halves of subnormal angles are not doubles.
        if 0.5 * phi0 * 2.0 != phi0 || 0.5 * phi1 * 2.0 != phi1 {
            return Err(Unsure);
        }
        // conj(w0) × w1 = α A⁴ sin Φ must be κ0 A⁴/4.
        let sine = &(&s0 * &c1) + &(&c0 * &s1);
        let bend = |kappa: &Iv| kappa.over(&sine.times(4.0));
        Ok(Ends { bends: [bend(kappa[0])?, bend(kappa[1])?], basis: [[c0, -&s0], [c1, s1]] })
    }

    /// `15 ∫ w²` by components along the basis's three products, then real and imaginary parts: polynomials in A.
    fn chord(&self, bits: usize) -> [Double; 2] {
        let number = |x: f64| Iv::new(x, bits);
        let monomial = |c: &Iv, power: usize| {
            let mut v = vec![number(0.0); power];
            v.push(c.clone());
            Poly::new(v)
        };
        let at = |power: usize, p: Poly| {
            let mut v = vec![Poly(vec![]); power];
            v.push(p);
            v
        };
        let one = number(1.0);
        let zero: Double = vec![];
        let w = [
            [at(1, monomial(&one, 0)), zero.clone()],
            [at(3, monomial(&self.bends[1], 3)), at(3, monomial(&self.bends[0], 0))],
            [zero, at(1, monomial(&one, 1))],
        ];
        let weights = [(0, 0, 3.0), (0, 1, 3.0), (1, 1, 2.0), (0, 2, 1.0), (1, 2, 3.0), (2, 2, 3.0)];
        let mut parts = [vec![], vec![], vec![]];
        for (i, j, weight) in weights {
            let scaled = |p: Double| p.iter().map(|c| c.times(weight)).collect::<Double>();
            let products = [
                times(&w[i][0], &w[j][0]),
                plus(&times(&w[i][0], &w[j][1]), &times(&w[i][1], &w[j][0])),
                times(&w[i][1], &w[j][1]),
            ];
            for (part, product) in parts.iter_mut().zip(products) {
                *part = plus(part, &scaled(product));
            }
        }
        let product =
            |x: &[Iv; 2], y: &[Iv; 2]| [&(&x[0] * &y[0]) - &(&x[1] * &y[1]), &(&x[0] * &y[1]) + &(&x[1] * &y[0])];
        let [f, g] = &self.basis;
        let units = [product(f, f), product(f, g), product(g, g)];
        [0, 1].map(|k| {
            let scaled = |part: &Double, unit: &Iv| {
                part.iter().map(|c| Poly::new(c.0.iter().map(|x| x * unit).collect())).collect()
            };
            let terms: Vec<Double> = parts.iter().zip(&units).map(|(part, unit)| scaled(part, &unit[k])).collect();
            plus(&plus(&terms[0], &terms[1]), &terms[2])
        })
    }

    /// All A, B > 0 with chord 2: `15 ∫ w² = 30`.
    fn solutions(&self, bits: usize) -> Sure<Vec<(Iv, Iv)>> {
        let [real, imaginary] = self.chord(bits);
        // In z = A²: a cubic with constant -30, and a quadratic after division by z.
        let cubic = [Poly::new(vec![Iv::new(-30.0, bits)]), real[2].clone(), real[4].clone(), real[6].clone()];
        let quadratic = [imaginary[2].clone(), imaginary[4].clone(), imaginary[6].clone()];
        let none = || Poly(vec![]);
        let mut rows = vec![];
        for shift in 0..3 {
            let mut row = vec![none(), none(), none(), none(), none()];
            for (i, c) in quadratic.iter().enumerate() {
                row[4 - shift - i] = c.clone();
            }
            rows.push(row);
        }
        for shift in 0..2 {
            let mut row = vec![none(), none(), none(), none(), none()];
            for (i, c) in cubic.iter().enumerate() {
                row[4 - shift - i] = c.clone();
            }
            rows.push(row);
        }
        let mut resultant = determinant(&rows);
        if self.bends[0].is_exact_zero() {
            // Then the lowest parts of both polynomials in ρ³z share the factor 3 + 3βz + 2β²z², so the lowest
            // coefficients are 0, which intervals show as uncertain signs.
            let common =
                resultant.0.iter().take_while(|c| c.sign().is_ok_and(|s| s.is_eq()) || c.sign().is_err()).count();
            resultant.0.drain(..common);
        }
        let chain = Sturm::new(&resultant)?;
        let low = Iv::power_of_two(-1060, bits);
        let high = Iv::power_of_two(bound(&resultant)?, bits);
        let mut found = vec![];
        for rho in chain.roots(&low, &high)? {
            // Cubic and quadratic reduce each other to a line in z.
            let c = cubic.each_ref().map(|p| p.at(&rho));
            let q = quadratic.each_ref().map(|p| p.at(&rho));
            let step = |top: &Iv, x: &Iv, y: &Iv| &(&q[2] * x) - &(top * y);
            let second = [&q[2] * &c[0], step(&c[3], &c[1], &q[0]), step(&c[3], &c[2], &q[1])];
            let line = [step(&second[2], &second[0], &q[0]), step(&second[2], &second[1], &q[1])];
            let z = (-&line[0]).over(&line[1])?;
            if z.positive()? {
                let a = z.sqrt();
                found.push((a.clone(), &a * &rho));
            }
        }
        Ok(found)
    }

    fn curve(&self, a: &Iv, b: &Iv, bits: usize) -> Sure<Curve> {
        let cube = |x: &Iv| &x.square() * x;
        let (p, q) = (&self.bends[0] * &cube(a), &self.bends[1] * &cube(b));
        let [f, g] = &self.basis;
        let zero = Iv::new(0.0, bits);
        let along = |x: &Iv, y: &Iv, k: usize| &(x * &f[k]) + &(y * &g[k]);
        // Powers of t of the real and the imaginary part.
        let part = |k: usize| {
            let (w0, w1, w2) = (along(a, &zero, k), along(&q, &p, k), along(&zero, b, k));
            Poly::new(vec![w0.clone(), (&w1 - &w0).times(2.0), &(&w0 - &w1.times(2.0)) + &w2])
        };
        let (u, v) = (part(0), part(1));
        let speed = u.mul(&u).add(&v.mul(&v));
        let mut turn = u.mul(&v.derivative()).add(&v.mul(&u.derivative()).times(-1.0));
        // The terms of third degree cancel.
        turn.0.truncate(3);
        let slope = turn.derivative().mul(&speed).add(&turn.mul(&speed.derivative()).times(-2.0));
        let mut length = zero;
        for (i, c) in speed.0.iter().enumerate() {
            length = &length + &c.over(&Iv::new(i as f64 + 1.0, bits))?;
        }
        let doubles = |p: &Poly| p.0.iter().map(Iv::approx).collect::<Vec<f64>>();
        Ok(Curve {
            a: a.to_f64()?,
            b: b.to_f64()?,
            length: length.to_f64()?,
            energy: if (1e-4..1e4).contains(&(a.approx() / b.approx())) {
                energy(&doubles(&turn), [&doubles(&u), &doubles(&v)])
            } else {
                f64::NAN
            },
            margin: margin(&slope, bits)?,
            spiral: non_negative(&slope, bits)?,
        })
    }
}

/// `∫ (2 turn)² / |w|⁶` by Simpson's rule, halved until it stands still.
///
/// A piece is done when halving it changes its own part, which is positive, by less than 1e-10 of it. Roundings are far
/// below that, even where w is small: its square is a sum of squares.
fn energy(turn: &[f64], w: [&[f64]; 2]) -> f64 {
    let value = |c: &[f64], x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
    let f = |x: f64| 4.0 * value(turn, x).powi(2) / w.iter().map(|c| value(c, x).powi(2)).sum::<f64>().powi(3);
    fn refine(f: &dyn Fn(f64) -> f64, from: f64, to: f64, ends: [f64; 3], depth: u32) -> f64 {
        let middle = 0.5 * (from + to);
        let (left, right) = (f(0.5 * (from + middle)), f(0.5 * (middle + to)));
        let h = (to - from) / 12.0;
        let coarse = 2.0 * h * (ends[0] + 4.0 * ends[1] + ends[2]);
        let fine = h * (ends[0] + 4.0 * left + 2.0 * ends[1] + 4.0 * right + ends[2]);
        // The first halvings see what a few points would miss.
        if depth >= 40 || depth >= 8 && (fine - coarse).abs() <= fine * 1e-10 {
            return fine + (fine - coarse) / 15.0;
        }
        let low = refine(f, from, middle, [ends[0], left, ends[1]], depth + 1);
        low + refine(f, middle, to, [ends[1], right, ends[2]], depth + 1)
    }
    refine(&f, 0.0, 1.0, [f(0.0), f(0.5), f(1.0)], 0)
}

fn determinant(rows: &[Vec<Poly>]) -> Poly {
    if rows.is_empty() {
        return Poly(vec![]);
    }
    if rows.len() == 1 {
        return rows[0][0].clone();
    }
    let mut sum = Poly(vec![]);
    for (i, row) in rows.iter().enumerate() {
        if row[0].0.is_empty() {
            continue;
        }
        let minor: Vec<Vec<Poly>> =
            rows.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, row)| row[1..].to_vec()).collect();
        let term = row[0].mul(&determinant(&minor));
        sum = sum.add(&if i % 2 == 0 { term } else { term.times(-1.0) });
    }
    sum
}

/// An exponent beyond which no root has its size (Fujiwara).
fn bound(p: &Poly) -> Sure<i32> {
    let n = p.0.len() - 1;
    let top = p.0[n].magnitude();
    top.positive()?;
    let share = |i: usize| -> i32 {
        let e = p.0[i].magnitude().exponent();
        if e == i32::MIN { i32::MIN } else { (e - top.exponent() + 2).div_euclid((n - i) as i32) + 1 }
    };
    Ok((0..n).map(share).max().ok_or(Unsure)?.max(-1050) + 2)
}
