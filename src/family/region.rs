//! What a family can prove of its flags over a whole box of data.

use crate::num::bernstein::{Quintic, halve, least};
use crate::num::{Form, Number, Verdict, formula};

/// Most coordinates of a box.
pub const MOST_SIDES: usize = 5;

/// What is proved of the flags over a closed box, bit by bit; see [`Region::facts`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Facts {
    /// Flags that hold at every point.
    pub inside: u8,
    /// Flags that hold at no point.
    pub outside: u8,
    /// About how much each coordinate moves what is left open: only a hint, for whoever halves the box.
    pub pull: [f64; MOST_SIDES],
}

/// Proofs over boxes, beside a family's proofs at points.
pub trait Region: Sync {
    /// Whether it has proofs in the family's chart of this name.
    fn covers(&self, chart: &str) -> bool;

    /// Shrinks a box so that it still holds each of its data of doubles that lies in the family's domain; false where
    /// there is none.
    fn clip(&self, chart: usize, low: &mut [f64], high: &mut [f64]) -> bool;

    /// Proves what it can of the flags in `wanted` over the closed box of all real points between `low` and `high`,
    /// both included.
    ///
    /// What is said of a flag holds at every point of the box that lies in the family's domain. So a box may leave
    /// the domain, and a flag's verdict may be proved although other conditions change inside. Nothing is said by
    /// chance: where rounding could matter, nothing is said.
    ///
    /// # Arguments
    /// - `chart`: index of the family's chart; `low` and `high` have a coordinate for each of its axes, with `low <=
    ///   high`.
    /// - `wanted`: the flags that matter; others may be left open.
    fn facts(&self, chart: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts;
}

/// The sides of a box in N coordinates; `None` in another number.
pub(super) fn sides<const N: usize>(low: &[f64], high: &[f64]) -> Option<[[f64; 2]; N]> {
    (low.len() == N && high.len() == N).then(|| std::array::from_fn(|i| [low[i], high[i]]))
}

/// Shrinks a side to the doubles from `least` to `most`; false where none is left.
pub(super) fn clip_side(low: &mut f64, high: &mut f64, least: f64, most: f64) -> bool {
    (*low, *high) = (low.max(least), high.min(most));
    *low <= *high
}

/// Whether a form is positive, or negative, all over the box.
pub(super) fn positive<const K: usize, const H: usize>(form: &Form<K, H>) -> Verdict {
    Verdict::proved(form.low() > 0.0, form.high() < 0.0)
}

/// Adds how much each coordinate moves a form, for its size.
pub(super) fn add_pull<const K: usize, const H: usize>(pull: &mut [f64; MOST_SIDES], form: &Form<K, H>) {
    let size = form.value.abs() + form.slope.iter().map(|s| s.abs()).sum::<f64>();
    if size > 0.0 && size.is_finite() {
        pull.iter_mut().zip(form.slope).for_each(|(pull, slope)| *pull += slope.abs() / size);
    }
}

impl Facts {
    /// Notes what is known of some flags.
    pub(super) fn note(&mut self, flags: u8, known: Verdict) {
        match known {
            Verdict::Yes => self.inside |= flags,
            Verdict::No => self.outside |= flags,
            Verdict::Undecided => {}
        }
    }
}

/// Whether a quintic in Bernstein's form is positive on [0, 1] all over the box, or negative somewhere on [0, 1] at
/// each place of it.
pub(super) fn unit_sign<const K: usize, const H: usize>(quintic: &Quintic<Form<K, H>>) -> Verdict {
    let middle: Quintic<f64> = quintic.map(|form| form.value);
    let (value, t) = least(&middle);
    let lowest = at(quintic, t);
    if value < 0.0 {
        return Verdict::proved(false, lowest.high() < 0.0);
    }
    // Where it is not positive even there, no halving helps. Elsewhere pieces stay open near its least value alone.
    Verdict::proved(lowest.low() > 0.0 && above(quintic, MOST_HALVINGS), false)
}

/// Halvings of [0, 1] at most: a least value of 2^-50 of the coefficients, below which their errors are, needs half as
/// many.
const MOST_HALVINGS: u32 = 26;

/// The quintic at t times a positive number: Horner's rule in `s = t / (1 - t)`, or in 1/s from the other end. Any s
/// is some t, so its rounding does not matter.
fn at<const K: usize, const H: usize>(c: &Quintic<Form<K, H>>, t: f64) -> Form<K, H> {
    const BINOMIALS: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
    let back = t > 0.5;
    let s = if back { (1.0 - t) / t } else { t / (1.0 - t) };
    let term = |i: usize| c[if back { i } else { 5 - i }].times(BINOMIALS[i]);
    (1..6).fold(term(0), |sum, i| formula!(sum * { s } + term(i)))
}

/// Whether the quintic is positive on [0, 1] all over the box, by halving.
fn above<const K: usize, const H: usize>(c: &Quintic<Form<K, H>>, depth: u32) -> bool {
    if c.iter().all(|form| form.low() > 0.0) {
        return true;
    }
    if depth == 0 || c[0].low() <= 0.0 || c[5].low() <= 0.0 {
        return false;
    }
    let (left, right) = halve(c);
    above(&left, depth - 1) && above(&right, depth - 1)
}
