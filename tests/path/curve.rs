//! The curve itself.

use super::*;
use std::f64::consts::PI;

fn curve(row: &Value) -> PhQuintic {
    let w = points(&row[1]);
    PhQuintic::new(point(&row[0]), [w[0], w[1], w[2]])
}

#[test]
fn published_measures() {
    for row in rows("basic") {
        let c = curve(&row);
        let t = number(&row[4]);
        let near = |what: &str, got: &[f64], want: &Value| assert_near(what, got, &numbers(want), DIGITS);
        assert_near("control points", &flat(&c.control_points()[1..]), &flat(&points(&row[2])), DIGITS);
        assert_near("length", &[c.length()], &[number(&row[3])], DIGITS);
        assert_near("curvature", &[c.curvature(t)], &[number(&row[5])], DIGITS);
        assert_near("parameter", &[c.parameter_at(number(&row[6]) * c.length())], &[number(&row[7])], DIGITS);
        near("end curvatures", &[c.curvature(0.0), c.curvature(1.0)], &row[8]);
        let extrema: Vec<[f64; 2]> = c.curvature_extrema().into_iter().map(|t| [t, c.curvature(t)]).collect();
        let (t_got, k_got): (Vec<f64>, Vec<f64>) = extrema.iter().map(|e| (e[0], e[1])).unzip();
        let (t_want, k_want): (Vec<f64>, Vec<f64>) = points(&row[9]).iter().map(|e| (e[0], e[1])).unzip();
        assert_near("extrema", &t_got, &t_want, 1e-11);
        assert_near("extreme curvatures", &k_got, &k_want, DIGITS);
        near("inflections", &c.inflections(), &row[10]);
        assert_near("greatest", &[c.greatest_curvature().1], &[number(&row[11])], DIGITS);
        assert_near("absolute rotation", &[c.absolute_rotation()], &[number(&row[12])], DIGITS);
        assert_near("rotation", &[c.rotation()], &[number(&row[13])], DIGITS);
        assert_near("energy", &[c.bending_energy()], &[number(&row[14])], DIGITS);
    }
}

#[test]
fn published_offsets() {
    let basic = rows("basic");
    for offset in published("offset").as_array().unwrap() {
        let w = points(&offset["w"]);
        let got = PhQuintic::new(point(&offset["p0"]), [w[0], w[1], w[2]]).offset(number(&offset["d"]));
        let got: Vec<f64> = got.weight.iter().zip(&got.numerator).flat_map(|(w, [x, y])| [*w, *x, *y]).collect();
        let want: Vec<f64> = offset["WXY"].as_array().unwrap().iter().flat_map(numbers).collect();
        assert_near("offset", &got, &want, DIGITS);
    }
    for row in rows("offset_points") {
        let c = curve(&basic[row[0].as_u64().unwrap() as usize]);
        assert_near("offset point", &c.offset(number(&row[1])).point(number(&row[2])), &point(&row[3]), DIGITS);
    }
}

#[test]
fn random_curves_agree_with_their_bezier_form() {
    let mut noise = Noise(1);
    let mut inflected = 0;
    for _ in 0..200 {
        let c = PhQuintic::new(noise.point(), [noise.point(), noise.point(), noise.point()]);
        // A curve that hardly stops is no test of quadrature.
        if c.least_speed().1 < 1e-2 * c.length() {
            continue;
        }
        for t in [0.0, 0.123, 0.5, 0.77, 1.0] {
            let (got, want) = (c.jet(t), bezier(&c, t));
            assert_near("point", &got.point, &want.point, 1e-14);
            assert_near("point", &c.point(t), &want.point, 1e-14);
            assert_near(
                "derivatives",
                &flat(&[got.first, got.second, got.third]),
                &flat(&[want.first, want.second, want.third]),
                1e-13,
            );
            assert_near("speed", &[c.speed(t)], &[want.speed()], 1e-13);
            assert_near("curvature", &[c.curvature(t)], &[want.curvature()], 1e-10);
            assert_near("tangent", &[c.tangent(t)[1].atan2(c.tangent(t)[0])], &[want.direction()], 1e-11);
            assert_near("length", &[c.length_to(t)], &[arc_length(|t| bezier(&c, t).speed(), 0.0, t)], 1e-13);
            assert_near("inverse", &[c.length_to(c.parameter_at(t * c.length()))], &[t * c.length()], 4e-15);
            let (o, n) = (c.offset(0.3).point(t), want);
            let unit = n.first.map(|x| x / n.speed());
            assert_near("offset", &o, &[n.point[0] - 0.3 * unit[1], n.point[1] + 0.3 * unit[0]], 1e-10);
        }
        let [length, energy, _] = quadrature(&c, 0.0, 1.0);
        assert_near("length and energy", &[c.length(), c.bending_energy()], &[length, energy], 1e-10);
        let inflections = c.inflections();
        inflected += inflections.len();
        let ends: Vec<f64> = [0.0].into_iter().chain(inflections).chain([1.0]).collect();
        let rotation: f64 = ends.windows(2).map(|w| quadrature(&c, w[0], w[1])[2]).sum();
        assert_near("rotation", &[c.absolute_rotation()], &[rotation], 1e-10);
        // No sample is bent more than the greatest curvature, and some nearly as much; the bound is no less, and not
        // much more.
        let sampled = (0..=4000).map(|i| bezier(&c, f64::from(i) / 4000.0).curvature().abs()).fold(0.0, f64::max);
        let (_, greatest) = c.greatest_curvature();
        assert!(sampled <= greatest * (1.0 + 1e-9) && sampled >= greatest * 0.999, "{sampled} {greatest}");
        let bound = c.curvature_bound(8);
        assert!(bound >= greatest && bound < 1.2 * greatest, "{bound} {greatest}");
    }
    assert!(inflected > 20);
}

#[test]
fn curves_that_stand_still_or_run_straight() {
    let straight = PhQuintic::new([1.0, 1.0], [[1.0, 0.5], [2.0, 1.0], [0.5, 0.25]]);
    assert_eq!(
        (straight.bending_energy(), straight.absolute_rotation(), straight.greatest_curvature().1),
        (0.0, 0.0, 0.0)
    );
    // w = 1 - 2t: it slows down to nothing and goes on, straight.
    let pause = PhQuintic::new([0.0, 0.0], [[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0]]);
    assert!(!pause.is_regular() && straight.is_regular());
    assert_eq!((pause.bending_energy(), pause.absolute_rotation(), pause.least_speed()), (0.0, 0.0, (0.5, 0.0)));
    assert!((pause.length_to(pause.parameter_at(0.4 * pause.length())) / pause.length() - 0.4).abs() < 1e-15);
    // (t - 1/2)(1 + i t): bent while it stands still.
    let cusp = PhQuintic::new([0.0, 0.0], [[-0.5, 0.0], [0.0, -0.25], [0.5, 0.5]]);
    assert!(cusp.bending_energy().is_infinite() && !cusp.is_regular() && cusp.curvature_bound(6).is_infinite());
    assert_eq!((cusp.greatest_curvature(), pause.greatest_curvature()), ((0.5, f64::INFINITY), (0.5, 0.0)));
    // Beside the cusp: a tiny loop of one more turn, and a bound that is still one.
    let near = PhQuintic::new([0.0, 0.0], [[-0.5, 1e-3], [0.0, -0.25], [0.5, 0.5]]);
    assert!(near.bending_energy().is_finite() && (near.rotation().abs() > PI || near.absolute_rotation() < PI));
    assert!(near.curvature_bound(12) >= near.greatest_curvature().1);
    // A point.
    let point = PhQuintic::new([3.0, 4.0], [[0.0; 2]; 3]);
    assert_eq!((point.length(), point.parameter_at(0.0), point.point(0.4)), (0.0, 0.0, [3.0, 4.0]));
    assert!(!PhQuintic::new([f64::NAN, 0.0], straight.preimage).is_finite() && straight.is_finite());
    assert!(!PhQuintic::new([0.0, 0.0], [[1e200, 0.0]; 3]).is_finite());
}

#[test]
fn any_unit_of_length() {
    let w = [[0.9, 0.1], [0.7, 0.5], [0.4, 0.8]];
    let c = PhQuintic::new([0.0, 0.0], w);
    for root in [1e-60, 1e-3, 1e50] {
        let size: f64 = root * root;
        let d = PhQuintic::new([0.0, 0.0], w.map(|z| z.map(|x| x * root)));
        let got = [
            d.length() / size,
            d.bending_energy() * size,
            d.greatest_curvature().1 * size,
            d.curvature_bound(6) * size,
        ];
        let want = [c.length(), c.bending_energy(), c.greatest_curvature().1, c.curvature_bound(6)];
        assert_near("measures", &got, &want, 1e-8);
        assert_near("rotation", &[d.absolute_rotation()], &[c.absolute_rotation()], 1e-14);
    }
}

/// `(t - 1/2 - a)(t - 1/2 - b)`.
fn of_roots(a: [f64; 2], b: [f64; 2]) -> PhQuintic {
    let [a, b] = [a, b].map(|[re, im]| num_complex::Complex64::new(0.5 + re, im));
    let w = [a * b, a * b - 0.5 * (a + b), (1.0 - a) * (1.0 - b)];
    PhQuintic::new([0.0, 0.0], w.map(|z| [z.re, z.im]))
}

/// Absolute rotation and greatest curvature, reckoned from the roots without cancellation near t = 1/2: the argument of
/// w is monotone between the roots of a quadratic polynomial, and the curvature is sampled at distances from there that
/// grow by the hundredth.
fn told_by_roots(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let [a, b] = [a, b].map(|[re, im]| num_complex::Complex64::new(re, im));
    // The slope of the argument is Im a / |s - a|² + Im b / |s - b|².
    let (p, q) = (a.im + b.im, a.im * b.re + b.im * a.re);
    let r = a.im * b.norm_sqr() + b.im * a.norm_sqr();
    let root = (q * q - p * r).sqrt();
    let mut ends = vec![-0.5, (q - root) / p, (q + root) / p, 0.5];
    ends.retain(|s| s.abs() <= 0.5);
    ends.sort_by(f64::total_cmp);
    let turn = |w: &[f64]| [a, b].map(|z| ((w[1] - z) / (w[0] - z)).arg()).iter().sum::<f64>().abs();
    let rotation = 2.0 * ends.windows(2).map(turn).sum::<f64>();
    let curvature = |s: f64| {
        let (w, slope) = ((s - a) * (s - b), 2.0 * s - a - b);
        2.0 * (w.conj() * slope).im.abs() / w.norm_sqr().powi(2)
    };
    let steps = (0..3000).map(|i| 0.5 * 0.99f64.powi(i));
    let samples = steps.flat_map(|s| [s, -s]).flat_map(|s| [s, a.re + s, b.re + s]).filter(|s| s.abs() <= 0.5);
    [rotation, samples.map(curvature).fold(0.0, f64::max)]
}

/// The slower a curve is somewhere, the less its pre-image says of how it turns there.
#[test]
fn curves_that_nearly_stand_still() {
    let mut least = f64::INFINITY;
    for i in 0..240 {
        let d = 0.3 * 0.95f64.powi(i);
        for (a, b) in [
            ([0.0, d], [0.7, 0.4]),
            ([0.0, d], [0.0, 0.7 * d]),
            ([0.2 * d, d], [-0.3 * d, -0.6 * d]),
            ([0.0, d * d], [0.3 * d, -0.9 * d * d]),
        ] {
            let c = of_roots(a, b);
            let share = c.least_speed().1 / c.length();
            if !c.is_regular() {
                continue;
            }
            least = least.min(share);
            let [rotation, greatest] = told_by_roots(a, b);
            let (turned, (_, most)) = (c.absolute_rotation(), c.greatest_curvature());
            let told = 40.0 * f64::EPSILON / share.sqrt();
            assert!((turned - rotation).abs() <= told, "{i} {share:e}: turns {turned:?}, not {rotation:?}");
            assert!((most / greatest - 1.0).abs() <= 1e-5, "{i} {share:e}: bends {most:?}, not {greatest:?}");
        }
    }
    assert!(least < 2e-12, "{least}");
}
