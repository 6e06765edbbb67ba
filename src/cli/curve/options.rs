//! Options that several families share.

use super::super::join::parse::{COLUMNS, states};
use super::super::{Outcome, numbers, output, points, refuse};
use super::Reportable;
use super::report::{Report, Wish};
use spiral_atlas::plot;
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::transition::{Ends, Turn, direction_of};
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

const SIZE: (u32, u32) = (1500, 900);

/// Two ends, or a table of them.
#[derive(clap::Args)]
pub(super) struct Between {
    /// Start point.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    from: Option<[f64; 2]>,
    /// End point.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    to: Option<[f64; 2]>,
    /// Direction of travel at the start: angle from the x axis, counter-clockwise, or a vector.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = direction, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    start_direction: Option<f64>,
    /// Direction of travel at the end.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = direction, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    end_direction: Option<f64>,
    /// Curvature at the start, 1 / length, positive to the left; 1/250 is that of a radius of 250.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::curvature, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    start_curvature: Option<f64>,
    /// Curvature at the end, 1 / length, positive to the left; 1/250 is that of a radius of 250.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::curvature, allow_hyphen_values = true)]
    #[arg(required_unless_present = "points", conflicts_with = "points")]
    end_curvature: Option<f64>,
    /// A CSV file of ends, - for standard input. Columns, in any order: x0, y0, direction0, curvature0, x1, y1,
    /// direction1, curvature1. Prints for each row, in order, a line of JSON as of --json, but without advice; for a
    /// bad row {"row":..,"error":".."}.
    #[arg(long, value_name = "FILE", conflicts_with = "figure")]
    points: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

impl Between {
    /// Reports what `find` finds for the ends, or for each row of the table.
    pub(super) fn answer<F: Reportable>(&self, find: impl Fn(&Ends, Wish) -> Result<F>) -> Result<Outcome> {
        let Some(path) = &self.points else {
            // clap has asked for them.
            let ends = self.ends().unwrap_or_else(|| refuse("two ends or `--points` are needed"));
            return self.output.report(|wish| find(&ends, wish));
        };
        points::run(path, &[&COLUMNS], self.output.csv, |row| {
            let [start, end] = states(row.cells)?;
            let ends = Ends {
                start: start.point,
                end: end.point,
                start_direction: start.direction,
                end_direction: end.direction,
                start_curvature: start.curvature,
                end_curvature: end.curvature,
            };
            let wish = self.output.wish(false);
            let found = find(&ends, wish)?;
            let report = Report::new(&found, wish)?;
            if self.output.csv {
                return row.table(report.samples.as_deref().unwrap_or_default(), report.reason.as_deref());
            }
            serde_json::to_vec(&report).map_err(output::json_error)
        })
    }

    fn ends(&self) -> Option<Ends> {
        Some(Ends {
            start: self.from?,
            end: self.to?,
            start_direction: self.start_direction?,
            end_direction: self.end_direction?,
            start_curvature: self.start_curvature?,
            end_curvature: self.end_curvature?,
        })
    }
}

/// Where a segment between a line and a circle lies.
#[derive(clap::Args)]
pub(super) struct Segment {
    /// Where it starts.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub from: [f64; 2],
    /// Direction of travel at the start: angle from the x axis, counter-clockwise, or a vector.
    #[arg(long, value_name = "ANGLE|DX,DY", value_parser = direction, allow_hyphen_values = true)]
    pub start_direction: f64,
    /// Which way it turns.
    #[arg(long, value_name = "SIDE", value_parser = numbers::named::<Turn>(&["left", "right"]))]
    pub turn: Turn,
    /// Radius of its round end.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    pub radius: f64,
    /// How far it turns.
    #[arg(long, value_name = "ANGLE", value_parser = parse_angle, allow_hyphen_values = true)]
    pub angle: f64,
}

/// What is printed and drawn.
#[derive(clap::Args)]
pub(super) struct Output {
    /// A curve longer than this counts as none; in your unit of length.
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    longest: Option<f64>,
    /// Print so many points at equal lengths along the curve too, both ends included: station (length from the start),
    /// x, y, heading (radians), curvature.
    #[arg(long, value_name = "N", value_parser = numbers::samples, allow_hyphen_values = true)]
    samples: Option<u32>,
    /// Print the samples as CSV, and nothing else; of a table each after the number of its row of data, from 1.
    #[arg(long, requires = "samples", conflicts_with = "json")]
    csv: bool,
    /// Draw the curve with its polygon and end circles, its curvature and the derivative of that.
    #[arg(long, value_name = "FILE.png|svg")]
    figure: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

impl Output {
    fn wish(&self, advice: bool) -> Wish {
        Wish { longest: self.longest, samples: self.samples, advice }
    }

    /// Prints what `find` finds, and draws it where that is asked for.
    pub(super) fn report<F: Reportable>(&self, find: impl FnOnce(Wish) -> Result<F>) -> Result<Outcome> {
        output::check_figure(self.figure.as_deref())?;
        let wish = self.wish(true);
        let found = find(wish)?;
        let report = Report::new(&found, wish)?;
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
}

/// Two numbers with a comma between.
pub(super) fn point(text: &str) -> std::result::Result<[f64; 2], String> {
    numbers::two(text)
        .filter(|p: &[f64; 2]| p.iter().all(|v| v.is_finite()))
        .ok_or_else(|| format!("{text:?} is not two finite numbers `x,y`"))
}

/// An angle, or a vector.
fn direction(text: &str) -> Result<f64> {
    if text.contains(',') { direction_of(point(text).map_err(Error::invalid)?) } else { parse_angle(text) }
}

fn length(text: &str) -> std::result::Result<f64, String> {
    text.trim()
        .parse()
        .ok()
        .filter(|x: &f64| *x > 0.0 && x.is_finite())
        .ok_or_else(|| format!("{text:?} is no finite length above 0"))
}
