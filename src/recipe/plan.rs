//! What a recipe says, looked up.

use super::look::Look;
use crate::family::{Chart, Family};
use crate::grid::Grid;

/// A recipe, read and looked up.
#[derive(Clone)]
pub struct Recipe {
    /// The atlases, at least one.
    pub atlases: Vec<AtlasPlan>,
    /// How the picture of slices side by side looks.
    pub look: Look,
    /// The text, with line ends as Unix has them, so that a checkout on any system makes the same atlas.
    pub text: String,
}

/// One atlas of a recipe.
#[derive(Clone)]
pub struct AtlasPlan {
    /// The file's stem: small letters, digits and hyphens.
    pub name: String,
    /// The family: the recipe's, unless the atlas has its own.
    pub family: &'static dyn Family,
    /// The scalars to store, in the recipe's order: indices into [`crate::family::About::scalars`].
    pub scalars: Vec<usize>,
    /// What the axes are.
    pub chart: &'static Chart,
    /// The nodes, or the edges of cells. Whether nodes lie in the family's domain, [`Family::table`] says.
    pub grid: Grid,
    /// Most bytes of a file of cells; `None` for nodes.
    pub cells: Option<u64>,
    /// The pictures to draw.
    pub pictures: Vec<PicturePlan>,
}

/// One picture of an atlas.
#[derive(Debug, Clone, PartialEq)]
pub struct PicturePlan {
    /// A slice, or several side by side.
    pub kind: PictureKind,
    /// The horizontal axis, an index into the grid's axes.
    pub x: usize,
    /// The vertical axis.
    pub y: usize,
    /// The other axes, slowest first, each with the nodes to show, increasing: just one on a slice.
    pub at: Vec<(usize, Vec<usize>)>,
    /// Flags to fill, each over those before: indices into [`crate::family::About::flags`]. Empty: the family's own
    /// choice.
    pub regions: Vec<usize>,
    /// Flags to draw as outlines, where `regions` are chosen.
    pub outlines: Vec<usize>,
    /// Levels of a scalar to fill, in place of flags; on slices and multiples only.
    pub levels: Option<Levels>,
    /// Points to mark; on slices and unions only.
    pub marks: Vec<Mark>,
    /// How it looks.
    pub look: Look,
}

/// How many slices a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureKind {
    /// One.
    Slice,
    /// One, of what is true at any combination of the other axes' chosen nodes.
    Union,
    /// One for each combination of the other axes' chosen nodes.
    Multiples,
    /// One: where the family has a `SPIRAL`, where another of the same axes has, and where both have.
    Compare {
        /// Name of the other family.
        with: &'static str,
    },
}

/// Regions where a scalar is at most so much.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    /// The scalar, which the atlas stores.
    pub field: &'static str,
    /// The levels, increasing.
    pub values: Vec<f64>,
}

/// A point marked on a slice.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Coordinate on the horizontal axis, within the axis.
    pub x: f64,
    /// Coordinate on the vertical axis, within the axis.
    pub y: f64,
    /// The words beside it.
    pub label: String,
}
