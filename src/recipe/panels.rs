//! How many panels small multiples may have.

use super::raw::Fault;
use crate::grid::Grid;
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
