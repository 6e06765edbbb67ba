//! Dense grids by blocks, by hand: `cargo bench --bench dense`. The f64 step of the cubic on planes of two curvatures,
//! with and without blocks, and a whole atlas of 128 nodes an axis as `generate` makes it.
//!
//! A plane is a grid at one pair of angles. Two hundred pairs, spread evenly over the box, stand for all of them: of n
//! nodes an axis, the whole grid costs n² planes.

use spiral_atlas::atlas::{Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::family::{Code, Family, Table, cubic::Cubic};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Pairs of angles.
const PLANES: usize = 200;
/// Rows of a piece that is too short for blocks.
const ROWS: usize = 7;
/// Nodes along each axis.
const SIZES: [usize; 7] = [24, 32, 48, 64, 128, 256, 512];

fn main() -> Outcome<()> {
    println!("{:>14} {:>14} {:>14} {:>7}", "nodes an axis", "ns, by nodes", "ns, by blocks", "times");
    let mut costs = vec![];
    for count in SIZES {
        let [nodes, blocks] = planes(count)?;
        println!("{count:14} {nodes:14.2} {blocks:14.2} {:7.2}", nodes / blocks);
        costs.push((count, blocks));
    }
    let cost =
        |count: usize| costs.iter().find(|(n, _)| *n == count).map_or(f64::NAN, |(n, ns)| ns * (*n as f64).powi(4));
    println!("growth from 128 to 512 nodes an axis: exponent {:.2}", (cost(512) / cost(128)).log(4.0));
    whole(128)
}

/// Nanoseconds a node, by nodes alone and by blocks.
fn planes(count: usize) -> Outcome<[f64; 2]> {
    let mut seconds = [0.0; 2];
    for plane in 0..PLANES {
        // Additive sequences of the plastic number, which fill a square evenly.
        let place = |step: f64| ((plane as f64 + 0.5) * step).fract();
        let [first, second] = [0.05 + 1.45 * place(0.754877666), 0.06 + 1.49 * place(0.569840291)];
        let grid = grid([Spacing::Values(vec![first]), Spacing::Values(vec![second])], count)?;
        let table = Cubic.table(&grid)?;
        let mut codes = [0, 1].map(|_| vec![Code::UNDECIDED; count * count]);
        for (way, piece) in [ROWS * count, count * count].into_iter().enumerate() {
            seconds[way] += time(&*table, &mut codes[way], piece);
        }
        if codes[0] != codes[1] {
            return Err(format!("codes differ at {first}, {second} with {count} nodes an axis").into());
        }
    }
    Ok(seconds.map(|s| s / (PLANES * count * count) as f64 * 1e9))
}

/// Seconds of the fastest of three rounds over a plane, in pieces of so many nodes.
fn time(table: &dyn Table, codes: &mut [Code], piece: usize) -> f64 {
    let round = |_| {
        let started = Instant::now();
        for (at, part) in codes.chunks_mut(piece).enumerate() {
            table.filter((at * piece) as u64, black_box(part));
        }
        started.elapsed().as_secs_f64()
    };
    (0..3).map(round).fold(f64::INFINITY, f64::min)
}

fn grid([phi0, phi1]: [Spacing; 2], count: usize) -> Outcome<Grid> {
    Ok(Grid::new(vec![
        Axis::new("phi0", phi0)?,
        Axis::new("phi1", phi1)?,
        Axis::new("kappa0", Spacing::Linear { lo: 0.01, hi: 1.0, count })?,
        Axis::new("kappa1", Spacing::Log { lo: 0.1, hi: 100.0, count })?,
    ])?)
}

/// A whole atlas, file and digest included.
fn whole(count: usize) -> Outcome<()> {
    let grid =
        grid([Spacing::Linear { lo: 0.05, hi: 1.5, count }, Spacing::Linear { lo: 0.06, hi: 1.55, count }], count)?;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("dense.safetensors");
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let started = Instant::now();
        let spec = Spec { name: "dense", family: &Cubic, grid: &grid, scalars: &[], recipe: "" };
        let mut writer = Writer::create(&path, &spec)?;
        let job = Job { family: &Cubic, grid: &grid, scalars: &[] };
        evaluate(&job, &Backend::Cpu, threads, &AtomicBool::new(false), |chunk| writer.put(&chunk))?;
        writer.finish()?;
        best = best.min(started.elapsed().as_secs_f64());
    }
    println!("an atlas of {count} nodes an axis, file and digest included, {threads} threads: {best:.2} s");
    Ok(())
}
