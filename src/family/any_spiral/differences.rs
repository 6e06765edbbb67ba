//! Functions of an angle that cancel near 0, by their series there.

/// `sin x - x cos x`, `x² - sin² x` and `x - sin x` for one x >= 0.
///
/// # Accuracy
/// Below 1 each within 8 units of 2^-53, relative: alternating series of decreasing terms, cut below 2^-58 of the
/// first. From 1 on as good as the sine and cosine allow: with both within 10 units, 14 units of `|sin x| + x |cos x|`
/// for the first and, as `sin x <= 0.842 x`, 80 and 70 units of themselves for the others.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Differences {
    /// `P = sin x - x cos x`.
    pub p: f64,
    /// `x² - sin² x`.
    pub w: f64,
    /// `x - sin x`.
    pub rest: f64,
}

/// Ratios of neighbouring terms but for x²: of P, of x² - sin² x, and of x - sin x.
const P: [f64; 9] = [10.0, 28.0, 54.0, 88.0, 130.0, 180.0, 238.0, 304.0, 378.0];
const W: [f64; 10] = [7.5, 14.0, 22.5, 33.0, 45.5, 60.0, 76.5, 95.0, 115.5, 138.0];
const REST: [f64; 9] = [20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0, 342.0, 420.0];

/// `1 - x²/r0 (1 - x²/r1 (1 - ...))`.
fn series(x2: f64, ratios: &[f64]) -> f64 {
    ratios.iter().rev().fold(1.0, |sum, ratio| 1.0 - x2 / ratio * sum)
}

impl Differences {
    /// All three divided by their first powers of x: `P/x³`, `(x² - sin² x)/x⁴` and `(x - sin x)/x³`. So nothing
    /// underflows, however small x >= 0 is.
    pub(super) fn by_powers(x: f64) -> Differences {
        let (sin, cos) = x.sin_cos();
        let x2 = x * x;
        if x >= 1.0 {
            let Differences { p, w, rest } = Differences::new(x, sin, cos);
            return Differences { p: p / (x2 * x), w: w / (x2 * x2), rest: rest / (x2 * x) };
        }
        Differences { p: series(x2, &P) / 3.0, w: series(x2, &W) / 3.0, rest: series(x2, &REST) / 6.0 }
    }

    /// From x and its sine and cosine.
    pub(super) fn new(x: f64, sin: f64, cos: f64) -> Differences {
        if x >= 1.0 {
            return Differences { p: sin - x * cos, w: (x - sin) * (x + sin), rest: x - sin };
        }
        let x2 = x * x;
        let cube = x2 * x;
        Differences {
            p: cube / 3.0 * series(x2, &P),
            w: x2 * x2 / 3.0 * series(x2, &W),
            rest: cube / 6.0 * series(x2, &REST),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Interval;

    #[test]
    fn all_keep_their_bounds() {
        let mut worst = [0.0f64; 3];
        for i in 0..400 {
            let x = if i < 40 { 0.7f64.powi(i) } else { f64::from(i) * 0.0117 };
            let (sin, cos) = Interval::sin_cos(x, 400);
            let shape = Differences::new(x, crate::num::sines::sin(x), crate::num::sines::cos(x));
            let n = Interval::new(x, 400);
            let truths = [&sin - &(&n * &cos), &n.square() - &sin.square(), &n - &sin];
            let scale = if x < 1.0 { truths[0].approx() } else { sin.approx().abs() + x * cos.approx().abs() };
            let scales = [scale, truths[1].approx(), truths[2].approx()];
            for (i, value) in [shape.p, shape.w, shape.rest].into_iter().enumerate() {
                let units = truths[i].plus(-value).approx().abs() / scales[i].abs() * 2f64.powi(53);
                let bound = if x < 1.0 { 8.0 } else { [14.0, 80.0, 70.0][i] };
                assert!(units <= bound, "function {i} of {x}: {units} units");
                worst[i] = worst[i].max(units);
            }
        }
        assert!(worst.iter().all(|w| *w > 0.5), "{worst:?}");
    }
}
