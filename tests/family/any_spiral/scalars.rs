//! Q, ω, θ and t0 are the nearest singles: by the signs of the equation for θ at the midpoints between singles.

use super::iv::{Iv, Sure};
use super::judge::q;
use super::{Datum, Random, grid_of};
use spiral_atlas::family::any_spiral::EXISTS;
use spiral_atlas::family::by_name;
use std::f64::consts::PI;

const BITS: usize = 512;

fn scalars_of(datum: Datum) -> (u8, [f32; 4]) {
    let grid = grid_of(datum);
    let table = by_name("any-spiral").unwrap().table(&grid).unwrap();
    let code = table.exact(0).unwrap().0;
    let mut out = [0.5; 4];
    table.scalars(0, code, &[0, 1, 2, 3], &mut out).unwrap();
    (code.flags(), out)
}

/// `sin(ω(θ) - ω)` times something positive, and t0: (4), and tan ω(θ) = P/(t0 sin θ) in the right quadrant, up to θ =
/// 4.49.
fn equation(datum: Datum, theta: f64) -> (Iv, Iv) {
    let [alpha, beta, ..] = datum;
    // Half angles are exact.
    let ((s0, c0), (s1, c1)) = (Iv::sin_cos(0.5 * alpha, BITS), Iv::sin_cos(0.5 * beta, BITS));
    let (sin, cos) = (&(&s0 * &c1) + &(&c0 * &s1), &(&c0 * &c1) - &(&s0 * &s1));
    let sin = if alpha + beta < 0.0 { -&sin } else { sin };
    let (s, c) = Iv::sin_cos(theta, BITS);
    let n = Iv::new(theta, BITS);
    // Q t0² = Q θ² - (θ² - sin² θ), Q negative.
    let q = q(datum, BITS);
    let t0 = (&n.square() - &(&n.square() - &s.square()).over(&q).expect("Q is not 0")).sqrt();
    let p = &s - &(&n * &c);
    (&(&p * &cos) - &(&(&t0 * &s) * &sin), t0)
}

/// Which of the four are not the nearest singles; doubtful ones (too close to a midpoint) count as right.
fn faults(datum: Datum, (flags, got): (u8, [f32; 4])) -> Vec<usize> {
    let mut faults = Vec::new();
    let between = |x: f32, truth: &Iv| -> Sure<bool> {
        let (low, high) =
            (0.5 * (f64::from(x.next_down()) + f64::from(x)), 0.5 * (f64::from(x) + f64::from(x.next_up())));
        Ok((truth - &Iv::new(low, BITS)).at_least_zero()? && (&Iv::new(high, BITS) - truth).at_least_zero()?)
    };
    let sum = (&Iv::new(datum[0], BITS) + &Iv::new(datum[1], BITS)).times(0.5);
    for (which, truth) in [(0, q(datum, BITS)), (1, sum)] {
        if between(got[which], &truth) == Ok(false) {
            faults.push(which);
        }
    }
    if flags & EXISTS == 0 {
        return faults;
    }
    // θ by the signs at the midpoints around it, t0 by those of θ where it would be another: t0 rises with θ.
    let theta = got[2];
    let middle = |a: f32, b: f32| 0.5 * (f64::from(a) + f64::from(b));
    let (low, high) = (middle(theta.next_down(), theta), middle(theta, theta.next_up()));
    if equation(datum, low).0.positive() == Ok(true) || equation(datum, high).0.positive() == Ok(false) {
        faults.push(2);
    }
    let (mut low, mut high) = (low, high);
    while low.next_up() < high {
        let middle = 0.5 * (low + high);
        if equation(datum, middle).0.positive() == Ok(true) { high = middle } else { low = middle }
    }
    let t0 = got[3];
    let (below, above) = (middle(t0.next_down(), t0), middle(t0, t0.next_up()));
    let (from, to) = (equation(datum, low).1, equation(datum, high).1);
    if (&Iv::new(below, BITS) - &to).positive() == Ok(true) || (&from - &Iv::new(above, BITS)).positive() == Ok(true) {
        faults.push(3);
    }
    faults
}

#[test]
fn scalars_are_the_nearest_singles() {
    let (mut r, mut compared, mut wrong) = (Random(21), 0, vec![]);
    for round in 0..600 {
        let mut datum = r.likely();
        match round % 5 {
            // ω close to 0, to π/2 and to π; Q close to 0.
            0 => datum[1] = -datum[0] + r.signed_decades(-9.0, -1.0),
            1 => datum[1] = if datum[0] > 0.0 { PI - datum[0] } else { -PI - datum[0] },
            2 => {
                datum =
                    [PI - r.uniform(0.0, 1e-3), PI - r.uniform(0.0, 1e-3), -r.uniform(1e-3, 2.0), r.uniform(1e-3, 2.0)]
            }
            3 => {
                let side = if datum[0] + datum[1] > 0.0 { 1.0 } else { -1.0 };
                let need = (0.5 * (datum[0] + datum[1])).sin().powi(2);
                let room = -side * (datum[2] + datum[0].sin());
                datum[3] = side * (need / room) * (1.0 + r.signed_decades(-12.0, -4.0).abs()) + datum[1].sin();
            }
            _ => {}
        }
        let got = scalars_of(datum);
        compared += usize::from(got.0 & EXISTS != 0);
        let faults = faults(datum, got);
        if !faults.is_empty() {
            wrong.push((datum, faults));
        }
    }
    println!("scalars: {compared} arcs, {} wrong", wrong.len());
    assert!(wrong.is_empty(), "{} wrong, such as {:?}", wrong.len(), wrong.first());
    assert!(compared > 350);
}

#[test]
fn a_changed_scalar_is_noticed() {
    for datum in [[0.5, 0.6, -2.0, 3.0], [3.0, 2.9, -0.7, 0.9], [-1.0, -1.5, 2.0, -4.0]] {
        let (flags, right) = scalars_of(datum);
        assert!(flags & EXISTS != 0 && faults(datum, (flags, right)).is_empty());
        for which in 0..4 {
            for step in [-1i32, 1] {
                let mut got = right;
                got[which] = f32::from_bits(got[which].to_bits().wrapping_add_signed(step));
                assert!(faults(datum, (flags, got)).contains(&which), "{datum:?}, {which}");
            }
        }
    }
}

/// Values that have no f32: stored at the end of the range; and exact values as they are.
#[test]
fn extreme_scalars() {
    assert_eq!(scalars_of([0.5, 0.6, -1e30, 1e30]).1[0], -1e38);
    assert_eq!(scalars_of([0.5, 0.6, 1e200, 1e300]).1[0], 1e38);
    assert_eq!(scalars_of([0.3, 0.3, 0.0, 0.0]).1[..2], [0.0, 0.3]);
    assert_eq!(scalars_of([0.3, 0.3, 0.5, 0.5]).1[0], 0.25);
    assert_eq!(scalars_of([-0.3, 0.3, 0.5, 0.5]).1[1].to_bits(), 0);
}
