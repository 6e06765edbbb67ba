//! `curve`: transition curves in the user's own units and axes.

mod cubic;
mod involute;
mod options;
mod ph;
mod reach;
mod report;
mod table;
mod trig;

use super::{Outcome, numbers, output};
use report::{Report, Wish};
use serde::Serialize;
use spiral_atlas::curve::Jet;
use spiral_atlas::family::reach::Kind;
use spiral_atlas::plot::{self, CurveFigure, EndCircle, Graph};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::transition::{Ends, Piece, direction_of, ph_spiral, spiral};
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

const SIZE: (u32, u32) = (1500, 900);
const SAMPLES: usize = 801;

/// Find a transition curve of monotone curvature, anywhere in the plane, in any unit of length.
///
/// Between two ends (`cubic`, `ph-quintic`, `involute`): two points, two directions of travel, two signed curvatures,
/// positive to the left. `cubic`: of several spirals the one with the largest margin. `ph-quintic`: that of least
/// bending energy. `involute`: the image of an involute of a circle, which exists whenever any spiral does; with
/// --turns it goes round its ends.
///
/// Added to the end of a line or of an arc (`reach-cubic`, `reach-ph`): a segment between curvature 0 and 1/radius that
/// turns by an angle, given by its shape numbers m and q or by its end point.
///
/// From a line or a circle to a line or a circle (`trig-quintic`): quintic trigonometric spirals in one of five
/// templates, each given by the angle that it turns, its radius and its shape numbers.
///
/// Exit status: 0 when there is such a spiral, 1 when there is none, 2 for an error. A no comes with the condition that
/// fails, in your units, and with what to type for the other families that have a spiral there.
///
/// With --points, one line of JSON for each row, in order, as of --json but without advice (no other families or
/// curvatures are tried); a bad row gives {"line":..,"error":".."}. The exit status is 0 when every row was answered,
/// whatever the answers, and 2 when one was bad.
#[derive(clap::Args)]
#[command(
    after_help = "Examples:\n  spiral-atlas curve --from 0,0 --to 200,0 --start-direction -40deg --end-direction 80deg \\\n      \
                        --start-curvature 0.004 --end-curvature 0.04 --figure spiral.png\n  \
                        spiral-atlas curve --family involute --from 0,0 --to 2,0 --start-direction 1,-0.84 \\\n      \
                        --end-direction 0.17,0.98 --start-curvature -0.3 --end-curvature 4 --json\n  \
                        spiral-atlas curve --family reach-ph --base line --from 10,5 --start-direction 30deg --turn left \\\n      \
                        --radius 20 --angle 45deg --to 30,25\n  \
                        spiral-atlas curve --family trig-quintic --template line-circle --from 10,5 --start-direction 30deg \\\n      \
                        --turn left --radius 20 --angle 42deg --m 1"
)]
pub(super) struct Args {
    // First, since each field takes its own from what was given.
    #[command(flatten)]
    given: options::Given,
    /// What kind of curve.
    #[arg(long, value_enum, value_name = "NAME", default_value = "cubic")]
    family: Family,
    /// Start point.
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    from: Option<[f64; 2]>,
    /// End point.
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    to: Option<[f64; 2]>,
    /// Direction of travel at the start: angle from the x axis, counter-clockwise, or a vector.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = parse_direction, allow_hyphen_values = true)]
    start_direction: Option<f64>,
    /// Direction of travel at the end.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = parse_direction, allow_hyphen_values = true)]
    end_direction: Option<f64>,
    /// Curvature at the start, 1 / length.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    start_curvature: Option<f64>,
    /// Curvature at the end, 1 / length.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    end_curvature: Option<f64>,
    /// A CSV file of ends for `cubic`, `ph-quintic` or `involute`, - for standard input. Columns, in any order: x0, y0,
    /// direction0, curvature0, x1, y1, direction1, curvature1.
    #[arg(long, value_name = "FILE", conflicts_with = "figure")]
    points: Option<PathBuf>,
    /// How often an involute's image turns about its start and about its end.
    #[arg(long, value_name = "N1,N2", value_parser = parse_turns, help_heading = "For `involute`")]
    turns: Option<[u32; 2]>,
    /// What the segment is added to.
    #[arg(long, value_parser = ["line", "circle"], help_heading = REACH)]
    base: Option<String>,
    /// Which way it turns.
    #[arg(long, value_parser = ["left", "right"], help_heading = REACH)]
    turn: Option<String>,
    /// Radius of its round end.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = REACH)]
    radius: Option<f64>,
    /// How far it turns.
    #[arg(long, value_name = "ANGLE", value_parser = parse_angle, allow_hyphen_values = true, help_heading = REACH)]
    angle: Option<f64>,
    /// Shape m, instead of the end point.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = REACH)]
    m: Option<f64>,
    /// Shape q, instead of the end point.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = REACH)]
    q: Option<f64>,
    /// What is joined, in the direction of travel; `--from` is its start, for `s` and `c` the point between the
    /// spirals.
    #[arg(long, value_name = "NAME", value_parser = ["line-circle", "line-line", "s", "c", "circle-in-circle"], help_heading = TRIG)]
    template: Option<String>,
    /// s / tan(angle/2); left out: 6, or with --as-printed the paper's (6 + m)/2.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = TRIG)]
    ratio: Option<f64>,
    /// Shape p, from -4 to 1; left out: 0, and so is q.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = TRIG)]
    p: Option<f64>,
    /// Angle, radius, ratio, m, p, q of the second spiral; left out: as the first.
    #[arg(long, value_name = "ANGLE,RADIUS,RATIO,M,P,Q", value_parser = parse_second, allow_hyphen_values = true, help_heading = TRIG)]
    second: Option<[f64; 6]>,
    /// Radius of the outer circle, for `circle-in-circle`.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, help_heading = TRIG)]
    outer: Option<f64>,
    /// Scale the curve as the paper does, which misses the end curvature.
    #[arg(long, help_heading = TRIG)]
    as_printed: bool,
    /// A curve longer than this counts as none; in your unit of length.
    #[arg(long, value_name = "LENGTH", value_parser = parse_longest, allow_hyphen_values = true)]
    longest: Option<f64>,
    /// Print so many points at equal lengths along the curve too, both ends included: station (length from the start),
    /// x, y, heading (radians), curvature.
    #[arg(long, value_name = "N", value_parser = numbers::samples)]
    samples: Option<u32>,
    /// Print the samples as CSV, and nothing else; with --points each after the number of its row of data, from 1.
    #[arg(long, requires = "samples", conflicts_with = "json")]
    csv: bool,
    /// Draw the curve with its polygon and end circles, its curvature and the derivative of that.
    #[arg(long, value_name = "FILE.png|svg")]
    figure: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

const REACH: &str = "For `reach-cubic`, `reach-ph` and `trig-quintic`";
const TRIG: &str = "For `trig-quintic`";

/// Families that make curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Family {
    Cubic,
    PhQuintic,
    Involute,
    ReachCubic,
    ReachPh,
    TrigQuintic,
}

impl Family {
    /// Its name, as it is typed.
    fn name(self) -> String {
        clap::ValueEnum::to_possible_value(&self).map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// What a family found, as it is reported; as JSON too.
trait Reportable: Serialize {
    /// The spirals that were asked for, in the direction of travel, or why there are none.
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String>;
    /// The ends that were to be joined, where any family between two ends could do it.
    fn ends(&self) -> Option<&Ends> {
        None
    }
    /// Which of the ends are straight by the question.
    fn straight(&self) -> [bool; 2] {
        self.ends().map_or([false; 2], |ends| [ends.start_curvature, ends.end_curvature].map(|k| k == 0.0))
    }
    /// In words; of a no what there is to say beside the reason.
    fn text(&self) -> String;
    /// What is drawn.
    ///
    /// # Errors
    /// [`Error::Domain`] when there is nothing to draw.
    fn figure(&self) -> Result<CurveFigure>;
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    output::check_figure(args.figure.as_deref())?;
    if let Some(path) = &args.points {
        if !matches!(args.family, Family::Cubic | Family::PhQuintic | Family::Involute) {
            super::refuse("`--points` is for the families `cubic`, `ph-quintic` and `involute`");
        }
        args.check(&[], if args.family == Family::Involute { &["turns"] } else { &[] });
        return table::run(args, path);
    }
    let longest = args.wish().longest();
    match args.family {
        Family::Cubic => args.report(&spiral(&args.ends(&[]))?.no_longer_than(longest).with_remedies()?),
        Family::PhQuintic => args.report(&ph_spiral(&args.ends(&[]))?.no_longer_than(longest).with_remedies()?),
        Family::Involute => args.report(&involute::find(&args.ends(&["turns"]), args.turns.unwrap_or_default())?),
        Family::ReachCubic => args.report(&reach::find(Kind::Cubic, &args.segment())?),
        Family::ReachPh => args.report(&reach::find(Kind::Ph, &args.segment())?),
        Family::TrigQuintic => args.report(&trig::find(&args.template())?),
    }
}

impl Args {
    /// Prints what was found, and draws it where that is asked for.
    fn report(&self, found: &impl Reportable) -> Result<Outcome> {
        let report = Report::new(found, self.wish())?;
        match (self.json, self.csv) {
            (true, _) => output::print_json(&report)?,
            (_, true) => report.csv()?,
            _ => report.text()?,
        }
        let Some(path) = &self.figure else { return Ok(report.outcome()) };
        match found.figure() {
            Ok(figure) => {
                output::write_figure(path, &plot::draw_curve(&figure, SIZE)?)?;
                if !(self.json || self.csv) {
                    output::print(&format!("drawn in {}\n", path.display()))?;
                }
            }
            Err(e) => output::note(&format!("{} was not drawn: {e}", path.display())),
        }
        Ok(report.outcome())
    }

    fn wish(&self) -> Wish {
        Wish { family: self.family, longest: self.longest, samples: self.samples, advice: self.points.is_none() }
    }
}

/// A circle of curvature for a figure.
fn circle(at: [f64; 2], direction: f64, curvature: f64, label: &str) -> EndCircle {
    EndCircle { at, direction: [direction.cos(), direction.sin()], curvature, label: label.into() }
}

/// Those at the ends.
fn end_circles(ends: &Ends) -> Vec<EndCircle> {
    vec![
        circle(ends.start, ends.start_direction, ends.start_curvature, "circle of curvature at the start"),
        circle(ends.end, ends.end_direction, ends.end_curvature, "circle of curvature at the end"),
    ]
}

/// A Bézier curve given relative to its start, its curvature, and the derivative of that.
fn drawn([x, y]: [f64; 2], local_control_points: &[[f64; 2]]) -> (Vec<[f64; 2]>, Graph, Graph) {
    let step = |i: usize| i as f64 / (SAMPLES - 1) as f64;
    let jets: Vec<(f64, Jet)> = (0..SAMPLES).map(step).map(|t| (t, Jet::of_bezier(local_control_points, t))).collect();
    let graph = |label: &str, value: fn(&Jet) -> f64| Graph {
        label: label.into(),
        points: jets.iter().map(|(t, jet)| [*t, value(jet)]).collect(),
    };
    let curve = jets.iter().map(|(_, jet)| [x + jet.point[0], y + jet.point[1]]).collect();
    (curve, graph("κ", Jet::curvature), graph("dκ/dt", Jet::curvature_dt))
}

/// Two numbers with a comma between.
fn parse_point(text: &str) -> std::result::Result<[f64; 2], String> {
    let both = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    both.filter(|p: &[f64; 2]| p.iter().all(|v| v.is_finite()))
        .ok_or_else(|| format!("{text:?} is not two finite numbers `x,y`"))
}

/// A length.
fn parse_longest(text: &str) -> std::result::Result<f64, String> {
    text.trim()
        .parse()
        .ok()
        .filter(|x: &f64| *x > 0.0 && x.is_finite())
        .ok_or_else(|| format!("{text:?} is no finite length above 0"))
}

/// Two whole numbers with a comma between.
fn parse_turns(text: &str) -> std::result::Result<[u32; 2], String> {
    let both = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    both.ok_or_else(|| format!("{text:?} is not two numbers of turns `n1,n2`"))
}

/// An angle and five numbers with commas between.
fn parse_second(text: &str) -> std::result::Result<[f64; 6], String> {
    let wrong = || format!("{text:?} is not an angle and five finite numbers `angle,radius,ratio,m,p,q`");
    let mut cells = text.split(',').map(str::trim);
    let angle = cells.next().and_then(|cell| parse_angle(cell).ok()).ok_or_else(wrong)?;
    let rest: Option<Vec<f64>> = cells.map(|cell| cell.parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let rest: [f64; 5] = rest.and_then(|rest| rest.try_into().ok()).ok_or_else(wrong)?;
    let [radius, ratio, m, p, q] = rest;
    Ok([angle, radius, ratio, m, p, q])
}

/// An angle, or a vector.
fn parse_direction(text: &str) -> Result<f64> {
    if text.contains(',') { direction_of(parse_point(text).map_err(Error::invalid)?) } else { parse_angle(text) }
}
