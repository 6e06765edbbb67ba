//! `path least-curvature`.

use super::input::angle;
use super::{Files, Outcome, PathReport, figure, found};
use serde::{Deserialize, Serialize};
use spiral_atlas::path::{Directions, Free, least_curvature};
use spiral_atlas::plain::name;
use spiral_atlas::{Error, Result};

/// Join two points with given directions by the path whose greatest curvature is least.
///
/// Input: {"start": [x, y], "end": [x, y], "start_direction": angle, "end_direction": angle, "free": "length",
/// "greatest_length": L}.
///
/// `free` is what is varied: `length`, of paths whose end derivatives are of one length, or `derivatives`, the length
/// of each. Without `greatest_length` the path is at most twice as long as the distance of the ends. No searched path
/// bends less than `at_least`: that is proved.
///
/// The exit status is 0 with a path. It is 1 when no searched path is short enough: then `paths` is empty, and `reason`
/// tells why.
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  spiral-atlas path least-curvature examples/least-curvature.json --figure least.png"
)]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    start: [f64; 2],
    end: [f64; 2],
    #[serde(deserialize_with = "angle")]
    start_direction: f64,
    #[serde(deserialize_with = "angle")]
    end_direction: f64,
    #[serde(deserialize_with = "name")]
    free: Free,
    greatest_length: Option<f64>,
}

#[derive(Serialize)]
struct Output {
    paths: Vec<PathReport>,
    /// Below which no searched path's greatest curvature lies.
    at_least: f64,
    derivatives: [f64; 2],
    /// Range of each derivative's length.
    searched: [f64; 2],
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let Input { start, end, start_direction, end_direction, free, greatest_length } = args.files.read()?;
    let distance = (end[0] - start[0]).hypot(end[1] - start[1]);
    // Curvatures would leave the range of doubles, and the length allowed would be no number that the user gave.
    let reckoned = distance == 0.0 || (1e-150..=1e150).contains(&distance);
    if !reckoned && start.iter().chain(&end).all(|x| x.is_finite()) {
        let what = format!(
            "`start` {start:?} and `end` {end:?} are not between 1e-150 and 1e150 apart; change the unit of length"
        );
        return Err(args.files.blame(Error::invalid(what)));
    }
    let greatest_length = greatest_length.unwrap_or(2.0 * distance);
    let ends = Directions { start, end, start_direction, end_direction, greatest_length, free };
    let found = match found(least_curvature(&ends), &args.files)? {
        Ok(found) => found,
        Err(none) => return Ok(none),
    };
    let paths = vec![PathReport::new(&[found.curve])];
    let title = format!("Greatest curvature {:.6}, length {:.6}", found.greatest_curvature, found.length);
    let output = Output { paths, at_least: found.at_least, derivatives: found.derivatives, searched: found.searched };
    args.files.finish(&output, || figure::curves(&[vec![found.curve]], &title))
}
