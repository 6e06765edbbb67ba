//! B0, B1 and B2 of one pair of angles, at roots that are forms.
//!
//! They are polynomials of degree 3 in (x, y), the same in a whole plane of curvatures. Their Taylor series around the
//! root of a block's middle ends, and in it the forms of x and y are inserted.

use super::pair::PAIR_ERROR;
use super::precision::Precision;
use crate::num::{COVER, FormLanes, Number};
use fearless_simd::{Simd, SimdBase};

/// Unit roundoff.
const UNIT: f64 = Precision::F64.unit;

/// A polynomial of degree 3 in x and y, and the sums of the absolute terms that each coefficient is made of.
///
/// The coefficients are those of 1, x, y, x², xy, y², x³, x²y, xy², y³.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    c: [f64; 10],
    size: [f64; 10],
}

/// Exponents of the terms of a [`Surface`].
const TERMS: [[usize; 2]; 10] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0], [2, 1], [1, 2], [0, 3]];

impl Surface {
    pub(super) fn constant(c: f64) -> Surface {
        let mut surface = Surface { c: [0.0; 10], size: [0.0; 10] };
        (surface.c[0], surface.size[0]) = (c, c.abs());
        surface
    }

    /// x or y itself.
    pub(super) fn symbol(at: usize) -> Surface {
        let mut surface = Surface::constant(0.0);
        (surface.c[at], surface.size[at]) = (1.0, 1.0);
        surface
    }

    fn zip(&self, other: &Surface, of: fn(f64, f64) -> f64) -> Surface {
        let both = |i: usize| of(self.c[i], other.c[i]);
        Surface { c: std::array::from_fn(both), size: std::array::from_fn(|i| self.size[i] + other.size[i]) }
    }
}

impl Number for Surface {
    fn add(&self, other: &Surface) -> Surface {
        self.zip(other, |a, b| a + b)
    }
    fn sub(&self, other: &Surface) -> Surface {
        self.zip(other, |a, b| a - b)
    }
    /// No product of `side` has a term of higher degree.
    fn mul(&self, other: &Surface) -> Surface {
        let mut product = Surface::constant(0.0);
        for (i, one) in TERMS.iter().enumerate() {
            for (j, two) in TERMS.iter().enumerate() {
                let term = [one[0] + two[0], one[1] + two[1]];
                if let Some(at) = TERMS.iter().position(|t| *t == term) {
                    product.c[at] += self.c[i] * other.c[j];
                    product.size[at] += self.size[i] * other.size[j];
                }
            }
        }
        product
    }
    fn times(&self, k: f64) -> Surface {
        Surface { c: self.c.map(|c| c * k), size: self.size.map(|c| c * k.abs()) }
    }
    fn plus(&self, k: f64) -> Surface {
        self.add(&Surface::constant(k))
    }
}

/// A root with the sizes that a Taylor series asks for.
pub(super) struct Spread<'r, S: Simd> {
    pub x: &'r FormLanes<S>,
    pub y: &'r FormLanes<S>,
    pub linear: [S::f64s; 2],
    pub rest: [S::f64s; 2],
    pub most: [S::f64s; 2],
}

impl Surface {
    /// At the forms of a root; see the documentation of the module.
    ///
    /// With `x = X + l + q`, l linear and q the rest, no larger than L and Q, a term of second order leaves out `2lq +
    /// q²` and its like, and all terms of third order are below those of the absolute values. Each coefficient is off
    /// by `PAIR_ERROR + 20` units of its absolute terms, and no term passes through more than 60 operations.
    #[inline(always)]
    pub(super) fn on<S: Simd>(&self, simd: S, root: &Spread<S>) -> FormLanes<S> {
        let Spread { x, y, linear: [lx, ly], rest: [qx, qy], most: [mx, my] } = root;
        let mut c = [x.value; 10];
        for (c, value) in c.iter_mut().zip(self.c) {
            *c = S::f64s::splat(simd, value);
        }
        let s = &self.size;
        let (u, v) = (x.value, y.value);
        let value = u * (u * (u * c[6] + v * c[7] + c[3]) + v * (v * c[8] + c[4]) + c[1])
            + v * (v * (v * c[9] + c[5]) + c[2])
            + c[0];
        let px = u * (u * c[6] * 3.0 + (v * c[7] + c[3]) * 2.0) + v * (v * c[8] + c[4]) + c[1];
        let py = v * (v * c[9] * 3.0 + (u * c[8] + c[5]) * 2.0) + u * (u * c[7] + c[4]) + c[2];
        let pxx = u * c[6] * 3.0 + v * c[7] + c[3];
        let pxy = (u * c[7] + v * c[8]) * 2.0 + c[4];
        let pyy = v * c[9] * 3.0 + u * c[8] + c[5];
        let ([xa, xk], [ya, yk]) = (x.slope, y.slope);
        let (dx, dy) = (*lx + *qx, *ly + *qy);
        let cut = pxx.abs() * (*qx * (*lx + dx)) + pxy.abs() * (*lx * *qy + *qx * dy) + pyy.abs() * (*qy * (*ly + dy));
        let third = dx * dx * (dx * c[6].abs() + dy * c[7].abs()) + dy * dy * (dx * c[8].abs() + dy * c[9].abs());
        let (m, n) = (*mx, *my);
        let size = m * (m * (m * s[6] + n * s[7] + s[3]) + n * (n * s[8] + s[4]) + s[1])
            + n * (n * (n * s[9] + s[5]) + s[2])
            + s[0];
        let (along, across, along_y) = (pxx * xa + pxy * ya, pxx * xk * 2.0 + pxy * yk, pyy * ya);
        FormLanes {
            value,
            slope: [px * xa + py * ya, px * xk + py * yk],
            bend: [
                px * x.bend[0] + py * y.bend[0] + along * xa + along_y * ya,
                px * x.bend[1] + py * y.bend[1] + across * xa + (pxy * xk + pyy * yk * 2.0) * ya,
                px * x.bend[2] + py * y.bend[2] + (pxx * xk + pxy * yk) * xk + pyy * yk * yk,
            ],
            error: (px.abs() * x.error + py.abs() * y.error + cut + third) * COVER
                + size * ((PAIR_ERROR + 100.0) * UNIT),
        }
    }
}
