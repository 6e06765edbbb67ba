//! The clearance of a path from obstacles, whoever made it.

use super::obstacles::{Obstacles, between, to_segment};
use crate::curve::PhQuintic;
use crate::path::{ROUNDINGS, mismatch};
use crate::queue::Queue;

/// Pieces at most.
const PIECES: usize = 200_000;

/// How near a path comes to obstacles, sides and inside.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Clearance {
    /// No point of the path is nearer than this: proved.
    pub at_least: f64,
    /// Some point is no further than this: proved.
    pub at_most: f64,
    /// That point, about.
    pub point: [f64; 2],
    /// The obstacle that is near there.
    pub obstacle: usize,
}

/// A piece of a span.
struct Piece {
    span: usize,
    from: f64,
    to: f64,
}

/// What is known of a span before it is cut.
struct Span {
    curve: PhQuintic,
    /// Bound of |r''|.
    bend: f64,
    /// Bound of the errors of its points and of their distances.
    slack: f64,
}

impl Span {
    fn new(curve: &PhQuintic, size: f64) -> Span {
        let w = curve.preimage;
        let most = |lengths: &[f64]| lengths.iter().fold(0.0, |most: f64, x| most.max(*x));
        let far = w.map(|w| w[0].hypot(w[1]));
        let steps = [0, 1].map(|i| (w[i + 1][0] - w[i][0]).hypot(w[i + 1][1] - w[i][1]));
        let ends = curve.start.iter().chain(&curve.end).fold(size, |most, x| most.max(x.abs()));
        let legs = w.as_flattened().iter().map(|x| x * x).sum::<f64>();
        // r'' = 2ww', and w' is twice a difference of coefficients.
        let bend = 4.0 * most(&far) * most(&steps) * (1.0 + 1e-12);
        Span { curve: *curve, bend, slack: mismatch(curve) + ROUNDINGS * (ends + legs) }
    }
}

struct Search<'o> {
    spans: Vec<Span>,
    obstacles: &'o Obstacles,
    /// By the lower bounds of their distances.
    waiting: Queue<Piece>,
    best: Clearance,
}

/// Encloses the least distance of spans from the sides of obstacles, until it is known to be at least `wanted` and
/// above 0, or not to be, and, where it is, to a tolerance. `None` without obstacles.
///
/// A piece is no further than `|r''| Δt²/8` from its chord. Errors of points and distances, the roundings of both, are
/// taken off twice.
pub(super) fn clearance(spans: &[PhQuintic], obstacles: &Obstacles, wanted: f64, tolerance: f64) -> Option<Clearance> {
    let wanted = wanted.max(f64::MIN_POSITIVE);
    let spans: Vec<Span> = spans.iter().map(|curve| Span::new(curve, obstacles.size)).collect();
    let count = spans.len();
    let best = Clearance { at_least: 0.0, at_most: f64::INFINITY, point: [0.0; 2], obstacle: 0 };
    let mut search = Search { spans, obstacles, waiting: Queue::new(), best };
    for span in 0..count {
        [0.0, 0.5, 1.0].into_iter().for_each(|t| search.look(span, t));
    }
    (search.best.at_most < f64::INFINITY).then_some(())?;
    (0..count).for_each(|span| search.add(span, 0.0, 1.0));
    for _ in 0..PIECES {
        let Some((bound, piece)) = search.waiting.pop() else { break };
        search.best.at_least = bound;
        let Clearance { at_least, at_most, .. } = search.best;
        let middle = 0.5 * (piece.from + piece.to);
        let fine = at_least >= wanted && at_most - at_least <= tolerance;
        // Between both bounds there is nothing more to be found than the errors.
        let spent = at_most - at_least <= 8.0 * search.spans[piece.span].slack || piece.to - piece.from < 1e-9;
        if fine || at_most < wanted || spent {
            break;
        }
        search.look(piece.span, middle);
        search.add(piece.span, piece.from, middle);
        search.add(piece.span, middle, piece.to);
    }
    Some(search.best)
}

impl Search<'_> {
    /// Keeps the least distance at a point.
    fn look(&mut self, span: usize, t: f64) {
        let Span { curve, slack, .. } = &self.spans[span];
        let point = curve.point(t);
        let Some(side) = self.obstacles.nearest(point) else { return };
        let at_most = to_segment(point, side.ends) + slack;
        if at_most < self.best.at_most {
            self.best = Clearance { at_most, point, obstacle: side.obstacle, ..self.best };
        }
    }

    fn add(&mut self, span: usize, from: f64, to: f64) {
        let Span { curve, bend, slack } = &self.spans[span];
        let chord = [curve.point(from), curve.point(to)];
        let bend = bend * (to - from) * (to - from) * 0.125;
        // Sides further off cannot be the nearest to any point.
        let within = self.best.at_most + bend;
        let near = self.obstacles.near(chord, within).map(|side| between(chord, side.ends));
        let bound = (near.fold(within, f64::min) - bend - 2.0 * slack).max(0.0);
        self.waiting.push(bound, Piece { span, from, to });
    }
}
