//! Reachable end points, from the end data and the curve itself: tangents, curvatures and positions of the control
//! polygon.

use super::iv::{Iv, Sure, Unsure};
use super::poly::{Poly, Sturm};
use spiral_atlas::family::reach::Kind;

/// A segment with its shape and what is true of it, as bits EXISTS, EXACT, THEOREM, PAPER.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape {
    pub m: f64,
    pub q: f64,
    pub flags: u8,
}

/// The segments of cases 1 and 2, if any.
pub(crate) type Verdict = [Option<Shape>; 2];

/// Judges an end point with as many bits as it takes.
pub(crate) fn judge(kind: Kind, theta: f64, xi: f64, eta: f64) -> Verdict {
    [0, 1].map(|case| {
        let mut bits = 256;
        loop {
            match at(kind, case, theta, xi, eta, bits) {
                Ok(shape) => return shape,
                Err(Unsure) => bits *= 2,
            }
            assert!(bits <= 40960, "{kind:?} {case} {theta:?} {xi:?} {eta:?}");
        }
    })
}

/// Curve coefficients (m, q), and the Bernstein coefficients of the (square root of the) hodograph, up to a positive
/// factor.
struct Curve {
    m: Iv,
    q: Iv,
    legs: [[Iv; 2]; 3],
}

fn at(kind: Kind, case: usize, theta: f64, xi: f64, eta: f64, bits: usize) -> Sure<Option<Shape>> {
    let curve = match kind {
        Kind::Cubic => cubic(case, theta, xi, eta, bits)?,
        Kind::Ph => ph(case, theta, xi, eta, bits)?,
    };
    let Some(Curve { m, q, legs }) = curve else { return Ok(None) };
    let slope = match kind {
        Kind::Cubic => cubic_slope(&legs),
        Kind::Ph => ph_slope(&legs),
    };
    let exact = non_negative(&if case == 0 { slope } else { slope.times(-1.0) }, bits)?;
    let (theorem, paper) = printed(kind, &m, &q, theta, bits)?;
    let flags = 1 | u8::from(exact) << 1 | u8::from(theorem) << 2 | u8::from(paper) << 3;
    Ok(Some(Shape { m: m.to_f64()?, q: q.to_f64()?, flags }))
}

/// `z' = a0 (1-t)² + 2 a1 t(1-t) + a2 t²`, so `z(1) = (a0 + a1 + a2)/3`; r is 1.
fn cubic(case: usize, theta: f64, xi: f64, eta: f64, bits: usize) -> Sure<Option<Curve>> {
    let (s, c) = Iv::sin_cos(theta, bits);
    let (xi, eta, zero) = (Iv::new(xi, bits), Iv::new(eta, bits), Iv::new(0.0, bits));
    let up = eta.over(&s)?.times(3.0);
    if case == 0 {
        // No curvature at the start: a1 along the x axis. a2 = d (cos θ, sin θ) gives y(1), and 2 a1 × a2 = d³ the
        // curvature 1.
        let d = up;
        if !d.positive()? {
            return Ok(None);
        }
        let middle = d.square().over(&s.times(2.0))?;
        let first = &xi.times(3.0) - &(&middle + &(&d * &c));
        if !first.positive()? {
            return Ok(None);
        }
        let legs = [[first.clone(), zero.clone()], [middle.clone(), zero], [&d * &c, &d * &s]];
        return Ok(Some(Curve { m: first.over(&middle)?, q: d, legs }));
    }
    // No curvature at the end: a1 along a2. a0 = (p, 0) from what is left of x(1), 2 a0 × a1 = p³ the curvature 1.
    let p = &xi.times(3.0) - &(&up * &c);
    if !p.positive()? {
        return Ok(None);
    }
    let middle = p.square().over(&s.times(2.0))?;
    let last = &up - &middle;
    if !last.positive()? {
        return Ok(None);
    }
    let along = |f: &Iv| [f * &c, f * &s];
    let legs = [[p.clone(), zero], along(&middle), along(&last)];
    Ok(Some(Curve { m: last.over(&middle)?, q: p, legs }))
}

/// `z' = w²`, `w = w0 (1-t)² + 2 w1 t(1-t) + w2 t²`, so `5 z(1) = w0² + w0 w1 + (2 w1² + w0 w2)/3 + w1 w2 + w2²`.
fn ph(case: usize, theta: f64, xi: f64, eta: f64, bits: usize) -> Sure<Option<Curve>> {
    let ((s, c), (sh, ch)) = (Iv::sin_cos(theta, bits), Iv::sin_cos(theta / 2.0, bits));
    let (xi, eta, zero, one) = (Iv::new(xi, bits), Iv::new(eta, bits), Iv::new(0.0, bits), Iv::new(1.0, bits));
    // The round end has |w|² = q, the flat one |w| = Y/√q, and curvature 1 makes the middle one q√q / (4 sin θ/2).
    // Across the flat end's tangent the end point lies at `5 across = q sin θ + q²/4 + Y sin(θ/2)/3`.
    let across = if case == 0 { eta.clone() } else { &(&xi * &s) - &(&eta * &c) };
    let poly = |c: &[&Iv]| Poly::new(c.iter().map(|c| (*c).clone()).collect());
    let by = |p: &Poly, f: &Iv| Poly::new(p.0.iter().map(|c| c * f).collect());
    let three = Iv::new(3.0, bits).over(&sh)?;
    let y = by(&poly(&[&across.times(5.0), &-&s, &Iv::new(-0.25, bits)]), &three);
    let quarter = Iv::new(0.25, bits).over(&sh)?;
    let q1 = poly(&[&zero, &one]);
    let q2 = q1.mul(&q1);
    let q4 = q2.mul(&q2);
    // The other coordinate times q.
    let square = y.mul(&y);
    let middle2 = by(&q4, &quarter.square()).times(2.0);
    let rest = if case == 0 {
        // x: w0 = Y/√q, w1 = real, w2 = √q (cos θ/2, sin θ/2)
        let thirds = middle2.add(&by(&y.mul(&q1), &ch));
        let ends = square.add(&by(&q2, &c));
        let mixed = by(&y.mul(&q2), &quarter).add(&by(&q2.mul(&q1), &(&quarter * &ch)));
        ends.add(&mixed).add(&by(&thirds, &one.over(&Iv::new(3.0, bits))?)).add(&q1.times(-5.0).mul(&poly(&[&xi])))
    } else {
        // y: w0 = √q real, w1 and w2 along (cos θ/2, sin θ/2)
        let thirds = by(&middle2, &s).add(&by(&y.mul(&q1), &sh));
        let mixed = q2.mul(&q1).times(0.25).add(&by(&y.mul(&q2), &(&quarter * &s)));
        by(&square, &s)
            .add(&mixed)
            .add(&by(&thirds, &one.over(&Iv::new(3.0, bits))?))
            .add(&q1.times(-5.0).mul(&poly(&[&eta])))
    };
    if !across.positive()? {
        return Ok(None);
    }
    // Y > 0 needs q² < 20 across.
    let power = Iv::power_of_two(across.times(20.0).sqrt().exponent() + 1, bits);
    let chain = Sturm::new(&rest)?;
    let end =
        [1.0, 1.25, 1.375].map(|w| power.times(w)).into_iter().find(|e| chain.changes(e).is_ok()).ok_or(Unsure)?;
    let mut found = None;
    for q in chain.roots(&zero, &end)? {
        let flat = y.at(&q);
        if !flat.positive()? {
            continue;
        }
        assert!(found.is_none(), "two segments: {theta:?} {xi:?} {eta:?}");
        // Everything over √q.
        let (flat, middle) = (flat.over(&q)?, &q * &quarter);
        let along = |f: &Iv| [f * &ch, f * &sh];
        let level = |f: &Iv| [f.clone(), zero.clone()];
        let legs = if case == 0 {
            [level(&flat), level(&middle), along(&one)]
        } else {
            [level(&one), along(&middle), along(&flat)]
        };
        found = Some(Curve { m: flat.over(&middle)?, q, legs });
    }
    Ok(found)
}

/// Power coefficients of the two coordinates.
fn coordinates(legs: &[[Iv; 2]; 3]) -> [Poly; 2] {
    [0, 1].map(|i| {
        let [a, b, c] = [&legs[0][i], &legs[1][i], &legs[2][i]];
        Poly::new(vec![a.clone(), (b - a).times(2.0), &(a - &b.times(2.0)) + c])
    })
}

/// `a b' - a' b` of two quadratics, whose cubic term cancels by itself.
fn wronskian(a: &Poly, b: &Poly) -> Poly {
    let mut w = a.mul(&b.derivative()).add(&b.mul(&a.derivative()).times(-1.0));
    w.0.truncate(3);
    w
}

/// `|z'|² (z' × z'')' - 3 (z' × z'') (z' · z'')`.
fn cubic_slope(legs: &[[Iv; 2]; 3]) -> Poly {
    let [x, y] = coordinates(legs);
    let turn = wronskian(&x, &y);
    let speed = x.mul(&x).add(&y.mul(&y));
    let pull = x.mul(&x.derivative()).add(&y.mul(&y.derivative()));
    speed.mul(&turn.derivative()).add(&turn.mul(&pull).times(-3.0))
}

/// κ is `2 (u v' - u' v) / (u² + v²)²`.
fn ph_slope(legs: &[[Iv; 2]; 3]) -> Poly {
    let [u, v] = coordinates(legs);
    let turn = wronskian(&u, &v);
    let speed = u.mul(&u).add(&v.mul(&v));
    speed.mul(&turn.derivative()).add(&turn.mul(&speed.derivative()).times(-2.0))
}

/// Whether a polynomial is at least 0 on [0, 1]. The cubic's has no slope at its flat end, where no chain can be
/// decided: a little of the interval is left to interval arithmetic on both sides.
fn non_negative(p: &Poly, bits: usize) -> Sure<bool> {
    let (zero, one) = (Iv::new(0.0, bits), Iv::new(1.0, bits));
    if !p.at(&zero).positive()? || !p.at(&one).positive()? {
        return Ok(false);
    }
    let chain = Sturm::new(p)?;
    if !chain.simple() {
        return Err(Unsure);
    }
    let power = |k: i32| Iv::power_of_two(-k, bits);
    let positive = |on: Iv| p.at(&on).positive() == Ok(true);
    let steps = || 3..(bits / 4) as i32;
    let low = steps().map(power).find(|x| positive(zero.to(x)) && chain.changes(x).is_ok()).ok_or(Unsure)?;
    let high =
        steps().map(|k| &one - &power(k)).find(|x| positive(x.to(&one)) && chain.changes(x).is_ok()).ok_or(Unsure)?;
    Ok(chain.count(&low, &high)? == 0)
}

/// Theorems 2.1 and 3.1 and the drawn region, as printed (with the root of the fourth term over all of its sum).
fn printed(kind: Kind, m: &Iv, q: &Iv, theta: f64, bits: usize) -> Sure<(bool, bool)> {
    let ((s, c), (sh, ch)) = (Iv::sin_cos(theta, bits), Iv::sin_cos(theta / 2.0, bits));
    let s2 = (&s * &c).times(2.0);
    let m4 = &m.times(-1.0).plus(4.0) * m;
    let (least_m, first) = match kind {
        Kind::Cubic => (Iv::new(3.0, bits).over(&Iv::new(10.0, bits))?, (&m.plus(4.0) * &s).over(&c.times(3.0))?),
        Kind::Ph => (Iv::new(3.0, bits).over(&Iv::new(7.0, bits))?, (&m.plus(6.0) * &sh).over(&ch.times(2.0))?),
    };
    let star = match kind {
        Kind::Cubic => Iv::new(6.0, bits).sqrt().plus(-1.0).times(2.0).over(&Iv::new(5.0, bits))?,
        Kind::Ph => Iv::new(30.0, bits).sqrt().plus(-3.0).times(2.0).over(&Iv::new(7.0, bits))?,
    };
    let reaches = |bound: &Iv| (q - bound).at_least_zero();
    let paper = (m - &star).at_least_zero()? && reaches(&first)?;
    if !(m - &least_m).positive()? {
        return Ok((false, paper));
    }
    let others = match kind {
        Kind::Cubic => {
            let line = &m.times(-4.0).plus(5.0) * &c;
            let root = (&m.times(60.0) + &line.square()).sqrt();
            [
                (&m4 * &s2).times(2.0).over(&m.times(13.0).plus(-2.0))?,
                (m * &s2).times(2.0).over(&m.times(10.0).plus(-3.0))?,
                (&(&line + &root) * &s).over(&Iv::new(6.0, bits))?,
            ]
        }
        Kind::Ph => {
            let line = &m.times(-3.0).plus(4.0) * &s;
            let root = (&(m * &sh.square()).times(112.0) + &line.square()).sqrt();
            [
                (&m4 * &s).times(3.0).over(&m.times(9.0).plus(-2.0))?,
                (m * &s).times(3.0).over(&m.times(7.0).plus(-3.0))?,
                (&line + &root).times(0.25),
            ]
        }
    };
    let mut all = reaches(&first)?;
    for bound in &others {
        all = all && reaches(bound)?;
    }
    Ok((all, paper))
}
