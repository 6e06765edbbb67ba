//! `info`: what an atlas says about itself.

use super::Outcome;
use super::cells::{self, Opened};
use super::legend::{flags, head, spacing, tail};
use super::output::{self, Object, grouped};
use spiral_atlas::Result;
use spiral_atlas::atlas::{About, Atlas};
use spiral_atlas::grid::Axis;
use std::path::PathBuf;

/// Show what an atlas holds: grid, fields, legend, hashes, recipe.
///
/// The hashes are checked first, as in `render` and `query --atlas`: a file with a damaged bit is refused. `verify`
/// shows whether its verdicts are true.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas info out/quickstart.atlas.safetensors")]
pub(super) struct Args {
    /// The atlas.
    atlas: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    let atlas = match Opened::checked(&args.atlas)? {
        Opened::Nodes(atlas) => atlas,
        Opened::Cells(found) => return cells::info(&found, args.json).map(|()| Outcome::Fine),
    };
    if args.json {
        output::print_json(&json(&atlas))?
    } else {
        output::print(&text(&atlas))?
    }
    Ok(Outcome::Fine)
}

fn json(atlas: &Atlas) -> serde_json::Value {
    let About { kind: _, generator, name, family, chart, chart_doc, conventions, flags, counts, scalars, recipe } =
        atlas.about();
    let axis = |a: &Axis| {
        let values = a.values();
        serde_json::json!({
            "name": a.name(), "spacing": spacing(a), "count": values.len(), "first": values[0],
            "last": values[values.len() - 1],
        })
    };
    let axes: Vec<_> = atlas.grid().axes().iter().map(axis).collect();
    let hashes = Object(atlas.hashes().map(|(name, hash)| (name, hash.to_hex().to_string())).collect());
    serde_json::json!({
        "file": atlas.path(), "name": name, "id": atlas.id().to_hex().as_str(), "generator": generator,
        "family": family, "chart": chart, "chart_doc": chart_doc, "conventions": conventions,
        "nodes": atlas.grid().len(), "axes": axes, "flags": flags, "counts": counts, "scalars": scalars,
        "blake3": hashes, "recipe": recipe,
    })
}

fn text(atlas: &Atlas) -> String {
    let about = atlas.about();
    let mut text = head(atlas.path(), about, &atlas.id().to_hex());
    text += &format!("grid of {} nodes, first axis slowest; chart `{}`\n", grouped(atlas.grid().len()), about.chart);
    for axis in atlas.grid().axes() {
        let values = axis.values();
        let (count, first, last) = (values.len(), values[0], values[values.len() - 1]);
        text += &format!("  {:<12} {:<6} {count:>6} values from {first:?} to {last:?}\n", axis.name(), spacing(axis));
    }
    text += &format!("  {}\nflags (u8)\n{}solutions (u8)\n", about.chart_doc, flags(about));
    for count in &about.counts {
        let last = count.shift + count.bits - 1;
        text += &format!("  bits {}-{last} {:<11} {}\n", count.shift, count.name, count.doc);
    }
    if !about.scalars.is_empty() {
        text += "scalars (f32)\n";
    }
    for scalar in &about.scalars {
        text += &format!("  {:<20} {}\n", scalar.name, scalar.doc);
    }
    text + &tail(about, atlas.hashes())
}
