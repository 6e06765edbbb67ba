//! `path plan`.

use super::{Files, Outcome, PathReport, figure, found};
use serde::Serialize;
use spiral_atlas::Result;
use spiral_atlas::path::{Clearance, Corner, Scene, plan};

/// Plan a path of bounded curvature among polygons: a short polyline around them whose corners can be rounded, rounded.
///
/// Input: {"start": [x, y], "goal": [x, y], "obstacles": [[[x, y], ..], ..], "clearance": d, "greatest_curvature": k}.
///
/// Vertices run either way around an obstacle. Start and goal must be further from obstacles than the clearance.
///
/// `clearance` and `curvature_at_most` are proved for the path printed.
///
/// The exit status is 0 with a path. It is 1 when every way is blocked or no path was found: then `paths` is empty, and
/// `reason` tells why.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas path plan examples/obstacles.json --figure plan.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
}

#[derive(Serialize)]
struct Planned<'p> {
    #[serde(flatten)]
    found: PathReport,
    length_saved: f64,
    curvature_at_most: f64,
    /// Null without obstacles.
    clearance: Option<Clearance>,
    polyline: &'p [[f64; 2]],
    corners: &'p [Corner],
}

#[derive(Serialize)]
struct Output<'p> {
    paths: [Planned<'p>; 1],
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let scene: Scene = args.files.read()?;
    let plan = match found(plan(&scene), &args.files)? {
        Ok(plan) => plan,
        Err(none) => return Ok(none),
    };
    let planned = Planned {
        found: PathReport::new(&plan.spans),
        length_saved: plan.length_saved,
        curvature_at_most: plan.proof.curvature_at_most,
        clearance: plan.proof.clearance,
        polyline: &plan.polyline,
        corners: &plan.corners,
    };
    args.files.finish(&Output { paths: [planned] }, || figure::planned(&scene, &plan))
}
