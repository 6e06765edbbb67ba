//! `path separation`.

use super::input::objects;
use super::{Files, Outcome, figure};
use crate::cli::numbers;
use serde::{Deserialize, Serialize};
use spiral_atlas::path::{Motion, Separation, Verdict, separations};
use spiral_atlas::plain::count;
use spiral_atlas::transition::Piece;
use spiral_atlas::{Error, Result};

/// Prove whether vehicles keep a minimum distance at all times, and tell how near they come.
///
/// Input: {"paths": [{"pieces": [piece, ..], "speed": 1, "start_time": 0}, ..]}, as the other tools, `join` and `curve
/// --json` print it, or a line of JSON for each of several, as with --points; pieces are of all kinds but `involute`,
/// and other fields are left out of account. `verdict` is `kept`, `violated` or
/// `undecided`: within rounding of the minimum.
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

#[derive(Deserialize)]
struct Path {
    #[serde(deserialize_with = "objects")]
    pieces: Vec<Piece>,
    #[serde(default = "one")]
    speed: f64,
    #[serde(default)]
    start_time: f64,
}

fn one() -> f64 {
    1.0
}

#[derive(Serialize)]
struct Output {
    minimum: f64,
    /// Of all pairs: the worst.
    verdict: Verdict,
    pairs: Vec<Pair>,
}

#[derive(Serialize)]
struct Pair {
    first: usize,
    second: usize,
    #[serde(flatten)]
    found: Separation,
}

fn motion(path: Path) -> Result<Motion> {
    Motion::new(path.pieces, path.speed, path.start_time)
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let paths: Vec<(String, Path)> = args.files.paths()?;
    let blame = |e| args.files.blame(e);
    if paths.len() < 2 {
        return Err(blame(Error::invalid(format!(
            "`paths` has {}; it takes two to be apart",
            count(paths.len(), "path")
        ))));
    }
    let named = |(place, path): (String, Path)| motion(path).map_err(|e| blame(e.at(place)));
    let motions = paths.into_iter().map(named).collect::<Result<Vec<_>>>()?;
    let found = separations(&motions, args.minimum)?;
    let worst = |verdict| found.iter().any(|(_, _, f)| f.verdict == verdict);
    let verdict = [Verdict::Violated, Verdict::Undecided].into_iter().find(|v| worst(*v)).unwrap_or(Verdict::Kept);
    let pairs =
        found.iter().map(|(first, second, found)| Pair { first: *first, second: *second, found: *found }).collect();
    let output = Output { minimum: args.minimum, verdict, pairs };
    let least = found.iter().map(|(_, _, f)| f.closest.at_most).fold(f64::INFINITY, f64::min);
    let title = format!("{} vehicles, {}, least separation {least:.6}", motions.len(), count(found.len(), "pair"));
    let done = args.files.finish(&output, || figure::separations(&motions, &found, args.minimum, title))?;
    Ok(if verdict == Verdict::Kept { done } else { Outcome::Bad })
}
