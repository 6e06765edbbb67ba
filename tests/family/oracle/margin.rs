//! The margin: least value on [0, 1] over the largest Bernstein coefficient.

use super::in_s;
use super::iv::{Iv, Sure, Unsure};
use super::poly::{Poly, Sturm};

/// The margin of the quintic `q`, rounded to the nearest double.
///
/// The least value is at an end or at a root of `q'`, all of which are enclosed.
pub(super) fn margin(q: &Poly, bits: usize) -> Sure<f64> {
    let (zero, one) = (Iv::new(0.0, bits), Iv::new(1.0, bits));
    let slope = q.derivative();
    let inside = if slope.0.len() < 2 { vec![] } else { Sturm::new(&slope)?.roots(&zero, &one)? };
    let places = inside.iter().chain([&zero, &one]);
    let least = places.map(|t| q.at(t)).reduce(|a, b| a.lower(&b)).ok_or(Unsure)?;
    let size = bernstein(q, bits)?.iter().map(Iv::magnitude).reduce(|a, b| -&(-&a).lower(&-&b)).ok_or(Unsure)?;
    least.over(&size)?.to_f64()
}

/// Bernstein coefficients of a quintic on [0, 1]: `H_(5-i) = C(5, i) b_i`.
fn bernstein(q: &Poly, bits: usize) -> Sure<Vec<Iv>> {
    let binomial = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
    in_s(q, bits).iter().rev().zip(binomial).map(|(c, n)| c.over(&Iv::new(n, bits))).collect()
}
