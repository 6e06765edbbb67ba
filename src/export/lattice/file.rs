//! The file: nav2's JSON.

use super::Lattice;
use super::headings::metres;
use super::primitive::Primitive;
use crate::error::{Error, Result};
use serde::Serialize;
use std::f64::consts::TAU;

/// A direction that is nearer to that of an end, radians, is that of the end: a rounding of straight lines.
const ROUNDING: f64 = 1e-12;

#[derive(Serialize)]
struct Metadata<'a> {
    motion_model: &'a str,
    turning_radius: f64,
    grid_resolution: f64,
    num_of_headings: usize,
    trajectory_distinctness_ratio: f64,
    heading_angles: Vec<f32>,
    number_of_trajectories: usize,
}

#[derive(Serialize)]
struct Trajectory {
    trajectory_id: usize,
    start_angle_index: usize,
    end_angle_index: usize,
    left_turn: bool,
    trajectory_radius: f32,
    trajectory_length: f32,
    arc_length: f32,
    straight_length: f32,
    poses: Vec<[f32; 3]>,
}

impl Lattice {
    /// The file's text. The same options give the same text, but for the last digits on a machine with other sines.
    ///
    /// All lengths and angles are written as the f32 numbers that the planner holds. The last pose of a primitive is
    /// on its cell as the planner computes it: see [`Lattice`].
    ///
    /// # Errors
    /// [`Error::Domain`] where a path has points that no double holds.
    pub fn to_json(&self) -> Result<String> {
        let options = &self.options;
        let metadata = Metadata {
            motion_model: "ackermann",
            turning_radius: options.turning_radius,
            grid_resolution: options.grid_resolution,
            num_of_headings: options.headings,
            trajectory_distinctness_ratio: options.distinctness,
            heading_angles: self.heading_angles.iter().map(|angle| *angle as f32).collect(),
            number_of_trajectories: self.primitives.len(),
        };
        let mut lines = Vec::with_capacity(self.primitives.len());
        for (id, primitive) in self.primitives.iter().enumerate() {
            lines.push(json(&self.trajectory(id, primitive)?)?);
        }
        Ok(format!(
            "{{\"version\":1.0,\"lattice_metadata\":{},\"primitives\":[\n{}\n]}}\n",
            json(&metadata)?,
            lines.join(",\n")
        ))
    }

    fn trajectory(&self, id: usize, primitive: &Primitive) -> Result<Trajectory> {
        let (length, straight) = (primitive.length(), primitive.straight_length());
        let resolution = self.options.grid_resolution;
        let ends = [primitive.start, primitive.end].map(|place| self.heading_angles[place]);
        let steps = ((length / resolution).round() as usize).max(1);
        // What comes before the first step is where the robot is.
        let mut poses: Vec<[f32; 3]> =
            primitive.stations(steps)?.iter().skip(1).map(|s| [s.x as f32, s.y as f32, yaw(s.heading, ends)]).collect();
        if let Some(last) = poses.last_mut() {
            let [x, y] = [0, 1].map(|i| on_cell(primitive.cell[i], metres(primitive.cell, resolution)[i], resolution));
            *last = [x, y, ends[1] as f32];
        }
        let curvature = primitive.greatest_curvature();
        Ok(Trajectory {
            trajectory_id: id,
            start_angle_index: primitive.start,
            end_angle_index: primitive.end,
            left_turn: primitive.left_turn(),
            trajectory_radius: if curvature > 0.0 { (1.0 / curvature) as f32 } else { 0.0 },
            trajectory_length: length as f32,
            arc_length: if curvature > 0.0 { (length - straight) as f32 } else { 0.0 },
            straight_length: straight as f32,
            poses,
        })
    }
}

fn json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string(value).map_err(|e| Error::invalid(format!("lattice: {e}")))
}

/// From 0 up to and without a full turn, as f32 numbers have it.
fn yaw(heading: f64, ends: [f64; 2]) -> f32 {
    let near = |end: &f64| {
        let apart = (heading - end).rem_euclid(TAU);
        apart.min(TAU - apart) <= ROUNDING
    };
    let yaw = ends.into_iter().find(near).unwrap_or(heading.rem_euclid(TAU)) as f32;
    if yaw >= TAU as f32 { 0.0 } else { yaw }
}

/// A coordinate of a cell. The planner divides it by the resolution, in f32, adds the place where it is, and cuts off
/// what is behind the point. Where no number near gives the cell's number exactly, the next above does: one below would
/// be cut off to the cell before.
fn on_cell(cell: i64, metres: f64, resolution: f64) -> f32 {
    let (near, resolution, cell) = (metres as f32, resolution as f32, cell as f32);
    let candidates = [near.next_down(), near, near.next_up()];
    let exact = candidates.into_iter().filter(|x| x / resolution == cell);
    let above = candidates.into_iter().filter(|x| x / resolution > cell);
    exact.chain(above).next().unwrap_or(near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_not_cut_off() {
        for resolution in [0.05f64, 0.1, 0.025, 0.01, 1.0 / 3.0, 0.07] {
            let mut inexact = 0;
            for cell in -300i64..=300 {
                let metres = cell as f64 * resolution;
                let quotient = on_cell(cell, metres, resolution) / resolution as f32;
                let exact = cell as f32;
                assert!(quotient == exact || quotient == exact.next_up(), "{cell} of {resolution}: {quotient}");
                inexact += u32::from(quotient != exact);
            }
            assert!(inexact < 100, "{resolution}: {inexact}");
        }
        assert_eq!(0.65f64 as f32 / 0.05f64 as f32, 13f32.next_down());
        assert_eq!((on_cell(13, 0.65, 0.05), on_cell(-7, -0.35, 0.05)), (0.65f32.next_up(), -0.35));
    }

    #[test]
    fn a_yaw_is_no_full_turn() {
        assert_eq!((yaw(-1e-17, [0.0, 1.0]), yaw(-1e-9, [3.0, 1.0]), yaw(-0.25, [3.0, 1.0])), (0.0, 0.0, 6.033_185_5));
    }
}
