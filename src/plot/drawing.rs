//! A picture as a list of shapes, from which files of either format are written. The same calls give the same bytes.

use super::geometry::{Point, Rect};
use super::hatch::{Hatch, Outline};
use super::letters::Letters;
use super::palette::{Color, WHITE};
use super::regions::Regions;
use super::shapes::{DPI, Pen, Shape};
use super::{pixels, svg};
use crate::error::{Error, Result};
use std::path::Path;

/// Most pixels of a sheet.
pub const MAX_PIXELS: u64 = 1 << 25;

/// The sheet of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sheet {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Pixels per inch. The file says so; what is drawn depends on the size alone.
    pub dpi: u32,
}

impl From<(u32, u32)> for Sheet {
    /// A sheet of so many pixels, at 96 pixels per inch.
    fn from(size: (u32, u32)) -> Sheet {
        Sheet { size, dpi: DPI }
    }
}

/// A format of picture files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// Pixels.
    Png,
    /// Lines, areas and texts, for print and for other programs to go on with.
    Svg,
}

impl Format {
    /// How the names of its files end, without a dot.
    pub fn ending(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Svg => "svg",
        }
    }

    /// That of a file, by how its name ends, in letters of either size.
    ///
    /// # Errors
    /// [`Error::Domain`] for any other ending.
    pub fn of(path: &Path) -> Result<Format> {
        let ends = |format: &Format| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(format.ending()));
        [Format::Png, Format::Svg].into_iter().find(ends).ok_or_else(|| {
            let path = path.display();
            Error::invalid(format!("the picture `{path}` is to be PNG or SVG; end its name with .png or .svg"))
        })
    }
}

/// A picture, from which files of either format are written.
#[derive(Clone)]
pub struct Drawing {
    sheet: Sheet,
    letters: Letters,
    shapes: Vec<Shape>,
}

impl Drawing {
    /// The picture as a file of this format.
    ///
    /// # Errors
    /// Those of [`Drawing::png`].
    pub fn file(&self, format: Format) -> Result<Vec<u8>> {
        match format {
            Format::Png => self.png(),
            Format::Svg => Ok(self.svg().into_bytes()),
        }
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// [`Error::Domain`] when the encoder fails; no such case is known.
    pub fn png(&self) -> Result<Vec<u8>> {
        pixels::png(self.sheet.size, self.sheet.dpi, &self.shapes, &self.letters)
    }

    /// The picture as an SVG file: the same shapes at the same places, texts as texts. Its unit is the pixel of the PNG
    /// file, and its size on paper is the same.
    pub fn svg(&self) -> String {
        svg::svg(self.sheet.size, self.sheet.dpi, &self.shapes)
    }

    pub(super) fn new(sheet: impl Into<Sheet>) -> Result<Drawing> {
        let sheet = sheet.into();
        let (width, height) = sheet.size;
        let count = u64::from(width) * u64::from(height);
        if count == 0 || count > MAX_PIXELS {
            let limit = format!("both sides must be above 0, and the product at most {MAX_PIXELS}");
            return Err(Error::invalid(format!("a picture of {width} x {height} pixels; {limit}")));
        }
        Ok(Drawing { sheet, letters: Letters::new()?, shapes: Vec::new() })
    }

    /// The whole sheet.
    pub(super) fn rect(&self) -> Rect {
        Rect { left: 0, top: 0, right: self.sheet.size.0 as i32, bottom: self.sheet.size.1 as i32 }
    }

    /// Another picture on this one, its corner at a place.
    pub(super) fn inset(&mut self, other: Drawing, at: (u32, u32)) {
        self.shapes.push(Shape::Inset { at, size: other.sheet.size, shapes: other.shapes });
    }

    pub(super) fn fill(&mut self, rect: Rect, color: Color) {
        self.shapes.push(Shape::Fill(rect, color));
    }

    /// A frame of one pixel just outside `rect`.
    pub(super) fn frame(&mut self, rect: Rect, color: Color) {
        let outer = rect.grown(1);
        for side in [
            Rect { bottom: rect.top, ..outer },
            Rect { top: rect.bottom, ..outer },
            Rect { right: rect.left, ..outer },
            Rect { left: rect.right, ..outer },
        ] {
            self.fill(side, color);
        }
    }

    /// A line with a white casing on both sides, so that it stands out from whatever it crosses.
    pub(super) fn cased(&mut self, points: &[Point], width: f64, color: Color, clip: Rect) {
        let casing = (width / 2.0).clamp(1.0, 3.0);
        self.line(points, width + 2.0 * casing, WHITE, clip);
        self.line(points, width, color, clip);
    }

    /// A line through points, with round ends and joints, in the part of the sheet within `clip`. Parts with a point
    /// that is not finite are left out.
    pub(super) fn line(&mut self, points: &[Point], width: f64, color: Color, clip: Rect) {
        self.shapes.push(Shape::Line { points: points.to_vec(), width, color, clip });
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, corners: &[Point], color: Color) {
        self.shapes.push(Shape::Polygon(corners.to_vec(), color));
    }

    /// Writes a text with the middle of its capitals level with `at`.
    pub(super) fn text(&mut self, at: Point, pen: Pen, text: &str) {
        self.shapes.push(Shape::Text { at, pen, text: text.to_owned() });
    }

    /// The regions of a slice.
    pub(super) fn regions(&mut self, regions: Regions) {
        self.shapes.push(Shape::Regions(regions));
    }

    /// A rectangle full of an outline's stripes.
    pub(super) fn stripes(&mut self, rect: Rect, hatch: Hatch, outline: Outline) {
        self.shapes.push(Shape::Stripes(rect, hatch, outline));
    }

    /// Width of a text in pixels.
    pub(super) fn text_width(&self, em: f64, text: &str) -> f64 {
        self.letters.text_width(em, text)
    }

    /// The text, or as much of it as fits in `width`, with an ellipsis.
    pub(super) fn fit(&self, em: f64, text: &str, width: f64) -> String {
        self.letters.fit(em, text, width)
    }

    /// The text in lines of at most `width`, broken at spaces.
    pub(super) fn wrap(&self, em: f64, text: &str, width: f64) -> Vec<String> {
        self.letters.wrap(em, text, width)
    }
}
