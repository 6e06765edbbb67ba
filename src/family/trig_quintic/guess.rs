//! Where the threshold is, about: nothing here is proved.
//!
//! At the threshold f, as a form along the curve, touches 0 from above. Among some places on the curve that one is
//! taken at which f is negative up to the largest ratio; from there Newton's method finds where f and its slope along
//! the curve are 0 together.

use super::poly::{BERNSTEIN, K};

/// Ratios up to this are looked at.
pub(super) const MOST: f32 = 64.0;
/// And down to this.
pub(super) const LEAST: f32 = 1.0 / 64.0;
/// Degree of f in the ratio.
pub(super) const DEGREE: usize = 6;

/// Places along the curve, besides its ends.
const PLACES: usize = 24;
/// Steps of each search at most.
const STEPS: u32 = 60;

/// f from one end of the curve: `Σ r^k Σ c s^i` with `s = τ/(1-τ)`, up to a positive factor.
struct Side<'c> {
    c: &'c [[f64; K]; DEGREE + 1],
    reversed: bool,
}

/// f, its derivative by the ratio, by s, by both, and twice by s.
struct Jet {
    value: f64,
    rise: f64,
    slope: f64,
    twist: f64,
    bend: f64,
}

impl Side<'_> {
    /// The coefficients of f by powers of the ratio at s, and their first two derivatives.
    fn powers(&self, s: f64) -> [[f64; 3]; DEGREE + 1] {
        std::array::from_fn(|k| {
            let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
            for i in (0..K).rev() {
                let place = if self.reversed { K - 1 - i } else { i };
                bend = bend * s + 2.0 * slope;
                slope = slope * s + value;
                value = value * s + self.c[k][place] / BERNSTEIN[place];
            }
            [value, slope, bend]
        })
    }

    fn jet(&self, ratio: f64, s: f64) -> Jet {
        let powers = self.powers(s);
        let by = |which: usize| {
            powers.iter().rev().fold([0.0, 0.0], |[sum, rise], c| [sum * ratio + c[which], rise * ratio + sum])
        };
        let ([value, rise], [slope, twist], [bend, _]) = (by(0), by(1), by(2));
        Jet { value, rise, slope, twist, bend }
    }

    /// The ratio above `low` from which f is positive at s, where it is not at `low`.
    fn passed(&self, s: f64, low: f64) -> Option<f64> {
        let powers = self.powers(s);
        let at = |ratio: f64| powers.iter().rev().fold(0.0, |sum, c| sum * ratio + c[0]);
        (at(low) < 0.0).then(|| crate::num::roots::find(at, low, f64::from(MOST), 1e-4 * low))
    }
}

/// The single that the threshold rounds to, as its bits; `None` where the search does not end.
pub(super) fn guess(c: &[[f64; K]; DEGREE + 1]) -> Option<u32> {
    let mut best: (f64, Option<(bool, f64)>) = (f64::from(LEAST), None);
    for reversed in [false, true] {
        let side = Side { c, reversed };
        for i in 0..=PLACES / 2 {
            let s = i as f64 / (PLACES - i) as f64;
            if let Some(ratio) = side.passed(s, best.0) {
                best = (ratio, Some((reversed, s)));
            }
        }
    }
    let (mut ratio, Some((reversed, mut s))) = best else { return Some(LEAST.to_bits()) };
    let side = Side { c, reversed };
    for _ in 0..STEPS {
        let Jet { value, rise, slope, twist, bend } = side.jet(ratio, s);
        // At an end f need not be level.
        let inside = s > 0.0 || slope < 0.0;
        let (up, along) = if inside && bend > 0.0 {
            // value + rise up + slope along = 0, slope + twist up + bend along = 0.
            let up = (slope * slope / bend - value) / (rise - slope * twist / bend);
            (up, -(slope + twist * up) / bend)
        } else {
            (-value / rise, 0.0)
        };
        let moved = (s + along).max(0.0) - s;
        (ratio, s) = (ratio + up, s + moved);
        if !(ratio > 0.0 && ratio.is_finite() && s < 4.0) {
            return None;
        }
        if up.abs() < 1e-13 * ratio && moved.abs() < 1e-7 {
            return Some((ratio as f32).max(LEAST).to_bits());
        }
    }
    None
}
