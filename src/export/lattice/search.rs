//! The search for the smallest set of primitives that the others are made of.

use super::headings::metres;
use super::primitive::Primitive;
use super::turns::{Fit, Pose, Turns};
use crate::curve::vector::{dot, length, sub};
use crate::error::Result;
use crate::transition::Station;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

/// The search ends after so many levels without a new primitive.
const PATIENCE: usize = 5;
/// Points of a path in each cell where it is compared with others.
const POINTS: f64 = 10.0;

/// The search from one heading.
pub(super) struct Search<'t> {
    turns: &'t Turns<'t>,
    heading: usize,
    /// The first level: cells nearer than the sharpest turn to a neighbouring heading are none.
    first: i64,
    /// What is kept so far.
    kept: Vec<Pose>,
}

impl<'t> Search<'t> {
    pub(super) fn new(turns: &'t Turns, heading: usize) -> Search<'t> {
        let headings = &turns.headings;
        let gaps = (1..=headings.count() / 8).map(|i| headings.angle(i) - headings.angle(i - 1));
        let least = gaps.fold(f64::INFINITY, f64::min) * turns.options.turning_radius;
        let first = ((least / turns.options.grid_resolution).round() as i64).max(1);
        Search { turns, heading, first, kept: Vec::new() }
    }

    /// The straight primitive.
    pub(super) fn straight(&mut self) -> Primitive {
        let [x, y] = self.turns.headings.first_point(self.heading);
        let times = (self.first + x.abs().max(y.abs()) - 1) / x.abs().max(y.abs());
        let cell = [x * times, y * times];
        self.kept.push(Pose { heading: self.heading, cell });
        self.turns.straight(self.heading, cell)
    }

    /// The turns to one side: 1 for left, -1 for right.
    ///
    /// Cells are searched by levels: squares about the start. It goes on until every heading of a quarter turn was met,
    /// and for some levels after the last new primitive.
    ///
    /// # Errors
    /// Those of joins.
    pub(super) fn side(&mut self, side: i64) -> Result<Vec<Primitive>> {
        let headings = &self.turns.headings;
        let ends: Vec<usize> =
            (1..=headings.quarter() as i64).map(|n| headings.beside(self.heading, side * n)).collect();
        let (mut found, mut missing) = (Vec::new(), BTreeSet::from_iter(ends.iter().copied()));
        let (mut level, mut idle) = (self.first, 0);
        while idle < PATIENCE || !missing.is_empty() {
            idle += 1;
            let mut fits: Vec<(Fit, Pose)> = Vec::new();
            for cell in border(level) {
                for pose in ends.iter().map(|heading| Pose { heading: *heading, cell }) {
                    fits.extend(self.turns.fit(self.heading, pose).map(|fit| (fit, pose)));
                }
            }
            // Of equal length to a rounding are mirror images only, and these are not on one side.
            fits.sort_by(|a, b| a.0.length.total_cmp(&b.0.length).then(a.1.cmp(&b.1)));
            for (fit, pose) in fits {
                missing.remove(&pose.heading);
                if !self.is_distinct(&fit, pose) {
                    continue;
                }
                let primitive = self.turns.turn(self.heading, pose, &fit)?;
                if !self.is_made_of_others(&primitive, pose)? {
                    self.kept.push(pose);
                    found.push(primitive);
                    idle = 0;
                }
            }
            level += 1;
        }
        Ok(found)
    }

    /// Whether it ends far enough from all others of its direction.
    fn is_distinct(&self, fit: &Fit, pose: Pose) -> bool {
        let options = self.turns.options;
        self.kept.iter().filter(|other| other.heading == pose.heading).all(|other| {
            let apart = [0, 1].map(|i| pose.cell[i] - other.cell[i]);
            length(metres(apart, options.grid_resolution)) >= options.distinctness * fit.length
        })
    }

    /// Whether it passes the end of another, about in its direction, from where one primitive more leads to its end.
    fn is_made_of_others(&self, primitive: &Primitive, pose: Pose) -> Result<bool> {
        let resolution = self.turns.options.grid_resolution;
        let steps = (POINTS * primitive.length() / resolution).ceil() as usize;
        let stations = primitive.stations(steps.max(1))?;
        let passes = |other: &Pose| {
            let (at, direction) = (metres(other.cell, resolution), self.turns.headings.angle(other.heading));
            stations.windows(2).any(|pair| {
                let turned = (pair[0].heading - direction).rem_euclid(TAU);
                turned.min(TAU - turned) < PI / self.turns.headings.count() as f64
                    && distance(at, pair) < 0.5 * resolution
            })
        };
        Ok(self.kept.iter().any(|other| self.turns.leads(*other, pose) && passes(other)))
    }
}

/// The cells of a square about the origin.
fn border(level: i64) -> impl Iterator<Item = [i64; 2]> {
    (-level..level).flat_map(move |i| [[level, i], [-i, level], [-level, -i], [i, -level]])
}

/// Of a point from the line between two stations.
fn distance(point: [f64; 2], pair: &[Station]) -> f64 {
    let [a, b] = [0, 1].map(|i| [pair[i].x, pair[i].y]);
    let (along, to) = (sub(b, a), sub(point, a));
    let share = (dot(along, to) / dot(along, along)).clamp(0.0, 1.0);
    length(sub(to, along.map(|x| x * share)))
}
