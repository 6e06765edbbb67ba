//! Paths that bend as little as possible: both minimisations of section 6, by branch and bound.

use super::{complex, pair};
use crate::curve::PhQuintic;
use crate::curve::vector::finite_ends;
use crate::error::{Error, Result};
use crate::family::ph_path::{Candidate, Search};
use crate::num::demand_ieee;
use crate::queue::Queue;
use crate::steps::step;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// What a search may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Free {
    /// The arc length of paths whose end derivatives are of one length, which is the same as to vary that.
    Length,
    /// The lengths of both end derivatives.
    Derivatives,
}

/// End points, directions of travel, what is free, and how long the path may be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Directions {
    /// Where it starts.
    pub start: [f64; 2],
    /// Where it ends, elsewhere.
    pub end: [f64; 2],
    /// Direction of travel at the start, radians from the x axis.
    pub start_direction: f64,
    /// Direction of travel at the end.
    pub end_direction: f64,
    /// Greatest arc length, above the distance of the ends, at most 1e6 times that.
    pub greatest_length: f64,
    /// What the search may change.
    pub free: Free,
}

/// The path that bends least of those searched, and what is known of the others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LeastCurvature {
    /// The path.
    pub curve: PhQuintic,
    /// Its greatest |curvature|.
    pub greatest_curvature: f64,
    /// No path within the searched ranges has a greatest |curvature| below this: proved, up to 1e-12 of it.
    pub at_least: f64,
    /// Its arc length.
    pub length: f64,
    /// Lengths of its end derivatives.
    pub derivatives: [f64; 2],
    /// From where to where the length of each end derivative was searched.
    pub searched: [f64; 2],
}

/// A search ends when the proved bound is no further than this share of the best path's curvature below that, or when
/// [`MOST`] is spent. It is far above the roundings of both, and so small that nobody would build the difference.
const TOLERANCE: f64 = 1e-6;
/// Ranges that are halved at most; about a hundred suffice for one free number, some hundreds and near straight lines
/// some thousands for two.
const MOST: usize = 20_000;
/// Steps of one length in the local search, at most: each is a rate of the numbers, so that with all lengths they lead
/// anywhere.
const MOVES: usize = 40;
/// Least derivative over the distance.
const LEAST: f64 = 1e-2;

/// The path of least greatest curvature between two ends with given directions.
///
/// Searched are all four PH quintics for end derivatives from a hundredth of the distance on, that are no longer than
/// allowed, up to 1e-12 of that. A derivative is at most nine times the length: a polynomial w of degree 2 with
/// `w(0) = 1` has `∫ w² >= 1/9`. Where little more than the distance is allowed, the search begins at half of what is
/// allowed beyond it.
///
/// # Accuracy
/// `at_least` is proved by enclosing means of curvatures over ranges of the free numbers, in halves until it is within
/// 1e-6 of what was found, or until 20,000 halvings are spent: then it is what they have proved. The curve is refined
/// by a local search.
///
/// The proof takes the angles of the directions to the chord as doubles give them, within 1e-15.
///
/// # Errors
/// [`Error::Domain`] naming a number that is not finite, ends that coincide, a greatest length not above their distance
/// or beyond a million times that. [`Error::NoPath`] where no searched path is short enough, or none but such as all
/// but stand still at their ends.
///
/// ```
/// use spiral_atlas::path::{Directions, Free, least_curvature};
/// let (start, end) = ([0.0, 0.0], [1.0, 0.0]);
/// let (start_direction, end_direction) = (std::f64::consts::FRAC_PI_6, std::f64::consts::FRAC_PI_4);
/// let (greatest_length, free) = (2.0, Free::Length);
/// let found = least_curvature(&Directions { start, end, start_direction, end_direction, greatest_length, free })?;
/// assert!((found.greatest_curvature - 3.1210262).abs() < 1e-7 && (found.derivatives[0] - 1.4132589).abs() < 1e-5);
/// assert!(found.at_least > 3.12102 && found.at_least <= found.greatest_curvature);
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn least_curvature(ends: &Directions) -> Result<LeastCurvature> {
    demand_ieee()?;
    let (chord, search) = checked(ends)?;
    let distance = chord.norm();
    // By Farouki et al., (10), equal end derivatives of paths of a length S have at least 3/2 (S - 1), for S near 1.
    let low = LEAST.min(0.5 * search.beyond);
    let space = Space::new(search, ends.free, low);
    let (best, at_least) = space.least().ok_or_else(|| {
        let length = ends.greatest_length;
        Error::NoPath(format!("no path with these directions is as short as `greatest_length`, {length:?}; allow more"))
    })?;
    let back = chord.sqrt();
    let curve = PhQuintic::between(ends.start, ends.end, best.preimage.map(|w| pair(complex(w) * back)));
    if !curve.is_regular() {
        return Err(Error::NoPath(format!(
            "the paths as short as `greatest_length`, {:?}, all but stand still at their ends, slower than 1e-12 of \
             their mean speed, where doubles have no curvature for them: it hardly exceeds the distance {distance:?} \
             of the ends; allow more",
            ends.greatest_length
        )));
    }
    let greatest_curvature = curve.greatest_curvature().1;
    Ok(LeastCurvature {
        curve,
        greatest_curvature,
        at_least: (at_least / distance * (1.0 - 1e-12)).min(greatest_curvature),
        length: curve.length(),
        derivatives: [curve.speed(0.0), curve.speed(1.0)],
        searched: [low * distance, 9.0 * (1.0 + search.beyond) * distance],
    })
}

fn fail<T>(what: String) -> Result<T> {
    Err(Error::invalid(format!("least curvature: {what}")))
}

/// The chord, and what is searched in units of it.
fn checked(ends: &Directions) -> Result<(Complex64, Search)> {
    let Directions { start, end, start_direction, end_direction, greatest_length, .. } = *ends;
    let (directions, most) = ([start_direction, end_direction], ("greatest_length", greatest_length));
    finite_ends("least curvature", [start, end], directions, most)?;
    let chord = complex(end) - complex(start);
    let distance = chord.norm();
    if distance == 0.0 {
        return fail(format!("`start` and `end` are both {start:?}; the ends must be apart"));
    }
    if !(greatest_length > distance && greatest_length <= 1e6 * distance) {
        return fail(format!(
            "`greatest_length` is {greatest_length:?}; it must exceed the distance {distance:?} of the ends, at most \
             1e6 times"
        ));
    }
    let theta = |direction: f64| (Complex64::cis(direction) * chord.conj()).arg();
    let theta = [theta(start_direction), theta(end_direction)];
    Ok((chord, Search { theta, beyond: (greatest_length - distance) / distance }))
}

/// The free numbers, and from where to where each is searched.
struct Space {
    search: Search,
    free: Free,
    ranges: [[f64; 2]; 2],
}

/// A product of ranges, one or two, and what the greatest curvature exceeds there.
#[derive(Debug, Clone, Copy)]
struct Region {
    ranges: [[f64; 2]; 2],
    least: f64,
}

impl Space {
    fn new(search: Search, free: Free, low: f64) -> Space {
        let [a, b] = search.sizes();
        let [a, b] = if free == Free::Length { [a.min(b); 2] } else { [a, b] };
        Space { search, free, ranges: [a, b].map(|high| [low, high]) }
    }

    fn dimensions(&self) -> usize {
        if self.free == Free::Derivatives { 2 } else { 1 }
    }

    /// With one free number both sizes are that.
    fn at(&self, x: [f64; 2]) -> Option<Candidate> {
        step();
        self.search.at([x[0], x[self.dimensions() - 1]])
    }

    fn region(&self, ranges: [[f64; 2]; 2], least: f64, enough: f64) -> Region {
        step();
        let found = self.search.least(ranges, self.dimensions() == 1, enough);
        Region { ranges, least: found.max(least) }
    }

    /// The best path, and what is proved of all.
    fn least(&self) -> Option<(Candidate, f64)> {
        let refined = |(x, found)| self.refined(x, found);
        // Of straight lines the one at constant speed.
        let plain = [1.0; 2];
        let mut best = lesser(self.at(plain).map(|found| (plain, found)), self.scanned()).map(refined);
        let mut waiting = Queue::new();
        let whole = self.region(self.ranges, 0.0, f64::INFINITY);
        waiting.push(whole.least, whole);
        for _ in 0..MOST {
            let most = best.map_or(f64::INFINITY, |(_, found)| found.most);
            let Some((_, region)) = waiting.pop_below(most * (1.0 - TOLERANCE)) else { break };
            let middle = region.ranges.map(|[a, b]| 0.5 * (a + b));
            best = lesser(best, self.at(middle).map(|found| (middle, found)));
            for half in self.halves(&region, most) {
                if half.least < most {
                    waiting.push(half.least, half);
                }
            }
        }
        let (_, found) = best.map(refined)?;
        let proved = waiting.least().unwrap_or(f64::INFINITY);
        Some((found, proved.min(found.most)))
    }

    /// The best of a coarse grid.
    fn scanned(&self) -> Option<([f64; 2], Candidate)> {
        let count = [200, 24][self.dimensions() - 1];
        let value = |[low, high]: [f64; 2], i: usize| low * (high / low).powf(i as f64 / count as f64);
        let others = if self.dimensions() == 1 { 0 } else { count };
        let places = (0..=count).flat_map(|i| (0..=others).map(move |j| [i, j]));
        places
            .map(|place| [0, 1].map(|k| value(self.ranges[k], place[k])))
            .filter_map(|x| Some((x, self.at(x)?)))
            .min_by(|a, b| a.1.most.total_cmp(&b.1.most))
    }

    /// Both halves along the range whose ends differ most: by what |w| is there, against that of the chord or more.
    fn halves(&self, region: &Region, enough: f64) -> [Region; 2] {
        let wide = |range: &[f64; 2]| (range[1].sqrt() + 1.0) / (range[0].sqrt() + 1.0);
        let split = usize::from(self.dimensions() == 2 && wide(&region.ranges[1]) > wide(&region.ranges[0]));
        let [low, high] = region.ranges[split];
        let middle = if high > 4.0 * low { (low * high).sqrt() } else { 0.5 * (low + high) };
        [[low, middle], [middle, high]].map(|half| {
            let mut ranges = region.ranges;
            ranges[split] = half;
            self.region(ranges, region.least, enough)
        })
    }

    /// Steps in directions all around, turned each time, as long as they help and not for ever, then shorter ones:
    /// between a kink or the greatest length and what is better there may be little room, and along it a search would
    /// only creep.
    fn refined(&self, mut x: [f64; 2], mut found: Candidate) -> ([f64; 2], Candidate) {
        let (mut step, mut turn, around) = (0.1, 0.0, if self.dimensions() == 1 { 2 } else { 24 });
        let mut moves = 0;
        while step > 1e-12 {
            let moved = (0..around).filter_map(|i| {
                let angle = turn + std::f64::consts::TAU * f64::from(i) / f64::from(around);
                let way =
                    if self.dimensions() == 1 { [1.0 - 2.0 * f64::from(i); 2] } else { [angle.cos(), angle.sin()] };
                let next = [0, 1].map(|i| (x[i] * (1.0 + step * way[i])).clamp(self.ranges[i][0], self.ranges[i][1]));
                Some((next, self.at(next)?))
            });
            let best = moved.min_by(|a, b| a.1.most.total_cmp(&b.1.most));
            // The golden angle comes near every direction.
            turn += 2.399963;
            match best {
                Some((next, better)) if better.most < found.most && moves < MOVES => {
                    (x, found) = (next, better);
                    moves += 1;
                }
                _ => (step, moves) = (0.7 * step, 0),
            }
        }
        (x, found)
    }
}

fn lesser(a: Option<([f64; 2], Candidate)>, b: Option<([f64; 2], Candidate)>) -> Option<([f64; 2], Candidate)> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.1.most < a.1.most { b } else { a }),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::counted;
    use std::f64::consts::PI;

    /// Lengths that exceed the distance by ulps or much, and directions that are straight, nearly straight, mirrored,
    /// equal or opposed.
    #[test]
    fn the_work_does_not_depend_on_how_degenerate_the_ends_are() {
        let angles = [0.0, 5e-324, 1e-16, 1e-8, 1e-3, 0.5, 0.5 * PI, PI.next_down(), PI];
        let mut most = 0;
        for greatest_length in [1.0f64.next_up(), 1.0 + 2.0 * f64::EPSILON, 1.000001, 2.0] {
            for (i, first) in angles.into_iter().enumerate() {
                for last in [-first.next_up(), angles[(i + 5) % angles.len()], 0.0] {
                    let (start, end, free) = ([0.0, 0.0], [1.0, 0.0], Free::Derivatives);
                    let ends =
                        Directions { start, end, start_direction: first, end_direction: last, greatest_length, free };
                    most = most.max(counted(|| least_curvature(&ends)).0);
                }
            }
        }
        // The ranges that are halved, and two local searches.
        assert!(most <= 3 * MOST + 2 * 24 * (MOVES + 1) * 73, "{most}");
    }
}
