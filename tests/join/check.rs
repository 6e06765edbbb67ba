//! Checks a join from what its JSON says: G² at every joint, both ends met, monotone curvature, the limit kept.

use serde_json::Value;
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::join::{End, Join, Request, State};

/// Relative to the extent of coordinates in least radii.
const TOLERANCE: f64 = 1e-12;

#[derive(Debug)]
pub(crate) struct Checked {
    /// The sum of lengths, each found anew.
    pub length: f64,
}

type Vector = [f64; 2];

/// Where a piece starts or ends.
#[derive(Debug, Clone, Copy)]
struct Place {
    point: Vector,
    direction: f64,
    curvature: f64,
}

struct Seen {
    ends: [Place; 2],
    curvatures: Vec<f64>,
    length: f64,
}

pub(crate) fn check(request: &Request, join: &Join) -> Result<Checked, String> {
    check_told(request, &serde_json::to_value(join).unwrap())
}

/// The same of a path as JSON: `pieces`, `length`, `greatest_curvature`.
pub(crate) fn check_told(request: &Request, told: &Value) -> Result<Checked, String> {
    let limit = request.greatest_curvature;
    let pieces: Vec<Seen> = told["pieces"].as_array().unwrap().iter().map(seen).collect();
    let far = |p: Vector| p.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let size = pieces.iter().flat_map(|p| p.ends).map(|p| far(p.point) * limit).fold(1.0, f64::max);
    let same = |a: &Place, b: &Place| {
        let apart = (a.point[0] - b.point[0]).hypot(a.point[1] - b.point[1]) * limit;
        let turned = (a.direction - b.direction).sin().hypot(1.0 - (a.direction - b.direction).cos());
        let bent = (a.curvature - b.curvature).abs() / limit;
        if apart.max(turned).max(bent) <= TOLERANCE * size {
            Ok(())
        } else {
            Err(format!("{apart:e} {turned:e} {bent:e}"))
        }
    };
    let given = |end: &End, at: &Place| match *end {
        End::State(State { point, direction, curvature }) => Place { point, direction, curvature },
        End::Line { point, direction } => {
            let (sin, cos) = direction.sin_cos();
            let along = (at.point[0] - point[0]) * cos + (at.point[1] - point[1]) * sin;
            Place { point: [point[0] + along * cos, point[1] + along * sin], direction, curvature: 0.0 }
        }
        End::Circle { centre, radius, turn } => {
            let side = if turn == Turn::Left { 1.0 } else { -1.0 };
            let [x, y] = [0, 1].map(|i| at.point[i] - centre[i]);
            let point = [x, y].map(|x0| x0 * (radius / x.hypot(y)));
            let direction = (side * x).atan2(-side * y);
            Place { point: [0, 1].map(|i| centre[i] + point[i]), direction, curvature: side / radius }
        }
    };
    let (first, last) = (pieces.first().ok_or("no pieces")?, pieces.last().ok_or("no pieces")?);
    same(&given(&request.from, &first.ends[0]), &first.ends[0]).map_err(|e| format!("start: {e}"))?;
    same(&given(&request.to, &last.ends[1]), &last.ends[1]).map_err(|e| format!("end: {e}"))?;
    for (i, pair) in pieces.windows(2).enumerate() {
        same(&pair[0].ends[1], &pair[1].ends[0]).map_err(|e| format!("joint {i}: {e}"))?;
    }
    let mut length = 0.0;
    for (i, (piece, told)) in pieces.iter().zip(told["pieces"].as_array().unwrap()).enumerate() {
        let slack = 1e-11 * limit * size;
        let all = &piece.curvatures;
        let up = all.windows(2).all(|w| w[1] >= w[0] - slack);
        let down = all.windows(2).all(|w| w[1] <= w[0] + slack);
        if !(up || down) {
            return Err(format!("piece {i} is not monotone"));
        }
        if all.iter().any(|k| k.abs() > limit + slack) {
            return Err(format!("piece {i} is beyond the limit"));
        }
        let said = told["length"].as_f64().unwrap();
        if (said - piece.length).abs() > 1e-9 * said + TOLERANCE * size / limit {
            return Err(format!("piece {i} is {} long, not {said}", piece.length));
        }
        length += said;
    }
    if (length - told["length"].as_f64().unwrap()).abs() > 1e-12 * length {
        return Err(format!("the length is {length}"));
    }
    let most = pieces.iter().flat_map(|p| p.ends).fold(0.0f64, |m, p| m.max(p.curvature.abs()));
    if (most - told["greatest_curvature"].as_f64().unwrap()).abs() > TOLERANCE * size * limit {
        return Err(format!("the greatest curvature is {most}"));
    }
    if told["greatest_curvature"].as_f64().unwrap() > limit {
        return Err("the limit is not kept".into());
    }
    Ok(Checked { length })
}

fn vector(value: &Value) -> Vector {
    [value[0].as_f64().unwrap(), value[1].as_f64().unwrap()]
}

fn seen(piece: &Value) -> Seen {
    let number = |name: &str| piece[name].as_f64().unwrap_or_else(|| panic!("{name} of {piece}"));
    match piece["kind"].as_str().unwrap() {
        "line" | "arc" => {
            let (point, direction, curvature, length) =
                (vector(&piece["start"]), number("direction"), number("curvature"), number("length"));
            let half = 0.5 * length * curvature;
            let chord = if half == 0.0 { length } else { length * half.sin() / half };
            let (sin, cos) = (direction + half).sin_cos();
            let start = Place { point, direction, curvature };
            let end = [point[0] + chord * cos, point[1] + chord * sin];
            let end = Place { point: end, direction: direction + 2.0 * half, curvature };
            Seen { ends: [start, end], curvatures: vec![curvature], length }
        }
        "clothoid" => {
            let (point, direction, [from, to], length) = (
                vector(&piece["start"]),
                number("direction"),
                ["curvature", "end_curvature"].map(number),
                number("length"),
            );
            let across = by_powers(length, direction, [from * length, 0.5 * (to - from) * length]);
            let end = [0, 1].map(|i| point[i] + across[i]);
            let turned = direction + 0.5 * (from + to) * length;
            let end = Place { point: end, direction: turned, curvature: to };
            Seen { ends: [Place { point, direction, curvature: from }, end], curvatures: vec![from, to], length }
        }
        "involute" => involute(piece),
        "trig-quintic" => {
            let points: Vec<Vector> = piece["control_points"].as_array().unwrap().iter().map(vector).collect();
            sampled([number("from"), number("to")], |t| trigonometric(&points, number("p"), number("q"), t))
        }
        _ => bezier(&piece["control_points"].as_array().unwrap().iter().map(vector).collect::<Vec<_>>()),
    }
}

/// From the start to the end of a curve of a length whose direction is `direction + a t + b t²`: with
/// `exp(i (a t + b t²)) = Σ c_n t^n`, `(n + 1) c_(n+1) = i (a c_n + 2 b c_(n-1))`.
fn by_powers(length: f64, direction: f64, [a, b]: [f64; 2]) -> Vector {
    let (mut before, mut c, mut sum): (Vector, Vector, Vector) = ([0.0, 0.0], [1.0, 0.0], [0.0, 0.0]);
    // Directions change by up to 10 radians.
    for n in 0..200 {
        let n = f64::from(n + 1);
        sum = [0, 1].map(|i| sum[i] + c[i] / n);
        let next = [-(a * c[1] + 2.0 * b * before[1]) / n, (a * c[0] + 2.0 * b * before[0]) / n];
        (before, c) = (c, next);
    }
    let (sin, cos) = direction.sin_cos();
    [length * (cos * sum[0] - sin * sum[1]), length * (sin * sum[0] + cos * sum[1])]
}

/// The library's own evaluation, as an involute has no control points; its ends are what it was made from.
fn involute(piece: &Value) -> Seen {
    let number = |name: &str| piece[name].as_f64().unwrap();
    let end = |which: &str| Place {
        point: vector(&piece[which]),
        direction: number(&format!("{which}_direction")),
        curvature: number(&format!("{which}_curvature")),
    };
    let made: spiral_atlas::transition::Piece = serde_json::from_value(piece.clone()).unwrap();
    let curvatures = (0..=40).map(|i| made.at(f64::from(i) / 40.0).curvature).collect();
    Seen { ends: [end("start"), end("end")], curvatures, length: made.length() }
}

/// Straight from the control points.
fn bezier(p: &[Vector]) -> Seen {
    let jet = |t: f64| {
        let mut rows = vec![p.to_vec()];
        while rows[rows.len() - 1].len() > 1 {
            let last = &rows[rows.len() - 1];
            rows.push(last.windows(2).map(|w| [0, 1].map(|i| w[0][i] * (1.0 - t) + w[1][i] * t)).collect());
        }
        let n = (p.len() - 1) as f64;
        let (a, b) = (&rows[rows.len() - 2], &rows[rows.len() - 3]);
        let d = [0, 1].map(|i| n * (a[1][i] - a[0][i]));
        let e = [0, 1].map(|i| n * (n - 1.0) * (b[2][i] - 2.0 * b[1][i] + b[0][i]));
        let speed = d[0].hypot(d[1]);
        (rows[rows.len() - 1][0], d[1].atan2(d[0]), (d[0] * e[1] - d[1] * e[0]) / speed.powi(3), speed)
    };
    sampled([0.0, 1.0], jet)
}

/// Value and two derivatives.
type Rates = [f64; 3];

fn times(a: Rates, b: Rates) -> Rates {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

fn linear(factor: f64, a: Rates, constant: f64) -> Rates {
    [factor * a[0] + constant, factor * a[1], factor * a[2]]
}

/// Basis (2) of Misro, Ramli and Ali, by the angle φ = πt/2.
fn trigonometric(points: &[Vector], p: f64, q: f64, t: f64) -> (Vector, f64, f64, f64) {
    let angle = std::f64::consts::FRAC_PI_2 * t;
    let (sin, cos) = angle.sin_cos();
    let half = [0.5 * angle, 0.5 * std::f64::consts::FRAC_PI_2 * (1.0 - t)].map(f64::sin);
    let (s, c) = ([sin, cos, -sin], [cos, -sin, -cos]);
    // 1 - C and 1 - S.
    let (v, w) = ([2.0 * half[0] * half[0], sin, cos], [2.0 * half[1] * half[1], -cos, sin]);
    let power = |a: Rates, n: i32| (0..n).fold([1.0, 0.0, 0.0], |product, _| times(product, a));
    let sum = |a: Rates, b: Rates, constant: f64| [a[0] + b[0] + constant, a[1] + b[1], a[2] + b[2]];
    let basis = [
        times(power(w, 4), linear(-p, s, 1.0)),
        times(times(s, power(w, 3)), linear(p, w, 4.0)),
        times(times(power(w, 2), v), sum(linear(8.0, s, 0.0), linear(3.0, c, 0.0), 9.0)),
        times(times(power(v, 2), w), sum(linear(8.0, c, 0.0), linear(3.0, s, 0.0), 9.0)),
        times(times(c, power(v, 3)), linear(q, v, 4.0)),
        times(power(v, 4), linear(-q, c, 1.0)),
    ];
    // From the nearer end, so that nothing is lost there.
    let origin = if t < 0.5 { points[0] } else { points[5] };
    let of = |order: usize| [0, 1].map(|i| (0..6).map(|n| basis[n][order] * (points[n][i] - origin[i])).sum::<f64>());
    let ([x, y], d, e) = (of(0), of(1), of(2));
    let speed = d[0].hypot(d[1]);
    let curvature = (d[0] * e[1] - d[1] * e[0]) / speed.powi(3);
    ([origin[0] + x, origin[1] + y], d[1].atan2(d[0]), curvature, speed * std::f64::consts::FRAC_PI_2)
}

/// Ends, curvatures and length of a part of a curve given by point, direction, curvature and speed.
fn sampled([from, to]: [f64; 2], jet: impl Fn(f64) -> (Vector, f64, f64, f64)) -> Seen {
    let place = |t: f64| {
        let (point, direction, curvature, _) = jet(t);
        Place { point, direction, curvature }
    };
    let steps = 400;
    let at = |i: usize| jet(from + (to - from) * (i as f64 / steps as f64));
    // Simpson's rule.
    let weight = |i: usize| if i == 0 || i == steps { 1.0 } else { [2.0, 4.0][i % 2] };
    let length = (0..=steps).map(|i| weight(i) * at(i).3).sum::<f64>() * (to - from) / (3 * steps) as f64;
    Seen { ends: [place(from), place(to)], curvatures: (0..=steps).map(|i| at(i).2).collect(), length }
}
