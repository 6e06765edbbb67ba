//! Numbers and angles as readers of pictures and reports want them.

pub use crate::plot::{grouped, short};

/// An angle in degrees when it was written so, that is when these have at most three decimals; else in radians.
pub fn angle(x: f64) -> String {
    let degrees = x.to_degrees();
    let whole = (degrees * 1000.0).round() / 1000.0;
    if (degrees - whole).abs() < 1e-10 && (whole != 0.0 || x == 0.0) { short(whole) + "°" } else { short(x) }
}

/// Several angles in one unit: in degrees when all of them were written so, else in radians.
pub(super) fn angles(all: &[f64]) -> Vec<String> {
    let texts: Vec<String> = all.iter().map(|x| angle(*x)).collect();
    if texts.iter().all(|text| text.ends_with('°')) { texts } else { all.iter().map(|x| short(*x)).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_shown_as_they_were_written() {
        assert_eq!([45f64, -15.5, 0.0, 89.001].map(|x| angle(x.to_radians())), ["45°", "−15.5°", "0°", "89.001°"]);
        assert_eq!(angles(&[0.0, 45f64.to_radians()]), ["0°", "45°"]);
        assert_eq!(angles(&[0.0, 45f64.to_radians(), 0.3332]), ["0", "0.7854", "0.3332"]);
        assert_eq!([0.7, -1.4, 1.25e-5, 5e-324].map(angle), ["0.7", "−1.4", "1.25e−5", "4.941e−324"]);
    }
}
