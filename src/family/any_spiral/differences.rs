//! Functions of an angle that cancel near 0, by their series there.

/// `sin x - x cos x` and `x² - sin² x` for one x >= 0.
///
/// # Accuracy
/// Below 1 each within 8 units of 2^-53, relative: alternating series of decreasing terms, cut below 2^-58 of the
/// first. From 1 on as good as the sine and cosine allow: with both within 10 units, 14 units of `|sin x| + x |cos x|`
/// for the first and, as `sin x <= 0.842 x`, 80 units of itself for the second; 70 for `x - sin x`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Differences {
    /// `P = sin x - x cos x`.
    pub p: f64,
    /// `x² - sin² x`.
    pub w: f64,
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
    /// `P/x³`: so nothing underflows, however small x >= 0 is.
    pub(super) fn p_by_powers(x: f64) -> f64 {
        if x < 1.0 { series(x * x, &P) / 3.0 } else { (x.sin() - x * x.cos()) / (x * x * x) }
    }

    /// `(x² - sin² x)/x⁴` and `(x - sin x)/x³`, likewise.
    pub(super) fn others_by_powers(x: f64) -> [f64; 2] {
        let x2 = x * x;
        if x < 1.0 {
            return [series(x2, &W) / 3.0, series(x2, &REST) / 6.0];
        }
        let sin = x.sin();
        [(x - sin) * (x + sin) / (x2 * x2), (x - sin) / (x2 * x)]
    }

    /// From x and its sine and cosine.
    pub(super) fn new(x: f64, sin: f64, cos: f64) -> Differences {
        if x >= 1.0 {
            return Differences { p: sin - x * cos, w: (x - sin) * (x + sin) };
        }
        let x2 = x * x;
        let cube = x2 * x;
        Differences { p: cube / 3.0 * series(x2, &P), w: x2 * x2 / 3.0 * series(x2, &W) }
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
            for (i, value) in
                [shape.p, shape.w, Differences::others_by_powers(x)[1] * (x * x * x)].into_iter().enumerate()
            {
                let units = truths[i].plus(-value).approx().abs() / scales[i].abs() * 2f64.powi(53);
                let bound = if x < 1.0 { 8.0 } else { [14.0, 80.0, 70.0][i] };
                assert!(units <= bound, "function {i} of {x}: {units} units");
                worst[i] = worst[i].max(units);
            }
        }
        assert!(worst.iter().all(|w| *w > 0.5), "{worst:?}");
    }
}
