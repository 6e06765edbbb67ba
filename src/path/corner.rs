//! Rounding the corner of a polyline by a PH quintic that joins its legs with continuous curvature:
//! Farouki et al., (15)-(21).

use super::{complex, finite, pair};
use crate::curve::PhQuintic;
use crate::error::{Error, OTHER_UNIT, Result, above_zero};
use num_complex::Complex64;

/// A path of two straight legs turns: half the turning angle θ, as cosine c and sine s.
///
/// A corner curve of reach L leaves the first leg a distance L before the corner and joins the second one L behind it.
/// Its curvature is 0 at both ends and largest in the middle.
///
/// # Accuracy
/// c and s are known to a few units of 2^-53, absolute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Directions of the legs.
    legs: [Complex64; 2],
    /// Unit vectors with half their angles, the roots of them.
    roots: [Complex64; 2],
    cosine: f64,
    sine: f64,
}

impl Turn {
    /// From one direction to another; `None` for vectors of no length, and for turning back.
    pub fn new(incoming: [f64; 2], outgoing: [f64; 2]) -> Option<Turn> {
        let unit = |v: [f64; 2]| complex(v) / v[0].hypot(v[1]);
        let legs = [unit(incoming), unit(outgoing)];
        let [first, last] = legs.map(|leg| leg.sqrt());
        let half = first.conj() * last;
        // Either root will do; the one within a right angle of the first makes the shorter turn.
        let sign = 1f64.copysign(half.re);
        let turn = Turn { legs, roots: [first, last * sign], cosine: half.re * sign, sine: half.im * sign };
        (turn.cosine > 0.0).then_some(turn)
    }

    /// The turning angle θ, in (-π, π), positive to the left.
    pub fn angle(&self) -> f64 {
        2.0 * self.sine.atan2(self.cosine)
    }

    /// The curvature in the middle of the corner curve, positive to the left: (17).
    pub fn curvature(&self, reach: f64) -> f64 {
        self.reach_for_curvature(1.0).copysign(self.sine) / reach
    }

    /// Length of the corner curve: (17).
    pub fn length(&self, reach: f64) -> f64 {
        2.0 * reach * (6.0 + self.cosine) * self.cosine / (6.0 * self.cosine + 1.0)
    }

    /// How much shorter the corner curve is than the legs it replaces.
    pub fn saved(&self, reach: f64) -> f64 {
        2.0 * reach * self.sine * self.sine / (6.0 * self.cosine + 1.0)
    }

    /// How far the middle of the corner curve is from the corner: (18).
    pub fn deviation(&self, reach: f64) -> f64 {
        (3.0 * self.cosine + 8.0) * self.sine.abs() * reach / (8.0 * (6.0 * self.cosine + 1.0))
    }

    /// The reach at which curvature attains a bound: the least that keeps it, (20).
    pub fn reach_for_curvature(&self, most: f64) -> f64 {
        let c = self.cosine;
        32.0 * (6.0 * c + 1.0) * (self.sine / c).abs() / (15.0 * (c + 1.0) * (c + 1.0) * most)
    }

    /// The reach at which the middle of the curve comes to the vertex of an obstacle that turns as the path does, both
    /// sides a distance `offset` from the path: the largest that keeps out of it, (19). Infinite for a path that does
    /// not turn.
    pub fn reach_for_offset(&self, offset: f64) -> f64 {
        8.0 * (6.0 + 1.0 / self.cosine) * offset / ((3.0 * self.cosine + 8.0) * self.sine.abs())
    }

    /// How far from the sides of an obstacle that turns as it does a path must run so that, rounded with curvature up
    /// to `most`, it keeps `clearance` from the obstacle; with no clearance (21).
    ///
    /// With the corner as origin and y along the bisector to the obstacle, its vertex is at height `offset / c`, and a
    /// point (x, y) of the path keeps the clearance when `offset >= c (y + √(clearance² - x²))`. The greatest over the
    /// path is wanted. Legs alone give `clearance`.
    ///
    /// # Accuracy
    /// 1e-3 of it, from 65 points of the curve; exact without a clearance, where the middle decides.
    pub fn least_offset(&self, clearance: f64, most: f64) -> f64 {
        let reach = self.reach_for_curvature(most);
        // Where the foot of the vertex on a leg is not cut off, the leg decides.
        let foot = clearance * self.sine.abs() / self.cosine;
        let leg = if foot > reach { clearance } else { 0.0 };
        let (inward, curve) = self.standard(reach);
        let needed = |i: i32| {
            let point = complex(curve.point(f64::from(i) / 128.0)) * inward.conj();
            // The middle lies on the bisector.
            let across = if i == 64 { 0.0 } else { point.im };
            let room = clearance * clearance - across * across;
            (room >= 0.0).then(|| self.cosine * (point.re + room.sqrt()))
        };
        (0..=64).filter_map(needed).fold(leg, f64::max)
    }

    /// The corner curve for a corner at the origin, and the direction to its inside.
    fn standard(&self, reach: f64) -> (Complex64, PhQuintic) {
        let [first, last] = self.legs;
        // Across the mean direction, which is the product of the roots.
        let inward = self.roots[0] * self.roots[1] * Complex64::new(0.0, 1f64.copysign(self.sine));
        (inward, PhQuintic::between(pair(-first * reach), pair(last * reach), self.preimage(reach)))
    }

    /// (15).
    fn preimage(&self, reach: f64) -> [[f64; 2]; 3] {
        // λ √L.
        let size = (30.0 * self.cosine / (6.0 * self.cosine + 1.0) * reach).sqrt();
        let [first, last] = self.roots.map(|root| pair(root * size));
        [first, [0.0, 0.0], last]
    }

    /// The corner curve of a reach for a corner at a point: the pre-image from (15), its ends on the legs.
    ///
    /// # Errors
    /// [`Error::Domain`] for a reach not above 0, or a result that is not finite.
    ///
    /// ```
    /// use spiral_atlas::path::Turn;
    /// let turn = Turn::new([1.0, 0.0], [0.0, 1.0]).unwrap();
    /// let curve = turn.corner([5.0, 0.0], 2.0)?;
    /// assert_eq!((curve.start, curve.end, curve.curvature(0.0)), ([3.0, 0.0], [5.0, 2.0], 0.0));
    /// assert!((curve.curvature(0.5) / turn.curvature(2.0) - 1.0).abs() < 1e-14);
    /// # Ok::<(), spiral_atlas::Error>(())
    /// ```
    pub fn corner(&self, at: [f64; 2], reach: f64) -> Result<PhQuintic> {
        finite("corner", "at", &at)?;
        above_zero("corner: the reach", reach)?;
        let [first, last] = self.legs.map(|leg| leg * reach);
        let curve = PhQuintic::between(pair(complex(at) - first), pair(complex(at) + last), self.preimage(reach));
        match curve.is_finite() {
            true => Ok(curve),
            false => Err(Error::beyond_doubles(format!("corner: a curve of reach {reach:?} at {at:?}"), OTHER_UNIT)),
        }
    }

    /// The straight line between two points that runs along the incoming leg, or along the outgoing one: the direction
    /// is that of the corner curve to the last bit but one, however short the line.
    pub(super) fn line(&self, outgoing: bool, [start, end]: [[f64; 2]; 2]) -> PhQuintic {
        let length = (complex(end) - complex(start)).norm();
        PhQuintic::between(start, end, [pair(self.roots[usize::from(outgoing)] * length.sqrt()); 3])
    }
}
