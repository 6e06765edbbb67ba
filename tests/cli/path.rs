//! `path`: JSON in, JSON and pictures out, mistakes by name.

use super::{Folder, Said, fine, program, run};
use serde_json::{Value, json};
use std::io::Write;
use std::process::Stdio;

const SWARM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/swarm.json");

const OBSTACLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/obstacles.json");

/// Runs a tool on standard input.
fn piped(args: &[&str], input: &str) -> Said {
    let mut child = program()
        .arg("path")
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // It may well end before it reads.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap().into()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Figures 3 and 4 of the paper: six vehicles, all pairs.
#[test]
fn a_swarm_arrives_together_and_keeps_its_distance() {
    let folder = Folder::new("");
    let (swarm, apart) = (folder.text("swarm.png"), folder.text("apart.png"));
    let paths = fine(["path", "equal-length", SWARM, "--figure", &swarm]);
    let found = paths.json();
    let all = found["paths"].as_array().unwrap();
    assert_eq!(all.len(), 6);
    assert!(
        all.iter()
            .all(|p| (number(&p["length"]) - 2.25).abs() < 1e-13 && p["candidates"].as_array().unwrap().len() == 4)
    );
    let separation = piped(&["separation", "-", "--minimum", "0.0225", "--figure", &apart], &paths.out).json();
    let pairs = separation["pairs"].as_array().unwrap();
    assert_eq!((pairs.len(), &separation["verdict"]), (15, &json!("kept")));
    let least = pairs.iter().map(|p| number(&p["closest"]["at_least"])).fold(f64::INFINITY, f64::min);
    let verdict = |minimum: f64| {
        let said = piped(&["separation", "-", "--minimum", &minimum.to_string()], &paths.out);
        (said.code, said.json()["verdict"].clone())
    };
    assert_eq!(
        (verdict(least - 1e-8), verdict(least + 1e-8)),
        ((Some(0), json!("kept")), (Some(1), json!("violated")))
    );
    for figure in [swarm, apart] {
        assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"), "{figure}");
    }
    // A later start of one vehicle is another question.
    let mut late = found.clone();
    late["paths"][0]["start_time"] = json!(0.4);
    late["paths"][0]["speed"] = json!(2.0);
    let late = piped(&["separation", "-", "--minimum", "0"], &late.to_string()).json();
    assert_ne!(late["pairs"][0]["closest"], pairs[0]["closest"]);
    assert_eq!(late["pairs"][14]["closest"]["at_most"], pairs[14]["closest"]["at_most"]);
}

#[test]
fn interpolants_and_splines() {
    let folder = Folder::new("");
    let figure = folder.text("path.png");
    let ends = r#"{"start": [0, 0], "end": [1, 0], "start_derivative": [1, 1], "end_derivative": [1, -1]}"#;
    let found = piped(&["hermite", "-", "--figure", &figure], ends).json();
    let path = &found["paths"][0];
    assert!((number(&path["absolute_rotation"]) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!((&path["pieces"][0]["control_points"][5], &path["best"]), (&json!([1.0, 0.0]), &json!(0)));
    std::fs::remove_file(&figure).unwrap();
    std::fs::write(folder.at("points.json"), r#"{"points": [[0, 0], [1, 1], [2, 0]], "closed": true}"#).unwrap();
    let found = fine(["path", "spline", &folder.text("points.json"), "--figure", &figure]).json();
    assert_eq!(found["paths"][0]["pieces"].as_array().unwrap().len(), 3);
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // Degrees and radians say the same.
    let swarm = |angle: &str| {
        let ends = format!(r#"{{"start": [0, 0], "end": [1, 0], "start_direction": {angle}, "end_direction": 0.3}}"#);
        piped(&["equal-length", "-", "--paper"], &format!(r#"{{"length": 1.2, "paths": [{ends}]}}"#)).out
    };
    assert!(!swarm("0.5").is_empty());
    assert_eq!(swarm("\"45deg\""), swarm(&45f64.to_radians().to_string()));
}

#[test]
fn a_planned_path_is_input_of_separation() {
    let folder = Folder::new("");
    let figure = folder.text("plan.png");
    let said = fine(["path", "plan", OBSTACLES, "--figure", &figure]);
    let found = said.json();
    let path = &found["paths"][0];
    assert!(number(&path["clearance"]["at_least"]) >= 0.2 && number(&path["curvature_at_most"]) <= 5.0);
    let (corners, pieces) = (path["corners"].as_array().unwrap(), path["pieces"].as_array().unwrap());
    assert!(corners.len() >= 4 && pieces.len() == 2 * corners.len() + 1);
    assert_eq!(pieces[number(&corners[1]["piece"]) as usize]["preimage"][1], json!([0.0, 0.0]));
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // A second vehicle in step with it, 0.5 beside; and one that starts later and so waits in its way.
    let mut beside = path.clone();
    for (span, end) in (0..pieces.len()).flat_map(|i| [(i, "start"), (i, "end")]) {
        let point = &mut beside["pieces"][span][end];
        *point = json!([number(&point[0]) + 0.3, number(&point[1]) + 0.4]);
    }
    let mut later = path.clone();
    later["start_time"] = json!(1.0);
    let verdict = |other: &Value, minimum: &str| {
        let both = json!({"paths": [path, other]}).to_string();
        piped(&["separation", "-", "--minimum", minimum], &both).json()["verdict"].clone()
    };
    assert_eq!((verdict(&beside, "0.499999"), verdict(&beside, "0.500001")), (json!("kept"), json!("violated")));
    assert_eq!(verdict(&later, "0.000001"), json!("violated"));
    // TOML says the same.
    let scene = "start = [0, 0]\ngoal = [3, 0]\nclearance = 0.1\ngreatest_curvature = 5\nobstacles = [[[1, -1], [2, \
                 -1], [2, 1], [1, 1]]]";
    std::fs::write(folder.at("scene.toml"), scene).unwrap();
    let json = concat!(
        r#"{"start": [0, 0], "goal": [3, 0], "clearance": 0.1, "greatest_curvature": 5, "#,
        r#""obstacles": [[[1, -1], [2, -1], [2, 1], [1, 1]]]}"#
    );
    let toml = fine(["path", "plan", &folder.text("scene.toml")]).out;
    assert!(!toml.is_empty() && toml == piped(&["plan", "-"], json).out);
    std::fs::write(folder.at("scene.toml"), "start = [0, 0").unwrap();
    let said = run(["path", "plan", &folder.text("scene.toml")]);
    assert!(said.code == Some(2) && said.err.contains("scene.toml") && said.err.contains("line 1"), "{}", said.err);
}

#[test]
fn what_is_measured_of_a_path_agrees_with_the_path() {
    let spline = piped(&["spline", "-"], r#"{"points": [[0, 0], [1, 1], [2, 0], [3, 1], [4, 0]]}"#).out;
    let folder = Folder::new("");
    let figure = folder.text("measured.png");
    let measured =
        piped(&["measure", "-", "--samples", "41", "--offset", "-0.25", "--figure", &figure], &spline).json();
    let path = &measured["paths"][0];
    let given: Value = serde_json::from_str(&spline).unwrap();
    assert_eq!(
        (&path["length"], &path["bending_energy"]),
        (&given["paths"][0]["length"], &given["paths"][0]["bending_energy"])
    );
    let list = |name: &str| path[name].as_array().unwrap().clone();
    let point = |at: &Value| [number(&at["x"]), number(&at["y"])];
    let samples = list("samples");
    assert_eq!(samples.len(), 41);
    assert_eq!((point(&samples[0]), point(&samples[40])), ([0.0, 0.0], [4.0, 0.0]));
    let step = number(&path["length"]) / 40.0;
    for w in samples.windows(2) {
        let ([p, q], turn) = ([point(&w[0]), point(&w[1])], number(&w[1]["heading"]) - number(&w[0]["heading"]));
        let chord = (q[0] - p[0]).hypot(q[1] - p[1]);
        assert!(
            (number(&w[1]["station"]) - number(&w[0]["station"]) - step).abs() < 1e-12
                && chord <= step
                && chord > 0.97 * step
        );
        // The mean of the curvatures is about the turn over the length.
        let mean = 0.5 * (number(&w[0]["curvature"]) + number(&w[1]["curvature"]));
        assert!((turn / step - mean).abs() < 0.2, "{turn} {step} {mean}");
    }
    // Up, down, up, down.
    let (extrema, inflections) = (list("curvature_extrema"), list("inflections"));
    assert!(extrema.len() == 3 && inflections.len() == 2, "{} {}", extrema.len(), inflections.len());
    assert!(inflections.iter().all(|at| number(&at["curvature"]).abs() < 1e-12));
    let most = extrema.iter().map(|at| number(&at["curvature"]).abs()).fold(0.0, f64::max);
    assert!((most / number(&given["paths"][0]["greatest_curvature"]) - 1.0).abs() < 1e-12);
    // The ends of the offset curve are 0.25 to the right.
    let offset = &path["offset"].as_array().unwrap()[0];
    let (first, weight) = (&offset["numerator"][0], number(&offset["weight"][0]));
    let direction = number(&samples[0]["heading"]);
    let apart =
        [number(&first[0]) / weight - 0.25 * direction.sin(), number(&first[1]) / weight + 0.25 * direction.cos()];
    assert!(apart[0].hypot(apart[1]) < 1e-14 && offset["numerator"].as_array().unwrap().len() == 10, "{apart:?}");
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // At a joint, where a closed path closes, and across straight lines between corners.
    let count = |spans: &str| {
        let path = piped(&["measure", "-"], spans).json()["paths"][0].clone();
        ["curvature_extrema", "inflections"].map(|name| path[name].as_array().unwrap().len())
    };
    let joint = piped(&["spline", "-"], r#"{"points": [[-2, 0], [-1, 1], [0, 0], [1, -1], [2, 0]]}"#).out;
    assert_eq!(count(&joint)[1], 1);
    let closed = piped(&["spline", "-"], r#"{"points": [[2, 0], [0, 1], [-2, 0], [0, -1]], "closed": true}"#).out;
    assert_eq!(count(&closed), [4, 0]);
    let bends = r#"{"start": [0, 0], "goal": [10, 0],
        "obstacles": [[[3, -5], [3.5, -5], [3.5, 1], [3, 1]], [[6, -1], [6.5, -1], [6.5, 5], [6, 5]]],
        "clearance": 0.2, "greatest_curvature": 3}"#;
    // Two corners to the right, two to the left; each has a peak, and between two alike the curvature falls to 0.
    assert_eq!(count(&piped(&["plan", "-"], bends).out), [6, 1]);
    let bare = piped(&["measure", "-"], &spline).json();
    assert!(bare["paths"][0]["samples"] == json!([]) && bare["paths"][0].get("offset").is_none());
}

/// Pieces of all kinds, as `curve` prints them.
const KINDS: &str = r#"{"paths": [
    {"pieces": [{"kind": "cubic", "control_points": [[0, 0], [1, 0], [2, 1], [1.5, 2]]}]},
    {"pieces": [{"kind": "ph-quintic", "start": [0, 0], "preimage": [[1, 0.1], [0.9, 0.5], [0.4, 1.0]]}]},
    {"pieces": [{"kind": "trig-quintic", "p": -0.5, "q": 0.75,
        "control_points": [[0, 0], [0.2, 0], [0.5, 0.1], [0.9, 0.2], [1.3, 0.6], [1.4, 1.1]]}]},
    {"pieces": [{"kind": "involute", "start": [0, 0], "end": [2, 0], "start_direction": -0.9, "end_direction": 1.2,
        "start_curvature": -0.3, "end_curvature": 3}]},
    {"pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0]},
        {"kind": "arc", "start": [1, 0], "direction": 0, "curvature": 1, "length": 1}]}]}"#;

#[test]
fn every_kind_of_piece_is_measured() {
    let folder = Folder::new("");
    let figure = folder.text("kinds.png");
    let said = piped(&["measure", "-", "--samples", "3", "--offset", "0.1", "--figure", &figure], KINDS);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let (measured, given) = (said.json(), serde_json::from_str::<Value>(KINDS).unwrap());
    let counts = |name: &str| {
        let of = |path: &Value| path[name].as_array().unwrap().len();
        measured["paths"].as_array().unwrap().iter().map(of).collect::<Vec<_>>()
    };
    assert_eq!((counts("curvature_extrema"), counts("inflections")), (vec![2, 1, 2, 0, 0], vec![0, 0, 0, 1, 0]));
    assert_eq!((counts("samples"), counts("offset")), (vec![3; 5], vec![1, 1, 1, 1, 2]));
    for (path, given) in measured["paths"].as_array().unwrap().iter().zip(given["paths"].as_array().unwrap()) {
        let known = path.get("bending_energy").is_some() && path.get("absolute_rotation").is_some();
        let kind = given["pieces"][0]["kind"].as_str().unwrap();
        assert_eq!(known, ["ph-quintic", "line"].contains(&kind), "{kind}");
        assert_eq!(path["offset"][0].get("points").is_none(), kind == "ph-quintic", "{kind}");
    }
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // The same samples as CSV.
    let csv = piped(&["measure", "-", "--samples", "3", "--csv"], KINDS).out;
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!((lines[0], lines.len()), ("path,station,x,y,heading,curvature", 16));
    let sample = &measured["paths"][2]["samples"][1];
    let cells = ["station", "x", "y", "heading", "curvature"].map(|name| sample[name].to_string()).join(",");
    assert_eq!(lines[8], format!("2,{cells}"));
    // A path that stands still at its start has no heading there.
    let still =
        r#"{"paths": [{"pieces": [{"kind": "ph-quintic", "start": [0, 0], "preimage": [[0, 0], [1, 1], [2, 0]]}]}]}"#;
    let sample = piped(&["measure", "-", "--samples", "2"], still).json()["paths"][0]["samples"][0].clone();
    assert_eq!(sample, json!({"station": 0.0, "x": 0.0, "y": 0.0, "heading": null, "curvature": null}));
    assert!(piped(&["measure", "-", "--samples", "2", "--csv"], still).out.contains("\n0,0.0,0.0,0.0,,\n"));
    // Separation has proofs for all kinds but one.
    let said = piped(&["separation", "-", "--minimum", "0.1"], KINDS);
    let parts = ["paths[3]: pieces[0] is of the kind `involute`", "takes all other kinds", "path spline"];
    assert!(said.code == Some(2) && parts.iter().all(|part| said.err.contains(part)), "{}", said.err);
    let mut others = given.clone();
    others["paths"].as_array_mut().unwrap().remove(3);
    let said = piped(&["separation", "-", "--minimum", "0.1"], &others.to_string());
    assert!(said.code == Some(1) && said.json()["pairs"].as_array().unwrap().len() == 6, "{}", said.out);
    let lines = r#"{"paths": [{"pieces": [{"kind": "line", "start": [0, 0], "end": [3, 4]}]},
        {"pieces": [{"kind": "line", "start": [0, 1], "end": [3, 5]}]}]}"#;
    let said = piped(&["separation", "-", "--minimum", "0.999"], lines);
    assert!(
        said.code == Some(0) && number(&said.json()["pairs"][0]["closest"]["at_most"]) < 1.0 + 1e-9,
        "{}",
        said.out
    );
}

#[test]
fn where_there_is_no_path_the_answer_is_no() {
    let wall = "[[1, -9], [2, -9], [2, 9], [1, 9]], [[-9, 8], [9, 8], [9, 9], [-9, 9]], \
                [[-9, -9], [9, -9], [9, -8], [-9, -8]], [[8, -9], [9, -9], [9, 9], [8, 9]]";
    let scene = |curvature: f64| {
        format!(
            r#"{{"start": [0, 0], "goal": [3, 0], "clearance": 0.1, "greatest_curvature": {curvature},
                "obstacles": [{wall}]}}"#
        )
    };
    let said = piped(&["plan", "-"], &scene(5.0));
    assert_eq!((said.code, &said.err[..], &said.json()["paths"]), (Some(1), "", &json!([])));
    assert!(said.json()["reason"].as_str().unwrap().starts_with("every way is blocked"), "{}", said.out);
    assert_eq!(piped(&["plan", "-"], &scene(-1.0)).code, Some(2));
}

/// Some of the curves run along a line and stand still on it.
#[test]
fn a_curve_that_stands_still_has_no_greatest_curvature() {
    let ends = r#"{"start": [0, 0], "end": [1, 0], "start_derivative": [6, 0], "end_derivative": [6, 0]}"#;
    let found = piped(&["hermite", "-"], ends).json();
    let path = &found["paths"][0];
    let told = |c: &Value| (c["regular"].clone(), c["greatest_curvature"].is_number());
    let told: Vec<_> = path["candidates"].as_array().unwrap().iter().map(told).collect();
    let [still, moving] = [(json!(false), false), (json!(true), true)];
    assert_eq!(told, [still.clone(), still, moving.clone(), moving]);
    assert!(path["best"] == json!(2) && path["greatest_curvature"] == path["candidates"][2]["greatest_curvature"]);
    let query =
        ["query", "--family", "ph-hermite", "--theta0", "0", "--theta1", "0", "--l0", "6", "--l1", "6", "--json"];
    let answer = fine(query).json();
    let told = |s: &Value| (s["regular"].clone(), s.get("kappa_max").is_some());
    let told: Vec<_> = answer["solutions"].as_array().unwrap().iter().map(told).collect();
    assert_eq!(told, [(json!(false), false), (json!(false), false), (json!(true), true), (json!(true), true)]);
}

pub(crate) fn run_or_pipe(args: &[&str], input: &str) -> Said {
    if input.is_empty() { run(["path"].iter().chain(args)) } else { piped(args, input) }
}

#[test]
fn least_curvature() {
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/least-curvature.json");
    let found = fine(["path", "least-curvature", example]).json();
    let path = &found["paths"][0];
    let (most, least) = (number(&path["greatest_curvature"]), number(&found["at_least"]));
    assert!(least <= most && least > 0.0 && most < 4.2440 && number(&path["length"]) <= 1.6 + 1e-9, "{found}");
    let says = |input: &str, parts: &[&str]| {
        let said = piped(&["least-curvature", "-"], input);
        assert!(said.code != Some(0) && parts.iter().all(|p| said.err.contains(p)), "{}", said.err);
    };
    says(
        r#"{"start": [0, 0], "end": [1, 0], "start_direction": 1, "end_direction": 1, "free": "width"}"#,
        &["width", "derivatives"],
    );
    for end in ["[1e308, 0]", "[5e-324, 0]", "[0, 1.1e150]", "[0, 0.9e-150]"] {
        let ends = format!(r#""end": {end}, "start_direction": 1, "end_direction": 1, "free": "length""#);
        says(&format!(r#"{{"start": [0, 0], {ends}}}"#), &["`start` [0.0, 0.0] and `end` [", "unit of length"]);
        says(&format!(r#"{{"start": [-1e308, 0], {ends}}}"#), &["`start` [-1e308, 0.0] and `end` [", "unit of length"]);
    }
    for end in ["0.9e150", "1.1e-150"] {
        let ends = r#""start_direction": 1, "end_direction": 1, "free": "length""#;
        let found =
            piped(&["least-curvature", "-"], &format!(r#"{{"start": [0, 0], "end": [{end}, 0], {ends}}}"#)).json();
        assert!(number(&found["at_least"]) > 0.0 && number(&found["paths"][0]["greatest_curvature"]) > 0.0, "{found}");
    }
    says(
        r#"{"start": [2, 1], "end": [2, 1], "start_direction": 1, "end_direction": 1, "free": "length"}"#,
        &["`start` and `end`", "apart"],
    );
}
