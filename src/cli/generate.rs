//! `generate`: from a recipe to atlases, reports and pictures.

use super::backend::{self, BackendArgs};
use super::cells;
use super::output::{self, Product, atlas_path, grouped, report_path};
use super::verify::{self, Compared};
use super::{Outcome, draw};
use spiral_atlas::Result;
use spiral_atlas::atlas::{Atlas, Spec, Writer};
use spiral_atlas::eval::{Backend, Job, Report, evaluate};
use spiral_atlas::files::{self, write_file};
use spiral_atlas::plot::Format;
use spiral_atlas::recipe::{AtlasPlan, Recipe};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Nodes that `--check sample` recomputes.
const SAMPLES: u64 = 2000;

/// Make the atlases of a recipe, with their pictures and a report.
///
/// Of each atlas: NAME.atlas.safetensors (the same bytes on every machine), NAME.report.json (what differs: backend,
/// time, check) and the recipe's pictures, NAME.png or NAME-1.png, NAME-2.png, ... Several atlases that begin with
/// slices are also drawn side by side, in RECIPE.png. Files appear whole or not at all.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
              spiral-atlas generate atlases/quickstart.toml\n  \
              spiral-atlas generate my.toml --out maps --backend gpu --adapter llvmpipe --check full")]
pub(super) struct Args {
    /// The recipe, a TOML file.
    recipe: PathBuf,
    /// Folder for the files; created when missing.
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// What to recompute afterwards: nothing, some 2000 nodes by the top of the ladder, or all by the other backends.
    #[arg(long, value_enum, default_value_t = Check::None)]
    check: Check,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Check {
    None,
    Sample,
    Full,
}

/// What was made of one atlas.
#[derive(serde::Serialize)]
struct Made {
    atlas: String,
    id: String,
    report: Report,
    check: Vec<Compared>,
    files: Vec<Product>,
}

/// `NAME.report.json`: all that may differ between two runs that write the same atlas.
#[derive(serde::Serialize)]
struct ReportFile<'a> {
    atlas: &'a str,
    id: &'a str,
    #[serde(flatten)]
    report: &'a Report,
    check: &'a [Compared],
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    let (recipe, backend) = (Recipe::read(&args.recipe)?, args.backend.one()?);
    draw::check(&args.recipe, &recipe, &args.out, Format::Png)?;
    for plan in &recipe.atlases {
        files::check_place(&atlas_path(&args.out, &plan.name))?;
        files::check_place(&report_path(&args.out, &plan.name))?;
    }
    check_room(&recipe, &args.out)?;
    // Before the work rather than after: whether the check can be done at all.
    let checkers = if args.check == Check::Full { backend::others(&backend)? } else { Vec::new() };
    let stop = super::stop_flag()?;
    output::make_folder(&args.out)?;
    let (mut all, mut atlases) = (Vec::new(), Vec::new());
    let mut good = true;
    for plan in &recipe.atlases {
        if let Some(budget) = plan.cells {
            let made = cells::make(&recipe, plan, budget, &args.out, args.backend.threads(), &stop)?;
            if !args.json {
                output::print(&made.summary())?;
            }
            all.push(output::to_value(&made)?);
            continue;
        }
        let path = atlas_path(&args.out, &plan.name);
        let (report, writer) = write_atlas(&recipe, plan, &path, &backend, args.backend.threads(), &stop)?;
        writer.finish()?;
        let atlas = Atlas::open(&path)?;
        let made = finish(args, plan, &atlas, report, &checkers, &stop)?;
        if !args.json {
            output::print(&made.summary(plan))?;
        }
        good &= made.check.iter().all(Compared::holds);
        all.push(output::to_value(&made)?);
        atlases.push(atlas);
    }
    let together = draw::together(&args.recipe, &recipe, &atlases, &args.out, Format::Png)?;
    if args.json {
        output::print_json(&serde_json::json!({ "atlases": all, "together": together }))?;
    } else if let Some(picture) = together {
        output::print(&format!("side by side\n{}", picture.line()))?;
    }
    if !good {
        output::complain("the check found differences; the files were kept");
    }
    Ok(if good { Outcome::Fine } else { Outcome::Bad })
}

/// Makes sure, before any work, that the disk has room for all atlases of a recipe together.
pub(super) fn check_room(recipe: &Recipe, folder: &Path) -> Result<()> {
    let size = |plan: &AtlasPlan| plan.cells.map_or_else(|| Writer::size(&spec(recipe, plan)), Ok);
    let sizes = recipe.atlases.iter().map(size);
    let sum = sizes.sum::<Result<u64>>()?;
    let what = match &recipe.atlases[..] {
        [one] => format!("the atlas `{}`", one.name),
        all => format!("the {} atlases of the recipe", all.len()),
    };
    files::check_room(folder, &what, sum)
}

fn spec<'a>(recipe: &'a Recipe, plan: &'a AtlasPlan) -> Spec<'a> {
    Spec { name: &plan.name, family: plan.family, grid: &plan.grid, scalars: &plan.scalars, recipe: &recipe.text }
}

/// Evaluates an atlas straight into its file, which is then whole but not finished.
pub(super) fn write_atlas(
    recipe: &Recipe,
    plan: &AtlasPlan,
    path: &Path,
    backend: &Backend,
    threads: usize,
    stop: &AtomicBool,
) -> Result<(Report, Writer)> {
    let job = Job { family: plan.family, grid: &plan.grid, scalars: &plan.scalars };
    let mut writer = Writer::create(path, &spec(recipe, plan))?;
    let bar = output::progress(plan.name.clone(), plan.grid.len());
    let report = evaluate(&job, backend, threads, stop, |chunk| {
        writer.put(&chunk)?;
        bar.inc(chunk.len() as u64);
        Ok(())
    });
    bar.finish_and_clear();
    Ok((report?, writer))
}

/// Checks an atlas and writes what stands beside it.
fn finish(
    args: &Args,
    plan: &AtlasPlan,
    atlas: &Atlas,
    report: Report,
    checkers: &[Backend],
    stop: &AtomicBool,
) -> Result<Made> {
    let job = Job { family: plan.family, grid: &plan.grid, scalars: &plan.scalars };
    let stored = spiral_atlas::atlas::verify::stored(atlas)?;
    let check = match args.check {
        Check::None => Vec::new(),
        Check::Sample => vec![verify::sampled(&job, &stored, SAMPLES, stop)?],
        Check::Full => {
            let threads = args.backend.threads();
            checkers.iter().map(|b| verify::compared(&job, &stored, b, threads, stop)).collect::<Result<_>>()?
        }
    };
    let id = atlas.id().to_hex().to_string();
    let beside = report_path(&args.out, &plan.name);
    let text = output::to_json(&ReportFile { atlas: &plan.name, id: &id, report: &report, check: &check })? + "\n";
    write_file(&beside, text.as_bytes())?;
    let mut files = vec![Product::of(atlas.path())?, Product::of(&beside)?];
    files.extend(draw::one(atlas, &plan.pictures, &args.out, Format::Png)?);
    Ok(Made { atlas: plan.name.clone(), id, report, check, files })
}

impl Made {
    fn summary(&self, plan: &AtlasPlan) -> String {
        let r = &self.report;
        let axes = plan.grid.axes().iter().map(|a| format!("{} {}", a.name(), grouped(a.values().len() as u64)));
        let axes: Vec<String> = axes.collect();
        let mut text = format!("{}: {} = {} nodes\n", self.atlas, axes.join(" x "), grouped(r.nodes));
        text += &format!("  by {} in {:.2} s, with {} threads\n", who(r), r.seconds, r.threads);
        text += "  nodes with a proved yes\n";
        for flag in plan.family.about().flags {
            let count = r.yes.get(flag.name).copied().unwrap_or(0);
            let share = count as f64 / r.nodes.max(1) as f64 * 100.0;
            text += &format!("    {:<14} {:>16}  {share:6.2} %  {}\n", flag.name, grouped(count), flag.label);
        }
        text += "  undecided nodes after each step of the ladder\n";
        let after =
            |step: &str, count: u64| format!("    {step:<14} {:>16}  {}\n", grouped(count), rate(count, r.nodes));
        if let Some(count) = r.undecided_f32 {
            text += &after("f32", count);
        }
        text += &after("f64", r.undecided_f64);
        let bits =
            if r.most_bits > 0 { format!("intervals of up to {} bits", r.most_bits) } else { "intervals".into() };
        text += &format!("    {bits}: {}\n", grouped(r.undecided));
        for compared in &self.check {
            text += &format!("  check {}", compared.text());
        }
        text + &self.files.iter().map(Product::line).collect::<String>()
    }
}

fn rate(count: u64, of: u64) -> String {
    of.checked_div(count).map_or("none".into(), |n| format!("1 in {}", grouped(n)))
}

#[cfg(feature = "gpu")]
fn who(report: &Report) -> String {
    report.device.as_ref().map_or("the CPU".into(), |device| device.adapter.label())
}

#[cfg(not(feature = "gpu"))]
fn who(_: &Report) -> String {
    "the CPU".into()
}
