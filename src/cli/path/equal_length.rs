//! `path equal-length`.

use super::{Files, Outcome, figure};
use spiral_atlas::Result;
use spiral_atlas::plain::count;
use spiral_atlas::tools::{EqualLengths, Tool};

/// Join points and directions by paths of one given length, so that vehicles of one speed arrive at the same time.
///
/// Input: {"length": L, "paths": [{"start": [x, y], "end": [x, y], "start_direction": angle, "end_direction": angle},
/// ..]}.
///
/// Each path is the one of least absolute rotation of four; `paper` is the index of the one that the paper takes, of
/// its two.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas path equal-length examples/swarm.json --figure swarm.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
    /// Take the better of the paper's two solutions, not the best of four.
    #[arg(long)]
    paper: bool,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let asked: EqualLengths = args.files.read()?;
    let title = format!("{} of length {}", count(asked.paths.len(), "path"), asked.length);
    let asked = EqualLengths { paper: asked.paper || args.paper, ..asked };
    let found = asked.answer().map_err(|e| args.files.blame(e))?;
    args.files.finish(&found, || figure::reported(&found.paths, &title))
}
