//! Data to judge: a seeded generator and the places where verdicts are hard.

use super::Ends;
pub(crate) use super::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// Angles and end conditions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Case {
    pub phi0: f64,
    pub phi1: f64,
    pub ends: Ends,
}

impl Random {
    /// Ten to a uniform exponent.
    pub(crate) fn decades(&mut self, lo: f64, hi: f64) -> f64 {
        10f64.powf(self.uniform(lo, hi))
    }

    /// A few units in the last place away, mostly within `most`.
    pub(crate) fn nudge(&mut self, x: f64, most: u64) -> f64 {
        let steps = self.below(2 * most + 1) as i64 - most as i64;
        f64::from_bits(x.to_bits().wrapping_add_signed(steps))
    }

    /// Angles with `φ0 + φ1 < π`, usually ordered, in one of several windows.
    pub(crate) fn angles(&mut self) -> (f64, f64) {
        let (a, b) = match self.below(4) {
            0 => (self.uniform(0.01, FRAC_PI_2), self.uniform(0.01, FRAC_PI_2)),
            1 => (self.uniform(0.01, 0.6), self.uniform(FRAC_PI_2, 2.5)),
            2 => (self.uniform(0.6, 0.9), self.uniform(0.7, 1.5)),
            _ => (self.uniform(0.001, 3.1), self.uniform(0.001, 3.1)),
        };
        if a + b >= PI - 1e-9 {
            return self.angles();
        }
        if a > b && self.below(8) > 0 { (b, a) } else { (a, b) }
    }
}

/// The curvatures of the curve with these ends and this `(f0, f1)`, in doubles.
pub(crate) fn curvatures(phi0: f64, phi1: f64, f0: f64, f1: f64) -> Ends {
    let sum = (phi0 + phi1).sin();
    let (d0, d1) = (2.0 * phi1.sin() / sum, 2.0 * phi0.sin() / sum);
    Ends::Curvature {
        kappa0: 4.0 * (3.0 - f1) * phi0.sin() / (f0 * d0).powi(2),
        kappa1: 4.0 * (3.0 - f0) * phi1.sin() / (f1 * d1).powi(2),
    }
}

/// The normalised ends `(a, k)` of `(f0, f1)`, in doubles.
pub(crate) fn normalised(f0: f64, f1: f64) -> Ends {
    Ends::Normalised { a: (3.0 - f1) / (f0 * f0), k: (3.0 - f0) / (f1 * f1) }
}

/// Uniform data in windows around the paper's figures and far outside them.
pub(crate) fn windows(r: &mut Random) -> Case {
    let (phi0, phi1) = r.angles();
    let ends = match r.below(4) {
        0 => Ends::Curvature { kappa0: r.uniform(0.0, 1.2), kappa1: r.uniform(0.0, 12.0) },
        1 => Ends::Curvature { kappa0: r.decades(-4.0, 2.0), kappa1: r.decades(-2.0, 4.0) },
        2 => Ends::Curvature { kappa0: r.uniform(-2.0, 1.0), kappa1: r.uniform(-1.0, 6.0) },
        _ => Ends::Curvature { kappa0: r.uniform(0.0, phi0.sin()), kappa1: phi1.sin() * r.decades(-0.5, 1.5) },
    };
    Case { phi0, phi1, ends }
}

/// Data of a curve drawn by its `(f0, f1)`: spirals are common, and so are `k <= 1/3` and several roots.
pub(crate) fn drawn(r: &mut Random) -> Case {
    let (phi0, phi1) = r.angles();
    let (f0, f1) = match r.below(3) {
        0 => (r.uniform(0.0, 3.0), r.uniform(0.0, 3.0)),
        1 => (r.uniform(1.0, 3.0), r.uniform(0.3, 2.2)),
        // Near the line of double roots two roots of three are close.
        _ => {
            let f0 = r.uniform(0.2, 2.95);
            (f0, (4.0 * (3.0 - f0) / (4.0 - f0) * (1.0 + r.uniform(-0.3, 0.3))).min(2.999))
        }
    };
    let ends = if r.below(4) == 0 { normalised(f0, f1) } else { curvatures(phi0, phi1, f0, f1) };
    Case { phi0, phi1, ends }
}

/// Two roots that almost or just not merge: `4 (3 - f0) (3 - f1) = f0 f1`, then a few units in the last place.
pub(crate) fn near_double(r: &mut Random) -> Case {
    let (phi0, phi1) = r.angles();
    let f0 = r.uniform(0.05, 2.98);
    let f1 = 4.0 * (3.0 - f0) / (4.0 - f0);
    let near = [0, 1, 3, 1 << 10, 1 << 30][r.below(5) as usize];
    let ends = match if r.below(2) == 0 { normalised(f0, f1) } else { curvatures(phi0, phi1, f0, f1) } {
        Ends::Normalised { a, k } => Ends::Normalised { a: r.nudge(a, near), k: r.nudge(k, near) },
        Ends::Curvature { kappa0, kappa1 } => {
            Ends::Curvature { kappa0: r.nudge(kappa0, near), kappa1: r.nudge(kappa1, near) }
        }
    };
    Case { phi0, phi1, ends }
}

/// Around `a = k = 1/4`, the one exact tie that doubles have: there three roots are one, and the curve is a parabola.
pub(crate) fn triple(r: &mut Random) -> Case {
    let equal = r.uniform(0.01, 1.5);
    let (phi0, phi1) = if r.below(6) == 0 { (equal, equal) } else { r.angles() };
    let near = [0, 1, 2, 8, 1 << 20, 1 << 40][r.below(6) as usize];
    let ends = match r.below(4) {
        0 => Ends::Normalised { a: 0.25, k: r.nudge(0.25, near) },
        1 => Ends::Normalised { a: r.nudge(0.25, near), k: 0.25 },
        2 => {
            let a = r.nudge(0.25, near);
            Ends::Normalised { a, k: a }
        }
        _ => Ends::Normalised { a: r.nudge(0.25, near), k: r.nudge(0.25, near) },
    };
    Case { phi0, phi1, ends }
}

/// Angles at the rim of their domain: tiny, equal but for the last bits, at right angles, adding up to π.
pub(crate) fn rim_angles(r: &mut Random) -> (f64, f64) {
    let plain = r.uniform(0.05, 1.5);
    let (a, b) = match r.below(7) {
        0 => (r.decades(-300.0, 0.0), plain),
        1 => (plain, r.decades(-300.0, 0.0)),
        2 => (r.decades(-300.0, -1.0), r.decades(-300.0, -1.0)),
        3 => (plain, r.nudge(plain, 4)),
        4 => {
            let tiny = r.decades(-300.0, -3.0);
            (tiny, r.nudge(tiny, 3))
        }
        5 => (plain, r.nudge(FRAC_PI_2, 3)),
        _ => {
            let near = [2, 40, 1 << 30][r.below(3) as usize];
            (plain, r.nudge(PI - plain, near))
        }
    };
    if super::in_domain(a, b) { (a, b) } else { rim_angles(r) }
}

/// Curvatures from 1e-300 to 1e300, and curvatures that make sense, at ordinary and at rim angles.
pub(crate) fn extreme(r: &mut Random) -> Case {
    let huge = r.below(2) == 0;
    let (phi0, phi1) = if huge && r.below(2) == 0 { r.angles() } else { rim_angles(r) };
    let sign = |r: &mut Random| if r.below(8) == 0 { -1.0 } else { 1.0 };
    let reach = |r: &mut Random| if r.below(2) == 0 { r.decades(-300.0, 300.0) } else { r.decades(-3.0, 3.0) };
    let made = curvatures(phi0, phi1, r.uniform(0.0, 3.0), r.uniform(0.0, 3.0));
    let ends = match made {
        Ends::Curvature { kappa0, kappa1 } if !huge && kappa0.is_finite() && kappa1.is_finite() => made,
        _ if r.below(4) == 0 => Ends::Normalised { a: sign(r) * reach(r), k: sign(r) * reach(r) },
        _ => Ends::Curvature { kappa0: sign(r) * reach(r), kappa1: sign(r) * reach(r) },
    };
    Case { phi0, phi1, ends }
}
