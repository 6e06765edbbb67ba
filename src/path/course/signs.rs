//! Where on a piece the curvature, or its slope, changes its sign.

use crate::curve::{CubicBezier, PhQuintic};
use crate::transition::{Cubic, Piece, TrigPart};

/// Parameters at which a trigonometric curve is looked at.
const LOOKS: usize = 256;
/// Numbers below this share of the largest have no sign: they are roundings.
const NOISE: f64 = 1e-9;
/// Halvings between two looks: then neighbouring doubles are left.
const HALVINGS: usize = 60;

/// Where a number changes its sign inside a piece, and numbers of the signs that it has beside both ends: 0 where it
/// has none.
#[derive(Debug)]
pub(super) struct Signs {
    pub inside: Vec<f64>,
    pub ends: [f64; 2],
}

/// The sign of the curvature's slope.
pub(super) fn slope(piece: &Piece) -> Signs {
    match piece {
        Piece::PhQuintic(curve) => Signs { inside: curve.curvature_extrema(), ends: rise(curve) },
        Piece::Cubic(cubic) => {
            let curve = near_origin(cubic);
            between([0.0, 1.0], curve.curvature_extrema(), |t| curve.jet(t).curvature_dt())
        }
        Piece::TrigQuintic(TrigPart { curve, from, to }) => sampled([*from, *to], |t| curve.jet(t).curvature_dt()),
        Piece::Involute(_) => {
            let [first, last] = [0.0, 1.0].map(|t| piece.at(t).curvature);
            Signs { inside: vec![], ends: [last - first; 2] }
        }
        Piece::Line(_) | Piece::Arc(_) => Signs { inside: vec![], ends: [0.0; 2] },
        Piece::Clothoid(clothoid) => Signs { inside: vec![], ends: [clothoid.rate(); 2] },
    }
}

/// The sign of the curvature.
pub(super) fn bend(piece: &Piece) -> Signs {
    match piece {
        Piece::PhQuintic(curve) => Signs { inside: curve.inflections(), ends: sides(curve) },
        Piece::Cubic(cubic) => {
            let curve = near_origin(cubic);
            between([0.0, 1.0], curve.inflections(), |t| curve.curvature(t))
        }
        Piece::TrigQuintic(TrigPart { curve, from, to }) => sampled([*from, *to], |t| curve.jet(t).curvature()),
        Piece::Involute(_) | Piece::Clothoid(_) => {
            let curvature = |t: f64| piece.at(t).curvature;
            let ends = [curvature(0.0), curvature(1.0)];
            let changes = opposite(ends[0], ends[1]);
            Signs { inside: if changes { vec![halved(curvature, 0.0, 1.0)] } else { vec![] }, ends }
        }
        Piece::Line(_) => Signs { inside: vec![], ends: [0.0; 2] },
        Piece::Arc(arc) => Signs { inside: vec![], ends: [arc.curvature; 2] },
    }
}

/// The largest curvature by size; NaN where the piece stands still.
pub(super) fn greatest_curvature(piece: &Piece) -> f64 {
    match piece {
        Piece::PhQuintic(curve) => {
            if curve.is_regular() {
                curve.greatest_curvature().1
            } else {
                f64::NAN
            }
        }
        _ => {
            let places = slope(piece).inside.into_iter().chain(piece.range());
            let sizes = places.map(|t| piece.at(t).curvature.abs());
            sizes.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
        }
    }
}

/// Numbers of the sign of the curvature's slope at both ends: `σh' - 2hσ'`.
fn rise(curve: &PhQuintic) -> [f64; 2] {
    let [first, .., last] = curve.slopes();
    [first, last]
}

/// Where the curvature is 0 at an end, within rounding, it has the sign of its slope there: none on a line.
fn sides(curve: &PhQuintic) -> [f64; 2] {
    let [h0, h1, h2] = curve.turn_coefficients();
    let none = 1e-12 * h0.abs().max(h1.abs()).max(h2.abs());
    [h0, h2].map(|h| if h.abs() <= none { h1 } else { h })
}

/// The same cubic from the origin, where its points are as exact as its sides.
fn near_origin(cubic: &Cubic) -> CubicBezier {
    let mut p = [[0.0; 2]; 4];
    for (i, leg) in cubic.legs.iter().enumerate() {
        p[i + 1] = [p[i][0] + leg[0], p[i][1] + leg[1]];
    }
    CubicBezier { p }
}

/// With the numbers in the middle of the first and of the last part, between which there is no change.
fn between([from, to]: [f64; 2], inside: Vec<f64>, f: impl Fn(f64) -> f64) -> Signs {
    let first = inside.first().copied().unwrap_or(to);
    let last = inside.last().copied().unwrap_or(from);
    Signs { ends: [f(0.5 * (from + first)), f(0.5 * (last + to))], inside }
}

/// Changes between looks. Both ends are left out: there the number is often 0.
fn sampled([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> Signs {
    let looks = (0..LOOKS).map(|i| from + (to - from) * ((i as f64 + 0.5) / LOOKS as f64));
    let all: Vec<(f64, f64)> = looks.map(|t| (t, f(t))).collect();
    let most = all.iter().fold(0.0f64, |most, (_, value)| most.max(value.abs()));
    let signed: Vec<(f64, f64)> = all.into_iter().filter(|(_, value)| value.abs() > NOISE * most).collect();
    let changes = signed.windows(2).filter(|w| opposite(w[0].1, w[1].1));
    let inside = changes.map(|w| halved(&f, w[0].0, w[1].0)).collect();
    let end = |at: Option<&(f64, f64)>| at.map_or(0.0, |(_, value)| *value);
    Signs { inside, ends: [end(signed.first()), end(signed.last())] }
}

/// Whether two numbers have opposite signs; 0 and NaN have none.
pub(super) fn opposite(a: f64, b: f64) -> bool {
    (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)
}

/// Where the sign changes between two parameters at which it differs.
fn halved(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let first = f(low);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if opposite(first, f(middle)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}
