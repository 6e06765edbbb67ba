//! `curve`: the transition spiral between two given ends, in the user's own units and axes.

use super::{Outcome, output};
use spiral_atlas::curve::{Answer, Ends, Figure, Solution, direction_of, spiral};
use spiral_atlas::plot::{self, CurveFigure, EndCircle, Graph};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::{Error, Result};
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (1500, 900);
const SAMPLES: usize = 801;

/// Find the transition spiral between two ends anywhere in the plane.
///
/// Two points, two directions of travel, two signed curvatures (positive to the left), in any unit of length. Of several
/// spirals the one with the largest margin is chosen. When there is none, says which condition fails, with numbers; that is an
/// answer too, and exits with 0.
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  spiral-atlas curve --from 0,0 --to 200,0 --start-direction -40deg --end-direction 80deg \\\n      \
                        --start-curvature 0.004 --end-curvature 0.04 --figure spiral.png\n  \
                        spiral-atlas curve --from 0,0 --to 2,0 --start-direction 1,-0.84 --end-direction 0.17,0.98 \\\n      \
                        --start-curvature 0.4 --end-curvature 4 --json"
)]
pub struct Args {
    /// Start point.
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    from: [f64; 2],
    /// End point.
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    to: [f64; 2],
    /// Direction of travel at the start: angle from the x axis, counter-clockwise, or a vector.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = parse_direction, allow_hyphen_values = true)]
    start_direction: f64,
    /// Direction of travel at the end.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = parse_direction, allow_hyphen_values = true)]
    end_direction: f64,
    /// Curvature at the start, 1 / length.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    start_curvature: f64,
    /// Curvature at the end, 1 / length.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    end_curvature: f64,
    /// Draw the curve with its polygon and end circles, its curvature and the derivative of that.
    #[arg(long, value_name = "FILE.png")]
    figure: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Outcome> {
    let ends = Ends {
        start: args.from,
        end: args.to,
        start_direction: args.start_direction,
        end_direction: args.end_direction,
        start_curvature: args.start_curvature,
        end_curvature: args.end_curvature,
    };
    if let Some(path) = args.figure.as_ref().filter(|p| !p.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"))) {
        return Err(Error::Domain(format!("the figure `{}` would be a PNG picture; name it with .png", path.display())));
    }
    let answer = spiral(&ends)?;
    if args.json {
        output::print_json(&answer)?
    } else {
        output::print(&format!("{answer}\n"))?
    }
    if let Some(path) = &args.figure {
        draw(&answer, path)?;
        if !args.json {
            output::print(&format!("drawn in {}\n", path.display()))?;
        }
    }
    Ok(Outcome::Fine)
}

/// Draws the chosen spiral or, where there is none, the cubic that comes nearest to one.
fn draw(answer: &Answer, path: &Path) -> Result<()> {
    let nearest = || answer.solutions.iter().max_by(|a, b| a.margin.total_cmp(&b.margin));
    let Some(solution) = answer.chosen().or_else(nearest) else {
        return Err(Error::Domain(format!("{} was not drawn: no cubic has these ends", path.display())));
    };
    spiral_atlas::files::write_file(path, &plot::curve_png(&figure(answer, solution)?, SIZE)?)
}

fn figure(answer: &Answer, solution: &Solution) -> Result<CurveFigure> {
    let (ends, figure) = (&answer.ends, Figure::new(&answer.ends, solution, SAMPLES)?);
    let circle = |at, direction: f64, curvature, label: &str| EndCircle {
        at,
        direction: [direction.cos(), direction.sin()],
        curvature,
        label: label.into(),
    };
    let kind = if solution.spiral { "cubic spiral" } else { "cubic, no spiral" };
    let points: Vec<String> = solution.control_points.p.iter().map(|[x, y]| format!("({x:.6}, {y:.6})")).collect();
    Ok(CurveFigure {
        title: format!("{kind}: f₀ = {:.6}, f₁ = {:.6}, margin {:.3e}", solution.f0, solution.f1, solution.margin),
        note: format!("control points {}", points.join(" ")),
        curve: figure.samples.iter().map(|s| s.point).collect(),
        control: figure.control_points.to_vec(),
        circles: vec![
            circle(ends.start, ends.start_direction, ends.start_curvature, "circle of curvature at the start"),
            circle(ends.end, ends.end_direction, ends.end_curvature, "circle of curvature at the end"),
        ],
        parameter: "t".into(),
        curvature: Graph { label: "κ".into(), points: figure.samples.iter().map(|s| [s.t, s.curvature]).collect() },
        derivative: Graph { label: "dκ/dt".into(), points: figure.samples.iter().map(|s| [s.t, s.curvature_dt]).collect() },
    })
}

/// Two numbers with a comma between.
fn parse_point(text: &str) -> std::result::Result<[f64; 2], String> {
    let both = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    both.filter(|p: &[f64; 2]| p.iter().all(|v| v.is_finite())).ok_or_else(|| format!("{text:?} is not two finite numbers `x,y`"))
}

/// An angle, or a vector.
fn parse_direction(text: &str) -> Result<f64> {
    if text.contains(',') { direction_of(parse_point(text).map_err(Error::Domain)?) } else { parse_angle(text) }
}
