//! Numbers on the command line, with sentences where they are none.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::DeserializeOwned;
use spiral_atlas::tools::MOST_SAMPLES;

type Parsed<T> = std::result::Result<T, String>;

/// A number.
pub(super) fn number(text: &str) -> Parsed<f64> {
    text.trim().parse().map_err(|_| format!("{text:?} is no number; write it like 0.5, -3 or 1e-3"))
}

/// A whole number in a range.
pub(super) fn count<const LEAST: u32, const MOST: u32>(text: &str) -> Parsed<u32> {
    let count = text.trim().parse().ok().filter(|count| (LEAST..=MOST).contains(count));
    count.ok_or_else(|| format!("{text:?} is no whole number from {LEAST} to {MOST}"))
}

/// How many samples of a curve.
pub(super) fn samples(text: &str) -> Parsed<u32> {
    count::<2, MOST_SAMPLES>(text)
}

/// One of the names that a type is read from.
pub(super) fn named<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    names: &[&'static str],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names.iter().copied()).try_map(|name| serde_json::from_value(name.into()))
}
