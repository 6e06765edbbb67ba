//! `join`: paths of spirals, arcs and lines between two states.

use super::{Outcome, output, points};
use spiral_atlas::plot::{self, Lines, PathsFigure};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::transition::join::{self, Family, Join, Objective, Request, State};
use spiral_atlas::transition::{Piece, Station, stations};
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

/// Columns, in the order of [`states`].
const COLUMNS: [&str; 8] = ["x0", "y0", "direction0", "curvature0", "x1", "y1", "direction1", "curvature1"];
const SIZE: (u32, u32) = (1500, 900);
const SAMPLES: usize = 2000;

/// Join two states by few spirals, arcs and lines, within a limit of curvature.
///
/// A state is a point, a direction of travel and a signed curvature, positive to the left, in any unit of length. Position, direction and
/// curvature of the path are continuous. The curvature of each piece is monotone, proved, so the limit that the pieces' ends keep holds everywhere. The
/// join is the best of those tried: turns (spiral, arc, spiral) with a line or a third turn between.
///
/// Prints {"length":..,"greatest_curvature":..,"curvature_range":..,"rate_range":..,"bending_energy":..,"pieces":[..]}, where a rate is
/// dκ/ds, or {"pieces":null,"reason":".."}.
/// With --points, one such line for each row, in order; a bad row gives {"line":..,"error":".."}.
///
/// Exit status: 0 when there is a join, 1 when none was found, 2 for an error. With --points it is 0 when every row was answered, whatever the
/// answers, and 2 when one was bad.
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  spiral-atlas join --from 0,0,0deg --to 8,6,90deg --greatest-curvature 0.5 --figure join.png\n  \
                        spiral-atlas join --from 0,0,0,0.2 --to 3,1,180deg,-0.1 --greatest-curvature 1 --family ph-quintic\n  \
                        spiral-atlas join --points states.csv --greatest-curvature 1 > joins.jsonl"
)]
pub struct Args {
    /// Where it starts; the direction is an angle from the x axis, the curvature 0 unless given.
    #[arg(long, value_name = "X,Y,ANGLE[,CURVATURE]", value_parser = parse_state, allow_hyphen_values = true, required_unless_present = "points")]
    from: Option<State>,
    /// Where it ends.
    #[arg(long, value_name = "X,Y,ANGLE[,CURVATURE]", value_parser = parse_state, allow_hyphen_values = true, required_unless_present = "points")]
    to: Option<State>,
    /// A CSV file of states, - for standard input. Columns, in any order: x0, y0, direction0, curvature0, x1, y1, direction1, curvature1.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["from", "to", "figure"])]
    points: Option<PathBuf>,
    /// Greatest curvature allowed, 1 / length: one over the least radius.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    greatest_curvature: f64,
    /// What kind of spirals.
    #[arg(long, value_enum, value_name = "NAME", default_value = "cubic")]
    family: Kind,
    /// What is to be least; a rate is |dκ/ds|, how fast the steering must turn.
    #[arg(long, value_enum, value_name = "NAME", default_value = "length")]
    objective: Least,
    /// A join longer than this counts as none; in your unit of length.
    #[arg(long, value_name = "LENGTH", default_value_t = f64::INFINITY, hide_default_value = true, allow_hyphen_values = true)]
    longest: f64,
    /// Most pieces allowed.
    #[arg(long, value_name = "N", default_value_t = Request::MOST_PIECES)]
    most_pieces: usize,
    /// Print so many points at equal lengths along the path too, both ends included, as `samples`: station (length from the start), x, y,
    /// heading (radians), curvature.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000), conflicts_with = "points")]
    samples: Option<u32>,
    /// Draw the path and its curvature.
    #[arg(long, value_name = "FILE.png")]
    figure: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Kind {
    Cubic,
    PhQuintic,
    Involute,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Least {
    Length,
    GreatestCurvature,
    GreatestRate,
    BendingEnergy,
}

/// What is printed of a single join.
#[derive(serde::Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    found: &'a join::Outcome,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<Station>>,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Outcome> {
    if let Some(path) = args.figure.as_ref().filter(|p| !p.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"))) {
        return Err(Error::Domain(format!("the figure `{}` would be a PNG picture; name it with .png", path.display())));
    }
    if let Some(path) = &args.points {
        // A limit or a length that is none spoils every row alike: it is told once.
        let nowhere = State { point: [0.0, 0.0], direction: 0.0, curvature: 0.0 };
        join::join(&args.request(nowhere, State { point: [1.0, 0.0], ..nowhere }))?;
        return points::run(path, &[&COLUMNS], |_, cells| {
            let (from, to) = states(cells)?;
            serde_json::to_vec(&join::join(&args.request(from, to))?).map_err(output::json_error)
        });
    }
    let (Some(from), Some(to)) = (args.from, args.to) else { super::refuse("`--from` and `--to` are needed, or `--points`") };
    let found = join::join(&args.request(from, to))?;
    let sampled = |(n, join): (u32, &Join)| stations(&join.pieces, n as usize);
    let samples = args.samples.zip(found.join()).map(sampled).transpose()?;
    output::print_json(&Told { found: &found, samples })?;
    let Some(join) = found.join() else { return Ok(Outcome::Bad) };
    if let Some(path) = &args.figure {
        spiral_atlas::files::write_file(path, &figure(join)?)?;
    }
    Ok(Outcome::Fine)
}

impl Args {
    fn request(&self, from: State, to: State) -> Request {
        Request {
            family: match self.family {
                Kind::Cubic => Family::Cubic,
                Kind::PhQuintic => Family::PhQuintic,
                Kind::Involute => Family::Involute,
            },
            objective: match self.objective {
                Least::Length => Objective::Length,
                Least::GreatestCurvature => Objective::GreatestCurvature,
                Least::GreatestRate => Objective::GreatestRate,
                Least::BendingEnergy => Objective::BendingEnergy,
            },
            longest: self.longest,
            most_pieces: self.most_pieces,
            ..Request::new(from, to, self.greatest_curvature)
        }
    }
}

/// The path, and its curvature over the length.
fn figure(join: &Join) -> Result<Vec<u8>> {
    let all = stations(&join.pieces, SAMPLES)?;
    let kinds = |kind: &str| join.pieces.iter().filter(|p| p.kind().name() == kind).count();
    let (lines, arcs) = (kinds("line"), kinds("arc"));
    let spirals = join.pieces.len() - lines - arcs;
    plot::paths_png(
        &PathsFigure {
            title: format!("A join of length {:.6}", join.measures.length),
            note: format!("dots: where pieces start; spirals: {spirals}, arcs: {arcs}, lines: {lines}"),
            paths: std::iter::once(all.iter().map(|s| [s.x, s.y]).collect())
                .chain(join.pieces.iter().skip(1).map(|p: &Piece| vec![p.start()]))
                .collect(),
            graph: Lines {
                across: "s".into(),
                up: "κ".into(),
                lines: vec![all.iter().map(|s| [s.station, s.curvature]).collect()],
            },
            level: None,
            backdrop: None,
        },
        SIZE,
    )
}

/// The states of a row.
fn states(cells: &[&str]) -> Result<(State, State)> {
    let number = |i: usize| {
        let wrong = || Error::Domain(format!("{}: {:?} is no number", COLUMNS[i], cells[i]));
        cells[i].parse::<f64>().map_err(|_| wrong())
    };
    let angle = |i: usize| parse_angle(cells[i]).map_err(|e| Error::Domain(format!("{}: {e}", COLUMNS[i])));
    let state = |i: usize| {
        Ok::<State, Error>(State { point: [number(i)?, number(i + 1)?], direction: angle(i + 2)?, curvature: number(i + 3)? })
    };
    Ok((state(0)?, state(4)?))
}

/// Point, direction and perhaps curvature.
fn parse_state(text: &str) -> std::result::Result<State, String> {
    let cells: Vec<&str> = text.split(',').map(str::trim).collect();
    let wrong = || format!("{text:?} is no state `x,y,angle` or `x,y,angle,curvature` of finite numbers");
    let number = |cell: &str| cell.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong);
    let (x, y, direction, curvature) = match cells.as_slice() {
        [x, y, direction] => (x, y, direction, 0.0),
        [x, y, direction, curvature] => (x, y, direction, number(curvature)?),
        _ => return Err(wrong()),
    };
    let direction = parse_angle(direction).map_err(|e| e.to_string())?;
    Ok(State { point: [number(x)?, number(y)?], direction, curvature })
}
