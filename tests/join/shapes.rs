//! Joins of lines and circles.

use super::check::check;
use super::{FAMILIES, Random};
use spiral_atlas::family::trig_quintic::{Scaling, Shape};
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::join::{End, Family, Join, Objective, Request, join};
use spiral_atlas::transition::templates::{self, Segment, Template};
use std::f64::consts::{FRAC_PI_2, PI};

fn line(x: f64, y: f64, direction: f64) -> End {
    End::Line { point: [x, y], direction }
}

fn circle(x: f64, y: f64, radius: f64, turn: Turn) -> End {
    End::Circle { centre: [x, y], radius, turn }
}

fn kinds(join: &Join) -> Vec<&'static str> {
    join.pieces.iter().map(|piece| piece.kind().name()).collect()
}

/// Found and right.
fn found(request: &Request) -> Join {
    match join(request).unwrap() {
        Ok(join) => {
            check(request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
            join
        }
        Err(why) => panic!("{request:?}: {why}"),
    }
}

impl Random {
    pub(crate) fn shape(&mut self, size: f64) -> End {
        let [x, y] = [0, 1].map(|_| self.between(-size, size));
        if self.next() < 0.4 {
            return line(x, y, self.between(-PI, PI));
        }
        let radius = 10f64.powf(self.between(0.0, 1.5));
        circle(x, y, radius, if self.next() < 0.5 { Turn::Left } else { Turn::Right })
    }
}

#[test]
fn random_lines_and_circles_are_joined() {
    let mut random = Random(3);
    for (family, count) in FAMILIES.into_iter().zip([1500, 300, 60, 300, 1500]) {
        let mut joined = 0;
        for i in 0..count {
            let size = [1.0, 10.0, 100.0][i % 3];
            let (from, to) = (random.shape(size), random.shape(size));
            let objective = [Objective::Length, Objective::GreatestRate][i / 3 % 2];
            let request = Request { family, objective, ..Request::new(from, to, 1.0) };
            match join(&request).unwrap() {
                Ok(join) => {
                    joined += 1;
                    check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
                }
                Err(why) => println!("{request:?}: {why}"),
            }
        }
        println!("{family:?}: {joined} of {count}");
        assert!(joined * 1000 >= count * 995, "{family:?}: {joined} of {count}");
    }
}

/// A straight line to a circle that it passes near: one spiral, whichever way.
#[test]
fn j() {
    for family in FAMILIES {
        for gap in [1.001, 1.01, 1.1, 1.5, 2.0, 2.2] {
            for (turn, side) in [(Turn::Left, 1.0), (Turn::Right, -1.0)] {
                let given = [line(3.0, 4.0, 0.0), circle(70.0, 4.0 + side * 20.0 * gap, 20.0, turn)];
                for (from, to) in
                    [(given[0], given[1]), (line(3.0, 4.0, PI), circle(-70.0, 4.0 - side * 20.0 * gap, 20.0, turn))]
                {
                    let request = Request { family, most_pieces: 1, ..Request::new(from, to, 0.05) };
                    assert_eq!(kinds(&found(&request)).len(), 1);
                }
                let back = Request { family, most_pieces: 1, ..Request::new(given[1], line(3.0, 4.0, PI), 0.05) };
                // Back along the line it turns to the other side.
                assert!(join(&back).unwrap().is_err(), "{gap}");
                let other =
                    circle(70.0, 4.0 + side * 20.0 * gap, 20.0, if side > 0.0 { Turn::Right } else { Turn::Left });
                found(&Request { from: other, ..back });
            }
        }
    }
}

/// Two lines: an arc of the limit between spirals, or spirals alone; parallel ones with the radius that fits.
#[test]
fn u() {
    for family in FAMILIES {
        for (degrees, x) in
            [(30.0f64, 0.0), (90.0, 5.0), (-100.0, 5.0), (150.0, 3.0), (179.0, -2.0), (1e-3, 0.0), (-1e-7, 0.0)]
        {
            let (from, to) = (line(0.0, 0.0, 0.5), line(x, 200.0, 0.5 + degrees.to_radians()));
            for objective in
                [Objective::Length, Objective::GreatestRate, Objective::BendingEnergy, Objective::GreatestCurvature]
            {
                found(&Request { family, objective, ..Request::new(from, to, 1.0 / 60.0) });
            }
        }
        let half = found(&Request { family, ..Request::new(line(0.0, 0.0, 0.0), line(7.0, 300.0, PI), 0.1) });
        assert!(half.measures.length > 300.0);
        let one = Request { family, most_pieces: 3, ..Request::new(line(0.0, 0.0, 0.0), line(7.0, 300.0, PI), 0.1) };
        let one = found(&one);
        assert_eq!(one.pieces.len(), 3);
        assert!(one.measures.greatest_curvature < 1.0 / 140.0, "{}", one.measures.greatest_curvature);
        for (from, to) in [
            (line(0.0, 0.0, 0.0), line(5.0, 1e-3, 0.0)),
            (line(0.0, 0.0, 0.0), line(5.0, 3.0, 0.0)),
            (line(0.0, 0.0, 0.0), line(5.0, -300.0, 0.0)),
            (line(0.0, 0.0, 0.0), line(5.0, 0.0, PI)),
            (line(0.0, 0.0, 1.0), line(0.0, 0.0, 1.0 - PI)),
            (line(0.0, 0.0, 0.0), line(5.0, 3.0, PI)),
            (line(0.0, 0.0, 0.0), line(5.0, 300.0, PI)),
        ] {
            found(&Request { family, ..Request::new(from, to, 0.1) });
        }
    }
    let alone =
        found(&Request { most_pieces: 2, ..Request::new(line(0.0, 0.0, 0.0), line(50.0, 0.0, FRAC_PI_2), 1.0 / 60.0) });
    assert_eq!(kinds(&alone), ["cubic", "cubic"]);
}

/// Two circles, apart, touching, one in the other, about one centre.
#[test]
fn circles() {
    use Turn::{Left, Right};
    for family in FAMILIES {
        for (from, to) in [
            (circle(0.0, 0.0, 2.0, Left), circle(9.0, 1.0, 3.0, Left)),
            (circle(0.0, 0.0, 2.0, Left), circle(9.0, 1.0, 3.0, Right)),
            (circle(0.0, 0.0, 2.0, Right), circle(5.0, 0.0, 3.0, Left)),
            (circle(0.0, 0.0, 2.0, Left), circle(5.0, 0.0, 3.0, Left)),
            (circle(0.0, 0.0, 3.0, Left), circle(0.4, 0.3, 2.0, Left)),
            (circle(0.0, 0.0, 3.0, Left), circle(1.0, 0.0, 2.0, Left)),
            (circle(0.0, 0.0, 3.0, Left), circle(0.0, 0.0, 2.0, Left)),
            (circle(0.0, 0.0, 2.0, Left), circle(0.0, 0.0, 3.0, Left)),
            (circle(0.0, 0.0, 3.0, Left), circle(0.0, 0.0, 3.0, Right)),
            (circle(0.0, 0.0, 3.0, Left), circle(1e-9, 0.0, 3.0, Left)),
            (circle(0.0, 0.0, 30.0, Left), circle(1.0, 2.0, 1.0, Left)),
            (circle(0.0, 0.0, 30.0, Left), circle(1.0, 2.0, 1.0, Right)),
            (circle(0.0, 0.0, 1e9, Left), circle(1.0, 2.0, 1.0, Right)),
            (circle(0.0, 0.0, 1.0, Left), circle(1e6, 2.0, 1.0, Left)),
        ] {
            // An involute is found from its ends, which have few digits so far away.
            let far = matches!(from, End::Circle { radius: 1e9, .. }) && family == Family::Involute;
            for objective in [Objective::Length, Objective::GreatestRate].into_iter().filter(|_| !far) {
                found(&Request { family, objective, ..Request::new(from, to, 1.0) });
            }
        }
        // The circle in the circle by one spiral.
        // Parts of trigonometric spirals turn little.
        let apart = if family == Family::TrigQuintic { 0.9997 } else { 0.97 };
        let inside = [circle(0.0, 0.0, 3.0, Left), circle(0.6 * apart, 0.8 * apart, 2.0, Left)];
        let one = Request { family, most_pieces: 1, ..Request::new(inside[0], inside[1], 0.5) };
        found(&one);
        found(&Request { from: inside[1], to: inside[0], ..one });
        // C and S without a line between.
        let pair = |distance: f64, turn| Request {
            family,
            most_pieces: 2,
            ..Request::new(circle(0.0, 0.0, 2.0, Left), circle(distance, 0.0, 3.0, turn), 1.0)
        };
        assert_eq!(found(&pair(6.0, Right)).pieces.len(), 2);
        assert_eq!(found(&pair(4.0, Left)).pieces.len(), 2);
    }
}

/// Concentric, tangent, nested and coincident circles, parallel and coincident lines, or nearly so.
#[test]
fn nearly_degenerate_shapes_of_all_sizes() {
    let mut random = Random(6);
    for (family, count) in FAMILIES.into_iter().zip([1500, 400, 60, 300, 1500]) {
        let mut joined = 0;
        for _ in 0..count {
            let limit = 10f64.powf(random.between(-9.0, 6.0));
            let mut near = |whole: f64| random.near_multiple(whole);
            let mut shape = || {
                let point = [near(1.0), near(1.0)].map(|x| x / limit);
                match near(1.0) {
                    side if side > 0.0 => End::Line { point, direction: near(FRAC_PI_2) },
                    side => {
                        let turn = if side > -0.5 { Turn::Left } else { Turn::Right };
                        End::Circle { centre: point, radius: (1.0 + near(1.0).abs()) / limit, turn }
                    }
                }
            };
            let request = Request { family, ..Request::new(shape(), shape(), limit) };
            match join(&request).unwrap() {
                Ok(join) => {
                    joined += 1;
                    check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
                }
                Err(why) if why.contains("nothing to join") || why.contains("beyond") => joined += 1,
                Err(why) => println!("{request:?}: {why}"),
            }
        }
        println!("{family:?}: {joined} of {count}");
        assert!(joined * 100 >= count * 98, "{family:?}: {joined} of {count}");
    }
}

/// The templates of the paper on trigonometric quintics, from their circles and lines alone.
#[test]
fn templates_are_special_joins() {
    let shape = Shape { ratio: 6.0, theta: 42f64.to_radians(), m: 1.0, p: 0.0, q: 0.0 };
    let [first, second] = [20.0, 15.0].map(|radius| Segment { shape, radius });
    let one = first;
    let all = [
        Template::LineCircle(first),
        Template::LineLine { first, second: one },
        Template::S { first, second },
        Template::C { first, second },
        Template::CircleInCircle {
            inner: Segment { shape: Shape { theta: 52f64.to_radians(), ..shape }, radius: 15.0 },
            outer: 60.0,
        },
    ];
    for template in all {
        let at = ([10.0, 5.0], 0.5, Turn::Left);
        let request =
            templates::Request { template, at: at.0, direction: at.1, turn: at.2, scaling: Scaling::Corrected };
        let made = templates::path(&request).unwrap().expect("spirals");
        let ends = [made.parts[0].ends()[0], made.parts[made.parts.len() - 1].ends()[1]];
        let end = |jet: &spiral_atlas::curve::Jet| {
            let (direction, curvature) = (jet.direction(), jet.curvature());
            if curvature.abs() < 1e-9 {
                return line(jet.point[0], jet.point[1], direction);
            }
            let (x, y) = (jet.point[0] - direction.sin() / curvature, jet.point[1] + direction.cos() / curvature);
            circle(x, y, 1.0 / curvature.abs(), if curvature > 0.0 { Turn::Left } else { Turn::Right })
        };
        let count = made.parts.len();
        // Between two lines the limit is the curvature in the middle.
        let limit = if matches!(template, Template::LineLine { .. }) { 1.0 / 20.0 } else { 1.0 / 14.0 };
        let request = Request::new(end(&ends[0]), end(&ends[1]), limit);
        let request = Request { family: Family::TrigQuintic, most_pieces: count, ..request };
        let join = found(&request);
        assert_eq!(join.pieces.len(), count);
        for (piece, part) in join.pieces.iter().zip(&made.parts) {
            for (a, b) in piece.control_points().unwrap().iter().zip(part.curve.points()) {
                assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-11, "{template:?}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn what_is_no_join() {
    let says = |from: End, to: End, limit: f64, what: &str| match join(&Request::new(from, to, limit)) {
        Ok(Err(why)) => assert!(why.contains(what), "{why}"),
        Ok(Ok(join)) => panic!("{join:?}"),
        Err(e) => assert!(e.to_string().contains(what), "{e}"),
    };
    let ahead = line(0.0, 0.0, 0.0);
    let round = circle(1.0, 2.0, 3.0, Turn::Left);
    says(ahead, line(-7.0, 0.0, 2.0 * PI), 1.0, "the two lines are one");
    says(round, round, 1.0, "the two circles are one");
    let state = |direction| super::state(3.0, 4.0, direction, 0.5).into();
    says(state(1.0), state(1.0 + 2.0 * PI), 1.0, "the two states are one");
    says(ahead, round, 0.25, "the end circle has the radius 3.0");
    says(ahead, circle(f64::NAN, 0.0, 1.0, Turn::Left), 1.0, "end x is NaN");
    says(ahead, circle(0.0, 0.0, -1.0, Turn::Left), 1.0, "the end radius is -1;");
    says(line(0.0, 0.0, f64::INFINITY), round, 1.0, "start direction is inf");
    says(ahead, super::state(0.0, 0.0, 0.0, 0.0).into(), 1.0, "one end is a state");
    says(ahead, circle(1e200, 0.0, 1.0, Turn::Left), 1.0, "least radii apart");
    for (x, radius, limit) in
        [(1e300, 1e-300, 1e300), (1e-300, 1e300, 1.0), (5e-324, 5e-324, 1e308), (1e11, 1e9, 1.0), (0.0, 1e-6, 1e6)]
    {
        for to in [circle(x, 0.0, radius, Turn::Left), line(x, x, 1e-300), line(x, x, 1.0)] {
            // An answer or an error, and no panic.
            let request = Request::new(circle(0.0, x, radius, Turn::Right), to, limit);
            if let Ok(Ok(join)) = join(&request) {
                check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}"));
            }
        }
    }
}
