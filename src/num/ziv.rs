//! The ladder of precisions.

use crate::error::{Error, Result};
use std::fmt::Debug;

/// Precision of the first try, in bits.
const FIRST_BITS: usize = 128;
/// Documented cap: a verdict still open here is an error. Sums of the tiniest and the largest doubles need some 4000
/// bits.
const MOST_BITS: usize = 16384;

/// Runs `attempt` with doubling precision until it succeeds; returns its result and the bits that were needed.
///
/// # Errors
/// [`Error::Undecided`] at 16384 bits, with the datum and what was to be decided.
pub(crate) fn climb<T>(datum: &impl Debug, what: &str, attempt: impl Fn(usize) -> Option<T>) -> Result<(T, usize)> {
    let mut bits = FIRST_BITS;
    while bits <= MOST_BITS {
        if let Some(found) = attempt(bits) {
            return Ok((found, bits));
        }
        bits *= 2;
    }
    let text = format!("{datum:?}");
    // Fields without the type's name.
    let coordinates =
        text.split_once(" { ").map_or(text.as_str(), |(_, fields)| fields.trim_end_matches(" }")).to_owned();
    Err(Error::Undecided { node: None, coordinates, what: what.into(), bits: MOST_BITS })
}
