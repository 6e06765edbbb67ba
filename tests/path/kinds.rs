//! Separation of motions along pieces of each kind.

use super::separation::{Polygon, sampled};
use super::*;
use spiral_atlas::curve::{CubicBezier, TrigBezier};
use spiral_atlas::path::{Course, Motion, Verdict, separation};
use spiral_atlas::transition::{Arc, Clothoid, Cubic, Line, Piece, TrigPart};
use std::f64::consts::FRAC_PI_2;

fn cubic(p: [[f64; 2]; 4]) -> Piece {
    let legs = std::array::from_fn(|i| [p[i + 1][0] - p[i][0], p[i + 1][1] - p[i][1]]);
    Piece::Cubic(Cubic { points: CubicBezier { p }, legs })
}

fn trig(points: [[f64; 2]; 6], [p, q]: [f64; 2], [from, to]: [f64; 2]) -> Piece {
    Piece::TrigQuintic(TrigPart { curve: TrigBezier::new(points, p, q).unwrap(), from, to })
}

/// One of each kind of which separation is proved, in a unit.
pub(crate) fn each(unit: f64) -> Vec<Piece> {
    let all = |points: [[f64; 2]; 6]| points.map(|p| p.map(|x| unit * x));
    let [a, b, c, d, ..] = all([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [3.0, 1.0], [0.0; 2], [0.0; 2]]);
    let six = all([[0.0, 0.0], [0.2, 0.0], [0.5, 0.1], [0.9, 0.2], [1.3, 0.6], [1.4, 1.1]]);
    // Past the checks of its making, which refuse numbers that are none.
    let curve = TrigBezier {
        start: six[0],
        sides: std::array::from_fn(|i| [0, 1].map(|k| six[i + 1][k] - six[i][k])),
        p: 0.5,
        q: -0.5,
    };
    let root = unit.sqrt();
    vec![
        cubic([a, b, c, d]),
        Piece::TrigQuintic(TrigPart { curve, from: 0.0, to: 1.0 }),
        Piece::Arc(Arc { start: a, start_direction: 0.2, curvature: 1.0 / unit, length: 2.0 * unit }),
        Piece::Clothoid(Clothoid {
            start: a,
            start_direction: 0.2,
            curvature: -1.0 / unit,
            end_curvature: 2.0 / unit,
            length: 2.0 * unit,
        }),
        Piece::Line(Line { start: a, end: d }),
        PhQuintic::new(a, [[1.0, 0.0], [1.0, 0.5], [0.5, 1.0]].map(|w| w.map(|x| root * x))).into(),
    ]
}

/// Points by other formulas than those of the library: Bernstein polynomials, basis functions and the centre of the
/// circle.
fn points(piece: &Piece) -> Vec<[f64; 2]> {
    let sum = |points: &[[f64; 2]], weights: &[f64]| {
        points.iter().zip(weights).fold([0.0, 0.0], |sum, (p, w)| [sum[0] + w * p[0], sum[1] + w * p[1]])
    };
    let [from, to] = piece.range();
    let point = |share: f64| {
        let t = from + share * (to - from);
        let u = 1.0 - t;
        match piece {
            Piece::Cubic(c) => sum(&c.points.p, &[u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t]),
            Piece::TrigQuintic(part) => sum(&part.curve.points(), &TrigBezier::basis(part.curve.p, part.curve.q, t)),
            Piece::Arc(a) => {
                let end = a.start_direction + a.curvature * a.length * t;
                let radius = 1.0 / a.curvature;
                let [x, y] = a.start;
                [x + radius * (end.sin() - a.start_direction.sin()), y - radius * (end.cos() - a.start_direction.cos())]
            }
            Piece::Line(l) => sum(&[l.start, l.end], &[u, t]),
            Piece::PhQuintic(curve) => bezier(curve, t).point,
            Piece::Clothoid(c) => clothoid(c, t),
            Piece::Involute(_) => panic!("an involute has no formula"),
        }
    };
    (0..=4000).map(|i| point(f64::from(i) / 4000.0)).collect()
}

/// By Simpson's rule.
fn clothoid(c: &Clothoid, t: f64) -> [f64; 2] {
    let (s, steps) = (t * c.length, 60);
    let direction = |x: f64| {
        let angle = c.start_direction + x * (c.curvature + 0.5 * x * (c.end_curvature - c.curvature) / c.length);
        [angle.cos(), angle.sin()]
    };
    let weight = |i: i32| if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let sum =
        |k: usize| (0..=steps).map(|i| weight(i) * direction(s * f64::from(i) / f64::from(steps))[k]).sum::<f64>();
    [0, 1].map(|k| c.start[k] + s * sum(k) / f64::from(3 * steps))
}

fn random(noise: &mut Noise, kind: usize) -> Piece {
    let mut p = || noise.point();
    match kind {
        0 => cubic([p(), p(), p(), p()]),
        1 => {
            let points = [p(), p(), p(), p(), p(), p()];
            let shape = p().map(|x| 2.5 * x - 1.5);
            let from = 0.4 * p()[0].abs();
            trig(points, shape, [from, from + 0.6])
        }
        2 => Piece::Arc(Arc {
            start: p(),
            start_direction: 4.0 * p()[0],
            curvature: 3.0 * p()[0] + 0.01,
            length: 1.5 + p()[0],
        }),
        3 => Piece::Line(Line { start: p(), end: p() }),
        4 => Piece::Clothoid(Clothoid {
            start: p(),
            start_direction: 4.0 * p()[0],
            curvature: 3.0 * p()[0],
            end_curvature: 3.0 * p()[0],
            length: 1.5 + p()[0],
        }),
        _ => PhQuintic::new(p(), [p(), p(), p()]).into(),
    }
}

#[test]
fn motions_along_each_kind_agree_with_dense_sampling() {
    let mut noise = Noise(31);
    for i in 0..60 {
        let [one, two] = [i % 6, (i / 6) % 5].map(|kind| random(&mut noise, kind));
        let (v1, v2, t2) = (1.0 + 0.5 * noise.next(), 1.0 + 0.5 * noise.next(), 0.1 * noise.next());
        let (a, b) = (Motion::new([one.clone()], v1, 0.0).unwrap(), Motion::new([two.clone()], v2, t2).unwrap());
        let lengths = [(&a, &one), (&b, &two)].map(|(m, piece)| m.length() / piece.length() - 1.0);
        assert!(lengths.iter().all(|off| off.abs() < 1e-12), "{lengths:?} {one:?} {two:?}");
        sampled([&a, &b], [&Polygon::through(points(&one)), &Polygon::through(points(&two))], [v1, v2, t2]);
    }
}

#[test]
fn pieces_of_different_kinds_make_one_path() {
    let bent = cubic([[0.0, 0.0], [1.0, 0.0], [2.0, 0.3], [2.5, 1.0]]);
    let arc = Piece::Arc(Arc { start: [2.5, 1.0], start_direction: 0.7f64.atan2(0.5), curvature: 0.5, length: 2.0 });
    let heading = arc.at(1.0).heading;
    let [x, y] = arc.end();
    let six = [0.0, 0.2, 0.5, 0.8, 1.1, 1.5].map(|s| [x + s * heading.cos() - 0.1 * s * s * s, y + s * heading.sin()]);
    let path = vec![bent, arc, trig(six, [0.5, -0.5], [0.0, 1.0])];
    let polygon = Polygon::through(path.iter().flat_map(points));
    let a = Motion::new(path.clone(), 1.0, 0.0).unwrap();
    let course = Course::new(path).unwrap();
    assert_eq!((a.course(), a.length()), (&course, a.course().length()));
    let line = Piece::Line(Line { start: [4.0, -1.0], end: [1.0, 4.0] });
    let b = Motion::new([line.clone()], 1.3, 0.05).unwrap();
    sampled([&a, &b], [&polygon, &Polygon::through(points(&line))], [1.0, 1.3, 0.05]);
}

/// A straight curve is a line, however unevenly its parameter runs along; a circle is one with another of the same
/// centre.
#[test]
fn in_step_with_a_line_or_a_circle() {
    let uneven = [0.0, 0.1, 6.0, 10.0].map(|x| [x, 0.0]);
    let turned = uneven.map(|[x, _]| [0.6 * x, 0.8 * x]);
    let six = [0.0, 0.5, 0.9, 4.0, 7.0, 10.0].map(|x| [x, 0.0]);
    let beside = Piece::Line(Line { start: [0.0, 1.0], end: [10.0, 1.0] });
    let turned_beside = Piece::Line(Line { start: [-0.8, 0.6], end: [5.2, 8.6] });
    let arc = |radius: f64| {
        Piece::Arc(Arc {
            start: [radius, 0.0],
            start_direction: FRAC_PI_2,
            curvature: 1.0 / radius,
            length: 2.0 * radius,
        })
    };
    let pairs = [
        (cubic(uneven), 1.0, beside.clone(), 1.0),
        (cubic(turned), 1.0, turned_beside, 1.0),
        (trig(six, [-2.0, 1.0], [0.0, 1.0]), 1.0, beside, 1.0),
        (arc(2.0), 2.0, arc(3.0), 3.0),
    ];
    for (one, v1, two, v2) in pairs {
        let (a, b) = (Motion::new([one.clone()], v1, 0.0).unwrap(), Motion::new([two], v2, 0.0).unwrap());
        let verdict = |minimum: f64| separation(&a, &b, minimum).unwrap().verdict;
        let near = [verdict(1.0 - 1e-7), verdict(1.0), verdict(1.0 + 1e-7)];
        assert_eq!(near, [Verdict::Yes, Verdict::Undecided, Verdict::No], "{one:?}");
    }
}
