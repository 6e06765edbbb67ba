//! Two straight lines joined by spirals alone: two around their corner, or four in an S where they run side by side.
//!
//! Two spirals of one length that lead to a curvature and back are a gentle turn ([`leg`]), whatever its angle. At a
//! given angle the legs grow as the length does. So the length is free around a corner. In an S two such turns, by
//! opposite angles, lead aside by both legs between the corners times the sine of the angle. That grows with the angle,
//! so the angle is a root in one unknown, whatever the length depends on.

use super::super::piece::principal;
use super::ease::leg;
use super::link::{Chain, Link, SHORTEST, root};
use super::request::Family;
use super::spiral::{Pose, Spiral};
use crate::curve::vector::{Vector, add, cross, scale, sub, unit};
use std::f64::consts::FRAC_PI_2;

/// Lengths of spirals in least radii: short ones for the shortest join, long ones for gentle joins.
const LENGTHS: [f64; 5] = [SHORTEST, 0.4, 1.2, 4.8, 16.0];
/// A turn by less than this, radians, is a rounding.
const ROUNDING: f64 = 1e-13;

/// What makes spirals as long as they are.
#[derive(Debug, Clone, Copy)]
pub(super) enum Size {
    /// Their curvature goes up to this.
    Peak(f64),
    /// They are so long.
    Long(f64),
    /// A join of this length has room for them.
    Room(f64),
}

impl Size {
    /// All that are tried.
    pub(super) fn all(peaks: &[f64], longest: f64) -> impl Iterator<Item = Size> {
        // The longest spirals are the gentlest.
        let room = longest.is_finite().then_some(Size::Room(longest));
        peaks.iter().map(|peak| Size::Peak(*peak)).chain(LENGTHS.map(Size::Long)).chain(room)
    }

    /// For turns by some angles.
    fn length(self, family: Family, angles: &[f64]) -> f64 {
        match self {
            Size::Peak(peak) => angles.iter().fold(0.0f64, |most, angle| most.max(angle.abs())) / peak,
            Size::Long(length) => length,
            // A turn lies between its chord and its legs, so it is shorter than they are.
            Size::Room(length) => length / angles.iter().map(|angle| 2.0 * leg(family, *angle, 1.0)).sum::<f64>(),
        }
    }
}

/// Two spirals of a length that turn by an angle, if they keep the limit and the family has them.
fn turned(family: Family, angle: f64, length: f64) -> Option<[Spiral; 2]> {
    let k = angle / length;
    let fits = k.abs() <= 1.0 && length >= SHORTEST && angle.abs() >= ROUNDING;
    (fits && 0.5 * angle.abs() <= Spiral::most(family, 0.0, k))
        .then_some([Spiral { from: 0.0, to: k, length }, Spiral { from: k, to: 0.0, length }])
}

fn link(family: Family, spiral: Spiral) -> Link {
    Link::direct(family, spiral.from, spiral.to, spiral.length).rated(family)
}

/// Around the corner of two lines.
pub(super) fn corner(family: Family, [a, b]: [Pose; 2], corner: Vector, size: Size) -> Option<Chain> {
    let angle = principal(b.direction - a.direction);
    let length = size.length(family, &[angle]);
    let spirals = turned(family, angle, length)?;
    let leg = leg(family, angle, length);
    let start = Pose { at: sub(corner, scale(a.along(), leg)), ..a };
    Some(Chain::alone(start, add(corner, scale(b.along(), leg)), spirals.map(|spiral| link(family, spiral)).to_vec()))
}

/// From a point of a line to another line beside it, in an S.
pub(super) fn beside(family: Family, [a, b]: [Pose; 2], size: Size) -> Option<Chain> {
    let across = cross(b.along(), sub(b.at, a.at));
    let all = principal(b.direction - a.direction);
    let angles = |angle: f64| [angle.copysign(across), all - angle.copysign(across)];
    // The second corner. It lies on the line but for a rounding of the line's own point, which may be far away: a
    // short spiral moved by that would have another curvature.
    let corner = |[first, second]: [f64; 2], length: f64| {
        let [s, t] = [first, second].map(|angle| leg(family, angle, length));
        add(a.at, add(scale(a.along(), s), scale(unit(a.direction + first), s + t)))
    };
    let short = |angle: f64| {
        let angles = angles(angle);
        cross(b.along(), sub(b.at, corner(angles, size.length(family, &angles)))) * across.signum()
    };
    let angles = angles(root(short, 0.1 * ROUNDING, FRAC_PI_2)?);
    let length = size.length(family, &angles);
    let [first, second] = angles.map(|angle| turned(family, angle, length));
    let ([one, two], [three, four]) = (first?, second?);
    let end = add(corner(angles, length), scale(b.along(), leg(family, angles[1], length)));
    let middle = Link::over_line(family, [two.from, three.to], [length; 2]).rated(family);
    Some(Chain::alone(a, end, vec![link(family, one), middle, link(family, four)]))
}
