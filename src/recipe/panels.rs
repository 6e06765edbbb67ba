//! The nodes of the axes that a picture does not draw, and how many panels small multiples may have.

use super::plan::PictureKind;
use super::raw::{Fault, Numbers, RawPicture};
use crate::grid::{Axis, Grid, Lookup};
use std::ops::Range;

/// Most panels along an axis when the recipe does not choose them.
pub(super) const PANELS: usize = 6;
/// Most panels of a picture: 12 by 12, beyond which no label has room.
pub(super) const MOST_PANELS: usize = 144;

/// Refuses more panels than a picture has room for.
pub(super) fn check(picture: Range<usize>, grid: &Grid, at: &[(usize, Vec<usize>)]) -> Result<(), Fault> {
    let count = at.iter().fold(1usize, |count, (_, nodes)| count.saturating_mul(nodes.len()));
    if count <= MOST_PANELS {
        return Ok(());
    }
    let name = |axis: usize| grid.axes()[axis].name();
    let of: Vec<String> = at.iter().map(|(axis, nodes)| format!("{} of `{}`", nodes.len(), name(*axis))).collect();
    let most = at.iter().max_by_key(|(_, nodes)| nodes.len()).map_or("", |(axis, _)| name(*axis));
    let what = format!("the picture would have {count} panels: {}; it has room for {MOST_PANELS}", of.join(", "));
    Err(Fault::new(picture, format!("{what}. Choose fewer nodes, for example `at = {{ {most} = [.., ..] }}`")))
}

/// The nodes of an axis that is not drawn.
pub(super) fn nodes(raw: &RawPicture, kind: PictureKind, axis: &Axis) -> Result<Vec<usize>, Fault> {
    let (name, count) = (axis.name(), axis.values().len());
    let Some((_, given)) = raw.at.iter().find(|(key, _)| key.get_ref() == name) else {
        return match kind {
            PictureKind::Slice | PictureKind::Compare { .. } if count > 1 => Err(Fault::new(
                raw.kind.span(),
                format!("the slice leaves `{name}` open; say `at = {{ {name} = .. }}`"),
            )),
            PictureKind::Union => Ok((0..count).collect()),
            _ if count <= PANELS => Ok((0..count).collect()),
            _ => Ok((0..PANELS).map(|i| i * (count - 1) / (PANELS - 1)).collect()),
        };
    };
    let fail = |what: String| Fault::new(given.span(), what);
    let points = match (given.get_ref(), kind) {
        (Numbers::One(point), _) => std::slice::from_ref(point),
        (Numbers::Many(points), PictureKind::Multiples | PictureKind::Union) if !points.is_empty() => points,
        (Numbers::Many(_), PictureKind::Slice | PictureKind::Compare { .. }) => {
            return Err(fail(format!("a slice takes one value of `{name}`")));
        }
        (Numbers::Many(_), _) => return Err(fail(format!("`{name}` has an empty list"))),
    };
    let lookup = Lookup::new(axis);
    let mut nodes: Vec<usize> = Vec::new();
    for point in points {
        let point = point.on(name).map_err(fail)?;
        let Some(node) = lookup.nearest(point) else {
            let (first, last) = ends(axis);
            return Err(fail(format!("{name} = {point} lies outside the axis, which runs from {first} to {last}")));
        };
        if nodes.last().is_some_and(|last| *last >= node) {
            return Err(fail(format!(
                "the values of `{name}` must increase, from node to node of the axis; {point} does not"
            )));
        }
        nodes.push(node);
    }
    Ok(nodes)
}

/// The first and the last value of an axis.
pub(super) fn ends(axis: &Axis) -> (f64, f64) {
    let values = axis.values();
    (values[0], values[values.len() - 1])
}
