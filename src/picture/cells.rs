//! Pictures of cells: a plane through them, where each flag is known, and where it is not.

use super::figures::{heading, middle_slice, place, sheet, view};
use crate::cells::{Cells, Known};
use crate::error::{Error, Result};
use crate::family::Family;
use crate::grid::{Axis, Grid, Spacing};
use crate::plot::{self, AxisView, Drawing, Mark, Region, Slice};
use crate::recipe::{PicturePlan, Recipe, SLICE_SIZE};

/// The plans of a file of cells: those of the recipe in its metadata, or its last two axes of several values at the
/// middle of the others.
///
/// # Errors
/// [`Error::Domain`] when it has a single axis.
pub fn plans(cells: &Cells) -> Result<Vec<PicturePlan>> {
    let about = cells.about();
    let recipe = Recipe::parse(&about.recipe).ok();
    let planned = recipe.and_then(|r| r.atlases.into_iter().find(|a| a.name == about.name && a.grid == *cells.grid()));
    match planned.map(|a| a.pictures) {
        Some(pictures) if !pictures.is_empty() => Ok(pictures),
        _ => middle_slice(cells.grid()).map(|plan| vec![plan]),
    }
}

/// Draws a slice through the finest cells. Of each region of the plan (of its family's widest flag and those of its
/// answer, where it chooses none) two are drawn: where it is MIXED, and where it is INSIDE.
///
/// # Errors
/// Those of [`plot`].
pub fn draw(cells: &Cells, plan: &PicturePlan) -> Result<Drawing> {
    let axes = cells.grid().axes();
    let [across, up] = [plan.x, plan.y].map(|axis| middles(&axes[axis]));
    let mut point: Vec<f64> = axes.iter().map(|axis| axis.values()[0]).collect();
    for (axis, nodes) in &plan.at {
        point[*axis] = axes[*axis].values()[nodes.first().copied().unwrap_or_default()];
    }
    let mut known: Vec<Known> = Vec::with_capacity(across.len() * up.len());
    for y in &up {
        for x in &across {
            (point[plan.x], point[plan.y]) = (*x, *y);
            let cell = cells.lookup(&point).ok_or_else(|| Error::invalid(format!("{point:?} is in no cell")))?;
            known.push(cell);
        }
    }
    let slice = slice(&cells.about().name, cells.family(), cells.grid(), plan, &known);
    plot::draw_slice(&slice, sheet(&plan.look, SLICE_SIZE))
}

/// The slice, of what is known of each finest cell, x fastest.
pub(super) fn slice(name: &str, family: &dyn Family, grid: &Grid, plan: &PicturePlan, known: &[Known]) -> Slice {
    let axes = grid.axes();
    let named = |name: &&str| family.about().bit(name);
    let usual =
        || family.about().nested.iter().take(1).chain(family.about().yes).filter_map(named).collect::<Vec<usize>>();
    let shown = if plan.regions.is_empty() { usual() } else { plan.regions.clone() };
    let regions = shown.iter().flat_map(|bit| {
        let label = family.about().flags[*bit].label;
        let mask = |holds: &dyn Fn(&Known) -> bool| known.iter().map(holds).collect();
        [
            Region::of_nodes(format!("{label}: MIXED"), mask(&|k| (k.inside | k.outside) >> bit & 1 == 0)),
            Region::of_nodes(format!("{label}: INSIDE"), mask(&|k| k.inside >> bit & 1 == 1)),
        ]
    });
    let places: Vec<String> =
        plan.at.iter().filter_map(|(axis, nodes)| Some(place(&axes[*axis], *nodes.first()?))).collect();
    let axis = |axis: usize| AxisView { values: middles(&axes[axis]), ..view(&axes[axis]) };
    Slice {
        title: heading(plan, &format!("{name}: {}", places.join(", "))),
        x: axis(plan.x),
        y: axis(plan.y),
        regions: regions.collect(),
        outlines: Vec::new(),
        marks: plan.marks.iter().map(|m| Mark { x: m.x, y: m.y, label: m.label.clone() }).collect(),
        note: "INSIDE is proved at every point of a cell; MIXED is not known, or true in a part of it".into(),
        counted: "cell",
    }
}

/// The middle of each finest cell of an axis, or its single value.
fn middles(axis: &Axis) -> Vec<f64> {
    if let [only] = axis.values() {
        return vec![*only];
    }
    let log = matches!(axis.spacing(), Spacing::Log { .. });
    let middle = |w: &[f64]| if log { w[0].sqrt() * w[1].sqrt() } else { 0.5 * w[0] + 0.5 * w[1] };
    axis.values().windows(2).map(middle).collect()
}
