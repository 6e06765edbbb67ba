//! Recipes: TOML files that say which family, grids, fields and pictures to generate.
//!
//! ```toml
//! family = "cubic"
//! fields = ["f0", "f1", "margin"]  # optional; `flags` and `solutions` are always there
//!
//! [[atlas]]
//! name = "quickstart"              # the file's stem
//! [atlas.axes]                     # their names pick the family's chart, and the chart their order
//! phi0 = { linear = ["5deg", 1.2], count = 41 }
//! phi1 = { values = [0.9, 1.4] }
//! kappa0 = { linear = [0.02, 1.0], count = 37 }
//! kappa1 = { log = [1.0, 100.0], count = 43 }
//!
//! [[atlas.picture]]
//! kind = "slice"                   # all axes but two fixed, each at the node nearest to `at`
//! x = "kappa0"
//! y = "kappa1"
//! at = { phi0 = 0.7, phi1 = 1.4 }  # an axis of one value may be left out
//! mark = [{ kappa0 = 0.4, kappa1 = 4.0, label = "example 1" }]
//! ```
//!
//! Angles may be written `"40deg"` or `"40°"` on axes of angles.
//! [`reference()`] has all keys, with their values, defaults and meanings; docs/recipes.md is what it returns.

mod cells;
mod keys;
mod levels;
mod look;
mod panels;
mod plan;
mod raw;
mod reference;
mod words;

pub use crate::plain::parse_angle;
pub use crate::plain::{parse_curvature, parse_number};
pub use look::{DPI, Look, MAX_PIXELS, MULTIPLES_SIZE, PANEL_SIZE, SLICE_SIZE};
pub use plan::{AtlasPlan, Levels, Mark, PictureKind, PicturePlan, Recipe};
pub use raw::{is_angle, parse_coordinate};
pub use reference::reference;

use crate::error::{Error, Result};
use crate::family::{self, Chart, Family};
use crate::grid::{Axis, Grid, Spacing, check_nodes};
use panels::{ends, nodes};
use raw::{Fault, Number, RawAtlas, RawAxis, RawPicture, unknown};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

impl Recipe {
    /// Reads the text of a recipe.
    ///
    /// # Errors
    /// [`Error::Recipe`] with line and column; an unknown name comes with the nearest known one.
    pub fn parse(text: &str) -> Result<Recipe> {
        let text = text.replace("\r\n", "\n");
        resolve(&text).map_err(|fault| fault.within(&text))
    }

    /// Reads a recipe from a file, or from standard input for `-`.
    ///
    /// # Errors
    /// [`Error::Io`], also for a text that is too long for the header of an atlas (1 MiB); or [`Error::Recipe`] as
    /// [`Recipe::parse`] has it, with the file's name.
    pub fn read(path: impl AsRef<Path>) -> Result<Recipe> {
        let path = path.as_ref();
        let text = crate::files::read_text(path, crate::files::LONGEST_RECIPE)?;
        Recipe::parse(&text).map_err(|e| match e {
            Error::Recipe(what) => Error::Recipe(format!("{}: {what}", path.display())),
            other => other,
        })
    }
}

fn resolve(text: &str) -> Result<Recipe, Fault> {
    let raw = words::parse(text)?;
    let at = raw.atlas.span();
    let usual = (PANEL_SIZE.0.saturating_mul(raw.atlas.get_ref().len() as u32), PANEL_SIZE.1);
    let look = look::look(raw.title.as_ref(), raw.size.as_ref(), raw.dpi.as_ref(), None, usual)?;
    let mut atlases: Vec<AtlasPlan> = Vec::new();
    for atlas in raw.atlas.into_inner() {
        let name = atlas.name.span();
        let family = family_of(atlas.family.as_ref().unwrap_or(&raw.family))?;
        let scalars = scalars(family, &raw.fields)?;
        let plan = plan(atlas, family, scalars)?;
        if atlases.iter().any(|other| other.name == plan.name) {
            return Err(Fault::new(
                name,
                format!("two atlases are named `{}`; their files need different names", plan.name),
            ));
        }
        atlases.push(plan);
    }
    if atlases.is_empty() {
        return Err(Fault::new(at, "there is no atlas; add an `[[atlas]]`"));
    }
    Ok(Recipe { atlases, look, text: text.to_owned() })
}

fn family_of(name: &Spanned<String>) -> Result<&'static dyn Family, Fault> {
    let names: Vec<&str> = family::all().iter().map(|f| f.about().name).collect();
    family::by_name(name.get_ref()).map_err(|_| Fault::new(name.span(), unknown("family", name.get_ref(), &names)))
}

fn scalars(family: &dyn Family, fields: &[Spanned<String>]) -> Result<Vec<usize>, Fault> {
    let always = ["flags", "solutions"];
    let known: Vec<&str> = always.into_iter().chain(family.about().scalars.iter().map(|s| s.name)).collect();
    let mut places = Vec::new();
    for field in fields {
        let name = field.get_ref();
        let place = known.iter().position(|k| k == name);
        let place = place.ok_or_else(|| Fault::new(field.span(), unknown("field", name, &known)))?;
        if places.contains(&place) {
            return Err(Fault::new(field.span(), format!("the field `{name}` is given twice")));
        }
        places.push(place);
    }
    Ok(places.iter().filter_map(|place| place.checked_sub(always.len())).collect())
}

fn plan(raw: RawAtlas, family: &'static dyn Family, scalars: Vec<usize>) -> Result<AtlasPlan, Fault> {
    let name = raw.name.get_ref();
    let plain = name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
    if !plain || !(1..=64).contains(&name.len()) {
        let what = format!("the atlas name {name:?} is not made of 1 to 64 small letters, digits and hyphens");
        return Err(Fault::new(raw.name.span(), what));
    }
    let chart = chart(family, &raw.axes)?;
    let cells = cells::cells(&raw)?;
    let edges = cells.map(|cells| cells.resolution + 1);
    let mut spaced = Vec::new();
    for name in chart.axes {
        let Some(axis) = raw.axes.get_ref().iter().find(|(key, _)| key.get_ref() == name).map(|(_, axis)| axis) else {
            continue;
        };
        let spacing = spacing(name, axis.get_ref(), edges).map_err(|e| Fault::new(axis.span(), e))?;
        spacing.check(name).map_err(|e| Fault::new(axis.span(), e))?;
        spaced.push((name, axis.span(), spacing));
    }
    // Before any axis is made: the values of a large one take seconds.
    check_nodes(spaced.iter().map(|(.., spacing)| spacing.count())).map_err(|e| Fault::new(raw.axes.span(), e))?;
    let made =
        |(name, at, spacing): (&&str, Range<usize>, Spacing)| Axis::new(name, spacing).map_err(|e| Fault::new(at, e));
    let axes = spaced.into_iter().map(made).collect::<Result<_, _>>()?;
    let grid = Grid::new(axes).map_err(|e| Fault::new(raw.axes.span(), e))?;
    if cells.is_some() {
        raw.picture.iter().try_for_each(cells::check_picture)?;
    }
    let scalars = if cells.is_some() { Vec::new() } else { scalars };
    let pictures = raw.picture.iter().map(|p| picture(p, &grid, family, chart, &scalars)).collect::<Result<_, _>>()?;
    Ok(AtlasPlan { name: name.clone(), family, scalars, chart, grid, cells: cells.map(|cells| cells.budget), pictures })
}

/// The chart that has just these axes.
fn chart(
    family: &'static dyn Family,
    axes: &Spanned<BTreeMap<Spanned<String>, Spanned<RawAxis>>>,
) -> Result<&'static Chart, Fault> {
    let mut known: Vec<&str> = family.about().charts.iter().flat_map(|c| c.axes).copied().collect();
    known.sort_unstable();
    known.dedup();
    let given: Vec<&Spanned<String>> = axes.get_ref().keys().collect();
    if let Some(key) = given.iter().find(|key| !known.contains(&&key.get_ref()[..])) {
        return Err(Fault::new(key.span(), unknown("axis", key.get_ref(), &known)));
    }
    let fits = |c: &&Chart| c.axes.len() == given.len() && given.iter().all(|key| c.axes.contains(&&key.get_ref()[..]));
    family.about().charts.iter().find(fits).ok_or_else(|| {
        let charts: Vec<String> =
            family.about().charts.iter().map(|c| format!("{} ({})", c.axes.join(", "), c.name)).collect();
        let given: Vec<&str> = given.iter().map(|key| &key.get_ref()[..]).collect();
        let what =
            format!("the axes are {}; `{}` takes {}", given.join(", "), family.about().name, charts.join(" or "));
        Fault::new(axes.span(), what)
    })
}

/// The spacing of an axis; `edges` is their number on an axis of cells, which has no `count`.
fn spacing(name: &str, raw: &RawAxis, edges: Option<usize>) -> Result<Spacing, String> {
    let count = match (edges, raw.count, &raw.values) {
        (None, count, _) => count,
        (Some(edges), None, None) => Some(edges),
        (Some(_), None, Some(values)) if values.len() == 1 => None,
        _ => {
            return Err(format!(
                "axis `{name}` of cells takes `{{ linear = [first, last] }}`, `{{ log = [first, last] }}` or \
                 `{{ values = [one] }}`"
            ));
        }
    };
    match (raw.linear.as_deref(), raw.log.as_deref(), &raw.values, count) {
        (Some([lo, hi]), None, None, Some(count)) => Ok(Spacing::Linear { lo: lo.on(name)?, hi: hi.on(name)?, count }),
        (None, Some([lo, hi]), None, Some(count)) => Ok(Spacing::Log { lo: lo.on(name)?, hi: hi.on(name)?, count }),
        (None, None, Some(values), None) => {
            values.iter().map(|v| v.on(name)).collect::<Result<_, _>>().map(Spacing::Values)
        }
        _ => Err(format!("axis `{name}` takes {}", keys::AXIS)),
    }
}

fn picture(
    raw: &RawPicture,
    grid: &Grid,
    family: &dyn Family,
    chart: &Chart,
    stored: &[usize],
) -> Result<PicturePlan, Fault> {
    let kind = match &raw.kind.get_ref()[..] {
        "slice" => PictureKind::Slice,
        "union" => PictureKind::Union,
        "multiples" => PictureKind::Multiples,
        "compare" => PictureKind::Compare { with: compared(raw, family, chart)? },
        other => return Err(Fault::new(raw.kind.span(), unknown("picture kind", other, &keys::KINDS))),
    };
    if let (false, Some(with)) = (matches!(kind, PictureKind::Compare { .. }), &raw.with) {
        return Err(Fault::new(with.span(), "`with` belongs to a picture of the kind `compare`"));
    }
    let (x, y) = (axis_index(grid, &raw.x)?, axis_index(grid, &raw.y)?);
    if x == y {
        return Err(Fault::new(raw.y.span(), format!("`x` and `y` are both `{}`; take two axes", raw.y.get_ref())));
    }
    for key in raw.at.keys() {
        let axis = axis_index(grid, key)?;
        if axis == x || axis == y {
            return Err(Fault::new(key.span(), format!("`{}` is drawn; `at` fixes the other axes", key.get_ref())));
        }
    }
    let others = (0..grid.axes().len()).filter(|axis| ![x, y].contains(axis));
    let at = others.map(|axis| Ok((axis, nodes(raw, kind, &grid.axes()[axis])?))).collect::<Result<Vec<_>, _>>()?;
    if let (PictureKind::Multiples, Some(mark)) = (kind, raw.mark.first()) {
        return Err(Fault::new(mark.span(), "marks belong on a slice; add a picture of that kind"));
    }
    if kind == PictureKind::Multiples {
        panels::check(raw.kind.span(), grid, &at)?;
    }
    let axes = [&grid.axes()[x], &grid.axes()[y]];
    let marks = raw.mark.iter().map(|m| mark(m, axes)).collect::<Result<_, _>>()?;
    let (regions, outlines) = (flags(&raw.regions, family)?, flags(&raw.outlines, family)?);
    if let (true, Some(outline)) = (regions.is_empty(), raw.outlines.first()) {
        return Err(Fault::new(outline.span(), "`outlines` go with `regions`; say which flags to fill"));
    }
    let levels = levels::levels(raw, kind, family, stored)?;
    let usual = if kind == PictureKind::Multiples { MULTIPLES_SIZE } else { SLICE_SIZE };
    let here = Some(raw.kind.span().start);
    let look = look::look(raw.title.as_ref(), raw.size.as_ref(), raw.dpi.as_ref(), here, usual)?;
    Ok(PicturePlan { kind, x, y, at, regions, outlines, levels, marks, look })
}

/// The family that a picture compares with: both have a `SPIRAL`, and the other a chart of the same axes.
fn compared(raw: &RawPicture, family: &dyn Family, chart: &Chart) -> Result<&'static str, Fault> {
    let with =
        raw.with.as_ref().ok_or_else(|| Fault::new(raw.kind.span(), "the picture lacks `with`, the other family"))?;
    let other = family_of(with)?;
    let spiral = |family: &dyn Family| family.about().flags.iter().any(|f| f.name == "SPIRAL");
    if !other.about().charts.iter().any(|c| c.axes == chart.axes) || !spiral(family) || !spiral(other) {
        let what = format!(
            "`{}` and `{}` cannot be compared: both need a flag `SPIRAL` and the same axes",
            family.about().name,
            other.about().name
        );
        return Err(Fault::new(with.span(), what));
    }
    Ok(other.about().name)
}

/// The places of named flags.
fn flags(names: &[Spanned<String>], family: &dyn Family) -> Result<Vec<usize>, Fault> {
    let known: Vec<&str> = family.about().flags.iter().map(|f| f.name).collect();
    let place = |name: &Spanned<String>| {
        let place = known.iter().position(|k| k == name.get_ref());
        place.ok_or_else(|| Fault::new(name.span(), unknown("flag", name.get_ref(), &known)))
    };
    names.iter().map(place).collect()
}

fn axis_index(grid: &Grid, name: &Spanned<String>) -> Result<usize, Fault> {
    let known: Vec<&str> = grid.axes().iter().map(Axis::name).collect();
    let index = known.iter().position(|k| k == name.get_ref());
    index.ok_or_else(|| Fault::new(name.span(), unknown("axis", name.get_ref(), &known)))
}

fn mark(raw: &Spanned<BTreeMap<Spanned<String>, Spanned<Number>>>, axes: [&Axis; 2]) -> Result<Mark, Fault> {
    let known = [axes[0].name(), axes[1].name(), "label"];
    let map = raw.get_ref();
    if let Some(key) = map.keys().find(|key| !known.contains(&&key.get_ref()[..])) {
        return Err(Fault::new(key.span(), unknown("key", key.get_ref(), &known)));
    }
    let get = |name: &str| {
        let found = map.iter().find(|(key, _)| key.get_ref() == name).map(|(_, value)| value);
        found.ok_or_else(|| Fault::new(raw.span(), format!("the mark lacks `{name}`")))
    };
    let coordinate = |axis: &Axis| {
        let given = get(axis.name())?;
        let value = given.get_ref().on(axis.name()).map_err(|e| Fault::new(given.span(), e))?;
        let (first, last) = ends(axis);
        if first <= value && value <= last {
            return Ok(value);
        }
        let what = format!("{} = {value} lies outside the picture, which runs from {first} to {last}", axis.name());
        Err(Fault::new(given.span(), what))
    };
    let label = get("label")?;
    match label.get_ref() {
        Number::Text(text) => Ok(Mark { x: coordinate(axes[0])?, y: coordinate(axes[1])?, label: text.clone() }),
        Number::Plain(_) => Err(Fault::new(label.span(), "the label of a mark is a text")),
    }
}

#[cfg(test)]
mod tests;
