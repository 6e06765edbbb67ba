//! The few operations on plane vectors that the curves need.

use crate::error::{Error, Result};
use num_complex::Complex64;

pub(crate) type Vector = [f64; 2];

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn scale(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Signed area of the parallelogram, positive when `b` lies to the left of `a`: Habib & Sakai, (2.3).
pub(crate) fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Product of complex numbers: turns and scales `b` by `a`.
pub(crate) fn turn(a: Vector, b: Vector) -> Vector {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// The vector of length 1 at an angle from the x axis.
pub(crate) fn unit(angle: f64) -> Vector {
    [angle.cos(), angle.sin()]
}

/// The angle from the x axis, in [-π, π].
pub(crate) fn angle_of(a: Vector) -> f64 {
    a[1].atan2(a[0])
}

pub(crate) fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

/// From `a` at `t = 0` to `b` at `t = 1`, both exact.
pub(crate) fn lerp(a: Vector, b: Vector, t: f64) -> Vector {
    add(scale(a, 1.0 - t), scale(b, t))
}

pub(crate) fn complex([re, im]: [f64; 2]) -> Complex64 {
    Complex64::new(re, im)
}

pub(crate) fn pair(z: Complex64) -> [f64; 2] {
    [z.re, z.im]
}

/// Refuses numbers that are not finite, by name.
pub(crate) fn finite(what: &str, name: &str, numbers: &[f64]) -> Result<()> {
    match numbers.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(Error::invalid(format!("{what}: `{name}` is {numbers:?}; all numbers must be finite"))),
    }
}

/// The same of two ends with their directions, and of one more number.
pub(crate) fn finite_ends(what: &str, ends: [Vector; 2], directions: [f64; 2], (name, x): (&str, f64)) -> Result<()> {
    finite(what, "start", &ends[0])?;
    finite(what, "end", &ends[1])?;
    finite(what, "start_direction", &directions[..1])?;
    finite(what, "end_direction", &directions[1..])?;
    finite(what, name, &[x])
}
