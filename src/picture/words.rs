//! Numbers and angles as readers of pictures and reports want them.

/// A number with its digits in groups of three.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let breaks = |i: usize| i > 0 && (digits.len() - i).is_multiple_of(3);
    digits.chars().enumerate().flat_map(|(i, c)| breaks(i).then_some(',').into_iter().chain([c])).collect()
}

/// A number with at most four decimals.
pub fn short(x: f64) -> String {
    let text = format!("{x:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

/// An angle in degrees when it was written so, that is when these have at most three decimals; else in radians.
pub fn angle(x: f64) -> String {
    let degrees = x.to_degrees();
    let whole = (degrees * 1000.0).round() / 1000.0;
    if (degrees - whole).abs() < 1e-10 { short(whole) + "°" } else { short(x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
    }

    #[test]
    fn angles_are_told_as_they_were_written() {
        assert_eq!([45f64, -15.5, 0.0, 89.001].map(|x| angle(x.to_radians())), ["45°", "−15.5°", "0°", "89.001°"]);
        assert_eq!([0.7, -1.4, 1e-5].map(angle), ["0.7", "−1.4", "0"]);
    }
}
