//! The spirals that joins are made of: between two curvatures of one sign, or from or to 0, of a given length.
//!
//! Their shape is that of nearly constant parametric speed, so that the curvature is nearly linear in the length, as a
//! clothoid's is. With end curvatures and the angle between the end directions given, a cubic has two free numbers, the
//! lengths h0, h1 of its outer legs, and a PH quintic the moduli A, B of its outer pre-images; its inner numbers follow
//! from (3.4) of Habib & Sakai and from `w1 = (κ0 A³ e^{iθ/2} + κ1 B³) / (4 sin(θ/2))`. Here h0 = h1 = L/3 and A² = B²
//! = L, but at a straight end the outer leg is m times the inner one, as in Habib & Sakai's CGIV paper, with m = 1.
//! Spirals that turn by more than some 0.6 rad need other legs to have monotone curvature ([`Spiral::shape`]).

use super::super::clothoid::{Clothoid, clothoid_step};
use super::super::cubic::chosen_spiral;
use super::super::involute::involute_between;
use super::super::ph_quintic;
use super::super::piece::{Arc, Cubic, InvoluteBetween, Line, Piece, TrigPart, of_legs};
use super::super::placement::Ends;
use super::super::segment::{Base, Request, Target, add_segment};
use super::super::turn::Turn;
use super::lengths::{cubic_length, near};
use super::request::Family;
use super::trig::{STRAIGHT, TrigWay};
use crate::curve::vector::{Vector, add, length, scale, sub, turn, unit};
use crate::curve::{CubicBezier, Jet, PhQuintic};
use crate::error::Result;
use crate::family::reach::{Kind, Level};
use std::f64::consts::PI;

/// A spiral leads at least this factor from one curvature to the other.
const APART: f64 = 0.55;
/// By what share the same curve's length may differ by roundings: it is computed to 1e-13 or better, here and there.
const SAME: f64 = 1e-12;

/// Point and direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pose {
    pub at: Vector,
    pub direction: f64,
}

impl Pose {
    /// The vector that (1, 0) is turned to.
    pub(super) fn along(&self) -> Vector {
        unit(self.direction)
    }
}

/// A spiral: curvatures of one sign, or one of them 0, and the length that a clothoid that turns as far would have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spiral {
    pub from: f64,
    pub to: f64,
    pub length: f64,
}

impl Spiral {
    /// How far it turns, with its sign.
    pub(super) fn angle(&self) -> f64 {
        0.5 * (self.from + self.to) * self.length
    }

    /// |dκ/ds|, were it a clothoid.
    pub(super) fn mean_rate(&self) -> f64 {
        (self.to - self.from).abs() / self.length
    }

    /// The greatest |dκ/ds|, nearly: of cubics and PH quintics at six points, closer together where they are round,
    /// since one that turns far hurries there; of the others as if they were clothoids.
    pub(super) fn rate(&self, family: Family) -> f64 {
        let greatest = |jet: &dyn Fn(f64) -> Jet| {
            let places = [0.0, 0.5, 0.75, 0.875, 0.9375, 1.0];
            let rounder = self.to.abs() > self.from.abs();
            let rates = places.map(|t| jet(if rounder { t } else { 1.0 - t }).curvature_ds().abs());
            rates.into_iter().fold(0.0, f64::max)
        };
        match family {
            Family::Cubic => {
                let legs = self.legs(family);
                greatest(&|t| of_legs(&legs, t))
            }
            Family::PhQuintic => {
                let curve = self.ph();
                greatest(&|t| curve.jet(t))
            }
            Family::Involute | Family::TrigQuintic | Family::Clothoid => self.mean_rate(),
        }
    }

    /// ∫ κ² ds, were it a clothoid.
    pub(super) fn bending_energy(&self) -> f64 {
        self.length * (self.from * self.from + self.from * self.to + self.to * self.to) / 3.0
    }

    /// Whether the family has a spiral between two curvatures, neither of them 0: of one sign, and apart by a factor at
    /// least. Nearer ones are no spirals but for arcs.
    pub(super) fn between_round(family: Family, from: f64, to: f64) -> bool {
        let (less, more) = (from.abs().min(to.abs()), from.abs().max(to.abs()));
        from * to > 0.0 && less <= APART * more && family != Family::TrigQuintic
    }

    /// The most that a spiral of [`Spiral::step`] between two curvatures turns, radians.
    pub(super) fn most(family: Family, from: f64, to: f64) -> f64 {
        match family {
            // All of them are spirals. This reaches circles two radii away from a line.
            Family::Clothoid => 1.5 * PI,
            Family::TrigQuintic if from != 0.0 && to != 0.0 => TrigWay::whole(STRAIGHT, from, to).angle(),
            _ if from == 0.0 || to == 0.0 => STRAIGHT,
            _ => 1.15,
        }
    }

    /// By how much the legs are longer than L/3, and by how much the one at the flatter end is longer than the other is
    /// shorter; at a straight end m instead.
    ///
    /// Fitted: for angles up to [`Spiral::most`] and ratios of curvature from 0.05 to 0.8 the result has monotone
    /// curvature, in the middle of the range of those that have. Close to the greatest angle it grows long, so that
    /// circles far from a line are reached. What is used is proved all the same.
    fn shape(&self, family: Family) -> [f64; 2] {
        let angle = self.angle().abs();
        let (flat, round) = (self.from.abs().min(self.to.abs()), self.from.abs().max(self.to.abs()));
        if family == Family::Clothoid {
            return [1.0, 1.0];
        }
        if family == Family::TrigQuintic {
            // These are as long as they are; nearly their chord.
            return [length(self.step(family)) / self.length * (1.0 + angle * angle / 48.0), 1.0];
        }
        if flat == 0.0 {
            return if family == Family::PhQuintic {
                [1.0 + 12.0 * (angle - 0.95).max(0.0).powi(2), (1.6 - angle).clamp(0.6, 1.0)]
            } else {
                let more = (angle - 0.7).max(0.0);
                [1.0 + 2.5 * more * more * (1.0 + more), (1.75 - 1.5 * angle).clamp(0.4, 1.0)]
            };
        }
        if family == Family::PhQuintic {
            return [1.0, 1.0];
        }
        let (ratio, share) = (flat / round, ((angle - 0.5) / 0.3).clamp(0.0, 1.0));
        let longer = ratio.powf(-0.22 * (1.0 - ratio).sqrt());
        let uneven = 0.3 - 2.0 / 3.0 * (ratio - 0.5).max(0.0);
        // Where this is 1 and the curvatures are near, two cubics nearly coincide, and doubles cannot tell them apart.
        let even = 1.0 - 0.02 * ((ratio - 0.2) / 0.2).clamp(0.0, 1.0);
        [even + share * (longer - even), 1.0 + share * uneven]
    }

    /// How long it is, nearly.
    pub(super) fn stretched(&self, family: Family) -> f64 {
        self.length * self.shape(family)[0]
    }

    /// From its start to its end, for a start along (1, 0), and what its length is at least and at most.
    ///
    /// The length of an involute's image is not asked for: its chord and its legs to the corner of its tangents bound
    /// it, as those of any convex arc. [`cubic_length`] bounds a cubic's. Lengths of the others are known to
    /// roundings: the coefficients of a PH quintic's speed are positive, so no sum cancels. But between two round ends
    /// curves are solved for, and another that nearly coincides may be found: of 40,000 PH quintics lengths differed
    /// by up to 7e-6.
    pub(super) fn measured(&self, family: Family) -> (Vector, [f64; 2]) {
        let (angle, side) = (self.angle().abs(), self.angle().signum());
        let ([x, y], lengths) = match family {
            Family::Cubic => {
                let legs @ [a, b, c] = self.legs(family);
                (add(a, add(b, c)), cubic_length(legs))
            }
            Family::PhQuintic => {
                let curve = self.ph();
                // Of two that nearly coincide the other may be built between round ends.
                let share = if self.from == 0.0 || self.to == 0.0 { SAME } else { 1e-5 };
                (curve.end, near(curve.length(), share))
            }
            Family::TrigQuintic => {
                let way = TrigWay::of(angle, self.from.abs(), self.to.abs());
                way.map_or(([f64::NAN; 2], [f64::NAN; 2]), |way| (way.step(), near(way.length(), SAME)))
            }
            Family::Clothoid => (self.step_left(family), near(self.length, SAME)),
            Family::Involute => {
                let [x, y] = self.step_left(family);
                ([x, y], [length([x, y]), x + y * (0.5 * angle).tan()])
            }
        };
        ([x, side * y], lengths)
    }

    /// From its start to its end, for a start along (1, 0).
    pub(super) fn step(&self, family: Family) -> Vector {
        let [x, y] = self.step_left(family);
        [x, self.angle().signum() * y]
    }

    /// The same, turning left.
    fn step_left(&self, family: Family) -> Vector {
        let (angle, k0, k1) = (self.angle().abs(), self.from.abs(), self.to.abs());
        match family {
            Family::Cubic | Family::Involute => {
                let [a, b, c] = self.legs(family);
                add(a, add(b, c))
            }
            Family::PhQuintic => self.ph().end,
            Family::Clothoid => clothoid_step(0.0, [k0, k1], self.length),
            Family::TrigQuintic => TrigWay::of(angle, k0, k1).map_or([f64::NAN; 2], |way| way.step()),
        }
    }

    /// The legs of the cubic, for a start along (1, 0), turning left.
    fn legs(&self, family: Family) -> [Vector; 3] {
        let (angle, k0, k1) = (self.angle().abs(), self.from.abs(), self.to.abs());
        let ([longer, uneven], (sine, cosine)) = (self.shape(family), angle.sin_cos());
        let h = longer * self.length / 3.0;
        let [flat, round] = if k0.min(k1) == 0.0 { [h, h] } else { [h * uneven, h / uneven] };
        let [h0, h1] = if k0 < k1 { [flat, round] } else { [round, flat] };
        let (x, y) = (1.5 * k1 * h1 * h1 / sine, 1.5 * k0 * h0 * h0 / sine);
        let h0 = if k0 == 0.0 { uneven * x } else { h0 };
        let h1 = if k1 == 0.0 { uneven * y } else { h1 };
        [[h0, 0.0], [x + y * cosine, y * sine], [h1 * cosine, h1 * sine]]
    }

    /// The PH quintic, from the origin along (1, 0), turning left.
    fn ph(&self) -> PhQuintic {
        let (angle, k0, k1) = (self.angle().abs(), self.from.abs(), self.to.abs());
        let [longer, m] = self.shape(Family::PhQuintic);
        let (half, root) = (0.5 * angle, (longer * self.length).sqrt());
        let [x, y] = [k1, k0].map(|k| k * root * root * root / (4.0 * half.sin()));
        let a = if k0 == 0.0 { m * x } else { root };
        let b = if k1 == 0.0 { m * y } else { root };
        let tilted = |f: f64| [f * half.cos(), f * half.sin()];
        PhQuintic::new([0.0, 0.0], [[a, 0.0], add([x, 0.0], tilted(y)), tilted(b)])
    }

    /// The proved spiral in units of `1 / scale`, from a pose of the user's frame, with the pose where it ends; `None`
    /// where the family has none.
    pub(super) fn piece(&self, family: Family, at: Pose, scale_by: f64) -> Result<Option<(Piece, Pose)>> {
        let direction = at.direction + self.angle();
        let placed = match family {
            Family::Clothoid => Some(Piece::Clothoid(Clothoid {
                start: at.at,
                start_direction: at.direction,
                curvature: self.from * scale_by,
                end_curvature: self.to * scale_by,
                length: self.length / scale_by,
            })),
            Family::TrigQuintic => match TrigWay::of(self.angle().abs(), self.from, self.to) {
                Some(way) => way.piece(at.at, at.direction, scale_by, self.angle())?,
                None => None,
            },
            Family::Cubic | Family::PhQuintic if self.from == 0.0 || self.to == 0.0 => {
                self.straight_ended(family, at, scale_by)?
            }
            _ => return self.with_ends(family, at, scale_by),
        };
        Ok(placed.map(|piece| {
            let end = piece.end();
            (piece, Pose { at: end, direction })
        }))
    }

    /// As [`Spiral::piece`], by the family's own answer to both ends.
    fn with_ends(&self, family: Family, at: Pose, scale_by: f64) -> Result<Option<(Piece, Pose)>> {
        let direction = at.direction + self.angle();
        let end = add(at.at, scale(turn(at.along(), self.step(family)), 1.0 / scale_by));
        let ends = Ends {
            start: at.at,
            end,
            start_direction: at.direction,
            end_direction: direction,
            start_curvature: self.from * scale_by,
            end_curvature: self.to * scale_by,
        };
        let piece = between(family, &ends)?;
        Ok(piece.map(|piece| (piece, Pose { at: end, direction })))
    }

    /// One end is straight.
    fn straight_ended(self, family: Family, at: Pose, scale_by: f64) -> Result<Option<Piece>> {
        let round = self.from + self.to;
        let [longer, m] = self.shape(family);
        let request = Request {
            base: if self.from == 0.0 { Base::Line } else { Base::Circle },
            start: at.at,
            direction: at.direction,
            turn: if round > 0.0 { Turn::Left } else { Turn::Right },
            radius: 1.0 / (round.abs() * scale_by),
            theta: self.angle().abs(),
            target: Target::Shape { m, q: longer * self.length * round.abs() },
        };
        let kind = if family == Family::PhQuintic { Kind::Ph } else { Kind::Cubic };
        Ok(match add_segment(kind, &request)? {
            Ok(added) if added.level >= Level::Exact => Some(added.piece),
            _ => None,
        })
    }
}

/// The family's proved spiral between two ends, if it has one.
pub(super) fn between(family: Family, ends: &Ends) -> Result<Option<Piece>> {
    Ok(match family {
        Family::Cubic => chosen_spiral(ends)?.map(|s| s.piece()),
        Family::PhQuintic => ph_quintic::chosen_spiral(ends)?.map(|s| Piece::PhQuintic(s.curve)),
        // Of those from a straight end none has these ends but by chance.
        Family::TrigQuintic => None,
        Family::Clothoid => Clothoid::between(ends).map(Piece::Clothoid),
        Family::Involute => {
            let (found, frame) = involute_between(ends, [0, 0])?;
            InvoluteBetween::of(ends, &found, &frame).map(Piece::Involute)
        }
    })
}

/// The same way, travelled back.
pub(super) fn reversed(piece: Piece) -> Result<Piece> {
    Ok(match piece {
        Piece::Cubic(Cubic { points, legs }) => {
            let ([a, b, c, d], [u, v, w]) = (points.p, legs);
            Piece::Cubic(Cubic { points: CubicBezier { p: [d, c, b, a] }, legs: [w, v, u].map(|leg| scale(leg, -1.0)) })
        }
        Piece::PhQuintic(PhQuintic { start, end, preimage: [u, v, w] }) => {
            Piece::PhQuintic(PhQuintic::between(end, start, [w, v, u].map(|[x, y]| [-y, x])))
        }
        Piece::Line(Line { start, end }) => Piece::Line(Line { start: end, end: start }),
        Piece::Arc(arc) => {
            let back = arc.start_direction + arc.curvature * arc.length + PI;
            let start = Piece::Arc(arc).end();
            Piece::Arc(Arc { start, start_direction: back, curvature: -arc.curvature, length: arc.length })
        }
        Piece::Clothoid(clothoid) => Piece::Clothoid(clothoid.reversed()),
        Piece::Involute(between) => {
            let e = *between.ends();
            let ends = Ends {
                start: e.end,
                end: e.start,
                start_direction: e.end_direction + PI,
                end_direction: e.start_direction + PI,
                start_curvature: -e.end_curvature,
                end_curvature: -e.start_curvature,
            };
            Piece::Involute(InvoluteBetween::new(&ends, [0, 0])?)
        }
        Piece::TrigQuintic(TrigPart { curve, from, to }) => {
            Piece::TrigQuintic(TrigPart { curve: curve.reversed(), from: 1.0 - to, to: 1.0 - from })
        }
    })
}

/// The same piece with its end moved by a rounding to where the next one starts.
pub(super) fn pinned(piece: Piece, to: Vector) -> Result<Piece> {
    Ok(match piece {
        Piece::Cubic(Cubic { points, legs }) => {
            let [a, b, c, _] = points.p;
            Piece::Cubic(Cubic { points: CubicBezier { p: [a, b, c, to] }, legs })
        }
        Piece::PhQuintic(curve) => Piece::PhQuintic(PhQuintic::between(curve.start, to, curve.preimage)),
        Piece::Involute(between) => {
            let ends = Ends { end: to, ..*between.ends() };
            Piece::Involute(InvoluteBetween::new(&ends, [0, 0])?)
        }
        // The end of a part is no point of the polygon.
        Piece::TrigQuintic(part) if part.to == 1.0 => {
            let mut curve = part.curve;
            curve.sides[2] = add(curve.sides[2], sub(to, curve.points()[5]));
            Piece::TrigQuintic(TrigPart { curve, ..part })
        }
        other => other,
    })
}

#[cfg(test)]
mod tests {
    use super::super::measure::greatest_rate;
    use super::*;

    /// What is built is as long as was said before.
    #[test]
    fn lengths_are_known_before_anything_is_built() {
        for family in Family::ALL {
            let wide = match family {
                Family::Involute => 0.2,
                Family::Cubic | Family::PhQuintic => 2.1e-5,
                _ => 1e-11,
            };
            let mut built = 0;
            for i in 0..2000 {
                let share = |n: u32| f64::from((i * n) % 2003) / 2003.0;
                let (round, flat) = (0.1 + 0.9 * share(37), if i % 2 == 0 { 0.0 } else { 0.54 * share(101) });
                let most = Spiral::most(family, round * flat, round).min(STRAIGHT);
                let length = 2.0 * most * (0.05 + 0.94 * share(211)) / (round + round * flat);
                let (from, to) = if i % 3 == 0 { (round, round * flat) } else { (round * flat, round) };
                let spiral = Spiral { from, to, length };
                let ([x, y], [least, most]) = spiral.measured(family);
                let start = Pose { at: [0.0, 0.0], direction: 0.0 };
                let Some((piece, end)) = spiral.piece(family, start, 1.0).unwrap() else { continue };
                built += 1;
                let long = piece.length();
                assert!(least <= long && long <= most, "{family:?}, {spiral:?}: {long} beyond {least} to {most}");
                assert!(most - least < wide * long && super::length(sub(end.at, [x, y])) < 1e-12 * long);
            }
            println!("{family:?}: {built}");
            assert!(built > 100, "{family:?}: {built}");
        }
    }

    /// Up to the greatest angles: the greatest rates are known to a tenth, so that the least of them is built.
    #[test]
    fn rates_are_known_before_anything_is_built() {
        for family in [Family::Cubic, Family::PhQuintic] {
            let mut built = 0;
            for i in 0..400 {
                let share = |n: u32| f64::from((i * n) % 401) / 401.0;
                let (round, flat) = (0.1 + 0.9 * share(37), if i % 2 == 0 { 0.0 } else { 0.54 * share(101) });
                let angle = Spiral::most(family, round * flat, round) * (0.1 + 0.9 * share(211));
                let length = 2.0 * angle / (round + round * flat);
                let (from, to) = if i % 3 == 0 { (round, round * flat) } else { (round * flat, round) };
                let spiral = Spiral { from, to, length };
                let start = Pose { at: [0.0, 0.0], direction: 0.0 };
                let Some((piece, _)) = spiral.piece(family, start, 1.0).unwrap() else { continue };
                built += 1;
                let known = spiral.rate(family) / greatest_rate(&[piece]);
                assert!((0.9..1.0 + 1e-9).contains(&known), "{family:?}, {spiral:?}: {known}");
            }
            assert!(built > 300, "{family:?}: {built}");
        }
    }
}
