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

    /// Whether it ends where it starts, in the same direction.
    fn closed(&self) -> bool {
        let (first, last) = (&self.spans[0], &self.spans[self.spans.len() - 1]);
        let ([a, b], [c, d]) = (first.tangent(0.0), last.tangent(1.0));
        first.start == last.end && a * c + b * d > 1.0 - 1e-9
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

    /// Where the curvature ends to rise or to fall.
    fn extrema(&self) -> Vec<Station> {
        self.stations(PhQuintic::curvature_extrema, rise)
    }

    /// Where it changes its sign.
    fn inflections(&self) -> Vec<Station> {
        let sides = |span: &PhQuintic| {
            // Where the curvature is 0 at an end, within rounding, it has the sign of its slope there: none on a line.
            let [h0, h1, h2] = span.turn_coefficients();
            let none = 1e-12 * h0.abs().max(h1.abs()).max(h2.abs());
            [h0, h2].map(|h| if h.abs() <= none { h1 } else { h })
        };
        self.stations(PhQuintic::inflections, sides)
    }

    /// Parameters inside spans, and joints where the sign that spans have beside them changes. Spans that have none, such as lines, are passed
    /// over: then it changes at the start of the next one. A path that ends where it starts joins there, too.
    fn stations(&self, inside: fn(&PhQuintic) -> Vec<f64>, sides: fn(&PhQuintic) -> [f64; 2]) -> Vec<Station> {
        let sides: Vec<[f64; 2]> = self.spans.iter().map(sides).collect();
        let mut last = if self.closed() { sides.iter().rev().map(|s| s[1]).find(|s| *s != 0.0).unwrap_or(0.0) } else { 0.0 };
        let mut all = Vec::new();
        for (i, [first, end]) in sides.iter().enumerate() {
            if first * last < 0.0 {
                all.push(self.station(i, 0.0));
            }
            last = [*end, *first, last].into_iter().find(|s| *s != 0.0).unwrap_or(0.0);
            all.extend(inside(&self.spans[i]).into_iter().map(|t| self.station(i, t)));
        }
        // What lies at a joint may be seen from both sides.
        all.dedup_by(|next, last| next.length - last.length <= 1e-9 * self.length);
        all
    }
}

/// Numbers of the sign of the curvature's slope at both ends: `σh' - 2hσ'`.
fn rise(span: &PhQuintic) -> [f64; 2] {
    let ([s0, s1, _, s3, s4], [h0, h1, h2]) = (span.speed_coefficients(), span.turn_coefficients());
    [s0 * (h1 - h0) - 4.0 * h0 * (s1 - s0), s4 * (h2 - h1) - 4.0 * h2 * (s4 - s3)]
}

fn measured(spans: &[PhQuintic], args: &Args) -> Result<Measured> {
    let course = Course::new(spans);
    let sum = |f: fn(&PhQuintic) -> f64| spans.iter().map(f).sum();
    let part = |i: usize| if i == args.samples { course.length } else { course.length * (i as f64 / args.samples as f64) };
    let samples = if args.samples == 0 { 0..0 } else { 0..args.samples + 1 };
    let offset = |d: f64| {
        let one = |(i, span): (usize, &PhQuintic)| {
            let spiral_atlas::curve::Offset { numerator, weight } = span.offset(d);
            if numerator.iter().flatten().chain(&weight).all(|x| x.is_finite()) {
                return Ok(Offset { numerator, weight });
            }
            let what = format!("spans[{i}]: its offset at distance {d:?} leaves the range of doubles; change the unit of length");
            Err(Error::Domain(what))
        };
        spans.iter().enumerate().map(one).collect::<Result<_>>()
    };
    Ok(Measured {
        length: course.length,
        bending_energy: sum(PhQuintic::bending_energy),
        absolute_rotation: sum(PhQuintic::absolute_rotation),
        curvature_extrema: course.extrema(),
        inflections: course.inflections(),
        samples: samples.map(|i| course.at(part(i))).collect(),
        offset: args.offset.map(offset).transpose()?,
    })
}

pub fn run(args: &Args) -> Result<Outcome> {
    if args.samples > MOST {
        return Err(Error::Domain(format!("--samples is {}; at most {MOST} are told", args.samples)));
    }
    if let Some(d) = args.offset.filter(|d| !d.is_finite()) {
        return Err(Error::Domain(format!("--offset is {d:?}; it must be a finite number")));
    }
    let input: Input = args.files.read()?;
    let blame = |i: usize, e: Error| args.files.blame(Error::Domain(format!("paths[{i}]: {e}")));
    let named = |(i, path): (usize, &Path)| curves(&path.spans).map_err(|e| blame(i, e));
    let courses = input.paths.iter().enumerate().map(named).collect::<Result<Vec<_>>>()?;
    let paths = courses.iter().enumerate().map(|(i, spans)| measured(spans, args).map_err(|e| blame(i, e)));
    let output = Output { paths: paths.collect::<Result<_>>()? };
    args.files.finish(&output, || figure::measured(&courses, args.offset))
}
