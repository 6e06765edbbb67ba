//! What goes wrong is said, with the value, and leaves nothing behind.

use super::{Folder, TINY, names, program, run};
use std::process::Command;
use std::time::{Duration, Instant};

#[test]
fn bad_input_is_named() {
    let folder = Folder::new(TINY);
    let recipe = folder.text("recipe.toml");
    std::fs::write(folder.at("typo.toml"), TINY.replace("kappa0 =", "kapa0 =")).unwrap();
    std::fs::write(folder.at("wide.toml"), TINY.replace("[0.9, 1.4]", "[0.9, 3.1]")).unwrap();
    std::fs::write(folder.at("head.csv"), "phi0,phi1,kappa0\n").unwrap();
    std::fs::write(folder.at("none.csv"), "").unwrap();
    std::fs::write(folder.at("junk.safetensors"), "junk").unwrap();
    let (typo, wide, junk) = (folder.text("typo.toml"), folder.text("wide.toml"), folder.text("junk.safetensors"));
    let (head, none, out) = (folder.text("head.csv"), folder.text("none.csv"), folder.text("out"));
    let cases: &[(&[&str], i32, &[&str])] = &[
        (&["query", "--phi0", "4", "--phi1", "1", "--kappa0", "1", "--kappa1", "2"], 2, &["phi0 is 4", "below pi"]),
        (&["query", "--phi0", "2", "--phi1", "2", "--kappa0", "1", "--kappa1", "2"], 2, &["phi0 + phi1", "2 + 2"]),
        (&["query", "--phi0", "1", "--phi1", "1", "--kappa0", "inf", "--kappa1", "2"], 2, &["kappa0 is inf"]),
        (&["query", "--phi0", "40dg", "--phi1", "1", "--kappa0", "1", "--kappa1", "2"], 2, &["40dg", "40deg"]),
        (&["query", "--phi0", "1", "--phi1", "1", "--kappa0", "abc", "--kappa1", "2"], 2, &["abc", "--kappa0"]),
        (&["query", "--phi0", "1"], 2, &["--phi1", "--kappa1"]),
        (&["query", "--points", "-", "--phi0", "1"], 2, &["--points", "--phi0"]),
        (&["query", "--points", &head], 2, &["head.csv: line 1", "\"phi0,phi1,kappa0\"", "kappa1"]),
        (&["query", "--points", &none], 2, &["none.csv", "empty"]),
        (&["query", "--points", "missing.csv"], 2, &["missing.csv", "No such file"]),
        (&["generate", "missing.toml"], 2, &["missing.toml", "No such file"]),
        (&["generate", &typo, "--out", &out], 2, &["typo.toml", "line 9", "`kapa0`", "`kappa0`"]),
        (&["generate", &wide, "--out", &out, "--backend", "cpu"], 2, &["phi0 + phi1", "3.1", "below pi"]),
        (&["generate", &recipe, "--out", &recipe, "--backend", "cpu"], 2, &["recipe.toml", "File exists"]),
        (&["generate", &recipe, "--backend", "cuda"], 2, &["cuda", "cpu"]),
        (&["generate", &recipe, "--threads", "0"], 2, &["'0'", "--threads"]),
        (&["generate", &recipe, "--backend", "cpu", "--adapter", "llvmpipe"], 2, &["--adapter", "--backend cpu"]),
        (&["generate", &recipe, "--adapter", "no such adapter"], 2, &["GPU"]),
        (&["verify", &junk], 2, &["junk.safetensors"]),
        (&["verify", "missing.safetensors"], 2, &["missing.safetensors", "No such file"]),
        (&["info", &recipe], 2, &["recipe.toml"]),
        (&["render", &junk], 2, &["junk.safetensors"]),
        (&["curve", "--from", "0"], 2, &["\"0\" is not two finite numbers"]),
        (&["speak"], 2, &["speak"]),
        (&[], 2, &["Usage"]),
    ];
    for (args, code, parts) in cases {
        let said = run(*args);
        assert_eq!(said.code, Some(*code), "{args:?}: {} {}", said.out, said.err);
        assert!(parts.iter().all(|part| said.err.contains(part)), "{args:?}: {}", said.err);
        assert!(said.out.is_empty() && (args.is_empty() || said.err.contains("error: ")), "{args:?}: {} {}", said.out, said.err);
    }
    // All of this is found before anything is written.
    assert!(!folder.at("out").exists());
}

#[test]
fn two_pictures_of_one_name_are_refused() {
    let slice = &TINY[..TINY.rfind("[[atlas.picture]]").unwrap()];
    let second = TINY[TINY.find("[[atlas]]").unwrap()..].replace("\"tiny\"", "\"tiny-1\"");
    let folder = Folder::new(&format!("{TINY}{}", &second[..second.rfind("[[atlas.picture]]").unwrap()]));
    let said = run(["generate", &folder.text("recipe.toml"), "--out", &folder.text("out"), "--backend", "cpu"]);
    assert!(said.code == Some(2) && said.err.contains("tiny-1.png"), "{}", said.err);
    std::fs::write(folder.at("tiny.toml"), format!("{slice}{second}")).unwrap();
    let said = run(["generate", &folder.text("tiny.toml"), "--out", &folder.text("out"), "--backend", "cpu"]);
    assert!(said.code == Some(2) && said.err.contains("tiny.png"), "{}", said.err);
    assert!(!folder.at("out").exists());
}

/// Enough nodes with scalars for many seconds.
fn long() -> String {
    TINY.replace("count = 6", "count = 2000").replace("count = 5", "count = 1500")
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_no_file() {
    let folder = Folder::new(&long());
    let out = folder.at("out");
    for command in ["generate", "render"] {
        let mut child = program();
        child.args([command, &folder.text("recipe.toml"), "--backend", "cpu", "--out"]).arg(&out);
        child.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let child = child.spawn().unwrap();
        let started = Instant::now();
        // Something is being written: the handler of signals was set before.
        while !out.exists() || names(&out).is_empty() {
            assert!(started.elapsed() < Duration::from_secs(60), "it wrote nothing");
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap().success());
        let said: super::Said = child.wait_with_output().unwrap().into();
        assert_eq!(said.code, Some(130), "{} {}", said.out, said.err);
        assert!(said.err.contains("interrupted"), "{}", said.err);
        assert_eq!(names(&out), [""; 0]);
    }
}

/// A limit on the size of files stands for a disk that is full: both refuse to write on.
#[cfg(unix)]
#[test]
fn a_disk_that_takes_no_more_leaves_no_file() {
    let folder = Folder::new(&TINY.replace("count = 6", "count = 600"));
    let script = "ulimit -f \"$1\"; trap '' XFSZ; shift; exec \"$@\"";
    let run = |blocks: &str| -> super::Said {
        let mut shell = Command::new("sh");
        shell.args(["-c", script, "sh", blocks, env!("CARGO_BIN_EXE_spiral-atlas")]);
        shell.args(["generate", &folder.text("recipe.toml"), "--backend", "cpu", "--out", &folder.text("out")]);
        shell.output().unwrap().into()
    };
    let said = run("8");
    assert_eq!(said.code, Some(2), "{} {}", said.out, said.err);
    assert!(said.err.contains("tiny.atlas.safetensors: File too large"), "{}", said.err);
    assert_eq!(names(&folder.at("out")), [""; 0]);
    let said = run("unlimited");
    assert_eq!((said.code, names(&folder.at("out")).len()), (Some(0), 4), "{}", said.err);
}
