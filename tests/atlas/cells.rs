//! Cells: what a file says is true, its bytes are the same for any number of threads, and any other words are refused
//! or found.

use spiral_atlas::cells::{Cells, Spec, attack, build, bytes, check, differences};
use spiral_atlas::family::cubic::{Datum, SPIRAL, solve};
use spiral_atlas::family::{Family, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};
use std::ops::Range;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

static NEVER: AtomicBool = AtomicBool::new(false);

fn cubic() -> &'static dyn Family {
    by_name("cubic").unwrap()
}

/// Around a part of the boundary of the cubic spirals, with as many cells along each axis.
fn grid(cells: usize) -> Grid {
    let linear = |name, lo, hi| Axis::new(name, Spacing::Linear { lo, hi, count: cells + 1 }).unwrap();
    let kappa1 = Axis::new("kappa1", Spacing::Log { lo: 2.6, hi: 3.4, count: cells + 1 }).unwrap();
    Grid::new(vec![linear("phi0", 0.69, 0.7), linear("phi1", 1.4, 1.41), linear("kappa0", 0.4, 0.5), kappa1]).unwrap()
}

fn made(cells: usize, budget: u64, threads: usize) -> Vec<u8> {
    let grid = grid(cells);
    let spec = Spec { name: "made", family: cubic(), grid: &grid, budget, recipe: "# none" };
    bytes(&spec, &build(&spec, threads, &NEVER, &|_| ()).unwrap()).unwrap()
}

/// Three levels: top cells, nodes whose children may be divided, and finest ones.
static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| made(32, u64::MAX, 2));

fn opened(file: &[u8]) -> Cells {
    Cells::from_bytes(file).unwrap()
}

/// Where a tensor lies in the file.
fn place(file: &[u8], name: &str) -> Range<usize> {
    let tensors = safetensors::SafeTensors::deserialize(file).unwrap();
    let data = tensors.tensor(name).unwrap().data().as_ptr_range();
    data.start.addr() - file.as_ptr().addr()..data.end.addr() - file.as_ptr().addr()
}

fn word(file: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(file[at..at + 4].try_into().unwrap())
}

fn random(mut seed: u64) -> impl FnMut(u64) -> u64 {
    move |n| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) % n
    }
}

/// A point of the box; each coordinate is anywhere, an edge of a cell, or the double beside one.
fn point(grid: &Grid, random: &mut impl FnMut(u64) -> u64) -> Vec<f64> {
    let coordinate = |axis: &Axis| {
        let edges = axis.values();
        let i = random(edges.len() as u64 - 1) as usize;
        match random(5) {
            0 => edges[i],
            1 => edges[i].next_up(),
            2 => edges[i + 1].next_down(),
            _ => edges[i] + (edges[i + 1] - edges[i]) * (random(1 << 30) as f64 / (1u64 << 30) as f64),
        }
    };
    grid.axes().iter().map(coordinate).collect()
}

#[test]
fn every_verdict_is_true() {
    let cells = opened(&FILE);
    cells.check_hashes().unwrap();
    let found = attack(&cells, 10_000, 7, &NEVER).unwrap();
    assert!(found.wrong == 0 && found.points > 2_000_000, "{found:?}");
    let mut random = random(3);
    let (mut known, mut mixed) = ([0; 2], 0);
    for _ in 0..20_000 {
        let point = point(cells.grid(), &mut random);
        let truth =
            solve(&Datum { phi0: point[0], phi1: point[1], kappa0: point[2], kappa1: point[3] }).unwrap().flags();
        assert_eq!(cells.verdict(&point, u8::MAX).unwrap(), truth, "{point:?}");
        assert_eq!(cells.verdict(&point, SPIRAL).unwrap(), truth & SPIRAL, "{point:?}");
        let cell = cells.lookup(&point).unwrap();
        known[0] += u32::from(cell.inside & SPIRAL != 0);
        known[1] += u32::from(cell.outside & SPIRAL != 0);
        mixed += u32::from((cell.inside | cell.outside) & SPIRAL == 0);
    }
    assert!(known.iter().all(|n| *n > 1_000) && (10..3_000).contains(&mixed), "{known:?} {mixed}");
}

#[test]
fn outside_the_box_the_family_answers() {
    let cells = opened(&FILE);
    for outside in
        [[0.6, 1.4, 0.4, 3.0], [0.69, 1.4, 0.4, 3.5], [f64::NAN, 1.4, 0.4, 3.0], [0.69, 1.4, f64::INFINITY, 3.0]]
    {
        assert_eq!(cells.lookup(&outside), None);
    }
    let last = cells.grid().node(cells.grid().len() - 1);
    assert!(cells.lookup(&last[..4]).is_some() && cells.lookup(&last[..3]).is_none());
    assert_eq!(cells.verdict(&[0.7, 1.4, 0.4, 4.0], SPIRAL).unwrap(), SPIRAL);
    let error = cells.verdict(&[f64::NAN, 1.4, 0.4, 3.0], SPIRAL).unwrap_err().to_string();
    assert!(error.contains("phi0") && error.contains("NaN"), "{error}");
    assert!(cells.verdict(&[0.7, 1.4, 0.4], SPIRAL).unwrap_err().to_string().contains("is 3; it must be 4"));
    assert!(cells.verdict(&[2.0, 2.0, 0.4, 3.0], SPIRAL).unwrap_err().to_string().contains("pi"));
}

#[test]
fn bytes_depend_on_no_threads() {
    assert!(made(32, u64::MAX, 1) == *FILE && made(32, u64::MAX, 5) == *FILE);
}

/// An axis of a single value is not divided: what a file says there, it says of that value alone.
#[test]
fn an_axis_may_have_a_single_value() {
    let family = by_name("trig-quintic").unwrap();
    let linear = |name: &str, lo, hi| Axis::new(name, Spacing::Linear { lo, hi, count: 33 }).unwrap();
    let single = |name: &str, x: f64| Axis::new(name, Spacing::Values(vec![x])).unwrap();
    let axes = vec![linear("ratio", 3.0, 7.0), single("theta", 0.75), linear("m", 0.5, 3.0), single("p", -0.5)];
    let grid = Grid::new([axes, vec![linear("q", -0.5, 0.25)]].concat()).unwrap();
    let spec = Spec { name: "made", family, grid: &grid, budget: 300_000, recipe: "# none" };
    let built = build(&spec, 2, &NEVER, &|_| ()).unwrap();
    let file = bytes(&spec, &built).unwrap();
    assert!(file.len() as u64 <= spec.budget);
    let cells = opened(&file);
    assert_eq!((cells.resolution(), differences(&cells, &built)), (32, (0, None)));
    let shapes = safetensors::SafeTensors::deserialize(&file).unwrap();
    let shape = |name: &str| shapes.tensor(name).unwrap().shape().to_vec();
    assert_eq!((shape("theta"), shape("q"), shape("top")), (vec![1], vec![33], vec![16, 16, 16, 2]));
    let found = attack(&cells, 2_000, 3, &NEVER).unwrap();
    assert!(found.wrong == 0 && found.points > 100_000 && found.verdicts > 300_000, "{found:?}");
    let point = [6.5, 0.75, 1.0, -0.5, -0.2];
    let known = cells.lookup(&point).unwrap();
    assert_eq!(known.inside & 0b11, 0b11, "{known:?}");
    for beside in [[6.5, 0.75_f64.next_up(), 1.0, -0.5, -0.2], [6.5, 0.75, 1.0, f64::NAN, -0.2]] {
        assert_eq!(cells.lookup(&beside), None);
    }
    assert_eq!(cells.verdict(&[6.5, 0.8, 1.0, 0.5, -0.2], u8::MAX).unwrap() & 1, 1);
    assert!(cells.verdict(&point[..4], 1).unwrap_err().to_string().contains("is 4; it must be 5"));
}

/// A budget is kept, used, and takes nothing but fineness: no cell says another thing.
#[test]
fn a_budget_makes_cells_coarser_and_no_more() {
    let full = opened(&FILE);
    let (least, most) = (150_000, FILE.len() as u64);
    let mut random = random(5);
    let mut before = 0;
    for part in [least, least + (most - least) / 3, most - (most - least) / 3] {
        let file = made(32, part, 2);
        assert!(file.len() as u64 <= part && file.len() as u64 > part - 30_000, "{} of {part}", file.len());
        let coarse = opened(&file);
        let mut known = 0;
        for _ in 0..20_000 {
            let point = point(full.grid(), &mut random);
            let (a, b) = (coarse.lookup(&point).unwrap(), full.lookup(&point).unwrap());
            assert!(a.inside & b.outside == 0 && a.outside & b.inside == 0, "{point:?}");
            known += (a.inside | a.outside).count_ones();
        }
        assert!(known > before, "{known} after {before}");
        before = known;
    }
    let grid = grid(32);
    let spec = Spec { name: "poor", family: cubic(), grid: &grid, budget: 100_000, recipe: "" };
    let error = build(&spec, 1, &NEVER, &|_| ()).unwrap_err().to_string();
    assert!(error.contains("top cells"), "{error}");
}

#[test]
fn a_flipped_cell_is_found() {
    let grid = grid(32);
    let spec = Spec { name: "made", family: cubic(), grid: &grid, budget: u64::MAX, recipe: "# none" };
    let fresh = build(&spec, 2, &NEVER, &|_| ()).unwrap();
    assert_eq!(differences(&opened(&FILE), &fresh), (0, None));
    // All over the file, a claim that can be turned round without breaking the words.
    let (mut flipped, trees) = (0, place(&FILE, "trees"));
    for at in trees.skip(4).step_by(4 * 301) {
        let node = word(&FILE, at);
        let Some(child) = (0..16).find(|c| (node | node >> 16) >> c & 1 == 1) else { continue };
        let mut file = FILE.clone();
        file[at..at + 4].copy_from_slice(&(node ^ (0x0001_0001 << child)).to_le_bytes());
        let Ok(cells) = Cells::from_bytes(&file) else { continue };
        let (count, first) = differences(&cells, &fresh);
        assert!(count == 1 && first.unwrap().contains("`trees`"));
        assert!(cells.check_hashes().unwrap_err().to_string().contains("`trees`"));
        flipped += 1;
    }
    assert!(flipped > 5, "{flipped}");
    // Claims that are wrong on a grand scale are also seen by points alone.
    let mut file = FILE.clone();
    let top = place(&FILE, "top");
    for known in file[top].as_chunks_mut::<2>().0.iter_mut().filter(|known| known[0] & SPIRAL != 0) {
        *known = [known[0] & !SPIRAL, known[1] | SPIRAL];
    }
    let found = attack(&opened(&file), 200, 1, &NEVER).unwrap();
    assert!(found.wrong > 0 && found.first.unwrap().contains("OUTSIDE of SPIRAL"));
}

fn complaint(file: &[u8]) -> String {
    match Cells::from_bytes(file) {
        Err(Error::Atlas { what, .. }) => what,
        other => panic!("expected a refusal, got {:?}", other.map(|_| "cells")),
    }
}

#[test]
fn hostile_files_are_refused() {
    let change = |at: usize, new: u32| {
        let mut file = FILE.clone();
        file[at..at + 4].copy_from_slice(&new.to_le_bytes());
        file
    };
    let (mut roots, trees, top) = (place(&FILE, "roots").step_by(4), place(&FILE, "trees"), place(&FILE, "top"));
    let root = roots.find(|at| word(&FILE, *at) != 0).unwrap();
    let first = trees.start + 4 * word(&FILE, root) as usize;
    // A root that leads elsewhere, nowhere, and out of the file.
    for wrong in [word(&FILE, root) + 1, u32::MAX, 0] {
        assert!(complaint(&change(root, wrong)).contains('`'), "{wrong}");
    }
    // A node of two words that leads to itself, back, and out of the file.
    assert_ne!(word(&FILE, first + 4), 0);
    for wrong in [(first - trees.start) as u32 / 4, 1, u32::MAX] {
        assert!(complaint(&change(first + 4, wrong)).contains("may be"), "{wrong}");
    }
    // A child that is both, and a first word that is something.
    assert!(complaint(&change(first, u32::MAX)).contains("both"));
    assert!(complaint(&change(trees.start, 1)).contains("begin"));
    // A top cell that is both, or has a flag that there is not.
    for wrong in [[0x01, 0x01], [0x20, 0]] {
        let mut file = FILE.clone();
        file[top.start..top.start + 2].copy_from_slice(&wrong);
        assert!(complaint(&file).contains("`top`"));
    }
    for cut in [0, 7, 100, FILE.len() / 2, FILE.len() - 1] {
        complaint(&FILE[..cut]);
    }
    complaint(&[&FILE[..], &[0; 4]].concat());
    // Files of nodes are told from files of cells.
    let error = spiral_atlas::atlas::Atlas::from_bytes(&FILE).unwrap_err().to_string();
    assert!(error.contains("cells"), "{error}");
}

/// Whatever the bytes, a file is refused, or every place in it can be looked up.
#[test]
fn damaged_files_do_no_harm() {
    let mut random = random(9);
    let header = 8 + u64::from_le_bytes(FILE[..8].try_into().unwrap());
    let mut opened = 0;
    for round in 0..200 {
        let mut file = FILE.clone();
        for _ in 0..=random(3) {
            let at = if round % 4 == 0 { random(header) } else { header + random(FILE.len() as u64 - header) };
            file[at as usize] ^= 1 << random(8);
        }
        let Ok(cells) = Cells::from_bytes(&file) else { continue };
        opened += 1;
        for _ in 0..100 {
            let known = cells.lookup(&point(cells.grid(), &mut random)).unwrap();
            assert_eq!(known.inside & known.outside, 0);
        }
    }
    println!("{opened} of 200 were opened");
}

#[test]
fn what_cannot_be_made_is_refused() {
    let linear = |name: &&str, count| Axis::new(name, Spacing::Linear { lo: 0.1, hi: 0.2, count });
    let refusal = |family: &str, axes: Vec<Result<Axis>>| {
        let grid = Grid::new(axes.into_iter().collect::<Result<_>>().unwrap()).unwrap();
        let spec = Spec { name: "x", family: by_name(family).unwrap(), grid: &grid, budget: 1 << 24, recipe: "" };
        check(&spec).unwrap_err().to_string()
    };
    let names = ["phi0", "phi1", "kappa0", "kappa1"];
    let all = |count: usize| names.iter().map(|name| linear(name, count)).collect::<Vec<_>>();
    assert!(refusal("cubic", all(6)).contains("resolution is 5"));
    let mut uneven = all(5);
    uneven[2] = linear(&"kappa0", 9);
    assert!(refusal("cubic", uneven).contains("[5, 5, 9, 5]"));
    let five = || ["ratio", "theta", "m", "p", "q"].iter().map(|name| linear(name, 5)).collect::<Vec<_>>();
    assert!(refusal("trig-quintic", five()).contains("at most 4 axes, given: 5; give an axis a single value"));
    let single = five().into_iter().map(|axis| Axis::new(axis.unwrap().name(), Spacing::Values(vec![0.1])));
    assert!(refusal("trig-quintic", single.collect()).contains("all axes of cells have a single value"));
    assert!(refusal("trig-quintic", all(5)).contains("must be ratio, theta, m, p, q"));
    let mixed = ["phi0", "phi1", "a", "kappa1"].iter().map(|name| linear(name, 5)).collect();
    assert!(refusal("cubic", mixed).contains("phi0, phi1, kappa0, kappa1 or phi0, phi1, a, k"));
}
