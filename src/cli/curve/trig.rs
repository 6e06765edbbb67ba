//! `curve trig-quintic`: the five templates of Misro, Ramli and Ali, with spirals that are some.

use super::super::{Outcome, numbers, refuse};
use super::options::{Output, Segment};
use super::{Reportable, SAMPLES};
use serde::{Serialize, Serializer};
use spiral_atlas::Result;
use spiral_atlas::curve::Jet;
use spiral_atlas::family::trig_quintic::{Scaling, Shape};
use spiral_atlas::plot::{self, CurveFigure, Graph};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::transition::templates::{self, NoSpirals, Path, Request, Template, path};
use spiral_atlas::transition::{EndCircle, Piece, Sample, TrigPart};

#[derive(clap::Args)]
pub(super) struct Args {
    /// What is joined, in the direction of travel; `--from` is its start, for `s` and `c` the point between the
    /// spirals.
    #[arg(long, value_name = "NAME", value_enum)]
    template: Joined,
    #[command(flatten)]
    first: Segment,
    /// Shape m of the first spiral.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    m: f64,
    /// Its shape p, from -4 to 1.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = 0.0)]
    p: f64,
    /// Its shape q, from -4 to 1.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(default_value_t = 0.0)]
    q: f64,
    /// Its s / tan(angle/2); left out: 6, or with --as-printed the paper's (6 + m)/2.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    ratio: Option<f64>,
    /// The second spiral of `line-line`, `s` and `c`; left out: as the first.
    #[arg(long, value_name = "ANGLE,RADIUS,RATIO,M,P,Q", value_parser = parse_second, allow_hyphen_values = true)]
    second: Option<templates::Segment>,
    /// Radius of the outer circle, for `circle-in-circle`.
    #[arg(long, value_name = "NUMBER", value_parser = numbers::number, allow_hyphen_values = true)]
    #[arg(required_if_eq("template", "circle-in-circle"))]
    outer: Option<f64>,
    /// Scale the curve as the paper does, which misses the end curvature.
    #[arg(long)]
    as_printed: bool,
    #[command(flatten)]
    output: Output,
}

/// What the templates join.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Joined {
    LineCircle,
    LineLine,
    S,
    C,
    CircleInCircle,
}

impl Args {
    pub(super) fn run(&self) -> Result<Outcome> {
        let &Args { m, p, q, .. } = self;
        let &Segment { from, start_direction, turn, radius, angle } = &self.first;
        let ratio = self.ratio.unwrap_or(if self.as_printed { 0.5 * (6.0 + m) } else { 6.0 });
        let first = templates::Segment { shape: Shape { ratio, theta: angle, m, p, q }, radius };
        let second = self.second.unwrap_or(first);
        let template = match (self.template, self.second, self.outer) {
            (Joined::LineCircle, None, None) => Template::LineCircle(first),
            (Joined::LineLine, _, None) => Template::LineLine { first, second },
            (Joined::S, _, None) => Template::S { first, second },
            (Joined::C, _, None) => Template::C { first, second },
            (Joined::CircleInCircle, None, Some(outer)) => Template::CircleInCircle { inner: first, outer },
            _ => refuse("`--second` is for `line-line`, `s` and `c`, `--outer` for `circle-in-circle`"),
        };
        let scaling = if self.as_printed { Scaling::AsPrinted } else { Scaling::Corrected };
        let request = Request { template, at: from, direction: start_direction, turn, scaling };
        self.output.report(|_| find(&request))
    }
}

/// An angle and five numbers with commas between.
fn parse_second(text: &str) -> std::result::Result<templates::Segment, String> {
    let wrong = || format!("{text:?} is not an angle and five finite numbers `angle,radius,ratio,m,p,q`");
    let (angle, rest) = text.split_once(',').ok_or_else(wrong)?;
    let theta = parse_angle(angle.trim()).map_err(|_| wrong())?;
    let rest: Vec<f64> = rest.split(',').map_while(|cell| cell.trim().parse().ok()).collect();
    match rest[..] {
        [radius, ratio, m, p, q] if rest.iter().all(|x| x.is_finite()) => {
            Ok(templates::Segment { shape: Shape { ratio, theta, m, p, q }, radius })
        }
        _ => Err(wrong()),
    }
}

/// What was asked and what was found.
#[derive(Debug, Serialize)]
struct Answer {
    request: Request,
    #[serde(serialize_with = "spirals_or_not")]
    outcome: std::result::Result<Path, NoSpirals>,
}

fn spirals_or_not<S: Serializer>(
    outcome: &std::result::Result<Path, NoSpirals>,
    serializer: S,
) -> std::result::Result<S::Ok, S::Error> {
    match outcome {
        Ok(path) => serializer.serialize_newtype_variant("Outcome", 0, "spirals", path),
        Err(none) => serializer.serialize_newtype_variant("Outcome", 1, "no-spirals", none),
    }
}

fn find(request: &Request) -> Result<Answer> {
    Ok(Answer { request: *request, outcome: path(request)? })
}

impl Answer {
    /// The path, of spirals or not.
    fn path(&self) -> &Path {
        match &self.outcome {
            Ok(path) | Err(NoSpirals { path, .. }) => path,
        }
    }

    fn title(&self) -> String {
        let name = match self.request.template {
            Template::LineCircle(_) => "line to circle",
            Template::LineLine { .. } => "line to line",
            Template::S { .. } => "S, circle to circle",
            Template::C { .. } => "C, circle to circle",
            Template::CircleInCircle { .. } => "circle in circle",
        };
        match &self.outcome {
            Ok(path) if path.parts.len() == 1 => format!("{name}: a trigonometric spiral"),
            Ok(_) => format!("{name}: two trigonometric spirals"),
            Err(NoSpirals { why, .. }) => {
                format!(
                    "{name}, {}",
                    if why.starts_with("as printed") { "as printed: not a spiral" } else { "not a spiral" }
                )
            }
        }
    }
}

impl Reportable for Answer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        match &self.outcome {
            Ok(path) => Ok(pieces(path)),
            Err(NoSpirals { why, .. }) => Err(why.clone()),
        }
    }

    fn straight(&self) -> [bool; 2] {
        let line = |circle: Option<&EndCircle>| matches!(circle, Some(EndCircle::Line { .. }));
        let circles = &self.path().circles;
        [line(circles.first()), line(circles.get(1))]
    }

    fn text(&self) -> String {
        let mut text = match &self.outcome {
            Ok(path) => {
                let length: f64 = pieces(path).iter().map(Piece::length).sum();
                format!("{}, length {length:?}\n", self.title())
            }
            Err(NoSpirals { why, .. }) => format!("{why}\n"),
        };
        for part in &self.path().parts {
            let (curve, [from, to]) = (part.curve, [part.from, part.to]);
            text += &format!("p = {:?}, q = {:?}, t from {from:?} to {to:?}; control points\n", curve.p, curve.q);
            for [x, y] in curve.points() {
                text += &format!("  ({x:?}, {y:?})\n");
            }
        }
        text.trim_end().to_owned()
    }

    fn figure(&self) -> Result<CurveFigure> {
        let path = self.path();
        let parts = path.samples(SAMPLES)?;
        let joints = parts[1..].iter().map(|part| part[0].s).collect();
        let samples: Vec<Sample> = parts.into_iter().flatten().collect();
        let control = path.parts.iter().flat_map(|part| part.curve.points()).collect();
        let note = match &self.outcome {
            Ok(_) => String::new(),
            Err(NoSpirals { why, .. }) => {
                why.trim_start_matches("as printed: ").trim_start_matches("not a spiral: ").into()
            }
        };
        Ok(CurveFigure {
            title: self.title(),
            note,
            curve: samples.iter().map(|s| s.point).collect(),
            control,
            circles: circles(path),
            parameter: "s".into(),
            curvature: Graph { label: "κ".into(), points: samples.iter().map(|s| [s.s, s.curvature]).collect() },
            derivative: Graph {
                label: "dκ/ds".into(),
                points: samples.iter().map(|s| [s.s, s.curvature_ds]).collect(),
            },
            joints,
        })
    }
}

fn pieces(path: &Path) -> Vec<Piece> {
    path.parts
        .iter()
        .map(|part| Piece::TrigQuintic(TrigPart { curve: part.curve, from: part.from, to: part.to }))
        .collect()
}

/// What the path joins, as the figure wants it.
fn circles(path: &Path) -> Vec<plot::EndCircle> {
    let (Some(first), Some(last)) = (path.parts.first(), path.parts.last()) else { return Vec::new() };
    let places: Vec<(Jet, &str)> = [(first.ends()[0], "what it starts from"), (last.ends()[1], "what it leads to")]
        .into_iter()
        .chain(path.parts[1..].iter().map(|part| (part.ends()[0], "between")))
        .collect();
    let circle = |((jet, label), circle): ((Jet, &str), &EndCircle)| {
        let curvature = match circle {
            EndCircle::Line { .. } => 0.0,
            EndCircle::Circle { centre, radius } => {
                let arm = [centre[0] - jet.point[0], centre[1] - jet.point[1]];
                (jet.first[0] * arm[1] - jet.first[1] * arm[0]).signum() / radius
            }
        };
        plot::EndCircle { at: jet.point, direction: jet.first, curvature, label: label.into() }
    };
    places.into_iter().zip(&path.circles).map(circle).collect()
}
