//! The verdicts of many data that lie on no grid, by several threads.

use super::{Code, Family, verdict};
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
    let axes = family.about().charts[chart].axes.len();
    let whole = data.chunks_exact(axes);
    if !whole.remainder().is_empty() {
        let what = format!("the data are {} numbers; each datum has {axes}", data.len());
        return Err(RowError { row: whole.len(), error: Error::invalid(what) });
    }
    let mut codes = vec![Code::UNDECIDED; whole.len()];
    let pieces = codes.chunks_mut(PIECE).zip(data.chunks(PIECE * axes)).enumerate();
    let (pieces, failed) = (Mutex::new(pieces), AtomicBool::new(false));
    // Pieces are taken in order, and each that was taken is finished up to its first fault. So the first fault of all
    // is among those found.
    let take = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || -> Result<(), RowError> {
        while let (false, Some((piece, (codes, data)))) = (failed.load(Ordering::Relaxed), take()) {
            for (i, (code, datum)) in codes.iter_mut().zip(data.chunks_exact(axes)).enumerate() {
                *code = verdict(family, chart, datum).map_err(|error| {
                    failed.store(true, Ordering::Relaxed);
                    RowError { row: piece * PIECE + i, error }
                })?;
            }
        }
        Ok(())
    };
    let faults: Vec<RowError> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let own = work();
        let others =
            workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        others.chain([own]).filter_map(Result::err).collect()
    });
    match faults.into_iter().min_by_key(|fault| fault.row) {
        Some(fault) => Err(fault),
        None => Ok(codes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::cubic::Cubic;
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
        for threads in [1, 2, 7] {
            assert_eq!(verdicts(&Cubic, 0, &data, threads).unwrap(), one_by_one);
        }
        assert_eq!(verdicts(&Cubic, 0, &[], 3).unwrap(), []);
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
