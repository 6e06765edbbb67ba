//! `curve --points`: ends from a CSV file, one answer a line.

use super::super::join::parse::{COLUMNS, states};
use super::super::{Outcome, output, points};
use super::report::{Report, Wish};
use super::{Args, Family, Reportable, involute};
use spiral_atlas::Result;
use spiral_atlas::transition::{Ends, ph_spiral, spiral};
use std::path::Path;

/// Answers for every row of a file, or of standard input for `-`.
pub(super) fn run(args: &Args, path: &Path) -> Result<Outcome> {
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
    fn row(&self, row: &points::Row, found: &impl Reportable, wish: Wish) -> Result<Vec<u8>> {
        let report = Report::new(found, wish)?;
        if self.csv {
            return row.table(report.samples.as_deref().unwrap_or_default(), report.reason.as_deref());
        }
        serde_json::to_vec(&report).map_err(output::json_error)
    }
}

/// The ends of a row.
fn ends(cells: &[&str]) -> Result<Ends> {
    let [start, end] = states(cells)?;
    Ok(Ends {
        start: start.point,
        end: end.point,
        start_direction: start.direction,
        end_direction: end.direction,
        start_curvature: start.curvature,
        end_curvature: end.curvature,
    })
}
