//! The outline of a region in a slice.

use super::drawing::Drawing;
use super::geometry::{Point, Rect};
use super::legend::Heading;
use super::palette::{GROWN, INK, LINES};
use super::paths::{finish, narrowed};
use super::scale::Scale;
use crate::error::{Error, Result};

/// What [`draw_outlines`] draws.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlinesFigure {
    /// Heading.
    pub title: String,
    /// Small print below the heading; may be empty.
    pub note: String,
    /// What stands beside both axes.
    pub names: [String; 2],
    /// Where they begin and end.
    pub within: [[f64; 2]; 2],
    /// Places in the region, as dots.
    pub inside: Vec<[f64; 2]>,
    /// Its outlines.
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Boxes of which less is known, by their least and greatest corners.
    pub open: Vec<[[f64; 2]; 2]>,
}

/// Draws a figure of `size` (width, height) pixels.
///
/// # Errors
/// [`Error::Domain`] when a number is not finite, an axis has no extent, or the size is 0, too large, or too small.
pub fn draw_outlines(figure: &OutlinesFigure, size: (u32, u32)) -> Result<Drawing> {
    let mut canvas = Drawing::new(size)?;
    let points = figure.lines.iter().flatten().chain(&figure.inside).chain(figure.open.iter().flatten());
    if !points.flatten().all(|v| v.is_finite()) {
        return Err(Error::invalid("outlines figure: all points must be finite"));
    }
    let (style, sheet, heading) = Heading::of_figure(&canvas, &figure.title, &figure.note, size);
    heading.draw(&mut canvas, style, sheet);
    let top = sheet.top + heading.height(style) + style.px(0.3);
    let body = Rect { top, bottom: sheet.bottom - style.below() - style.px(1.6), ..sheet };
    let scale = |i: usize| Scale::new(&figure.names[i], figure.within[i][0], figure.within[i][1], false);
    let (x, y) = (scale(0)?, scale(1)?);
    let rect = narrowed(&mut canvas, &y, style, body)?;
    let place = |p: &Point| rect.at(x.fraction(p[0]), y.fraction(p[1]));
    for [low, high] in &figure.open {
        canvas.polygon(&[*low, [high[0], low[1]], *high, [low[0], high[1]]].map(|p| place(&p)), GROWN);
    }
    for at in figure.inside.iter().map(place) {
        canvas.line(&[at, at], style.em * 0.3, LINES[0], rect);
    }
    for line in &figure.lines {
        canvas.cased(&line.iter().map(place).collect::<Vec<_>>(), style.em * 0.16, INK, rect);
    }
    canvas.frame(rect, INK);
    finish(&mut canvas, [&x, &y], [&figure.names[0], &figure.names[1]], style, rect);
    Ok(canvas)
}
