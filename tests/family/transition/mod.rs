//! Curves, their placement in the user's plane, and the reasons why there is none.

mod answers;
mod by_hand;
mod half_turns;
mod ph;
mod pieces;
mod placement;
mod remedies;
mod segment;
mod sides;

use spiral_atlas::curve::CubicBezier;
use spiral_atlas::family::cubic::{Datum, Root};
use spiral_atlas::transition::{Answer, Ends, Placement};

const EPS: f64 = f64::EPSILON;

/// Roots (f0, f1) of `3 - y = a x²`, `3 - x = k y²` by scan and bisection: the simplest thing that can work, in
/// doubles.
fn roots(d: &Datum) -> Vec<Root> {
    let half = |sin: f64| sin / (d.phi0 + d.phi1).sin();
    let a = d.kappa0 * half(d.phi1.sin()).powi(2) / d.phi0.sin();
    let k = d.kappa1 * half(d.phi0.sin()).powi(2) / d.phi1.sin();
    let value = |x: f64| 3.0 - x - k * (3.0 - a * x * x).powi(2);
    let mut found = Vec::new();
    for i in 0..4000 {
        let (mut lo, mut hi) = (3.0 * f64::from(i) / 4000.0, 3.0 * f64::from(i + 1) / 4000.0);
        if (value(lo) > 0.0) == (value(hi) > 0.0) {
            continue;
        }
        while lo < 0.5 * (lo + hi) && 0.5 * (lo + hi) < hi {
            let middle = 0.5 * (lo + hi);
            if (value(middle) > 0.0) == (value(lo) > 0.0) { lo = middle } else { hi = middle }
        }
        let (f0, f1) = (lo, 3.0 - a * lo * lo);
        if 0.0 < f1 && f1 < 3.0 {
            let spiral = CubicBezier::from_ratios(d.phi0, d.phi1, f0, f1).curvature_extrema().is_empty();
            found.push(Root { f0, f1, theorem31: spiral, spiral, margin: if spiral { 0.1 } else { -0.1 } });
        }
    }
    found
}

fn answer(ends: &Ends) -> Answer {
    let (d, _) = Placement::normalise(ends).unwrap();
    let roots = roots(&d);
    Answer::from_roots(ends, &roots, roots.iter().find(|r| r.spiral)).unwrap()
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
