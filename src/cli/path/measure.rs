//! `path measure`.

use super::input::{Span, curves, objects};
use super::{Files, Outcome, figure};
use serde::{Deserialize, Serialize};
use spiral_atlas::curve::PhQuintic;
use spiral_atlas::{Error, Result};

/// Samples of a path, at most.
const MOST: usize = 1_000_000;

/// Tell of paths: points at equal steps of arc length, where the curvature is extreme and where it changes its sign, and offset curves.
///
/// Input: {"paths": [{"spans": [{"start": [x, y], "preimage": [[u, v], ..]}, ..]}, ..]}, as the other tools print it; other fields are left out
/// of account. Lengths are from the start of the path, parameters those of the span. An offset is rational of degree 9: at parameter t it is
/// the Bernstein form `numerator` divided by the form `weight`.
///
/// Direction and curvature are null where the path stands still.
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  spiral-atlas path spline examples/lap.json | spiral-atlas path measure - --samples 100 --offset 0.2"
)]
pub struct Args {
    #[command(flatten)]
    files: Files,
    /// Steps of equal length, at most 1,000,000; with 0 there are no samples.
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    samples: usize,
    /// Distance of an offset curve, positive to the left.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    offset: Option<f64>,
}

#[derive(Deserialize)]
struct Input {
    #[serde(deserialize_with = "objects")]
    paths: Vec<Path>,
}

#[derive(Deserialize)]
struct Path {
    #[serde(deserialize_with = "objects")]
    spans: Vec<Span>,
}

#[derive(Serialize)]
struct Output {
    paths: Vec<Measured>,
}

#[derive(Serialize)]
struct Measured {
    length: f64,
    bending_energy: f64,
    absolute_rotation: f64,
    curvature_extrema: Vec<Station>,
    inflections: Vec<Station>,
    samples: Vec<Station>,
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<Vec<Offset>>,
}

/// A point of a path and what is known there.
#[derive(Serialize)]
struct Station {
    length: f64,
    span: usize,
    parameter: f64,
    point: [f64; 2],
    direction: f64,
    curvature: f64,
}

#[derive(Serialize)]
struct Offset {
    numerator: Vec<[f64; 2]>,
    weight: Vec<f64>,
}

/// Spans with the lengths of the path before them.
struct Course<'p> {
    spans: &'p [PhQuintic],
    before: Vec<f64>,
    length: f64,
}

impl Course<'_> {
    fn new(spans: &[PhQuintic]) -> Course<'_> {
        let mut length = 0.0;
        let mut before = Vec::with_capacity(spans.len());
        for span in spans {
            before.push(length);
            length += span.length();
        }
        Course { spans, before, length }
    }

    fn station(&self, span: usize, parameter: f64) -> Station {
        let curve = &self.spans[span];
        let tangent = curve.tangent(parameter);
        Station {
            length: self.before[span] + curve.length_to(parameter),
            span,
            parameter,
            point: curve.point(parameter),
            direction: tangent[1].atan2(tangent[0]),
            curvature: curve.curvature(parameter),
        }
    }

    /// Where the path is so long from its start.
    fn at(&self, length: f64) -> Station {
        let span = self.before.partition_point(|before| *before <= length).max(1) - 1;
        self.station(span, self.spans[span].parameter_at(length - self.before[span]))
    }

    /// Where the curvature ends to rise or to fall, also where spans join.
    fn extrema(&self) -> Vec<Station> {
        let one = |i: usize| {
            let mut all = self.spans[i].curvature_extrema();
            let next = self.spans.get(i + 1).map_or(0.0, |next| rise(next, false));
            all.extend((rise(&self.spans[i], true) * next < 0.0).then_some(1.0));
            all.into_iter().map(move |t| self.station(i, t))
        };
        (0..self.spans.len()).flat_map(one).collect()
    }

    fn stations(&self, parameters: fn(&PhQuintic) -> Vec<f64>) -> Vec<Station> {
        let all = self.spans.iter().enumerate().flat_map(|(i, span)| parameters(span).into_iter().map(move |t| (i, t)));
        all.map(|(i, t)| self.station(i, t)).collect()
    }
}

/// A number of the sign of the curvature's slope at an end: `σh' - 2hσ'`.
fn rise(span: &PhQuintic, last: bool) -> f64 {
    let ([s0, s1, _, s3, s4], [h0, h1, h2]) = (span.speed_coefficients(), span.turn_coefficients());
    if last { s4 * (h2 - h1) - 4.0 * h2 * (s4 - s3) } else { s0 * (h1 - h0) - 4.0 * h0 * (s1 - s0) }
}

fn measured(spans: &[PhQuintic], args: &Args) -> Measured {
    let course = Course::new(spans);
    let sum = |f: fn(&PhQuintic) -> f64| spans.iter().map(f).sum();
    let part = |i: usize| if i == args.samples { course.length } else { course.length * (i as f64 / args.samples as f64) };
    let samples = if args.samples == 0 { 0..0 } else { 0..args.samples + 1 };
    let offset = |d: f64| {
        let one = |span: &PhQuintic| {
            let spiral_atlas::curve::Offset { numerator, weight } = span.offset(d);
            Offset { numerator, weight }
        };
        spans.iter().map(one).collect()
    };
    Measured {
        length: course.length,
        bending_energy: sum(PhQuintic::bending_energy),
        absolute_rotation: sum(PhQuintic::absolute_rotation),
        curvature_extrema: course.extrema(),
        inflections: course.stations(PhQuintic::inflections),
        samples: samples.map(|i| course.at(part(i))).collect(),
        offset: args.offset.map(offset),
    }
}

pub fn run(args: &Args) -> Result<Outcome> {
    if args.samples > MOST {
        return Err(Error::Domain(format!("--samples is {}; at most {MOST} are told", args.samples)));
    }
    if let Some(d) = args.offset.filter(|d| !d.is_finite()) {
        return Err(Error::Domain(format!("--offset is {d:?}; it must be a finite number")));
    }
    let input: Input = args.files.read()?;
    let named =
        |(i, path): (usize, &Path)| curves(&path.spans).map_err(|e| args.files.blame(Error::Domain(format!("paths[{i}]: {e}"))));
    let paths = input.paths.iter().enumerate().map(named).collect::<Result<Vec<_>>>()?;
    let output = Output { paths: paths.iter().map(|spans| measured(spans, args)).collect() };
    args.files.finish(&output, || figure::measured(&paths, args.offset))
}
