//! The length along a half of the curve, tabulated once.

use super::half::Half;
use crate::curve::vector::length;
use crate::curve::{gauss, parameter_of};

/// A half in pieces on each of which one Gauss-Legendre rule gives the length.
///
/// The speed may have a peak at the end, far narrower than the half is long: over `y = ln(1 + w)` its width is about 1.
/// Inside it may have one more, where the curve goes far away, and there its width is bounded below by the rounding of
/// the parameter. So pieces of one and a half units of y, and of at most as much of v, are halved until halves agree
/// with the whole to 1e-15 of the length or to the rounding of the speed: about 50 times next to a peak, and nowhere
/// else. Their number is bounded by the digits of the data and by the turns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    pub half: Half,
    /// The length of its `grow`.
    grown: f64,
    /// y and the length from the half's end, from [0, 0] on.
    knots: Vec<[f64; 2]>,
}

/// A half of a piece may differ by this share of the length.
const TOLERANCE: f64 = 1e-15;

/// A piece at first, in units of y and of v.
const PIECE: f64 = 1.5;

/// Halvings at most: then a piece is a rounding wide.
const DEPTH: u32 = 54;

impl Track {
    pub(super) fn new(half: Half) -> Track {
        let last = half.stretched(1.0);
        // v by w.
        let unit = half.theta / half.reach;
        let mut ends = vec![0.0];
        let mut here = 0.0f64;
        while here < last {
            // A unit of y is as many units of v as v is, and s.
            let v = unit * here.exp();
            here = (here + PIECE.min((PIECE / v).ln_1p())).min(last);
            ends.push(here);
        }
        let mut track = Track { half, grown: length(half.grow), knots: vec![[0.0, 0.0]] };
        let wholes: Vec<_> = ends.windows(2).map(|w| track.between(w[0], w[1])).collect();
        let tolerance = TOLERANCE * wholes.iter().map(|x| x[0]).sum::<f64>();
        for (ends, whole) in ends.windows(2).zip(wholes) {
            track.refine(ends[0], ends[1], whole, tolerance, DEPTH);
        }
        track
    }

    fn refine(&mut self, from: f64, to: f64, whole: [f64; 2], tolerance: f64, depth: u32) {
        let middle = 0.5 * (from + to);
        let (left, right) = (self.between(from, middle), self.between(middle, to));
        let noise = left[1] + right[1];
        // Written so that NaN stops at once.
        let differs = (left[0] + right[0] - whole[0]).abs() > tolerance + noise;
        if depth > 0 && differs {
            self.refine(from, middle, left, tolerance, depth - 1);
            self.refine(middle, to, right, tolerance, depth - 1);
            return;
        }
        for (to, [length, _]) in [(middle, left), (to, right)] {
            self.knots.push([to, self.length() + length]);
        }
    }

    fn speed(&self, y: f64) -> [f64; 2] {
        self.half.speed(self.half.share(y), self.grown)
    }

    /// Length from y to y, and its rounding.
    fn between(&self, from: f64, to: f64) -> [f64; 2] {
        gauss(|y| self.speed(y), from, to)
    }

    /// The whole half's length.
    pub(super) fn length(&self) -> f64 {
        self.knots[self.knots.len() - 1][1]
    }

    /// How many pieces there are.
    pub(super) fn pieces(&self) -> usize {
        self.knots.len() - 1
    }

    /// Length from the half's end to `u`.
    pub(super) fn to(&self, u: f64) -> f64 {
        let y = self.half.stretched(u);
        let [from, before] = self.knots[self.knots.partition_point(|k| k[0] <= y) - 1];
        before + self.between(from, y)[0]
    }

    /// u at a length from the half's end: Newton's method on its piece, and halving where that leaves the bracket.
    pub(super) fn at(&self, length: f64) -> f64 {
        if length <= 0.0 {
            return 0.0;
        }
        let next = self.knots.partition_point(|k| k[1] < length).clamp(1, self.pieces());
        let ([start, before], [end, after]) = (self.knots[next - 1], self.knots[next]);
        let guess = start + (end - start) * ((length - before) / (after - before)).clamp(0.0, 1.0);
        let at = |y: f64| [before + self.between(start, y)[0] - length, self.speed(y)[0]];
        self.half.share(parameter_of(at, [start, end], guess, 0.0))
    }
}
