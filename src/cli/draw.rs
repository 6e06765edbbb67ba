//! The picture files of a recipe and its atlases, for all commands that draw.

use super::output::Product;
use spiral_atlas::atlas::Atlas;
use spiral_atlas::cells::{self, Cells, Spec};
use spiral_atlas::files::{check_place, write_file};
use spiral_atlas::plot::{Drawing, Format};
use spiral_atlas::recipe::{AtlasPlan, Look, PictureKind, PicturePlan, Recipe};
use spiral_atlas::{Error, Result, picture, plain};
use std::path::{Path, PathBuf};

/// Draws an atlas's pictures into a folder.
pub(super) fn one(atlas: &Atlas, plans: &[PicturePlan], folder: &Path, format: Format) -> Result<Vec<Product>> {
    each(&atlas.about().name, plans, folder, format, |plan| picture::draw(atlas, plan))
}

/// Draws pictures of cells into a folder.
pub(super) fn of_cells(cells: &Cells, plans: &[PicturePlan], folder: &Path, format: Format) -> Result<Vec<Product>> {
    each(&cells.about().name, plans, folder, format, |plan| picture::cells::draw(cells, plan))
}

fn each(
    name: &str,
    plans: &[PicturePlan],
    folder: &Path,
    format: Format,
    draw: impl Fn(&PicturePlan) -> Result<Drawing>,
) -> Result<Vec<Product>> {
    let files = picture::files(folder, name, plans.len(), format);
    let write = |(plan, file): (&PicturePlan, PathBuf)| {
        write_file(&file, &draw(plan)?.file(format)?)?;
        Product::of(&file)
    };
    plans.iter().zip(files).map(write).collect()
}

/// What a plan of cells specifies, with the budget that it has.
pub(super) fn cells_spec<'a>(recipe: &'a Recipe, plan: &'a AtlasPlan, budget: u64) -> Spec<'a> {
    Spec { name: &plan.name, family: plan.family, grid: &plan.grid, budget, recipe: &recipe.text }
}

fn first_slice(pictures: &[PicturePlan]) -> Option<&PicturePlan> {
    pictures.iter().find(|p| matches!(p.kind, PictureKind::Slice | PictureKind::Compare { .. }))
}

/// An atlas of nodes with its first slice.
fn with_slice(plan: &AtlasPlan) -> Option<(&AtlasPlan, &PicturePlan)> {
    Some((plan, first_slice(&plan.pictures).filter(|_| plan.cells.is_none())?))
}

/// Draws the first planned slices or comparisons of several atlases side by side; `None` when there are not several.
pub(super) fn together(
    source: &Path,
    recipe: &Recipe,
    atlases: &[Atlas],
    folder: &Path,
    format: Format,
) -> Result<Option<Product>> {
    let of_nodes = recipe.atlases.iter().filter(|plan| plan.cells.is_none());
    let planned = atlases.iter().zip(of_nodes).filter_map(|(atlas, plan)| Some((atlas, first_slice(&plan.pictures)?)));
    let slices = planned.map(|(atlas, plan)| picture::slice(atlas, plan)).collect::<Result<Vec<_>>>()?;
    if slices.len() < 2 {
        return Ok(None);
    }
    let (stem, file) = (stem(source), together_path(source, folder, format));
    write_file(&file, &picture::side_by_side(&stem, &recipe.look, slices)?.file(format)?)?;
    Product::of(&file).map(Some)
}

/// Makes sure, before any work, that every grid lies in the family's domain, every picture has room and the letters
/// that it needs, no two pictures of a recipe have one name, and nothing but files has these names.
///
/// # Errors
/// Those of [`spiral_atlas::family::Family::table`], [`Error::Recipe`] that names the file, and [`Error::Io`].
pub(super) fn check(source: &Path, recipe: &Recipe, folder: &Path, format: Format) -> Result<()> {
    for plan in &recipe.atlases {
        let checked = match plan.cells {
            Some(budget) => cells::check(&cells_spec(recipe, plan, budget)),
            None => plan.family.table(&plan.grid).map(drop),
        };
        checked.map_err(|e| match e {
            Error::Domain(what) => Error::Recipe(format!("{}, atlas `{}`: {what}", source.display(), plan.name)),
            other => other,
        })?;
    }
    // Of a picture by its file, and by the line of the recipe that has its size.
    let blamed = |file: &Path, look: &Look, checked: Result<()>| {
        checked.map_err(|e| {
            let line = look.at.map_or(String::new(), |at| format!(", line {}", plain::place(&recipe.text[..at]).0));
            let picture = file.file_name().unwrap_or_default().display();
            Error::Recipe(format!("{}{line}: `{picture}`: {e}", source.display()))
        })
    };
    let mut files: Vec<PathBuf> = Vec::new();
    for plan in &recipe.atlases {
        for (picture, file) in plan.pictures.iter().zip(picture::files(folder, &plan.name, plan.pictures.len(), format))
        {
            blamed(&file, &picture.look, picture::check(plan, picture))?;
            files.push(file);
        }
    }
    let sliced: Vec<(&AtlasPlan, &PicturePlan)> = recipe.atlases.iter().filter_map(with_slice).collect();
    if sliced.len() > 1 {
        let file = together_path(source, folder, format);
        blamed(&file, &recipe.look, picture::check_side_by_side(&stem(source), &recipe.look, &sliced))?;
        files.push(file);
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

fn together_path(recipe: &Path, folder: &Path, format: Format) -> PathBuf {
    folder.join(format!("{}.{}", stem(recipe), format.ending()))
}

fn stem(recipe: &Path) -> String {
    recipe.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
