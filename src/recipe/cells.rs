//! What a recipe says of cells.

use super::raw::{Fault, RawAtlas, RawPicture, unknown};
use toml::Spanned;

/// Cells of an atlas.
#[derive(Clone, Copy)]
pub(super) struct CellsPlan {
    pub resolution: usize,
    pub budget: u64,
}

/// The most that a budget may be: places in the file are words of 32 bits.
const MOST: u64 = 8 << 30;

/// The cells of an atlas; `None` for one of nodes.
pub(super) fn cells(raw: &RawAtlas) -> Result<Option<CellsPlan>, Fault> {
    let kind = raw.kind.as_ref().map_or("nodes", |kind| kind.get_ref());
    match (kind, &raw.resolution, &raw.budget) {
        ("nodes", None, None) => Ok(None),
        ("nodes", Some(key), _) => {
            Err(Fault::new(key.span(), "`resolution` belongs to an atlas with `kind = \"cells\"`"))
        }
        ("nodes", _, Some(key)) => Err(Fault::new(key.span(), "`budget` belongs to an atlas with `kind = \"cells\"`")),
        ("cells", Some(resolution), Some(budget)) => {
            let cells = *resolution.get_ref();
            if !cells.is_power_of_two() || !(2..=2048).contains(&cells) {
                let what = format!("`resolution` is {cells}; it must be a power of two from 2 to 2048");
                return Err(Fault::new(resolution.span(), what));
            }
            Ok(Some(CellsPlan { resolution: cells as usize, budget: bytes(budget)? }))
        }
        ("cells", ..) => Err(Fault::new(raw.name.span(), "an atlas of cells needs `resolution` and `budget`")),
        (other, ..) => {
            let at = raw.kind.as_ref().map_or(raw.name.span(), Spanned::span);
            Err(Fault::new(at, unknown("kind of atlas", other, &["nodes", "cells"])))
        }
    }
}

/// A size such as `32 MiB`.
fn bytes(text: &Spanned<String>) -> Result<u64, Fault> {
    let units = [("KiB", 1u64 << 10), ("MiB", 1 << 20), ("GiB", 1 << 30)];
    let given = text.get_ref().trim();
    let size = units.iter().find_map(|(unit, bytes)| {
        let number: f64 = given.strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * *bytes as f64)
    });
    match size {
        Some(size) if (1.0..=MOST as f64).contains(&size) => Ok(size as u64),
        _ => {
            let what =
                format!("`budget` is {given:?}; it must be a size such as \"32 MiB\", in KiB, MiB or GiB, up to 8 GiB");
            Err(Fault::new(text.span(), what))
        }
    }
}

/// A picture of cells is a slice of flags.
pub(super) fn check_picture(raw: &RawPicture) -> Result<(), Fault> {
    match (&raw.kind.get_ref()[..], &raw.field) {
        ("slice", None) => Ok(()),
        ("slice", Some(field)) => Err(Fault::new(field.span(), "cells have no scalars")),
        _ => Err(Fault::new(raw.kind.span(), "a picture of cells is of the kind `slice`")),
    }
}
