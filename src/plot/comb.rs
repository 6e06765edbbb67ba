//! Curvature combs.

use super::drawing::Drawing;
use super::geometry::{Point, Rect};
use super::palette::PALE;
use super::style::Style;

/// Length of the longest tooth, as a share of the diagonal of the curve's box.
const SHARE: f64 = 0.14;
/// From one tooth to the next along the curve, in em.
const STEP: f64 = 0.7;

/// Teeth across a curve, as long as its curvature there is great, on the side away from which it bends.
pub(super) struct Comb {
    /// Points of the curve and, for each, the tip of its tooth.
    teeth: Vec<[Point; 2]>,
}

impl Comb {
    /// The comb of a curve of so great a curvature at each of its points; none where it does not bend.
    pub(super) fn new(curve: &[Point], curvature: impl Iterator<Item = f64> + Clone) -> Comb {
        let most = curvature.clone().fold(0.0, |most: f64, k| most.max(k.abs()));
        let extent = |i: usize| {
            let (low, high) =
                curve.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| (lo.min(p[i]), hi.max(p[i])));
            high - low
        };
        let longest = SHARE * extent(0).hypot(extent(1));
        if most == 0.0 || !longest.is_finite() {
            return Comb { teeth: Vec::new() };
        }
        // Where points coincide the curve has the direction that it had.
        let mut along = [0.0, 0.0];
        let tooth = |(i, k): (usize, f64)| {
            let (before, here, after) = (curve[i.saturating_sub(1)], curve[i], curve[(i + 1).min(curve.len() - 1)]);
            let chord = [after[0] - before[0], after[1] - before[1]];
            let length = chord[0].hypot(chord[1]);
            if length > 0.0 {
                along = [chord[0] / length, chord[1] / length];
            }
            let tooth = k / most * longest;
            [here, [here[0] + along[1] * tooth, here[1] - along[0] * tooth]]
        };
        Comb { teeth: curvature.take(curve.len()).enumerate().map(tooth).collect() }
    }

    /// Where its teeth end.
    pub(super) fn tips(&self) -> impl Iterator<Item = &Point> {
        self.teeth.iter().map(|[_, tip]| tip)
    }

    /// Draws it, under the curve.
    pub(super) fn draw(&self, canvas: &mut Drawing, style: Style, clip: Rect, place: impl Fn(&Point) -> Point) {
        let places: Vec<[Point; 2]> = self.teeth.iter().map(|[foot, tip]| [place(foot), place(tip)]).collect();
        // One shape for all: a point that is not finite parts a tooth from the next.
        let (mut teeth, mut way) = (Vec::new(), f64::INFINITY);
        for (i, [foot, tip]) in places.iter().enumerate() {
            let before = places[i.saturating_sub(1)][0];
            way += (foot[0] - before[0]).hypot(foot[1] - before[1]);
            if way >= STEP * style.em || i + 1 == places.len() {
                teeth.extend([*foot, *tip, [f64::NAN; 2]]);
                way = 0.0;
            }
        }
        canvas.line(&teeth, style.em * 0.05, PALE, clip);
        let tips: Vec<Point> = places.iter().map(|[_, tip]| *tip).collect();
        canvas.line(&tips, style.em * 0.08, PALE, clip);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn teeth_stand_on_the_outer_side_and_are_as_long_as_the_curvature() {
        // A quarter of a circle of radius 2 to the left, from (2, 0), then twice its curvature said at one point.
        let curve: Vec<Point> =
            (0..=90).map(|i| f64::from(i).to_radians().sin_cos()).map(|(s, c)| [2.0 * c, 2.0 * s]).collect();
        let longest = SHARE * 8f64.sqrt();
        let radii = |curvature: &[f64]| -> Vec<f64> {
            Comb::new(&curve, curvature.iter().copied()).tips().map(|p| p[0].hypot(p[1])).collect()
        };
        // The chords at the ends are half a step of direction off.
        assert!(radii(&[0.5; 91]).iter().all(|r| (r - 2.0 - longest).abs() < 1e-4));
        assert!(radii(&[-0.5; 91]).iter().all(|r| (r - 2.0 + longest).abs() < 1e-4), "to the right");
        let mut bent = [0.5; 91];
        bent[45] = 1.0;
        let found = radii(&bent);
        assert!((found[45] - 2.0 - longest).abs() < 1e-4 && (found[9] - 2.0 - longest / 2.0).abs() < 1e-4);
        assert_eq!(Comb::new(&curve, [0.0; 91].into_iter()).tips().count(), 0, "a straight line has none");
    }
}
