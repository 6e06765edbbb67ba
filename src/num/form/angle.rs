//! Forms of angles and of their sines.

use super::{Form, UNIT};
use crate::num::formula;
use crate::num::sines::{SIN_ERROR, cos, sin, sin_of_sum};
use crate::num::{Ball, Number, Real};

/// Sine and cosine of a double from -3π/2 to 3π/2, each within [`SIN_ERROR`] units.
fn signed(x: f64) -> (f64, f64) {
    (x.signum() * sin(x.abs()), cos(x.abs()))
}

impl<const K: usize, const H: usize> Form<K, H> {
    /// A range as `middle + half · symbol`, exactly: every number of the range is that for some place of the symbol.
    ///
    /// The larger distance from the middle to an end is rounded once, by at most one unit; four units more cover that.
    pub(crate) fn centred([low, high]: [f64; 2], symbol: usize) -> Form<K, H> {
        let middle = 0.5 * low + 0.5 * high;
        let half = (high - middle).max(middle - low);
        let mut form = Form::ball(Ball { value: middle, error: 0.0 });
        form.slope[symbol] = half * (1.0 + 4.0 * UNIT) + f64::MIN_POSITIVE;
        form
    }

    /// How far it is from its value.
    fn rest(&self) -> Form<K, H> {
        Form { value: 0.0, ..*self }
    }

    /// A function f of `f'' = -f` and `|f| <= 1`, such as a sine, of an angle that moves by `by` around a middle,
    /// where it is `value` and its derivative is `slope`, each to so many units (`value` relative, `slope` absolute).
    ///
    /// Taylor: `value + slope by - value by² / 2`, and a rest of at most `|by|³ / 6`.
    fn turned(value: f64, slope: f64, by: &Form<K, H>, units: f64) -> Form<K, H> {
        let most = by.most();
        let rounded = units * UNIT * (value.abs() + most + 0.5 * value.abs() * most * most);
        let form = formula!(by * by * { -0.5 * value } + by * { slope } + { value });
        form.off(most * most * most / 6.0 + rounded)
    }

    /// The sine of an angle whose value is from -3π/2 to 3π/2.
    pub(crate) fn sine(&self) -> Form<K, H> {
        let (sine, cosine) = signed(self.value);
        Form::turned(sine, cosine, &self.rest(), SIN_ERROR)
    }

    /// The cosine of such an angle.
    pub(crate) fn cosine(&self) -> Form<K, H> {
        let (sine, cosine) = signed(self.value);
        Form::turned(cosine, -sine, &self.rest(), SIN_ERROR)
    }

    /// The sine of the sum of two such angles; the sum of their values is between -π and π.
    ///
    /// The cosine of the sum is taken from those of the angles: two products of numbers within 10 units each and a
    /// difference, all at most 1, are off by less than 44 units.
    pub(crate) fn sine_of_sum(&self, other: &Form<K, H>) -> Form<K, H> {
        let (x, y) = (self.value, other.value);
        let ((s0, c0), (s1, c1)) = (signed(x), signed(y));
        let value = if x + y < 0.0 { -sin_of_sum(-x, -y) } else { sin_of_sum(x, y) };
        Form::turned(value, c0 * c1 - s0 * s1, &self.rest().add(&other.rest()), 44.0)
    }
}

#[cfg(test)]
mod tests {
    use crate::noise::Noise;
    use crate::num::{Interval, Quadratic};
    use std::f64::consts::PI;

    /// At ends, middles and elsewhere in ranges of any width, also those around 0 and beside π.
    #[test]
    fn sines_hold_the_truth() {
        let mut noise = Noise(5);
        let mut worst = [0.0f64; 3];
        for round in 0..4000 {
            let width = 2f64.powi((26.0 * (noise.signed() - 1.0)) as i32);
            let ranges = [0, 1].map(|_| {
                let middle = [3.1 * noise.signed(), 0.0, 3.1, 1e-9 * noise.signed()][round % 4];
                [middle - 0.02 * width, middle + 0.01 * width]
            });
            let [a, b] = [0, 1].map(|i| Quadratic::centred(ranges[i], i));
            if (a.value + b.value).abs() >= PI {
                continue;
            }
            let found = [a.sine(), a.cosine(), a.sine_of_sum(&b)];
            for place in 0..4 {
                let at = ranges.map(|[low, high]| match place {
                    0 => low,
                    1 => high,
                    _ => (low + (high - low) * noise.signed().abs()).clamp(low, high),
                });
                let ((s0, c0), (s1, c1)) = (Interval::sin_cos(at[0], 300), Interval::sin_cos(at[1], 300));
                let sum = &(&s0 * &c1) + &(&c0 * &s1);
                let symbols = [0, 1].map(|i| {
                    let form = if i == 0 { &a } else { &b };
                    Interval::new(at[i], 300)
                        .plus(-form.value)
                        .over(&Interval::new(form.slope[i], 300))
                        .expect("not zero")
                });
                for (i, truth) in [s0, c0, sum].iter().enumerate() {
                    let q = found[i];
                    let [x, y] = &symbols;
                    let terms = [
                        (q.slope[0], x.clone()),
                        (q.slope[1], y.clone()),
                        (q.bend[0], x.square()),
                        (q.bend[1], x * y),
                        (q.bend[2], y.square()),
                    ];
                    let held = terms.iter().fold(Interval::new(q.value, 300), |sum, (k, term)| &sum + &term.scale(*k));
                    let off = (truth - &held).approx().abs();
                    assert!(off <= q.error, "{i} of {ranges:?} at {at:?}: {q:?} is off by {off}");
                    assert!(q.low() <= truth.approx() && truth.approx() <= q.high());
                    worst[i] = worst[i].max(off / q.error);
                }
            }
        }
        assert!(worst.iter().all(|w| *w > 0.3), "{worst:?}");
    }
}
