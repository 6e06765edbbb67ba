//! Commands that answer: query, adapters, completions, help.

use super::{Folder, TINY, fine, program, run};
use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

/// Section 4 of the paper: φ0, φ1, κ0, κ1, f0, f1.
const EXAMPLES: [[f64; 6]; 3] = [
    [0.7, 1.4, 0.4, 4.0, 1.66010274767, 0.76985066613],
    [0.1, 1.5, 0.035, 100.0, 2.60727801728, 0.62666697883],
    [0.8, 0.9, 0.6, 0.874, 1.69966006964, 1.49236264052],
];

fn query(data: [&str; 4], more: &[&str]) -> super::Said {
    let names = ["--phi0", "--phi1", "--kappa0", "--kappa1"];
    let pairs = names.into_iter().zip(data).flat_map(|(name, value)| [name, value]);
    let said = run(["query"].into_iter().chain(pairs).chain(more.iter().copied()));
    assert!(matches!(said.code, Some(0 | 1)) && said.err.is_empty(), "{}\n{}", said.out, said.err);
    said
}

/// Asks a family about a datum written as its options.
fn ask(family: &str, datum: &str, more: &[&str]) -> super::Said {
    run(["query", "--family", family].into_iter().chain(datum.split_whitespace()).chain(more.iter().copied()))
}

#[test]
fn the_exit_status_is_the_answer() {
    let data = [
        ("cubic", "--phi0 0.7 --phi1 1.4 --kappa0 0.4 --kappa1 4", 0),
        // Some spiral, but no cubic one.
        ("cubic", "--phi0 0.7 --phi1 1.4 --kappa0 -0.4 --kappa1 4", 1),
        ("cubic", "--phi0 4 --phi1 1.4 --kappa0 0.4 --kappa1 4", 2),
        ("ph-quintic", "--phi0 0.7 --phi1 1.4 --kappa0 0.4 --kappa1 4", 0),
        // A PH quintic, but no spiral.
        ("ph-quintic", "--phi0 0.7 --phi1 1.4 --kappa0 0.4 --kappa1 1.2", 1),
        ("any-spiral", "--alpha -40deg --beta 80deg --k1 -0.3 --k2 4", 0),
        // Falling curvature, which the other ends need.
        ("any-spiral", "--alpha -40deg --beta 80deg --k1 4 --k2 -0.3", 1),
        // Case 1 alone, case 2 alone, neither.
        ("reach-cubic", "--theta 45deg --xi 1.7 --eta 0.4", 0),
        ("reach-cubic", "--theta 45deg --xi 1.5 --eta 0.9", 0),
        ("reach-cubic", "--theta 45deg --xi 0.1 --eta 4", 1),
        ("reach-ph", "--theta 40deg --xi 1.5 --eta 0.35", 0),
        ("reach-ph", "--theta 40deg --xi 0.1 --eta 4", 1),
        ("trig-quintic", "--ratio 6 --theta 42deg --m 1 --p 0 --q 0", 0),
        ("trig-quintic", "--ratio 3.5 --theta 42deg --m 1 --p 0 --q 0", 1),
        // All data that are known have a solution that stands still nowhere.
        ("ph-equal-length", "--theta0 60deg --theta1 -135deg --S 1.3", 0),
        ("ph-hermite", "--theta0 30deg --theta1 45deg --l0 4 --l1 4", 0),
        ("ph-hermite", "--theta0 30deg --theta1 45deg --l0 4 --l1 0", 2),
    ];
    for (family, datum, code) in data {
        for more in [&[][..], &["--json"]] {
            let said = ask(family, datum, more);
            assert_eq!(said.code, Some(code), "{family} {datum}: {}{}", said.out, said.err);
            assert_eq!(said.out.is_empty(), code == 2, "{family} {datum}: {}", said.out);
        }
    }
}

/// JSON has no infinity: it would become null. A number beyond the range of doubles is named instead, and with it the
/// datum.
#[test]
fn numbers_beyond_the_range_of_doubles_are_told_in_a_sentence() {
    let data = [
        ("cubic", "--phi0 0.7 --phi1 1.4 --a 1e-300 --k 1.7e308", "kappa1 leaves the range of doubles for phi0 = 0.7"),
        ("cubic", "--phi0 0.7 --phi1 5e-324 --kappa0 0.4 --kappa1 4", "k leaves the range of doubles"),
        ("any-spiral", "--alpha -0.7 --beta 1.4 --k1 -1.7e308 --k2 1.7e308", "1e100"),
        ("reach-cubic", "--theta 0.7 --xi 1.5 --eta 1e-310", "m leaves the range of doubles"),
        ("reach-ph", "--theta 0.7 --xi 1e300 --eta 0.5", "m leaves the range of doubles"),
        (
            "trig-quintic",
            "--ratio 1e160 --theta 42deg --m 1 --p 0 --q 0",
            "length of solution 0 leaves the range of doubles",
        ),
        ("ph-equal-length", "--theta0 1 --theta1 1 --S 1e300", "S is 1e300"),
        ("ph-hermite", "--theta0 1 --theta1 1 --l0 1e160 --l1 1e-300", "l0 is 1e160"),
    ];
    for (family, datum, part) in data {
        for more in [&[][..], &["--json"]] {
            let said = ask(family, datum, more);
            assert_eq!((said.code, &said.out[..]), (Some(2), ""), "{family} {datum}: {}", said.err);
            assert!(said.err.contains(part) && !said.err.contains("inf"), "{family} {datum}: {}", said.err);
        }
    }
}

/// Extreme data in each coordinate of each family: an answer of finite numbers, or a sentence; no row of digits longer
/// than a double needs.
#[test]
fn extreme_data_are_answered_or_refused_in_readable_numbers() {
    let ordinary = [
        ("cubic", "phi0,phi1,kappa0,kappa1", "0.7,1.4,0.4,4"),
        ("cubic", "phi0,phi1,a,k", "0.7,1.4,0.8,2"),
        ("ph-quintic", "phi0,phi1,kappa0,kappa1", "0.7,1.4,0.4,4"),
        ("any-spiral", "alpha,beta,k1,k2", "-0.7,1.4,0.4,4"),
        ("reach-cubic", "theta,xi,eta", "0.7,1.5,0.5"),
        ("reach-ph", "theta,xi,eta", "0.7,1.5,0.5"),
        ("trig-quintic", "ratio,theta,m,p,q", "6,0.7,1,0,0"),
        ("ph-equal-length", "theta0,theta1,S", "0.5,-0.9,1.3"),
        ("ph-hermite", "theta0,theta1,l0,l1", "0.5,-0.9,2,3"),
    ];
    let folder = Folder::new("");
    for (family, header, datum) in ordinary {
        let cells: Vec<&str> = datum.split(',').collect();
        let mut rows = vec![header.to_owned()];
        for i in 0..cells.len() {
            for extreme in ["5e-324", "-1e-310", "1e-300", "1e160", "1e300", "nan"] {
                let mut row = cells.clone();
                row[i] = extreme;
                rows.push(row.join(","));
            }
        }
        std::fs::write(folder.at("rows.csv"), rows.join("\n")).unwrap();
        let said = run(["query", "--family", family, "--points", &folder.text("rows.csv")]);
        assert_eq!((said.code, said.out.lines().count()), (Some(2), rows.len() - 1), "{family}: {}", said.err);
        for line in said.out.lines() {
            let told = line.replace("\"chosen\":null", "");
            assert!(!["null", "inf", "inity"].iter().any(|word| told.contains(word)), "{family}: {line}");
            let longest = told.split(|c: char| !c.is_ascii_digit()).map(str::len).max();
            assert!(longest < Some(40), "{family}: {line}");
        }
    }
}

#[test]
fn the_papers_examples_have_the_papers_answers() {
    for example in EXAMPLES {
        let data: Vec<String> = example[..4].iter().map(|v| v.to_string()).collect();
        let data = [&data[0][..], &data[1], &data[2], &data[3]];
        let json = query(data, &["--json"]).json();
        assert!(
            ["SOLVABLE", "THEOREM31", "THEOREM31_ANY", "SPIRAL", "ANY_SPIRAL"]
                .iter()
                .all(|f| json["flags"][*f] == true)
        );
        let chosen = &json["solutions"][json["chosen"].as_u64().unwrap() as usize];
        let off = |key: &str, value: f64| (chosen[key].as_f64().unwrap() - value).abs();
        assert!(off("f0", example[4]) < 1e-10 && off("f1", example[5]) < 1e-10, "{chosen}");
        assert!(chosen["theorem31"] == true && chosen["spiral"] == true && chosen["margin"].as_f64().unwrap() > 0.0);
        assert_eq!(chosen["control_points"][3], serde_json::json!([1.0, 0.0]));
        // Longer than its chord, shorter than its polygon.
        let point = |i: usize| [0, 1].map(|k| chosen["control_points"][i][k].as_f64().unwrap());
        let side = |i: usize| (point(i + 1)[0] - point(i)[0]).hypot(point(i + 1)[1] - point(i)[1]);
        let length = chosen["length"].as_f64().unwrap();
        assert!(length > 2.0 && length < side(0) + side(1) + side(2), "{chosen}");
        let text = query(data, &[]).out;
        assert!(text.contains("chosen: f0 = ") && text.contains("spiral = yes"), "{text}");
    }
    let none = query(["0.7", "1.4", "0.4", "1.2"], &["--json"]).json();
    assert_eq!((&none["chosen"], &none["flags"]["SPIRAL"]), (&serde_json::Value::Null, &false.into()));
}

#[test]
fn degrees_and_negative_numbers_are_read() {
    let json = query(["40deg", "90deg", "-0.4", "4"], &["--json"]).json();
    assert_eq!(json["phi1"], std::f64::consts::FRAC_PI_2);
    assert_eq!((&json["kappa0"], &json["flags"]["SOLVABLE"]), (&(-0.4).into(), &false.into()));
}

#[test]
fn an_atlas_is_asked_too() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let file = folder.text("out/tiny.atlas.safetensors");
    let json = query(["0.69", "1.41", "0.41", "4.1"], &["--atlas", &file, "--json"]).json();
    let told = &json["atlas"];
    assert_eq!((&told["coordinates"]["phi0"], &told["flags"]["SPIRAL"]), (&0.7.into(), &true.into()), "{told}");
    assert!(told["scalars"]["f0"].as_f64().is_some_and(|f| f > 1.5) && told["solutions"]["spirals"] == 1, "{told}");
    // Node 2·3·6·5 counts: phi0 1, phi1 2, kappa0 3, kappa1 2 of 16^(i/4).
    assert_eq!(told["node"], 90 + 2 * 30 + 3 * 5 + 2);
    let none = query(["0.7", "1.4", "0.6", "1"], &["--atlas", &file, "--json"]).json();
    assert_eq!(none["atlas"]["scalars"]["f0"], serde_json::Value::Null);
    let far = query(["0.7", "1.4", "0.41", "400"], &["--atlas", &file]).out;
    assert!(far.contains("does not reach there: kappa1 = 400.0 is outside 1.0 to 16.0"), "{far}");
}

#[test]
fn atlases_in_normalised_coordinates_are_asked_too() {
    let recipe = TINY
        .replace("kappa0 = { linear = [0.1, 0.6]", "a = { linear = [0.1, 1.6]")
        .replace("kappa1 = { log", "k = { log");
    let folder = Folder::new(&recipe[..recipe.find("[[atlas.picture]]").unwrap()]);
    folder.generate(&[]);
    let json =
        query(["0.7", "1.4", "0.4", "4"], &["--atlas", &folder.text("out/tiny.atlas.safetensors"), "--json"]).json();
    // a = 0.4 (sin 1.4 / sin 2.1)² / sin 0.7 = 0.809, nearest to 0.7 of 0.1, 0.4, ..; k = 4 (sin 0.7 / sin 2.1)² / sin
    // 1.4 = 2.26, to 2.
    assert_eq!((&json["atlas"]["coordinates"]["a"], &json["atlas"]["coordinates"]["k"]), (&0.7.into(), &2.0.into()));
}

#[test]
fn every_family_answers() {
    let any = fine([
        "query",
        "--family",
        "any-spiral",
        "--phi0",
        "0.7",
        "--phi1",
        "1.4",
        "--kappa0",
        "0.4",
        "--kappa1",
        "4",
        "--json",
    ]);
    let (any, cubic) = (any.json(), query(["0.7", "1.4", "0.4", "4"], &["--json"]).json());
    assert_eq!((&any["flags"]["EXISTS"], &cubic["flags"]["ANY_SPIRAL"]), (&true.into(), &true.into()));
    assert_eq!((&any["derived"]["alpha"], any["solutions"][0]["theta"].is_f64()), (&(-0.7).into(), true), "{any}");
    // The Walton-Meek point of case 1 for 45 degrees: the segment with m = 1.
    let data = [
        "query",
        "--family",
        "reach-cubic",
        "--theta",
        "45deg",
        "--xi",
        "1.7022941028565",
        "--eta",
        "0.392837100659193",
        "--json",
    ];
    let reach = fine(data).json();
    assert_eq!((&reach["flags"]["CASE1_PAPER"], &reach["solutions"][0]["case"]), (&true.into(), &1.into()), "{reach}");
    assert!((reach["solutions"][0]["m"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    // The same datum in the cubic's other chart.
    let (a, k) = (cubic["derived"]["a"].to_string(), cubic["derived"]["k"].to_string());
    let other = fine(["query", "--phi0", "0.7", "--phi1", "1.4", "--a", &a, "--k", &k, "--json"]).json();
    assert!((other["derived"]["kappa1"].as_f64().unwrap() - 4.0).abs() < 1e-14);
    assert_eq!((&other["flags"], &other["counts"]), (&cubic["flags"], &cubic["counts"]));
    let folder = Folder::new("");
    std::fs::write(folder.at("ends.csv"), "theta,xi,eta\n45deg,1.5,0.9\n4,1,1\n").unwrap();
    let said = run(["query", "--family", "reach-cubic", "--points", &folder.text("ends.csv")]);
    assert!(
        said.code == Some(2) && said.out.contains("CASE2_EXACT\":true") && said.out.contains("theta is 4"),
        "{}",
        said.out
    );
}

#[test]
fn a_table_is_answered_line_by_line_in_order() {
    let folder = Folder::new("");
    let rows = "kappa1, phi0 ,id,phi1,kappa0\r\n4,0.7,a,1.4,0.4\r\n\r\nx,0.7,b,1.4,0.4\n4,0.7\n\
                100,0.1,c,1.5,0.035\n4,4,d,1,1\n\
                4,40deg,e,80deg,-1\n1e999,0.7,f,1.4,0.4";
    std::fs::write(folder.at("rows.csv"), rows).unwrap();
    let said = run(["query", "--points", &folder.text("rows.csv")]);
    let summary = "error: rows 2, 3, 5, 7 of 7 are bad; their answers say why\n";
    assert_eq!((said.code, &said.err[..]), (Some(2), summary));
    let lines: Vec<serde_json::Value> = said.out.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(lines.len(), 7);
    assert!(said.out.starts_with(r#"{"phi0":0.7,"phi1":1.4,"kappa0":0.4,"kappa1":4.0,"flags":{"SOLVABLE":true,"#));
    assert_eq!(
        (&lines[0]["chosen"], &lines[3]["kappa1"], &lines[5]["kappa0"]),
        (&0.into(), &100.0.into(), &(-1.0).into())
    );
    for (at, part) in [(1, "kappa1: \"x\""), (2, "2 values"), (4, "phi0 is 4"), (6, "kappa1 is inf")] {
        assert_eq!(lines[at]["row"], at + 1);
        assert!(lines[at]["error"].as_str().unwrap().contains(part), "{}", lines[at]);
    }
    // Every row has an answer: that the second is a no does not matter.
    let good: String = rows
        .lines()
        .filter(|l| ["id", ",a,", ",e,"].iter().any(|part| l.contains(part)))
        .map(|l| format!("{l}\n"))
        .collect();
    std::fs::write(folder.at("good.csv"), good).unwrap();
    assert_eq!(fine(["query", "--points", &folder.text("good.csv")]).out.lines().count(), 2);
}

/// What spreadsheets write: a byte order mark, marks around cells, commas in them, lines of commas at the end.
#[test]
fn tables_of_spreadsheets_are_read() {
    let asked = |text: &str| super::curve_output::piped(&["query", "--points", "-"], text);
    let plain = asked("phi0,phi1,kappa0,kappa1\n0.7,1.4,0.4,4\n");
    for text in [
        "\u{feff}\"phi0\",\"phi1\",\"kappa0\",\"kappa1\"\r\n\"0.7\",\"1.4\",\"0.4\",\"4\"\r\n\r\n,,,\r\n",
        "PHI0,Phi1,name,kappa0,kappa1\n0.7,1.4,\"Main St, 5\",0.4,4\n\n\n",
    ] {
        let said = asked(text);
        assert!(
            said.code == Some(0) && said.out == plain.out && said.err.is_empty(),
            "{text}: {}{}",
            said.out,
            said.err
        );
    }
    let none = asked("phi0,phi1,kappa0,kappa1\r\n\r\n");
    assert_eq!((none.code, &none.out[..], &none.err[..]), (Some(0), "", ""));
    for (text, what) in [
        ("phi0;phi1;kappa0;kappa1\n0,7;1,4;0,4;4\n", "with semicolons between the columns; save the table with commas"),
        ("phi0\tphi1\tkappa0\tkappa1\n", "with tabs between the columns"),
        ("", "it is empty"),
    ] {
        let said = asked(text);
        assert!(said.code == Some(2) && said.err.contains(what) && said.out.is_empty(), "{text}: {}", said.err);
    }
    let comma = asked("phi0,phi1,kappa0,kappa1\n0.7,1.4,0.4,4\n0.7,1.4,\"0,4\",4\n");
    assert!(comma.code == Some(2) && comma.out.starts_with(&plain.out), "{}", comma.out);
    assert!(comma.out.contains("\"row\":2") && comma.out.contains("write 0.4, with a point"), "{}", comma.out);
    assert_eq!(comma.err, "error: row 2 of 2 is bad; its answer says why\n");
}

/// Names of families in letters of either size. A number that is none: the comma is named where it is the fault.
#[test]
fn names_and_numbers_as_they_are_typed() {
    let datum = |kappa0: &'static str| format!("--phi0 0.7 --phi1 1.4 --kappa0 {kappa0} --kappa1 4");
    let plain = ask("ph-quintic", &datum("0.4"), &["--json"]);
    let large = ask("PH-Quintic", &datum("0.4"), &["--json"]);
    assert!(plain.code == Some(0) && large.out == plain.out, "{}{}", plain.err, large.err);
    let comma = ask("cubic", &datum("0,4"), &[]);
    assert!(comma.code == Some(2) && comma.err.contains("write 0.4, with a point"), "{}", comma.err);
    let (distinctness, curvature) = (["export", "lattice", "--distinctness"], ["join", "--greatest-curvature"]);
    for (option, number, way_out) in [
        (&distinctness[..], "0,4", "write 0.4, with a point"),
        (&distinctness, "much", "write it like 0.5, -3 or 1e-3"),
        (&curvature, "0,4", "write 0.4, with a point"),
        (&curvature, "much", "write a curvature like 0.004, or 1/250 for a radius of 250"),
    ] {
        let said = run([option, &[number]].concat());
        let once = said.err.contains(way_out) && said.err.matches("write").count() == 1;
        assert!(said.code == Some(2) && once, "{}", said.err);
    }
}

#[test]
fn whoever_sends_a_row_gets_its_answer_before_the_next() {
    let mut child =
        program().args(["query", "--points", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let (mut input, mut output) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
    input.write_all(b"phi0,phi1,kappa0,kappa1\n").unwrap();
    for kappa1 in [3.5, 4.5] {
        writeln!(input, "0.7,1.4,0.4,{kappa1}").unwrap();
        let mut line = String::new();
        output.read_line(&mut line).unwrap();
        assert!(line.contains(&format!(r#""kappa1":{kappa1}"#)), "{line}");
    }
    drop(input);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_reader_that_leaves_ends_the_stream_quietly() {
    let folder = Folder::new("");
    let rows: String = "phi0,phi1,kappa0,kappa1\n".chars().chain("0.7,1.4,0.4,4\n".repeat(20_000).chars()).collect();
    std::fs::write(folder.at("rows.csv"), rows).unwrap();
    let mut child = program();
    child.args(["query", "--points", &folder.text("rows.csv")]).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with('{'));
    let said: super::Said = child.wait_with_output().unwrap().into();
    assert_eq!((said.code, &said.err[..]), (Some(0), ""));
}

/// The commands, or those of a command, that the help lists.
fn commands(of: &[&str]) -> Vec<String> {
    let help = fine(of.iter().copied().chain(["--help"])).out;
    let Some((_, list)) = help.split_once("\nCommands:\n") else { return Vec::new() };
    let names = list.lines().take_while(|line| !line.is_empty());
    let names = names.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    names.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help").map(str::to_owned).collect()
}

#[test]
fn every_command_has_an_example_in_its_help() {
    let commands = commands(&[]);
    assert!(commands.len() > 8, "{commands:?}");
    for command in commands {
        let (help, inner) = (fine([&command, "--help"]).out, self::commands(&[&command]));
        let own = |help: &str, name: &str| help.contains("Example") && help.contains(&format!("spiral-atlas {name}"));
        let each = |inner: &String| own(&fine([&command, inner, "--help"]).out, &format!("{command} {inner}"));
        assert!(own(&help, &command) || !inner.is_empty() && inner.iter().all(each), "{command}: {help}");
    }
    assert!(fine(["completions", "bash"]).out.contains("generate"));
    assert!(fine(["adapters", "--json"]).json().is_array());
}
