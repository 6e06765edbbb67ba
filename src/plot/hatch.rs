//! Hatched lines: how the inner side of a region is shown, on a slice and, alike, in its legend.

use super::palette::{Color, OUTLINES};
use super::style::Style;

/// What sets one of several outlines apart: its colour, and where there are more than colours, the way its stripes run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outline {
    pub color: Color,
    /// Whether stripes rise to the right. Those of the first ones fall, because boundaries tend to rise.
    pub rising: bool,
}

impl Outline {
    pub(super) fn of(index: usize) -> Outline {
        Outline { color: OUTLINES[index % OUTLINES.len()], rising: index / OUTLINES.len() % 2 == 1 }
    }
}

/// The line around a region, the stripes further in, and the white casing that parts them from every fill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hatch {
    /// Width of the line around the region.
    pub line: i32,
    /// Width of the casing on either side of the line.
    pub rim: i32,
    /// How far the stripes reach inwards.
    pub band: i32,
    /// From one stripe to the next, to the right.
    pub period: f64,
    /// Half the width of a stripe.
    pub half: f64,
    /// Width of the casing on either side of a stripe.
    pub casing: f64,
}

impl Hatch {
    pub(super) fn new(style: Style) -> Hatch {
        let line = style.px(0.13).max(1);
        Hatch {
            line,
            rim: (line / 2).max(1),
            band: style.px(0.7).max(3),
            period: style.em * 0.7,
            half: style.em * 0.04 + 0.1,
            casing: (style.em * 0.06).max(1.0),
        }
    }

    /// The same on pixels so many times as small.
    pub(super) fn scaled(self, times: i32) -> Hatch {
        let by = f64::from(times);
        Hatch {
            line: self.line * times,
            rim: self.rim * times,
            band: self.band * times,
            period: self.period * by,
            half: self.half * by,
            casing: self.casing * by,
        }
    }
}
