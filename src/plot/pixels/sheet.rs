//! A white sheet of pixels with anti-aliased lines and text.

use crate::plot::geometry::{Point, Rect, distance, holds, hull};
use crate::plot::hatch::{Hatch, Outline};
use crate::plot::letters::Letters;
use crate::plot::palette::{Color, WHITE};
use crate::plot::shapes::Pen;

pub(super) struct Pixels {
    pub size: (u32, u32),
    /// Red, green and blue of each pixel, from the upper left one on, row by row.
    pub bytes: Vec<u8>,
}

impl Pixels {
    pub(super) fn new(size: (u32, u32)) -> Pixels {
        Pixels { size, bytes: vec![255; size.0 as usize * size.1 as usize * 3] }
    }

    fn rect(&self) -> Rect {
        Rect { left: 0, top: 0, right: self.size.0 as i32, bottom: self.size.1 as i32 }
    }

    /// Copies another sheet onto this one, its corner at a place; what lies beyond is cut off.
    pub(super) fn paste(&mut self, other: &Pixels, (left, top): (u32, u32)) {
        let width = other.size.0.min(self.size.0.saturating_sub(left)) as usize * 3;
        for row in 0..other.size.1.min(self.size.1.saturating_sub(top)) {
            let from = row as usize * other.size.0 as usize * 3;
            let to = ((top + row) as usize * self.size.0 as usize + left as usize) * 3;
            self.bytes[to..to + width].copy_from_slice(&other.bytes[from..from + width]);
        }
    }

    /// Copies a sheet of pixels that are so many times as small, its corner at a place that leaves all of it
    /// on this one.
    pub(super) fn reduce(&mut self, fine: &Pixels, times: i32, (left, top): (i32, i32)) {
        let (times, count) = (times as usize, (times * times) as u32);
        let (width, height) = (fine.size.0 as usize / times, fine.size.1 as usize / times);
        let part =
            |x: usize, y: usize, channel: usize| u32::from(fine.bytes[(y * fine.size.0 as usize + x) * 3 + channel]);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let to = ((y + top as usize) * self.size.0 as usize + x + left as usize) * 3;
            for channel in 0..3 {
                let parts = (0..times * times).map(|i| part(x * times + i % times, y * times + i / times, channel));
                self.bytes[to + channel] = ((parts.sum::<u32>() + count / 2) / count) as u8;
            }
        }
    }

    /// Mixes a colour into a pixel; pixels beyond the sheet are ignored.
    pub(super) fn blend(&mut self, x: i32, y: i32, color: Color, cover: f64) {
        let inside = |v: i32, n: u32| u32::try_from(v).is_ok_and(|v| v < n);
        if !(inside(x, self.size.0) && inside(y, self.size.1)) {
            return;
        }
        let at = (y as usize * self.size.0 as usize + x as usize) * 3;
        let pixel = &mut self.bytes[at..at + 3];
        if cover >= 1.0 {
            return pixel.copy_from_slice(&color);
        }
        for (old, new) in pixel.iter_mut().zip(color) {
            *old = (f64::from(*old) + (f64::from(new) - f64::from(*old)) * cover.max(0.0)).round() as u8;
        }
    }

    pub(super) fn fill(&mut self, rect: Rect, color: Color) {
        let rect = rect.meet(&self.rect());
        for y in rect.top..rect.bottom {
            for x in rect.left..rect.right {
                self.blend(x, y, color, 1.0);
            }
        }
    }

    /// A line through points, with round ends and joints, in the part of the sheet within `clip`. Parts with a point
    /// that is not finite are left out.
    pub(super) fn line(&mut self, points: &[Point], width: f64, color: Color, clip: Rect) {
        let clip = clip.meet(&self.rect()).meet(&hull(points, width / 2.0 + 1.0));
        if clip.width() <= 0 || clip.height() <= 0 {
            return;
        }
        // The cover of the whole line is collected first: blending piece by piece would darken the joints.
        let mut cover = vec![0.0; clip.width() as usize * clip.height() as usize];
        let half = width / 2.0;
        for pair in points.windows(2).filter(|pair| pair.iter().flatten().all(|v| v.is_finite())) {
            let touched = hull(pair, half + 1.0).meet(&clip);
            for y in touched.top..touched.bottom {
                for x in touched.left..touched.right {
                    let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    let cell = &mut cover[((y - clip.top) * clip.width() + x - clip.left) as usize];
                    *cell = (half + 0.5 - distance(centre, pair[0], pair[1])).max(*cell).min(1.0);
                }
            }
        }
        for (i, cover) in (0..).zip(cover).filter(|(_, cover)| *cover > 0.0) {
            self.blend(clip.left + i % clip.width(), clip.top + i / clip.width(), color, cover);
        }
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, corners: &[Point], color: Color) {
        let touched = hull(corners, 1.0).meet(&self.rect());
        for y in touched.top..touched.bottom {
            for x in touched.left..touched.right {
                let sub = |i: i32| f64::from(i) / 4.0 + 0.125;
                let hits = (0..16).filter(|i| holds(corners, [f64::from(x) + sub(i % 4), f64::from(y) + sub(i / 4)]));
                self.blend(x, y, color, hits.count() as f64 / 16.0);
            }
        }
    }

    /// Writes a text with the middle of its capitals level with `at`.
    pub(super) fn text(&mut self, at: Point, pen: Pen, text: &str, letters: &Letters) {
        if pen.rim > 0.0 {
            let rim = Pen { color: WHITE, rim: 0.0, ..pen };
            for i in 0..16 {
                let (sin, cos) = (std::f64::consts::PI * f64::from(i) / 8.0).sin_cos();
                self.text([at[0] + pen.rim * cos, at[1] + pen.rim * sin], rim, text, letters);
            }
        }
        let (glyphs, width) = letters.glyphs(pen.em, text);
        // Along the text and across it, from the start of its base line; whole pixels keep letters crisp.
        let along = if pen.up { at[1] + width * pen.anchor } else { at[0] - width * pen.anchor }.round() as i32;
        let across = (if pen.up { at[0] } else { at[1] } + pen.drop()).round() as i32;
        for outline in glyphs.into_iter().filter_map(|glyph| letters.outline(glyph)) {
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, cover| {
                let (x, y) = (corner.x as i32 + x as i32, corner.y as i32 + y as i32);
                let (x, y) = if pen.up { (across + y, along - 1 - x) } else { (along + x, across + y) };
                self.blend(x, y, pen.color, f64::from(cover));
            });
        }
    }

    /// Draws as much of the stripes and their casing as lies on a pixel; of the casing alone where the stripes have
    /// ended. The second place is where the pixel is among the stripes.
    pub(super) fn stripe(&mut self, (x, y): (i32, i32), place: (i32, i32), hatch: Hatch, outline: Outline, on: bool) {
        // Distance from the nearest of the lines x - y, or x + y, = multiple of the period.
        let along = if outline.rising { place.0 + place.1 } else { place.0 - place.1 };
        let off = f64::from(along).rem_euclid(hatch.period);
        let distance = off.min(hatch.period - off) / std::f64::consts::SQRT_2;
        let cover = |half: f64| (half + 0.5 - distance).clamp(0.0, 1.0);
        // A pixel that the stripe touches at all is white under it.
        self.blend(x, y, WHITE, cover(hatch.half + hatch.casing + 0.5));
        if on {
            self.blend(x, y, outline.color, cover(hatch.half));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::palette::INK;

    #[test]
    fn drawing_off_the_sheet_is_harmless() {
        let mut pixels = Pixels::new((20, 10));
        let clean = pixels.bytes.clone();
        let off = Rect { left: -50, top: -50, right: -40, bottom: 900 };
        pixels.fill(off, INK);
        pixels.line(&[[f64::NAN, 1.0], [5.0, 5.0]], 2.0, INK, pixels.rect());
        pixels.line(&[[1.0, 1.0], [5.0, 5.0]], 2.0, INK, off);
        pixels.text([900.0, -900.0], Pen::new(12.0, 0.5), "far", &Letters::new().unwrap());
        assert_eq!(pixels.bytes, clean);
        pixels.line(&[[-1e100, 5.0], [1e100, 5.0]], 2.0, INK, pixels.rect());
        assert_ne!(pixels.bytes, clean);
    }
}
