//! A crude evaluation of the cubic family, only to have real-looking regions and curves to draw.

use spiral_atlas::plot::{AxisView, CurveFigure, EndCircle, Graph, Region, Slice};

fn h(x: f64, y: f64, p0: f64, p1: f64) -> [f64; 6] {
    let low = |x: f64, y: f64, p0: f64, p1: f64| {
        let (s0, c1, c0, s1) = (p0.sin(), p1.cos(), p0.cos(), p1.sin());
        let d1 = 2.0 * s0 / (p0 + p1).sin();
        let (x3, e) = (x - 3.0, d1 * s0 / 2.0);
        [
            y * y * d1 * ((9.0 - x * x - 10.0 * y + 3.0 * x * y) * s0 + x3 * x3 * (p0 + 2.0 * p1).sin()),
            2.0 * y
                * (2.0 * s0 * c1 * x3 * (2.0 * x * x + 17.0 * y - 7.0 * x * y - 18.0)
                    - e * (x3 * (4.0 * x * x - 14.0 * x * y) + y * y * (9.0 * x - 22.0))
                    - 4.0 * c0 * s1 * x3 * x3 * x3),
            4.0 * y
                * (s0 * c1 * (6.0 * (2.0 * y - 3.0) + x * (15.0 - 32.0 * y) + x * x * (12.0 - 5.0 * x + 10.0 * y))
                    + e * (5.0 * x * x * x - 2.0 * y * y - 2.0 * x * x * (6.0 + 5.0 * y) + x * y * (12.0 + 5.0 * y))
                    + c0 * s1 * x3 * x3 * (5.0 * x - 2.0)),
        ]
    };
    let ([a, b, c], [f, e, d]) = (low(x, y, p0, p1), low(y, x, p1, p0));
    [a, b, c, -d, -e, -f]
}

/// `[any spiral, exact, Theorem 3.1 for any root, Theorem 3.1, solvable]`
fn flags(p0: f64, p1: f64, k0: f64, k1: f64) -> [bool; 5] {
    let s = (p0 + p1).sin();
    let a = k0 * (2.0 * p1.sin() / s).powi(2) / (4.0 * p0.sin());
    let k = k1 * (2.0 * p0.sin() / s).powi(2) / (4.0 * p1.sin());
    let f = |x: f64| 3.0 - x - k * (3.0 - a * x * x).powi(2);
    let mut roots = Vec::new();
    for i in 0..300 {
        let (mut lo, mut hi) = (f64::from(i) * 0.01, f64::from(i + 1) * 0.01);
        if f(lo) * f(hi) < 0.0 {
            for _ in 0..30 {
                let mid = (lo + hi) / 2.0;
                if f(lo) * f(mid) < 0.0 { hi = mid } else { lo = mid }
            }
            let y = 3.0 - a * lo * lo;
            if y > 0.0 && y < 3.0 {
                roots.push((lo, y));
            }
        }
    }
    let theorem = |&(x, y): &(f64, f64)| {
        let [a, b, c, d, e, f] = h(x, y, p0, p1);
        [a, c, d, f].iter().all(|v| *v >= 0.0) && b + 2.0 * (a * c).sqrt() >= 0.0 && e + 2.0 * (d * f).sqrt() >= 0.0
    };
    let spiral = |&(x, y): &(f64, f64)| {
        let h = h(x, y, p0, p1);
        (0..=60).all(|i| {
            let t = f64::from(i) / 60.0;
            (0..6).map(|j| h[j as usize] * (1.0 - t).powi(j) * t.powi(5 - j)).sum::<f64>() >= 0.0
        })
    };
    let room = p0.sin() - k0;
    let any = p0 < p1 && room > 0.0 && k1 > p1.sin() + (0.5 * (p1 - p0)).sin().powi(2) / room;
    let solvable = k > 1.0 / 3.0 && !roots.is_empty();
    let theorem31 = solvable && roots.first().is_some_and(theorem);
    [any, roots.iter().any(spiral), roots.iter().any(theorem), theorem31, solvable]
}

const LABELS: [&str; 5] =
    ["any spiral at all", "exact cubic spiral", "Theorem 3.1, any root", "Theorem 3.1", "solvable (A.9)"];

pub(crate) fn cubic_slice(p0: f64, p1: f64, x: AxisView, y: AxisView) -> Slice {
    let nodes = y.values.iter().flat_map(|k1| x.values.iter().map(|k0| flags(p0, p1, *k0, *k1)));
    let nodes: Vec<[bool; 5]> = nodes.collect();
    let region = |i: usize| Region::of_nodes(LABELS[i], nodes.iter().map(|f| f[i]).collect());
    Slice {
        title: format!("Cubic spirals for φ₀ = {p0}, φ₁ = {p1}"),
        regions: (0..4).map(region).collect(),
        outlines: vec![region(4)],
        marks: Vec::new(),
        note: "Which end curvatures can be joined with monotone curvature; ends at (−1, 0) and (1, 0).".into(),
        counted: "node",
        x,
        y,
    }
}

pub(crate) fn spaced(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| lo + (hi - lo) * i as f64 / (count - 1) as f64).collect()
}

pub(crate) fn curve_figure(p0: f64, p1: f64, k: (f64, f64), f: (f64, f64)) -> CurveFigure {
    let s = (p0 + p1).sin();
    let (l0, l1) = (2.0 * p1.sin() / s * f.0 / 3.0, 2.0 * p0.sin() / s * f.1 / 3.0);
    let control =
        vec![[-1.0, 0.0], [-1.0 + l0 * p0.cos(), -l0 * p0.sin()], [1.0 - l1 * p1.cos(), -l1 * p1.sin()], [1.0, 0.0]];
    let blend = |w: [f64; 4]| [0, 1].map(|c| (0..4).map(|i| w[i] * control[i][c]).sum::<f64>());
    let at = |t: f64| {
        let u = 1.0 - t;
        let p = blend([u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t]);
        let d = blend([-3.0 * u * u, 3.0 * u * u - 6.0 * u * t, 6.0 * u * t - 3.0 * t * t, 3.0 * t * t]);
        let e = blend([6.0 * u, 6.0 * t - 12.0 * u, 6.0 * u - 12.0 * t, 6.0 * t]);
        (p, (d[0] * e[1] - d[1] * e[0]) / d[0].hypot(d[1]).powi(3))
    };
    let t = spaced(0.0, 1.0, 401);
    let derivative = |t: f64| {
        let d = 1e-4;
        let (lo, hi) = ((t - d).max(0.0), (t + d).min(1.0));
        [t, (at(hi).1 - at(lo).1) / (hi - lo)]
    };
    CurveFigure {
        title: format!("Spiral for φ₀ = {p0}, φ₁ = {p1}, κ₀ = {}, κ₁ = {}", k.0, k.1),
        note: format!("f₀ = {}, f₁ = {}", f.0, f.1),
        curve: t.iter().map(|t| at(*t).0).collect(),
        circles: vec![
            EndCircle {
                at: [-1.0, 0.0],
                direction: [p0.cos(), -p0.sin()],
                curvature: k.0,
                label: format!("start circle, radius {:.3}", 1.0 / k.0),
            },
            EndCircle {
                at: [1.0, 0.0],
                direction: [p1.cos(), p1.sin()],
                curvature: k.1,
                label: format!("end circle, radius {:.3}", 1.0 / k.1),
            },
        ],
        parameter: "parameter t".into(),
        curvature: Graph { label: "curvature κ".into(), points: t.iter().map(|t| [*t, at(*t).1]).collect() },
        joints: Vec::new(),
        derivative: Graph { label: "dκ/dt".into(), points: t.iter().map(|t| derivative(*t)).collect() },
        control,
    }
}
