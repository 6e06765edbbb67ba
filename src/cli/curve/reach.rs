//! `curve reach-cubic|reach-ph`: a segment added to the end of a line or of an arc (Habib & Sakai, CGIV 2004).

use super::super::{Outcome, numbers, output, refuse};
use super::options::{Output, Segment, point};
use super::{Reportable, circle, drawn};
use serde::{Serialize, Serializer};
use spiral_atlas::family::reach::{Kind, Level};
use spiral_atlas::plot::CurveFigure;
use spiral_atlas::transition::segment::{Added, Base, Request, Target, add_segment};
use spiral_atlas::transition::{Piece, Turn};
use spiral_atlas::{Error, Result};

#[derive(clap::Args)]
pub(super) struct Args {
    /// What the segment is added to.
    #[arg(long, value_parser = numbers::named::<Base>(&["line", "circle"]))]
    base: Base,
    #[command(flatten)]
    segment: Segment,
    /// Where it ends.
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["m", "q"])]
    to: Option<[f64; 2]>,
    /// Its shape m, with q instead of its end.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, requires = "q")]
    m: Option<f64>,
    /// Its shape q.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true, requires = "m")]
    q: Option<f64>,
    #[command(flatten)]
    output: Output,
}

impl Args {
    pub(super) fn run(&self, kind: Kind) -> Result<Outcome> {
        let shape = self.m.zip(self.q).map(|(m, q)| Target::Shape { m, q });
        let target = shape
            .or(self.to.map(Target::Point))
            .unwrap_or_else(|| refuse("where it ends is needed: `--to X,Y`, or its shape `--m M --q Q`"));
        let &Segment { from, start_direction, turn, radius, angle } = &self.segment;
        let request =
            Request { base: self.base, start: from, direction: start_direction, turn, radius, theta: angle, target };
        self.output.report(|_| find(kind, &request))
    }
}

/// What was asked and what was found.
#[derive(Debug, Serialize)]
struct Answer {
    #[serde(skip)]
    kind: Kind,
    request: Request,
    #[serde(flatten, serialize_with = "segment_or_none")]
    outcome: std::result::Result<Added, String>,
}

/// `segment`, or `none` with the reason as its `why`.
fn segment_or_none<S: Serializer>(
    outcome: &std::result::Result<Added, String>,
    to: S,
) -> std::result::Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    #[serde(rename_all = "lowercase")]
    enum Fields<'a> {
        Segment(&'a Added),
        None { why: &'a str },
    }
    match outcome {
        Ok(added) => Fields::Segment(added),
        Err(why) => Fields::None { why },
    }
    .serialize(to)
}

fn find(kind: Kind, request: &Request) -> Result<Answer> {
    Ok(Answer { kind, request: *request, outcome: add_segment(kind, request)? })
}

impl Reportable for Answer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        match &self.outcome {
            Err(why) => Err(format!("no segment of `{}`: {why}", self.kind.name())),
            Ok(added) if added.level == Level::Exists => {
                Err("the only segment of this family that ends there is no spiral: its curvature is not monotone"
                    .into())
            }
            Ok(added) => Ok(vec![added.piece.clone()]),
        }
    }

    fn straight(&self) -> [bool; 2] {
        let line = self.request.base == Base::Line;
        [line, !line]
    }

    fn text(&self) -> String {
        match &self.outcome {
            Err(why) => format!("no segment of `{}`: {why}", self.kind.name()),
            Ok(added) => {
                let Added { case, xi, eta, m, q, level, length, end_direction, .. } = added;
                let mut text = format!(
                    "{}: case {case}, m = {m:?}, q = {q:?}, length {length:?}; control points\n",
                    level_words(*level)
                );
                for [x, y] in &added.control_points {
                    text += &format!("  ({x:?}, {y:?})\n");
                }
                text + &format!("end direction {end_direction:?}; (xi, eta) = ({xi:?}, {eta:?})")
            }
        }
    }

    fn figure(&self) -> Result<CurveFigure> {
        let Ok(added) = &self.outcome else { return Err(Error::invalid("there is no segment")) };
        let request = &self.request;
        let (curve, curvature, derivative) = drawn(request.start, &added.local_control_points);
        let bent = if request.turn == Turn::Right { -1.0 } else { 1.0 } / request.radius;
        let curvatures = if request.base == Base::Line { [0.0, bent] } else { [bent, 0.0] };
        let end = added.control_points.last().copied().unwrap_or(request.start);
        Ok(CurveFigure {
            title: format!(
                "{}: m = {:.6}, q = {:.6}, θ = {}",
                level_words(added.level),
                added.m,
                added.q,
                output::angle(request.theta)
            ),
            note: format!("{}, case {}: (ξ, η) = ({:.6}, {:.6})", self.kind.name(), added.case, added.xi, added.eta),
            curve,
            control: added.control_points.clone(),
            circles: vec![
                circle(request.start, request.direction, curvatures[0], "what it is added to"),
                circle(end, added.end_direction, curvatures[1], "circle of curvature at the end"),
            ],
            parameter: "t".into(),
            curvature,
            derivative,
            joints: Vec::new(),
        })
    }
}

/// What a level says, in words.
fn level_words(level: Level) -> &'static str {
    match level {
        Level::Exists => "segment, no spiral",
        Level::Exact => "spiral segment, beyond the paper's theorem",
        Level::Theorem => "spiral segment by the paper's theorem",
        Level::Paper => "spiral segment in the paper's region",
    }
}
