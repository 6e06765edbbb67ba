//! Pictures: slices of an atlas, small multiples of slices, curves with their curvature, paths with graphs.
//!
//! Everything here is plain data in, a [`Drawing`] out, and from that the bytes of a PNG or SVG file; the same data
//! give the same bytes. [`crate::files::write_file`] puts them on disk.

mod axes;
mod comb;
mod curve;
mod drawing;
mod geometry;
mod hatch;
mod legend;
mod letters;
mod multiples;
mod outlines;
mod palette;
mod paths;
mod pixels;
mod regions;
mod scale;
mod shapes;
mod slice;
mod style;
mod svg;

pub use curve::{CurveFigure, EndCircle, Graph, draw_curve};
pub use drawing::{Drawing, Format, MAX_PIXELS, Sheet};
pub use letters::missing_letter;
pub use multiples::{Caption, Multiples, draw_multiples, multiples_fit};
pub use outlines::{OutlinesFigure, draw_outlines};
pub use palette::region_colors;
pub use paths::{Backdrop, Lines, PathsFigure, draw_paths};
pub use shapes::DPI;
pub use slice::{draw_montage, draw_slice, montage_fits, slice_fits};

/// One axis of a slice.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisView {
    /// Name in error messages.
    pub name: String,
    /// What stands beside the axis; [`symbol`] helps.
    pub label: String,
    /// The nodes: finite, strictly increasing; above 0 on a logarithmic axis.
    pub values: Vec<f64>,
    /// Whether the picture spaces them by their logarithms.
    pub log: bool,
}

/// A set of nodes of a slice.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// What the legend says, before the number of nodes.
    pub label: String,
    /// Whether node `(i, j)` belongs to it, at `j * x.values.len() + i`: x fastest.
    pub mask: Vec<bool>,
    /// Closed lines around it, in axis values: what is inside of an odd number of them is drawn. What lies beyond
    /// [`AxisView::border`] is moved there. None: each node fills its cell.
    pub rings: Vec<Vec<[f64; 2]>>,
}

impl Region {
    /// One of nodes that fill their cells.
    pub fn of_nodes(label: impl Into<String>, mask: Vec<bool>) -> Region {
        Region { label: label.into(), mask, rings: Vec::new() }
    }
}

impl AxisView {
    /// Where a picture of these nodes begins and ends: half a step beyond them, in the axis's own spacing.
    pub fn border(&self) -> [f64; 2] {
        let beyond = |end: f64, next: f64| if self.log { end * (end / next).sqrt() } else { end + (end - next) / 2.0 };
        match self.values[..] {
            [] => [f64::NAN; 2],
            [only] if self.log => [only / 2.0, only * 2.0],
            [only] => [only - only.abs().max(1.0) / 2.0, only + only.abs().max(1.0) / 2.0],
            [first, second, ..] => {
                let last = self.values.len() - 1;
                [beyond(first, second), beyond(self.values[last], self.values[last - 1])]
            }
        }
    }
}

/// A point to point out.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its place, in axis values. A mark outside the picture is not drawn.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// A few words beside it.
    pub label: String,
}

/// A plane through a grid: which nodes belong to which regions.
#[derive(Debug, Clone, PartialEq)]
pub struct Slice {
    /// Heading.
    pub title: String,
    /// The axis to the right.
    pub x: AxisView,
    /// The axis upwards.
    pub y: AxisView,
    /// Filled regions, largest first; each covers those before it.
    pub regions: Vec<Region>,
    /// Regions drawn as a line hatched on its inner side, which hides nothing: for those not nested in the others.
    pub outlines: Vec<Region>,
    /// Points to point out.
    pub marks: Vec<Mark>,
    /// Small print below the heading; may be empty.
    pub note: String,
    /// What a point of the plane is, for the legend that counts them: `node`.
    pub counted: &'static str,
}

/// An axis name as a formula: `phi0` becomes `φ₀`, `kappa1` becomes `κ₁`; unknown names stay.
pub fn symbol(name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let letter = match stem {
        "alpha" => "α",
        "beta" => "β",
        "phi" => "φ",
        "kappa" => "κ",
        "omega" => "ω",
        "theta" => "θ",
        "xi" => "ξ",
        "eta" => "η",
        "f" | "H" | "w" | "a" | "k" => stem,
        _ => return name.to_owned(),
    };
    let lowered =
        |c: char| c.to_digit(10).map_or(c, |d| ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][d as usize]);
    letter.chars().chain(name[stem.len()..].chars().map(lowered)).collect()
}

/// A number with at most four decimals, or of four digits in scientific form where decimals would say nothing or fill
/// lines.
pub fn short(x: f64) -> String {
    let size = x.abs();
    let text = if !(1e-4..1e15).contains(&size) { format!("{x:.3e}") } else { format!("{x:.4}") };
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, ""));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    match exponent {
        _ if x == 0.0 => "0".into(),
        "" => digits.replace('-', "−"),
        exponent => format!("{digits}e{exponent}").replace('-', "−"),
    }
}

/// A number with its digits in groups of three.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let breaks = |i: usize| i > 0 && (digits.len() - i).is_multiple_of(3);
    digits.chars().enumerate().flat_map(|(i, c)| breaks(i).then_some(',').into_iter().chain([c])).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn large_numbers_have_groups_of_digits() {
        assert_eq!([0, 999, 1000, 1234567].map(super::grouped), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn short_numbers_have_four_digits() {
        assert_eq!([0.0, 5e-324, -1e300, 1e-310].map(super::short), ["0", "4.941e−324", "−1e300", "1e−310"]);
    }
}
