//! `query`, `curve` and `join` with `--points`: a CSV file in, a line of JSON or rows of a table out for each row, in
//! order, in bounded memory.
//!
//! Rows are numbers, so a row is a line: a stray quotation mark spoils its own row alone, never the rest of the file.

use super::Outcome;
use super::output::{self, json_error, stdout_error};
use spiral_atlas::files::size;
use spiral_atlas::plain::count;
use spiral_atlas::transition::Station;
use spiral_atlas::{Error, Result};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;

/// Longest line in bytes; no line of numbers comes near.
const MAX_LINE: usize = 1 << 16;
/// A line that still has no end after so many bytes may have none at all, as in /dev/zero: it is not read on.
const MAX_SKIPPED: usize = 1 << 26;
/// Most bad rows that are named together.
const NAMED: usize = 20;
/// What other tables have between columns.
const OTHERS: [(&str, char); 2] = [("semicolons", ';'), ("tabs", '\t')];

/// A row of data.
pub(super) struct Row<'l> {
    /// Index of the first set of columns that the header has.
    pub chart: usize,
    /// Its number among the rows of data, from 1.
    number: u64,
    /// Its cells in the order of that set.
    pub cells: &'l [&'l str],
}

impl Row<'_> {
    /// The rows of a table of samples, which begin with the number of this row; without samples the reason goes to
    /// standard error.
    pub(super) fn table(&self, samples: &[Station], reason: Option<&str>) -> Result<Vec<u8>> {
        if let Some(reason) = reason {
            output::note(&format!("row {}: {reason}", self.number));
        }
        let mut text = Vec::new();
        output::rows(&mut text, &format!("{},", self.number), samples, ",").map_err(stdout_error)?;
        Ok(text)
    }
}

/// The header of a table of samples of several rows.
fn table_header() -> String {
    format!("row,{}\n", Station::COLUMNS.join(","))
}

/// Answers for every row of a file, or of standard input for `-`, with what `answer` gives: a line of JSON, or for a
/// `table` whole rows.
pub(super) fn run(
    path: &Path,
    charts: &[&'static [&'static str]],
    table: bool,
    answer: impl Fn(&Row) -> Result<Vec<u8>>,
) -> Result<Outcome> {
    let io = |source| Error::Io { path: path.to_owned(), source };
    let input: Box<dyn Read> =
        if path == Path::new("-") { Box::new(io::stdin()) } else { Box::new(std::fs::File::open(path).map_err(io)?) };
    let mut lines = Lines { input: BufReader::with_capacity(MAX_LINE, input), number: 0, line: Vec::new() };
    let header = loop {
        match lines.next().map_err(io)? {
            None => {
                return Err(Error::invalid(format!(
                    "{}: it is empty; its first line must be {}",
                    path.display(),
                    columns(charts)
                )));
            }
            Some(Ok(line)) if line.trim().is_empty() => {}
            Some(line) => break line.and_then(|line| Header::parse(charts, line)),
        }
    };
    let header = header.map_err(|what| Error::invalid(format!("{}: line {}: {what}", path.display(), lines.number)))?;
    let mut out = BufWriter::new(io::stdout().lock());
    let (mut bad, mut first_bad, mut number) = (0, Vec::new(), 0);
    if table && let Some(end) = broken(out.write_all(table_header().as_bytes()))? {
        return Ok(end);
    }
    loop {
        // Whoever waits for an answer before sending the next row gets it.
        let waiting = lines.input.buffer().is_empty();
        if let Some(end) = if waiting { broken(out.flush())? } else { None } {
            return Ok(end);
        }
        let line = match lines.next().map_err(io)? {
            None => break,
            // Spreadsheets end a table with lines of commas alone.
            Some(Ok(line)) if line.chars().all(|c| c.is_whitespace() || c == ',' || c == '"') => continue,
            Some(line) => {
                number += 1;
                line.and_then(|line| {
                    let row = Row { chart: header.chart, number, cells: &header.cells(line)? };
                    answer(&row).map_err(|e| e.to_string())
                })
            }
        };
        let mut text = match line {
            Ok(text) => text,
            Err(error) => {
                bad += 1;
                if bad <= NAMED {
                    first_bad.push(number);
                }
                if table {
                    output::complain(&format!("row {number}: {error}"));
                    continue;
                }
                serde_json::to_vec(&Bad { row: number, error }).map_err(json_error)?
            }
        };
        if !table {
            text.push(b'\n');
        }
        if let Some(end) = broken(out.write_all(&text))? {
            return Ok(end);
        }
    }
    if let Some(end) = broken(out.flush())? {
        return Ok(end);
    }
    if bad == 0 {
        return Ok(Outcome::Fine);
    }
    if !table {
        let named: Vec<String> = first_bad.iter().map(u64::to_string).collect();
        let more = if bad > NAMED { format!(" and {} more", bad - NAMED) } else { String::new() };
        let (rows, why) =
            if bad == 1 { ("row", "is bad; its answer says why") } else { ("rows", "are bad; their answers say why") };
        output::complain(&format!("{rows} {}{more} of {number} {why}", named.join(", ")));
    }
    Ok(Outcome::Failed)
}

/// Where in the rows of a table the columns are.
#[derive(Debug, PartialEq)]
struct Header {
    /// Index of the set of columns.
    chart: usize,
    places: Vec<usize>,
    count: usize,
}

impl Header {
    /// Reads the header line.
    fn parse(charts: &[&'static [&'static str]], line: &str) -> std::result::Result<Header, String> {
        let given: Vec<&str> = cells(line.trim_start_matches('\u{feff}')).collect();
        let has_all =
            |chart: &&[&str]| chart.iter().all(|name| given.iter().any(|cell| cell.eq_ignore_ascii_case(name)));
        let Some(chart) = charts.iter().position(has_all) else {
            if let Some((name, _)) = OTHERS.iter().find(|(_, separator)| line.contains(*separator)) {
                return Err(format!(
                    "the header is {:?}, with {name} between the columns; save the table with commas between columns, \
                     and with decimal points in numbers",
                    line.trim()
                ));
            }
            return Err(format!("the header is {:?}; it must have the columns {}", line.trim(), columns(charts)));
        };
        let place = |name: &&str| {
            let mut found =
                given.iter().enumerate().filter(|(_, cell)| cell.eq_ignore_ascii_case(name)).map(|(i, _)| i);
            let first = found.next().unwrap_or_default();
            if found.next().is_none() { Ok(first) } else { Err(format!("the header has two columns `{name}`")) }
        };
        let places = charts[chart].iter().map(place).collect::<std::result::Result<_, _>>()?;
        Ok(Header { chart, places, count: given.len() })
    }

    /// The cells of a row, in the order of the columns.
    fn cells<'l>(&self, line: &'l str) -> std::result::Result<Vec<&'l str>, String> {
        let all: Vec<&str> = cells(line).collect();
        if all.len() != self.count {
            let comma = if all.len() > self.count { " (numbers have decimal points: 0.5, not 0,5)" } else { "" };
            return Err(format!("the row has {}; the header has {}{comma}", count(all.len(), "value"), self.count));
        }
        Ok(self.places.iter().map(|place| all[*place]).collect())
    }
}

/// Sets of columns for a message.
fn columns(charts: &[&'static [&'static str]]) -> String {
    charts.iter().map(|names| names.join(",")).collect::<Vec<_>>().join(" or ")
}

/// The cells of a line, without blanks and quotation marks around them. Commas between marks are part of a cell, unless
/// a mark has no partner.
fn cells(line: &str) -> impl Iterator<Item = &str> {
    let paired = line.matches('"').count().is_multiple_of(2);
    let mut inside = false;
    let separates = move |c: char| {
        inside ^= paired && c == '"';
        c == ',' && !inside
    };
    line.split(separates).map(|cell| cell.trim().trim_matches('"').trim())
}

#[derive(serde::Serialize)]
struct Bad {
    row: u64,
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
        let mut skipped = 0;
        while skipped < MAX_SKIPPED {
            let buffer = self.input.fill_buf()?;
            let end = buffer.iter().position(|b| *b == b'\n');
            let (length, done) = (end.map_or(buffer.len(), |at| at + 1), end.is_some() || buffer.is_empty());
            self.input.consume(length);
            if done {
                return Ok(());
            }
            skipped += length;
        }
        Err(io::Error::other(format!(
            "line {} has no end within {}; this is no table",
            self.number,
            size(MAX_SKIPPED as u64)
        )))
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

    #[test]
    fn a_line_without_end_is_left() {
        let mut lines = Lines { input: BufReader::new(Box::new(io::repeat(b'0'))), number: 0, line: Vec::new() };
        assert!(lines.next().unwrap_err().to_string().contains("line 1 has no end"));
    }

    #[test]
    fn headers_say_where_columns_are() {
        const CHARTS: [&[&str]; 2] = [&["phi0", "phi1", "kappa0", "kappa1"], &["phi0", "phi1", "a", "k"]];
        let parse = |line| Header::parse(&CHARTS, line);
        let plain = parse("phi0,phi1,kappa0,kappa1\r\n").unwrap();
        assert_eq!((plain.chart, &plain.places[..], plain.count), (0, &[0, 1, 2, 3][..], 4));
        let other = parse("\u{feff}\"kappa1\", id ,phi1,\"phi0\",kappa0").unwrap();
        assert_eq!((&other.places[..], other.count), (&[3, 2, 4, 0][..], 5));
        assert_eq!(other.cells("4,\"x\",90deg,0.7 , \"-0.4\"").unwrap(), ["0.7", "90deg", "-0.4", "4"]);
        assert_eq!(parse("phi0,phi1,a,k").unwrap().chart, 1);
        assert_eq!(parse("Phi0,PHI1,kappa0,kappa1").unwrap().chart, 0);
        assert_eq!(other.cells("4,\"Main St, 5\",90deg,0.7,-0.4").unwrap(), ["0.7", "90deg", "-0.4", "4"]);
        assert!(other.cells("4,\"x,90deg,0.7,-0.4").is_ok(), "a mark alone");
        assert_eq!(other.cells("4,x,90deg,\"0,7\",-0.4").unwrap()[0], "0,7");
        assert!(plain.cells("0,7,1,4,0,4,4").unwrap_err().contains("0.5, not 0,5"));
        assert!(parse("phi0;phi1;kappa0;kappa1").unwrap_err().contains("with semicolons between the columns"));
        assert!(parse("phi0,phi1,kappa0,kapa1").unwrap_err().contains("kapa1"));
        assert!(parse("phi0,phi1,kappa0,kappa1,phi0").unwrap_err().contains("two columns"));
        assert!(plain.cells("1,2,3").unwrap_err().contains("3 values"));
    }
}
