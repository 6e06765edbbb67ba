//! The numbers of a picture like Habib & Sakai's Fig. 3: curve, control polygon, end circles, curvature and its
//! derivative.

use super::Solution;
use super::placement::Ends;
use crate::curve::vector::add;
use crate::error::{Result, samples};
use serde::Serialize;

/// Circle of curvature at an end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum EndCircle {
    /// Curvature is not zero.
    Circle {
        /// Its centre, to the left of the direction of travel for positive curvature.
        centre: [f64; 2],
        /// Its radius, positive.
        radius: f64,
    },
    /// Curvature zero, or so small that the centre is out of range: the tangent.
    Line {
        /// The end point.
        point: [f64; 2],
        /// Angle of the direction of travel, radians.
        direction: f64,
    },
}

impl EndCircle {
    /// Of a point, a direction of travel (radians) and a signed curvature.
    pub fn new(point: [f64; 2], direction: f64, curvature: f64) -> EndCircle {
        let arm = 1.0 / curvature;
        let centre = add(point, [-arm * direction.sin(), arm * direction.cos()]);
        if centre.iter().all(|x| x.is_finite()) {
            EndCircle::Circle { centre, radius: arm.abs() }
        } else {
            EndCircle::Line { point, direction }
        }
    }
}

impl Ends {
    /// The circles of curvature that were asked for, at the start and at the end.
    pub fn circles(&self) -> [EndCircle; 2] {
        [
            EndCircle::new(self.start, self.start_direction, self.start_curvature),
            EndCircle::new(self.end, self.end_direction, self.end_curvature),
        ]
    }
}

/// One point of the curve; user units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sample {
    /// Parameter, 0 to 1.
    pub t: f64,
    /// Arc length from the start.
    pub s: f64,
    /// The point.
    pub point: [f64; 2],
    /// Signed curvature.
    pub curvature: f64,
    /// Its derivative with respect to t.
    pub curvature_dt: f64,
    /// Its derivative with respect to arc length.
    pub curvature_ds: f64,
}

/// What a picture of one curve shows; user units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// The control polygon.
    pub control_points: [[f64; 2]; 4],
    /// Circles of curvature at start and end, as asked for.
    pub circles: [EndCircle; 2],
    /// The curve at equal steps of the parameter, both ends included.
    pub samples: Vec<Sample>,
}

impl Figure {
    /// Samples one of the curves that match `ends`.
    ///
    /// # Accuracy
    /// Arc lengths 1e-14 relative; curvatures as [`crate::curve::Jet::curvature`].
    ///
    /// # Errors
    /// [`crate::Error::Domain`] for fewer than 2 samples.
    pub fn new(ends: &Ends, solution: &Solution, count: usize) -> Result<Figure> {
        samples(count)?;
        let local = &solution.local_control_points;
        let step = |i: usize| i as f64 / (count - 1) as f64;
        let mut s = 0.0;
        let mut sample = |i: usize| {
            let (t, jet) = (step(i), local.jet(step(i)));
            s += if i == 0 { 0.0 } else { local.length_between(step(i - 1), t) };
            Sample {
                t,
                s,
                point: add(ends.start, jet.point),
                curvature: jet.curvature(),
                curvature_dt: jet.curvature_dt(),
                curvature_ds: jet.curvature_ds(),
            }
        };
        let samples = (0..count).map(&mut sample).collect();
        Ok(Figure { control_points: solution.control_points.p, circles: ends.circles(), samples })
    }
}
