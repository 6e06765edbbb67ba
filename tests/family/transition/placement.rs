//! Normalisation and the way back.

use super::{EPS, answer, length, minus};
use proptest::prelude::*;
use spiral_atlas::curve::CubicBezier;
use spiral_atlas::family::cubic::Datum;
use spiral_atlas::transition::{Ends, Placement};
use std::f64::consts::PI;

/// `a - b` as an angle in [-π, π].
fn angle(a: f64, b: f64) -> f64 {
    (a - b).sin().atan2((a - b).cos())
}

/// How rounding of the control points (2 EPS of the largest distance P from the first) shows at an end: in the
/// direction `2 EPS P / |e0|`, and relatively in the curvature `(2/3) e0×e1 / |e0|³`: 3 times that, and by each factor
/// of the product `2 EPS P (1/|e0| + 1/|e1|) / sin(e0, e1)`. Returned for start and end as (direction, curvature).
fn rounding(p: &[[f64; 2]; 4]) -> [(f64, f64); 2] {
    let size = p.iter().map(|z| length(minus(*z, p[0]))).fold(0.0, f64::max);
    let of = |a: [f64; 2], b: [f64; 2]| {
        let sine = (a[0] / length(a) * b[1] / length(b) - a[1] / length(a) * b[0] / length(b)).abs();
        let direction = 2.0 * EPS * size / length(a);
        (direction, 3.0 * direction + (direction + 2.0 * EPS * size / length(b)) / sine + 16.0 * EPS)
    };
    let e = [minus(p[1], p[0]), minus(p[2], p[1]), minus(p[3], p[2])];
    [of(e[0], e[1]), of(e[2], e[1])]
}

/// A rigid motion with scale, mirror and reversal.
#[derive(Debug, Clone, Copy)]
struct Motion {
    size: f64,
    turn: f64,
    /// In sizes.
    shift: [f64; 2],
    mirror: bool,
    reverse: bool,
}

impl Motion {
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.turn.sin_cos();
        let y = if self.mirror { -y } else { y };
        [self.size * (cos * x - sin * y + self.shift[0]), self.size * (sin * x + cos * y + self.shift[1])]
    }

    fn direction(&self, angle: f64) -> f64 {
        self.turn + if self.mirror { -angle } else { angle } + if self.reverse { PI } else { 0.0 }
    }

    fn curvature(&self, kappa: f64) -> f64 {
        if self.mirror != self.reverse { -kappa / self.size } else { kappa / self.size }
    }

    /// End data of the moved curve, by differentiating it where it is best known, and its control points.
    fn ends(&self, unit: &CubicBezier) -> (Ends, [[f64; 2]; 4]) {
        let mut p = unit.p.map(|z| self.point(z));
        let mut jets = [unit.jet(0.0), unit.jet(1.0)];
        if self.reverse {
            p.reverse();
            jets.reverse();
        }
        let ends = Ends {
            start: p[0],
            end: p[3],
            start_direction: self.direction(jets[0].direction()),
            end_direction: self.direction(jets[1].direction()),
            start_curvature: self.curvature(jets[0].curvature()),
            end_curvature: self.curvature(jets[1].curvature()),
        };
        (ends, p)
    }
}

/// φ0, φ1, f0, f1.
type Shape = [f64; 4];

/// κ0, κ1 by (3.4): what differentiation must give, found without it.
fn end_curvatures([phi0, phi1, f0, f1]: Shape) -> [f64; 2] {
    let sum = (phi0 + phi1).sin();
    let one = |near: f64, far: f64, f: f64, g: f64| (3.0 - g) * near.sin() * (sum / (f * far.sin())).powi(2);
    [one(phi0, phi1, f0, f1), one(phi1, phi0, f1, f0)]
}

/// Normalises the moved curve and places it back; the errors in units of their tolerance. `spoil` may corrupt the ends,
/// `twist` the placement; the tolerances know of neither.
fn round_trip(
    shape: Shape,
    motion: &Motion,
    spoil: fn(&mut Ends),
    twist: fn(&mut Placement),
) -> Vec<(&'static str, f64)> {
    let unit = CubicBezier::from_ratios(shape[0], shape[1], shape[2], shape[3]);
    let (mut ends, want) = motion.ends(&unit);
    spoil(&mut ends);
    let (found, mut placement) = Placement::normalise(&ends).unwrap();
    twist(&mut placement);

    let mut data = end_curvatures(shape);
    let ([mut phi0, mut phi1, mut f0, mut f1], mut round) = (shape, rounding(&unit.p));
    let p = &unit.p;
    let mut sides = [length(minus(p[1], p[0])), length(minus(p[3], p[2]))];
    if data[0] > data[1] {
        (phi0, phi1, f0, f1) = (phi1, phi0, f1, f0);
        data.reverse();
        round.reverse();
        sides.reverse();
    }
    // Shift and size round the end points by 2 EPS (1 + shift) half chords each. Directions: two atan2 (2 EPS each),
    // sums with turn and π up to 4π (4 EPS each, and π's own error), reduction to [-π, π] (2 EPS), points (3 EPS),
    // difference (2 EPS).
    let far = 1.0 + length(motion.shift);
    let angles = [0, 1].map(|i| round[i].0 + (24.0 + 4.0 * far) * EPS);
    let sum = phi0 + phi1;
    let d_errors = |far: f64, i: usize| (angles[0] + angles[1]) / sum.tan().abs() + angles[1 - i] / far.tan().abs();
    let d = [d_errors(phi1, 0), d_errors(phi0, 1)];
    // (3.4) itself: three sines of relative error below EPS (1 + x |cot x|), squared; 3 - f within EPS.
    let formula = 8.0 * EPS * (1.0 + sum / sum.tan().abs());
    let curvature = [0, 1].map(|i| round[i].1 + formula + 4.0 * far * EPS);
    let mut errors = vec![
        ("phi0", (found.phi0 - phi0).abs() / angles[0]),
        ("phi1", (found.phi1 - phi1).abs() / angles[1]),
        ("kappa0", (found.kappa0 / data[0] - 1.0).abs() / curvature[0]),
        ("kappa1", (found.kappa1 / data[1] - 1.0).abs() / curvature[1]),
    ];

    // Control points: a side turns by the error of its angle and stretches by that of d (2 sin φ / sin(φ0+φ1)).
    let side = [0, 1].map(|i| sides[i] * (angles[i] + d[i] + 16.0 * EPS));
    let biggest = p.iter().map(|z| length(*z)).fold(0.0, f64::max);
    let place = side[0].max(side[1]) + 8.0 * EPS * (biggest + far);
    assert!(place < 1e-12 * biggest.max(far), "the tolerance itself breaks the promise: {place}");
    let placed = placement.place(&found, f0, f1);
    let worst = placed.p.iter().zip(&want).map(|(a, b)| length(minus(*a, *b)) / motion.size).fold(0.0, f64::max);
    errors.push(("control points", worst / place));
    errors.push(("end points", if placed.p[0] == ends.start && placed.p[3] == ends.end { 0.0 } else { f64::INFINITY }));

    // End data of the placed curve: its own rounding, and what the errors of angles and d do to (3.4).
    let local = placement.place_local(&found, f0, f1);
    let near = if placement.reversed { [1, 0] } else { [0, 1] };
    let asked = [(ends.start_direction, ends.start_curvature), (ends.end_direction, ends.end_curvature)];
    for (t, i, (direction, kappa)) in [(0.0, near[0], asked[0]), (1.0, near[1], asked[1])] {
        let jet = local.jet(t);
        let phi = [phi0, phi1][i];
        let share = 2.0 * curvature[i] + angles[i] / phi.tan().abs() + 2.0 * d[i];
        assert!(angles[i] < 1e-12 && share < 1e-10, "{} {share}", angles[i]);
        errors.push(("end direction", angle(jet.direction(), direction).abs() / (2.0 * angles[i])));
        errors.push(("end curvature", (jet.curvature() / kappa - 1.0).abs() / share));
    }
    errors
}

fn shapes() -> impl Strategy<Value = Shape> {
    let drawn = (0.1..1.5f64, 0.1..1.5f64, 0.2..2.8f64, 0.2..2.8f64);
    drawn.prop_map(|(phi0, phi1, f0, f1)| [phi0, phi1, f0, f1]).prop_filter("same end curvatures", |shape| {
        let [kappa0, kappa1] = end_curvatures(*shape);
        (kappa0 / kappa1).ln().abs() > 1e-6 && shape[0] + shape[1] < 2.9
    })
}

fn motions() -> impl Strategy<Value = Motion> {
    let drawn = (-140.0..140.0f64, -PI..PI, -4.0..4.0f64, -4.0..4.0f64, any::<bool>(), any::<bool>());
    drawn.prop_map(|(size, turn, x, y, mirror, reverse)| Motion {
        size: 10f64.powf(size),
        turn,
        shift: [x, y],
        mirror,
        reverse,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_moved_curve_is_normalised_and_placed_back(shape in shapes(), motion in motions()) {
        let errors = round_trip(shape, &motion, |_| (), |_| ());
        prop_assert_eq!(errors.len(), 10);
        for (what, error) in errors {
            prop_assert!(error <= 1.0, "{}: {} tolerances", what, error);
        }
    }

    /// 10 000 km from the origin, with roots found for the rounded data: the curve answers the data as they are.
    #[test]
    fn far_from_the_origin_the_ends_are_still_met(shape in shapes(), motion in motions()) {
        let motion = Motion { size: 100.0, shift: [1e5, -5e4], ..motion };
        let (ends, _) = motion.ends(&CubicBezier::from_ratios(shape[0], shape[1], shape[2], shape[3]));
        let all = answer(&ends);
        // The curve itself is among them, but for double roots that the scan steps over.
        prop_assume!(!all.solutions.is_empty());
        for s in &all.solutions {
            let p = &s.local_control_points.p;
            let round = rounding(p);
            prop_assert_eq!(s.control_points.p[0], ends.start);
            prop_assert_eq!(s.control_points.p[3], ends.end);
            for (far, near) in s.control_points.p.iter().zip(p) {
                let back = minus(minus(*far, ends.start), *near);
                // Half an ulp of a coordinate of 1e7 for the sum, as much for the chord; the rest is far smaller.
                prop_assert!(length(back) <= 4.0 * EPS * 1e7, "{:?}", back);
            }
            // The root: f0 is one of two neighbours between which F changes sign, f1 follows within 2 ulp of 3.
            let a = (3.0 - s.f1) / s.f0.powi(2);
            let k = (3.0 - s.f0) / s.f1.powi(2);
            let root0 = 8.0 * EPS * (1.0 + 3.0 / (3.0 - s.f1));
            let root1 = 8.0 * EPS * (1.0 + 3.0 / s.f1 + (1.0 + 4.0 * a * k * s.f0 * s.f1) * s.f0 / (3.0 - s.f0));
            let root = if all.placement.reversed { [root1, root0] } else { [root0, root1] };
            let Datum { phi0, phi1, .. } = all.datum;
            // Angles are within 8 EPS of what the ends say; (3.4) stretches that by the cotangents.
            let over = |share: f64, angle: f64| share / angle.tan().abs();
            let angles = 8.0 * EPS * (1.0 + over(3.0, phi0) + over(3.0, phi1) + over(4.0, phi0 + phi1));
            let asked = [(ends.start_direction, ends.start_curvature), (ends.end_direction, ends.end_curvature)];
            for (i, (direction, kappa)) in asked.into_iter().enumerate() {
                let jet = s.local_control_points.jet(i as f64);
                prop_assert!(angle(jet.direction(), direction).abs() <= round[i].0 + 12.0 * EPS);
                let error = (jet.curvature() / kappa - 1.0).abs();
                prop_assert!(error <= round[i].1 + root[i] + angles, "{} > {} {} \
                                                                      {}", error, round[i].1, root[i], angles);
            }
        }
    }
}

#[test]
fn the_round_trip_notices_every_corruption() {
    let spoils: [fn(&mut Ends); 6] = [
        |e| e.start_direction += 1e-11,
        |e| e.end_direction -= 1e-11,
        |e| e.start_curvature *= 1.0 + 1e-11,
        |e| e.end_curvature *= 1.0 + 1e-11,
        |e| e.start[0] *= 1.0 + 1e-11,
        |e| (e.start, e.end) = (e.end, e.start),
    ];
    let twists: [fn(&mut Placement); 4] = [
        |p| p.mirrored = !p.mirrored,
        |p| p.reversed = !p.reversed,
        |p| p.half_chord[0] *= 1.0 + 1e-11,
        |p| p.start[1] *= 1.0 + EPS,
    ];
    for (mirror, reverse) in [(false, false), (true, false), (false, true), (true, true)] {
        for shape in [[0.7, 1.1, 1.6, 0.8], [1.2, 0.6, 0.9, 1.4]] {
            let motion = Motion { size: 250.0, turn: 0.6, shift: [1.5, -0.5], mirror, reverse };
            let worst = |spoil, twist| round_trip(shape, &motion, spoil, twist).iter().map(|e| e.1).fold(0.0, f64::max);
            assert!(worst(|_| (), |_| ()) <= 1.0);
            for (i, spoil) in spoils.into_iter().enumerate() {
                assert!(worst(spoil, |_| ()) > 1.0, "spoil {i} passed, {mirror} {reverse}");
            }
            for (i, twist) in twists.into_iter().enumerate() {
                assert!(worst(|_| (), twist) > 1.0, "twist {i} passed, {mirror} {reverse}");
            }
        }
    }
}
