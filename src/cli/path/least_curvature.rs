//! `path least-curvature`.

use super::{Files, Outcome, answer, figure};
use spiral_atlas::Result;
use spiral_atlas::tools::LeastBend;

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
/// says why.
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  spiral-atlas path least-curvature examples/least-curvature.json --figure least.png"
)]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let asked: LeastBend = args.files.read()?;
    let found = match answer(asked, &args.files)? {
        Ok(found) => found,
        Err(none) => return Ok(none),
    };
    let [path] = &found.paths;
    let title = format!("Greatest curvature {:.6}, length {:.6}", path.greatest_curvature, path.length);
    args.files.finish(&found, || figure::reported(&found.paths, &title))
}
