//! The outer bound of every curve family: whether any spiral at all has these ends (Kurnosenko).
//!
//! For increasing curvature in the cubic's frame: `κ0 < sin φ0`, `κ1 > sin φ1` and
//! `(sin φ0 - κ0)(κ1 - sin φ1) > sin²((φ1 - φ0)/2)`, given φ0 < φ1. That is Q < 0, and κ0 < κ1 follows: otherwise both
//! factors would add up to at most `sin φ0 - sin φ1`, and their product to at most
//! `cos²((φ0 + φ1)/2) sin²((φ1 - φ0)/2)`. Likewise Q < 0 and κ0 < κ1 leave no other signs of the factors.

use crate::num::formula;
use crate::num::{Certain, Verdict};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};
use std::cmp::Ordering::Greater;

/// `[sin φ0, sin φ1, sin²((φ1 - φ0)/2)]`.
pub(super) type Sines<N> = [N; 3];

/// Lanes where the bound holds, and where it does not; where neither, doubles cannot decide.
///
/// Sines, curvatures and the square are within a relative `error`, which also covers four roundings.
#[inline(always)]
pub(super) fn lanes<S: Simd>(simd: S, sines: &Sines<f64>, kappa0: S::f64s, kappa1: S::f64s, error: f64) -> (u64, u64) {
    let [sin0, sin1, sin2_half] = sines.map(|s| S::f64s::splat(simd, s));
    let (room0, room1) = (sin0 - kappa0, kappa1 - sin1);
    let (error0, error1) = ((sin0.abs() + kappa0.abs()) * error, (sin1.abs() + kappa1.abs()) * error);
    let product = room0 * room1;
    let over = product - sin2_half;
    let error = room0.abs() * error1 + room1.abs() * error0 + error0 * error1 + (product.abs() + sin2_half) * error;
    let zero = S::f64s::splat(simd, 0.0);
    let yes = over.simd_gt(error) & room0.simd_gt(zero);
    let no = over.simd_lt(-error) | room0.simd_lt(-error0) | room1.simd_lt(-error1);
    (yes.to_bitmask(), no.to_bitmask())
}

/// The same for enclosed numbers; undecided when the precision does not suffice.
pub(super) fn holds<N: Certain>(sines: &Sines<N>, kappa0: &N, kappa1: &N) -> Verdict {
    let positive = |x: &N| Verdict::from(x.certain_sign(0.0).map(|sign| sign == Greater));
    let (room0, room1) = (sines[0].sub(kappa0), kappa1.sub(&sines[1]));
    let rooms = positive(&room0).and(positive(&room1));
    if rooms.is_yes() { positive(&formula!(room0 * room1 - sines[2])) } else { rooms }
}
