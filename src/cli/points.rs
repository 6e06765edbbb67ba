//! `query --points`: a CSV file in, a line of JSON out for each row, in order, in bounded memory.
//!
//! Rows are numbers, so a row is a line: a stray quotation mark spoils its own row alone, never the rest of the file.

use super::Outcome;
use super::datum::{Header, columns};
use super::output::{json_error, stdout_error};
use super::query::Answer;
use spiral_atlas::atlas::Atlas;
use spiral_atlas::family::Family;
use spiral_atlas::{Error, Result};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;

/// Longest line in bytes; no line of numbers comes near.
const MAX_LINE: usize = 1 << 16;

/// Answers for every row of a file, or of standard input for `-`.
pub fn run(family: &'static dyn Family, path: &Path, atlas: Option<&Atlas>) -> Result<Outcome> {
    let io = |source| Error::Io { path: path.to_owned(), source };
    let input: Box<dyn Read> =
        if path == Path::new("-") { Box::new(io::stdin()) } else { Box::new(std::fs::File::open(path).map_err(io)?) };
    let mut lines = Lines { input: BufReader::with_capacity(MAX_LINE, input), number: 0, line: Vec::new() };
    let header = loop {
        match lines.next().map_err(io)? {
            None => {
                return Err(Error::Domain(format!(
                    "{}: it is empty; its first line must be {}",
                    path.display(),
                    columns(family)
                )));
            }
            Some(Ok(line)) if line.trim().is_empty() => {}
            Some(line) => break line.and_then(|line| Header::parse(family, line)),
        }
    };
    let header = header.map_err(|what| Error::Domain(format!("{}: line {}: {what}", path.display(), lines.number)))?;
    let mut out = BufWriter::new(io::stdout().lock());
    let mut outcome = Outcome::Fine;
    loop {
        // Whoever waits for an answer before sending the next row gets it.
        let waiting = lines.input.buffer().is_empty();
        if let Some(end) = if waiting { broken(out.flush())? } else { None } {
            return Ok(end);
        }
        let answer = match lines.next().map_err(io)? {
            None => break,
            Some(Ok(line)) if line.trim().is_empty() => continue,
            Some(line) => {
                line.and_then(|line| header.datum(line)).and_then(|d| Answer::new(family, d, atlas).map_err(|e| e.to_string()))
            }
        };
        let mut text = match answer {
            Ok(answer) => serde_json::to_vec(&answer),
            Err(error) => {
                outcome = Outcome::Failed;
                serde_json::to_vec(&Bad { line: lines.number, error })
            }
        }
        .map_err(json_error)?;
        text.push(b'\n');
        if let Some(end) = broken(out.write_all(&text))? {
            return Ok(end);
        }
    }
    broken(out.flush()).map(|end| end.unwrap_or(outcome))
}

#[derive(serde::Serialize)]
struct Bad {
    line: u64,
    error: String,
}

/// `Some` when nobody reads on, as with `| head`: then there is nothing more to do, and nothing to say.
fn broken(done: io::Result<()>) -> Result<Option<Outcome>> {
    match done {
        Ok(()) => Ok(None),
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(Some(Outcome::Fine)),
        Err(e) => Err(stdout_error(e)),
    }
}

/// Lines with their numbers, from 1.
struct Lines {
    input: BufReader<Box<dyn Read>>,
    number: u64,
    line: Vec<u8>,
}

impl Lines {
    /// The next line without its end, or what is wrong with it; `None` at the end.
    fn next(&mut self) -> io::Result<Option<std::result::Result<&str, String>>> {
        self.line.clear();
        let read = (&mut self.input).take(MAX_LINE as u64).read_until(b'\n', &mut self.line)?;
        if read == 0 {
            return Ok(None);
        }
        self.number += 1;
        if read == MAX_LINE && self.line.last() != Some(&b'\n') {
            self.skip()?;
            return Ok(Some(Err(format!("the line is longer than {MAX_LINE} bytes"))));
        }
        Ok(Some(std::str::from_utf8(&self.line).map_err(|_| "the line is not UTF-8 text".into())))
    }

    /// Leaves the rest of a line unread, in pieces.
    fn skip(&mut self) -> io::Result<()> {
        loop {
            let buffer = self.input.fill_buf()?;
            let end = buffer.iter().position(|b| *b == b'\n');
            let (length, done) = (end.map_or(buffer.len(), |at| at + 1), end.is_some() || buffer.is_empty());
            self.input.consume(length);
            if done {
                return Ok(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Lines {
        Lines { input: BufReader::new(Box::new(io::Cursor::new(text.to_vec()))), number: 0, line: Vec::new() }
    }

    #[test]
    fn long_and_broken_lines_spoil_themselves_alone() {
        let mut text = vec![b'x'; 3 * MAX_LINE];
        text.extend(b"\n\xff\nlast");
        let mut lines = lines(&text);
        assert!(lines.next().unwrap().unwrap().unwrap_err().contains("longer than"));
        assert!(lines.next().unwrap().unwrap().unwrap_err().contains("UTF-8"));
        assert_eq!(lines.next().unwrap(), Some(Ok("last")));
        assert_eq!(lines.next().unwrap(), None);
        assert_eq!(lines.number, 3);
    }
}
