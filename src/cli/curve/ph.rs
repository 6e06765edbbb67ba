//! `curve ph-quintic`: the Pythagorean-hodograph quintic spiral of least bending energy.

use super::report::Wish;
use super::{Reportable, drawn, end_circles};
use spiral_atlas::plot::CurveFigure;
use spiral_atlas::transition::{Ends, Kind, PhAnswer, Piece, ph_spiral};
use spiral_atlas::{Error, Result};

/// The answer for two ends.
pub(super) fn find(ends: &Ends, wish: Wish) -> Result<PhAnswer> {
    let found = ph_spiral(ends)?.no_longer_than(wish.longest());
    if wish.advice { found.with_remedies() } else { Ok(found) }
}

impl Reportable for PhAnswer {
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String> {
        match &self.outcome {
            Ok(i) => Ok(self.solutions.get(*i).map(|s| Piece::PhQuintic(s.curve)).into_iter().collect()),
            Err(why) => Err(why.sentence("PH quintic spiral")),
        }
    }

    fn between(&self) -> Option<(&Ends, Kind)> {
        Some((&self.ends, Kind::PhQuintic))
    }

    fn text(&self) -> String {
        self.to_string()
    }

    /// The chosen spiral or, where there is none, the PH quintic that comes nearest to one.
    fn figure(&self) -> Result<CurveFigure> {
        let nearest = || self.solutions.iter().max_by(|a, b| a.margin.total_cmp(&b.margin));
        let solution = self.chosen().or_else(nearest);
        let solution = solution.ok_or_else(|| Error::invalid("no PH quintic has these ends"))?;
        let (curve, curvature, derivative) = drawn(self.ends.start, &solution.local_control_points);
        let kind = if solution.spiral { "PH quintic spiral" } else { "PH quintic, no spiral" };
        Ok(CurveFigure {
            title: format!("{kind}: A = {:.6}, B = {:.6}, margin {:.3e}", solution.a, solution.b, solution.margin),
            note: format!("length {:.6}, bending energy {:.6}", solution.length, solution.energy),
            curve,
            control: solution.control_points.to_vec(),
            circles: end_circles(&self.ends),
            parameter: "t".into(),
            curvature,
            derivative,
            joints: Vec::new(),
        })
    }
}
