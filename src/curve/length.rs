//! Arc length by adaptive Gauss-Legendre quadrature of the speed.

/// Positive nodes and weights of the 16-point Gauss-Legendre rule on [-1, 1].
const RULE: [(f64, f64); 8] = [
    (0.9894009349916499, 0.027152459411754095),
    (0.9445750230732326, 0.06225352393864789),
    (0.8656312023878318, 0.09515851168249279),
    (0.755404408355003, 0.12462897125553388),
    (0.6178762444026438, 0.14959598881657674),
    (0.45801677765722737, 0.16915651939500254),
    (0.2816035507792589, 0.1826034150449236),
    (0.09501250983763744, 0.1894506104550685),
];

/// A half may differ from its whole by this share of the total length. Near rounding noise, and far above the error of
/// the halves that are then taken: halving divides the error of a rule of degree 31 by up to 2^32.
const TOLERANCE: f64 = 1e-15;

/// Halvings at most: a cusp, where the speed has a kink, halves its error four times faster than its interval.
const DEPTH: u32 = 40;

/// Integral of a speed over `[from, to]`; negative when `to < from`.
///
/// # Accuracy
/// 1e-14 relative for the speed of a polynomial curve, cusps included: the interval is halved until the 16-point
/// Gauss-Legendre rule on both halves agrees with the rule on the whole to 1e-15 of the total. All weights and speeds
/// are positive, so sums do not cancel.
///
/// # Source
/// Gander & Gautschi, Adaptive quadrature revisited (2000), for the stopping rule relative to the whole integral.
pub fn arc_length(speed: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let speed = |t: f64| [speed(t)];
    let [whole] = gauss(speed, from, to);
    refine(&speed, from, to, whole, TOLERANCE * whole.abs(), DEPTH)
}

fn refine(speed: &impl Fn(f64) -> [f64; 1], from: f64, to: f64, whole: f64, tolerance: f64, depth: u32) -> f64 {
    let middle = 0.5 * (from + to);
    let ([left], [right]) = (gauss(speed, from, middle), gauss(speed, middle, to));
    // The rounding of the parameter alone, where the speed changes over a width like this one's: halving mends nothing.
    let noise = 4.0 * f64::EPSILON * from.abs().max(to.abs()) / (to - from).abs() * whole.abs();
    // Written so that NaN stops at once.
    let differs = (left + right - whole).abs() > tolerance + noise;
    if depth == 0 || !differs {
        return left + right;
    }
    refine(speed, from, middle, left, tolerance, depth - 1) + refine(speed, middle, to, right, tolerance, depth - 1)
}

/// The parameter in a bracket at which a curve has a length: Newton's method from a guess, and halving where that
/// leaves the bracket.
///
/// # Arguments
/// - `at`: how much the length at a parameter exceeds the wanted one, which is below 0 at the first end, and the speed.
/// - `near`: an excess of at most this size is none.
///
/// # Accuracy
/// The last step is at most two roundings of the parameter, unless the excess was small enough before.
pub(crate) fn parameter_of(
    mut at: impl FnMut(f64) -> [f64; 2],
    [mut low, mut high]: [f64; 2],
    guess: f64,
    near: f64,
) -> f64 {
    let mut t = if low < guess && guess < high { guess } else { 0.5 * (low + high) };
    // Halving alone needs 53 to exhaust a double.
    for _ in 0..100 {
        let [excess, speed] = at(t);
        if excess.abs() <= near {
            break;
        }
        *if excess < 0.0 { &mut low } else { &mut high } = t;
        let newton = t - excess / speed;
        let next = if low <= newton && newton <= high { newton } else { 0.5 * (low + high) };
        let step = (next - t).abs();
        t = next;
        if step <= 2.0 * f64::EPSILON * t.abs() {
            break;
        }
    }
    t
}

/// The 16-point Gauss-Legendre rule on `[from, to]`, for one integrand or several at once.
pub(crate) fn gauss<const N: usize>(speed: impl Fn(f64) -> [f64; N], from: f64, to: f64) -> [f64; N] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sum = [0.0; N];
    for (x, w) in RULE {
        let (below, above) = (speed(middle - half * x), speed(middle + half * x));
        for i in 0..N {
            sum[i] += w * (below[i] + above[i]);
        }
    }
    sum.map(|x| half * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_is_exact_to_degree_31_and_not_beyond() {
        for degree in 0..32 {
            let (got, want) = (gauss(|x| [x.powi(degree)], 0.0, 1.0)[0], 1.0 / f64::from(degree + 1));
            // 16 terms of relative error below degree + 3 ulp each.
            assert!((got - want).abs() < 40.0 * f64::EPSILON * want, "degree {degree}: {got} {want}");
        }
        // The remainder of x^32 over [-1, 1] is 2^33 16!^4 / (33 32!^2).
        let (got, want) = (gauss(|x| [x.powi(32)], -1.0, 1.0)[0], 2.0 / 33.0);
        assert!((want - got - 7.2e-10).abs() < 1e-11, "{got} {want}");
    }
}
