//! The command `join`.

use super::curve_output::piped;
use super::{Folder, fine, run};
use serde_json::{Value, json};

const LIMIT: [&str; 2] = ["--greatest-curvature", "0.5"];

fn join(arguments: &[&str]) -> super::Said {
    run(["join"].iter().chain(arguments))
}

fn with_limit(arguments: &[&str]) -> super::Said {
    join(&[&LIMIT, arguments].concat())
}

fn kinds(json: &Value) -> Vec<&str> {
    json["paths"][0]["pieces"].as_array().unwrap().iter().map(|piece| piece["kind"].as_str().unwrap()).collect()
}

#[test]
fn states_lines_and_circles_are_joined() {
    let folder = Folder::new("");
    let figure = folder.text("join.png");
    let said = with_limit(&["--from", "0,0,0deg", "--to", "8,6,90deg", "--figure", &figure, "--samples", "11"]).json();
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    let lines = folder.text("join.SVG");
    with_limit(&["--from", "0,0,0deg", "--to", "8,6,90deg", "--figure", &lines]);
    let svg = std::fs::read_to_string(&lines).unwrap();
    assert!(svg.starts_with("<?xml") && svg.trim_end().ends_with("</svg>") && svg.contains(">A join of length "));
    assert_eq!(said["samples"].as_array().unwrap().len(), 11);
    assert_eq!(said["samples"][10]["station"], said["paths"][0]["length"]);
    let arc = said["paths"][0]["pieces"].as_array().unwrap().iter().find(|piece| piece["kind"] == "arc").unwrap();
    assert!(
        arc["start"].is_array() && arc["direction"].is_number() && arc["curvature"] == 0.5 && arc["length"].is_number()
    );
    let u = with_limit(&["--from-line", "0,0,0", "--to-line", "0,9,100deg", "--family", "ph-quintic"]).json();
    assert_eq!(kinds(&u), ["ph-quintic", "arc", "ph-quintic"]);
    let j = with_limit(&["--from-line=-3,0,0", "--to-circle", "0,4.2,4,left", "--most-pieces", "1"]).json();
    assert_eq!(kinds(&j), ["cubic"]);
    let s = with_limit(&["--from-circle", "0,0,4,left", "--to-circle", "12,0,3,right", "--objective", "greatest-rate"])
        .json();
    let [low, high] = [0, 1].map(|i| s["paths"][0]["curvature_range"][i].as_f64().unwrap());
    assert!((low + 1.0 / 3.0).abs() < 1e-12 && (high - 0.25).abs() < 1e-12, "{low} {high}");
}

#[test]
fn samples_come_as_a_table() {
    let csv = with_limit(&["--from", "0,0,0", "--to", "5,0,0", "--samples", "3", "--csv"]);
    assert_eq!(
        csv.out,
        "station,x,y,heading,curvature\n0.0,0.0,0.0,0.0,0.0\n2.5,2.5,0.0,0.0,0.0\n5.0,5.0,0.0,0.0,0.0\n"
    );
    assert_eq!(csv.code, Some(0));
    let none = with_limit(&["--from", "0,0,0", "--to", "5,0,0", "--samples", "3", "--csv", "--longest", "4"]);
    assert_eq!((none.code, none.out.as_str()), (Some(1), ""));
    assert!(
        none.err.contains("keeps to a length of 4; without that bound one has 1 piece and is 5 long"),
        "{}",
        none.err
    );
    let few = with_limit(&["--from", "0,0,0", "--to", "8,6,90deg", "--most-pieces", "1"]);
    assert!(few.code == Some(1) && few.out.contains("keeps to 1 piece; without that bound one has"), "{}", few.out);
}

#[test]
fn no_join_is_an_answer() {
    let none = with_limit(&["--from", "0,0,0,0.7", "--to", "5,0,0"]);
    assert_eq!(none.code, Some(1));
    let none: Value = serde_json::from_str(&none.out).unwrap();
    assert_eq!(none, json!({ "paths": [], "reason": "the start curvature 0.7 is beyond the greatest curvature 0.5" }));
    let one = with_limit(&["--from-line", "0,0,0", "--to-line", "5,0,0"]);
    assert!(one.code == Some(1) && one.out.contains("there is nothing to join"), "{}", one.out);
}

#[test]
fn a_request_stands_in_a_file() {
    let folder = Folder::new("");
    let typed = ["join", "--from", "0,0,0", "--to", "4,3,90deg,0.25", "--greatest-curvature", "0.5", "--longest", "99"];
    let typed = fine(typed).out;
    let toml = "greatest_curvature = 0.5\nlongest = 99\nfrom.state = { point = [0, 0], direction = 0 }\n\
                to.state = { point = [4, 3], direction = \"90deg\", curvature = 0.25 }\n";
    std::fs::write(folder.at("a.toml"), toml).unwrap();
    assert_eq!(join(&[&folder.text("a.toml")]).out, typed);
    let json = json!({
        "greatest_curvature": 0.5, "longest": 99, "family": "cubic", "objective": "length", "most_pieces": 11,
        "from": { "state": { "point": [0, 0], "direction": 0 } },
        "to": { "state": { "point": [4, 3], "direction": "90deg", "curvature": 0.25 } },
    });
    assert_eq!(piped(&["join", "-"], &json.to_string()).out, typed);
    // As some editors write it.
    assert_eq!(piped(&["join", "-"], &format!("\u{feff}{json}")).out, typed);
    let mut circle = json.clone();
    circle["from"] = json!({ "line": { "point": [0, 0], "direction": 0 } });
    circle["to"] = json!({ "circle": { "centre": [9, 3], "radius": 2, "turn": "left" } });
    assert_eq!(piped(&["join", "-"], &circle.to_string()).code, Some(0));
    // The curvature of a straight end is 0, and no rounding of it.
    let ramp = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ramp.toml");
    let csv = fine(["join", ramp, "--samples", "21", "--csv"]).out;
    assert!(csv.lines().last().unwrap().ends_with(",0.0"), "{csv}");
    for (path, value, what) in [
        (
            "objective",
            json!("speed"),
            "objective must be one of `length`, `greatest-curvature`, `greatest-rate`, `bending-energy`; it is `speed`",
        ),
        (
            "objective",
            json!(null),
            "objective must be one of \"length\", \"greatest-curvature\", \"greatest-rate\", \"bend",
        ),
        (
            "family",
            json!(3),
            "family must be one of \"cubic\", \"ph-quintic\", \"involute\", \"trig-quintic\", \"clothoid\"; it is",
        ),
        ("longset", json!(3), "there is no field `longset`; did you mean `longest`?"),
        ("from", json!({ "state": { "point": [0, 0] } }), "from.state lacks the field `direction`"),
        ("from", json!(null), "from must be an object with the fields state, line, circle; it is null (line 1"),
        ("from", json!([0, 0, 0]), "from must be an object with the fields state, line, circle; it is a list (line 1"),
        ("from", json!({}), "from: give one of `state`, `line` and `circle`; there is none"),
        (
            "from",
            json!({ "state": [0, 0] }),
            "from.state must be an object with the fields point, direction, curvature; it",
        ),
        (
            "from",
            json!({ "line": { "point": [0, 0], "direction": 40 } }),
            "say which unit is meant: \"40deg\" or \"40rad\"",
        ),
        ("to", json!({ "pose": {} }), "there is no field `pose` in to; known are `state`, `line`, `circle`"),
        (
            "to",
            json!({
                "line": { "point": [0, 0], "direction": 0 },
                "circle": { "centre": [0, 0], "radius": 1, "turn": "left" },
            }),
            "to: keep one of `state`, `line` and `circle`; there are several",
        ),
        (
            "to",
            json!({ "circle": { "centre": [0, 0], "radius": 1, "turn": 1 } }),
            "to.circle.turn must be one of \"left\", \"right\"; it is `1`",
        ),
    ] {
        let mut wrong = json.clone();
        wrong[path] = value;
        let said = piped(&["join", "-"], &wrong.to_string());
        assert!(said.code == Some(2) && said.err.contains(what) && !said.err.contains("not JSON"), "{}", said.err);
    }
    for (from, to, what) in [
        ("longest", "family = cubic\nlongest", "a text stands in quotation marks: \"cubic\""),
        (
            "longest",
            "family = 3\nlongest",
            "family must be one of \"cubic\", \"ph-quintic\", \"involute\", \"trig-quintic\", \"clothoid\"; it is `3`",
        ),
        ("direction = 0 ", "direction = 40deg ", "a text stands in quotation marks: \"40deg\""),
        ("direction = 0 ", "direction = 40 ", "from.state.direction: 40 is more than a full turn in radians"),
        ("from.state = {", "from.stat = {", "there is no field `stat` in from; did you mean `state`?"),
        ("from.state = {", "from = 1 #", "from must be an object with the fields state, line, circle; it is `1`"),
        ("from.state", "from.line = {}\nfrom.state", "from.line lacks the field `point`"),
    ] {
        std::fs::write(folder.at("b.toml"), toml.replacen(from, to, 1)).unwrap();
        let said = join(&[&folder.text("b.toml")]);
        assert!(said.code == Some(2) && said.err.contains(what), "{to}: {}", said.err);
    }
}

/// A curvature far below what a path keeps to is that of a straight end; directions of many turns are reduced.
#[test]
fn curvatures_of_next_to_nothing_are_straight() {
    let straight = with_limit(&["--from", "0,0,0", "--to", "8,6,90deg"]).out;
    for tiny in ["5e-324", "-5e-324", "1e-310", "1e-300", "-1e-160", "1e-20", "4e-13"] {
        let from = format!("0,0,0,{tiny}");
        assert_eq!(with_limit(&["--from", &from, "--to", &format!("8,6,90deg,{tiny}")]).out, straight, "{tiny}");
    }
    for tiny in ["1e-12", "-1e-11", "1e-9", "1e-6", "-1e-3"] {
        for family in ["cubic", "ph-quintic", "involute"] {
            let end = format!("8,6,90deg,{tiny}");
            let said =
                with_limit(&["--from", &format!("0,0,0,{tiny}"), "--to", &end, "--family", family, "--samples", "2"])
                    .json();
            for sample in said["samples"].as_array().unwrap() {
                let off = sample["curvature"].as_f64().unwrap() - tiny.parse::<f64>().unwrap();
                assert!(off.abs() <= 0.5e-12, "{family} {tiny}: {sample}");
            }
        }
    }
    let turned = with_limit(&["--from", "0,0,3600000000deg", "--to", "8,6,90deg"]).json();
    let length = |json: &Value| json["paths"][0]["length"].as_f64().unwrap();
    assert!((length(&turned) - length(&serde_json::from_str(&straight).unwrap())).abs() < 1e-6);
    let huge = with_limit(&["--from", "0,0,1e300rad", "--to", "8,6,90deg"]);
    assert_eq!(piped(&["path", "measure", "-"], &huge.out).code, Some(0), "{}", huge.err);
}

#[test]
fn tables_are_answered_row_by_row() {
    let rows = "x0,y0,direction0,curvature0,x1,y1,direction1,curvature1\n0,0,0,0,8,6,90deg,0\n\
                0,0,0,1,8,6,1,0\n0,0,0,x,8,6,1,0\n\
                0,0,0,nan,8,6,1,0\n";
    let said = piped(&["join", "--points", "-", "--greatest-curvature", "0.5"], rows);
    let lines: Vec<Value> = said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((said.code, lines.len()), (Some(2), 4));
    assert_eq!(lines[0]["pieces"][0]["kind"], "cubic");
    assert!(lines[1]["pieces"].is_null() && lines[1]["reason"].as_str().unwrap().contains("start curvature 1.0"));
    assert_eq!(lines[2], json!({ "row": 3, "error": "curvature0: \"x\" is no number" }));
    assert!(lines[3]["error"].as_str().unwrap().contains("start curvature is NaN"));
    let told = piped(&["join", "--points", "-", "--greatest-curvature", "0.5", "--samples", "3", "--csv"], rows);
    let table: Vec<&str> = told.out.lines().collect();
    assert_eq!((told.code, table.len(), table[0]), (Some(2), 4, "row,station,x,y,heading,curvature"), "{}", told.err);
    assert!(table[1].starts_with("1,0.0,0.0,0.0,0.0,") && table[3].starts_with("1,"), "{}", told.out);
    let [two, three] = ["row 2: the start curvature 1.0 is beyond", "row 3: curvature0: \"x\" is no number"];
    assert!(told.err.contains(two) && told.err.contains(three), "{}", told.err);
    let sampled = piped(&["join", "--points", "-", "--greatest-curvature", "0.5", "--samples", "3"], rows);
    let first: Value = serde_json::from_str(sampled.out.lines().next().unwrap()).unwrap();
    assert_eq!(first["samples"][2]["station"], first["length"]);
    let fine = rows.lines().take(3).collect::<Vec<_>>().join("\n");
    let said = piped(&["join", "--points", "-", "--greatest-curvature", "0.5"], &fine);
    assert_eq!(said.code, Some(0));
}

/// One answer, lines of answers with a no and a bad row among them, and a path alone.
#[test]
fn joins_are_read_by_what_reads_paths() {
    let one = with_limit(&["--from", "0,0,0", "--to", "8,6,90deg"]).out;
    let length = serde_json::from_str::<Value>(&one).unwrap()["paths"][0]["length"].as_f64().unwrap();
    let near = |measured: &Value| (measured.as_f64().unwrap() - length).abs() < 1e-12 * length;
    let rows = "x0,y0,direction0,curvature0,x1,y1,direction1,curvature1\n0,0,0,0,8,6,90deg,0\n\
                0,0,0,1,8,6,1,0\n0,0,0,x,8,6,1,0\n\
                0,0,0,0,8,6,90deg,0\n";
    let lines = piped(&["join", "--points", "-", "--greatest-curvature", "0.5"], rows).out;
    let alone = lines.lines().next().unwrap();
    for (input, count, note) in
        [(&one[..], 1, ""), (&lines, 2, "lines 2, 3 of standard input have no path"), (alone, 1, "")]
    {
        let said = piped(&["path", "measure", "-"], input);
        assert!(said.err.contains(note) && said.err.is_empty() == note.is_empty(), "{}", said.err);
        let paths = said.json()["paths"].as_array().unwrap().clone();
        assert!(paths.len() == count && paths.iter().all(|path| near(&path["length"])), "{paths:?}");
        let road = piped(&["export", "opendrive", "-"], input);
        assert_eq!((road.code, road.out.matches("<road ").count()), (Some(0), count), "{}", road.err);
    }
    let apart = piped(&["path", "separation", "-", "--minimum", "1"], &lines).json();
    assert_eq!(apart["verdict"], "violated");
    let broken = lines.replacen("\"kind\":\"arc\"", "\"kind\":\"ark\"", 2);
    let said = piped(&["path", "measure", "-"], &broken);
    assert!(said.code == Some(2) && said.err.contains("standard input: line 1: pieces["), "{}", said.err);
}

#[test]
fn mistakes_are_told() {
    for (arguments, what) in [
        (vec!["--to", "1,0,0"], "one of `--from`, `--from-line` and `--from-circle` is needed"),
        (vec!["--from", "0,0", "--to", "1,0,0"], "\"0,0\" is no state `x,y,angle`"),
        (vec!["--from", "0,0,nan", "--to", "1,0,0"], "nan"),
        (vec!["--from-circle", "0,0,1,up", "--to-line", "1,0,0"], "is no circle"),
        (
            vec!["--from-circle", "0,0,-1,left", "--to-line", "1,0,0"],
            "the start radius is -1; it must be finite and above 0",
        ),
        (vec!["--from", "0,0,0", "--to-line", "1,0,0"], "one end is a state and the other is not"),
        (vec!["--from", "0,0,0", "--from-line", "0,0,0", "--to-line", "1,0,0"], "cannot be used with"),
        (vec!["--from", "0,0,0", "--to", "1,0,0", "--most-pieces", "0"], "the most pieces are 0"),
        (vec!["--from", "0,0,0", "--to", "1,0,0", "--longest=-1"], "the longest length is -1;"),
        (vec!["--from", "0,0,0", "--to", "1,0,0", "--figure", "a.jpg"], "end its name with .png or .svg"),
        (vec!["--from", "0,0,0", "--to", "1,0,0", "--figure", "/no/such/a.png"], "has no folder `/no/such` to be in"),
        (vec!["--from", "0,0,0", "--to", "1,0,0", "--csv"], "--samples"),
        (
            vec!["--from", "0,0,0", "--to", "4e12,0,0"],
            "the ends are 2000000000000 least radii apart, where no join is sought",
        ),
        (vec!["--from-circle", "0,0,1e13,left", "--to-circle", "0,0,4,left"], "check the unit of length"),
        (vec!["request.toml"], "cannot be used with"),
    ] {
        let said = with_limit(&arguments);
        assert!(said.code == Some(2) && said.err.contains(what) && said.out.is_empty(), "{arguments:?}: {}", said.err);
    }
    let limit = |limit: &str| join(&["--from", "0,0,0", "--to", "1,0,0", &format!("--greatest-curvature={limit}")]);
    for (given, what) in
        [("0", "is 0; it must"), ("-1", "is -1;"), ("nan", "is NaN"), ("1e200", "change the unit of length")]
    {
        let said = limit(given);
        assert!(said.code == Some(2) && said.err.contains(what), "{}", said.err);
    }
    assert!(join(&["--from", "0,0,0", "--to", "1,0,0"]).err.contains("`--greatest-curvature` is needed"));
}

/// A line may be given by a point that is far from where it is left: its digits are not the path's.
#[test]
fn far_points_of_lines_cost_no_digits() {
    for (from, to) in [
        (["--from-line", "1e12,1e-9,-180deg"], ["--to-line", "-8.2,2,90deg"]),
        (["--from-line", "1e8,2,0"], ["--to-circle", "10,6,3.7,right"]),
        (["--from-circle", "10,6,3.7,right"], ["--to-line", "3,-1e12,90deg"]),
        (["--from-line", "-5,1e12,-0.5"], ["--to-circle", "0,0.3,2,right"]),
        (["--from-circle", "1e12,0.3,1e5,right"], ["--to-circle", "0,2,4,right"]),
    ] {
        for family in ["cubic", "ph-quintic"] {
            let said = with_limit(&[&from[..], &to, &["--family", family]].concat());
            let read = piped(&["path", "measure", "-"], &said.out);
            assert_eq!((said.code, read.code), (Some(0), Some(0)), "{from:?} {to:?}: {} {}", said.err, read.err);
        }
    }
    let near = with_limit(&["--from-line", "0,0,0", "--to-line", "-8,2,90deg"]).json();
    let far = with_limit(&["--from-line=-1e12,0,0", "--to-line", "-8,-1e12,90deg"]).json();
    let length = |json: &Value| json["paths"][0]["length"].as_f64().unwrap();
    assert!((length(&near) / length(&far) - 1.0).abs() < 1e-3, "{} {}", length(&near), length(&far));
}

/// From a state to itself there is nothing to join, and the option for JSON is no mistake where all is JSON.
#[test]
fn equal_states_and_needless_options() {
    let same = with_limit(&["--from", "1,2,30deg,0.1", "--to", "1,2,30deg,0.1", "--json"]);
    assert_eq!(same.code, Some(1));
    assert_eq!(same.json()["reason"], "the two states are one: there is nothing to join");
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/ramp.toml");
    assert_eq!(fine(["join", example, "--json"]).out, fine(["join", example]).out);
}

/// What is joined is drawn, too, in grey: lines and circles, but no states.
#[test]
fn lines_and_circles_are_in_the_picture() {
    let folder = Folder::new("");
    let grey = |ends: &[&str]| {
        let figure = folder.text("join.svg");
        let said = with_limit(&[ends, &["--figure", &figure]].concat());
        assert_eq!(said.code, Some(0), "{}", said.err);
        std::fs::read_to_string(figure).unwrap().matches("stroke=\"#6e6e6e\"").count()
    };
    assert_eq!(grey(&["--from-line=-3,0,0", "--to-circle", "0,4.2,4,left"]), 2);
    assert_eq!(grey(&["--from=-3,0,0", "--to", "3,2,0.5,0.25"]), 0);
}
