//! `export`: paths as files of other programs.

mod lattice;

use super::path::Source;
use super::{Outcome, numbers, output};
use lattice::LatticeArgs;
use spiral_atlas::export::{OpenDrive, dxf, opendrive};
use spiral_atlas::path::Course;
use spiral_atlas::plain::count;
use spiral_atlas::{Error, Result};
use std::path::{Path, PathBuf};

/// Write paths as files that other programs read.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
        spiral-atlas curve cubic --from 0,0 --to 200,0 --start-direction=-40deg --end-direction 80deg \\\n      \
        --start-curvature 0.004 --end-curvature 0.04 --json | spiral-atlas export opendrive - --out road.xodr")]
pub(super) struct Args {
    #[command(subcommand)]
    format: Format,
}

#[derive(clap::Subcommand)]
enum Format {
    Opendrive(RoadArgs),
    Dxf(DrawingArgs),
    Lattice(LatticeArgs),
}

/// ASAM OpenDRIVE 1.7: a road for each path, whose reference line the path is, with one driving lane to the right.
///
/// Input: {"paths": [{"pieces": [piece, ..]}, ..]} in metres, as `curve NAME --json`, `join` and the tools of `path`
/// print it, or a line of JSON for each of several, as with --points; lines without a path are named on standard error.
///
/// Lines, arcs, cubic curves and clothoids are exact. PH quintics are fitted by cubics, no further away than the
/// tolerance; how many, how well, and how much the curvature differs at joints is reported on standard error. Involutes
/// and trigonometric curves are refused.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas export opendrive path.json --lane-width 3.75 --out road.xodr")]
struct RoadArgs {
    #[command(flatten)]
    source: Source,
    /// Width of the lane in metres.
    #[arg(long, value_name = "METRES", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = 3.5)]
    lane_width: f64,
    /// How far a fitted curve may be from the true one, in metres.
    #[arg(long, value_name = "METRES", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = 0.001)]
    tolerance: f64,
    /// Where the file goes; standard output for - and unless given.
    #[arg(long, value_name = "FILE.xodr")]
    out: Option<PathBuf>,
}

/// DXF: a drawing of all paths for CAD programs, with a layer PATH_1, PATH_2, .. for each.
///
/// Input: {"paths": [{"pieces": [piece, ..]}, ..]} in any unit, as `curve --json`, `join` and the tools of `path` print
/// it, or a line of JSON for each of several, as with --points; lines without a path are named on standard error.
///
/// Lines, arcs, cubic curves and PH quintics are exact: LINE, ARC, and SPLINE of degree 3 and 5, with 12 decimals.
/// Involutes, trigonometric curves and clothoids are refused.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas export dxf path.json --out path.dxf")]
struct DrawingArgs {
    #[command(flatten)]
    source: Source,
    /// Where the file goes; standard output for -.
    #[arg(long, value_name = "FILE.dxf")]
    out: PathBuf,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    match &args.format {
        Format::Opendrive(args) => road(args),
        Format::Dxf(args) => drawing(args),
        Format::Lattice(args) => lattice::run(args),
    }
}

fn drawing(args: &DrawingArgs) -> Result<Outcome> {
    output::not_over(Some(&args.out), args.source.input())?;
    if !(output::has_extension(&args.out, "dxf") || args.out == Path::new("-")) {
        let path = args.out.display();
        return Err(Error::invalid(format!("the drawing `{path}` is to be DXF; end its name with .dxf")));
    }
    let paths: Vec<Course> = args.source.courses()?.into_iter().map(|(_, course)| course).collect();
    output::write_out(Some(&args.out), &dxf(&paths).map_err(|e| args.source.blame(e))?)?;
    Ok(Outcome::Fine)
}

fn road(args: &RoadArgs) -> Result<Outcome> {
    output::not_over(args.out.as_deref(), args.source.input())?;
    let options = OpenDrive { lane_width: args.lane_width, tolerance: args.tolerance };
    let paths: Vec<Course> = args.source.courses()?.into_iter().map(|(_, course)| course).collect();
    let (text, fit) = opendrive(&paths, &options).map_err(|e| args.source.blame(e))?;
    output::write_out(args.out.as_deref(), text.as_bytes())?;
    if fit.curves > 0 {
        output::note(&format!(
            "{} {} {} now, no further away than {:.1e} m; curvature at joints differs by at most {:.1e} / m",
            count(fit.curves, "PH quintic"),
            if fit.curves == 1 { "is" } else { "are" },
            count(fit.cubics, "cubic"),
            fit.error,
            fit.curvature
        ));
    }
    Ok(Outcome::Fine)
}
