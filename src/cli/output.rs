//! What all commands do to print: text, JSON, errors, progress, numbers.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::ser::{Serialize, Serializer};
use spiral_atlas::files::{check_place, size, write_file};
pub(super) use spiral_atlas::picture::{angle, grouped};
use spiral_atlas::plot::{Drawing, Format};
use spiral_atlas::transition::Station;
use spiral_atlas::{Error, Result};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Prints to standard output.
pub(super) fn print(text: &str) -> Result<()> {
    stream(|out| out.write_all(text.as_bytes()))
}

/// Prints to standard output as it goes, so that the text need not fit in memory. That nobody reads on is no failure.
pub(super) fn stream(write: impl FnOnce(&mut BufWriter<io::StdoutLock>) -> io::Result<()>) -> Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(stdout_error(e)),
        Err(_) => {
            // What is left in the buffer would be tried again.
            let _ = out.into_parts();
            Ok(())
        }
        Ok(()) => Ok(()),
    }
}

/// The failure of standard output.
pub(super) fn stdout_error(source: io::Error) -> Error {
    Error::Io { path: "(standard output)".into(), source }
}

/// Refuses to write where the input is.
pub(super) fn not_over(out: Option<&Path>, input: &Path) -> Result<()> {
    let real = |path: &Path| path.canonicalize().ok();
    match out.filter(|out| real(out).is_some() && real(out) == real(input)) {
        Some(out) => Err(Error::invalid(format!("{} is the input; choose another name for the output", out.display()))),
        None => Ok(()),
    }
}

/// Writes a file, or to standard output for `-` and where no file is named.
pub(super) fn write_out(out: Option<&Path>, bytes: &[u8]) -> Result<()> {
    match out.filter(|path| *path != Path::new("-")) {
        Some(path) => write_file(path, bytes),
        None => stream(|out| out.write_all(bytes)),
    }
}

/// Before any work, whether a figure can be what its name says, where it says.
pub(super) fn check_figure(figure: Option<&Path>) -> Result<()> {
    let Some(path) = figure else { return Ok(()) };
    Format::of(path)?;
    match path.parent().filter(|folder| !(folder.as_os_str().is_empty() || folder.is_dir())) {
        None => check_place(path),
        Some(folder) => Err(Error::invalid(format!(
            "the figure `{}` has no folder `{}` to be in; create it, or choose another",
            path.display(),
            folder.display()
        ))),
    }
}

/// Writes a figure in the format that its name asks for.
pub(super) fn write_figure(path: &Path, figure: &Drawing) -> Result<()> {
    write_file(path, &figure.file(Format::of(path)?)?)
}

/// Whether a file's name ends so, in letters of either size.
pub(super) fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension))
}

/// Prints a value as JSON with indents.
pub(super) fn print_json(value: &impl Serialize) -> Result<()> {
    stream(|out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        out.write_all(b"\n")
    })
}

/// A value as JSON with indents.
pub(super) fn to_json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string_pretty(value).map_err(json_error)
}

/// A value as part of a larger JSON text.
pub(super) fn to_value(value: &impl Serialize) -> Result<serde_json::Value> {
    serde_json::to_value(value).map_err(json_error)
}

/// Writes samples with their header.
pub(super) fn table(out: &mut impl Write, samples: &[Station], comma: &str) -> io::Result<()> {
    writeln!(out, "{}", Station::COLUMNS.join(comma))?;
    rows(out, "", samples, comma)
}

/// Writes rows of samples, each after the same words. A number that there is not, where a path stands still, is an
/// empty cell.
pub(super) fn rows(out: &mut impl Write, lead: &str, samples: &[Station], comma: &str) -> io::Result<()> {
    let cell = |x: f64| if x.is_finite() { format!("{x:?}") } else { String::new() };
    samples.iter().try_for_each(|s| writeln!(out, "{lead}{}", s.numbers().map(cell).join(comma)))
}

/// The failure of writing JSON; none is known.
pub(super) fn json_error(e: serde_json::Error) -> Error {
    Error::invalid(format!("a report cannot be written as JSON: {e}"))
}

/// Reports an error. When even standard error is closed, the exit code must do.
pub(super) fn complain(what: &str) {
    let _ = writeln!(io::stderr(), "error: {what}");
}

/// Reports on standard error what is no error, where standard output is for numbers alone.
pub(super) fn note(what: &str) {
    let _ = writeln!(io::stderr(), "{what}");
}

/// A bar on standard error for a number of nodes; silent when that is no terminal.
pub(super) fn progress(what: String, nodes: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(nodes), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{msg} {wide_bar} {human_pos}/{human_len} nodes, {eta} left");
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())).with_message(what)
}

/// A JSON object whose keys keep their order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Object<K, V>(pub Vec<(K, V)>);

impl<K: Serialize, V: Serialize> Serialize for Object<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(k, v)| (k, v)))
    }
}

/// A file that was written, with what distinguishes it from others.
#[derive(Debug, Clone, serde::Serialize)]
pub(super) struct Product {
    /// Where it is.
    pub path: PathBuf,
    /// Its length.
    pub bytes: u64,
    /// BLAKE3 of its bytes, as `b3sum` has it.
    pub blake3: String,
}

impl Product {
    /// Reads the file once.
    pub(super) fn of(path: &Path) -> Result<Product> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(std::fs::File::open(path).map_err(io)?).map_err(io)?;
        Ok(Product { path: path.to_owned(), bytes: hasher.count(), blake3: hasher.finalize().to_hex().to_string() })
    }

    /// A line of a summary.
    pub(super) fn line(&self) -> String {
        format!("  {}  {}\n    BLAKE3 {}\n", self.path.display(), size(self.bytes), self.blake3)
    }
}

/// Where the atlas of a name goes.
pub(super) fn atlas_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.atlas.safetensors"))
}

/// Where its report goes.
pub(super) fn report_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.report.json"))
}

/// Creates a folder with its parents, unless it is there.
pub(super) fn make_folder(path: &Path) -> Result<()> {
    if path == Path::new("-") {
        return Err(Error::invalid("several files are written, which standard output cannot take; name a folder"));
    }
    if path.exists() && !path.is_dir() {
        return Err(Error::invalid(format!(
            "{} is a file; the folder for the results needs another name",
            path.display()
        )));
    }
    std::fs::create_dir_all(path).map_err(|source| Error::Io { path: path.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_keep_their_order() {
        let json = serde_json::to_string(&Object(vec![("b", 1), ("a", 2)])).unwrap();
        assert_eq!(json, r#"{"b":1,"a":2}"#);
    }
}
