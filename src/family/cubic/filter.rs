//! The f64 step: classifies a vector of nodes that share their angles, with proof, or leaves them undecided.
//!
//! Guesses (Newton's method, division, square roots) only choose where to look. What is stored rests on `+ - *` with
//! these bounds, in units of u = 2^-53. The shader of `shaders/cubic/` does the same in f32, function by function.

use super::precision::{Precision, Prepared, ROUNDINGS, THROUGH};
use super::root::{Data, Root, Side, bernstein, residual, root, sides};
use super::{ANY_SPIRAL, FLAGS, SOLVABLE, SPIRAL, THEOREM31, THEOREM31_ANY};
use crate::family::outer;
use crate::family::rows::bits;
use crate::num::Verdict;
use crate::num::bernstein::{Quintic, positive};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask};

/// Verdicts of a vector of nodes, one bit a lane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Planes {
    /// By bit.
    pub flags: [u64; FLAGS.len()],
    /// Number of roots, two bits.
    pub roots: [u64; 2],
    /// Number of spirals, two bits.
    pub spirals: [u64; 2],
    /// Lanes where something could not be proved.
    pub undecided: u64,
}

impl Planes {
    /// Adds the root of a place, slot 0 being the one that Theorem 3.1 is about: lanes where the theorem accepts it,
    /// and where it is a spiral.
    #[inline(always)]
    pub(super) fn add(&mut self, slot: usize, theorem: u64, spirals: u64) {
        if slot == 0 {
            self.flags[bit(THEOREM31)] = theorem & self.flags[bit(SOLVABLE)];
        }
        self.flags[bit(THEOREM31_ANY)] |= theorem;
        self.flags[bit(SPIRAL)] |= spirals;
        self.spirals[1] |= self.spirals[0] & spirals;
        self.spirals[0] ^= spirals;
    }
}

/// The place of a flag.
pub(super) const fn bit(flag: u8) -> usize {
    flag.trailing_zeros() as usize
}

/// Bit l of a byte as the lowest bit of byte l: a plane of eight lanes, spread over their codes.
const SPREAD: [u64; 256] = {
    let mut table = [0; 256];
    let mut plane = 0;
    while plane < 256 {
        let mut lane = 0;
        while lane < 8 {
            table[plane] |= ((plane as u64 >> lane) & 1) << (8 * lane);
            lane += 1;
        }
        plane += 1;
    }
    table
};

impl Planes {
    /// Writes the codes of the first lanes, at most eight.
    #[inline(always)]
    pub(super) fn store(&self, codes: &mut [super::Code]) {
        let spread = |plane: u64| SPREAD[(plane & 0xff) as usize];
        let undecided = spread(self.undecided) * 0xff;
        let flags = (0..FLAGS.len()).fold(undecided, |bytes, i| bytes | spread(self.flags[i]) << i);
        let counts = [self.roots[0], self.roots[1], self.spirals[0], self.spirals[1]];
        let counts = (0..4).fold(undecided, |bytes, i| bytes | spread(counts[i]) << i);
        for (code, (flags, counts)) in codes.iter_mut().zip(flags.to_le_bytes().into_iter().zip(counts.to_le_bytes())) {
            *code = super::Code::new(flags, counts);
        }
    }
}

/// How many roots the box (0, 3)² holds, from the signs of 3k - 1, 3a - 1 and the discriminant alone.
pub(super) struct Cases {
    /// k > 1/3 and a > 1/3: one root, the smaller positive one.
    pub one: u64,
    /// k > 1/3, a < 1/3, positive discriminant: two.
    pub smaller_two: u64,
    /// k < 1/3, a > 1/3, positive discriminant: two.
    pub larger_two: u64,
    /// k < 1/3, a < 1/3, negative discriminant: one.
    pub lone: u64,
    /// k < 1/3, a < 1/3, positive discriminant: three.
    pub three: u64,
    /// One of k and a above 1/3, the other below, negative discriminant: none.
    pub none: u64,
    /// A curvature is not positive: none either.
    pub rootless: u64,
}

/// Descartes' rule and the signs of F at 0 and √(3/a) give the count; see the documentation of the module, "Counting
/// roots".
#[inline(always)]
pub(super) fn cases<S: Simd>(simd: S, d: &Data<S>) -> Cases {
    let (a, k) = (d.a, d.k);
    let precision = d.precision;
    let one = S::f64s::splat(simd, 1.0);
    let (above, below) = (one + precision.third(), one - precision.third());
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
    let error = (ak * (square + sum + 96.0) + one) * precision.discriminant();
    let (real, complex) = (bits::<S>(discriminant.simd_gt(error)), bits::<S>(discriminant.simd_lt(-error)));
    Cases {
        one: k_above & a_above,
        smaller_two: k_above & a_below & real,
        larger_two: k_below & a_above & real,
        lone: k_below & a_below & complex,
        three: k_below & a_below & real,
        none: complex & ((k_above & a_below) | (k_below & a_above)),
        rootless,
    }
}

impl Cases {
    /// Lanes that are decided, whatever the case.
    #[inline(always)]
    pub(super) fn known(&self) -> u64 {
        self.one | self.smaller_two | self.larger_two | self.lone | self.three | self.none | self.rootless
    }

    /// What the case alone decides: SOLVABLE and the number of roots.
    #[inline(always)]
    pub(super) fn planes(&self) -> Planes {
        let mut planes = Planes::default();
        let two = self.smaller_two | self.larger_two;
        planes.flags[bit(SOLVABLE)] = self.one | self.smaller_two;
        planes.roots = [self.one | self.lone | self.three, two | self.three];
        planes
    }
}

/// Three-valued conditions at a vector of roots.
struct Conditions {
    theorem: (u64, u64),
    /// H0 < 0 or H5 < 0: no spiral.
    bad_end: u64,
}

/// `B0 >= 0, B2 >= 0, B1 + √(8 w B0 B2) >= 0`, one half of Theorem 3.1 divided by positive factors: (yes, no, B0 < 0).
#[inline(always)]
fn half_theorem<S: Simd>(side: &Side<S>, w: S::f64s, delta: S::f64s) -> (u64, u64, u64) {
    const U: f64 = Precision::F64.unit;
    let [b0, b1, b2] = side.value;
    let [e0, e1, e2] = side.error;
    let product = b0 * b2;
    // The root's inequality, squared. It follows only where B0 and B2 are not negative. Where one of them is, this half
    // fails anyway: so "no" is right, and "yes" asks for both signs.
    let over = product * w * 8.0 - b1 * b1;
    let error = ((b0.abs() * e2 + b2.abs() * e0 + e0 * e2) * (w + delta) + product.abs() * delta) * THROUGH
        + (b1.abs() * 2.0 + e1) * e1
        + (product.abs() * w * 8.0 + b1 * b1) * (ROUNDINGS * U);
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

/// Lanes whose spiral polynomial is certainly negative at s = 1/2, 1 or 2: most of those that are no spirals, without
/// halving.
///
/// Each coefficient `H_i` carries what its B and its root may be off; three products and Horner's ten operations add
/// less than 16 units.
#[inline(always)]
fn dips<S: Simd>(simd: S, start: &Side<S>, end: &Side<S>, root: &Root<S>) -> u64 {
    let ([h0, h1, h2], [h5, h4, h3]) = (dipping::<S>(start, root.y, root.delta), dipping::<S>(end, root.x, root.delta));
    let polynomial = [h0, h1, h2, h3, h4, h5];
    negative::<S>(simd, &polynomial, 0.5)
        | negative::<S>(simd, &polynomial, 1.0)
        | negative::<S>(simd, &polynomial, 2.0)
}

/// One half of the coefficients, with errors.
// A function, as all that runs on vectors here: a closure is not always inlined into code for a wider level, and then
// every vector operation becomes a call.
#[inline(always)]
fn dipping<S: Simd>(side: &Side<S>, w: S::f64s, delta: S::f64s) -> [(S::f64s, S::f64s); 3] {
    let mut terms = side.weighed(w, delta);
    terms[2] = (terms[2].0 * 2.0, terms[2].1 * 2.0);
    for (h, e) in &mut terms {
        *e += h.abs() * (ROUNDINGS * Precision::F64.unit);
    }
    terms
}

/// Lanes where the polynomial is certainly negative at s > 0.
#[inline(always)]
fn negative<S: Simd>(simd: S, polynomial: &[(S::f64s, S::f64s); 6], s: f64) -> u64 {
    let (mut value, mut bound) = polynomial[5];
    for (h, e) in polynomial[..5].iter().rev() {
        value = value * s + *h;
        bound = bound * s + *e;
    }
    bits::<S>(value.simd_lt(S::f64s::splat(simd, 0.0) - bound))
}

/// [`positive`] with the f64 bounds: twenty halvings reach features of 2^-20 of the segment, finer than the bounds
/// show.
pub(super) fn spiral(c: &Quintic<f64>, error: f64) -> Verdict {
    const DEPTH: u32 = 20;
    let largest = c.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    positive(c, error, 5.0 * Precision::F64.unit * (largest + error), DEPTH)
}

/// Where Newton starts for the (up to three) roots by increasing x: left, at F's inflection, right.
///
/// F is convex before 1/√a and concave after, so from these starts Newton's method is monotone.
#[inline(always)]
pub(super) fn starts<S: Simd>(simd: S, d: &Data<S>, case: &Cases) -> [(S::f64s, u64); 3] {
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

/// What is known of one root in a vector, for callers that want more than codes.
pub(super) struct RootLanes<'r, S: Simd> {
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
pub(super) fn classify<S: Simd>(simd: S, prepared: &Prepared, d: &Data<S>) -> Planes {
    // Without any spiral the counts say all, so the roots need not be found.
    visit::<S, false>(simd, prepared, d, |_| {})
}

/// [`classify`], showing each root to `seen`; with `ALL` also those of data that no spiral fits.
#[inline(always)]
pub(super) fn visit<S: Simd, const ALL: bool>(
    simd: S,
    prepared: &Prepared,
    d: &Data<S>,
    mut seen: impl FnMut(RootLanes<'_, S>),
) -> Planes {
    const { assert!(S::f64s::LEN <= 8, "a plane is a byte") };
    let all = (1 << S::f64s::LEN) - 1;
    let case = cases(simd, d);
    let pair = &prepared.pair;
    let (any, no) = match pair.rising {
        true => outer::lanes(simd, &[pair.sin0, pair.sin1, pair.sin2_half], d.kappa0, d.kappa1, d.precision.outer()),
        false => (0, all),
    };
    let mut planes = case.planes();
    planes.flags[bit(ANY_SPIRAL)] = any;
    planes.undecided = all & !(case.known() & (any | no));
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
        if proved & !theorem & !not_spirals != 0 {
            not_spirals |= dips(simd, &start, &end, &root) & proved & !theorem;
        }
        let mut unclear = proved & !theorem & !not_spirals;
        while unclear != 0 {
            let lane = unclear.trailing_zeros() as usize;
            unclear &= unclear - 1;
            let (c, error) = bernstein(&start, &end, &root, lane);
            match spiral(&c, error) {
                Verdict::Yes => spirals |= 1 << lane,
                Verdict::No => not_spirals |= 1 << lane,
                Verdict::Undecided => {}
            }
        }
        // Theorem 3.1 is sufficient: no spiral, no theorem.
        planes.undecided |= wanted & !((theorem | known.theorem.1 | not_spirals) & (spirals | not_spirals));
        planes.add(slot, theorem, spirals);
        seen(RootLanes { root: &root, start: &start, end: &end, wanted, theorem, spirals });
    }
    planes
}
