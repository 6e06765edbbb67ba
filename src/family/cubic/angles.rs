//! What depends on the two tangent angles alone, enclosed.

use crate::family::last::{Last, kept};
use crate::family::outer::Sines;
use crate::num::{Interval, formula};
use std::cell::RefCell;
use std::rc::Rc;

/// The constants of a pair of angles, as in [`super::pair::Pair`].
pub(super) struct Angles {
    pub p: Interval,
    pub r: Interval,
    pub g0: Interval,
    pub g1: Interval,
    pub outer: Sines<Interval>,
}

impl Angles {
    /// [`Angles::new`], kept for the next call.
    pub(super) fn cached(phi0: f64, phi1: f64, bits: usize) -> Option<Rc<Angles>> {
        thread_local!(static LAST: Last<([u64; 2], usize), Angles> = const { RefCell::new(None) });
        kept(&LAST, ([phi0, phi1].map(f64::to_bits), bits), || Angles::new(phi0, phi1, bits))
    }

    pub(super) fn new(phi0: f64, phi1: f64, bits: usize) -> Option<Angles> {
        let ((sin0, cos0), (sin1, cos1)) = (Interval::sin_cos(phi0, bits), Interval::sin_cos(phi1, bits));
        let (sc, cs) = (&sin0 * &cos1, &cos0 * &sin1);
        let sum = &sc + &cs;
        // sin²(δ/2) = (1 - cos δ)/2
        let cos_difference = formula!(cos0 * cos1 + sin0 * sin1);
        Some(Angles {
            p: sc.over(&sum)?,
            r: cs.over(&sum)?,
            g0: sin0.over(&sum)?.square(),
            g1: sin1.over(&sum)?.square(),
            outer: [sin0, sin1, formula!(0.5 * (-cos_difference + 1.0))],
        })
    }
}
