//! The numbers of the paper's figures.

use spiral_atlas::family::any_spiral::{Datum, Involute, involute};
use std::f64::consts::PI;

fn degrees(x: f64) -> f64 {
    x * 180.0 / PI
}

fn near(got: f64, want: f64, digits: i32) {
    assert!((got - want).abs() <= 0.5001 * 10f64.powi(-digits), "{got} is not {want}");
}

fn curve(alpha: f64, beta: f64, k1: f64, k2: f64, turns: [u32; 2]) -> (f64, f64, Involute) {
    let found = involute(&Datum { alpha, beta, k1, k2 }, turns).unwrap();
    let curve = found.curve().expect("a curve").clone();
    (found.q, degrees(found.omega), curve)
}

/// Arcs of the involute itself: α, β and θ of three of them with Q = -0.04. The map of an arc onto itself is the
/// identity.
#[test]
fn figure_2() {
    for (theta, omega, alpha, beta, turns) in [
        (59.0f64, 7.164, 66.16, -51.84, [0, 0]),
        (92.0, 9.248, 101.25, -82.75, [0, 0]),
        (172.0, 55.633, 227.63, -116.37, [1, 0]),
    ] {
        let (q, theta) = (0.04, theta.to_radians());
        let (sin, cos) = theta.sin_cos();
        let t0 = (theta * theta + (theta * theta - sin * sin) / q).sqrt();
        let (x, p) = (t0 * sin, sin - theta * cos);
        let (c, w) = (x.hypot(p), p.atan2(x));
        near(degrees(w), omega, 3);
        near(degrees(w + theta), alpha, 2);
        near(degrees(w - theta), beta, 2);
        let within = |x: f64| if x > PI { x - 2.0 * PI } else { x };
        let (q, omega, curve) = curve(within(w + theta), w - theta, -c / (t0 - theta), -c / (t0 + theta), turns);
        near(q, -0.04, 12);
        near(omega, degrees(w), 9);
        near(curve.theta(), theta, 11);
        near(curve.t0(), t0, 9);
        near(curve.map()[0], 1.0, 10);
        assert_eq!(curve.turns(), turns);
    }
}

/// Where a function of opposite signs at both ends is 0, by bisection.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > f(low);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *if (f(middle) < 0.0) == rising { &mut low } else { &mut high } = middle;
    }
    0.5 * (low + high)
}

/// An arc of the Cornu spiral; directions as in the figure, to a tenth of a degree: α ≈ -18.3°, β ≈ 188.4°.
#[test]
fn figure_4() {
    let (k1, k2, q) = (-0.84521f64, 2.76312, -2.37979);
    // β follows from ω ≈ 85.0° and Q, which the rounded angles do not give to so many digits.
    let theta = 175.742f64.to_radians();
    let (t0, half) = (3.65504, theta.sin());
    let omega = (half - theta * theta.cos()).atan2(t0 * half);
    let star = [omega + theta - 2.0 * PI, omega - theta].map(degrees);
    near(star[0], -99.208, 2);
    near(star[1], -90.692, 2);
    // α so that Q comes out: by bisection around -18.3°.
    let value = |alpha: f64| (k1 + alpha.sin()) * (k2 - (2.0 * omega - alpha).sin()) + omega.sin().powi(2) - q;
    let alpha = root(value, (-18.35f64).to_radians(), (-18.25f64).to_radians());
    let beta = 2.0 * omega - alpha;
    near(degrees(beta), 188.4, 1);
    let (got, _, curve) = curve(alpha, beta - 2.0 * PI, k1, k2, [0, 1]);
    near(got, q, 5);
    near(degrees(curve.theta()), 175.742, 3);
    near(curve.t0(), 3.65504, 4);
    assert_eq!(curve.turns(), [0, 1]);
}

#[test]
fn figure_5() {
    let k = 0.75f64.sqrt() / 2.0;
    near(k, 0.433013, 6);
    let (q, omega, short) = curve(-2.0 * PI / 3.0, PI, k, 2.0 * k, [0, 0]);
    near(q, -0.125, 12);
    near(omega, 30.0, 9);
    near(short.theta(), 2.478559516339784, 12);
    let (q, omega, long) = curve(-PI / 2.0, PI / 2.0, 0.75, 1.5, [0, 2]);
    near(q, -0.125, 12);
    near(omega, 360.0, 9);
    near(long.theta(), 7.725251836937707, 12);
    assert_eq!(long.turns(), [0, 2]);
}

/// The polar tractrix, with ψ in place of s: an inverse of the involute, so that the curve found is the tractrix again.
#[test]
fn figure_6() {
    let tractrix = |psi: f64| {
        let (shrink, sin, cos) = (1.0 / (1.0 + psi * psi), psi.sin(), psi.cos());
        let point = [2.0 * shrink * (psi * sin + cos), 2.0 * shrink * (sin - psi * cos)];
        let u = 1.0 - 2.0 * shrink;
        let direction = psi - (2.0 * shrink - 1.0).acos() + PI;
        (point, direction, u / (1.0 - u * u).sqrt())
    };
    // Ends by their directions in the figure: the chord's frame has α ≈ -53.7°, β ≈ 226.9°, Q ≈ -1.33286.
    let frame = |psi: [f64; 2]| {
        let ([a, ta, ka], [b, tb, kb]) = {
            let ((a, ta, ka), (b, tb, kb)) = (tractrix(psi[0]), tractrix(psi[1]));
            ([a, [ta, 0.0], [ka, 0.0]], [b, [tb, 0.0], [kb, 0.0]])
        };
        let d = [0.5 * (b[0] - a[0]), 0.5 * (b[1] - a[1])];
        let (c, mu) = (d[0].hypot(d[1]), d[1].atan2(d[0]));
        ([ta[0] - mu, tb[0] - mu], [ka[0] * c, kb[0] * c], c, mu, [a[0] + d[0], a[1] + d[1]])
    };
    let ends = [0.4, 4.0];
    let ([alpha, beta], [k1, k2], c, mu, middle) = frame(ends);
    let principal = |x: f64| x - 2.0 * PI * (x / (2.0 * PI)).round();
    let turns = (degrees(alpha - principal(alpha)).round(), degrees(beta - principal(beta)).round());
    let mut met = 0;
    for total in 0..3 {
        let chord = Datum { alpha: principal(alpha), beta: principal(beta), k1, k2 };
        let Some(curve) = involute(&chord, [0, total]).unwrap().curve().cloned() else { continue };
        // The one whose direction turns as much as the tractrix's.
        if ((curve.at(1.0).direction - curve.at(0.0).direction) - (beta - alpha)).abs() > 1e-6 {
            continue;
        }
        for i in 0..=40 {
            let (point, _, k) = tractrix(ends[0] + (ends[1] - ends[0]) * f64::from(i) / 40.0);
            let d = [point[0] - middle[0], point[1] - middle[1]];
            let (sin, cos) = mu.sin_cos();
            let want = [(d[0] * cos + d[1] * sin) / c, (d[1] * cos - d[0] * sin) / c];
            // The same curvature is the same point: curvature is monotone.
            let f = root(|f| curve.at(f).curvature - k * c, 0.0, 1.0);
            let got = if i == 0 || i == 40 { curve.at(f64::from(i / 40)) } else { curve.at(f) };
            let off = (got.point[0] - want[0]).hypot(got.point[1] - want[1]);
            assert!(off < 1e-12, "{off} at {i} of {turns:?}");
            met += 1;
        }
    }
    assert_eq!(met, 41);
}
