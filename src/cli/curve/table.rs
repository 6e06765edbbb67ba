//! `curve --points`: ends from a CSV file, one answer a line.

use super::super::{Outcome, output, points};
use super::report::{Report, Wish};
use super::{Args, Family, Found, involute};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::transition::{Ends, ph_spiral, spiral};
use spiral_atlas::{Error, Result};
use std::path::Path;

/// Columns, in the order of [`ends`].
const COLUMNS: [&str; 8] = ["x0", "y0", "direction0", "curvature0", "x1", "y1", "direction1", "curvature1"];

/// Answers for every row of a file, or of standard input for `-`.
pub fn run(args: &Args, path: &Path) -> Result<Outcome> {
    let wish = args.wish();
    points::run(path, &[&COLUMNS], args.csv, |row| {
        let ends = ends(row.cells)?;
        match args.family {
            Family::PhQuintic => args.row(row, &ph_spiral(&ends)?.no_longer_than(wish.longest()), wish),
            Family::Involute => args.row(row, &involute::find(&ends, args.turns.unwrap_or_default())?, wish),
            _ => args.row(row, &spiral(&ends)?.no_longer_than(wish.longest()), wish),
        }
    })
}

impl Args {
    /// What is printed for a row.
    fn row(&self, row: &points::Row, found: &impl Found, wish: Wish) -> Result<Vec<u8>> {
        let report = Report::new(found, wish)?;
        if self.csv {
            return row.table(report.samples.as_deref().unwrap_or_default(), report.reason.as_deref());
        }
        serde_json::to_vec(&report).map_err(output::json_error)
    }
}

/// The ends of a row.
fn ends(cells: &[&str]) -> Result<Ends> {
    let number = |i: usize| {
        let wrong = || Error::Domain(format!("{}: {:?} is no number", COLUMNS[i], cells[i]));
        cells[i].parse::<f64>().map_err(|_| wrong())
    };
    let angle = |i: usize| parse_angle(cells[i]).map_err(|e| Error::Domain(format!("{}: {e}", COLUMNS[i])));
    Ok(Ends {
        start: [number(0)?, number(1)?],
        start_direction: angle(2)?,
        start_curvature: number(3)?,
        end: [number(4)?, number(5)?],
        end_direction: angle(6)?,
        end_curvature: number(7)?,
    })
}
