//! The published numbers of the reachable regions: vectors, Walton & Meek's points, shares of areas.

use serde_json::Value;
use spiral_atlas::family::reach::{Datum, Kind, Level, Reach, Reached, Segment, solve};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::PI;

const KINDS: [(Kind, &str); 2] = [(Kind::Cubic, "cubic"), (Kind::Ph, "ph")];

fn axis(name: &str, values: Vec<f64>) -> Axis {
    Axis::new(name, Spacing::Values(values)).unwrap()
}

fn at(kind: Kind, theta: f64, xi: f64, eta: f64) -> Reached {
    solve(kind, &Datum { theta, xi, eta }).unwrap()
}

fn segment(reached: &Reached, case: usize) -> Option<Segment> {
    if case == 1 { reached.case1 } else { reached.case2 }
}

/// The code of one node by the whole ladder, and its scalars.
fn node(kind: Kind, theta: f64, xi: f64, eta: f64) -> (Code, Code, [f32; 4]) {
    let grid = Grid::new(vec![axis("theta", vec![theta]), axis("xi", vec![xi]), axis("eta", vec![eta])]).unwrap();
    let family = Reach(kind);
    let table = family.table(&grid).unwrap();
    let mut fast = [Code(7)];
    table.filter(0, &mut fast);
    let exact = table.exact(0).unwrap().0;
    let mut scalars = [0.0; 4];
    table.scalars(0, exact, &[0, 1, 2, 3], &mut scalars).unwrap();
    (fast[0], exact, scalars)
}

const NESTED: [u8; 5] = [0b0000, 0b0001, 0b0011, 0b0111, 0b1111];

/// Everything in which a row differs from the library.
fn row_faults(kind: Kind, case: usize, row: &[Option<f64>]) -> Vec<String> {
    let [Some(theta), Some(xi), Some(eta), m, q, Some(level), Some(_)] = row[..] else { panic!("{row:?}") };
    let mut faults = Vec::new();
    let found = segment(&at(kind, theta, xi, eta), case);
    let is = match found {
        None => 0,
        Some(s) => {
            1 + [Level::Exists, Level::Exact, Level::Theorem, Level::Paper].iter().position(|l| *l == s.level).unwrap()
        }
    };
    if is != level as usize {
        faults.push(format!("level {is}, must be {level}"));
    }
    let (fast, exact, scalars) = node(kind, theta, xi, eta);
    let nibble = exact.flags() >> (4 * (case - 1)) & 15;
    if nibble != NESTED[level as usize] || exact.counts() != 0 {
        faults.push(format!("code {exact:?}"));
    }
    if fast != Code::UNDECIDED && fast != exact {
        faults.push(format!("filter {fast:?} against {exact:?}"));
    }
    for (name, want, got, single) in [
        ("m", m, found.map(|s| s.m), scalars[2 * (case - 1)]),
        ("q", q, found.map(|s| s.q), scalars[2 * (case - 1) + 1]),
    ] {
        match (want, got) {
            (None, None) if single == NO_VALUE => {}
            (Some(w), Some(g)) if (w - g).abs() <= room(kind, theta, w, q) && single == g as f32 => {}
            _ => faults.push(format!("{name} is {got:?} and {single:?}, must be {want:?}")),
        }
    }
    faults
}

/// What a row's number may be off: it has 15 digits, and was made from the decimal coordinates, which the doubles miss
/// by half a unit; small m come from a difference with 1 (cubic) or 3 + 24 L/q (PH), and so does what one unit moves
/// them.
fn room(kind: Kind, theta: f64, value: f64, q: Option<f64>) -> f64 {
    let size = match kind {
        Kind::Cubic => 1.0,
        Kind::Ph => 3.0 + 24.0 * (theta / 2.0).tan() / q.unwrap(),
    };
    2e-14 * value.abs() + 2e-15 * size
}

fn rows(fixture: &Value, kind: &str, case: usize) -> Vec<Vec<Option<f64>>> {
    let rows = fixture[format!("{kind}_case{case}")].as_array().unwrap();
    rows.iter().map(|row| row.as_array().unwrap().iter().map(Value::as_f64).collect()).collect()
}

#[test]
fn every_field_of_every_vector() {
    let fixture: Value = serde_json::from_str(include_str!("../fixtures/reachable.json")).unwrap();
    let mut levels = [0; 5];
    let mut compared = 0;
    for (kind, name) in KINDS {
        for case in [1, 2] {
            for row in rows(&fixture, name, case) {
                let faults = row_faults(kind, case, &row);
                assert!(faults.is_empty(), "{name} case {case} {row:?}: {faults:?}");
                levels[row[5].unwrap() as usize] += 1;
                compared += 1;
                // The comparison notices another level, another m, another q.
                let mut wrong = row.clone();
                wrong[5] = Some(f64::from((row[5].unwrap() as u8 + 1) % 5));
                assert!(!row_faults(kind, case, &wrong).is_empty());
                for i in [3, 4] {
                    let mut wrong = row.clone();
                    wrong[i] = Some(row[i].map_or(1.0, |x| x + 1e-9 * (1.0 + x)));
                    assert!(!row_faults(kind, case, &wrong).is_empty());
                }
            }
        }
    }
    assert_eq!(compared, 400);
    assert!(levels.iter().all(|n| *n > 20), "{levels:?}");
}

/// m = 1 with no slope of curvature at the round end: the one point of the older method.
fn walton_meek(kind: Kind, case: usize, t: f64) -> (f64, f64) {
    let (s, c, tan, half) = (t.sin(), t.cos(), t.tan(), (t / 2.0).tan());
    let secant2 = 1.0 + half * half;
    match (kind, case) {
        (Kind::Cubic, 1) => (5.0 / 27.0 * (3.0 * s + 5.0 * tan / c), 5.0 / 9.0 * s * tan),
        (Kind::Cubic, _) => (40.0 / 27.0 * tan, 25.0 / 27.0 * tan * tan),
        (Kind::Ph, 1) => {
            let xi = 7.0 / 240.0 * (69.0 + 26.0 * c + 6.0 * (2.0 * t).cos()) * secant2 * half;
            (xi, 7.0 / 60.0 * (13.0 + 6.0 * c) * half * half)
        }
        (Kind::Ph, _) => (7.0 / 240.0 * (26.0 + 75.0 * c) * secant2 * half, 147.0 / 40.0 * half * half),
    }
}

#[test]
fn walton_and_meeks_points_have_m_1_and_lie_on_the_rim() {
    for (kind, _) in KINDS {
        for case in [1, 2] {
            for t in [0.1, PI / 6.0, PI / 4.0, PI / 3.0, 1.4] {
                let (xi, eta) = walton_meek(kind, case, t);
                let q = match kind {
                    Kind::Cubic => 5.0 / 3.0 * t.tan(),
                    Kind::Ph => 3.5 * (t / 2.0).tan(),
                };
                let found = segment(&at(kind, t, xi, eta), case).unwrap();
                assert!(
                    (found.m - 1.0).abs() < 1e-12 && (found.q - q).abs() < 1e-13 * q,
                    "{kind:?} {case} {t}: {found:?}"
                );
                // A little more of q is drawn, a little less is no spiral: the ends move by (1 ± 1e-9) from the base
                // point.
                let near = |f: f64| {
                    let (m, q) = (1.0, q * f);
                    let (x, y) = end(kind, case, t, m, q);
                    segment(&at(kind, t, x, y), case).unwrap().level
                };
                assert_eq!((near(1.0 + 1e-9), near(1.0 - 1e-9)), (Level::Paper, Level::Exists), "{kind:?} {case} {t}");
                // Off by a thousandth it is another segment.
                let off = segment(&at(kind, t, xi * 1.001, eta), case).unwrap();
                assert!((off.m - 1.0).abs() > 1e-5);
            }
        }
    }
}

/// The paper's end points (6), (20) and their mirrors.
fn end(kind: Kind, case: usize, t: f64, m: f64, q: f64) -> (f64, f64) {
    let (s, c) = t.sin_cos();
    let (x, y) = match kind {
        Kind::Cubic => (q * ((1.0 + m) * q + (2.0 * t).sin()) / (6.0 * s), q * s / 3.0),
        Kind::Ph => {
            let f = 2.0 + 3.0 * m + 3.0 * m * m;
            let x = q * (f * q * q + 2.0 * q * (3.0 + m) * s + 24.0 * c * (1.0 - c)) / (120.0 * (1.0 - c));
            (x, q * ((3.0 + m) * q + 12.0 * s) / 60.0)
        }
    };
    if case == 1 { (x, y) } else { (x * c + y * s, x * s - y * c) }
}

/// Nodes at the centres of n x n cells of [0, 4]²: counts of exact, theorem, drawn for both cases.
fn areas(kind: Kind, theta: f64, n: usize) -> [[usize; 3]; 2] {
    let centres: Vec<f64> = (0..n).map(|i| (i as f64 + 0.5) * 4.0 / n as f64).collect();
    let grid = Grid::new(vec![axis("theta", vec![theta]), axis("xi", centres.clone()), axis("eta", centres)]).unwrap();
    let family = Reach(kind);
    let table = family.table(&grid).unwrap();
    let mut codes = vec![Code::UNDECIDED; n * n];
    table.filter(0, &mut codes);
    let mut counts = [[0; 3]; 2];
    for (i, code) in codes.iter().enumerate() {
        let code = if *code == Code::UNDECIDED { table.exact(i as u64).unwrap().0 } else { *code };
        for (case, counts) in counts.iter_mut().enumerate() {
            for (level, count) in counts.iter_mut().enumerate() {
                *count += usize::from(code.flags() >> (4 * case + level + 1) & 1);
            }
        }
    }
    counts
}

/// Shares of the exact area: drawn and whole theorem, cases 1 and 2, with three digits.
const SHARES: [(Kind, f64, [[f64; 2]; 2]); 4] = [
    (Kind::Cubic, PI / 4.0, [[0.581, 0.819], [0.635, 0.845]]),
    (Kind::Ph, PI / 4.0, [[0.619, 0.828], [0.660, 0.849]]),
    (Kind::Cubic, PI / 3.0, [[0.273, 0.662], [0.389, 0.725]]),
    (Kind::Ph, PI / 3.0, [[0.541, 0.791], [0.569, 0.807]]),
];

#[test]
fn areas_in_the_window() {
    const N: usize = 3000;
    for (kind, theta, shares) in SHARES {
        for (counts, shares) in areas(kind, theta, N).iter().zip(shares) {
            let exact = counts[0] as f64;
            // The regions are bounded by curves of length 6 at most, which pass 6 N/4 cells. Each is miscounted by half
            // a cell at most, here too many and there too few: as of so many fair coins, four standard deviations of
            // the sum.
            let cells = 4.0 * 0.5 * (6.0 * N as f64 / 4.0).sqrt();
            let tolerance = 0.0005 + 2.0 * cells / exact;
            assert!(tolerance < 0.003, "{exact} cells, {tolerance}");
            for (share, count) in shares.into_iter().zip([counts[2], counts[1]]) {
                let ours = count as f64 / exact;
                println!("{kind:?} {theta:.4}: {ours:.5}, published {share}, tolerance {tolerance:.5}");
                assert!(
                    (ours - share).abs() <= tolerance,
                    "{kind:?} {theta}: {ours} is not {share} within {tolerance}"
                );
                // And would notice a wrong digit in the second place.
                assert!((ours - share - 0.01).abs() > tolerance);
            }
        }
    }
}

#[test]
fn bad_input_is_named() {
    let complaint = |kind, theta, xi, eta| solve(kind, &Datum { theta, xi, eta }).unwrap_err().to_string();
    assert!(
        complaint(Kind::Cubic, 1.6, 1.0, 1.0)
            .contains("theta is 1.6 (91.673247 degrees); it must be above 0 and below pi/2 for `reach-cubic`")
    );
    assert!(complaint(Kind::Ph, 3.15, 1.0, 1.0).contains("below pi "));
    assert!(complaint(Kind::Ph, -0.1, 1.0, 1.0).contains("theta is -0.1"));
    assert!(complaint(Kind::Ph, 0.5, f64::NAN, 1.0).contains("xi is NaN"));
    assert!(complaint(Kind::Cubic, 0.5, 1.0, f64::INFINITY).contains("eta is inf"));
    assert!(complaint(Kind::Cubic, f64::NAN, 1.0, 1.0).contains("theta is NaN"));
    let grid = Grid::new(vec![axis("theta", vec![0.5, 1.6]), axis("xi", vec![1.0]), axis("eta", vec![1.0])]).unwrap();
    assert!(Reach(Kind::Ph).table(&grid).is_ok());
    assert!(Reach(Kind::Cubic).table(&grid).err().unwrap().to_string().contains("theta is 1.6"));
    let grid = Grid::new(vec![axis("theta", vec![0.5]), axis("eta", vec![1.0]), axis("xi", vec![1.0])]).unwrap();
    assert!(Reach(Kind::Cubic).table(&grid).err().unwrap().to_string().contains("it has: theta, xi, eta"));
}
