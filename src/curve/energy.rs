//! The bending energy `∫ κ² ds = ∫ h²/σ³ dξ` of a curve, enclosed.
//!
//! On a piece, centred so that it is `-1 <= u <= 1`, let `σ = c0 (1 + c1 u + ... + c4 u⁴)`. Where
//! `2|c1| + 4|c2| + 8|c3| + 16|c4| <= 3/4`, σ/c0 is at least 1/4 in the disc `|u| <= 2`, so `y = (σ/c0)^-3` is at most
//! 64 there and its Taylor coefficients at most `64 · 2^-m` (Cauchy). They follow from `σ y' = -3 σ' y`:
//! `(m + 1) y_{m+1} = -Σ c_j (m + 1 + 2j) y_{m+1-j}`. Other pieces are halved.

use crate::num::bernstein::halve;
use crate::num::{Number, Real, formula};
use crate::steps::step;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::LN_2;

/// A piece of the curve.
struct Piece<N> {
    speed: [N; 5],
    turn: [N; 3],
    depth: i32,
    from: f64,
    /// About the logarithm of the most that it may add.
    most: f64,
}

impl<N: Real> Piece<N> {
    fn new(speed: [N; 5], turn: [N; 3], depth: i32, from: f64) -> Piece<N> {
        let least = speed
            .iter()
            .map(|s| if s.is_positive() { s.ln() } else { f64::NEG_INFINITY })
            .fold(f64::INFINITY, f64::min);
        let largest =
            turn.iter().map(|h| if h.is_positive() { h.ln() } else { h.most().ln() }).fold(f64::NEG_INFINITY, f64::max);
        let most = 2.0 * largest - 3.0 * least - f64::from(depth) * LN_2;
        Piece { speed, turn, depth, from, most: if most.is_nan() { f64::INFINITY } else { most } }
    }

    fn width(&self) -> N {
        N::power_of_two(-self.depth, self.speed[0].bits())
    }

    /// From 0 to the most that it may add: coefficients bound both polynomials.
    fn at_most(&self) -> Option<N> {
        let zero = N::of(0.0, self.speed[0].bits());
        let turn = self.turn.iter().fold(zero.clone(), |sum, h| sum.add(&h.size()));
        let mut most = zero.clone();
        for s in &self.speed {
            most = most.add(&formula!(turn * turn).over(s)?.over(s)?.over(s)?);
        }
        self.speed.iter().all(N::is_positive).then(|| most.mul(&self.width()).union(&zero))
    }
}

impl<N> PartialEq for Piece<N> {
    fn eq(&self, other: &Piece<N>) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<N> Eq for Piece<N> {}

impl<N> PartialOrd for Piece<N> {
    fn partial_cmp(&self, other: &Piece<N>) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<N> Ord for Piece<N> {
    fn cmp(&self, other: &Piece<N>) -> Ordering {
        self.most.total_cmp(&other.most)
    }
}

/// `∫ h²/σ³` over [0, 1] for σ and h with these Bernstein coefficients; `None` when the precision does not suffice.
///
/// The piece that may add most comes first, and the search ends where all that is left adds less than 2^-61 of what is
/// found, or than half the bits show: so the work grows with the halvings to the sharpest bend, and not with all there
/// is between bends.
pub(crate) fn energy<N: Real>(speed: &[N; 5], turn: &[N; 3]) -> Option<N> {
    let bits = speed[0].bits();
    // One halving more for each halving of the distance to a zero of σ, as close as data of doubles can put it.
    let deepest = if bits <= 53 { 64 } else { 8192 };
    let negligible = 0.5 * bits.max(122) as f64 * LN_2;
    let mut waiting = BinaryHeap::from([Piece::new(speed.clone(), turn.clone(), 0, 0.0)]);
    let mut found: Vec<(f64, N)> = Vec::new();
    let mut largest = f64::NEG_INFINITY;
    while let Some(piece) = waiting.pop() {
        step();
        if piece.most + ((waiting.len() + 1) as f64).ln() < largest - negligible {
            waiting.push(piece);
            break;
        }
        if let Some(c) = centred(&piece.speed)? {
            let part = series(&piece.speed, &c, &piece.turn)?.mul(&piece.width());
            largest = largest.max(if part.is_positive() { part.ln() } else { f64::NEG_INFINITY });
            found.push((piece.from, part));
            continue;
        }
        if piece.depth == deepest {
            return None;
        }
        let ((s0, s1), (t0, t1)) = (halve(&piece.speed), halve(&piece.turn));
        let (depth, half) = (piece.depth + 1, 2f64.powi(-piece.depth - 1));
        waiting.push(Piece::new(s0, t0, depth, piece.from));
        waiting.push(Piece::new(s1, t1, depth, piece.from + half));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sum = found.iter().fold(N::of(0.0, bits), |sum, (_, part)| formula!(sum + part));
    waiting.iter().try_fold(sum, |sum, piece| Some(sum.add(&piece.at_most()?)))
}

fn combine<N: Number, const D: usize>(b: &[N; D], by: [f64; D]) -> N {
    let sum = b.iter().zip(by).filter(|(_, k)| *k != 0.0).map(|(x, k)| x.times(k));
    sum.reduce(|sum, x| formula!(sum + x)).unwrap_or_else(|| b[0].clone())
}

fn middle<N: Number>(b: &[N; 5]) -> N {
    combine(b, [0.0625, 0.25, 0.375, 0.25, 0.0625])
}

/// `c1 .. c4`, if the disc of radius 2 is clear of the zeros of σ: `Some(None)` when that is not certain. `None` when
/// only the precision is in the way: σ itself changes little on the piece, so that halving, which leaves errors as they
/// are, would go on everywhere.
fn centred<N: Real>(b: &[N; 5]) -> Option<Option<[N; 4]>> {
    let c0 = middle(b);
    let c = [
        combine(b, [-0.25, -0.5, 0.0, 0.5, 0.25]).over(&c0)?,
        combine(b, [0.375, 0.0, -0.75, 0.0, 0.375]).over(&c0)?,
        combine(b, [-0.25, 0.5, 0.0, -0.5, 0.25]).over(&c0)?,
        combine(b, [0.0625, -0.25, 0.375, -0.25, 0.0625]).over(&c0)?,
    ];
    let weight = |size: fn(&N) -> f64| c.iter().zip([2.0, 4.0, 8.0, 16.0]).map(|(c, k)| size(c) * k).sum::<f64>();
    // A little less than 3/4, for `most` is rounded.
    let clear = weight(N::most) < 0.749;
    (clear || weight(|c| c.approx().abs()) > 0.375).then(|| clear.then_some(c))
}

/// `∫ h² y` over -1 <= u <= 1, halved, over `c0³`.
fn series<N: Real>(speed: &[N; 5], c: &[N; 4], turn: &[N; 3]) -> Option<N> {
    let bits = speed[0].bits();
    let h = [combine(turn, [0.25, 0.5, 0.25]), combine(turn, [-0.5, 0.0, 0.5]), combine(turn, [0.25, -0.5, 0.25])];
    // h² in powers of u.
    let e = [
        formula!(h[0] * h[0]),
        formula!(2.0 * (h[0] * h[1])),
        formula!(h[1] * h[1] + 2.0 * (h[0] * h[2])),
        formula!(2.0 * (h[1] * h[2])),
        formula!(h[2] * h[2]),
    ];
    let number = |x: f64| N::of(x, bits);
    // The last five coefficients, the latest first.
    let mut y = [number(1.0), number(0.0), number(0.0), number(0.0), number(0.0)];
    let mut sum = number(0.0);
    let terms = bits + 16;
    for m in 0..=terms {
        // ∫ u^m over [-1, 1], halved, times the coefficient of u^m of h² y.
        if m % 2 == 0 {
            let part = (1..5).fold(e[0].mul(&y[0]), |part, i| formula!(part + e[i] * y[i]));
            sum = sum.add(&part.over(&number((m + 1) as f64))?);
        }
        let next =
            (1..5).fold(number(0.0), |next, j| formula!(next - c[j - 1] * y[j - 1] * { (m + 1 + 2 * j) as f64 }));
        let next = next.over(&number((m + 1) as f64))?;
        let [y0, y1, y2, y3, _] = y;
        y = [next, y0, y1, y2, y3];
    }
    // What is left out are products of some e_i and y_j with i + j > terms, in all at most 64 · 2^(i - terms) · |e_i|.
    let most = e.iter().fold(number(0.0), |sum, e| sum.add(&e.size()));
    let tail = (0..terms)
        .step_by(500)
        .fold(most.times(1024.0), |tail, from| tail.times(2f64.powi(-(500.min(terms - from) as i32))));
    let c0 = middle(speed);
    sum.add(&tail).over(&formula!(c0 * c0 * c0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{Ball, Interval};
    use crate::steps::counted;

    /// Where an error is larger than the speed, halving does not end before the precision does.
    #[test]
    fn speeds_that_are_hardly_known_are_left_at_once() {
        let near = |value: f64| Ball { value, error: 0.2 };
        let (steps, found) = counted(|| energy(&[1.0, 0.9, 1.0, 1.1, 1.0].map(near), &[1.0; 3].map(near)));
        assert!(found.is_none() && steps < 10, "{found:?} after {steps} steps");
    }

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
