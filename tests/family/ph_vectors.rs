//! The published numbers of G² Hermite PH quintics: solutions, windows, and how they compare with the cubic.

use serde_json::Value;
use spiral_atlas::family::cubic::{self, Cubic};
use spiral_atlas::family::ph_quintic::{ANY_SPIRAL, Datum, PhQuintic, Quintic, SOLVABLE, SPIRAL, Solutions, solve};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// Relative accuracy of the published numbers: 13 digits.
const DIGITS: f64 = 1e-12;

/// A, B, spiral, length, energy.
type Row = [f64; 5];

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| f64::from(u8::from(value.as_bool().expect("a number"))))
}

fn rows(all: &Value) -> Vec<Row> {
    let row = |row: &Value| std::array::from_fn(|i| number(&row[i]));
    all.as_array().expect("rows").iter().map(row).collect()
}

/// Everything in which the solutions differ from published ones, sorted by A.
fn faults(want: &[Row], got: &[Quintic]) -> Vec<String> {
    if want.len() != got.len() {
        return vec![format!("{} solutions, must be {}", got.len(), want.len())];
    }
    let mut faults = Vec::new();
    for (want, got) in want.iter().zip(got) {
        for (name, want, got) in [
            ("A", want[0], got.a),
            ("B", want[1], got.b),
            ("length", want[3], got.length),
            ("energy", want[4], got.energy),
        ] {
            if (want - got).abs() > DIGITS * want {
                faults.push(format!("{name} is {got}, must be {want}"));
            }
        }
        if (want[2] == 1.0) != got.spiral {
            faults.push(format!("spiral is {}", got.spiral));
        }
    }
    faults
}

fn grid(phi: [f64; 2], kappa0: Vec<f64>, kappa1: Spacing) -> Grid {
    let values = |name: &str, values: Vec<f64>| Axis::new(name, Spacing::Values(values)).expect("an axis");
    let axes = vec![
        values("phi0", vec![phi[0]]),
        values("phi1", vec![phi[1]]),
        values("kappa0", kappa0),
        Axis::new("kappa1", kappa1).expect("an axis"),
    ];
    Grid::new(axes).expect("a grid")
}

fn codes(family: &dyn Family, grid: &Grid) -> (Vec<Code>, usize) {
    let table = family.table(grid).expect("in the domain");
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    table.filter(0, &mut codes);
    let mut open = 0;
    for (node, code) in (0..).zip(&mut codes) {
        if *code == Code::UNDECIDED {
            open += 1;
            *code = table.exact(node).expect("decided").0;
        }
    }
    (codes, open)
}

#[test]
fn every_published_solution() {
    let fixture: Value = serde_json::from_str(include_str!("../fixtures/ph_g2.json")).expect("JSON");
    let one =
        fixture["g2"]["rows"].as_array().expect("rows").iter().map(|r| (&r[0], &r[1], &r[3], Some(number(&r[2]))));
    let several =
        fixture["g2_multi"].as_array().expect("rows").iter().map(|r| (&r["phi"], &r["kappa"], &r["all"], None));
    let (mut compared, mut spirals) = (0, 0);
    for (phi, kappa, all, any) in one.chain(several) {
        let pair = |v: &Value| [number(&v[0]), number(&v[1])];
        let ([phi0, phi1], [kappa0, kappa1], want) = (pair(phi), pair(kappa), rows(all));
        let datum = Datum { phi0, phi1, kappa0, kappa1 };
        let found = solve(&datum).expect("decided");
        assert_eq!(faults(&want, found.all()), [""; 0], "{datum:?}: {found:?}");
        assert_eq!(found.flags() & SOLVABLE != 0, !want.is_empty());
        assert_eq!(found.flags() & SPIRAL != 0, want.iter().any(|r| r[2] == 1.0));
        assert!(any.is_none_or(|any| (any == 1.0) == (found.flags() & ANY_SPIRAL != 0)), "{datum:?}");
        // The comparison notices a changed number, verdict and count.
        for i in 0..5 {
            let mut wrong = want.clone();
            let Some(row) = wrong.first_mut() else { break };
            row[i] = if i == 2 { 1.0 - row[i] } else { row[i] * (1.0 + 1e-11) };
            assert_eq!(faults(&wrong, found.all()).len(), 1);
            wrong.pop();
            assert_eq!(faults(&wrong, found.all()).len(), 1);
        }
        compared += want.len();
        spirals += found.all().iter().filter(|q| q.spiral).count();
        scalars_agree(&datum, &found);
    }
    println!("{compared} solutions, {spirals} spirals");
    assert!(compared >= 69 && spirals >= 45, "{compared} {spirals}");
}

/// The stored scalars are the chosen spiral's, rounded.
fn scalars_agree(datum: &Datum, found: &Solutions) {
    let grid = grid([datum.phi0, datum.phi1], vec![datum.kappa0], Spacing::Values(vec![datum.kappa1]));
    let table = PhQuintic.table(&grid).expect("in the domain");
    let code = table.exact(0).expect("decided").0;
    assert_eq!(code.flags(), found.flags());
    let (mut fast, mut exact) = ([0.0; 5], [0.0; 5]);
    table.scalars(0, code, &[0, 1, 2, 3, 4], &mut fast).expect("decided");
    table.exact_scalars(0, code, &[0, 1, 2, 3, 4], &mut exact).expect("decided");
    assert_eq!(fast, exact);
    match found.chosen() {
        None => assert_eq!(fast, [NO_VALUE; 5]),
        Some(q) => assert_eq!(fast, [q.a, q.b, q.energy, q.length, q.margin].map(|x| x as f32)),
    }
}

/// φ0, φ1, κ0 and κ1 windows, and how many of 60 x 60 nodes have a PH spiral, a cubic one, both.
type Window = ([f64; 2], [f64; 2], [f64; 2], [usize; 3]);
const WINDOWS: [Window; 3] = [
    ([0.7, 1.4], [0.2, 0.644], [1.0, 20.0], [1130, 1261, 669]),
    ([0.1, 1.5], [0.02, 0.0998], [5.0, 2e4], [958, 1546, 857]),
    ([0.8, 0.9], [0.5, 0.717], [0.79, 1.4], [1038, 362, 263]),
];

fn counted((phi, [lo, hi], [from, to], _): &Window) -> [usize; 3] {
    // The centres of 60 x 60 cells.
    let centres = |lo: f64, hi: f64| (0..60).map(move |i| lo + (hi - lo) * (f64::from(i) + 0.5) / 60.0);
    let kappa1 = centres(from.ln(), to.ln()).map(f64::exp).collect();
    let grid = grid(*phi, centres(*lo, *hi).collect(), Spacing::Values(kappa1));
    let start = std::time::Instant::now();
    let (ph, open) = codes(&PhQuintic, &grid);
    println!("{phi:?}: {open} open after f64, {:?}", start.elapsed());
    let (cubic, _) = codes(&Cubic, &grid);
    let ph: Vec<bool> = ph.iter().map(|c| c.flags() & SPIRAL != 0).collect();
    let cubic: Vec<bool> = cubic.iter().map(|c| c.flags() & cubic::SPIRAL != 0).collect();
    let count = |holds: &dyn Fn(usize) -> bool| (0..3600).filter(|i| holds(*i)).count();
    [count(&|i| ph[i]), count(&|i| cubic[i]), count(&|i| ph[i] && cubic[i])]
}

#[test]
fn windows_beside_the_cubic() {
    for window in &WINDOWS {
        assert_eq!(counted(window), window.3, "{window:?}");
    }
}
