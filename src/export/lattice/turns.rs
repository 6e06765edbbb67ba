//! Paths between two poses of the grid: a straight line, or one turn between two lines.

use super::headings::{Headings, cross, dot, metres};
use super::options::LatticeOptions;
use super::primitive::Primitive;
use crate::curve::vector::{length, sub};
use crate::error::{Error, Result};
use crate::transition::join::{End, Join, Request, join};
use crate::transition::{Line, Piece};
use std::collections::BTreeMap;

/// Lengths that differ by less, relatively, are the same: far more than the roundings of a corner and of a join.
const SAME: f64 = 1e-11;

/// A pose of the grid: its cell, and the place of its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pose {
    pub heading: usize,
    pub cell: [i64; 2],
}

/// A turn of some angle between two straight lines, in units of one over the limit of curvature that it is made for.
#[derive(Debug, Clone, Copy)]
struct TurnShape {
    /// It is the shortest join of so many pieces.
    most_pieces: usize,
    /// From where it leaves the first line to the corner of the two, and from there to where it reaches the second.
    leg: f64,
    length: f64,
    greatest_curvature: f64,
    greatest_rate: f64,
}

/// A turn that fits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    most_pieces: usize,
    /// The limit of curvature that the join is asked for.
    limit: f64,
    /// Of the whole path, lines included.
    pub length: f64,
}

/// What turns there are between the headings.
pub(super) struct Turns<'o> {
    pub options: &'o LatticeOptions,
    pub headings: Headings,
    /// By the cosine of the angle: scalar product, and product of the squared lengths.
    shapes: BTreeMap<(i64, i64), Vec<TurnShape>>,
}

impl Turns<'_> {
    /// # Errors
    /// Those of [`join`].
    pub(super) fn new(options: &LatticeOptions) -> Result<Turns<'_>> {
        let headings = Headings::new(options.headings);
        let mut shapes = BTreeMap::new();
        for from in 0..headings.quarter() {
            for left in 1..=headings.quarter() {
                let to = headings.beside(from, left as i64);
                if let std::collections::btree_map::Entry::Vacant(place) = shapes.entry(key(&headings, from, to)) {
                    place.insert(Turns::shapes_of(options, headings.angle(to) - headings.angle(from))?);
                }
            }
        }
        Ok(Turns { options, headings, shapes })
    }

    /// The shortest turn, and the shortest without an arc: the latter is longer and steers more slowly.
    fn shapes_of(options: &LatticeOptions, angle: f64) -> Result<Vec<TurnShape>> {
        let line = |direction: f64| End::Line { point: [0.0, 0.0], direction };
        let mut all = Vec::new();
        for most_pieces in [3, 2] {
            let request = Request { family: options.family, most_pieces, ..Request::new(line(0.0), line(angle), 1.0) };
            if let Ok(Join { measures, pieces }) = &join(&request)? {
                all.push(TurnShape {
                    most_pieces,
                    leg: pieces.first().map_or(0.0, |piece| length(piece.start())),
                    length: measures.length,
                    greatest_curvature: measures.greatest_curvature,
                    greatest_rate: measures.greatest_rate(),
                });
            }
        }
        Ok(all)
    }

    /// From a direction at the origin to a pose: as wide as the corner of the two lines leaves room for. Of the shapes
    /// that keep the limit, the one that steers most slowly.
    pub(super) fn fit(&self, heading: usize, to: Pose) -> Option<Fit> {
        let [u, v] = [heading, to.heading].map(|place| self.headings.step(place));
        let turned = cross(u, v);
        let shapes = self.shapes.get(&key(&self.headings, heading, to.heading))?;
        // How many steps the corner is after the start, and before the end: a / turned and b / turned.
        let [a, b] = [cross(to.cell, v), cross(u, to.cell)].map(|n| n * turned.signum());
        if a <= 0 || b <= 0 {
            return None;
        }
        let legs = [(a, u), (b, v)]
            .map(|(n, step)| n as f64 / turned.abs() as f64 * length(metres(step, self.options.grid_resolution)));
        let room = legs[0].min(legs[1]);
        let fits = shapes.iter().filter_map(|shape| {
            // One over the limit of curvature.
            let least = shape.greatest_curvature * self.options.turning_radius;
            let unit = room / shape.leg;
            let unit = if unit < least && unit >= least * (1.0 - SAME) { least } else { unit };
            let length = legs[0] + legs[1] + (shape.length - 2.0 * shape.leg) * unit;
            let fit = Fit { most_pieces: shape.most_pieces, limit: 1.0 / unit, length };
            (unit >= least).then_some((shape.greatest_rate / (unit * unit), fit))
        });
        fits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, fit)| fit)
    }

    /// Whether a straight line or a turn leads from one pose to another.
    pub(super) fn leads(&self, from: Pose, to: Pose) -> bool {
        let cell = [to.cell[0] - from.cell[0], to.cell[1] - from.cell[1]];
        if from.heading == to.heading {
            let step = self.headings.step(from.heading);
            return cross(step, cell) == 0 && dot(step, cell) > 0;
        }
        self.fit(from.heading, Pose { cell, ..to }).is_some()
    }

    /// The straight line to a cell ahead.
    pub(super) fn straight(&self, heading: usize, cell: [i64; 2]) -> Primitive {
        let end = metres(cell, self.options.grid_resolution);
        Primitive { start: heading, end: heading, cell, pieces: vec![Line { start: [0.0, 0.0], end }.into()] }
    }

    /// A turn that fits, as pieces.
    ///
    /// # Errors
    /// Those of [`join`], and [`Error::Domain`] where the join is not that of the shape.
    pub(super) fn turn(&self, heading: usize, to: Pose, fit: &Fit) -> Result<Primitive> {
        let end = metres(to.cell, self.options.grid_resolution);
        let line = |point, place: usize| End::Line { point, direction: self.headings.angle(place) };
        let request = Request {
            family: self.options.family,
            most_pieces: fit.most_pieces,
            ..Request::new(line([0.0, 0.0], heading), line(end, to.heading), fit.limit)
        };
        let found = join(&request)?;
        let turn = found.as_ref().map_or(&[][..], |join| &join.pieces);
        let ends = turn.first().zip(turn.last()).map(|(first, last)| [first.start(), last.end()]);
        let mut pieces = Vec::with_capacity(turn.len() + 2);
        if let Some([from, to]) = ends {
            let most = SAME * fit.length;
            let line = |start, end| (length(sub(end, start)) > most).then_some(Piece::Line(Line { start, end }));
            pieces.extend(line([0.0, 0.0], from));
            pieces.extend(turn.iter().cloned());
            pieces.extend(line(to, end));
        }
        let whole: f64 = pieces.iter().map(Piece::length).sum();
        // A join that leaves a line elsewhere would go back to it.
        if (whole - fit.length).abs() > 1e-6 * fit.length {
            return Err(Error::invalid(format!(
                "lattice: the turn from heading {heading} to heading {} at {end:?} should be {} m long, and the join \
                 found is {whole} m; take another family or radius",
                to.heading, fit.length
            )));
        }
        Ok(Primitive { start: heading, end: to.heading, cell: to.cell, pieces })
    }
}

/// What gives the angle between two headings.
fn key(headings: &Headings, from: usize, to: usize) -> (i64, i64) {
    let [u, v] = [from, to].map(|place| headings.step(place));
    (dot(u, v), dot(u, u) * dot(v, v))
}
