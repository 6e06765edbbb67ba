//! The rules of normalising as docs/cubic.md gives them to whoever does it without this program: followed literally,
//! number by number.

use super::sides::ends;
use super::{EPS, length, minus};
use spiral_atlas::family::cubic::Datum;
use spiral_atlas::transition::{Ends, Placement, spiral};
use std::f64::consts::PI;

const PAGE: &str = include_str!("../../../docs/cubic.md");

/// The cells of the page's table: for each kind of curve φ0, φ1, κ0, κ1.
fn table() -> Vec<(&'static str, [&'static str; 4])> {
    let (_, rows) = PAGE.split_once("| curve | φ0 | φ1 | κ0 | κ1 |\n| --- | --- | --- | --- | --- |\n").unwrap();
    let cells =
        |line: &'static str| -> Vec<&'static str> { line.trim_matches('|').split('|').map(str::trim).collect() };
    let row = |line| match cells(line)[..] {
        [curve, a, b, c, d] => (curve, [a, b, c, d]),
        _ => panic!("{line}"),
    };
    rows.lines().take_while(|line| line.starts_with('|')).map(row).collect()
}

/// A number of the page's letters.
fn letter(name: &str, ends: &Ends) -> f64 {
    let [x, y] = minus(ends.end, ends.start);
    match name {
        "δ0" => ends.start_direction,
        "δ1" => ends.end_direction,
        "χ" => y.atan2(x),
        "h" => 0.5 * x.hypot(y),
        "c0" => ends.start_curvature,
        "c1" => ends.end_curvature,
        _ => panic!("the page has no letter {name}"),
    }
}

/// `a - b` reduced to (-π, π], or `h c`, or `-h c`.
fn value(cell: &str, ends: &Ends) -> f64 {
    if let Some((a, b)) = cell.split_once(" - ") {
        let angle = (letter(a, ends) - letter(b, ends)).rem_euclid(2.0 * PI);
        return if angle > PI { angle - 2.0 * PI } else { angle };
    }
    let (sign, product) = cell.strip_prefix('-').map_or((1.0, cell), |rest| (-1.0, rest));
    let (h, c) = product.split_once(' ').unwrap();
    sign * letter(h, ends) * letter(c, ends)
}

/// The row for these ends: what happens to the curve, and the datum.
fn by_hand(ends: &Ends) -> ([bool; 2], Datum) {
    let side = if ends.start_curvature + ends.end_curvature > 0.0 { "left" } else { "right" };
    let way = if ends.start_curvature < ends.end_curvature { "rises rising" } else { "falling" };
    let fits = |curve: &str| curve.contains(side) && way.split(' ').any(|word| curve.contains(word));
    let rows: Vec<_> = table().into_iter().filter(|(curve, _)| fits(curve)).collect();
    let [(curve, cells)] = rows[..] else { panic!("{side} {way}: {rows:?}") };
    let [phi0, phi1, kappa0, kappa1] = cells.map(|cell| value(cell, ends));
    let both = curve.starts_with("both");
    (
        [both || curve.starts_with("mirrored"), both || curve.starts_with("run backwards")],
        Datum { phi0, phi1, kappa0, kappa1 },
    )
}

#[test]
fn the_pages_rules_give_datum_and_points() {
    assert_eq!(table().len(), 4);
    let datum = [0.7, 1.4, 0.4, 4.0];
    let mut kinds = Vec::new();
    for (mirrored, reversed) in [(false, false), (true, false), (false, true), (true, true)] {
        for (turned, half) in [(0.0, 100.0), (0.3, 2.0), (-2.9, 0.01), (1.7, 5e4)] {
            let ends = ends(datum, turned, half, mirrored, reversed);
            let ([mirror, backwards], hand) = by_hand(&ends);
            let all = [hand.phi0, hand.phi1, hand.kappa0, hand.kappa1];
            let off = all.iter().zip(datum).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Angles of a few radians and coordinates of a few half chords, each rounded a few times.
            let rounding = 64.0 * EPS * (1.0 + 4.0 / half);
            assert!(off < rounding, "{ends:?}: {hand:?}");
            let (found, _) = Placement::normalise(&ends).unwrap();
            for (a, b) in all.iter().zip([found.phi0, found.phi1, found.kappa0, found.kappa1]) {
                assert!((a - b).abs() < rounding, "{hand:?} {found:?}");
            }
            // From the frame back into the plane.
            let answer = spiral(&ends).unwrap();
            let chosen = answer.chosen().unwrap();
            let frame = spiral_atlas::curve::CubicBezier::from_ratios(hand.phi0, hand.phi1, chosen.f0, chosen.f1);
            let (h, chord) = (letter("h", &ends), letter("χ", &ends));
            let place = |[x, y]: [f64; 2]| {
                let (x, y) = (if backwards { -x } else { x }, if mirror { -y } else { y });
                let middle = [0, 1].map(|i| 0.5 * (ends.start[i] + ends.end[i]));
                let (sin, cos) = chord.sin_cos();
                [middle[0] + h * (cos * x - sin * y), middle[1] + h * (sin * x + cos * y)]
            };
            let mut points = frame.p.map(place);
            if backwards {
                points.reverse();
            }
            for (by_hand, placed) in points.iter().zip(chosen.control_points.p) {
                assert!(
                    length(minus(*by_hand, placed)) < 8.0 * rounding * h,
                    "{points:?}: {:?}",
                    chosen.control_points
                );
            }
            kinds.push((mirror, backwards));
        }
    }
    kinds.sort();
    kinds.dedup();
    assert_eq!(kinds.len(), 4, "each row of the table was used");
}

#[test]
fn the_pages_example_has_the_pages_numbers() {
    let ends = Ends {
        start: [0.0, 0.0],
        end: [200.0, 0.0],
        start_direction: -40f64.to_radians(),
        end_direction: 80f64.to_radians(),
        start_curvature: 0.004,
        end_curvature: 0.04,
    };
    assert!(PAGE.contains("h = 100 and χ = 0: φ0 = 40°, φ1 = 80°, κ0 = 0.4, κ1 = 4,"));
    let (how, Datum { phi0, phi1, kappa0, kappa1 }) = by_hand(&ends);
    assert_eq!((how, letter("h", &ends), letter("χ", &ends)), ([false, false], 100.0, 0.0));
    for (got, want) in [(phi0.to_degrees(), 40.0), (phi1.to_degrees(), 80.0), (kappa0, 0.4), (kappa1, 4.0)] {
        assert!((got / want - 1.0).abs() < 8.0 * EPS, "{got} {want}");
    }
}
