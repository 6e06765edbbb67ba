//! Files of paths: one JSON or TOML text, or lines of JSON as batches print them.

use super::super::output;
use super::read;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use spiral_atlas::path::Course;
use spiral_atlas::tools::GivenPath;
use spiral_atlas::tools::input::objects;
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

/// Given as all tools print them; what reports have beside the paths is left out of account.
#[derive(Deserialize)]
#[serde(bound = "P: DeserializeOwned")]
struct Given<P> {
    #[serde(deserialize_with = "objects")]
    paths: Vec<P>,
}

/// The keys of a line of a batch, which say what it is.
#[derive(Deserialize)]
struct BatchLine {
    paths: Option<Vec<IgnoredAny>>,
    pieces: Option<IgnoredAny>,
    #[serde(alias = "error")]
    reason: Option<String>,
}

impl Source {
    /// What stands in the input.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Result<T> {
        let text = spiral_atlas::files::read_text(&self.input, MAX_INPUT)?;
        read::parse(&text, self.is_toml()).map_err(|e| self.blame(Error::invalid(e)))
    }

    /// The paths in the input, each with its place for messages. Of several lines that are objects each, which batches
    /// print, those without a path are left out and told on standard error.
    ///
    /// # Errors
    /// [`Error::NoPath`] with the reason, where the input is the answer that there is none.
    pub(crate) fn paths<P: DeserializeOwned>(&self) -> Result<Vec<(String, P)>> {
        let text = spiral_atlas::files::read_text(&self.input, MAX_INPUT)?;
        let wrong = |place: &str, what: String| self.blame(Error::invalid(format!("{place}{what}")));
        let lines: Vec<(usize, &str)> = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()).collect();
        let whole = |line: &str| serde_json::from_str::<BatchLine>(line).is_ok();
        if self.is_toml() || lines.len() < 2 || !whole(lines[0].1) {
            return match one(&text, self.is_toml(), "").map_err(|what| wrong("", what))? {
                Read::Paths(paths) => Ok(paths),
                Read::None(reason) => Err(Error::NoPath(format!("{} has no path: {reason}", self.name()))),
            };
        }
        let (mut paths, mut without) = (Vec::new(), Vec::new());
        for (number, line) in lines {
            let place = format!("line {number}: ");
            match one(line, false, &place).map_err(|what| wrong(&place, what))? {
                Read::Paths(found) => paths.extend(found),
                Read::None(_) => without.push(number.to_string()),
            }
        }
        if !without.is_empty() {
            let more =
                if without.len() > NAMED { format!(" and {} more", without.len() - NAMED) } else { String::new() };
            let (s, has) = if without.len() == 1 { ("", "has") } else { ("s", "have") };
            let named = without[..without.len().min(NAMED)].join(", ");
            let what = format!("line{s} {named}{more} of {} {has} no path; the reason stands there", self.name());
            if paths.is_empty() {
                return Err(Error::NoPath(what));
            }
            output::note(&what);
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

    /// Where it stands.
    pub(crate) fn input(&self) -> &Path {
        &self.input
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

/// What one text has: paths with their places, or the reason why there is none.
enum Read<P> {
    Paths(Vec<(String, P)>),
    None(String),
}

/// The paths of one text: several, one alone, or none with a reason or an error.
fn one<P: DeserializeOwned>(text: &str, toml: bool, place: &str) -> std::result::Result<Read<P>, String> {
    match if toml { None } else { serde_json::from_str::<BatchLine>(text).ok() } {
        Some(BatchLine { paths: None, pieces: Some(_), .. }) => {
            Ok(Read::Paths(vec![(format!("{place}the path"), read::parse(text, false)?)]))
        }
        Some(BatchLine { paths, reason: Some(reason), .. }) if paths.as_ref().is_none_or(Vec::is_empty) => {
            Ok(Read::None(reason))
        }
        _ => {
            let Given { paths } = read::parse(text, toml)?;
            Ok(Read::Paths((0..).zip(paths).map(|(i, path)| (format!("{place}paths[{i}]"), path)).collect()))
        }
    }
}
