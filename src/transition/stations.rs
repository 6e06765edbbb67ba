//! Points at equal arc lengths along a path of pieces.

use super::piece::Piece;
use crate::curve::{arc_length, parameter_of};
use crate::error::{Error, OTHER_UNIT, Result, samples};
use serde::Serialize;

/// A point of a path and what is known there, in the user's units. As JSON, heading and curvature are null where the
/// path stands still.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Station {
    /// Arc length from the start.
    pub station: f64,
    /// The point.
    pub x: f64,
    /// The point.
    pub y: f64,
    /// Direction of travel, radians from the x axis, counter-clockwise, in [-π, π]; NaN where the path stands still.
    pub heading: f64,
    /// Signed curvature, positive to the left; NaN where the path stands still.
    pub curvature: f64,
}

impl Station {
    /// The names of [`Station::numbers`], as in JSON and the headers of tables.
    pub const COLUMNS: [&str; 5] = ["station", "x", "y", "heading", "curvature"];

    /// Its numbers, in the order of [`Station::COLUMNS`].
    pub fn numbers(&self) -> [f64; 5] {
        [self.station, self.x, self.y, self.heading, self.curvature]
    }

    /// The point at signed distance `d` to the left of this one.
    pub fn beside(&self, d: f64) -> [f64; 2] {
        let (sin, cos) = self.heading.sin_cos();
        [self.x - d * sin, self.y + d * cos]
    }
}

/// `count` points at equal arc lengths, both ends included.
///
/// # Accuracy
/// A point's arc length is its `station` to 1e-13 of the path's length; PH quintics, lines, arcs and clothoids have
/// formulas, and the others are integrated to 1e-14 by [`arc_length`]. Both ends are exact. Headings and curvatures are
/// those of [`Piece::at`].
///
/// # Errors
/// [`Error::Domain`] for fewer than two points or more than [`super::MOST_SAMPLES`], or where a number leaves the range
/// of doubles.
pub fn stations(pieces: &[Piece], count: usize) -> Result<Vec<Station>> {
    samples(count)?;
    let lengths: Vec<f64> = pieces.iter().map(Piece::length).collect();
    let whole: f64 = lengths.iter().sum();
    let mut all = Vec::with_capacity(count);
    let (mut before, mut next) = (0.0, 0);
    for (i, (piece, length)) in pieces.iter().zip(&lengths).enumerate() {
        let last = i + 1 == pieces.len();
        let first = next;
        let wanted = |n: usize| if n + 1 == count { whole } else { whole * (n as f64 / (count - 1) as f64) };
        while next < count && (last || wanted(next) < before + length) {
            next += 1;
        }
        let inside: Vec<f64> = (first..next).map(|n| (wanted(n) - before).clamp(0.0, *length)).collect();
        for (n, t) in (first..next).zip(parameters(piece, *length, &inside)) {
            let at = piece.at(t);
            let curvature = if at.heading.is_nan() { f64::NAN } else { at.curvature };
            let found = Station { station: wanted(n), x: at.point[0], y: at.point[1], heading: at.heading, curvature };
            // Where the path stands still, heading and curvature are none.
            let known = if at.heading.is_nan() { 3 } else { 5 };
            let beyond = found.numbers().iter().take(known).position(|x| !x.is_finite());
            if let Some(name) = beyond.map(|i| Station::COLUMNS[i]) {
                return Err(Error::beyond_doubles(format!("the {name} of sample {n}"), OTHER_UNIT));
            }
            all.push(found);
        }
        before += length;
    }
    Ok(all)
}

/// The parameters of a piece at increasing lengths from its start.
fn parameters(piece: &Piece, length: f64, wanted: &[f64]) -> Vec<f64> {
    let [from, to] = piece.range();
    let (mut t, mut s) = (from, 0.0);
    let mut next = |wanted: f64| {
        if wanted <= 0.0 || wanted >= length {
            return if wanted > 0.0 { to } else { from };
        }
        match piece {
            Piece::PhQuintic(curve) => curve.parameter_at(wanted),
            Piece::Line(_) | Piece::Arc(_) | Piece::Clothoid(_) => wanted / length,
            Piece::Involute(between) => between.parameter_at(wanted / length),
            Piece::Cubic(_) | Piece::TrigQuintic(_) => {
                let (from, known, speed) = (t, s, |t: f64| piece.at(t).speed);
                let at = |t: f64| {
                    s = known + arc_length(speed, from, t);
                    [s - wanted, speed(t)]
                };
                t = parameter_of(at, [from, to], from + (wanted - known) / speed(from), 4.0 * f64::EPSILON * length);
                t
            }
        }
    };
    wanted.iter().map(|s| next(*s)).collect()
}
