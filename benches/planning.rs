//! How long a path among obstacles takes to plan, for scenes of growing size, as tables.
//!
//! Stars and convex polygons of 3 to 8 vertices on a jittered lattice, from corner to corner; the density is the same
//! for all sizes. Then scenes that are hard to search: combs, grids and spirals.

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
    println!("\n{:>9} {:>9} {:>9} {:>9}", "scene", "vertices", "curvature", "seconds");
    for size in [30, 60, 125] {
        hard("comb", &comb(size));
    }
    for (size, most) in [(8, 3.0), (16, 3.0), (8, 0.5), (16, 0.5)] {
        hard("grid", &grid(size, most));
    }
    for size in [100, 200, 400, 1000] {
        hard("spiral", &spiral(size));
    }
    Ok(())
}

/// A line of the table, also where no path is found.
fn hard(name: &str, scene: &Scene) {
    let start = Instant::now();
    let found = plan(scene).map_or_else(|e| e.to_string(), |found| format!("{} corners", found.corners.len()));
    let (vertices, seconds) = (scene.obstacles.iter().map(Vec::len).sum::<usize>(), start.elapsed().as_secs_f64());
    println!("{name:>9} {vertices:>9} {:>9} {seconds:>9.3} {found:.60}", scene.greatest_curvature);
}

/// From gap to gap of a wall with teeth.
fn comb(teeth: usize) -> Scene {
    let end = teeth as f64;
    let tooth = |i: usize| [[0.2, 0.0], [0.2, 3.0], [0.5, 3.0], [0.5, 0.0]].map(|p| [p[0] + i as f64, p[1]]);
    let ring = [[0.0, -1.0]].into_iter().chain((0..teeth).flat_map(tooth)).chain([[end + 1.0, -1.0]]).collect();
    Scene {
        start: [0.85, 0.5],
        goal: [end - 0.15, 0.5],
        obstacles: vec![ring],
        clearance: 0.05,
        greatest_curvature: 1.0,
    }
}

/// Squares, their gaps narrower than themselves.
fn grid(side: i32, greatest_curvature: f64) -> Scene {
    let square = |k: i32| {
        let ring = [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]];
        ring.map(|p| [p[0] + f64::from(k / side), p[1] + f64::from(k % side)]).to_vec()
    };
    let far = f64::from(side) - 1.5;
    let obstacles = (0..side * side).map(square).collect();
    Scene { start: [0.5, 0.5], goal: [far, far], obstacles, clearance: 0.05, greatest_curvature }
}

/// Out of a spiral of two turns.
fn spiral(vertices: i32) -> Scene {
    let wall = |in_by: f64| {
        (0..vertices).map(move |k| {
            let angle = 2.0 * std::f64::consts::TAU * f64::from(k) / f64::from(vertices - 1);
            let far = 1.0 + angle / std::f64::consts::TAU - in_by;
            [far * angle.cos(), far * angle.sin()]
        })
    };
    let ring = wall(0.0).chain(wall(0.05).rev()).collect();
    Scene { start: [0.0, 0.0], goal: [5.0, 0.0], obstacles: vec![ring], clearance: 0.1, greatest_curvature: 5.0 }
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
