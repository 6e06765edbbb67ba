//! What a reader of recipes complains of, in the words of a recipe: the key, what stands there, and what may stand
//! there.

use super::keys::takes;
use super::raw::{Fault, RawRecipe, unknown};
use crate::plain;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Parses the text; an unknown key is refused with the nearest known one.
pub(super) fn parse(text: &str) -> Result<RawRecipe, Fault> {
    toml::from_str(text).map_err(|e| complaint(text, e.span().unwrap_or(0..0), e.message()))
}

/// A complaint of the TOML reader in plain words. Serde speaks of its own types, and names no key.
fn complaint(text: &str, at: Range<usize>, message: &str) -> Fault {
    let path = DeTable::parse(text).ok().and_then(|table| path_to(table.get_ref(), &at));
    let what = if let Some(rest) = message.strip_prefix("unknown field `") {
        let mut names = rest.split('`').step_by(2);
        let given = names.next().unwrap_or_default();
        unknown("key", given, &names.filter(|name| !name.is_empty()).collect::<Vec<_>>())
    } else if let Some(key) = message.strip_prefix("missing field ") {
        let place = match path.as_deref() {
            Some([.., last]) if last == "picture" => "this `[[atlas.picture]]`",
            Some([.., last]) if last == "atlas" => "this `[[atlas]]`",
            _ => "the recipe",
        };
        format!("{place} lacks the key {key}")
    } else if message == "duplicate key" {
        format!("`{}` is given twice; keep one (sections that repeat are written `[[..]]`)", snippet(text, &at))
    } else if let (Some(keys), Some(expected)) = (&path, message.split("expected ").nth(1)) {
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        let takes = takes(&keys).unwrap_or_else(|| expected.to_owned());
        format!("`{}` has {}, but it takes {takes}", keys.last().unwrap_or(&""), snippet(text, &at))
    } else {
        format!("this is not TOML: {}", plain::toml_syntax(text, &at, message))
    };
    Fault::new(at, what)
}

/// The first line of what stands in the text.
fn snippet(text: &str, at: &Range<usize>) -> String {
    let line = text.get(at.clone()).unwrap_or_default().lines().next().unwrap_or_default();
    if line.chars().count() > 40 { line.chars().take(40).chain(['…']).collect() } else { line.to_owned() }
}

/// The keys that lead to the value at a place; a list adds none.
fn path_to(table: &DeTable, at: &Range<usize>) -> Option<Vec<String>> {
    table.iter().find_map(|(key, value)| {
        let rest = if value.span() == *at { Some(Vec::new()) } else { within(value.get_ref(), at) }?;
        Some([key.get_ref().to_string()].into_iter().chain(rest).collect())
    })
}

fn within(value: &DeValue, at: &Range<usize>) -> Option<Vec<String>> {
    match value {
        DeValue::Table(table) => path_to(table, at),
        DeValue::Array(array) => {
            array.iter().find_map(|v| if v.span() == *at { Some(Vec::new()) } else { within(v.get_ref(), at) })
        }
        _ => None,
    }
}
