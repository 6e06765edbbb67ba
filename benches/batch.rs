//! A million data at once: the verdicts of the cubic, and the nearest nodes of an atlas in memory. `benches/batch.py`
//! times the same calls from Python, in the same run (`benches/run`).

use spiral_atlas::atlas::{Atlas, Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::family::cubic::Cubic;
use spiral_atlas::family::{solve_batch, verdicts};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

const ROWS: usize = 1_000_000;
/// Fractional parts of powers of the root of x⁵ = x + 1: their multiples fill a box of four dimensions evenly.
const STEPS: [f64; 4] = [0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101];
/// The box of quickstart.
const BOX: [[f64; 2]; 4] = [[0.1, 1.2], [0.2, 1.5], [0.02, 1.0], [1.0, 100.0]];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let data: Vec<f64> = (0..ROWS)
        .flat_map(|i| [0, 1, 2, 3].map(|j| BOX[j][0] + (BOX[j][1] - BOX[j][0]) * (i as f64 * STEPS[j]).fract()))
        .collect();
    let axes = ["phi0", "phi1", "kappa0", "kappa1"];
    let axis = |j: usize| Axis::new(axes[j], Spacing::Linear { lo: BOX[j][0], hi: BOX[j][1], count: 32 });
    let grid = Grid::new((0..4).map(axis).collect::<Result<_, _>>()?)?;
    let folder = tempfile::tempdir()?;
    let spec = Spec { name: "batch", family: &Cubic, grid: &grid, scalars: &[], recipe: "" };
    let mut writer = Writer::create(&folder.path().join("batch.atlas.safetensors"), &spec)?;
    let job = Job { family: &Cubic, grid: &grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 2, &AtomicBool::new(false), |chunk| writer.put(&chunk))?;
    let atlas: Atlas = writer.open()?;

    for threads in [1, 2] {
        time(&format!("Rust: verdicts, threads: {threads}"), || verdicts(&Cubic, 0, &data, threads));
        time(&format!("Rust: solve_batch, threads: {threads}"), || solve_batch(&Cubic, 0, &data, threads));
    }
    time("Rust: nearest node", || {
        let found = data
            .as_chunks::<4>()
            .0
            .iter()
            .map(|point| atlas.nearest(point).map_or(0, |(node, entry)| node + u64::from(entry.flags)));
        Ok::<u64, ()>(found.sum())
    });
    Ok(())
}

/// The best of five.
fn time<T, E: std::fmt::Debug>(name: &str, work: impl Fn() -> Result<T, E>) {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let started = Instant::now();
        black_box(work().expect("the data are in the domain"));
        best = best.min(started.elapsed().as_secs_f64());
    }
    println!("{name:44} {:12.1} ns each", best / ROWS as f64 * 1e9);
}
