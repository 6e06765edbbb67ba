//! `curve involute`: the spiral that exists whenever any does (Kurnosenko).

use super::super::Outcome;
use super::super::numbers::two;
use super::options::Between;
use super::{Reportable, end_circles};
use serde::Serialize;
use spiral_atlas::family::any_spiral::{Involute, InvolutePoint, Spiral};
use spiral_atlas::plain::count;
use spiral_atlas::plot::{CurveFigure, Graph};
use spiral_atlas::transition::{Ends, Frame, InvoluteBetween, Kind, Piece, involute_between, polyline, why_no_spiral};
use spiral_atlas::{Error, Result};

#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    ends: Between,
    /// How often the curve turns about its start and about its end.
    #[arg(long, value_name = "N1,N2", value_parser = parse_turns, default_value = "0,0")]
    turns: [u32; 2],
}

impl Args {
    pub(super) fn run(&self) -> Result<Outcome> {
        self.ends.answer(|ends, _| find(ends, self.turns))
    }
}

/// Two whole numbers with a comma between.
fn parse_turns(text: &str) -> std::result::Result<[u32; 2], String> {
    two(text).ok_or_else(|| format!("{text:?} is not two numbers of turns `n1,n2`"))
}

/// What is known of two ends, and the curve in the user's units.
#[derive(Debug, Serialize)]
struct Answer {
    ends: Ends,
    #[serde(flatten)]
    spiral: Spiral,
    /// Length from end to end.
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<f64>,
    #[serde(skip)]
    frame: Frame,
}

/// A point for the figure.
struct Drawn {
    s: f64,
    point: [f64; 2],
    curvature: f64,
}

fn find(ends: &Ends, turns: [u32; 2]) -> Result<Answer> {
    let (spiral, frame) = involute_between(ends, turns)?;
    let mut answer = Answer { ends: *ends, spiral, length: None, frame };
    answer.length = answer.spiral.curve().map(|curve| curve.length() * frame.unit());
    Ok(answer)
}

impl Answer {
    /// Points so near to each other that a line through them looks like the curve, the ends included.
    fn drawn(&self, curve: &Involute) -> Vec<Drawn> {
        let unit = self.frame.unit();
        let drawn = |(InvolutePoint { point, curvature, .. }, s): (InvolutePoint, f64)| Drawn {
            s: s * unit,
            point: self.frame.point(point),
            curvature: curvature / unit,
        };
        polyline(curve).into_iter().map(drawn).collect()
    }
}

impl Reportable for Answer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        if let Some(between) = InvoluteBetween::of(&self.ends, &self.spiral, &self.frame) {
            return Ok(vec![Piece::Involute(between)]);
        }
        Err(why_no_spiral(&self.ends, &self.spiral).unwrap_or_default())
    }

    fn between(&self) -> Option<(&Ends, Kind)> {
        Some((&self.ends, Kind::Involute))
    }

    fn text(&self) -> String {
        let Spiral { q, omega, turns, .. } = self.spiral;
        let text = match (self.spirals(), self.spiral.curve()) {
            (Ok(_), Some(curve)) => {
                let [rho, lambda] = curve.map();
                let mut text = format!(
                    "spiral, the image of an involute, length {:?}; it has no control points: ask for points with \
                     `--samples 101`\n\
                     theta = {:?}, t0 = {:?}, rho = {rho:?}, lambda = {lambda:?}\n",
                    self.length.unwrap_or_default(),
                    curve.theta(),
                    curve.t0(),
                );
                if turns != [0, 0] {
                    let [start, end] = turns.map(|n| count(n as usize, "turn"));
                    text += &format!("{start} about its start and {end} about its end, as asked\n");
                }
                text
            }
            (spirals, _) => spirals.err().unwrap_or_default() + "\n",
        };
        text + &format!("Q = {q:?}, omega = {omega:?}")
    }

    fn figure(&self) -> Result<CurveFigure> {
        self.spirals().map_err(Error::invalid)?;
        let curve = self.spiral.curve().ok_or_else(|| Error::invalid("no spiral of any kind has these ends"))?;
        let (samples, q) = (self.drawn(curve), self.spiral.q);
        let slope = |w: &[Drawn]| [0.5 * (w[0].s + w[1].s), (w[1].curvature - w[0].curvature) / (w[1].s - w[0].s)];
        Ok(CurveFigure {
            title: format!("Image of an involute: θ = {:.3}°, t₀ = {:.5}", curve.theta().to_degrees(), curve.t0()),
            note: format!(
                "Q = {}, ω = {:.3}°, length {:.5}",
                if q.abs() < 1e-3 || q.abs() > 1e6 { format!("{q:.5e}") } else { format!("{q:.5}") },
                self.spiral.omega.to_degrees(),
                self.length.unwrap_or_default()
            ),
            curve: samples.iter().map(|s| s.point).collect(),
            control: Vec::new(),
            circles: end_circles(&self.ends),
            parameter: "s".into(),
            curvature: Graph { label: "κ".into(), points: samples.iter().map(|s| [s.s, s.curvature]).collect() },
            derivative: Graph { label: "Δκ/Δs".into(), points: samples.windows(2).map(slope).collect() },
            joints: Vec::new(),
        })
    }
}
