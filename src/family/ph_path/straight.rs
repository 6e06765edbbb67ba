//! Both angles 0: a real pre-image makes a straight line, which may turn back.
//!
//! Let `a = √l0`, `b = √l1`, `m = √(ab)`. With w2 = -b, w changes its sign. With w2 = b it stays positive exactly if
//! `w1 > -m`, which only the larger w1 can do: `√Z > 3(a + b) - 4m`, or `5 > l0 + l1 + ab - (a + b)m`. Squared twice
//! that is a question about the sign of `x + y ab` for polynomials x, y in l0, l1, and so of `x² - y² l0 l1`: in
//! doubles' intervals that is exact at some precision, so that a zero is recognised.

use crate::num::{Interval, Verdict, formula};
use std::cmp::Ordering::{self, Equal, Greater};

/// Whether some line with these end speeds, in chords, moves on throughout.
///
/// Z must not be negative.
pub(super) fn moves_on(size: [f64; 2], bits: usize) -> Verdict {
    let [l0, l1] = size.map(|l| Interval::new(l, bits));
    let (sum, product) = (&l0 + &l1, &l0 * &l1);
    let less = sum.plus(-5.0);
    let number = |x: f64| Interval::new(x, bits);
    // 5 - l0 - l1 - ab >= 0: the rest is positive.
    match sign(&-&less, &number(-1.0), &product) {
        None => return Verdict::Undecided,
        Some(Ordering::Less) => {}
        Some(_) => return Verdict::Yes,
    }
    // (a + b)² m² against its square.
    let whole = sign(&(&product - &less.square()), &formula!(-sum + 10.0), &product);
    whole.map(|whole| whole == Greater).into()
}

/// The sign of `x + y √product`.
fn sign(x: &Interval, y: &Interval, product: &Interval) -> Option<Ordering> {
    let (of_x, of_y) = (x.sign()?, y.sign()?);
    if of_x == of_y || of_y == Equal {
        return Some(of_x);
    }
    if of_x == Equal {
        return Some(of_y);
    }
    let apart = formula!(x.square() - y.square() * product).sign()?;
    Some(if of_x == Greater { apart } else { apart.reverse() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::climb;

    fn decided(l0: f64, l1: f64) -> bool {
        climb(&[l0, l1], "a line", |bits| moves_on([l0, l1], bits).decided()).unwrap().0
    }

    /// Against the least value of w, and at the tie l0 = l1 = 5.
    #[test]
    fn lines_move_on_where_their_preimage_stays_positive() {
        let mut both = [0, 0];
        for i in 1..60 {
            for j in 1..60 {
                let (l0, l1) = (0.13 * f64::from(i), 0.13 * f64::from(j));
                let (a, b) = (l0.sqrt(), l1.sqrt());
                let square = 120.0 - 15.0 * (l0 + l1) + 10.0 * a * b;
                if square < 0.0 {
                    continue;
                }
                let w1 = (square.sqrt() - 3.0 * (a + b)) / 4.0;
                let least = w1 + (a * b).sqrt();
                assert!(least.abs() > 1e-9);
                assert_eq!(decided(l0, l1), least > 0.0, "{l0} {l1}");
                both[usize::from(least > 0.0)] += 1;
            }
        }
        assert!(both.iter().all(|n| *n > 100), "{both:?}");
        assert!(!decided(5.0, 5.0) && decided(5.0_f64.next_down(), 5.0) && !decided(5.0_f64.next_up(), 5.0));
    }
}
