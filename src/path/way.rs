//! Where a vehicle is on a piece of its path once it has covered a length, with bounds of the errors.
//!
//! Quintics with a Pythagorean hodograph, lines and arcs have formulas. Clothoids have as parameter their length, and
//! their points are known to far less than roundings (`transition/clothoid.rs`). The length of a cubic or a
//! trigonometric quintic is integrated by the 16-point Gauss-Legendre rule on cells where its error is proved. Let `x'
//! ± iy'` differ by at most a quarter of `|r'|` from their values at the middle of a cell of half-width h, in the
//! complex disc of radius `17/8 h`. They are the factors of `|r'|²` and have no root there. So the speed is analytic in
//! the ellipse of the foci -h, h and the sum 4h of its half-axes, which lies in the disc, and at most 5/4 of that in
//! the middle. The rule then errs by less than `h 64/15 5/4 |r'| 4^-32 / (1 - 1/16)`, and the cell is at least `2h 3/4
//! |r'|` long. So the error is below 4e-19 of the cell's length: Trefethen, Approximation Theory, theorem 19.3. The
//! same holds for a part of a cell, whose disc lies in that of the cell.
//!
//! Roundings: r' has at most 30 of them (of 2^-53, in units of the bound [`Bezier::size`]) for a cubic and 70 for a
//! trigonometric quintic, whose basis is a product of up to six factors, sines and cosines among them. A parameter is
//! rounded twice, and r'' is below 8 of those units. The weighted sum of 16 values has 20. These are 106 at most, less
//! than the 128 of [`ROUNDINGS`].
//!
//! A point is off by no more than its length is, since a chord is no longer than its arc.

use super::{ROUNDINGS, distance, mismatch};
use crate::curve::vector::{cross, length, sub};
use crate::curve::{Jet, PhQuintic, gauss};
use crate::error::{Error, OTHER_UNIT, Result};
use crate::steps::step;
use crate::transition::{Arc, Clothoid, Cubic, Piece, TrigPart};
use std::f64::consts::FRAC_PI_2;

/// The greatest half-axis of the ellipse in half-widths.
const REACH: f64 = 17.0 / 8.0;
/// Cells are no smaller than this share of the parameters; beside a standstill they halve up to there.
const SMALLEST: f64 = 1e-18;
/// Derivatives above the first are known to this share of the largest first one that the polygon allows, far above
/// their roundings.
const BLUR: f64 = 1e-10;
/// Steps of Newton's method; what they miss is reported.
const NEWTON: usize = 3;
/// Lengths and coordinates in which neither squares nor the tiny shares above leave the range of doubles.
const RANGE: [f64; 2] = [1e-140, 1e140];

/// A piece, and what is proved of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way {
    curve: Curve,
    /// Its length.
    pub length: f64,
    /// By how much that, and any length along it, may be wrong.
    pub length_off: f64,
    /// By how much its points may be wrong where lengths are right, and jump.
    pub mismatch: f64,
    /// By how much unit tangents may be wrong.
    pub direction_off: f64,
    /// No curvature is above this.
    pub curvature: f64,
    /// Bounds of its coordinates, and of what its length is computed from.
    pub sizes: [f64; 2],
}

#[derive(Debug, Clone, PartialEq)]
enum Curve {
    Quintic(PhQuintic),
    Arc(Arc),
    Clothoid(Clothoid),
    Integrated(Bezier, Vec<Cell>),
}

/// Curves without a formula of their length.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bezier {
    Cubic(Cubic),
    Trig(TrigPart),
}

/// A part of the parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    from: f64,
    to: f64,
    /// Length up to its start.
    before: f64,
    /// Bound of the length of a part so small, or so slow, that nothing else is known of it.
    blind: Option<f64>,
}

/// Where one is after a length.
pub(super) struct Reached {
    pub point: [f64; 2],
    /// The unit tangent; not finite at a standstill.
    pub tangent: [f64; 2],
    /// How far along the curve the place of that length may be.
    pub missed: f64,
}

impl Way {
    /// # Errors
    /// [`Error::Domain`] for an involute, whose points have no proved error, and for lengths and coordinates beyond
    /// [`RANGE`], or not finite.
    pub(super) fn new(piece: &Piece) -> Result<Way> {
        let way = match piece {
            Piece::PhQuintic(curve) => Way::quintic(*curve),
            Piece::Line(line) => Way::quintic(PhQuintic::straight(line.start, line.end)),
            Piece::Arc(arc) => Way::round(Curve::Arc(*arc), arc.start, arc.start_direction, arc.curvature, arc.length),
            Piece::Clothoid(c) => {
                Way::round(Curve::Clothoid(*c), c.start, c.start_direction, c.greatest_curvature(), c.length)
            }
            Piece::Cubic(cubic) => Way::integrated(Bezier::Cubic(*cubic)),
            Piece::TrigQuintic(part) => Way::integrated(Bezier::Trig(*part)),
            Piece::Involute(_) => {
                return Err(Error::invalid(format!(
                    "is of the kind `{}`, whose points have no proved error; separation takes all other kinds. Take \
                     points of the path with `path measure --samples`, and lay a path through them with `path spline`",
                    piece.kind().name()
                )));
            }
        };
        let [shortest, most] = RANGE;
        let size = way.sizes[0].max(way.sizes[1]);
        if way.length >= shortest && size <= most && way.mismatch.is_finite() {
            return Ok(way);
        }
        Err(Error::invalid(format!(
            "is {:?} long, and its numbers go up to {size:?}; separation takes lengths from {shortest:e} and numbers \
             up to {most:e}: leave out a piece of no length, or {OTHER_UNIT}",
            piece.length()
        )))
    }

    fn quintic(curve: PhQuintic) -> Way {
        let far = largest(&curve.control_points());
        // Coefficients of lengths are at most the sum of |w|², and so are legs.
        let legs = curve.preimage.iter().flatten().map(|x| x * x).sum::<f64>();
        // The direction is that of w², and w is off by a few roundings of its largest coefficient. Its least square is
        // no less than the least coefficient of the speed. Where that says nothing, the curvature is infinite or the
        // speed 1e-6 of its largest coefficient, which is above 1/27 of the legs: coefficients of a quadratic are at
        // most three times its greatest value.
        let least = curve.speed_coefficients().iter().fold(f64::INFINITY, |least, s| s.min(least));
        let steep = if least > 0.0 { (legs / least).sqrt().min(6e3) } else { 6e3 };
        Way {
            curve: Curve::Quintic(curve),
            length: curve.length(),
            length_off: 0.0,
            mismatch: mismatch(&curve),
            direction_off: ROUNDINGS * steep,
            curvature: curve.curvature_bound(5),
            sizes: [far, legs],
        }
    }

    /// An arc or a clothoid. Its angles, and with them its points, err by roundings of the largest angle.
    fn round(curve: Curve, start: [f64; 2], direction: f64, curvature: f64, length: f64) -> Way {
        let direction_off = ROUNDINGS * (1.0 + direction.abs() + (curvature * length).abs());
        Way {
            curve,
            length,
            length_off: 0.0,
            mismatch: direction_off * length,
            direction_off,
            curvature: curvature.abs() * (1.0 + ROUNDINGS),
            sizes: [largest(&[start]) + length, length],
        }
    }

    fn integrated(curve: Bezier) -> Way {
        let (size, mismatch) = (curve.size(), curve.mismatch());
        let [start, end] = curve.range();
        // What is so large or small that its bounds leave the range of doubles is not cut: it is as long as nothing,
        // and refused.
        let fits = (RANGE[0]..=RANGE[1]).contains(&size);
        let (mut cells, mut waiting) = (vec![], if fits { vec![[start, end]] } else { vec![] });
        let (mut before, mut blind_length) = (0.0, 0.0);
        let (mut direction_off, mut curvature): (f64, f64) = (0.0, 0.0);
        while let Some([from, to]) = waiting.pop() {
            step();
            let middle = 0.5 * (from + to);
            // The middle is rounded.
            let known = curve.around(middle, 0.5 * (to - from) + f64::EPSILON * to);
            let longest = (to - from) * known.fastest;
            let small = to - from <= SMALLEST * (end - start) || middle <= from || middle >= to;
            let blind = small || longest <= 0.01 * f64::EPSILON * size;
            if !known.analytic && !blind {
                waiting.extend([[middle, to], [from, middle]]);
                continue;
            }
            cells.push(Cell { from, to, before, blind: (!known.analytic).then_some(longest) });
            if known.analytic {
                before += curve.between(from, to);
                direction_off = direction_off.max((ROUNDINGS * size + 3.0 * mismatch) / known.slowest);
                curvature = curvature.max(known.curvature);
            } else {
                before += 0.5 * longest;
                blind_length += longest;
                curvature = f64::INFINITY;
            }
        }
        // A curve of other legs is longer or shorter by no more than these differ. Lengths of cells are added one by
        // one.
        let length_off = blind_length + mismatch + ROUNDINGS * size + f64::EPSILON * cells.len() as f64 * before;
        let sizes = [largest(&curve.points()), size];
        Way {
            curve: Curve::Integrated(curve, cells),
            length: before,
            length_off,
            mismatch,
            direction_off,
            curvature,
            sizes,
        }
    }

    /// By how much two points after the same length on both, less those at the starts, differ at most; and so both
    /// lengths. Infinite where kinds differ, or numbers that it cannot tell from.
    ///
    /// Derivatives differ by no more than `|w² - v²| <= |w - v| (|w| + |v|)`, or three times a difference of legs; so
    /// do speeds, and then points after the same length by twice that.
    pub(super) fn unlike(&self, other: &Way) -> f64 {
        let most = |v: &[[f64; 2]]| v.iter().map(|x| length(*x)).fold(0.0, f64::max);
        let apart = |v: &[[f64; 2]], w: &[[f64; 2]]| v.iter().zip(w).map(|(v, w)| distance(*v, *w)).fold(0.0, f64::max);
        let equal = |same: bool| if same { 0.0 } else { f64::INFINITY };
        let derivatives = match (&self.curve, &other.curve) {
            (Curve::Quintic(a), Curve::Quintic(b)) => {
                apart(&a.preimage, &b.preimage) * (most(&a.preimage) + most(&b.preimage))
            }
            (Curve::Arc(a), Curve::Arc(b)) => equal(Arc { start: b.start, ..*a } == *b),
            (Curve::Clothoid(a), Curve::Clothoid(b)) => equal(Clothoid { start: b.start, ..*a } == *b),
            (Curve::Integrated(Bezier::Cubic(a), _), Curve::Integrated(Bezier::Cubic(b), _)) => {
                3.0 * apart(&a.legs, &b.legs)
            }
            (Curve::Integrated(Bezier::Trig(a), _), Curve::Integrated(Bezier::Trig(b), _)) => {
                let [c, d] = [&a.curve, &b.curve];
                equal((c.sides, c.p, c.q, a.from, a.to) == (d.sides, d.p, d.q, b.from, b.to))
            }
            _ => f64::INFINITY,
        };
        2.0 * derivatives * (1.0 + ROUNDINGS)
    }

    /// Where one is after a length.
    pub(super) fn after(&self, local: f64) -> Reached {
        match &self.curve {
            Curve::Quintic(curve) => {
                let t = curve.parameter_at(local);
                let missed = (curve.length_to(t) - local.min(self.length)).abs();
                Reached { point: curve.point(t), tangent: curve.tangent(t), missed }
            }
            Curve::Arc(arc) => at_share(&Piece::Arc(*arc), local / arc.length),
            Curve::Clothoid(clothoid) => at_share(&Piece::Clothoid(*clothoid), local / clothoid.length),
            Curve::Integrated(curve, cells) => integrated_to(curve, cells, self.length, local.clamp(0.0, self.length)),
        }
    }
}

/// After a share of the length that is the parameter.
fn at_share(piece: &Piece, share: f64) -> Reached {
    let at = piece.at(share.clamp(0.0, 1.0));
    let (sine, cosine) = at.heading.sin_cos();
    Reached { point: at.point, tangent: [cosine, sine], missed: 0.0 }
}

fn integrated_to(curve: &Bezier, cells: &[Cell], whole: f64, local: f64) -> Reached {
    let i = cells.partition_point(|cell| cell.before <= local).clamp(1, cells.len()) - 1;
    let Cell { from, to, before, blind } = cells[i];
    let after = cells.get(i + 1).map_or(whole, |next| next.before);
    let share = if after > before { (local - before) / (after - before) } else { 0.0 };
    let (mut t, mut missed) = (from + share * (to - from), blind.unwrap_or(0.0));
    if blind.is_none() {
        let over = |t: f64| before + curve.between(from, t) - local;
        missed = over(t);
        for _ in 0..NEWTON {
            if missed.abs() <= 4.0 * f64::EPSILON * whole {
                break;
            }
            step();
            t = (t - missed / curve.speed(t)).clamp(from, to);
            missed = over(t);
        }
    }
    let Jet { first, .. } = curve.jet(t);
    let speed = length(first);
    Reached { point: curve.point(t), tangent: first.map(|x| x / speed), missed: missed.abs() }
}

/// What is known of a curve around a parameter.
struct Around {
    /// Whether the speed is analytic as far as the rule needs.
    analytic: bool,
    slowest: f64,
    fastest: f64,
    curvature: f64,
}

impl Bezier {
    fn range(&self) -> [f64; 2] {
        match self {
            Bezier::Cubic(_) => [0.0, 1.0],
            Bezier::Trig(part) => [part.from, part.to],
        }
    }

    fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Bezier::Cubic(cubic) => cubic.points.p.to_vec(),
            Bezier::Trig(part) => part.curve.points().to_vec(),
        }
    }

    fn point(&self, t: f64) -> [f64; 2] {
        self.jet(t).point
    }

    fn jet(&self, t: f64) -> Jet {
        match self {
            Bezier::Cubic(cubic) => cubic.jet(t),
            Bezier::Trig(part) => part.curve.jet(t),
        }
    }

    fn speed(&self, t: f64) -> f64 {
        match self {
            Bezier::Cubic(cubic) => cubic.jet(t).speed(),
            Bezier::Trig(part) => part.curve.speed(t),
        }
    }

    /// A bound of |r'|: three times the legs of a cubic. The derivatives by the angle of what a trigonometric quintic
    /// multiplies its sides with are at most `4 + 6 |p|`, so 28.
    fn size(&self) -> f64 {
        match self {
            Bezier::Cubic(cubic) => 3.0 * cubic.legs.iter().map(|leg| length(*leg)).sum::<f64>(),
            Bezier::Trig(part) => 28.0 * FRAC_PI_2 * part.curve.sides.iter().map(|side| length(*side)).sum::<f64>(),
        }
    }

    /// How far the curve of the legs is from points that are computed: those of the control points, or roundings of a
    /// sum of sides.
    fn mismatch(&self) -> f64 {
        match self {
            Bezier::Cubic(Cubic { points, legs }) => {
                legs.iter().zip(points.p.windows(2)).map(|(leg, w)| distance(*leg, sub(w[1], w[0]))).sum()
            }
            Bezier::Trig(_) => ROUNDINGS * self.size(),
        }
    }

    /// A bound of the fourth derivative for complex parameters this far from real ones.
    ///
    /// Sides are multiplied with trigonometric polynomials of degree 5 and, but for constants, of sizes up to 16 (1 +
    /// |p|), 32, 192, 32 and 16 (1 + |q|). Bernstein's inequality: the fourth derivative of one of size M is at most
    /// `5⁴ M exp(5 |Im φ|)`, with φ = πt/2.
    fn fourth(&self, far: f64) -> f64 {
        let Bezier::Trig(TrigPart { curve, .. }) = self else { return 0.0 };
        let sizes = [16.0 * (1.0 + curve.p.abs()), 32.0, 192.0, 32.0, 16.0 * (1.0 + curve.q.abs())];
        let all: f64 = curve.sides.iter().zip(sizes).map(|(side, size)| length(*side) * size).sum();
        625.0 * FRAC_PI_2.powi(4) * (5.0 * FRAC_PI_2 * far).exp() * all
    }

    /// Bounds within `half` of a parameter, by Taylor's formula.
    fn around(&self, t: f64, half: f64) -> Around {
        let (jet, size) = (self.jet(t), self.size());
        let fourth = self.fourth(REACH * half);
        let first = jet.speed();
        let [second, third] = [jet.second, jet.third].map(|v| length(v) + BLUR * size);
        let change = |far: f64| far * (second + far * (0.5 * third + far * fourth / 6.0));
        let sure = first - ROUNDINGS * size;
        let slowest = sure - change(half);
        let fastest = first + ROUNDINGS * size + change(half);
        // The slope of the product r' × r'' is that of r' and the third derivative. Divided by the least speed first,
        // nothing leaves the range of doubles.
        let over = |v: [f64; 2]| v.map(|x| x / slowest);
        let turn = cross(over(jet.first), over(jet.second)).abs()
            + (fastest / slowest) * (BLUR * size / slowest)
            + (ROUNDINGS * size / slowest) * (second / slowest)
            + half * (fastest / slowest) * ((third + half * fourth) / slowest);
        let curvature = turn / slowest * (1.0 + ROUNDINGS);
        let analytic = change(REACH * half) <= 0.25 * sure && curvature.is_finite();
        Around { analytic, slowest, fastest, curvature }
    }

    /// Length between parameters within one cell. A part of a cell lies in its disc, with its own.
    fn between(&self, from: f64, to: f64) -> f64 {
        gauss(|t| [self.speed(t)], from, to)[0]
    }
}

/// Infinite where a number is not finite.
fn largest(points: &[[f64; 2]]) -> f64 {
    points.iter().flatten().fold(0.0, |far, x| if x.is_finite() { x.abs().max(far) } else { f64::INFINITY })
}

#[cfg(test)]
mod tests;
