//! Path planning against published numbers, and against what the Bézier form alone says.

mod audit;
mod corner;
mod course;
mod curve;
mod equal;
mod extremes;
mod hermite;
mod kinds;
mod least_curvature;
mod piece;
mod plan;
mod separation;
mod spline;

use serde_json::Value;
use spiral_atlas::curve::{Jet, PhQuintic, arc_length};

/// Relative accuracy of the published numbers: 13 digits.
const DIGITS: f64 = 2e-12;

fn published(key: &str) -> Value {
    let all: Value = serde_json::from_str(include_str!("../fixtures/ph_paths.json")).unwrap();
    all[key].clone()
}

fn rows(key: &str) -> Vec<Value> {
    let rows = published(key)["rows"].as_array().unwrap().clone();
    assert!(rows.len() > 10);
    rows
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn point(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn points(value: &Value) -> Vec<[f64; 2]> {
    value.as_array().unwrap().iter().map(point).collect()
}

/// How far two lists of numbers are apart, relative to the largest; infinite for different lengths.
fn apart(got: &[f64], want: &[f64]) -> f64 {
    let size = want.iter().fold(1e-3f64, |size, x| size.max(x.abs()));
    let off =
        got.iter().zip(want).map(|(g, w)| (g - w).abs()).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
    if got.len() == want.len() { off / size } else { f64::INFINITY }
}

fn flat(points: &[[f64; 2]]) -> Vec<f64> {
    points.iter().flatten().copied().collect()
}

fn assert_near(what: &str, got: &[f64], want: &[f64], tolerance: f64) {
    assert!(apart(got, want) <= tolerance, "{what}: {got:?} is not {want:?}");
}

/// A jet that knows the control points alone.
fn bezier(curve: &PhQuintic, t: f64) -> Jet {
    Jet::of_bezier(&curve.control_points(), t)
}

/// Arc length, bending energy and absolute rotation by quadrature of the Bézier curve, between parameters.
fn quadrature(curve: &PhQuintic, from: f64, to: f64) -> [f64; 3] {
    let integral = |power: i32| {
        arc_length(|t| bezier(curve, t).curvature().abs().powi(power) * bezier(curve, t).speed(), from, to)
    };
    [integral(0), integral(2), integral(1)]
}

/// Numbers without a pattern, in [-1, 1].
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / 2f64.powi(52) - 1.0
    }
    fn point(&mut self) -> [f64; 2] {
        [self.next(), self.next()]
    }
}

#[test]
fn comparisons_can_fail() {
    assert!(
        apart(&[1.0, 2.0], &[1.0, 2.0 + 1e-11]) > DIGITS
            && apart(&[1.0], &[1.0, 2.0]) > 1.0
            && apart(&[f64::NAN], &[1.0]).is_nan()
    );
    assert!(std::panic::catch_unwind(|| assert_near("", &[f64::NAN], &[1.0], 1.0)).is_err());
}
