//! Cells of the cubic, then of `ph-quintic`, by hand: `cargo bench --bench cells -- [resolution] [MiB] [resolution of
//! ph-quintic] [its MiB]`. What is MIXED, and what a lookup, a verdict and a solution cost.

mod random;

use random::Random;
use spiral_atlas::cells::{Cells, Spec, build, write};
use spiral_atlas::family::cubic::Datum;
use spiral_atlas::family::{Family, by_name, cubic, ph_quintic};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

const POINTS: usize = 1_000_000;
/// Few enough for the first cache, with the parts of the file that they touch.
const FEW: usize = 1_000;

fn main() -> spiral_atlas::Result<()> {
    let numbers: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let number = |at: usize, usual: usize| numbers.get(at).copied().unwrap_or(usual);
    let solve = |p: &[f64; 4]| drop(black_box(cubic::solve(&datum(p))));
    measure("cubic", number(0, 64), number(1, 32), &solve)?;
    let solve = |p: &[f64; 4]| drop(black_box(ph_quintic::solve(&datum(p))));
    measure("ph-quintic", number(2, 16), number(3, 8), &solve)
}

fn datum(&[phi0, phi1, kappa0, kappa1]: &[f64; 4]) -> Datum {
    Datum { phi0, phi1, kappa0, kappa1 }
}

fn measure(name: &str, resolution: usize, mib: usize, solve: &dyn Fn(&[f64; 4])) -> spiral_atlas::Result<()> {
    let count = resolution + 1;
    let axis = |name, spacing| Axis::new(name, spacing);
    let grid = Grid::new(vec![
        axis("phi0", Spacing::Linear { lo: 0.05, hi: 1.5, count })?,
        axis("phi1", Spacing::Linear { lo: 0.06, hi: 1.55, count })?,
        axis("kappa0", Spacing::Linear { lo: 0.01, hi: 1.0, count })?,
        axis("kappa1", Spacing::Log { lo: 0.1, hi: 100.0, count })?,
    ])?;
    let family: &'static dyn Family = by_name(name)?;
    let flag = |name: &str| family.about().bit(name).map_or(0, |bit| 1 << bit);
    let (spiral_flag, any_spiral) = (flag("SPIRAL"), flag("ANY_SPIRAL"));
    let spec = Spec { name: "bench", family, grid: &grid, budget: (mib as u64) << 20, recipe: "" };
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    let started = Instant::now();
    let built = build(&spec, threads, &AtomicBool::new(false), &|_| ())?;
    println!(
        "{name}, resolution {resolution}, {mib} MiB: made in {:.1} s with {threads} threads",
        started.elapsed().as_secs_f64()
    );
    let path = std::env::temp_dir().join("spiral-atlas-bench-cells.safetensors");
    write(&path, &spec, &built)?;
    let started = Instant::now();
    let cells = Cells::open(&path)?;
    println!("{} bytes, opened in {:.3} s", cells.bytes(), started.elapsed().as_secs_f64());

    let mut random = Random(1);
    let points: Vec<[f64; 4]> = (0..POINTS).map(|_| point(&mut random)).collect();
    // Uniform inside the outer bound: in angles and curvatures, not in cells.
    let mut within: Vec<[f64; 4]> = Vec::new();
    while within.len() < POINTS {
        let point = point(&mut random);
        if cells.verdict(&point, any_spiral)? != 0 {
            within.push(point);
        }
    }
    for (what, points) in [("whole box", &points), ("inside the outer bound", &within)] {
        let mut mixed = [0; 8];
        for known in points.iter().filter_map(|p| cells.lookup(p)) {
            mixed
                .iter_mut()
                .enumerate()
                .for_each(|(bit, n)| *n += u32::from((known.inside | known.outside) >> bit & 1 == 0));
        }
        let shares = mixed
            .iter()
            .zip(family.about().flags)
            .map(|(n, flag)| format!("{} {:.2} %", flag.name, f64::from(*n) / points.len() as f64 * 100.0));
        println!("MIXED of queries, {what}: {}", shares.collect::<Vec<_>>().join(", "));
    }
    let time = |what: &str, points: &[[f64; 4]], rounds: usize, of: &dyn Fn(&[f64; 4])| {
        let best = (0..5).map(|_| {
            let started = Instant::now();
            for _ in 0..rounds {
                points.iter().for_each(of);
            }
            started.elapsed().as_secs_f64() * 1e9 / (rounds * points.len()) as f64
        });
        let best = best.fold(f64::INFINITY, f64::min);
        println!("{what}: {best:.1} ns");
        best
    };
    let lookup = |p: &[f64; 4]| {
        black_box(cells.lookup(black_box(p)));
    };
    time("lookup, in cache, whole box", &points[..FEW], 1000, &lookup);
    time("lookup, in cache, inside the outer bound", &within[..FEW], 1000, &lookup);
    time("lookup, a million points, whole box", &points, 1, &lookup);
    time("lookup, a million points, inside the outer bound", &within, 1, &lookup);
    let all = |p: &[f64; 4]| {
        let _ = black_box(cells.verdict(black_box(p), u8::MAX));
    };
    let spiral = |p: &[f64; 4]| {
        let _ = black_box(cells.verdict(black_box(p), spiral_flag));
    };
    time("verdict of all flags, inside the outer bound", &within, 1, &all);
    let ratio = |what: &str, points: &[[f64; 4]]| {
        let verdict = time(&format!("verdict of SPIRAL, {what}"), points, 1, &spiral);
        let solved = time(&format!("solve, {what}"), &points[..points.len() / 50], 1, solve);
        println!("solve over verdict, {what}: {:.1}", solved / verdict);
    };
    ratio("inside the outer bound", &within);
    ratio("whole box", &points);
    std::fs::remove_file(&path).map_err(|source| spiral_atlas::Error::Io { path, source })
}

/// Anywhere in the box, κ1 by its logarithm.
fn point(random: &mut Random) -> [f64; 4] {
    let [a, b, c, d] = [0; 4].map(|_| random.unit());
    [0.05 + 1.45 * a, 0.06 + 1.49 * b, 0.01 + 0.99 * c, 0.1 * 1000f64.powf(d)]
}
