//! What goes wrong is said, with the value, and leaves nothing behind.

use super::{Folder, TINY, fine, names, program, run};
use std::io::Write;
use std::process::{Child, Command, Stdio};
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
    std::fs::create_dir(folder.at("store.zarr")).unwrap();
    std::fs::write(folder.at("store.zarr/zarr.json"), "{}").unwrap();
    let store = folder.text("store.zarr");
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
        (&["generate", &recipe, "--out", &recipe, "--backend", "cpu"], 2, &["recipe.toml is a file", "another name"]),
        (&["generate", &recipe, "--backend", "cuda"], 2, &["cuda", "cpu"]),
        (&["generate", &recipe, "--threads", "0"], 2, &["'0'", "--threads"]),
        (
            &["generate", &recipe, "--backend", "cpu", "--adapter", "llvmpipe"],
            2,
            &["--adapter", "--backend cpu", "Usage: spiral-atlas generate"],
        ),
        (&["generate", &recipe, "--adapter", "no such adapter"], 2, &["GPU"]),
        (&["verify", &junk], 2, &["junk.safetensors"]),
        (&["verify", "missing.safetensors"], 2, &["missing.safetensors", "No such file"]),
        (&["info", &recipe], 2, &["recipe.toml"]),
        (&["render", &junk], 2, &["junk.safetensors"]),
        (&["curve", "cubic", "--from", "0"], 2, &["\"0\" is not two finite numbers", "Usage: spiral-atlas curve"]),
        (&["path", "hermite"], 2, &["Usage: spiral-atlas path hermite"]),
        (
            &["curve", "cubic", "--form", "0,0"],
            2,
            &["a similar argument exists: '--from'", "Usage: spiral-atlas curve", "'spiral-atlas curve cubic --help'"],
        ),
        (
            &["path", "hermite", "--figur", "a.png"],
            2,
            &["'--figur'", "'--figure'", "Usage: spiral-atlas path hermite", "try 'spiral-atlas path hermite --help'"],
        ),
        (
            &["curve", "cubic", "--start-direction", "40%"],
            2,
            &["--start-direction", "`40deg` or `40°`", "try 'spiral-atlas curve cubic --help'"],
        ),
        (&["--famly"], 2, &["'--famly'", "Usage: spiral-atlas <COMMAND>", "try 'spiral-atlas --help'"]),
        (&["info", &folder.text("")], 2, &["not an ordinary file"]),
        (&["info", &store], 2, &["store.zarr: it is a Zarr store; `spiral-atlas-cluster` reads it"]),
        (&["generate", &folder.text("")], 2, &["it is a folder"]),
        (
            &["generate", &recipe, "--out", &folder.text("recipe.toml/out")],
            2,
            &["recipe.toml/out", "a part of this path is a file"],
        ),
        (&["speak"], 2, &["speak"]),
        (&[], 2, &["Usage"]),
    ];
    for (args, code, parts) in cases {
        let said = run(*args);
        assert_eq!(said.code, Some(*code), "{args:?}: {} {}", said.out, said.err);
        assert!(parts.iter().all(|part| said.err.contains(part)), "{args:?}: {}", said.err);
        assert!(
            said.out.is_empty() && (args.is_empty() || said.err.contains("error: ")),
            "{args:?}: {} {}",
            said.out,
            said.err
        );
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
    assert!(
        said.err.contains("tiny.atlas.safetensors: the file would be larger than the system allows"),
        "{}",
        said.err
    );
    assert_eq!(names(&folder.at("out")), [""; 0]);
    let said = run("unlimited");
    assert_eq!((said.code, names(&folder.at("out")).len()), (Some(0), 4), "{}", said.err);
}

/// Starts a run that writes for many seconds, and waits until it writes.
fn writing(folder: &Folder) -> Child {
    let mut child = program();
    child.args(["generate", &folder.text("recipe.toml"), "--backend", "cpu", "--out", &folder.text("out")]);
    let child = child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let started = Instant::now();
    while drafts(folder).is_empty() {
        assert!(started.elapsed() < Duration::from_secs(60), "it wrote nothing");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

fn drafts(folder: &Folder) -> Vec<String> {
    let out = folder.at("out");
    if out.exists() { names(&out).into_iter().filter(|name| name.ends_with(".part")).collect() } else { Vec::new() }
}

#[cfg(unix)]
#[test]
fn the_next_run_removes_what_a_killed_run_left_but_not_what_a_live_one_writes() {
    let folder = Folder::new(&long());
    std::fs::write(folder.at("small.toml"), TINY.replace("\"tiny\"", "\"small\"")).unwrap();
    let small = || fine(["generate", &folder.text("small.toml"), "--backend", "cpu", "--out", &folder.text("out")]);
    let mut killed = writing(&folder);
    killed.kill().unwrap();
    killed.wait().unwrap();
    let left = drafts(&folder);
    assert_eq!(left.len(), 1, "a killed program cannot clean up");

    // The live run removes it as it starts; the small one leaves the file of the live run alone.
    let mut live = writing(&folder);
    let started = Instant::now();
    while drafts(&folder).contains(&left[0]) {
        assert!(started.elapsed() < Duration::from_secs(60), "the file of the killed run is still there");
        std::thread::sleep(Duration::from_millis(5));
    }
    small();
    let living = drafts(&folder);
    assert!(living.len() == 1 && living != left, "{living:?} {left:?}");
    assert!(live.try_wait().unwrap().is_none(), "the long run was too short for this test");
    live.kill().unwrap();
    live.wait().unwrap();
    small();
    assert_eq!(drafts(&folder), [""; 0]);
    assert!(folder.at("out/small.atlas.safetensors").exists());
}

#[test]
fn what_no_disk_can_hold_is_refused_at_the_start_with_sizes() {
    let counts = [("count = 6", "100000"), ("count = 5", "100000"), ("count = 3", "800")];
    let huge = counts.iter().fold(TINY.to_owned(), |text, (count, n)| text.replace(count, &format!("count = {n}")));
    let folder = Folder::new(&huge);
    for command in ["generate", "render"] {
        let said = run([command, &folder.text("recipe.toml"), "--backend", "cpu", "--out", &folder.text("out")]);
        assert_eq!(said.code, Some(2), "{} {}", said.out, said.err);
        // 1.6e13 nodes of two bytes and two numbers.
        for part in ["the atlas `tiny` would take 145.52 TiB", &folder.text("out"), "free;", "fewer nodes"] {
            assert!(said.err.contains(part), "{part}: {}", said.err);
        }
        assert!(!folder.at("out").exists());
    }
}

/// A disk in memory, where this user may make one: the same run fits or not by its size alone.
#[cfg(target_os = "linux")]
#[test]
fn a_small_disk_refuses_an_atlas_that_does_not_fit() {
    let folder = Folder::new(&TINY.replace("count = 6", "count = 2000").replace("count = 5", "count = 60"));
    let disk = folder.at("disk");
    std::fs::create_dir(&disk).unwrap();
    let mount = |size: &str| {
        let done =
            Command::new("mount").args(["-t", "tmpfs", "-o", &format!("size={size}"), "tmpfs"]).arg(&disk).output();
        done.is_ok_and(|done| done.status.success())
    };
    let generate = || run(["generate", &folder.text("recipe.toml"), "--backend", "cpu", "--out", &folder.text("disk")]);
    // 720,000 nodes of ten bytes each are 6.9 MiB.
    for (size, fits) in [("4m", false), ("16m", true)] {
        if !mount(size) {
            eprintln!("this user may not mount a disk; the sizes were tested without one");
            return;
        }
        let said = generate();
        let there = names(&disk);
        assert!(Command::new("umount").arg(&disk).status().unwrap().success());
        assert_eq!(said.code, Some(if fits { 0 } else { 2 }), "{}", said.err);
        assert!(
            fits || said.err.contains("would take 6.9 MiB") && said.err.contains("has 4.0 MiB free"),
            "{}",
            said.err
        );
        assert_eq!(there.len(), if fits { 4 } else { 0 }, "{there:?}");
    }
}

#[cfg(unix)]
#[test]
fn endless_input_is_left_and_pipes_are_read() {
    let cases: [(&[&str], &str); 3] = [
        (&["generate", "/dev/zero"], "longer than 1.0 MiB"),
        (&["path", "plan", "/dev/zero"], "longer than 256.0 MiB"),
        (&["query", "--points", "/dev/zero"], "no end within 64.0 MiB"),
    ];
    for (args, part) in cases {
        let said = run(args);
        assert!(
            said.code == Some(2) && said.err.contains("/dev/zero") && said.err.contains(part),
            "{args:?}: {}",
            said.err
        );
    }
    let folder = Folder::new(TINY);
    let mut child = program();
    child.args(["generate", "/dev/stdin", "--backend", "cpu", "--out", &folder.text("out")]);
    let mut child = child.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(TINY.as_bytes()).unwrap();
    assert!(child.wait_with_output().unwrap().status.success());
    assert!(folder.at("out/tiny.atlas.safetensors").exists());
}

/// Found before the work, whichever file it is.
#[cfg(unix)]
#[test]
fn a_folder_or_a_dead_link_in_place_of_a_file_is_told_at_the_start() {
    let folder = Folder::new(TINY);
    for name in ["tiny.atlas.safetensors", "tiny.report.json", "tiny-2.png"] {
        let place = folder.at("out").join(name);
        std::fs::create_dir_all(&place).unwrap();
        let generate =
            || run(["generate", &folder.text("recipe.toml"), "--backend", "cpu", "--out", &folder.text("out")]);
        let said = generate();
        assert!(said.code == Some(2) && said.err.contains(name) && said.err.contains("it is a folder"), "{}", said.err);
        std::fs::remove_dir(&place).unwrap();
        std::os::unix::fs::symlink("nowhere", &place).unwrap();
        let said = generate();
        assert!(said.code == Some(2) && said.err.contains(name) && said.err.contains("symbolic link"), "{}", said.err);
        std::fs::remove_file(&place).unwrap();
        assert_eq!(names(&folder.at("out")), [""; 0]);
    }
}

#[test]
fn mistakes_in_toml_are_named() {
    let folder = Folder::new("");
    let says = |tool: &str, text: &str, part: &str| {
        std::fs::write(folder.at("ends.toml"), text).unwrap();
        let said = run(["path", tool, &folder.text("ends.toml")]);
        assert!(said.code == Some(2) && said.err.contains(&format!("ends.toml: {part}")), "{}", said.err);
    };
    let ends = "end = [1, 0]\nstart_derivative = [1, 1]\nend_derivative = [1, -1]";
    says("hermite", &format!("start = [0, 0, 1]\n{ends}"), "start has more values than belong there: 3");
    says("hermite", &format!("start = [0, \"a\"]\n{ends}"), "start[1] must be a number; it is the text \"a\"");
    says("hermite", ends, "the field `start` is missing");
    says(
        "equal-length",
        "length = 2\n[[paths]]\nstart = [0, 0]\nend = 1",
        "paths[0].end must be a pair of numbers [x, y]; it is `1`",
    );
    says("equal-length", "length = 2\npaths = [[1]]", "paths[0] must be an object with the fields start, end");
    says(
        "equal-length",
        "length = 2\npaths = [{ start_direction = true }]",
        "paths[0].start_direction must be an angle, a number",
    );
    says("hermite", "a = ", "it is not TOML (line 1, column 5): a value is missing");
    let deep = format!("a={}", "[".repeat(100_000));
    says("hermite", &deep, "it is not TOML (line 1, column 83): lists are in each other too deep\n");
    std::fs::write(folder.at("ends.toml"), format!("start = [0, 0]\n{ends}")).unwrap();
    fine(["path", "hermite", &folder.text("ends.toml")]);
}

/// Texts that a reader could take for degrees, numbers that no double holds, and what the program says of each.
#[test]
fn angles_and_curves_beyond_their_range_are_told() {
    let ends = |direction: &str, more: &[&str]| {
        let given = ["curve", "involute", "--from", "0,0", "--to", "2,0", "--end-direction", "1"];
        let rest = ["--start-curvature=-0.3", "--end-curvature", "4", "--start-direction", direction];
        run(given.iter().chain(&rest).chain(more))
    };
    let said = ends("-40", &[]);
    assert!(said.code == Some(2) && said.err.contains("say which unit is meant: `-40deg` or `-40rad`"), "{}", said.err);
    assert_eq!(ends("-40deg", &[]).code, ends("320°", &[]).code);
    assert_ne!(ends("-40rad", &[]).code, Some(2));
    assert_ne!(ends("6.283", &[]).code, Some(2));
    let query = run(["query", "--phi0", "40", "--phi1", "1", "--kappa0", "1", "--kappa1", "2"]);
    assert!(query.code == Some(2) && query.err.contains("`40deg` or `40rad`"), "{}", query.err);
    for more in [&["reach-cubic", "--base", "line", "--q", "1.9"][..], &["trig-quintic", "--template", "s"]] {
        let far = [
            "--from",
            "1e308,0",
            "--start-direction",
            "0",
            "--turn",
            "left",
            "--radius",
            "1e308",
            "--angle",
            "45deg",
            "--m",
            "0.8",
        ];
        let said = run(["curve"].iter().chain(more).chain(&far));
        assert!(
            said.code == Some(2) && said.err.contains("leaves the range of doubles; change the unit"),
            "{}",
            said.err
        );
        assert!(!said.err.contains("NaN") && !said.err.contains("inf"), "{}", said.err);
    }
}

/// A million samples are printed as they come: all of the text would be some 160 MB, and its parts in memory several
/// times that.
#[cfg(target_os = "linux")]
#[test]
fn many_samples_take_little_memory() {
    let curve = "curve cubic --from 0,0 --to 200,0 --start-direction=-40deg --end-direction 80deg \
                 --start-curvature 0.004 --end-curvature 0.04";
    for form in ["--json", "--csv", ""] {
        let limited = format!(
            "ulimit -v 200000 && exec {} {curve} --samples 1000000 {form} | wc -l",
            env!("CARGO_BIN_EXE_spiral-atlas")
        );
        let said: super::Said = Command::new("sh").args(["-c", &limited]).output().unwrap().into();
        assert!(
            said.err.is_empty() && said.out.trim().parse::<u32>().unwrap() > 1_000_000,
            "{form}: {} {}",
            said.out,
            said.err
        );
    }
}
