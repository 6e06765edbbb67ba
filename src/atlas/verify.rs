//! Whether a file of nodes is what its family and its recipe say. Its values are recomputed by [`crate::eval::agree`].

use super::Atlas;
use crate::error::{Error, Result};
use crate::eval::agree::Stored;
use crate::family::Family;

/// What is wrong with a file apart from the values of its nodes: its hashes, its legend, or its recipe, in words. Empty
/// is good.
pub fn faults(atlas: &Atlas, family: &dyn Family) -> Vec<String> {
    let hashes = atlas.check_hashes().err().map(|e| e.to_string());
    let faults = [hashes, legend_fault(atlas, family)].into_iter().flatten();
    #[cfg(feature = "recipe")]
    let faults = faults.chain(recipe_fault(atlas));
    faults.collect()
}

/// The fields of an atlas, in file order: what [`crate::eval::agree`] compares.
///
/// # Errors
/// [`Error::Atlas`] for a scalar that cannot be read.
pub fn stored(atlas: &Atlas) -> Result<Stored<'_>> {
    let scalar =
        |name: &str| atlas.scalar(name).ok_or_else(|| fault(atlas, format!("its scalar `{name}` cannot be read")));
    let scalars = atlas.scalar_names().map(scalar).collect::<Result<_>>()?;
    Ok(Stored { flags: atlas.flags(), solutions: atlas.solutions(), scalars })
}

/// The scalars of an atlas, as indices into the family's.
///
/// # Errors
/// [`Error::Atlas`] for a scalar that the family does not have.
pub fn scalars(atlas: &Atlas, family: &dyn Family) -> Result<Vec<usize>> {
    let place = |name: &str| {
        let place = family.about().scalars.iter().position(|s| s.name == name);
        place
            .ok_or_else(|| fault(atlas, format!("its scalar `{name}` is none of the family `{}`", family.about().name)))
    };
    atlas.scalar_names().map(place).collect()
}

/// Whether the file gives its bytes another meaning than the family does.
fn legend_fault(atlas: &Atlas, family: &dyn Family) -> Option<String> {
    let about = atlas.about();
    let axes: Vec<&str> = atlas.grid().axes().iter().map(|a| a.name()).collect();
    let chart =
        family.about().charts.iter().any(|c| c.name == about.chart && c.doc == about.chart_doc && c.axes == axes);
    let flags =
        about.flags.iter().map(|f| (&f.name[..], &f.doc[..])).eq(family.about().flags.iter().map(|f| (f.name, f.doc)));
    let counts = about.counts.iter().map(|c| (&c.name[..], &c.doc[..], c.shift, c.bits));
    let counts = counts.eq(family.about().counts.iter().map(|c| (c.name, c.doc, c.shift, c.bits)));
    let known = |s: &super::Named| family.about().scalars.iter().any(|k| k.name == s.name && k.doc == s.doc);
    let scalars = about.scalars.iter().all(known);
    let conventions = about.conventions == family.about().conventions;
    let parts =
        [("axes", chart), ("flags", flags), ("counts", counts), ("scalars", scalars), ("conventions", conventions)];
    let wrong: Vec<&str> = parts.iter().filter(|(_, good)| !good).map(|(name, _)| *name).collect();
    (!wrong.is_empty()).then(|| format!("its legend ({}) is not that of `{}`", wrong.join(", "), family.about().name))
}

/// Whether the recipe in the file would give another grid. A text that is no recipe (of an atlas made by a program)
/// says nothing.
#[cfg(feature = "recipe")]
fn recipe_fault(atlas: &Atlas) -> Option<String> {
    let recipe = crate::recipe::Recipe::parse(atlas.recipe_text()).ok()?;
    let about = atlas.about();
    let Some(plan) = recipe.atlases.iter().find(|plan| plan.name == about.name) else {
        return Some(format!("its recipe has no atlas `{}`", about.name));
    };
    let names = plan.scalars.iter().filter_map(|i| plan.family.about().scalars.get(*i)).map(|s| s.name);
    let same = plan.family.about().name == about.family && plan.grid == *atlas.grid() && names.eq(atlas.scalar_names());
    (!same).then(|| "its recipe gives another family, grid or other scalars than the file has".into())
}

fn fault(atlas: &Atlas, what: String) -> Error {
    Error::Atlas { path: atlas.path().to_owned(), what }
}
