//! An auditor of planned paths that shares nothing with the library: interval arithmetic on the power basis of
//! `start + ∫ w²`.

use super::*;
use spiral_atlas::path::{Plan, Scene};

/// All numbers from the first to the second.
#[derive(Clone, Copy)]
pub(crate) struct Range(f64, f64);

impl Range {
    fn point(x: f64) -> Range {
        Range(x, x)
    }
    fn wide(lo: f64, hi: f64) -> Range {
        Range(lo.next_down(), hi.next_up())
    }
    fn plus(self, b: Range) -> Range {
        Range::wide(self.0 + b.0, self.1 + b.1)
    }
    fn minus(self, b: Range) -> Range {
        Range::wide(self.0 - b.1, self.1 - b.0)
    }
    fn times(self, b: Range) -> Range {
        let all = [self.0 * b.0, self.0 * b.1, self.1 * b.0, self.1 * b.1];
        Range::wide(all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }
    fn by(self, x: f64) -> Range {
        self.times(Range::point(x))
    }
    fn over(self, x: f64) -> Range {
        Range::wide(self.0 / x, self.1 / x)
    }
    fn size(self) -> f64 {
        self.0.abs().max(self.1.abs())
    }
}

/// A complex number.
type Pair = [Range; 2];

fn add(a: Pair, b: Pair) -> Pair {
    [a[0].plus(b[0]), a[1].plus(b[1])]
}

fn mul(a: Pair, b: Pair) -> Pair {
    [a[0].times(b[0]).minus(a[1].times(b[1])), a[0].times(b[1]).plus(a[1].times(b[0]))]
}

fn scaled(a: Pair, x: f64) -> Pair {
    a.map(|r| r.by(x))
}

/// Coefficients of powers of `t - from`: of w, and of the point.
struct Powers {
    w: [Pair; 3],
    r: [Pair; 6],
}

impl Powers {
    fn new(curve: &PhQuintic) -> Powers {
        let [a, b, c] = curve.preimage.map(|z| z.map(Range::point));
        let w = [a, scaled(add(b, scaled(a, -1.0)), 2.0), add(add(a, c), scaled(b, -2.0))];
        Powers { w, r: integral(curve.start.map(Range::point), w) }
    }

    /// The same, from another parameter on.
    fn from(&self, t: f64) -> Powers {
        let [a, b, c] = self.w;
        let w = [add(add(a, scaled(b, t)), scaled(scaled(c, t), t)), add(b, scaled(c, 2.0 * t)), c];
        Powers { w, r: integral(at(&self.r, Range::point(t)), w) }
    }
}

/// Of `start + ∫ w²`.
fn integral(start: Pair, [a, b, c]: [Pair; 3]) -> [Pair; 6] {
    let squares =
        [mul(a, a), scaled(mul(a, b), 2.0), add(mul(b, b), scaled(mul(a, c), 2.0)), scaled(mul(b, c), 2.0), mul(c, c)];
    std::array::from_fn(|i| if i == 0 { start } else { squares[i - 1].map(|r| r.over(i as f64)) })
}

/// Value of a polynomial (Horner).
fn at(coefficients: &[Pair], t: Range) -> Pair {
    let zero = [Range::point(0.0); 2];
    coefficients.iter().rev().fold(zero, |sum, c| add(sum.map(|r| r.times(t)), *c))
}

/// Distance of a point from a segment, by the nearest of the ends and the foot.
pub(crate) fn apart_from_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, length) = ([b[0] - a[0], b[1] - a[1]], (b[0] - a[0]).hypot(b[1] - a[1]));
    let foot = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length;
    let ends = (p[0] - a[0]).hypot(p[1] - a[1]).min((p[0] - b[0]).hypot(p[1] - b[1]));
    let across = ((p[0] - a[0]) * along[1] - (p[1] - a[1]) * along[0]).abs() / length;
    if foot > 0.0 && foot < length { across.min(ends) } else { ends }
}

pub(crate) fn apart_from_all(p: [f64; 2], obstacles: &[Vec<[f64; 2]>]) -> f64 {
    let sides = obstacles.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    sides.filter(|(a, b)| a != b).map(|(a, b)| apart_from_segment(p, *a, *b)).fold(f64::INFINITY, f64::min)
}

/// Whether a point is inside, by the winding angle.
pub(crate) fn inside(p: [f64; 2], ring: &[[f64; 2]]) -> bool {
    let angle = |q: &[f64; 2]| (q[1] - p[1]).atan2(q[0] - p[0]);
    let steps = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| {
        let step = angle(b) - angle(a);
        step - (step / std::f64::consts::TAU).round() * std::f64::consts::TAU
    });
    steps.sum::<f64>().abs() > 1.0
}

/// Whether a curve from t on for a step keeps the distance and the curvature: interval arithmetic, halved up to a
/// depth.
fn kept(powers: &Powers, from: f64, step: f64, depth: u32, scene: &Scene) -> bool {
    let local = powers.from(from);
    let t = Range(0.0, step);
    let place = at(&local.r, t);
    let middle = place.map(|r| 0.5 * (r.0 + r.1));
    let radius = place.map(|r| 0.5 * (r.1 - r.0) * (1.0 + 1e-15));
    let far = apart_from_all(middle, &scene.obstacles) - radius[0].hypot(radius[1]);
    let w = at(&local.w, t);
    let slope = at(&[local.w[1], scaled(local.w[2], 2.0)], t);
    let turn = w[0].times(slope[1]).minus(w[1].times(slope[0])).by(2.0).size();
    let speed = w[0].times(w[0]).plus(w[1].times(w[1]));
    let speed = speed.0.max(0.0);
    // Intervals narrow no faster than the steps: at the very limit they would need too many.
    let slack = 1e-9;
    let size = scene.obstacles.iter().flatten().flatten().fold(1.0f64, |m, x| m.max(x.abs()));
    if far >= scene.clearance - slack * size && turn <= scene.greatest_curvature * speed * speed * (1.0 + 1e-6) {
        return true;
    }
    let half = 0.5 * step;
    depth > 0 && kept(powers, from, half, depth - 1, scene) && kept(powers, from + half, half, depth - 1, scene)
}

/// What is wrong with a path, if anything is.
pub(crate) fn audit(scene: &Scene, spans: &[PhQuintic]) -> Result<(), String> {
    let check = |fine: bool, what: String| if fine { Ok(()) } else { Err(what) };
    check(spans[0].start == scene.start && spans[spans.len() - 1].end == scene.goal, "ends".into())?;
    for (i, w) in spans.windows(2).enumerate() {
        let [a, b] = [w[0].control_points(), w[1].control_points()];
        check(a[5] == b[0], format!("gap after span {i}"))?;
        let (p, q) = (bezier(&w[0], 1.0).first, bezier(&w[1], 0.0).first);
        let (sizes, across) = (p[0].hypot(p[1]) * q[0].hypot(q[1]), p[0] * q[1] - p[1] * q[0]);
        check(
            across.abs() < 1e-7 * sizes && p[0] * q[0] + p[1] * q[1] > 0.0,
            format!("kink after span {i}: {p:?} {q:?}"),
        )?;
        check(w[0].curvature(1.0) == 0.0 && w[1].curvature(0.0) == 0.0, format!("curvature jumps after span {i}"))?;
    }
    for (i, span) in spans.iter().enumerate() {
        let powers = Powers::new(span);
        let off = at(&powers.r, Range::point(1.0));
        let off = [off[0].0 - span.end[0], off[1].0 - span.end[1]];
        let size =
            scene.obstacles.iter().flatten().chain([&scene.goal]).flatten().fold(1e-300f64, |m, x| m.max(x.abs()));
        check(off[0].hypot(off[1]) < 1e-13 * size, format!("span {i} ends elsewhere: {off:?}"))?;
        check(kept(&powers, 0.0, 1.0, 36, scene), format!("span {i} is not proved by intervals"))?;
        let hit = scene.obstacles.iter().position(|ring| inside(bezier(span, 0.37).point, ring));
        check(hit.is_none(), format!("span {i} is inside {hit:?}"))?;
    }
    Ok(())
}

/// [`audit`] of a plan, and of what it says of itself.
pub(crate) fn audit_plan(scene: &Scene, plan: &Plan) -> Result<(), String> {
    audit(scene, &plan.spans)?;
    let check = |fine: bool, what: &str| if fine { Ok(()) } else { Err(format!("{what}: {plan:?}")) };
    let sum = |lengths: &mut dyn Iterator<Item = f64>| lengths.sum::<f64>();
    let length = sum(&mut plan.spans.iter().map(|s| quadrature(s, 0.0, 1.0)[0]));
    let polyline = sum(&mut plan.polyline.windows(2).map(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1])));
    check((polyline - plan.length_saved - length).abs() < 1e-9 * polyline, "length")?;
    check(plan.spans.len() == 2 * plan.corners.len() + 1 && plan.polyline.len() == plan.corners.len() + 2, "spans")?;
    let reach = |i: usize| i.checked_sub(1).and_then(|i| plan.corners.get(i)).map_or(0.0, |c| c.reach);
    for (i, w) in plan.polyline.windows(2).enumerate() {
        check(reach(i) + reach(i + 1) < (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1]), "corner curves overlap")?;
    }
    let samples: Vec<(f64, f64)> = plan
        .spans
        .iter()
        .flat_map(|s| (0..=300).map(move |i| (s, f64::from(i) / 300.0)))
        .map(|(s, t)| (apart_from_all(bezier(s, t).point, &scene.obstacles), bezier(s, t).curvature().abs()))
        .collect();
    let least = samples.iter().fold(f64::INFINITY, |m, s| m.min(s.0));
    let most = samples.iter().fold(0.0f64, |m, s| m.max(s.1));
    let Some(c) = plan.proof.clearance else { return check(scene.obstacles.is_empty(), "no clearance") };
    check(c.at_least >= scene.clearance && c.at_least <= least && c.at_most >= c.at_least, "clearance")?;
    check(
        least - c.at_most < 1e-2 && (apart_from_all(c.point, &scene.obstacles) - c.at_most).abs() < 1e-9,
        "nearest point",
    )?;
    check(plan.proof.curvature_at_most <= scene.greatest_curvature, "curvature")?;
    check(
        most <= plan.proof.curvature_at_most * (1.0 + 1e-9) + 1e-9 && most >= 0.999 * plan.proof.curvature_at_most,
        "bound",
    )
}
