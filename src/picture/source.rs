//! What a picture is drawn of.

use crate::atlas::{About, Atlas, Outline};
use crate::error::{Error, Result};
use crate::family::Family;
use crate::grid::Grid;
use crate::recipe::PicturePlan;
use std::collections::BTreeMap;

/// Fields at the nodes of a grid, or at those of them that a picture shows.
pub trait Source {
    /// What the atlas says about itself.
    fn about(&self) -> &About;
    /// All nodes of the atlas.
    fn grid(&self) -> &Grid;
    /// The `flags` of a node; `None` where it is not there.
    fn flags(&self, index: &[usize]) -> Option<u8>;
    /// A scalar of a node; `None` where the node or the scalar is not there.
    fn scalar(&self, name: &str, index: &[usize]) -> Option<f32>;
}

impl Source for Atlas {
    fn about(&self) -> &About {
        self.about()
    }

    fn grid(&self) -> &Grid {
        self.grid()
    }

    fn flags(&self, index: &[usize]) -> Option<u8> {
        Some(self.at(index)?.flags)
    }

    fn scalar(&self, name: &str, index: &[usize]) -> Option<f32> {
        self.scalar(name)?.get(self.grid().flat(index)? as usize).copied()
    }
}

/// What is drawn: the nodes of an atlas or, to look for room before there is one, a grid without anything known of its
/// nodes; then masks are empty.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub name: &'a str,
    pub family: &'static dyn Family,
    pub grid: &'a Grid,
    pub atlas: Option<&'a dyn Source>,
}

impl<'a> Subject<'a> {
    /// # Errors
    /// [`Error::Domain`] for a family that this program does not have.
    pub(super) fn of(atlas: &'a dyn Source) -> Result<Subject<'a>> {
        Ok(Subject {
            name: &atlas.about().name,
            family: atlas.about().family()?,
            grid: atlas.grid(),
            atlas: Some(atlas),
        })
    }
}

/// The chosen nodes of each axis of an atlas, with the fields of their products: no more than a picture needs.
pub struct Part<'a> {
    outline: &'a Outline,
    nodes: &'a [Vec<usize>],
    flags: &'a [u8],
    scalars: BTreeMap<&'a str, &'a [f32]>,
}

impl<'a> Part<'a> {
    /// A part of an atlas.
    ///
    /// # Arguments
    /// - `nodes`: for each axis the chosen nodes, increasing; [`shown`] gives those of a picture.
    /// - `flags`, `scalars`: the fields of all combinations of them, the last axis fastest.
    ///
    /// # Errors
    /// [`Error::Domain`] when the nodes are not of the grid, or a field has another length than they ask for.
    pub fn new(
        outline: &'a Outline,
        nodes: &'a [Vec<usize>],
        flags: &'a [u8],
        scalars: BTreeMap<&'a str, &'a [f32]>,
    ) -> Result<Part<'a>> {
        let count = outline.grid().pick(nodes)?.len();
        let lengths = scalars.iter().map(|(name, values)| (*name, values.len())).chain([("flags", flags.len())]);
        match lengths.into_iter().find(|(_, length)| *length as u64 != count) {
            None => Ok(Part { outline, nodes, flags, scalars }),
            Some((name, length)) => {
                Err(Error::invalid(format!("`{name}` has {length} values; the chosen nodes are {count}")))
            }
        }
    }

    fn place(&self, index: &[usize]) -> Option<usize> {
        let axes = self.nodes.iter().zip(index);
        axes.into_iter().try_fold(0, |flat, (nodes, i)| Some(flat * nodes.len() + nodes.binary_search(i).ok()?))
    }
}

impl Source for Part<'_> {
    fn about(&self) -> &About {
        self.outline.about()
    }

    fn grid(&self) -> &Grid {
        self.outline.grid()
    }

    fn flags(&self, index: &[usize]) -> Option<u8> {
        self.flags.get(self.place(index)?).copied()
    }

    fn scalar(&self, name: &str, index: &[usize]) -> Option<f32> {
        self.scalars.get(name)?.get(self.place(index)?).copied()
    }
}

/// The nodes of each axis that a picture shows, for [`Part`].
pub fn shown(grid: &Grid, plan: &PicturePlan) -> Vec<Vec<usize>> {
    let mut nodes: Vec<Vec<usize>> = grid.shape().into_iter().map(|count| (0..count).collect()).collect();
    for (axis, chosen) in &plan.at {
        nodes[*axis].clone_from(chosen);
    }
    nodes
}
