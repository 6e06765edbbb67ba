//! How a picture looks, whatever it shows: its heading, size and resolution.

use super::raw::{Fault, Pixels};
use toml::Spanned;

/// Pixels per inch of a picture whose recipe does not choose them.
pub const DPI: u32 = 96;
/// Most pixels of a picture: a typing error should not fill the memory.
pub const MAX_PIXELS: u64 = 1 << 25;
/// Width and height of slices, unions and comparisons, in pixels at [`DPI`], unless the recipe chooses others.
pub const SLICE_SIZE: (u32, u32) = (1000, 860);
/// Those of small multiples.
pub const MULTIPLES_SIZE: (u32, u32) = (1500, 1350);
/// Those of each slice of several atlases side by side.
pub const PANEL_SIZE: (u32, u32) = (620, 700);
/// The resolutions that a recipe may choose.
pub(super) const RESOLUTIONS: [u32; 2] = [24, 2400];

/// Heading, size and resolution.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Look {
    /// The heading; `None`: made from the name and what the picture shows.
    pub title: Option<String>,
    /// Width and height in pixels at [`DPI`]; `None`: as the kind of picture has it.
    pub size: Option<(u32, u32)>,
    /// Pixels per inch.
    pub dpi: u32,
    /// Where in the text of the recipe the size or the resolution stands, or else the picture.
    pub at: Option<usize>,
}

impl Default for Look {
    fn default() -> Look {
        Look { title: None, size: None, dpi: DPI, at: None }
    }
}

impl Look {
    /// Width and height in pixels, where the size at [`DPI`] is `usual` unless the recipe has another.
    pub fn pixels(&self, usual: (u32, u32)) -> (u32, u32) {
        let scaled = |at_96: u32| (f64::from(at_96) * f64::from(self.dpi) / f64::from(DPI)).round() as u32;
        let (width, height) = self.size.unwrap_or(usual);
        (scaled(width), scaled(height))
    }
}

/// The look that a recipe chooses, for a picture of a usual size that stands so far in its text.
pub(super) fn look(
    title: Option<&String>,
    size: Option<&Spanned<Vec<Pixels>>>,
    dpi: Option<&Spanned<Pixels>>,
    picture: Option<usize>,
    usual: (u32, u32),
) -> Result<Look, Fault> {
    let mut look = Look { title: title.cloned(), ..Look::default() };
    if let Some(dpi) = dpi {
        look.dpi = dpi.get_ref().count();
        let [least, most] = RESOLUTIONS;
        if !(least..=most).contains(&look.dpi) {
            return Err(Fault::new(
                dpi.span(),
                format!("`dpi` is {}; it must be {least} to {most} pixels per inch", look.dpi),
            ));
        }
    }
    if let Some(size) = size {
        let fail = |what: String| Err(Fault::new(size.span(), what));
        let [width, height] = size.get_ref()[..] else {
            return fail(format!(
                "`size` has {} numbers; it is a list of two, width and height in pixels",
                size.get_ref().len()
            ));
        };
        let (width, height) = (width.count(), height.count());
        if width == 0 || height == 0 {
            return fail(format!("`size` is {width} x {height} pixels; both must be above 0"));
        }
        look.size = Some((width, height));
    }
    let ((wide, high), at) = (look.pixels(usual), size.map(Spanned::span).or(dpi.map(Spanned::span)));
    look.at = at.as_ref().map(|at| at.start).or(picture);
    match at {
        Some(at) if u64::from(wide) * u64::from(high) > MAX_PIXELS => {
            let what =
                format!("the picture would have {wide} x {high} pixels; the product must be at most {MAX_PIXELS}");
            Err(Fault::new(at, format!("{what}, so take a smaller `size` or `dpi`")))
        }
        _ => Ok(look),
    }
}
