//! Shapes as pixels. Only correctly rounded arithmetic and the font that comes with the program.

mod regions;
mod sheet;

use super::letters::Letters;
use super::shapes::Shape;
use crate::error::{Error, Result};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter, PixelDimensions, Unit};
use sheet::Pixels;

/// A PNG file of shapes.
pub(super) fn png(size: (u32, u32), dpi: u32, shapes: &[Shape], letters: &Letters) -> Result<Vec<u8>> {
    encoded(&painted(size, shapes, letters), dpi)
        .map_err(|e| Error::invalid(format!("PNG of {} x {} pixels: {e}", size.0, size.1)))
}

fn encoded(pixels: &Pixels, dpi: u32) -> std::result::Result<Vec<u8>, EncodingError> {
    let mut png = Vec::new();
    let mut encoder = Encoder::new(&mut png, pixels.size.0, pixels.size.1);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    // Pixels per metre, which is what the chunk pHYs has.
    let density = (f64::from(dpi) / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(PixelDimensions { xppu: density, yppu: density, unit: Unit::Meter }));
    // Large even areas: unfiltered, they take less than half as much.
    encoder.set_compression(Compression::High);
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels.bytes)?;
    writer.finish()?;
    Ok(png)
}

fn painted(size: (u32, u32), shapes: &[Shape], letters: &Letters) -> Pixels {
    let mut pixels = Pixels::new(size);
    for shape in shapes {
        match shape {
            Shape::Fill(rect, color) => pixels.fill(*rect, *color),
            Shape::Line { points, width, color, clip } => pixels.line(points, *width, *color, *clip),
            Shape::Polygon(corners, color) => pixels.polygon(corners, *color),
            Shape::Text { at, pen, text } => pixels.text(*at, *pen, text, letters),
            Shape::Regions(found) => regions::paint(&mut pixels, found),
            Shape::Stripes(rect, hatch, outline) => {
                for y in rect.top..rect.bottom {
                    for x in rect.left..rect.right {
                        pixels.stripe((x, y), (x, y), *hatch, *outline, true);
                    }
                }
            }
            Shape::Inset { at, size, shapes } => pixels.paste(&painted(*size, shapes, letters), *at),
        }
    }
    pixels
}
