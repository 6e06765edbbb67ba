//! Small multiples: many slices side by side under one legend.

use super::Slice;
use super::axes::{Style, draw_below, draw_left, label_below, label_left, width_left};
use super::canvas::{Canvas, Pen, Rect, Sheet};
use super::legend::{Heading, Legend};
use super::slice::{Panel, check_room, entries};
use crate::error::{Error, Result};

/// Height of a line of a caption, in em.
const LINE: f64 = 1.25;

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
    /// What stands above each column; may be empty texts, or of several lines.
    pub columns: Vec<String>,
    /// What stands beside each row, topmost first; may be empty texts, or of several lines.
    pub rows: Vec<String>,
    /// The panels row by row, all with the same labels of regions and outlines. Their titles and notes stand above them.
    pub panels: Vec<Slice>,
}

/// Draws small multiples on a sheet; the legend counts the nodes of all panels.
///
/// # Errors
/// [`Error::Domain`] when the number of panels is not rows times columns, when two panels have different regions, and
/// whenever [`super::slice_png`] would fail for a panel.
pub fn multiples_png(figure: &Multiples, sheet: impl Into<Sheet>) -> Result<Vec<u8>> {
    let sheet = sheet.into();
    let mut canvas = Canvas::new(sheet)?;
    check(figure)?;
    let panels = figure.panels.iter().map(Panel::new).collect::<Result<Vec<_>>>()?;
    let layout = Layout::new(&canvas, figure, &panels, sheet.size)?;
    let style = layout.style;
    layout.heading.draw(&mut canvas, style, layout.sheet);
    for (i, (panel, slice)) in panels.iter().zip(&figure.panels).enumerate() {
        let (row, column) = (i / figure.columns.len(), i % figure.columns.len());
        let rect = layout.panel(row, column);
        let own = !layout.shared;
        panel.draw(&mut canvas, layout.signs, rect, false);
        draw_below(&mut canvas, &panel.x.scale, style, rect, own || row + 1 == figure.rows.len());
        draw_left(&mut canvas, &panel.y.scale, style, rect, own || column == 0);
        if own {
            label_below(&mut canvas, style, rect, style.below(), &slice.x.label);
            label_left(&mut canvas, style, rect, layout.numbers, &slice.y.label);
        }
        let caption = Rect { top: rect.top - layout.above - style.px(0.2), ..rect };
        Heading::new(&canvas, &slice.title, &slice.note, layout.small, rect.width()).draw(&mut canvas, layout.small, caption);
    }
    layout.draw_captions(&mut canvas, figure);
    let all: Vec<&Slice> = figure.panels.iter().collect();
    let entries = entries(&all, true);
    let legend = Legend::new(&canvas, &entries, style, layout.sheet.width());
    legend.draw(&mut canvas, style, (layout.sheet.left, layout.sheet.bottom - legend.height(style)));
    canvas.into_png()
}

fn check(figure: &Multiples) -> Result<()> {
    let (rows, columns, count) = (figure.rows.len(), figure.columns.len(), figure.panels.len());
    if count == 0 || rows.checked_mul(columns) != Some(count) {
        return Err(Error::Domain(format!(
            "{count} panels for {rows} rows and {columns} columns of small multiples; it must be rows times columns, at least 1"
        )));
    }
    let labels = |slice: &Slice| -> Vec<String> {
        slice.regions.iter().chain(&slice.outlines).map(|region| region.label.clone()).collect()
    };
    let first = labels(&figure.panels[0]);
    match figure.panels.iter().position(|panel| labels(panel) != first) {
        Some(i) => Err(Error::Domain(format!(
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
    fn new(canvas: &Canvas, figure: &'a Multiples, panels: &[Panel], size: (u32, u32)) -> Result<Layout<'a>> {
        let first = &figure.panels[0];
        let shared = figure.panels.iter().all(|p| p.x == first.x && p.y == first.y);
        let (rows, columns) = (figure.rows.len() as i32, figure.columns.len() as i32);
        let em = ((f64::from(size.0) * f64::from(size.1)).sqrt() / 72.0).max(10.0);
        let style = Style { em, slack: em * 0.4 };
        let small = Style { em: em * 0.85, ..style };
        let sheet = canvas.rect().grown(-style.px(1.2));
        let heading = Heading::new(canvas, &figure.title, &figure.note, style, sheet.width());
        let entries = entries(&figure.panels.iter().collect::<Vec<_>>(), true);
        let legend = Legend::new(canvas, &entries, style, sheet.width()).height(style);

        let label = style.px(1.6);
        let gap = style.px(if shared { 0.8 } else { 1.4 });
        let lines = |captions: &[String]| captions.iter().map(|c| c.lines().count()).max().unwrap_or(0);
        let captions = |of: &[String]| style.px(LINE * lines(of) as f64 + 0.35);
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
        let right = sheet.right - if lines(&figure.rows) > 0 { captions(&figure.rows) } else { 0 };
        let left = sheet.left + beside;
        let between_columns = gap + if shared { 0 } else { beside };
        let width = (right - left - (columns - 1) * between_columns) / columns;

        let step = (width + between_columns, height + between_rows);
        let top = top + above;
        let grid =
            Rect { left, top, right: left + columns * step.0 - between_columns, bottom: top + rows * step.1 - between_rows };
        check_room(canvas, Rect { left, top, right: left + width, bottom: top + height })?;
        let signs = Style { em: em.min(f64::from(width.min(height)) / 13.0), ..style };
        Ok(Layout { style, small, signs, heading, sheet, grid, shared, panel: (width, height), step, above, numbers })
    }

    fn panel(&self, row: usize, column: usize) -> Rect {
        let (left, top) = (self.grid.left + column as i32 * self.step.0, self.grid.top + row as i32 * self.step.1);
        Rect { left, top, right: left + self.panel.0, bottom: top + self.panel.1 }
    }

    /// Captions of rows and columns, and the axis labels where panels share them.
    fn draw_captions(&self, canvas: &mut Canvas, figure: &Multiples) {
        let style = self.style;
        for (column, caption) in figure.columns.iter().enumerate() {
            let rect = self.panel(0, column);
            for (line, i) in caption.lines().rev().zip(0..) {
                let up = style.em * (0.85 + LINE * f64::from(i));
                let line = canvas.fit(style.em, line, f64::from(self.step.0) - style.em * 0.5);
                canvas.text([rect.at(0.5, 0.0)[0], f64::from(rect.top - self.above) - up], Pen::new(style.em, 0.5), &line);
            }
        }
        for (row, caption) in figure.rows.iter().enumerate() {
            let rect = self.panel(row, 0);
            for (line, i) in caption.lines().zip(0..) {
                let at = [f64::from(self.grid.right) + style.em * (1.0 + LINE * f64::from(i)), rect.at(0.0, 0.5)[1]];
                let line = canvas.fit(style.em, line, f64::from(self.step.1) - style.em * 0.5);
                canvas.text(at, Pen { up: true, ..Pen::new(style.em, 0.5) }, &line);
            }
        }
        if self.shared {
            label_below(canvas, style, self.grid, style.below(), &figure.panels[0].x.label);
            label_left(canvas, style, self.grid, self.numbers, &figure.panels[0].y.label);
        }
    }
}
