//! The bending energy `∫ κ² ds = ∫ h²/σ³ dξ` of a curve, enclosed.
//!
//! On a piece, centred so that it is `-1 <= u <= 1`, let `σ = c0 (1 + c1 u + ... + c4 u⁴)`. Where
//! `2|c1| + 4|c2| + 8|c3| + 16|c4| <= 3/4`, σ/c0 is at least 1/4 in the disc `|u| <= 2`, so `y = (σ/c0)^-3` is at most 64 there and its Taylor
//! coefficients at most `64 · 2^-m` (Cauchy). They follow from `σ y' = -3 σ' y`:
//! `(m + 1) y_{m+1} = -Σ c_j (m + 1 + 2j) y_{m+1-j}`. Other pieces are halved.

use crate::num::bernstein::halve;
use crate::num::{Number, Real};

/// `∫ h²/σ³` over [0, 1] for σ and h with these Bernstein coefficients; `None` when the precision does not suffice.
pub(crate) fn energy<N: Real>(speed: &[N; 5], turn: &[N; 3]) -> Option<N> {
    // One halving more for each halving of the distance to a zero of σ, as close as doubles can put it.
    let most = if speed[0].bits() <= 53 { 64 } else { 1000 };
    let mut sum = N::of(0.0, speed[0].bits());
    let mut waiting = vec![(speed.clone(), turn.clone(), 0)];
    while let Some((speed, turn, depth)) = waiting.pop() {
        if let Some(c) = centred(&speed)? {
            sum = sum.add(&series(&speed, &c, &turn)?.times(2f64.powi(-depth)));
            continue;
        }
        if depth == most {
            return None;
        }
        let ((s0, s1), (t0, t1)) = (halve(&speed), halve(&turn));
        waiting.push((s1, t1, depth + 1));
        waiting.push((s0, t0, depth + 1));
    }
    Some(sum)
}

fn combine<N: Number, const D: usize>(b: &[N; D], by: [f64; D]) -> N {
    let sum = b.iter().zip(by).filter(|(_, k)| *k != 0.0).map(|(x, k)| x.times(k));
    sum.reduce(|sum, x| sum.add(&x)).unwrap_or_else(|| b[0].clone())
}

fn middle<N: Number>(b: &[N; 5]) -> N {
    combine(b, [0.0625, 0.25, 0.375, 0.25, 0.0625])
}

/// `c1 .. c4`, if the disc of radius 2 is clear of the zeros of σ: `Some(None)` when that is not certain.
fn centred<N: Real>(b: &[N; 5]) -> Option<Option<[N; 4]>> {
    let c0 = middle(b);
    let c = [
        combine(b, [-0.25, -0.5, 0.0, 0.5, 0.25]).over(&c0)?,
        combine(b, [0.375, 0.0, -0.75, 0.0, 0.375]).over(&c0)?,
        combine(b, [-0.25, 0.5, 0.0, -0.5, 0.25]).over(&c0)?,
        combine(b, [0.0625, -0.25, 0.375, -0.25, 0.0625]).over(&c0)?,
    ];
    let weight: f64 = c.iter().zip([2.0, 4.0, 8.0, 16.0]).map(|(c, k)| c.most() * k).sum();
    // A little less than 3/4, for `most` is rounded.
    Some((weight < 0.749).then_some(c))
}

/// `∫ h² y` over -1 <= u <= 1, halved, over `c0³`.
fn series<N: Real>(speed: &[N; 5], c: &[N; 4], turn: &[N; 3]) -> Option<N> {
    let bits = speed[0].bits();
    let h = [combine(turn, [0.25, 0.5, 0.25]), combine(turn, [-0.5, 0.0, 0.5]), combine(turn, [0.25, -0.5, 0.25])];
    // h² in powers of u.
    let e = [
        h[0].mul(&h[0]),
        h[0].mul(&h[1]).times(2.0),
        h[1].mul(&h[1]).add(&h[0].mul(&h[2]).times(2.0)),
        h[1].mul(&h[2]).times(2.0),
        h[2].mul(&h[2]),
    ];
    let number = |x: f64| N::of(x, bits);
    // The last four coefficients, the latest first.
    let mut y = [number(1.0), number(0.0), number(0.0), number(0.0)];
    let mut sum = number(0.0);
    let terms = bits + 12;
    for m in 0..=terms {
        // ∫ u^(i + m) over [-1, 1], halved.
        let even = (0..5).filter(|i| (i + m) % 2 == 0);
        for i in even {
            sum = sum.add(&e[i].mul(&y[0]).over(&number((i + m + 1) as f64))?);
        }
        let next = (1..5).fold(number(0.0), |next, j| next.sub(&c[j - 1].mul(&y[j - 1]).times((m + 1 + 2 * j) as f64)));
        let next = next.over(&number((m + 1) as f64))?;
        let [y0, y1, y2, _] = y;
        y = [next, y0, y1, y2];
    }
    // Each of the terms left out is at most 64 · 2^-m · Σ|e|/(m + 1).
    let most = e.iter().fold(number(0.0), |sum, e| sum.add(&e.size()));
    let tail =
        (0..terms).step_by(500).fold(most.times(64.0), |tail, from| tail.times(2f64.powi(-(500.min(terms - from) as i32))));
    let c0 = middle(speed);
    sum.add(&tail).over(&c0.mul(&c0).mul(&c0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{Ball, Interval};

    /// A steep curve, integrated by the midpoint rule.
    #[test]
    fn agrees_with_a_plain_sum_in_doubles_and_intervals() {
        let (speed, turn) = ([1.3, 0.2, 0.09, 0.15, 2.0], [0.4, 0.9, 0.3]);
        let value = |c: &[f64], x: f64| {
            let mut row = c.to_vec();
            while row.len() > 1 {
                row = row.windows(2).map(|w| w[0] + x * (w[1] - w[0])).collect();
            }
            row[0]
        };
        let n = 200_000;
        let plain = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
        let plain: f64 = plain.map(|x| value(&turn, x).powi(2) / value(&speed, x).powi(3)).sum::<f64>() / f64::from(n);
        let ball = |x| Ball::of(x, 53);
        let near = energy(&speed.map(ball), &turn.map(ball)).expect("enough bits");
        assert!((near.value - plain).abs() < 1e-8 * plain && near.error < 1e-11 * plain, "{near:?} is not {plain}");
        for bits in [128, 600] {
            let number = |x| Interval::new(x, bits);
            let exact = energy(&speed.map(number), &turn.map(number)).expect("enough bits");
            assert!(exact.plus(-near.value).approx().abs() <= near.error);
            let width = (&exact.upper() - &exact.lower()).approx() / plain;
            assert!(width < 2f64.powi(20 - bits as i32), "{width}");
        }
    }
}
