//! `curve --family trig-quintic`: the five templates of Misro, Ramli and Ali, with spirals that are some.

use super::{Reportable, SAMPLES};
use serde::{Serialize, Serializer};
use spiral_atlas::Result;
use spiral_atlas::curve::Jet;
use spiral_atlas::plot::{self, CurveFigure, Graph};
pub(super) use spiral_atlas::transition::templates::Request;
use spiral_atlas::transition::templates::{NoSpirals, Path, Template, path};
use spiral_atlas::transition::{EndCircle, Piece, Sample, TrigPart};

/// What was asked and what was found.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
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

pub(super) fn find(request: &Request) -> Result<Answer> {
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
