//! Files of paths: one JSON or TOML text, or lines of JSON as batches print them.

use super::super::output;
use super::input;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use spiral_atlas::path::Course;
use spiral_atlas::transition::Piece;
use spiral_atlas::{Error, Result};
use std::path::{Path, PathBuf};

/// Longest input in bytes: a million pieces have 200 MiB.
const MAX_INPUT: u64 = 1 << 28;
/// Most lines without a path that are named.
const NAMED: usize = 20;

/// A file of paths.
#[derive(clap::Args)]
pub(in super::super) struct Source {
    /// JSON file, TOML file named .toml, or `-` for JSON from standard input.
    input: PathBuf,
}

/// Given as all tools print them; other fields are left out of account.
#[derive(Deserialize)]
#[serde(bound = "P: DeserializeOwned")]
struct Given<P> {
    #[serde(deserialize_with = "input::objects")]
    paths: Vec<P>,
}

/// Which of the shapes of a batch a line has.
#[derive(Deserialize)]
struct Shape {
    paths: Option<IgnoredAny>,
    pieces: Option<IgnoredAny>,
    reason: Option<IgnoredAny>,
    error: Option<IgnoredAny>,
}

#[derive(Deserialize)]
struct GivenPath {
    #[serde(deserialize_with = "input::objects")]
    pieces: Vec<Piece>,
}

impl Source {
    /// What stands in the input.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Result<T> {
        let text = spiral_atlas::files::read_text(&self.input, MAX_INPUT)?;
        input::parse(&text, self.is_toml()).map_err(|e| self.blame(Error::invalid(e)))
    }

    /// The paths in the input, each with its place for messages. Of several lines that are objects each, which batches
    /// print, those without a path are left out and told on standard error.
    pub(crate) fn paths<P: DeserializeOwned>(&self) -> Result<Vec<(String, P)>> {
        let text = spiral_atlas::files::read_text(&self.input, MAX_INPUT)?;
        let wrong = |place: &str, what: String| self.blame(Error::invalid(format!("{place}{what}")));
        let lines: Vec<(usize, &str)> = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()).collect();
        let whole = |line: &str| serde_json::from_str::<Shape>(line).is_ok();
        if self.is_toml() || lines.len() < 2 || !whole(lines[0].1) {
            return one(&text, self.is_toml(), "").map_err(|what| wrong("", what));
        }
        let (mut paths, mut without) = (Vec::new(), Vec::new());
        for (number, line) in lines {
            let place = format!("line {number}: ");
            let found = one(line, false, &place).map_err(|what| wrong(&place, what))?;
            if found.is_empty() {
                without.push(number.to_string());
            }
            paths.extend(found);
        }
        if !without.is_empty() {
            let more =
                if without.len() > NAMED { format!(" and {} more", without.len() - NAMED) } else { String::new() };
            let (s, has) = if without.len() == 1 { ("", "has") } else { ("s", "have") };
            let named = without[..without.len().min(NAMED)].join(", ");
            output::note(&format!("line{s} {named}{more} of {} {has} no path; the reason stands there", self.name()));
        }
        Ok(paths)
    }

    /// The paths in the input, each with its place for messages.
    pub(crate) fn courses(&self) -> Result<Vec<(String, Course)>> {
        let course = |(place, path): (String, GivenPath)| match Course::new(path.pieces) {
            Ok(course) => Ok((place, course)),
            Err(e) => Err(self.blame(e.at(place))),
        };
        self.paths()?.into_iter().map(course).collect()
    }

    fn is_toml(&self) -> bool {
        output::has_extension(&self.input, "toml")
    }

    fn name(&self) -> String {
        if self.input == Path::new("-") { "standard input".into() } else { self.input.display().to_string() }
    }

    /// An error of what was read here.
    pub(crate) fn blame(&self, error: Error) -> Error {
        error.at(self.name())
    }
}

/// The paths of one text: several, one alone, or none with a reason or an error.
fn one<P: DeserializeOwned>(text: &str, toml: bool, place: &str) -> std::result::Result<Vec<(String, P)>, String> {
    match if toml { None } else { serde_json::from_str::<Shape>(text).ok() } {
        Some(Shape { paths: None, pieces: Some(_), .. }) => {
            Ok(vec![(format!("{place}the path"), input::parse(text, false)?)])
        }
        Some(Shape { paths: None, reason: Some(_), .. } | Shape { paths: None, error: Some(_), .. }) => Ok(Vec::new()),
        _ => {
            let Given { paths } = input::parse(text, toml)?;
            Ok((0..).zip(paths).map(|(i, path)| (format!("{place}paths[{i}]"), path)).collect())
        }
    }
}
