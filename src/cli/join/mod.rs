//! `join`: paths of spirals, arcs and lines between two states, or two lines and circles.

pub(super) mod parse;
mod request;

use super::path::figure::{self, SAMPLES, drawn};
use super::{Outcome, numbers, output, points};
use parse::{COLUMNS, states};
use spiral_atlas::Result;
use spiral_atlas::path::Course;
use spiral_atlas::plot::Drawing;
use spiral_atlas::transition::join::{self, End, Family, Join, Objective, Request, State};
use spiral_atlas::transition::{Station, Turn};
use std::f64::consts::TAU;
use std::path::PathBuf;

/// Join two states, or two lines and circles, by few spirals, arcs and lines, within a limit of curvature.
///
/// A state is a point, a direction of travel and a signed curvature, positive to the left, in any unit of length. Lines
/// have no ends and a direction, and circles are travelled to the left or to the right; the join leaves the first and
/// reaches the second where it has to.
///
/// Position, direction and curvature of the path are continuous. The curvature of each piece is monotone, proved, so
/// the limit that the pieces' ends keep holds everywhere. The join is the best of those tried, not of all.
///
/// Prints {"paths":[path]} with the path {"length":..,"greatest_curvature":..,"curvature_range":..,"rate_range":..,
/// "bending_energy":..,"pieces":[..]}, where a rate is dκ/ds, or {"paths":[],"reason":".."}. With --points, for each
/// row in order a line with the path alone, or {"pieces":null,"reason":".."}; a bad row gives {"row":..,"error":".."}.
/// `path measure` and `export opendrive` read all of it.
///
/// Exit status: 0 when there is a join, 1 when none was found, 2 for an error. With --points it is 0 when every row was
/// answered, whatever the answers, and 2 when one was bad.
#[derive(clap::Args)]
#[command(
    group(clap::ArgGroup::new("start").args(["from", "from_line", "from_circle"])),
    group(clap::ArgGroup::new("goal").args(["to", "to_line", "to_circle"])),
    after_help = "Examples:\n  \
        spiral-atlas join --from 0,0,0deg --to 8,6,90deg --greatest-curvature 0.5 --figure join.png\n  \
        spiral-atlas join --from-line 0,0,0deg --to-circle 90,35,30,left --greatest-curvature 0.04 \\\n      \
        --samples 101 --csv\n  \
        spiral-atlas join --points states.csv --greatest-curvature 1 > joins.jsonl\n  \
        spiral-atlas join request.toml"
)]
pub(super) struct Args {
    /// All of the options below but those of output in one file: JSON, TOML if named .toml, `-` for JSON from standard
    /// input.
    #[arg(value_name = "FILE", conflicts_with_all = ["start", "goal", "points", "greatest_curvature"])]
    #[arg(conflicts_with_all = ["family", "objective", "longest", "most_pieces"])]
    request: Option<PathBuf>,
    /// Start in a state; the direction is an angle from the x axis, the curvature 0 unless given.
    #[arg(long, value_name = "X,Y,ANGLE[,CURVATURE]", value_parser = parse::state)]
    #[arg(allow_hyphen_values = true, help_heading = ENDS)]
    from: Option<End>,
    /// End in a state.
    #[arg(long, value_name = "X,Y,ANGLE[,CURVATURE]", value_parser = parse::state)]
    #[arg(allow_hyphen_values = true, help_heading = ENDS)]
    to: Option<End>,
    /// Start anywhere on a straight line: a point of it and its direction.
    #[arg(long, value_name = "X,Y,ANGLE", value_parser = parse::line, allow_hyphen_values = true, help_heading = ENDS)]
    from_line: Option<End>,
    /// End anywhere on a straight line.
    #[arg(long, value_name = "X,Y,ANGLE", value_parser = parse::line, allow_hyphen_values = true, help_heading = ENDS)]
    to_line: Option<End>,
    /// Start anywhere on a circle: its centre, its radius, and to which side it is travelled, left or right.
    #[arg(long, value_name = "X,Y,RADIUS,SIDE", value_parser = parse::circle)]
    #[arg(allow_hyphen_values = true, help_heading = ENDS)]
    from_circle: Option<End>,
    /// End anywhere on a circle.
    #[arg(long, value_name = "X,Y,RADIUS,SIDE", value_parser = parse::circle)]
    #[arg(allow_hyphen_values = true, help_heading = ENDS)]
    to_circle: Option<End>,
    /// A CSV file of states, - for standard input. Columns, in any order: x0, y0, direction0, curvature0, x1, y1,
    /// direction1, curvature1.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["start", "goal", "figure"], help_heading = ENDS)]
    points: Option<PathBuf>,
    /// Greatest curvature allowed, 1 / length: one over the least radius, such as 1/60.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::curvature, allow_hyphen_values = true)]
    greatest_curvature: Option<f64>,
    /// What kind of spirals.
    #[arg(long, value_name = "NAME", default_value = "cubic", value_parser = numbers::joined())]
    family: Family,
    /// What is to be least; a rate is |dκ/ds|, how fast the steering must turn.
    #[arg(long, value_name = "NAME", default_value = "length")]
    #[arg(value_parser = numbers::named::<Objective>(&Objective::ALL.map(Objective::name)))]
    objective: Objective,
    /// A join longer than this counts as none; in your unit of length.
    #[arg(long, value_name = "LENGTH", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = f64::INFINITY, hide_default_value = true)]
    longest: f64,
    /// Most pieces allowed.
    #[arg(long, value_name = "N", value_parser = numbers::count::<0, 1000>, allow_hyphen_values = true)]
    #[arg(default_value_t = Request::MOST_PIECES as u32)]
    most_pieces: u32,
    /// Print so many points at equal lengths along the path too, both ends included, as `samples`: station (length from
    /// the start), x, y, heading (radians), curvature.
    #[arg(long, value_name = "N", value_parser = numbers::samples, allow_hyphen_values = true)]
    samples: Option<u32>,
    /// Print the samples as CSV, and nothing else; with --points each after the number of its row of data, from 1.
    #[arg(long, requires = "samples")]
    csv: bool,
    /// As the other commands have it; here it is always JSON, but for CSV.
    #[arg(long, hide = true, conflicts_with = "csv")]
    json: bool,
    /// Draw the path and its curvature.
    #[arg(long, value_name = "FILE.png|svg")]
    figure: Option<PathBuf>,
}

const ENDS: &str = "What is joined";

/// What is printed of a single join.
#[derive(serde::Serialize)]
struct JoinReport<'a> {
    paths: Vec<&'a Join>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<Station>>,
}

/// What is printed of a join in a table.
#[derive(serde::Serialize)]
struct Line<'a> {
    #[serde(flatten)]
    join: Option<&'a Join>,
    #[serde(flatten)]
    none: Option<NoJoin<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<Station>>,
}

/// That there is none.
#[derive(serde::Serialize)]
struct NoJoin<'a> {
    pieces: (),
    reason: &'a str,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    output::check_figure(args.figure.as_deref())?;
    if let Some(path) = &args.points {
        // A limit or a length that is none spoils every row alike: it is reported once.
        let nowhere = State { point: [0.0, 0.0], direction: 0.0, curvature: 0.0 };
        let _ = join::join(&args.request(nowhere.into(), State { point: [1.0, 0.0], ..nowhere }.into()))?;
        return points::run(path, &[&COLUMNS], args.csv, |row| {
            let [from, to] = states(row.cells)?.map(End::from);
            let found = asked_whether_radii(join::join(&args.request(from, to))?, &from, &to);
            let samples = args.samples(&found)?;
            if args.csv {
                return row.table(&samples.unwrap_or_default(), reason(&found));
            }
            let none = reason(&found).map(|reason| NoJoin { pieces: (), reason });
            serde_json::to_vec(&Line { join: found.as_ref().ok(), none, samples }).map_err(output::json_error)
        });
    }
    let request = match &args.request {
        Some(path) => request::read(path)?,
        None => args.request(
            args.from.or(args.from_line).or(args.from_circle).unwrap_or_else(|| missing("from")),
            args.to.or(args.to_line).or(args.to_circle).unwrap_or_else(|| missing("to")),
        ),
    };
    let found = asked_whether_radii(join::join(&request)?, &request.from, &request.to);
    let samples = args.samples(&found)?;
    match (reason(&found), &samples) {
        (Some(reason), _) if args.csv => output::note(reason),
        (None, Some(samples)) if args.csv => output::stream(|out| output::table(out, samples, ","))?,
        (reason, _) => output::print_json(&JoinReport { paths: found.iter().collect(), reason, samples })?,
    }
    let Ok(join) = &found else { return Ok(Outcome::Bad) };
    if let Some(path) = &args.figure {
        output::write_figure(path, &figure(&request, join)?)?;
    }
    Ok(Outcome::Fine)
}

/// Neither states, a table nor a file was given.
fn missing(end: &str) -> ! {
    super::refuse(&format!("one of `--{end}`, `--{end}-line` and `--{end}-circle` is needed, or `--points`, or a file"))
}

/// A join, or why there is none.
type Found = std::result::Result<Join, String>;

/// A reason asks too whether curvatures so large are meant as radii.
fn asked_whether_radii(found: Found, from: &End, to: &End) -> Found {
    let (End::State(from), End::State(to)) = (from, to) else { return found };
    let ask = || numbers::are_radii(from.point, to.point, [from.curvature, to.curvature]);
    found.map_err(|reason| ask().map_or(reason.clone(), |ask| format!("{reason}; {ask}")))
}

/// Why there is no join.
fn reason(found: &Found) -> Option<&str> {
    found.as_ref().err().map(String::as_str)
}

impl Args {
    /// The samples that are asked for, where there is a join.
    fn samples(&self, found: &Found) -> Result<Option<Vec<Station>>> {
        self.samples.zip(found.as_ref().ok()).map(|(n, join)| join.stations(n as usize)).transpose()
    }

    fn request(&self, from: End, to: End) -> Request {
        let limit = self.greatest_curvature.unwrap_or_else(|| super::refuse("`--greatest-curvature` is needed"));
        let Args { family, objective, longest, most_pieces, .. } = *self;
        Request { family, objective, longest, most_pieces: most_pieces as usize, ..Request::new(from, to, limit) }
    }
}

/// The line or circle that a join leaves or reaches at a point, as much of it as goes on from there for a length:
/// backwards before the start. Of a state there is nothing.
fn beyond(end: &End, at: [f64; 2], ahead: f64) -> Option<figure::Line> {
    let [x, y] = at;
    let steps = (0..=200).map(|i| ahead * f64::from(i) / 200.0);
    Some(match *end {
        End::State(_) => return None,
        End::Line { direction, .. } => steps.map(|s| [x + s * direction.cos(), y + s * direction.sin()]).collect(),
        End::Circle { centre: [a, b], radius, turn } => {
            let round = if turn == Turn::Left { 1.0 } else { -1.0 } / radius;
            let first = (y - b).atan2(x - a);
            let angles = steps.map(|s| first + (s * round).clamp(-TAU, TAU));
            angles.map(|angle| [a + radius * angle.cos(), b + radius * angle.sin()]).collect()
        }
    })
}

/// The path, and its curvature over the length.
fn figure(request: &Request, join: &Join) -> Result<Drawing> {
    let all = Course::new(join.pieces.clone())?.outline(SAMPLES)?;
    let kinds = |kind: &str| join.pieces.iter().filter(|p| p.kind().name() == kind).count();
    let (lines, arcs) = (kinds("line"), kinds("arc"));
    let spirals = join.pieces.len() - lines - arcs;
    let far = 0.3 * join.measures.length;
    let before = join.pieces.first().and_then(|piece| beyond(&request.from, piece.start(), -far));
    let after = join.pieces.last().and_then(|piece| beyond(&request.to, piece.end(), far));
    let given: Vec<_> = [before, after].into_iter().flatten().collect();
    let more = if given.is_empty() { "" } else { "; grey: what is joined" };
    drawn(
        vec![all.iter().map(|s| [s.x, s.y]).collect()],
        vec![all.iter().map(|s| [s.station, s.curvature]).collect()],
        join.pieces.iter().skip(1).map(|piece| vec![piece.start()]).collect(),
        given,
        [
            &format!("A join of length {:.6}", join.measures.length),
            &format!(
                "dots: where pieces start; comb: curvature; spirals: {spirals}, arcs: {arcs}, lines: {lines}{more}"
            ),
        ],
    )
}
