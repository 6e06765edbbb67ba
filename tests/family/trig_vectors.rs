//! Quintic trigonometric curves against independent numbers: basis, printed curves, general polygons, monotonicity,
//! thresholds, the five templates, and the paper's own parameters.

use serde_json::Value;
use spiral_atlas::curve::TrigBezier;
use spiral_atlas::family::trig_quintic::Scaling;
use spiral_atlas::family::trig_quintic::{SPIRAL, Shape, flags, least_ratio};
use spiral_atlas::transition::templates::{NoSpirals, Part, Request, Segment, Template, path};
use spiral_atlas::transition::{EndCircle, Turn};

fn vectors() -> Value {
    serde_json::from_str(include_str!("../fixtures/trig.json")).unwrap()
}

/// All numbers of a value, in order.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(n) => vec![n.as_f64().unwrap()],
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        _ => vec![],
    }
}

fn rows(vectors: &Value, name: &str) -> Vec<Vec<f64>> {
    let rows: Vec<_> = vectors[name]["rows"].as_array().unwrap().iter().map(numbers).collect();
    assert!(rows.len() > 7, "{name}");
    rows
}

/// The numbers have 13 digits, some of them after a point.
fn close(got: f64, want: f64, size: f64) -> bool {
    (got - want).abs() <= 2e-12 * (want.abs() + size)
}

fn all_close(got: &[f64], want: &[f64], size: f64) -> bool {
    got.len() == want.len() && got.iter().zip(want).all(|(g, w)| close(*g, *w, size))
}

#[test]
fn basis_functions_are_the_printed_ones() {
    for row in rows(&vectors(), "basis") {
        let basis = TrigBezier::basis(row[1], row[2], row[0]);
        assert!(all_close(&basis, &row[3..], 1e-3), "{row:?}: {basis:?}");
        assert!((basis.iter().sum::<f64>() - 1.0).abs() < 1e-14 && basis.iter().all(|g| *g >= 0.0));
        let shifted = TrigBezier::basis(row[1], row[2], row[0] + 1e-9);
        assert!(!all_close(&shifted, &row[3..], 1e-3));
    }
}

fn shape(ratio: f64, theta: f64, m: f64, p: f64, q: f64) -> Shape {
    Shape { ratio, theta, m, p, q }
}

#[test]
fn printed_curves_have_the_known_points_and_curvatures() {
    for row in rows(&vectors(), "paper_curve") {
        let [theta, s, r, m, p, q, t] = row[..7].try_into().unwrap();
        let curve = shape(s / (0.5f64 * theta).tan(), theta, m, p, q).curve(r, Scaling::AsPrinted);
        let (at, end) = (curve.jet(t), curve.jet(1.0));
        let [x, y, dx, dy, k, dk, k1, dk1, x1, y1, length] = row[7..].try_into().unwrap();
        let size = curve.length_between(0.0, 1.0);
        assert!(
            all_close(&[at.point[0], at.point[1], at.first[0], at.first[1]], &[x, y, dx, dy], 1e-4 * size),
            "{row:?} {at:?}"
        );
        let got = [at.curvature(), at.curvature_dt(), end.curvature(), end.curvature_dt()];
        assert!(all_close(&got, &[k, dk, k1, dk1], 1e-2 * k1), "{row:?} {got:?}");
        assert!(all_close(&[end.point[0], end.point[1], size], &[x1, y1, length], 0.0), "{row:?}");
        // What (9) leaves: 15/((4 + q)² r) and not 1/r.
        assert!(close(end.curvature(), 15.0 / ((4.0 + q) * (4.0 + q) * r), 0.0));
        assert_eq!(curve.jet(0.0).curvature(), 0.0);
        assert_eq!((curve.jet(0.0).point, end.point), (curve.points()[0], curve.points()[5]));
    }
}

#[test]
fn general_polygons_have_the_known_derivatives() {
    for row in rows(&vectors(), "general") {
        let points: [[f64; 2]; 6] = std::array::from_fn(|i| [row[2 * i], row[2 * i + 1]]);
        let [p, q, t] = row[12..15].try_into().unwrap();
        let curve = TrigBezier::new(points, p, q).unwrap();
        let [at, start, end] = [t, 0.0, 1.0].map(|t| curve.jet(t));
        let got = [at.point, start.first, end.first].concat();
        assert!(all_close(&got, &row[15..21], 1e-2), "{row:?} {got:?}");
        let got = [start, end, at].map(|jet| jet.curvature());
        assert!(all_close(&got, &row[21..], 1e-2), "{row:?} {got:?}");
        // The same curve backwards.
        let back = curve.reversed().jet(1.0 - t);
        assert!(all_close(&back.point, &at.point, 1e-2) && close(-back.curvature(), at.curvature(), 1e-2));
    }
    assert!(TrigBezier::new([[0.0; 2]; 6], 1.5, 0.0).unwrap_err().to_string().contains("p is 1.5"));
    assert!(TrigBezier::new([[f64::NAN; 2]; 6], 1.0, 0.0).unwrap_err().to_string().contains("NaN"));
}

#[test]
fn monotone_curvature_and_thresholds_are_the_known_ones() {
    let vectors = vectors();
    let mut with = 0;
    for row in rows(&vectors, "monotone") {
        let spiral = flags(&shape(row[1], row[0], row[2], row[3], row[4])).unwrap() & SPIRAL != 0;
        assert_eq!(spiral, row[5] == 1.0, "{row:?}");
        with += usize::from(spiral);
    }
    assert!((5..20).contains(&with));
    for row in rows(&vectors, "threshold") {
        let least = least_ratio(&shape(1.0, row[0].to_radians(), row[1], row[2], row[3])).unwrap().unwrap();
        // 8 digits, and half a step of singles.
        assert!((f64::from(least) - row[4]).abs() < 1e-7 + f64::from(f32::EPSILON) * row[4], "{row:?} {least}");
    }
}

/// The paper's figures, with its parameters, are no spirals, and say so.
#[test]
fn printed_figures_are_reproduced_and_are_no_spirals() {
    let vectors = vectors();
    let figures = vectors["printed_figures"].as_array().unwrap();
    assert_eq!(figures.len(), 3);
    for figure in figures {
        let n = |key: &str| figure[key].as_f64().unwrap();
        let shape = shape(n("s_over_tan"), n("theta_deg").to_radians(), n("m"), n("p"), n("q"));
        let segment = Segment { shape, radius: n("r") };
        let request = Request {
            template: Template::LineCircle(segment),
            at: [0.0, 0.0],
            direction: 0.0,
            turn: Turn::Left,
            scaling: Scaling::AsPrinted,
        };
        let Err(NoSpirals { path: found, why }) = path(&request).unwrap() else { panic!("a spiral: {figure}") };
        assert!(why.starts_with("as printed: not a spiral"), "{why}");
        let curve = found.parts[0].curve;
        let end = curve.jet(1.0);
        assert!(close(end.curvature(), n("kappa1"), 0.0) && close(end.curvature_dt(), n("dkappa1"), 0.1), "{figure}");
        for pair in figure["kappa_t"].as_array().unwrap() {
            let pair = numbers(pair);
            assert!(close(curve.jet(pair[0]).curvature(), pair[1], 0.0), "{figure}");
        }
        let most = (0..=400).map(|i| curve.jet(f64::from(i) / 400.0).curvature()).fold(0.0, f64::max);
        assert!(close(most, n("max_on_grid400"), 0.0));
        // A ratio that gives spirals does not mend the end curvature.
        let shape = Shape { ratio: 6.0, ..shape };
        let request = Request { template: Template::LineCircle(Segment { shape, ..segment }), ..request };
        let Err(NoSpirals { why, .. }) = path(&request).unwrap() else { panic!("as asked") };
        assert!(why.contains("end curvature"), "{why}");
        assert!(path(&Request { scaling: Scaling::Corrected, ..request }).unwrap().is_ok());
    }
}

fn segment(value: &Value, which: usize) -> Segment {
    let n = |key: &str| {
        let value = value.get(key).unwrap_or(&Value::Null);
        value.as_f64().or_else(|| value.get(which).and_then(Value::as_f64))
    };
    let get = |key: &str| n(key).unwrap_or_else(|| panic!("{key}"));
    let radius = n("r").unwrap_or_else(|| get("r1"));
    Segment { shape: shape(get("s_over_tan"), get("theta_deg").to_radians(), get("m"), get("p"), get("q")), radius }
}

fn at_origin(template: Template) -> Request {
    Request { template, at: [0.0, 0.0], direction: 0.0, turn: Turn::Left, scaling: Scaling::Corrected }
}

/// Whether every part is what it claims, told by the curves alone: it joins the next, it meets its circles, and its
/// curvature is monotone.
fn check(request: &Request) -> Vec<Part> {
    let outcome = path(request).unwrap();
    let Ok(path) = outcome else { panic!("{request:?}: {outcome:?}") };
    let size: f64 = path.parts.iter().map(|part| part.curve.length_between(part.from, part.to)).sum();
    let mut places = vec![path.parts[0].ends()[0], path.parts[path.parts.len() - 1].ends()[1]];
    for pair in path.parts.windows(2) {
        let (one, two) = (pair[0].ends()[1], pair[1].ends()[0]);
        let gap = (one.point[0] - two.point[0]).hypot(one.point[1] - two.point[1]);
        assert!(gap <= 1e-13 * size, "{request:?}: a gap of {gap}");
        let turned = (one.direction() - two.direction()).sin();
        assert!(turned.abs() < 1e-13 && (one.curvature() - two.curvature()).abs() * size < 1e-11, "{one:?} {two:?}");
        places.push(two);
    }
    assert_eq!(path.circles.len(), places.len());
    for (circle, jet) in path.circles.iter().zip(places) {
        match circle {
            EndCircle::Circle { centre, radius } => {
                let arm = [centre[0] - jet.point[0], centre[1] - jet.point[1]];
                let curvature = jet.curvature();
                assert!((curvature.abs() * radius - 1.0).abs() < 1e-12, "{request:?}: {curvature} {radius}");
                let left = [-jet.first[1] / jet.speed(), jet.first[0] / jet.speed()];
                assert!((arm[0] * left[0] + arm[1] * left[1] - 1.0 / curvature).abs() < 1e-12 * (radius + size));
            }
            EndCircle::Line { .. } => assert!(jet.curvature().abs() * size < 1e-12),
        }
    }
    for part in &path.parts {
        let signs: Vec<f64> = (1..400)
            .map(|i| part.curve.jet(part.from + (part.to - part.from) * f64::from(i) / 400.0).curvature_dt())
            .collect();
        assert!(part.spiral && (signs.iter().all(|s| *s > 0.0) || signs.iter().all(|s| *s < 0.0)), "{request:?}");
    }
    path.parts
}

#[test]
fn the_five_templates_have_the_known_places() {
    let vectors = vectors();
    let templates = &vectors["templates"];
    let point = |value: &Value| -> [f64; 2] { numbers(value).try_into().unwrap() };
    let near = |got: [f64; 2], want: [f64; 2]| all_close(&got, &want, 10.0);

    let one = segment(&templates["line_line"], 0);
    let parts = check(&at_origin(Template::LineLine { first: one, second: one }));
    let known = &templates["line_line"];
    assert!(
        near(parts[1].ends()[0].point, point(&known["join"])) && near(parts[1].ends()[1].point, point(&known["end"]))
    );

    // Not both of these are spirals, but the curves are known.
    let known = &templates["line_line_pq"];
    let one = segment(known, 0);
    let none = path(&at_origin(Template::LineLine { first: one, second: one })).unwrap().unwrap_err();
    let parts = &none.path.parts;
    assert!(
        near(parts[1].ends()[0].point, point(&known["join"])) && near(parts[1].ends()[1].point, point(&known["end"]))
    );
    assert!(near(parts[1].curve.jet(0.3).point, point(&known["mid2"])));
    assert_eq!((parts[1].curve.p, parts[1].curve.q), (-0.5, 0.5));

    // Run backwards, the first spiral ends at the joint; the vectors have it on the right.
    for (name, other) in [("s_shape", -1.0), ("c_shape", 1.0)] {
        let known = &templates[name];
        let [first, second] = [0, 1].map(|which| segment(known, which));
        let template = if other < 0.0 {
            Template::S { first: second, second: first }
        } else {
            Template::C { first: second, second: first }
        };
        let turn = if other < 0.0 { Turn::Right } else { Turn::Left };
        let parts = check(&Request { turn, ..at_origin(template) });
        let ends = known["ends"].as_array().unwrap();
        assert!(near(parts[1].ends()[1].point, point(&ends[0])), "{name} {parts:?}");
        assert!(near(parts[0].ends()[0].point, point(&ends[1])), "{name} {parts:?}");
    }

    let known = &templates["circle_in_circle"];
    let n = |key: &str| known[key].as_f64().unwrap();
    let inner = segment(known, 0);
    let parts = check(&at_origin(Template::CircleInCircle { inner, outer: n("r0") }));
    assert!((parts[0].from - n("t0")).abs() < 1e-12, "{}", parts[0].from);
    assert!(near(inner.shape.curve(1.0, Scaling::Corrected).jet(parts[0].from).point, point(&known["start"])));
    let first = parts[0].ends()[0];
    assert!(near(first.point, [0.0, 0.0]) && first.direction().abs() < 1e-13);
}

#[test]
fn paths_lie_anywhere_and_bad_requests_are_named() {
    let one = Segment { shape: shape(6.0, 0.7, 1.0, 0.0, 0.0), radius: 300.0 };
    let two = Segment { shape: shape(7.0, 1.1, 2.0, 0.5, -0.5), radius: 170.0 };
    let templates = [
        Template::LineCircle(two),
        Template::LineLine { first: one, second: Segment { radius: 300.0, ..two } },
        Template::S { first: one, second: two },
        Template::C { first: one, second: two },
        Template::CircleInCircle { inner: two, outer: 900.0 },
    ];
    for template in templates {
        for turn in [Turn::Left, Turn::Right] {
            let request = Request { template, at: [5e5, -4e5], direction: 2.5, turn, scaling: Scaling::Corrected };
            let parts = check(&Request { at: [0.0, 0.0], ..request });
            let moved = path(&request).unwrap().unwrap();
            // Moved to the joint for S and C, to the start otherwise; the sides do not change.
            assert!(moved.parts.iter().zip(&parts).all(|(a, b)| a.curve.sides == b.curve.sides));
            let joint = if matches!(template, Template::S { .. } | Template::C { .. }) { 1 } else { 0 };
            let at = moved.parts[joint].ends()[0];
            assert!((at.point[0] - 5e5).hypot(at.point[1] + 4e5) < 1e-8);
            assert!((at.direction() - 2.5).abs() < 1e-12);
            let first = moved.parts[0].curve.jet(0.7).curvature();
            assert_eq!(first > 0.0, turn == Turn::Left);
            let samples = moved.samples(50).unwrap();
            assert!(samples.iter().all(|part| part.len() == 50));
        }
    }
    let error = |template| path(&at_origin(template)).unwrap_err().to_string();
    assert!(error(Template::LineLine { first: one, second: two }).contains("300.0 and 170.0"));
    assert!(error(Template::CircleInCircle { inner: one, outer: 200.0 }).contains("outer radius is 200.0"));
    assert!(error(Template::LineCircle(Segment { radius: 0.0, ..one })).contains("radius is 0;"));
    let bad = Segment { shape: Shape { q: -4.0, ..one.shape }, ..one };
    assert!(error(Template::LineCircle(bad)).contains("q is -4"));
}
