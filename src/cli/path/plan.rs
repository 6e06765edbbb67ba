//! `path plan`.

use super::{Files, Outcome, answer, figure};
use spiral_atlas::Result;
use spiral_atlas::path::Scene;

/// Plan a path of bounded curvature among polygons: a short polyline around them whose corners can be rounded, rounded.
///
/// Input: {"start": [x, y], "goal": [x, y], "obstacles": [[[x, y], ..], ..], "clearance": d, "greatest_curvature": k}.
///
/// Vertices run either way around an obstacle. Start and goal must be further from obstacles than the clearance.
///
/// `clearance` and `curvature_at_most` are proved for the path printed.
///
/// The exit status is 0 with a path. It is 1 when every way is blocked or no path was found: then `paths` is empty, and
/// `reason` says why.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas path plan examples/obstacles.json --figure plan.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let scene: Scene = args.files.read()?;
    Ok(match answer(scene.clone(), &args.files)? {
        Ok(found) => args.files.finish(&found, || figure::planned(&scene, &found.plan))?,
        Err(none) => none,
    })
}
