//! `export lattice`: motion primitives for nav2.

use super::super::{Outcome, numbers, output};
use spiral_atlas::Result;
use spiral_atlas::export::{Lattice, LatticeOptions, lattice};
use spiral_atlas::plot::{Drawing, Lines, PathsFigure, draw_paths};
use spiral_atlas::transition::join::Family;
use std::path::PathBuf;

const SIZE: (u32, u32) = (1500, 900);
/// Steps of a primitive where it is drawn.
const STEPS: usize = 200;

/// Motion primitives for nav2's Smac lattice planner whose curvature is continuous, within 1 / radius.
///
/// Each is a line, or a turn of spirals and an arc between lines, and so straight at both ends: whatever the planner
/// puts together of them has a continuous curvature. The set is as small as nav2's own rules make it. The output is
/// JSON as nav2 reads it, the same for the same options.
///
/// In the planner's settings analytic expansion and the smoother must be off, since both join what they make with jumps
/// of the curvature: `analytic_expansion_max_length: 0.0` and `smooth_path: false`.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
              spiral-atlas export lattice --turning-radius 0.5 --grid-resolution 0.05 --out lattice.json")]
pub(super) struct LatticeArgs {
    /// Least radius in metres.
    #[arg(long, value_name = "METRES", value_parser = numbers::number, allow_hyphen_values = true)]
    turning_radius: f64,
    /// Length of a cell in metres: the resolution of the costmap.
    #[arg(long, value_name = "METRES", value_parser = numbers::number, allow_hyphen_values = true)]
    grid_resolution: f64,
    /// How many directions: a multiple of 8.
    #[arg(long, value_name = "N", value_parser = numbers::count::<0, 1000>, allow_hyphen_values = true)]
    #[arg(default_value_t = 16)]
    headings: u32,
    /// Two primitives with the same directions end further apart than this share of the length of the longer: from 0 to
    /// 1. With less there are more.
    #[arg(long, value_name = "SHARE", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = 0.9)]
    distinctness: f64,
    /// What kind of spirals.
    #[arg(long, value_name = "NAME", default_value = "cubic", value_parser = numbers::joined())]
    family: Family,
    /// Where the file goes; standard output for - and unless given.
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
    /// Draw the primitives, and the curvature of those that start along 0 to 45°.
    #[arg(long, value_name = "FILE.png|svg")]
    figure: Option<PathBuf>,
}

/// Runs the command.
pub(super) fn run(args: &LatticeArgs) -> Result<Outcome> {
    output::check_figure(args.figure.as_deref())?;
    let found = lattice(&LatticeOptions {
        headings: args.headings as usize,
        distinctness: args.distinctness,
        family: args.family,
        ..LatticeOptions::new(args.turning_radius, args.grid_resolution)
    })?;
    let text = found.to_json()?;
    output::write_out(args.out.as_deref(), text.as_bytes())?;
    if let Some(path) = &args.figure {
        output::write_figure(path, &figure(&found)?)?;
    }
    Ok(Outcome::Fine)
}

/// All primitives, one colour for each direction at the start; and their curvature, for those that are no images of
/// others.
fn figure(lattice: &Lattice) -> Result<Drawing> {
    let octant = lattice.options.headings / 8;
    let (mut paths, mut lines) = (Vec::new(), Vec::new());
    for start in 0..lattice.options.headings {
        let (mut path, mut line) = (vec![[0.0, 0.0]], vec![[0.0, 0.0]]);
        for primitive in lattice.primitives.iter().filter(|primitive| primitive.start == start) {
            let all = primitive.stations(STEPS)?;
            // There and back, so that the next one starts at the origin.
            path.extend(all.iter().chain(all.iter().rev()).map(|s| [s.x, s.y]));
            line.extend(all.iter().map(|s| [s.station, s.curvature]));
            line.extend([[primitive.length(), 0.0], [0.0, 0.0]]);
        }
        paths.push(path);
        if start <= octant {
            lines.push(line);
        }
    }
    let figure = PathsFigure {
        title: format!("{} primitives, {} directions", lattice.primitives.len(), lattice.options.headings),
        note:
            "right: curvature of those that start along 0 to 45°, in the same colours; red: one over the turning radius"
                .into(),
        paths,
        graph: Lines { across: "s".into(), up: "κ".into(), lines },
        comb: Vec::new(),
        given: Vec::new(),
        level: Some(1.0 / lattice.options.turning_radius),
        backdrop: None,
    };
    draw_paths(&figure, SIZE)
}
