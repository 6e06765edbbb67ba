//! Pieces of paths: what JSON says of one rebuilds it to the last bit.

use super::bezier;
use spiral_atlas::curve::{CubicBezier, PhQuintic, TrigBezier};
use spiral_atlas::transition::{Arc, Clothoid, Cubic, Ends, InvoluteBetween, Line, Piece, TrigPart};

/// One of each kind, all of them far from the origin in units of their size.
pub(crate) fn all() -> Vec<Piece> {
    let start = [300.1, -200.3];
    let points = CubicBezier { p: [start, [300.4, -200.25], [300.8, -200.0], [301.0, -199.3]] };
    let legs =
        std::array::from_fn(|i| [0, 1].map(|k| points.p[i + 1][k] - points.p[i][k] + if k == 0 { 1e-15 } else { 0.0 }));
    let six = [[0.0, 0.0], [0.2, 0.0], [0.5, 0.1], [0.9, 0.2], [1.3, 0.6], [1.4, 1.1]]
        .map(|[x, y]| [start[0] + x, start[1] + y]);
    let ends = Ends {
        start,
        end: [302.1, -200.9],
        start_direction: -0.9,
        end_direction: 1.2,
        start_curvature: -0.3,
        end_curvature: 3.0,
    };
    vec![
        Piece::Cubic(Cubic { points, legs }),
        Piece::PhQuintic(PhQuintic::new(start, [[1.0, 0.1], [0.9, 0.5], [0.4, 1.0]])),
        Piece::TrigQuintic(TrigPart { curve: TrigBezier::new(six, -0.5, 0.75).unwrap(), from: 0.0, to: 1.0 }),
        Piece::TrigQuintic(TrigPart { curve: TrigBezier::new(six, -0.5, 0.75).unwrap(), from: 0.125, to: 1.0 }),
        Piece::Involute(InvoluteBetween::new(&ends, [0, 0]).unwrap()),
        Piece::Line(Line { start, end: [301.7, -200.9] }),
        Piece::Arc(Arc { start, start_direction: 0.3, curvature: -0.7, length: 2.5 }),
        Piece::Clothoid(Clothoid { start, start_direction: 0.3, curvature: -0.7, end_curvature: 1.1, length: 2.5 }),
    ]
}

#[test]
fn pieces_come_back_from_json_as_they_were() {
    for piece in all() {
        let text = serde_json::to_string(&piece).unwrap();
        let back: Piece = serde_json::from_str(&text).unwrap();
        assert_eq!(back, piece, "{text}");
        assert_eq!(serde_json::to_string(&back).unwrap(), text);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(
            (value["kind"].as_str(), value["length"].as_f64()),
            (Some(piece.kind().name()), Some(piece.length()))
        );
        assert!(text.starts_with("{\"kind\":"), "{text}");
    }
    // The same curve by its control points, or by its ends and pre-image alone.
    let bare = r#"{"kind": "cubic", "control_points": [[0, 0], [1, 0], [2, 1], [2, 2]]}"#;
    let Ok(Piece::Cubic(cubic)) = serde_json::from_str(bare) else { panic!("{bare}") };
    assert_eq!(cubic.legs, [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let bare = r#"{"kind": "ph-quintic", "start": [0, 0], "preimage": [[1, 0], [1, 0], [1, 0]]}"#;
    let Ok(Piece::PhQuintic(curve)) = serde_json::from_str(bare) else { panic!("{bare}") };
    assert_eq!((curve.end, bezier(&curve, 1.0).point), ([1.0, 0.0], [1.0, 0.0]));
}

#[test]
fn what_is_wrong_with_a_piece_is_told() {
    let cases = [
        (r#"{"start": [0, 0]}"#, "missing field `kind`"),
        (r#"{"kind": "spline"}"#, "unknown variant `spline`, expected one of `cubic`, `ph-quintic`"),
        (
            r#"{"kind": "clothoid", "start": [0, 0], "direction": 0, "curvature": 1, "length": 2}"#,
            "a piece of the kind `clothoid` needs `end_curvature`",
        ),
        (
            r#"{"kind": "clothoid", "start": [0, 0], "direction": 0, "curvature": 1, "length": 2,
                "end_curvature": -3e9}"#,
            "the length of a clothoid times its greater curvature is 6000000000; ",
        ),
        (r#"{"kind": "ph-quintic", "start": [0, 0]}"#, "a piece of the kind `ph-quintic` needs `preimage`"),
        (
            r#"{"kind": "ph-quintic", "start": [0, 0], "end": [7, 0], "preimage": [[1, 0], [1, 0], [1, 0]]}"#,
            "`end` is [7.0, 0.0], but the pre-image leads to [1.0, 0.0]",
        ),
        (
            r#"{"kind": "cubic", "control_points": [[0, 0], [1, 0]]}"#,
            "`control_points` has 2 points; a piece of the kind `cubic` has 4",
        ),
        (
            concat!(
                r#"{"kind": "cubic", "control_points": [[0, 0], [1, 0], [2, 0], [3, 0]], "#,
                r#""legs": [[1, 0], [1, 0], [2, 0]]}"#
            ),
            "`control_points` end at [3.0, 0.0], but `legs` lead to [4.0, 0.0]",
        ),
        (
            concat!(
                r#"{"kind": "trig-quintic", "control_points": [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]], "#,
                r#""p": 2, "q": 0}"#
            ),
            "p is 2",
        ),
        (
            concat!(
                r#"{"kind": "trig-quintic", "control_points": [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]], "#,
                r#""p": 1, "q": 0, "from": 1}"#
            ),
            "`from` is 1.0 and `to` is 1.0",
        ),
        (r#"{"kind": "line", "start": [1, 1], "end": [1, 1]}"#, "`start` and `end` are both [1.0, 1.0]"),
        (
            r#"{"kind": "arc", "start": [1, 1], "direction": 0, "curvature": 1, "length": -1}"#,
            "`length` of an arc is -1;",
        ),
        (
            r#"{"kind": "arc", "start": [1, 1], "direction": 0, "curvature": 0, "length": 1, "end": [1, 2]}"#,
            "`end` is [1.0, 2.0], but the arc leads to [2.0, 1.0]",
        ),
        (
            concat!(
                r#"{"kind": "involute", "start": [0, 0], "end": [1, 0], "start_direction": 0, "end_direction": 0, "#,
                r#""start_curvature": 1, "end_curvature": 1}"#
            ),
            "no involute has these ends",
        ),
    ];
    for (text, what) in cases {
        let error = serde_json::from_str::<Piece>(text).expect_err(text).to_string();
        assert!(error.contains(what), "{text}: {error}");
    }
}

/// A curve's heading is the direction from point to point, its curvature how that turns, its speed how fast points
/// follow.
#[test]
fn directions_curvatures_and_speeds_are_those_of_the_points() {
    for piece in all() {
        let [from, to] = piece.range();
        assert_eq!((piece.start(), piece.end()), (piece.at(from).point, piece.at(to).point));
        for i in 1..16 {
            let (t, h) = (from + (to - from) * f64::from(i) / 16.0, 1e-4);
            let [before, here, after] = [t - h, t, t + h].map(|t| piece.at(t));
            let step = [0, 1].map(|k| after.point[k] - before.point[k]);
            let length = step[0].hypot(step[1]);
            let turn = |a: f64, b: f64| (b - a).sin().atan2((b - a).cos());
            assert!(turn(here.heading, step[1].atan2(step[0])).abs() < 1e-5, "{piece:?} at {t}");
            assert!((turn(before.heading, after.heading) / length - here.curvature).abs() < 1e-5, "{piece:?} at {t}");
            assert!(here.speed.is_nan() || (length / (2.0 * h) / here.speed - 1.0).abs() < 1e-6, "{piece:?} at {t}");
        }
    }
}
