//! The work for one datum is bounded by its digits: its counted steps stay few near every case where the equations
//! degenerate.
//!
//! A step is one knot, one height that starts from logarithms, or one piece of an energy, a margin or a sign. Brackets
//! take some 60 knots at most, and solutions a dozen each. The pieces are halved down to the sharpest bend, which data
//! of doubles put as close to an end as 2^-1000. A few precisions are tried.

use super::{Datum, PhQuintic, SOLVABLE, flags, solve};
use crate::error::Error;
use crate::family::Family;
use crate::grid::{Axis, Grid, Spacing};
use crate::steps::counted;
use std::f64::consts::PI;

const ANGLES: [f64; 6] = [1e-300, 1e-100, 1e-10, 0.7, 1.4, 3.0];
const CURVATURES: [f64; 8] = [0.0, 1e-300, 1e-20, 0.2, 3.0, 1e60, 1e150, 1e300];

/// Counts one datum; whether it was answered.
fn case(datum: Datum, most: &mut (usize, Option<Datum>)) -> bool {
    let (verdict, proved) = counted(|| flags(&datum));
    let (steps, solved) = counted(|| solve(&datum));
    if verdict + steps > most.0 {
        *most = (verdict + steps, Some(datum));
    }
    match (proved, solved) {
        (Ok(flags), Ok(solutions)) => {
            assert_eq!(flags, solutions.flags(), "{datum:?}");
            true
        }
        (_, Err(Error::Undecided { .. } | Error::Domain(_))) => false,
        (proved, solved) => panic!("{datum:?}: {proved:?}, {solved:?}"),
    }
}

#[test]
fn few_steps_for_data_of_any_size() {
    let mut most = (0, None);
    let (mut all, mut answered) = (0, 0);
    for (i, phi0) in ANGLES.into_iter().enumerate() {
        for (j, phi1) in ANGLES.into_iter().enumerate().filter(|(_, phi1)| phi0 + phi1 < PI) {
            for (k, kappa0) in CURVATURES.into_iter().enumerate().skip((i + j) % 3).step_by(3) {
                // Another last curvature for each.
                let kappa1 = CURVATURES[(i + 3 * j + 5 * k) % CURVATURES.len()];
                all += 1;
                answered += usize::from(case(Datum { phi0, phi1, kappa0, kappa1 }, &mut most));
            }
        }
    }
    println!("{answered} of {all} answered; most steps {most:?}");
    assert!(most.0 < 2000 && answered * 10 > all * 8, "{answered} of {all} answered; most steps {most:?}");
}

#[test]
fn few_steps_beside_the_limits_of_angles_and_curvatures() {
    let mut most = (0, None);
    let next = |x: f64| [x.next_down(), x, x.next_up()];
    for phi0 in next(0.7) {
        for phi1 in
            next(0.7).into_iter().chain(next(PI - 0.7)).filter(|phi1| crate::num::sines::sum_below_pi(phi0, *phi1))
        {
            for kappa in [0.3, 1.0, 1e40] {
                for kappa1 in next(kappa) {
                    case(Datum { phi0, phi1, kappa0: kappa, kappa1 }, &mut most);
                }
            }
        }
    }
    println!("most steps {most:?}");
    assert!(most.0 < 1000, "{most:?}");
}

/// The speed in the middle is far below that at the ends, and the f64 step hardly knows it.
#[test]
fn few_steps_where_tangents_all_but_run_against_each_other() {
    let datum = Datum {
        phi0: 0.00012305211208073135,
        phi1: 3.141469601477712,
        kappa0: 2.9725652171194206e-5,
        kappa1: 0.000304662804446726,
    };
    let mut most = (0, None);
    assert!(case(datum, &mut most) && most.0 < 1000, "{most:?}");
}

/// Circular arcs of small angles, in doubles, and their neighbours: one solution is about to become three, some angle
/// apart. Doubles, sums of two and intervals of each precision try in turn, and each adds its steps.
#[test]
fn few_steps_near_a_fork_however_near() {
    let sizes =
        [1e-1, 1e-2, 1e-4, 1e-7, 1e-10, 1e-20, 1e-40, 1e-50, 1e-100, 1e-150, 1e-200, 1e-300, 1e-307, 1e-310, 5e-324];
    let mut most = (0, None);
    for x in sizes {
        let datum = Datum { phi0: x, phi1: x, kappa0: x, kappa1: x };
        assert_eq!((flags(&datum).ok(), solutions(datum)), (Some(SOLVABLE), Some(3)), "{x:e}");
        case(datum, &mut most);
        // A bending energy of 2x² that is no double.
        let refused = |e: Error| matches!(e, Error::Domain(_)) && 2.0 * x * x == 0.0;
        assert!(solve(&datum).map_or_else(refused, |found| found.all().len() == 3), "{x:e}");
    }
    for x in sizes {
        let near = [x, x.next_up(), 1.0001 * x, 1.5 * x];
        for i in (1..64).step_by(7) {
            let of = |place: usize| near[i >> (2 * place) & 3];
            let datum = Datum { phi0: x, phi1: of(0), kappa0: of(1), kappa1: of(2) };
            assert!(flags(&datum).is_ok(), "{datum:?}");
            case(datum, &mut most);
        }
    }
    println!("most steps {most:?}");
    assert!(most.0 < 2500, "{most:?}");
}

fn solutions(datum: Datum) -> Option<usize> {
    let Datum { phi0, phi1, kappa0, kappa1 } = datum;
    let axis = |(name, x): (&str, f64)| Axis::new(name, Spacing::Values(vec![x])).unwrap();
    let named = [("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)];
    let grid = Grid::new(named.into_iter().map(axis).collect()).unwrap();
    let (code, _) = PhQuintic.table(&grid).unwrap().exact(0).ok()?;
    Some(usize::from(code.counts() & 7))
}
