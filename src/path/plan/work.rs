//! How many sides are looked at in scenes that crowd places or sides: counted, not timed.

use super::*;

type Ring = Vec<[f64; 2]>;

/// Points at equal angles around (5, 0), at these distances in turn.
fn round(count: usize, first: f64, far: &[f64]) -> Ring {
    let at = |i: usize| {
        let (sine, cosine) = (first + std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        let far = far[i % far.len()];
        [5.0 + far * cosine, far * sine]
    };
    (0..count).map(at).collect()
}

fn square(shift: f64) -> Ring {
    [[3.0, -2.0], [7.0, -2.0], [7.0, 2.0], [3.0, 2.0]].map(|p| p.map(|x| x + shift)).to_vec()
}

/// Sides looked at in search of a path around obstacles, whether there is one, and the number of sides.
fn looked_at(obstacles: Vec<Ring>, clearance: f64, greatest_curvature: f64) -> (usize, bool, usize) {
    let scene = Scene { start: [0.0, 0.0], goal: [10.0, 0.0], obstacles, clearance, greatest_curvature };
    let obstacles = scene.check().unwrap();
    let found = route(&scene, &obstacles, scene.limits());
    (obstacles.looks(), found.is_ok(), obstacles.sides().count())
}

/// The first search, the first one in the open alone, which takes as much as this, and those after it.
fn bound(sides: usize) -> usize {
    SIDES_LOOKED_AT[0] + SIDES_LOOKED_AT[1] * sides + 3 * search::SIDES * MORE
}

#[test]
fn squares_that_nearly_coincide_are_looked_at_as_often_as_their_number() {
    for count in [50, 150] {
        for step in [1e-12, 1e-9, 1e-8] {
            let squares = (0..count).map(|i| square(step * i as f64)).collect();
            let (looks, found, _) = looked_at(squares, 0.1, 0.3);
            assert!(found && looks < 50_000 * count, "{count} {step} {looks}");
        }
    }
}

#[test]
fn crowds_end_with_a_path_where_one_leads_around_in_the_open() {
    let turned =
        |count: usize| (0..count).map(|i| round(7, 0.897 * i as f64 / count as f64, &[2.0])).collect::<Vec<_>>();
    let apart = |count: usize| (0..count).map(|i| square(1e-3 * i as f64)).collect();
    let star = |count: usize| vec![round(count, 0.0, &[1.0, 2.0])];
    let squares = |count: usize| (0..count).map(|i| round(4, 0.01 * i as f64, &[2.8])).collect::<Vec<_>>();
    let crowds = [(turned(50), 0.1, 0.3), (apart(60), 0.1, 0.3), (star(900), 0.1, 0.3), (star(900), 0.01, 5.0)];
    // At low curvature start and goal see all of hundreds of places in the open.
    let wide = [(squares(100), 0.1, 0.05), (squares(200), 0.1, 0.1)];
    for (i, (obstacles, clearance, most)) in crowds.into_iter().chain(wide).enumerate() {
        let (looks, found, sides) = looked_at(obstacles, clearance, most);
        assert!(found && looks < bound(sides), "{i}: {looks} {sides}");
    }
}
