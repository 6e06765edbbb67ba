//! Segments added to lines and circles: their end data, measured on the control points alone, and the property claimed.

use spiral_atlas::family::reach::{Kind, Level};
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::segment::{Added, Base, Request, Target, add_segment};
use std::f64::consts::PI;

type Point = [f64; 2];

/// First two derivatives by de Casteljau's algorithm, from the sides of the control polygon.
fn jet(legs: &[Point], t: f64) -> [Point; 2] {
    let n = legs.len() as f64;
    let mix = |row: &[Point]| -> Vec<Point> {
        row.windows(2).map(|w| [0, 1].map(|i| w[0][i] + t * (w[1][i] - w[0][i]))).collect()
    };
    let steps = |row: &[Point]| -> Vec<Point> { row.windows(2).map(|w| [0, 1].map(|i| w[1][i] - w[0][i])).collect() };
    let value = |row: &[Point]| {
        let mut row = row.to_vec();
        while row.len() > 1 {
            row = mix(&row);
        }
        row[0]
    };
    [value(legs).map(|x| x * n), value(&steps(legs)).map(|x| x * n * (n - 1.0))]
}

fn curvature(legs: &[Point], t: f64) -> f64 {
    let [a, b] = jet(legs, t);
    (a[0] * b[1] - a[1] * b[0]) / a[0].hypot(a[1]).powi(3)
}

/// All end data that are off by more than 1e-12, in units of r, and curvatures by more than directions rounded to
/// doubles allow: 4 ulp of the neighbour's length over the square of the end leg's.
fn faults(request: &Request, added: &Added) -> Vec<String> {
    let legs = &added.legs;
    let length = |i: usize| legs[i][0].hypot(legs[i][1]) / request.radius;
    let last = legs.len() - 1;
    let bent = |own: usize, next: usize| 1e-13 + 4.0 * f64::EPSILON * length(next) / length(own).powi(2);
    let sign = if request.turn == Turn::Left { 1.0 } else { -1.0 };
    let heading = |t: f64| {
        let [d, _] = jet(legs, t);
        d[1].atan2(d[0])
    };
    let turned = |angle: f64| angle.sin().atan2(angle.cos());
    let bends = if request.base == Base::Line { [0.0, sign] } else { [sign, 0.0] };
    let checks = [
        ("start", added.control_points[0][0] - request.start[0], 0.0, 0.0),
        ("start", added.control_points[0][1] - request.start[1], 0.0, 0.0),
        ("start direction", turned(heading(0.0) - request.direction), 0.0, 1e-12),
        ("end direction", turned(heading(1.0) - request.direction), turned(sign * request.theta), 1e-12),
        ("end direction as told", turned(heading(1.0) - added.end_direction), 0.0, 1e-12),
        ("start curvature", curvature(legs, 0.0) * request.radius, bends[0], bent(0, 1)),
        ("end curvature", curvature(legs, 1.0) * request.radius, bends[1], bent(last, last - 1)),
    ];
    let mut faults: Vec<String> = checks
        .iter()
        .filter(|(_, is, want, near)| (is - want).abs().partial_cmp(near).is_none_or(|o| o.is_gt()))
        .map(|(what, is, want, _)| format!("{what} is {is:?}, must be {want:?}"))
        .collect();
    let points = &added.local_control_points;
    let size = points[points.len() - 1][0].hypot(points[points.len() - 1][1]);
    for (w, leg) in points.windows(2).zip(legs) {
        if (w[1][0] - w[0][0] - leg[0]).hypot(w[1][1] - w[0][1] - leg[1]) > 1e-14 * size {
            faults.push(format!("a side is {leg:?}, but the points are {w:?}"));
        }
    }
    // Curvature grows away from the line, or dies away from the circle.
    let samples: Vec<f64> = (0..=2000).map(|i| sign * curvature(legs, f64::from(i) / 2000.0)).collect();
    let rising = if request.base == Base::Line { 1.0 } else { -1.0 };
    let largest = samples.iter().fold(0.0f64, |most, k| most.max(k.abs()));
    let monotone = samples.windows(2).all(|w| rising * (w[1] - w[0]) >= -(bent(0, 1) + bent(last, last - 1)) * largest);
    if monotone != (added.level >= Level::Exact) {
        faults.push(format!("level {:?}, but monotone is {monotone}", added.level));
    }
    faults
}

fn segment(kind: Kind, request: &Request) -> Added {
    match add_segment(kind, request).unwrap() {
        Ok(added) => added,
        Err(why) => panic!("{request:?}: {why}"),
    }
}

fn requests(kind: Kind) -> Vec<Request> {
    let mut all = Vec::new();
    for theta in [0.2, 0.8, 1.3, 2.4].into_iter().filter(|t| kind == Kind::Ph || *t < PI / 2.0) {
        let least = if kind == Kind::Cubic { theta.tan() / 3.0 } else { (0.5 * theta).tan() / 2.0 };
        for (m, stretch) in [(0.05, 1.0), (0.2, 1.4), (0.45, 1.3), (0.8, 1.01), (1.0, 0.9), (3.0, 1.2)] {
            let q = stretch * least * (m + if kind == Kind::Cubic { 4.0 } else { 6.0 });
            for base in [Base::Line, Base::Circle] {
                for turn in [Turn::Left, Turn::Right] {
                    let target = Target::Shape { m, q };
                    let (start, direction, radius) = ([0.3, -0.2], -2.0 + theta, 1.7);
                    all.push(Request { base, start, direction, turn, radius, theta, target });
                }
            }
        }
    }
    all
}

#[test]
fn shapes_have_their_end_data_and_their_level() {
    for kind in [Kind::Cubic, Kind::Ph] {
        let mut levels = [0; 4];
        for request in requests(kind) {
            let added = segment(kind, &request);
            assert_eq!(faults(&request, &added), [""; 0], "{kind:?} {request:?}");
            levels[added.level as usize] += 1;
            assert_eq!(added.control_points.len(), if kind == Kind::Cubic { 4 } else { 6 });
            // A point or a side moved by little is noticed.
            for i in 0..added.legs.len() {
                let (mut wrong, mut other) = (added.clone(), added.clone());
                wrong.local_control_points[i][1] += 1e-5;
                other.legs[i][1] += 1e-11;
                assert!(
                    !faults(&request, &wrong).is_empty() && !faults(&request, &other).is_empty(),
                    "{kind:?} {i} {request:?}"
                );
            }
            let wrong =
                Added { level: if added.level == Level::Exists { Level::Exact } else { Level::Exists }, ..added };
            assert!(!faults(&request, &wrong).is_empty());
        }
        assert!(levels.iter().all(|n| *n > 0), "{kind:?} {levels:?}");
    }
}

#[test]
fn the_end_point_of_a_shape_gives_the_shape_again() {
    for kind in [Kind::Cubic, Kind::Ph] {
        for request in requests(kind) {
            let by_shape = segment(kind, &request);
            let end = *by_shape.control_points.last().unwrap();
            let by_point = segment(kind, &Request { target: Target::Point(end), ..request });
            assert_eq!(*by_point.control_points.last().unwrap(), end);
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-11 * (1.0 + b.abs());
            assert!(close(by_point.m, by_shape.m) && close(by_point.q, by_shape.q), "{by_point:?} {by_shape:?}");
            assert_eq!(by_point.level, by_shape.level);
            for (a, b) in by_point.control_points.iter().zip(&by_shape.control_points) {
                assert!(close(a[0], b[0]) && close(a[1], b[1]), "{kind:?} {request:?}");
            }
            assert!((by_point.control_points[1][0] - by_shape.control_points[1][0] - 1e-6).abs() > 1e-9);
        }
    }
}

#[test]
fn what_cannot_be_had_is_said() {
    let request = Request {
        base: Base::Line,
        start: [0.0, 0.0],
        direction: 0.0,
        turn: Turn::Left,
        radius: 2.0,
        theta: 0.8,
        target: Target::Point([3.0, -1.0]),
    };
    let why = |request: &Request| match add_segment(Kind::Cubic, request).unwrap() {
        Err(why) => why,
        Ok(added) => panic!("{added:?}"),
    };
    assert!(why(&request).contains("eta = -0.5, which must be above 0"), "{}", why(&request));
    let near = Request { target: Target::Point([0.1, 1.0]), ..request };
    assert!(why(&near).contains("m <= 0"), "{}", why(&near));
    let circle = Request { base: Base::Circle, target: Target::Point([0.1, 1.0]), ..request };
    assert!(why(&circle).contains("xi sin(theta) - eta cos(theta)"), "{}", why(&circle));
    let complaint = |request: &Request| add_segment(Kind::Cubic, request).unwrap_err().to_string();
    let shape = |m, q| Request { target: Target::Shape { m, q }, ..request };
    assert!(complaint(&shape(0.0, 1.0)).contains("m is 0"));
    assert!(complaint(&shape(1.0, -1.0)).contains("q is -1"));
    assert!(complaint(&Request { radius: 0.0, ..request }).contains("radius is 0"));
    assert!(complaint(&Request { theta: 1.6, ..request }).contains("theta is 1.6"));
    assert!(complaint(&Request { theta: 1.6, ..shape(1.0, 1.0) }).contains("theta is 1.6"));
    assert!(complaint(&Request { direction: f64::NAN, ..request }).contains("direction is NaN"));
    assert!(complaint(&Request { target: Target::Point([f64::INFINITY, 1.0]), ..request }).contains("end point (inf"));
}
