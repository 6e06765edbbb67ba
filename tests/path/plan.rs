//! Paths among obstacles.

mod crowded;
mod limits;
mod refused;

use super::audit::{self, apart_from_all, audit, audit_plan};
use super::*;
use spiral_atlas::path::{Motion, Plan, Scene, Turn, Verdict, plan, prove, separation};

type Ring = Vec<[f64; 2]>;

fn scene(start: [f64; 2], goal: [f64; 2], obstacles: Vec<Ring>, clearance: f64, greatest_curvature: f64) -> Scene {
    Scene { start, goal, obstacles, clearance, greatest_curvature }
}

fn square([x, y]: [f64; 2], half: f64) -> Ring {
    vec![[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
}

fn line(from: [f64; 2], to: [f64; 2]) -> PhQuintic {
    let w = num_complex::Complex64::new(to[0] - from[0], to[1] - from[1]).sqrt();
    PhQuintic::between(from, to, [[w.re, w.im]; 3])
}

fn length(plan: &Plan) -> f64 {
    plan.spans.iter().map(PhQuintic::length).sum()
}

/// Stars around points of a lattice, some of them overlapping, in either orientation.
fn field(noise: &mut Noise, side: i32) -> Vec<Ring> {
    let mut all = vec![];
    for k in 0..side * side {
        let centre = [f64::from(k / side) + 0.25 * noise.next(), f64::from(k % side) + 0.25 * noise.next()];
        let n = 3 + (2.5 * (noise.next() + 1.0)) as usize;
        let corner = |k: usize, noise: &mut Noise| {
            let angle = std::f64::consts::TAU * (k as f64 + 0.3 * noise.next()) / n as f64;
            let far = 0.32 + 0.16 * noise.next();
            [centre[0] + far * angle.cos(), centre[1] + far * angle.sin()]
        };
        let mut ring: Ring = (0..n).map(|k| corner(k, noise)).collect();
        if noise.next() > 0.0 {
            ring.reverse();
        }
        all.push(ring);
    }
    all
}

#[test]
fn random_scenes_pass_the_audit() {
    let mut noise = Noise(5);
    let mut corners = 0;
    for i in 0..60 {
        let obstacles = field(&mut noise, 4);
        let clearance = [0.0, 0.02, 0.05, 0.1][i % 4];
        // From outside, or from somewhere in the middle.
        let free = |p: &[f64; 2]| {
            apart_from_all(*p, &obstacles) > 0.11 && !obstacles.iter().any(|ring| audit::inside(*p, ring))
        };
        let middle = (0..1000).map(|_| noise.point().map(|x| 1.5 + x)).find(free).unwrap();
        let start = if i < 30 { [-1.0, -0.8] } else { middle };
        let scene = scene(start, [4.0, 3.7], obstacles, clearance, [1.0, 8.0, 30.0][i % 3]);
        let plan = plan(&scene).unwrap();
        audit_plan(&scene, &plan).unwrap();
        assert_eq!(prove(&scene, &plan.spans).unwrap(), plan.proof);
        corners += plan.corners.len();
    }
    assert!(corners > 100, "{corners}");
}

#[test]
fn a_thousand_vertices_are_planned_among() {
    let obstacles = field(&mut Noise(9), 14);
    let vertices: usize = obstacles.iter().map(Vec::len).sum();
    let scene = scene([-1.0, -0.8], [14.0, 13.7], obstacles, 0.03, 9.0);
    let plan = plan(&scene).unwrap();
    audit(&scene, &plan.spans).unwrap();
    assert!(vertices > 900 && plan.corners.len() > 10, "{vertices} {}", plan.corners.len());
}

#[test]
fn the_audit_can_fail() {
    let given = scene([-1.0, -0.8], [4.0, 3.7], field(&mut Noise(5), 4), 0.05, 8.0);
    let found = plan(&given).unwrap();
    let near = |share: f64| Scene { clearance: found.proof.clearance.unwrap().at_most * share, ..given.clone() };
    let bent = |share: f64| Scene { greatest_curvature: found.proof.curvature_at_most * share, ..given.clone() };
    let says = |scene: &Scene, spans: &[PhQuintic]| audit(scene, spans).err().unwrap_or_default();
    assert_eq!((says(&near(0.999), &found.spans), says(&bent(1.001), &found.spans)), (String::new(), String::new()));
    for scene in [near(1.001), bent(0.999)] {
        assert!(says(&scene, &found.spans).contains("not proved"));
        assert!(prove(&scene, &found.spans).is_err());
    }
    // A corner left sharp, and one turned a little.
    let mut sharp = found.spans.clone();
    let (from, to) = (sharp[1].start, sharp[1].end);
    sharp[1] = line(from, to);
    assert!(says(&given, &sharp).contains("kink"));
    let mut off = found.clone();
    off.corners[0].reach *= 1000.0;
    assert!(audit_plan(&given, &off).unwrap_err().contains("overlap"));
    off = found.clone();
    off.length_saved += 1e-6;
    assert!(audit_plan(&given, &off).unwrap_err().contains("length"));
}

/// The shortest path among polygons themselves: Dijkstra's algorithm on all vertices, by exhaustive sight.
fn shortest(scene: &Scene) -> f64 {
    let side = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let points: Vec<[f64; 2]> =
        [scene.start, scene.goal].into_iter().chain(scene.obstacles.iter().flatten().copied()).collect();
    // Properly crossed, or a diagonal inside: its middle, and points near its ends, are then inside.
    let blocked = |a: [f64; 2], b: [f64; 2]| {
        let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        scene.obstacles.iter().any(|ring| {
            let crossed = ring
                .iter()
                .zip(ring.iter().cycle().skip(1))
                .any(|(c, d)| side(a, b, *c) * side(a, b, *d) < -1e-18 && side(*c, *d, a) * side(*c, *d, b) < -1e-18);
            let deep = |p: [f64; 2]| audit::inside(p, ring) && apart_from_all(p, std::slice::from_ref(ring)) > 1e-9;
            crossed || [1e-3, 0.5, 1.0 - 1e-3].into_iter().any(|t| deep(at(t)))
        })
    };
    let mut best = vec![f64::INFINITY; points.len()];
    let mut done = vec![false; points.len()];
    best[0] = 0.0;
    while let Some(i) = (0..points.len()).filter(|i| !done[*i]).min_by(|i, j| best[*i].total_cmp(&best[*j])) {
        done[i] = true;
        for j in 0..points.len() {
            let way = best[i] + (points[i][0] - points[j][0]).hypot(points[i][1] - points[j][1]);
            if way < best[j] && !blocked(points[i], points[j]) {
                best[j] = way;
            }
        }
    }
    best[1]
}

#[test]
fn sharp_turns_allowed_it_is_the_shortest_path() {
    let mut noise = Noise(77);
    for _ in 0..12 {
        let scene = scene([-1.0, -0.8], [3.0, 2.7], field(&mut noise, 3), 1e-6, 1e5);
        let (got, want) = (length(&plan(&scene).unwrap()), shortest(&scene));
        assert!(want > 5.3 && got > want * (1.0 - 1e-9) && got < want * (1.0 + 1e-3), "{got} {want}");
    }
}

#[test]
fn other_obstacles_inside_the_corner_triangle() {
    // Around the wall's end; a pin stands where the largest corner curve would pass, and where every one does.
    let wall = vec![[0.0, -5.0], [0.2, -5.0], [0.2, 1.0], [0.0, 1.0]];
    let with = |pins: Vec<Ring>| scene([-2.0, -1.0], [2.2, -1.0], [vec![wall.clone()], pins].concat(), 0.1, 3.0);
    let free = plan(&with(vec![])).unwrap();
    audit_plan(&with(vec![]), &free).unwrap();
    let mut pinned = 0;
    for (i, t) in [0.2, 0.3, 0.4, 0.5, 0.6, 0.8].into_iter().enumerate() {
        let span = free.spans[free.corners[i % free.corners.len()].span];
        let pin = square(span.point(t), 0.01);
        let scene = with(vec![pin]);
        assert!(prove(&scene, &free.spans).is_err() && audit(&scene, &free.spans).is_err());
        let found = plan(&scene).unwrap();
        audit_plan(&scene, &found).unwrap();
        assert!(length(&found) < 1.5 * length(&free));
        pinned += usize::from(found.polyline != free.polyline);
    }
    assert!(pinned > 0);
}

#[test]
fn units_orientation_and_repeated_vertices_change_nothing() {
    let given = scene([-1.0, -0.8], [4.0, 3.7], field(&mut Noise(8), 4), 0.03, 9.0);
    let found = plan(&given).unwrap();
    let mut turned = given.clone();
    turned.obstacles.iter_mut().for_each(|ring| ring.reverse());
    assert_eq!(plan(&turned).unwrap().spans, found.spans);
    let mut repeated = given.clone();
    repeated.obstacles.iter_mut().for_each(|ring| {
        ring.insert(1, ring[0]);
        ring.push(ring[0]);
        let middle = [0.5 * (ring[2][0] + ring[1][0]), 0.5 * (ring[2][1] + ring[1][1])];
        ring.insert(2, middle);
    });
    assert!((length(&plan(&repeated).unwrap()) - length(&found)).abs() < 1e-9);
    for unit in [2f64.powi(-200), 2f64.powi(150)] {
        let scaled = |p: [f64; 2]| p.map(|x| x * unit);
        let other = Scene {
            start: scaled(given.start),
            goal: scaled(given.goal),
            obstacles: given.obstacles.iter().map(|ring| ring.iter().map(|p| scaled(*p)).collect()).collect(),
            clearance: given.clearance * unit,
            greatest_curvature: given.greatest_curvature / unit,
        };
        assert_near("length", &[length(&plan(&other).unwrap()) / unit], &[length(&found)], 1e-12);
    }
    // Far from the origin digits are lost, but nothing else.
    let far = |p: [f64; 2]| [p[0] + 1e6, p[1] - 3e6];
    let moved = Scene {
        start: far(given.start),
        goal: far(given.goal),
        obstacles: given.obstacles.iter().map(|ring| ring.iter().map(|p| far(*p)).collect()).collect(),
        ..given.clone()
    };
    assert_near("length", &[length(&plan(&moved).unwrap())], &[length(&found)], 1e-4);
}

#[test]
fn nothing_in_the_way() {
    let free = scene([0.0, 1.0], [3.0, 5.0], vec![], 0.5, 1e-3);
    let found = plan(&free).unwrap();
    assert_eq!((found.spans.len(), length(&found), found.proof.curvature_at_most), (1, 5.0, 0.0));
    assert!(found.proof.clearance.is_none() && found.corners.is_empty() && audit_plan(&free, &found).is_ok());
    let aside = scene([0.0, 0.0], [8.0, 0.0], vec![square([4.0, 2.0], 1.0)], 0.5, 1.0);
    let found = plan(&aside).unwrap();
    assert!(found.spans.len() == 1 && (found.proof.clearance.unwrap().at_least - 1.0).abs() < 1e-8);
}

#[test]
fn touching_and_overlapping_obstacles_are_one() {
    // Two squares that share a point, a side or more leave no gap; a gap of less than twice the clearance is none.
    for gap in [-0.5, 0.0, 0.15] {
        let squares = vec![square([0.0, -1.0 - gap / 2.0], 1.0), square([0.0, 1.0 + gap / 2.0], 1.0)];
        let given = scene([-2.0, 0.0], [2.0, 0.0], squares, 0.1, 5.0);
        let found = plan(&given).unwrap();
        audit_plan(&given, &found).unwrap();
        assert!(length(&found) > 5.5, "{gap}");
    }
    let open = vec![square([0.0, -1.15], 1.0), square([0.0, 1.15], 1.0)];
    let given = scene([-2.0, 0.0], [2.0, 0.0], open, 0.1, 5.0);
    assert_eq!(length(&plan(&given).unwrap()), 4.0);
    // Corner to corner.
    let given = scene(
        [-2.0, 0.0],
        [2.0, 0.0],
        vec![square([-0.5, -0.5], 0.5), square([0.5, 0.5], 0.5), square([0.0, 0.0], 0.2)],
        0.05,
        9.0,
    );
    audit_plan(&given, &plan(&given).unwrap()).unwrap();
}

/// Plans, audits, and says how long the path is.
fn planned(given: &Scene) -> f64 {
    let found = plan(given).unwrap();
    audit_plan(given, &found).unwrap();
    length(&found)
}
