//! Codes over blocks of a dense grid: boxes in the last two coordinates at one pair of angles, a block in each lane.
//!
//! What is proved holds at all real points of the closed block. It rests on the same facts as the proofs over boxes in
//! four coordinates (`region`), whose documentation derives them; here are those that fixed angles make simpler.
//!
//! **ANY_SPIRAL** falls with κ0 and rises with κ1 (`outer.rs`: both factors only grow on the way), so two corners
//! decide it.
//!
//! **Cases.** For a, k > 0 the double roots in the square are the curve `a = 1/(x(4 - x))`, `k = (4 - x)²/(16(3 - x))`
//! for 0 < x < 3: F' = 0 is `4akxy = 1`, which with the two parabolas is `4(3 - x)(3 - y) = xy`, so `y = 4(3 - x)/(4 -
//! x)`. Both a and k fall up to x = 2 and rise from there on. So two rising branches start at the cusp a = k = 1/4.
//! One, up to x = 2, is `k = A(a)`, from 1/4 to 1/3; the other is `a = A(k)`. With A = 1/4 below 1/4, the middle root
//! exists exactly when `k > A(a)` and `a > A(k)`, in the wedge between the branches. For it is the root with F' > 0. It
//! cannot leave the square, since F' = -1 where x = 0 or y = 0, and it can vanish only by meeting another root, on the
//! curve. So it exists everywhere or nowhere in the wedge, and likewise outside; it does at a = k = 1 (x = y, 2ax > 1),
//! and it does not at a = k = 1/8 (Δ < 0, one root). A does not fall. So a block has it everywhere when its corners
//! (least a, greatest k) and (greatest a, least k) have it. Outside the wedge, where a > k it is the first condition
//! that fails, since `A(t) <= max(t, 1/4)`: along the curve the derivative of `ln(k/a)` by x is `3(x - 2)²` over
//! positive factors, and k = a at x = 2. It fails in the whole block when it does so at (least a, greatest k). Likewise
//! with a and k exchanged.
//!
//! **Roots** are enclosed as in `region/root.rs`, by forms of second order in the two coordinates of the block.
//!
//! **B0, B1, B2** at these forms are those of `surface.rs`.

use super::filter::{Cases, Planes, bit, cases, starts};
use super::pair::Pair;
use super::poly::side;
use super::precision::{Precision, Prepared};
use super::root::{Data, settle};
use super::surface::{Spread, Surface};
use super::table::CubicTable;
use super::{ANY_SPIRAL, Code};
use crate::family::blocks::Blocks;
use crate::family::outer;
use crate::family::rows::bits;
use crate::num::{COVER, FormLanes, Number, formula, halve_forms};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};

/// Unit roundoff.
const UNIT: f64 = Precision::F64.unit;

/// Rounds in which an enclosure may grow.
const ROUNDS: u32 = 6;
/// Halvings of a quintic at most, by all lanes together.
const MOST_HALVINGS: u32 = 6;
/// Where the least value of a quintic is sought, as t / (1 - t).
const PLACES: [f64; 7] = [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0];

/// What the blocks of one pair of angles share.
pub(super) struct Plane {
    pair: Pair,
    /// B0, B1, B2 of the start, and those of the end with the other sign.
    sides: [[Surface; 3]; 2],
}

impl Plane {
    fn new(pair: &Pair) -> Plane {
        let (x, y) = (Surface::symbol(1), Surface::symbol(2));
        let [p, r, g0, g1] = [pair.p, pair.r, pair.g0, pair.g1].map(Surface::constant);
        let end = side(&y, &x, &r, &g1, &p).map(|b| b.times(-1.0));
        Plane { pair: *pair, sides: [side(&x, &y, &p, &g0, &r), end] }
    }
}

/// A root of a vector of blocks.
struct Root<S: Simd> {
    x: FormLanes<S>,
    y: FormLanes<S>,
    proved: u64,
}

/// Which root is meant, by lanes, where it is not the middle one: see `region`.
struct Which {
    left: u64,
    right: u64,
    lone: u64,
}

impl Blocks for CubicTable<'_> {
    const LEAST: usize = 32;
    const FIRST: usize = 32;
    const LEAF: usize = 32;
    type Plane = Plane;

    fn plane(&self, prepared: &Prepared) -> Option<Plane> {
        Some(Plane::new(&prepared.pair))
    }

    #[inline(always)]
    fn codes_on<S: Simd>(&self, simd: S, plane: &Plane, third: [S::f64s; 2], fourth: [S::f64s; 2], out: &mut [Code]) {
        let pair = &plane.pair;
        let all = (1 << S::f64s::LEN) - 1;
        let early = self.data(simd, pair, third[0], fourth[1]);
        let late = self.data(simd, pair, third[1], fourth[0]);
        let mut case = case_of(simd, &early, &late);
        let (any, no) = if pair.rising {
            let sines = [pair.sin0, pair.sin1, pair.sin2_half];
            let least = outer::lanes(simd, &sines, late.kappa0, late.kappa1, Precision::F64.outer()).0;
            (least, outer::lanes(simd, &sines, early.kappa0, early.kappa1, Precision::F64.outer()).1)
        } else {
            (0, all)
        };
        let mut planes = case.planes();
        planes.flags[bit(ANY_SPIRAL)] = any;
        planes.undecided = all & !(case.known() & (any | no));
        let open = any & !planes.undecided;
        if open != 0 && planes.roots != [0; 2] {
            // Where the cases differ, nothing is asked.
            for mask in [&mut case.one, &mut case.smaller_two, &mut case.larger_two, &mut case.lone, &mut case.three] {
                *mask &= open;
            }
            let forms = [range(simd, [early.a, late.a], 0), range(simd, [late.k, early.k], 1)];
            let middle = Data { a: forms[0].value, k: forms[1].value, ..early };
            roots(simd, plane, &middle, &forms, &case, &mut planes);
        }
        planes.store(out);
    }
}

/// The case that all data of a block have, from those at (least a, greatest k) and (greatest a, least k).
#[inline(always)]
fn case_of<S: Simd>(simd: S, early: &Data<S>, late: &Data<S>) -> Cases {
    let (first, last) = (cases(simd, early), cases(simd, late));
    let zero = S::f64s::splat(simd, 0.0);
    // A little less: numbers are known to less than 2^-45, relative.
    const LESS: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;
    let quarter = S::f64s::splat(simd, 0.25 * LESS);
    let flat = bits::<S>((early.a * LESS).simd_gt(early.k));
    let steep = bits::<S>((late.k * LESS).simd_gt(late.a));
    let outside = flat | steep | bits::<S>(late.a.simd_lt(quarter) | early.k.simd_lt(quarter));
    let rootless =
        (late.a.simd_le(zero) & late.kappa0.simd_le(zero)) | (early.k.simd_le(zero) & early.kappa1.simd_le(zero));
    Cases {
        one: first.one & last.one,
        smaller_two: first.smaller_two & last.smaller_two,
        larger_two: first.larger_two & last.larger_two,
        lone: first.lone & last.lone & outside,
        three: first.three & last.three,
        none: first.none & flat | last.none & steep,
        rootless: bits::<S>(rootless),
    }
}

/// All numbers between two, both positive and known to [`Precision::input`], as a linear form of a symbol.
///
/// The symbol is the number's own place, so nothing is left for an error.
#[inline(always)]
fn range<S: Simd>(simd: S, [low, high]: [S::f64s; 2], symbol: usize) -> FormLanes<S> {
    let mut form = FormLanes::exact(simd, (low + high) * 0.5);
    // Twice the input, for roundings here.
    form.slope[symbol] = (high - form.value).max(form.value - low) + high * (2.0 * Precision::F64.input * UNIT);
    form
}

/// What is known of all roots of the open lanes.
#[inline(always)]
fn roots<S: Simd>(
    simd: S,
    plane: &Plane,
    middle: &Data<S>,
    forms: &[FormLanes<S>; 2],
    case: &Cases,
    planes: &mut Planes,
) {
    let none = Which { left: 0, right: 0, lone: 0 };
    let which = [
        Which { left: case.larger_two | case.three, lone: case.lone, ..none },
        Which { right: case.smaller_two, ..none },
        Which { right: case.three, ..none },
    ];
    let starts = starts(simd, middle, case);
    for (slot, which) in which.iter().enumerate() {
        let (start, lanes) = starts[slot];
        let wanted = lanes & !planes.undecided;
        if wanted == 0 {
            break;
        }
        let root = enclose(simd, middle, forms, start, which, wanted);
        let (theorem, spirals, known) = judge(simd, plane, &root, wanted & root.proved);
        planes.undecided |= wanted & !known;
        planes.add(slot, theorem, spirals);
    }
}

/// The root near which Newton's method ends, over the whole block; see `region/root.rs`.
#[inline(always)]
fn enclose<S: Simd>(
    simd: S,
    middle: &Data<S>,
    [a, k]: &[FormLanes<S>; 2],
    start: S::f64s,
    which: &Which,
    wanted: u64,
) -> Root<S> {
    let (one, zero) = (S::f64s::splat(simd, 1.0), S::f64s::splat(simd, 0.0));
    let x0 = settle(simd, middle, start, wanted);
    let (a0, k0, a1, k1) = (a.value, k.value, a.slope[0], k.slope[1]);
    let y0 = S::f64s::splat(simd, 3.0) - a0 * x0 * x0;
    let (ax, ky) = (a0 * x0 * 2.0, k0 * y0 * 2.0);
    let inverse = one / (one - ax * ky);
    let (da, dk) = (x0 * x0 * a1 * inverse, y0 * y0 * k1 * inverse);
    let (mut x, mut y) = (FormLanes::exact(simd, x0), FormLanes::exact(simd, y0));
    x.slope = [ky * da, zero - dk];
    y.slope = [zero - da, ax * dk];
    let [xa, xk] = x.slope;
    let [ya, yk] = y.slope;
    let w1 = [a0 * xa * xa + x0 * a1 * xa * 2.0, (a0 * xa + x0 * a1) * xk * 2.0, a0 * xk * xk];
    let w2 = [k0 * ya * ya, (k0 * yk + y0 * k1) * ya * 2.0, k0 * yk * yk + y0 * k1 * yk * 2.0];
    for i in 0..3 {
        x.bend[i] = (ky * w1[i] - w2[i]) * inverse;
        y.bend[i] = (ax * w2[i] - w1[i]) * inverse;
    }
    let (ax, ky) = (a.mul(&x), k.mul(&y));
    let (axx, kyy) = (ax.mul(&x), ky.mul(&y));
    let (first, second) = (formula!(3.0 - (axx + y)).most(), formula!(3.0 - (kyy + x)).most());
    let slope = formula!(ax * ky * -4.0 + 1.0);
    let (low, high) = (slope.low(), slope.high());
    let least = low.max(zero - high);
    let (alpha, beta, a_most, k_most) = (ax.most() * 2.0, ky.most() * 2.0, a.most(), k.most());
    let (mut e, mut f) = (zero, zero);
    let mut held = 0;
    for _ in 0..ROUNDS {
        let (own, its) = (first + a_most * e * e, second + k_most * f * f);
        let (next_e, next_f) = ((its + beta * own) / least * COVER, (own + alpha * its) / least * COVER);
        held = bits::<S>(next_e.simd_le(e) & next_f.simd_le(f) & least.simd_gt(zero));
        if held & wanted == wanted {
            break;
        }
        // Lanes that are held stay: a larger rectangle may not be taken into itself.
        let keep = S::mask64s::from_bitmask(simd, held);
        e = keep.select(e, next_e * 1.1 + f64::MIN_POSITIVE);
        f = keep.select(f, next_f * 1.1 + f64::MIN_POSITIVE);
    }
    // How much 4akxy and its like change within the rectangle.
    let moved = (alpha * k_most * f + beta * a_most * e + a_most * k_most * e * f * 2.0) * (2.0 * COVER);
    let rises = bits::<S>((zero - high).simd_gt(moved));
    let falls = bits::<S>(low.simd_gt(moved));
    let (x, y) = (x.off(e), y.off(f));
    let left = (axx.high() + (alpha * e + a_most * e * e) * COVER).simd_lt(one);
    let right = (kyy.high() + (beta * f + k_most * f * f) * COVER).simd_lt(one);
    let named = (which.left & bits::<S>(left)) | (which.right & bits::<S>(right)) | which.lone;
    let inside = bits::<S>(x.low().simd_gt(zero));
    let bent = which.left | which.right | which.lone;
    let proved = held & ((falls & named) | (rises & inside & !bent));
    Root { x, y, proved }
}

/// Lanes where Theorem 3.1 accepts the root everywhere, where its curve is a spiral everywhere, and where both are
/// known.
#[inline(always)]
fn judge<S: Simd>(simd: S, plane: &Plane, root: &Root<S>, wanted: u64) -> (u64, u64, u64) {
    let Root { x, y, .. } = root;
    let spread = Spread {
        x,
        y,
        linear: [x.linear(), y.linear()],
        rest: [(x.curved() + x.error) * COVER, (y.curved() + y.error) * COVER],
        most: [x.most(), y.most()],
    };
    let (start, end) = (on_side(simd, &plane.sides[0], &spread), on_side(simd, &plane.sides[1], &spread));
    let ((yes0, no0, bad0), (yes1, no1, bad1)) = (half(simd, &start, y), half(simd, &end, x));
    let (theorem, no_theorem) = (yes0 & yes1 & wanted, (no0 | no1) & wanted);
    let (mut spirals, mut not_spirals) = (theorem, (bad0 | bad1) & wanted);
    let open = wanted & !(spirals | not_spirals);
    if open != 0 {
        let quintic = [
            y.mul(&y.mul(&start[0])).times(5.0),
            y.mul(&start[1]),
            y.mul(&start[2]),
            x.mul(&end[2]),
            x.mul(&end[1]),
            x.mul(&x.mul(&end[0])).times(5.0),
        ];
        let (yes, no) = unit_signs(simd, &quintic, open);
        spirals |= yes;
        not_spirals |= no;
    }
    (theorem, spirals, (theorem | no_theorem | not_spirals) & (spirals | not_spirals))
}

#[inline(always)]
fn on_side<S: Simd>(simd: S, side: &[Surface; 3], root: &Spread<S>) -> [FormLanes<S>; 3] {
    [side[0].on(simd, root), side[1].on(simd, root), side[2].on(simd, root)]
}

/// Lanes where a form is positive everywhere, and where it is negative everywhere.
#[inline(always)]
fn sign<S: Simd>(simd: S, form: &FormLanes<S>) -> (u64, u64) {
    let zero = S::f64s::splat(simd, 0.0);
    (bits::<S>(form.low().simd_gt(zero)), bits::<S>(form.high().simd_lt(zero)))
}

/// Lanes where one half of Theorem 3.1 holds everywhere, where it fails everywhere, and where `B0 < 0` everywhere.
#[inline(always)]
fn half<S: Simd>(simd: S, b: &[FormLanes<S>; 3], w: &FormLanes<S>) -> (u64, u64, u64) {
    let ((p0, n0), (p1, n1), (p2, n2)) = (sign(simd, &b[0]), sign(simd, &b[1]), sign(simd, &b[2]));
    let (mut middle, mut no) = (p1, n0 | n2);
    if p0 & p2 & !p1 != 0 {
        let [b0, b1, b2] = b;
        let (over, under) = sign(simd, &formula!(8.0 * (b0 * b2 * w) - b1 * b1));
        middle |= over;
        no |= n1 & under;
    }
    (p0 & p2 & middle, no, n0)
}

/// Lanes where a quintic is positive on [0, 1] all over the block, and where it is negative somewhere at each place.
#[inline(always)]
fn unit_signs<S: Simd>(simd: S, c: &[FormLanes<S>; 6], wanted: u64) -> (u64, u64) {
    const BINOMIALS: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
    let zero = S::f64s::splat(simd, 0.0);
    // Where the quintic of the middle is least, at `t / (1 - t) = s`, of a few places.
    let (mut least, mut s) = (S::f64s::splat(simd, f64::INFINITY), S::f64s::splat(simd, 1.0));
    for place in PLACES {
        let mut value = zero;
        for i in (0..6).rev() {
            value = value * place + c[i].value * BINOMIALS[i];
        }
        value *= (1.0 + place).powi(-5);
        let lower = value.simd_lt(least);
        least = lower.select(value, least);
        s = lower.select(S::f64s::splat(simd, place), s);
    }
    let mut sum = c[5];
    for i in (0..5).rev() {
        sum = sum.scaled(s).add(&c[i].times(BINOMIALS[i]));
    }
    let no = bits::<S>(sum.high().simd_lt(zero)) & wanted;
    let mut open = wanted & bits::<S>(sum.low().simd_gt(zero));
    let mut waiting = Vec::with_capacity(8);
    waiting.push((*c, open));
    let (mut left, mut yes) = (MOST_HALVINGS, open);
    while let Some((c, lanes)) = waiting.pop() {
        let mut positive = lanes & open;
        for c in &c {
            positive &= bits::<S>(c.low().simd_gt(zero));
        }
        let rest = lanes & open & !positive;
        if rest == 0 {
            continue;
        }
        let ends = bits::<S>(c[0].low().simd_gt(zero) & c[5].low().simd_gt(zero));
        let halved = if left == 0 { 0 } else { rest & ends };
        open &= !(rest & !halved);
        yes &= open;
        if halved == 0 {
            continue;
        }
        left -= 1;
        let [first, second] = halve_forms(&c);
        waiting.push((second, halved));
        waiting.push((first, halved));
    }
    (yes, no)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{Axis, Grid, Spacing};
    use fearless_simd::{Level, dispatch};

    #[inline(always)]
    fn decided<S: Simd>(simd: S, table: &CubicTable, grid: &Grid, step: usize) -> [usize; 2] {
        let plane = Plane::new(&Pair::new(grid.node(0)[0], grid.node(0)[1]).expect("an ordinary pair"));
        let (third, fourth) = (grid.axes()[2].values(), grid.axes()[3].values());
        let mut counts = [0; 2];
        for rows in third.windows(step).step_by(step) {
            for columns in fourth.windows(step).step_by(step) {
                let splat = |x: f64| S::f64s::splat(simd, x);
                let mut code = [Code::UNDECIDED];
                let ends = |side: &[f64]| [splat(side[0]), splat(side[step - 1])];
                table.codes_on(simd, &plane, ends(rows), ends(columns), &mut code);
                if code[0] != Code::UNDECIDED {
                    counts[usize::from(code[0].flags() & ANY_SPIRAL != 0)] += 1;
                }
            }
        }
        counts
    }

    /// Of 1024 blocks of 8 x 8 nodes 572 are proved without ANY_SPIRAL, and 280 with it.
    #[test]
    fn most_blocks_are_decided() {
        let axis = |name: &str, spacing| Axis::new(name, spacing).expect("an axis");
        let grid = Grid::new(vec![
            axis("phi0", Spacing::Values(vec![0.7])),
            axis("phi1", Spacing::Values(vec![1.4])),
            axis("kappa0", Spacing::Linear { lo: 0.01, hi: 1.0, count: 256 }),
            axis("kappa1", Spacing::Log { lo: 0.1, hi: 100.0, count: 256 }),
        ])
        .expect("a grid");
        let table = CubicTable::new(&grid, Level::new()).expect("in the domain");
        let [without, with] = dispatch!(Level::new(), simd => decided(simd, &table, &grid, 8));
        assert!(without >= 568 && with >= 276, "{without} {with}");
    }
}
