//! What users are to type by the pages works, and the figures they show are what it draws.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn pages() -> Vec<PathBuf> {
    let docs = std::fs::read_dir(Path::new(ROOT).join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = docs.filter(|path| path.extension().is_some_and(|e| e == "md"));
    [Path::new(ROOT).join("README.md")].into_iter().chain(pages).collect()
}

/// A line of shell: what `printf` writes in front, the arguments of each command, whose output the next one reads, and
/// the exit status of the last: 0, or 1 where the page says so in a comment that begins with `exit 1`.
type Line = (String, Vec<Vec<String>>, i32);

/// Every line of `query`, `curve`, `join`, `path` and `export` in the shell blocks of a page; `generate` is the
/// business of `shipped.rs`.
fn commands(text: &str) -> Vec<Line> {
    let blocks = text.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let lines = blocks.flat_map(|block| block.replace("\\\n", " ").lines().map(str::to_owned).collect::<Vec<_>>());
    let arguments = lines.filter_map(|line| {
        let one = |command: &str| {
            let rest =
                command.strip_prefix("cargo run --release -- ").or_else(|| command.strip_prefix("spiral-atlas "))?;
            Some(rest.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
        };
        let (command, comment) = line.split_once(" #").unwrap_or((&line, ""));
        let (written, command) = match command.strip_prefix("printf '").and_then(|rest| rest.split_once("' | ")) {
            Some((text, rest)) => (text.replace("\\n", "\n"), rest),
            None => (String::new(), command),
        };
        let commands = command.split(" | ").map(|command| one(command.trim())).collect::<Option<Vec<_>>>()?;
        Some((written, commands, i32::from(comment.trim_start().starts_with("exit 1"))))
    });
    arguments
        .filter(|(_, line, _)| ["query", "curve", "join", "path", "export"].contains(&line[0][0].as_str()))
        .collect()
}

/// Runs a line in a folder.
fn run((written, line, status): &Line, folder: &Path) {
    let mut read = written.clone().into_bytes();
    for (i, arguments) in line.iter().enumerate() {
        let mut command = Command::new(env!("CARGO_BIN_EXE_spiral-atlas"));
        command.current_dir(folder).args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // It need not read.
        let _ = child.stdin.take().unwrap().write_all(&read);
        let done = child.wait_with_output().unwrap();
        let expected = if i + 1 == line.len() { *status } else { 0 };
        assert_eq!(done.status.code(), Some(expected), "{arguments:?}: {}", String::from_utf8_lossy(&done.stderr));
        read = done.stdout;
    }
}

/// The share of pixels that differ clearly. Libraries of mathematics may differ in a last bit, and so may a pixel of a
/// curve's rim.
fn difference(a: &[u8], b: &[u8]) -> f64 {
    let [a, b] = [a, b].map(|png| image::load_from_memory(png).unwrap().to_rgb8());
    if a.dimensions() != b.dimensions() {
        return 1.0;
    }
    let differ =
        a.pixels().zip(b.pixels()).filter(|(p, q)| p.0.iter().zip(q.0).any(|(x, y)| x.abs_diff(y) > 64)).count();
    differ as f64 / a.pixels().len() as f64
}

#[test]
fn commands_work_and_draw_the_figures() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("docs/figures")).unwrap();
    std::fs::create_dir(folder.path().join("examples")).unwrap();
    for example in std::fs::read_dir(Path::new(ROOT).join("examples")).unwrap().map(|entry| entry.unwrap()) {
        std::fs::copy(example.path(), folder.path().join("examples").join(example.file_name())).unwrap();
    }
    let mut lines = 0;
    for page in pages() {
        for line in commands(&std::fs::read_to_string(&page).unwrap()) {
            run(&line, folder.path());
            lines += 1;
        }
    }
    assert!(lines > 15, "{lines}");
    let (mut figures, mut stale) = (Vec::new(), Vec::new());
    for entry in std::fs::read_dir(Path::new(ROOT).join("docs/figures")).unwrap() {
        let committed = entry.unwrap().path();
        let made = folder.path().join("docs/figures").join(committed.file_name().unwrap());
        assert!(made.exists(), "no page has a command that draws {}", committed.display());
        let name = committed.file_name().unwrap().to_owned();
        let [committed, made] = [committed, made].map(|path| std::fs::read(path).unwrap());
        if difference(&committed, &made) >= 1e-3 {
            std::fs::write(Path::new(env!("CARGO_TARGET_TMPDIR")).join(&name), &made).unwrap();
            stale.push(name);
        }
        figures.push(committed);
    }
    assert!(stale.is_empty(), "{stale:?} are not up to date; fresh ones are in {}", env!("CARGO_TARGET_TMPDIR"));
    assert!(figures.len() > 5 && figures.windows(2).all(|w| difference(&w[0], &w[1]) > 5e-3));
}

/// README lists the commands of `--help`.
#[test]
fn readme_has_all_commands() {
    let help = Command::new(env!("CARGO_BIN_EXE_spiral-atlas")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let text = std::fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap();
    let row = |name: &str| [format!("| `{name}`"), format!("| `{name} ")].iter().any(|start| text.contains(start));
    let missing: Vec<&&str> = names.iter().filter(|name| **name != "help" && !row(name)).collect();
    assert!(names.len() > 10 && missing.is_empty(), "README's table of commands lacks {missing:?}");
}

/// The pages of the families explain every flag.
#[test]
fn pages_have_all_flags() {
    let written = pages().into_iter().filter(|page| !page.ends_with("recipes.md"));
    let text: String = written.map(|page| std::fs::read_to_string(page).unwrap()).collect();
    for about in spiral_atlas::family::all().iter().map(|family| family.about()) {
        // docs/reach.md explains those of both cases at once.
        let name = |flag: &'static str| flag.split_once("CASE").map_or(flag, |(_, rest)| &rest[2..]);
        let explained = |flag: &str| text.contains(&format!("| `{flag}` |"));
        let missing: Vec<&str> = about.flags.iter().map(|f| name(f.name)).filter(|flag| !explained(flag)).collect();
        assert!(missing.is_empty(), "no page of `{}` has a row of {missing:?}", about.name);
    }
}

#[test]
fn links_lead_to_files() {
    let mut links = 0;
    for page in pages() {
        let text = std::fs::read_to_string(&page).unwrap();
        for rest in text.split("](").skip(1) {
            let target = rest.split([')', '#']).next().unwrap();
            if !target.starts_with("http") && !target.is_empty() {
                assert!(page.parent().unwrap().join(target).exists(), "{}: {target}", page.display());
                links += 1;
            }
        }
    }
    assert!(links > 15, "{links}");
}

#[test]
fn commands_are_found() {
    let text = "```sh\ncargo run --release -- query --a 1 \\\n    --b 2  # exit 1: no\nls\nspiral-atlas generate \
                x\n```\nspiral-atlas query\n";
    let words = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(commands(text), [(String::new(), vec![words("query --a 1 --b 2")], 1)]);
    let text = "```sh\nspiral-atlas path a | spiral-atlas path b -\nspiral-atlas path a | less\n```\n";
    assert_eq!(commands(text), [(String::new(), vec![words("path a"), words("path b -")], 0)]);
    let text = "```sh\nprintf 'a,b\\n1,2\\n' | \\\n    spiral-atlas query --points -\n```\n";
    assert_eq!(commands(text), [("a,b\n1,2\n".into(), vec![words("query --points -")], 0)]);
}
