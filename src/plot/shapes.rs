//! What pictures are made of. Two writers draw it: [`super::pixels`] and [`super::svg`].

use super::geometry::{Point, Rect};
use super::hatch::{Hatch, Outline};
use super::palette::{Color, INK};
use super::regions::Regions;

/// Pixels per inch of a sheet that states only its size.
pub const DPI: u32 = 96;

/// How a text is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pen {
    /// Size of the em square, pixels.
    pub em: f64,
    pub color: Color,
    /// Which part of the text is at the point: 0 its start, 0.5 its middle, 1 its end.
    pub anchor: f64,
    /// Whether it runs upwards.
    pub up: bool,
    /// Width of a white rim around the letters, pixels; 0 for none.
    pub rim: f64,
}

impl Pen {
    pub(super) fn new(em: f64, anchor: f64) -> Pen {
        Pen { em, color: INK, anchor, up: false, rim: 0.0 }
    }

    /// How far the base line is below the middle of the capitals.
    pub(super) fn drop(&self) -> f64 {
        0.365 * self.em
    }
}

/// One thing drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shape {
    Fill(Rect, Color),
    /// A line through points, with round ends and joints, in the part of the sheet within `clip`. Parts with a point
    /// that is not finite are left out.
    Line {
        points: Vec<Point>,
        width: f64,
        color: Color,
        clip: Rect,
    },
    /// A filled polygon.
    Polygon(Vec<Point>, Color),
    /// A text with the middle of its capitals level with `at`.
    Text {
        at: Point,
        pen: Pen,
        text: String,
    },
    /// Regions of a slice.
    Regions(Regions),
    /// A rectangle full of an outline's stripes.
    Stripes(Rect, Hatch, Outline),
    /// Another sheet of this size, its corner at a place; what lies beyond either sheet is cut off.
    Inset {
        at: (u32, u32),
        size: (u32, u32),
        shapes: Vec<Shape>,
    },
}
