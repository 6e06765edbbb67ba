//! What an atlas says about itself: the metadata of the file, key by key.

use crate::family::{self, Family, NO_VALUE, unpack};
use crate::grid::{Axis, Grid, Spacing};
use crate::plain;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashMap};

/// The version of the file format that this crate writes, and the only one that it reads.
pub const FORMAT_VERSION: u32 = 1;
const FORMAT: &str = "spiral-atlas";

/// What [`super::Writer::create`] must know.
#[derive(Clone, Copy)]
pub struct Spec<'a> {
    /// The atlas's name: letters, digits, `_` and `-`.
    pub name: &'a str,
    /// The family.
    pub family: &'static dyn Family,
    /// The nodes.
    pub grid: &'a Grid,
    /// The scalars to store: indices into [`family::About::scalars`].
    pub scalars: &'a [usize],
    /// The recipe's text.
    pub recipe: &'a str,
}

/// What the grid of a file is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Fields at the nodes.
    Nodes,
    /// Verdicts about the boxes between the nodes: [`crate::cells`].
    Cells,
}

/// The metadata `kind` of a file of cells; one of nodes has none.
const CELLS: &str = "cells";

/// What an atlas says about itself, apart from its grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct About {
    /// What the grid is about.
    pub kind: Kind,
    /// The program that wrote it, with its version.
    pub generator: String,
    /// The atlas's name in its recipe.
    pub name: String,
    /// The family's name.
    pub family: String,
    /// The chart's name.
    pub chart: String,
    /// What the chart's axes are, with units.
    pub chart_doc: String,
    /// Frame, signs and units.
    pub conventions: String,
    /// The bits of `flags`, bit 0 first.
    pub flags: Vec<Named>,
    /// The numbers packed in `solutions`.
    pub counts: Vec<Packed>,
    /// The scalar tensors, in file order.
    pub scalars: Vec<Named>,
    /// The recipe's text.
    pub recipe: String,
}

/// A name with what it means.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Named {
    /// The name.
    pub name: String,
    /// What it means.
    pub doc: String,
}

/// A number packed in the bits `shift .. shift + bits` of a `solutions` byte.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Packed {
    /// The number's name.
    pub name: String,
    /// What is counted.
    pub doc: String,
    /// Lowest bit.
    pub shift: u32,
    /// Number of bits.
    pub bits: u32,
}

impl Packed {
    /// Takes the number out of a `solutions` byte.
    pub fn of(&self, solutions: u8) -> u8 {
        unpack(solutions, self.shift, self.bits)
    }

    fn mask(&self) -> u8 {
        (0..8)
            .filter(|bit| (self.shift..self.shift.saturating_add(self.bits)).contains(bit))
            .fold(0, |m, bit| m | 1 << bit)
    }
}

/// An axis as the metadata has it; the ends and the count are those of its tensor.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct NamedAxis {
    pub name: String,
    spacing: SpacingKind,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SpacingKind {
    Linear,
    Log,
    Values,
}

impl NamedAxis {
    fn of(axis: &Axis) -> NamedAxis {
        let spacing = match axis.spacing() {
            Spacing::Linear { .. } => SpacingKind::Linear,
            Spacing::Log { .. } => SpacingKind::Log,
            Spacing::Values(_) => SpacingKind::Values,
        };
        NamedAxis { name: axis.name().to_owned(), spacing }
    }

    /// The axis with these values, if its spacing gives just them.
    pub(super) fn build(&self, values: Vec<f64>) -> Result<Axis, String> {
        let (Some(&lo), Some(&hi), count) = (values.first(), values.last(), values.len()) else {
            return Err(format!("the axis `{}` is empty", self.name));
        };
        let spacing = match self.spacing {
            SpacingKind::Linear => Spacing::Linear { lo, hi, count },
            SpacingKind::Log => Spacing::Log { lo, hi, count },
            SpacingKind::Values => Spacing::Values(values.clone()),
        };
        let axis = Axis::new(&self.name, spacing).map_err(|e| e.to_string())?;
        match axis.values().iter().zip(&values).position(|(a, b)| a.to_bits() != b.to_bits()) {
            None => Ok(axis),
            Some(i) => Err(format!(
                "value {i} of the axis `{}` is {:?}, not the {:?} of its {:?} spacing",
                self.name,
                values[i],
                axis.values()[i],
                self.spacing
            )),
        }
    }
}

impl About {
    /// Its family.
    ///
    /// # Errors
    /// [`crate::Error::Domain`] for one that this program does not have.
    pub fn family(&self) -> crate::Result<&'static dyn Family> {
        family::by_name(&self.family).map_err(|e| e.at(format!("the atlas `{}`", self.name)))
    }

    pub(crate) fn of(spec: &Spec) -> Result<About, String> {
        let names: Vec<&str> = spec.grid.axes().iter().map(Axis::name).collect();
        let family = spec.family;
        let chart = family.about().charts.iter().find(|c| c.axes == names).ok_or_else(|| {
            let known: Vec<String> = family.about().charts.iter().map(|c| format!("({})", c.axes.join(", "))).collect();
            format!(
                "the axes ({}) are no chart of `{}`; take {}",
                names.join(", "),
                family.about().name,
                known.join(" or ")
            )
        })?;
        let scalar = |i: &usize| {
            let known = family.about().scalars;
            let s = known
                .get(*i)
                .ok_or_else(|| format!("`{}` has {} scalars, no number {i}", family.about().name, known.len()))?;
            Ok(Named { name: s.name.into(), doc: s.doc.into() })
        };
        let count =
            |c: &crate::family::Count| Packed { name: c.name.into(), doc: c.doc.into(), shift: c.shift, bits: c.bits };
        Ok(About {
            kind: Kind::Nodes,
            generator: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).into(),
            name: spec.name.into(),
            family: family.about().name.into(),
            chart: chart.name.into(),
            chart_doc: chart.doc.into(),
            conventions: family.about().conventions.into(),
            flags: family.about().flags.iter().map(|f| Named { name: f.name.into(), doc: f.doc.into() }).collect(),
            counts: family.about().counts.iter().map(count).collect(),
            scalars: spec.scalars.iter().map(scalar).collect::<Result<_, String>>()?,
            recipe: spec.recipe.into(),
        })
    }

    /// The bits of `flags` that have names.
    pub(super) fn flag_bits(&self) -> u8 {
        (0..self.flags.len().min(8)).fold(0, |m, bit| m | 1 << bit)
    }

    /// The bits of `solutions` that belong to a count.
    pub(super) fn count_bits(&self) -> u8 {
        self.counts.iter().fold(0, |m, c| m | c.mask())
    }

    /// Whether the names and bits make sense.
    pub(super) fn check(&self) -> Result<(), String> {
        for (what, name) in [("atlas", &self.name), ("family", &self.family), ("chart", &self.chart)] {
            check_name(what, name)?;
        }
        if self.flags.len() > 8 {
            return Err(format!("it has {} flags; a byte holds 8", self.flags.len()));
        }
        let mut used = 0u8;
        for count in &self.counts {
            let mask = count.mask();
            if mask.count_ones() != count.bits || count.bits == 0 || used & mask != 0 {
                return Err(format!(
                    "the count `{}` takes {} bits from bit {}; it needs its own bits of a byte",
                    count.name, count.bits, count.shift
                ));
            }
            used |= mask;
        }
        check_names("flag", self.flags.iter().map(|f| &f.name))?;
        check_names("count", self.counts.iter().map(|c| &c.name))?;
        check_names("scalar", self.scalars.iter().map(|s| &s.name))
    }

    pub(super) fn to_map(&self, grid: &Grid) -> Result<BTreeMap<String, String>, String> {
        let axes: Vec<NamedAxis> = grid.axes().iter().map(NamedAxis::of).collect();
        let pairs = [
            ("format", FORMAT.to_owned()),
            ("format_version", FORMAT_VERSION.to_string()),
            ("generator", self.generator.clone()),
            ("name", self.name.clone()),
            ("family", self.family.clone()),
            ("chart", self.chart.clone()),
            ("chart_doc", self.chart_doc.clone()),
            ("conventions", self.conventions.clone()),
            ("axes", json(&axes)?),
            ("flags", json(&self.flags)?),
            ("counts", json(&self.counts)?),
            ("scalars", json(&self.scalars)?),
            ("no_value", format!("{NO_VALUE:e}")),
            ("recipe", self.recipe.clone()),
        ];
        let kind = (self.kind == Kind::Cells).then(|| ("kind", CELLS.to_owned()));
        Ok(pairs.into_iter().chain(kind).map(|(key, value)| (key.to_owned(), value)).collect())
    }

    /// The inverse of [`About::to_map`]; whoever calls it compares the keys that are not read here.
    pub(super) fn from_map(map: &HashMap<String, String>) -> Result<(About, Vec<NamedAxis>), String> {
        let text = |key: &str| map.get(key).cloned().ok_or_else(|| format!("its metadata lacks `{key}`"));
        let format = text("format")?;
        if format != FORMAT {
            return Err(format!("its format is {format:?}, not {FORMAT:?}"));
        }
        let version = text("format_version")?;
        if version != FORMAT_VERSION.to_string() {
            return Err(format!(
                "its format version is {version:?}; this program reads version {FORMAT_VERSION}, so write it anew from \
                 its recipe"
            ));
        }
        let kind = match map.get("kind").map(String::as_str) {
            None => Kind::Nodes,
            Some(CELLS) => Kind::Cells,
            Some(other) => return Err(format!("its kind is {other:?}; this program reads nodes and {CELLS:?}")),
        };
        let about = About {
            kind,
            generator: text("generator")?,
            name: text("name")?,
            family: text("family")?,
            chart: text("chart")?,
            chart_doc: text("chart_doc")?,
            conventions: text("conventions")?,
            flags: list("flags", &text("flags")?)?,
            counts: list("counts", &text("counts")?)?,
            scalars: list("scalars", &text("scalars")?)?,
            recipe: text("recipe")?,
        };
        Ok((about, list("axes", &text("axes")?)?))
    }
}

fn json<T: Serialize>(value: &T) -> Result<String, String> {
    serde_json::to_string(value).map_err(|e| e.to_string())
}

fn list<T: DeserializeOwned>(key: &str, text: &str) -> Result<Vec<T>, String> {
    serde_json::from_str(text).map_err(|e| format!("its metadata `{key}` cannot be read: {}", plain::json("", &e)))
}

/// Names are identifiers of at most 64 characters (atlas names may have hyphens), so that no reader trips over them.
pub(super) fn check_name(what: &str, name: &str) -> Result<(), String> {
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if plain && (1..=64).contains(&name.len()) {
        return Ok(());
    }
    let shown: String = name.chars().take(64).collect();
    Err(format!("the {what} name {shown:?} is not made of 1 to 64 letters, digits, `_` and `-`"))
}

fn check_names<'a>(what: &str, names: impl Iterator<Item = &'a String> + Clone) -> Result<(), String> {
    for (i, name) in names.clone().enumerate() {
        check_name(what, name)?;
        if names.clone().take(i).any(|other| other == name) {
            return Err(format!("two {what}s are named `{name}`"));
        }
    }
    Ok(())
}
