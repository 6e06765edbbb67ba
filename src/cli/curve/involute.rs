//! `curve --family involute`: the spiral that exists whenever any does (Kurnosenko).

use super::{Found, end_circles};
use serde::Serialize;
use spiral_atlas::family::any_spiral::{Involute, InvoluteOutcome, InvolutePoint, Spiral, Split};
use spiral_atlas::plot::{CurveFigure, Graph};
use spiral_atlas::transition::{Ends, Frame, InvoluteBetween, NoSpiral, Piece, involute_between};
use spiral_atlas::{Error, Result};
use std::f64::consts::TAU;

/// What is known of two ends, and the curve in the user's units.
#[derive(Debug, Serialize)]
pub struct Answer {
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

pub fn find(ends: &Ends, turns: [u32; 2]) -> Result<Answer> {
    let (spiral, frame) = involute_between(ends, turns)?;
    let mut answer = Answer { ends: *ends, spiral, length: None, frame };
    answer.length = answer.spiral.curve().map(|curve| curve.length() * answer.unit());
    Ok(answer)
}

impl Answer {
    /// Half the chord in the user's unit.
    fn unit(&self) -> f64 {
        let [x, y] = self.frame.half_chord;
        x.hypot(y)
    }

    /// Points so near to each other that a line through them looks like the curve, the ends included.
    fn drawn(&self, curve: &Involute) -> Vec<Drawn> {
        let unit = self.unit();
        let drawn = |(InvolutePoint { point, curvature, .. }, s): (InvolutePoint, f64)| Drawn {
            s: s * unit,
            point: self.frame.point(point),
            curvature: curvature / unit,
        };
        near_each_other(curve).into_iter().map(drawn).collect()
    }
}

/// Points of a curve, with the lengths up to them. Between neighbours it turns by a degree and a half or less and is no
/// longer than its 400th part, unless it would need more than 100,000 points for that: then turns are seen as rings.
fn near_each_other(curve: &Involute) -> Vec<(InvolutePoint, f64)> {
    const MOST: usize = 100_000;
    let turns: f64 = curve.turns().into_iter().map(f64::from).sum();
    let turn = 0.025f64.max(TAU * (turns + 2.0) / MOST as f64 * 2.0);
    let longest = curve.length() / 400.0;
    let at = |f: f64| (curve.at(f), curve.length_to(f));
    // So many pieces that an inflection lies within few.
    let mut waiting: Vec<_> = (0..32).rev().map(|i| (at(f64::from(i) / 32.0), at(f64::from(i + 1) / 32.0))).collect();
    let mut all = vec![at(0.0)];
    while let Some((from, to)) = waiting.pop() {
        let middle = 0.5 * (from.0.f + to.0.f);
        let near = (to.0.direction - from.0.direction).abs() <= turn && to.1 - from.1 <= longest;
        if near || all.len() + waiting.len() >= MOST || middle <= from.0.f || middle >= to.0.f {
            all.push(to);
        } else {
            let middle = at(middle);
            waiting.extend([(middle, to), (from, middle)]);
        }
    }
    all
}

impl Found for Answer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        if let Some(between) = InvoluteBetween::of(&self.ends, &self.spiral, &self.frame) {
            return Ok(vec![Piece::Involute(between)]);
        }
        // In the user's units; within rounding of a boundary, in those of the chord's frame.
        let why = match (NoSpiral::of(&self.ends), &self.spiral.outcome) {
            (Ok(Some(why)), _) => why.to_string(),
            (_, InvoluteOutcome::None(why)) => why.to_string(),
            _ => String::new(),
        };
        Err(format!("no spiral of any kind joins these ends: {why}"))
    }

    fn ends(&self) -> Option<&Ends> {
        Some(&self.ends)
    }

    fn text(&self) -> String {
        let Spiral { q, omega, turns, .. } = self.spiral;
        let text = match &self.spiral.outcome {
            InvoluteOutcome::None(_) => self.spirals().err().unwrap_or_default() + "\n",
            InvoluteOutcome::Curve { curve, split } => {
                let [rho, lambda] = curve.map();
                let mut text = format!(
                    "spiral, the image of an involute, length {:?}; it has no control points: ask for points with `--samples 101`\n\
                     theta = {:?}, t0 = {:?}, rho = {rho:?}, lambda = {lambda:?}\n",
                    self.length.unwrap_or_default(),
                    curve.theta(),
                    curve.t0(),
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
                text
            }
        };
        text + &format!("Q = {q:?}, omega = {omega:?}")
    }

    fn figure(&self) -> Result<CurveFigure> {
        let curve = self.spiral.curve().ok_or_else(|| Error::Domain("no spiral of any kind has these ends".into()))?;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// From a circle that it turns about many times, and without turns from a tight circle to a nearly straight end.
    #[test]
    fn figures_show_the_curve() {
        let turning = Ends {
            start: [0.0, 0.0],
            end: [200.0, 0.0],
            start_direction: -0.7,
            end_direction: 1.4,
            start_curvature: -0.003,
            end_curvature: 0.06,
        };
        let wide = Ends {
            start: [-1.0, 0.0],
            end: [1.0, 0.0],
            start_direction: -3.111120516395333,
            end_direction: 3.09052202872047,
            start_curvature: 1.4644171020186707,
            end_curvature: 0.0018417801985307334,
        };
        for (ends, turns) in
            [(turning, [0, 0]), (turning, [10, 10]), (turning, [200, 200]), (turning, [1000, 1000]), (wide, [0, 0])]
        {
            let found = find(&ends, turns).unwrap();
            let points = near_each_other(found.spiral.curve().unwrap());
            assert!(points.len() > 400 && points.len() < 110_000, "{turns:?}: {} points", points.len());
            let most = points.windows(2).map(|w| (w[1].0.direction - w[0].0.direction).abs()).fold(0.0, f64::max);
            assert!(most < 0.3 && points.windows(2).all(|w| w[0].1 < w[1].1), "{turns:?}: {most}");
        }
    }
}
