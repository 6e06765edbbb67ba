//! Paths among obstacles.

use super::{PathReport, Tool};
use crate::error::Result;
use crate::path::{Clearance, Corner, Plan, Scene, plan};
use serde::Serialize;

/// A path among obstacles.
#[derive(Debug, Serialize)]
pub struct PlannedPath {
    /// The path itself.
    #[serde(flatten)]
    pub path: PathReport,
    /// How much shorter it is than the polyline.
    pub length_saved: f64,
    /// Proved.
    pub curvature_at_most: f64,
    /// Proved; none without obstacles.
    pub clearance: Option<Clearance>,
    /// What was rounded.
    pub polyline: Vec<[f64; 2]>,
    /// Its corners.
    pub corners: Vec<Corner>,
}

/// The answer for a scene.
#[derive(Debug, Serialize)]
pub struct Planned {
    /// The one path.
    pub paths: [PlannedPath; 1],
    /// The plan that it comes from.
    #[serde(skip)]
    pub plan: Plan,
}

/// A short polyline around the obstacles, rounded.
impl Tool for Scene {
    type Answer = Planned;

    fn answer(self) -> Result<Planned> {
        let plan = plan(&self)?;
        let path = PlannedPath {
            path: PathReport::new(&plan.spans),
            length_saved: plan.length_saved,
            curvature_at_most: plan.proof.curvature_at_most,
            clearance: plan.proof.clearance,
            polyline: plan.polyline.clone(),
            corners: plan.corners.clone(),
        };
        Ok(Planned { paths: [path], plan })
    }
}
