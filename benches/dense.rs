//! Dense grids by hand.

use spiral_atlas::Result;
use spiral_atlas::family::{Code, Family, Table, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::hint::black_box;
use std::time::Instant;

fn plane(phi: [f64; 2], n: usize) -> Result<Grid> {
    Grid::new(vec![
        Axis::new("phi0", Spacing::Values(vec![phi[0]]))?,
        Axis::new("phi1", Spacing::Values(vec![phi[1]]))?,
        Axis::new("kappa0", Spacing::Linear { lo: 0.01, hi: 1.0, count: n })?,
        Axis::new("kappa1", Spacing::Log { lo: 0.1, hi: 100.0, count: n })?,
    ])
}

/// Seconds of the fastest of some rounds over a plane, in pieces of so many rows.
fn time(table: &dyn Table, codes: &mut [Code], piece: usize) -> f64 {
    let round = |_| {
        let started = Instant::now();
        for (at, part) in codes.chunks_mut(piece).enumerate() {
            table.filter(at as u64 * piece as u64, black_box(part));
        }
        started.elapsed().as_secs_f64()
    };
    (0..3).map(round).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<()> {
    for (name, planes, sizes) in
        [("cubic", 200usize, &[24usize, 32, 48, 64, 128, 256, 512][..]), ("ph-quintic", 1, &[64])]
    {
        let family: &'static dyn Family = by_name(name)?;
        for &n in sizes {
            let mut seconds = [0.0; 2];
            let mut wrong = 0;
            for p in 0..planes {
                let u = |k: f64| ((p as f64 + 0.5) * k).fract();
                let grid = plane([0.05 + 1.45 * u(0.754877666), 0.06 + 1.49 * u(0.569840291)], n)?;
                let table = family.table(&grid)?;
                let mut codes = [vec![Code::UNDECIDED; n * n], vec![Code::UNDECIDED; n * n]];
                for (way, piece) in [(0, std::env::var("ROWS").map_or(7, |x| x.parse().unwrap()) * n), (1, n * n)] {
                    seconds[way] += time(&*table, &mut codes[way], piece);
                }
                wrong += codes[0].iter().zip(&codes[1]).filter(|(a, b)| a != b).count();
            }
            let [nodes, blocks] = seconds.map(|s| s / (planes * n * n) as f64 * 1e9);
            println!(
                "{name:12} {n:4}: {nodes:8.2} ns a node, with blocks {blocks:8.2}: {:5.2} times; {wrong} differ",
                nodes / blocks
            );
        }
    }
    Ok(())
}
