//! Whether a file of cells is what its family and its recipe say.

use super::{Attack, Cells, Spec, attack, build, differences};
use crate::error::Result;
use crate::recipe::Recipe;
use std::sync::atomic::AtomicBool;

/// Rounds of the attack, of some 200 points each.
const ROUNDS: u64 = 5_000;

/// What [`verify`] found.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Verified {
    /// What is wrong apart from the cells: the file's hashes, its recipe or its legend, in words. Empty is good.
    pub faults: Vec<String>,
    /// Words of the file that differ from those made anew.
    pub differences: u64,
    /// The first of them, in words.
    pub first_difference: Option<String>,
    /// What the family itself says of points.
    pub attack: Attack,
}

impl Verified {
    /// Whether nothing is wrong, and points were compared at all.
    pub fn holds(&self) -> bool {
        self.faults.is_empty() && self.differences == 0 && self.attack.wrong == 0 && self.attack.verdicts > 0
    }
}

/// Makes the cells of a file anew and compares every word; asks the family itself about points.
///
/// The other arguments are those of [`build`].
///
/// # Errors
/// Those of [`build`] and [`attack`].
pub fn verify(cells: &Cells, threads: usize, stop: &AtomicBool, progress: &(dyn Fn(u64) + Sync)) -> Result<Verified> {
    let (about, family) = (cells.about(), cells.family());
    let hashes = cells.check_hashes().err().map(|e| e.to_string());
    let (recipe, budget) = recipe_fault(cells);
    let faults = [hashes, recipe, legend_fault(cells)].into_iter().flatten().collect();
    let attack = attack(cells, ROUNDS, 1, stop)?;
    let spec = Spec { name: &about.name, family, grid: cells.grid(), budget, recipe: &about.recipe };
    let (differences, first_difference) = differences(cells, &build(&spec, threads, stop, progress)?);
    Ok(Verified { faults, differences, first_difference, attack })
}

/// Whether the recipe in the file would give other cells, and the budget that it states. A text that is no recipe (of a
/// file made by a program) says nothing; its cells then have no budget but what they took.
fn recipe_fault(cells: &Cells) -> (Option<String>, u64) {
    let about = cells.about();
    let Ok(recipe) = Recipe::parse(&about.recipe) else { return (None, u64::MAX) };
    let Some(plan) = recipe.atlases.iter().find(|plan| plan.name == about.name) else {
        return (Some(format!("its recipe has no atlas `{}`", about.name)), u64::MAX);
    };
    let same = plan.family.about().name == about.family && plan.grid == *cells.grid() && plan.cells.is_some();
    let fault = (!same).then(|| "its recipe gives another family or other cells than the file has".into());
    (fault, plan.cells.unwrap_or(u64::MAX))
}

/// Whether the file gives its bits another meaning than the family does.
fn legend_fault(cells: &Cells) -> Option<String> {
    let (about, family) = (cells.about(), cells.family().about());
    let flags = about.flags.iter().map(|f| (&f.name[..], &f.doc[..])).eq(family.flags.iter().map(|f| (f.name, f.doc)));
    let same = flags && about.conventions == family.conventions;
    (!same).then(|| format!("its legend is not that of `{}`", family.name))
}
