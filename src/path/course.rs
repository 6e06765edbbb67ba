//! A path of pieces of any kinds: its length, points along it, where its curvature is extreme or changes its sign, and
//! its offset curves.

mod signs;

use super::distance;
use crate::curve::{Offset, PhQuintic};
use crate::error::{Error, OTHER_UNIT, Result};
use crate::transition::{Piece, Station, stations};
use serde::Serialize;
use signs::{Signs, opposite};

/// Pieces join where the gap between them is at most this share of their length and place, for roundings of whoever
/// wrote them.
const GAP: f64 = 1e-10;
/// Stations of one path nearer to each other than this share of its length are one, seen from both sides of a joint.
const SAME: f64 = 1e-9;
/// Points of the offset curve of one piece that has no formula.
const OFFSET_POINTS: usize = 65;

/// A path of pieces that join.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    pieces: Vec<Piece>,
    /// Lengths of the path up to each piece.
    before: Vec<f64>,
    length: f64,
}

/// A station of a path, and where on which piece it lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spot {
    /// What is known there. Heading and curvature are NaN where the path stands still.
    #[serde(flatten)]
    pub station: Station,
    /// Index of the piece.
    pub piece: usize,
    /// Parameter of the piece, within [`Piece::range`].
    pub parameter: f64,
}

/// A path in a few numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Summary {
    /// [`Course::length`].
    pub length: f64,
    /// [`Course::bending_energy`], where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_energy: Option<f64>,
    /// [`Course::absolute_rotation`], where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absolute_rotation: Option<f64>,
    /// [`Course::greatest_curvature`].
    pub greatest_curvature: f64,
}

impl Summary {
    /// Itself, where its numbers that are known are finite.
    ///
    /// # Errors
    /// [`Error::Domain`], with the name of one that is not.
    pub fn finite(self) -> Result<Summary> {
        let known = |x: Option<f64>| x.unwrap_or(0.0);
        let named = [
            ("length", self.length),
            ("greatest curvature", self.greatest_curvature),
            ("bending energy", known(self.bending_energy)),
            ("absolute rotation", known(self.absolute_rotation)),
        ];
        let lost = named.into_iter().find(|(_, x)| !x.is_finite());
        lost.map_or(Ok(self), |(what, _)| Err(Error::beyond_doubles(format!("the curve's {what}"), OTHER_UNIT)))
    }
}

/// The curve at a distance from a piece.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum OffsetCurve {
    /// Of a Pythagorean-hodograph quintic: exact.
    Exact(Offset),
    /// Of any other piece: 65 points at equal lengths of the piece, both ends included.
    Sampled {
        /// In order.
        points: Vec<[f64; 2]>,
    },
}

impl Course {
    /// Of pieces in order.
    ///
    /// # Errors
    /// [`Error::Domain`] without a piece, for a length that is not finite, and for a gap between pieces above 1e-10 of
    /// their length and place.
    pub fn new(pieces: Vec<Piece>) -> Result<Course> {
        let fail = |what: String| Err(Error::invalid(what));
        if pieces.is_empty() {
            return fail("`pieces` is empty; a path has one at least".into());
        }
        let (mut before, mut length) = (Vec::with_capacity(pieces.len()), 0.0);
        for (i, piece) in pieces.iter().enumerate() {
            before.push(length);
            let own = piece.length();
            length += own;
            if !length.is_finite() {
                return fail(format!("pieces[{i}] is {own:?} long, and the path would be {length:?}; {OTHER_UNIT}"));
            }
        }
        for (i, w) in pieces.windows(2).enumerate() {
            let (end, start) = (w[0].end(), w[1].start());
            let size = end.iter().chain(&start).fold(w[0].length().max(w[1].length()), |most, x| most.max(x.abs()));
            // Written so that NaN is a gap.
            let joined = distance(end, start) <= GAP * size;
            if !joined {
                return fail(format!(
                    "pieces[{i}] ends at {end:?}, pieces[{}] starts at {start:?}; they must join",
                    i + 1
                ));
            }
        }
        Ok(Course { pieces, before, length })
    }

    /// Its pieces.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Its arc length.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Its length, energy, rotation and greatest curvature.
    pub fn summary(&self) -> Summary {
        Summary {
            length: self.length,
            bending_energy: self.bending_energy(),
            absolute_rotation: self.absolute_rotation(),
            greatest_curvature: self.greatest_curvature(),
        }
    }

    /// `count` points at equal arc lengths, both ends included: [`stations`].
    ///
    /// # Errors
    /// Those of [`stations`].
    pub fn stations(&self, count: usize) -> Result<Vec<Station>> {
        stations(&self.pieces, count)
    }

    /// Stations that show the whole path, however short some of its pieces are: those of [`Course::stations`], both
    /// ends of every piece, and where in it the curvature is extreme, in order. A joint is there once for each of its
    /// pieces. Beside the `count` equal ones, those that stand still are left out.
    ///
    /// # Errors
    /// Those of [`stations`].
    pub fn outline(&self, count: usize) -> Result<Vec<Station>> {
        let mut all = self.stations(count)?;
        for (i, piece) in self.pieces.iter().enumerate() {
            let places = signs::slope(piece).inside.into_iter().chain(piece.range());
            all.extend(places.map(|t| self.spot(i, t).station).filter(|s| s.numbers().iter().all(|x| x.is_finite())));
        }
        all.sort_by(|a, b| a.station.total_cmp(&b.station));
        Ok(all)
    }

    /// The largest curvature by size; NaN where the path stands still.
    ///
    /// # Accuracy
    /// As the extrema of the curvature.
    pub fn greatest_curvature(&self) -> f64 {
        self.pieces.iter().map(signs::greatest_curvature).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
    }

    /// `∫ κ² ds`; nothing where a piece is neither a Pythagorean-hodograph quintic nor a line nor an arc.
    pub fn bending_energy(&self) -> Option<f64> {
        self.sum(PhQuintic::bending_energy, |curvature, length| curvature * curvature * length)
    }

    /// `∫ |κ| ds`, radians; known as [`Course::bending_energy`] is.
    pub fn absolute_rotation(&self) -> Option<f64> {
        self.sum(PhQuintic::absolute_rotation, |curvature, length| curvature.abs() * length)
    }

    fn sum(&self, of: fn(&PhQuintic) -> f64, arc: fn(f64, f64) -> f64) -> Option<f64> {
        let one = |piece: &Piece| match piece {
            Piece::PhQuintic(curve) => Some(of(curve)),
            Piece::Line(_) => Some(0.0),
            Piece::Arc(a) => Some(arc(a.curvature, a.length)),
            _ => None,
        };
        self.pieces.iter().map(one).sum()
    }

    /// Where the curvature ends to rise or to fall: inside pieces, and where they join. No jump at a joint is
    /// reported.
    ///
    /// # Accuracy
    /// For PH quintics and cubics all extrema are isolated in doubles. For a trigonometric quintic they are found where
    /// the slope of the curvature has different signs at neighbours of 256 parameters, so that two closer ones may be
    /// missed. The other kinds have none.
    pub fn curvature_extrema(&self) -> Vec<Spot> {
        self.spots(signs::slope)
    }

    /// Where the curvature changes its sign: inside pieces, and where they join.
    ///
    /// # Accuracy
    /// As [`Course::curvature_extrema`]. An involute has one at most, for its curvature is monotone.
    pub fn inflections(&self) -> Vec<Spot> {
        self.spots(signs::bend)
    }

    /// The curve at signed distance `d` to the left, of each piece.
    ///
    /// # Accuracy
    /// Exact for PH quintics. The points of the others are at this distance to a few roundings.
    ///
    /// # Errors
    /// [`Error::Domain`] where a number leaves the range of doubles, or where a piece that is no PH quintic stands
    /// still.
    pub fn offset(&self, d: f64) -> Result<Vec<OffsetCurve>> {
        let fail = |i: usize| {
            Error::invalid(format!(
                "pieces[{i}]: its offset at distance {d:?} is not finite: the piece stands still somewhere, or the \
                 offset leaves the range of doubles; then {OTHER_UNIT}"
            ))
        };
        let one = |(i, piece): (usize, &Piece)| {
            let (offset, finite) = match piece {
                Piece::PhQuintic(curve) => {
                    let exact = curve.offset(d);
                    let finite = exact.numerator.iter().flatten().chain(&exact.weight).all(|x| x.is_finite());
                    (OffsetCurve::Exact(exact), finite)
                }
                _ => {
                    let all = stations(std::slice::from_ref(piece), OFFSET_POINTS)?;
                    let points: Vec<_> = all.iter().map(|station| station.beside(d)).collect();
                    let finite = points.iter().flatten().all(|x| x.is_finite());
                    (OffsetCurve::Sampled { points }, finite)
                }
            };
            if finite { Ok(offset) } else { Err(fail(i)) }
        };
        self.pieces.iter().enumerate().map(one).collect()
    }

    /// Whether it ends where it starts, in the same direction.
    fn closed(&self) -> bool {
        let (Some(first), Some(last)) = (self.pieces.first(), self.pieces.last()) else { return false };
        let [from, to] = [first.at(first.range()[0]), last.at(last.range()[1])];
        from.point == to.point && (from.heading - to.heading).cos() > 1.0 - 1e-9
    }

    fn spot(&self, piece: usize, parameter: f64) -> Spot {
        let at = self.pieces[piece].at(parameter);
        let station = self.before[piece] + self.pieces[piece].length_to(parameter);
        let [x, y] = at.point;
        Spot { station: Station { station, x, y, heading: at.heading, curvature: at.curvature }, piece, parameter }
    }

    /// Parameters inside pieces, and joints where the sign that pieces have beside them changes. Pieces that have none,
    /// such as lines, are passed over: then it changes at the start of the next one. A path that ends where it starts
    /// joins there, too.
    fn spots(&self, signs: fn(&Piece) -> Signs) -> Vec<Spot> {
        let all: Vec<Signs> = self.pieces.iter().map(signs).collect();
        let some = |numbers: &[f64]| numbers.iter().copied().find(|s| s.abs() > 0.0);
        let mut last =
            if self.closed() { all.iter().rev().find_map(|s| some(&[s.ends[1]])).unwrap_or(0.0) } else { 0.0 };
        let mut spots = Vec::new();
        for (i, Signs { inside, ends: [first, end] }) in all.iter().enumerate() {
            if opposite(*first, last) {
                spots.push(self.spot(i, self.pieces[i].range()[0]));
            }
            last = some(&[*end, *first, last]).unwrap_or(0.0);
            spots.extend(inside.iter().map(|t| self.spot(i, *t)));
        }
        // What lies at a joint may be seen from both sides.
        spots.dedup_by(|next, last| next.station.station - last.station.station <= SAME * self.length);
        spots
    }
}
