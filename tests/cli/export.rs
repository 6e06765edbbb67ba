//! Paths as files of other programs. What stands in the files is judged by `tests/opendrive` and `tests/join`.

use super::{Folder, fine, run};

const ROAD: &str = r#"{"paths": [{"pieces": [
    {"kind": "line", "start": [0, 0], "end": [30, 0]},
    {"kind": "arc", "start": [30, 0], "direction": 0, "curvature": 0.02, "length": 40}
]}]}"#;

#[test]
fn a_road_goes_to_a_file_or_to_standard_output() {
    let folder = Folder::new("");
    std::fs::write(folder.at("road.json"), ROAD).unwrap();
    let (input, out) = (folder.text("road.json"), folder.text("road.xodr"));
    let printed = fine(["export", "opendrive", &input]);
    assert!(
        printed.out.contains(r#"<arc curvature="0.02"/>"#) && printed.out.contains(r#"length="70.0""#),
        "{}",
        printed.out
    );
    assert!(printed.err.is_empty(), "{}", printed.err);
    let silent = fine(["export", "opendrive", &input, "--out", &out]);
    assert!(silent.out.is_empty() && std::fs::read_to_string(out).unwrap() == printed.out);
}

/// The extents hold all of the drawing, an arc's sides too; the file's name says what it is.
/// One rule for outputs: `-` is standard output where one file is written, and no input is written over.
#[test]
fn outputs_are_files_or_standard_output() {
    let folder = super::Folder::new("");
    let line = r#"{"paths": [{"pieces": [{"kind": "line", "start": [0, 0], "end": [9, 0]}]}]}"#;
    for name in ["path.json", "path.dxf"] {
        std::fs::write(folder.at(name), line).unwrap();
    }
    let (json, dxf) = (folder.text("path.json"), folder.text("path.dxf"));
    assert!(super::fine(["export", "opendrive", &json, "--out", "-"]).out.starts_with("<?xml"));
    assert!(super::fine(["export", "dxf", &json, "--out", "-"]).out.contains("SECTION"));
    for (format, path) in [("opendrive", &json), ("dxf", &dxf)] {
        let said = super::run(["export", format, path, "--out", path]);
        assert!(said.code == Some(2) && said.err.contains("is the input; choose another name"), "{}", said.err);
        assert_eq!(std::fs::read_to_string(path).unwrap(), line);
    }
    std::fs::write(folder.at("recipe.toml"), super::TINY).unwrap();
    for command in ["generate", "render"] {
        let said = super::run([command, &folder.text("recipe.toml"), "--out", "-"]);
        assert!(said.code == Some(2) && said.err.contains("name a folder"), "{command}: {}", said.err);
    }
}

#[test]
fn a_drawing_tells_its_extents() {
    let folder = Folder::new("");
    std::fs::write(folder.at("road.json"), ROAD.replace("\"length\": 40", "\"length\": 100")).unwrap();
    let (input, out) = (folder.text("road.json"), folder.text("road.dxf"));
    fine(["export", "dxf", &input, "--out", &out]);
    let text = std::fs::read_to_string(out).unwrap();
    let corner = |name: &str| -> Vec<f64> {
        let lines: Vec<&str> = text.split(name).nth(1).unwrap().lines().map(str::trim).collect();
        [2, 4].map(|i| lines[i].parse().unwrap()).to_vec()
    };
    // A circle of radius 50 about (30, 50), left along its bottom; two radians are more than a quarter.
    let top = 50.0 * (1.0 - 2f64.cos());
    for (name, want) in [("$EXTMIN", [0.0, 0.0]), ("$EXTMAX", [80.0, top])] {
        let found = corner(name);
        assert!(found.iter().zip(want).all(|(x, y)| (x - y).abs() < 1e-9), "{name}: {found:?}");
    }
    let other = run(["export", "dxf", &input, "--out", &folder.text("road.svg")]);
    assert!(other.code == Some(2) && other.err.contains("end its name with .dxf"), "{}", other.err);
    assert!(!folder.at("road.svg").exists());
}

#[test]
fn clothoids_are_spirals_of_a_road_and_nothing_in_a_drawing() {
    let folder = Folder::new("");
    let options = ["join", "--from", "0,0,0", "--to", "80,60,90deg", "--greatest-curvature", "0.05"];
    let join = fine(options.iter().chain(&["--family", "clothoid", "--objective", "greatest-rate"]));
    std::fs::write(folder.at("join.json"), &join.out).unwrap();
    let (input, out) = (folder.text("join.json"), folder.text("join.dxf"));
    let road = fine(["export", "opendrive", &input]).out;
    let piece = &join.json()["paths"][0]["pieces"][0];
    assert_eq!((&piece["kind"], &piece["curvature"]), (&"clothoid".into(), &0.0.into()));
    let spiral = format!("<spiral curvStart=\"0.0\" curvEnd=\"{:?}\"/>", piece["end_curvature"].as_f64().unwrap());
    assert!(road.contains(&spiral), "{spiral}: {road}");
    let refused = run(["export", "dxf", &input, "--out", &out]);
    assert!(refused.code == Some(2) && refused.err.contains("of the kind `clothoid`"), "{}", refused.err);
    assert!(!folder.at("join.dxf").exists());
}

#[test]
fn what_no_road_can_be_is_refused_and_leaves_no_file() {
    let folder = Folder::new("");
    let (input, out) = (folder.text("road.json"), folder.text("road.xodr"));
    let options = ["--from", "0,0", "--to", "200,0", "--start-direction=-40deg", "--end-direction", "80deg"];
    let curvatures = ["--start-curvature", "0.004", "--end-curvature", "0.04", "--json"];
    let curve = |family: &str| fine(["curve", family].iter().chain(&options).chain(&curvatures)).out;
    let none = r#"{"paths": []}"#.to_owned();
    let still = r#"{"paths": [{"pieces": [{"kind": "cubic", "control_points": [[0, 0], [0, 0], [1, 1], [2, 0]]}]}]}"#
        .to_owned();
    let cases: [(String, &[&str], &[&str]); 6] = [
        (curve("involute"), &[], &["pieces[0]", "`involute`", "ph-quintic"]),
        (curve("ph-quintic"), &["--tolerance", "1e-300"], &["tolerance", "2000"]),
        (ROAD.into(), &["--lane-width", "NaN"], &["lane width", "NaN"]),
        (ROAD.into(), &["--tolerance", "0"], &["tolerance is 0;"]),
        (none, &[], &["no path"]),
        (still, &[], &["pieces[0]", "direction"]),
    ];
    for (text, more, words) in cases {
        std::fs::write(folder.at("road.json"), &text).unwrap();
        let said = run(["export", "opendrive", &input, "--out", &out].iter().chain(more));
        assert_eq!(said.code, Some(2), "{text} {more:?}");
        assert!(words.iter().all(|word| said.err.contains(word)), "{more:?}: {}", said.err);
        assert!(!folder.at("road.xodr").exists());
    }
}

#[test]
fn a_lattice_goes_to_a_file_or_to_standard_output() {
    let folder = Folder::new("");
    let (out, figure) = (folder.text("lattice.json"), folder.text("lattice.png"));
    let options = ["export", "lattice", "--turning-radius", "0.4", "--grid-resolution", "0.1"];
    let printed = fine(options);
    assert!(printed.err.is_empty(), "{}", printed.err);
    let told = printed.json();
    assert_eq!(told["lattice_metadata"]["num_of_headings"], 16);
    assert_eq!(told["lattice_metadata"]["number_of_trajectories"], told["primitives"].as_array().unwrap().len());
    let silent = fine(options.iter().chain(&["--out", &out, "--figure", &figure]));
    assert!(silent.out.is_empty() && std::fs::read_to_string(out).unwrap() == printed.out);
    assert!(std::fs::read(figure).unwrap().starts_with(b"\x89PNG"));
    let more = ["--headings", "24", "--distinctness", "0.5", "--family", "ph-quintic"];
    let other = fine(options.iter().chain(&more)).json();
    assert_eq!(other["lattice_metadata"]["heading_angles"].as_array().unwrap().len(), 24);
}

#[test]
fn what_no_lattice_can_be_is_refused_and_leaves_no_file() {
    let folder = Folder::new("");
    let out = folder.text("lattice.json");
    let cases: [(&str, &str, &[&str], &str); 11] = [
        ("0", "0.05", &[], "turning radius is 0.0"),
        ("NaN", "0.05", &[], "turning radius is NaN"),
        ("-0.5", "0.05", &[], "turning radius is -0.5"),
        ("half", "0.05", &[], "no number"),
        ("0.5", "inf", &[], "grid resolution is inf"),
        ("0.5", "0.6", &[], "larger than the turning radius"),
        ("0.5", "0.0001", &[], "coarser grid"),
        ("0.5", "0.05", &["--headings", "7"], "multiple of 8"),
        ("0.5", "0.05", &["--headings", "8"], "from 16"),
        ("0.5", "0.05", &["--distinctness", "-1"], "distinctness is -1.0"),
        ("0.5", "0.05", &["--figure", "lattice.pdf"], ".png"),
    ];
    for (radius, resolution, more, words) in cases {
        let options = ["export", "lattice", "--turning-radius", radius, "--grid-resolution", resolution, "--out", &out];
        let said = run(options.iter().chain(more));
        assert_eq!(said.code, Some(2), "{words}");
        assert!(said.err.contains(words), "{words}: {}", said.err);
        assert!(!folder.at("lattice.json").exists());
    }
}
