//! Pictures of an atlas: from a plan of its recipe to the plain data that [`crate::plot`] draws.

pub mod cells;
mod figures;
mod outlines;
mod source;
mod words;

pub use source::{Part, Source, shown};
pub use words::{angle, grouped, short};

use crate::atlas::About;
use crate::error::{Error, Result};
use crate::grid::Grid;
use crate::plot::{self, Drawing, Format, Multiples, Region, Sheet, Slice};
use crate::recipe::{self, AtlasPlan, Look, MULTIPLES_SIZE, PANEL_SIZE, PictureKind, PicturePlan, Recipe, SLICE_SIZE};
use figures::{middle_slice, multiples, sheet};
use source::Subject;
use std::path::{Path, PathBuf};

// What a recipe may ask for can be drawn: the two rooms do not know each other.
const _: () = assert!(plot::DPI == recipe::DPI && plot::MAX_PIXELS == recipe::MAX_PIXELS);

/// Height of the heading above slices of unlike regions, in pixels at the usual resolution.
const HEAD: u32 = 40;

/// The plans of an atlas: those of the recipe in its metadata or, where that has none, its default slice.
///
/// # Errors
/// [`Error::Domain`] when the atlas has a single axis.
pub fn plans(about: &About, grid: &Grid) -> Result<Vec<PicturePlan>> {
    let recipe = Recipe::parse(&about.recipe).ok();
    let planned = recipe.and_then(|r| r.atlases.into_iter().find(|a| a.name == about.name && a.grid == *grid));
    match planned.map(|a| a.pictures) {
        Some(pictures) if !pictures.is_empty() => Ok(pictures),
        _ => middle_slice(grid).map(|plan| vec![plan]),
    }
}

/// The files of an atlas's pictures: `NAME.png`, or `NAME-1.png`, `NAME-2.png`, ... for several; the same with `.svg`.
pub fn files(folder: &Path, name: &str, count: usize, format: Format) -> Vec<PathBuf> {
    let ending = format.ending();
    match count {
        1 => vec![folder.join(format!("{name}.{ending}"))],
        _ => (1..=count).map(|i| folder.join(format!("{name}-{i}.{ending}"))).collect(),
    }
}

/// Draws one picture of an atlas.
///
/// # Errors
/// Those of [`plot`], and [`Error::Domain`] for a family that this program does not have.
pub fn draw(atlas: &dyn Source, plan: &PicturePlan) -> Result<Drawing> {
    let subject = Subject::of(atlas)?;
    match plan.kind {
        PictureKind::Slice | PictureKind::Union | PictureKind::Compare { .. } => {
            plot::draw_slice(&figures::slice(&subject, plan)?, sheet(&plan.look, SLICE_SIZE))
        }
        PictureKind::Multiples => plot::draw_multiples(&multiples(&subject, plan)?, sheet(&plan.look, MULTIPLES_SIZE)),
    }
}

/// The slice of a plan: the chosen node of each axis that is not drawn or, of a union, all chosen ones together.
///
/// # Errors
/// [`Error::Domain`] for a family that this program does not have.
pub fn slice(atlas: &dyn Source, plan: &PicturePlan) -> Result<Slice> {
    figures::slice(&Subject::of(atlas)?, plan)
}

/// Draws slices of several atlases side by side: under one legend where they show the same, or else each with its own.
///
/// # Errors
/// As [`draw`].
pub fn side_by_side(stem: &str, look: &Look, slices: Vec<Slice>) -> Result<Drawing> {
    match SideBySide::new(stem, look, slices) {
        SideBySide::Alike(figure, usual) => plot::draw_multiples(&figure, sheet(look, usual)),
        SideBySide::Unlike { title, slices, columns, usual } => {
            plot::draw_montage(title, &slices, columns, sheet(look, usual))
        }
    }
}

/// Slices of several atlases, and their usual size.
enum SideBySide<'a> {
    /// Of the same regions, under one legend.
    Alike(Multiples, (u32, u32)),
    Unlike {
        title: &'a str,
        slices: Vec<Slice>,
        columns: usize,
        usual: (u32, u32),
    },
}

impl<'a> SideBySide<'a> {
    fn new(stem: &'a str, look: &'a Look, mut slices: Vec<Slice>) -> SideBySide<'a> {
        let title = look.title.as_deref().unwrap_or(stem);
        // The legend counts all panels together.
        for slice in &mut slices {
            let share = |region: &Region| {
                let yes = region.mask.iter().filter(|m| **m).count();
                format!("; {} {:.1} %", region.label, 100.0 * yes as f64 / region.mask.len().max(1) as f64)
            };
            slice.note += &slice.regions.iter().map(share).collect::<String>();
        }
        let count = slices.len();
        let labels =
            |slice: &Slice| slice.regions.iter().chain(&slice.outlines).map(|r| r.label.clone()).collect::<Vec<_>>();
        if slices.iter().any(|slice| labels(slice) != labels(&slices[0])) {
            let columns = count.min(3);
            let rows = count.div_ceil(columns) as u32;
            let usual = (PANEL_SIZE.0 * columns as u32, PANEL_SIZE.1.saturating_mul(rows) + HEAD);
            return SideBySide::Unlike { title, slices, columns, usual };
        }
        let (title, note, shape) = (title.into(), String::new(), [1, count]);
        let figure = Multiples { title, note, shape, columns: Vec::new(), rows: Vec::new(), panels: slices };
        SideBySide::Alike(figure, (PANEL_SIZE.0.saturating_mul(count as u32), PANEL_SIZE.1))
    }
}

/// Makes sure, before any work, that a picture of an atlas has room beside its labels, and that the font has its
/// letters.
///
/// # Errors
/// [`Error::Domain`] with the size that would do, or the letter.
pub fn check(plan: &AtlasPlan, picture: &PicturePlan) -> Result<()> {
    check_letters(picture.look.title.iter().chain(picture.marks.iter().map(|mark| &mark.label)))?;
    let subject = Subject { name: &plan.name, family: plan.family, grid: &plan.grid, atlas: None };
    if picture.kind == PictureKind::Multiples {
        let figure = multiples(&subject, picture)?;
        return check_size(&picture.look, MULTIPLES_SIZE, |sheet| plot::multiples_fit(&figure, sheet));
    }
    let slice = match plan.cells {
        Some(_) => cells::slice(&plan.name, plan.family, &plan.grid, picture, &[]),
        None => figures::slice(&subject, picture)?,
    };
    check_size(&picture.look, SLICE_SIZE, |sheet| plot::slice_fits(&slice, sheet))
}

/// The same for slices of several atlases side by side.
///
/// # Errors
/// As [`check`].
pub fn check_side_by_side(stem: &str, look: &Look, slices: &[(&AtlasPlan, &PicturePlan)]) -> Result<()> {
    check_letters([look.title.as_deref().unwrap_or(stem)])?;
    let slice = |(plan, picture): &(&AtlasPlan, &PicturePlan)| {
        figures::slice(&Subject { name: &plan.name, family: plan.family, grid: &plan.grid, atlas: None }, picture)
    };
    match SideBySide::new(stem, look, slices.iter().map(slice).collect::<Result<_>>()?) {
        SideBySide::Alike(figure, usual) => check_size(look, usual, |sheet| plot::multiples_fit(&figure, sheet)),
        SideBySide::Unlike { slices, columns, usual, .. } => {
            check_size(look, usual, |sheet| plot::montage_fits(&slices, columns, sheet))
        }
    }
}

/// Refuses letters that no picture can show.
fn check_letters(texts: impl IntoIterator<Item = impl AsRef<str>>) -> Result<()> {
    for text in texts {
        if let Some(letter) = plot::missing_letter(text.as_ref()) {
            let what =
                format!("the font has no letter `{letter}`, which stands in {:?}; write it in others", text.as_ref());
            return Err(Error::invalid(what));
        }
    }
    Ok(())
}

/// Refuses a size without room, with the least one of the same shape that has it, or nearly the least.
fn check_size(look: &Look, usual: (u32, u32), fits: impl Fn(Sheet) -> Result<()>) -> Result<()> {
    let Err(error) = fits(sheet(look, usual)) else { return Ok(()) };
    let (width, height) = look.size.unwrap_or(usual);
    let larger = |tenths: u32| {
        let side = |side: u32| side.saturating_mul(tenths).div_ceil(10);
        Look { size: Some((side(width), side(height))), ..look.clone() }
    };
    let enough = (11..200).map(larger).find(|look| fits(sheet(look, usual)).is_ok());
    Err(match (error, enough.and_then(|look| look.size)) {
        (Error::Domain(what), Some((width, height))) => {
            Error::invalid(format!("{what}, such as `size = [{width}, {height}]`"))
        }
        (error, _) => error,
    })
}
