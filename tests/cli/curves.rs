//! The command `curve`.

use super::{Folder, fine, run};

fn curve(from: &str, to: &str, directions: [&str; 2], curvatures: [&str; 2], more: &[&str]) -> super::Said {
    let all = [
        "curve",
        "cubic",
        "--from",
        from,
        "--to",
        to,
        "--start-direction",
        directions[0],
        "--end-direction",
        directions[1],
    ];
    let rest = ["--start-curvature", curvatures[0], "--end-curvature", curvatures[1]];
    run(all.iter().chain(&rest).chain(more))
}

#[test]
fn curves_join_real_ends() {
    let folder = Folder::new("");
    let figure = folder.text("curve.png");
    let json = curve("-1,0", "1,0", ["-0.7", "1.4"], ["0.4", "4"], &["--json", "--figure", &figure]).json();
    assert_eq!(json["datum"]["phi0"], 0.7);
    let points = json["solutions"][0]["control_points"].as_array().unwrap();
    assert_eq!(
        (points.len(), &points[0], &points[3]),
        (4, &serde_json::json!([-1.0, 0.0]), &serde_json::json!([1.0, 0.0]))
    );
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // The same curve ten times as large, mirrored, with vectors for directions.
    let large = curve("0,0", "20,0", ["0.764842187284,0.644217687237", "80.2140913183153deg"], ["-0.04", "-0.4"], &[]);
    assert!(large.out.contains("their sum must be below 0, and it is 120.321°"), "{}", large.out);
    let large = curve("0,0", "20,0", ["0.764842187284,0.644217687237", "-80.2140913183153deg"], ["-0.04", "-0.4"], &[]);
    assert!(large.out.contains("cubic spiral (f0, f1) = (1.6601") && large.out.contains("mirrored"), "{}", large.out);
}

#[test]
fn no_curve_is_an_answer_with_numbers() {
    let folder = Folder::new("");
    let said = curve("-1,0", "1,0", ["-0.7", "1.4"], ["0.4", "1.2"], &[]);
    assert!(said.code == Some(1) && said.out.contains("the end curvature 1.2 must be above 1.46691"), "{}", said.out);
    let json = curve("-1,0", "1,0", ["-0.7", "1.4"], ["-0.4", "4"], &["--json"]);
    assert_eq!(json.code, Some(1));
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!((&json["why"]["condition"], &json["paths"]), (&"inflection".into(), &serde_json::json!([])));
    assert!(
        json["reason"].as_str().unwrap().starts_with("no cubic spiral: the start curvature -0.4 is to the right"),
        "{json}"
    );
    assert_eq!(json["families"], serde_json::json!(["involute"]));
    let wavy = curve("-1,0", "1,0", ["-0.7", "1.4"], ["0.4", "2.2"], &["--figure", &folder.text("wavy.png")]);
    assert!(
        wavy.code == Some(1)
            && wavy.out.contains("is not monotone; ")
            && wavy.out.contains(" would give a spiral (root ("),
        "{}",
        wavy.out
    );
    assert!(folder.at("wavy.png").exists());
    let none = curve("-1,0", "1,0", ["-0.7", "1.4"], ["0.4", "-1"], &["--figure", &folder.text("none.png")]);
    assert!(none.code == Some(1) && none.err.contains("none.png was not drawn"), "{}", none.err);
    assert!(!folder.at("none.png").exists());
}

#[test]
fn angles_may_be_written_in_many_ways() {
    let ask = |start: &str, end: &str| {
        let json = curve("0,0", "200,0", [start, end], ["0.004", "0.04"], &["--json"]).json();
        let points = json["paths"][0]["pieces"][0]["control_points"].clone();
        points.as_array().unwrap().iter().flat_map(|p| [number(&p[0]), number(&p[1])]).collect::<Vec<f64>>()
    };
    let (plain, mut others) = (ask("-40deg", "80deg"), 0);
    let radians = [format!("{:?}", -40f64.to_radians()), format!("{:?}rad", 80f64.to_radians())];
    let starts = [
        "-40°",
        "-40 deg",
        " -40.0° ",
        "-4e1deg",
        "320deg",
        "-400°",
        "0.766044443118978,-0.642787609686539",
        &radians[0],
    ];
    let ends =
        ["80°", "80 deg", "+80°", "80 °", "440deg", "-280deg", "1.736481776669303,9.84807753012208", &radians[1]];
    for (start, end) in starts.into_iter().zip(ends) {
        // A turn more loses an ulp of itself, and vectors are given to 15 digits; 200 long.
        let off = ask(start, end).iter().zip(&plain).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 200.0 * 1e-13, "{start} {end}: {off}");
        others += usize::from(off > 0.0);
    }
    assert!(others > 0);
    assert_ne!(ask("-41deg", "80deg"), plain);
}

fn point(sample: &serde_json::Value) -> [f64; 2] {
    [number(&sample["x"]), number(&sample["y"])]
}

fn number(json: &serde_json::Value) -> f64 {
    json.as_f64().unwrap_or_else(|| panic!("{json} is no number"))
}

#[test]
fn involutes_join_any_ends_with_a_spiral() {
    let folder = Folder::new("");
    let figure = folder.text("involute.png");
    let ends = ["--from", "3,1", "--to", "7,4", "--start-direction", "0.2", "--end-direction", "2.4"];
    let curvatures =
        ["--start-curvature", "-0.1", "--end-curvature", "1.6", "--samples", "33", "--json", "--figure", &figure];
    let all = ["curve", "involute"].into_iter().chain(ends).chain(curvatures);
    let json = fine(all.clone()).json();
    let samples = json["samples"].as_array().unwrap();
    let (first, last) = (&samples[0], &samples[32]);
    assert_eq!([point(first), point(last)], [[3.0, 1.0], [7.0, 4.0]]);
    let near = |value: &serde_json::Value, wanted: f64| (number(value) - wanted).abs() <= 1e-12 * wanted.abs();
    assert!(
        near(&first["heading"], 0.2) && near(&last["heading"], 2.4) && near(&first["curvature"], -0.1),
        "{first} {last}"
    );
    assert!(near(&last["curvature"], 1.6) && near(&last["station"], number(&json["length"])));
    assert!(samples.windows(2).all(|w| number(&w[0]["curvature"]) < number(&w[1]["curvature"])));
    assert!(samples.windows(2).all(|w| number(&w[0]["station"]) < number(&w[1]["station"])));
    assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    // A turn more about an end makes another curve; equal curvatures make none.
    let turned = fine(all.clone().chain(["--turns", "0,1"])).json();
    assert!(
        number(&turned["length"]) > number(&json["length"]) && turned["turns"] == serde_json::json!([0, 1]),
        "{turned}"
    );
    let none = run(all
        .filter(|a| *a != "--json" && *a != "--figure" && *a != figure)
        .map(|a| if a == "1.6" { "-0.1" } else { a }));
    assert!(none.code == Some(1) && none.out.contains("the curvature is -0.1 at both ends"), "{}", none.out);
}

/// A curvature may be written as that of a radius. One that is a radius itself is asked about, in a no alone.
#[test]
fn curvatures_may_be_those_of_radii() {
    let yes = |curvatures: [&str; 2]| curve("0,0", "200,0", ["-40deg", "80deg"], curvatures, &["--json"]);
    assert_eq!(yes(["1/250", "1/25"]).json(), yes(["0.004", "0.04"]).json());
    let no = curve("0,0", "200,0", ["-40deg", "80deg"], ["250", "1/25"], &[]);
    let ask = "is the start curvature 250 a radius? A curvature is 1/radius: 1/250";
    assert!(no.code == Some(1) && no.out.contains(ask) && !no.out.contains("end curvature 0.04 a"), "{}", no.out);
    let reason = curve("0,0", "200,0", ["-40deg", "80deg"], ["250", "1/25"], &["--json"]).json()["reason"].to_string();
    assert!(reason.contains(ask), "{reason}");
    let join = ["join", "--from", "0,0,0deg,250", "--to", "80,50,1,1/60", "--greatest-curvature", "1/60"];
    let none = run(join);
    assert!(none.code == Some(1) && none.out.contains(ask), "{}{}", none.out, none.err);
    let wrong = curve("0,0", "200,0", ["-40deg", "80deg"], ["1/x", "1/25"], &[]);
    assert!(wrong.code == Some(2) && wrong.err.contains("1/250 for a radius of 250"), "{}", wrong.err);
}

/// The end that is said to be too near is near enough by as much as is said, and no less.
#[test]
fn ends_that_are_too_near_are_told_by_how_much() {
    for (family, angle) in [("reach-cubic", 0.8f64), ("reach-ph", 0.8), ("reach-ph", 2.2)] {
        for (base, direction) in [("line", 0.0), ("circle", angle)] {
            let asked = |end: [f64; 2]| {
                let (angle, to) = (angle.to_string(), format!("{},{}", end[0], end[1]));
                let all =
                    ["curve", family, "--base", base, "--from", "0,0", "--start-direction", "0", "--turn", "left"];
                run(all.iter().chain(&["--radius", "20", "--angle", &angle, "--to", &to]))
            };
            // In units of the radius: nearly under the flat end's tangent, seen from the round end.
            let end = if base == "line" { [-5.0, 8.0] } else { [20.0 * angle.sin() - 5.0, 1.0] };
            let said = asked(end);
            let which = if base == "line" { "start" } else { "end" };
            let words = format!("further ahead along the {which} direction, by more than ");
            let (_, more) = said.out.split_once(&words).unwrap_or_else(|| panic!("{family} {base}: {}", said.out));
            let more: f64 = more.trim_end().parse().unwrap_or_else(|_| panic!("{}", said.out));
            let moved = |t: f64| asked([end[0] + t * f64::cos(direction), end[1] + t * f64::sin(direction)]).out;
            assert!(!moved(1.0001 * more).contains("no segment"), "{family} {base}: {}", moved(1.0001 * more));
            assert!(moved(0.999 * more).contains("too near"), "{family} {base}: {}", moved(0.999 * more));
        }
    }
}

/// Turns that the curve does not have are a no, which names those that it has.
#[test]
fn turns_are_those_asked_for() {
    let turns = |angles: [&str; 2], curvatures: [&str; 2], more: &[&str]| {
        let [from, to] = [angles[0], angles[1]].map(str::to_owned);
        let ends = ["curve", "involute", "--from=-1,0", "--to=1,0", "--start-direction", &from, "--end-direction", &to];
        run(ends.iter().chain(&["--start-curvature", curvatures[0], "--end-curvature", curvatures[1]]).chain(more))
    };
    for (angles, curvatures, asked, reason, advised) in [
        (["-40deg", "80deg"], ["0.4", "4"], "1,0", "no spiral of any kind has 1 turn about its start and 0", "0,1"),
        (["83deg", "114deg"], ["0.65", "0.076"], "0,2", "of 2 in all, 2 must be about the start", "2,0"),
        (["114deg", "-8deg"], ["0.55", "-1.4"], "0,1", "no involute has 0 turns about its start and 1 turn", "1,0"),
    ] {
        let no = turns(angles, curvatures, &["--turns", asked]);
        assert!(no.code == Some(1) && no.out.contains(reason), "{asked}: {}", no.out);
        assert!(no.out.contains(&format!("ask for `--turns {advised}`")), "{asked}: {}", no.out);
        let json = turns(angles, curvatures, &["--turns", asked, "--json"]).json();
        assert!(json["paths"] == serde_json::json!([]) && json["reason"].is_string(), "{json}");
        let yes = turns(angles, curvatures, &["--turns", advised]);
        assert!(yes.code == Some(0) && yes.out.contains(", as asked\n"), "{advised}: {}", yes.out);
    }
    // What is advised where only a turn helps is had as advised.
    let no = turns(["83deg", "114deg"], ["0.65", "0.076"], &[]);
    assert!(no.code == Some(1) && no.out.contains("`curve involute --turns 1,0`"), "{}", no.out);
    // With a turn the circles of curvature still cross: the directions are no reason any more.
    let no = turns(["0", "0"], ["0.1", "0.5"], &["--turns", "0,1"]);
    assert!(no.code == Some(1) && no.out.contains("with 1 turn: the circles of curvature"), "{}", no.out);
}

#[test]
fn ph_quintics_join_straight_ends_too() {
    let folder = Folder::new("");
    let figure = folder.text("ph.png");
    let straight = |more: &[&str]| {
        let ends = ["curve", "ph-quintic", "--from", "0,0", "--to", "200,0", "--start-direction=-25deg"];
        let rest = ["--end-direction", "50deg", "--start-curvature", "0", "--end-curvature"];
        run(ends.into_iter().chain(rest).chain(more.iter().copied()))
    };
    let json = straight(&["0.012", "--json", "--figure", &figure]).json();
    let chosen = &json["solutions"][json["chosen"].as_u64().unwrap() as usize];
    assert_eq!(
        (&chosen["control_points"][0], &chosen["spiral"]),
        (&serde_json::json!([0.0, 0.0]), &true.into()),
        "{json}"
    );
    assert!(number(&chosen["length"]) > 200.0 && std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
    let none = straight(&["0.02"]);
    assert!(none.code == Some(1) && none.out.contains("no PH quintic spiral: "), "{}", none.out);
}

#[test]
fn segments_are_added_to_lines_and_arcs() {
    let folder = Folder::new("");
    let figure = folder.text("segment.png");
    let segment = |family: &str, base: &str, more: &[&str]| {
        let all = ["curve", family, "--base", base, "--from", "10,5", "--start-direction", "30deg", "--turn", "left"];
        run(all.into_iter().chain(["--radius", "20", "--angle", "45deg"]).chain(more.iter().copied()))
    };
    for (family, points) in [("reach-cubic", 4), ("reach-ph", 6)] {
        for base in ["line", "circle"] {
            let json = segment(family, base, &["--m", "0.8", "--q", "1.9", "--json", "--figure", &figure]).json();
            let by_shape = &json["segment"];
            let control = by_shape["control_points"].as_array().unwrap();
            assert_eq!((control.len(), &control[0]), (points, &serde_json::json!([10.0, 5.0])));
            assert!(std::fs::read(&figure).unwrap().starts_with(b"\x89PNG"));
            assert_eq!(by_shape["case"], if base == "line" { 1 } else { 2 });
            // The end point asked for gives the shape back.
            let end = control[points - 1].as_array().unwrap();
            let json = segment(family, base, &["--to", &format!("{},{}", end[0], end[1]), "--json"]).json();
            assert!(
                (number(&json["segment"]["m"]) - 0.8).abs() < 1e-12
                    && (number(&json["segment"]["q"]) - 1.9).abs() < 1e-12,
                "{json}"
            );
        }
        let near = segment(family, "line", &["--to", "30,30"]);
        assert!(
            near.code == Some(1) && near.out.contains(&format!("no segment of `{family}`: the end point")),
            "{}",
            near.out
        );
    }
}

#[test]
fn options_of_other_families_are_refused() {
    let refused = |args: &[&str], parts: &[&str]| {
        let said = run(args.iter().copied());
        assert_eq!((said.code, &said.out[..]), (Some(2), ""), "{args:?}");
        assert!(parts.iter().all(|part| said.err.contains(part)), "{}", said.err);
    };
    refused(&["curve", "cubic", "--from", "0,0"], &["not provided", "--to <X,Y>", "--end-curvature <NUMBER>"]);
    refused(&["curve", "reach-ph", "--to", "1,1"], &["not provided", "--radius <NUMBER>"]);
    refused(
        &["curve", "reach-ph", "--m", "1"],
        &["not provided", "--q <NUMBER>", "'spiral-atlas curve reach-ph --help'"],
    );
    let added = "--base line --from 0,0 --start-direction 0 --turn left --radius 1 --angle 1";
    let segment: Vec<&str> = ["curve", "reach-ph"].into_iter().chain(added.split(' ')).collect();
    refused(&segment, &["where it ends is needed: `--to X,Y`, or its shape `--m M --q Q`"]);
    let both: Vec<&str> = segment.iter().copied().chain("--to 1,1 --m 1 --q 1".split(' ')).collect();
    refused(&both, &["'--to <X,Y>' cannot be used with"]);
    let template = "--from 0,0 --start-direction 0 --turn left --radius 1 --angle 1 --m 1 --template";
    for (more, part) in [
        ("circle-in-circle", "--outer <NUMBER>"),
        ("line-circle --second 1,1,1,1,1,1", "`--second` is for"),
        ("circle-in-circle --outer 9 --second 1,1,1,1,1,1", "`--second` is for"),
        ("s --outer 9", "`--outer` for `circle-in-circle`"),
    ] {
        let words = template.split(' ').chain(more.split(' '));
        let all: Vec<&str> = ["curve", "trig-quintic"].into_iter().chain(words).collect();
        refused(&all, &[part, "Usage: spiral-atlas curve trig-quintic"]);
    }
    refused(&["curve", "cubic", "--points", "-", "--from", "0,0"], &["'--points <FILE>' cannot be used with '--from"]);
    refused(&["curve", "reach-ph", "--points", "-"], &["unexpected argument '--points'"]);
    refused(&["curve", "clothoid"], &["clothoid", "there are cubic, ph-quintic, involute"]);
    refused(&["curve", "cubic", "--turns", "1,0"], &["unexpected argument '--turns'"]);
    refused(
        &["query", "--family", "reach-ph", "--phi0", "1"],
        &["a datum of `reach-ph` needs `--theta --xi --eta`", "`--phi0`"],
    );
}

/// `query` gives a segment's length in radii, `curve` in the user's unit.
#[test]
fn lengths_of_added_segments_agree() {
    for (family, theta, xi, eta, base) in [
        ("reach-cubic", "45deg", 1.7, 0.4, "line"),
        ("reach-ph", "40deg", 1.5, 0.35, "line"),
        ("reach-ph", "40deg", 1.1, 0.6, "circle"),
    ] {
        let datum = ["--theta", theta, "--xi", &xi.to_string(), "--eta", &eta.to_string(), "--json"];
        let json = run(["query", "--family", family].iter().chain(&datum)).json();
        let case = if base == "line" { 1 } else { 2 };
        let segment = json["solutions"].as_array().unwrap().iter().find(|s| s["case"] == case).unwrap();
        let [m, q] = ["m", "q"].map(|name| segment[name].to_string());
        let shape = [
            "--base",
            base,
            "--from",
            "0,0",
            "--start-direction",
            "0",
            "--turn",
            "left",
            "--radius",
            "20",
            "--angle",
            theta,
        ];
        let rest = ["--m", &m, "--q", &q, "--json"];
        let curve: serde_json::Value =
            serde_json::from_str(&run(["curve", family].iter().chain(&shape).chain(&rest)).out).unwrap();
        let [a, b] = [&segment["length"], &curve["segment"]["length"]].map(|x| x.as_f64().unwrap());
        assert!((20.0 * a / b - 1.0).abs() < 1e-12, "{family}: {a} {b}");
    }
}

/// `curve --family NAME` and `curve` alone, which means `cubic`, are older spellings.
#[test]
fn an_older_spelling_means_the_same() {
    let folder = Folder::new("");
    let ends = "--from 0,0 --to 200,0 --start-direction=-40deg --end-direction 80deg --start-curvature 0.004";
    let rows = "x0,y0,direction0,curvature0,x1,y1,direction1,curvature1\n0,0,-40deg,0.004,200,0,80deg,0.04\n";
    std::fs::write(folder.at("ends.csv"), format!("{rows}0,0,-40deg,0.004,200,0,80deg\n")).unwrap();
    let table = format!("--points {}", folder.text("ends.csv"));
    for (end, code) in [(" --end-curvature 0.04", 0), (" --end-curvature 0.005 --json", 1), ("", 2)] {
        let ends = format!("{ends}{end}");
        for (older, new) in [
            (ends.clone(), format!("cubic {ends}")),
            (format!("{ends} --family involute"), format!("involute {ends}")),
            (format!("--family=ph-quintic {ends}"), format!("ph-quintic {ends}")),
        ] {
            let [older, new] = [older, new].map(|words| run(["curve"].into_iter().chain(words.split(' '))));
            assert_eq!((older.code, &older.out, &older.err), (new.code, &new.out, &new.err));
            assert_eq!(older.code, Some(code), "{}", older.err);
        }
    }
    let [older, new] =
        [table.clone(), format!("cubic {table}")].map(|words| run(["curve"].into_iter().chain(words.split(' '))));
    assert_eq!((older.code, &older.out), (Some(2), &new.out));
    assert!(older.out.lines().count() == 2 && older.out.contains("\"row\":2"), "{}", older.out);
}
