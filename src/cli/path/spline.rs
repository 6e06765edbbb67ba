//! `path spline`.

use super::{Files, Outcome, figure};
use spiral_atlas::Result;
use spiral_atlas::plain::count;
use spiral_atlas::tools::{Through, Tool};

/// Lay a curve with continuous second derivative through points, open or closed.
///
/// Input: {"points": [[x, y], ..], "closed": false}.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
        echo '{\"points\": [[0, 0], [1, 1], [2, 0], [3, 1]]}' | spiral-atlas path spline - --figure spline.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let asked: Through = args.files.read()?;
    let kind = if asked.closed { "Closed" } else { "Open" };
    let title = format!("{kind} spline through {}", count(asked.points.len(), "point"));
    let found = asked.answer().map_err(|e| args.files.blame(e))?;
    args.files.finish(&found, || figure::reported(&found.paths, &title))
}
