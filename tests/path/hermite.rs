//! Hermite interpolation.

use super::*;
use spiral_atlas::curve::{Choice, Hermite, hermite};

fn rotations(choice: &Choice) -> Vec<f64> {
    let mut all: Vec<f64> = choice.candidates.iter().map(|c| c.absolute_rotation).collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn published_interpolants() {
    for row in rows("hermite") {
        let [start, end, start_derivative, end_derivative] = [0, 1, 2, 3].map(|i| point(&row[i]));
        let choice = hermite(&Hermite { start, end, start_derivative, end_derivative }).unwrap();
        let best = choice.best();
        let p = best.control_points();
        assert_near("inner control points", &flat(&p[2..4]), &flat(&[point(&row[4]), point(&row[5])]), DIGITS);
        assert_near("rotations", &rotations(&choice), &numbers(&row[6]), DIGITS);
        assert_near("length, greatest curvature", &[best.length()], &[number(&row[7])], DIGITS);
        assert_near("greatest curvature", &[best.greatest_curvature().1], &[number(&row[8])], DIGITS);
    }
}

/// Figures 7 and 8.
#[test]
fn greatest_curvature_by_end_speed() {
    let kmax = |l: f64| {
        let at = |angle: f64| [l * angle.cos(), l * angle.sin()];
        let [start_derivative, end_derivative] = [std::f64::consts::FRAC_PI_6, std::f64::consts::FRAC_PI_4].map(at);
        let choice =
            hermite(&Hermite { start: [0.0, 0.0], end: [1.0, 0.0], start_derivative, end_derivative }).unwrap();
        choice.best().greatest_curvature()
    };
    let printed = [4.066457, 3.140970, 3.764156, 4.950836, 6.597532, 8.619074, 10.828017];
    let figures = published("figures");
    let rows = figures["fig7_8"].as_array().unwrap();
    assert_eq!(rows.len(), printed.len());
    for (row, printed) in rows.iter().zip(printed) {
        let (t, k) = kmax(row[0].as_str().unwrap().parse().unwrap());
        assert_near("figure 7", &[k, t], &[number(&row[1]), number(&row[2])], 1e-11);
        assert!((k - printed).abs() < 6e-7);
    }
    let least = kmax(1.4132589).1;
    assert!((least - 3.1210262).abs() < 1e-7 && kmax(1.4130).1 > least && kmax(1.4135).1 > least);
}

#[test]
fn random_ends_are_met_by_four_different_curves() {
    let mut noise = Noise(3);
    for i in 0..300 {
        let size = 10f64.powi(i % 7 - 3);
        let start_derivative = noise.point().map(|x| x * size);
        let ends =
            Hermite { start: noise.point(), end: noise.point(), start_derivative, end_derivative: noise.point() };
        let choice = hermite(&ends).unwrap();
        let all: Vec<_> = choice.candidates.iter().map(|c| c.curve).collect();
        for (i, c) in all.iter().enumerate() {
            let p = c.control_points();
            let scale = size + 2.0;
            let leg = |i: usize| [5.0 * (p[i + 1][0] - p[i][0]), 5.0 * (p[i + 1][1] - p[i][1])];
            assert_eq!((p[0], p[5]), (ends.start, ends.end));
            let near = |got: [f64; 2], want: [f64; 2]| (got[0] - want[0]).hypot(got[1] - want[1]) < 1e-14 * scale * 5.0;
            assert!(near(leg(0), ends.start_derivative) && near(leg(4), ends.end_derivative), "{ends:?}");
            // The middle leg, which joins what was built from both ends, is that of the pre-image; and the speed is a
            // quartic.
            let integral = PhQuintic::new(c.start, c.preimage).end;
            assert!(near(integral, ends.end), "{integral:?} {ends:?}");
            let speeds: Vec<f64> = (0..=5).map(|i| bezier(c, f64::from(i) / 5.0).speed()).collect();
            let fifth = [-1.0, 5.0, -10.0, 10.0, -5.0, 1.0].iter().zip(&speeds).map(|(c, s)| c * s).sum::<f64>();
            assert!(fifth.abs() <= 1e-13 * speeds.iter().sum::<f64>().max(scale), "{fifth}");
            let differs = |d: &PhQuintic| apart(&flat(&c.control_points()), &flat(&d.control_points())) > 1e-9;
            assert!(all[..i].iter().all(differs));
        }
        assert!(
            (rotations(&choice)[0] - choice.candidates[choice.best].absolute_rotation).abs() < 1e-9
                || !choice.candidates.iter().all(|c| c.regular)
        );
    }
}

#[test]
fn degenerate_ends() {
    let ends = Hermite { start: [0.0, 0.0], end: [1.0, 0.0], start_derivative: [1.0, 0.0], end_derivative: [1.0, 0.0] };
    // A straight line, though others that pause on the way turn as little.
    let straight = hermite(&ends).unwrap();
    assert_near(
        "a line",
        &flat(&straight.best().control_points()),
        &flat(&[0.0, 0.2, 0.4, 0.6, 0.8, 1.0].map(|x| [x, 0.0])),
        1e-15,
    );
    assert!(straight.candidates.iter().filter(|c| !c.regular).count() >= 2);
    // Coincident ends: a loop.
    let around = hermite(&Hermite { end: [0.0, 0.0], ..ends }).unwrap();
    assert!(around.best().length() > 0.1 && around.candidates[around.best].absolute_rotation > 3.0);
    // Far away, and tiny.
    let tiny = |x: f64| x * 1e-150;
    assert!(
        hermite(&Hermite {
            end: [tiny(1.0), 0.0],
            start_derivative: [tiny(1.0), tiny(0.5)],
            end_derivative: [tiny(1.0), 0.0],
            ..ends
        })
        .is_ok()
    );
    let says = |ends: Hermite, parts: &[&str]| {
        let error = hermite(&ends).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    says(Hermite { start_derivative: [0.0, 0.0], ..ends }, &["`start_derivative` is 0"]);
    says(Hermite { end_derivative: [0.0, -0.0], ..ends }, &["`end_derivative` is 0"]);
    says(Hermite { end: [f64::INFINITY, 0.0], ..ends }, &["`end`", "inf", "finite"]);
    says(Hermite { end_derivative: [0.0, f64::NAN], ..ends }, &["`end_derivative`", "NaN"]);
    says(Hermite { end: [1e308, 0.0], start: [-1e308, 0.0], ..ends }, &["range of doubles"]);
}
