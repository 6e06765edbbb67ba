//! Scenes that are hard to search: low curvature, needles, combs, copies.

use super::*;

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
    let nested = (1..100).map(|i| {
        square.iter().map(|p| [1.5 + (p[0] - 1.5) * f64::from(i) / 100.0, p[1] * f64::from(i) / 100.0]).collect()
    });
    assert_eq!(plan(&scene([square.clone()].into_iter().chain(copies).chain(nested).collect())).unwrap(), alone);
}
