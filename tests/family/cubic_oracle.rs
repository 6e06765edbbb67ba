//! The library against the oracle: random data, and every place where a verdict is hard. Nothing may be wrong.

use crate::oracle::compare::{
    Answer, MARGIN_ACCURACY, ROOT_ACCURACY, Tally, answer_faults, code_faults, code_of, grid_of, scalar_faults,
};
use crate::oracle::data::{Case, Random, drawn, extreme, near_double, rim_angles, triple, windows};
use crate::oracle::{Ends, Verdict, in_domain, judge, judge_ends, judge_thoroughly};
use spiral_atlas::family::cubic::{Datum, solve};
use spiral_atlas::family::{Code, NO_VALUE, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

fn compare(name: &str, seed: u64, count: usize, draw: fn(&mut Random) -> Case) -> Tally {
    let (mut r, mut tally) = (Random(seed), Tally::default());
    for _ in 0..count {
        tally.case(&draw(&mut r));
    }
    tally.finish(name, count);
    tally
}

#[test]
fn random_windows() {
    let tally = compare("random windows", 1, 10_000, windows);
    assert!(tally.spirals > 100 && tally.filtered > 9_000);
}

#[test]
fn drawn_by_their_roots() {
    let tally = compare("drawn by (f0, f1)", 2, 10_000, drawn);
    assert!(tally.spirals > 500 && tally.several > 1_000 && tally.filtered > 8_000);
}

#[test]
fn almost_double_roots() {
    let tally = compare("almost double roots", 3, 4_000, near_double);
    assert!(tally.several > 1_000);
}

#[test]
fn around_the_triple_root() {
    let tally = compare("around the triple root", 4, 2_000, triple);
    assert!(tally.spirals > 50);
}

#[test]
fn extreme_data() {
    let tally = compare("extreme data", 5, 2_000, extreme);
    assert!(tally.spirals > 50);
}

/// `a = k = 1/4` is on the discriminant exactly, where three roots are one and the curve is a parabola.
#[test]
fn the_exact_tie() {
    let mut tally = Tally::default();
    for (phi0, phi1) in [(0.7, 1.4), (0.1, 1.5), (0.8, 0.9), (0.5, 0.5), (0.3, 2.5), (1.2, 0.4)] {
        let v = tally.case(&Case { phi0, phi1, ends: Ends::Normalised { a: 0.25, k: 0.25 } });
        assert_eq!((v.flags & crate::oracle::SOLVABLE, v.roots.len(), v.roots[0].f0, v.roots[0].f1), (0, 1, 2.0, 2.0));
    }
    tally.finish("the exact tie", 6);
}

/// A double as an integer in the order of the doubles, and back.
fn key(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

fn double(key: i64) -> f64 {
    f64::from_bits(if key < 0 { i64::MIN - key } else { key } as u64)
}

fn coordinate(case: &Case, which: usize) -> f64 {
    match (which, case.ends) {
        (0, _) => case.phi0,
        (1, _) => case.phi1,
        (2, Ends::Curvature { kappa0: x, .. } | Ends::Normalised { a: x, .. }) => x,
        (_, Ends::Curvature { kappa1: x, .. } | Ends::Normalised { k: x, .. }) => x,
    }
}

fn moved(case: &Case, which: usize, x: f64) -> Case {
    let mut case = *case;
    match (which, &mut case.ends) {
        (0, _) => case.phi0 = x,
        (1, _) => case.phi1 = x,
        (2, Ends::Curvature { kappa0: slot, .. } | Ends::Normalised { a: slot, .. }) => *slot = x,
        (_, Ends::Curvature { kappa1: slot, .. } | Ends::Normalised { k: slot, .. }) => *slot = x,
    }
    case
}

/// The neighbouring doubles of one coordinate between which the library's answer changes, if it changes at all.
fn boundary(case: &Case, which: usize, to: f64) -> Option<(Case, Case)> {
    let (mut lo, mut hi) = (key(coordinate(case, which)), key(to));
    let code = |k: i64| code_of(&moved(case, which, double(k)));
    let first = code(lo)?;
    if code(hi)? == first {
        return None;
    }
    while lo.abs_diff(hi) > 1 {
        let mid = lo.midpoint(hi);
        if code(mid)? == first { lo = mid } else { hi = mid }
    }
    Some((moved(case, which, double(lo)), moved(case, which, double(hi))))
}

#[test]
fn boundaries_between_neighbouring_doubles() {
    let (mut r, mut tally) = (Random(6), Tally::default());
    let mut kinds = [0; 7];
    for _ in 0..5_000 {
        let case = if r.below(3) == 0 { windows(&mut r) } else { drawn(&mut r) };
        let which = r.below(4) as usize;
        let reach = [0.5, 0.1, 0.02][r.below(3) as usize];
        let to = coordinate(&case, which) * (1.0 + r.uniform(-reach, reach));
        if which < 2 && !in_domain(moved(&case, which, to).phi0, moved(&case, which, to).phi1) {
            continue;
        }
        let Some((one, two)) = boundary(&case, which, to) else { continue };
        let (one, two) = (tally.case(&one), tally.case(&two));
        let flips = u32::from(one.flags ^ two.flags);
        let counts = [one.roots.len() != two.roots.len(), one.solutions() >> 2 != two.solutions() >> 2];
        for (kind, slot) in kinds.iter_mut().enumerate() {
            *slot += usize::from(if kind < 5 { flips >> kind & 1 == 1 } else { counts[kind - 5] });
        }
    }
    tally.finish("neighbouring doubles", 1_000);
    println!("  of them SOLVABLE, THEOREM31, THEOREM31_ANY, SPIRAL, ANY_SPIRAL, roots, spirals: {kinds:?}");
    assert!(kinds.iter().all(|n| *n >= 20), "{kinds:?}: every kind of boundary must be met");
}

/// Whole grids with four different axis lengths, the filter run in one piece and in pieces.
#[test]
fn grids() {
    let (mut r, mut wrong, mut compared, mut abstained) = (Random(7), vec![], 0, 0);
    for round in 0..6 {
        let normalised = round % 2 == 1;
        let mut axis = |name: &str, n: usize, lo: f64, hi: f64| {
            let mut values: Vec<f64> = (0..n).map(|_| r.uniform(lo, hi)).collect();
            values.sort_by(f64::total_cmp);
            Axis::new(name, Spacing::Values(values)).expect("different values")
        };
        let names = if normalised { ["a", "k"] } else { ["kappa0", "kappa1"] };
        let (least, most) = if normalised { (0.05, 2.0) } else { (-0.3, 8.0) };
        let axes = vec![
            axis("phi0", 5, 0.05, 0.9),
            axis("phi1", 7, 0.3, 2.2),
            axis(names[0], 6, least, 0.8),
            axis(names[1], 11, least, most),
        ];
        let grid = Grid::new(axes).expect("four axes");
        let table = by_name("cubic").expect("the family").table(&grid).expect("in the domain");
        let sentinel = Code(0x5aa5);
        let mut codes = vec![sentinel; grid.len() as usize];
        table.filter(0, &mut codes);
        let start = r.below(grid.len() - 40);
        let mut piece = [sentinel; 39];
        table.filter(start, &mut piece);
        assert_eq!(piece, codes[start as usize..][..39], "a piece of the grid from {start} differs from the whole");
        for node in 0..grid.len() {
            let [phi0, phi1, x, y, _] = grid.node(node);
            let ends =
                if normalised { Ends::Normalised { a: x, k: y } } else { Ends::Curvature { kappa0: x, kappa1: y } };
            let want = judge_ends(phi0, phi1, ends);
            let exact = table.exact(node).expect("decided").0;
            compared += 1;
            wrong.extend(
                code_faults(&want, exact).into_iter().map(|f| format!("exact at {}: {f}", grid.describe(node))),
            );
            if codes[node as usize] == Code::UNDECIDED {
                abstained += 1;
            } else {
                let found = code_faults(&want, codes[node as usize]);
                wrong.extend(found.into_iter().map(|f| format!("filter at {}: {f}", grid.describe(node))));
            }
        }
    }
    println!("grids: {compared} nodes, abstained {abstained}, wrong {}", wrong.len());
    assert!(wrong.is_empty(), "{} wrong, the first: {:?}", wrong.len(), wrong.first());
    assert!(compared == 6 * 5 * 7 * 6 * 11 && abstained < compared / 100);
}

/// Angles around the rim of the domain: the solver refuses exactly those outside.
#[test]
fn the_domain_is_exact() {
    let (mut r, mut inside, mut outside) = (Random(8), 0, 0);
    for _ in 0..2_000 {
        let (mut phi0, mut phi1) = rim_angles(&mut r);
        match r.below(4) {
            0 => phi1 = r.nudge(std::f64::consts::PI - phi0, 4),
            1 => (phi0, phi1) = (phi1, r.nudge(std::f64::consts::PI - phi1, 2)),
            2 if r.below(10) == 0 => phi0 = -phi0,
            _ => {}
        }
        let accepted = solve(&Datum { phi0, phi1, kappa0: 0.4, kappa1: 4.0 }).is_ok();
        assert_eq!(accepted, in_domain(phi0, phi1), "phi0 = {phi0:?}, phi1 = {phi1:?}");
        if accepted { inside += 1 } else { outside += 1 }
    }
    println!("domain: {inside} inside, {outside} outside, wrong 0");
    assert!(inside > 500 && outside > 200);
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(solve(&Datum { phi0: 0.7, phi1: 1.4, kappa0: bad, kappa1: 4.0 }).is_err());
        assert!(solve(&Datum { phi0: bad, phi1: 1.4, kappa0: 0.4, kappa1: 4.0 }).is_err());
    }
}

/// The oracle skips curves whose end data are in the wrong order; examined, none of them is a spiral.
#[test]
fn the_oracle_finds_no_spiral_in_the_wrong_order() {
    let (mut r, mut examined) = (Random(9), 0);
    while examined < 500 {
        let Case { phi0, phi1, ends } = drawn(&mut r);
        let quick = judge_ends(phi0, phi1, ends);
        let thorough = judge_thoroughly(phi0, phi1, ends);
        examined += usize::from(!quick.roots.is_empty() && (phi0 >= phi1 || quick.gap != thorough.gap));
        assert_eq!((quick.flags, &quick.roots), (thorough.flags, &thorough.roots), "{phi0:?}, {phi1:?}, {ends:?}");
    }
}

/// Circles nested by their centres and radii, against `Q < 0`, which the oracle uses for other signs only.
#[test]
fn the_oracle_agrees_with_itself_on_nested_circles() {
    let (mut r, mut yes, mut no) = (Random(10), 0, 0);
    for _ in 0..3_000 {
        let Case { phi0, phi1, ends } = windows(&mut r);
        let Ends::Curvature { kappa0, kappa1 } = ends else { continue };
        if kappa0 <= 0.0 || kappa0 >= kappa1 || phi0 >= phi1 {
            continue;
        }
        let by_circles = judge(phi0, phi1, kappa0, kappa1).flags & crate::oracle::ANY_SPIRAL != 0;
        let q = (kappa0 - phi0.sin()) * (kappa1 - phi1.sin()) + (0.5 * (phi1 - phi0)).sin().powi(2);
        if q.abs() > 1e-9 {
            assert_eq!(by_circles, q < 0.0, "{phi0:?}, {phi1:?}, {kappa0:?}, {kappa1:?}");
            if by_circles { yes += 1 } else { no += 1 }
        }
    }
    assert!(yes > 100 && no > 100, "{yes} nested, {no} not");
}

/// A datum with two roots, both spirals, the first one chosen.
fn example() -> (Verdict, Case) {
    let ends = Ends::Curvature { kappa0: 0.204242752, kappa1: 1.23200825 };
    let case = Case { phi0: 0.411969, phi1: 0.754766, ends };
    (judge_ends(case.phi0, case.phi1, case.ends), case)
}

#[test]
fn a_flipped_bit_of_a_code_is_noticed() {
    let (want, _) = example();
    let right = Code::new(want.flags, want.solutions());
    assert!(code_faults(&want, right).is_empty());
    for bit in 0..16 {
        assert_eq!(code_faults(&want, Code(right.0 ^ 1 << bit)).len(), 1, "bit {bit}");
    }
}

#[test]
fn a_changed_answer_is_noticed() {
    let (want, _) = example();
    assert_eq!((want.roots.len(), want.solutions() >> 2), (2, 2));
    let roots = want.roots.iter().map(crate::oracle::compare::root_of).collect::<Vec<_>>();
    let chosen = want.chosen().map(crate::oracle::compare::root_of);
    let right = Answer { flags: want.flags, roots, chosen };
    let changed = |change: fn(&mut Answer)| {
        let mut answer = right.clone();
        change(&mut answer);
        answer_faults(&want, &answer).len()
    };
    assert_eq!(changed(|_| ()), 0);
    assert_eq!(changed(|a| a.roots[1].f0 += 2.0 * ROOT_ACCURACY), 1);
    assert_eq!(changed(|a| a.roots[1].f1 -= 2.0 * ROOT_ACCURACY), 1);
    assert_eq!(changed(|a| a.roots[1].margin += 2.0 * MARGIN_ACCURACY), 1);
    assert_eq!(changed(|a| a.roots[1].margin = f64::NAN), 1);
    assert_eq!(changed(|a| a.roots[1].theorem31 ^= true), 1);
    assert_eq!(changed(|a| a.roots[1].spiral ^= true), 2);
    assert_eq!(changed(|a| a.chosen = None), 1);
    assert_eq!(changed(|a| a.roots.truncate(1)), 2);
    assert_eq!(changed(|a| a.chosen = Some(a.roots[1])), 1);
}

#[test]
fn a_changed_scalar_is_noticed() {
    let (want, _) = example();
    let best = want.chosen().expect("a spiral");
    let right = [best.f0 as f32, best.f1 as f32, best.margin as f32];
    assert!(scalar_faults(&want, right).is_empty());
    for i in 0..3 {
        let mut got = right;
        got[i] = f32::from_bits(got[i].to_bits() ^ 1);
        assert_eq!(scalar_faults(&want, got).len(), 1);
    }
    let none = judge(0.7, 1.4, 0.4, 0.5);
    assert!(scalar_faults(&none, [NO_VALUE; 3]).is_empty());
    assert_eq!(scalar_faults(&none, [0.0; 3]).len(), 3);
}

/// A wrong table would be reported: the example's verdict against the codes of a neighbouring datum.
#[test]
fn the_wrong_datum_is_noticed() {
    let (want, case) = example();
    let other = moved(&case, 3, 0.05);
    assert!(grid_of(&other).len() == 1);
    let code = code_of(&other).expect("an answer");
    assert!(!code_faults(&want, code).is_empty());
}
