//! Paths between given ends and through given points.

use super::input::{angle, objects};
use super::{PathReport, Tool};
use crate::curve::{Choice, EqualLength, Hermite, equal_length, hermite};
use crate::error::{Error, OTHER_UNIT, Result};
use crate::path::{Directions, Free, LeastCurvature, least_curvature, spline};
use crate::plain::name;
use serde::{Deserialize, Serialize};

/// A path that was chosen among several.
#[derive(Debug, Serialize)]
pub struct Chosen {
    /// The one path.
    pub paths: [PathReport; 1],
    /// Among which it was chosen.
    #[serde(skip)]
    pub choice: Choice,
}

/// The curve of least absolute rotation of the four between two points with given derivatives.
impl Tool for Hermite {
    type Answer = Chosen;

    fn answer(self) -> Result<Chosen> {
        let choice = hermite(&self)?;
        Ok(Chosen { paths: [PathReport::chosen(&choice, choice.best, None)], choice })
    }
}

/// Paths of one given length.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EqualLengths {
    /// Arc length of each.
    pub length: f64,
    /// Their ends, one path at least.
    #[serde(deserialize_with = "objects")]
    pub paths: Vec<PathEnds>,
    /// Take the better of the paper's two solutions, not the best of four.
    #[serde(default)]
    pub paper: bool,
}

/// Where a path starts and ends, and in which directions.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathEnds {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    #[serde(deserialize_with = "angle")]
    pub start_direction: f64,
    /// Direction of travel at the end.
    #[serde(deserialize_with = "angle")]
    pub end_direction: f64,
}

/// Paths as they are reported.
#[derive(Debug, Serialize)]
pub struct Paths {
    /// In order.
    pub paths: Vec<PathReport>,
}

/// Each path is the one of least absolute rotation of four.
impl Tool for EqualLengths {
    type Answer = Paths;

    fn answer(self) -> Result<Paths> {
        if self.paths.is_empty() {
            return Err(Error::invalid("`paths` is empty; give the ends of one at least"));
        }
        let path = |(i, ends): (usize, &PathEnds)| {
            let PathEnds { start, end, start_direction, end_direction } = *ends;
            let choice = equal_length(&EqualLength { start, end, start_direction, end_direction, length: self.length })
                .map_err(|e| e.at(format!("paths[{i}]")))?;
            let paper = EqualLength::paper(&choice);
            Ok(PathReport::chosen(&choice, if self.paper { paper } else { choice.best }, Some(paper)))
        };
        Ok(Paths { paths: self.paths.iter().enumerate().map(path).collect::<Result<_>>()? })
    }
}

/// The path between two ends whose greatest curvature is least.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeastBend {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    #[serde(deserialize_with = "angle")]
    pub start_direction: f64,
    /// Direction of travel at the end.
    #[serde(deserialize_with = "angle")]
    pub end_direction: f64,
    /// What is varied.
    #[serde(deserialize_with = "name")]
    pub free: Free,
    /// The path is no longer; left out: twice the distance of the ends.
    pub greatest_length: Option<f64>,
}

/// A path, and what is proved of all that were searched.
#[derive(Debug, Serialize)]
pub struct LeastBendPath {
    /// The one path.
    pub paths: [PathReport; 1],
    /// Below which no searched path's greatest curvature lies.
    pub at_least: f64,
    /// Lengths of its end derivatives.
    pub derivatives: [f64; 2],
    /// Range of each derivative's length.
    pub searched: [f64; 2],
}

/// No searched path bends less than `at_least`: that is proved.
impl Tool for LeastBend {
    type Answer = LeastBendPath;

    fn answer(self) -> Result<LeastBendPath> {
        let LeastBend { start, end, start_direction, end_direction, free, greatest_length } = self;
        let distance = (end[0] - start[0]).hypot(end[1] - start[1]);
        // Curvatures would leave the range of doubles, and the length allowed would be no number that the user gave.
        let reckoned = distance == 0.0 || (1e-150..=1e150).contains(&distance);
        if !reckoned && start.iter().chain(&end).all(|x| x.is_finite()) {
            return Err(Error::invalid(format!(
                "`start` {start:?} and `end` {end:?} are not between 1e-150 and 1e150 apart; {OTHER_UNIT}"
            )));
        }
        let greatest_length = greatest_length.unwrap_or(2.0 * distance);
        let ends = Directions { start, end, start_direction, end_direction, greatest_length, free };
        let LeastCurvature { curve, at_least, derivatives, searched, .. } = least_curvature(&ends)?;
        Ok(LeastBendPath { paths: [PathReport::new(&[curve])], at_least, derivatives, searched })
    }
}

/// A curve with continuous second derivative through points.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Through {
    /// In order.
    pub points: Vec<[f64; 2]>,
    /// Whether it leads back to the first.
    #[serde(default)]
    pub closed: bool,
}

/// A span from each point to the next.
impl Tool for Through {
    type Answer = Paths;

    fn answer(self) -> Result<Paths> {
        Ok(Paths { paths: vec![PathReport::new(&spline(&self.points, self.closed)?.spans)] })
    }
}
