//! The bending energy of a Pythagorean-hodograph quintic.

use super::PhQuintic;
use super::energy::energy as energy_integral;
use crate::num::{Ball, Interval, Number, Real, formula};
use crate::steps::step;

/// Bits with which σ and h are rewritten from where the curve is slow. Of a regular curve w is at least 1e-6 of its
/// size, so coefficients lose 80 bits at most.
const BITS: usize = 256;

impl PhQuintic {
    /// Bending energy `∫κ² ds`, 1 / length; infinite for a curve that is not [regular](PhQuintic::is_regular) and no
    /// straight line.
    ///
    /// # Accuracy
    /// 2^-40, relative, proved: an enclosure by Taylor series with remainder.
    ///
    /// The work is bounded: pieces are halved towards the places where the curve is slow, and the speed of a regular
    /// curve is nowhere below 1e-12 of its mean. Where doubles lose digits on the way there, the curve is written anew
    /// from its slowest places.
    pub fn bending_energy(&self) -> f64 {
        let (unit, size) = self.scaled();
        if unit.turn_coefficients() == [0.0; 3] {
            return 0.0;
        }
        if !self.is_regular() {
            return f64::INFINITY;
        }
        let plain = || energy(&rates(&unit.preimage.map(|z| z.map(|x| Ball::of(x, 53))))?);
        // Underflow adds to errors what only nearly straight curves notice.
        let known = |e: &Ball| e.value.is_finite() && e.error <= 2f64.powi(-40) * e.value + 1e-300;
        let energy = plain().filter(known).or_else(|| unit.energy_from_slow_places().filter(known)).or_else(|| {
            // What cancels in a nearly straight curve; regular, it has few pieces.
            let w = unit.preimage.map(|z| z.map(|x| Interval::new(x, BITS)));
            energy(&rates(&w)?).map(|e| Ball::enclosing(&e)).filter(known)
        });
        energy.map_or(f64::INFINITY, |e| e.value / size)
    }

    /// The sum over parts that begin and end where the speed is least.
    fn energy_from_slow_places(&self) -> Option<Ball> {
        let mut ends = self.speed_extrema();
        ends.insert(0, 0.0);
        ends.push(1.0);
        let part = |w: &[f64]| {
            let (speed, turn) = rates(&self.part([w[0], w[1]]))?;
            // With u = (t - a)/(b - a) as parameter h is `b - a` times as large, and dt is `(b - a) du`.
            let inverse = Ball::of(1.0, 53).over(&Ball::near(w[1] - w[0], 1.0))?;
            Some(energy(&(speed.map(|x| Ball::enclosing(&x)), turn.map(|x| Ball::enclosing(&x))))?.mul(&inverse))
        };
        ends.windows(2).map(part).reduce(|sum, part| Some(sum?.add(&part?)))?
    }

    /// Bernstein coefficients of w between two parameters: its polar form.
    fn part(&self, [a, b]: [f64; 2]) -> [[Interval; 2]; 3] {
        let of = |x: f64| Interval::new(x, BITS);
        let (one, [a, b]) = (of(1.0), [a, b].map(of));
        let polar = |s: &Interval, t: &Interval| {
            let (left, right) = (&one - s, &one - t);
            let weights = [&left * &right, formula!(left * t + s * right), s * t];
            [0, 1].map(|k| {
                let terms = [0, 1, 2].map(|i| &weights[i] * &of(self.preimage[i][k]));
                formula!(terms[0] + terms[1] + terms[2])
            })
        };
        [polar(&a, &a), polar(&a, &b), polar(&b, &b)]
    }
}

/// Bernstein coefficients of the speed σ and of h: Farouki et al., (6), (14).
type Rates<N> = ([N; 5], [N; 3]);

fn rates<N: Real>(w: &[[N; 2]; 3]) -> Option<Rates<N>> {
    let re = |i: usize, j: usize| formula!(w[i][0] * w[j][0] + w[i][1] * w[j][1]);
    // By the difference, which for nearly straight curves is small and exact.
    let im = |i: usize, j: usize| {
        let step = [0, 1].map(|k| formula!(w[j][k] - w[i][k]));
        formula!(w[i][0] * step[1] - w[i][1] * step[0])
    };
    let middle = formula!(2.0 * re(1, 1) + re(0, 2)).over(&N::of(3.0, w[0][0].bits()))?;
    let speed = [re(0, 0), re(0, 1), middle, re(1, 2), re(2, 2)];
    Some((speed, [im(0, 1).times(4.0), im(0, 2).times(2.0), im(1, 2).times(4.0)]))
}

/// `∫ h²/σ³` over [0, 1].
fn energy<N: Real>((speed, turn): &Rates<N>) -> Option<N> {
    step();
    // The square of a small h would leave the range of doubles, so h is scaled to size 1 by powers of 2 that are
    // doubles themselves.
    let most = turn.iter().fold(f64::MIN_POSITIVE, |most, h| h.most().max(most));
    let half = most.log2().floor() * 0.5;
    let (first, last) = (half.floor().exp2(), half.ceil().exp2());
    let energy = energy_integral(speed, &turn.clone().map(|h| formula!(h * { 1.0 / first } * { 1.0 / last })))?;
    Some([first, last, first, last].iter().fold(energy, |energy, factor| energy.times(*factor)))
}

#[cfg(test)]
mod tests {
    use crate::curve::{Hermite, hermite};
    use crate::steps::counted;

    /// End derivatives and chords from 1e-154 to 1e154, ends that coincide, mirrored and opposed directions: an energy
    /// takes at most one integral in plain doubles and four from the slow places, of a hundred pieces each, and only
    /// what is not regular has none.
    #[test]
    fn energies_of_any_ends_take_few_integrals() {
        let (mut most, mut regular) = (0, 0);
        for chord in [0.0, 1e-154, 1e-12, 1.0, 1e4, 1e5, 1e12, 1e154] {
            for size in [1e-154, 1e-20, 1e-5, 1.0, 1e7, 1e154] {
                for [first, last] in [[0.3, -0.3], [0.3, 0.3], [0.3, 2.5], [0.0, 1e-9], [1.0, -2.141592653589793]] {
                    let way = |angle: f64, size: f64| [size * angle.cos(), size * angle.sin()];
                    let (start_derivative, end_derivative) = (way(first, size), way(last, 1.0));
                    let ends = Hermite { start: [0.0, 0.0], end: [chord, 0.0], start_derivative, end_derivative };
                    let Ok(choice) = hermite(&ends) else { continue };
                    for candidate in &choice.candidates {
                        let (steps, energy) = counted(|| candidate.curve.bending_energy());
                        most = most.max(steps);
                        assert!(!candidate.regular || energy.is_finite(), "{ends:?}: {:?}", candidate.curve);
                        regular += usize::from(candidate.regular);
                    }
                }
            }
        }
        assert!(most <= 500 && regular > 300, "{most} {regular}");
    }
}
