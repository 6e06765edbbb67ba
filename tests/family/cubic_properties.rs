//! What must hold of the library's answers whatever they are: nested conditions, and curves that do what is claimed.

use crate::oracle::data::{Case, Random, drawn, windows};
use crate::oracle::{ANY_SPIRAL, Ends, SPIRAL, THEOREM31, THEOREM31_ANY};
use spiral_atlas::family::cubic::{Datum, Root, solve};
use spiral_atlas::family::{Code, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// THEOREM31 ⊂ THEOREM31_ANY ⊂ SPIRAL ⊂ ANY_SPIRAL, and spirals are roots.
fn nested(flags: u8, solutions: u8) -> bool {
    let implies = |a: u8, b: u8| flags & a == 0 || flags & b != 0;
    let (roots, spirals) = (solutions & 3, solutions >> 2);
    implies(THEOREM31, THEOREM31_ANY)
        && implies(THEOREM31_ANY, SPIRAL)
        && implies(SPIRAL, ANY_SPIRAL)
        && implies(THEOREM31, crate::oracle::SOLVABLE)
        && spirals <= roots
        && (spirals > 0) == (flags & SPIRAL != 0)
}

#[test]
fn conditions_are_nested() {
    let linear =
        |name: &str, lo: f64, hi: f64, count| Axis::new(name, Spacing::Linear { lo, hi, count }).expect("an axis");
    let plain = vec![
        linear("phi0", 0.05, 0.9, 7),
        linear("phi1", 0.1, 2.2, 11),
        linear("kappa0", -0.2, 1.0, 13),
        linear("kappa1", 0.1, 9.0, 17),
    ];
    let normalised = vec![
        linear("phi0", 0.02, 1.0, 11),
        linear("phi1", 0.1, 2.1, 7),
        linear("a", 0.01, 1.0, 13),
        linear("k", 0.05, 3.0, 17),
    ];
    // Where Theorem 3.1 misses most spirals: nearly equal angles.
    let equal = vec![
        linear("phi0", 0.7, 0.8, 5),
        linear("phi1", 0.9, 1.4, 7),
        linear("a", 0.45, 0.65, 11),
        linear("k", 0.54, 1.1, 29),
    ];
    let mut met = [0; 32];
    for axes in [plain, normalised, equal] {
        let grid = Grid::new(axes).expect("a grid");
        let table = by_name("cubic").expect("the family").table(&grid).expect("in the domain");
        let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
        table.filter(0, &mut codes);
        for (node, code) in (0..).zip(codes) {
            let code = if code == Code::UNDECIDED { table.exact(node).expect("decided").0 } else { code };
            assert!(nested(code.flags(), code.counts()), "{}: {code:?}", grid.describe(node));
            met[usize::from(code.flags() & !crate::oracle::SOLVABLE)] += 1;
        }
    }
    // Each step of the inclusion is strict somewhere.
    for flags in [ANY_SPIRAL, SPIRAL | ANY_SPIRAL, THEOREM31_ANY | SPIRAL | ANY_SPIRAL, ALL ^ crate::oracle::SOLVABLE] {
        assert!(met[usize::from(flags)] > 0, "no node has exactly the flags {flags} beside SOLVABLE");
    }
}

#[test]
fn broken_nesting_is_noticed() {
    assert!(nested(ALL, 1 | 1 << 2));
    for bit in [THEOREM31_ANY, SPIRAL, ANY_SPIRAL] {
        assert!(!nested(ALL ^ bit, 1 | 1 << 2));
    }
    assert!(
        !nested(ALL ^ SPIRAL ^ THEOREM31 ^ THEOREM31_ANY, 1 | 1 << 2) && !nested(ALL, 1) && !nested(ALL, 1 | 2 << 2)
    );
}

/// Every flag of the family.
const ALL: u8 = crate::oracle::SOLVABLE | THEOREM31 | THEOREM31_ANY | SPIRAL | ANY_SPIRAL;

type Vector = [f64; 2];

fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

/// The legs of the control polygon.
struct Legs([Vector; 3]);

/// Half a unit in the last place of 1.
const EPS: f64 = f64::EPSILON / 2.0;

impl Legs {
    fn new(d: &Datum, f0: f64, f1: f64) -> Legs {
        let sum = (d.phi0 + d.phi1).sin();
        let (reach0, reach1) = (2.0 * d.phi1.sin() / sum * f0 / 3.0, 2.0 * d.phi0.sin() / sum * f1 / 3.0);
        let first = [reach0 * d.phi0.cos(), -reach0 * d.phi0.sin()];
        let last = [reach1 * d.phi1.cos(), reach1 * d.phi1.sin()];
        Legs([first, [2.0 - first[0] - last[0], -first[1] - last[1]], last])
    }

    /// A bound of the error of each leg, when f0 and f1 are off by `near`: a dozen roundings of numbers up to `size`,
    /// of which the sine of the sum may have lost `1 / sin` units.
    fn error(&self, d: &Datum, near: f64) -> f64 {
        let size = 2.0 + length(self.0[0]) + length(self.0[2]);
        let reach = 2.0 / (d.phi0 + d.phi1).sin();
        size * 16.0 * EPS * (1.0 + reach) + near * reach
    }

    /// Curvature at `t`, and a bound of its error.
    fn curvature(&self, t: f64, leg_error: f64) -> (f64, f64) {
        let [a, b, c] = self.0;
        let at = |i: usize| 3.0 * ((1.0 - t) * ((1.0 - t) * a[i] + t * b[i]) + t * ((1.0 - t) * b[i] + t * c[i]));
        let slope = |i: usize| 6.0 * ((1.0 - t) * (b[i] - a[i]) + t * (c[i] - b[i]));
        let (first, second) = ([at(0), at(1)], [slope(0), slope(1)]);
        let speed = length(first);
        let kappa = cross(first, second) / speed.powi(3);
        // Errors of P' and P'' are at most 3 and 12 times that of a leg; first order, doubled.
        let turn = 3.0 * leg_error * length(second) + 12.0 * leg_error * speed;
        (kappa, 2.0 * (turn / speed.powi(3) + 3.0 * kappa.abs() * 3.0 * leg_error / speed))
    }

    /// In how many of `steps` steps the curvature certainly falls, and in how many it certainly rises.
    fn falls_and_rises(&self, leg_error: f64, steps: usize) -> (usize, usize) {
        let samples: Vec<_> = (0..=steps).map(|i| self.curvature(i as f64 / steps as f64, leg_error)).collect();
        let certain = |w: &[(f64, f64)], sign: f64| sign * (w[1].0 - w[0].0) > w[0].1 + w[1].1;
        (
            samples.windows(2).filter(|w| certain(w, -1.0)).count(),
            samples.windows(2).filter(|w| certain(w, 1.0)).count(),
        )
    }
}

/// Absolute accuracy that `solve` promises of f0 and f1.
const NEAR: f64 = crate::oracle::compare::ROOT_ACCURACY;

/// What is wrong with the ends of the curve of a root: directions by construction, curvatures within the derived error.
fn end_faults(d: &Datum, root: &Root) -> Vec<String> {
    let legs = Legs::new(d, root.f0, root.f1);
    let error = legs.error(d, NEAR);
    let mut faults = vec![];
    for (t, want) in [(0.0, d.kappa0), (1.0, d.kappa1)] {
        let (got, near) = legs.curvature(t, error);
        if (got - want).abs() > near {
            faults.push(format!("curvature at {t} is {got}, asked {want}, error at most {near}"));
        }
    }
    let [first, _, last] = legs.0;
    for (name, got, want) in [("start", -first[1].atan2(first[0]), d.phi0), ("end", last[1].atan2(last[0]), d.phi1)] {
        if (got - want).abs() > 8.0 * EPS * (1.0 + want) {
            faults.push(format!("{name} angle is {got}, asked {want}"));
        }
    }
    faults
}

/// Roots of data with ordinary numbers, with what they were solved from.
fn roots(seed: u64, draws: usize) -> Vec<(Datum, Root)> {
    let (mut r, mut found) = (Random(seed), vec![]);
    for i in 0..draws {
        let Case { phi0, phi1, ends } = if i % 4 == 0 { windows(&mut r) } else { drawn(&mut r) };
        let Ends::Curvature { kappa0, kappa1 } = ends else { continue };
        if phi0 + phi1 > 3.0 {
            continue;
        }
        let datum = Datum { phi0, phi1, kappa0, kappa1 };
        let solutions = solve(&datum).expect("in the domain");
        found.extend(solutions.roots().iter().map(|root| (datum, *root)));
    }
    found
}

#[test]
fn curves_have_the_asked_ends() {
    let (mut checked, mut sharp) = (0, 0);
    for (datum, root) in roots(11, 8_000) {
        assert_eq!(end_faults(&datum, &root), [""; 0], "{datum:?}, {root:?}");
        checked += 1;
        // How often the check says something: a millionth more in f0 is noticed.
        sharp += usize::from(!end_faults(&datum, &Root { f0: root.f0 * (1.0 + 1e-6), ..root }).is_empty());
    }
    println!("ends: {checked} curves, {sharp} of them noticed when f0 is a millionth off");
    assert!(checked > 4_000 && sharp > checked * 9 / 10);
}

#[test]
fn spirals_have_rising_curvature_and_others_do_not() {
    let (mut spirals, mut others) = (0, 0);
    for (datum, root) in roots(12, 8_000) {
        // The sampled curve is that of the rounded root: whatever f0 and f1 are off moves it as a whole.
        let legs = Legs::new(&datum, root.f0, root.f1);
        let error = legs.error(&datum, 0.0);
        assert_eq!(root.spiral, root.margin >= 0.0, "{datum:?}, {root:?}");
        if root.spiral && root.margin > 1e-6 {
            let (falls, rises) = legs.falls_and_rises(error, 1_000);
            assert!(falls == 0 && rises > 0, "{falls} falls, {rises} rises: {datum:?}, {root:?}");
            spirals += 1;
        }
        // A quintic at -0.05 beside coefficients of 1 stays below zero over at least 0.005 of [0, 1].
        if root.margin < -0.05 {
            let (falls, _) = legs.falls_and_rises(error, 1_000);
            assert!(falls > 0, "no fall: {datum:?}, {root:?}");
            others += 1;
        }
    }
    println!("curvature: {spirals} spirals rise, {others} others fall somewhere");
    assert!(spirals > 300 && others > 1_000);
}

/// The sampling can tell: a spiral run backwards falls.
#[test]
fn a_reversed_spiral_is_noticed() {
    let datum = Datum { phi0: 0.7, phi1: 1.4, kappa0: 0.4, kappa1: 4.0 };
    let legs = Legs::new(&datum, 1.660102747681678, 0.7698506660841348);
    let error = legs.error(&datum, 0.0);
    let (falls, rises) = legs.falls_and_rises(error, 1_000);
    assert!(falls == 0 && rises > 900);
    let [[a, b], [c, d], [e, f]] = legs.0;
    let (falls, rises) = Legs([[e, -f], [c, -d], [a, -b]]).falls_and_rises(error, 1_000);
    assert!(falls > 900 && rises == 0, "mirrored and reversed: {falls} falls, {rises} rises");
}

/// At a small first angle and an obtuse second one the spiral polynomial is least within that angle of an end.
#[test]
fn margins_least_just_inside_an_end_are_decided() {
    for phi0 in [1e-6, 1e-8, 1e-10, 1e-30, 1e-100] {
        for (phi1, kappa0, kappa1) in [(2.0, 1e-4, 0.7), (1.58, 0.1, 0.7), (2.5, 1e-3, 3.0)] {
            let datum = Datum { phi0, phi1, kappa0: kappa0 * phi0, kappa1 };
            let found = solve(&datum).unwrap_or_else(|error| panic!("{error}"));
            for root in found.roots() {
                assert!(!root.spiral && root.margin < 0.0, "{datum:?}: {root:?}");
            }
        }
    }
}
