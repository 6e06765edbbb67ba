//! Ends that hardly turn: changes of lanes, and roads that are nearly straight.

use super::check::check;
use super::{FAMILIES, Random, found, state};
use spiral_atlas::transition::join::{End, Family, Join, Objective, Request};

/// The join that is found, after all checks of one.
fn checked(request: &Request) -> Join {
    let join = found(request);
    check(request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
    join
}

/// The path between states that lie nearly ahead of each other is hardly longer than the straight line, whatever the
/// limit of curvature has room for.
#[test]
fn what_hardly_turns_is_hardly_longer() {
    let mut random = Random(11);
    for (family, count) in FAMILIES.into_iter().zip([1000, 1000, 200, 1000, 1000]) {
        let mut worst = 0.0f64;
        for i in 0..count {
            let apart = [1000.0, 100.0][i % 2];
            let limit = 0.01 * 20f64.powf(random.next());
            let mut small = |most: f64| most * random.between(-1.0, 1.0) * 10f64.powf(random.between(-6.0, 0.0));
            let [aside, from, to] = [small(0.05 * apart), small(0.05), small(0.05)];
            let request =
                Request { family, ..Request::new(state(0.0, 0.0, from, 0.0), state(apart, aside, to, 0.0), limit) };
            let join = checked(&request);
            let ratio = join.measures.length / apart.hypot(aside);
            worst = worst.max(ratio);
        }
        println!("{family:?}: {worst}");
        assert!(worst < 1.001, "{family:?}: {worst}");
    }
}

fn line(x: f64, y: f64, direction: f64) -> End {
    End::Line { point: [x, y], direction }
}

/// From a line to one beside it an S leads: hardly longer than the two arcs of the limit, which have no spirals, or
/// as long as the shortest spirals.
#[test]
fn lines_side_by_side() {
    let mut random = Random(12);
    for family in FAMILIES {
        let mut worst = 0.0f64;
        for _ in 0..40 {
            let apart = 10f64.powf(random.between(-10.0, 0.0));
            let direction = random.between(-3.0, 3.0);
            let side = if random.next() < 0.5 { apart } else { -apart };
            let (x, (sin, cos)) = (random.between(-90.0, 90.0), direction.sin_cos());
            let to = line(x * cos - side * sin, x * sin + side * cos, direction);
            let request = Request { family, ..Request::new(line(0.0, 0.0, direction), to, 1.0) };
            let join = checked(&request);
            let arcs = 2.0 * (1.0 - 0.5 * apart).acos();
            worst = worst.max(join.measures.length / arcs.max(0.2));
        }
        println!("{family:?}: {worst}");
        // Trigonometric spirals are long for what they turn.
        let most = if family == Family::TrigQuintic { 3.5 } else { 1.5 };
        assert!(worst < most, "{family:?}: {worst}");
    }
}

/// Where a length bounds it, a gentle join takes all of that: of spirals of the length l, an S aside by d bends up to
/// d / (2 l²), and a corner by an angle up to angle / l.
#[test]
fn gentle_joins_of_lines_take_the_length_they_may_have() {
    for family in FAMILIES {
        for objective in [Objective::GreatestCurvature, Objective::GreatestRate, Objective::BendingEnergy] {
            for (to, spirals, bend) in
                [(line(0.0, 5.0, 0.0), 4.0, 5.0 / (2.0 * 75f64.powi(2))), (line(70.0, 9.0, 0.03), 2.0, 0.03 / 150.0)]
            {
                let from = line(0.0, 0.0, 0.0);
                let request = Request { family, objective, longest: 300.0, ..Request::new(from, to, 0.01) };
                let join = checked(&request);
                assert!(join.measures.length > 290.0 && join.pieces.len() as f64 == spirals, "{family:?}: {join:?}");
                let off = join.measures.greatest_curvature / bend;
                // Trigonometric spirals bend sharply near their round end.
                let most = if family == Family::TrigQuintic { 3.0 } else { 1.02 };
                assert!(off > 0.98 && off < most, "{family:?}: {off}");
            }
        }
    }
}
