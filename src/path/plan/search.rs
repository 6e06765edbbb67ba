//! The shortest polyline among places that can be rounded: a search over legs, since whether a path can turn depends on
//! two of them.

use super::obstacles::{Obstacles, between};
use super::places::Place;
use super::proof::{Clearance, clearance};
use crate::curve::vector::sub;
use crate::path::{Turn, distance};
use crate::queue::Queue;
use std::collections::HashSet;
use std::rc::Rc;

/// Legs found in one search, at most.
const LEGS: usize = 1_000_000;
/// A leg found takes as long as so many looks from one place to another.
const LEG: usize = 4;
/// So many sides looked at take as long as one look from one place to another.
pub(super) const SIDES: usize = 8;
/// And a corner curve that is looked at.
const CURVE: usize = 20;
/// Places this nearly on a line are passed without turning there: sine of the angle.
const STRAIGHT: f64 = 1e-9;
/// Corner curves take no more of a leg than this; between them remains a straight piece.
pub(super) const ROOM: f64 = 0.999;
const START: usize = 0;
const GOAL: usize = 1;

/// What paths must keep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Clearance.
    pub clearance: f64,
    /// A little more, so that rounding does not matter.
    pub keep: f64,
    /// Greatest curvature.
    pub most: f64,
    /// Corner curves are no smaller than this, for doubles to hold their shape.
    pub least_reach: f64,
}

impl Limits {
    /// The least reach of a corner curve, a little more than doubles need to prove its curvature.
    pub(super) fn reach(&self, turn: &Turn) -> f64 {
        (turn.reach_for_curvature(self.most) * (1.0 + 1e-9) + 1e-14 / self.most).max(self.least_reach)
    }

    /// The same with turns as sharp as doubles can hold.
    pub(super) fn sharp(&self) -> Limits {
        Limits { most: 1.0 / self.least_reach, ..*self }
    }

    /// What comes too near to a corner curve.
    pub(super) fn breach(&self, turn: &Turn, at: [f64; 2], reach: f64, obstacles: &Obstacles) -> Option<Why> {
        let Ok(curve) = turn.corner(at, reach) else { return Some(Why::Range) };
        // A curve through a side would be halved down to rounding before that is seen.
        let points: [_; 9] = std::array::from_fn(|i| curve.point(i as f64 * 0.125));
        if let Some(w) = points.windows(2).find(|w| !is_clear(obstacles, [w[0], w[1]], f64::MIN_POSITIVE)) {
            let obstacle = obstacles.nearest(w[0]).map_or(0, |side| side.obstacle);
            return Some(Why::Near(Clearance { at_least: 0.0, at_most: 0.0, point: w[0], obstacle }));
        }
        let clearance = clearance(&[curve], obstacles, self.clearance, f64::INFINITY)?;
        (clearance.at_least < self.clearance || clearance.at_least <= 0.0).then_some(Why::Near(clearance))
    }
}

/// Why a corner curve will not do.
#[derive(Debug, Clone, Copy)]
pub(super) enum Why {
    /// It comes too near.
    Near(Clearance),
    /// It leaves the range of doubles.
    Range,
}

/// How the search ended.
#[derive(Debug)]
pub(super) enum SearchResult {
    /// Places from start to goal, and the length of the polyline.
    Path(Vec<Place>, f64),
    /// There is none.
    None,
    /// Not to the end.
    GaveUp,
}

/// A place that another one sees, with the sides on which their vertices are.
#[derive(Debug, Clone, Copy)]
struct Seen {
    place: usize,
    length: f64,
    here: i8,
    there: i8,
}

/// A leg reached by some path.
struct Leg {
    places: [usize; 2],
    /// Index of its end among what its start sees.
    index: usize,
    length: f64,
    /// On which side of the leg the vertex at its end is.
    side: i8,
    /// The turn at its start, and how much of the leg it takes.
    turn: Option<(Turn, f64)>,
    /// Length of the path up to its end.
    path: f64,
    /// The leg before.
    before: Option<usize>,
}

pub(super) struct Search<'o> {
    obstacles: &'o Obstacles,
    limits: Limits,
    /// Start, goal, and places beside obstacles.
    places: Vec<Place>,
    seen: Vec<Option<Rc<[Seen]>>>,
    legs: Vec<Leg>,
    /// How much of a leg the turn at its start took, for legs looked at, by their start and index.
    taken: Vec<Vec<f64>>,
    /// Legs by the least length of a path through them.
    waiting: Queue<usize>,
    /// Longer paths are not wanted.
    longest: f64,
    /// Looks and legs left.
    work: usize,
    /// Sides looked at until work was last taken off.
    looks: usize,
    /// Sides looked at when the search gives up.
    most_looks: usize,
}

impl<'o> Search<'o> {
    pub(super) fn new(obstacles: &'o Obstacles, limits: Limits, ends: [[f64; 2]; 2], beside: Vec<Place>) -> Search<'o> {
        let free =
            |place: &Place| place.at.iter().all(|x| x.is_finite()) && is_clear(obstacles, [place.at; 2], limits.keep);
        let ends = ends.map(|at| Place { at, vertex: None, wide: false }).into_iter();
        let mut known = HashSet::new();
        let new = |place: &Place| place.cell().is_none_or(|cell| known.insert(cell));
        let places: Vec<Place> = ends.chain(beside.into_iter().filter(free).filter(new)).collect();
        let seen = vec![None; places.len()];
        let taken = vec![vec![]; places.len()];
        let (legs, waiting) = (vec![], Queue::new());
        Search {
            obstacles,
            limits,
            places,
            seen,
            legs,
            taken,
            waiting,
            longest: f64::INFINITY,
            work: usize::MAX,
            looks: obstacles.looks(),
            most_looks: usize::MAX,
        }
    }

    /// Only paths shorter than this, and not for ever.
    pub(super) fn within(self, longest: f64, work: usize) -> Search<'o> {
        Search { longest, work, ..self }
    }

    /// And not past so many sides looked at.
    pub(super) fn looking_at(self, sides: usize) -> Search<'o> {
        Search { most_looks: self.looks + sides, ..self }
    }

    /// Shortest path first, as A* does; a leg is looked at again only where the turn at its start takes less of it than
    /// before.
    ///
    /// Also says how much work is left.
    pub(super) fn run(mut self) -> (SearchResult, usize) {
        let found = self.find();
        (found, self.work)
    }

    fn find(&mut self) -> SearchResult {
        self.extend(None);
        while let Some((_, leg)) = self.waiting.pop() {
            if self.spent() {
                return SearchResult::GaveUp;
            }
            let Leg { places, index, turn, path, .. } = self.legs[leg];
            let takes = turn.map_or(0.0, |(_, reach)| reach);
            if self.taken[places[0]][index] <= takes || self.breaches(places[0], turn) {
                continue;
            }
            self.taken[places[0]][index] = takes;
            if places[1] == GOAL {
                return SearchResult::Path(self.path(leg), path);
            }
            self.extend(Some(leg));
        }
        // What was seen last may not be all.
        if self.spent() { SearchResult::GaveUp } else { SearchResult::None }
    }

    fn spent(&self) -> bool {
        self.legs.len() > LEGS || self.work == 0 || self.obstacles.looks() > self.most_looks
    }

    /// Whether the curve at the start of a leg comes too near to something.
    fn breaches(&mut self, place: usize, turn: Option<(Turn, f64)>) -> bool {
        let breach = turn.is_some_and(|(turn, reach)| {
            self.limits.breach(&turn, self.places[place].at, reach, self.obstacles).is_some()
        });
        self.spend(CURVE);
        breach
    }

    /// Takes off work, and what the sides looked at since then took: where sides nearly coincide, one look meets all of
    /// them.
    fn spend(&mut self, work: usize) {
        let looks = self.obstacles.looks();
        self.work = self.work.saturating_sub(work + (looks - self.looks) / SIDES);
        self.looks = looks;
    }

    /// All legs that go on from a leg, or from the start.
    fn extend(&mut self, before: Option<usize>) {
        let from = before.map_or(START, |leg| self.legs[leg].places[1]);
        for (index, seen) in self.seen_from(from).iter().enumerate() {
            let turn = match before {
                None => None,
                Some(leg) => match self.turn(leg, seen) {
                    Some(turn) => Some(turn),
                    None => continue,
                },
            };
            let takes = turn.map_or(0.0, |(_, reach)| reach);
            let path = before.map_or(0.0, |leg| self.legs[leg].path) + seen.length;
            let bound = path + self.to_goal(seen.place);
            if self.taken[from][index] <= takes || bound >= self.longest {
                continue;
            }
            let leg =
                Leg { places: [from, seen.place], index, length: seen.length, side: seen.there, turn, path, before };
            self.work = self.work.saturating_sub(LEG);
            self.waiting.push(bound, self.legs.len());
            self.legs.push(leg);
        }
    }

    fn to_goal(&self, place: usize) -> f64 {
        distance(self.places[place].at, self.places[GOAL].at)
    }

    /// The turn from a leg to the next one, around the vertex between them, if both have room for it.
    fn turn(&self, leg: usize, next: &Seen) -> Option<(Turn, f64)> {
        let Leg { places: [from, at], length, side, turn: before, .. } = self.legs[leg];
        let [a, b, c] = [from, at, next.place].map(|i| self.places[i].at);
        let (incoming, outgoing) = (sub(b, a), sub(c, b));
        let bend = incoming[0] * outgoing[1] - incoming[1] * outgoing[0];
        // In the open either side will do.
        let inward = if side == 0 { bend.abs() } else { bend * f64::from(side) };
        if next.here != side || inward <= STRAIGHT * length * next.length {
            return None;
        }
        let turn = Turn::new(incoming, outgoing)?;
        let reach = self.limits.reach(&turn);
        let there = (ROOM * length - before.map_or(0.0, |(_, reach)| reach)).min(ROOM * next.length);
        (reach <= there).then_some((turn, reach))
    }

    /// What a place sees, found once.
    fn seen_from(&mut self, from: usize) -> Rc<[Seen]> {
        if let Some(seen) = &self.seen[from] {
            return seen.clone();
        }
        let here = &self.places[from];
        let look = |(i, there): (usize, &Place)| {
            let along = [there.at[0] - here.at[0], there.at[1] - here.at[1]];
            let seen =
                Seen { place: i, length: along[0].hypot(along[1]), here: here.side(along)?, there: there.side(along)? };
            let clear = seen.length > 0.0 && is_clear(self.obstacles, [here.at, there.at], self.limits.keep);
            clear.then_some(seen)
        };
        let within = |_: &(usize, &Place)| self.obstacles.looks() <= self.most_looks;
        let seen: Rc<[Seen]> = self.places.iter().enumerate().skip(GOAL).take_while(within).filter_map(look).collect();
        self.spend(self.places.len());
        self.taken[from] = vec![f64::INFINITY; seen.len()];
        self.seen[from] = Some(seen.clone());
        seen
    }

    fn path(&self, last: usize) -> Vec<Place> {
        let legs = std::iter::successors(Some(&self.legs[last]), |leg| leg.before.map(|i| &self.legs[i]));
        let mut places: Vec<Place> = legs.map(|leg| self.places[leg.places[1]]).collect();
        places.push(self.places[START]);
        places.reverse();
        places
    }
}

/// Whether a segment keeps a distance from all sides, about.
pub(super) fn is_clear(obstacles: &Obstacles, segment: [[f64; 2]; 2], keep: f64) -> bool {
    obstacles.near(segment, keep).all(|side| between(segment, side.ends) >= keep)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::plan::places::places;

    fn squares(step: f64) -> Obstacles {
        let square = |i: usize| {
            [[3.0, -2.0], [7.0, -2.0], [7.0, 2.0], [3.0, 2.0]].map(|p| p.map(|x| x + step * i as f64)).to_vec()
        };
        Obstacles::new(&(0..60).map(square).collect::<Vec<_>>()).unwrap()
    }

    const LIMITS: Limits = Limits { clearance: 0.1, keep: 0.1 + 1e-12, most: 0.3, least_reach: 1e-8 };

    fn among(obstacles: &Obstacles) -> Search<'_> {
        Search::new(obstacles, LIMITS, [[0.0, 0.0], [10.0, 0.0]], places(obstacles, LIMITS.keep, LIMITS.most, 0.0))
    }

    /// Squares that nearly coincide: each look from place to place meets the sides of all of them, and that is work,
    /// too.
    #[test]
    fn sides_that_nearly_coincide_are_work() {
        let obstacles = squares(1e-3);
        let work = 20_000;
        let search = among(&obstacles).within(f64::INFINITY, work);
        let (count, before) = (search.places.len(), obstacles.looks());
        let (found, left) = search.run();
        let looks = obstacles.looks() - before;
        // What was allowed, and all that one place sees beyond it.
        assert!(looks <= SIDES * work + count * 240, "{looks} {count}");
        assert!(matches!(found, SearchResult::GaveUp) && left == 0, "{found:?} {left}");
        // So many sides, those of one more look, and those of one more corner curve.
        let (before, most) = (obstacles.looks(), 50_000);
        let (found, _) = among(&obstacles).looking_at(most).run();
        let looks = obstacles.looks() - before;
        assert!(matches!(found, SearchResult::GaveUp) && looks <= most + count * 240, "{found:?} {looks}");
    }

    #[test]
    fn places_that_nearly_coincide_are_one() {
        let count = |step: f64| among(&squares(step)).places.len();
        // A lattice may part them in each of four coordinates.
        let (one, many) = (count(0.0), count(1e-9));
        assert!(one >= 6 && many <= 16 * one && many < 100, "{one} {many}");
        assert!(count(1e-3) > 30 * one, "{}", count(1e-3));
    }
}
