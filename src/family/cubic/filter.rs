//! The f64 step: classifies a vector of nodes that share their angles, with proof, or leaves them undecided.
//!
//! Guesses (Newton's method, division, square roots) only choose where to look. What is stored rests on `+ - *` with
//! these bounds, in units of u = 2^-53. The shader `cubic.wgsl` does the same in f32, function by function.

use super::pair::{PAIR_ERROR, Pair};
use super::poly::{Bounds, side};
use crate::family::outer;
use crate::num::bernstein::{Quintic, positive};
use crate::num::{Lanes, Number};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask};

/// Constants of the error bounds; the f32 shader has its own set, derived the same way.
#[derive(Debug, Clone, Copy)]
pub struct Precision {
    /// Unit roundoff u.
    pub unit: f64,
    /// Relative error of a, k, κ0, κ1 and the constants of a pair, in units.
    pub input: f64,
}

impl Precision {
    /// f64: a pair constant and a product ([`PAIR_ERROR`] + 2).
    pub const F64: Precision = Precision { unit: 1.0 / (1u64 << 53) as f64, input: PAIR_ERROR + 2.0 };
    /// f32: constants rounded once from f64, κ rounded once, one product: 3, and a little for the f64 errors below.
    #[cfg(feature = "gpu")]
    pub const F32: Precision = Precision { unit: 1.0 / (1u32 << 24) as f64, input: 4.0 };

    /// Γ of [`Bounds`].
    pub fn gamma(self) -> f64 {
        (self.input + 12.0) * self.unit
    }
    /// `3k` against 1: the input and one product.
    pub fn third(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// The discriminant: up to four inputs and eight operations a term.
    pub fn discriminant(self) -> f64 {
        (4.0 * self.input + 10.0) * self.unit
    }
    /// `s - κ` for a sine s, and their product: input and two operations.
    pub fn outer(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// `y = 3 - a x²` for `a x² <= 3`: (input + 2) 3 + 3 + 3 units, rounded up.
    pub fn eta(self) -> f64 {
        (6.0 * self.input + 16.0) * self.unit
    }
    /// F: the factor of `k y² + 2 k y (V + y)`, where `V = a x²`.
    pub fn residual(self) -> f64 {
        (self.input + 4.0) * self.unit
    }
    /// F: what does not depend on k: two subtractions of numbers up to 3, and x itself, however they are reassociated.
    pub fn residual_floor(self) -> f64 {
        10.0 * self.unit
    }
}

/// Verdicts of a vector of nodes, one bit a lane.
#[derive(Debug, Clone, Copy, Default)]
pub struct Planes {
    /// SOLVABLE, THEOREM31, THEOREM31_ANY, SPIRAL, ANY_SPIRAL.
    pub flags: [u64; 5],
    /// Number of roots, two bits.
    pub roots: [u64; 2],
    /// Number of spirals, two bits.
    pub spirals: [u64; 2],
    /// Lanes where something could not be proved.
    pub undecided: u64,
}

impl Planes {
    /// The code of one lane.
    #[inline(always)]
    pub fn code(&self, lane: usize) -> super::Code {
        if self.undecided >> lane & 1 == 1 {
            return super::Code::UNDECIDED;
        }
        let bit = |plane: u64, to: u32| ((plane >> lane & 1) << to) as u16;
        let flags = (0..5).fold(0, |sum, i| sum | bit(self.flags[i], i as u32));
        let counts = bit(self.roots[0], 8) | bit(self.roots[1], 9) | bit(self.spirals[0], 10) | bit(self.spirals[1], 11);
        super::Code(flags | counts)
    }
}

/// A pair of angles ready for [`classify`].
#[derive(Debug, Clone, Copy)]
pub struct Prepared {
    /// The constants.
    pub pair: Pair,
    /// Bounds of the φ0 side and of the φ1 side.
    pub bounds: (Bounds, Bounds),
}

impl Prepared {
    /// Adds the f64 bounds to a pair.
    pub fn new(pair: Pair) -> Prepared {
        Prepared { pair, bounds: Bounds::of_pair(&pair, Precision::F64.gamma()) }
    }
}

/// A vector of data: κ0, κ1 and the normalised a, k, each within [`Precision::input`].
#[derive(Debug, Clone, Copy)]
pub struct Data<S: Simd> {
    /// a = κ0 d0² / (4 sin φ0).
    pub a: S::f64s,
    /// k = κ1 d1² / (4 sin φ1).
    pub k: S::f64s,
    /// κ0.
    pub kappa0: S::f64s,
    /// κ1.
    pub kappa1: S::f64s,
}

#[inline(always)]
fn bits<S: Simd>(mask: S::mask64s) -> u64 {
    mask.to_bitmask()
}

/// How many roots the box (0, 3)² holds, from the signs of 3k - 1, 3a - 1 and the discriminant alone.
struct Cases {
    /// k > 1/3 and a > 1/3: one root, the smaller positive one.
    one: u64,
    /// k > 1/3, a < 1/3, positive discriminant: two.
    smaller_two: u64,
    /// k < 1/3, a > 1/3, positive discriminant: two.
    larger_two: u64,
    /// k < 1/3, a < 1/3, negative discriminant: one.
    lone: u64,
    /// k < 1/3, a < 1/3, positive discriminant: three.
    three: u64,
    /// Decided, whatever the case.
    known: u64,
}

/// Descartes' rule and the signs of F at 0 and √(3/a) give the count; see DESIGN.md, "Counting roots".
#[inline(always)]
fn cases<S: Simd>(simd: S, d: &Data<S>) -> Cases {
    let (a, k) = (d.a, d.k);
    const P: Precision = Precision::F64;
    let one = S::f64s::splat(simd, 1.0);
    let (above, below) = (one + P.third(), one - P.third());
    let (k3, a3) = (k * 3.0, a * 3.0);
    // Outside 2^±200 products might overflow; zero and negative values have no root.
    let (least, most) = (S::f64s::splat(simd, 2f64.powi(-200)), S::f64s::splat(simd, 2f64.powi(200)));
    let positive = bits::<S>(a.simd_ge(least) & a.simd_le(most) & k.simd_ge(least) & k.simd_le(most));
    let zero = S::f64s::splat(simd, 0.0);
    // One of κ and a is the datum, the other derived, which may have underflowed: both must say so.
    let rootless = bits::<S>((a.simd_le(zero) & d.kappa0.simd_le(zero)) | (k.simd_le(zero) & d.kappa1.simd_le(zero)));
    let (k_above, k_below) = (bits::<S>(k3.simd_gt(above)) & positive, bits::<S>(k3.simd_lt(below)) & positive);
    let (a_above, a_below) = (bits::<S>(a3.simd_gt(above)) & positive, bits::<S>(a3.simd_lt(below)) & positive);
    // 768 a²k² - 256 ak(a+k) + 96 ak - 1 has the sign of the discriminant of F.
    let ak = a * k;
    let (square, sum) = (ak * 768.0, (a + k) * 256.0);
    let discriminant = ak * (square - sum + 96.0) - one;
    let error = (ak * (square + sum + 96.0) + one) * P.discriminant();
    let (real, complex) = (bits::<S>(discriminant.simd_gt(error)), bits::<S>(discriminant.simd_lt(-error)));
    let case = Cases {
        one: k_above & a_above,
        smaller_two: k_above & a_below & real,
        larger_two: k_below & a_above & real,
        lone: k_below & a_below & complex,
        three: k_below & a_below & real,
        known: 0,
    };
    let none = complex & ((k_above & a_below) | (k_below & a_above)) | rootless;
    let known = case.one | case.smaller_two | case.larger_two | case.lone | case.three | none;
    Cases { known, ..case }
}

/// A root known to lie within `delta` of (x, y), in both coordinates.
#[derive(Clone, Copy)]
pub(super) struct Root<S: Simd> {
    pub x: S::f64s,
    pub y: S::f64s,
    pub delta: S::f64s,
    low: S::f64s,
    high: S::f64s,
    pub proved: u64,
}

/// `F = 3 - x - k y²` with its error, `y = 3 - a x²`, and `J = F' = 4akxy - 1`.
#[inline(always)]
fn residual<S: Simd>(simd: S, d: &Data<S>, x: S::f64s) -> (S::f64s, S::f64s, S::f64s, S::f64s) {
    const P: Precision = Precision::F64;
    let three = S::f64s::splat(simd, 3.0);
    let v = d.a * x * x;
    let y = three - v;
    let wide = y.abs() + P.eta();
    let kw = d.k * wide;
    // y is off by at most (input + 2) V + y units, x by 1, k by `input`; products and the final difference as counted in `Precision`.
    let error = (kw * wide + kw * (v + wide) * 2.0) * P.residual() + P.residual_floor();
    let slope = d.a * x * (d.k * y) * 4.0 - 1.0;
    ((three - x) - d.k * (y * y), error, y, slope)
}

/// Newton from `start`, then a proof: F has opposite certain signs at `x - δ` and `x + δ`, both inside the box.
#[inline(always)]
pub(super) fn root<S: Simd>(simd: S, d: &Data<S>, start: S::f64s, wanted: u64) -> Root<S> {
    const P: Precision = Precision::F64;
    const MOST_STEPS: u32 = 24;
    let mut x = start;
    for _ in 0..MOST_STEPS {
        let y = S::f64s::splat(simd, 3.0) - d.a * x * x;
        let ky = d.k * y;
        let step = ((S::f64s::splat(simd, 3.0) - x) - ky * y) / (d.a * x * ky * 4.0 - 1.0);
        x -= step;
        // The next error is the square of this step times F''/2F', usually below 100: under 2^-52 with this limit.
        if bits::<S>(step.abs().simd_lt(x * 2f64.powi(-30))) & wanted == wanted {
            break;
        }
    }
    let (_, error, y, slope) = residual(simd, d, x);
    // Any δ would do that the proof accepts; four times the error over the slope is one it usually does.
    let delta = error * 4.0 / slope.abs() + x * 2f64.powi(-50);
    let (low, high) = (x - delta, x + delta);
    let (f_low, e_low, _, _) = residual(simd, d, low);
    let (f_high, e_high, y_high, _) = residual(simd, d, high);
    let crossing = (f_low.simd_gt(e_low) & f_high.simd_lt(-e_high)) | (f_low.simd_lt(-e_low) & f_high.simd_gt(e_high));
    let zero = S::f64s::splat(simd, 0.0);
    let inside = low.simd_gt(zero) & high.simd_le(S::f64s::splat(simd, 3.0)) & y_high.simd_gt(S::f64s::splat(simd, P.eta()));
    let small = (delta * 64.0).simd_lt(x);
    // |y - y*| <= a (2x + δ) δ + η, and δ < x/64.
    let delta_y = d.a * x * delta * 2.1 + P.eta();
    Root { x, y, delta: (delta * 1.01).max(delta_y), low, high, proved: bits::<S>(crossing & inside & small) }
}

/// Three-valued conditions at a vector of roots.
struct Conditions {
    theorem: (u64, u64),
    /// H0 < 0 or H5 < 0: no spiral.
    bad_end: u64,
}

/// B0, B1, B2 of one side with their errors.
#[derive(Clone, Copy)]
pub(super) struct Side<S: Simd> {
    pub value: [S::f64s; 3],
    pub error: [S::f64s; 3],
}

/// The two sides of the spiral polynomial at a root; the second is already negated (H5, H4, H3 up to positive factors).
#[inline(always)]
pub(super) fn sides<S: Simd>(simd: S, prepared: &Prepared, root: &Root<S>) -> (Side<S>, Side<S>) {
    let pair = &prepared.pair;
    let n = |value: f64| Lanes::<S>::splat(simd, value);
    let (x, y) = (Lanes::<S>(root.x), Lanes::<S>(root.y));
    let start = side(&x, &y, &n(pair.p), &n(pair.g0), &n(pair.r));
    let end = side(&y, &x, &n(pair.r), &n(pair.g1), &n(pair.p));
    let error = |b: &Bounds| {
        let of = |i: usize| root.delta * b.slope[i] + b.rounding[i];
        [of(0), of(1), of(2)]
    };
    (
        Side { value: start.map(|v| v.0), error: error(&prepared.bounds.0) },
        Side { value: end.map(|v| v.times(-1.0).0), error: error(&prepared.bounds.1) },
    )
}

/// `B0 >= 0, B2 >= 0, B1 + √(8 w B0 B2) >= 0`, one half of Theorem 3.1 divided by positive factors: (yes, no, B0 < 0).
#[inline(always)]
fn half_theorem<S: Simd>(side: &Side<S>, w: S::f64s, delta: S::f64s) -> (u64, u64, u64) {
    const U: f64 = Precision::F64.unit;
    let [b0, b1, b2] = side.value;
    let [e0, e1, e2] = side.error;
    let product = b0 * b2;
    // The root's inequality, squared: certain only where the signs under it are, which the first two conditions see to.
    let over = product * w * 8.0 - b1 * b1;
    let error = ((b0.abs() * e2 + b2.abs() * e0 + e0 * e2) * (w + delta) + product.abs() * delta) * 8.1
        + (b1.abs() * 2.0 + e1) * e1
        + (product.abs() * w * 8.0 + b1 * b1) * (16.0 * U);
    let middle_yes = b1.simd_gt(e1) | over.simd_gt(error);
    let middle_no = b1.simd_lt(-e1) & over.simd_lt(-error);
    let yes = b0.simd_gt(e0) & b2.simd_gt(e2) & middle_yes;
    let bad_end = b0.simd_lt(-e0);
    let no = bad_end | b2.simd_lt(-e2) | middle_no;
    (bits::<S>(yes), bits::<S>(no), bits::<S>(bad_end))
}

#[inline(always)]
fn conditions<S: Simd>(start: &Side<S>, end: &Side<S>, root: &Root<S>) -> Conditions {
    let (yes0, no0, bad0) = half_theorem(start, root.y, root.delta);
    let (yes1, no1, bad1) = half_theorem(end, root.x, root.delta);
    Conditions { theorem: (yes0 & yes1, no0 | no1), bad_end: bad0 | bad1 }
}

/// The Bernstein coefficients of the spiral polynomial (times 5) in one lane, and how far each may be off.
///
/// `b = (5y²B0, yB1, yB2, xC2, xC1, 5x²C0)`: the binomials of degree 5 divide `H_i`.
pub(super) fn bernstein<S: Simd>(start: &Side<S>, end: &Side<S>, root: &Root<S>, lane: usize) -> (Quintic<f64>, f64) {
    let at = |v: &S::f64s| v.as_slice()[lane];
    let (x, y, delta) = (at(&root.x), at(&root.y), at(&root.delta));
    let half = |side: &Side<S>, w: f64| {
        let (b, e) = (side.value.map(|v| at(&v)), side.error.map(|v| at(&v)));
        let c = [5.0 * w * w * b[0], w * b[1], w * b[2]];
        let near = w + delta;
        let error = [
            5.0 * (near * near * e[0] + (w + near) * delta * b[0].abs()),
            near * e[1] + delta * b[1].abs(),
            near * e[2] + delta * b[2].abs(),
        ];
        // Up to four roundings a coefficient.
        let worst = (0..3).fold(0.0f64, |worst, i| worst.max(error[i] * 1.01 + 4.0 * Precision::F64.unit * c[i].abs()));
        (c, worst)
    };
    let ((b, e0), (c, e1)) = (half(start, y), half(end, x));
    ([b[0], b[1], b[2], c[2], c[1], c[0]], e0.max(e1))
}

/// [`positive`] with the f64 bounds: halving a dozen times reaches features of width 2^-20 of the segment.
pub(super) fn spiral(c: &Quintic<f64>, error: f64) -> Option<bool> {
    const DEPTH: u32 = 20;
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    positive(c, error, 5.0 * Precision::F64.unit * (largest + error), DEPTH)
}

/// Where Newton starts for the (up to three) roots by increasing x: left, at F's inflection, right.
///
/// F is convex before 1/√a and concave after, so from these starts Newton's method is monotone.
#[inline(always)]
fn starts<S: Simd>(simd: S, d: &Data<S>, case: &Cases) -> [(S::f64s, u64); 3] {
    let (left, right) = (S::f64s::splat(simd, 0.0), S::f64s::splat(simd, 3.0));
    let middle = S::f64s::splat(simd, 1.0) / d.a.sqrt();
    let lone_right = {
        let bend = middle.min(right);
        let (f, _, _, _) = residual(simd, d, bend);
        S::mask64s::from_bitmask(simd, case.lone) & f.simd_gt(left)
    };
    let from_middle = S::mask64s::from_bitmask(simd, case.one | case.smaller_two);
    let first = from_middle.select(middle, lone_right.select(right, left));
    let second = S::mask64s::from_bitmask(simd, case.smaller_two).select(right, middle);
    let (two, three) = (case.smaller_two | case.larger_two, case.three);
    [(first, case.one | two | case.lone | three), (second, two | three), (right, three)]
}

/// Adds one bit a lane to a two-bit counter.
#[inline(always)]
fn count(counter: &mut [u64; 2], bit: u64) {
    counter[1] |= counter[0] & bit;
    counter[0] ^= bit;
}

/// What is known of one root in a vector, for callers that want more than codes.
pub(super) struct Found<'r, S: Simd> {
    pub root: &'r Root<S>,
    pub start: &'r Side<S>,
    pub end: &'r Side<S>,
    /// Lanes that have this root.
    pub wanted: u64,
    /// Lanes where Theorem 3.1 accepts it.
    pub theorem: u64,
    /// Lanes where its curve is a spiral.
    pub spirals: u64,
}

/// Classifies a vector of data of one pair of angles.
#[inline(always)]
pub fn classify<S: Simd>(simd: S, prepared: &Prepared, d: &Data<S>) -> Planes {
    // Without any spiral the counts say all, so the roots need not be found.
    visit::<S, false>(simd, prepared, d, |_| {})
}

/// [`classify`], showing each root to `seen`; with `ALL` also those of data that no spiral fits.
#[inline(always)]
pub(super) fn visit<S: Simd, const ALL: bool>(
    simd: S,
    prepared: &Prepared,
    d: &Data<S>,
    mut seen: impl FnMut(Found<'_, S>),
) -> Planes {
    let all = if S::f64s::LEN == 64 { u64::MAX } else { (1 << S::f64s::LEN) - 1 };
    let case = cases(simd, d);
    let pair = &prepared.pair;
    let (any, no) = match pair.rising {
        true => outer::lanes(simd, &[pair.sin0, pair.sin1, pair.sin2_half], d.kappa0, d.kappa1, Precision::F64.outer()),
        false => (0, all),
    };
    let two = case.smaller_two | case.larger_two;
    let mut planes = Planes {
        flags: [case.one | case.smaller_two, 0, 0, 0, any],
        roots: [case.one | case.lone | case.three, two | case.three],
        spirals: [0, 0],
        undecided: all & !(case.known & (any | no)),
    };
    let open = if ALL { all } else { any } & !planes.undecided;
    let mut below = S::f64s::splat(simd, 0.0);
    for (slot, (start, lanes)) in starts(simd, d, &case).into_iter().enumerate() {
        let wanted = lanes & open;
        if wanted == 0 {
            break;
        }
        let root = root(simd, d, start, wanted);
        // As many disjoint proved intervals as there are roots: each holds exactly one.
        let apart = bits::<S>(root.low.simd_gt(below));
        below = root.high;
        let proved = root.proved & apart & wanted;
        planes.undecided |= wanted & !proved;
        let (start, end) = sides(simd, prepared, &root);
        let known = conditions(&start, &end, &root);
        let theorem = known.theorem.0 & proved & any;
        let mut spirals = theorem;
        let mut not_spirals = known.bad_end | no;
        let mut unclear = proved & !theorem & !not_spirals;
        while unclear != 0 {
            let lane = unclear.trailing_zeros() as usize;
            unclear &= unclear - 1;
            let (c, error) = bernstein(&start, &end, &root, lane);
            match spiral(&c, error) {
                Some(true) => spirals |= 1 << lane,
                Some(false) => not_spirals |= 1 << lane,
                None => {}
            }
        }
        // Theorem 3.1 is sufficient: no spiral, no theorem.
        planes.undecided |= wanted & !((theorem | known.theorem.1 | not_spirals) & (spirals | not_spirals));
        if slot == 0 {
            planes.flags[1] = theorem & planes.flags[0];
        }
        planes.flags[2] |= theorem;
        planes.flags[3] |= spirals;
        count(&mut planes.spirals, spirals);
        seen(Found { root: &root, start: &start, end: &end, wanted, theorem, spirals });
    }
    planes
}
