//! Verdicts and curves of many data that lie on no grid, by several threads.

use super::{About, Code, Family, verdict};
use crate::error::{Error, Result};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Rows that a thread takes at a time: much work against a lock, little against a whole table.
const PIECE: usize = 64;

/// The first row that has no verdict, and why.
#[derive(Debug, thiserror::Error)]
#[error("row {row}: {error}")]
pub struct RowError {
    /// From 0.
    pub row: usize,
    /// Why.
    pub error: Error,
}

/// The proved codes of many data, as an atlas has them at its nodes.
///
/// # Arguments
/// - `chart`: index into [`crate::family::About::charts`].
/// - `data`: one datum after another, each with as many numbers as the chart has axes, in the order of its axes.
/// - `threads`: workers, at least 1. The result does not depend on their number.
///
/// # Errors
/// For the first row without a verdict: [`Error::Domain`], naming the coordinate, outside the family's domain;
/// [`Error::Undecided`] at the precision cap. A last row that is not whole is an [`Error::Domain`], too.
pub fn verdicts(family: &dyn Family, chart: usize, data: &[f64], threads: usize) -> Result<Vec<Code>, RowError> {
    let (rows, axes) = whole_rows(family, chart, data)?;
    let mut codes = vec![Code::UNDECIDED; rows];
    let pieces = codes.chunks_mut(PIECE).zip(data.chunks(PIECE * axes));
    spread(pieces, threads, |(codes, data)| {
        in_order(codes.iter_mut().zip(data.chunks_exact(axes)), |(code, datum)| {
            *code = verdict(family, chart, datum)?;
            Ok(())
        })
    })?;
    Ok(codes)
}

/// What [`solve_batch`] finds.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// The code of each row, as [`verdicts`] has it.
    pub codes: Vec<Code>,
    /// [`crate::family::About::control_points`] points for each row: those of the chosen curve
    /// ([`crate::family::Answer::chosen`]), in the family's frame, or NaN where none is chosen.
    pub control_points: Vec<[f64; 2]>,
}

/// The proved codes of many data, and their curves: those that [`Family::answer`] has.
///
/// Arguments are those of [`verdicts`].
///
/// # Errors
/// As there, for the first row without an answer; and an [`Error::Domain`] where the family's answers have no control
/// points.
pub fn solve_batch(family: &dyn Family, chart: usize, data: &[f64], threads: usize) -> Result<Solved, RowError> {
    let (rows, axes) = whole_rows(family, chart, data)?;
    let About { name, control_points: each, .. } = *family.about();
    if each == 0 {
        let what = format!("the answers of `{name}` have no control points; ask for verdicts alone");
        return Err(RowError { row: 0, error: Error::invalid(what) });
    }
    let mut codes = vec![Code::UNDECIDED; rows];
    let mut control_points = vec![[f64::NAN; 2]; rows * each];
    let pieces = codes.chunks_mut(PIECE).zip(control_points.chunks_mut(PIECE * each)).zip(data.chunks(PIECE * axes));
    spread(pieces, threads, |((codes, points), data)| {
        let rows = codes.iter_mut().zip(points.chunks_exact_mut(each)).zip(data.chunks_exact(axes));
        in_order(rows, |((code, points), datum)| {
            let (own, curve) = family.chosen(chart, datum)?;
            *code = own;
            if let Some(curve) = curve {
                points.copy_from_slice(&curve);
            }
            Ok(())
        })
    })?;
    Ok(Solved { codes, control_points })
}

/// How many rows the data are, and how many numbers each has.
fn whole_rows(family: &dyn Family, chart: usize, data: &[f64]) -> Result<(usize, usize), RowError> {
    let axes = family.about().charts[chart].axes.len();
    let whole = data.chunks_exact(axes);
    if !whole.remainder().is_empty() {
        let what = format!("the data are {} numbers; each datum has {axes}", data.len());
        return Err(RowError { row: whole.len(), error: Error::invalid(what) });
    }
    Ok((whole.len(), axes))
}

/// Works at rows up to the first fault, which comes with its place among them.
fn in_order<T>(rows: impl Iterator<Item = T>, work: impl Fn(T) -> Result<()>) -> Result<(), RowError> {
    rows.enumerate().try_for_each(|(row, slots)| work(slots).map_err(|error| RowError { row, error }))
}

/// Works at pieces of [`PIECE`] rows by several threads. The fault is that of the first bad row of all.
fn spread<P>(
    pieces: impl ExactSizeIterator<Item = P> + Send,
    threads: usize,
    work: impl Fn(P) -> Result<(), RowError> + Sync,
) -> Result<(), RowError> {
    // Pieces are taken in order, and each that was taken is finished up to its first fault. So the first fault of all
    // is among those found.
    let threads = threads.min(pieces.len());
    let (pieces, failed) = (Mutex::new(pieces.enumerate()), AtomicBool::new(false));
    let take = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
    let worker = || -> Result<(), RowError> {
        while let (false, Some((piece, slots))) = (failed.load(Ordering::Relaxed), take()) {
            work(slots).map_err(|RowError { row, error }| {
                failed.store(true, Ordering::Relaxed);
                RowError { row: piece * PIECE + row, error }
            })?;
        }
        Ok(())
    };
    let faults: Vec<RowError> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads).map(|_| scope.spawn(worker)).collect();
        let own = worker();
        let others =
            workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        others.chain([own]).filter_map(Result::err).collect()
    });
    faults.into_iter().min_by_key(|fault| fault.row).map_or(Ok(()), Err)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::cubic::Cubic;
    use crate::family::{Value, Values};
    use crate::noise::Noise;

    fn data(rows: usize) -> Vec<f64> {
        let mut noise = Noise(5);
        let mut between = |low: f64, high: f64| low + (high - low) * 0.5 * (noise.signed() + 1.0);
        (0..rows).flat_map(|_| [between(0.1, 1.0), between(0.9, 1.5), between(0.05, 0.6), between(1.0, 50.0)]).collect()
    }

    #[test]
    fn all_rows_have_their_verdict_whatever_the_threads() {
        let data = data(1000);
        let one_by_one: Vec<Code> = data.chunks(4).map(|datum| verdict(&Cubic, 0, datum).unwrap()).collect();
        for threads in [1, 2, 7, usize::MAX] {
            assert_eq!(verdicts(&Cubic, 0, &data, threads).unwrap(), one_by_one);
        }
        assert_eq!(verdicts(&Cubic, 0, &[], 3).unwrap(), []);
    }

    #[test]
    fn curves_are_those_of_single_answers() {
        let data = data(1000);
        for threads in [1, 3] {
            let all = solve_batch(&Cubic, 0, &data, threads).unwrap();
            assert_eq!(all.codes, verdicts(&Cubic, 0, &data, threads).unwrap());
            let mut curves = 0;
            for (datum, points) in data.chunks(4).zip(all.control_points.chunks(4)) {
                match Cubic.answer(0, datum).unwrap().control_points() {
                    Some(own) => {
                        curves += 1;
                        assert_eq!(points, own);
                    }
                    None => assert!(points.as_flattened().iter().all(|x| x.is_nan())),
                }
            }
            assert!((100..900).contains(&curves), "{curves}");
        }
        let fault = solve_batch(crate::family::by_name("any-spiral").unwrap(), 0, &data, 1).unwrap_err();
        assert!(fault.error.to_string().contains("no control points"), "{fault}");
    }

    /// Every curve has as many points as the family says.
    #[test]
    fn families_say_how_many_control_points_they_have() {
        let data: [(&str, &[f64]); 5] = [
            ("cubic", &[0.7, 1.4, 0.4, 4.0]),
            ("ph-quintic", &[0.7, 1.4, 0.4, 4.0]),
            ("trig-quintic", &[3.0, 1.0, 0.5, 1.0, 1.0]),
            ("ph-equal-length", &[0.7, 0.9, 2.5]),
            ("ph-hermite", &[0.7, 0.9, 1.0, 1.2]),
        ];
        for family in crate::family::all() {
            let About { name, control_points, .. } = family.about();
            let Some((_, datum)) = data.iter().find(|(known, _)| known == name) else {
                assert_eq!(*control_points, 0, "{name}");
                continue;
            };
            let answer = family.answer(0, datum).unwrap();
            let points = |values: &Values| match values.iter().find(|(name, _)| *name == "control_points") {
                Some((_, Value::Points(points))) => points.len(),
                _ => 0,
            };
            assert!(!answer.solutions.is_empty(), "{name}");
            assert!(answer.solutions.iter().all(|solution| points(solution) == *control_points), "{name}");
        }
    }

    #[test]
    fn the_first_bad_row_is_named() {
        let mut data = data(1000);
        for row in [901, 417, 418] {
            data[4 * row + 2] = f64::NAN;
        }
        for threads in [1, 2, 7] {
            let fault = verdicts(&Cubic, 0, &data, threads).unwrap_err();
            assert!(
                fault.row == 417 && fault.to_string().starts_with("row 417: ") && fault.to_string().contains("kappa0"),
                "{fault}"
            );
        }
        assert_eq!(verdicts(&Cubic, 0, &data[..10], 1).unwrap_err().row, 2);
    }
}
