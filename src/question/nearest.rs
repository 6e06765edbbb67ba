//! The nearest datum that has a property.

use super::property::{Cell, Property};
use crate::error::{Error, Result};
use crate::family::MOST_SIDES;
use crate::queue::Queue;

/// The search ends when the best distance is at most 1 + this times the proved lower bound.
const CLOSE: f64 = 1e-3;
/// Most boxes that one answer looks at.
const MOST_BOXES: usize = 30_000;
/// Most boxes of each first search, in which two coordinates vary.
const SLICE_BOXES: usize = 1000;
/// One box in so many has its middle tried.
const OFFERS: usize = 16;
/// Steps of the best datum, and the least of them, as a share of its distance.
const STEPS: usize = 400;
const LEAST_STEP: f64 = 1e-9;
/// Random data that are tried, the powers of two between which their coordinates are, and how many of them descend.
const TRIES: usize = 10_000;
const SIZES: [f64; 2] = [-7.0, 3.0];
const STARTS: usize = 10;
/// The moves of two coordinates may be apart by so many powers of two.
const SIZES_APART: f64 = 16.0;
/// Coordinates that may change lie within this size, or between it and the datum's own.
const FAR: f64 = 1e6;

/// The nearest datum with a property, as far as it is known.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Nearest {
    /// A datum that has the property: proved. None where none was found.
    pub point: Option<Vec<f64>>,
    /// Its distance from the given datum.
    pub distance: Option<f64>,
    /// Every datum with the property is at least so far away: proved. Infinite where there is none at all.
    #[serde(serialize_with = "finite")]
    pub at_least: f64,
    /// How many boxes were looked at.
    pub boxes: usize,
}

/// Infinity is null in JSON.
fn finite<S: serde::Serializer>(x: &f64, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serde::Serialize::serialize(&x.is_finite().then_some(*x), serializer)
}

/// Weighted distances from a datum.
struct Metric<'p> {
    point: &'p [f64],
    weights: &'p [f64],
}

impl Metric<'_> {
    /// `√Σ (w Δ)²` over the coordinates that may change.
    fn distance(&self, to: &[f64]) -> f64 {
        let sides = self.point.iter().zip(to).zip(self.weights).filter(|((from, to), _)| from != to);
        sides.map(|((from, to), weight)| (weight * (to - from)).powi(2)).sum::<f64>().sqrt()
    }

    /// The point of a box that is nearest to the datum.
    fn clamped(&self, cell: &Cell) -> Vec<f64> {
        self.point.iter().enumerate().map(|(i, x)| x.clamp(cell.low[i], cell.high[i])).collect()
    }
}

/// The closest datum that has a property, of all whose coordinates are at most 1e6 in size.
///
/// The distance of two data is `√Σ (w Δ)²`, over coordinates with their weights w. It says what to change least where
/// a property fails.
///
/// # Arguments
/// - `weights`: one for each coordinate, 1e-50 to 1e50; infinity for one that must stay as it is.
///
/// # Accuracy
/// The datum that is returned has the property: its verdict is exact. `at_least` is proved by boxes of which none has
/// the property, rounded down. Both differ by 0.1 % at most, unless the answer stops after 30,000 boxes.
///
/// # Errors
/// [`Error::Domain`] for a datum or weights that are none; [`Error::Undecided`] at the precision cap.
pub fn nearest(property: &Property, point: &[f64], weights: &[f64]) -> Result<Nearest> {
    let whole = searched(property, point, weights)?;
    let metric = Metric { point, weights };
    if property.at(point)? == Some(true) {
        return Ok(Nearest { point: Some(point.to_vec()), distance: Some(0.0), at_least: 0.0, boxes: 0 });
    }
    let mut search = Search { property, metric, best: None, boxes: 0, halvings: 8, noise: Noise(1) };
    let free: Vec<usize> = (0..point.len()).filter(|i| weights[*i].is_finite()).collect();
    // Random data and searches over two coordinates at a time are cheap and give a first bound. Then the best is
    // improved by small moves.
    search.scatter(&free)?;
    for (k, i) in free.iter().enumerate() {
        for j in &free[..k] {
            let mut slice = property.point(point)?;
            for side in [*i, *j] {
                (slice.low[side], slice.high[side]) = (whole.low[side], whole.high[side]);
            }
            search.run(slice, SLICE_BOXES)?;
        }
    }
    search.descend(&free)?;
    search.halvings = 40;
    let budget = MOST_BOXES - search.boxes;
    let at_least = search.run(whole, budget)?;
    search.descend(&free)?;
    let Search { best, boxes, .. } = search;
    let (distance, point) = best.unzip();
    // Each distance has at most eight roundings; the bound is lowered by as much.
    let at_least = distance.map_or(at_least, |found| at_least.min(found)) * (1.0 - 8.0 * f64::EPSILON);
    Ok(Nearest { point, distance, at_least, boxes })
}

/// A search in progress.
struct Search<'p> {
    property: &'p Property,
    metric: Metric<'p>,
    /// The nearest datum with the property so far, and its distance.
    best: Option<(f64, Vec<f64>)>,
    boxes: usize,
    /// How often the way to the datum is halved to find where the property ends. Beside the end a verdict costs most,
    /// so that only the last search goes near.
    halvings: usize,
    noise: Noise,
}

impl Search<'_> {
    /// Searches a box, nearest parts first. Returns a lower bound of the distance of every datum in it that has the
    /// property; infinity where there is none.
    fn run(&mut self, whole: Cell, budget: usize) -> Result<f64> {
        let mut waiting = Queue::new();
        self.push(&mut waiting, whole);
        let end = self.boxes + budget;
        while let Some((distance, cell)) = waiting.pop() {
            let enough = self.best.as_ref().is_some_and(|(found, _)| distance * (1.0 + CLOSE) >= *found);
            if enough || self.boxes >= end {
                return Ok(distance);
            }
            self.boxes += 1;
            let facts = self.property.facts(&cell);
            match self.property.verdict(&facts) {
                Some(false) => continue,
                // Its nearest point is the nearest of all that are left.
                Some(true) => {
                    self.offer(self.metric.clamped(&cell))?;
                    return Ok(distance);
                }
                None if self.boxes.is_multiple_of(OFFERS) || self.best.is_none() => {
                    let middle = |i: usize| 0.5 * cell.low[i] + 0.5 * cell.high[i];
                    self.offer((0..self.metric.point.len()).map(middle).collect())?;
                }
                None => {}
            }
            if let Some(parts) = divided(&self.metric, &cell, facts.pull) {
                parts.into_iter().for_each(|part| self.push(&mut waiting, part));
            } else {
                // The box cannot be divided: its nearest point is asked for its verdict.
                self.offer(self.metric.clamped(&cell))?;
            }
        }
        Ok(f64::INFINITY)
    }

    fn push(&self, waiting: &mut Queue<Cell>, mut cell: Cell) {
        if self.property.clip(&mut cell) {
            waiting.push(self.metric.distance(&self.metric.clamped(&cell)), cell);
        }
    }

    /// Tries a datum. If it has the property, moves it towards the given one as far as the property lasts, and keeps it
    /// if it is then the nearest. Returns whether it was kept.
    fn offer(&mut self, to: Vec<f64>) -> Result<bool> {
        let best = self.best.as_ref().map_or(f64::INFINITY, |(found, _)| *found);
        // Those beyond twice the best are seldom much nearer when moved.
        if self.metric.distance(&to) > 2.0 * best || self.property.at(&to)? != Some(true) {
            return Ok(false);
        }
        let at = |share: f64| -> Vec<f64> {
            self.metric.point.iter().zip(&to).map(|(from, to)| from + share * (to - from)).collect()
        };
        // At share 0 lies the given datum, which lacks the property.
        let (mut fails, mut holds, mut found) = (0.0, 1.0, to.clone());
        for _ in 0..self.halvings {
            let share = 0.5 * (fails + holds);
            let tried = at(share);
            if self.property.at(&tried)? == Some(true) {
                (holds, found) = (share, tried);
            } else {
                fails = share;
            }
        }
        let distance = self.metric.distance(&found);
        let nearer = distance < best;
        if nearer {
            self.best = Some((distance, found));
        }
        Ok(nearer)
    }

    /// Finds data with the property among random ones of all sizes, and lets each descend: one alone may end where
    /// every small move fails.
    fn scatter(&mut self, free: &[usize]) -> Result<()> {
        let mut starts = 0;
        for _ in 0..TRIES {
            let mut to = self.metric.point.to_vec();
            for side in free {
                // A third of the coordinates stay.
                if self.noise.unit() < 2.0 / 3.0 {
                    let size = 2f64.powf(SIZES[0] + (SIZES[1] - SIZES[0]) * self.noise.unit());
                    to[*side] = if self.noise.unit() < 0.25 { -size } else { size };
                }
            }
            if self.property.at(&to)? != Some(true) {
                continue;
            }
            let before = self.best.take();
            self.offer(to)?;
            self.descend(free)?;
            let nearer = |a: &(f64, Vec<f64>), b: &(f64, Vec<f64>)| a.0 < b.0;
            self.best = match (before, self.best.take()) {
                (Some(a), Some(b)) => Some(if nearer(&a, &b) { a } else { b }),
                (a, b) => a.or(b),
            };
            starts += 1;
            if starts == STARTS {
                break;
            }
        }
        Ok(())
    }

    /// Moves the best by random steps and back towards the datum. Steps grow where they help and shrink where not.
    fn descend(&mut self, free: &[usize]) -> Result<()> {
        let mut step = 0.5;
        for _ in 0..STEPS {
            let Some((distance, from)) = self.best.clone() else { return Ok(()) };
            let to = self.moved(&from, step * distance, free);
            // At this pace steps neither grow nor shrink where one in eight helps.
            step *= if self.offer(to)? { 1.75 } else { 0.92 };
            if step < LEAST_STEP {
                break;
            }
        }
        Ok(())
    }

    /// A datum in a random direction from another, no further than about this distance. The moves of its coordinates
    /// are, every other time, of different sizes, since the room for them may be so, too.
    fn moved(&mut self, from: &[f64], distance: f64, free: &[usize]) -> Vec<f64> {
        let mut to = from.to_vec();
        let even = self.noise.unit() < 0.5;
        for side in free {
            let size = distance * if even { 1.0 } else { 2f64.powf(-SIZES_APART * self.noise.unit().powi(2)) };
            to[*side] += size * self.noise.bell() / self.metric.weights[*side];
        }
        to
    }
}

/// Random numbers, the same in every search (splitmix64).
struct Noise(u64);

impl Noise {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    /// About normal, of variance 1/4.
    fn bell(&mut self) -> f64 {
        self.unit() + self.unit() + self.unit() - 1.5
    }
}

/// Where data may lie: the datum's own coordinate where that must stay, else all numbers of a size.
fn searched(property: &Property, point: &[f64], weights: &[f64]) -> Result<Cell> {
    let mut whole = property.point(point)?;
    if weights.len() != point.len() {
        let count = Error::domain("the number of weights", weights.len() as f64, point.len().to_string());
        return Err(count.or(format!("one for each of {}", property.axes().join(", "))));
    }
    for (i, (weight, axis)) in weights.iter().zip(property.axes()).enumerate() {
        if !(1e-50..=1e50).contains(weight) && *weight != f64::INFINITY {
            let weight = Error::domain(format!("the weight of {axis}"), *weight, "1e-50 to 1e50");
            return Err(weight.or(format!("infinity keeps {axis}")));
        }
        // So no distance leaves the range of doubles.
        if weight.is_finite() && point[i].abs() > 1e50 {
            return Err(Error::domain(*axis, point[i], "at most 1e50 in size"));
        }
        if weight.is_finite() {
            (whole.low[i], whole.high[i]) = (point[i].min(-FAR), point[i].max(FAR));
        }
    }
    Ok(whole)
}

/// Parts of a box along the side that says most: the one that moves what is open most, or the widest as distances go.
fn divided(metric: &Metric<'_>, cell: &Cell, pull: [f64; MOST_SIDES]) -> Option<[Cell; 2]> {
    let pull = |i: usize| if pull[i].is_finite() { pull[i] } else { 0.0 };
    let width =
        |i: usize| (cell.high[i] - cell.low[i]) * if metric.weights[i].is_finite() { metric.weights[i] } else { 0.0 };
    let sides = 0..metric.point.len();
    let widest = sides.clone().map(width).fold(f64::MIN_POSITIVE, f64::max);
    let most = sides.clone().map(pull).fold(f64::MIN_POSITIVE, f64::max);
    let score = |i: usize| pull(i) / most + width(i) / widest;
    let (side, at) =
        sides.filter_map(|i| Some((i, cell.middle(i)?))).max_by(|a, b| score(a.0).total_cmp(&score(b.0)))?;
    Some(cell.parts(side, at))
}
