//! Angles as they are written.

use crate::error::{Error, Result, written};
use std::f64::consts::{PI, TAU};

/// Reads an angle: `40deg` or `40°`, `0.7rad`, or radians alone, `0.7`. Beyond a full turn the unit must be named.
///
/// # Returns
/// Radians; degrees are divided by 180 and then multiplied by π, each rounded once, so that `180deg` is π's double
/// itself.
///
/// # Errors
/// [`Error::Domain`] when it is no finite number with one of these units, or a number above 2π alone: degrees, most
/// likely.
///
/// ```
/// use spiral_atlas::recipe::parse_angle;
/// assert_eq!(parse_angle("90deg")?, std::f64::consts::FRAC_PI_2);
/// assert_eq!(parse_angle("0.7 rad")?, 0.7);
/// assert_eq!(parse_angle("40°")?, parse_angle("40deg")?);
/// assert!(parse_angle("40%").is_err() && parse_angle("40").is_err());
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn parse_angle(text: &str) -> Result<f64> {
    let trimmed = text.trim();
    let in_degrees = trimmed.strip_suffix("deg").or_else(|| trimmed.strip_suffix('°'));
    let (number, degrees) = match (in_degrees, trimmed.strip_suffix("rad")) {
        (Some(number), _) => (number, true),
        (None, Some(number)) => (number, false),
        (None, None) => (trimmed, false),
    };
    let unit = number.len() < trimmed.len();
    match number.trim_end().parse::<f64>() {
        Ok(value) if value.is_finite() && !unit && value.abs() > TAU => Err(Error::invalid(format!(
            "{text:?} is more than a full turn in radians; say which unit is meant: `{trimmed}deg` or `{trimmed}rad`"
        ))),
        Ok(value) if value.is_finite() => Ok(if degrees { value / 180.0 * PI } else { value }),
        _ => Err(Error::invalid(format!(
            "{text:?} is no angle; write radians such as `0.7`, or degrees such as `40deg` or `40°`"
        ))),
    }
}

/// Checks an angle that was given as a number of radians, as [`parse_angle`] does where there is no unit.
///
/// # Errors
/// [`Error::Domain`] when it is more than a full turn. What is not finite is for others to refuse, by its name.
pub fn bare_angle(radians: f64) -> Result<f64> {
    if !radians.is_finite() || radians.abs() <= TAU {
        return Ok(radians);
    }
    let number = written(radians);
    Err(Error::invalid(format!(
        "{number} is more than a full turn in radians; say which unit is meant: \"{number}deg\" or \"{number}rad\""
    )))
}
