//! Complaints of the readers of JSON and TOML as sentences: where, what must stand there, and what does.
//!
//! Serde's messages have few forms and speak of Rust's types; tests hold the sentences to them.

mod angle;
mod name;
mod number;

pub use angle::{bare_angle, parse_angle};
pub use name::{name, names};
pub use number::{parse_curvature, parse_number};
use std::ops::Range;

/// Most characters of a value that are quoted.
const QUOTED: usize = 60;

/// A complaint of JSON's reader about the value at a path such as `paths[1].start`; an empty path is the whole text.
pub fn json(path: &str, error: &serde_json::Error) -> String {
    use serde_json::error::Category;
    let whole = error.to_string();
    let what = whole.rfind(" at line ").map_or(&whole[..], |end| &whole[..end]);
    let place = format!("line {}, column {}", error.line(), error.column());
    let at = if path.is_empty() { String::new() } else { format!(", at {path}") };
    match error.classify() {
        _ if what == "trailing characters" && !path.is_empty() => {
            format!("{path} has more values than belong there ({place})")
        }
        _ if what == "number out of range" => {
            let whose = if path.is_empty() { "a number" } else { path };
            format!("{whose} is beyond the range of doubles, which ends at 1.8e308 ({place})")
        }
        Category::Data if error.line() == 0 => value(path, what),
        Category::Data => format!("{} ({place})", value(path, what)),
        Category::Eof if error.line() <= 1 && error.column() == 0 => "it is empty, where JSON must stand".into(),
        Category::Eof => format!("it ends in the middle of its JSON ({place}{at}); is it cut off?"),
        Category::Syntax | Category::Io => format!("it is not JSON ({place}{at}): {}", syntax(what)),
    }
}

/// A complaint of TOML's reader about the text: what is wrong, with the line and column of the bytes that are to blame.
pub fn toml(text: &str, at: Option<Range<usize>>, message: &str) -> String {
    let at = at.unwrap_or(0..0);
    let (line, column) = place(text.get(..at.start).unwrap_or_default());
    format!("it is not TOML (line {line}, column {column}): {}", toml_syntax(text, &at, message))
}

/// So many of something that takes an s, one of it without.
pub fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Line and column of what follows a text.
pub fn place(before: &str) -> (usize, usize) {
    (before.matches('\n').count() + 1, before.chars().rev().take_while(|c| *c != '\n').count() + 1)
}

/// What is wrong with a text that is not JSON.
fn syntax(message: &str) -> &str {
    match message {
        "expected ident" => "there is a word that is none of true, false and null",
        "expected value" => "a value is missing there, or is none; JSON has neither NaN nor Infinity",
        "expected `:`" => "a colon is missing after a name",
        "expected `,` or `}`" | "expected `,` or `]`" => "a comma is missing, or the closing bracket",
        "key must be a string" => "a name must stand in quotation marks",
        "trailing comma" => "nothing follows after a comma",
        "trailing characters" => "something follows after its end",
        "invalid number" => "there is a number that JSON does not know",
        "invalid escape" => "there is a backslash in a text that JSON does not know",
        "recursion limit exceeded" => DEEP,
        other => other,
    }
}

const DEEP: &str = "lists are in each other too deep";

/// What is wrong with a text that is not TOML, of which the reader blames these bytes.
pub fn toml_syntax(text: &str, at: &Range<usize>, message: &str) -> String {
    let given = cut(word(text, at));
    let what = message.split(", expected").next().unwrap_or_default();
    let number = what.starts_with("invalid ")
        && [" number", "float", "mantissa", "fraction", "exponent", "date-time", "date", "time"]
            .iter()
            .any(|end| what.ends_with(end));
    match what {
        "string values must be quoted" | "missing value for key" | "missing value" if given.is_empty() => {
            "a value is missing"
        }
        "string values must be quoted"
        | "integer number overflowed"
        | "unexpected leading zero"
        | "unexpected sign" => {
            return no_number(&given);
        }
        _ if number => return no_number(&given),
        "invalid boolean" => return format!("`{given}` is neither `true` nor `false`, nor a text in quotation marks"),
        "key with no value" | "invalid key-value pair" => "a name has no value; write `name = value`",
        "unquoted keys cannot be empty" => "a name is missing before the `=`",
        "invalid unquoted key" => return format!("the name `{given}` must stand in quotation marks"),
        "missing assignment between key-value pairs" => return format!("a `=` is missing, at `{given}`"),
        "missing key for inline table element" | "invalid inline table element" => "a name is missing before a value",
        "missing opening quote" => "a text lacks its opening quotation mark",
        "invalid basic string" | "invalid literal string" => "a text lacks its closing quotation mark",
        "missing escaped value" => "a text has a backslash alone; write two",
        "missing comma between array elements"
        | "missing comma between key-value pairs"
        | "extra assignment between key-value pairs" => "a comma is missing",
        "extra comma in array" | "extra comma in inline table" => "there is a comma too many",
        "extra `=`" | "unexpected `=` in array" => "there is a `=` too many",
        "unexpected key or value" | "unexpected content" => "something follows after a value; begin a new line",
        "unclosed table" | "unclosed array table" | "unclosed array" | "unclosed inline table" => {
            "a bracket is not closed"
        }
        "cannot recurse further; max recursion depth met" => DEEP,
        "duplicate key" => "a name is given twice",
        _ if given.is_empty() => what,
        _ => return format!("{what}, at `{given}`"),
    }
    .into()
}

fn no_number(given: &str) -> String {
    if given.contains('"') {
        return format!("`{given}` is more than one value; is there a comma between them?");
    }
    format!("`{given}` is no number; a text stands in quotation marks: \"{given}\"")
}

/// The word at some bytes of a text, all of it.
fn word<'t>(text: &'t str, at: &Range<usize>) -> &'t str {
    let ends = |c: char| c.is_control() || ",=[]{}#".contains(c);
    let (Some(before), Some(from)) = (text.get(..at.start), text.get(at.start..)) else { return "" };
    let start = before.rfind(ends).map_or(0, |i| i + before[i..].chars().next().map_or(0, char::len_utf8));
    let end = from.find(ends).map_or(text.len(), |i| at.start + i);
    text[start..end].trim()
}

/// A complaint about a value at a path, in serde's words: what must be there, and what is.
pub fn value(path: &str, message: &str) -> String {
    let message = message.trim();
    let whose = if path.is_empty() { "it" } else { path };
    let expected =
        |rest: &str| rest.rsplit_once(", expected ").map(|(given, takes)| (given.to_owned(), takes.to_owned()));
    for form in ["invalid type: ", "invalid value: "] {
        if let Some((given, takes)) = message.strip_prefix(form).and_then(expected) {
            return format!("{whose} must be {}; it is {}", must_be(&takes), is(&given));
        }
    }
    if let Some((count, takes)) = message.strip_prefix("invalid length ").and_then(expected) {
        return match (&takes[..], count.parse().map(|n| self::count(n, "value"))) {
            ("fewer elements in array", _) => format!("{whose} has more values than belong there: {count}"),
            (takes, Ok(values)) => format!("{whose} must be {}; it has {values}", must_be(takes)),
            (takes, Err(_)) => format!("{whose} must be {}; it has {count}", must_be(takes)),
        };
    }
    let quoted = |form: &str| message.strip_prefix(form)?.split_once('`');
    let within = |name: &str| match path.strip_suffix(name).map(|path| path.trim_end_matches('.')) {
        Some("") | None => String::new(),
        Some(path) => format!("{path} "),
    };
    if let Some((name, rest)) = quoted("unknown field `") {
        let name = cut(name);
        let known = rest.trim_start_matches(", expected ").trim_start_matches("one of ");
        // Names stand between backticks.
        let near = nearest(&name, known.split('`').skip(1).step_by(2));
        let inside = within(&name);
        let inside = if inside.is_empty() { String::new() } else { format!(" in {}", inside.trim_end()) };
        return match near {
            Some(near) => format!("there is no field `{name}`{inside}; did you mean `{near}`?"),
            None => format!("there is no field `{name}`{inside}; known are {known}"),
        };
    }
    if let Some((name, rest)) = quoted("unknown variant `") {
        let known = rest.trim_start_matches(", expected ");
        return format!("{whose} must be {known}; it is `{}`", cut(name));
    }
    if let Some((name, _)) = quoted("missing field `") {
        return if path.is_empty() {
            format!("the field `{name}` is missing")
        } else {
            format!("{path} lacks the field `{name}`")
        };
    }
    if let Some((name, _)) = quoted("duplicate field `") {
        return format!("the field `{}` is given twice; keep one", cut(name));
    }
    if path.is_empty() { message.to_owned() } else { format!("{path}: {message}") }
}

/// The name that is nearest to what was given, unless it is far from all.
pub fn nearest<'n>(given: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let far = |name: &str| strsim::damerau_levenshtein(given, name);
    known.min_by_key(|name| far(name)).filter(|name| far(name) <= 1 + name.len() / 3 && far(name) < name.len())
}

/// What serde expects.
fn must_be(takes: &str) -> String {
    if let Some(count) = takes.strip_prefix("an array of length ") {
        return if count == "2" { "a pair of numbers [x, y]".into() } else { format!("a list of {count} values") };
    }
    match takes {
        "f64" | "f32" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        "a string" | "string" => "a text in quotation marks",
        "a map" | "map" | "string or map" => "an object",
        other if other.starts_with("struct ") || other.starts_with("enum ") => "an object",
        other => other,
    }
    .into()
}

/// What serde found.
fn is(given: &str) -> String {
    let (kind, value) = given.split_once(' ').unwrap_or((given, ""));
    let bare = || value.rsplit(' ').next().unwrap_or_default().trim_matches('`');
    match kind {
        "string" => format!("the text {}", cut(value)),
        "integer" | "boolean" | "floating" => format!("`{}`", bare()),
        "null" | "unit" | "Option" => "null".into(),
        "map" => "an object".into(),
        "sequence" => "a list".into(),
        _ => cut(given),
    }
}

/// A text, shortened where it is long.
pub fn cut(text: &str) -> String {
    if text.chars().count() <= QUOTED { text.to_owned() } else { text.chars().take(QUOTED).chain(['…']).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;
    use serde::de::DeserializeOwned;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read alone")]
    struct Input {
        start: [f64; 2],
        count: Option<u32>,
        kind: Option<Kind>,
        closed: Option<bool>,
        name: Option<String>,
        list: Option<Vec<f64>>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Kind {
        Line,
        Arc,
    }

    fn read<T: DeserializeOwned + std::fmt::Debug>(text: &str) -> String {
        json("", &serde_json::from_str::<T>(text).unwrap_err())
    }

    #[test]
    fn what_serde_says_becomes_a_sentence() {
        let long = format!("{{\"start\": \"{}\"}}", "x".repeat(1000));
        for (text, part) in [
            (r#"{"start": "a"}"#, "it must be a pair of numbers [x, y]; it is the text \"a\" (line 1, column 13)"),
            (r#"{"start": "a, expected b"}"#, "it is the text \"a, expected b\" ("),
            (r#"{"start": [1]}"#, "must be a pair of numbers [x, y]; it has 1 value ("),
            (r#"{"start": [1, null]}"#, "must be a number; it is null ("),
            (r#"{"start": [1, 1e999]}"#, "a number is beyond the range of doubles"),
            (r#"{"start": [1, 2"#, "it ends in the middle of its JSON (line 1, column 15); is it cut off?"),
            (r#"{"start": [1, tru]}"#, "it is not JSON (line 1, column 18): there is a word that is none of"),
            (r#"{"count": -1}"#, "must be a whole number, 0 or more; it is `-1` ("),
            (r#"{"count": 1.5}"#, "must be a whole number, 0 or more; it is `1.5` ("),
            (r#"{"closed": 1}"#, "must be true or false; it is `1` ("),
            (r#"{"closed": {}}"#, "must be true or false; it is an object ("),
            (r#"{"name": true}"#, "must be a text in quotation marks; it is `true` ("),
            (r#"{"list": 1}"#, "must be a list; it is `1` ("),
            (r#"{"kind": "ark"}"#, "must be `line` or `arc`; it is `ark` ("),
            (r#"{"stat": 1}"#, "there is no field `stat`; did you mean `start`? ("),
            (
                r#"{"velocity": 1}"#,
                "there is no field `velocity`; known are `start`, `count`, `kind`, `closed`, `name`, `list` (",
            ),
            (r#"{"closed": true, "closed": true}"#, "the field `closed` is given twice; keep one ("),
            ("{}", "the field `start` is missing (line 1, column 2)"),
            ("[]", "it must be an object; it is a list ("),
            ("", "it is empty, where JSON must stand"),
            ("\n \n", "it ends in the middle of its JSON (line 3, column 0)"),
            (&long, "it is the text \"xxxxx"),
        ] {
            let said =
                if text == "[]" { read::<std::collections::BTreeMap<String, f64>>(text) } else { read::<Input>(text) };
            assert!(said.contains(part) && said.len() < 200, "{text}: {said}");
        }
    }

    #[test]
    fn paths_are_named() {
        assert_eq!(
            value("a.b", "unknown field `b`, expected one of `c`, `d`"),
            "there is no field `b` in a; known are `c`, `d`"
        );
        assert_eq!(value("a[0]", "missing field `b`"), "a[0] lacks the field `b`");
        assert_eq!(value("a", "something else"), "a: something else");
        assert_eq!(
            toml("a = 1\nb = ", Some(10..10), "duplicate key"),
            "it is not TOML (line 2, column 5): a name is given twice"
        );
    }

    #[cfg(feature = "recipe")]
    #[test]
    fn what_toml_says_becomes_a_sentence() {
        for (text, told) in [
            ("a = cubic", "`cubic` is no number; a text stands in quotation marks: \"cubic\""),
            ("a = {b = [1, 40deg ]}", "`40deg` is no number; a text stands in quotation marks: \"40deg\""),
            ("a = 1.2.3", "`1.2.3` is no number"),
            ("a = 07", "`07` is no number"),
            ("a = 1-2", "`1-2` is no number"),
            ("a = 0x", "`0x` is no number"),
            ("a = True", "`True` is neither `true` nor `false`"),
            ("a = \"b", "a text lacks its closing quotation mark"),
            ("a = 'b", "a text lacks its closing quotation mark"),
            ("a = b\"", "a text lacks its opening quotation mark"),
            ("a = \"b\\q\"", "a text has a backslash alone; write two"),
            ("a b", "a name has no value; write `name = value`"),
            ("a = ", "a value is missing"),
            ("= 1", "a name is missing before the `=`"),
            ("ä = 1", "the name `ä` must stand in quotation marks"),
            ("a = [1, 2", "a bracket is not closed"),
            ("[a", "a bracket is not closed"),
            ("[[a]", "a bracket is not closed"),
            ("a = {b 1}", "a `=` is missing, at `b 1`"),
            ("a = {= 2}", "a name is missing before the `=`"),
            ("a = [1\"b\" 2]", "`1\"b\" 2` is more than one value; is there a comma between them?"),
            ("a = {b = 1 c = 2}", "a comma is missing"),
            ("a = [\"b\" \"c\"]", "a comma is missing"),
            ("a = [1,,2]", "there is a comma too many"),
            ("a == 1", "there is a `=` too many"),
            ("a = 1 b = 2", "something follows after a value"),
            ("a = \"b\" c", "something follows after a value; begin a new line"),
        ] {
            let error = toml::from_str::<toml::Table>(text).unwrap_err();
            let said = super::toml(text, error.span(), error.message());
            assert!(said.contains(told), "{text}: {said} ({})", error.message());
        }
    }
}
