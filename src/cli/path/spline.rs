//! `path spline`.

use super::{Files, Outcome, PathReport, Paths, figure};
use serde::Deserialize;
use spiral_atlas::Result;
use spiral_atlas::path::spline;

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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    points: Vec<[f64; 2]>,
    #[serde(default)]
    closed: bool,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let input: Input = args.files.read()?;
    let found = spline(&input.points, input.closed).map_err(|e| args.files.blame(e))?;
    let kind = if input.closed { "Closed" } else { "Open" };
    let title = format!("{kind} spline through {} points", input.points.len());
    let paths = vec![PathReport::new(&found.spans)];
    args.files.finish(&Paths { paths }, || figure::curves(&[found.spans], &title))
}
