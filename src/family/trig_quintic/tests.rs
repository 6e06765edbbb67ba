use super::exact::{Shape, judge};
use super::plain::{PRINTED_Q, end_slope, flags, printed_ratio};
use super::threshold::{by_twins, exact_least_ratio, least_ratio};
use super::*;
use crate::noise::Noise;
use crate::num::{Interval, climb, formula};
use crate::steps::counted;
use std::cmp::Ordering::{Equal, Greater, Less};

fn shape(ratio: f64, degrees: f64, m: f64, p: f64, q: f64) -> Shape {
    Shape { ratio, theta: degrees.to_radians(), m, p, q }
}

#[test]
fn thresholds_are_those_of_other_programs() {
    // To 8 digits, by bisection with 40 digits.
    let known = [
        (42.0, 1.0, 0.0, 0.0, 5.6303171),
        (42.0, 3.293, 1.0, 1.0, 5.2813167),
        (42.0, 1.8, 1.0, 1.0, 5.3284153),
        (25.1, 0.439, -0.73, -0.49, 7.0047367),
        (42.2, 5.825, -2.64, -2.84, 6.6562683),
        (33.4, 2.744, -0.34, 0.3, 4.6442234),
        (77.7, 5.851, 0.85, -0.52, 3.0527806),
        (7.3, 1.295, -0.29, -1.21, 7.0134814),
        (42.0, 1.0, 1.0, 1.0, 5.4832),
    ];
    for (degrees, m, p, q, threshold) in known {
        let this = shape(1.0, degrees, m, p, q);
        let found = least_ratio(&this).unwrap();
        assert!((f64::from(found) - threshold).abs() < 1e-4 * threshold, "{degrees} {m} {p} {q}: {found}");
        assert_eq!(found, exact_least_ratio(&this).unwrap());
    }
}

#[test]
fn comparisons_are_exact_at_their_ties() {
    assert!(
        printed_ratio(3.5, 1.0) && !printed_ratio(3.5f64.next_down(), 1.0) && !printed_ratio(3.5, 1.0f64.next_up())
    );
    assert!(!printed_ratio(3.0, 5e-324) && printed_ratio(3.0f64.next_up(), 5e-324));
    assert_eq!(end_slope(2.5, 0.125), Equal);
    assert_eq!(end_slope(2.5, 0.125f64.next_up()), Less);
    assert_eq!(end_slope(2.5f64.next_up(), 0.125), Greater);
    assert_eq!(end_slope(f64::MAX, 1.0), Greater);
    assert_eq!(end_slope(5e-324, -1.0), Greater);
}

#[test]
fn printed_end_curvatures_change_between_neighbouring_doubles() {
    let near = |q: f64| {
        let square = Interval::new(q, 400).plus(4.0).square();
        let (low, high) = (formula!(101.0 * square - 1500.0).sign(), formula!(99.0 * square - 1500.0).sign());
        low == Some(Greater) && high == Some(Less)
    };
    let [low, high] = PRINTED_Q;
    assert!(near(low) && near(high) && !near(low.next_down()) && !near(high.next_up()));
    assert_eq!(
        [low, low.next_down()].map(|q| flags(1.0, 1.0, q) & END_CURVATURE_AS_PRINTED),
        [END_CURVATURE_AS_PRINTED, 0]
    );
}

#[test]
fn a_tie_at_the_end_is_decided() {
    // κ'(1) = 0 exactly.
    let flags = judge(&shape(2.5, 42.0, 1.0, 0.0, 0.125), 128);
    assert_eq!(flags, Some(END_RISES));
}

/// The numbers of an answer are the nearest doubles.
#[test]
fn sides_and_scales_are_nearest_doubles() {
    for i in 0..400 {
        let shape =
            shape(0.01 + 0.37 * f64::from(i), 0.1 + 0.22 * f64::from(i), 1.0, 0.0, -3.99 + 0.0124 * f64::from(i));
        let answer = TrigQuintic.answer(0, &[shape.ratio, shape.theta, shape.m, shape.p, shape.q]).unwrap();
        let (sin, cos) = Interval::new(shape.theta, 300).scale(0.5).sine_cosine();
        let side = Interval::new(shape.q, 300).plus(4.0).square();
        let truths = [sin.scale(shape.ratio).over(&cos), Interval::new(15.0, 300).over(&side)];
        assert_eq!(["s", "scale"].map(|name| answer.number(name)), truths.map(|x| x.unwrap().to_f64()), "{shape:?}");
    }
}

/// All of them: ratio and m of any size, angles down to the least and up to the double below π/2, shape parameters up
/// to both ends.
#[test]
fn every_shape_is_decided_in_few_halvings() {
    const SIZES: [f64; 7] = [5e-324, 1e-160, 1e-20, 1.0, 6.0, 1e140, f64::MAX];
    const THETAS: [f64; 4] = [5e-324, 1e-160, 0.7, std::f64::consts::FRAC_PI_2];
    let pq = [(-4f64).next_up(), 0.0, 1.0];
    let (mut most, mut most_bits) = ((0, None), 0);
    for (i, ratio) in SIZES.into_iter().enumerate() {
        for (j, m) in SIZES.into_iter().enumerate() {
            for (k, theta) in THETAS.into_iter().enumerate() {
                let shape = Shape { ratio, theta, m, p: pq[(i + k) % 3], q: pq[(j + k) % 3] };
                let (steps, told) = counted(|| climb(&shape, "a verdict", |bits| judge(&shape, bits)));
                let (_, bits) = told.unwrap_or_else(|e| panic!("{e}"));
                most_bits = most_bits.max(bits);
                if steps > most.0 {
                    most = (steps, Some(shape));
                }
            }
        }
    }
    assert!(most.0 < 400 && most_bits <= 1024, "{most_bits} bits, most halvings {most:?}");
}

#[test]
fn thresholds_of_any_shape_are_decided_in_few_halvings() {
    let (least, end) = ((-4f64).next_up(), std::f64::consts::FRAC_PI_2);
    let (mut most, mut found) = (0, 0);
    for m in [5e-324, 0.1, 1.0, 6.0, 1e3, 1e140] {
        for (theta, p, q) in
            [(5e-324, 0.0, 0.0), (1e-9, 1.0, 1.0), (0.7, least, 1.0), (0.7, 1.0, least), (end, 0.5, 0.0)]
        {
            let shape = Shape { ratio: 1.0, theta, m, p, q };
            let (steps, threshold) = counted(|| exact_least_ratio(&shape));
            found += usize::from(threshold.unwrap_or_else(|e| panic!("{e}")) != crate::family::NO_VALUE);
            most = most.max(steps);
        }
    }
    assert!(most < 1000 && found > 5, "{found} thresholds, most halvings {most}");
}

/// Shapes of any size, of most of which doubles decide no threshold.
#[test]
fn thresholds_of_two_doubles_are_those_of_intervals() {
    let mut noise = Noise(8);
    let (mut told, mut found) = (0, 0);
    for _ in 0..40 {
        let end = |noise: &mut Noise| -4.0 + 5.0 * 10f64.powf(-8.0 * noise.next());
        let theta = 1.57 * 10f64.powf(-6.0 * noise.next());
        let shape =
            Shape { ratio: 1.0, theta, m: 10f64.powf(4.0 * noise.signed()), p: end(&mut noise), q: end(&mut noise) };
        let Some(threshold) = by_twins(&shape) else { continue };
        let truth = exact_least_ratio(&shape).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(threshold, truth, "{shape:?}");
        assert_eq!(least_ratio(&shape).ok(), Some(truth), "{shape:?}");
        told += 1;
        found += usize::from(truth != crate::family::NO_VALUE);
    }
    assert!(told > 35 && found > 10, "{told} told, {found} of them thresholds");
}

/// Where the curvature's slope at the end alone sets the threshold, and that lies exactly between two singles.
///
/// Then `9 ratio = 20 (1 + q)`, which is so near to 4.4, for angles near π/2.
#[test]
fn thresholds_between_two_singles_are_decided() {
    let mut noise = Noise(3);
    let (mut found, mut most) = ([0; 2], 0);
    for i in 0..200 {
        // An odd number times 2⁻²² is the middle of two singles here; a multiple of 5 gives q few digits.
        let ratio = f64::from(5 * (2 * (1_800_000 + 301 * i) + 1)) * 2f64.powi(-22);
        let (q, m) = (0.45 * ratio - 1.0, 0.5 + 0.1 * noise.next());
        assert_eq!(end_slope(ratio, q), Equal, "{ratio} {q}");
        let shape = Shape { ratio, theta: 1.555 + 0.015 * noise.next(), m, p: -4.0 + 5.0 * noise.next(), q };
        let (steps, least) = counted(|| least_ratio(&shape).unwrap());
        // Where the tie itself is a spiral, it is the threshold.
        if judge(&shape, 256).unwrap() & SPIRAL != 0 {
            assert_eq!(least, ratio as f32, "{shape:?}");
            found[usize::from(f64::from(least) < ratio)] += 1;
        }
        most = most.max(steps);
    }
    assert!(found.into_iter().all(|rounded| rounded > 80) && most < 20, "{found:?} rounded up and down, {most} steps");
}
