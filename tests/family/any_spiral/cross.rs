//! No family has a spiral where there is none of any kind, over more than a million nodes each.

use spiral_atlas::family::any_spiral::{EXISTS, RISING};
use spiral_atlas::family::reach::{CASE_BITS, EXACT};
use spiral_atlas::family::{Code, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// Bits of `SPIRAL` and `ANY_SPIRAL` of a family.
fn bits(family: &str) -> [u8; 2] {
    let flags = by_name(family).unwrap().about().flags;
    ["SPIRAL", "ANY_SPIRAL"].map(|name| 1 << flags.iter().position(|f| f.name == name).unwrap())
}

/// Whether a family's code and that of any spiral contradict each other at one node, for φ0 < φ1.
fn contradict([spiral, bound]: [u8; 2], code: Code, any: Code) -> bool {
    let exists = any.flags() & EXISTS != 0;
    let rising = any.flags() & RISING != 0;
    (code.flags() & bound != 0) != (exists && rising) || code.flags() & spiral != 0 && !exists
}

fn codes(family: &str, grid: &Grid) -> Vec<Code> {
    let table = by_name(family).unwrap().table(grid).unwrap();
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    table.filter(0, &mut codes);
    for (node, code) in codes.iter_mut().enumerate() {
        if *code == Code::UNDECIDED {
            *code = table.exact(node as u64).unwrap().0;
        }
    }
    codes
}

fn linear(name: &str, lo: f64, hi: f64, count: usize) -> Axis {
    Axis::new(name, Spacing::Linear { lo, hi, count }).unwrap()
}

#[test]
fn no_spiral_between_two_ends_where_there_is_none_at_all() {
    let log = |name: &str, lo, hi, count| Axis::new(name, Spacing::Log { lo, hi, count }).unwrap();
    let grids = [
        vec![
            linear("phi0", 0.05, 1.0, 23),
            linear("phi1", 0.1, 2.1, 29),
            linear("kappa0", -0.5, 0.9, 43),
            log("kappa1", 0.3, 90.0, 41),
        ],
        vec![
            log("phi0", 1e-4, 0.5, 11),
            log("phi1", 1e-3, 1.5, 13),
            linear("kappa0", -0.2, 0.5, 31),
            linear("kappa1", -0.5, 9.0, 47),
        ],
    ];
    let grids = grids.map(|axes| Grid::new(axes).unwrap());
    let all = grids.each_ref().map(|grid| codes("any-spiral", grid));
    for family in ["cubic", "ph-quintic"] {
        let [spiral, bound] = bits(family);
        let (mut compared, mut spirals, mut any, mut outside) = (0, 0, 0, 0);
        for (grid, all) in grids.iter().zip(&all) {
            for (node, (code, all)) in codes(family, grid).iter().zip(all).enumerate() {
                let [phi0, phi1, ..] = grid.node(node as u64);
                if phi0 < phi1 {
                    assert!(
                        !contradict([spiral, bound], *code, *all),
                        "{}: {code:?}, {all:?}",
                        grid.describe(node as u64)
                    );
                    compared += 1;
                } else {
                    // There is no spiral of rising curvature at all.
                    assert_ne!(all.flags() & (EXISTS | RISING), EXISTS | RISING);
                    assert_eq!(code.flags() & (bound | spiral), 0);
                    outside += 1;
                }
                spirals += usize::from(code.flags() & spiral != 0);
                any += usize::from(code.flags() & bound != 0);
            }
        }
        println!("{family}: {compared} nodes with phi0 < phi1 ({any} any spiral, {spirals} spirals), {outside} others");
        assert!(compared > 1_000_000 && spirals > 20_000 && any > 200_000 && outside > 50_000);
    }
}

/// `Q < 0` and `ω > 0` of a segment from a line to the point (ξ, η), turning by θ, with the curvature 1 at its round
/// end; of case 2 that is the segment travelled backwards and mirrored. Wrong by less than `1e-12` of Q, which is given
/// too.
fn any_segment(theta: f64, xi: f64, eta: f64, case: u32) -> (bool, f64) {
    let chord = eta.atan2(xi);
    let (alpha, beta) = if case == 0 { (-chord, theta - chord) } else { (chord - theta, chord) };
    let (k2, half) = (0.5 * xi.hypot(eta), 0.5 * (alpha + beta));
    let q = alpha.sin() * (k2 - beta.sin()) + half.sin().powi(2);
    (q < 0.0 && half > 0.0, q)
}

#[test]
fn no_segment_is_a_spiral_where_there_is_none_at_all() {
    for family in ["reach-cubic", "reach-ph"] {
        let axes = vec![linear("theta", 0.05, 1.55, 31), linear("xi", 0.01, 6.0, 181), linear("eta", 0.01, 6.0, 191)];
        let grid = Grid::new(axes).unwrap();
        let (mut spirals, mut none) = (0, 0);
        for (node, code) in codes(family, &grid).iter().enumerate() {
            let [theta, xi, eta, ..] = grid.node(node as u64);
            for case in 0..2 {
                let (any, q) = any_segment(theta, xi, eta, case);
                let spiral = code.flags() >> (case * CASE_BITS) & EXACT != 0;
                assert!(
                    any || !spiral || q.abs() < 1e-12,
                    "{family}, case {}: {}, Q = {q}",
                    case + 1,
                    grid.describe(node as u64)
                );
                spirals += usize::from(spiral);
                none += usize::from(!any);
            }
        }
        println!("{family}: {} nodes, {spirals} spirals, {none} times none at all", grid.len());
        assert!(grid.len() > 1_000_000 && spirals > 20_000 && none > 200_000);
    }
}

#[test]
fn a_contradiction_is_noticed() {
    let flags @ [spiral, bound] = bits("cubic");
    let (code, any) = (Code::new(bound | spiral, 0), Code::new(EXISTS | RISING, 0));
    assert!(!contradict(flags, code, any));
    assert!(contradict(flags, code, Code::new(RISING, 0)) && contradict(flags, code, Code::new(EXISTS, 0)));
    assert!(contradict(flags, Code::new(spiral, 0), Code::new(0, 0)) && contradict(flags, Code::new(0, 0), any));
}
