//! The one error type of the library: every message names the thing, its value and the way out.

use std::path::PathBuf;

/// What can go wrong, apart from bugs.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument, axis, datum or option lies outside its domain.
    #[error("{0}")]
    Domain(String),
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
        if node.is_some() { "move the node or drop it from the grid" } else { "change a number by a unit in its last place" }
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

/// Shorthand for results of this library.
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Error {
        let path = path.into();
        move |source| Error::Io { path, source }
    }
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
