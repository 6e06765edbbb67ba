//! The program, run as a user runs it.
#![cfg(feature = "cli")]

#[cfg(feature = "gpu")]
#[path = "../adapters/mod.rs"]
mod adapters;
mod answers;
mod cells;
mod curve_output;
mod curves;
mod export;
mod failures;
mod files;
#[cfg(feature = "gpu")]
mod gpu;
mod join;
mod path;
mod path_mistakes;
mod questions;
mod snapshots;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Four different axis lengths, all kinds of spacing, two scalars, both kinds of picture.
const TINY: &str = r#"
family = "cubic"
fields = ["margin", "f0"]
[[atlas]]
name = "tiny"
[atlas.axes]
phi0 = { values = ["20deg", 0.7] }
phi1 = { linear = [0.9, 1.4], count = 3 }
kappa0 = { linear = [0.1, 0.6], count = 6 }
kappa1 = { log = [1, 16], count = 5 }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = 1.4 }
mark = [{ kappa0 = 0.4, kappa1 = 4, label = "example 1" }]
[[atlas.picture]]
kind = "multiples"
x = "kappa0"
y = "kappa1"
"#;
const TINY_NODES: usize = 2 * 3 * 6 * 5;

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_spiral-atlas"))
}

/// What a run said, and its exit code.
struct Said {
    code: Option<i32>,
    out: String,
    err: String,
}

impl From<Output> for Said {
    fn from(output: Output) -> Said {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Said { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

impl Said {
    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap_or_else(|e| panic!("{e}: {} {}", self.out, self.err))
    }
}

fn run<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Said {
    program().args(args).output().unwrap().into()
}

/// Runs it and expects success.
fn fine<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Said {
    let said = run(args);
    assert_eq!(said.code, Some(0), "{}\n{}", said.out, said.err);
    said
}

/// A folder with a recipe in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new(recipe: &str) -> Folder {
        let folder = Folder(tempfile::tempdir().unwrap());
        std::fs::write(folder.at("recipe.toml"), recipe).unwrap();
        folder
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        self.at(name).to_str().unwrap().to_owned()
    }

    /// Generates the recipe on the CPU into the folder `out`.
    fn generate(&self, more: &[&str]) -> Said {
        let (recipe, out) = (self.text("recipe.toml"), self.text("out"));
        fine(["generate", &recipe, "--out", &out, "--backend", "cpu"].iter().chain(more))
    }
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
