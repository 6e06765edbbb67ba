//! The segment of a shape, in the frame of the family: r = 1, from (0, 0) along (1, 0).

use super::Kind;
use crate::curve::vector::{Vector, add, length as size, scale, turn};
use crate::curve::{PhQuintic, arc_length};

/// Arc length over r: by the formula for a PH quintic, else to 1e-13 relative.
pub(super) fn length(kind: Kind, case: u8, theta: f64, m: f64, q: f64) -> f64 {
    match (kind, &legs(kind, case, theta, m, q)[..]) {
        (Kind::Cubic, [a, b, c]) => {
            let speed = |t: f64| {
                let (s, t) = (1.0 - t, t);
                size(scale(add(scale(*a, s * s), add(scale(*b, 2.0 * s * t), scale(*c, t * t))), 3.0))
            };
            arc_length(speed, 0.0, 1.0)
        }
        _ => PhQuintic::new([0.0, 0.0], preimage(case, theta, m, q)).length(),
    }
}

/// The sides of the control polygon for r = 1.
pub(crate) fn legs(kind: Kind, case: u8, theta: f64, m: f64, q: f64) -> Vec<Vector> {
    let (s, c) = theta.sin_cos();
    match kind {
        Kind::Cubic => {
            // The round end's leg is d = q; curvature 1 makes the middle one d²/(2 sin θ), the flat one m times that.
            let middle = q * q / (2.0 * s);
            let lengths = [m * middle, middle, q].map(|d| d / 3.0);
            match case {
                1 => vec![[lengths[0], 0.0], [lengths[1], 0.0], scale([c, s], lengths[2])],
                _ => vec![[lengths[2], 0.0], scale([c, s], lengths[1]), scale([c, s], lengths[0])],
            }
        }
        Kind::Ph => {
            let [a, b, c] = preimage(case, theta, m, q);
            let middle = scale(add(scale(turn(b, b), 2.0), turn(a, c)), 1.0 / 3.0);
            [turn(a, a), turn(a, b), middle, turn(b, c), turn(c, c)].map(|leg| scale(leg, 0.2)).to_vec()
        }
    }
}

/// Bernstein coefficients of the PH quintic's pre-image for r = 1.
pub(crate) fn preimage(case: u8, theta: f64, m: f64, q: f64) -> [Vector; 3] {
    let (sh, ch) = (0.5 * theta).sin_cos();
    let round = q.sqrt();
    let middle = q * round / (4.0 * sh);
    let tilted = |f: f64| [f * ch, f * sh];
    match case {
        1 => [[m * middle, 0.0], [middle, 0.0], tilted(round)],
        _ => [[round, 0.0], tilted(middle), tilted(m * middle)],
    }
}
