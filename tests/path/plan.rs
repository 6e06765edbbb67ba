//! Paths among obstacles.

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
        let free = |p: &[f64; 2]| apart_from_all(*p, &obstacles) > 0.11 && !obstacles.iter().any(|ring| audit::inside(*p, ring));
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
    let points: Vec<[f64; 2]> = [scene.start, scene.goal].into_iter().chain(scene.obstacles.iter().flatten().copied()).collect();
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
fn verdicts_at_the_very_limit() {
    // A straight path, its distance from a side exact in doubles.
    let given = |clearance: f64| scene([0.0, 0.0], [8.0, 0.0], vec![vec![[2.0, 0.5], [5.0, 0.5], [3.0, 2.0]]], clearance, 1.0);
    let path = [line([0.0, 0.0], [8.0, 0.0])];
    let proved = |clearance: f64| prove(&given(clearance), &path);
    assert!(proved(0.5 - 1e-9).is_ok());
    // Exactly the clearance is kept, but doubles cannot prove it.
    for clearance in [0.5, 0.5 + 1e-12] {
        let error = proved(clearance).unwrap_err().to_string();
        assert!(error.contains("not proved") && error.contains("obstacles[0]"), "{error}");
    }
    assert!(audit(&given(0.4999), &path).is_ok() && audit(&given(0.5 + 1e-7), &path).is_err());
    // The curvature of a corner: its greatest is that of the middle to a few roundings.
    let turn = Turn::new([1.0, 0.0], [0.3, 1.0]).unwrap();
    let (at, reach) = ([2.0, 0.0], 1.5);
    let corner = turn.corner(at, reach).unwrap();
    let allowed = |share: f64| {
        let given =
            Scene { greatest_curvature: turn.curvature(reach) * share, ..scene(corner.start, corner.end, vec![], 0.0, 1.0) };
        prove(&given, &[corner])
    };
    assert!(allowed(1.0 + 1e-13).is_ok());
    let error = allowed(1.0 - 1e-13).unwrap_err().to_string();
    assert!(error.contains("span 0 has a curvature of"), "{error}");
}

#[test]
fn samples_that_miss_a_needle_fool_nobody() {
    // A needle reaches through the path between two of 2000 samples, or up to a hair's breadth of the clearance.
    let turn = Turn::new([1.0, 0.0], [0.0, 1.0]).unwrap();
    let corner = turn.corner([10.0, 0.0], 8.0).unwrap();
    let path = [line([0.0, 0.0], corner.start), corner, line(corner.end, [10.0, 12.0])];
    let t = 0.500_25;
    let (p, along) = (corner.point(t), corner.tangent(t));
    let place =
        |across: f64, ahead: f64| [p[0] - along[1] * across + along[0] * ahead, p[1] + along[0] * across + along[1] * ahead];
    let needle = |tip: f64| vec![vec![place(tip, 0.0), place(3.0, -1e-4), place(3.0, 1e-4)]];
    let given = |tip: f64, clearance: f64| scene([0.0, 0.0], [10.0, 12.0], needle(tip), clearance, 1.0);
    let sampled =
        |scene: &Scene| (0..=2000).all(|i| apart_from_all(corner.point(f64::from(i) / 2000.0), &scene.obstacles) > 1e-4);
    let through = given(-0.5e-4, 1e-5);
    assert!(sampled(&given(1e-4, 0.0)) && prove(&given(1e-4, 0.0), &path).is_ok());
    assert!(prove(&through, &path).is_err() && audit(&through, &path).is_err());
    for tip in [1e-3, 0.1, 0.5] {
        let clearance = tip + 1e-10;
        assert!(prove(&given(tip, tip - 1e-10), &path).is_ok());
        let error = prove(&given(tip, clearance), &path).unwrap_err().to_string();
        assert!(error.contains("is not proved"), "{error}");
        // Half a step from it no sample sees that.
        let scene = given(tip, clearance);
        assert!((0..=2000).all(|i| apart_from_all(corner.point(f64::from(i) / 2000.0), &scene.obstacles) >= clearance));
    }
    // And paths that do not lead there.
    assert!(prove(&given(0.1, 0.0), &path[..2]).unwrap_err().to_string().contains("not from `start` to `goal`"));
    let gap = [path[0], path[2]];
    assert!(prove(&given(0.1, 0.0), &gap).unwrap_err().to_string().contains("span 0 ends at"));
    assert!(prove(&given(0.1, 0.0), &[]).is_err());
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

#[test]
fn what_makes_no_sense_or_has_no_path_is_named() {
    let fine = || scene([-2.0, 0.0], [2.0, 0.0], vec![square([0.0, 0.0], 1.0)], 0.1, 5.0);
    let says = |change: &dyn Fn(&mut Scene), parts: &[&str]| {
        let mut scene = fine();
        change(&mut scene);
        let error = plan(&scene).expect_err(parts[0]).to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{error}: {parts:?}");
    };
    assert!(plan(&fine()).is_ok());
    says(&|s| s.start[1] = f64::NAN, &["`start`", "NaN"]);
    says(&|s| s.goal[0] = f64::INFINITY, &["`goal`", "inf"]);
    says(&|s| s.clearance = f64::NAN, &["`clearance`"]);
    says(&|s| s.clearance = -0.1, &["`clearance` is -0.1"]);
    says(&|s| s.greatest_curvature = 0.0, &["`greatest_curvature` is 0.0"]);
    says(&|s| s.greatest_curvature = -1.0, &["`greatest_curvature` is -1.0"]);
    says(&|s| s.goal = s.start, &["both [-2.0, 0.0]"]);
    says(&|s| s.obstacles[0][2][1] = f64::NEG_INFINITY, &["`obstacles[0][2]` is [1.0, -inf]"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [6.0, 5.0]]), &["obstacles[1] has 2 different vertices"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0]; 9]), &["obstacles[1] has 1 different vertices"]);
    says(&|s| s.obstacles.push(vec![]), &["obstacles[1] has 0"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [6.0, 6.0], [6.0, 5.0], [5.0, 6.0]]), &["obstacles[1] meets itself", "split it"]);
    // Back on itself, flat, and a vertex on a side.
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [8.0, 5.0], [6.0, 5.0], [6.0, 7.0]]), &["obstacles[1] meets itself"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [6.0, 6.0], [7.0, 7.0]]), &["obstacles[1] meets itself"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [7.0, 5.0], [7.0, 7.0], [6.0, 5.0], [5.0, 7.0]]), &["obstacles[1] meets itself"]);
    says(&|s| s.start = [0.5, 0.5], &["`start` [0.5, 0.5] lies in or on obstacles[0]"]);
    says(&|s| s.goal = [1.0, 0.3], &["`goal` [1.0, 0.3] lies in or on obstacles[0]"]);
    says(&|s| s.goal = [1.05, 0.0], &["`goal` [1.05, 0.0]", "away from obstacles[0]", "clearance 0.1"]);
    says(&|s| s.start = [-1.1, 0.0], &["`start` [-1.1, 0.0]"]);
    says(&|s| s.obstacles = vec![vec![[0.0; 2]; 20_001]], &["20001 vertices"]);
    says(&|s| s.start[0] = 1e200, &["1e200", "unit of length"]);
    says(&|s| s.clearance = 1e300, &["`start`", "clearance 1e300"]);
    // A ring of walls, and a room whose door is too narrow.
    let walls = |gap: f64| {
        let side = |turn: usize| -> Ring {
            let ring = [[gap - 3.0, 2.0], [3.0, 2.0], [3.0, 2.5], [gap - 3.0, 2.5]];
            ring.iter().map(|p| (0..turn).fold(*p, |p, _| [-p[1], p[0]])).collect()
        };
        (0..4).map(side).collect::<Vec<Ring>>()
    };
    let room = |gap: f64, most: f64| scene([0.0, 0.0], [9.0, 0.0], walls(gap), 0.1, most);
    let error = |scene: Scene| plan(&scene).unwrap_err().to_string();
    assert!(error(room(0.0, 5.0)).contains("every way is blocked"));
    assert!(error(room(1.9, 0.05)).contains("the shortest way turns"), "{}", error(room(1.9, 0.05)));
    let found = plan(&room(2.5, 8.0)).unwrap();
    audit_plan(&room(2.5, 8.0), &found).unwrap();
    // Curvature that no leg has room for: the corner is named, with what it needs.
    let error = error(room(1.9, 1e-3));
    assert!(
        ["the shortest way turns", "obstacles[", "degrees", "curvature 0.001", "needs"].iter().all(|p| error.contains(p)),
        "{error}"
    );
}

#[test]
fn small_round_things_are_gone_around_in_wide_turns() {
    // A pin in the only gap between two walls, and its radius is far below that of the path.
    let pin = square([0.0, 0.0], 0.05);
    let wall = |x: f64| vec![[x, -30.0], [x + 0.1, -30.0], [x + 0.1, 0.3], [x, 0.3]];
    let given = scene([-0.5, -3.0], [0.6, -3.0], vec![pin, wall(-0.05)], 0.1, 1.0);
    let found = plan(&given).unwrap();
    audit_plan(&given, &found).unwrap();
    // A polygon of 60 sides, too many to turn at each.
    let around = |k: u32| (f64::from(k) * std::f64::consts::TAU / 60.0).sin_cos();
    let disc: Ring = (0..60).map(around).map(|(s, c)| [c, s]).collect();
    let given = scene([-3.0, 0.1], [3.0, -0.1], vec![disc], 0.1, 0.8);
    let found = plan(&given).unwrap();
    audit_plan(&given, &found).unwrap();
    assert!(length(&found) < 8.0, "{}", length(&found));
}

#[test]
fn vehicles_in_step_on_planned_paths_are_told_apart_exactly() {
    // Lines and corners join with directions that differ by rounding; taken for corners, 400,000 stretches would not do.
    let given = scene([-1.0, -0.8], [4.0, 3.7], field(&mut Noise(8), 4), 0.03, 9.0);
    let spans = plan(&given).unwrap().spans;
    let moved = |p: [f64; 2]| [p[0] + 0.3, p[1] + 0.4];
    let beside = spans.iter().map(|s| PhQuintic::between(moved(s.start), moved(s.end), s.preimage)).collect();
    let pair = [spans, beside].map(|spans| Motion::new(spans, 1.0, 0.0).unwrap());
    let found = separation(&pair[0], &pair[1], 0.5 - 1e-7).unwrap();
    let closest = found.closest;
    assert!(found.verdict == Verdict::Kept && (closest.at_most - 0.5).abs() < 1e-12, "{found:?}");
}

/// Plans, audits, and tells how long the path is.
fn planned(given: &Scene) -> f64 {
    let found = plan(given).unwrap();
    audit_plan(given, &found).unwrap();
    length(&found)
}

#[test]
fn low_curvature_swings_out() {
    // With both ends free there is a path for every curvature.
    for most in [1.0, 0.3, 0.1, 0.01] {
        let given = scene([-1.5, 0.0], [1.5, 0.0], vec![square([0.0, 0.0], 1.0)], 0.2, most);
        // Proved; the audit's tolerances are those of the scene, which such paths leave far behind.
        let length = length(&plan(&given).unwrap());
        assert!(length > 5.0 && length < 30.0 / most, "{length}");
    }
    // Between two aisles of a grid, straight out of one and into the other from the outside.
    let squares = (0..64).map(|k| square([f64::from(k / 8), f64::from(k % 8)], 0.3)).collect();
    let given = scene([0.5, 0.5], [6.5, 6.5], squares, 0.05, 0.5);
    let found = plan(&given).unwrap();
    audit_plan(&given, &found).unwrap();
    let open = found.corners.iter().filter(|corner| corner.vertex.is_none() && corner.obstacle.is_none()).count();
    assert!(open > 0 && length(&found) < 55.0, "{open} {}", length(&found));
}

#[test]
fn wide_corridors_leave_room_for_corners_a_little_further_off() {
    let walls = vec![
        vec![[-1.0, -1.0], [11.0, -1.0], [11.0, 0.0], [-1.0, 0.0]],
        vec![[-1.0, 1.0], [9.0, 1.0], [9.0, 10.0], [-1.0, 10.0]],
        vec![[10.0, -1.0], [11.0, -1.0], [11.0, 10.0], [10.0, 10.0]],
    ];
    let length = planned(&scene([0.0, 0.5], [9.5, 9.0], walls, 0.1, 1.0));
    assert!((16.0..18.0).contains(&length), "{length}");
}

#[test]
fn needles_are_turned_at_the_tip() {
    let slab = vec![[-1000.0, -1.0], [1000.0, -1.0], [1000.0, 0.001], [-1000.0, 0.001]];
    let needle = vec![[-0.05, 0.0], [0.05, 0.0], [0.0, 10.0]];
    let length = planned(&scene([-1.0, 9.0], [1.0, 9.0], vec![needle, slab], 0.2, 10.0));
    assert!(length < 5.0, "{length}");
}

/// A wall with teeth one apart, 0.3 thick.
fn comb(teeth: usize) -> Ring {
    let end = teeth as f64 + 1.0;
    let tooth = |i: usize| [[0.2, 0.0], [0.2, 3.0], [0.5, 3.0], [0.5, 0.0]].map(|p| [p[0] + i as f64, p[1]]);
    [[0.0, -1.0]].into_iter().chain((0..teeth).flat_map(tooth)).chain([[end, -1.0]]).collect()
}

#[test]
fn combs_grids_and_spirals_do_not_exhaust_the_search() {
    let teeth = scene([0.85, 0.5], [29.85, 0.5], vec![comb(30)], 0.05, 1.0);
    let squares = (0..64).map(|k| square([f64::from(k / 8), f64::from(k % 8)], 0.3)).collect();
    let grid = scene([0.5, 0.5], [6.5, 6.5], squares, 0.05, 3.0);
    let wall = |in_by: f64| {
        (0..400).map(move |k| {
            let angle = 4.0 * std::f64::consts::PI * f64::from(k) / 399.0;
            let far = 1.0 + angle / std::f64::consts::TAU - in_by;
            [far * angle.cos(), far * angle.sin()]
        })
    };
    let spiral = scene([0.0, 0.0], [5.0, 0.0], vec![wall(0.0).chain(wall(0.05).rev()).collect()], 0.1, 5.0);
    for (given, most) in [(teeth, 40.0), (grid, 12.0), (spiral, 16.0)] {
        let length = planned(&given);
        assert!(length < most, "{length}");
    }
}

#[test]
fn blocked_is_said_at_once_and_only_where_it_is_so() {
    // Four walls around the goal that leave slits 0.05 narrower than given at their corners, in a field of squares.
    let walls = |slit: f64| {
        let side = move |turn: usize| -> Ring {
            let ring = [[slit - 0.5, 0.45], [0.5, 0.45], [0.5, 0.5], [slit - 0.5, 0.5]];
            ring.iter().map(|p| (0..turn).fold(*p, |p, _| [-p[1], p[0]])).map(|p| [p[0] + 6.0, p[1] + 6.0]).collect()
        };
        (0..4).map(side)
    };
    let squares = || (0..144).filter(|k| *k != 6 * 12 + 6).map(|k| square([f64::from(k / 12), f64::from(k % 12)], 0.3));
    let given =
        |slit: f64, clearance: f64| scene([-1.0, -1.0], [6.0, 6.0], walls(slit).chain(squares()).collect(), clearance, 1e4);
    let says = |scene: Scene| plan(&scene).map_or_else(|e| e.to_string(), |_| "found".into());
    for (slit, clearance) in [(0.0, 0.0), (0.0, 0.05), (0.15, 0.0501)] {
        assert!(says(given(slit, clearance)).contains("every way is blocked: obstacles grown"), "{slit} {clearance}");
    }
    assert_eq!([says(given(0.15, 0.0)), says(given(0.15, 0.04))], ["found", "found"]);
    // A ring around both ends, or beside them, parts nothing.
    let ring = |x: f64| walls(0.0).map(move |ring| ring.into_iter().map(|p| [p[0] - 6.0 + x, p[1] - 6.0]).collect::<Ring>());
    for x in [0.0, 2.0, 4.0] {
        let blocked = says(scene([x - 0.1, 0.0], [0.1, 0.2], ring(0.0).collect(), 0.01, 1e3)).contains("blocked");
        assert_eq!(blocked, x != 0.0, "{x}");
        let blocked = says(scene([-3.0, 0.0], [7.0, 0.0], ring(x).collect(), 0.01, 1e3)).contains("blocked");
        assert!(!blocked, "{x}");
    }
}

#[test]
fn a_list_is_no_scene() {
    let error = serde_json::from_str::<Scene>("[[0, 0]]").unwrap_err().to_string();
    assert!(error.contains("an object with start, goal, obstacles, clearance and greatest_curvature"), "{error}");
}

/// Copies in either direction, from any vertex, and polygons inside of others change nothing.
#[test]
fn copies_and_what_lies_inside_change_nothing() {
    let square = vec![[1.0, -1.0], [2.0, -1.0], [2.0, 1.0], [1.0, 1.0]];
    let scene = |obstacles: Vec<Vec<[f64; 2]>>| Scene {
        start: [0.0, 0.0],
        goal: [3.0, 0.0],
        obstacles,
        clearance: 0.1,
        greatest_curvature: 5.0,
    };
    let alone = plan(&scene(vec![square.clone()])).unwrap();
    let copies = (0..100).map(|i| {
        let mut copy = square.clone();
        copy.rotate_left(i % 4);
        if i % 3 == 1 {
            copy.reverse();
        }
        copy
    });
    let nested = (1..100)
        .map(|i| square.iter().map(|p| [1.5 + (p[0] - 1.5) * f64::from(i) / 100.0, p[1] * f64::from(i) / 100.0]).collect());
    assert_eq!(plan(&scene([square.clone()].into_iter().chain(copies).chain(nested).collect())).unwrap(), alone);
}
