//! `curve cubic`: Habib & Sakai, section 3.2.

use super::report::Wish;
use super::{Reportable, SAMPLES, end_circles};
use spiral_atlas::plot::{CurveFigure, Graph};
use spiral_atlas::transition::{Answer, Ends, Figure, Kind, Piece, spiral};
use spiral_atlas::{Error, Result};

/// The answer for two ends.
pub(super) fn find(ends: &Ends, wish: Wish) -> Result<Answer> {
    let found = spiral(ends)?.no_longer_than(wish.longest());
    if wish.advice { found.with_remedies() } else { Ok(found) }
}

impl Reportable for Answer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        match &self.outcome {
            Ok(i) => Ok(self.solutions.get(*i).map(|s| s.piece()).into_iter().collect()),
            Err(why) => Err(why.sentence("cubic spiral")),
        }
    }

    fn between(&self) -> Option<(&Ends, Kind)> {
        Some((&self.ends, Kind::Cubic))
    }

    fn text(&self) -> String {
        self.to_string()
    }

    /// The chosen spiral or, where there is none, the cubic that comes nearest to one.
    fn figure(&self) -> Result<CurveFigure> {
        let nearest = || self.solutions.iter().max_by(|a, b| a.margin.total_cmp(&b.margin));
        let solution = self.chosen().or_else(nearest).ok_or_else(|| Error::invalid("no cubic has these ends"))?;
        let figure = Figure::new(&self.ends, solution, SAMPLES)?;
        let kind = if solution.spiral { "cubic spiral" } else { "cubic, no spiral" };
        let points: Vec<String> = solution.control_points.p.iter().map(|[x, y]| format!("({x:.6}, {y:.6})")).collect();
        Ok(CurveFigure {
            title: format!("{kind}: f₀ = {:.6}, f₁ = {:.6}, margin {:.3e}", solution.f0, solution.f1, solution.margin),
            note: format!("control points {}", points.join(" ")),
            curve: figure.samples.iter().map(|s| s.point).collect(),
            control: figure.control_points.to_vec(),
            circles: end_circles(&self.ends),
            parameter: "t".into(),
            curvature: Graph {
                label: "κ".into(), points: figure.samples.iter().map(|s| [s.t, s.curvature]).collect()
            },
            derivative: Graph {
                label: "dκ/dt".into(),
                points: figure.samples.iter().map(|s| [s.t, s.curvature_dt]).collect(),
            },
            joints: Vec::new(),
        })
    }
}
