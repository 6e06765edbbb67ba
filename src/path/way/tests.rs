//! Lengths, curvatures and steps of single pieces.

use super::*;
use crate::curve::{CubicBezier, TrigBezier};
use crate::steps::counted;

fn cubic(p: [[f64; 2]; 4]) -> Piece {
    let legs = std::array::from_fn(|i| sub(p[i + 1], p[i]));
    Piece::Cubic(Cubic { points: CubicBezier { p }, legs })
}

fn trig(sides: [[f64; 2]; 5], from: f64, to: f64) -> Piece {
    Piece::TrigQuintic(TrigPart { curve: TrigBezier { start: [0.0; 2], sides, p: 1.0, q: -4.0 }, from, to })
}

/// Within what is reported, and few cells even where the curve stands still for long.
#[test]
fn lengths_are_off_by_no_more_than_told() {
    let third = 1.0 / 3.0;
    let none = [0.0; 2];
    let x = [1.0, 0.0];
    let cases = [
        // (t², t³): 13√13/27 - 8/27. The same twice, back and forth: (4t² - 4t, 0).
        (cubic([none, none, [third, 0.0], [1.0, 1.0]]), (13.0 * 13f64.sqrt() - 8.0) / 27.0),
        (cubic([none, [-4.0 * third, 0.0], [-4.0 * third, 0.0], none]), 2.0),
        (cubic([none, none, none, x]), 1.0),
        (cubic([none, [third, 0.0], [2.0 * third, 0.0], x]), 1.0),
        // Straight, standing still to the seventh order at either end, or at both; and a part of no speed to speak of.
        (trig([none, none, none, none, x], 0.0, 1.0), 1.0),
        (trig([x, none, none, none, none], 0.0, 1.0), 1.0),
        (trig([none, none, x, none, none], 0.0, 1.0), 1.0),
        (trig([none, none, none, none, x], 0.0, 1e-30), 0.0),
        (trig([x, x, x, x, x], 0.25, 0.25 + f64::EPSILON), 5.0 * 1e-15),
    ];
    for (piece, length) in cases {
        let (steps, way) = match &piece {
            Piece::Cubic(c) => counted(|| Way::integrated(Bezier::Cubic(*c))),
            Piece::TrigQuintic(part) => counted(|| Way::integrated(Bezier::Trig(*part))),
            _ => continue,
        };
        // Beside a zero of order m <= 8 of r', at the distance d, a half-width h is analytic once (1 + 17/8 h/d)^m is
        // at most 5/4: h > d/77. So a doubling of d takes at most 39 cells, twice as many because widths are powers of
        // two, and twice as many nodes of the tree: 156. There are 61 doublings down to the smallest cell and two ends,
        // and the bounds of derivatives may ask for half the width: 2 * 2 * 61 * 156.
        assert!(steps < 38_064 && way.length_off < 1e-11, "{steps} {} {piece:?}", way.length_off);
        assert!((way.length - length).abs() <= way.length_off, "{} {length} {} {piece:?}", way.length, way.length_off);
    }
}

/// The bound of the curvature holds, and is no more than some times the truth where the curve is regular.
#[test]
fn curvatures_are_bounded() {
    let bent = cubic([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [2.0, 2.5]]);
    let waving = trig([[0.5, 0.2], [0.4, 0.5], [0.6, -0.3], [0.5, -0.6], [0.6, 0.3]], 0.1, 0.8);
    for piece in [bent, waving] {
        let way = Way::new(&piece).unwrap();
        let [from, to] = piece.range();
        let at = |i: i32| piece.at(from + (to - from) * f64::from(i) / 1000.0).curvature.abs();
        let most = (0..=1000).map(at).fold(0.0, f64::max);
        assert!(most > 0.3 && way.curvature >= most && way.curvature < 8.0 * most, "{most} {}", way.curvature);
        // Where one is after a length is where the length up to there says.
        for i in 0..=100 {
            let local = way.length * f64::from(i) / 100.0;
            let reached = way.after(local);
            assert!(reached.missed <= 1e-14 * way.length, "{local} {}", reached.missed);
        }
    }
}
