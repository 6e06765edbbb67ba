//! The nearest node in a few nanoseconds: a guess from the spacing, corrected against the values.

use crate::grid::{Axis, Spacing, nearest};

/// What [`Lookup::nearest`] needs to know about an axis besides its values.
#[derive(Debug)]
pub(crate) struct Lookup {
    guess: Guess,
    low: f64,
    high: f64,
}

#[derive(Debug)]
enum Guess {
    /// Cell `(x - lo) per`.
    Linear { lo: f64, per: f64 },
    /// Cell `(ln x - ln_lo) per`.
    Log { ln_lo: f64, per: f64 },
    /// None: search.
    None,
}

impl Lookup {
    pub fn new(axis: &Axis) -> Lookup {
        let values = axis.values();
        let (first, last) = (values[0], values[values.len() - 1]);
        // Halved before subtracting, so that nothing overflows.
        let half_step = |pair: Option<&[f64]>| pair.map_or(0.0, |p| 0.5 * p[1] - 0.5 * p[0]);
        let low = (first - half_step(values.windows(2).next())).max(f64::MIN);
        let high = (last + half_step(values.windows(2).next_back())).min(f64::MAX);
        let guess = match *axis.spacing() {
            Spacing::Linear { lo, hi, count } => Guess::Linear { lo, per: (count - 1) as f64 / (hi - lo) },
            Spacing::Log { lo, hi, count } => Guess::Log { ln_lo: lo.ln(), per: (count - 1) as f64 / (hi.ln() - lo.ln()) },
            Spacing::Values(_) => Guess::None,
        };
        Lookup { guess, low, high }
    }

    /// [`Axis::nearest`], except that points further outside than half the step at that end give `None`.
    ///
    /// An axis of a single value has no step, and so accepts that value alone. `values` are those of the axis.
    #[inline]
    pub fn nearest(&self, values: &[f64], x: f64) -> Option<usize> {
        // NaN fails both comparisons, an infinity one.
        if !(self.low <= x && x <= self.high) {
            return None;
        }
        let Some(last_cell) = values.len().checked_sub(2) else { return Some(0) };
        // Casts saturate, and turn NaN into 0.
        let guess = match self.guess {
            Guess::Linear { lo, per } => (x - lo) * per,
            Guess::Log { ln_lo, per } => (x.ln() - ln_lo) * per,
            Guess::None => return nearest(values, x),
        };
        let mut cell = (guess as usize).min(last_cell);
        // Rounding may put a guess close to a node into the cell beside it.
        if x <= values[cell] {
            cell = cell.saturating_sub(1);
        } else if x > values[cell + 1] {
            cell = (cell + 1).min(last_cell);
        }
        let (below, above) = (values[cell], values[cell + 1]);
        if below < x && x <= above {
            return Some(if above - x < x - below { cell + 1 } else { cell });
        }
        // At or beyond an end, or a spacing so extreme that the guess was useless.
        nearest(values, x)
    }
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
            linear(-f64::MAX, f64::MAX, 3),
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
                assert_eq!(lookup.nearest(axis.values(), x), expected, "{x:?} on {axis:?}");
                *(if expected.is_some() { &mut inside } else { &mut outside }) += 1;
            }
            assert!(inside >= 1 && outside >= 4, "{inside} points inside, {outside} outside {axis:?}");
        }
    }

    #[test]
    fn accepts_half_a_step_outside_and_no_more() {
        let axis = Axis::new("x", Spacing::Values(vec![1.0, 2.0, 6.0])).unwrap();
        let nearest = |x| Lookup::new(&axis).nearest(axis.values(), x);
        assert_eq!([0.5, 8.0].map(nearest), [Some(0), Some(2)]);
        assert_eq!([0.5f64.next_down(), 8f64.next_up(), f64::NAN].map(nearest), [None; 3]);
        let single = Axis::new("x", Spacing::Values(vec![0.7])).unwrap();
        let nearest = |x| Lookup::new(&single).nearest(single.values(), x);
        assert_eq!([0.7f64.next_down(), 0.7, 0.7f64.next_up()].map(nearest), [None, Some(0), None]);
    }
}
