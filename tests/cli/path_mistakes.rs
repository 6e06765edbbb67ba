//! Mistakes in the input of `path`, each named.

use super::path::run_or_pipe;

#[test]
fn mistakes_are_named() {
    let cases: &[(&[&str], &str, &[&str])] = &[
        (&["hermite", "-"], "{", &["standard input: it ends in the middle of its JSON (line 1, column 1)"]),
        (&["measure", "-"], r#"{"paths": [{"pieces": []}]}"#, &["paths[0]: `pieces` is empty"]),
        (
            &["measure", "-"],
            concat!(
                r#"{"paths": [{"pieces": [{"kind": "ph-quintic", "start": [0, 0], "#,
                r#""preimage": [[1, 0], [1, 0], [1, 0]]}, {"kind": "ph-quintic", "start": [7, 7], "#,
                r#""preimage": [[1, 0], [1, 0], [1, 0]]}]}]}"#
            ),
            &["paths[0]: pieces[0] ends at [1.0, 0.0], pieces[1] starts at [7.0, 7.0]"],
        ),
        (
            &["measure", "-", "--offset", "1e308"],
            concat!(
                r#"{"paths": [{"pieces": [{"kind": "ph-quintic", "start": [0, 0], "#,
                r#""preimage": [[100, 0], [50, 60], [1, 90]]}]}]}"#
            ),
            &["paths[0]: pieces[0]: its offset at distance 1e308"],
        ),
        (&["measure", "-", "--offset", "inf"], r#"{"paths": []}"#, &["--offset is inf"]),
        (
            &["measure", "-", "--samples", "1000001"],
            r#"{"paths": []}"#,
            &["\"1000001\" is no whole number from 2 to 1000000", "--samples"],
        ),
        (&["hermite", "-"], r#"{"start": [0, 0]}"#, &["standard input: the field `end` is missing (line 1"]),
        (
            &["hermite", "-"],
            r#"{"start": [0, 0], "end": [1, 0], "start_derivative": [0, 0], "end_derivative": [1, 0]}"#,
            &["standard input", "`start_derivative` is 0"],
        ),
        (&["spline", "-"], r#"{"points": [[0, 0], [1, 0], [1, 0]]}"#, &["points[1] and points[2]", "[1.0, 0.0]"]),
        (
            &["spline", "-"],
            r#"{"points": [[0, 0], [1e999, 0]]}"#,
            &["standard input: points[1][0] is beyond the range of doubles"],
        ),
        (
            &["spline", "-"],
            r#"{"points": [[0, 0], [1, 0, 0]]}"#,
            &["standard input: points[1] has more values than belong there (line 1"],
        ),
        (
            &["spline", "-"],
            r#"{"points": [[0, 0], [1, 0]]} {}"#,
            &["standard input: it is not JSON (line 1, column 30): something follows after its end"],
        ),
        (
            &["spline", "-"],
            "[[[0, 0], [1, 0]]]",
            &["standard input: it must be an object with the fields points, closed; it is a list"],
        ),
        (&["spline", "-"], r#"{"point": []}"#, &["there is no field `point`; did you mean `points`?"]),
        (
            &["equal-length", "-"],
            concat!(
                r#"{"length": 2, "paths": [{"start": [0, 0], "end": [3, 0], "start_direction": 0.1, "#,
                r#""end_direction": "5deg"}]}"#
            ),
            &["paths[0]", "`length` is 2;", "distance 3 "],
        ),
        (
            &["equal-length", "-"],
            concat!(
                r#"{"length": 2, "paths": [{"start": [0, 0], "end": [3, 0], "start_direction": "4dg", "#,
                r#""end_direction": 0}]}"#
            ),
            &["standard input: paths[0].start_direction: \"4dg\" is no angle"],
        ),
        (
            &["equal-length", "-"],
            r#"{"length": 2, "paths": [[[0, 0], [1, 0], 1, 1]]}"#,
            &["paths[0] must be an object with the fields start, end, start_direction, end_direction; it is a list"],
        ),
        (
            &["separation", "-", "--minimum", "0"],
            r#"{"paths": [{"pieces": [[[0, 0], null, [[1, 0], [1, 0], [1, 0]]]]}]}"#,
            &["paths[0].pieces[0] must be an object with the fields kind, start, end, start_direction"],
        ),
        (
            &["separation", "-", "--minimum", "0"],
            concat!(
                r#"{"paths": [{"pieces": [{"kind": "ph-quintic", "start": [0, 0], "#,
                r#""preimage": [[1, 0], [1, 0], [1, 0]]}]}, {"pieces": []}]}"#
            ),
            &["paths[1]: `pieces` is empty"],
        ),
        (
            &["plan", "-"],
            r#"{"obstacles": [[[0, 1], [1, 2], [3]]]}"#,
            &["standard input: obstacles[0][2] must be a pair of numbers [x, y]; it has 1 value (line 1"],
        ),
        (&["equal-length", "-"], r#"{"length": 2, "paths": []}"#, &["`paths` is empty"]),
        (&["separation", "-", "--minimum", "0"], r#"{"paths": []}"#, &["0 paths"]),
        (
            &["separation", "-", "--minimum", "0"],
            concat!(
                r#"{"paths": [{"pieces": [{"kind": "ph-quintic", "start": [0, 0], "end": [7, 0], "#,
                r#""preimage": [[1, 0], [1, 0], [1, 0]]}]}, {"pieces": []}]}"#
            ),
            &["paths[0]", "pieces[0]", "`end` is [7.0, 0.0]", "[1.0, 0.0]"],
        ),
        (
            &["separation", "-", "--minimum", "0"],
            concat!(
                r#"{"paths": [{"speed": 0, "pieces": [{"kind": "ph-quintic", "start": [0, 0], "#,
                r#""preimage": [[1, 0], [1, 0], [1, 0]]}]}, {"pieces": []}]}"#
            ),
            &["paths[0]", "`speed` is 0;"],
        ),
        (
            &["plan", "-"],
            concat!(
                r#"{"start": [0, 0], "goal": [3, 0], "obstacles": [[[1, 1], [2, 2]]], "clearance": 0, "#,
                r#""greatest_curvature": 1}"#
            ),
            &["standard input", "obstacles[0] has 2 different vertices"],
        ),
        (&["plan", "-"], r#"{"start": [0, 0], "heading": 1}"#, &["there is no field `heading`"]),
        (&["separation", "missing.json", "--minimum", "1"], "", &["missing.json", "No such file"]),
        (&["spline", "-", "--figure", "x.jpg"], "{}", &["x.jpg", ".png or .svg"]),
    ];
    for (args, input, parts) in cases {
        let said = run_or_pipe(args, input);
        assert_eq!((said.code, &said.out[..]), (Some(2), ""), "{args:?} {input}");
        assert!(parts.iter().all(|part| said.err.contains(part)), "{args:?} {input}: {}", said.err);
    }
}

/// Numbers near both ends of the range of doubles, in every place: an answer of finite numbers, or an error with a way
/// out.
/// A misspelt field of a path or a piece is no silence; what the tools print is read.
#[test]
fn unknown_fields_of_paths_are_refused() {
    let piece = r#"{"kind": "line", "start": [0, 0], "end": [1, 0], "length": 1}"#;
    let two = |field: &str| format!(r#"{{"paths": [{{"pieces": [{piece}]}}, {{"pieces": [{piece}], {field}: 2}}]}}"#);
    for (tool, text, what) in [
        ("separation", two("\"sped\""), "there is no field `sped` in paths[1]; did you mean `speed`?"),
        ("measure", two("\"start_tme\""), "there is no field `start_tme` in paths[1]; did you mean `start_time`?"),
        (
            "measure",
            two("\"speed\"").replacen("\"end\"", "\"endd\"", 1),
            "there is no field `endd` in paths[0].pieces[0]; did you mean `end`?",
        ),
    ] {
        let more: &[&str] = if tool == "separation" { &["--minimum", "0.1"] } else { &[] };
        let said = super::curve_output::piped(&[&["path", tool, "-"], more].concat(), &text);
        assert!(said.code == Some(2) && said.err.contains(what) && said.out.is_empty(), "{tool}: {}", said.err);
    }
    let refused = super::run(["path", "measure", "-", "--samples", "3", "--csv", "--offset", "-0.5"]);
    assert!(refused.code == Some(2) && refused.err.contains("cannot be used with"), "{}", refused.err);
}

#[test]
fn extreme_numbers_have_an_answer_or_a_way_out() {
    let templates: [(&[&str], &str); 4] = [
        (&["spline", "-"], r#"{"points": [[0, 0], [1, X], [X, 0], [3, 1]]}"#),
        (&["spline", "-"], r#"{"points": [[0, 0], [X, 0], [X, X]], "closed": true}"#),
        (
            &["equal-length", "-"],
            concat!(
                r#"{"length": L, "paths": [{"start": [0, 0], "end": [X, 0], "start_direction": 1e-300, "#,
                r#""end_direction": 5e-324}]}"#
            ),
        ),
        (
            &["separation", "-", "--minimum", "1e-300"],
            concat!(
                r#"{"paths": [{"pieces": [{"kind": "line", "start": [0, 0], "end": [X, 0]}], "speed": L}, "#,
                r#"{"pieces": [{"kind": "cubic", "control_points": [[0, 0], [1, X], [2, 0], [X, X]]}], "#,
                r#""start_time": X}]}"#
            ),
        ),
    ];
    let numbers = ["5e-324", "1e-310", "1e-200", "1e-16", "1e16", "1e154", "1e300", "1.7e308", "-1e308"];
    let mut answers = 0;
    for (args, template) in templates {
        for (x, l) in numbers.iter().flat_map(|x| numbers.iter().step_by(2).map(move |l| (x, l))) {
            let said = run_or_pipe(args, &template.replace('X', x).replace('L', l));
            let ways_out =
                ["unit of", "range of doubles", "too ", "must ", "different", "coincide", "no spline", "fail"];
            match said.code {
                Some(0 | 1) => {
                    answers += 1;
                    assert!(!said.out.is_empty() && !said.out.contains("NaN"), "{args:?} {x} {l}: {}", said.out);
                }
                Some(2) => assert!(ways_out.iter().any(|way| said.err.contains(way)), "{args:?} {x} {l}: {}", said.err),
                other => panic!("{args:?} {x} {l}: {other:?} {}", said.err),
            }
        }
    }
    assert!(answers > 20, "{answers}");
}
