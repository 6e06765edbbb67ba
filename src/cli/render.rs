//! `render`: pictures of an atlas, or of a recipe whose atlases are not kept.

use super::backend::BackendArgs;
use super::output::{self, Product};
use super::pictures;
use super::{Outcome, generate};
use spiral_atlas::atlas::Atlas;
use spiral_atlas::files::{check_place, write_file};
use spiral_atlas::recipe::{AtlasPlan, PictureKind, PicturePlan, Recipe};
use spiral_atlas::{Error, Result};
use std::path::{Path, PathBuf};

/// Draw PNG pictures of an atlas, or of a recipe (its atlases are made and not kept).
///
/// The pictures are those of the recipe, which every atlas carries with it: NAME.png, or NAME-1.png, NAME-2.png, ...
/// An atlas without planned pictures gets a slice over its last two axes, at the middle of the others.
/// Several atlases of a recipe that begin with slices are also drawn side by side, in RECIPE.png.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  spiral-atlas render out/quickstart.atlas.safetensors --out pictures\n  \
                        spiral-atlas render atlases/habib-sakai-fig2.toml")]
pub struct Args {
    /// An atlas (.safetensors) or a recipe (.toml).
    source: PathBuf,
    /// Folder for the pictures; created when missing.
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Outcome> {
    let products = if args.source.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
        of_recipe(args)?
    } else {
        let atlas = Atlas::open(&args.source)?;
        let plans = pictures::plans(&atlas)?;
        output::make_folder(&args.out)?;
        one(&atlas, &plans, &args.out)?
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
    check(&args.source, &recipe, &args.out)?;
    generate::check_room(&recipe, &args.out)?;
    let stop = super::stop_flag()?;
    output::make_folder(&args.out)?;
    let (mut atlases, mut products) = (Vec::new(), Vec::new());
    for plan in &recipe.atlases {
        // Beside the pictures: there is room for them, and the system's own folder may be memory.
        let path = generate::atlas_path(&args.out, &plan.name);
        let (_, writer) = generate::write_atlas(&recipe, plan, &path, &backend, args.backend.threads(), &stop)?;
        let atlas = writer.open()?;
        products.extend(one(&atlas, &pictures::plans(&atlas)?, &args.out)?);
        atlases.push(atlas);
    }
    products.extend(together(&args.source, &recipe, &atlases, &args.out)?);
    Ok(products)
}

/// Draws an atlas's pictures into a folder.
pub fn one(atlas: &Atlas, plans: &[PicturePlan], folder: &Path) -> Result<Vec<Product>> {
    let files = pictures::files(folder, &atlas.about().name, plans.len());
    let draw = |(plan, file): (&PicturePlan, PathBuf)| {
        write_file(&file, &pictures::draw(atlas, plan)?)?;
        Product::of(&file)
    };
    plans.iter().zip(files).map(draw).collect()
}

fn first_slice(pictures: &[PicturePlan]) -> Option<&PicturePlan> {
    pictures.iter().find(|p| matches!(p.kind, PictureKind::Slice | PictureKind::Compare { .. }))
}

/// Draws the first planned slices or comparisons of several atlases side by side; `None` when there are not several.
pub fn together(source: &Path, recipe: &Recipe, atlases: &[Atlas], folder: &Path) -> Result<Option<Product>> {
    let planned = atlases.iter().zip(&recipe.atlases).filter_map(|(atlas, plan)| Some((atlas, first_slice(&plan.pictures)?)));
    let slices = planned.map(|(atlas, plan)| pictures::slice(atlas, plan)).collect::<Result<Vec<_>>>()?;
    if slices.len() < 2 {
        return Ok(None);
    }
    let (stem, file) = (stem(source), together_path(source, folder));
    write_file(&file, &pictures::side_by_side(&stem, &recipe.look, slices)?)?;
    Product::of(&file).map(Some)
}

/// Makes sure, before any work, that every grid lies in the family's domain, no two pictures of a recipe have one name, and nothing
/// but files has these names.
///
/// # Errors
/// Those of [`spiral_atlas::family::Family::table`], [`Error::Recipe`] that names the file, and [`Error::Io`].
pub fn check(source: &Path, recipe: &Recipe, folder: &Path) -> Result<()> {
    for plan in &recipe.atlases {
        plan.family.table(&plan.grid).map_err(|e| match e {
            Error::Domain(what) => Error::Recipe(format!("{}, atlas `{}`: {what}", source.display(), plan.name)),
            other => other,
        })?;
    }
    let mut files: Vec<PathBuf> = Vec::new();
    for plan in &recipe.atlases {
        files.extend(pictures::files(folder, &plan.name, plan.pictures.len()));
    }
    let sliced = |plan: &&AtlasPlan| first_slice(&plan.pictures).is_some();
    if recipe.atlases.iter().filter(sliced).count() > 1 {
        files.push(together_path(source, folder));
    }
    files.sort();
    match files.windows(2).find(|pair| pair[0] == pair[1]) {
        None => files.iter().try_for_each(|file| check_place(file)),
        Some(pair) => Err(Error::Recipe(format!(
            "two pictures would be {}; rename an atlas, or the recipe itself (slices side by side bear its name)",
            pair[0].display()
        ))),
    }
}

fn together_path(recipe: &Path, folder: &Path) -> PathBuf {
    folder.join(stem(recipe) + ".png")
}

fn stem(recipe: &Path) -> String {
    recipe.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
