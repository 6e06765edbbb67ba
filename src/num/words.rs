//! Numbers in messages.

/// A number as a reader writes it: all its digits, no `.0`, and the scientific form from 1e16 on and below 1e-5, so
/// that never a row of zeros stands in a sentence.
pub fn told(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_messages_are_short() {
        assert_eq!(
            [2.0, 0.25, -0.0, 5e-324, 1.5e300, -1e-310].map(told),
            ["2", "0.25", "-0", "5e-324", "1.5e300", "-1e-310"]
        );
    }
}
