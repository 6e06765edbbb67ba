//! How long a path among obstacles takes to plan, for scenes of growing size, as a table.
//!
//! Stars and convex polygons of 3 to 8 vertices on a jittered lattice, from corner to corner; the density is the same for all sizes.

use spiral_atlas::path::{Scene, plan};
use std::time::Instant;

fn main() -> Result<(), spiral_atlas::Error> {
    println!("{:>9} {:>9} {:>9} {:>9} {:>9}", "vertices", "corners", "seconds", "worst", "growth");
    let mut last: Option<f64> = None;
    for vertices in [100, 200, 500, 1000, 2000] {
        let mut seconds = vec![];
        let mut corners = 0;
        for seed in 0..5 {
            let scene = scene(vertices, seed);
            let start = Instant::now();
            corners += plan(&scene)?.corners.len();
            seconds.push(start.elapsed().as_secs_f64());
        }
        seconds.sort_by(f64::total_cmp);
        let growth = last.map_or("-".into(), |last| format!("{:.1}", seconds[2] / last));
        println!("{vertices:>9} {:>9.1} {:>9.3} {:>9.3} {growth:>9}", corners as f64 / 5.0, seconds[2], seconds[4]);
        last = Some(seconds[2]);
    }
    Ok(())
}

fn scene(vertices: usize, seed: u64) -> Scene {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / 2f64.powi(53)
    };
    let side = (vertices as f64 / 5.5).sqrt().ceil() as usize;
    let mut obstacles: Vec<Vec<[f64; 2]>> = vec![];
    let mut total = 0;
    'all: for i in 0..side {
        for j in 0..side {
            let n = (3 + (random() * 6.0) as usize).min(vertices - total);
            if n < 3 {
                break 'all;
            }
            let centre = [i as f64 + 0.2 * random(), j as f64 + 0.2 * random()];
            let ragged = if random() < 0.5 { 0.5 } else { 0.05 };
            let turn = random();
            let corner = |k: usize| {
                let angle = std::f64::consts::TAU * (k as f64 + turn + 0.3 * random()) / n as f64;
                let far = 0.38 * (1.0 - ragged * random());
                [centre[0] + far * angle.cos(), centre[1] + far * angle.sin()]
            };
            obstacles.push((0..n).map(corner).collect());
            total += n;
        }
    }
    let far = side as f64 - 0.3;
    Scene { start: [-0.7, -0.7], goal: [far, far], obstacles, clearance: 0.05, greatest_curvature: 8.0 }
}
