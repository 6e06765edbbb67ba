//! Levels of a scalar, which a picture fills in place of flags.

use super::plan::{Levels, PictureKind};
use super::raw::{Fault, RawPicture, unknown};
use crate::family::Family;

/// What the levels of a picture are.
pub(super) const LEVELS_RULE: &str = "a list of increasing numbers such as `[0.5, 1]`";

/// Levels of a stored scalar.
pub(super) fn levels(
    raw: &RawPicture,
    kind: PictureKind,
    family: &dyn Family,
    stored: &[usize],
) -> Result<Option<Levels>, Fault> {
    let (field, values) = match (&raw.field, &raw.levels) {
        (None, None) => return Ok(None),
        (Some(field), Some(values)) => (field, values),
        (Some(field), None) => return Err(Fault::new(field.span(), "`field` goes with `levels`; say which to fill")),
        (None, Some(values)) => return Err(Fault::new(values.span(), "`levels` go with `field`; say of which scalar")),
    };
    let known: Vec<&'static str> = stored.iter().map(|i| family.about().scalars[*i].name).collect();
    let name = known.iter().find(|name| *name == field.get_ref());
    let name = name.ok_or_else(|| Fault::new(field.span(), unknown("field of this atlas", field.get_ref(), &known)))?;
    let rising =
        values.get_ref().windows(2).all(|pair| pair[0] < pair[1]) && values.get_ref().iter().all(|x| x.is_finite());
    if values.get_ref().is_empty() || !rising {
        return Err(Fault::new(values.span(), "the levels must be finite and increase"));
    }
    if !matches!(kind, PictureKind::Slice | PictureKind::Multiples) || !raw.regions.is_empty() {
        return Err(Fault::new(field.span(), "levels of a scalar fill a slice or multiples, without `regions`"));
    }
    Ok(Some(Levels { field: name, values: values.get_ref().clone() }))
}
