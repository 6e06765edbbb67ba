//! Trigonometric spirals: those from or to a straight end, and parts of them between two curvatures, as in the paper's
//! circle within a circle.

use super::super::piece::{Piece, TrigPart};
use crate::curve::vector::{Vector, sub, turn, unit};
use crate::curve::{TrigBezier, arc_length};
use crate::error::Result;
use crate::family::trig_quintic::{SPIRAL, Scaling, Shape, flags};
use crate::num::roots::find;
use crate::steps::step as count;
use std::f64::consts::PI;

/// The most that a spiral with a straight end turns that is no clothoid, radians.
pub(super) const STRAIGHT: f64 = 1.3;
/// Angles, radians, that are the same to roundings.
const ROUNDING: f64 = 1e-15;

/// The part of a spiral from a straight end that leads from one curvature to another of the same sign.
pub(super) struct TrigWay {
    shape: Shape,
    /// Curvature of its round end, by size.
    round: f64,
    /// Whether it is travelled from the flatter end to the rounder one.
    rising: bool,
    /// The whole, which turns left, with the radius of its round end.
    curve: TrigBezier,
    /// Where the part begins.
    from: f64,
}

impl TrigWay {
    /// Of the spiral that turns by an angle in all.
    pub(super) fn whole(theta: f64, from: f64, to: f64) -> TrigWay {
        let (flat, round) = (from.abs().min(to.abs()), from.abs().max(to.abs()));
        // A ratio of 6 gives spirals for all angles to a straight end that are used here.
        let shape = Shape { ratio: 6.0, theta, m: 1.0, p: 0.0, q: 0.0 };
        let curve = shape.curve(1.0 / round, Scaling::Corrected);
        let over = |t: f64| {
            count();
            curve.jet(t).curvature() - flat
        };
        let begins = if flat == 0.0 { 0.0 } else { find(over, 0.0, 1.0, 1e-17) };
        TrigWay { shape, round, rising: from.abs() < to.abs(), curve, from: begins }
    }

    /// Of one whose part turns by an angle, if there is one.
    pub(super) fn of(angle: f64, from: f64, to: f64) -> Option<TrigWay> {
        if from == 0.0 || to == 0.0 {
            return Some(TrigWay::whole(angle, from, to));
        }
        let over = |theta: f64| TrigWay::whole(theta, from, to).angle() - angle;
        let most = over(STRAIGHT);
        // The one that turns most is asked for by its angle, which was rounded.
        if most.abs() <= ROUNDING {
            return Some(TrigWay::whole(STRAIGHT, from, to));
        }
        (most > 0.0).then(|| TrigWay::whole(find(over, angle, STRAIGHT, 1e-17), from, to))
    }

    /// Direction where the part begins.
    fn begins(&self) -> f64 {
        if self.from == 0.0 { 0.0 } else { self.curve.jet(self.from).direction() }
    }

    /// How far the part turns.
    pub(super) fn angle(&self) -> f64 {
        self.shape.theta - self.begins()
    }

    /// How long the part is, as [`Piece::length`] has it.
    pub(super) fn length(&self) -> f64 {
        arc_length(|t| self.curve.speed(t), self.from, 1.0)
    }

    /// From where the part begins to where it ends, for a start along (1, 0), turning left.
    pub(super) fn step(&self) -> Vector {
        let across = sub(self.curve.points()[5], self.curve.jet(self.from).point);
        let [x, y] = turn(unit(-self.begins()), across);
        if self.rising { [x, y] } else { turn(unit(self.angle()), [x, -y]) }
    }

    /// In units of `1 / scale`, from a point and a direction of the user's frame, turning by an angle with its sign;
    /// `None` where it is not proved.
    pub(super) fn piece(&self, at: Vector, direction: f64, scale_by: f64, angle: f64) -> Result<Option<Piece>> {
        if flags(&self.shape)? & SPIRAL == 0 {
            return Ok(None);
        }
        let curve = self.shape.curve(1.0 / (self.round * scale_by), Scaling::Corrected);
        let mirrored = |curve: &TrigBezier| curve.mapped(curve.start, |[x, y]| [x, -y]);
        // Run backwards it starts along θ + π and turns the other way.
        let (curve, begins, [from, to]) = if self.rising {
            (curve, self.begins(), [self.from, 1.0])
        } else {
            (mirrored(&curve).reversed(), PI - self.shape.theta, [0.0, 1.0 - self.from])
        };
        let curve = if angle > 0.0 { curve } else { mirrored(&curve) };
        let along = unit(direction - begins.copysign(angle));
        let before = turn(along, sub(curve.jet(from).point, curve.start));
        let curve = curve.mapped(sub(at, before), |z| turn(along, z));
        Ok(Some(Piece::TrigQuintic(TrigPart { curve, from, to })))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::counted;

    /// One root is sought inside the other, and halving would end each after some 60 steps: 3600. It takes fewer,
    /// however near the angle is to nothing or to the most there is, and the curvatures to each other or to 0.
    #[test]
    fn the_part_that_turns_by_an_angle_takes_bounded_steps() {
        let (mut worst, mut found) = (0, 0);
        for flat in [1e-15, 1e-9, 1e-3, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-9, 1.0 - 1e-15] {
            for [from, to] in [[flat, 1.0], [1.0, flat]] {
                let most = TrigWay::whole(STRAIGHT, from, to).angle();
                let shares = (1..20).map(|i| f64::from(i) / 20.0).chain((1..50).map(|i| 2f64.powi(-i)));
                for share in shares.flat_map(|share| [share, 1.0 - share]).chain([1.0]) {
                    let (steps, way) = counted(|| TrigWay::of(share * most, from, to));
                    worst = worst.max(steps);
                    let Some(way) = way else { continue };
                    assert!((way.angle() - share * most).abs() < 1e-14, "{from} {to} {share}: {}", way.angle());
                    found += 1;
                }
            }
        }
        println!("{found}: {worst}");
        assert!(found > 1500 && worst <= 2500, "{found}: {worst}");
    }
}
