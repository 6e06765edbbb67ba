//! Atlas files, of nodes and of cells: what they say of themselves, and planes through them.

use serde::Deserialize;
use serde_json::{Value, json};
use spiral_atlas::atlas::{About, Atlas, Kind, kind_of};
use spiral_atlas::cells::Cells;
use spiral_atlas::family;
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};

/// An atlas file that is open.
pub(crate) enum File {
    Nodes(Atlas),
    Cells(Cells),
}

/// A plane that is asked for.
#[derive(Deserialize)]
pub(crate) struct Plane {
    /// The axes that are drawn.
    x: usize,
    y: usize,
    /// A place on each axis: the index of a node, or of a finest cell. Those of the drawn axes mean nothing.
    at: Vec<usize>,
}

impl File {
    /// Checks all bytes of a file.
    ///
    /// # Errors
    /// [`Error::Atlas`] where it is no valid atlas.
    pub(crate) fn open(bytes: &[u8]) -> Result<File> {
        match kind_of(bytes)? {
            Kind::Nodes => {
                let atlas = Atlas::from_bytes(bytes)?;
                atlas.check_hashes()?;
                Ok(File::Nodes(atlas))
            }
            Kind::Cells => {
                let cells = Cells::from_bytes(bytes)?;
                cells.check_hashes()?;
                Ok(File::Cells(cells))
            }
        }
    }

    fn grid(&self) -> &Grid {
        match self {
            File::Nodes(atlas) => atlas.grid(),
            File::Cells(cells) => cells.grid(),
        }
    }

    /// What it says of itself.
    pub(crate) fn about(&self) -> Value {
        let (about, kind): (&About, _) = match self {
            File::Nodes(atlas) => (atlas.about(), "nodes"),
            File::Cells(cells) => (cells.about(), "cells"),
        };
        let axis = |axis: &Axis| {
            let log = matches!(axis.spacing(), Spacing::Log { .. });
            json!({ "name": axis.name(), "values": axis.values(), "log": log })
        };
        let known = family::by_name(&about.family).ok();
        let label = |name: &str| {
            known.and_then(|f| f.about().flags.iter().find(|flag| flag.name == name)).map(|flag| flag.label)
        };
        let flags: Vec<Value> = about
            .flags
            .iter()
            .map(|f| json!({ "name": f.name, "doc": f.doc, "label": label(&f.name).unwrap_or(&f.name) }))
            .collect();
        let bit = |name: &&str| about.flags.iter().position(|flag| flag.name == *name);
        let nested: Vec<usize> =
            known.map_or(Vec::new(), |family| family.about().nested.iter().filter_map(bit).collect());
        json!({
            "kind": kind, "name": about.name, "family": about.family,
            "title": known.map(|f| f.about().title), "chart_doc": about.chart_doc,
            "generator": about.generator, "flags": flags, "nested": nested,
            "axes": self.grid().axes().iter().map(axis).collect::<Vec<_>>(),
        })
    }

    /// The verdicts on a plane, x fastest, from below: of nodes their flags; of cells what is INSIDE, and what is
    /// OUTSIDE.
    ///
    /// # Errors
    /// [`Error::Domain`] for axes and places that the file does not have.
    pub(crate) fn plane(&self, plane: &Plane) -> Result<Value> {
        let axes = self.grid().axes();
        let cells = usize::from(matches!(self, File::Cells(_)));
        let count = |axis: usize| axes.get(axis).map_or(0, |axis| (axis.values().len() - cells).max(1));
        let Plane { x, y, at } = plane;
        let fits = x != y && *x < axes.len() && *y < axes.len() && at.len() == axes.len();
        if !fits || at.iter().enumerate().any(|(axis, i)| axis != *x && axis != *y && *i >= count(axis)) {
            return Err(Error::invalid(format!("the file has no plane of the axes {x} and {y} at {at:?}")));
        }
        let mut at = at.clone();
        let (mut inside, mut outside) = (Vec::new(), Vec::new());
        for j in 0..count(*y) {
            for i in 0..count(*x) {
                (at[*x], at[*y]) = (i, j);
                match self {
                    File::Nodes(atlas) => inside.push(atlas.at(&at).map_or(0, |entry| entry.flags)),
                    File::Cells(cells) => {
                        let known = cells.lookup(&middle(axes, &at)).unwrap_or_default();
                        inside.push(known.inside);
                        outside.push(known.outside);
                    }
                }
            }
        }
        Ok(json!({ "width": count(*x), "height": count(*y), "inside": inside, "outside": outside }))
    }
}

/// A point inside a finest cell, or at an axis' single value.
fn middle(axes: &[Axis], at: &[usize]) -> Vec<f64> {
    let middle = |(axis, i): (&Axis, &usize)| match axis.values() {
        [only] => *only,
        edges => 0.5 * edges[*i] + 0.5 * edges[*i + 1],
    };
    axes.iter().zip(at).map(middle).collect()
}
