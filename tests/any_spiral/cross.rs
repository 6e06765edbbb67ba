//! Two families over one chart: the cubic's flags and the spirals of any kind.

use spiral_atlas::family::any_spiral::{EXISTS, RISING};
use spiral_atlas::family::cubic::{ANY_SPIRAL, SPIRAL};
use spiral_atlas::family::{Code, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// Whether the two families' codes at one node contradict each other, for φ0 < φ1.
fn contradict(cubic: Code, any: Code) -> bool {
    let exists = any.flags() & EXISTS != 0;
    let rising = any.flags() & RISING != 0;
    (cubic.flags() & ANY_SPIRAL != 0) != (exists && rising) || cubic.flags() & SPIRAL != 0 && !exists
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

#[test]
fn no_cubic_spiral_where_there_is_none_at_all() {
    let linear = |name: &str, lo, hi, count| Axis::new(name, Spacing::Linear { lo, hi, count }).unwrap();
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
    let (mut compared, mut spirals, mut any, mut outside) = (0, 0, 0, 0);
    for axes in grids {
        let grid = Grid::new(axes).unwrap();
        let (cubic, all) = (codes("cubic", &grid), codes("any-spiral", &grid));
        for (node, (cubic, all)) in cubic.iter().zip(&all).enumerate() {
            let [phi0, phi1, ..] = grid.node(node as u64);
            if phi0 < phi1 {
                assert!(!contradict(*cubic, *all), "{}: {cubic:?}, {all:?}", grid.describe(node as u64));
                compared += 1;
            } else {
                // There is no spiral of rising curvature at all.
                assert_ne!(all.flags() & (EXISTS | RISING), EXISTS | RISING);
                assert_eq!(cubic.flags() & (ANY_SPIRAL | SPIRAL), 0);
                outside += 1;
            }
            spirals += usize::from(cubic.flags() & SPIRAL != 0);
            any += usize::from(cubic.flags() & ANY_SPIRAL != 0);
        }
    }
    println!("{compared} nodes with phi0 < phi1 ({any} any spiral, {spirals} cubic spirals), {outside} others");
    assert!(compared > 1_000_000 && spirals > 20_000 && any > 200_000 && outside > 50_000);
}

#[test]
fn a_contradiction_is_noticed() {
    let (cubic, any) = (Code::new(ANY_SPIRAL | SPIRAL, 0), Code::new(EXISTS | RISING, 0));
    assert!(!contradict(cubic, any));
    assert!(contradict(cubic, Code::new(RISING, 0)) && contradict(cubic, Code::new(EXISTS, 0)));
    assert!(contradict(Code::new(SPIRAL, 0), Code::new(0, 0)) && contradict(Code::new(0, 0), any));
}
