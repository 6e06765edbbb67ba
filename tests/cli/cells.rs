//! Cells from recipe to answer.

use super::{Folder, fine, names, run};

const CELLS: &str = r#"
family = "cubic"
[[atlas]]
name = "few"
kind = "cells"
resolution = 16
budget = "200 KiB"
[atlas.axes]
phi0 = { linear = [0.68, 0.7] }
phi1 = { linear = ["80deg", 1.41] }
kappa0 = { linear = [0.3, 0.5] }
kappa1 = { log = [2.5, 4] }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.69, phi1 = 1.4 }
"#;

const POINTS: &str = "phi0,phi1,kappa0,kappa1\n0.69,1.4,0.4,3.5\n0.5,1.4,0.4,3.5\n0.69,1.4,0.31,2.6\n";

#[test]
fn cells_are_made_told_asked_and_verified() {
    let folder = Folder::new(CELLS);
    folder.generate(&[]);
    assert_eq!(names(&folder.at("out")), ["few.atlas.safetensors", "few.png", "few.report.json"]);
    let file = folder.text("out/few.atlas.safetensors");
    let told = fine(["info", &file, "--json"]).json();
    assert_eq!((&told["kind"], &told["resolution"], &told["family"]), (&"cells".into(), &16.into(), &"cubic".into()));
    assert!(fine(["info", &file]).out.contains("cells, up to 16 an axis"));

    std::fs::write(folder.at("points.csv"), POINTS).unwrap();
    let said = fine(["query", "--atlas", &file, "--points", &folder.text("points.csv")]);
    let rows: Vec<serde_json::Value> = said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((rows.len(), &rows[1]["cell"]), (3, &serde_json::Value::Null));
    assert!(rows[1].as_object().unwrap().contains_key("cell"));
    for row in [&rows[0], &rows[2]] {
        let (cell, flags) = (row["cell"].as_object().unwrap(), row["flags"].as_object().unwrap());
        assert_eq!(cell.keys().collect::<Vec<_>>(), flags.keys().collect::<Vec<_>>());
        for (name, holds) in flags {
            let word = cell[name].as_str().unwrap();
            assert!(word == "MIXED" || (word == "INSIDE") == holds.as_bool().unwrap(), "{name}: {row}");
        }
    }
    assert_eq!(rows[0]["cell"]["SPIRAL"], "INSIDE");
    let plain =
        fine(["query", "--phi0", "0.69", "--phi1", "1.4", "--kappa0", "0.4", "--kappa1", "3.5", "--atlas", &file]);
    assert!(plain.out.contains("its cell: ") && plain.out.contains("SPIRAL = INSIDE"), "{}", plain.out);
    // The same place in other coordinates was rounded, so its cell says nothing of it.
    let other = run(["query", "--phi0", "0.69", "--phi1", "1.4", "--a", "0.8", "--k", "2", "--atlas", &file, "--json"]);
    assert_eq!(other.json()["cell"], serde_json::Value::Null);

    fine(["render", &file, "--out", &folder.text("again")]);
    let picture = |name: &str| std::fs::read(folder.at(name)).unwrap();
    assert!(picture("again/few.png") == picture("out/few.png"));

    let verified = fine(["verify", &file, "--json"]).json();
    assert_eq!(
        (&verified["good"], &verified["differences"], &verified["attack"]["wrong"]),
        (&true.into(), &0.into(), &0.into())
    );
    // One flag of one top cell, the last of the file.
    let mut bytes = std::fs::read(&file).unwrap();
    let last = bytes.chunks_exact(2).rposition(|known| known[0] & 8 != 0).unwrap() * 2;
    (bytes[last], bytes[last + 1]) = (bytes[last] & !8, bytes[last + 1] | 8);
    std::fs::write(&file, bytes).unwrap();
    let found = run(["verify", &file]);
    assert_eq!(found.code, Some(1), "{}", found.out);
    assert!(found.out.contains("FAULT") && found.out.contains("1 words DIFFER\n    `top` at"), "{}", found.out);
}

/// A recipe of a family with its axes, the two that are drawn, where the others are, and two points inside.
const OTHERS: [(&str, &str, [&str; 3], &str); 2] = [
    (
        "ph-equal-length",
        "theta0 = { linear = [0.9, 1.1] }\ntheta1 = { linear = [-0.5, 0.1] }\nS = { log = [1.15, 1.5] }",
        ["theta1", "S", "theta0 = 1"],
        "theta0,theta1,S\n0.95,-0.31,1.3\n1.01,-0.2,1.4\n",
    ),
    (
        "trig-quintic",
        "ratio = { linear = [3, 8] }\ntheta = { values = [\"42deg\"] }\nm = { linear = [0.3, 4] }\n\
         p = { values = [0] }\nq = { linear = [-0.3, 0.2] }",
        ["m", "ratio", "q = 0"],
        "ratio,theta,m,p,q\n6.5,0.7330382858376184,1.1,0,-0.2\n3.1,0.7330382858376184,2,0,0.1\n",
    ),
];

#[test]
fn other_families_have_cells() {
    for (family, axes, [x, y, at], points) in OTHERS {
        let folder = Folder::new(&format!(
            "family = \"{family}\"\n[[atlas]]\nname = \"few\"\nkind = \"cells\"\nresolution = 32\n\
             budget = \"300 KiB\"\n[atlas.axes]\n{axes}\n[[atlas.picture]]\nkind = \"slice\"\nx = \"{x}\"\n\
             y = \"{y}\"\nat = {{ {at} }}\n"
        ));
        folder.generate(&[]);
        let file = folder.text("out/few.atlas.safetensors");
        let told = fine(["info", &file, "--json"]).json();
        assert_eq!((&told["resolution"], &told["family"]), (&32.into(), &family.into()));
        std::fs::write(folder.at("points.csv"), points).unwrap();
        let said = fine(["query", "--atlas", &file, "--points", &folder.text("points.csv")]);
        let rows: Vec<serde_json::Value> = said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(rows.len(), 2);
        let mut known = 0;
        for row in &rows {
            for (name, holds) in row["flags"].as_object().unwrap() {
                let word = row["cell"][name].as_str().unwrap();
                assert!(word == "MIXED" || (word == "INSIDE") == holds.as_bool().unwrap(), "{name}: {row}");
                known += u32::from(word != "MIXED");
            }
        }
        assert!(known > 4, "{rows:?}");
        fine(["render", &file, "--out", &folder.text("again")]);
        let picture = |name: &str| std::fs::read(folder.at(name)).unwrap();
        assert!(picture("again/few.png") == picture("out/few.png"));
        let verified = fine(["verify", &file, "--json"]).json();
        assert_eq!((&verified["good"], &verified["attack"]["wrong"]), (&true.into(), &0.into()), "{verified}");
    }
}

#[test]
fn mistakes_in_recipes_of_cells_are_named() {
    let cases = [
        ("resolution = 16", "resolution = 20", "`resolution` is 20; it must be a power of two"),
        ("budget = \"200 KiB\"", "budget = \"200 kilos\"", "`budget` is \"200 kilos\""),
        ("budget = \"200 KiB\"", "budget = \"1 KiB\"", "top cells alone take"),
        ("budget = \"200 KiB\"\n", "", "needs `resolution` and `budget`"),
        ("kind = \"cells\"", "kind = \"nodes\"", "`resolution` belongs to"),
        ("kind = \"cells\"", "kind = \"cell\"", "did you mean `cells`?"),
        ("[0.68, 0.7] }", "[0.68, 0.7], count = 3 }", "axis `phi0` of cells takes"),
        ("{ linear = [0.68, 0.7] }", "{ values = [0.68, 0.7] }", "or `{ values = [one] }`"),
        ("kind = \"slice\"", "kind = \"multiples\"", "of the kind `slice`"),
    ];
    for (from, to, what) in cases {
        let folder = Folder::new(&CELLS.replacen(from, to, 1));
        let said = run(["generate", &folder.text("recipe.toml"), "--out", &folder.text("out")]);
        assert!(said.code == Some(2) && said.err.contains(what), "{to}: {}", said.err);
        assert!(!folder.at("out").join("few.atlas.safetensors").exists());
    }
}

#[test]
fn cells_outside_a_domain_are_refused_before_any_work() {
    const TURNS: [(&str, &str); 2] = [("phi0", "linear = [0.1, 0.5]"), ("phi1", "linear = [0.6, 1]")];
    const BENDS: [(&str, &str); 2] = [("kappa0", "linear = [0.1, 1]"), ("kappa1", "log = [1, 5]")];
    const PLACE: [(&str, &str); 2] = [("xi", "linear = [0.6, 1]"), ("eta", "linear = [0.1, 1]")];
    const THETAS: [(&str, &str); 2] = [("theta0", "linear = [0.1, 0.5]"), ("theta1", "linear = [0.6, 1]")];
    const SPEEDS: [(&str, &str); 2] = [("l0", "linear = [0.6, 1]"), ("l1", "log = [1, 5]")];
    const LENGTH: [(&str, &str); 1] = [("S", "linear = [1.1, 2]")];
    const REACH: [(&str, &str); 1] = [("theta", "linear = [0.1, 0.5]")];
    const TRIG: [(&str, &str); 5] = [
        ("ratio", "linear = [3, 5]"),
        ("theta", "values = [0.7]"),
        ("m", "linear = [0.3, 1]"),
        ("p", "values = [0]"),
        ("q", "linear = [-0.3, 0.2]"),
    ];
    let cases: [(&str, Vec<_>, &[[&str; 3]]); 8] = [
        (
            "cubic",
            [TURNS, BENDS].concat(),
            &[
                ["phi0", "linear = [-2, -1]", "phi0 is -2 (-114.591559 degrees); it must be above 0 and below pi"],
                ["phi0", "values = [3]", "phi0 + phi1 reaches 3 + 0.6 = 3.6; it must stay below pi"],
            ],
        ),
        (
            "ph-quintic",
            [TURNS, BENDS].concat(),
            &[["phi1", "values = [0]", "phi1 is 0 (0 degrees); it must be above 0"]],
        ),
        (
            "any-spiral",
            [TURNS, BENDS].concat(),
            &[["phi1", "linear = [3.2, 4]", "phi1 is 3.2 (183.346494 degrees); it"]],
        ),
        (
            "reach-cubic",
            [&REACH[..], &PLACE].concat(),
            &[["theta", "values = [1.6]", "above 0 and below pi/2 for `reach"]],
        ),
        (
            "reach-ph",
            [&REACH[..], &PLACE].concat(),
            &[["theta", "linear = [-1, 0]", "theta is -1 (-57.29578 degrees)"]],
        ),
        (
            "ph-equal-length",
            [&THETAS[..], &LENGTH].concat(),
            &[
                ["theta0", "values = [4]", "theta0 is 4; it must be 0, or 1e-9 to pi in size"],
                ["S", "values = [0.5]", "S is 0.5; it must be above 1"],
                ["S", "linear = [0.5, 0.9]", "S is 0.5; it must be above 1"],
            ],
        ),
        (
            "ph-hermite",
            [THETAS, SPEEDS].concat(),
            &[["l0", "values = [-1]", "l0 is -1; it must be 1e-6 to 1e6, in chords"]],
        ),
        (
            "trig-quintic",
            TRIG.to_vec(),
            &[
                ["m", "values = [-1]", "m is -1; it must be finite and above 0"],
                ["p", "values = [1.5]", "p is 1.5; it must be above -4 and at most 1"],
                ["theta", "values = [1.6]", "theta is 1.6 (91.673247 degrees); it must be above 0 and below pi/2"],
            ],
        ),
    ];
    let made = |family: &str, axes: &[(&str, &str)]| {
        let axes: String = axes.iter().map(|(name, values)| format!("{name} = {{ {values} }}\n")).collect();
        let folder = Folder::new(&format!(
            "family = \"{family}\"\n[[atlas]]\nname = \"few\"\nkind = \"cells\"\nresolution = 2\nbudget = \"1 MiB\"\n\
             [atlas.axes]\n{axes}"
        ));
        let said = run(["generate", &folder.text("recipe.toml"), "--out", &folder.text("out")]);
        let written = folder.at("out").join("few.atlas.safetensors").exists();
        (said, written)
    };
    for (family, axes, mistakes) in cases {
        for [name, values, what] in mistakes {
            let axes: Vec<_> = axes.iter().map(|axis| if axis.0 == *name { (*name, *values) } else { *axis }).collect();
            let (said, written) = made(family, &axes);
            assert!(said.code == Some(2) && said.err.contains(what), "{family} {name}: {}", said.err);
            assert!(!written, "{family} {name}");
        }
    }
    // What is outside in part is a box like any other; of two limits the one that shuts the box out is named.
    let wide = ("phi0", "linear = [-1, 4]");
    assert!(made("cubic", &[wide, TURNS[1], BENDS[0], BENDS[1]]).1);
    let (said, _) = made("cubic", &[wide, ("phi1", "values = [3.2]"), BENDS[0], BENDS[1]]);
    assert!(said.err.contains("phi1 is 3.2"), "{}", said.err);
}
