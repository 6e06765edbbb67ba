//! The f64 step: proves the verdicts of a vector of nodes, or leaves them undecided. The shader does the same in f32.

use super::frame::FRAME_ERRORS;
use super::plain::{flags, printed_ratio};
use super::poly::{BERNSTEIN, Frame, K, hodograph, numerator};
use super::{END_RISES, PRINTED_RATIO, SPIRAL};
use crate::family::Code;
use crate::num::bernstein::positive;
use crate::num::bernstein_lanes::{negative_lanes, positive_lanes};
use crate::num::{COVER, Certain, Lanes, Verdict};
use fearless_simd::{Simd, SimdBase};

/// 2^-53.
pub(super) const UNIT: f64 = 0.5 * f64::EPSILON;
/// m, ratio and their inverses stay below this, so that nothing overflows or underflows: a coefficient has eight
/// factors of each, and one of `(4 + p)⁴ > 2^-208`.
const MOST: f64 = (1u64 << 40) as f64;
/// Halvings: a feature that deeper ones would show is hidden by the error anyway.
const DEPTH: u32 = 40;

/// Relative error of the numerator's coefficients against the sums of their terms' absolute values, given the errors of
/// the frame.
///
/// The first side is `3(my)²`; then as [`hodograph`] and [`numerator`] count; one more for the Bernstein factor. The
/// last 5 are two for adding the error itself, and what is of second order.
pub(super) const fn coefficient_error([y, last, square]: [f64; 3], of_m: f64, of_pq: f64) -> f64 {
    let first = 2.0 * (y + of_m + 1.0) + 2.0;
    let sides = if first > last { first } else { last };
    4.0 * (sides + 5.0 + of_pq) + square + 48.0 + 1.0 + 5.0
}

/// Whether m and the ratio are small enough, and large enough.
pub(super) fn is_ordinary(m: f64, ratio: f64) -> bool {
    [m, ratio].iter().all(|v| (1.0 / MOST..=MOST).contains(v))
}

/// Error of the numerator's coefficients, relative to the sums of absolute terms.
pub(super) const ERROR: f64 = coefficient_error(FRAME_ERRORS, 0.0, 1.0) * UNIT;

/// The sign of the numerator from Bernstein coefficients and the sums of absolute values of their terms.
pub(super) fn decide<N: Certain>(value: &[N; K], size: &[f64; K], relative: f64) -> Verdict {
    // The least polynomial may prove it positive, the greatest disprove it: coefficients differ much in size, and so do
    // their errors.
    let side = |sign: f64| {
        let c: [N; K] = std::array::from_fn(|i| value[i].plus(sign * relative * size[i]));
        let largest = size.iter().fold(0.0f64, |most, s| most.max(*s)) * COVER;
        positive(&c, 0.0, largest * ((K - 1) as f64 * UNIT), DEPTH)
    };
    let holds = side(-1.0).is_yes();
    Verdict::proved(holds, !holds && side(1.0).is_no())
}

/// Places where a numerator that is negative somewhere mostly is: at `τ/(1 - τ) = s`.
const DIPS: [f64; 7] = [1.0, 3.0, 1.0 / 3.0, 7.0, 1.0 / 7.0, 5.0 / 3.0, 0.6];
/// Halvings in vectors; what is open then goes lane by lane.
const HALVINGS: usize = 12;

/// Lanes whose numerator is certainly positive, and those where it is certainly negative somewhere.
#[inline(always)]
fn spirals<S: Simd>(simd: S, value: &[S::f64s; K], size: &[S::f64s; K], wanted: u64) -> (u64, u64) {
    let (mut no, mut errors) = (0, *size);
    for error in &mut errors {
        *error *= COVER * (ERROR + 2.0 * K as f64 * UNIT);
    }
    for s in DIPS {
        if wanted & !no != 0 {
            no |= negative_lanes(simd, value, &errors, s) & wanted;
        }
    }
    let open = wanted & !no;
    if open == 0 {
        return (0, no);
    }
    // The least polynomial, as in `decide`.
    let (mut least, mut largest) = (*value, S::f64s::splat(simd, 0.0));
    for i in 0..K {
        least[i] = (value[i] - size[i] * (COVER * ERROR)) * BERNSTEIN[i];
        largest = largest.max(size[i] * BERNSTEIN[i]);
    }
    // The product above and that with a whole factor add two units, of numbers below that.
    (positive_lanes(simd, &least, largest * (4.0 * UNIT), open, HALVINGS), no)
}

/// The codes of a vector of nodes that share ratio, θ, m and p.
#[inline(always)]
pub(super) fn classify<S: Simd>(simd: S, frame: &Frame<f64>, [ratio, m, p]: [f64; 3], q: S::f64s, out: &mut [Code]) {
    let mut known = [0u8; 8];
    for (flag, q) in known.iter_mut().zip(q.as_slice()).take(out.len()) {
        *flag = flags(ratio, m, *q);
    }
    let rising = (0..out.len()).filter(|lane| known[*lane] & END_RISES != 0).fold(0, |lanes, lane| lanes | 1 << lane);
    debug_assert_eq!(known[0] & PRINTED_RATIO != 0, printed_ratio(ratio, m));
    let forms = if rising != 0 && is_ordinary(m, ratio) {
        let number = |x: f64| Lanes::<S>::splat(simd, x);
        let frame = Frame { y: number(frame.y), last: number(frame.last), square: number(frame.square) };
        let hodograph = hodograph(&frame, &number(m), &number(p), &Lanes(q));
        Some([numerator(&hodograph, &frame.square, -1.0), numerator(&hodograph, &frame.square, 1.0)])
    } else {
        None
    };
    let (mut yes, mut no) = (0, 0);
    if let Some([value, size]) = &forms {
        (yes, no) = spirals(simd, &value.map(|c| c.0), &size.map(|c| c.0), rising);
    }
    for (lane, code) in out.iter_mut().enumerate() {
        let flags = known[lane];
        if flags & END_RISES == 0 {
            *code = Code::new(flags, 0);
            continue;
        }
        if (yes | no) >> lane & 1 == 1 {
            *code = Code::new(if yes >> lane & 1 == 1 { flags | SPIRAL } else { flags }, 0);
            continue;
        }
        let Some([value, size]) = &forms else {
            *code = Code::UNDECIDED;
            continue;
        };
        let at = |c: &[Lanes<S>; K]| std::array::from_fn(|i| c[i].0.as_slice()[lane] * BERNSTEIN[i]);
        *code = match decide(&at(value), &at(size), ERROR) {
            Verdict::Yes => Code::new(flags | SPIRAL, 0),
            Verdict::No => Code::new(flags, 0),
            Verdict::Undecided => Code::UNDECIDED,
        };
    }
}
