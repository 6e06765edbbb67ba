//! The domain of G² Hermite data in the chord's frame: `0 < φ0`, `0 < φ1`, `φ0 + φ1 < π`.

use super::region::clip_side;
use crate::error::{Error, Result, finite, written};
use crate::grid::Grid;
use crate::num::sines::{PI_LOW, sum_below_pi};
use std::f64::consts::PI;

/// An angle must be positive and below π, which lies just above the double [`PI`]; the sum is checked by
/// [`check_angles`].
fn check_angle(name: &str, angle: f64) -> Result<()> {
    if angle > 0.0 && angle <= PI {
        return Ok(());
    }
    Err(Error::angle(name.to_owned(), angle, "above 0 and below pi", "radians; write `40deg` for degrees"))
}

/// The tangents must meet: φ0 + φ1 < π, decided exactly.
fn check_angles(phi0: f64, phi1: f64) -> Result<()> {
    if sum_below_pi(phi0, phi1) {
        return Ok(());
    }
    let [first, second, sum] = [phi0, phi1, phi0 + phi1].map(written);
    Err(Error::invalid(format!(
        "phi0 + phi1 reaches {first} + {second} = {sum}; it must stay below pi, so that the tangents meet"
    )))
}

/// A datum: two angles, then two finite curvature coordinates, by name.
pub(super) fn check(datum: [(&'static str, f64); 4]) -> Result<()> {
    for (name, value) in &datum[2..] {
        finite(*name, *value)?;
    }
    for (name, angle) in &datum[..2] {
        check_angle(name, *angle)?;
    }
    check_angles(datum[0].1, datum[1].1)
}

/// Whether a box lies in the domain.
pub(super) fn holds_box(sides: &[[f64; 2]; 4]) -> bool {
    let [phi0, phi1, ..] = sides;
    phi0[0] > 0.0 && phi1[0] > 0.0 && sum_below_pi(phi0[1], phi1[1]) && sides.iter().flatten().all(|x| x.is_finite())
}

/// [`super::Region::clip`] of a family with this domain.
pub(super) fn clip(low: &mut [f64], high: &mut [f64]) -> bool {
    let least = f64::from_bits(1);
    for side in 0..2 {
        let other = low[1 - side].max(least);
        // What the other angle leaves: π less that angle, with what the double of π lacks, up to two roundings. So the
        // double above is too large, and the last that fits is a step or two below.
        let mut most = ((PI - other) + PI_LOW).next_up().min(PI);
        while most > 0.0 && !sum_below_pi(most, other) {
            most = most.next_down();
        }
        if !clip_side(&mut low[side], &mut high[side], least, most) {
            return false;
        }
    }
    true
}

/// A grid whose first two axes are φ0 and φ1.
pub(super) fn check_grid(grid: &Grid) -> Result<()> {
    let (phi0, phi1) = (&grid.axes()[0], &grid.axes()[1]);
    for axis in [phi0, phi1] {
        check_angle(axis.name(), axis.values()[0])?;
    }
    let last = |axis: &crate::grid::Axis| axis.values()[axis.values().len() - 1];
    check_angles(last(phi0), last(phi1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    #[test]
    fn what_is_clipped_holds_every_datum() {
        let mut noise = Noise(3);
        let others = (0..2000).map(|_| PI * noise.signed().abs());
        let near_pi = (0..60).map(|i| PI - 2f64.powi(-i)).chain([PI, PI.next_down()]);
        for other in others.chain(near_pi) {
            let (mut low, mut high) = ([0.0, other], [4.0, other]);
            assert!(clip(&mut low, &mut high), "{other:?}");
            // The last double that fits, and none above.
            assert!(sum_below_pi(high[0], other) && !sum_below_pi(high[0].next_up(), other), "{other:?}");
        }
    }
}
