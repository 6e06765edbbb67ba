//! Reads a request in TOML or JSON.

use serde::de::DeserializeOwned;
use spiral_atlas::plain;
use spiral_atlas::tools::input;

/// What a text says, in TOML or else in JSON.
///
/// # Errors
/// What is wrong, after the path of where: `paths[1].start: ...`.
pub(crate) fn parse<T: DeserializeOwned>(text: &str, toml: bool) -> std::result::Result<T, String> {
    if !toml {
        return input::json(text);
    }
    // As a table first: read from the text, `[0, 0, 1]` would be taken for a point.
    let table = toml::from_str::<toml::Table>(text).map_err(|e| plain::toml(text, e.span(), e.message()))?;
    input::at_path(table, |path, e: &toml::de::Error| plain::value(path, e.message()))
}
