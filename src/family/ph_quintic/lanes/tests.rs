//! Every number of a lane against intervals of 300 bits, every code against that of one node.

use super::{Bounds, Equations, curves, march, root, usable};
use crate::family::Code;
use crate::family::ph_quintic::curves::Curves;
use crate::family::ph_quintic::march::March;
use crate::family::ph_quintic::pair::Pair;
use crate::family::ph_quintic::truth::{solve, verdict};
use crate::noise::Noise;
use crate::num::{Ball, Interval};
use fearless_simd::{Level, Simd, SimdBase, dispatch};

const BITS: usize = 300;

/// The first lane's numbers, each with how far it may be off.
struct Facts {
    /// Heights, slopes and gap at a knot.
    knot: Vec<(f64, f64)>,
    /// t, Z and the quintic of each solution.
    roots: Vec<Vec<(f64, f64)>>,
}

#[inline(always)]
fn facts<S: Simd>(simd: S, pair: &Pair<Ball>, kappa: [f64; 2], t: f64) -> Option<Facts> {
    let bounds = Bounds::of(pair).filter(|_| usable(pair, kappa[0]))?;
    let kappa1 = S::f64s::splat(simd, kappa[1]);
    let equations = Equations::new(simd, curves(simd, pair, kappa[0], kappa1), bounds);
    let first = |x: S::f64s| x.as_slice()[0];
    let found = march::brackets(&equations, 1, kappa[0] > 0.0);
    let mut roots = vec![];
    for bracket in found.slots.iter().filter(|bracket| bracket.lanes & 1 == 1 && found.open == 0) {
        let root = root::root(&equations, bracket, 1);
        if root.proved & 1 == 0 {
            roots.clear();
            break;
        }
        let (value, error) = root::quintic(&equations, &root);
        let pair = |x: S::f64s, off: S::f64s| (first(x), first(off));
        let mut all = vec![pair(root.t, root.t * root.t_off), pair(root.z, root.z * root.z_off)];
        all.extend((0..6).map(|i| pair(value[i], error[i])));
        roots.push(all);
    }
    let knot = equations.knot(t, None, 1);
    let (off, slope) = (first(knot.off), first(equations.slope_error(&knot)));
    let mut all = vec![];
    for i in 0..2 {
        all.push((first(knot.z[i]), first(knot.z[i]) * off));
        all.push((first(knot.s[i]), first(knot.s[i]) * slope));
    }
    all.push((first(knot.gap), first(equations.gap_error(&knot))));
    Some(Facts { knot: all, roots })
}

/// How much of its bound each number is off, at most.
fn worst(numbers: &[(f64, f64)], truths: &[Interval]) -> f64 {
    assert_eq!(numbers.len(), truths.len());
    numbers.iter().zip(truths).fold(0.0, |worst, ((value, error), truth)| {
        // Near 0 a double's own spacing is below every bound.
        let off = truth.plus(-value).approx().abs();
        assert!(off <= *error, "{value} is off by {off}, at most {error} was said");
        if off == 0.0 { worst } else { f64::max(worst, off / error) }
    })
}

fn random(noise: &mut Noise, round: usize) -> ([f64; 2], [f64; 2], f64) {
    let phi0 = 0.02 + 1.3 * noise.next();
    let phi1 = phi0 + (2.9 - 2.0 * phi0) * noise.next() * if round.is_multiple_of(5) { 1e-6 } else { 1.0 };
    let size = if round.is_multiple_of(3) { 40.0 } else { 5.0 };
    let kappa = [phi0.sin() * (size * (noise.next() - 0.8)).exp(), phi1.sin() * (size * (noise.next() - 0.2)).exp()];
    ([phi0, phi1], kappa, (2.0 * size * noise.signed()).clamp(-20.0, 20.0).exp())
}

#[test]
fn numbers_are_within_their_bounds() {
    let mut noise = Noise(11);
    let (mut knots, mut roots, mut worst_knot, mut worst_root) = (0, 0, 0.0f64, 0.0f64);
    for round in 0..1500 {
        let ([phi0, phi1], kappa, t) = random(&mut noise, round);
        let Some(pair) = Pair::<Ball>::new(phi0, phi1) else { continue };
        let Some(found) = dispatch!(Level::new(), simd => facts(simd, &pair, kappa, t)) else { continue };
        let exact = Pair::exact(phi0, phi1, BITS).expect("enough bits");
        let curves = Curves::of(&exact, kappa).expect("enough bits");
        let knot = March::new(curves).knot(Interval::new(t, BITS)).expect("enough bits");
        let [z0, z1] = knot.z;
        let [s0, s1] = knot.s;
        if found.knot[0].1.is_finite() {
            worst_knot = worst_knot.max(worst(&found.knot, &[z0, s0, z1, s1, knot.gap]));
            knots += 1;
        }
        if found.roots.is_empty() {
            continue;
        }
        let truth = solve(&exact, kappa).expect("enough bits");
        assert_eq!(truth.solutions.len(), found.roots.len());
        for (numbers, truth) in found.roots.iter().zip(&truth.solutions) {
            let mut all = vec![truth.root.t.clone(), truth.root.z.clone()];
            all.extend(truth.shape.quintic());
            worst_root = worst_root.max(worst(numbers, &all));
            roots += 1;
        }
    }
    println!("{knots} knots, at most {worst_knot} of a bound; {roots} solutions, at most {worst_root}");
    assert!(knots > 1000 && roots > 500 && worst_knot > 0.02 && worst_root > 0.05);
}

/// Vectors of neighbours on scales from far apart to one double; those that lanes decide are decided rightly.
#[test]
fn codes_are_those_of_one_node() {
    let mut noise = Noise(5);
    let (mut decided, mut all, mut kinds) = (0, 0, std::collections::BTreeSet::new());
    for round in 0..6000 {
        let ([phi0, phi1], kappa, _) = random(&mut noise, round);
        let Some(pair) = Pair::<Ball>::new(phi0, phi1) else { continue };
        let apart = 2f64.powi(-((noise.next() * 52.0) as i32));
        let kappa1: [f64; 8] = std::array::from_fn(|i| match (round % 50, i) {
            (0, 3) => 0.0,
            (0, 4) => -kappa[1],
            (0, 5) => 1e-30,
            (1, 3) => f64::MAX,
            _ => kappa[1] * (1.0 + apart * i as f64),
        });
        let kappa0 = match round % 40 {
            0 => 0.0,
            1 => -kappa[0],
            _ => kappa[0],
        };
        let mut codes = [Code::UNDECIDED; 8];
        let width = dispatch!(Level::new(), simd => some(simd, &pair, kappa0, &kappa1, &mut codes));
        for (code, kappa1) in codes.iter().zip(kappa1).take(width) {
            all += 1;
            if *code == Code::UNDECIDED {
                continue;
            }
            let kappa = [kappa0, kappa1];
            let want = verdict(&pair, kappa).or_else(|| verdict(&Pair::exact(phi0, phi1, BITS)?, kappa));
            assert_eq!(Some(*code), want, "{phi0} {phi1} {kappa:?}");
            kinds.insert((code.flags(), code.counts()));
            decided += 1;
        }
    }
    println!("{decided} of {all} decided, {kinds:?}");
    assert!(decided * 100 > all * 90 && kinds.len() > 8);
}

#[inline(always)]
fn some<S: Simd>(simd: S, pair: &Pair<Ball>, kappa0: f64, kappa1: &[f64; 8], out: &mut [Code; 8]) -> usize {
    let width = S::f64s::LEN;
    super::codes(simd, pair, kappa0, S::f64s::from_slice(simd, &kappa1[..width]), &mut out[..width]);
    width
}
