//! The f64 step: classifies a vector of nodes of one angle, with proof, or leaves them undecided.
//!
//! Guesses (division, square roots, Newton's method) only choose where to look; what is stored rests on `+ - *` with
//! these bounds. The shaders do the same in f32, function by function (`shaders/reach/`).

use super::angle::{Angle, SCALE_ERROR};
use super::poly::{BERNSTEIN, LEAST_M, MONOTONE_M, coefficients, ph_m, ph_sides};
use super::{CASE_BITS, EXACT, EXISTS, Kind, PAPER, THEOREM};
use crate::family::Code;
use crate::family::rows::bits;
use crate::num::bernstein::positive;
use crate::num::{COVER, Lanes, Verdict};
use fearless_simd::{Simd, SimdBase, SimdFloat};

/// Constants of the error bounds: they count operations for each term, so they hold with fused multiply-adds and
/// reassociation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Precision {
    /// Unit roundoff u.
    pub unit: f64,
    /// α and β: the constant, the product and the input.
    scale: f64,
    /// `ξ sin θ - η cos θ`: inputs, sines, one product, one sum.
    side: f64,
    /// `αu² - 24gu - 3`: g and five operations.
    shape: f64,
    /// The coefficients: g and twelve operations, and a twelfth of these ([`THROUGH_M`]).
    coefficient: f64,
    /// What underflow may do to a side, α or β.
    pub floor: f64,
    /// α, u and their inverses stay below this, so that nothing overflows.
    pub most_alpha: f64,
    /// β stays below this, and above its negative.
    pub most_beta: f64,
    /// Least and largest u.
    pub range_u: (f64, f64),
}

impl Precision {
    pub(super) const F64: Precision = Precision {
        unit: 1.0 / (1u64 << 53) as f64,
        scale: SCALE_ERROR + 2.0,
        side: 14.0,
        shape: 28.0,
        coefficient: 36.0,
        floor: 1e-280,
        most_alpha: (1u128 << 120) as f64,
        most_beta: (1u128 << 120) as f64,
        range_u: (1.0 / (1u128 << 100) as f64, (1u128 << 84) as f64),
    };
    pub(super) const F32: Precision = Precision {
        unit: 1.0 / (1u32 << 24) as f64,
        scale: 5.0,
        side: 6.0,
        shape: 8.0,
        coefficient: 15.0,
        floor: 1e-30,
        most_alpha: (1u32 << 24) as f64,
        most_beta: (1u64 << 40) as f64,
        range_u: (1.0 / (1u32 << 24) as f64, (1u32 << 14) as f64),
    };

    pub(super) const fn scale(self) -> f64 {
        self.scale * self.unit
    }
    pub(super) const fn side(self) -> f64 {
        self.side * self.unit
    }
    pub(super) const fn shape(self) -> f64 {
        self.shape * self.unit
    }
    pub(super) const fn coefficient(self) -> f64 {
        self.coefficient * self.unit
    }
    /// G: at most seven operations a term.
    pub(super) const fn residual(self) -> f64 {
        8.0 * self.unit
    }
}

/// Relative errors of u and m must be below this.
pub(super) const SMALL: f64 = 1.0 / 64.0;
/// Errors of G in the δ that is tried for u: the value at the guess may take one half, and the proof needs one.
pub(super) const TRIED: f64 = 2.5;
/// Covers what the cubic's bounds leave out: roundings of their own computation, and squares of errors.
pub(super) const LOOSE: f64 = 1.05;
/// Of the relative error e of u: how far `u²` may be off, `2e + e² <= 2.02 e` for `e < SMALL`.
pub(super) const THROUGH_U: f64 = 2.2;
/// Of the relative error d of m: how far `m³ u²` may be off beyond [`THROUGH_U`]. `(1 + d)³ - 1 <= 3.05 d`, and its
/// product with what u does, below 0.032, adds 0.1 d. What the coefficient's own error adds, as a product with both, is
/// below a twelfth of it: [`Precision::coefficient`] counts that.
pub(super) const THROUGH_M: f64 = 3.3;

/// m*, rounded.
pub(super) const fn least_drawn_m(kind: Kind) -> f64 {
    match kind {
        Kind::Cubic => 0.579_795_897_113_271_2,
        Kind::Ph => 0.707_778_735_729_046,
    }
}

const P: Precision = Precision::F64;

/// A number and how far it may be off.
#[derive(Clone, Copy)]
pub(super) struct Near<S: Simd> {
    pub value: S::f64s,
    pub error: S::f64s,
}

impl<S: Simd> Near<S> {
    /// Times a constant that is off by [`Precision::scale`], with the product's rounding.
    #[inline(always)]
    fn scaled(&self, by: f64) -> Near<S> {
        let value = self.value * by;
        Near { value, error: value.abs() * P.scale() + self.error * (COVER * by) + P.floor }
    }
}

/// The segment of one case, where there is one.
pub(super) struct SegmentLanes<S: Simd> {
    /// u; its error is relative.
    pub u: Near<S>,
    pub m: Near<S>,
    /// Lanes where (u, m) is proved to be the only candidate.
    found: u64,
    /// Lanes where there is proved to be no `m > 0`.
    none: u64,
}

impl<S: Simd> SegmentLanes<S> {
    /// Whether a lane's segment is proved to exist.
    pub(super) fn is_found(&self, lane: u32) -> bool {
        self.found >> lane & 1 == 1
    }
}

/// The two sides (a, b) of both cases and where a is proved not to be positive.
#[inline(always)]
pub(super) fn sides<S: Simd>(simd: S, angle: &Angle, xi: f64, eta: S::f64s) -> [(Near<S>, Near<S>, u64); 2] {
    let zero = S::f64s::splat(simd, 0.0);
    let (east, north) = (S::f64s::splat(simd, xi * angle.sin), eta * angle.cos);
    let h: Near<S> = Near { value: east - north, error: (east.abs() + north.abs()) * P.side() + P.floor };
    let (below, h_below) = (bits::<S>(eta.simd_le(zero)), bits::<S>(h.value.simd_lt(-h.error)));
    let eta = Near { value: eta, error: zero };
    [(eta, h, below), (h, eta, h_below)]
}

/// The segment with α from `a` and β from `b`.
#[inline(always)]
pub(super) fn shape<S: Simd>(
    simd: S,
    kind: Kind,
    angle: &Angle,
    a: &Near<S>,
    b: &Near<S>,
    none: u64,
) -> SegmentLanes<S> {
    let (alpha, beta) = (a.scaled(angle.to_alpha), b.scaled(angle.to_beta));
    let (least, most) = (S::f64s::splat(simd, 1.0 / P.most_alpha), S::f64s::splat(simd, P.most_alpha));
    let usable = alpha.value.simd_gt(least) & alpha.value.simd_lt(most);
    let usable = bits::<S>(usable & beta.value.abs().simd_lt(S::f64s::splat(simd, P.most_beta))) & !none;
    let mut shape = match kind {
        Kind::Cubic => cubic(simd, &alpha, &beta),
        Kind::Ph => ph(simd, angle.g, &alpha, &beta, usable),
    };
    let u = shape.u.value;
    let (low, high) = (S::f64s::splat(simd, P.range_u.0), S::f64s::splat(simd, P.range_u.1));
    let in_range = u.simd_gt(low) & u.simd_lt(high) & shape.u.error.simd_lt(S::f64s::splat(simd, SMALL));
    shape.found &= usable & bits::<S>(in_range);
    let negative = (shape.m.value + shape.m.error).simd_lt(S::f64s::splat(simd, 0.0));
    shape.none = none | shape.none & usable | shape.found & bits::<S>(negative);
    shape.found &= !shape.none & bits::<S>(shape.m.value.simd_gt(shape.m.error));
    shape
}

/// `αu = 1`, `m = βu² - 1`.
#[inline(always)]
fn cubic<S: Simd>(simd: S, alpha: &Near<S>, beta: &Near<S>) -> SegmentLanes<S> {
    let one = S::f64s::splat(simd, 1.0);
    let u = one / alpha.value;
    // |u - u*| / u* = |α* u - 1|
    let rho = ((alpha.value * u - one).abs() + alpha.error * u + 3.0 * P.unit) * LOOSE;
    let square = u * u;
    let sum = beta.value * square;
    let error = (beta.error * square + sum.abs() * rho * 2.0) * LOOSE + (sum.abs() + one) * (4.0 * P.unit);
    SegmentLanes { u: Near { value: u, error: rho }, m: Near { value: sum - one, error }, found: u64::MAX, none: 0 }
}

/// `m = αu² - 24gu - 3` with the error that the constants bring.
#[inline(always)]
fn ph_shape<S: Simd>(alpha: &Near<S>, g: S::f64s, u: S::f64s) -> Near<S> {
    let m = ph_m(&Lanes::<S>(alpha.value), &Lanes(g), &Lanes(u)).0;
    let terms = (alpha.value * u + g * 24.0) * u + 3.0;
    Near { value: m, error: alpha.error * (u * u) + terms * P.shape() }
}

/// G with its error.
#[inline(always)]
fn residual<S: Simd>(beta: &Near<S>, m: &Near<S>, u: S::f64s) -> Near<S> {
    let (left, right) = ph_sides(&Lanes::<S>(beta.value), &Lanes(m.value), &Lanes(u));
    let size = m.value.abs();
    let terms = (size + 3.0) * u * 2.0 + size * (size + 1.0) * 3.0 + 2.0 + right.0.abs();
    let through_m = (u * 2.0 + size * 6.0 + 3.0 + m.error * 3.0) * m.error;
    Near { value: left.0 - right.0, error: (through_m + beta.error * (u * u * u)) * COVER + terms * P.residual() }
}

/// The equation for u of the PH quintic.
struct Curve<S: Simd> {
    g: S::f64s,
    alpha: Near<S>,
    beta: Near<S>,
}

impl<S: Simd> Curve<S> {
    /// m and G.
    #[inline(always)]
    fn at(&self, u: S::f64s) -> (Near<S>, Near<S>) {
        let m = ph_shape(&self.alpha, self.g, u);
        (m, residual(&self.beta, &m, u))
    }

    /// `u G' - 3G`.
    #[inline(always)]
    fn slope(&self, m: S::f64s, value: S::f64s, u: S::f64s) -> S::f64s {
        let m_slope = u * 2.0 * (self.alpha.value * u - self.g * 12.0);
        let right = self.beta.value * (u * u * u);
        (m + 3.0) * u * 2.0 - right * 3.0 + (u * 2.0 + m * 6.0 + 3.0) * m_slope - value * 3.0
    }
}

/// Newton's method for G/u³ from where `m = LEAST_M`, then a proof: G has certain signs on both sides of a short
/// interval.
#[inline(always)]
fn ph<S: Simd>(simd: S, g: f64, alpha: &Near<S>, beta: &Near<S>, wanted: u64) -> SegmentLanes<S> {
    const MOST_STEPS: u32 = 16;
    let (zero, g) = (S::f64s::splat(simd, 0.0), S::f64s::splat(simd, g));
    let curve: Curve<S> = Curve { g, alpha: *alpha, beta: *beta };
    let from = (g * 12.0 + (g * g * 144.0 + alpha.value * (3.0 + LEAST_M)).sqrt()) / alpha.value;
    let (start, g_start) = curve.at(from);
    let least = S::f64s::splat(simd, MONOTONE_M);
    let monotone = (start.value - start.error).simd_gt(least);
    let none = bits::<S>(monotone & (start.value + start.error).simd_lt(zero) & g_start.value.simd_gt(g_start.error));
    let wanted = wanted & !none;
    let mut u = from;
    for _ in 0..MOST_STEPS {
        if wanted == 0 {
            break;
        }
        let (m, value) = curve.at(u);
        let step = u * value.value / curve.slope(m.value, value.value, u);
        u = (u - step).max(from);
        // The next error is about the square of this step.
        if bits::<S>(step.abs().simd_lt(u * 2f64.powi(-28))) & wanted == wanted {
            break;
        }
    }
    let (m, value) = curve.at(u);
    // Any δ would do that the proof accepts.
    let delta = (value.error * TRIED / curve.slope(m.value, value.value, u) + 4.0 * P.unit) * u;
    let (low, high) = (u - delta, u + delta);
    let ((m_low, g_low), (_, g_high)) = (curve.at(low), curve.at(high));
    let monotone = (m_low.value - m_low.error).simd_gt(least);
    let crossing = monotone & g_low.value.simd_lt(-g_low.error) & g_high.value.simd_gt(g_high.error);
    // Where rounding has turned the slope, δ is no length and proves nothing.
    let found = bits::<S>(crossing & low.simd_gt(zero) & delta.simd_gt(zero));
    let rho = delta / u * COVER + 4.0 * P.unit;
    let error = m.error + (alpha.value * u + g * 12.0) * u * THROUGH_U * rho;
    SegmentLanes { u: Near { value: u, error: rho }, m: Near { value: m.value, error }, found, none }
}

/// Verdicts of a vector of nodes about one case, one bit a lane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Planes {
    /// EXISTS, EXACT, THEOREM, PAPER.
    pub flags: [u64; 4],
    /// Lanes where everything is proved.
    pub known: u64,
}

/// Decides the four levels of one case.
#[inline(always)]
pub(super) fn levels<S: Simd>(simd: S, kind: Kind, angle: &Angle, shape: &SegmentLanes<S>) -> Planes {
    let (m, u, g) = (shape.m.value, shape.u.value, S::f64s::splat(simd, angle.g));
    // m itself must be known well, relative to its size.
    let open = shape.found & bits::<S>(shape.m.error.simd_lt(m * SMALL));
    if open == 0 {
        return Planes { flags: [0; 4], known: shape.none };
    }
    let value = coefficients(kind, &Lanes::<S>(m), &Lanes(u), &Lanes(g), -1.0);
    let mut error = coefficients(kind, &Lanes::<S>(m), &Lanes(u), &Lanes(g), 1.0);
    // A term has m to the third power at most, u to the second.
    let relative = shape.m.error / m * THROUGH_M + shape.u.error * THROUGH_U + P.coefficient();
    let (mut above, mut below) = ([0; 4], [0; 4]);
    for i in 0..6 {
        error[i] = Lanes(error[i].0 * relative);
        if i < 4 {
            (above[i], below[i]) =
                (bits::<S>(value[i].0.simd_gt(error[i].0)), bits::<S>(value[i].0.simd_lt(-error[i].0)));
        }
    }
    let star = least_drawn_m(kind);
    let drawn = bits::<S>((m - shape.m.error).simd_gt(S::f64s::splat(simd, star * (1.0 + 4.0 * P.unit))));
    let not_drawn = bits::<S>((m + shape.m.error).simd_lt(S::f64s::splat(simd, star * (1.0 - 4.0 * P.unit))));
    let paper = open & drawn & above[0];
    let theorem = paper | open & above[0] & above[1] & above[2] & above[3];
    let mut exact = theorem;
    let mut not_exact = open & below[0];
    let mut unclear = open & !exact & !not_exact;
    while unclear != 0 {
        let lane = unclear.trailing_zeros() as usize;
        unclear &= unclear - 1;
        let at = |c: &[Lanes<S>; 6], i: usize| c[i].0.as_slice()[lane];
        match spiral(std::array::from_fn(|i| at(&value, i)), std::array::from_fn(|i| at(&error, i))) {
            Verdict::Yes => exact |= 1 << lane,
            Verdict::No => not_exact |= 1 << lane,
            Verdict::Undecided => {}
        }
    }
    // The drawn region lies inside the theorem's, and that among the spirals.
    let not_theorem = not_exact | open & (below[1] | below[2] | below[3]);
    let not_paper = not_theorem | open & not_drawn;
    let known = (exact | not_exact) & (theorem | not_theorem) & (paper | not_paper);
    Planes { flags: [open & known, exact & known, theorem & known, paper & known], known: shape.none | known }
}

/// Whether the quintic is positive, from its coefficients and their errors: the least quintic may prove it, the
/// greatest disprove it.
fn spiral(value: [f64; 6], error: [f64; 6]) -> Verdict {
    const DEPTH: u32 = 20;
    let sign = |side: f64| {
        let c: [f64; 6] = std::array::from_fn(|i| (value[i] + side * error[i]) * BERNSTEIN[i]);
        let rounding = c.iter().fold(0.0f64, |most, v| most.max(v.abs())) * (5.0 * P.unit);
        positive(&c, rounding, rounding, DEPTH)
    };
    let fails = sign(1.0).is_no();
    Verdict::proved(!fails && sign(-1.0).is_yes(), fails)
}

/// The codes of a vector of nodes that share θ and ξ.
#[inline(always)]
pub(super) fn classify<S: Simd>(simd: S, kind: Kind, angle: &Angle, xi: f64, eta: S::f64s, out: &mut [Code]) {
    // No closures around what runs on vectors: they are not always inlined into code for a wider level, and then every
    // operation becomes a call.
    let mut cases = [Planes::default(); 2];
    for (planes, (a, b, none)) in cases.iter_mut().zip(&sides(simd, angle, xi, eta)) {
        let shape = shape(simd, kind, angle, a, b, *none);
        *planes = levels(simd, kind, angle, &shape);
    }
    for (lane, code) in out.iter_mut().enumerate() {
        *code = if (cases[0].known & cases[1].known) >> lane & 1 == 0 {
            Code::UNDECIDED
        } else {
            let nibble = |planes: &Planes| {
                let bit = |i: usize, flag: u8| if planes.flags[i] >> lane & 1 == 1 { flag } else { 0 };
                bit(0, EXISTS) | bit(1, EXACT) | bit(2, THEOREM) | bit(3, PAPER)
            };
            Code::new(nibble(&cases[0]) | nibble(&cases[1]) << CASE_BITS, 0)
        };
    }
}
