//! The numbers of a path whose pieces have monotone curvature.

use super::super::piece::{Arc, Piece, of_legs};
use crate::curve::{Jet, gauss};
use serde::Serialize;

/// Steps of a piece between which the greatest rate is bracketed.
const STEPS: usize = 32;
/// Golden sections of a bracket: they leave 1/40,000 of it.
const SECTIONS: usize = 22;
/// What each leaves of it.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// Curvatures of control points, relative to the limit.
const ROUNDING: f64 = 1e-12;
/// The curvature of a straight end, relative to the limit: a few roundings of control points at the origin.
const NOISE: f64 = 4.0 * f64::EPSILON;

/// What there is to know of a path, in the user's units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measures {
    /// Arc length.
    pub length: f64,
    /// Greatest |κ|; as the curvature of each piece is monotone, it is at an end of one. A rounding beyond the limit
    /// counts as the limit, for which the piece was made.
    pub greatest_curvature: f64,
    /// Least and greatest signed curvature.
    pub curvature_range: [f64; 2],
    /// Least and greatest dκ/ds inside the pieces, 1 / length².
    ///
    /// Found from 32 steps of each spiral and by narrowing around the best: to 1e-9 relative where the rate has one
    /// extremum in a step.
    pub rate_range: [f64; 2],
    /// ∫ κ² ds, to 1e-10 relative.
    pub bending_energy: f64,
}

/// The curvature of a piece's end, where a rounding of a straight one is 0.
pub(super) fn without_noise(curvature: f64, limit: f64) -> f64 {
    if curvature.abs() <= limit * NOISE { 0.0 } else { curvature }
}

/// Least and greatest signed curvature.
fn curvature_range(pieces: &[Piece], limit: f64) -> [f64; 2] {
    let within = |k: f64| match without_noise(k, limit) {
        0.0 => 0.0,
        k if k.abs() <= limit * (1.0 + ROUNDING) => k.clamp(-limit, limit),
        k => k,
    };
    let curvature = |piece: &Piece, t: f64| jet(piece, t).map_or_else(|| piece.at(t).curvature, |jet| jet.curvature());
    let curvatures = pieces.iter().flat_map(|p| p.range().map(|t| within(curvature(p, t))));
    curvatures.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], k| [low.min(k), high.max(k)])
}

/// Greatest |κ|.
pub(super) fn greatest_curvature(pieces: &[Piece], limit: f64) -> f64 {
    greatest(curvature_range(pieces, limit))
}

/// Greatest |dκ/ds|.
pub(super) fn greatest_rate(pieces: &[Piece]) -> f64 {
    greatest(rates(pieces))
}

/// ∫ κ² ds.
pub(super) fn bending_energy(pieces: &[Piece]) -> f64 {
    pieces.iter().map(energy).sum()
}

/// Least and greatest dκ/ds.
fn rates(pieces: &[Piece]) -> [f64; 2] {
    pieces.iter().map(rate_range).fold([0.0f64, 0.0], |[low, high], rates| [low.min(rates[0]), high.max(rates[1])])
}

/// The size of the greater end of a range about 0.
fn greatest([low, high]: [f64; 2]) -> f64 {
    high.max(-low)
}

impl Measures {
    pub(super) fn of(pieces: &[Piece], length: f64, limit: f64) -> Measures {
        let range = curvature_range(pieces, limit);
        Measures {
            length,
            greatest_curvature: greatest(range),
            curvature_range: range,
            rate_range: rates(pieces),
            bending_energy: bending_energy(pieces),
        }
    }

    /// Greatest |dκ/ds|.
    pub fn greatest_rate(&self) -> f64 {
        greatest(self.rate_range)
    }
}

fn energy(piece: &Piece) -> f64 {
    match piece {
        Piece::Line(_) => 0.0,
        Piece::Arc(Arc { curvature, length, .. }) => curvature * curvature * length,
        Piece::Clothoid(clothoid) => clothoid.bending_energy(),
        Piece::PhQuintic(curve) => curve.bending_energy(),
        Piece::Involute(between) => {
            piece.length() * integral(|share| piece.at(between.parameter_at(share)).curvature.powi(2), [0.0, 1.0])
        }
        Piece::Cubic(_) | Piece::TrigQuintic(_) => {
            let square = |t: f64| jet(piece, t).map_or(0.0, |jet| jet.curvature().powi(2) * jet.speed());
            integral(square, piece.range())
        }
    }
}

/// Over four parts: curvature close to 0 has few digits, and no rule that halves until they agree would end.
fn integral(f: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    let at = |i: i32| from + (to - from) * 0.25 * f64::from(i);
    (0..4).map(|i| gauss(|t| [f(t)], at(i), at(i + 1))[0]).sum()
}

/// Derivatives of a polynomial or trigonometric piece.
fn jet(piece: &Piece, t: f64) -> Option<Jet> {
    match piece {
        Piece::Cubic(cubic) => Some(of_legs(&cubic.legs, t)),
        Piece::PhQuintic(curve) => Some(curve.jet(t)),
        Piece::TrigQuintic(part) => Some(part.curve.jet(t)),
        Piece::Involute(_) | Piece::Line(_) | Piece::Arc(_) | Piece::Clothoid(_) => None,
    }
}

/// dκ/ds at a share from 0 to 1 of a piece.
fn rate(piece: &Piece, share: f64) -> f64 {
    let [from, to] = piece.range();
    let t = from + share * (to - from);
    match piece {
        Piece::Line(_) | Piece::Arc(_) => 0.0,
        Piece::Clothoid(clothoid) => clothoid.rate(),
        Piece::Cubic(_) | Piece::PhQuintic(_) | Piece::TrigQuintic(_) => {
            jet(piece, t).map_or(0.0, |jet| jet.curvature_ds())
        }
        Piece::Involute(between) => between.rate_at_length(share),
    }
}

fn rate_range(piece: &Piece) -> [f64; 2] {
    if matches!(piece, Piece::Line(_) | Piece::Arc(_) | Piece::Clothoid(_)) {
        return [rate(piece, 0.0); 2];
    }
    let share = |i: usize| i as f64 / STEPS as f64;
    let rates: Vec<f64> = (0..=STEPS).map(|i| rate(piece, share(i))).collect();
    [-1.0, 1.0].map(|sign| {
        let best = (0..=STEPS).max_by(|i, j| (sign * rates[*i]).total_cmp(&(sign * rates[*j]))).unwrap_or(0);
        if best == 0 || best == STEPS {
            return rates[best];
        }
        let (mut low, mut high) = (share(best - 1), share(best + 1));
        let at = |share: f64| (share, sign * rate(piece, share));
        let (mut one, mut two) = (at(high - GOLDEN * (high - low)), at(low + GOLDEN * (high - low)));
        for _ in 0..SECTIONS {
            if one.1 < two.1 {
                low = one.0;
                (one, two) = (two, at(low + GOLDEN * (high - low)));
            } else {
                high = two.0;
                (one, two) = (at(high - GOLDEN * (high - low)), one);
            }
        }
        sign * (sign * rates[best]).max(sign * rate(piece, 0.5 * (low + high)))
    })
}

#[cfg(test)]
mod tests {
    use super::super::request::Family;
    use super::super::spiral::{Pose, Spiral};
    use super::*;

    /// The rates of a piece of each kind add up to the difference of its end curvatures, to the left and to the right,
    /// rising and falling.
    #[test]
    fn rates_add_up_to_the_difference_of_curvatures() {
        for family in Family::ALL {
            for [from, to] in [[0.1, 0.9], [0.9, 0.1], [-0.1, -0.9], [-0.9, -0.1]] {
                let start = Pose { at: [3.0, -1.0], direction: 2.0 };
                let spiral = Spiral { from, to, length: 0.5 };
                let (piece, _) = spiral.piece(family, start, 0.01).unwrap().unwrap();
                let [a, b] = piece.range();
                let speed = |t: f64| match piece {
                    Piece::Involute(_) => piece.length(),
                    _ => piece.at(t).speed,
                };
                let all = integral(|t| rate(&piece, (t - a) / (b - a)) * speed(t), [a, b]);
                assert!((all / (0.01 * (to - from)) - 1.0).abs() < 1e-10, "{family:?} {from} {to}: {all}");
            }
        }
    }
}
