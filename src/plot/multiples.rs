//! Small multiples: many slices side by side under one legend.

use super::Slice;
use super::axes::{draw_below, draw_left, label_below, label_left, named_below, named_left, width_left};
use super::drawing::{Drawing, Sheet};
use super::geometry::Rect;
use super::legend::{Heading, Legend};
use super::shapes::Pen;
use super::slice::{Panel, check_room, entries};
use super::style::Style;
use crate::error::{Error, Result};

/// Height of a line of a caption, in em.
const LINE: f64 = 1.25;
/// Least size of the letters of a caption, in pixels.
const LEAST_EM: f64 = 8.0;

/// A line of captions along panels: an outer axis, and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    /// What stands once, before the values, such as `φ₀ =`.
    pub name: String,
    /// The values in order, each with the number of panels that it is about.
    pub values: Vec<(String, usize)>,
}

/// Slices in rows and columns, usually over two outer axes of a grid.
///
/// When all panels have the same axes, numbers stand on the left and bottom panels alone, and the axis labels once;
/// otherwise each panel has its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Multiples {
    /// Heading.
    pub title: String,
    /// Small print below the heading; may be empty.
    pub note: String,
    /// Numbers of rows and of columns.
    pub shape: [usize; 2],
    /// What stands above the columns; the last line is nearest to them.
    pub columns: Vec<Caption>,
    /// What stands beside the rows, topmost first; the first line is nearest to them.
    pub rows: Vec<Caption>,
    /// The panels row by row, all with the same labels of regions and outlines. Their titles and notes stand above
    /// them.
    pub panels: Vec<Slice>,
}

/// Draws small multiples on a sheet; the legend counts the nodes of all panels.
///
/// # Errors
/// [`Error::Domain`] when the number of panels is not rows times columns, when two panels have different regions, and
/// whenever [`super::draw_slice`] would fail for a panel.
pub fn draw_multiples(figure: &Multiples, sheet: impl Into<Sheet>) -> Result<Drawing> {
    let sheet = sheet.into();
    let mut canvas = Drawing::new(sheet)?;
    check(figure)?;
    let panels = figure.panels.iter().map(Panel::new).collect::<Result<Vec<_>>>()?;
    let layout = Layout::new(&canvas, figure, &panels, sheet.size)?;
    let style = layout.style;
    layout.heading.draw(&mut canvas, style, layout.sheet);
    for (i, (panel, slice)) in panels.iter().zip(&figure.panels).enumerate() {
        let (row, column) = (i / figure.shape[1], i % figure.shape[1]);
        let rect = layout.panel(row, column);
        let own = !layout.shared;
        panel.draw(&mut canvas, layout.signs, rect, false);
        draw_below(&mut canvas, &panel.x.scale, style, rect, own || row + 1 == figure.shape[0]);
        draw_left(&mut canvas, &panel.y.scale, style, rect, own || column == 0);
        if own {
            let [below, left] = layout.names(&canvas, slice, panel);
            label_below(&mut canvas, style, rect, style.below(), &below);
            label_left(&mut canvas, style, rect, layout.numbers, &left);
        }
        let caption = Rect { top: rect.top - layout.above - style.px(0.2), ..rect };
        Heading::new(&canvas, &slice.title, &slice.note, layout.small, rect.width()).draw(
            &mut canvas,
            layout.small,
            caption,
        );
    }
    layout.draw_captions(&mut canvas, figure);
    if layout.shared {
        let [below, left] = layout.names(&canvas, &figure.panels[0], &panels[0]);
        label_below(&mut canvas, style, layout.grid, style.below(), &below);
        label_left(&mut canvas, style, layout.grid, layout.numbers, &left);
    }
    let all: Vec<&Slice> = figure.panels.iter().collect();
    let entries = entries(&all, true);
    let legend = Legend::new(&canvas, &entries, style, layout.sheet.width());
    legend.draw(&mut canvas, style, (layout.sheet.left, layout.sheet.bottom - legend.height(style)));
    Ok(canvas)
}

fn check(figure: &Multiples) -> Result<()> {
    let ([rows, columns], count) = (figure.shape, figure.panels.len());
    if count == 0 || rows.checked_mul(columns) != Some(count) {
        return Err(Error::invalid(format!(
            "{count} panels for {rows} rows and {columns} columns of small multiples; it must be rows times columns, \
             at least 1"
        )));
    }
    for (captions, count, what) in [(&figure.rows, rows, "rows"), (&figure.columns, columns, "columns")] {
        let of = |caption: &Caption| caption.values.iter().map(|(_, count)| count).sum::<usize>();
        if let Some(caption) = captions.iter().find(|caption| of(caption) != count) {
            let (name, of) = (&caption.name, of(caption));
            return Err(Error::invalid(format!(
                "the caption `{name}` is about {of} of {count} {what} of small multiples"
            )));
        }
    }
    let labels = |slice: &Slice| -> Vec<String> {
        slice.regions.iter().chain(&slice.outlines).map(|region| region.label.clone()).collect()
    };
    let first = labels(&figure.panels[0]);
    match figure.panels.iter().position(|panel| labels(panel) != first) {
        Some(i) => Err(Error::invalid(format!(
            "panel {i} has the regions {:?}, panel 0 has {first:?}; one legend needs the same for all",
            labels(&figure.panels[i])
        ))),
        None => Ok(()),
    }
}

/// Where everything goes.
struct Layout<'a> {
    style: Style,
    /// Style of the headings of panels.
    small: Style,
    /// Style of the lines and stars in panels: finer in small ones.
    signs: Style,
    heading: Heading<'a>,
    sheet: Rect,
    /// From the outermost corner of the first panel to that of the last.
    grid: Rect,
    /// Whether all panels have the same axes.
    shared: bool,
    /// Size of one panel.
    panel: (i32, i32),
    /// From the corner of one panel to that of the next.
    step: (i32, i32),
    /// Height of the headings of panels.
    above: i32,
    /// Width of the numbers to the left of a panel.
    numbers: i32,
}

impl<'a> Layout<'a> {
    fn new(canvas: &Drawing, figure: &'a Multiples, panels: &[Panel], size: (u32, u32)) -> Result<Layout<'a>> {
        let first = &figure.panels[0];
        let shared = figure.panels.iter().all(|p| p.x == first.x && p.y == first.y);
        let [rows, columns] = figure.shape.map(|count| count as i32);
        let em = ((f64::from(size.0) * f64::from(size.1)).sqrt() / 72.0).max(10.0);
        let style = Style { em, slack: em * 0.4 };
        let small = Style { em: em * 0.85, ..style };
        let sheet = canvas.rect().grown(-style.px(1.2));
        let heading = Heading::new(canvas, &figure.title, &figure.note, style, sheet.width());
        let entries = entries(&figure.panels.iter().collect::<Vec<_>>(), true);
        let legend = Legend::new(canvas, &entries, style, sheet.width()).height(style);

        let label = style.px(1.6);
        let gap = style.px(if shared { 0.8 } else { 1.4 });
        let captions = |of: &[Caption]| style.px(LINE * of.len() as f64 + 0.35);
        let about = sheet.width() / columns - style.px(if shared { 1.0 } else { 6.0 });
        let heights = figure.panels.iter().map(|p| Heading::new(canvas, &p.title, &p.note, small, about).height(small));
        let above = heights.max().unwrap_or(0);
        let below = style.below() + label;

        let top = sheet.top + heading.height(style) + captions(&figure.columns).max(style.px(0.7));
        let bottom = sheet.bottom - legend - style.px(0.6) - below;
        let between_rows = above + gap + if shared { 0 } else { below };
        let height = (bottom - top - above - (rows - 1) * between_rows) / rows;
        let widths = panels.iter().map(|p| width_left(canvas, &p.y.scale, style, height));
        let numbers = widths.max().unwrap_or(0);
        let beside = numbers + label;
        let right = sheet.right - if !figure.rows.is_empty() { captions(&figure.rows) } else { 0 };
        let left = sheet.left + beside;
        let between_columns = gap + if shared { 0 } else { beside };
        let width = (right - left - (columns - 1) * between_columns) / columns;

        let step = (width + between_columns, height + between_rows);
        let top = top + above;
        let grid = Rect {
            left,
            top,
            right: left + columns * step.0 - between_columns,
            bottom: top + rows * step.1 - between_rows,
        };
        check_room(canvas, Rect { left, top, right: left + width, bottom: top + height })?;
        let signs = Style { em: em.min(f64::from(width.min(height)) / 13.0), ..style };
        Ok(Layout { style, small, signs, heading, sheet, grid, shared, panel: (width, height), step, above, numbers })
    }

    fn panel(&self, row: usize, column: usize) -> Rect {
        let (left, top) = (self.grid.left + column as i32 * self.step.0, self.grid.top + row as i32 * self.step.1);
        Rect { left, top, right: left + self.panel.0, bottom: top + self.panel.1 }
    }

    /// What the axes of a panel are called, below and on its left.
    fn names(&self, canvas: &Drawing, slice: &Slice, panel: &Panel) -> [String; 2] {
        let (width, height) = self.panel;
        [
            named_below(canvas, &slice.x, &panel.x.scale, self.style, width),
            named_left(&slice.y, &panel.y.scale, self.style, height),
        ]
    }

    /// Captions of rows and columns.
    fn draw_captions(&self, canvas: &mut Drawing, figure: &Multiples) {
        let style = self.style;
        let em = self.caption_em(canvas, &figure.columns, self.step.0);
        for (caption, i) in figure.columns.iter().rev().zip(0..) {
            let y = f64::from(self.grid.top - self.above) - style.em * (0.85 + LINE * f64::from(i));
            let name = canvas.fit(style.em, &caption.name, f64::from(self.grid.left));
            canvas.text([f64::from(self.grid.left) - style.em * 0.4, y], Pen::new(style.em, 1.0), &name);
            for (value, first, count) in spans(caption) {
                let [from, to] = [first, first + count - 1].map(|column| self.panel(0, column));
                let value = canvas.fit(em, value, f64::from(to.right - from.left));
                canvas.text([0.5 * f64::from(from.left + to.right), y], Pen::new(em, 0.5), &value);
            }
        }
        let em = self.caption_em(canvas, &figure.rows, self.step.1);
        for (caption, i) in figure.rows.iter().zip(0..) {
            let x = f64::from(self.grid.right) + style.em * (1.0 + LINE * f64::from(i));
            // It reads upwards, as the values do, and ends where they begin.
            let name = canvas.fit(style.em, &caption.name, style.em * 4.0);
            let end = f64::from(self.grid.bottom) + style.em * 0.4 + canvas.text_width(style.em, &name);
            canvas.text([x, end], Pen { up: true, ..Pen::new(style.em, 0.0) }, &name);
            for (value, first, count) in spans(caption) {
                let [from, to] = [first, first + count - 1].map(|row| self.panel(row, 0));
                let value = canvas.fit(em, value, f64::from(to.bottom - from.top));
                canvas.text([x, 0.5 * f64::from(from.top + to.bottom)], Pen { up: true, ..Pen::new(em, 0.5) }, &value);
            }
        }
    }

    /// Size of the letters of values, so small that each fits over its panels, whose steps are so long; but not too
    /// small to read.
    fn caption_em(&self, canvas: &Drawing, captions: &[Caption], step: i32) -> f64 {
        let em = self.style.em;
        let fits = |(value, _, count): (&str, usize, usize)| {
            em * (f64::from(step) * count as f64 - em * 0.5) / canvas.text_width(em, value)
        };
        captions.iter().flat_map(spans).map(fits).fold(em, f64::min).max(LEAST_EM.min(em))
    }
}

/// The values of a caption, with the first panel of each and their number.
fn spans(caption: &Caption) -> impl Iterator<Item = (&str, usize, usize)> {
    caption.values.iter().scan(0, |next, (value, count)| {
        let first = *next;
        *next += count;
        Some((&value[..], first, *count))
    })
}

/// Whether there is room for small multiples, whatever their nodes turn out to be: masks are not looked at.
///
/// # Errors
/// As [`draw_multiples`], where none of that size can be drawn.
pub fn multiples_fit(figure: &Multiples, sheet: impl Into<Sheet>) -> Result<()> {
    let sheet = sheet.into();
    check(figure)?;
    let panels = figure.panels.iter().map(Panel::of_axes).collect::<Result<Vec<_>>>()?;
    Layout::new(&Drawing::new(sheet)?, figure, &panels, sheet.size).map(drop)
}

#[cfg(test)]
mod tests {
    use super::super::{AxisView, Region};
    use super::*;

    /// As many panels as a recipe may ask for, and values as long as axes give them.
    #[test]
    fn every_caption_is_told_whole() {
        let axis = || AxisView { name: "k".into(), label: "k".into(), values: vec![0.0125, 0.0375], log: false };
        let panel = Slice {
            title: String::new(),
            x: axis(),
            y: axis(),
            regions: vec![Region::of_nodes("some region of nodes", vec![true; 4])],
            outlines: vec![],
            marks: vec![],
            note: String::new(),
            counted: "node",
        };
        let line = |values: usize, panels: usize| Caption {
            name: "φ₀ =".into(),
            values: (0..values).map(|i| (format!("−0.{}", 3332 + i), panels)).collect(),
        };
        for (rows, columns) in [(12, vec![line(12, 1)]), (3, vec![line(4, 4), line(16, 1)]), (1, vec![line(24, 1)])] {
            let shape = [rows, columns.last().unwrap().values.len()];
            let figure = Multiples {
                title: "t".into(),
                note: "n".into(),
                shape,
                columns,
                rows: vec![line(rows, 1)],
                panels: vec![panel.clone(); shape[0] * shape[1]],
            };
            let size = (1500, 1350);
            let panels: Vec<Panel> = figure.panels.iter().map(|p| Panel::new(p).unwrap()).collect();
            let canvas = Drawing::new(size).unwrap();
            let layout = Layout::new(&canvas, &figure, &panels, size).unwrap();
            for (captions, step) in [(&figure.columns, layout.step.0), (&figure.rows, layout.step.1)] {
                let em = layout.caption_em(&canvas, captions, step);
                for (value, _, count) in captions.iter().flat_map(spans) {
                    assert!(canvas.text_width(em, value) < f64::from(step) * count as f64, "{shape:?}: {value}");
                }
            }
            // Where no number has room beside a panel, the ends of the axis stand in its name.
            for (name, side) in layout.names(&canvas, &figure.panels[0], &panels[0]).iter().zip([1, 0]) {
                assert_eq!(name, if shape[side] >= 12 { "k: 0.0125 to 0.0375" } else { "k" }, "{shape:?}");
            }
        }
    }
}
