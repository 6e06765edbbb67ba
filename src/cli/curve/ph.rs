//! `curve --family ph-quintic`: the Pythagorean-hodograph quintic spiral of least bending energy.

use super::super::output;
use super::{Found, SAMPLES, end_circles};
use spiral_atlas::curve::{Ends, Jet, PhAnswer, ph_spiral};
use spiral_atlas::plot::{CurveFigure, Graph};
use spiral_atlas::{Error, Result};

pub fn find(ends: &Ends) -> Result<PhAnswer> {
    ph_spiral(ends)
}

impl Found for PhAnswer {
    fn json(&self) -> Result<String> {
        output::to_json(self)
    }

    fn text(&self) -> String {
        self.to_string()
    }

    /// The chosen spiral or, where there is none, the PH quintic that comes nearest to one.
    fn figure(&self) -> Result<CurveFigure> {
        let nearest = || self.solutions.iter().max_by(|a, b| a.margin.total_cmp(&b.margin));
        let solution = self.chosen().or_else(nearest);
        let solution = solution.ok_or_else(|| Error::Domain("no PH quintic has these ends".into()))?;
        let step = |i: usize| i as f64 / (SAMPLES - 1) as f64;
        let jets: Vec<(f64, Jet)> =
            (0..SAMPLES).map(step).map(|t| (t, Jet::of_bezier(&solution.local_control_points, t))).collect();
        let [x, y] = self.ends.start;
        let kind = if solution.spiral { "PH quintic spiral" } else { "PH quintic, no spiral" };
        Ok(CurveFigure {
            title: format!("{kind}: A = {:.6}, B = {:.6}, margin {:.3e}", solution.a, solution.b, solution.margin),
            note: format!("length {:.6}, bending energy {:.6}", solution.length, solution.energy),
            curve: jets.iter().map(|(_, jet)| [x + jet.point[0], y + jet.point[1]]).collect(),
            control: solution.control_points.clone(),
            circles: end_circles(&self.ends),
            parameter: "t".into(),
            curvature: Graph { label: "κ".into(), points: jets.iter().map(|(t, jet)| [*t, jet.curvature()]).collect() },
            derivative: Graph { label: "dκ/dt".into(), points: jets.iter().map(|(t, jet)| [*t, jet.curvature_dt()]).collect() },
        })
    }
}
