//! From user data anywhere in the plane to the normalised frame, and back.

use super::turn::Turn;
use crate::curve::CubicBezier;
use crate::curve::PhQuintic;
use crate::curve::hodograph::complex;
use crate::curve::vector::{Vector, add, length, scale, sub, turn};
use crate::error::{Error, OTHER_UNIT, Result, finite};
use crate::family::any_spiral;
use crate::family::cubic::Datum;
use num_complex::Complex64;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// `2π` less its double.
const TAU_LOW: f64 = 2.4492935982947064e-16;

/// How far rounding may move a half turn against the chord: direction, chord and wrapping by an ulp of π
/// each, and the chord by the rounding of
/// its coordinates, an ulp of 1.
const HALF_TURN_ROUNDING: f64 = 7.0 * f64::EPSILON;

/// What a transition curve must join: points, directions of travel and signed curvatures, in the user's units and axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ends {
    /// Where the curve starts.
    pub start: [f64; 2],
    /// Where it ends.
    pub end: [f64; 2],
    /// Direction of travel at the start: counter-clockwise angle from the x axis, radians. See [`direction_of`].
    pub start_direction: f64,
    /// Direction of travel at the end.
    pub end_direction: f64,
    /// Curvature at the start, 1 / length, positive where the curve turns left (counter-clockwise).
    pub start_curvature: f64,
    /// Curvature at the end.
    pub end_curvature: f64,
}

/// The angle of a direction given as a vector of any length, radians, in [-π, π].
///
/// # Errors
/// [`Error::Domain`] for a zero or non-finite vector.
pub fn direction_of(vector: [f64; 2]) -> Result<f64> {
    let [x, y] = vector;
    if !(x.is_finite() && y.is_finite()) || (x == 0.0 && y == 0.0) {
        return Err(Error::invalid(format!(
            "direction vector ({x:?}, {y:?}) has no direction; it must be finite and not zero (or give an angle)"
        )));
    }
    Ok(y.atan2(x))
}

impl Ends {
    fn check_finite(&self) -> Result<()> {
        let values = [
            ("start x", self.start[0]),
            ("start y", self.start[1]),
            ("end x", self.end[0]),
            ("end y", self.end[1]),
            ("start direction", self.start_direction),
            ("end direction", self.end_direction),
            ("start curvature", self.start_curvature),
            ("end curvature", self.end_curvature),
        ];
        values.into_iter().try_for_each(|(name, value)| finite(name, value).map(drop))
    }

    /// The ends seen from their chord, and half the chord as a vector. A half turn is [`PI`], and stands for both
    /// signs.
    pub(super) fn chord(&self) -> Result<(any_spiral::Datum, Vector)> {
        self.check_finite()?;
        let (half, size) = self.half_chord()?;
        let chord = half[1].atan2(half[0]);
        let (alpha, beta) = (against(self.start_direction, chord), against(self.end_direction, chord));
        let k1 = by_chord("start", self.start_curvature, size)?;
        let k2 = by_chord("end", self.end_curvature, size)?;
        Ok((any_spiral::Datum { alpha, beta, k1, k2 }, half))
    }

    /// Half the chord as a vector, and its length.
    fn half_chord(&self) -> Result<(Vector, f64)> {
        let ([ax, ay], [bx, by]) = (self.start, self.end);
        if self.start == self.end {
            return Err(Error::invalid(format!(
                "start and end are both ({ax:?}, {ay:?}); a transition needs two different points"
            )));
        }
        // Halved after the difference, which is exact for neighbours.
        let half = scale(sub(self.end, self.start), 0.5);
        let size = length(half);
        if !size.is_normal() {
            let what = format!("the length of half the chord from ({ax:?}, {ay:?}) to ({bx:?}, {by:?})");
            return Err(Error::domain(what, size, "2.3e-308 to 1.7e308").or(OTHER_UNIT));
        }
        Ok((half, size))
    }
}

/// How the normalised frame lies in the user's: `z -> (start + end)/2 + half_chord * z` in complex numbers, after
/// conjugating z if `mirrored`; `start` and `end` are the images of -1 and 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Placement {
    /// Image of the normalised start (-1, 0): the user's start, or the user's end if `reversed`.
    pub start: [f64; 2],
    /// Image of the normalised end (1, 0).
    pub end: [f64; 2],
    /// `(end - start) / 2`, the complex factor of the similarity; its length is the normalised frame's unit.
    pub half_chord: [f64; 2],
    /// Whether left turns of the normalised frame are right turns of the user's, both in the normalised direction of
    /// travel.
    pub mirrored: bool,
    /// Whether the user travels from the normalised end to the normalised start.
    pub reversed: bool,
}

impl Placement {
    /// Normalises user data: half the chord becomes 1, the curve turns left, and its curvature increases.
    ///
    /// With `α`, `β` the angles of the end directions against the chord (positive to the left of it) and curvatures
    /// times half the chord:
    ///
    /// | the curve | φ0 | φ1 | κ0 | κ1 | mirrored | reversed |
    /// | --- | --- | --- | --- | --- | --- | --- |
    /// | turns left ever more sharply | -α | β | κs | κe | no | no |
    /// | turns right ever more sharply | α | -β | -κs | -κe | yes | no |
    /// | turns left ever less sharply | β | -α | κe | κs | yes | yes |
    /// | turns right ever less sharply | -β | α | -κe | -κs | no | yes |
    ///
    /// (Running a curve backwards swaps its ends, turns directions and chord by π and negates curvatures.) The side is
    /// read off the directions; where they lie on one side of the chord, off the curvatures. Data of no C-shaped curve
    /// get a datum too, with a negative angle or curvature: what is wrong with it is [`crate::transition::Why`].
    ///
    /// # Accuracy
    /// Angles within 2e-15 radians absolutely, curvatures 3 ulp, beyond the rounding of the data themselves.
    ///
    /// # Errors
    /// [`Error::Domain`] naming the value: not finite; coincident points; half chord or a curvature times it
    /// outside the range of normal doubles.
    pub fn normalise(ends: &Ends) -> Result<(Datum, Placement)> {
        let (any_spiral::Datum { alpha, beta, k1: at_start, k2: at_end }, half) = ends.chord()?;

        let (alpha, beta) = half_turns_to_their_side(alpha, beta, at_start + at_end >= 0.0);
        let (sides_of_left, sides_of_right) = (alpha < 0.0 && beta > 0.0, alpha > 0.0 && beta < 0.0);
        let right = sides_of_right || (!sides_of_left && at_start + at_end < 0.0);
        let side = if right { -1.0 } else { 1.0 };
        let first = (-side * alpha, side * at_start);
        let last = (side * beta, side * at_end);
        let reversed = (first.1, first.0) > (last.1, last.0);
        let ((phi0, kappa0), (phi1, kappa1)) = if reversed { (last, first) } else { (first, last) };
        let (start, end, half_chord) =
            if reversed { (ends.end, ends.start, scale(half, -1.0)) } else { (ends.start, ends.end, half) };
        // Adding 0 makes -0 the ordinary 0, for readers.
        let datum = Datum { phi0: phi0 + 0.0, phi1: phi1 + 0.0, kappa0: kappa0 + 0.0, kappa1: kappa1 + 0.0 };
        Ok((datum, Placement { start, end, half_chord, mirrored: right != reversed, reversed }))
    }

    /// Points of the normalised frame in the user's frame, in the user's order of travel.
    ///
    /// # Accuracy
    /// The images of (-1, 0) and (1, 0) are the user's points, exactly. Others are found from the nearer of the two,
    /// within 4 ulp of their distance from it and half an ulp of the result.
    pub fn to_user<const N: usize>(&self, points: &[[f64; 2]; N]) -> [[f64; 2]; N] {
        let mut mapped = points.map(|z| self.user_point(z));
        self.put_in_order(&mut mapped);
        mapped
    }

    /// The same relative to the user's start point, free of the rounding of far-away coordinates: what to
    /// differentiate.
    pub fn to_user_local<const N: usize>(&self, points: &[[f64; 2]; N]) -> [[f64; 2]; N] {
        let origin = if self.reversed { 1.0 } else { -1.0 };
        let mut mapped = points.map(|z| self.step(origin, z));
        self.put_in_order(&mut mapped);
        mapped
    }

    /// Sides of a control polygon of the normalised frame in the user's, in the user's order of travel.
    pub fn to_user_legs<const N: usize>(&self, legs: &[[f64; 2]; N]) -> [[f64; 2]; N] {
        let sign = if self.reversed { -1.0 } else { 1.0 };
        let mut mapped = legs.map(|leg| scale(self.step(0.0, leg), sign));
        self.put_in_order(&mut mapped);
        mapped
    }

    /// A PH quintic of the normalised frame, from (-1, 0) to (1, 0), in the user's.
    ///
    /// The derivative w² is turned and stretched by half the chord, so w is by its root; a mirrored curve has the
    /// conjugate of w, and one run backwards i times the coefficients in reverse order.
    pub(super) fn ph_in_user_frame(&self, curve: &PhQuintic) -> PhQuintic {
        let [x, y] = self.half_chord;
        let root = Complex64::new(x, y).sqrt();
        let mut w = complex(&curve.preimage).map(|w| root * if self.mirrored { w.conj() } else { w });
        let (mut start, mut end) = (self.start, self.end);
        if self.reversed {
            w = w.map(|w| Complex64::i() * w);
            w.reverse();
            (start, end) = (end, start);
        }
        PhQuintic::between(start, end, w.map(|w| [w.re, w.im]))
    }

    /// The normalised datum and what was done to get it, in words.
    pub(super) fn described(&self, datum: &Datum) -> String {
        let Datum { phi0, phi1, kappa0, kappa1 } = datum;
        let unit = self.unit();
        let mut text = format!(
            "normalised: phi0 = {phi0:?}, phi1 = {phi1:?}, kappa0 = {kappa0:?}, kappa1 = {kappa1:?}; half chord \
             {unit:?}"
        );
        text += if self.mirrored { ", mirrored" } else { "" };
        text + if self.reversed { ", reversed (what is called 0 belongs to the end)" } else { "" }
    }

    /// The curve of a datum and one root (f0, f1), in the user's frame and direction of travel.
    pub fn place(&self, datum: &Datum, f0: f64, f1: f64) -> CubicBezier {
        CubicBezier { p: self.to_user(&CubicBezier::from_ratios(datum.phi0, datum.phi1, f0, f1).p) }
    }

    /// The same relative to the user's start point, free of the rounding of far-away coordinates: the one to
    /// differentiate.
    pub fn place_local(&self, datum: &Datum, f0: f64, f1: f64) -> CubicBezier {
        CubicBezier { p: self.to_user_local(&CubicBezier::from_ratios(datum.phi0, datum.phi1, f0, f1).p) }
    }

    /// Angles of the user's end directions against the chord, radians, positive to the left: α and β of
    /// [`Placement::normalise`].
    pub fn against_chord(&self, datum: &Datum) -> [f64; 2] {
        let side = if self.mirrored { -1.0 } else { 1.0 };
        if self.reversed { [side * datum.phi1, -side * datum.phi0] } else { [-side * datum.phi0, side * datum.phi1] }
    }

    /// Where the user's curve turns.
    pub fn turn(&self) -> Turn {
        if self.mirrored != self.reversed { Turn::Right } else { Turn::Left }
    }

    /// Half the user's chord: multiply normalised lengths by it, and divide normalised curvatures.
    pub fn unit(&self) -> f64 {
        length(self.half_chord)
    }

    fn put_in_order(&self, points: &mut [Vector]) {
        if self.reversed {
            points.reverse();
        }
    }

    fn user_point(&self, z: Vector) -> Vector {
        let (near, origin) = if z[0] <= 0.0 { (self.start, -1.0) } else { (self.end, 1.0) };
        add(near, self.step(origin, z))
    }

    /// The user's vector from the image of (origin, 0) to that of z.
    fn step(&self, origin: f64, [x, y]: Vector) -> Vector {
        turn(self.half_chord, [x - origin, if self.mirrored { -y } else { y }])
    }
}

/// `direction - chord`, brought into (-π, π]. Never beyond ±[`PI`], the double; a half turn up to the rounding of both
/// is that double (a direction beyond ±π is taken to be rounded, by an ulp or 1e-9).
fn against(direction: f64, chord: f64) -> f64 {
    let turned = principal(direction) - chord;
    let within = match turned {
        // A half turn more is exact, and what is left of it rounds once.
        x if x > PI => (x - TAU) - TAU_LOW,
        x if x <= -PI => (x + TAU) + TAU_LOW,
        x => x,
    };
    // Against a chord along the x axis a direction up to a half turn stays as it is.
    let beyond = if direction.abs() > PI { (f64::EPSILON * direction.abs()).min(1e-9) } else { 0.0 };
    let rounding = if chord == 0.0 { 0.0 } else { HALF_TURN_ROUNDING + beyond };
    if within.abs() >= PI - rounding { PI } else { within }
}

/// The same direction within [-π, π]. Beyond it the double next to a multiple of a quarter turn is that
/// multiple, and of any other direction only
/// the last ulp is lost, however many turns it has.
fn principal(angle: f64) -> f64 {
    if angle.abs() <= PI {
        return angle;
    }
    let quarters = (angle / FRAC_PI_2).round();
    if (angle - quarters * FRAC_PI_2).abs() <= f64::EPSILON * angle.abs() {
        return [0.0, FRAC_PI_2, PI, -FRAC_PI_2][quarters.rem_euclid(4.0) as usize];
    }
    angle.sin().atan2(angle.cos())
}

/// The directions at both ends, a half turn with the sign that it has on a C-shaped curve: there α and β have opposite
/// signs. So ends and their mirror image are placed alike.
fn half_turns_to_their_side(alpha: f64, beta: f64, left: bool) -> (f64, f64) {
    match (alpha.abs() == PI, beta.abs() == PI) {
        (true, true) if left => (-PI, PI),
        (true, true) => (PI, -PI),
        (true, false) if beta != 0.0 => (PI.copysign(-beta), beta),
        (false, true) if alpha != 0.0 => (alpha, PI.copysign(-alpha)),
        (true, false) => (if left { -PI } else { PI }, beta),
        (false, true) => (alpha, if left { PI } else { -PI }),
        (false, false) => (alpha, beta),
    }
}

fn by_chord(name: &str, curvature: f64, half_chord: f64) -> Result<f64> {
    let product = curvature * half_chord;
    if curvature != 0.0 && !product.is_normal() {
        let what = format!("{name} curvature {curvature:?} times half the chord, {half_chord:?},");
        return Err(Error::domain(what, product, "0 or 2.3e-308 to 1.7e308 in magnitude"));
    }
    Ok(product)
}
