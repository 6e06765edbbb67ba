//! Lengths of cubics before anything is built, with a proved bound.

use crate::curve::vector::{Vector, add, dot, length, lerp, scale, sub};

/// Gauss's rule of five points on [0, 1]: places and weights.
const FIVE: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// The square of the greatest δ of [`cubic_length`] that one rule takes.
const STRAIGHT_ENOUGH: f64 = 9.0 / 64.0;

/// Halvings of a cubic at most: spirals of joins need fewer, as the tests of [`super::spiral`] show.
const HALVINGS: u32 = 8;

/// What a length is at least and at most, for the share of it by which it may be wrong.
pub(super) fn near(length: f64, share: f64) -> [f64; 2] {
    [length * (1.0 - share), length * (1.0 + share)]
}

/// At least and at most the length of the cubic with these legs: to 1e-5 of it, unless more halvings are needed.
///
/// With `s = 1 - t` the hodograph is 3 times `z = s² a + 2st b + t² c = b (1 + s² A + t² B)`, where A and B are at
/// most `δ = max(|a - b|, |c - b|)/|b|` in size. Let t be complex and `|s| + |t| < e = (ρ + 1/ρ)/2`: an ellipse about
/// 0 and 1, in which `|s|² + |t|² = (1 + |s - t|²)/2 < (1 + e²)/2`. For `e² = 2/δ - 1` that is 1/δ, so that
/// `|z/b - 1| < 1` there, and the same holds with conjugate coefficients. So the speed, 3 times the root of the
/// product of both, is analytic in the ellipse, and less than `M = 6|b|`. Hence its Chebyshev coefficients are at most
/// `2M/ρ^k`. The rule is exact for those of k < 10 and of odd k. For the others it is wrong by at most
/// `(2 + 2/(k² - 1))/2 <= 100/99`. In all that is at most `200/99 M r⁵/(1 - r)`, where `1/r = ρ² = y + √(y² - 1)` and
/// `y = 2e² - 1 = 4/δ - 3`. The length is at least `3|b|(1 - δ)`. For δ = 3/8 the error is 8.4e-6 of that, and for
/// smaller ones less; roundings are far below the rest of 1e-5.
///
/// Halving a curve about halves its δ. Any curve is no shorter than its chord and no longer than its polygon.
pub(super) fn cubic_length(legs: [Vector; 3]) -> [f64; 2] {
    halved(legs, HALVINGS)
}

fn halved(legs @ [a, b, c]: [Vector; 3], halvings: u32) -> [f64; 2] {
    let square = |x: Vector| dot(x, x);
    if square(sub(a, b)).max(square(sub(c, b))) <= STRAIGHT_ENOUGH * square(b) {
        let speed = |t: f64| {
            let s = 1.0 - t;
            let [x, y] = [0, 1].map(|i| s * s * a[i] + 2.0 * s * t * b[i] + t * t * c[i]);
            (x * x + y * y).sqrt()
        };
        return near(3.0 * FIVE.iter().map(|(t, weight)| weight * speed(*t)).sum::<f64>(), 1e-5);
    }
    if halvings == 0 {
        return [length(add(a, add(b, c))), legs.map(length).iter().sum()];
    }
    let [ab, bc] = [lerp(a, b, 0.5), lerp(b, c, 0.5)];
    let middle = lerp(ab, bc, 0.5);
    let [first, last] = [[a, ab, middle], [middle, bc, c]].map(|legs| {
        let half = legs.map(|leg| scale(leg, 0.5));
        halved(half, halvings - 1)
    });
    add(first, last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::vector::unit;
    use crate::noise::Noise;
    use crate::num::Interval;
    use std::f64::consts::PI;

    /// What the length lies between at least: chords and polygons of 2^n parts, at 128 bits.
    fn chords_and_polygons(legs: &[[Interval; 2]; 3], halvings: u32) -> [Interval; 2] {
        let half = |a: &[Interval; 2], b: &[Interval; 2]| [0, 1].map(|i| (&a[i] + &b[i]).scale(0.5));
        let long = |[x, y]: &[Interval; 2]| (&x.square() + &y.square()).sqrt().unwrap();
        let [a, b, c] = legs;
        if halvings == 0 {
            let sum = [0, 1].map(|i| &(&a[i] + &b[i]) + &c[i]);
            return [long(&sum), &(&long(a) + &long(b)) + &long(c)];
        }
        let (ab, bc) = (half(a, b), half(b, c));
        let middle = half(&ab, &bc);
        let scaled = |legs: [&[Interval; 2]; 3]| legs.map(|[x, y]| [x.scale(0.5), y.scale(0.5)]);
        let first = chords_and_polygons(&scaled([a, &ab, &middle]), halvings - 1);
        let last = chords_and_polygons(&scaled([&middle, &bc, c]), halvings - 1);
        [0, 1].map(|i| &first[i] + &last[i])
    }

    /// Random legs, those just straight enough for one rule, nearly straight ones, cusps, loops and legs of no length.
    #[test]
    fn lengths_of_cubics_lie_within_their_bounds() {
        let mut noise = Noise(7);
        let (mut within, mut most_wrong) = (0, 0.0f64);
        for i in 0..400 {
            let mut vector = |size: f64| scale(unit(PI * noise.signed()), size);
            let legs = match i % 8 {
                0 => [vector(1.0), vector(1.0), vector(1.0)],
                1 | 2 => [add([1.0, 0.0], vector(0.37499)), [1.0, 0.0], add([1.0, 0.0], vector(0.37499))],
                3 => [add([1.0, 0.0], vector(1e-9)), [1.0, 0.0], add([1.0, 0.0], vector(0.2))],
                4 => [vector(1.0), vector(1e-3), vector(1e-6)],
                5 => [vector(1.0), [0.0, 0.0], vector(1.0)],
                6 => [[1.0, 0.0], add([-0.5, 0.0], vector(1e-7)), [1.0, 0.0]],
                _ => [add([1.0, 0.0], vector(0.9)), add([1.0, 0.0], vector(0.9)), add([1.0, 0.0], vector(0.9))],
            };
            let [least, most] = cubic_length(legs);
            let legs = legs.map(|leg| leg.map(|x| Interval::new(x, 128)));
            let [low, high] = chords_and_polygons(&legs, 9).map(|x| x.approx());
            assert!(least <= high * (1.0 + 1e-14) && low <= most * (1.0 + 1e-14), "{i}: {least} {most} {low} {high}");
            // Cusps take more halvings than there are.
            if most - least < 2.001e-5 * most {
                within += 1;
                most_wrong =
                    most_wrong.max((low - 0.5 * (least + most)).abs().min((high - 0.5 * (least + most)).abs()) / most);
                assert!(high - low > 1e-6 * low || least <= low && high <= most, "{i}: {least} {most} {low} {high}");
            }
            assert!(most - least < 1e-3 * most, "{i}: {least} {most}");
        }
        println!("{within} {most_wrong:e}");
        assert!(within > 200 && most_wrong < 1e-5, "{within} {most_wrong:e}");
    }
}
