//! A recipe as TOML has it, before anything is looked up.

use crate::error::written;
use crate::error::{Error, Result};
use crate::plain;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use toml::Spanned;

/// What is wrong, and which bytes of the text are to blame.
pub(super) struct Fault {
    pub at: Range<usize>,
    pub what: String,
}

impl Fault {
    pub(super) fn new(at: Range<usize>, what: impl ToString) -> Fault {
        Fault { at, what: what.to_string() }
    }

    /// An error of the recipe, with line and column.
    pub(super) fn within(self, text: &str) -> Error {
        let before = text.get(..self.at.start).unwrap_or(text);
        let (line, column) = plain::place(before);
        Error::Recipe(format!("line {line}, column {column}: {}", self.what))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRecipe {
    pub family: Spanned<String>,
    #[serde(default)]
    pub fields: Vec<Spanned<String>>,
    pub title: Option<String>,
    pub size: Option<Spanned<Vec<Pixels>>>,
    pub dpi: Option<Spanned<Pixels>>,
    pub atlas: Spanned<Vec<RawAtlas>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAtlas {
    pub name: Spanned<String>,
    pub family: Option<Spanned<String>>,
    pub kind: Option<Spanned<String>>,
    pub resolution: Option<Spanned<u32>>,
    pub budget: Option<Spanned<String>>,
    pub axes: Spanned<BTreeMap<Spanned<String>, Spanned<RawAxis>>>,
    #[serde(default)]
    pub picture: Vec<RawPicture>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAxis {
    // Not arrays: serde would take the first two of three values without a word.
    pub linear: Option<Vec<Number>>,
    pub log: Option<Vec<Number>>,
    pub values: Option<Vec<Number>>,
    pub count: Option<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPicture {
    pub kind: Spanned<String>,
    pub with: Option<Spanned<String>>,
    pub x: Spanned<String>,
    pub y: Spanned<String>,
    #[serde(default)]
    pub at: BTreeMap<Spanned<String>, Spanned<Numbers>>,
    #[serde(default)]
    pub regions: Vec<Spanned<String>>,
    #[serde(default)]
    pub outlines: Vec<Spanned<String>>,
    pub field: Option<Spanned<String>>,
    pub levels: Option<Spanned<Vec<f64>>>,
    #[serde(default)]
    pub mark: Vec<Spanned<BTreeMap<Spanned<String>, Spanned<Number>>>>,
    pub title: Option<String>,
    pub size: Option<Spanned<Vec<Pixels>>>,
    pub dpi: Option<Spanned<Pixels>>,
}

/// A number of pixels.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "expected a whole number that is not negative")]
pub(super) enum Pixels {
    Whole(u32),
}

impl Pixels {
    pub(super) fn count(self) -> u32 {
        let Pixels::Whole(count) = self;
        count
    }
}

/// A number, or a text that may be an angle.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number, or a text such as \"40deg\"")]
pub(super) enum Number {
    Plain(f64),
    Text(String),
}

/// One number or several.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number or a list of numbers")]
pub(super) enum Numbers {
    One(Number),
    Many(Vec<Number>),
}

impl Number {
    /// Its value on an axis. Texts are angles, and only axes of angles take them.
    pub(super) fn on(&self, axis: &str) -> Result<f64, String> {
        match self {
            Number::Plain(value) => Ok(*value),
            Number::Text(text) if is_angle(axis) => parse_angle(text).map_err(|e| format!("`{axis}`: {e}")),
            Number::Text(text) => Err(format!("`{axis}` is no angle, so {text:?} must be a plain number")),
        }
    }
}

/// Parses the text; an unknown key is refused with the nearest known one.
pub(super) fn parse(text: &str) -> Result<RawRecipe, Fault> {
    toml::from_str(text).map_err(|e| super::words::complaint(text, e.span().unwrap_or(0..0), e.message()))
}

/// The complaint about a name that is not known, with the nearest that is.
pub(super) fn unknown(what: &str, given: &str, known: &[&str]) -> String {
    let distance = |name: &&&str| strsim::damerau_levenshtein(given, name);
    let given = plain::cut(given);
    match known.iter().min_by_key(distance) {
        Some(name) if distance(&name) <= 1 + name.len() / 3 => {
            format!("unknown {what} `{given}`; did you mean `{name}`?")
        }
        Some(_) => format!("unknown {what} `{given}`; known are `{}`", known.join("`, `")),
        None => format!("unknown {what} `{given}`"),
    }
}

/// Whether the axes of this name are angles.
pub fn is_angle(axis: &str) -> bool {
    ["alpha", "beta", "phi", "theta"].iter().any(|start| axis.starts_with(start))
}

/// Reads a coordinate of an axis: an angle as [`parse_angle`], or a number.
///
/// # Errors
/// [`Error::Domain`], naming the axis and the text.
pub fn parse_coordinate(axis: &str, text: &str) -> Result<f64> {
    if is_angle(axis) {
        return parse_angle(text).map_err(|e| e.at(axis));
    }
    text.trim().parse().map_err(|_| Error::invalid(format!("{axis}: {text:?} is no number")))
}

/// Reads an angle: `40deg` or `40°`, `0.7rad`, or radians alone, `0.7`. Beyond a full turn the unit must be named.
///
/// # Returns
/// Radians; degrees are divided by 180 and then multiplied by π, each rounded once, so that `180deg` is π's double
/// itself.
///
/// # Errors
/// [`Error::Domain`] when it is no finite number with one of these units, or a number above 2π alone: degrees, most
/// likely.
///
/// ```
/// use spiral_atlas::recipe::parse_angle;
/// assert_eq!(parse_angle("90deg")?, std::f64::consts::FRAC_PI_2);
/// assert_eq!(parse_angle("0.7 rad")?, 0.7);
/// assert_eq!(parse_angle("40°")?, parse_angle("40deg")?);
/// assert!(parse_angle("40%").is_err() && parse_angle("40").is_err());
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn parse_angle(text: &str) -> Result<f64> {
    let trimmed = text.trim();
    let in_degrees = trimmed.strip_suffix("deg").or_else(|| trimmed.strip_suffix('°'));
    let (number, degrees) = match (in_degrees, trimmed.strip_suffix("rad")) {
        (Some(number), _) => (number, true),
        (None, Some(number)) => (number, false),
        (None, None) => (trimmed, false),
    };
    let unit = number.len() < trimmed.len();
    match number.trim_end().parse::<f64>() {
        Ok(value) if value.is_finite() && !unit && value.abs() > TAU => Err(Error::invalid(format!(
            "{text:?} is more than a full turn in radians; say which unit is meant: `{trimmed}deg` or `{trimmed}rad`"
        ))),
        Ok(value) if value.is_finite() => Ok(if degrees { value / 180.0 * PI } else { value }),
        _ => Err(Error::invalid(format!(
            "{text:?} is no angle; write radians such as `0.7`, or degrees such as `40deg` or `40°`"
        ))),
    }
}

/// Checks an angle that was given as a number of radians, as [`parse_angle`] does where there is no unit.
///
/// # Errors
/// [`Error::Domain`] when it is more than a full turn. What is not finite is for others to refuse, by its name.
pub fn bare_angle(radians: f64) -> Result<f64> {
    if !radians.is_finite() || radians.abs() <= TAU {
        return Ok(radians);
    }
    let number = written(radians);
    Err(Error::invalid(format!(
        "{number} is more than a full turn in radians; say which unit is meant: \"{number}deg\" or \"{number}rad\""
    )))
}
