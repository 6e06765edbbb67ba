//! Roots of the two parabolas `3 - y = a x²`, `3 - x = k y²` over a box, as forms.
//!
//! **Enclosure.** X and Y are any forms; Newton's method and two orders of implicit differentiation give good ones.
//! With `x = X + u`, `y = Y + v`, and the residuals `R = 3 - Y - a X²`, `T = 3 - X - k Y²`, (x, y) is a root exactly
//! when (u, v) is a fixed point of
//!
//! ```text
//! u = [(T - k v²) - 2kY (R - a u²)] / D,   v = [(R - a u²) - 2aX (T - k v²)] / D,   D = 1 - 4akXY
//! ```
//!
//! (the two equations are `v + 2aX u = R - a u²` and `u + 2kY v = T - k v²`, solved for the linear part). At each
//! place of the box this is a continuous map. Where it takes the rectangle `|u| <= e, |v| <= f` into itself,
//! Brouwer's theorem puts a root into the rectangle. The bounds below are those of the whole box, so there is a root
//! within (e, f) of (X, Y) at every place of it. Which root that is, is left to the caller.
//!
//! **A span.** Where two roots merge inside the box, neither is a form. With `F(x) = 3 - x - k (3 - a x²)²`, and only
//! for y >= 0, F rises with a and falls with k. So at each root of each datum of the box, `F(x; A, K) >= 0` for A at
//! least every a and K at most every k, where y is cut off at 0. This leaves `(0, l]` and `[m, r]` when F(·; A, K) is
//! negative between l and m, and beyond r. It is so when F(l) < 0, F(m) < 0, `A l² < 1`, and `A m² <= 1` or F'(m) >
//! 0: F is convex up to 1/√A; from there to m, F' falls, so it stays positive, and F(m) is the largest value. Beyond
//! r, F falls when F(r) < 0, `A r² >= 1` and F'(r) < 0. On `(0, l]` every F(·; a, k) is convex and negative at l. So
//! it has just one root there where F(0) > 0, that is k < 1/3, and none elsewhere. F' < 0 at that root: it is the
//! left one in the sense of the module. With K >= 1/3, l = 0 will do.
//!
//! The cut changes nothing up to r: y falls along x, y > 0 at m (F'(m) > 0 would fail otherwise), and r < 3 is taken
//! only for A < 1/3, so that `y(r) = 3 - A r² > 0`. Beyond, F falls until y = 0 and is 3 - x < 0 from `x = √(3/A) > 3`
//! on.

use super::angles::Four;
use crate::num::{Ball, Certain, Real, formula};
use std::cmp::Ordering::{Greater, Less};

/// Covers the roundings of the bounds of an enclosure: fewer than 100 operations on numbers that are not negative.
const GROW: f64 = 1.0 + 128.0 * f64::EPSILON;

/// Newton's method for F from a start; a guess.
fn settle(a: f64, k: f64, mut x: f64) -> Option<f64> {
    for _ in 0..60 {
        let y = 3.0 - a * x * x;
        let step = (3.0 - x - k * y * y) / (4.0 * a * x * k * y - 1.0);
        x -= step;
        if step.abs() < 1e-11 {
            return Some(x);
        }
    }
    None
}

/// A root over the box.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root {
    pub x: Four,
    pub y: Four,
    /// `1 - 4akxy = -F'` there, of one sign.
    pub slope: Four,
}

impl Root {
    /// The same seen with x and y exchanged.
    fn swapped(self) -> Root {
        Root { x: self.y, y: self.x, ..self }
    }

    /// A root of F' < 0, found from x = 0; anything that Newton's method leads to.
    pub(super) fn falling(a: &Four, k: &Four) -> Option<Root> {
        let root = enclose(a, k, settle(a.value, k.value, 0.0)?)?;
        (root.slope.low() > 0.0).then_some(root)
    }

    /// The left root: F' < 0 and `a x² < 1`.
    pub(super) fn left(a: &Four, k: &Four) -> Option<Root> {
        let root = Root::falling(a, k)?;
        (formula!(a * (root.x * root.x)).high() < 1.0).then_some(root)
    }

    /// The right root, which is the left one with x and y exchanged.
    pub(super) fn right(a: &Four, k: &Four) -> Option<Root> {
        Root::left(k, a).map(Root::swapped)
    }

    /// The only root of a datum that has one.
    pub(super) fn lone(a: &Four, k: &Four) -> Option<Root> {
        Root::falling(a, k).or_else(|| Root::falling(k, a).map(Root::swapped))
    }

    /// The middle root: F' > 0.
    pub(super) fn middle(a: &Four, k: &Four) -> Option<Root> {
        let root = enclose(a, k, settle(a.value, k.value, 1.0 / a.value.sqrt())?)?;
        (root.slope.high() < 0.0 && root.x.low() > 0.0).then_some(root)
    }
}

/// The root near x0, a root for the middle of the box; see the documentation of the module.
fn enclose(a: &Four, k: &Four, x0: f64) -> Option<Root> {
    let (a0, k0) = (a.value, k.value);
    let y0 = 3.0 - a0 * x0 * x0;
    let (ax, ky) = (2.0 * a0 * x0, 2.0 * k0 * y0);
    let i = 1.0 / (1.0 - ax * ky);
    let exact = |value| Four::ball(Ball { value, error: 0.0 });
    let (mut x, mut y) = (exact(x0), exact(y0));
    for j in 0..4 {
        let (da, dk) = (x0 * x0 * a.slope[j], y0 * y0 * k.slope[j]);
        x.slope[j] = (ky * da - dk) * i;
        y.slope[j] = (ax * dk - da) * i;
    }
    // Second order: w1 = a dx² + 2x da dx + x² d²a, w2 = k dy² + 2y dk dy + y² d²k.
    let mut at = 0;
    for j in 0..4 {
        for l in j..4 {
            // A product of two different symbols comes from both orders.
            let pair = |u: &Four, v: &Four| {
                let one = u.slope[j] * v.slope[l];
                if j == l { one } else { one + u.slope[l] * v.slope[j] }
            };
            let w1 = a0 * pair(&x, &x) + 2.0 * x0 * pair(a, &x) + x0 * x0 * a.bend[at];
            let w2 = k0 * pair(&y, &y) + 2.0 * y0 * pair(k, &y) + y0 * y0 * k.bend[at];
            x.bend[at] = (ky * w1 - w2) * i;
            y.bend[at] = (ax * w2 - w1) * i;
            at += 1;
        }
    }
    let (ax, ky) = (formula!(a * x), formula!(k * y));
    let rest = |minus: &Four, other: &Four| formula!(3.0 - (minus + other)).most();
    let (first, second) = (rest(&formula!(ax * x), &y), rest(&formula!(ky * y), &x));
    let slope = formula!(ax * ky * -4.0 + 1.0);
    let least = slope.low().max(-slope.high());
    // Not for NaN either.
    (least > 0.0).then_some(())?;
    let (alpha, beta) = (2.0 * ax.most(), 2.0 * ky.most());
    let (a_most, k_most) = (a.most(), k.most());
    let (mut e, mut f) = (0.0, 0.0);
    for _ in 0..10 {
        let (own, its) = (first + a_most * e * e, second + k_most * f * f);
        let (next_e, next_f) = ((its + beta * own) / least * GROW, (own + alpha * its) / least * GROW);
        if next_e <= e && next_f <= f {
            let (x, y) = (x.off(e), y.off(f));
            let slope = formula!(a * x * (k * y) * -4.0 + 1.0);
            return Some(Root { x, y, slope });
        }
        if !(next_e < 3.0 && next_f < 3.0) {
            return None;
        }
        (e, f) = (1.1 * next_e + f64::MIN_POSITIVE, 1.1 * next_f + f64::MIN_POSITIVE);
    }
    None
}

/// `[m, r]` of a span, by the documentation of the module: every root of the box but the left one has its x there.
pub(super) fn span(a: &Four, k: &Four) -> Option<[f64; 2]> {
    let (most, least) = (a.high(), k.low());
    (least > 0.0 && most > 0.0).then_some(())?;
    let exact = |value| Ball { value, error: 0.0 };
    let (a, k) = (exact(most), exact(least));
    // F, F', y and a x² at x.
    let at = |x: f64| {
        let x = exact(x);
        let ax = formula!(a * x);
        let y = formula!(3.0 - ax * x);
        let ky = formula!(k * y);
        let value = formula!(3.0 - (x + ky * y));
        (value, formula!(4.0 * (ax * ky) - 1.0), y, formula!(ax * x - 1.0))
    };
    let sure = |x: &Ball, sign| x.certain_sign(0.0) == Some(sign);
    // Any number a little on the good side of the root will do that the signs accept.
    const NEAR: f64 = 1e-7;
    let m = settle(most, least, 1.0 / most.sqrt())? * (1.0 - NEAR);
    let (value, slope, y, bend) = at(m);
    (m > 0.0 && sure(&value, Less) && sure(&y, Greater) && (sure(&bend, Less) || sure(&slope, Greater)))
        .then_some(())?;
    if !sure(&formula!(3.0 * k - 1.0), Greater) {
        let l = settle(most, least, 0.0)? * (1.0 + NEAR);
        let (value, _, _, bend) = at(l);
        (l > 0.0 && l <= m && sure(&value, Less) && sure(&bend, Less)).then_some(())?;
    }
    let mut r = 3.0;
    if sure(&formula!(3.0 * a - 1.0), Less) {
        let guess = settle(most, least, 3.0)? * (1.0 + NEAR);
        let (value, slope, _, bend) = at(guess);
        if guess < 3.0 && guess >= m && sure(&value, Less) && sure(&slope, Less) && sure(&bend, Greater) {
            r = guess;
        }
    }
    (m < r).then_some([m, r])
}
