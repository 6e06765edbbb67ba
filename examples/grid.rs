//! An atlas of a million nodes, made, written, opened and looked up: `cargo run --release --example grid`.

use spiral_atlas::Result;
use spiral_atlas::atlas::{Atlas, Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::family::cubic::{ANY_SPIRAL, Cubic, SPIRAL};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::sync::atomic::AtomicBool;

fn main() -> Result<()> {
    let angles = |lo: f64, hi: f64| Spacing::Linear { lo: lo.to_radians(), hi: hi.to_radians(), count: 21 };
    let grid = Grid::new(vec![
        Axis::new("phi0", angles(5.0, 65.0))?,
        Axis::new("phi1", angles(25.0, 85.0))?,
        Axis::new("kappa0", Spacing::Linear { lo: 0.02, hi: 0.98, count: 49 })?,
        Axis::new("kappa1", Spacing::Log { lo: 0.5, hi: 50.0, count: 49 })?,
    ])?;

    let path = std::env::temp_dir().join("example.atlas.safetensors");
    let spec = Spec { name: "example", family: &Cubic, grid: &grid, scalars: &[], recipe: "" };
    let mut writer = Writer::create(&path, &spec)?;
    let job = Job { family: &Cubic, grid: &grid, scalars: &[] };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    // Chunks come in order, and memory is bounded however large the grid is.
    evaluate(&job, &Backend::Cpu, threads, &AtomicBool::new(false), |chunk| writer.put(&chunk))?;
    println!("{} bytes in {}", writer.finish()?.bytes, path.display());

    let atlas = Atlas::open(&path)?;
    let share = |bit: u8| atlas.flags().iter().filter(|flags| *flags & bit != 0).count() as f64 / grid.len() as f64;
    println!("a cubic spiral at {:.2} of the nodes, some spiral at {:.2}", share(SPIRAL), share(ANY_SPIRAL));
    let datum = [0.7, 1.4, 0.4, 4.0];
    if let Some((node, entry)) = atlas.nearest(&datum) {
        println!("{datum:?} is nearest to {}: {entry:?}", grid.describe(node));
    }
    Ok(())
}
