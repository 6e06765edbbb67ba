//! Quintic trigonometric curves from the printed basis and control points: curvature by its definition, signs by
//! Sturm's chain.

use super::iv::{Iv, Sure, Unsure};
use super::poly::{Poly, Sturm};

pub(crate) const END_RISES: u8 = 1;
pub(crate) const SPIRAL: u8 = 2;
pub(crate) const PRINTED_RATIO: u8 = 4;
pub(crate) const END_CURVATURE_AS_PRINTED: u8 = 8;

/// The flags of `[ratio, θ, m, p, q]`, with as many bits as it takes.
pub(crate) fn judge(shape: [f64; 5]) -> u8 {
    let mut bits = 256;
    loop {
        match at(shape, bits) {
            Ok(flags) => return flags,
            Err(Unsure) => bits *= 2,
        }
        assert!(bits <= 40960, "{shape:?}");
    }
}

fn at([ratio, theta, m, p, q]: [f64; 5], bits: usize) -> Sure<u8> {
    let n = |x: f64| Iv::new(x, bits);
    // The end curvature of (9) as printed, from the last two sides of the polygon: 12 ΔP3 × ΔP4 / ((4 + q)² |ΔP4|³).
    let points = control_points(ratio, theta, m, bits)?;
    let side = |i: usize| [&points[i + 1][0] - &points[i][0], &points[i + 1][1] - &points[i][1]];
    let (before, last) = (side(3), side(4));
    let cross = &(&before[0] * &last[1]) - &(&before[1] * &last[0]);
    let length = (&last[0].square() + &last[1].square()).sqrt();
    let curvature = cross.times(12.0).over(&(&n(q).plus(4.0).square() * &(&length.square() * &length)))?;
    // r = 1.
    let near = (&n(0.01) - &curvature.plus(-1.0)).positive()? && curvature.plus(-1.0).plus(0.01).positive()?;
    let slope = numerator(&points, p, q, bits)?;
    // Both hold at their ties, which doubles can meet: 2 ratio against 6 + m in whole numbers of bits, κ'(1) by its own
    // formula.
    let printed = (&n(ratio).times(2.0) - &n(m).plus(6.0)).at_least_zero()?;
    let rises = (&n(ratio).times(9.0) - &n(q).plus(1.0).times(20.0)).at_least_zero()?;
    let end = slope.at(&n(1.0));
    if let Ok(sign) = end.sign() {
        assert_eq!(sign.is_ge(), rises, "κ'(1) is not 9 ratio - 20 (1 + q): {ratio} {q}");
    }
    let tie = (&n(ratio).times(9.0) - &n(q).plus(1.0).times(20.0)).is_exact_zero();
    let spiral = rises && never_negative(&slope, tie, bits)?;
    let set = |holds: bool, flag: u8| if holds { flag } else { 0 };
    Ok(set(rises, END_RISES) | set(spiral, SPIRAL) | set(printed, PRINTED_RATIO) | set(near, END_CURVATURE_AS_PRINTED))
}

/// (3) with (9), r = 1.
fn control_points(ratio: f64, theta: f64, m: f64, bits: usize) -> Sure<Vec<[Iv; 2]>> {
    let (sine, cosine) = Iv::sin_cos(theta / 2.0, bits);
    let s = &sine.over(&cosine)? * &Iv::new(ratio, bits);
    let d = s.sqrt();
    let u1 = (&d * &s).over(&sine.times(4.0))?;
    let zero = Iv::new(0.0, bits);
    let w = [[&u1 * &Iv::new(m, bits), zero.clone()], [u1, zero.clone()], [&d * &cosine, &d * &sine]];
    let product = |i: usize, j: usize| {
        let ([a, b], [c, e]) = (&w[i], &w[j]);
        [&(a * c) - &(b * e), &(a * e) + &(b * c)]
    };
    let over =
        |v: [Iv; 2], n: f64| -> Sure<[Iv; 2]> { Ok([v[0].over(&Iv::new(n, bits))?, v[1].over(&Iv::new(n, bits))?]) };
    let ([a, b], [c, e]) = (product(1, 1), product(0, 2));
    let middle = [&a.times(2.0) + &c, &b.times(2.0) + &e];
    let steps = [
        over(product(0, 0), 5.0)?,
        over(product(0, 1), 5.0)?,
        over(middle, 15.0)?,
        over(product(1, 2), 5.0)?,
        over(product(2, 2), 5.0)?,
    ];
    let mut points = vec![[zero.clone(), zero]];
    for [x, y] in steps {
        let [px, py] = &points[points.len() - 1];
        let next = [px + &x, py + &y];
        points.push(next);
    }
    Ok(points)
}

/// The basis (2) times `(1 + τ²)⁵`, in powers of `τ = tan(πt/4)`.
fn basis(p: f64, q: f64, bits: usize) -> [Poly; 6] {
    let poly = |c: &[f64]| Poly::new(c.iter().map(|x| Iv::new(*x, bits)).collect());
    let (s, c, v) = (poly(&[0.0, 2.0]), poly(&[1.0, 0.0, -1.0]), poly(&[1.0, 0.0, 1.0]));
    let less = |x: &Poly| v.add(&x.times(-1.0));
    let power = |x: &Poly, n: usize| (1..n).fold(x.clone(), |product, _| product.mul(x));
    let end = |x: &Poly, p: f64| power(&less(x), 4).mul(&v.add(&x.mul(&poly(&[-p]))));
    let next = |x: &Poly, p: f64| {
        let factor = v.times(4.0).add(&v.add(&x.times(-1.0)).mul(&poly(&[p])));
        x.mul(&power(&less(x), 3)).mul(&factor)
    };
    let middle = |x: &Poly, y: &Poly| {
        let factor = x.times(8.0).add(&y.times(3.0)).add(&v.times(9.0));
        power(&less(x), 2).mul(&less(y)).mul(&factor).mul(&v)
    };
    [end(&s, p), next(&s, p), middle(&s, &c), middle(&c, &s), next(&c, q), end(&c, q)]
}

/// The numerator of κ' by τ, without its factor τ; a positive factor is left out.
fn numerator(points: &[[Iv; 2]], p: f64, q: f64, bits: usize) -> Sure<Poly> {
    let v = Poly::new([1.0, 0.0, 1.0].map(|x| Iv::new(x, bits)).to_vec());
    let tau = Poly::new([0.0, 1.0].map(|x| Iv::new(x, bits)).to_vec());
    let basis = basis(p, q, bits);
    // z = Z/V⁵, z' = (Z' V - 10 τ Z)/V⁶; what cancels is cut off.
    let hodograph = |axis: usize| {
        let z = basis.iter().zip(points).map(|(g, point)| g.mul(&Poly::new(vec![point[axis].clone()])));
        let z = z.reduce(|a, b| a.add(&b)).expect("six");
        let mut h = z.derivative().mul(&v).add(&tau.mul(&z).times(-10.0));
        h.0.truncate(11);
        h
    };
    let (x, y) = (hodograph(0), hodograph(1));
    let mut cross = x.mul(&y.derivative()).add(&y.mul(&x.derivative()).times(-1.0));
    cross.0.truncate(19);
    // The first two sides are parallel: κ has a double zero at the start.
    let zero = Iv::new(0.0, bits);
    for c in &mut cross.0[..2] {
        assert!(c.sign().is_err() || c.is_exact_zero(), "not parallel");
        *c = zero.clone();
    }
    let square = x.mul(&x).add(&y.mul(&y));
    // κ is cross V⁶ / square^(3/2).
    let rising = cross.derivative().mul(&v).mul(&square);
    let through_v = tau.mul(&cross).mul(&square).times(12.0);
    let falling = cross.mul(&v).mul(&square.derivative()).times(-1.5);
    let mut all = rising.add(&through_v).add(&falling);
    all.0.truncate(39);
    let mut slope = all.0.split_off(1);
    // Without p and q the hodograph has the factor V, and this its fourth power, which no Sturm chain would survive.
    if p == 0.0 && q == 0.0 {
        for _ in 0..4 {
            for i in (0..slope.len() - 2).rev() {
                slope[i] = &slope[i] - &slope[i + 2];
            }
            slope.drain(..2);
        }
    }
    Ok(Poly(slope))
}

/// Whether a polynomial with a positive value at 0 is at least 0 on [0, 1]; it has no multiple roots. With a root at 1
/// itself there must be one before.
fn never_negative(p: &Poly, root_at_1: bool, bits: usize) -> Sure<bool> {
    let (zero, mut one) = (Iv::new(0.0, bits), Iv::new(1.0, bits));
    assert!(p.at(&zero).positive()?, "κ' falls at the start");
    if root_at_1 {
        one = one.plus(-(2f64.powi(-30)));
    } else if !p.at(&one).positive()? {
        return Ok(false);
    }
    let roots = Sturm::new(p)?.count(&zero, &one)?;
    assert!(roots > 0 || !root_at_1, "a spiral with κ'(1) = 0");
    Ok(roots == 0)
}
