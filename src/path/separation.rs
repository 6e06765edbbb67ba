//! How near two vehicles come that travel along their paths at constant speeds: proved, not sampled.
//!
//! On a stretch of time with half-width h around a moment with the separation `r` and the relative velocity `v`, the
//! separation stays above both `|r| - L h`, `L = V1 + V2`, and `min |r + vτ| - K h²/2`, `K = V1² κ1 + V2² κ2` with
//! bounds of the curvatures. Stretches are halved, the one with the least bound first, until the least separation is
//! enclosed and the verdict certain. Where both move in step the second bound needs far fewer stretches than the first;
//! and where their pieces have the same shapes, as those of a formation, one stretch does: the way from one to the
//! other does not change ([`Motion::drift`]).

use super::motion::{Motion, State};
use super::{distance, finite};
use crate::error::{Error, Result};
use crate::num::{Verdict, demand_ieee};
use crate::queue::Queue;
use crate::steps::step;

/// Stretches at most.
const STRETCHES: usize = 100_000;
/// Stretches of all pairs together, after each pair is decided.
const ALL_STRETCHES: usize = 1_000_000;
/// The least separation is enclosed to this share of the greatest length and coordinate, or as rounding allows.
const TOLERANCE: f64 = 1e-10;

/// The closest approach.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Closest {
    /// A time at which the separation is no more than `at_most`.
    pub time: f64,
    /// Where both are then.
    pub points: [[f64; 2]; 2],
    /// The least separation is no less than this.
    pub at_least: f64,
    /// The least separation is no more than this.
    pub at_most: f64,
}

/// What is known of two motions.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Separation {
    /// Whether the minimum distance is kept at all times. It is undecided where the least separation is too close to
    /// the minimum to decide in doubles. JSON says `kept`, `violated` or `undecided`.
    #[serde(serialize_with = "kept")]
    pub verdict: Verdict,
    /// The closest approach.
    pub closest: Closest,
}

/// Writes whether a minimum distance is kept.
pub(crate) fn kept<S: serde::Serializer>(verdict: &Verdict, to: S) -> std::result::Result<S::Ok, S::Error> {
    to.serialize_str(match verdict {
        Verdict::Yes => "kept",
        Verdict::No => "violated",
        Verdict::Undecided => "undecided",
    })
}

/// Whether two vehicles keep a minimum distance, and how near they come.
///
/// At all times: before its start time a vehicle stands at its start, and once it has arrived at its end.
///
/// # Accuracy
/// [`Verdict::Yes`] and [`Verdict::No`] are proved for the curves given, roundings included. The least
/// separation is enclosed to 1e-10 of the size of the scene (lengths and coordinates) where 100,000 stretches suffice;
/// the enclosure holds in any case.
///
/// # Errors
/// [`Error::Domain`] for a minimum distance that is negative or not finite.
pub fn separation(a: &Motion, b: &Motion, minimum: f64) -> Result<Separation> {
    demand_ieee()?;
    check(minimum)?;
    let tolerance = tolerance(a, b);
    let mut search = Search::new(a, b);
    search.run(STRETCHES, |least, most| !verdict(minimum, least, most).is_open() && most - least <= tolerance);
    Ok(search.found(minimum))
}

/// [`separation`] of all pairs, as `(first, second, what is known)` with `first < second`.
///
/// # Accuracy
/// Verdicts are those of [`separation`]. Where 1,000,000 stretches do not suffice for all pairs together, the pairs
/// that come nearest are enclosed as there, and others as far as it takes to decide them.
///
/// # Errors
/// Those of [`separation`].
pub fn separations(motions: &[Motion], minimum: f64) -> Result<Vec<(usize, usize, Separation)>> {
    demand_ieee()?;
    check(minimum)?;
    let pairs = (0..motions.len()).flat_map(|i| (i + 1..motions.len()).map(move |j| (i, j)));
    let mut searches: Vec<(usize, usize, Search)> =
        pairs.map(|(i, j)| (i, j, Search::new(&motions[i], &motions[j]))).collect();
    for (_, _, search) in &mut searches {
        search.run(STRETCHES, |least, most| !verdict(minimum, least, most).is_open());
    }
    let mut order: Vec<usize> = (0..searches.len()).collect();
    order.sort_by(|i, j| searches[*i].2.best.0.total_cmp(&searches[*j].2.best.0));
    let mut left = ALL_STRETCHES;
    for i in order {
        let search = &mut searches[i].2;
        let tolerance = tolerance(search.a, search.b);
        left -= search.run(left.min(STRETCHES), |least, most| most - least <= tolerance);
    }
    Ok(searches.into_iter().map(|(i, j, search)| (i, j, search.found(minimum))).collect())
}

fn check(minimum: f64) -> Result<()> {
    finite("separation", "minimum", &[minimum])?;
    if minimum < 0.0 {
        return Err(Error::domain("separation: `minimum`", minimum, "at least 0"));
    }
    Ok(())
}

fn verdict(minimum: f64, at_least: f64, at_most: f64) -> Verdict {
    Verdict::proved(at_least >= minimum, at_most < minimum)
}

fn tolerance(a: &Motion, b: &Motion) -> f64 {
    TOLERANCE * a.extent().max(b.extent())
}

struct Search<'m> {
    a: &'m Motion,
    b: &'m Motion,
    /// Stretches of time, and whether halves would decide more.
    waiting: Queue<([f64; 2], bool)>,
    /// Least upper bound, when, and where both are then.
    best: (f64, f64, [[f64; 2]; 2]),
    /// A lower bound.
    at_least: f64,
}

impl Search<'_> {
    fn new<'m>(a: &'m Motion, b: &'m Motion) -> Search<'m> {
        let mut events = [a.times(), b.times()].concat();
        events.sort_by(f64::total_cmp);
        let mut search =
            Search { a, b, waiting: Queue::new(), best: (f64::INFINITY, events[0], [[0.0; 2]; 2]), at_least: 0.0 };
        // Where one starts or arrives the least separation often is. In between both keep standing or moving.
        for time in &events {
            search.look(*time);
        }
        for w in events.windows(2).filter(|w| w[0] < w[1]) {
            search.add(w[0], w[1]);
        }
        search
    }

    /// Halves stretches until lower and upper bound are `enough`, or as near as roundings allow; the number looked at,
    /// `most` at most.
    fn run(&mut self, most: usize, enough: impl Fn(f64, f64) -> bool) -> usize {
        for count in 0..most {
            step();
            let Some((bound, ([from, to], more))) = self.waiting.pop() else { return count };
            self.at_least = self.at_least.max(bound);
            let at_most = self.best.0;
            let middle = 0.5 * (from + to);
            let halved = more && from < middle && middle < to;
            if enough(self.at_least, at_most) || !halved {
                self.waiting.push(bound, ([from, to], more));
                return count + 1;
            }
            self.add(from, middle);
            self.add(middle, to);
        }
        most
    }

    /// What is known by now.
    fn found(&self, minimum: f64) -> Separation {
        let ((at_most, time, points), at_least) = (self.best, self.at_least);
        let verdict = verdict(minimum, at_least, at_most);
        Separation { verdict, closest: Closest { time, points, at_least, at_most } }
    }

    /// Both at a time; keeps the least separation.
    fn look(&mut self, time: f64) -> [State; 2] {
        let both = [self.a.state(time), self.b.state(time)];
        let apart = distance(both[0].point, both[1].point) + both[0].off + both[1].off;
        if apart < self.best.0 {
            self.best = (apart, time, [both[0].point, both[1].point]);
        }
        both
    }

    fn add(&mut self, from: f64, to: f64) {
        let middle = 0.5 * (from + to);
        let half = (middle - from).max(to - middle) * (1.0 + 4.0 * f64::EPSILON);
        let [a, b] = self.look(middle);
        let off = a.off + b.off;
        let r = [a.point[0] - b.point[0], a.point[1] - b.point[1]];
        let apart = r[0].hypot(r[1]);
        // What they cover until the end of the stretch.
        let (along_a, along_b) = (a.speed * half, b.speed * half);
        let v = [0, 1].map(|i| a.tangent[i] * along_a - b.tangent[i] * along_b);
        let by_speed = apart - (along_a + along_b);
        // No squares of a speed or a time: they may leave the range of doubles.
        let bend = |s: &State, along: f64| (0.5 * (s.curvature * along) + s.tangent_off) * along;
        let by_curvature = nearest(r, v) - bend(&a, along_a) - bend(&b, along_b);
        let drift = self.a.drift(self.b, [from, to]);
        let in_step = apart - drift - 2.0 * off;
        let bound = [by_curvature, in_step].into_iter().fold(by_speed, f64::max);
        // Where one covers less of the way to the other than points are off, there is no more to learn.
        let more = drift.min(along_a + along_b) > off;
        // Distances and bounds themselves round, by less than the roundings in `off`.
        self.waiting.push((bound - 2.0 * off).max(0.0), ([from, to], more));
    }
}

/// The least `|r + vτ|` for `|τ| <= 1`.
fn nearest(r: [f64; 2], v: [f64; 2]) -> f64 {
    let far = v[0].hypot(v[1]);
    if far == 0.0 {
        return r[0].hypot(r[1]);
    }
    let unit = v.map(|x| x / far);
    let along = (-(r[0] * unit[0] + r[1] * unit[1])).clamp(-far, far);
    (r[0] + unit[0] * along).hypot(r[1] + unit[1] * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{CubicBezier, PhQuintic};
    use crate::steps::counted;
    use crate::transition::{Arc, Cubic, Line, Piece};

    fn cubic(p: [[f64; 2]; 4]) -> Piece {
        let legs = std::array::from_fn(|i| [0, 1].map(|k| p[i + 1][k] - p[i][k]));
        Piece::Cubic(Cubic { points: CubicBezier { p }, legs })
    }

    /// Curves that coincide, touch, move in step or stand still, and a path of 20,000 pieces: a bounded number of
    /// stretches, and of steps of Newton's method in each of its two moments.
    #[test]
    fn every_question_ends() {
        let shape = |up: f64| cubic([[0.0, up], [1.0, up], [2.0, 1.0 + up], [3.0, 1.0 + up]]);
        let arc = |length: f64| Piece::Arc(Arc { start: [0.0; 2], start_direction: 0.0, curvature: 1.0, length });
        let line = |from: f64, to: f64| Piece::Line(Line { start: [from, 0.0], end: [to, 0.0] });
        let still = cubic([[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]);
        let many: Vec<Piece> = (0..20_000).map(|i| line(f64::from(i), f64::from(i + 1))).collect();
        let quintic: Piece = PhQuintic::new([0.0; 2], [[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]).into();
        let pairs = [
            (vec![shape(0.0)], vec![shape(0.0)]),
            (vec![shape(0.0)], vec![shape(1e-9)]),
            (vec![shape(0.0)], vec![shape(0.1)]),
            (vec![arc(1e6)], vec![arc(1e9)]),
            (vec![arc(3.0)], vec![line(-1.0, 1.0)]),
            (vec![still], vec![line(0.5, 2.0)]),
            (vec![quintic], vec![shape(0.0)]),
            (many.clone(), vec![line(2e4, 0.0)]),
            (many.clone(), many),
        ];
        for (one, two) in pairs {
            let [a, b] = [&one, &two].map(|pieces| Motion::new(pieces.iter().cloned(), 1.0, 0.0).unwrap());
            for minimum in [0.0, 1e-300, 1e-9, 0.1, 1e300] {
                let (steps, found) = counted(|| separation(&a, &b, minimum).unwrap());
                assert!(steps <= 13 * STRETCHES + 10_000, "{steps} {minimum:e} {found:?}");
                assert!(found.closest.at_least <= found.closest.at_most, "{found:?}");
            }
        }
    }

    /// A formation of 200: copies of one path of curves, lines and arcs, and others that only move as slowly as they
    /// do. Each pair of copies takes a few stretches, and all pairs together no more than is allowed after they are
    /// decided.
    #[test]
    fn formations_take_few_stretches() {
        let vehicle = |up: f64| {
            let curve = PhQuintic::new([0.0, up], [[1.0, 0.0], [1.0, 0.7], [0.5, 1.0]]);
            let end = curve.end;
            let line = Line { start: end, end: [end[0] - 0.6, end[1] + 0.8] };
            let direction = f64::atan2(0.8, -0.6);
            let arc = Arc { start: line.end, start_direction: direction, curvature: 0.3, length: 2.0 };
            Motion::new([curve.into(), Piece::Line(line), Piece::Arc(arc)], 1.0, 0.0).unwrap()
        };
        let motions: Vec<Motion> = (0..200).map(|i| vehicle(0.0131 * f64::from(i))).collect();
        let pairs = 199 * 100;
        for minimum in [0.01, 0.0131, 0.1] {
            let (steps, found) = counted(|| separations(&motions, minimum).unwrap());
            assert!(found.len() == pairs && steps < 4 * pairs, "{steps}");
            for (i, j, found) in found {
                let (apart, closest) = (0.0131 * (j - i) as f64, found.closest);
                assert!(
                    (closest.at_most - apart).abs() < 1e-9 && apart - closest.at_least < 1e-9,
                    "{i} {j}: {found:?}"
                );
                assert_eq!(found.verdict == Verdict::Yes, apart > 1.000001 * minimum, "{i} {j}: {found:?}");
            }
        }
        // On circles around one centre, as fast as they are wide.
        let circle = |i: i32| {
            let radius = 1.0 + 0.01 * f64::from(i);
            let arc = Arc {
                start: [radius, 0.0],
                start_direction: std::f64::consts::FRAC_PI_2,
                curvature: 1.0 / radius,
                length: radius,
            };
            Motion::new([Piece::Arc(arc)], radius, 0.0).unwrap()
        };
        let motions: Vec<Motion> = (0..30).map(circle).collect();
        let (steps, found) = counted(|| separations(&motions, 0.005).unwrap());
        assert!(found.iter().all(|(_, _, found)| found.verdict == Verdict::Yes), "{found:?}");
        assert!(steps < ALL_STRETCHES + 100 * found.len(), "{steps}");
        let [first, ..] = &found[..] else { panic!() };
        assert!(first.2.closest.at_most - first.2.closest.at_least < 1e-7, "{first:?}");
    }
}
