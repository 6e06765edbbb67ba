//! PH quintics with given ends against the oracle: random data, folds between neighbouring doubles, grids. Nothing may
//! be wrong.

use crate::oracle::data::Random;
use crate::oracle::ph::{Curve, Verdict, judge};
use spiral_atlas::family::ph_quintic::{Datum, PhQuintic, Solutions, solve};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};

fn grid(datum: [f64; 4]) -> Grid {
    let axis = |(name, x): (&str, f64)| Axis::new(name, Spacing::Values(vec![x])).expect("one value");
    Grid::new(["phi0", "phi1", "kappa0", "kappa1"].into_iter().zip(datum).map(axis).collect()).expect("a grid")
}

fn solved([phi0, phi1, kappa0, kappa1]: [f64; 4]) -> Solutions {
    solve(&Datum { phi0, phi1, kappa0, kappa1 }).expect("an answer")
}

fn code_faults(want: &Verdict, code: Code) -> Vec<String> {
    let mut faults = vec![];
    if code.flags() != want.flags {
        faults.push(format!("flags {:#b}, must be {:#b}", code.flags(), want.flags));
    }
    if code.counts() != want.solutions() {
        faults.push(format!("solutions {:#o}, must be {:#o}", code.counts(), want.solutions()));
    }
    faults
}

/// What [`solve`] promises, with what the oracle's quadrature may be off.
fn curve_faults(want: &Curve, got: &Curve) -> Vec<String> {
    let mut faults = vec![];
    let relative = 2f64.powi(-36);
    for (name, want, got, room) in [
        ("A", want.a, got.a, relative * want.a),
        ("B", want.b, got.b, relative * want.b),
        ("length", want.length, got.length, relative * want.length),
        ("energy", want.energy, got.energy, 1e-8 * want.energy),
        ("margin", want.margin, got.margin, 2f64.powi(-30)),
    ] {
        if !((want - got).abs() <= room || name == "energy" && want.is_nan()) {
            faults.push(format!("{name} is {got:?}, must be {want:?}"));
        }
    }
    if want.spiral != got.spiral {
        faults.push(format!("spiral is {}", got.spiral));
    }
    faults
}

fn answer_faults(want: &Verdict, got: &Solutions) -> Vec<String> {
    let as_curve = |q: &spiral_atlas::family::ph_quintic::Quintic| Curve {
        a: q.a,
        b: q.b,
        length: q.length,
        energy: q.energy,
        margin: q.margin,
        spiral: q.spiral,
    };
    let mut faults = vec![];
    if got.flags() != want.flags || got.all().len() != want.curves.len() {
        faults.push(format!("{} solutions, flags {:#b}", got.all().len(), got.flags()));
    }
    for (want, got) in want.curves.iter().zip(got.all()) {
        faults.extend(curve_faults(want, &as_curve(got)));
    }
    match (want.chosen(), got.chosen()) {
        (None, None) => {}
        (Some(w), Some(g)) if curve_faults(w, &as_curve(g)).is_empty() => {}
        (w, g) => faults.push(format!("chosen {g:?}, must be {w:?}")),
    }
    faults
}

fn scalar_faults(want: &Verdict, got: [f32; 5]) -> Vec<String> {
    let Some(best) = want.chosen() else {
        return if got == [NO_VALUE; 5] { vec![] } else { vec![format!("scalars {got:?} without a spiral")] };
    };
    let mut faults = vec![];
    for (i, want) in [(0, best.a), (1, best.b), (3, best.length), (4, best.margin)] {
        // The oracle's double is rounded itself: twice rounding moves at most one step, and only near a tie.
        if got[i] != want as f32 && got[i] != want.next_up() as f32 && got[i] != want.next_down() as f32 {
            faults.push(format!("scalar {i} is {}, must be {want}", got[i]));
        }
    }
    if (f64::from(got[2]) / best.energy - 1.0).abs() > 1.3e-7 {
        faults.push(format!("energy {} must be {}", got[2], best.energy));
    }
    faults
}

#[derive(Default)]
struct Tally {
    cases: usize,
    solutions: [usize; 4],
    spirals: usize,
    filtered: usize,
    wrong: Vec<String>,
}

impl Tally {
    /// Compares every way to an answer.
    fn case(&mut self, datum: [f64; 4]) -> Verdict {
        let want = judge(datum);
        let grid = grid(datum);
        let table = PhQuintic.table(&grid).expect("in the domain");
        let mut fast = [Code(0x5aa5)];
        table.filter(0, &mut fast);
        let exact = table.exact(0).expect("decided").0;
        let mut faults = code_faults(&want, exact);
        if fast[0] != Code::UNDECIDED {
            self.filtered += 1;
            faults.extend(code_faults(&want, fast[0]).into_iter().map(|f| format!("filter: {f}")));
        }
        faults.extend(answer_faults(&want, &solved(datum)));
        let mut scalars = [0.0; 5];
        table.scalars(0, exact, &[0, 1, 2, 3, 4], &mut scalars).expect("decided");
        faults.extend(scalar_faults(&want, scalars));
        self.wrong.extend(faults.into_iter().map(|f| format!("{datum:?}: {f}")));
        self.cases += 1;
        self.solutions[want.curves.len().min(3)] += 1;
        self.spirals += want.curves.iter().filter(|c| c.spiral).count();
        want
    }

    fn finish(&self, name: &str, least: usize) {
        let Tally { cases, solutions, spirals, filtered, wrong } = self;
        println!(
            "{name}: {cases} cases, solutions {solutions:?}, {spirals} spirals, {filtered} by the filter, {} wrong",
            wrong.len()
        );
        assert!(wrong.is_empty(), "{name}: {} wrong, the first: {:#?}", wrong.len(), &wrong[..wrong.len().min(5)]);
        assert!(*cases >= least, "{cases}");
    }
}

/// Windows where spirals are common.
fn window(r: &mut Random) -> [f64; 4] {
    let (phi0, phi1) = r.angles();
    let kappa0 = phi0.sin() * r.uniform(0.05, 1.05);
    [phi0, phi1, kappa0, phi1.sin() * r.decades(-0.3, 2.0)]
}

#[test]
fn random_windows() {
    let (mut r, mut tally) = (Random(21), Tally::default());
    for _ in 0..250 {
        tally.case(window(&mut r));
    }
    tally.finish("random windows", 250);
    assert!(tally.spirals > 10 && tally.solutions[..3].iter().all(|n| *n > 5) && tally.filtered > 245);
}

/// Several solutions are common for nearly equal angles.
#[test]
fn near_symmetric_data() {
    let (mut r, mut tally) = (Random(22), Tally::default());
    for _ in 0..50 {
        let phi0 = r.uniform(0.3, 1.1);
        let phi1 = phi0 * r.uniform(1.0, 1.3);
        let kappa0 = phi0.sin() * r.uniform(0.7, 1.0);
        tally.case([phi0, phi1, kappa0, phi1.sin() * r.uniform(0.95, 1.3)]);
    }
    tally.finish("near symmetric", 50);
    assert!(tally.solutions[3] > 5 && tally.spirals > 3, "{:?}", tally.solutions);
}

/// Symmetric data where one solution is about to become three, and their neighbours.
#[test]
fn forks() {
    let mut tally = Tally::default();
    let tiny = [1e-4, 1e-5, 1e-7, 1e-9].map(|x| (x, x));
    for (phi, kappa) in
        tiny.into_iter().chain([(1.0, 0.5835894701), (0.3, 0.2867208939305582), (0.01, 0.009999500030548204)])
    {
        // The oracle cannot tell that mirror images have one energy; that they are such images can be seen.
        let symmetric = solved([phi, phi, kappa, kappa]);
        let curves = symmetric.all();
        assert!(matches!(curves.len(), 1 | 3), "{phi} {kappa}: {curves:?}");
        for (one, other) in curves.iter().zip(curves.iter().rev()) {
            assert!((one.a - other.b).abs() < 1e-9 * one.a, "{phi} {kappa}: {curves:?}");
        }
        for kappa1 in [kappa.next_up(), kappa.next_down()] {
            tally.case([phi, phi, kappa, kappa1]);
        }
    }
    tally.finish("forks", 14);
    assert!(tally.solutions[1] > 0 && tally.solutions[3] > 0, "{:?}", tally.solutions);
}

/// Circular arcs of tiny angles and what is near them: three solutions as near each other as the angle.
#[test]
fn forks_of_tiny_angles() {
    let (mut r, mut tally) = (Random(26), Tally::default());
    for x in [1e-8_f64, 1e-12, 1e-20, 1e-30, 1e-50, 1e-80] {
        for i in 0..8 {
            let datum = match i % 4 {
                0 => [0; 4].map(|_| [x, x.next_up(), x.next_down()][r.below(3) as usize]),
                1 => [0; 4].map(|_| x * (1.0 + r.decades(-16.0, -1.0))),
                // Where the curvatures exceed the angle by a share, three solutions are the root of that apart, and a
                // share of its power of 3/2 in a difference of both ends makes two of them merge.
                _ => {
                    let share = r.decades(-9.0, -1.0);
                    let apart = 0.3 * share.powf(1.5) * r.uniform(-1.0, 1.0);
                    [x, x * (1.0 + apart), x * (1.0 + share), x * (1.0 + share)]
                }
            };
            // The oracle cannot tell that mirror images have one energy.
            if datum != [x; 4] {
                tally.case(datum);
            }
        }
    }
    tally.finish("forks of tiny angles", 40);
    assert!(tally.solutions[1] > 5 && tally.solutions[3] > 5, "{:?}", tally.solutions);
}

#[test]
fn no_curvature_at_an_end() {
    let (mut r, mut tally) = (Random(23), Tally::default());
    for i in 0..60 {
        let [phi0, phi1, kappa0, kappa1] = window(&mut r);
        tally.case(if i % 3 == 0 { [phi0, phi1, kappa0, 0.0] } else { [phi0, phi1, 0.0, kappa1] });
    }
    tally.finish("no curvature at an end", 60);
    assert!(tally.solutions[1] > 10);
}

/// Tiny angles, and tangents that are almost parallel: there the two equations almost coincide.
#[test]
fn rims_of_the_domain() {
    let (mut r, mut tally) = (Random(24), Tally::default());
    for i in 0..40 {
        let phi0 = if i % 4 == 0 { r.decades(-8.0, -1.0) } else { r.uniform(0.1, 1.5) };
        let phi1 = if i % 2 == 0 { r.uniform(0.1, 1.5) } else { std::f64::consts::PI - phi0 - r.decades(-6.0, -1.0) };
        tally.case([phi0, phi1, r.decades(-3.0, 1.0), r.decades(-3.0, 3.0)]);
    }
    tally.finish("rims", 40);
}

/// Neighbouring doubles of κ1 between which the library's answer changes.
#[test]
fn boundaries_between_neighbouring_doubles() {
    let (mut r, mut tally) = (Random(25), Tally::default());
    let (mut folds, mut rims, mut outer) = (0, 0, 0);
    while tally.cases < 120 {
        let [phi0, phi1, kappa0, kappa1] = if r.below(2) == 0 {
            window(&mut r)
        } else {
            let phi0 = r.uniform(0.3, 1.1);
            [phi0, phi0 * r.uniform(1.0, 1.3), phi0.sin() * r.uniform(0.7, 1.0), phi0.sin() * r.uniform(1.0, 1.3)]
        };
        if phi0 + phi1 > 3.1 {
            continue;
        }
        let code = |kappa1: f64| {
            let grid = grid([phi0, phi1, kappa0, kappa1]);
            let table = PhQuintic.table(&grid).expect("in the domain");
            let mut code = [Code::UNDECIDED];
            table.filter(0, &mut code);
            if code[0] == Code::UNDECIDED { table.exact(0).expect("decided").0 } else { code[0] }
        };
        let (mut low, mut high) = (kappa1, kappa1 * r.uniform(1.05, 3.0));
        let first = code(low);
        if code(high) == first {
            continue;
        }
        while high > low.next_up() {
            let middle = f64::from_bits(low.to_bits().midpoint(high.to_bits()));
            if code(middle) == first { low = middle } else { high = middle }
        }
        let (one, two) = (tally.case([phi0, phi1, kappa0, low]), tally.case([phi0, phi1, kappa0, high]));
        folds += usize::from(one.curves.len() != two.curves.len());
        rims += usize::from(one.solutions() >> 3 != two.solutions() >> 3);
        outer += usize::from((one.flags ^ two.flags) & 4 != 0);
    }
    tally.finish("neighbouring doubles", 120);
    println!("  folds {folds}, rims of spirals {rims}, outer bounds {outer}");
    assert!(folds >= 10 && rims >= 5 && outer >= 10);
}

/// Both curvatures 0: `w1 = 0`, so `AB + 6 cos Φ B² = 30 sin φ0 / sin Φ` and the same with the ends exchanged; by hand,
/// one solution.
#[test]
fn no_curvature_at_both_ends() {
    for (phi0, phi1) in [(0.7, 1.4), (0.3, 0.3), (0.2, 2.5)] {
        let found = solved([phi0, phi1, 0.0, 0.0]);
        let [q] = found.all() else { panic!("{found:?}") };
        let half: f64 = 0.5 * (phi0 + phi1);
        let side = |x: f64| q.a * q.b + 6.0 * half.cos() * x * x;
        assert!((side(q.b) / (30.0 * phi0.sin() / half.sin()) - 1.0).abs() < 1e-10, "{q:?}");
        assert!((side(q.a) / (30.0 * phi1.sin() / half.sin()) - 1.0).abs() < 1e-10, "{q:?}");
        assert!(!q.spiral && found.flags() == 1);
    }
}

#[test]
fn every_change_is_noticed() {
    let datum = [0.514, 1.536, 0.2049, 3.77];
    let want = judge(datum);
    assert_eq!((want.curves.len(), want.solutions()), (3, 3 | 3 << 3));
    let code = Code::new(want.flags, want.solutions());
    assert!(code_faults(&want, code).is_empty());
    for bit in 0..16 {
        assert_eq!(code_faults(&want, Code(code.0 ^ 1 << bit)).len(), 1, "bit {bit}");
    }
    let found = solved(datum);
    assert!(answer_faults(&want, &found).is_empty());
    let mut fewer = want.clone();
    fewer.curves.pop();
    assert!(!answer_faults(&fewer, &found).is_empty());
    for i in 0..3 {
        let mut changed = want.clone();
        changed.curves[i].spiral ^= true;
        assert!(!answer_faults(&changed, &found).is_empty());
        let changes: [fn(&mut Curve); 4] =
            [|c| c.a *= 1.0 + 1e-9, |c| c.b *= 1.0 + 1e-9, |c| c.length *= 1.0 + 1e-9, |c| c.energy *= 1.0 + 1e-6];
        for change in changes {
            let mut changed = want.clone();
            change(&mut changed.curves[i]);
            assert!(!answer_faults(&changed, &found).is_empty());
        }
    }
    let best = want.chosen().expect("a spiral");
    let right = [best.a, best.b, best.energy, best.length, best.margin].map(|x| x as f32);
    assert!(scalar_faults(&want, right).is_empty());
    for i in 0..5 {
        let mut wrong = right;
        wrong[i] = f32::from_bits(wrong[i].to_bits() + 2);
        assert_eq!(scalar_faults(&want, wrong).len(), 1, "{i}");
    }
}
