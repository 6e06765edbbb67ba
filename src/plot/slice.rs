//! One slice: coloured cells, outlines, marks.

use super::axes::{draw_below, draw_left, label_below, label_left, named_below, named_left, width_left};
use super::drawing::{Drawing, Sheet};
use super::geometry::Rect;
use super::hatch::{Hatch, Outline};
use super::legend::{Entry, Heading, Key, Legend, star};
use super::palette::{INK, region_colors};
use super::regions::{Area, Regions};
use super::scale::{Cells, Scale};
use super::shapes::Pen;
use super::style::Style;
use super::{Region, Slice, grouped};
use crate::error::{Error, Result};

/// Least side of a plot in pixels.
pub(super) const LEAST_SIDE: i32 = 24;

/// Draws a slice on a sheet: each node fills the cell of what is nearer to it than to its
/// neighbours, in the axis's own spacing. A pixel shows the node of its centre.
///
/// # Errors
/// [`Error::Domain`] when an axis is empty, not increasing or not finite, a mask has not one entry for each node, a
/// mark is not finite, or the size is 0, too large, or too small for a plot beside its labels.
pub fn draw_slice(slice: &Slice, sheet: impl Into<Sheet>) -> Result<Drawing> {
    let sheet = sheet.into();
    let mut canvas = Drawing::new(sheet)?;
    let panel = Panel::new(slice)?;
    let style = style(sheet.size);
    let entries = entries(&[slice], false);
    let Layout { sheet, heading, legend, rect, left } = Layout::new(&canvas, slice, &panel, &entries, style)?;
    heading.draw(&mut canvas, style, sheet);
    panel.draw(&mut canvas, style, rect, true);
    draw_below(&mut canvas, &panel.x.scale, style, rect, true);
    draw_left(&mut canvas, &panel.y.scale, style, rect, true);
    let below = named_below(&canvas, &slice.x, &panel.x.scale, style, rect.width());
    label_below(&mut canvas, style, rect, style.below(), &below);
    label_left(&mut canvas, style, rect, left, &named_left(&slice.y, &panel.y.scale, style, rect.height()));
    legend.draw(&mut canvas, style, (sheet.left, sheet.bottom - legend.height(style)));
    Ok(canvas)
}

/// Draws slices of unlike regions in rows of `columns`, each with its own legend, under one title.
///
/// # Errors
/// As [`draw_slice`], and [`Error::Domain`] for no columns.
pub fn draw_montage(title: &str, slices: &[Slice], columns: usize, sheet: impl Into<Sheet>) -> Result<Drawing> {
    if columns == 0 || slices.is_empty() {
        let (slices, columns) = (slices.len(), columns);
        return Err(Error::invalid(format!(
            "a montage of {slices} slices in {columns} columns; it needs at least 1 of each"
        )));
    }
    let sheet = sheet.into();
    let mut canvas = Drawing::new(sheet)?;
    let (columns, em, head, size) = montage(slices.len(), columns, sheet);
    let title = canvas.fit(em, title, f64::from(sheet.size.0) - 1.6 * em);
    canvas.text([em * 0.8, f64::from(head) * 0.6], Pen::new(em, 0.0), &title);
    for (slice, i) in slices.iter().zip(0..) {
        canvas.inset(draw_slice(slice, Sheet { size, ..sheet })?, (i % columns * size.0, head + i / columns * size.1));
    }
    Ok(canvas)
}

/// Columns, size of the title's letters, height of the head and size of each slice.
fn montage(slices: usize, columns: usize, sheet: Sheet) -> (u32, f64, u32, (u32, u32)) {
    let (columns, rows) = (columns as u32, slices.div_ceil(columns) as u32);
    let (width, height) = (sheet.size.0 / columns, sheet.size.1 / rows);
    let em = style((width, height)).em * 1.5;
    let head = (em * 2.4) as u32;
    (columns, em, head, (width, sheet.size.1.saturating_sub(head) / rows))
}

/// Whether there is room for a slice, whatever its nodes turn out to be: its masks are not looked at.
///
/// # Errors
/// As [`draw_slice`], where none of that size can be drawn.
pub fn slice_fits(slice: &Slice, sheet: impl Into<Sheet>) -> Result<()> {
    let sheet = sheet.into();
    let (canvas, entries) = (Drawing::new(sheet)?, entries(&[slice], false));
    Layout::new(&canvas, slice, &Panel::of_axes(slice)?, &entries, style(sheet.size)).map(drop)
}

/// The same for [`draw_montage`].
///
/// # Errors
/// As [`draw_montage`], where none of that size can be drawn.
pub fn montage_fits(slices: &[Slice], columns: usize, sheet: impl Into<Sheet>) -> Result<()> {
    let sheet = sheet.into();
    let (.., size) = montage(slices.len(), columns.max(1), sheet);
    slices.iter().try_for_each(|slice| slice_fits(slice, Sheet { size, ..sheet }))
}

fn style(size: (u32, u32)) -> Style {
    let em = (f64::from(size.0) * f64::from(size.1)).sqrt() / 58.0;
    Style { em: em.max(10.0), slack: em }
}

/// Where everything goes.
struct Layout<'a> {
    /// What margins leave of the sheet.
    sheet: Rect,
    heading: Heading<'a>,
    legend: Legend<'a>,
    /// The plot.
    rect: Rect,
    /// Width of the numbers to its left.
    left: i32,
}

impl<'a> Layout<'a> {
    fn new(
        canvas: &Drawing,
        slice: &'a Slice,
        panel: &Panel,
        entries: &'a [Entry],
        style: Style,
    ) -> Result<Layout<'a>> {
        let sheet = canvas.rect().grown(-style.px(1.2));
        let heading = Heading::new(canvas, &slice.title, &slice.note, style, sheet.width());
        let legend = Legend::new(canvas, entries, style, sheet.width());
        let label = style.px(1.6);
        let mut rect = Rect {
            top: sheet.top + heading.height(style) + style.px(0.3),
            bottom: sheet.bottom - legend.height(style) - style.px(0.6) - label - style.below(),
            ..sheet
        };
        let left = width_left(canvas, &panel.y.scale, style, rect.height());
        rect.left += left + label;
        check_room(canvas, rect)?;
        Ok(Layout { sheet, heading, legend, rect, left })
    }
}

/// Says so when labels leave no room for a plot.
pub(super) fn check_room(canvas: &Drawing, rect: Rect) -> Result<()> {
    let sheet = canvas.rect();
    if rect.width() >= LEAST_SIDE && rect.height() >= LEAST_SIDE {
        return Ok(());
    }
    let (w, h) = (rect.width().max(0), rect.height().max(0));
    Err(Error::invalid(format!(
        "a picture of {} x {} pixels leaves {w} x {h} for a plot beside its labels; it needs {LEAST_SIDE} x \
         {LEAST_SIDE}: ask for a larger picture",
        sheet.width(),
        sheet.height()
    )))
}

/// A checked slice, ready to be drawn into any rectangle.
pub(super) struct Panel<'a> {
    slice: &'a Slice,
    pub x: Cells,
    pub y: Cells,
}

impl Panel<'_> {
    /// One whose axes alone are checked, to lay it out.
    pub(super) fn of_axes(slice: &Slice) -> Result<Panel<'_>> {
        Ok(Panel { slice, x: Cells::new(&slice.x)?, y: Cells::new(&slice.y)? })
    }

    pub(super) fn new(slice: &Slice) -> Result<Panel<'_>> {
        let panel = Panel::of_axes(slice)?;
        let (columns, rows) = (slice.x.values.len(), slice.y.values.len());
        for region in slice.regions.iter().chain(&slice.outlines) {
            // As u128, because a product of lengths of two slices fits.
            if region.mask.len() as u128 != columns as u128 * rows as u128 {
                return Err(Error::invalid(format!(
                    "region `{}` has {} nodes; the axes `{}` and `{}` have {columns} x {rows}",
                    region.label,
                    region.mask.len(),
                    slice.x.name,
                    slice.y.name
                )));
            }
        }
        for region in slice.regions.iter().chain(&slice.outlines) {
            let drawn =
                |p: &[f64; 2]| panel.x.scale.fraction(p[0]).is_finite() && panel.y.scale.fraction(p[1]).is_finite();
            if let Some([x, y]) = region.rings.iter().flatten().find(|p| !drawn(p)) {
                let label = &region.label;
                return Err(Error::invalid(format!(
                    "a line around region `{label}` leads to ({x}, {y}), no place on the axes"
                )));
            }
        }
        if let Some(mark) = slice.marks.iter().find(|m| !(m.x.is_finite() && m.y.is_finite())) {
            let (label, x, y) = (&mark.label, mark.x, mark.y);
            return Err(Error::invalid(format!("mark `{label}` is at ({x}, {y}); both must be finite")));
        }
        Ok(panel)
    }

    /// Draws all but axes; labels of marks only where asked.
    pub(super) fn draw(&self, canvas: &mut Drawing, style: Style, rect: Rect, mark_labels: bool) {
        let fraction = |scale: &Scale, value: f64| scale.fraction(value).clamp(0.0, 1.0);
        let point = |p: &[f64; 2]| [fraction(&self.x.scale, p[0]), fraction(&self.y.scale, p[1])];
        let area = |region: &Region| Area {
            mask: region.mask.clone(),
            rings: region.rings.iter().map(|ring| ring.iter().map(point).collect()).collect(),
        };
        canvas.regions(Regions {
            rect,
            x: self.x.clone(),
            y: self.y.clone(),
            fills: self.slice.regions.iter().map(area).collect(),
            outlines: self.slice.outlines.iter().map(area).collect(),
            edge: style.px(0.07).max(1),
            hatch: Hatch::new(style),
        });
        canvas.frame(rect, INK);
        self.draw_marks(canvas, style, rect, mark_labels);
    }

    fn draw_marks(&self, canvas: &mut Drawing, style: Style, rect: Rect, labels: bool) {
        for mark in &self.slice.marks {
            let (x, y) = (self.x.scale.fraction(mark.x), self.y.scale.fraction(mark.y));
            if !((0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y)) {
                continue;
            }
            let at = rect.at(x, y);
            let radius = style.em * 0.62;
            star(canvas, at, radius);
            if labels && !mark.label.is_empty() {
                // To the right of the star, or to the left where there is more room.
                let (side, anchor) = if x < 0.6 { (1.0, 0.0) } else { (-1.0, 1.0) };
                let room = f64::from(rect.width()) * if x < 0.6 { 1.0 - x } else { x };
                let label = canvas.fit(style.em, &mark.label, room - 3.0 * radius);
                let level = at[1].clamp(f64::from(rect.top) + style.em, f64::from(rect.bottom) - style.em);
                let start = [at[0] + side * radius * 2.2, level];
                // A white rim, legible on every colour.
                canvas.text(start, Pen { rim: style.em * 0.2, ..Pen::new(style.em, anchor) }, &label);
            }
        }
    }
}

/// The legend of slices that have the same regions: nodes are counted over all of them.
pub(super) fn entries(slices: &[&Slice], stars: bool) -> Vec<Entry> {
    let Some(first) = slices.first() else { return Vec::new() };
    let nodes: usize = slices.iter().map(|s| s.x.values.len() * s.y.values.len()).sum();
    let text = |label: &str, pick: &dyn Fn(&Slice) -> usize| {
        let count: usize = slices.iter().map(|s| pick(s)).sum();
        let share = 100.0 * count as f64 / nodes as f64;
        let share = if count > 0 && share < 0.05 { "< 0.1".into() } else { format!("{share:.1}") };
        let s = if count == 1 { "" } else { "s" };
        format!("{label}: {} {}{s} ({share} %)", grouped(count as u64), first.counted)
    };
    let count = |region: &Region| region.mask.iter().filter(|inside| **inside).count();
    let colors = region_colors(first.regions.len());
    let mut entries: Vec<Entry> = Vec::new();
    for (i, (region, color)) in first.regions.iter().zip(colors).enumerate() {
        let text = text(&region.label, &|s| s.regions.get(i).map_or(0, count));
        entries.push(Entry { key: Key::Fill(color), text });
    }
    for (i, region) in first.outlines.iter().enumerate() {
        let text = text(&region.label, &|s| s.outlines.get(i).map_or(0, count));
        entries.push(Entry { key: Key::Hatched(Outline::of(i)), text });
    }
    for mark in slices.iter().flat_map(|s| &s.marks).filter(|m| stars && !m.label.is_empty()) {
        let entry = Entry { key: Key::Star, text: mark.label.clone() };
        if !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}
