//! Pythagorean-hodograph quintics: the one type that every maker of them gives.
//!
//! With the pre-image `w = w0 (1-t)² + 2 w1 t(1-t) + w2 t²` of complex numbers the curve's derivative is `w²`, so its
//! speed `σ = |w|²`, its arc length, unit tangent, curvature and offsets are polynomials or quotients of them (Farouki
//! et al., (2)-(9)).

use super::extrema::sign_changes;
use super::hodograph::{Bound, Hodograph, complex};
use super::jet::{Jet, casteljau};
use super::length::parameter_of;
use crate::num::bernstein::halve;
use crate::num::{Ball, Interval, Real};
use num_complex::Complex64;

/// A Pythagorean-hodograph quintic for t in [0, 1], anywhere in the plane, in any unit of length.
///
/// A pre-image and its negative give the same curve: compare curves by control points. As JSON it is a
/// [`crate::transition::Piece`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhQuintic {
    /// The point at t = 0.
    pub start: [f64; 2],
    /// The point at t = 1: `start + ∫ w²`, to a few roundings.
    pub end: [f64; 2],
    /// Bernstein coefficients of w as (real, imaginary), in square roots of lengths.
    pub preimage: [[f64; 2]; 3],
}

impl PhQuintic {
    /// From where it starts and its pre-image.
    ///
    /// ```
    /// use spiral_atlas::curve::PhQuintic;
    /// let straight = PhQuintic::new([1.0, 2.0], [[2.0, 0.0]; 3]);
    /// assert_eq!((straight.end, straight.length(), straight.curvature(0.3)), ([5.0, 2.0], 4.0, 0.0));
    /// ```
    pub fn new(start: [f64; 2], preimage: [[f64; 2]; 3]) -> PhQuintic {
        let [w0, w1, w2] = complex(&preimage);
        // (5): the sum of all legs.
        let chord = (w0 * w0 + w0 * w1 + (2.0 * w1 * w1 + w0 * w2) / 3.0 + w1 * w2 + w2 * w2) / 5.0;
        PhQuintic { start, end: [start[0] + chord.re, start[1] + chord.im], preimage }
    }

    /// With both ends as given, exactly; `end - start` must be `∫ w²` to a few roundings.
    pub fn between(start: [f64; 2], end: [f64; 2], preimage: [[f64; 2]; 3]) -> PhQuintic {
        PhQuintic { start, end, preimage }
    }

    /// The straight line between two points, at constant speed.
    pub fn straight(start: [f64; 2], end: [f64; 2]) -> PhQuintic {
        let root = Complex64::new(end[0] - start[0], end[1] - start[1]).sqrt();
        PhQuintic::between(start, end, [[root.re, root.im]; 3])
    }

    /// Whether no number in it is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        let numbers = self.preimage.iter().flatten().chain(&self.start).chain(&self.end);
        numbers.chain(&self.speed_coefficients()).all(|x| x.is_finite())
    }

    /// Bézier control points: (5), from both ends, so that both are exact.
    pub fn control_points(&self) -> [[f64; 2]; 6] {
        let [w0, w1, w2] = complex(&self.preimage);
        let add = |p: [f64; 2], leg: Complex64, sign: f64| [p[0] + sign * 0.2 * leg.re, p[1] + sign * 0.2 * leg.im];
        let p1 = add(self.start, w0 * w0, 1.0);
        let p4 = add(self.end, w2 * w2, -1.0);
        [self.start, p1, add(p1, w0 * w1, 1.0), add(p4, w1 * w2, -1.0), p4, self.end]
    }

    /// The sides of the control polygon, each to a few ulp of itself: a fifth of the derivative's control points.
    pub fn legs(&self) -> [[f64; 2]; 5] {
        let [w0, w1, w2] = complex(&self.preimage);
        let middle = (w1 * w1 * 2.0 + w0 * w2) / 3.0;
        [w0 * w0, w0 * w1, middle, w1 * w2, w2 * w2].map(|leg| [0.2 * leg.re, 0.2 * leg.im])
    }

    /// The point at t; exact at 0 and 1.
    pub fn point(&self, t: f64) -> [f64; 2] {
        casteljau(&mut self.control_points(), t)
    }

    /// Point and derivatives at t; the derivatives come from the pre-image, so they do not suffer far from the origin.
    pub fn jet(&self, t: f64) -> Jet {
        let ([w, w1], w2) = (self.image(t), self.bend());
        let pair = |z: Complex64| [z.re, z.im];
        Jet {
            point: self.point(t),
            first: pair(w * w),
            second: pair(2.0 * w * w1),
            third: pair(2.0 * (w1 * w1 + w * w2)),
        }
    }

    /// Direction of travel at t as a vector of length 1; NaN where the speed is zero.
    pub fn tangent(&self, t: f64) -> [f64; 2] {
        let [w, _] = self.image(t);
        let unit = w / w.norm();
        let tangent = unit * unit;
        [tangent.re, tangent.im]
    }

    /// Parametric speed σ at t, length per unit of t.
    pub fn speed(&self, t: f64) -> f64 {
        self.image(t)[0].norm_sqr()
    }

    /// Bernstein coefficients of the speed σ: (6).
    pub fn speed_coefficients(&self) -> [f64; 5] {
        self.hodograph().speed_coefficients()
    }

    /// Bernstein coefficients of h, where the curvature is `h / σ²`: (14).
    pub fn turn_coefficients(&self) -> [f64; 3] {
        self.hodograph().turn
    }

    /// Bernstein coefficients of the arc length from the start: (8).
    pub fn length_coefficients(&self) -> [f64; 6] {
        let mut lengths = [0.0; 6];
        for (k, speed) in self.speed_coefficients().iter().enumerate() {
            lengths[k + 1] = lengths[k] + 0.2 * speed;
        }
        lengths
    }

    /// Arc length: (9).
    pub fn length(&self) -> f64 {
        0.2 * self.speed_coefficients().iter().sum::<f64>()
    }

    /// Arc length from the start to t.
    pub fn length_to(&self, t: f64) -> f64 {
        value(self.length_coefficients(), t)
    }

    /// Where the arc length from the start is `s`: the inverse of [`PhQuintic::length_to`], 0 below it and 1 above.
    ///
    /// # Accuracy
    /// The length at the result is `s` to a few roundings of the whole length. Newton's method, kept inside a bracket:
    /// where the curve stands still it becomes bisection.
    pub fn parameter_at(&self, s: f64) -> f64 {
        let lengths = self.length_coefficients();
        if s <= 0.0 || s >= lengths[5] {
            return if s > 0.0 { 1.0 } else { 0.0 };
        }
        parameter_of(|t| [value(lengths, t) - s, self.speed(t)], [0.0, 1.0], s / lengths[5], 0.0)
    }

    /// Signed curvature at t, positive to the left: (4); NaN where the speed is zero.
    pub fn curvature(&self, t: f64) -> f64 {
        let [w, slope] = self.image(t);
        let speed = w.norm();
        (2.0 * ((w / speed).conj() * (slope / speed)).im) / speed / speed
    }

    /// The parameters in (0, 1), increasing, where the curvature has an extremum: the sign changes of `σh' - 2hσ'`.
    ///
    /// # Accuracy
    /// As [`super::CubicBezier::curvature_extrema`].
    pub fn curvature_extrema(&self) -> Vec<f64> {
        sign_changes(&self.scaled().0.slopes())
    }

    /// Bernstein coefficients of `σh' - 2hσ'`, which has the sign of the curvature's slope, times 10.
    pub(crate) fn slopes(&self) -> [f64; 6] {
        self.hodograph().slopes()
    }

    /// The largest curvature by size, and where: `(t, |κ|)`. Infinite for a curve that stands still somewhere and is no
    /// straight line.
    ///
    /// # Accuracy
    /// A few roundings over the square root of the least speed's share of the length. A curve that is not
    /// [regular](PhQuintic::is_regular) counts as standing still, as its pre-image does not show how near it comes to
    /// that.
    pub fn greatest_curvature(&self) -> (f64, f64) {
        if !self.is_regular() {
            let size = if self.scaled().0.turn_coefficients() == [0.0; 3] { 0.0 } else { f64::INFINITY };
            return (self.least_speed().0, size);
        }
        let mut candidates = vec![0.0];
        bends(&self.scaled().0.hodograph(), [0.0, 1.0], &mut candidates);
        let sizes = candidates.into_iter().map(|t| (t, self.curvature(t).abs()));
        sizes.fold((0.0, 0.0), |best, next| if next.1 > best.1 || next.1.is_nan() { next } else { best })
    }

    /// The parameters in (0, 1), increasing, where the curvature changes its sign.
    pub fn inflections(&self) -> Vec<f64> {
        sign_changes(&self.scaled().0.turn_coefficients())
    }

    /// The least speed over [0, 1], and where: `(t, σ)`.
    pub fn least_speed(&self) -> (f64, f64) {
        let all = [0.0, 1.0].into_iter().chain(self.speed_extrema()).map(|t| (t, self.speed(t)));
        all.fold((0.0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
    }

    /// The parameters in (0, 1), increasing, where the speed has an extremum.
    pub(super) fn speed_extrema(&self) -> Vec<f64> {
        let s = self.speed_coefficients();
        sign_changes(&[0, 1, 2, 3].map(|i| s[i + 1] - s[i]))
    }

    /// Whether it stands still nowhere: its least speed is above 1e-12 of its mean speed.
    pub fn is_regular(&self) -> bool {
        self.least_speed().1 > 1e-12 * self.length()
    }

    /// How far the tangent turns from start to end, counted with sign and whole turns, radians.
    pub fn rotation(&self) -> f64 {
        turned(&self.roots(), 0.0, 1.0)
    }

    /// `∫|κ| ds`: how far the tangent turns, to either side, radians.
    ///
    /// # Accuracy
    /// A few roundings over the square root of the least speed's share of the length: so much does a rounding of the
    /// pre-image turn the tangent where the curve is slowest. Between inflections it is twice the sum of the angles
    /// under which the roots of w see the piece. A stationary point, a root on the piece itself, turns nothing.
    pub fn absolute_rotation(&self) -> f64 {
        let roots = self.roots();
        let mut ends = self.inflections();
        ends.insert(0, 0.0);
        ends.push(1.0);
        ends.windows(2).map(|w| turned(&roots, w[0], w[1]).abs()).sum()
    }

    /// An upper bound of |κ|, infinite where the curve nearly stands still: h and σ in Bernstein form on `2^halvings`
    /// pieces.
    ///
    /// # Accuracy
    /// Never below the truth. With w at most about 1, σ and h are computed to 2^-46; what is added to |h| exceeds that,
    /// and as pieces with σ below 1e-6 of its coefficients count as infinite, the last factor exceeds what it makes of
    /// σ².
    pub fn curvature_bound(&self, halvings: u32) -> f64 {
        let (unit, size) = self.scaled();
        let (speed, turn) = (unit.speed_coefficients(), unit.turn_coefficients());
        let floor = 1e-6 * speed.iter().fold(0.0, |most: f64, s| most.max(s.abs()));
        bound(&speed, &turn, floor, halvings) * (1.0 + 1e-7) / size
    }

    /// Whether |κ| stays below `most`, proved; false also where that is not.
    pub(crate) fn bends_less(&self, most: f64) -> bool {
        fn proved<N: Real>(preimage: [[f64; 2]; 3], most: f64, bits: usize) -> bool {
            let whole = Hodograph::new(preimage.map(|z| z.map(|x| N::of(x, bits))));
            matches!(whole.below(&N::of(most, bits), 0), Bound::Below)
        }
        proved::<Ball>(self.preimage, most, 53) || proved::<Interval>(self.preimage, most, 256)
    }

    /// Its speed and bend, apart from its place.
    fn hodograph(&self) -> Hodograph<f64> {
        Hodograph::new(self.preimage)
    }

    /// w and w' at t.
    fn image(&self, t: f64) -> [Complex64; 2] {
        let [w0, w1, w2] = complex(&self.preimage);
        let (a, b) = (w0 * (1.0 - t) + w1 * t, w1 * (1.0 - t) + w2 * t);
        [a * (1.0 - t) + b * t, 2.0 * ((w1 - w0) * (1.0 - t) + (w2 - w1) * t)]
    }

    /// w''.
    fn bend(&self) -> Complex64 {
        let [w0, w1, w2] = complex(&self.preimage);
        2.0 * ((w2 - w1) - (w1 - w0))
    }

    /// The same shape with coefficients of w near 1, and the power of two that lengths were divided by.
    pub(super) fn scaled(&self) -> (PhQuintic, f64) {
        let most = self.preimage.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        if !(most.is_finite() && most > 0.0) {
            return (*self, 1.0);
        }
        let root = most.log2().round().clamp(-500.0, 500.0).exp2();
        let preimage = self.preimage.map(|w| w.map(|x| x / root));
        (PhQuintic { preimage, ..*self }, root * root)
    }

    /// The roots of w that are finite.
    fn roots(&self) -> Vec<Complex64> {
        let [c, w1, w2] = complex(&self.scaled().0.preimage);
        let (a, b) = ((w2 - w1) - (w1 - c), w1 - c);
        let root = (b * b - a * c).sqrt();
        // The sum that does not cancel.
        let q = if (b.conj() * root).re < 0.0 { root - b } else { -(b + root) };
        let none = Complex64::new(0.0, 0.0);
        let other = if q == none { none } else { c / q };
        [q / a, if q == none && a == none { q / a } else { other }].into_iter().filter(|z| z.is_finite()).collect()
    }
}

/// Adds where the curvature may be greatest on this piece, between parameters of the whole: the extrema, and the end.
/// Close to where the speed is low the roundings of the whole would cover them, so there the pieces are small.
fn bends(piece: &Hodograph<f64>, [from, to]: [f64; 2], all: &mut Vec<f64>) {
    let speed = piece.speed_coefficients();
    let most = speed.iter().copied().fold(0.0, f64::max);
    if to - from > 1e-9 && speed.iter().any(|s| *s < 1e-2 * most) {
        let ([first, second], middle) = (piece.halves(), 0.5 * (from + to));
        bends(&first, [from, middle], all);
        return bends(&second, [middle, to], all);
    }
    all.extend(sign_changes(&piece.slopes()).into_iter().map(|t| from + t * (to - from)));
    all.push(to);
}

/// The value of a Bernstein form (de Casteljau).
pub(super) fn value(mut c: impl AsMut<[f64]>, t: f64) -> f64 {
    let c = c.as_mut();
    for last in (1..c.len()).rev() {
        for i in 0..last {
            c[i] = (1.0 - t) * c[i] + t * c[i + 1];
        }
    }
    c.first().copied().unwrap_or(0.0)
}

/// Twice the angles under which the roots see the way from `a` to `b`.
fn turned(roots: &[Complex64], a: f64, b: f64) -> f64 {
    // Of (b - z) conj(a - z), scaled so that the squares of large roots stay in range.
    let angle = |z: &Complex64| {
        let size = z.re.abs().max(z.im.abs()).max(1.0);
        let across = z.im / size;
        (across * ((b - a) / size)).atan2((b - z.re) / size * ((a - z.re) / size) + across * across)
    };
    2.0 * roots.iter().filter(|z| z.im != 0.0).map(angle).sum::<f64>()
}

/// The largest of `|h|/σ²` over pieces, from the largest |h| and the least σ among the coefficients of each.
fn bound(speed: &[f64; 5], turn: &[f64; 3], floor: f64, halvings: u32) -> f64 {
    if halvings == 0 {
        let least = speed.iter().copied().fold(f64::INFINITY, f64::min);
        let most = turn.iter().fold(0.0f64, |most, h| most.max(h.abs()));
        return if least > floor { (most + 1e-12) / (least * least) } else { f64::INFINITY };
    }
    let ((s0, s1), (h0, h1)) = (halve(speed), halve(turn));
    bound(&s0, &h0, floor, halvings - 1).max(bound(&s1, &h1, floor, halvings - 1))
}
