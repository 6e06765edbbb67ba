//! Clothoids: curves whose curvature is linear in their length, for comparison with the other spirals.
//!
//! With `φ(s) = θ + κ0 s + (κ1 - κ0) s² / (2L)` the point is `p0 + ∫ (cos φ, sin φ) ds`. The integral is taken by the
//! 16-point Gauss-Legendre rule on equal parts, so short that `h |φ'| <= 2` for their half-width h. In the ellipse of
//! the foci -h, h with the sum 5h of its half-axes 2.6 h and 2.4 h, `|Im φ|` is then at most 2.6 · 2.4 · 2 = 12.5. So
//! the rule errs by less than `64/15 e^12.5 5^-32 / (1 - 1/25) h < 6e-17 h`: Trefethen, Approximation Theory, theorem
//! 19.3. Fresnel's integrals are not used: nearly circular clothoids are small differences of them.

use super::placement::Ends;
use crate::curve::gauss;
use crate::curve::vector::{Vector, add, length as norm, scale, sub};
use std::f64::consts::PI;

/// A clothoid: its curvature changes evenly along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clothoid {
    /// Where it starts.
    pub start: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    pub start_direction: f64,
    /// Signed curvature at the start, positive to the left.
    pub curvature: f64,
    /// Signed curvature at the end.
    pub end_curvature: f64,
    /// Arc length, above 0. Times the greater curvature it is at most [`Clothoid::MOST_ANGLE`]; beyond, points are NaN.
    pub length: f64,
}

/// A given end may be missed by this share of the size of the coordinates: below what joins are exact to.
const NEAR: f64 = 1e-13;

impl Clothoid {
    /// Greatest product of the length and the greater curvature, radians: a point takes time in proportion to it.
    pub const MOST_ANGLE: f64 = 1000.0;

    /// The greatest |κ|: at one of the ends.
    pub(crate) fn greatest_curvature(&self) -> f64 {
        self.curvature.abs().max(self.end_curvature.abs())
    }

    /// That times the length.
    pub(crate) fn angle_bound(&self) -> f64 {
        self.greatest_curvature() * self.length
    }

    /// The vector from the start after a share, from 0 to 1, of its length, and the direction there, radians.
    ///
    /// # Accuracy
    /// 1e-15 of the length, and the rounding of the direction times the length.
    pub(super) fn after(&self, share: f64) -> (Vector, f64) {
        let Clothoid { start_direction, curvature: k0, end_curvature, length, .. } = *self;
        let k1 = k0 + (end_curvature - k0) * share;
        let s = share * length;
        (clothoid_step(start_direction, [k0, k1], s), start_direction + 0.5 * (k0 + k1) * s)
    }

    /// The curvature there.
    pub(super) fn curvature_at(&self, share: f64) -> f64 {
        if share < 1.0 { self.curvature + (self.end_curvature - self.curvature) * share } else { self.end_curvature }
    }

    /// dκ/ds.
    pub fn rate(&self) -> f64 {
        (self.end_curvature - self.curvature) / self.length
    }

    /// ∫ κ² ds.
    pub fn bending_energy(&self) -> f64 {
        let (k0, k1) = (self.curvature, self.end_curvature);
        self.length * (k0 * k0 + k0 * k1 + k1 * k1) / 3.0
    }

    /// The same way, travelled back.
    pub(super) fn reversed(&self) -> Clothoid {
        let (across, direction) = self.after(1.0);
        Clothoid {
            start: add(self.start, across),
            start_direction: direction + PI,
            curvature: -self.end_curvature,
            end_curvature: -self.curvature,
            length: self.length,
        }
    }

    /// The one with these ends, which turns by half a turn at most. Directions and curvatures fix its length, so that
    /// there is none unless the end happens to lie right, to 1e-13 of the size of the coordinates.
    pub(super) fn between(ends: &Ends) -> Option<Clothoid> {
        let Ends { start, end, start_direction, end_direction, start_curvature, end_curvature } = *ends;
        let (sin, cos) = (end_direction - start_direction).sin_cos();
        let length = 2.0 * sin.atan2(cos) / (start_curvature + end_curvature);
        let found = Clothoid { start, start_direction, curvature: start_curvature, end_curvature, length };
        if !length.is_finite() || length <= 0.0 || found.angle_bound() > Clothoid::MOST_ANGLE {
            return None;
        }
        let off = norm(sub(add(start, found.after(1.0).0), end));
        (off <= NEAR * (length + norm(start) + norm(end))).then_some(found)
    }
}

/// From the start to the end of a clothoid of a direction at its start, radians, curvatures at both ends, and a length.
pub(super) fn clothoid_step(direction: f64, [from, to]: [f64; 2], length: f64) -> Vector {
    let (first, bend) = (from * length, 0.5 * (to - from) * length);
    let parts = (0.25 * from.abs().max(to.abs()) * length).ceil().max(1.0);
    if parts > 0.25 * Clothoid::MOST_ANGLE {
        return [f64::NAN; 2];
    }
    let along = |u: f64| {
        let (sin, cos) = (direction + u * (first + u * bend)).sin_cos();
        [cos, sin]
    };
    let part = |i: u32| gauss(along, f64::from(i) / parts, f64::from(i + 1) / parts);
    scale((0..parts as u32).map(part).fold([0.0, 0.0], add), length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values of Fresnel's integrals, C and S at 1, 2 and 5 (Abramowitz & Stegun, table 7.7; more digits from
    /// their power series). κ = π s.
    #[test]
    fn fresnels_integrals() {
        for (x, want) in [
            (1.0, [0.779_893_400_376_822_8, 0.438_259_147_390_354_8]),
            (2.0, [0.488_253_406_075_340_8, 0.343_415_678_363_698_2]),
            (5.0, [0.563_631_188_704_012_2, 0.499_191_381_917_116_9]),
        ] {
            let got = clothoid_step(0.0, [0.0, PI * x], x);
            assert!(norm(sub(got, want)) < 4e-15, "{x}: {got:?}");
        }
    }

    /// Any length is the sum of its parts, also nearly a circle and through curvature 0; travelled back it is the same.
    #[test]
    fn parts_and_the_way_back() {
        for (from, to, length) in
            [(0.0, 1.0, 1.3), (-1.0, 1.0, 6.0), (1.0, 1.0 + 1e-15, 3.0), (2.0, 0.5, 40.0), (0.0, 1e-300, 5.0)]
        {
            let whole =
                Clothoid { start: [3.0, -2.0], start_direction: 0.7, curvature: from, end_curvature: to, length };
            let (across, direction) = whole.after(0.375);
            let rest = Clothoid {
                start: add(whole.start, across),
                start_direction: direction,
                curvature: whole.curvature_at(0.375),
                length: 0.625 * length,
                ..whole
            };
            let [a, b] = [whole, rest].map(|c| add(c.start, c.after(1.0).0));
            // Roundings of the directions, which are up to 50, times the length.
            assert!(norm(sub(a, b)) < 1e-13, "{a:?} {b:?}");
            let back = whole.reversed();
            assert!(norm(sub(add(back.start, back.after(1.0).0), whole.start)) < 1e-13, "{back:?}");
            let ends = Ends {
                start: whole.start,
                end: a,
                start_direction: 0.7,
                end_direction: whole.after(1.0).1,
                start_curvature: from,
                end_curvature: to,
            };
            let found = Clothoid::between(&ends);
            let small = 0.5 * (from + to) * length;
            assert_eq!(found.is_some(), small > 1e-3 && small < PI, "{whole:?}");
            assert_eq!(Clothoid::between(&Ends { end: [a[0] + 1e-9, a[1]], ..ends }), None);
        }
    }
}
