//! Least greatest curvature.

use super::*;
use spiral_atlas::curve::{EqualLength, Hermite, equal_length, hermite};
use spiral_atlas::path::{Directions, Free, LeastCurvature, least_curvature};
use std::f64::consts::PI;

fn ends(start_direction: f64, end_direction: f64, greatest_length: f64, free: Free) -> Directions {
    Directions { start: [0.0, 0.0], end: [1.0, 0.0], start_direction, end_direction, greatest_length, free }
}

/// Ends, directions and length are those asked for, and the numbers are the curve's.
fn check(data: &Directions) -> LeastCurvature {
    let found = least_curvature(data).unwrap_or_else(|e| panic!("{data:?}: {e}"));
    let curve = &found.curve;
    let size = (data.end[0] - data.start[0]).hypot(data.end[1] - data.start[1]);
    assert_eq!((curve.start, curve.end), (data.start, data.end));
    let integral = PhQuintic::new(data.start, curve.preimage).end;
    let legs = curve.preimage.iter().flatten().map(|x| x * x).sum::<f64>();
    assert!((integral[0] - data.end[0]).hypot(integral[1] - data.end[1]) < 1e-12 * (legs + size), "{data:?}");
    for (t, direction) in [(0.0, data.start_direction), (1.0, data.end_direction)] {
        let off = bezier(curve, t).direction() - direction;
        assert!(off.sin().abs() < 1e-9 && off.cos() > 0.0, "{data:?}");
    }
    assert!(curve.length() <= data.greatest_length * (1.0 + 1e-9), "{data:?}");
    assert!(found.at_least <= found.greatest_curvature && found.at_least >= 0.0, "{data:?} {found:?}");
    // By sampling the Bézier curve.
    let sampled = (0..=2000).map(|i| bezier(curve, f64::from(i) / 2000.0).curvature().abs()).fold(0.0, f64::max);
    assert!(sampled <= found.greatest_curvature * (1.0 + 1e-6) + 1e-9 / size, "{data:?}");
    found
}

/// As near as is promised.
fn tight(found: &LeastCurvature) -> bool {
    found.at_least >= found.greatest_curvature * (1.0 - 1.1e-6)
}

/// Figure 8: the minimum over equal derivatives.
#[test]
fn published_minimum() {
    let found = check(&ends(PI / 6.0, PI / 4.0, 2.0, Free::Length));
    assert!((found.greatest_curvature - 3.1210262181019).abs() < 1e-10, "{found:?}");
    assert!((found.derivatives[0] - 1.41325888).abs() < 1e-6 && tight(&found), "{found:?}");
    // Both free: less.
    let both = check(&ends(PI / 6.0, PI / 4.0, 2.0, Free::Derivatives));
    println!("{both:?}");
    assert!(both.greatest_curvature < found.greatest_curvature && tight(&both), "{both:?}");
}

/// Figure 6: there is no minimum up to 1.6, so it lies at the bound.
#[test]
fn the_bound_on_length_is_reached() {
    let found = check(&ends(PI / 3.0, -0.75 * PI, 1.6, Free::Length));
    assert!((found.length - 1.6).abs() < 1e-9 && (found.greatest_curvature - 4.337433134206).abs() < 1e-8, "{found:?}");
    assert!(tight(&found), "{found:?}");
    let longer = check(&ends(PI / 3.0, -0.75 * PI, 3.0, Free::Length));
    println!("{longer:?}");
    assert!(longer.greatest_curvature < found.greatest_curvature);
}

#[test]
fn straight_ahead_is_straight() {
    let found = check(&ends(0.0, 0.0, 2.0, Free::Derivatives));
    assert_eq!((found.greatest_curvature, found.at_least), (0.0, 0.0));
    assert!((found.length - 1.0).abs() < 1e-15);
    assert!((found.derivatives[0] - 1.0).abs() < 1e-15 && (found.derivatives[1] - 1.0).abs() < 1e-15, "{found:?}");
    assert_eq!(check(&ends(0.0, 0.0, 2.0, Free::Length)).greatest_curvature, 0.0);
    // Nearly so: about an arc of a circle, a seventh of a billionth longer than its chord.
    let found = check(&ends(3e-5, -3e-5, 2.0, Free::Length));
    assert!((found.greatest_curvature / 6e-5 - 1.0).abs() < 1e-3 && found.length - 1.0 < 2e-10, "{found:?}");
}

/// Random ends, unit and place: nothing sampled is below the proved bound, and no sampled path is better than what was
/// found.
#[test]
fn nothing_sampled_is_below_the_bound() {
    let mut noise = Noise(3);
    let (mut compared, mut close) = (0, 0);
    for i in 0..18 {
        let free = [Free::Length, Free::Length, Free::Derivatives][i % 3];
        let (start, end) = (noise.point().map(|x| 10.0 * x), noise.point().map(|x| 10.0 * x));
        let size = (end[0] - start[0]).hypot(end[1] - start[1]);
        let [mut first, last] = noise.point().map(|x| 3.0 * x);
        if i % 4 == 3 {
            first = last;
        }
        let greatest_length = size * (1.3 + 0.5 * (1.0 + noise.next()));
        let data = Directions { start, end, start_direction: first, end_direction: last, greatest_length, free };
        let Ok(found) = least_curvature(&data) else { continue };
        let found = {
            check(&data);
            found
        };
        close += usize::from(tight(&found));
        for _ in 0..400 {
            let x = |noise: &mut Noise| size * 10f64.powf(noise.next());
            let choice = match free {
                Free::Length if i % 3 == 0 => {
                    let length = size + (greatest_length - size) * (0.501 + 0.499 * noise.next());
                    equal_length(&EqualLength { start, end, start_direction: first, end_direction: last, length })
                }
                _ => {
                    let l0 = x(&mut noise);
                    let l1 = if free == Free::Length { l0 } else { x(&mut noise) };
                    let along = |l: f64, angle: f64| [l * angle.cos(), l * angle.sin()];
                    hermite(&Hermite {
                        start,
                        end,
                        start_derivative: along(l0, first),
                        end_derivative: along(l1, last),
                    })
                }
            };
            for c in choice.unwrap().candidates.iter().filter(|c| c.regular && c.curve.length() <= greatest_length) {
                let most = c.curve.greatest_curvature().1;
                assert!(
                    most >= found.at_least && most >= found.greatest_curvature * (1.0 - 1e-6),
                    "{data:?} {found:?} {most}"
                );
                compared += 1;
            }
        }
    }
    println!("{compared} {close}");
    assert!(compared > 5000 && close == 18, "{compared} {close}");
}

/// Mirrored, opposite, nearly straight and turning ends, short and long: the bound is as near as is promised, with one
/// and with two free numbers, and two are never worse than one.
#[test]
fn the_proof_closes_for_degenerate_ends() {
    let directions = [
        [0.7, 0.7],
        [0.7, -0.7],
        [PI, PI],
        [PI, 0.0],
        [0.0, PI],
        [0.5 * PI, -0.5 * PI],
        [0.5 * PI, 0.5 * PI],
        [3e-5, -3e-5],
        [1e-3, 0.0],
        [1e-2, 2e-2],
    ];
    let mut active = 0;
    for [first, last] in directions {
        for greatest_length in [1.7, 40.0] {
            let [one, two] = [Free::Length, Free::Derivatives].map(|free| {
                let data = ends(first, last, greatest_length, free);
                least_curvature(&data).is_ok().then(|| check(&data))
            });
            let Some(two) = two else { continue };
            assert!(tight(&two), "{first} {last} {greatest_length} {two:?}");
            active += usize::from(two.length > greatest_length * (1.0 - 1e-6));
            if let Some(one) = one {
                assert!(
                    tight(&one) && two.greatest_curvature <= one.greatest_curvature * (1.0 + 1.1e-6),
                    "{first} {last} {one:?} {two:?}"
                );
            }
        }
    }
    assert!((4..16).contains(&active), "{active}");
}

/// Such paths nearly stand still at their ends.
#[test]
fn little_more_than_the_distance_is_enough() {
    for [first, last] in [[PI / 3.0, -0.75 * PI], [0.5, 1.0], [3.0, -3.0], [2.0, 2.0], [PI, 0.3]] {
        for longest in [1.1, 1.001, 1.00001] {
            for free in [Free::Length, Free::Derivatives] {
                let found = check(&ends(first, last, longest, free));
                println!(
                    "{first} {last} {longest} {free:?} {} {}",
                    found.at_least / found.greatest_curvature,
                    found.greatest_curvature
                );
                assert!(tight(&found), "{first} {last} {longest} {found:?}");
            }
        }
    }
}

#[test]
fn what_cannot_be_searched_is_named() {
    let fine = ends(0.5, 1.0, 2.0, Free::Length);
    let says = |data: Directions, parts: &[&str]| {
        let error = least_curvature(&data).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    says(Directions { greatest_length: 1.0, ..fine }, &["`greatest_length` is 1.0", "must exceed the distance 1.0"]);
    says(Directions { greatest_length: f64::NAN, ..fine }, &["`greatest_length`", "NaN"]);
    says(Directions { greatest_length: 1e7, ..fine }, &["at most 1e6 times"]);
    says(Directions { end: [0.0, 0.0], ..fine }, &["`start` and `end` are both"]);
    says(Directions { start: [f64::INFINITY, 0.0], ..fine }, &["`start`", "inf"]);
    says(Directions { end_direction: f64::NAN, ..fine }, &["`end_direction`", "NaN"]);
}

/// A length so near the distance that a path would all but stand still at its ends has no curvature to tell: that is
/// said.
#[test]
fn no_room_for_a_turn_is_no_path() {
    for free in [Free::Length, Free::Derivatives] {
        for length in [1.0 + f64::EPSILON, 1.0 + 4.0 * f64::EPSILON] {
            match least_curvature(&ends(0.5, -0.5, length, free)) {
                Err(spiral_atlas::Error::NoPath(why)) => {
                    assert!(why.contains("all but stand still at their ends") && why.contains("allow more"), "{why}")
                }
                other => panic!("{other:?}"),
            }
            // A straight line stands still nowhere.
            assert_eq!(check(&ends(0.0, 0.0, length, free)).greatest_curvature, 0.0);
        }
        check(&ends(0.5, -0.5, 1.00000001, free));
    }
}
