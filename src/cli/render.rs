//! `render`: pictures of an atlas, or of a recipe whose atlases are not kept.

use super::backend::BackendArgs;
use super::cells::{self, Opened};
use super::output::{self, Product};
use super::{Outcome, draw, generate, numbers};
use spiral_atlas::plot::Format;
use spiral_atlas::recipe::Recipe;
use spiral_atlas::{Result, picture};
use std::path::PathBuf;

/// Draw pictures of an atlas, or of a recipe (its atlases are made and not kept).
///
/// The pictures are those of the recipe, which every atlas carries with it: NAME.png, or NAME-1.png, NAME-2.png, ...
/// An atlas without planned pictures gets a slice over its last two axes, at the middle of the others.
/// Several atlases of a recipe that begin with slices are also drawn side by side, in RECIPE.png. With --format svg all
/// of these are SVG files: lines, areas and texts, for print.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
              spiral-atlas render out/quickstart.atlas.safetensors --out pictures\n  \
              spiral-atlas render atlases/habib-sakai-fig2.toml")]
pub(super) struct Args {
    /// An atlas (.safetensors) or a recipe (.toml).
    source: PathBuf,
    /// Folder for the pictures; created when missing.
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// PNG, or SVG for print.
    #[arg(long, value_name = "NAME", default_value = "png", value_parser = numbers::named::<Format>(&["png", "svg"]))]
    format: Format,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendArgs,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    let products = if args.source.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
        of_recipe(args)?
    } else {
        let opened = Opened::checked(&args.source)?;
        output::make_folder(&args.out)?;
        match &opened {
            Opened::Nodes(atlas) => {
                draw::one(atlas, &picture::plans(atlas.about(), atlas.grid())?, &args.out, args.format)?
            }
            Opened::Cells(found) => draw::of_cells(found, &picture::cells::plans(found)?, &args.out, args.format)?,
        }
    };
    if args.json {
        output::print_json(&products)?;
    } else {
        output::print(&products.iter().map(Product::line).collect::<String>())?;
    }
    Ok(Outcome::Fine)
}

/// Makes the recipe's atlases in files that go away, and draws them.
fn of_recipe(args: &Args) -> Result<Vec<Product>> {
    let (recipe, backend) = (Recipe::read(&args.source)?, args.backend.one()?);
    draw::check(&args.source, &recipe, &args.out, args.format)?;
    generate::check_room(&recipe, &args.out)?;
    let stop = super::stop_flag()?;
    output::make_folder(&args.out)?;
    let (mut atlases, mut products) = (Vec::new(), Vec::new());
    for plan in &recipe.atlases {
        if let Some(budget) = plan.cells {
            let found = cells::in_memory(&recipe, plan, budget, args.backend.threads(), &stop)?;
            products.extend(draw::of_cells(&found, &picture::cells::plans(&found)?, &args.out, args.format)?);
            continue;
        }
        // Beside the pictures: there is room for them, and the system's own folder may be memory.
        let path = output::atlas_path(&args.out, &plan.name);
        let (_, writer) = generate::write_atlas(&recipe, plan, &path, &backend, args.backend.threads(), &stop)?;
        let atlas = writer.open()?;
        products.extend(draw::one(&atlas, &picture::plans(atlas.about(), atlas.grid())?, &args.out, args.format)?);
        atlases.push(atlas);
    }
    products.extend(draw::together(&args.source, &recipe, &atlases, &args.out, args.format)?);
    Ok(products)
}
