//! `curve --family involute`: the spiral that exists whenever any does (Kurnosenko).

use super::{Found, SAMPLES, end_circles};
use serde::Serialize;
use spiral_atlas::family::any_spiral::{Involute, InvoluteOutcome, InvolutePoint, Spiral, Split};
use spiral_atlas::plot::{CurveFigure, Graph};
use spiral_atlas::transition::{Ends, Frame, involute_between};
use spiral_atlas::{Error, Result};
use std::f64::consts::TAU;

/// What is known of two ends, and the curve in the user's units.
#[derive(Debug, Serialize)]
pub struct Told {
    ends: Ends,
    #[serde(flatten)]
    spiral: Spiral,
    /// Length from end to end.
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<f64>,
    /// Points at equal lengths.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    samples: Vec<Sample>,
    #[serde(skip)]
    frame: Frame,
    /// The library's directions count the turns about the start.
    #[serde(skip)]
    turned: f64,
}

#[derive(Debug, Serialize)]
struct Sample {
    s: f64,
    point: [f64; 2],
    /// Followed along the curve from the direction at the start, so that full turns show.
    direction: f64,
    curvature: f64,
}

pub fn find(ends: &Ends, turns: [u32; 2], samples: u32) -> Result<Told> {
    let (spiral, frame) = involute_between(ends, turns)?;
    let mut told = Told { ends: *ends, spiral, length: None, samples: Vec::new(), frame, turned: 0.0 };
    if let Some(curve) = told.spiral.curve().cloned() {
        told.length = Some(curve.length() * told.unit());
        told.turned = TAU * ((curve.at(0.0).direction - told.spiral.chord.alpha) / TAU).round();
        told.samples = curve.samples(samples as usize)?.into_iter().map(|(s, at)| told.sample(s, at)).collect();
    }
    Ok(told)
}

impl Told {
    /// Half the chord in the user's unit.
    fn unit(&self) -> f64 {
        let [x, y] = self.frame.half_chord;
        x.hypot(y)
    }

    /// A point of the chord's frame, at a length in half chords, in the user's frame.
    fn sample(&self, s: f64, at: InvolutePoint) -> Sample {
        let (unit, [x, y]) = (self.unit(), self.frame.half_chord);
        Sample {
            s: s * unit,
            point: self.frame.point(at.point),
            direction: at.direction - self.turned + y.atan2(x),
            curvature: at.curvature / unit,
        }
    }

    /// Samples at equal steps of the involute's parameter, the ends included.
    fn drawn(&self, curve: &Involute) -> Vec<Sample> {
        let step = |i: usize| i as f64 / (SAMPLES - 1) as f64;
        (0..SAMPLES).map(step).map(|f| self.sample(curve.length_to(f), curve.at(f))).collect()
    }
}

impl Found for Told {
    fn text(&self) -> String {
        let Spiral { q, omega, turns, .. } = self.spiral;
        let mut text = match &self.spiral.outcome {
            InvoluteOutcome::None(why) => format!("no spiral of any kind: {why}\n"),
            InvoluteOutcome::Curve { curve, split } => {
                let [rho, lambda] = curve.map();
                let mut text = format!(
                    "involute's image: theta = {:?}, t0 = {:?}, rho = {rho:?}, lambda = {lambda:?}; length {:?}\n",
                    curve.theta(),
                    curve.t0(),
                    self.length.unwrap_or_default(),
                );
                let [n1, n2] = curve.turns();
                text += &match split {
                    Split::Asked if turns == [0, 0] => String::new(),
                    Split::Asked => format!("turns {n1} times about its start and {n2} times about its end, as asked\n"),
                    Split::Other => format!(
                        "turns {n1} times about its start and {n2} times about its end, not {},{}, which some other spiral does\n",
                        turns[0], turns[1]
                    ),
                    Split::Impossible { least, most } => format!(
                        "turns {n1} times about its start and {n2} times about its end, not {},{}: any spiral turns {least} to {most} \
                         times about its start\n",
                        turns[0], turns[1]
                    ),
                };
                text + "  s, x, y, direction, curvature\n"
            }
        };
        for Sample { s, point: [x, y], direction, curvature } in &self.samples {
            text += &format!("  {s:?}, {x:?}, {y:?}, {direction:?}, {curvature:?}\n");
        }
        text + &format!("Q = {q:?}, omega = {omega:?}")
    }

    fn figure(&self) -> Result<CurveFigure> {
        let curve = self.spiral.curve().ok_or_else(|| Error::Domain("no spiral of any kind has these ends".into()))?;
        let (samples, q) = (self.drawn(curve), self.spiral.q);
        let slope = |w: &[Sample]| [0.5 * (w[0].s + w[1].s), (w[1].curvature - w[0].curvature) / (w[1].s - w[0].s)];
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
