//! Shapes as SVG 1.1: lines, areas and texts at the same places as in pixels.

mod lines;
mod page;
mod regions;

use super::shapes::Shape;
use lines::{path, within};
use page::{Page, number};
use std::io;

/// An SVG file of shapes.
pub(super) fn svg((width, height): (u32, u32), dpi: u32, shapes: &[Shape]) -> String {
    let mut page = Page::new();
    // Writing to memory does not fail.
    let _ = page.document((width, height), dpi, |page| shapes.iter().try_for_each(|shape| write(page, shape)));
    page.into_text()
}

fn write(page: &mut Page, shape: &Shape) -> io::Result<()> {
    match shape {
        Shape::Fill(rect, color) => page.rect(*rect, &page::color(*color)),
        Shape::Line { points, width, color, clip } => {
            let parts = within(points, *clip, *width);
            // A line of no length is a dot, for which not every program draws round ends.
            if let [dot] = &parts[..]
                && dot.iter().all(|p| p == &dot[0])
            {
                return page.dot(dot[0], width / 2.0, *color, *clip);
            }
            if parts.is_empty() { Ok(()) } else { page.line(&path(&parts, false), *width, *color, *clip) }
        }
        Shape::Polygon(corners, color) => page.area(&path(std::slice::from_ref(corners), true), *color),
        Shape::Text { at, pen, text } => page.text(*at, *pen, text),
        Shape::Regions(found) => regions::write(page, found),
        Shape::Stripes(rect, hatch, outline) => {
            let pattern = regions::pattern(page, *hatch, *outline)?;
            page.rect(*rect, &pattern)
        }
        Shape::Inset { at, size, shapes } => {
            let [x, y] = [at.0, at.1].map(|v| number(f64::from(v)));
            page.inset([&x, &y], *size, |page| shapes.iter().try_for_each(|shape| write(page, shape)))
        }
    }
}
