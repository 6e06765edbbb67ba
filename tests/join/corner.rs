//! The corner of the paper on paths of PH quintics, as a join of two lines.

use super::check::check;
use spiral_atlas::curve::PhQuintic;
use spiral_atlas::family::reach::{Kind, Level};
use spiral_atlas::path;
use spiral_atlas::transition::join::{End, Family, Join, Measures, Request, join};
use spiral_atlas::transition::segment::{self, Base, Target, add_segment};
use spiral_atlas::transition::{Piece, Turn};

type Vector = [f64; 2];

/// Both halves of a curve.
fn halves(curve: &PhQuintic) -> [PhQuintic; 2] {
    let [a, b, c] = curve.preimage;
    let mean = |a: Vector, b: Vector| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let (ab, bc) = (mean(a, b), mean(b, c));
    let middle = mean(ab, bc);
    // The speed by the half parameter is half of the speed.
    let half = |all: [Vector; 3]| all.map(|w| w.map(|x| x * 0.5f64.sqrt()));
    let first = PhQuintic::new(curve.start, half([a, ab, middle]));
    [first, PhQuintic::between(first.end, curve.end, half([middle, bc, c]))]
}

/// The corner is made of two spirals, and it is a join of its two lines: the one whose halves have the shape numbers m
/// = 2 and q = 4 tan(θ/4) for a turn by θ. The join that is found within the same limit takes less of the lines,
/// unless the turn is sharp.
#[test]
fn the_corner_is_a_join_of_two_lines() {
    for theta in [0.3f64, -1.0, std::f64::consts::FRAC_PI_2, 2.0, -2.5] {
        let (at, reach) = ([3.0, -1.0], 2.5);
        let corner = path::Turn::new([1.0, 0.0], [theta.cos(), theta.sin()]).unwrap();
        let curve = corner.corner(at, reach).unwrap();
        let limit = corner.curvature(reach).abs();
        let halves = halves(&curve);
        let pieces = halves.map(Piece::PhQuintic).to_vec();
        let line = |direction: f64| End::Line { point: at, direction };
        let request = Request { family: Family::PhQuintic, ..Request::new(line(0.0), line(theta), limit) };
        let length = halves.iter().map(PhQuintic::length).sum();
        let measures = Measures {
            length,
            greatest_curvature: limit,
            curvature_range: [0.0, 0.0],
            rate_range: [0.0, 0.0],
            bending_energy: 0.0,
        };
        check(&request, &Join { measures, pieces }).unwrap_or_else(|e| panic!("{theta}: {e}"));
        let made = |share: f64| {
            let q = share * 4.0 * (0.25 * theta.abs()).tan();
            let half = segment::Request {
                base: Base::Line,
                start: curve.start,
                direction: 0.0,
                turn: if theta > 0.0 { Turn::Left } else { Turn::Right },
                radius: 1.0 / limit,
                theta: 0.5 * theta.abs(),
                target: Target::Shape { m: 2.0, q },
            };
            add_segment(Kind::Ph, &half).unwrap().expect("a curve")
        };
        for (a, b) in made(1.0).piece.control_points().unwrap().iter().zip(halves[0].control_points()) {
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12 * reach, "{theta}: {a:?} {b:?}");
        }
        // Its curvature stops rising just where the halves meet: on one side are spirals, on the other are none.
        let spirals = [1.0 - 1e-9, 1.0 + 1e-9].map(|share| made(share).level >= Level::Exact);
        assert!(spirals[0] != spirals[1], "{theta}: {spirals:?}");
        let found = join(&Request { most_pieces: 2, ..request }).unwrap().expect("there is room");
        check(&request, &found).unwrap_or_else(|e| panic!("{theta}: {e}"));
        let leg = at[0] - found.pieces[0].start()[0];
        println!("{theta}: reach {} least radii, of the join {}", reach * limit, leg * limit);
        assert!(found.pieces.len() == 2 && (leg < reach || theta.abs() > 2.0), "{theta}: {found:?}");
    }
}
