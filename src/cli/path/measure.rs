//! `path measure`.

use super::{Files, Outcome, figure};
use crate::cli::{numbers, output};
use spiral_atlas::tools::{Measured, Measures};
use spiral_atlas::transition::Station;
use spiral_atlas::{Error, Result};
use std::io::Write;

/// Measure paths: points at equal steps of arc length, where the curvature is extreme and where it changes its sign,
/// and offset curves.
///
/// Input: {"paths": [{"pieces": [piece, ..]}, ..]}, as the other tools, `join` and `curve NAME --json` print it, or a
/// line of JSON for each of several, as with --points; lines without a path are named on standard error, and not
/// counted. A field that no tool prints is refused. Pieces of all kinds are read. A `station` is the length from the
/// start of the path, a `parameter` that of the piece.
///
/// The offset of a PH quintic is exact, rational of degree 9: at parameter t it is the Bernstein form `numerator`
/// divided by the form `weight`. Of other pieces it is given by `points`.
///
/// Heading and curvature are null where the path stands still.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  \
        spiral-atlas path spline examples/lap.json | spiral-atlas path measure - --samples 101 --offset 0.2")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
    /// Print so many points at equal steps of length, both ends included: station (length from the start), x, y,
    /// heading (radians), curvature.
    #[arg(long, value_name = "N", value_parser = numbers::samples, allow_hyphen_values = true)]
    samples: Option<u32>,
    /// Print the samples as CSV, and nothing else; an offset curve is printed as JSON only.
    #[arg(long, requires = "samples", conflicts_with = "offset")]
    csv: bool,
    /// Distance of an offset curve, positive to the left.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    offset: Option<f64>,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    if let Some(d) = args.offset.filter(|d| !d.is_finite()) {
        return Err(Error::domain("--offset", d, "finite"));
    }
    let courses = args.files.courses()?;
    let blame = |place: &str, e: Error| args.files.blame(e.at(place));
    let figure = || figure::measured(courses.iter().map(|(_, course)| course), args.offset);
    if let Some(count) = args.samples.filter(|_| args.csv) {
        let samples =
            courses.iter().map(|(place, course)| course.stations(count as usize).map_err(|e| blame(place, e)));
        let samples = samples.collect::<Result<Vec<_>>>()?;
        output::stream(|out| {
            writeln!(out, "path,{}", Station::COLUMNS.join(","))?;
            (0..).zip(&samples).try_for_each(|(i, samples)| output::rows(out, &format!("{i},"), samples, ","))
        })?;
        return args.files.draw(figure);
    }
    let paths = courses
        .iter()
        .map(|(place, course)| Measured::new(course, args.samples, args.offset).map_err(|e| blame(place, e)));
    let output = Measures { paths: paths.collect::<Result<_>>()? };
    args.files.finish(&output, figure)
}
