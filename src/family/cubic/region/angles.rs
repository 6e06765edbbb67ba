//! What depends on the two angles, as forms over their ranges.

use crate::num::sines::sum_below_pi;
use crate::num::{Form, Number, formula};

/// A form in φ0, φ1, κ0, κ1.
pub(super) type Four = Form<4, 10>;

/// The constants of [`super::super::pair::Pair`] over a range of angles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Angles {
    pub p: Four,
    pub r: Four,
    pub g0: Four,
    pub g1: Four,
    /// a / κ0.
    pub curve0: Four,
    /// k / κ1.
    pub curve1: Four,
}

impl Angles {
    /// `None` where the box leaves the domain, comes too near to its end, or is too wide for two orders.
    pub(super) fn new(phi0: [f64; 2], phi1: [f64; 2]) -> Option<Angles> {
        (phi0[0] > 0.0 && phi1[0] > 0.0 && sum_below_pi(phi0[1], phi1[1])).then_some(())?;
        let (first, second) = (Four::centred(phi0, 0), Four::centred(phi1, 1));
        let (sin0, sin1) = (first.sine(), second.sine());
        let inverse = first.sine_of_sum(&second).inverse()?;
        let (q0, q1) = (formula!(sin0 * inverse), formula!(sin1 * inverse));
        let (g0, g1) = (formula!(q0 * q0), formula!(q1 * q1));
        let p = q0.mul(&second.cosine());
        Some(Angles {
            p,
            r: formula!(1.0 - p),
            g0,
            g1,
            curve0: g1.mul(&sin0.inverse()?),
            curve1: g0.mul(&sin1.inverse()?),
        })
    }
}
