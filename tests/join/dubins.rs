//! The shortest path of bounded curvature between two poses, without regard to curvature at its ends (Dubins 1957): a
//! lower bound.

use spiral_atlas::transition::join::State;
use std::f64::consts::TAU;

/// Its length.
pub(crate) fn length(from: &State, to: &State, limit: f64) -> f64 {
    let [x, y] = [0, 1].map(|i| (to.point[i] - from.point[i]) * limit);
    let (d, theta) = (x.hypot(y), y.atan2(x));
    let (a, b) = (from.direction - theta, to.direction - theta);
    // A turn that rounding makes a full one is none: the bound stays one.
    let m = |x: f64| {
        let r = x.rem_euclid(TAU);
        if r > TAU - 1e-9 { 0.0 } else { r }
    };
    let ((sa, ca), (sb, cb), cab) = (a.sin_cos(), b.sin_cos(), (a - b).cos());
    let mut best = f64::INFINITY;
    let mut offer = |t: f64, p: f64, q: f64| best = best.min(m(t) + p + m(q));
    let straight = |square: f64| (square >= 0.0).then(|| square.sqrt());
    if let Some(p) = straight(2.0 + d * d - 2.0 * cab + 2.0 * d * (sa - sb)) {
        let t = (cb - ca).atan2(d + sa - sb);
        offer(t - a, p, b - t);
    }
    if let Some(p) = straight(2.0 + d * d - 2.0 * cab + 2.0 * d * (sb - sa)) {
        let t = (ca - cb).atan2(d - sa + sb);
        offer(a - t, p, t - b);
    }
    if let Some(p) = straight(d * d - 2.0 + 2.0 * cab + 2.0 * d * (sa + sb)) {
        let t = (-ca - cb).atan2(d + sa + sb) - (-2.0f64).atan2(p);
        offer(t - a, p, t - b);
    }
    if let Some(p) = straight(d * d - 2.0 + 2.0 * cab - 2.0 * d * (sa + sb)) {
        let t = (ca + cb).atan2(d - sa - sb) - 2.0f64.atan2(p);
        offer(a - t, p, b - t);
    }
    let cos = (6.0 - d * d + 2.0 * cab + 2.0 * d * (sa - sb)) / 8.0;
    if cos.abs() <= 1.0 {
        let p = TAU - cos.acos();
        let t = a - (ca - cb).atan2(d - sa + sb) + 0.5 * p;
        offer(t, p, a - b - t + p);
    }
    let cos = (6.0 - d * d + 2.0 * cab + 2.0 * d * (sb - sa)) / 8.0;
    if cos.abs() <= 1.0 {
        let p = TAU - cos.acos();
        let t = -a + (cb - ca).atan2(d + sa - sb) + 0.5 * p;
        offer(t, p, b - a - t + p);
    }
    best / limit
}
