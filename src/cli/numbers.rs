//! Numbers on the command line, with sentences where they are none.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::DeserializeOwned;
use spiral_atlas::error::{Domain, Error};
use spiral_atlas::recipe::{parse_curvature, parse_number};
use spiral_atlas::transition::MOST_SAMPLES;
use spiral_atlas::transition::join::Family;
use std::str::FromStr;

/// A curvature is hardly meant that is so many times one over the distance of the ends.
const LARGE: f64 = 1e3;

type Parsed<T> = std::result::Result<T, String>;

/// A number.
pub(super) fn number(text: &str) -> Parsed<f64> {
    parse_number(text).map_err(|e| advised(&e, "write it like 0.5, -3 or 1e-3"))
}

/// A mistake with an advice, unless the mistake says itself what to write.
fn advised(error: &Error, advice: &str) -> String {
    match error {
        Error::Domain(Domain::NoNumber { instead: Some(_), .. }) => error.to_string(),
        _ => format!("{error}; {advice}"),
    }
}

/// Two of a kind, with a comma between.
pub(super) fn two<T: FromStr>(text: &str) -> Option<[T; 2]> {
    let (first, second) = text.split_once(',')?;
    Some([first.trim().parse().ok()?, second.trim().parse().ok()?])
}

/// A curvature: a number, or `1/radius`.
pub(super) fn curvature(text: &str) -> Parsed<f64> {
    parse_curvature(text).map_err(|e| advised(&e, "write a curvature like 0.004, or 1/250 for a radius of 250"))
}

/// What to ask whoever gives curvatures so large that they must be radii; nothing where none is.
pub(super) fn are_radii(from: [f64; 2], to: [f64; 2], curvatures: [f64; 2]) -> Option<String> {
    let distance = (to[0] - from[0]).hypot(to[1] - from[1]);
    let large = |(which, k): (&str, f64)| {
        let radius = format!("{k:?}");
        let radius = radius.trim_end_matches(".0");
        (k.is_finite() && k.abs() * distance > LARGE)
            .then(|| format!("is the {which} curvature {radius} a radius? A curvature is 1/radius: 1/{radius}"))
    };
    let asked: Vec<String> = ["start", "end"].into_iter().zip(curvatures).filter_map(large).collect();
    (!asked.is_empty()).then(|| asked.join("; "))
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
) -> impl TypedValueParser<Value = T> + use<T> {
    PossibleValuesParser::new(names.iter().copied()).try_map(|name| serde_json::from_value(name.into()))
}

/// One of the families of joins.
pub(super) fn joined() -> impl TypedValueParser<Value = Family> {
    named(&Family::ALL.map(Family::name))
}
