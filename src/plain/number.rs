//! Numbers as they are written.

use crate::error::{Domain, Error, Result};

/// Reads a number.
///
/// # Errors
/// [`Error::Domain`] when it is none, with what to write where it has a decimal comma.
pub fn parse_number(text: &str) -> Result<f64> {
    let trimmed = text.trim();
    trimmed.parse().map_err(|_| {
        let point = trimmed.replacen(',', ".", 1);
        let instead = (point != trimmed && point.parse::<f64>().is_ok()).then_some(point);
        Error::Domain(Domain::NoNumber { text: text.into(), instead })
    })
}

/// Reads a curvature: a number, or that of a radius, `1/250`: the quotient of two numbers, rounded once.
///
/// # Errors
/// [`Error::Domain`] when it is neither.
///
/// ```
/// use spiral_atlas::recipe::parse_curvature;
/// assert_eq!(parse_curvature("1/250")?, 0.004);
/// assert_eq!(parse_curvature("-1/3")?, -1.0 / 3.0);
/// assert!(parse_curvature("0,004").unwrap_err().to_string().contains("write 0.004, with a point"));
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn parse_curvature(text: &str) -> Result<f64> {
    match text.split_once('/') {
        Some((above, below)) => Ok(parse_number(above)? / parse_number(below)?),
        None => parse_number(text),
    }
}
