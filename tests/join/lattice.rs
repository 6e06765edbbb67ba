//! Motion primitives for nav2: the rules of its loader, and the curves themselves.

use super::check::check_told;
use super::{FAMILIES, state};
use serde_json::{Value, json};
use spiral_atlas::export::{Lattice, LatticeOptions, Primitive, lattice};
use spiral_atlas::transition::join::{Family, Request};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A robot with a least radius of half a metre on a grid of 5 cm.
fn usual() -> LatticeOptions {
    LatticeOptions::new(0.5, 0.05)
}

/// As the planner holds a number: read as a double, kept as a float.
fn float(value: &Value) -> f32 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number")) as f32
}

fn rule(kept: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if kept { Ok(()) } else { Err(what()) }
}

/// What nav2 makes of a file, and whether it means what the file says: it checks nothing itself, and takes primitives
/// by their order. Says what is wrong.
fn loaded(text: &str) -> Result<(), String> {
    let all: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    let metadata = &all["lattice_metadata"];
    let (radius, resolution) = (float(&metadata["turning_radius"]), float(&metadata["grid_resolution"]));
    let count = metadata["num_of_headings"].as_u64().unwrap() as usize;
    let angles: Vec<f32> = metadata["heading_angles"].as_array().unwrap().iter().map(float).collect();
    rule(metadata["motion_model"] == "ackermann", || format!("motion model {}", metadata["motion_model"]))?;
    rule(angles.len() == count, || format!("{} angles", angles.len()))?;
    rule(angles[0] == 0.0 && angles.windows(2).all(|w| w[0] < w[1]), || format!("{angles:?}"))?;
    rule(angles.iter().all(|angle| f64::from(*angle) < TAU), || format!("{angles:?}"))?;
    let primitives = all["primitives"].as_array().unwrap();
    rule(metadata["number_of_trajectories"] == primitives.len(), || "number of trajectories".into())?;
    // A list of primitives for each heading: a new one begins where the index changes.
    let (mut lists, mut before, mut list) = (Vec::new(), 0.0, Vec::new());
    for primitive in primitives {
        let start = float(&primitive["start_angle_index"]);
        if start != before {
            lists.push(std::mem::take(&mut list));
            before = start;
        }
        list.push(primitive);
    }
    lists.push(list);
    rule(lists.len() == count, || format!("{} lists for {count} headings", lists.len()))?;
    let mut id = 0;
    for (heading, list) in lists.iter().enumerate() {
        rule(!list.is_empty(), || format!("nothing leads from heading {heading}"))?;
        for primitive in list {
            let blame = |what: &str| format!("{what} of {primitive}");
            rule(primitive["trajectory_id"] == id, || blame("id"))?;
            id += 1;
            rule(primitive["start_angle_index"] == heading, || blame("start"))?;
            let end = primitive["end_angle_index"].as_u64().unwrap() as usize;
            rule(end < count, || blame("end"))?;
            let length = float(&primitive["trajectory_length"]);
            let (arc, line) = (float(&primitive["arc_length"]), float(&primitive["straight_length"]));
            rule((arc + line - length).abs() <= 1e-6 * length && length > 1e-4, || blame("lengths"))?;
            // Shorter arcs would count as straight.
            rule(if end == heading { arc == 0.0 } else { arc >= 0.001 }, || blame("arc"))?;
            let turned = (2 * (end + count - heading)) % (2 * count);
            rule(primitive["left_turn"].as_bool() == Some(turned <= count), || blame("side"))?;
            let least = float(&primitive["trajectory_radius"]);
            rule(if end == heading { least == 0.0 } else { least >= radius }, || blame("radius"))?;
            let poses: Vec<[f32; 3]> =
                primitive["poses"].as_array().unwrap().iter().map(|p| [0, 1, 2].map(|i| float(&p[i]))).collect();
            rule(poses.iter().all(|p| p[2] >= 0.0 && f64::from(p[2]) < TAU), || blame("yaw"))?;
            // The start is left out, and no step is much longer than a cell.
            let points = [[0.0, 0.0]].into_iter().chain(poses.iter().map(|p| [p[0], p[1]])).collect::<Vec<_>>();
            let steps = points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]) / resolution);
            rule(steps.clone().all(|step| (0.5..=1.5).contains(&step)), || blame("steps"))?;
            let [x, y, yaw] = poses[poses.len() - 1];
            rule(yaw == angles[end], || blame("last yaw"))?;
            for last in [x, y] {
                let cells = (f64::from(last) / f64::from(resolution)).round();
                // Wherever the robot is, at the corner of a cell or within: cut off, the sum is the right cell.
                for from in (0..2000).map(|n| n as f32).filter(|from| f64::from(*from) + cells >= 0.0) {
                    for inside in [0.0, 0.5] {
                        let to = (from + inside + last / resolution) as u32;
                        rule(f64::from(to) == f64::from(from) + cells, || blame("last pose"))?;
                    }
                }
            }
        }
    }
    rule(id == primitives.len(), || "number".into())
}

#[test]
fn the_loader_understands_the_file() {
    for (radius, resolution) in [(0.5, 0.05), (1.0, 0.05), (0.4, 0.1), (2.0, 0.07), (0.3, 0.3)] {
        for headings in [16, 24] {
            let options = LatticeOptions { headings, ..LatticeOptions::new(radius, resolution) };
            let text = lattice(&options).unwrap().to_json().unwrap();
            loaded(&text).unwrap_or_else(|e| panic!("{options:?}: {e}"));
        }
    }
}

#[test]
fn the_loaders_rules_catch_mistakes() {
    let text = lattice(&usual()).unwrap().to_json().unwrap();
    type Change<'a> = (&'a str, &'a dyn Fn(&mut Value));
    let mistaken: [Change; 7] = [
        ("number of trajectories", &|v| drop(v["primitives"].as_array_mut().unwrap().pop())),
        ("lists", &|v| {
            v["primitives"].as_array_mut().unwrap().retain(|p| p["start_angle_index"] != 5);
            v["lattice_metadata"]["number_of_trajectories"] = v["primitives"].as_array().unwrap().len().into();
        }),
        ("lists", &|v| v["primitives"].as_array_mut().unwrap().swap(0, 20)),
        ("last yaw", &|v| v["primitives"][3]["end_angle_index"] = 2.into()),
        // 13 cells, as they are usually written.
        ("last pose", &|v| v["primitives"][3]["poses"].as_array_mut().unwrap().last_mut().unwrap()[0] = 0.65.into()),
        ("steps", &|v| drop(v["primitives"][1]["poses"].as_array_mut().unwrap().remove(0))),
        ("radius", &|v| v["primitives"][1]["trajectory_radius"] = 0.49.into()),
    ];
    for (what, change) in mistaken {
        let mut value: Value = serde_json::from_str(&text).unwrap();
        change(&mut value);
        let said = loaded(&value.to_string()).expect_err(what);
        assert!(said.contains(what), "{what}: {}", &said[..said.len().min(200)]);
    }
}

/// Each is checked from its control points: straight at both ends, G² between, monotone pieces, the limit.
#[test]
fn primitives_are_straight_at_both_ends_and_keep_the_limit() {
    for family in FAMILIES {
        // Involutes take a hundred times as long, and a coarse grid has fewer.
        let resolution = if family == Family::Involute { 0.5 } else { 0.1 };
        let options = LatticeOptions { family, ..LatticeOptions::new(0.5, resolution) };
        let found = lattice(&options).unwrap();
        assert!(found.primitives.iter().any(|p| p.pieces.len() > 3) && found.primitives.len() == 144, "{family:?}");
        for primitive in &found.primitives {
            checked(&found, primitive).unwrap_or_else(|e| panic!("{family:?} {primitive:?}: {e}"));
        }
    }
}

fn checked(lattice: &Lattice, primitive: &Primitive) -> Result<(), String> {
    let end = primitive.cell.map(|n| n as f64 * lattice.options.grid_resolution);
    let [from, to] = [primitive.start, primitive.end].map(|place| lattice.heading_angles[place]);
    let limit = 1.0 / lattice.options.turning_radius;
    let request = Request::new(state(0.0, 0.0, from, 0.0), state(end[0], end[1], to, 0.0), limit);
    let told = json!({
        "pieces": primitive.pieces,
        "length": primitive.length(),
        "greatest_curvature": primitive.greatest_curvature().min(limit),
    });
    check_told(&request, &told)?;
    // To one side only.
    let side = if primitive.left_turn() { 1.0 } else { -1.0 };
    let stations = primitive.stations(40).unwrap();
    if stations.iter().any(|s| s.curvature * side < -1e-9) {
        return Err("it turns to both sides".into());
    }
    Ok(())
}

#[test]
fn poses_lie_on_the_pieces() {
    let found = lattice(&usual()).unwrap();
    let all: Value = serde_json::from_str(&found.to_json().unwrap()).unwrap();
    for (primitive, told) in found.primitives.iter().zip(all["primitives"].as_array().unwrap()) {
        let poses = told["poses"].as_array().unwrap();
        let stations = primitive.stations(poses.len()).unwrap();
        for (pose, s) in poses.iter().zip(&stations[1..]) {
            let [x, y, yaw] = [0, 1, 2].map(|i| f64::from(float(&pose[i])));
            // One unit of a float's last place, which the end may be off, of numbers below 2; and half of one below 8.
            let apart = (x - s.x).abs().max((y - s.y).abs());
            assert!(apart <= 1.3e-7 && (yaw - s.heading).sin().abs() <= 2.4e-7, "{pose} {s:?}");
        }
    }
}

/// The same primitives from each heading, by quarter turns and mirrors.
#[test]
fn the_set_is_symmetric() {
    for headings in [16, 24] {
        let found = lattice(&LatticeOptions { headings, ..usual() }).unwrap();
        let all: BTreeMap<_, _> = found.primitives.iter().map(|p| ((p.start, p.end, p.cell), p)).collect();
        assert_eq!(all.len(), found.primitives.len());
        assert!(found.primitives.is_sorted_by_key(|p| (p.start, p.end, p.cell)));
        let quarter = |place: usize| (place + headings / 4) % headings;
        let mirror = |place: usize| (headings - place) % headings;
        for p in &found.primitives {
            let turned = all[&(quarter(p.start), quarter(p.end), [-p.cell[1], p.cell[0]])];
            let mirrored = all[&(mirror(p.start), mirror(p.end), [p.cell[0], -p.cell[1]])];
            let [here, turned, mirrored] = [p, turned, mirrored].map(|p| p.stations(20).unwrap());
            for ((a, b), c) in here.iter().zip(turned).zip(mirrored) {
                let apart = [a.x - b.y, a.y + b.x, a.x - c.x, a.y + c.y];
                assert!(apart.iter().all(|d| d.abs() < 1e-14), "{apart:?}");
            }
        }
    }
}

/// Every cell of a neighbourhood is reached from heading 0 in every heading.
#[test]
fn every_pose_is_reached() {
    for (radius, resolution) in [(0.5, 0.05), (0.4, 0.1)] {
        let found = lattice(&LatticeOptions::new(radius, resolution)).unwrap();
        let mut lists = vec![Vec::new(); 16];
        found.primitives.iter().for_each(|p| lists[p.start].push((p.cell, p.end, (p.length() * 1e9) as u64)));
        let far = (4.0 * radius / resolution) as i64;
        let side = 2 * far + 1;
        let place = |[x, y]: [i64; 2], heading: usize| ((x + far) * side + y + far) as usize * 16 + heading;
        let mut lengths = vec![None; (side * side) as usize * 16];
        // In nanometres, which have an order.
        let mut queue = BinaryHeap::from([Reverse((0u64, [0i64, 0], 0usize))]);
        while let Some(Reverse((length, cell, heading))) = queue.pop() {
            let known = &mut lengths[place(cell, heading)];
            if known.is_some() {
                continue;
            }
            *known = Some(length);
            for (step, end, more) in &lists[heading] {
                let next = [0, 1].map(|i| cell[i] + step[i]);
                if next.iter().all(|n| n.abs() <= far) {
                    queue.push(Reverse((length + more, next, *end)));
                }
            }
        }
        let near = far / 2;
        for (x, y) in (-near..=near).flat_map(|x| (-near..=near).map(move |y| (x, y))) {
            for heading in 0..16 {
                assert!(lengths[place([x, y], heading)].is_some(), "{radius} {resolution}: {x} {y} {heading}");
            }
        }
        // Straight ahead, where straight primitives lead, nothing is shorter.
        let [step, _] = found.primitives[0].cell;
        let ahead = lengths[place([4 * step, 0], 0)].unwrap() as f64 * 1e-9 / (4.0 * step as f64 * resolution);
        assert!((1.0 - 1e-6..=1.0).contains(&ahead), "{ahead}");
    }
}

/// None is made of a shorter one and one more, passing its end; and none ends near another of its headings.
#[test]
fn the_set_is_small() {
    let ends = |found: &Lattice, start: usize| -> Vec<(usize, [i64; 2])> {
        found.primitives.iter().filter(|p| p.start == start).map(|p| (p.end, p.cell)).collect()
    };
    let found = lattice(&usual()).unwrap();
    let from_0 = [(0, [3, 0]), (1, [9, 2]), (2, [12, 5]), (3, [13, 8]), (4, [13, 13])];
    assert_eq!(ends(&found, 0)[..5], from_0);
    assert_eq!(found.primitives.len(), 16 * 9);
    let counts = [0.0, 0.3, 0.9].map(|distinctness| {
        let found = lattice(&LatticeOptions { distinctness, ..usual() }).unwrap();
        // One straight line for each heading: longer ones are made of it.
        assert_eq!(found.primitives.iter().filter(|p| p.start == p.end).count(), 16);
        for (i, p) in found.primitives.iter().enumerate() {
            for q in found.primitives[..i].iter().filter(|q| (q.start, q.end) == (p.start, p.end)) {
                let apart = (p.cell[0] - q.cell[0]) as f64 * 0.05;
                let apart = apart.hypot((p.cell[1] - q.cell[1]) as f64 * 0.05);
                assert!(apart >= distinctness * p.length().max(q.length()) - 1e-12, "{p:?} {q:?}");
            }
        }
        found.primitives.len()
    });
    assert_eq!(counts, [688, 312, 144]);
}

#[test]
fn the_same_options_give_the_same_bytes() {
    let [a, b] = [0, 1].map(|_| lattice(&usual()).unwrap().to_json().unwrap());
    assert!(a == b && a.lines().count() == 146);
    // The first and the second line: metadata, and the straight line along heading 0.
    let lines: Vec<&str> = a.lines().collect();
    assert!(lines[0].starts_with(concat!(
        r#"{"version":1.0,"lattice_metadata":{"motion_model":"ackermann","turning_radius":0.5,"#,
        r#""grid_resolution":0.05,"num_of_headings":16,"#
    )));
    assert_eq!(
        lines[1],
        concat!(
            r#"{"trajectory_id":0,"start_angle_index":0,"end_angle_index":0,"left_turn":true,"#,
            r#""trajectory_radius":0.0,"trajectory_length":0.15,"arc_length":0.0,"straight_length":0.15,"#,
            r#""poses":[[0.05,0.0,0.0],[0.1,0.0,0.0],[0.15,0.0,0.0]]},"#
        )
    );
}

#[test]
fn options_out_of_range_are_refused() {
    let usual = usual();
    let of = |turning_radius, grid_resolution| LatticeOptions { turning_radius, grid_resolution, ..usual };
    let headings = |headings| LatticeOptions { headings, ..usual };
    let distinctness = |distinctness| LatticeOptions { distinctness, ..usual };
    let cases = [
        (of(0.0, 0.05), "turning radius is 0.0"),
        (of(f64::NAN, 0.05), "turning radius is NaN"),
        (of(f64::INFINITY, 0.05), "turning radius is inf"),
        (of(-1.0, 0.05), "turning radius is -1.0"),
        (of(0.5, 0.0), "grid resolution is 0.0"),
        (of(0.5, f64::NAN), "grid resolution is NaN"),
        (of(0.5, 0.6), "0.6 m is larger than the turning radius"),
        (of(50.0, 0.05), "1000 cells"),
        (headings(0), "0 headings"),
        (headings(7), "7 headings"),
        (headings(8), "8 headings"),
        (headings(136), "136 headings"),
        (distinctness(-0.1), "distinctness is -0.1"),
        (distinctness(f64::NAN), "distinctness is NaN"),
    ];
    for (options, words) in cases {
        let said = lattice(&options).expect_err(words).to_string();
        assert!(said.contains(words), "{words}: {said}");
    }
}

/// Many headings, and a coarse grid: each still has its turns to the neighbours.
#[test]
fn each_heading_leads_to_all_within_a_quarter_turn() {
    for options in [
        LatticeOptions { headings: 40, ..LatticeOptions::new(0.5, 0.1) },
        LatticeOptions { headings: 32, ..LatticeOptions::new(1.0, 1.0) },
    ] {
        let found = lattice(&options).unwrap();
        let count = options.headings;
        for start in 0..count {
            let ends: BTreeSet<usize> = found.primitives.iter().filter(|p| p.start == start).map(|p| p.end).collect();
            for turned in 0..=count / 4 {
                let [left, right] = [start + turned, start + count - turned].map(|place| place % count);
                assert!(ends.contains(&left) && ends.contains(&right), "{start} {turned}: {ends:?}");
            }
        }
        assert!(found.primitives.iter().all(|p| checked(&found, p).is_ok()));
        let quarter = found.heading_angles[count / 4];
        assert!((quarter - FRAC_PI_2).abs() < 1e-15);
    }
}
