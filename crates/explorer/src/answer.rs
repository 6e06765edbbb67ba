//! Curves, joins and roads: what the library answers, with points to draw.

use serde::Deserialize;
use serde_json::{Value, json};
use spiral_atlas::Result;
use spiral_atlas::export::{OpenDrive, opendrive};
use spiral_atlas::path::Course;
use spiral_atlas::transition::join::{self, join};
use spiral_atlas::transition::{
    self, EndCircle, InvoluteBetween, Kind, NoSpiral, Piece, Placement, Turn, Why, fitted, involute_between, nearby,
    ph_spiral, polyline, spiral, why_no_spiral,
};

/// Points of a curve that is drawn, less one.
const STEPS: usize = 160;
/// The same of one that is no spiral.
const OTHER_STEPS: usize = 80;
/// The same of a piece of a join.
const PIECE_STEPS: usize = 64;
/// Most points of an involute that are drawn: one that turns often has more.
const MOST_POINTS: usize = 1200;

/// Two ends, as the page has them.
#[derive(Clone, Copy, Deserialize)]
struct Ends {
    start: [f64; 2],
    end: [f64; 2],
    start_direction: f64,
    end_direction: f64,
    start_curvature: f64,
    end_curvature: f64,
}

impl From<Ends> for transition::Ends {
    fn from(ends: Ends) -> Self {
        let Ends { start, end, start_direction, end_direction, start_curvature, end_curvature } = ends;
        Self { start, end, start_direction, end_direction, start_curvature, end_curvature }
    }
}

/// The curves of some kinds between two ends.
#[derive(Deserialize)]
pub(crate) struct Curves {
    ends: Ends,
    kinds: Vec<Kind>,
}

/// What would help where there is none.
#[derive(Deserialize)]
pub(crate) struct Advice {
    ends: Ends,
    kind: Kind,
}

/// An end of a join.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum End {
    State { point: [f64; 2], direction: f64, curvature: f64 },
    Line { point: [f64; 2], direction: f64 },
    Circle { centre: [f64; 2], radius: f64, turn: Turn },
}

impl From<End> for join::End {
    fn from(end: End) -> Self {
        match end {
            End::State { point, direction, curvature } => join::State { point, direction, curvature }.into(),
            End::Line { point, direction } => Self::Line { point, direction },
            End::Circle { centre, radius, turn } => Self::Circle { centre, radius, turn },
        }
    }
}

/// A path between two states, or two lines and circles.
#[derive(Deserialize)]
pub(crate) struct Join {
    from: End,
    to: End,
    greatest_curvature: f64,
    family: join::Family,
    objective: join::Objective,
    most_pieces: usize,
}

/// Pieces as a road.
#[derive(Deserialize)]
pub(crate) struct Road {
    pieces: Vec<Piece>,
}

/// Of each point of a curve: arc length, x, y, heading, curvature.
type Samples = Vec<[f64; 5]>;

impl Curves {
    pub(crate) fn answer(self) -> Result<Value> {
        let ends = self.ends.into();
        let (datum, placement) = Placement::normalise(&ends)?;
        let mut curves = serde_json::Map::new();
        for kind in self.kinds {
            // What one kind cannot answer, another can.
            let found = curve(&ends, kind).unwrap_or_else(|e| json!({ "spiral": false, "error": e.to_string() }));
            curves.insert(kind.name().to_owned(), found);
        }
        let turn = placement.turn();
        Ok(json!({
            "ends": ends, "datum": datum, "placement": placement, "unit": placement.unit(), "turn": turn,
            "against_chord": placement.against_chord(&datum), "circles": ends.circles(), "curves": curves,
        }))
    }
}

/// The curve of one kind.
fn curve(ends: &transition::Ends, kind: Kind) -> Result<Value> {
    match fitted("kind", kind.name())? {
        Kind::Cubic => {
            let answer = spiral(ends)?;
            let piece = answer.chosen().map(|s| (s.piece(), json!({ "margin": s.margin, "f0": s.f0, "f1": s.f1 })));
            let why = answer.outcome.as_ref().err().map(|why| (why.sentence("cubic spiral"), json!(why)));
            told(piece, why, answer.solutions.iter().map(|s| other(&s.piece())).collect())
        }
        Kind::PhQuintic => {
            let answer = ph_spiral(ends)?;
            let facts =
                |s: &transition::PhSolution| json!({ "margin": s.margin, "a": s.a, "b": s.b, "energy": s.energy });
            let piece = answer.chosen().map(|s| (Piece::PhQuintic(s.curve), facts(s)));
            let why = answer.outcome.as_ref().err().map(|why| (why.sentence("PH quintic spiral"), json!(why)));
            told(piece, why, answer.solutions.iter().map(|s| other(&Piece::PhQuintic(s.curve))).collect())
        }
        _ => {
            let (found, frame) = involute_between(ends, [0, 0])?;
            let Some((curve, between)) = found.curve().zip(InvoluteBetween::of(ends, &found, &frame)) else {
                let text = why_no_spiral(ends, &found).unwrap_or_default();
                let why = NoSpiral::of(ends)?.map(Why::NoSpiralOfAnyKind);
                return told(None, Some((text, json!(why))), Vec::new());
            };
            let unit = frame.unit();
            let all = polyline(curve);
            let thin = all.len().div_ceil(MOST_POINTS);
            let last = all.len() - 1;
            let points = all.iter().enumerate().filter(|(i, _)| i % thin == 0 || *i == last).map(|(_, (at, s))| {
                let [x, y] = frame.point(at.point);
                [s * unit, x, y, at.direction + frame.half_chord[1].atan2(frame.half_chord[0]), at.curvature / unit]
            });
            let points: Samples = points.collect();
            let facts = json!({ "theta": curve.theta(), "t0": curve.t0(), "turns": curve.turns() });
            drawn(&Piece::Involute(between), &facts, &points)
        }
    }
}

/// What has these ends and is no spiral is drawn, too.
fn other(piece: &Piece) -> Value {
    json!({ "samples": samples(piece, OTHER_STEPS, 0.0) })
}

/// A curve, or why there is none and what else has these ends.
fn told(found: Option<(Piece, Value)>, why: Option<(String, Value)>, others: Vec<Value>) -> Result<Value> {
    match found {
        Some((piece, facts)) => drawn(&piece, &facts, &samples(&piece, STEPS, 0.0)),
        None => {
            let (reason, why) = why.unwrap_or_default();
            Ok(json!({ "spiral": false, "reason": reason, "why": why, "others": others }))
        }
    }
}

fn drawn(piece: &Piece, facts: &Value, samples: &Samples) -> Result<Value> {
    let greatest = samples.iter().map(|s| s[4].abs()).fold(0.0, f64::max);
    Ok(json!({
        "spiral": true, "length": piece.length(), "greatest_curvature": greatest,
        "control_points": piece.control_points(),
        "piece": piece, "facts": facts, "samples": samples,
    }))
}

/// Points at equal steps of the parameter, which lie close where the curve bends.
fn samples(piece: &Piece, steps: usize, before: f64) -> Samples {
    let [from, to] = piece.range();
    let at = |i: usize| {
        let t = from + (to - from) * (i as f64 / steps as f64);
        let place = piece.at(t);
        [before + piece.length_to(t), place.point[0], place.point[1], place.heading, place.curvature]
    };
    (0..=steps).map(at).collect()
}

impl Advice {
    pub(crate) fn answer(self) -> Result<Value> {
        let ends = self.ends.into();
        let why = match self.kind {
            Kind::Cubic => spiral(&ends)?.with_remedies()?.outcome.err().map(|why| ("cubic spiral", why)),
            Kind::PhQuintic => ph_spiral(&ends)?.with_remedies()?.outcome.err().map(|why| ("PH quintic spiral", why)),
            _ => None,
        };
        let (reason, why) = why.map(|(kind, why)| (why.sentence(kind), json!(why))).unwrap_or_default();
        Ok(json!({ "reason": reason, "why": why, "nearby": nearby(&ends, self.kind)? }))
    }
}

impl Join {
    pub(crate) fn answer(self) -> Result<Value> {
        let request = join::Request {
            family: self.family,
            objective: self.objective,
            most_pieces: self.most_pieces,
            ..join::Request::new(self.from, self.to, self.greatest_curvature)
        };
        let circle = |end: &join::End| match *end {
            join::End::State(join::State { point, direction, curvature }) => {
                EndCircle::new(point, direction, curvature)
            }
            join::End::Line { point, direction } => EndCircle::Line { point, direction },
            join::End::Circle { centre, radius, .. } => EndCircle::Circle { centre, radius },
        };
        let circles = [circle(&request.from), circle(&request.to)];
        Ok(match join(&request)? {
            Err(reason) => json!({ "circles": circles, "reason": reason }),
            Ok(found) => {
                let mut before = 0.0;
                let mut parts = Vec::with_capacity(found.pieces.len());
                for piece in &found.pieces {
                    parts.push(samples(piece, PIECE_STEPS, before));
                    before += piece.length();
                }
                json!({ "circles": circles, "path": found, "samples": parts })
            }
        })
    }
}

impl Road {
    pub(crate) fn answer(self) -> Result<Value> {
        let (text, fit) = opendrive(&[Course::new(self.pieces)?], &OpenDrive { lane_width: 3.5, tolerance: 0.001 })?;
        Ok(json!({ "text": text, "off": fit.error }))
    }
}
