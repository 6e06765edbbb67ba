//! `path separation`.

use super::{Files, Outcome, figure};
use crate::cli::numbers;
use spiral_atlas::Result;
use spiral_atlas::path::Verdict;
use spiral_atlas::plain::count;
use spiral_atlas::tools::{Separations, motions};

/// Prove whether vehicles keep a minimum distance at all times, and how near they come.
///
/// Input: {"paths": [{"pieces": [piece, ..], "speed": 1, "start_time": 0}, ..]}, as the other tools, `join` and `curve
/// --json` print it, or a line of JSON for each of several, as with --points; pieces are of all kinds but `involute`.
/// A field that no tool prints is refused. `verdict` is `kept`, `violated` or `undecided`: within rounding of the
/// minimum.
///
/// Before its start time a vehicle stands at its start, and once it has arrived at its end. The exit
/// status is 0 for `kept`, 1 for `violated` and `undecided`.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
        spiral-atlas path equal-length examples/swarm.json | spiral-atlas path separation - --minimum 0.03")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
    /// The distance to keep.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    minimum: f64,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let motions = motions(args.files.paths()?).map_err(|e| args.files.blame(e))?;
    let found = Separations::new(&motions, args.minimum)?;
    let pairs = count(found.pairs.len(), "pair");
    let title = format!("{} vehicles, {pairs}, least separation {:.6}", motions.len(), found.least());
    let done = args.files.finish(&found, || figure::separations(&motions, &found, title))?;
    Ok(if found.verdict == Verdict::Kept { done } else { Outcome::Bad })
}
