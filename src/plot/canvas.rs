//! A white sheet of pixels with anti-aliased lines and text. Only correctly rounded arithmetic and the font that comes
//! with the program: the same calls give the same bytes.

use super::palette::{Color, INK, WHITE};
use crate::error::{Error, Result};
use ab_glyph::{Font, FontRef, Glyph, GlyphId, PxScale, ScaleFont, point};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter, PixelDimensions, Unit};

static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

/// Pixels per inch of a sheet that tells only its size.
pub const DPI: u32 = 96;
/// Most pixels of a sheet.
pub const MAX_PIXELS: u64 = 1 << 25;

pub(super) type Point = [f64; 2];

/// Pixels from `left` to before `right`, from `top` to before `bottom`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Rect {
    pub(super) fn width(&self) -> i32 {
        self.right - self.left
    }
    pub(super) fn height(&self) -> i32 {
        self.bottom - self.top
    }
    /// Moved out on all sides; in, for a negative amount.
    pub(super) fn grown(&self, by: i32) -> Rect {
        Rect { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }
    /// The common part; empty (not positive in width or height) when there is none.
    pub(super) fn meet(&self, other: &Rect) -> Rect {
        Rect {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }
    /// The point at these fractions of width and height, the second upwards.
    pub(super) fn at(&self, x: f64, y: f64) -> Point {
        [f64::from(self.left) + x * f64::from(self.width()), f64::from(self.bottom) - y * f64::from(self.height())]
    }
}

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

/// How a text is written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    /// Size of the em square, pixels.
    pub em: f64,
    pub color: Color,
    /// Which part of the text is at the point: 0 its start, 0.5 its middle, 1 its end.
    pub anchor: f64,
    /// Whether it runs upwards.
    pub up: bool,
}

impl Pen {
    pub(super) fn new(em: f64, anchor: f64) -> Pen {
        Pen { em, color: INK, anchor, up: false }
    }
}

pub(super) struct Canvas {
    size: (u32, u32),
    dpi: u32,
    pixels: Vec<u8>,
    font: FontRef<'static>,
}

/// The first letter of a text that the font of all pictures lacks.
pub fn missing_letter(text: &str) -> Option<char> {
    let font = FontRef::try_from_slice(FONT).ok()?;
    text.chars().find(|c| !c.is_whitespace() && font.glyph_id(*c).0 == 0)
}

impl Canvas {
    pub(super) fn new(sheet: impl Into<Sheet>) -> Result<Canvas> {
        let mut canvas = Canvas::measuring(sheet)?;
        canvas.pixels = vec![255; canvas.size.0 as usize * canvas.size.1 as usize * 3];
        Ok(canvas)
    }

    /// One to measure texts by, that nothing can be drawn on.
    pub(super) fn measuring(sheet: impl Into<Sheet>) -> Result<Canvas> {
        let Sheet { size, dpi } = sheet.into();
        let (width, height) = size;
        let count = u64::from(width) * u64::from(height);
        if count == 0 || count > MAX_PIXELS {
            let limit = format!("both sides must be above 0, and the product at most {MAX_PIXELS}");
            return Err(Error::invalid(format!("a picture of {width} x {height} pixels; {limit}")));
        }
        let font = FontRef::try_from_slice(FONT).map_err(|e| Error::invalid(format!("the built-in font: {e}")))?;
        Ok(Canvas { size, dpi, pixels: Vec::new(), font })
    }

    /// The whole sheet.
    pub(super) fn rect(&self) -> Rect {
        Rect { left: 0, top: 0, right: self.size.0 as i32, bottom: self.size.1 as i32 }
    }

    /// The picture as a PNG file.
    pub(super) fn into_png(self) -> Result<Vec<u8>> {
        self.encoded().map_err(|e| Error::invalid(format!("PNG of {} x {} pixels: {e}", self.size.0, self.size.1)))
    }

    fn encoded(&self) -> std::result::Result<Vec<u8>, EncodingError> {
        let mut png = Vec::new();
        let mut encoder = Encoder::new(&mut png, self.size.0, self.size.1);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        // Pixels per metre, which is what the chunk pHYs has.
        let density = (f64::from(self.dpi) / 0.0254).round() as u32;
        encoder.set_pixel_dims(Some(PixelDimensions { xppu: density, yppu: density, unit: Unit::Meter }));
        // Large even areas: unfiltered, they take less than half as much.
        encoder.set_compression(Compression::High);
        encoder.set_filter(Filter::NoFilter);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(png)
    }

    /// Copies another sheet onto this one, its corner at a place; what lies beyond is cut off.
    pub(super) fn paste(&mut self, other: &Canvas, (left, top): (u32, u32)) {
        let width = other.size.0.min(self.size.0.saturating_sub(left)) as usize * 3;
        for row in 0..other.size.1.min(self.size.1.saturating_sub(top)) {
            let from = row as usize * other.size.0 as usize * 3;
            let to = ((top + row) as usize * self.size.0 as usize + left as usize) * 3;
            self.pixels[to..to + width].copy_from_slice(&other.pixels[from..from + width]);
        }
    }

    /// Mixes a colour into a pixel; pixels beyond the sheet are ignored.
    pub(super) fn blend(&mut self, x: i32, y: i32, color: Color, cover: f64) {
        let inside = |v: i32, n: u32| u32::try_from(v).is_ok_and(|v| v < n);
        if !(inside(x, self.size.0) && inside(y, self.size.1)) {
            return;
        }
        let at = (y as usize * self.size.0 as usize + x as usize) * 3;
        let pixel = &mut self.pixels[at..at + 3];
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

    /// A filled polygon; for small shapes.
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

    /// Width of a text in pixels.
    pub(super) fn text_width(&self, em: f64, text: &str) -> f64 {
        self.glyphs(em, text).1
    }

    /// The text, or as much of it as fits in `width`, with an ellipsis.
    pub(super) fn fit(&self, em: f64, text: &str, width: f64) -> String {
        let (glyphs, whole) = self.glyphs(em, text);
        if whole <= width {
            return text.to_owned();
        }
        let room = width - self.text_width(em, "…");
        // Kept: the characters before the last that begins within the room.
        let kept = glyphs.partition_point(|glyph| f64::from(glyph.position.x) <= room).saturating_sub(1);
        if room < 0.0 {
            String::new()
        } else {
            text.chars().take(kept).collect::<String>().trim_end().to_owned() + "…"
        }
    }

    /// The text in lines of at most `width`, broken at spaces.
    pub(super) fn wrap(&self, em: f64, text: &str, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if self.text_width(em, &format!("{line} {word}")) <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines.iter().map(|line| self.fit(em, line, width)).collect()
    }

    /// Writes a text with the middle of its capitals level with `at`.
    pub(super) fn text(&mut self, at: Point, pen: Pen, text: &str) {
        let (glyphs, width) = self.glyphs(pen.em, text);
        // Along the text and across it, from the start of its base line; whole pixels keep letters crisp.
        let along = if pen.up { at[1] + width * pen.anchor } else { at[0] - width * pen.anchor }.round() as i32;
        let across = (if pen.up { at[0] } else { at[1] } + 0.365 * pen.em).round() as i32;
        let font = self.font.clone();
        for outline in glyphs.into_iter().filter_map(|glyph| font.outline_glyph(glyph)) {
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, cover| {
                let (x, y) = (corner.x as i32 + x as i32, corner.y as i32 + y as i32);
                let (x, y) = if pen.up { (across + y, along - 1 - x) } else { (along + x, across + y) };
                self.blend(x, y, pen.color, f64::from(cover));
            });
        }
    }

    /// The glyphs of a text, placed from the start of its base line, and its width.
    fn glyphs(&self, em: f64, text: &str) -> (Vec<Glyph>, f64) {
        // ab_glyph's scale is the height of a line, not the em.
        let height = self.font.units_per_em().map_or(1.0, |units| self.font.height_unscaled() / units);
        let scale = PxScale::from(em as f32 * height);
        let font = self.font.as_scaled(scale);
        let mut x = 0.0;
        let mut last: Option<GlyphId> = None;
        let mut place = |c: char| {
            let id = font.glyph_id(c);
            x += last.map_or(0.0, |last| font.kern(last, id));
            last = Some(id);
            let glyph = id.with_scale_and_position(scale, point(x, 0.0));
            x += font.h_advance(id);
            glyph
        };
        let glyphs = text.chars().map(&mut place).collect();
        (glyphs, f64::from(x))
    }
}

/// The pixels within `by` of the box of the points; saturates for points far away.
fn hull(points: &[Point], by: f64) -> Rect {
    let all = |pick: fn(f64, f64) -> f64, i: usize| points.iter().map(|p| p[i]).fold(f64::NAN, pick);
    Rect {
        left: (all(f64::min, 0) - by).floor() as i32,
        top: (all(f64::min, 1) - by).floor() as i32,
        right: (all(f64::max, 0) + by).ceil() as i32,
        bottom: (all(f64::max, 1) + by).ceil() as i32,
    }
}

/// Distance of `p` from the segment from `a` to `b`.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = along[0] * along[0] + along[1] * along[1];
    let t = if length2 > 0.0 { ((to[0] * along[0] + to[1] * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let off = [to[0] - t * along[0], to[1] - t * along[1]];
    (off[0] * off[0] + off[1] * off[1]).sqrt()
}

/// Whether a closed polygon holds a point (even-odd rule).
fn holds(corners: &[Point], p: Point) -> bool {
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = pairs
        .filter(|(a, b)| (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_labels_need() {
        let canvas = Canvas::new((9, 9)).unwrap();
        for c in "φκωπ₀₁₂⁻⁰¹²³⁴⁵⁶⁷⁸⁹−×≤≥√∞′·…°⊂–’aA0%".chars() {
            assert_ne!(canvas.font.glyph_id(c).0, 0, "{c}");
        }
        assert_eq!(canvas.font.glyph_id('漢').0, 0, "so that the loop above can fail");
    }

    #[test]
    fn long_texts_are_shortened_and_wrapped() {
        let canvas = Canvas::new((9, 9)).unwrap();
        let text = "monotone curvature between two ends";
        let whole = canvas.text_width(16.0, text);
        assert_eq!(canvas.fit(16.0, text, whole), text);
        let short = canvas.fit(16.0, text, whole / 2.0);
        assert!(short.ends_with('…') && canvas.text_width(16.0, &short) <= whole / 2.0 && short.len() > 9, "{short}");
        let lines = canvas.wrap(16.0, text, whole / 2.0);
        assert!(lines.len() >= 2 && lines.join(" ") == text, "{lines:?}");
    }

    #[test]
    fn drawing_off_the_sheet_is_harmless() {
        let mut canvas = Canvas::new((20, 10)).unwrap();
        let clean = canvas.pixels.clone();
        let off = Rect { left: -50, top: -50, right: -40, bottom: 900 };
        canvas.fill(off, INK);
        canvas.line(&[[f64::NAN, 1.0], [5.0, 5.0]], 2.0, INK, canvas.rect());
        canvas.line(&[[1.0, 1.0], [5.0, 5.0]], 2.0, INK, off);
        canvas.text([900.0, -900.0], Pen::new(12.0, 0.5), "far");
        assert_eq!(canvas.pixels, clean);
        canvas.line(&[[-1e100, 5.0], [1e100, 5.0]], 2.0, INK, canvas.rect());
        assert_ne!(canvas.pixels, clean);
    }
}
