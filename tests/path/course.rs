//! Courses of pieces of all kinds, against their points alone.

use super::piece;
use spiral_atlas::curve::TrigBezier;
use spiral_atlas::path::{Course, OffsetCurve};
use spiral_atlas::transition::join::{Family, Request, State, join};
use spiral_atlas::transition::{Arc, Line, Piece, TrigPart};

/// Pieces of all kinds, and some whose curvature rises, falls and changes its sign.
fn courses() -> Vec<Course> {
    let waving = |from: f64, to: f64| {
        let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [3.0, -1.0], [4.0, -1.0], [5.0, 0.0]];
        Piece::TrigQuintic(TrigPart { curve: TrigBezier::new(points, -0.5, 0.75).unwrap(), from, to })
    };
    let cubics = [
        "[[0, 0], [1, 0], [2, 1], [1.5, 2]]",
        "[[0, 0], [1, 1], [2, -1], [3, 0]]",
        "[[0, 0], [3, 2], [-2, 2], [1, 0]]",
    ];
    let cubic =
        |points: &str| serde_json::from_str(&format!(r#"{{"kind": "cubic", "control_points": {points}}}"#)).unwrap();
    let others = cubics.map(cubic).into_iter().chain([waving(0.0, 1.0), waving(0.0625, 0.7)]);
    piece::all().into_iter().chain(others).map(|piece| Course::new(vec![piece]).unwrap()).collect()
}

/// Where a list of numbers begins to fall after rising, or to rise after falling.
fn turns(values: &[f64]) -> Vec<usize> {
    let signed: Vec<(usize, bool)> = values
        .windows(2)
        .enumerate()
        .filter(|(_, w)| (w[1] - w[0]).abs() > 1e-9)
        .map(|(i, w)| (i, w[1] > w[0]))
        .collect();
    signed.windows(2).filter(|w| w[0].1 != w[1].1).map(|w| w[1].0).collect()
}

#[test]
fn extrema_and_inflections_are_where_samples_show_them() {
    let (mut extrema, mut inflections) = (0, 0);
    for course in courses() {
        let samples = course.stations(4001).unwrap();
        let step = course.length() / 4000.0;
        let curvatures: Vec<f64> = samples.iter().map(|s| s.curvature).collect();
        let shown: Vec<f64> = turns(&curvatures).into_iter().map(|i| samples[i].station).collect();
        let found = course.curvature_extrema();
        assert_eq!(found.len(), shown.len(), "{:?}: {shown:?}", course.pieces());
        for (spot, shown) in found.iter().zip(&shown) {
            assert!((spot.station.station - shown).abs() <= 2.0 * step, "{spot:?} {shown}");
            let at = course.pieces()[0].at(spot.parameter);
            assert_eq!(([spot.station.x, spot.station.y], spot.station.curvature), (at.point, at.curvature));
        }
        let crossed = samples.windows(2).filter(|w| w[0].curvature * w[1].curvature < 0.0).map(|w| w[0].station);
        let crossed: Vec<f64> = crossed.collect();
        let found = course.inflections();
        assert_eq!(found.len(), crossed.len(), "{:?}: {crossed:?}", course.pieces());
        assert!(found.iter().zip(&crossed).all(|(spot, station)| (spot.station.station - station).abs() <= 2.0 * step));
        assert!(found.iter().all(|spot| spot.station.curvature.abs() < 1e-12));
        let most = curvatures.iter().fold(0.0f64, |most, k| most.max(k.abs()));
        let greatest = course.greatest_curvature();
        assert!(greatest >= most * (1.0 - 1e-12) && greatest <= most * (1.0 + 1e-4) + 1e-12, "{greatest} {most}");
        (extrema, inflections) = (extrema + course.curvature_extrema().len(), inflections + found.len());
    }
    assert!(extrema >= 8 && inflections >= 4, "{extrema} {inflections}");
}

#[test]
fn offset_curves_are_at_their_distance() {
    for course in courses() {
        for d in [0.1, -0.25] {
            let [offset] = &course.offset(d).unwrap()[..] else { panic!("one for each piece") };
            let points: Vec<[f64; 2]> = match offset {
                OffsetCurve::Exact(exact) => [0.0, 1.0].map(|t| exact.point(t)).to_vec(),
                OffsetCurve::Sampled { points } => points.clone(),
            };
            assert_eq!(points.len() == 2, matches!(course.pieces()[0], Piece::PhQuintic(_)));
            for (point, at) in points.iter().zip(course.stations(points.len()).unwrap()) {
                let beside = [point[0] - at.x, point[1] - at.y];
                assert!((beside[0] + d * at.heading.sin()).hypot(beside[1] - d * at.heading.cos()) < 1e-11);
            }
        }
    }
}

#[test]
fn a_road_of_lines_and_arcs() {
    let line = |start, end| Piece::Line(Line { start, end });
    let arc = |start, curvature: f64| Piece::Arc(Arc { start, start_direction: 0.0, curvature, length: 1.0 });
    let bend = arc([2.0, 0.0], 0.5);
    let back = Piece::Arc(Arc { start: bend.end(), start_direction: 0.5, curvature: -0.25, length: 2.0 });
    let course = Course::new(vec![line([0.0, 0.0], [2.0, 0.0]), bend, back]).unwrap();
    assert_eq!((course.length(), course.bending_energy(), course.absolute_rotation()), (5.0, Some(0.375), Some(1.0)));
    assert_eq!((course.greatest_curvature(), course.curvature_extrema()), (0.5, vec![]));
    let [inflection] = course.inflections()[..] else { panic!("one, between the arcs") };
    assert_eq!((inflection.piece, inflection.parameter, inflection.station.station), (2, 0.0, 3.0));
    // Roundings at a joint are none of its business; a gap is.
    let near = |gap: f64| Course::new(vec![line([0.0, 0.0], [2.0, 0.0]), arc([2.0 + gap, 0.0], 0.5)]);
    assert!(near(1e-12).is_ok());
    let error = near(1e-6).unwrap_err().to_string();
    assert!(error.contains("pieces[0] ends at [2.0, 0.0], pieces[1] starts at [2.000001, 0.0]"), "{error}");
    assert!(Course::new(vec![]).unwrap_err().to_string().contains("`pieces` is empty"));
    let error = Course::new(vec![line([-1e308, 0.0], [1e308, 0.0])]).unwrap_err().to_string();
    assert!(error.contains("pieces[0] is inf long"), "{error}");
}

/// Lengths up to a parameter are those of the samples.
#[test]
fn lengths_up_to_a_parameter() {
    for course in courses() {
        let piece = &course.pieces()[0];
        let [from, to] = piece.range();
        assert_eq!((piece.length_to(from), piece.length_to(to)), (0.0, piece.length()));
        let part = |i: u32| piece.length_to(from + (to - from) * f64::from(i) / 64.0);
        let point = |i: u32| piece.at(from + (to - from) * f64::from(i) / 64.0).point;
        for i in 0..64 {
            let (p, q) = (point(i), point(i + 1));
            let (chord, length) = ((p[0] - q[0]).hypot(p[1] - q[1]), part(i + 1) - part(i));
            assert!(chord <= length * (1.0 + 1e-9) && chord > 0.98 * length, "{piece:?}: {chord} {length}");
        }
    }
}

/// A few metres of spirals on a way of 100 km: no sample at equal lengths needs to meet one of them.
#[test]
fn an_outline_has_every_peak_of_a_long_path() {
    let state = |x: f64, y: f64, direction: f64| State { point: [x, y], direction, curvature: 0.0 };
    for far in [1e2, 1e5, 1e9] {
        let request = Request::new(state(0.0, 0.0, 0.0), state(far, 0.15 * far, 1.7), 0.5);
        for family in [Family::Cubic, Family::PhQuintic, Family::Involute] {
            let found = join(&Request { family, ..request }).unwrap();
            let course = Course::new(found.unwrap().pieces).unwrap();
            let outline = course.outline(2000).unwrap();
            let most = outline.iter().fold(0.0f64, |most, station| most.max(station.curvature.abs()));
            assert_eq!(most, course.greatest_curvature(), "{far} {family:?}");
            assert!(outline.windows(2).all(|w| w[0].station <= w[1].station));
        }
    }
    // An extremum inside a piece, between samples.
    let bend = |y: f64| format!("[[0, 0], [1, {y}], [2, {}], [3, 0]]", -y);
    let cubic = format!(r#"{{"kind": "cubic", "control_points": {}}}"#, bend(1.0));
    let line = |start: f64, end: f64| Piece::Line(Line { start: [start, 0.0], end: [end, 0.0] });
    let course = Course::new(vec![line(-1e7, 0.0), serde_json::from_str(&cubic).unwrap(), line(3.0, 1e7)]).unwrap();
    let outline = course.outline(2000).unwrap();
    let most = outline.iter().fold(0.0f64, |most, station| most.max(station.curvature.abs()));
    assert!(most > 0.5 && most == course.greatest_curvature(), "{most}");
}
