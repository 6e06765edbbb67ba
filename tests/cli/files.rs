//! Commands that write and read files: generate, verify, render, info.

use super::{Folder, TINY, TINY_NODES, fine, names, run};
use spiral_atlas::atlas::{Atlas, Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use std::process::Stdio;
use std::sync::atomic::AtomicBool;

#[test]
fn a_recipe_becomes_an_atlas_a_report_and_pictures() {
    let folder = Folder::new(TINY);
    let said = folder.generate(&["--check", "sample"]);
    for part in ["phi0 2 x phi1 3 x kappa0 6 x kappa1 5 = 180 nodes", "by the CPU", "THEOREM31_ANY", "f64", "all agree"]
    {
        assert!(said.out.contains(part), "{part}: {}", said.out);
    }
    let expected = ["tiny-1.png", "tiny-2.png", "tiny.atlas.safetensors", "tiny.report.json"];
    assert_eq!(names(&folder.at("out")), expected);
    assert!(said.err.is_empty(), "a progress bar on what is no terminal: {}", said.err);
    for name in expected {
        let bytes = std::fs::read(folder.at("out").join(name)).unwrap();
        assert!(said.out.contains(&blake3::hash(&bytes).to_hex().to_string()), "{name}");
        assert_eq!(name.ends_with(".png"), bytes.starts_with(b"\x89PNG"), "{name}");
    }
    let atlas = Atlas::open(folder.at("out/tiny.atlas.safetensors")).unwrap();
    atlas.check_hashes().unwrap();
    assert_eq!(atlas.scalar_names().collect::<Vec<_>>(), ["margin", "f0"]);
    assert_eq!(atlas.recipe_text(), TINY);
    let report: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.at("out/tiny.report.json")).unwrap()).unwrap();
    let spirals = atlas.flags().iter().filter(|f| **f & 8 != 0).count();
    assert!(spirals > 5);
    assert_eq!((&report["nodes"], &report["yes"]["SPIRAL"]), (&180.into(), &spirals.into()));
    assert_eq!((&report["check"][0]["differences"], &report["check"][0]["nodes"]), (&0.into(), &180.into()));
    assert_eq!(report["id"], atlas.id().to_hex().as_str());
    let json = folder.generate(&["--json"]).json();
    assert_eq!((&json["atlases"][0]["report"]["nodes"], &json["together"]), (&180.into(), &serde_json::Value::Null));
}

#[test]
fn the_same_recipe_gives_the_same_bytes_with_any_number_of_threads() {
    let bytes = |recipe: &str, threads| {
        let folder = Folder::new(recipe);
        folder.generate(&["--threads", threads]);
        ["tiny.atlas.safetensors", "tiny-1.png", "tiny-2.png"].map(|n| std::fs::read(folder.at("out").join(n)).unwrap())
    };
    let first = bytes(TINY, "1");
    assert!(first == bytes(TINY, "1") && first == bytes(TINY, "5"));
    let other = bytes(&TINY.replace("16]", "17]"), "1");
    assert!((0..3).all(|i| first[i] != other[i]));
}

/// Two runs into one folder at the same time: both end well, and whole files are there.
#[test]
fn runs_at_the_same_time_end_well() {
    let folder = Folder::new(TINY);
    let (recipe, out) = (folder.text("recipe.toml"), folder.text("out"));
    let args = ["generate", &recipe, "--out", &out, "--backend", "cpu"];
    let runs: Vec<_> = (0..4)
        .map(|_| super::program().args(args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap())
        .collect();
    for run in runs {
        let said = super::Said::from(run.wait_with_output().unwrap());
        assert_eq!(said.code, Some(0), "{}", said.err);
    }
    let all = ["tiny-1.png", "tiny-2.png", "tiny.atlas.safetensors", "tiny.report.json"];
    assert_eq!(names(&folder.at("out")), all);
    fine(["verify", &folder.text("out/tiny.atlas.safetensors"), "--backend", "cpu"]);
}

#[test]
fn verify_finds_a_flipped_byte_where_it_is() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let path = folder.at("out/tiny.atlas.safetensors");
    let file = path.to_str().unwrap();
    let good = fine(["verify", file, "--backend", "cpu", "--json"]).json();
    assert_eq!((&good["good"], &good["comparisons"][0]["values"]), (&true.into(), &(4 * TINY_NODES).into()));
    assert!(fine(["verify", file, "--backend", "cpu"]).out.contains("720 values of 180 nodes, all agree"));

    let bytes = std::fs::read(&path).unwrap();
    // Flags and solutions, a byte a node each, end the file.
    for (back, field, node) in [(2 * TINY_NODES, "flags", 97), (TINY_NODES, "solutions", 179)] {
        let mut bad = bytes.clone();
        bad[bytes.len() - back + node] ^= 1;
        std::fs::write(&path, bad).unwrap();
        let said = run(["verify", file, "--backend", "cpu", "--json"]);
        assert_eq!(said.code, Some(1));
        let json = said.json();
        let (found, first) = (&json["comparisons"][0], &json["comparisons"][0]["first"]);
        assert_eq!((&found["differences"], first.as_array().map(Vec::len)), (&1.into(), Some(1)));
        assert_eq!((&first[0]["field"], &first[0]["node"]), (&field.into(), &node.into()));
        assert!(json["faults"][0].as_str().unwrap().contains(field), "{json}");
        let text = run(["verify", file, "--backend", "cpu"]);
        assert!(text.code == Some(1) && text.out.contains(&format!("node {node} (phi0 = ")), "{}", text.out);
        assert!(text.err.contains("verification failed"), "{}", text.err);
    }
}

/// Writes an atlas of the tiny grid whose metadata has another recipe.
fn with_recipe(folder: &Folder, recipe: &str) -> String {
    let plan = spiral_atlas::recipe::Recipe::parse(TINY).unwrap();
    let (family, grid) = (plan.atlases[0].family, &plan.atlases[0].grid);
    let path = folder.at("other.safetensors");
    let mut writer = Writer::create(&path, &Spec { name: "tiny", family, grid, scalars: &[], recipe }).unwrap();
    let job = Job { family, grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 1, &AtomicBool::new(false), |chunk| writer.put(&chunk)).unwrap();
    writer.finish().unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn verify_compares_the_recipe_with_the_grid() {
    let folder = Folder::new(TINY);
    let free = with_recipe(&folder, "made by a program");
    assert!(fine(["verify", &free, "--backend", "cpu"]).out.contains("recipe are sound"));
    for (recipe, part) in [(TINY.replace("16]", "17]"), "another"), (TINY.replace("tiny", "huge"), "no atlas `tiny`")] {
        let said = run(["verify", &with_recipe(&folder, &recipe), "--backend", "cpu"]);
        assert!(said.code == Some(1) && said.out.contains(part), "{}", said.out);
    }
}

#[test]
fn render_draws_what_generate_draws_and_keeps_nothing_else() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let (again, direct) = (folder.text("again"), folder.text("direct"));
    fine(["render", &folder.text("out/tiny.atlas.safetensors"), "--out", &again]);
    let said = fine(["render", &folder.text("recipe.toml"), "--out", &direct, "--backend", "cpu", "--json"]);
    assert_eq!(said.json().as_array().unwrap().len(), 2);
    for out in [&again, &direct] {
        assert_eq!(names(out.as_ref()), ["tiny-1.png", "tiny-2.png"]);
        for name in names(out.as_ref()) {
            let read = |folder: &std::path::Path| std::fs::read(folder.join(&name)).unwrap();
            assert!(read(out.as_ref()) == read(&folder.at("out")), "{name}");
        }
    }
    let lines = folder.text("lines");
    fine(["render", &folder.text("out/tiny.atlas.safetensors"), "--out", &lines, "--format", "svg"]);
    assert_eq!(names(lines.as_ref()), ["tiny-1.svg", "tiny-2.svg"]);
    assert!(std::fs::read_to_string(folder.at("lines/tiny-1.svg")).unwrap().starts_with("<?xml"));
    // Without a recipe: one slice, which a recipe's first picture is not.
    let plain = folder.text("plain");
    fine(["render", &with_recipe(&folder, ""), "--out", &plain]);
    assert_eq!(names(plain.as_ref()), ["tiny.png"]);
    assert_ne!(
        std::fs::read(folder.at("plain/tiny.png")).unwrap(),
        std::fs::read(folder.at("out/tiny-1.png")).unwrap()
    );
}

#[test]
fn slices_of_several_atlases_are_drawn_side_by_side() {
    let slice = &TINY[..TINY.rfind("[[atlas.picture]]").unwrap()];
    let second = &slice[slice.find("[[atlas]]").unwrap()..];
    let folder = Folder::new(&format!("{slice}{}", second.replace("\"tiny\"", "\"tiny-b\"")));
    let said = folder.generate(&[]);
    assert!(said.out.contains("side by side"));
    let pictures: Vec<String> = names(&folder.at("out")).into_iter().filter(|n| n.ends_with(".png")).collect();
    assert_eq!(pictures, ["recipe.png", "tiny-b.png", "tiny.png"]);
}

#[test]
fn info_tells_what_an_atlas_holds() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let file = folder.text("out/tiny.atlas.safetensors");
    let text = fine(["info", &file]).out;
    for part in ["180 nodes", "kappa1", "log", "bit 3 SPIRAL", "bits 2-3 spirals", "margin", "half chord", "[[atlas]]"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let json = fine(["info", &file, "--json"]).json();
    assert_eq!((&json["axes"][3]["count"], &json["axes"][3]["last"]), (&5.into(), &16.0.into()));
    assert_eq!((&json["flags"][0]["name"], &json["recipe"]), (&"SOLVABLE".into(), &TINY.into()));
    let bytes = std::fs::read(&file).unwrap();
    let flags = blake3::hash(&bytes[bytes.len() - 2 * TINY_NODES..bytes.len() - TINY_NODES]);
    assert_eq!(json["blake3"]["flags"], flags.to_hex().as_str());
}

/// Sizes without room, and letters that the font lacks, are reported before anything is made; the size that is advised
/// works, and one hardly smaller than that does not.
#[test]
fn pictures_that_cannot_be_drawn_are_refused_before_the_work() {
    let recipe = |more: &str| TINY.replacen("at = {", &format!("{more}\nat = {{"), 1);
    let folder = Folder::new(&recipe("size = [240, 180]"));
    let args = ["generate", &folder.text("recipe.toml"), "--out", &folder.text("out"), "--backend", "cpu"];
    let line = 1 + recipe("size").lines().position(|line| line == "size").unwrap();
    let said = run(args);
    let place = format!("recipe.toml, line {line}: `tiny-1.png`: a picture of ");
    assert!(said.code == Some(2) && said.err.contains(&place) && !folder.at("out").exists(), "{}", said.err);
    let advised = said.err.split("such as `size = [").nth(1).unwrap().split("]`").next().unwrap();
    let [width, height] = [0, 1].map(|i| advised.split(", ").nth(i).unwrap().parse::<f64>().unwrap());
    let works = |scale: f64| {
        let size = format!("size = [{}, {}]", (width * scale).round(), (height * scale).round());
        std::fs::write(folder.at("recipe.toml"), recipe(&size)).unwrap();
        run(args).code == Some(0)
    };
    assert!(works(1.0) && !works(0.9), "{advised}");
    for more in ["title = \"螺旋\"", "mark = [{ kappa0 = 0.4, kappa1 = 4, label = \"螺\" }]"] {
        std::fs::write(
            folder.at("recipe.toml"),
            recipe(more).replace("mark = [{ kappa0 = 0.4, kappa1 = 4, label = \"example 1\" }]", ""),
        )
        .unwrap();
        let said = run(args);
        let place = format!("line {}: `tiny-1.png`: the font has no letter `螺`", line - 3);
        assert!(said.code == Some(2) && said.err.contains(&place), "{}", said.err);
    }
}

#[test]
fn a_damaged_bit_is_seen_by_all_that_read_an_atlas() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let (file, out) = (folder.text("out/tiny.atlas.safetensors"), folder.text("pictures"));
    let datum = ["--phi0", "0.7", "--phi1", "1.4", "--kappa0", "0.4", "--kappa1", "4"];
    let query: Vec<&str> = ["query", "--atlas", &file].into_iter().chain(datum).collect();
    let readers = [vec!["info", &file], vec!["render", &file, "--out", &out], query];
    for args in &readers {
        fine(args);
    }
    let mut bytes = std::fs::read(&file).unwrap();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    std::fs::write(&file, bytes).unwrap();
    for args in &readers {
        let said = run(args);
        assert_eq!((said.code, &said.out[..]), (Some(2), ""), "{args:?}");
        assert!(said.err.contains("the BLAKE3 of `solutions` is"), "{args:?}: {}", said.err);
    }
}
