//! The work for one curve is bounded by the digits of its data, not by how near they are to a case where no
//! curve exists or the formulas break.
//!
//! Bounds, for doubles with at most 2150 bits between the largest and the smallest digit of what is added, and at most
//! 2000 turns:
//! - Precision doubles from 128 bits. Digits that the data share cost some: where Q is small against its terms, or
//!   nearly 3ω² for small ω. So does a number of the curve that is next to the middle between two doubles: data from
//!   1e-300 to 1e100 let it come nearer than 1e-600.
//! - The equation is solved by Newton's method from a start with at least 10 right bits, so that each step doubles
//!   them: log2(bits/10) evaluations, two for the bracket, two for the proof at the first δ, and as many again where
//!   rounding asks for a wider one.
//! - The length has pieces of a unit and a half of y, which is at most ln of the largest w; of a unit and a half of v,
//!   which is at most θ; and some 4 for each halving towards a peak inside, of which doubles leave 54.

use super::super::Datum;
use super::solve::{Work, solve};
use std::f64::consts::{FRAC_PI_2, PI};

/// The largest work of each kind so far.
#[derive(Debug, Default)]
struct Most {
    curves: usize,
    bits: usize,
    evaluations: usize,
    pieces: usize,
    worst: Option<(Datum, [u32; 2])>,
}

impl Most {
    fn case(&mut self, chord: Datum, turns: [u32; 2]) {
        let within = |x: f64| x.clamp(-PI, PI);
        let chord = Datum { alpha: within(chord.alpha), beta: within(chord.beta), ..chord };
        let (found, Some(Work { bits, evaluations, pieces })) = solve(&chord, turns).unwrap() else { return };
        let more = bits > self.bits || evaluations > self.evaluations || pieces > self.pieces;
        if more {
            self.worst = Some((chord, turns));
        }
        self.curves += 1;
        self.bits = self.bits.max(bits);
        self.evaluations = self.evaluations.max(evaluations);
        self.pieces = self.pieces.max(pieces);
        let curve = found.curve().unwrap();
        assert!(curve.length().is_finite() && curve.length() >= 2.0, "{chord:?}: {}", curve.length());
        for i in 0..=4 {
            let at = [curve.at(0.25 * f64::from(i)), curve.at_length(0.25 * f64::from(i))];
            for at in at {
                let all = [at.point[0], at.point[1], at.direction, at.curvature];
                assert!(all.iter().all(|x| x.is_finite()), "{chord:?}, {turns:?}: {at:?}");
            }
        }
    }
}

/// Some doubles around x, from its neighbours to far.
fn around(x: f64) -> Vec<f64> {
    let near = (1..4).scan([x, x], |pair, _| {
        *pair = [pair[0].next_down(), pair[1].next_up()];
        Some(*pair)
    });
    let far = [1e-300, 1e-200, 1e-100, 1e-40, 1e-17, 1e-12, 1e-6, 1e-2].map(|d| [x - d, x + d]);
    near.chain(far).flatten().chain([x]).collect()
}

const CURVATURES: [f64; 13] = [0.0, 1e-300, 1e-100, 1e-17, 1e-5, 0.1, 1.0, 8.5, 1e3, 1e8, 1e17, 1e50, 1e100];

fn signed() -> Vec<f64> {
    CURVATURES.iter().flat_map(|k| [-k, *k]).collect()
}

#[test]
fn few_steps_near_every_limit_of_the_angles() {
    let mut most = Most::default();
    for alpha in [0.0, 1e-300, 1e-17, 0.3, 1.1993755400291874, FRAC_PI_2, 3.0, PI].iter().flat_map(|a| [-a, *a]) {
        for beta in around(-alpha)
            .into_iter()
            .chain(around(0.0))
            .chain(around(PI))
            .chain(around(-PI))
            .chain(around(FRAC_PI_2))
            .step_by(3)
        {
            for (i, k1) in signed().into_iter().enumerate() {
                // Two k2 for each k1, others for each.
                for k2 in signed().into_iter().skip(i % 13).step_by(13) {
                    most.case(Datum { alpha, beta, k1, k2 }, [0, 0]);
                }
            }
        }
    }
    println!("{most:?}");
    assert!(most.curves > 3_000, "{most:?}");
    assert!(most.bits <= 4096 && most.evaluations <= 16 && most.pieces <= 800, "{most:?}");
}

/// Where Q is next to 0: k2 is the last double of a curve, and those before it.
#[test]
fn few_steps_near_circles_that_touch() {
    let mut most = Most::default();
    for alpha in [-3.0, -1.0, -1e-8, -1e-150, -1e-300, 0.0, 1e-200, 1e-16, 0.7, FRAC_PI_2, PI] {
        for sum in [1e-320, 1e-300, 1e-100, 1e-17, 1e-8, 1e-3, 0.1, 1.0, 3.0] {
            let beta = sum - alpha;
            for room in [1e-300, 1e-100, 1e-17, 1e-3, 1.0, 1e17, 1e99] {
                let k1 = -room - alpha.sin();
                // Between a k2 without a curve and one with it.
                let exists = |k2: f64| Datum { alpha, beta, k1, k2 }.code().is_ok_and(|c| c.0.flags() & 1 != 0);
                let (mut low, mut high) = (k1.max(beta.sin()), 1e100);
                if beta.abs() > PI || exists(low) || !exists(high) {
                    continue;
                }
                for _ in 0..2100 {
                    let middle = if high > 0.0 && low > 0.0 && high > 4.0 * low {
                        low.sqrt() * high.sqrt()
                    } else {
                        0.5 * (low + high)
                    };
                    if middle <= low || middle >= high {
                        break;
                    }
                    if exists(middle) { high = middle } else { low = middle }
                }
                let mut k2 = high;
                for _ in 0..3 {
                    most.case(Datum { alpha, beta, k1, k2 }, [0, 0]);
                    k2 = k2.next_up();
                }
            }
        }
    }
    println!("{most:?}");
    assert!(most.curves > 500, "{most:?}");
    assert!(most.bits <= 1024 && most.evaluations <= 16 && most.pieces <= 800, "{most:?}");
}

/// Many turns: pieces as many as the turns ask for, at most 100 each, where the curve passes infinity closely in each.
#[test]
fn steps_grow_with_the_turns_alone() {
    for turns in [[0, 1], [3, 2], [40, 0], [1000, 1000]] {
        let mut most = Most::default();
        for alpha in [-PI, -1.0, -1e-300, 0.0, 0.5, PI] {
            for beta in around(-alpha).into_iter().step_by(7) {
                for (k1, k2) in [
                    (-1e100, 1e100),
                    (-8.0, 13.0),
                    (-1e17, 1e-300),
                    (-1e-300, 0.6),
                    (-3.0, -1.0),
                    (2.0, 1e8),
                    (7.0, -3.0),
                ] {
                    most.case(Datum { alpha, beta, k1, k2 }, turns);
                }
            }
        }
        let bound = 800 + 100 * (turns[0] + turns[1]) as usize;
        println!("{turns:?}: {most:?}");
        assert!(most.curves > 30 && most.bits <= 512 && most.evaluations <= 16 && most.pieces <= bound, "{most:?}");
    }
}

/// Both directions along the chord up to rounding, the most ordinary road there is, in 60 places of the plane.
#[test]
fn few_steps_where_both_directions_lie_along_the_chord() {
    let mut most = Most::default();
    for i in 0..60 {
        // Directions of the chord, all over the circle; and the same direction as a user may write it.
        let chord = (2.399963 * f64::from(i)).rem_euclid(2.0 * PI) - PI;
        let turned = (chord + 2.0 * PI) - 2.0 * PI;
        let written = [chord, chord.to_degrees().to_radians(), chord.sin().atan2(chord.cos()), turned, chord.next_up()];
        let before = most.curves;
        for (alpha, beta) in written.iter().flat_map(|a| written.map(|b| (a - chord, b - chord))) {
            for (k1, k2) in [(-0.3, 6.0), (6.0, -0.3), (-4e-4, 1e-3)] {
                most.case(Datum { alpha, beta, k1, k2 }, [0, 0]);
            }
        }
        assert!(most.curves > before, "{chord}");
    }
    println!("{most:?}");
    assert!(most.curves > 1_000 && most.bits <= 512 && most.evaluations <= 16 && most.pieces <= 800, "{most:?}");
}
