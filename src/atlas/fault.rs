//! Values that no atlas may hold. The writer refuses them; the full check of a file looks for them.

/// Finds a byte with a bit that has no name.
pub(super) fn bits(field: &str, bytes: &[u8], named: u8) -> Result<(), String> {
    match bytes.iter().position(|b| b & !named != 0) {
        None => Ok(()),
        Some(i) => Err(format!("`{field}` entry {i} is {:#04x}, with bits beyond {named:#04x}", bytes[i])),
    }
}

/// Finds a scalar that is NaN or infinite.
pub(super) fn finite(field: &str, values: &[f32]) -> Result<(), String> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(i) => Err(format!("`{field}` entry {i} is {}; all must be finite", values[i])),
    }
}
