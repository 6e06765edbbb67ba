//! What the greatest curvature of a solution exceeds for all sizes in a box.
//!
//! It is at least `|κ(t)|` for every t, so at least every mean `Σ λ_i s_i κ(t_i)` with weights λ that sum up to 1 and
//! signs s; and where the length L is at most S, at least `Σ λ_i s_i κ(t_i) + μ (L - S)` with `μ >= 0`. Around the best
//! sizes no `κ(t_i)` alone has a large least value over a box, because each falls where another rises. The mean whose
//! slopes cancel changes by the second order of the box's size only.

use crate::curve::hodograph::{Complex, Hodograph, re};
use crate::num::{Form, Number, Quadratic, Real, formula};

/// Parts that are looked at for peaks.
const PARTS: u32 = 24;
/// One over what parameters are multiples of: then doubles subtract them from 1 exactly.
const GRID: f64 = (1u32 << 30) as f64;

fn on_grid(t: f64) -> f64 {
    (t * GRID).round() / GRID
}

fn parts() -> impl Iterator<Item = f64> {
    (0..=PARTS).map(|i| f64::from(i) / f64::from(PARTS))
}

/// What the greatest |κ| exceeds in a box wherever the arc is longer than the chord by no more than `beyond`; as much
/// as is `enough`, or more.
pub(super) fn bound(arc: &Hodograph<Quadratic>, beyond: f64, enough: f64) -> f64 {
    // Both the length's thirds and fifths and the bound in chords are rounded.
    let over = arc.beyond_chord().plus(-beyond * (1.0 + 1e-15));
    if over.low() > 0.0 {
        return f64::INFINITY;
    }
    let mut best = needle(arc, enough);
    let mut bends = Vec::with_capacity(8);
    let steps: [&dyn Fn() -> Vec<f64>; 3] = [&|| vec![0.0, 1.0], &|| peaks(arc), &|| slopes(arc, enough)];
    for step in steps {
        for t in step() {
            if best >= enough {
                return best;
            }
            if let Some(bend) = bend(arc, t) {
                best = best.max(bend.low());
                bends.push(bend);
            }
        }
    }
    let reaches = |x: &Quadratic, limit: f64| x.value + x.range().error > limit;
    // What is nowhere above the best is of no use.
    bends.retain(|bend| reaches(bend, best));
    means(&bends, reaches(&over, 0.0).then_some(over)).fold(best, f64::max)
}

/// |κ| at t where it keeps its sign, or else a number below; `None` where it may be infinite.
fn bend(arc: &Hodograph<Quadratic>, t: f64) -> Option<Quadratic> {
    let at = |[a, b, c]: [&Quadratic; 3]| mixed(&mixed(a, b, t), &mixed(b, c, t), t);
    let w = [0, 1].map(|i| at([0, 1, 2].map(|k| &arc.w[k][i])));
    let speed = re(&w, &w);
    let [a, b, c] = &arc.turn;
    let bend = at([a, b, c]).over(&speed.mul(&speed))?;
    Some(if bend.value < 0.0 { bend.times(-1.0) } else { bend })
}

fn mixed<const K: usize, const H: usize>(a: &Form<K, H>, b: &Form<K, H>, t: f64) -> Form<K, H> {
    match t {
        0.0 => *a,
        1.0 => *b,
        _ => formula!(a * { 1.0 - t } + b * { t }),
    }
}

/// About where inside |κ| has peaks in the middle of the box.
fn peaks(arc: &Hodograph<Quadratic>) -> Vec<f64> {
    let plain = arc.plain();
    let samples: Vec<(f64, f64)> = parts().map(|t| (t, plain.bend(t))).collect();
    let inside = samples.windows(3).filter(|s| s[1].1 > s[0].1 && s[1].1 >= s[2].1).map(|s| s[1].0);
    let slow = plain.slow().into_iter().filter(|t| *t > 0.0 && *t < 1.0);
    let mut all: Vec<f64> = Vec::new();
    for t in [0.0, 1.0].into_iter().chain(inside).chain(slow) {
        let peak = on_grid(plain.climbed(t).0);
        if all.iter().chain(&[0.0, 1.0]).all(|t| (t - peak).abs() > 1e-6) {
            all.push(peak);
        }
    }
    all
}

/// Nearer and nearer to where the curve is slow: parameters at which |κ| is above a limit in the middle of the box.
///
/// The peak there may be too sharp to be enclosed, but its slopes are not.
fn slopes(arc: &Hodograph<Quadratic>, limit: f64) -> Vec<f64> {
    let plain = arc.plain();
    let beside =
        |t: f64| (1..10).flat_map(move |k| [-1.0, 1.0].map(|side| on_grid(t.clamp(0.0, 1.0) + side * 0.5f64.powi(k))));
    let all = plain.slow().into_iter().flat_map(beside);
    all.filter(|t| *t > 0.0 && *t < 1.0 && plain.bend(*t) > limit).collect()
}

/// What |κ| exceeds where the curve is slowest, if that is somewhere inside: there w is perpendicular to w' and |κ| is
/// `2|w'|/|w|³`, which has no difference in it, however near the curve comes to standing still.
///
/// Where σ falls at a and rises at b there is such a place between these, and |w| is nowhere between them less than
/// there.
pub(super) fn needle<const K: usize, const H: usize>(arc: &Hodograph<Form<K, H>>, enough: f64) -> f64 {
    let slow = arc.plain().slow();
    let mut best = 0.0f64;
    for reach in [0.125, 0.25, 0.0625, 0.5, 0.03125] {
        for t in slow.into_iter().filter(|t| *t > 0.0 && *t < 1.0) {
            let [[w, v], [z, u], [x, y]] =
                [(t - reach).max(0.0), t, (t + reach).min(1.0)].map(|t| moved(arc, on_grid(t)));
            if re(&w, &v).times(-1.0).is_positive() && re(&x, &y).is_positive() {
                // w' is linear: from t to either end it changes by so much.
                let apart = |y: &Complex<Form<K, H>>| y[0].sub(&u[0]).most().hypot(y[1].sub(&u[1]).most());
                let fast = re(&u, &u).low().max(0.0).sqrt() * (1.0 - 1e-14) - apart(&v).max(apart(&y)) * (1.0 + 1e-14);
                let slow = re(&z, &z).most();
                best = best.max(2.0 * fast / (slow * slow.sqrt()) * (1.0 - 1e-14));
                if best >= enough {
                    return best;
                }
            }
        }
    }
    best
}

/// w and w' at t.
fn moved<const K: usize, const H: usize>(arc: &Hodograph<Form<K, H>>, t: f64) -> [Complex<Form<K, H>>; 2] {
    let [w0, w1, w2] = &arc.w;
    let legs = [0, 1].map(|i| [mixed(&w0[i], &w1[i], t), mixed(&w1[i], &w2[i], t)]);
    let slopes = [0, 1].map(|i| mixed(&w1[i].sub(&w0[i]), &w2[i].sub(&w1[i]), t).times(2.0));
    [legs.map(|[a, b]| mixed(&a, &b, t)), slopes]
}

/// What means of two or three functions whose slopes cancel exceed; among them may be how much too long the arc is,
/// whose weight does not count.
fn means(bends: &[Quadratic], over: Option<Quadratic>) -> impl Iterator<Item = f64> {
    let all: Vec<(f64, Quadratic)> = bends.iter().map(|x| (1.0, *x)).chain(over.map(|x| (0.0, x))).collect();
    let sets = (0..all.len()).flat_map(move |i| (0..i).flat_map(move |j| (0..=j).map(move |k| [i, j, k])));
    sets.flat_map(move |[i, j, k]| {
        let [a, b, c] = [i, j, k].map(|i| all[i]);
        // Twice the same: a pair.
        let ways =
            if j == k { [opposed(&a.1, &b.1, 0), opposed(&a.1, &b.1, 1)] } else { [around([&a.1, &b.1, &c.1]), None] };
        ways.map(|way| way.map_or(0.0, |weights| low([a, b, c], weights)))
    })
}

/// Weights with which two slopes along one axis sum up to 0.
fn opposed(a: &Quadratic, b: &Quadratic, axis: usize) -> Option<[f64; 3]> {
    let (p, q) = (a.slope[axis], b.slope[axis]);
    (p * q < 0.0).then_some([q.abs(), p.abs(), 0.0])
}

/// Weights with which three slopes sum up to 0.
fn around([a, b, c]: [&Quadratic; 3]) -> Option<[f64; 3]> {
    let cross = |a: &Quadratic, b: &Quadratic| a.slope[0] * b.slope[1] - a.slope[1] * b.slope[0];
    let all = [cross(b, c), cross(c, a), cross(a, b)];
    (all.iter().all(|x| *x > 0.0) || all.iter().all(|x| *x < 0.0)).then(|| all.map(f64::abs))
}

/// What a mean exceeds, or 0.
fn low(terms: [(f64, Quadratic); 3], weights: [f64; 3]) -> f64 {
    let whole: f64 = terms.iter().zip(weights).map(|((counts, _), weight)| counts * weight).sum();
    let [a, b, c] = [0, 1, 2].map(|i| terms[i].1.times(weights[i] / whole));
    // The weights may sum up to a little more than 1.
    let low = formula!(a + b + c).low() * (1.0 - 1e-15);
    // Not for NaN.
    if low > 0.0 { low } else { 0.0 }
}
