//! PNG pictures: slices of an atlas, small multiples of slices, curves with their curvature, paths with graphs.
//!
//! Everything here is plain data in, PNG bytes out; the same data give the same bytes.
//! [`crate::files::write_file`] puts them on disk.

mod axes;
mod canvas;
mod curve;
mod legend;
mod multiples;
mod paths;
mod scale;
mod slice;

pub use curve::{CurveFigure, EndCircle, Graph, curve_png};
pub use multiples::{Multiples, multiples_png};
pub use paths::{Backdrop, Lines, PathsFigure, paths_png};
pub use slice::{montage_png, slice_png};

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
}

/// The colours of `count` nested regions, largest first: from light to dark, so that they stay apart without colour
/// and for colour-blind readers.
pub fn region_colors(count: usize) -> Vec<[u8; 3]> {
    const RAMP: [[u8; 3]; 4] = [[226, 226, 226], [242, 188, 60], [38, 137, 152], [54, 26, 92]];
    let picked: &[usize] = match count {
        0..=1 => &[2],
        2 => &[0, 1],
        3 => &[0, 1, 3],
        _ => &[0, 1, 2, 3],
    };
    if count <= 4 {
        return picked.iter().take(count).map(|&i| RAMP[i]).collect();
    }
    let mixed = |i: usize| {
        let at = i * 3;
        let (low, part) = ((at / (count - 1)).min(2), at as f64 / (count - 1) as f64);
        let mix = |c: usize| {
            let (a, b) = (f64::from(RAMP[low][c]), f64::from(RAMP[low + 1][c]));
            (a + (b - a) * (part - low as f64)).round() as u8
        };
        [mix(0), mix(1), mix(2)]
    };
    (0..count).map(mixed).collect()
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
    let lowered = |c: char| c.to_digit(10).map_or(c, |d| ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][d as usize]);
    letter.chars().chain(name[stem.len()..].chars().map(lowered)).collect()
}

/// A number with its digits in groups of three.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let breaks = |i: usize| i > 0 && (digits.len() - i).is_multiple_of(3);
    digits.chars().enumerate().flat_map(|(i, c)| breaks(i).then_some(',').into_iter().chain([c])).collect()
}
