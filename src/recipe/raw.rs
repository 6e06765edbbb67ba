//! A recipe as TOML has it, before anything is looked up.

use crate::error::{Error, Result};
use crate::plain::{self, parse_angle, parse_number};
use serde::Deserialize;
use std::collections::BTreeMap;
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

/// The complaint about a name that is not known, with the nearest that is.
pub(super) fn unknown(what: &str, given: &str, known: &[&str]) -> String {
    let near = plain::nearest(given, known.iter().copied());
    let given = plain::cut(given);
    match near {
        Some(name) => format!("unknown {what} `{given}`; did you mean `{name}`?"),
        None if known.is_empty() => format!("unknown {what} `{given}`"),
        None => format!("unknown {what} `{given}`; known are `{}`", known.join("`, `")),
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
    parse_number(text).map_err(|e| e.at(axis))
}
