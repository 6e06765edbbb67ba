//! Solutions at sizes and over ranges of sizes, for searches.

use super::Kind;
use super::bound::bound;
use super::curves::{boxed, curves};
use super::datum::{Datum, Turned};
use crate::curve::hodograph::Hodograph;
use crate::num::{Ball, Quadratic};

/// Solutions with end directions (to the chord) that are longer than the chord by no more than `beyond`, in chords.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    pub theta: [f64; 2],
    pub beyond: f64,
}

/// One solution: its greatest |κ|, as doubles see it, how much longer it is than the chord, and its pre-image, for the
/// chord from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    pub most: f64,
    pub beyond: f64,
    pub preimage: [[f64; 2]; 3],
}

impl Search {
    /// What the sizes of its solutions do not exceed.
    ///
    /// With `w = u + iv` such a solution is longer than its chord by `∫ |w|² - Re w² = 2 ∫ v²`, and a polynomial v of
    /// degree 2 has `∫ v² >= v²/9` at either end, where it is `√l sin(θ/2)`. The same of |w| makes sizes at most nine
    /// times the length.
    pub(crate) fn sizes(&self) -> [f64; 2] {
        self.theta.map(|theta| {
            let sine = (0.5 * theta).sin();
            // A little more than the roundings.
            (4.5 * self.beyond / (sine * sine)).min(9.0 * (1.0 + self.beyond)) * (1.0 + 1e-12)
        })
    }

    /// The solution at these sizes that bends least.
    pub(crate) fn at(&self, size: [f64; 2]) -> Option<Candidate> {
        let curves = curves::<Ball>(&Datum { kind: Kind::Hermite, theta: self.theta, size }, 53)?;
        if curves.straight {
            let [a, b] = size.map(f64::sqrt);
            let middle = ((120.0 - 15.0 * (a * a + b * b) + 10.0 * a * b).sqrt() - 3.0 * (a + b)) / 4.0;
            return Some(Candidate { most: 0.0, beyond: 0.0, preimage: [[a, 0.0], [middle, 0.0], [b, 0.0]] });
        }
        let found = |part: Hodograph<Ball>, whole: &Hodograph<Ball>| Candidate {
            most: part.guess().1,
            beyond: whole.beyond_chord().value,
            preimage: whole.w.map(|z| z.map(|x| x.value)),
        };
        let all = curves.bent.iter().map(|c| found(c.part(), &c.whole));
        all.filter(|f| f.beyond <= self.beyond * (1.0 + 1e-9) && f.most.is_finite())
            .min_by(|a, b| a.most.total_cmp(&b.most))
    }

    /// What the greatest |κ| of every solution that is not too long exceeds, for all sizes in these ranges (`equal`:
    /// both the same in the first).
    ///
    /// As much as is `enough`, or more.
    pub(crate) fn least(&self, size: [[f64; 2]; 2], equal: bool, enough: f64) -> f64 {
        let first = Quadratic::along(size[0], 0);
        let last = if equal { first } else { Quadratic::along(size[1], 1) };
        let half = self.theta.map(|theta| Ball::half_turn(theta, 53).map(Quadratic::ball));
        let Some(arcs) = boxed(Kind::Hermite, half, [first, last]) else { return 0.0 };
        arcs.iter().map(|arc| bound(&arc.whole, self.beyond, enough)).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use num_complex::Complex64;
    use std::f64::consts::PI;

    /// Sizes in the ratio of these at which Z is about as near to 0 as it gets.
    fn meeting(theta: [f64; 2], size: [f64; 2]) -> [f64; 2] {
        let [w0, w2] = [0, 1].map(|i| Complex64::from_polar(size[i].sqrt(), 0.5 * theta[i]));
        let rest = 15.0 * w0 * w0 + 15.0 * w2 * w2 - 10.0 * w0 * w2;
        size.map(|l| l * (120.0 / rest.norm()).min(1e3))
    }

    /// Boxes of every size, many around places where two solutions meet (Z = 0), with general, mirrored, opposite and
    /// nearly straight directions: no solution in them bends less than the bound. Many bounds are so tight that 1.001
    /// of them would fail.
    #[test]
    fn no_solution_bends_less_than_its_box_says() {
        let mut noise = Noise(5);
        let (mut compared, mut tight) = (0, 0);
        for round in 0..3000 {
            let angle = 2.0 * PI * (noise.next() - 0.5);
            let other = 2.0 * PI * (noise.next() - 0.5);
            let small = 10f64.powf(-6.0 * noise.next());
            let theta = match round % 8 {
                0 => [angle, angle],
                1 => [angle, -angle],
                2 => [small * angle, small * other],
                3 => [0.0, small * other],
                4 => [PI, [PI, 0.0][round / 8 % 2]],
                5 => [0.5 * PI, if angle > 0.0 { -0.5 * PI } else { 0.5 * PI }],
                _ => [angle, other],
            };
            let beyond = if round % 3 == 0 { noise.next() } else { 99.0 };
            let search = Search { theta, beyond };
            let equal = round % 5 == 0;
            let width = 10f64.powf(-7.0 * noise.next());
            let mut middle = [0, 1].map(|_| 20.0 * 10f64.powf(-3.0 * noise.next()));
            if round % 4 == 0 {
                middle = meeting(theta, if equal { [1.0; 2] } else { middle });
            }
            let size = middle.map(|x| [x * (1.0 - 0.5 * width), x * (1.0 + width)]);
            let least = search.least(size, equal, f64::INFINITY);
            let mut lowest = f64::INFINITY;
            for i in 0..12 {
                // Corners too.
                let part = |noise: &mut Noise| if i < 6 { noise.next() } else { noise.next().round() };
                let x = size.map(|[low, high]| (low + (high - low) * part(&mut noise)).clamp(low, high));
                let Some(found) = search.at(if equal { [x[0]; 2] } else { x }) else { continue };
                // Only those that are certainly not too long.
                if found.beyond > beyond {
                    continue;
                }
                assert!(least <= found.most * (1.0 + 1e-9), "{search:?} {size:?} {equal}: {least} {found:?}");
                lowest = lowest.min(found.most);
                compared += 1;
            }
            tight += usize::from(lowest.is_finite() && least > 0.999 * lowest);
        }
        println!("{compared} {tight}");
        assert!(compared > 20_000 && tight > 1000, "{compared} {tight}");
    }
}
