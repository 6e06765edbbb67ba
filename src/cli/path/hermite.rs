//! `path hermite`.

use super::{Files, Outcome, figure};
use spiral_atlas::Result;
use spiral_atlas::curve::Hermite;
use spiral_atlas::tools::Tool;

/// Join two points with given derivatives: the curve of least absolute rotation of the four there are.
///
/// Input: {"start": [x, y], "end": [x, y], "start_derivative": [x, y], "end_derivative": [x, y]}.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
      echo '{\"start\": [0, 0], \"end\": [1, 0], \"start_derivative\": [1, 1], \"end_derivative\": [1, -1]}' |\n      \
        spiral-atlas path hermite - --figure hermite.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let ends: Hermite = args.files.read()?;
    let found = ends.answer().map_err(|e| args.files.blame(e))?;
    args.files.finish(&found, || figure::choice(&found.choice))
}
