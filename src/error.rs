//! The one error type of the library: every message names the thing, its value and the way out.

use std::borrow::Cow;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

/// What can go wrong, apart from bugs.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument, axis, datum or option lies outside its domain.
    #[error("{0}")]
    Domain(Domain),
    /// There is no path such as was asked for, or none was found: an answer rather than a mistake. The text is the
    /// reason.
    #[error("{0}")]
    NoPath(String),
    /// A recipe does not say what it must, or says what it may not.
    #[error("recipe: {0}")]
    Recipe(String),
    /// A file is not a valid atlas: truncated, inconsistent, hostile or of another version.
    #[error("{}: {what}", path.display())]
    Atlas {
        /// The file that was read.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
    },
    /// The operating system refused to read or write.
    #[error("{}: {}", path.display(), in_words(source))]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A verdict could not be proved at the precision cap.
    #[error(
        "{}{coordinates}: {what} is not decided at the cap of {bits} bits; {}",
        node.map_or(String::new(), |n| format!("node {n} at ")),
        if node.is_some() { "move the node or drop it from the grid" } else { "change a number by a unit in its last \
                                                                               place" }
    )]
    Undecided {
        /// Flat index; none for a single datum.
        node: Option<u64>,
        /// The node's coordinates.
        coordinates: String,
        /// The condition in question.
        what: String,
        /// The precision reached.
        bits: usize,
    },
    /// No adapter, a lost device, a limit or a validation error on the GPU.
    #[error("GPU: {0}")]
    Gpu(String),
    /// The user asked to stop.
    #[error("interrupted; nothing was left half-written")]
    Interrupted,
}

/// What to do where a length leaves the range of doubles.
pub(crate) const OTHER_UNIT: &str = "change the unit of length";

/// Shorthand for results of this library.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What lies outside its domain.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Domain {
    /// A number: "{what} is {value}; it must be {limit} ({way_out})".
    Number {
        /// Its name.
        what: Cow<'static, str>,
        /// Its value.
        value: f64,
        /// What it must be, such as "above 0".
        limit: Cow<'static, str>,
        /// What to do, where that does not go without saying.
        way_out: Option<Cow<'static, str>>,
    },
    /// An angle in radians. The sentence is the same, with the value in degrees too.
    Angle {
        /// Its name.
        what: Cow<'static, str>,
        /// Its value.
        value: f64,
        /// What it must be.
        limit: Cow<'static, str>,
        /// What to do.
        way_out: Cow<'static, str>,
    },
    /// A text: "{text} is no number; write {instead}, with a point".
    NoNumber {
        /// What was given.
        text: String,
        /// The number, where a decimal comma makes it none.
        instead: Option<String>,
    },
    /// Anything else, in a sentence.
    Other(String),
}

impl Display for Domain {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let way_out = match self {
            Domain::Number { what, value, limit, way_out } => {
                write!(f, "{what} is {}; it must be {limit}", written(*value))?;
                way_out.as_ref()
            }
            Domain::Angle { what, value, limit, way_out } => {
                write!(f, "{what} is {}; it must be {limit}", written_angle(*value))?;
                Some(way_out)
            }
            Domain::NoNumber { text, instead } => {
                write!(f, "{text:?} is no number")?;
                return instead.as_ref().map_or(Ok(()), |number| write!(f, "; write {number}, with a point"));
            }
            Domain::Other(sentence) => return f.write_str(sentence),
        };
        way_out.map_or(Ok(()), |way_out| write!(f, " ({way_out})"))
    }
}

impl Error {
    /// A number outside its domain: "{what} is {value}; it must be {limit}".
    pub fn domain(what: impl Into<Cow<'static, str>>, value: f64, limit: impl Into<Cow<'static, str>>) -> Error {
        Error::Domain(Domain::Number { what: what.into(), value, limit: limit.into(), way_out: None })
    }

    /// The same with what to do.
    pub(crate) fn or(mut self, advice: impl Into<Cow<'static, str>>) -> Error {
        if let Error::Domain(Domain::Number { way_out, .. }) = &mut self {
            *way_out = Some(advice.into());
        }
        self
    }

    /// An angle in radians outside its domain.
    pub(crate) fn angle(
        what: impl Into<Cow<'static, str>>,
        value: f64,
        limit: impl Into<Cow<'static, str>>,
        way_out: impl Into<Cow<'static, str>>,
    ) -> Error {
        Error::Domain(Domain::Angle { what: what.into(), value, limit: limit.into(), way_out: way_out.into() })
    }

    /// A number of an answer that leaves the range of doubles, with the datum.
    pub(crate) fn extreme<'a>(what: &str, datum: impl IntoIterator<Item = (&'a str, f64)>) -> Error {
        let datum: Vec<String> = datum.into_iter().map(|(name, x)| format!("{name} = {x:?}")).collect();
        let datum = datum.join(", ");
        Error::invalid(format!("{what} leaves the range of doubles for {datum}; choose less extreme numbers"))
    }

    /// A number too large or too small for a double: "{what} leaves the range of doubles; {way_out}".
    pub(crate) fn beyond_doubles(what: impl Display, way_out: &str) -> Error {
        Error::invalid(format!("{what} leaves the range of doubles; {way_out}"))
    }

    /// Something outside its domain, in a sentence that names it, its value, what is allowed and the way out.
    pub fn invalid(sentence: impl Into<String>) -> Error {
        Error::Domain(Domain::Other(sentence.into()))
    }

    /// The same with the place before it, such as a field or a line.
    pub fn at(self, place: impl Display) -> Error {
        let prefixed = |what: Cow<'static, str>| format!("{place}: {what}").into();
        Error::Domain(match self {
            Error::Domain(Domain::Number { what, value, limit, way_out }) => {
                Domain::Number { what: prefixed(what), value, limit, way_out }
            }
            Error::Domain(Domain::Angle { what, value, limit, way_out }) => {
                Domain::Angle { what: prefixed(what), value, limit, way_out }
            }
            other => Domain::Other(format!("{place}: {other}")),
        })
    }

    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Error {
        let path = path.into();
        move |source| Error::Io { path, source }
    }
}

/// The one of all that has a name, else the error "the {what} is `{name}`; it must be a, b or c".
pub(crate) fn by_name<T: Copy>(what: &str, name: &str, all: &[T], name_of: impl Fn(T) -> &'static str) -> Result<T> {
    all.iter().copied().find(|one| name_of(*one) == name).ok_or_else(|| {
        let known: Vec<&str> = all.iter().map(|one| name_of(*one)).collect();
        let known = match &known[..] {
            [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            _ => known.concat(),
        };
        Error::invalid(format!("the {what} is `{name}`; it must be {known}"))
    })
}

/// Refuses a number that is not finite.
pub(crate) fn finite(what: impl Into<Cow<'static, str>>, value: f64) -> Result<f64> {
    if value.is_finite() { Ok(value) } else { Err(Error::domain(what, value, "finite")) }
}

/// Refuses a number that is not finite and above 0.
pub(crate) fn positive(what: impl Into<Cow<'static, str>>, value: f64) -> Result<f64> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Error::domain(what, value, "finite and above 0")) }
}

/// Refuses a number that is not above 0; infinity is.
pub(crate) fn above_zero(what: impl Into<Cow<'static, str>>, value: f64) -> Result<f64> {
    if value > 0.0 { Ok(value) } else { Err(Error::domain(what, value, "above 0")) }
}

/// Most samples of a curve: no request can take all memory.
pub const MOST_SAMPLES: u32 = 1_000_000;

/// Refuses a number of samples with which a curve has not both its ends, or that no memory may hold.
pub(crate) fn samples(count: usize) -> Result<usize> {
    let what = "the number of samples of a curve";
    match count {
        0..2 => Err(Error::domain(what, count as f64, "at least 2, the ends")),
        2..=LARGEST => Ok(count),
        _ => Err(Error::domain(what, count as f64, format!("at most {MOST_SAMPLES}"))
            .or("of a path of several pieces, sample each by itself")),
    }
}

const LARGEST: usize = MOST_SAMPLES as usize;

/// A number as a reader writes it: all its digits, no `.0`, and the scientific form from 1e16 on and below 1e-5, so
/// that never a row of zeros stands in a sentence.
pub(crate) fn written(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// An angle in radians as a reader writes it, with the degrees that it is.
fn written_angle(angle: f64) -> String {
    let degrees = angle.to_degrees();
    // Six decimals undo the rounding of degrees that were turned into radians; smaller angles have none to undo.
    let degrees = if degrees.abs() < 1e-3 { degrees } else { (degrees * 1e6).round() / 1e6 };
    if degrees.is_finite() { format!("{} ({} degrees)", written(angle), written(degrees)) } else { written(angle) }
}

/// What the system said, as a sentence with a way out where there is one, and its own words after.
fn in_words(source: &std::io::Error) -> String {
    use std::io::ErrorKind as Kind;
    let what = match source.kind() {
        Kind::NotFound => "there is no such file or folder; check the name",
        Kind::PermissionDenied => "this user has no right to that; change the rights or choose another place",
        Kind::ReadOnlyFilesystem => "its disk can only be read; choose another place",
        Kind::StorageFull => "its disk is full; free some room or choose another place",
        Kind::QuotaExceeded => "this user's share of the disk is used up; free some room or choose another place",
        Kind::FileTooLarge => "the file would be larger than the system allows; raise the limit or write less",
        Kind::IsADirectory => "it is a folder; name a file",
        Kind::NotADirectory => "a part of this path is a file, not a folder; choose another path",
        Kind::AlreadyExists => "a file of that name is in the way; choose another name",
        _ => return source.to_string(),
    };
    // An error that was made from its kind alone has no words beyond it.
    if source.raw_os_error().is_some() { format!("{what} ({source})") } else { what.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_messages_are_short() {
        assert_eq!(
            [2.0, 0.25, -0.0, 5e-324, 1.5e300, -1e-310].map(written),
            ["2", "0.25", "-0", "5e-324", "1.5e300", "-1e-310"]
        );
    }

    #[test]
    fn sentences_have_their_parts_in_order() {
        let error = Error::domain("the radius", 0.0, "finite and above 0");
        assert_eq!(error.to_string(), "the radius is 0; it must be finite and above 0");
        let error = error.or("change the unit").at("paths[2]");
        assert_eq!(error.to_string(), "paths[2]: the radius is 0; it must be finite and above 0 (change the unit)");
        let error = Error::angle("phi0", 4.0, "below pi", "radians").at("line 3");
        assert_eq!(error.to_string(), "line 3: phi0 is 4 (229.183118 degrees); it must be below pi (radians)");
        let error = |known: &[&'static str]| by_name("kind", "x", known, |one| one).unwrap_err().to_string();
        assert_eq!(error(&["a"]), "the kind is `x`; it must be a");
        assert_eq!(error(&["a", "b", "c"]), "the kind is `x`; it must be a, b or c");
        assert_eq!(by_name("kind", "b", &["a", "b"], |one| one).unwrap(), "b");
        let error = Error::extreme("the length", [("theta", 1.0), ("xi", 1e300)]).to_string();
        assert_eq!(
            error,
            "the length leaves the range of doubles for theta = 1.0, xi = 1e300; choose less extreme numbers"
        );
        assert_eq!(Error::NoPath("none".into()).at("x").to_string(), "x: none");
        assert!(finite("x", f64::NAN).is_err() && positive("x", f64::INFINITY).is_err());
        assert!(samples(1).is_err() && samples(2).is_ok() && samples(LARGEST).is_ok());
        let error = samples(usize::MAX).unwrap_err().to_string();
        assert!(error.contains("is 1.8446744073709552e19; it must be at most 1000000 (of a path"), "{error}");
        assert_eq!((positive("x", 2.0).unwrap(), above_zero("x", f64::INFINITY).unwrap()), (2.0, f64::INFINITY));
    }
}
