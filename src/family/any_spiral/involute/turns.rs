//! How many turns about either end a spiral can take.

use super::super::Datum;
use serde::Serialize;
use std::f64::consts::PI;

/// Whether a curve takes its turns about the two ends as asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Split {
    /// As asked.
    Asked,
    /// Not this curve: it has as many turns in all, but others about each end. Some other spiral can do as asked.
    Other,
    /// No spiral can: one with so many turns in all takes from `least` to `most` of them about the start.
    Impossible {
        /// Fewest turns about the start.
        least: u32,
        /// Most turns about the start.
        most: u32,
    },
}

/// Fewest and most turns about the start among all spirals of increasing curvature with `turns` in all.
///
/// The spiral stays outside of, or inside, both end circles of curvature, as the signs of the curvatures say. With
/// k1 >= 0 it lies within the first circle, which the line beyond the start meets nowhere else, so that it never turns
/// about the start; likewise for k2 <= 0 and the end. Between, its tangent at the inflection parts the two circles:
/// directions of such lines lie in an interval within (-π, 0), and the curve turns right from its start, and left to
/// its end, from or to one of them. Without a turn about the start (the end) α (β) must lie above the least of these
/// directions.
pub(super) fn range(chord: &Datum, turns: u32) -> (u32, u32) {
    if turns == 0 || chord.k1 >= 0.0 {
        return (0, 0);
    }
    if chord.k2 <= 0.0 {
        return (turns, turns);
    }
    let least = least_direction(chord);
    (u32::from(chord.alpha <= least), turns - u32::from(chord.beta <= least))
}

/// The least direction, in (-π, 0), of lines with the circle at the start on their right and that at the end on their
/// left.
fn least_direction(chord: &Datum) -> f64 {
    let (r1, r2) = (-1.0 / chord.k1, 1.0 / chord.k2);
    // From centre to centre; centres lie to the right at the start and to the left at the end.
    let x = 2.0 - r2 * chord.beta.sin() - r1 * chord.alpha.sin();
    let y = r2 * chord.beta.cos() + r1 * chord.alpha.cos();
    let slack = ((r1 + r2) / x.hypot(y)).min(1.0).acos();
    let direction = y.atan2(x) - 0.5 * PI - slack;
    if direction < -PI { direction + 2.0 * PI } else { direction }
}
