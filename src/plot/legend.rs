//! Heading above a figure and legend below it.

use super::drawing::Drawing;
use super::geometry::{Point, Rect};
use super::hatch::{Hatch, Outline};
use super::palette::{Color, GREY, INK, WHITE};
use super::shapes::Pen;
use super::style::Style;

/// The sign of a legend's entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Key {
    /// A filled region.
    Fill(Color),
    /// A line hatched on one side.
    Hatched(Outline),
    /// A line; the second number is its width in em.
    Line(Color, f64),
    /// The star of marks.
    Star,
}

/// One entry of a legend.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub key: Key,
    pub text: String,
}

const ROW: f64 = 1.6;
const KEY: f64 = 2.6;

/// A legend laid out in columns.
pub(super) struct Legend<'a> {
    entries: &'a [Entry],
    columns: usize,
    column_width: f64,
}

impl Legend<'_> {
    /// As many columns as fit in `width`, evenly filled.
    pub(super) fn new<'a>(canvas: &Drawing, entries: &'a [Entry], style: Style, width: i32) -> Legend<'a> {
        let widest = entries.iter().map(|e| canvas.text_width(style.em, &e.text)).fold(0.0, f64::max);
        let needed = widest + style.em * (KEY + 1.5);
        let most = (f64::from(width) / needed).floor().max(1.0) as usize;
        let rows = entries.len().div_ceil(most).max(1);
        let columns = entries.len().div_ceil(rows).max(1);
        Legend { entries, columns, column_width: needed.min(f64::from(width)) }
    }

    fn rows(&self) -> usize {
        self.entries.len().div_ceil(self.columns)
    }

    pub(super) fn height(&self, style: Style) -> i32 {
        style.px(ROW * self.rows() as f64)
    }

    /// Draws it with its top left corner at `corner`.
    pub(super) fn draw(&self, canvas: &mut Drawing, style: Style, corner: (i32, i32)) {
        for (i, entry) in self.entries.iter().enumerate() {
            let (column, row) = (i / self.rows(), i % self.rows());
            let x = f64::from(corner.0) + column as f64 * self.column_width;
            let y = f64::from(corner.1) + (row as f64 + 0.5) * ROW * style.em;
            let key = Rect {
                left: x.round() as i32,
                right: (x + style.em * 1.9).round() as i32,
                top: (y - style.em * 0.45).round() as i32,
                bottom: (y + style.em * 0.55).round() as i32,
            };
            draw_key(canvas, style, key, entry.key);
            let text = canvas.fit(style.em, &entry.text, self.column_width - style.em * KEY);
            canvas.text([x + style.em * KEY, y], Pen::new(style.em, 0.0), &text);
        }
    }
}

fn draw_key(canvas: &mut Drawing, style: Style, rect: Rect, key: Key) {
    match key {
        Key::Fill(color) => {
            canvas.fill(rect, color);
            canvas.frame(rect, INK);
        }
        Key::Hatched(outline) => {
            let hatch = Hatch::new(style);
            canvas.stripes(rect, hatch, outline);
            canvas.fill(Rect { bottom: rect.top + hatch.line, ..rect }, outline.color);
        }
        Key::Line(color, width) => {
            canvas.line(&[rect.at(0.0, 0.5), rect.at(1.0, 0.5)], width * style.em, color, rect.grown(2));
        }
        Key::Star => star(canvas, rect.at(0.5, 0.5), style.em * 0.6),
    }
}

/// The sign of a mark: a black star with a white rim, seen on every colour.
pub(super) fn star(canvas: &mut Drawing, at: Point, radius: f64) {
    // A rim of even width all round: the outline is drawn as a line before the star is filled.
    let corner = |i: usize| {
        let length = if i.is_multiple_of(2) { radius } else { radius * 0.42 };
        let (sin, cos) = (std::f64::consts::PI * i as f64 / 5.0).sin_cos();
        [at[0] + length * sin, at[1] - length * cos]
    };
    let corners: Vec<Point> = (0..10).map(corner).collect();
    let closed: Vec<Point> = corners.iter().chain(&corners[..1]).copied().collect();
    canvas.line(&closed, radius * 0.6, WHITE, canvas.rect());
    canvas.polygon(&corners, INK);
}

/// Heading and small print at the top of a figure.
pub(super) struct Heading<'a> {
    title: &'a str,
    note: Vec<String>,
}

impl Heading<'_> {
    pub(super) fn new<'a>(canvas: &Drawing, title: &'a str, note: &str, style: Style, width: i32) -> Heading<'a> {
        Heading { title, note: canvas.wrap(style.em * 0.95, note, width.into()) }
    }

    /// That of a figure of a size in pixels, with the figure's style and the sheet within its margins.
    pub(super) fn of_figure<'a>(
        canvas: &Drawing,
        title: &'a str,
        note: &str,
        size: (u32, u32),
    ) -> (Style, Rect, Heading<'a>) {
        let em = ((f64::from(size.0) * f64::from(size.1)).sqrt() / 64.0).max(10.0);
        let style = Style { em, slack: em * 0.8 };
        let sheet = canvas.rect().grown(-style.px(1.2));
        (style, sheet, Heading::new(canvas, title, note, style, sheet.width()))
    }

    pub(super) fn height(&self, style: Style) -> i32 {
        let title = if self.title.is_empty() { 0.0 } else { 1.8 };
        style.px(title + 1.35 * self.note.len() as f64)
    }

    /// Draws it into the top of `rect`.
    pub(super) fn draw(&self, canvas: &mut Drawing, style: Style, rect: Rect) {
        let (x, mut y) = (f64::from(rect.left), f64::from(rect.top));
        if !self.title.is_empty() {
            let em = style.em * 1.25;
            let title = canvas.fit(em, self.title, rect.width().into());
            canvas.text([x, y + em * 0.6], Pen::new(em, 0.0), &title);
            y += style.em * 1.8;
        }
        for line in &self.note {
            let pen = Pen { color: GREY, ..Pen::new(style.em * 0.95, 0.0) };
            canvas.text([x, y + style.em * 0.6], pen, line);
            y += style.em * 1.35;
        }
    }
}
