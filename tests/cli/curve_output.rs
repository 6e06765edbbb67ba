//! What every family of `curve` gives alike: samples, lengths, batches, and paths that `path measure` reads.

use super::{Said, program, run};
use serde_json::{Value, json};
use std::io::Write;
use std::process::Stdio;

/// A question with a spiral, for every family.
const ASKED: [(&str, &[&str]); 6] = [
    ("cubic", &ENDS),
    ("ph-quintic", &ENDS),
    ("involute", &ENDS),
    ("reach-cubic", &SEGMENT),
    ("reach-ph", &SEGMENT),
    (
        "trig-quintic",
        &[
            "--template",
            "s",
            "--from",
            "10,5",
            "--start-direction",
            "40°",
            "--turn",
            "left",
            "--radius",
            "20",
            "--angle",
            "42deg",
            "--m",
            "1",
        ],
    ),
];
const ENDS: [&str; 12] = [
    "--from",
    "5,-3",
    "--to",
    "205,-3",
    "--start-direction",
    "-40°",
    "--end-direction",
    "80deg",
    "--start-curvature",
    "0.004",
    "--end-curvature",
    "0.04",
];
const SEGMENT: [&str; 16] = [
    "--base",
    "line",
    "--from",
    "10,5",
    "--start-direction",
    "30deg",
    "--turn",
    "left",
    "--radius",
    "20",
    "--angle",
    "45deg",
    "--m",
    "0.8",
    "--q",
    "1.9",
];

fn curve(family: &str, asked: &[&str], more: &[&str]) -> Said {
    run(["curve", family].iter().chain(asked).chain(more))
}

/// What a command says to an input.
pub(super) fn piped(args: &[&str], input: &str) -> Said {
    let mut child =
        program().args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap().into()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn samples_lie_at_equal_lengths() {
    for (family, asked) in ASKED {
        let json = curve(family, asked, &["--samples", "1001", "--json"]).json();
        let samples: Vec<[f64; 5]> = json["samples"].as_array().unwrap().iter().map(row).collect();
        let length = number(&json["paths"][0]["length"]);
        assert!(samples.len() == 1001 && samples[0][0] == 0.0 && samples[1000][0] == length, "{family}");
        let pieces = json["paths"][0]["pieces"].as_array().unwrap();
        let least =
            samples.windows(2).map(|w| (w[1][1] - w[0][1]).hypot(w[1][2] - w[0][2])).fold(f64::INFINITY, f64::min);
        // A chord is shorter than its arc by (curvature arc)²/24 of it, here 0.05 * 0.4 at most, and the heading turns
        // by curvature arc.
        let step = length / 1000.0;
        assert!(step >= least && least > step * (1.0 - 1e-4), "{family}: {least} {step}");
        for w in samples.windows(2) {
            let turned = (w[1][3] - w[0][3]).sin();
            assert!((turned - 0.5 * (w[0][4] + w[1][4]) * step).abs() < 1e-3, "{family}: {w:?}");
        }
        if asked == ENDS {
            let ([_, x, y, heading, curvature], last) = (samples[0], samples[1000]);
            assert_eq!(([x, y], [last[1], last[2]]), ([5.0, -3.0], [205.0, -3.0]), "{family}");
            let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
            assert!(
                near(heading, -40f64.to_radians()) && near(last[3], 80f64.to_radians()),
                "{family}: {heading} {last:?}"
            );
            assert!(near(curvature, 0.004) && near(last[4], 0.04), "{family}: {curvature} {last:?}");
        }
        assert_eq!(pieces.len(), if family == "trig-quintic" { 2 } else { 1 });

        let csv = curve(family, asked, &["--samples", "1001", "--csv"]).out;
        let mut lines = csv.lines();
        assert_eq!(lines.next(), Some("station,x,y,heading,curvature"));
        let cells = |line: &str| -> Vec<f64> { line.split(',').map(|cell| cell.trim().parse().unwrap()).collect() };
        assert!(lines.map(cells).eq(samples.iter().map(|s| s.to_vec())), "{family}");
        let text = curve(family, asked, &["--samples", "3"]).out;
        let (_, table) = text.split_once("station, x, y, heading, curvature\n").unwrap();
        assert!(table.lines().count() == 3 && cells(table.lines().nth(2).unwrap()) == samples[1000], "{text}");
    }
}

fn row(sample: &Value) -> [f64; 5] {
    ["station", "x", "y", "heading", "curvature"].map(|name| number(&sample[name]))
}

#[test]
fn a_curve_that_is_too_long_is_none() {
    for (family, asked) in ASKED {
        let length = number(&curve(family, asked, &["--json"]).json()["paths"][0]["length"]);
        let (more, less) = (format!("{:?}", 1.0001 * length), format!("{:?}", 0.9999 * length));
        assert_eq!(curve(family, asked, &["--longest", &more]).code, Some(0), "{family}");
        let said = curve(family, asked, &["--longest", &less, "--json"]);
        let json: Value = serde_json::from_str(&said.out).unwrap();
        let reason = json["reason"].as_str().unwrap();
        assert!(
            said.code == Some(1)
                && json["paths"] == json!([])
                && reason.contains(&format!(" long, more than the {less}")),
            "{reason}"
        );
        let said = curve(family, asked, &["--longest", &less]);
        assert!(said.code == Some(1) && said.out.contains(&less), "{}", said.out);
    }
    let said = curve("cubic", &ENDS, &["--longest", "-3"]);
    assert!(said.code == Some(2) && said.err.contains("no finite length above 0"), "{}", said.err);
}

#[test]
fn what_curve_prints_path_measure_reads() {
    for (family, asked) in ASKED {
        let printed = curve(family, asked, &["--json"]);
        let (path, said) = (&printed.json()["paths"][0], piped(&["path", "measure", "-"], &printed.out));
        assert_eq!(said.code, Some(0), "{family}: {}", said.err);
        let measured = &said.json()["paths"][0];
        for name in ["length", "greatest_curvature"] {
            let (a, b) = (number(&path[name]), number(&measured[name]));
            assert!((a / b - 1.0).abs() < 1e-11, "{family}: {name} {a} {b}");
        }
    }
}

#[test]
fn a_no_names_the_families_that_would_do() {
    // A straight start: outside the family `cubic`.
    let straight = ENDS.map(|arg| if arg == "0.004" { "0" } else { arg });
    let said = curve("cubic", &straight, &[]);
    assert!(said.code == Some(1) && said.out.contains("the start curvature is 0"), "{}", said.out);
    assert!(said.out.contains("kind of curve would do: ") && said.out.contains("`curve involute`"), "{}", said.out);
    let json: Value = serde_json::from_str(&curve("cubic", &straight, &["--json"]).out).unwrap();
    for family in json["families"].as_array().unwrap() {
        assert_eq!(curve(family.as_str().unwrap(), &straight, &[]).code, Some(0), "{family}");
    }
    assert!(json["reason"].as_str().unwrap().starts_with("no cubic spiral: the start curvature is 0"), "{json}");
}

/// Ends that a segment of `reach-cubic` and one of `reach-ph` join, and one that neither does: from a line to a circle,
/// and back.
#[test]
fn a_straight_end_is_advised_the_segments_that_join_it() {
    let ask = |ends: [&str; 6], more: &[&str]| {
        let names = ["--from", "--to", "--start-direction", "--end-direction", "--start-curvature", "--end-curvature"];
        run(["curve", "cubic"]
            .into_iter()
            .chain(names.into_iter().zip(ends).flat_map(|(a, b)| [a, b]))
            .chain(more.iter().copied()))
    };
    let cases = [
        (["10,5", "35.4,28.9", "30°", "75°", "0", "0.05"], &["reach-cubic", "reach-ph"][..]),
        (["35.4,28.9", "10,5", "255°", "210°", "-0.05", "0"], &["reach-cubic", "reach-ph"]),
        (["0,0", "200,0", "-25°", "50°", "0", "0.012"], &["reach-ph"]),
        (["0,0", "200,0", "-40°", "80°", "0", "0.04"], &[]),
    ];
    for (ends, families) in cases {
        let said = ask(ends, &[]);
        let json: Value = serde_json::from_str(&ask(ends, &["--json"]).out).unwrap();
        let commands: Vec<&str> =
            json["segments"].as_array().into_iter().flatten().map(|c| c.as_str().unwrap()).collect();
        assert!(said.code == Some(1) && commands.len() == families.len(), "{}", said.out);
        for (command, family) in commands.iter().zip(families) {
            assert!(said.out.contains(&format!("`{command}`")), "{}", said.out);
            let words: Vec<&str> = command.split(' ').collect();
            assert_eq!(words[..3], ["spiral-atlas", "curve", family]);
            let found = run(words[1..].iter().chain(&["--json", "--samples", "2"])).json();
            // It has the ends that were asked for: points exactly, the rest within the roundings of a chord's
            // direction.
            let [first, last] = [0, 1].map(|i| row(&found["samples"][i]));
            let degrees = |text: &str| text.trim_end_matches('°').parse::<f64>().unwrap().to_radians();
            for (at, point, heading, curvature) in
                [(first, ends[0], ends[2], ends[4]), (last, ends[1], ends[3], ends[5])]
            {
                assert_eq!(format!("{},{}", at[1], at[2]), point);
                assert!((at[3] - degrees(heading)).sin().abs() < 1e-13, "{at:?} {heading}");
                assert!((at[4] - curvature.parse::<f64>().unwrap()).abs() < 1e-13, "{at:?} {curvature}");
            }
        }
    }
    let short = ask(cases[0].0, &["--longest", "30"]);
    assert!(short.code == Some(1) && !short.out.contains("reach-"), "{}", short.out);
}

#[test]
fn batches_have_a_line_for_each_row() {
    let rows = "curvature1,direction0,x0,y0,x1,y1,curvature0,direction1\n\
                0.04,-40°,5,-3,205,-3,0.004,80deg\n\
                0.005,-40°,5,-3,205,-3,0.004,80deg\n";
    for family in ["cubic", "ph-quintic", "involute"] {
        let args = ["curve", family, "--points", "-"];
        let said = piped(&args, rows);
        let lines: Vec<Value> = said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert!(said.code == Some(0) && lines.len() == 2, "{family}: {} {}", said.out, said.err);
        assert_eq!(lines[0], curve(family, &ENDS, &["--json"]).json());
        assert!(
            lines[1]["paths"] == json!([]) && lines[1]["reason"].as_str().unwrap().contains("must be above"),
            "{}",
            lines[1]
        );
        assert_eq!(lines[1].get("families"), None);
        let bad =
            piped(&args, &format!("{rows}0.04,-40°,5,x,205,-3,0.004,80deg\n1,2\n0.04,-40°,5,-3,205,-3,0.004,80deg\n"));
        let lines: Vec<Value> = bad.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert!(bad.code == Some(2) && lines.len() == 5, "{}", bad.out);
        assert_eq!((&lines[2]["row"], &lines[2]["error"]), (&json!(3), &json!("y0: \"x\" is no number")));
        assert!(lines[3]["error"].is_string() && lines[4] == lines[0], "{}", lines[3]);
    }
    // Lines of both answers are read where paths are read, and samples come as one table.
    let lines = piped(&["curve", "cubic", "--points", "-"], rows).out;
    let measured = piped(&["path", "measure", "-", "--samples", "2", "--csv"], &lines);
    assert_eq!(measured.out.lines().map(|line| &line[..2]).collect::<Vec<_>>(), ["pa", "0,", "0,"], "{}", measured.err);
    assert_eq!(measured.err, "line 2 of standard input has no path; the reason stands there\n");
    assert_eq!(piped(&["export", "opendrive", "-"], &lines).out.matches("<road ").count(), 1);
    let table = piped(
        &["curve", "cubic", "--points", "-", "--samples", "3", "--csv"],
        &format!("{rows}\n{}", rows.split_once('\n').unwrap().1),
    );
    let alone = curve("cubic", &ENDS, &["--samples", "3", "--csv"]).out;
    let rows_of = |row: &str| alone.lines().skip(1).map(|line| format!("{row},{line}\n")).collect::<String>();
    assert_eq!(table.out, format!("row,station,x,y,heading,curvature\n{}{}", rows_of("1"), rows_of("3")));
    assert!(
        table.code == Some(0) && table.err.starts_with("row 2: ") && table.err.contains("row 4: "),
        "{}",
        table.err
    );
    let header = piped(&["curve", "cubic", "--points", "-"], "x0,y0\n");
    assert!(header.code == Some(2) && header.err.contains("curvature1"), "{}", header.err);
}

/// The answer that there is no curve is read as that, and no error.
#[test]
fn a_no_is_a_no_for_what_reads_paths() {
    let no = curve("cubic", &ENDS.map(|arg| if arg == "0.04" { "0.005" } else { arg }), &["--json"]);
    let join = run(["join", "--from", "0,0,0,1", "--to", "9,0,0", "--greatest-curvature", "0.5"]);
    let row = run(["join", "--from", "0,0,0,1", "--to", "9,0,0", "--greatest-curvature", "0.5"]).json();
    let rows =
        format!("{}\n{}\n", json!({ "pieces": null, "reason": row["reason"] }), json!({ "row": 3, "error": "bad" }));
    for (input, what) in [
        (&no.out, "standard input has no path: no spiral of any kind joins these ends"),
        (&join.out, "standard input has no path: the start curvature 1.0 is beyond"),
        (&rows, "lines 1, 2 of standard input have no path; the reason stands there"),
    ] {
        let tools: [&[&str]; 3] =
            [&["path", "measure", "-"], &["export", "opendrive", "-"], &["path", "separation", "-", "--minimum", "1"]];
        for tool in tools {
            let said = piped(tool, input);
            assert!(said.code == Some(1) && said.out.is_empty() && said.err.contains(what), "{tool:?}: {}", said.err);
        }
    }
    assert_eq!(piped(&["path", "measure", "-"], "{\"paths\": []}").code, Some(0));
}

/// An end that is straight by the question has the curvature 0, where its doubles show -1.3e-18.
#[test]
fn straight_ends_have_no_curvature() {
    let mut rounded = 0;
    for (family, base, turn) in ["reach-cubic", "reach-ph"].into_iter().flat_map(|family| {
        ["line", "circle"].into_iter().flat_map(move |base| ["left", "right"].map(|turn| (family, base, turn)))
    }) {
        for direction in ["30deg", "-77deg", "1.234567", "200deg"] {
            let asked = SEGMENT.map(|arg| match arg {
                "line" => base,
                "left" => turn,
                "30deg" => direction,
                other => other,
            });
            let found = curve(family, &asked, &["--samples", "3", "--json"]).json();
            let [straight, round] =
                if base == "line" { [0, 2] } else { [2, 0] }.map(|i: usize| row(&found["samples"][i])[4]);
            assert!(
                straight.to_bits() == 0 && (round.abs() - 0.05).abs() < 1e-12,
                "{family} {asked:?}: {straight} {round}"
            );
            // What the doubles of the path show there is a rounding of its first two sides, a and b: b 2^-51 / a².
            let read = piped(&["path", "measure", "-", "--samples", "3"], &found.to_string()).json();
            let shown = row(&read["paths"][0]["samples"][if base == "line" { 0 } else { 2 }])[4];
            let mut sides: Vec<f64> = found["segment"]["legs"].as_array().unwrap().iter().map(side).collect();
            if base == "circle" {
                sides.reverse();
            }
            assert!(shown.abs() <= sides[1] * 0.5f64.powi(51) / (sides[0] * sides[0]), "{shown} {sides:?}");
            rounded += usize::from(shown != 0.0);
        }
    }
    assert!(rounded > 5, "{rounded}");
    let line = curve("trig-quintic", ASKED[5].1, &["--samples", "3", "--json"]).json();
    assert!((row(&line["samples"][0])[4].abs() - 0.05).abs() < 1e-12, "the circles of an S are round");
    let lines = ASKED[5].1.iter().map(|arg| if *arg == "s" { "line-line" } else { arg }).collect::<Vec<_>>();
    let line = curve("trig-quintic", &lines, &["--samples", "3", "--json"]).json();
    assert_eq!([0, 2].map(|i: usize| row(&line["samples"][i])[4]), [0.0, 0.0]);
}

/// The length of a side.
fn side(side: &Value) -> f64 {
    number(&side[0]).hypot(number(&side[1]))
}

/// Words end with a line's end, not with an empty line.
#[test]
fn no_empty_line_ends_an_answer() {
    for (family, asked) in ASKED {
        for more in [&[][..], &["--longest", "1"]] {
            let said = curve(family, asked, more).out;
            assert!(said.ends_with('\n') && !said.ends_with("\n\n"), "{family}: {said:?}");
        }
    }
}

/// A shape of any size is judged in a few halvings; there were seconds.
#[test]
fn extreme_shapes_have_an_answer() {
    for m in ["1e160", "1e300", "1e-160"] {
        let asked = ASKED[5].1.iter().map(|arg| if *arg == "1" { m } else { arg }).collect::<Vec<_>>();
        let said = curve("trig-quintic", &asked, &[]);
        let told = said.code == Some(1) && said.out.contains("not a spiral");
        assert!(
            told || said.code == Some(2) && said.err.contains("range of doubles"),
            "{m}: {} {}",
            said.out,
            said.err
        );
    }
}

#[test]
fn the_pages_reason_is_what_is_said() {
    let page = include_str!("../../docs/cubic.md").replace('\n', " ");
    let ends = ["--start-direction=-40deg", "--end-direction=80deg", "--start-curvature=0.03", "--end-curvature=0.04"];
    let said = run(["curve", "cubic", "--from", "0,0", "--to", "200,0"].iter().chain(&ends));
    let reason = "the start curvature 0.03 must be below 0.00603991 (or, turning left, a radius of at least 165.566)";
    assert!(page.contains(reason) && said.out.contains(reason), "{}", said.out);
}
