//! Half and quarter turns against the chord, however they are written: the same answer as for the ends on the x axis.

use super::EPS;
use spiral_atlas::family::any_spiral::{Datum, involute};
use spiral_atlas::transition::{Ends, Placement, involute_between, ph_spiral};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Directions of the chord, as vectors, and their angles in degrees: along the axes, along diagonals, and others with
/// their neighbours.
fn chords() -> Vec<([f64; 2], f64)> {
    let mut all = Vec::new();
    for quarter in 0..4 {
        for [x, y] in [[1.0, 0.0], [1.0, 1.0], [3.0, 4.0], [12.0, 5.0], [1e-3, 7.0], [0.1, 0.3]] {
            let [x, y]: [f64; 2] = (0..quarter).fold([x, y], |[x, y]: [f64; 2], _| [-y, x]);
            all.push(([x, y], y.atan2(x).to_degrees()));
        }
    }
    all
}

/// Every way to write so many quarter turns from the chord, in radians.
fn written(quarters: i32, chord: f64) -> Vec<f64> {
    let degrees = chord + 90.0 * f64::from(quarters);
    let turns = [-720.0, -360.0, 0.0, 360.0, 720.0, 36000.0];
    turns.iter().flat_map(|turn| [(degrees + turn).to_radians(), (degrees + turn) * (PI / 180.0)]).collect()
}

/// Ends at a distance of 2 units, from the chord's quarter turns.
fn ends([x, y]: [f64; 2], directions: [f64; 2], k: [f64; 2]) -> Ends {
    let size = 0.5 * x.hypot(y);
    Ends {
        start: [0.0, 0.0],
        end: [x, y],
        start_direction: directions[0],
        end_direction: directions[1],
        start_curvature: k[0] / size,
        end_curvature: k[1] / size,
    }
}

#[test]
fn half_and_quarter_turns_land_in_the_domain_however_they_are_written() {
    let quarter = |n: i32| f64::from(n) * FRAC_PI_2;
    let (mut compared, mut curves) = (0, 0);
    for (vector, chord) in chords() {
        for first in -2..=2 {
            for last in -2..=2 {
                for k in [[-1.5, 2.5], [0.3, 7.0], [-7.0, -0.3], [2.5, -1.5], [7.0, 0.3], [-0.3, -7.0]] {
                    let plain =
                        involute(&Datum { alpha: quarter(first), beta: quarter(last), k1: k[0], k2: k[1] }, [0, 0])
                            .unwrap();
                    for (a, b) in written(first, chord).into_iter().zip(written(last, chord)) {
                        // The directions that differ from the chord's by nothing may come out on either side of it.
                        let placed = ends(vector, [a, b], k);
                        let (found, _) =
                            involute_between(&placed, [0, 0]).unwrap_or_else(|e| panic!("{placed:?}: {e}"));
                        let exact = chord == 0.0 || first.abs() == 2 && last.abs() == 2;
                        if first + last != 0 || exact && a.abs() < 100.0 {
                            assert_eq!(
                                found.curve().is_some(),
                                plain.curve().is_some(),
                                "{placed:?}: {:?}",
                                found.chord
                            );
                        }
                        for (got, want) in [(found.chord.alpha, first), (found.chord.beta, last)] {
                            if want.abs() == 2 && a.abs() < 100.0 {
                                assert_eq!(got.abs(), PI, "{placed:?}");
                            }
                        }
                        curves += usize::from(found.curve().is_some());
                        compared += 1;
                    }
                }
            }
        }
    }
    println!("{compared} placements, {curves} curves");
    assert!(compared > 30_000 && curves > 5_000);
}

/// PH quintics, for directions at every eighth of a turn against the chord in every quadrant: the answer is that for
/// ends on the x axis.
#[test]
fn ph_quintics_are_placed_alike_in_every_quadrant() {
    let (mut compared, mut curves) = (0, 0);
    for (vector, chord) in chords().into_iter().step_by(2) {
        for (first, last) in (-4i32..=4).flat_map(|first| (-4i32..=4).map(move |last| (first, last))) {
            let eighths = [first, last].map(|n| f64::from(n) * FRAC_PI_4);
            for k in [[0.4, 4.0], [-4.0, -0.4], [-0.4, -4.0], [4.0, 0.4], [0.5, 20.0]] {
                let plain = ph_spiral(&ends([2.0, 0.0], eighths, k)).unwrap();
                for whole in [0.0, 360.0] {
                    let [a, b] = [first, last].map(|n| (chord + 45.0 * f64::from(n) + whole).to_radians());
                    let placed = ends(vector, [a, b], k);
                    let found = ph_spiral(&placed).unwrap_or_else(|e| panic!("{placed:?}: {e}"));
                    // On a boundary of the domain rounding decides: along the chord, at opposite angles, and where
                    // tangents are parallel.
                    if first * last * (first + last) == 0 || (last - first).abs() == 4 {
                        continue;
                    }
                    assert_eq!(found.chosen().is_some(), plain.chosen().is_some(), "{placed:?}: {found}");
                    if let (Some(one), Some(other)) = (found.chosen(), plain.chosen()) {
                        let (size, half) = (0.5 * vector[0].hypot(vector[1]), 1.0);
                        assert!((one.length / size / (other.length / half) - 1.0).abs() < 1e-10, "{placed:?}");
                        assert_eq!((one.control_points[0], one.control_points[5]), (placed.start, placed.end));
                        curves += 1;
                    }
                    compared += 1;
                }
            }
        }
    }
    println!("{compared} placements, {curves} curves");
    assert!(compared > 4_000 && curves >= 12 * 2 * 5);
}

/// Both signs of a half turn, the mirror image and the way back give one datum of a C-shaped curve.
#[test]
fn a_half_turn_has_the_side_of_the_other_end() {
    let mut compared = 0;
    for (vector, chord) in chords() {
        let chord = chord.to_radians();
        for [a, b] in [[PI, 0.7], [-PI, 0.7], [0.4, PI], [0.4, -PI], [PI, PI], [-PI, PI], [PI, -PI], [-PI, -PI]] {
            for k in [[0.4, 2.0], [3.0, 0.5], [-0.4, -2.0], [-3.0, -0.5], [-0.4, 2.0], [3.0, -0.4]] {
                let this = ends(vector, [chord + a, chord + b], k);
                let (datum, placement) = Placement::normalise(&this).unwrap();
                let others = [[-a, b], [a, -b], [-a, -b]].into_iter().filter(|o| {
                    let same = |x: f64, y: f64| x == y || x.abs() == PI && y.abs() == PI;
                    same(o[0], a) && same(o[1], b)
                });
                for other in others {
                    let (again, same) =
                        Placement::normalise(&ends(vector, [chord + other[0], chord + other[1]], k)).unwrap();
                    assert_eq!(
                        (again.phi0.abs() == PI, again.phi1.abs() == PI),
                        (datum.phi0.abs() == PI, datum.phi1.abs() == PI)
                    );
                    let off = (again.phi0 - datum.phi0).abs().max((again.phi1 - datum.phi1).abs());
                    assert!(off < 16.0 * EPS && same.mirrored == placement.mirrored, "{this:?}: {datum:?}, {again:?}");
                    compared += 1;
                }
                let [x, y] = vector;
                let seen = ends([x, -y], [-(chord + a), -(chord + b)], [-k[0], -k[1]]);
                let back = Ends {
                    start: this.end,
                    end: this.start,
                    start_direction: this.end_direction + PI,
                    end_direction: this.start_direction + PI,
                    start_curvature: -this.end_curvature,
                    end_curvature: -this.start_curvature,
                };
                for (other, mirrored, reversed) in [(seen, true, false), (back, false, true)] {
                    let (again, how) = Placement::normalise(&other).unwrap();
                    let off = (again.phi0 - datum.phi0).abs().max((again.phi1 - datum.phi1).abs());
                    assert!(off < 16.0 * EPS, "{this:?}: {datum:?}; {other:?}: {again:?}");
                    assert_eq!(
                        (how.mirrored != placement.mirrored, how.reversed != placement.reversed),
                        (mirrored, reversed),
                        "{this:?}; {other:?}"
                    );
                    compared += 1;
                }
            }
        }
    }
    println!("{compared} placements");
    assert!(compared > 3_000);
}
