//! `path`: path planning with Pythagorean-hodograph quintics. JSON in, JSON out, and a picture.

mod equal_length;
pub(super) mod figure;
mod hermite;
mod least_curvature;
mod measure;
mod plan;
pub(super) mod read;
mod separation;
mod source;
mod spline;

use super::{Outcome, output};
use serde::Serialize;
use serde::de::DeserializeOwned;
pub(super) use source::Source;
use spiral_atlas::path::Course;
use spiral_atlas::plot::Drawing;
use spiral_atlas::tools::{self, NoPath};
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

/// Plan paths of Pythagorean-hodograph quintics: through ends, through points, of equal length,
/// among obstacles, and apart from each other.
///
/// Each tool reads JSON or TOML from a file, or JSON from standard input for `-`, and prints JSON. What the others
/// print has `paths`, which `separation` and `measure` read, and so they read what `curve NAME --json` and `join`
/// print, also with --points. Any unit of length; angles are radians, or degrees when written like "40deg".
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
        spiral-atlas path equal-length examples/swarm.json --figure swarm.png |\n      \
        spiral-atlas path separation - --minimum 0.03")]
pub(super) struct Args {
    #[command(subcommand)]
    tool: Tool,
}

#[derive(clap::Subcommand)]
enum Tool {
    Hermite(hermite::Args),
    EqualLength(equal_length::Args),
    LeastCurvature(least_curvature::Args),
    Spline(spline::Args),
    Plan(plan::Args),
    Separation(separation::Args),
    Measure(measure::Args),
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    match &args.tool {
        Tool::Hermite(args) => hermite::run(args),
        Tool::EqualLength(args) => equal_length::run(args),
        Tool::LeastCurvature(args) => least_curvature::run(args),
        Tool::Spline(args) => spline::run(args),
        Tool::Plan(args) => plan::run(args),
        Tool::Separation(args) => separation::run(args),
        Tool::Measure(args) => measure::run(args),
    }
}

/// What a tool works on and where it draws.
#[derive(clap::Args)]
struct Files {
    #[command(flatten)]
    source: Source,
    /// Draw what was found.
    #[arg(long, value_name = "FILE.png|svg")]
    figure: Option<PathBuf>,
}

impl Files {
    /// Before any work, whether the figure can be where it is to go.
    fn check_figure(&self) -> Result<()> {
        output::check_figure(self.figure.as_deref())?;
        output::not_over(self.figure.as_deref(), self.source.input())
    }

    /// What stands in the input.
    fn read<T: DeserializeOwned>(&self) -> Result<T> {
        self.check_figure()?;
        self.source.read()
    }

    /// The paths in the input, each with its place for messages.
    fn paths<P: DeserializeOwned>(&self) -> Result<Vec<(String, P)>> {
        self.check_figure()?;
        self.source.paths()
    }

    /// The same, ready to be measured.
    fn courses(&self) -> Result<Vec<(String, Course)>> {
        self.check_figure()?;
        self.source.courses()
    }

    /// An error of what was read here.
    fn blame(&self, error: Error) -> Error {
        self.source.blame(error)
    }

    /// Draws, if asked to, and prints.
    fn finish(&self, found: &impl Serialize, figure: impl FnOnce() -> Result<Drawing>) -> Result<Outcome> {
        output::print_json(found)?;
        self.draw(figure)
    }

    /// Draws, if asked to.
    fn draw(&self, figure: impl FnOnce() -> Result<Drawing>) -> Result<Outcome> {
        if let Some(path) = &self.figure {
            let drawing = figure().map_err(|e| Error::invalid(format!("{} was not drawn: {e}", path.display())))?;
            output::write_figure(path, &drawing)?;
        }
        Ok(Outcome::Fine)
    }
}

/// The answer to a request; where there is no path, that is printed with the reason, and nothing is left to do.
fn answer<T: tools::Tool>(request: T, files: &Files) -> Result<std::result::Result<T::Answer, Outcome>> {
    match request.answer() {
        Ok(found) => Ok(Ok(found)),
        Err(Error::NoPath(reason)) => output::print_json(&NoPath::new(reason)).map(|()| Err(Outcome::Bad)),
        Err(e) => Err(files.blame(e)),
    }
}
