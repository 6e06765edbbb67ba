//! The nearest node in a few nanoseconds: a guess from the spacing, corrected against the values.

use crate::grid::{Axis, Spacing, nearest};

/// An axis, ready for lookups.
#[derive(Debug)]
pub(crate) struct Lookup {
    /// The values between two infinities, so that every value has neighbours.
    padded: Box<[f64]>,
    guess: Guess,
    low: f64,
    high: f64,
}

/// How to guess an index: the integer nearest to this. What is added puts midpoints of values at midpoints of integers.
#[derive(Debug)]
enum Guess {
    /// `x per + add`
    Linear { per: f64, add: f64 },
    /// `log2(x) per + add`
    Log { per: f64, add: f64 },
    /// No guess: search.
    None,
}

impl Guess {
    fn new(axis: &Axis) -> Guess {
        match *axis.spacing() {
            Spacing::Linear { lo, hi, count } => {
                let per = (count - 1) as f64 / (hi - lo);
                Guess::Linear { per, add: -lo * per }
            }
            Spacing::Log { lo, hi, count } => {
                let step = (hi.log2() - lo.log2()) / (count - 1) as f64;
                // The arithmetic mean of 1 and 2^step, as a fraction of a step.
                let middle = (0.5 * step.exp2() + 0.5).log2() / step;
                Guess::Log { per: 1.0 / step, add: 0.5 - middle - lo.log2() / step }
            }
            Spacing::Values(_) => Guess::None,
        }
    }
}

impl Lookup {
    pub(crate) fn new(axis: &Axis) -> Lookup {
        let values = axis.values();
        let (first, last) = (values[0], values[values.len() - 1]);
        // Halved before subtracting, so that nothing overflows.
        let half_step = |pair: Option<&[f64]>| pair.map_or(0.0, |p| 0.5 * p[1] - 0.5 * p[0]);
        let low = (first - half_step(values.windows(2).next())).max(f64::MIN);
        let high = (last + half_step(values.windows(2).next_back())).min(f64::MAX);
        let padded = [&[f64::NEG_INFINITY], values, &[f64::INFINITY]].concat();
        Lookup { padded: padded.into(), guess: Guess::new(axis), low, high }
    }

    /// Number of values.
    #[inline]
    pub(crate) fn count(&self) -> usize {
        self.padded.len() - 2
    }

    /// About the index of the value nearest to `x`, with its fraction.
    #[inline]
    fn guess(&self, x: f64) -> f64 {
        match self.guess {
            Guess::Linear { per, add } => x * per + add,
            Guess::Log { per, add } => rough_log2(x) * per + add,
            Guess::None => f64::NAN,
        }
    }

    /// Index of the cell between two neighbouring values that holds `x`; of two the upper one. `None` outside the axis.
    #[inline]
    pub(crate) fn cell(&self, x: f64) -> Option<usize> {
        let last = self.count().checked_sub(2)?;
        // Between two values the guess lies between their indices; the comparisons find a wrong one. NaN fails both.
        let index = (nearest_integer(self.guess(x) - 0.5) as usize).min(last);
        if let [low, high] = self.padded[index + 1..index + 3]
            && (low <= x) & (x <= high)
        {
            return Some(index);
        }
        let values = &self.padded[1..=self.count()];
        // NaN fails.
        let inside = (values[0] <= x) & (x <= values[last + 1]);
        inside.then(|| values.partition_point(|v| *v <= x).saturating_sub(1).min(last))
    }

    /// [`Axis::nearest`], except that points further outside than half the step at that end give `None`.
    ///
    /// An axis of a single value has no step, and so accepts that value alone.
    #[inline]
    pub(crate) fn nearest(&self, x: f64) -> Option<usize> {
        // NaN fails both comparisons, an infinity one.
        if !((self.low <= x) & (x <= self.high)) {
            return None;
        }
        let guess = self.guess(x);
        // Any guess will do for an index in range; the comparisons below find a wrong one.
        let index = (nearest_integer(guess) as usize).min(self.count() - 1);
        if let [below, here, above] = self.padded[index..index + 3] {
            // With `x <= here` the second holds anyway, else the first; so no branch depends on which half of a step x
            // is in. Differences that round alike are left to the search.
            if (here - x < x - below) & (x - here < above - x) {
                return Some(index);
            }
        }
        // Explicit values, a point so close to a midpoint that the guess was misled, or an extreme spacing.
        nearest(&self.padded[1..=self.count()], x)
    }
}

/// The integer nearest to `x` for `0 <= x < 2^31`, and some number for any other `x`: quicker than a cast.
#[inline]
fn nearest_integer(x: f64) -> u32 {
    // Next to 1.5 * 2^52 neighbouring doubles differ by 1, so the sum rounds to an integer, which is its low bits.
    (x + 6755399441055744.0).to_bits() as u32
}

/// log2 of a positive normal `x` to 1.3e-4, and some number for any other `x`: several times quicker than the exact
/// one.
#[inline]
fn rough_log2(x: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    let exponent = (x.to_bits() >> 52) as i32 - 1023;
    let z = f64::from_bits(x.to_bits() & FRACTION | 1f64.to_bits()) - 1.0;
    // log2(1 + z) = z + z (1 - z) p(z), with p fitted by least squares: exact at both ends of an octave.
    let p = 0.43837932982764094 + z * (-0.23750132506741717 + z * 0.08065315847911843);
    f64::from(exponent) + z + z * (1.0 - z) * p
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes() -> Vec<Axis> {
        let linear = |lo, hi, count| Spacing::Linear { lo, hi, count };
        let log = |lo, hi, count| Spacing::Log { lo, hi, count };
        let spacings = [
            linear(0.1, 1.2, 41),
            linear(-3.0, 1e-3, 7),
            linear(1e-300, 1.0, 2),
            linear(-f64::MAX / 2.0, f64::MAX / 2.0, 3),
            linear(1.0, 1.0 + 8.0 * f64::EPSILON, 9),
            log(1.0, 100.0, 43),
            log(1e-3, 1e4, 301),
            log(1e-300, 1e300, 12),
            log(1.0, 1.0 + 8.0 * f64::EPSILON, 5),
            Spacing::Values(vec![-1.0, 0.0, 0.1, 7.0]),
            Spacing::Values(vec![0.7]),
        ];
        spacings.into_iter().map(|s| Axis::new("x", s).unwrap()).collect()
    }

    /// Every node, midpoint and end of the accepted range, each with its neighbouring doubles, and points between.
    fn probes(axis: &Axis, lookup: &Lookup) -> Vec<f64> {
        let values = axis.values();
        let mids = values.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]);
        let quarters = values.windows(2).map(|w| 0.75 * w[0] + 0.25 * w[1]);
        let mut points: Vec<f64> = values.iter().copied().chain(mids).chain(quarters).collect();
        points.extend([lookup.low, lookup.high, 0.0, -0.0, f64::MAX, f64::MIN, f64::INFINITY, f64::NEG_INFINITY]);
        let near = |x: &f64| [x.next_down().next_down(), x.next_down(), *x, x.next_up(), x.next_up().next_up()];
        points.iter().flat_map(near).collect()
    }

    #[test]
    fn equals_the_search_of_the_axis() {
        for axis in axes() {
            let lookup = Lookup::new(&axis);
            let (mut inside, mut outside) = (0, 0);
            for x in probes(&axis, &lookup) {
                let expected = axis.nearest(x).filter(|_| lookup.low <= x && x <= lookup.high);
                assert_eq!(lookup.nearest(x), expected, "{x:?} on {axis:?}");
                *(if expected.is_some() { &mut inside } else { &mut outside }) += 1;
            }
            assert!(inside >= 1 && outside >= 4, "{inside} points inside, {outside} outside {axis:?}");
        }
    }

    #[test]
    fn rough_logarithms_are_close_enough() {
        let worst = (1..4000).map(|i| i as f64 / 1000.0).map(|x| (rough_log2(x) - x.log2()).abs()).fold(0.0, f64::max);
        assert!((1e-5..1.31e-4).contains(&worst), "{worst}");
    }

    /// Beside the middle of two values, where differences round alike: the sum of the two against twice x, exactly.
    #[test]
    fn neighbouring_doubles_beside_a_middle_get_their_own_value() {
        let mut alike = 0;
        for (low, high) in [(-1e-20, 1.0), (-1e-17, 1.0), (0.1, 1.2), (-0.3, 0.7), (1e-20, 3.0), (-7.0, 1e-9)] {
            let axis = Axis::new("x", Spacing::Values(vec![low, high])).unwrap();
            let middle = 0.5 * low + 0.5 * high;
            for x in [middle.next_down(), middle, middle.next_up()] {
                let (sum, lost) = crate::num::sines::two_sum(low, high);
                let upper = sum < 2.0 * x || sum == 2.0 * x && lost < 0.0;
                assert_eq!(axis.nearest(x), Some(usize::from(upper)), "{low} {high} {x}");
                assert_eq!(Lookup::new(&axis).nearest(x), Some(usize::from(upper)), "{low} {high} {x}");
                alike += usize::from(upper && high - x == x - low);
            }
        }
        assert!(alike > 0);
    }

    #[test]
    fn accepts_half_a_step_outside_and_no_more() {
        let axis = Axis::new("x", Spacing::Values(vec![1.0, 2.0, 6.0])).unwrap();
        let nearest = |x| Lookup::new(&axis).nearest(x);
        assert_eq!([0.5, 8.0].map(nearest), [Some(0), Some(2)]);
        assert_eq!([0.5f64.next_down(), 8f64.next_up(), f64::NAN].map(nearest), [None; 3]);
        let single = Axis::new("x", Spacing::Values(vec![0.7])).unwrap();
        let nearest = |x| Lookup::new(&single).nearest(x);
        assert_eq!([0.7f64.next_down(), 0.7, 0.7f64.next_up()].map(nearest), [None, Some(0), None]);
    }
}
