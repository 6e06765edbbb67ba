//! Numbers near the ends of the range of doubles: the same answer in another unit, or an error that says what is wrong.

use super::kinds::each;
use super::*;
use spiral_atlas::Error;
use spiral_atlas::curve::{EqualLength, equal_length};
use spiral_atlas::path::{Course, Motion, Separation, separation, spline};
use spiral_atlas::transition::Line;

const UNITS: [f64; 12] = [5e-324, 1e-310, 1e-300, 1e-200, 1e-145, 1e-100, 1e-12, 1e12, 1e100, 1e145, 1e200, 1e300];

/// Those of the units that give an answer; each near that for the unit 1. Errors have to say something useful.
fn answered(what: &str, answer: impl Fn(f64) -> Result<Vec<f64>, Error>) -> Vec<f64> {
    let want = answer(1.0).unwrap();
    let told = |unit: &f64| match answer(*unit) {
        Ok(got) => {
            // Multiples of the smallest double are whole: those data are other data.
            if *unit > 5e-324 {
                assert_near(&format!("{what}, unit {unit:e}"), &got, &want, 1e-9);
            }
            true
        }
        Err(e) => {
            let e = e.to_string();
            assert!(
                ["unit of", "range of doubles", "too "].iter().any(|way_out| e.contains(way_out)),
                "{what}, unit {unit:e}: {e}"
            );
            false
        }
    };
    UNITS.into_iter().filter(told).collect()
}

fn holds(answered: &[f64], least: f64, most: f64) {
    let wanted: Vec<f64> = UNITS.into_iter().filter(|unit| (least..=most).contains(unit)).collect();
    assert!(wanted.iter().all(|unit| answered.contains(unit)), "{answered:?}");
}

#[test]
fn splines() {
    let points = [[0.0, 0.0], [1.0, 0.4], [2.0, 0.0], [3.0, 0.4]];
    let measures = |unit: f64| {
        let found = spline(&points.map(|p| p.map(|x| unit * x)), false)?;
        Ok(found.spans.iter().flat_map(|s| [s.length() / unit, s.absolute_rotation()]).collect())
    };
    holds(&answered("spline", measures), 1e-145, 1e145);
    // Even points and one far off; points that all but coincide.
    for far in [1e17, 1e100, 1e300] {
        let found = spline(&[[0.0, 0.0], [1.0, 0.4], [far, 0.0], [3.0, 0.4]], true);
        assert!(found.is_err() || found.unwrap().spans.iter().all(PhQuintic::is_finite));
    }
    let near = spline(&[[1.0, 1.0], [1.0 + f64::EPSILON, 1.0], [2.0, 1.0]], false);
    assert!(near.is_err() || near.unwrap().spans.iter().all(PhQuintic::is_finite));
}

#[test]
fn paths_of_equal_length() {
    let measures = |unit: f64| {
        let ends = EqualLength {
            start: [0.0, 0.0],
            end: [3.0 * unit, 4.0 * unit],
            start_direction: 0.3,
            end_direction: -1.0,
            length: 6.0 * unit,
        };
        let choice = equal_length(&ends)?;
        Ok(choice.candidates.iter().flat_map(|c| [c.curve.length() / unit, c.absolute_rotation]).collect())
    };
    holds(&answered("equal length", measures), 1e-145, 1e145);
}

#[test]
fn measures() {
    for i in 0..each(1.0).len() {
        let measures = |unit: f64| {
            let course = Course::new(vec![each(unit)[i].clone()])?;
            let stations = course.stations(5)?;
            let told =
                stations.iter().flat_map(|s| [s.station / unit, s.x / unit, s.y / unit, s.heading, s.curvature * unit]);
            Ok(told.chain([course.length() / unit, course.greatest_curvature() * unit]).collect())
        };
        holds(&answered(each(1.0)[i].kind().name(), measures), 1e-145, 1e145);
    }
}

#[test]
fn separations() {
    for i in 0..each(1.0).len() {
        let measures = |unit: f64| {
            let a = Motion::new([each(unit)[i].clone()], unit, 0.0)?;
            let b = Motion::new([Line { start: [unit, 2.0 * unit], end: [unit, -2.0 * unit] }], 1.1 * unit, 0.1)?;
            let Separation { closest, .. } = separation(&a, &b, 0.0)?;
            assert!(closest.at_least <= closest.at_most);
            Ok(vec![closest.at_least / unit, closest.at_most / unit])
        };
        let units = answered(each(1.0)[i].kind().name(), measures);
        holds(&units, 1e-100, 1e100);
        assert!(units.iter().all(|unit| (1e-140..=1e140).contains(unit)), "{units:?}");
    }
    // Slow and fast, early and late: the verdict is that of the same motions in another unit of time.
    let lines = |speed: f64, start: f64| {
        let line = |start: [f64; 2], end: [f64; 2]| [Line { start, end }];
        let a = Motion::new(line([0.0, 0.0], [10.0, 0.0]), speed, start).unwrap();
        let b = Motion::new(line([5.0, -5.0], [5.0, 5.0]), speed, start).unwrap();
        separation(&a, &b, 1e-3).unwrap().closest
    };
    for speed in [1e-130, 1e-100, 1.0, 1e100, 1e130, 1e200] {
        let closest = lines(speed, 0.0);
        assert!(closest.at_most < 1e-8 && (closest.time * speed - 5.0).abs() < 1e-8, "{speed:e}: {closest:?}");
    }
    // Where a time has no digits left for the motion, what is reported is true, and wide.
    let closest = lines(1.0, 1e15);
    assert!(closest.at_least == 0.0 && closest.at_most < 10.0, "{closest:?}");
}

#[test]
fn numbers_that_are_none() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for piece in each(bad) {
            let error = Motion::new([piece.clone()], 1.0, 0.0).map(|m| m.length()).unwrap_err().to_string();
            assert!(error.contains("pieces[0]"), "{piece:?}: {error}");
        }
    }
    let same = Line { start: [1.0, 2.0], end: [1.0, 2.0] };
    let error = Motion::new([same], 1.0, 0.0).map(|m| m.length()).unwrap_err().to_string();
    assert!(error.contains("pieces[0] is 0.0 long"), "{error}");
}
