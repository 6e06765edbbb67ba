//! What the commands do with an atlas of cells.

use super::legend::{self, flags, head, spacing, tail};
use super::output::{self, Object, Product, grouped};
use super::{Outcome, draw};
use spiral_atlas::atlas::{Atlas, Kind};
use spiral_atlas::cells::{self, Attack, Built, Cells, Known, Spec, Verified};
use spiral_atlas::files::{size, write_file};
use spiral_atlas::plot::Format;
use spiral_atlas::recipe::{AtlasPlan, Recipe};
use spiral_atlas::{Result, atlas};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// A file of either kind.
pub(super) enum Opened {
    Nodes(Box<Atlas>),
    Cells(Box<Cells>),
}

impl Opened {
    pub(super) fn open(path: impl AsRef<Path>) -> Result<Opened> {
        let path = path.as_ref();
        Ok(match atlas::kind(path)? {
            Kind::Nodes => Opened::Nodes(Box::new(Atlas::open(path)?)),
            Kind::Cells => Opened::Cells(Box::new(Cells::open(path)?)),
        })
    }

    /// The same, and the hashes of all that the file holds are compared with those that it states.
    pub(super) fn checked(path: impl AsRef<Path>) -> Result<Opened> {
        let opened = Opened::open(path)?;
        match &opened {
            Opened::Nodes(atlas) => atlas.check_hashes()?,
            Opened::Cells(cells) => cells.check_hashes()?,
        }
        Ok(opened)
    }
}

/// What was made of one atlas of cells.
#[derive(serde::Serialize)]
pub(super) struct Made {
    atlas: String,
    id: String,
    kind: &'static str,
    resolution: usize,
    threads: usize,
    seconds: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<Product>,
}

/// Makes cells, with a bar that shows how many have been divided.
fn with_bar<T>(name: &str, most_bytes: u64, make: impl FnOnce(&(dyn Fn(u64) + Sync)) -> T) -> T {
    // How many will be divided is not known before: a cell takes some five bytes.
    let bar = output::progress(name.to_owned(), most_bytes / 5);
    let made = make(&|divided| bar.set_position(divided));
    bar.finish_and_clear();
    made
}

fn build(spec: &Spec, threads: usize, stop: &AtomicBool) -> Result<Built> {
    with_bar(spec.name, spec.budget, |bar| cells::build(spec, threads, stop, bar))
}

/// Makes the cells of a plan for pictures alone.
pub(super) fn in_memory(
    recipe: &Recipe,
    plan: &AtlasPlan,
    budget: u64,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Cells> {
    let spec = draw::cells_spec(recipe, plan, budget);
    Cells::from_bytes(&cells::bytes(&spec, &build(&spec, threads, stop)?)?)
}

/// Makes the file of a plan, its report and its pictures.
pub(super) fn make(
    recipe: &Recipe,
    plan: &AtlasPlan,
    budget: u64,
    out: &Path,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Made> {
    let spec = draw::cells_spec(recipe, plan, budget);
    let started = Instant::now();
    let built = build(&spec, threads, stop)?;
    let path = output::atlas_path(out, &plan.name);
    cells::write(&path, &spec, &built)?;
    let cells = Cells::open(&path)?;
    let (id, seconds) = (cells.id()?.to_hex().to_string(), started.elapsed().as_secs_f64());
    let mut made = Made {
        atlas: plan.name.clone(),
        id,
        kind: "cells",
        resolution: cells.resolution(),
        threads,
        seconds,
        files: Vec::new(),
    };
    let beside = output::report_path(out, &plan.name);
    write_file(&beside, (output::to_json(&made)? + "\n").as_bytes())?;
    made.files = vec![Product::of(&path)?, Product::of(&beside)?];
    made.files.extend(draw::of_cells(&cells, &plan.pictures, out, Format::Png)?);
    Ok(made)
}

impl Made {
    pub(super) fn summary(&self) -> String {
        let Made { atlas, resolution, threads, seconds, .. } = self;
        let text = format!(
            "{atlas}: cells, up to {resolution} an axis\n  by the CPU in {seconds:.2} s, with {threads} threads\n"
        );
        text + &self.files.iter().map(Product::line).collect::<String>()
    }
}

#[derive(serde::Serialize)]
struct Report<'a> {
    atlas: &'a Path,
    id: String,
    #[serde(flatten)]
    found: Verified,
    seconds: f64,
    good: bool,
}

/// Makes the cells anew and compares every word; asks the family itself about points.
pub(super) fn verify(cells: &Cells, threads: usize, json: bool) -> Result<Outcome> {
    let started = Instant::now();
    let stop = super::stop_flag()?;
    let found = with_bar(&cells.about().name, cells.bytes(), |bar| cells::verify(cells, threads, &stop, bar))?;
    let (id, seconds) = (cells.id()?.to_hex().to_string(), started.elapsed().as_secs_f64());
    let report = Report { atlas: cells.path(), id, good: found.holds(), found, seconds };
    if json {
        output::print_json(&report)?
    } else {
        output::print(&report.text())?
    }
    if !report.good {
        output::complain(&format!("{}: verification failed", cells.path().display()));
    }
    Ok(if report.good { Outcome::Fine } else { Outcome::Bad })
}

impl Report<'_> {
    fn text(&self) -> String {
        let Verified { faults, differences, first_difference, attack } = &self.found;
        let mut text = legend::faults(self.atlas, &self.id, faults);
        let Attack { points, verdicts, wrong, first } = attack;
        let (points, verdicts) = (grouped(*points), grouped(*verdicts));
        text += &match (wrong, first) {
            (0, _) => format!("  attacked with {points} points: {verdicts} verdicts of cells, all true\n"),
            (_, first) => {
                let first = first.as_deref().unwrap_or("");
                format!(
                    "  attacked with {points} points: {verdicts} verdicts of cells, {} WRONG\n    {first}\n",
                    grouped(*wrong)
                )
            }
        };
        text += &match first_difference {
            None => "  made anew: every word agrees".to_owned(),
            Some(first) => format!("  made anew: {} words DIFFER\n    {first}\n ", grouped(*differences)),
        };
        text + &format!(" ({:.2} s)\n", self.seconds)
    }
}

/// What a file of cells says about itself.
pub(super) fn info(cells: &Cells, json: bool) -> Result<()> {
    let about = cells.about();
    let id = cells.id()?.to_hex().to_string();
    let axes = cells.grid().axes();
    if json {
        let axis = |a: &spiral_atlas::grid::Axis| {
            let values = a.values();
            serde_json::json!({
                "name": a.name(), "spacing": spacing(a), "first": values[0], "last": values[values.len() - 1],
            })
        };
        let hashes = Object(cells.hashes().map(|(name, hash)| (name, hash.to_hex().to_string())).collect());
        return output::print_json(&serde_json::json!({
            "file": cells.path(), "name": about.name, "id": id, "kind": "cells", "generator": about.generator,
            "family": about.family, "chart": about.chart, "chart_doc": about.chart_doc,
            "conventions": about.conventions,
            "resolution": cells.resolution(), "bytes": cells.bytes(), "axes": axes.iter().map(axis).collect::<Vec<_>>(),
            "flags": about.flags, "blake3": hashes, "recipe": about.recipe,
        }));
    }
    let mut text = head(cells.path(), about, &id);
    let (resolution, bytes) = (cells.resolution(), size(cells.bytes()));
    text += &format!("cells, up to {resolution} an axis, in {bytes}; chart `{}`\n", about.chart);
    for axis in axes {
        let (first, last) = (axis.values()[0], axis.values()[axis.values().len() - 1]);
        let range = if first == last { format!("at {first:?}") } else { format!("from {first:?} to {last:?}") };
        text += &format!("  {:<12} {:<6} {range}\n", axis.name(), spacing(axis));
    }
    text += &format!("  {}\nflags\n{}", about.chart_doc, flags(about));
    output::print(&(text + &tail(about, cells.hashes())))
}

/// What the cell of a datum says of each flag; `None` outside the box, or for a datum in other coordinates than those
/// of the file.
pub(super) fn look_up(cells: &Cells, chart: usize, point: &[f64]) -> Option<Object<&'static str, &'static str>> {
    let Known { inside, outside } = if chart == cells.chart() { cells.lookup(point)? } else { return None };
    let word = |bit: usize| match (inside >> bit & 1, outside >> bit & 1) {
        (1, _) => "INSIDE",
        (_, 1) => "OUTSIDE",
        _ => "MIXED",
    };
    Some(Object(cells.family().about().flags.iter().enumerate().map(|(bit, flag)| (flag.name, word(bit))).collect()))
}
