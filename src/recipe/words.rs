//! What a reader of recipes complains of, in the words of a recipe: the key, what stands there, and what may stand there.

use super::raw::{Fault, unknown};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// What a key takes; those of axes stand for all axes.
const TAKES: &[(&str, &str)] = &[
    ("fields", "a list of texts such as `[\"margin\"]`"),
    ("atlas", "a section `[[atlas]]`, in double brackets"),
    ("picture", "a section `[[atlas.picture]]`, in double brackets"),
    ("axes", "a section `[atlas.axes]`, in single brackets, with a line for each axis"),
    ("linear", "two numbers such as `[0, 1.5]`; angles may be written \"40deg\""),
    ("log", "two numbers above 0 such as `[1, 100]`; angles may be written \"40deg\""),
    ("values", "a list of numbers such as `[0.5, 1]`; angles may be written \"40deg\""),
    ("count", "a whole number of at least 2, such as `41`"),
    ("at", "a table such as `{ phi0 = 0.7 }`"),
    ("mark", "a list of tables such as `[{ kappa0 = 0.4, kappa1 = 4, label = \"mine\" }]`"),
    ("regions", "a list of flags such as `[\"SPIRAL\"]`"),
    ("outlines", "a list of flags such as `[\"SPIRAL\"]`"),
    ("levels", "a list of numbers such as `[0.5, 1]`"),
];

/// A complaint of the TOML reader in plain words. Serde speaks of its own types, and names no key.
pub(super) fn plain(text: &str, at: Range<usize>, message: &str) -> Fault {
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
    } else if let (Some(path), Some(expected)) = (&path, message.split("expected ").nth(1)) {
        let key = path.last().map_or("", String::as_str);
        format!("`{key}` has {}, but it takes {}", snippet(text, &at), takes(path, expected))
    } else {
        format!("this is not TOML: {message}")
    };
    Fault::new(at, what)
}

fn takes<'a>(path: &[String], expected: &'a str) -> &'a str {
    let known = |key: &str| TAKES.iter().find(|(name, _)| *name == key).map(|(_, takes)| *takes);
    match path {
        [.., section, _] if section == "axes" => {
            "one of `{ linear = [lo, hi], count = n }`, `{ log = [lo, hi], count = n }`, `{ values = [..] }`"
        }
        [.., key] => known(key).unwrap_or(match expected {
            "a string" => "a text in quotation marks",
            "a sequence" => "a list in square brackets",
            "a map" => "a table in braces",
            "usize" | "u64" | "u32" => "a whole number of at least 0",
            "f64" | "f32" => "a number",
            other => other,
        }),
        [] => expected,
    }
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
