//! Quotients, roots and signs of forms.

use super::{Form, GROW, UNIT};
use crate::num::formula;
use crate::num::{Ball, Certain, Number, Real};
use std::cmp::Ordering;

impl<const K: usize, const H: usize> Certain for Form<K, H> {
    fn certain_sign(&self, error: f64) -> Option<Ordering> {
        self.range().certain_sign(error)
    }
}

impl<const K: usize, const H: usize> Real for Form<K, H> {
    fn of(x: f64, _bits: usize) -> Form<K, H> {
        Form::ball(Ball { value: x, error: 0.0 })
    }
    fn bits(&self) -> usize {
        53
    }
    fn over(&self, divisor: &Form<K, H>) -> Option<Form<K, H>> {
        Some(self.mul(&divisor.inverse()?))
    }
    /// With a double s near `1 / value` and `self s = 1 + u` that is `√(1/s) (1 + u/2 - u²/8 + ...)`. All further
    /// terms have one sign for `u < 0`, so that the rest is largest at the least u: for `u >= -m` it is `1 - m/2 -
    /// m²/8 - √(1-m)`, and at most `m³ / 16 (1-m)^(-5/2)`.
    fn sqrt(&self) -> Option<Form<K, H>> {
        (self.value > self.around()).then_some(())?;
        let s = 1.0 / self.value;
        let u = formula!(self * { s } - 1.0);
        let most = u.most();
        (most < 1.0).then_some(())?;
        let left = 1.0 - most;
        let rest = (most * most * most / (16.0 * left * left * left.sqrt()))
            .min(1.0 - 0.5 * most - 0.125 * most * most - left.sqrt() + 8.0 * UNIT);
        let root = formula!(0.5 * u - 0.125 * (u * u) + 1.0).off(rest * GROW);
        // That √(1/s) is off by three units.
        let back = root.times((1.0 / s).sqrt());
        let size = back.most();
        Some(back.off(4.0 * UNIT * size))
    }
    fn union(&self, other: &Form<K, H>) -> Form<K, H> {
        Form::ball(self.range().union(&other.range()))
    }
    fn size(&self) -> Form<K, H> {
        Form::ball(self.range().size())
    }
    fn most(&self) -> f64 {
        (self.value.abs() + self.around()) * GROW
    }
    fn middle(&self) -> Form<K, H> {
        Form::of(self.value, 53)
    }
    const ORDERS: usize = 2;
    fn guess(&self) -> Form<K, H> {
        Form { error: 0.0, ..*self }
    }
    fn approx(&self) -> f64 {
        self.value
    }
    fn power_of_two(exponent: i32, bits: usize) -> Form<K, H> {
        Form::of(2f64.powi(exponent), bits)
    }
    fn ln(&self) -> f64 {
        self.value.ln()
    }
    fn to_f32(&self) -> Option<f32> {
        self.range().to_f32()
    }
}
