//! Scenes that make no sense, and those without a path.

use super::*;

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
    says(
        &|s| s.obstacles.push(vec![[5.0, 5.0], [6.0, 6.0], [6.0, 5.0], [5.0, 6.0]]),
        &["obstacles[1] meets itself", "split it"],
    );
    // Back on itself, flat, and a vertex on a side.
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [8.0, 5.0], [6.0, 5.0], [6.0, 7.0]]), &["obstacles[1] meets itself"]);
    says(&|s| s.obstacles.push(vec![[5.0, 5.0], [6.0, 6.0], [7.0, 7.0]]), &["obstacles[1] meets itself"]);
    says(
        &|s| s.obstacles.push(vec![[5.0, 5.0], [7.0, 5.0], [7.0, 7.0], [6.0, 5.0], [5.0, 7.0]]),
        &["obstacles[1] meets itself"],
    );
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
        ["the shortest way turns", "obstacles[", "degrees", "curvature 0.001", "needs"]
            .iter()
            .all(|p| error.contains(p)),
        "{error}"
    );
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
    let given = |slit: f64, clearance: f64| {
        scene([-1.0, -1.0], [6.0, 6.0], walls(slit).chain(squares()).collect(), clearance, 1e4)
    };
    let says = |scene: Scene| plan(&scene).map_or_else(|e| e.to_string(), |_| "found".into());
    for (slit, clearance) in [(0.0, 0.0), (0.0, 0.05), (0.15, 0.0501)] {
        assert!(says(given(slit, clearance)).contains("every way is blocked: obstacles grown"), "{slit} {clearance}");
    }
    assert_eq!([says(given(0.15, 0.0)), says(given(0.15, 0.04))], ["found", "found"]);
    // A ring around both ends, or beside them, parts nothing.
    let ring =
        |x: f64| walls(0.0).map(move |ring| ring.into_iter().map(|p| [p[0] - 6.0 + x, p[1] - 6.0]).collect::<Ring>());
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
