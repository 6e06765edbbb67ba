//! Paths with given ends, by sampling: w1 from Newton's method on `∫ w² = 1`, end speeds of a given length by
//! bisection, the curvature from the control polygon of the derivative, its peak by dense sampling and golden sections.
//! Nothing is proved here, but 192 bits leave no doubt.

use super::iv::Iv;
use std::f64::consts::PI;

const BITS: usize = 192;

/// What is given besides the angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Given {
    Length(f64),
    Speeds(f64, f64),
}

/// One solution's peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Peak {
    pub most: f64,
    /// Where.
    pub at: f64,
    /// The curvature keeps its sign.
    pub one_way: bool,
    /// w2 with the positive sign.
    pub paper: bool,
}

type Complex = [Iv; 2];

fn number(x: f64) -> Iv {
    Iv::new(x, BITS)
}

fn add(a: &Complex, b: &Complex) -> Complex {
    [&a[0] + &b[0], &a[1] + &b[1]]
}

fn mul(a: &Complex, b: &Complex) -> Complex {
    [&(&a[0] * &b[0]) - &(&a[1] * &b[1]), &(&a[0] * &b[1]) + &(&a[1] * &b[0])]
}

fn times(a: &Complex, x: f64) -> Complex {
    [a[0].times(x), a[1].times(x)]
}

fn middle(a: &Complex) -> Complex {
    [a[0].middle(), a[1].middle()]
}

fn over(a: &Complex, b: &Complex) -> Option<Complex> {
    let conj = [b[0].clone(), -&b[1]];
    let (top, size) = (mul(a, &conj), &b[0].square() + &b[1].square());
    Some([top[0].over(&size).ok()?.middle(), top[1].over(&size).ok()?.middle()])
}

/// The control points of `w²`, times 3.
fn derivative([w0, w1, w2]: &[Complex; 3]) -> [Complex; 5] {
    let inner = add(&times(&mul(w1, w1), 2.0), &mul(w0, w2));
    [times(&mul(w0, w0), 3.0), times(&mul(w0, w1), 3.0), inner, times(&mul(w1, w2), 3.0), times(&mul(w2, w2), 3.0)]
}

/// `15 ∫ w² - 15`: a quadratic equation for w1, and its slope.
fn equation(w: &[Complex; 3]) -> (Complex, Complex) {
    let [a, b, c, d, e] = derivative(w);
    let sum = add(&add(&a, &b), &add(&c, &add(&d, &e)));
    let slope = add(&times(&add(&w[0], &w[2]), 3.0), &times(&w[1], 4.0));
    ([sum[0].plus(-15.0), sum[1].clone()], slope)
}

/// A pre-image with these outer coefficients, by Newton's method from a guess at w1.
fn preimage(w0: &Complex, mut w1: Complex, w2: &Complex) -> [Complex; 3] {
    for _ in 0..200 {
        let w = [w0.clone(), w1.clone(), w2.clone()];
        let (value, slope) = equation(&w);
        let Some(step) = over(&value, &slope) else { break };
        let small = |x: &Iv| x.approx().abs();
        let (size, tiny) = (small(&w1[0]) + small(&w1[1]), small(&step[0]) + small(&step[1]));
        w1 = middle(&add(&w1, &times(&step, -1.0)));
        if tiny < 1e-50 * size {
            break;
        }
    }
    [w0.clone(), w1, w2.clone()]
}

/// One of both.
fn first_preimage(w0: &Complex, w2: &Complex) -> [Complex; 3] {
    preimage(w0, [number(1.234), number(5.678)], w2)
}

/// Both of them, by deflation: Vieta for a guess at the second.
fn preimages(w0: &Complex, w2: &Complex) -> [[Complex; 3]; 2] {
    let first = first_preimage(w0, w2);
    // The roots add up to -3/2 (w0 + w2).
    let other = add(&times(&add(w0, w2), -1.5), &times(&first[1], -1.0));
    let second = preimage(w0, middle(&other), w2);
    [first, second]
}

fn unit(theta: f64) -> Complex {
    // Halves of angles are doubles.
    let (sin, cos) = Iv::sin_cos(0.5 * theta, BITS);
    if theta == 0.0 { [number(1.0), number(0.0)] } else { [cos.middle(), sin.middle()] }
}

fn length(w: &[Complex; 3]) -> Iv {
    let dot = |a: &Complex, b: &Complex| &(&a[0] * &b[0]) + &(&a[1] * &b[1]);
    let [a, b, c] = w;
    let outer = &(&dot(a, a) + &dot(a, b)) + &(&dot(b, c) + &dot(c, c));
    let inner = &dot(b, b).times(2.0) + &dot(a, c);
    (&outer.times(3.0) + &inner).over(&number(15.0)).unwrap().middle()
}

/// The end speed at which the curves have this length.
fn speed_of(first: &Complex, last: &Complex, wanted: f64) -> Option<Iv> {
    let off = |z: &Iv| {
        let size = z.sqrt().middle();
        let scaled = |unit: &Complex| middle(&[&unit[0] * &size, &unit[1] * &size]);
        length(&first_preimage(&scaled(first), &scaled(last))).plus(-wanted)
    };
    let (mut low, mut high) = (number(1e-18), number(1e12));
    for i in 0..600 {
        // Orders of magnitude first.
        let between = if i < 20 { (&low * &high).sqrt().middle() } else { (&low + &high).middle().times(0.5) };
        if off(&between).approx() > 0.0 {
            high = between
        } else {
            low = between
        }
        if (&high - &low).approx() < 1e-45 * low.approx() {
            break;
        }
    }
    Some(high)
}

/// The curvature from the derivative's control polygon.
fn curvature(legs: &[Complex; 5], t: &Iv) -> Iv {
    let back = (-t).plus(1.0);
    let mut row = legs.to_vec();
    while row.len() > 2 {
        row = row.windows(2).map(|p| [0, 1].map(|i| &(&p[0][i] * &back) + &(&p[1][i] * t))).collect();
    }
    let point = [0, 1].map(|i| &(&row[0][i] * &back) + &(&row[1][i] * t));
    let slope = [0, 1].map(|i| (&row[1][i] - &row[0][i]).times(4.0));
    let cross = &(&point[0] * &slope[1]) - &(&point[1] * &slope[0]);
    let speed = (&point[0].square() + &point[1].square()).sqrt();
    // The legs are three times too long.
    cross.over(&(&speed.square() * &speed)).unwrap_or_else(|_| number(1e60)).times(3.0).middle()
}

/// Parameters at which a peak shows: even ones, and ever closer ones around the slowest points.
fn samples(w: &[Complex; 3]) -> Vec<f64> {
    let speed = |t: f64| {
        let (t, back) = (number(t), number(1.0 - t));
        let mut row = w.to_vec();
        while row.len() > 1 {
            row = row.windows(2).map(|p| middle(&[0, 1].map(|i| &(&p[0][i] * &back) + &(&p[1][i] * &t)))).collect();
        }
        (&row[0][0].square() + &row[0][1].square()).approx()
    };
    let even: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
    let speeds: Vec<f64> = even.iter().map(|t| speed(*t)).collect();
    let mut all = even.clone();
    for i in 0..=100usize {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(100));
        if speeds[i] > speeds[before] || speeds[i] > speeds[after] {
            continue;
        }
        let (mut a, mut b) = (even[before], even[after]);
        for _ in 0..85 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if speed(c) < speed(d) { b = d } else { a = c }
        }
        let around = (0..100).flat_map(|k| [1.0, -1.0].map(|s| a + s * 0.01 * 0.72f64.powi(k)));
        all.extend(around.filter(|t| *t > 0.0 && *t < 1.0));
    }
    all.sort_by(f64::total_cmp);
    all
}

fn peak(w: &[Complex; 3], paper: bool) -> Peak {
    let legs = derivative(w);
    let at = samples(w);
    let values: Vec<f64> = at.iter().map(|t| curvature(&legs, &number(*t)).approx()).collect();
    let largest = values.iter().fold(0.0f64, |m, k| m.max(k.abs()));
    let one_way = values.iter().all(|k| *k >= -1e-30 * largest) || values.iter().all(|k| *k <= 1e-30 * largest);
    let size = |t: &Iv| curvature(&legs, t).magnitude();
    let best = (0..at.len()).max_by(|i, j| values[*i].abs().total_cmp(&values[*j].abs())).unwrap();
    let (mut a, mut b) = (number(at[best.saturating_sub(1)]), number(at[(best + 1).min(at.len() - 1)]));
    // Golden sections.
    let ratio = 0.6180339887498949;
    let inner = |a: &Iv, b: &Iv, r: f64| (a + &(b - a).times(r)).middle();
    let (mut c, mut d) = (inner(&a, &b, 1.0 - ratio), inner(&a, &b, ratio));
    let (mut at_c, mut at_d) = (size(&c), size(&d));
    for _ in 0..110 {
        if (&at_c - &at_d).middle().approx() > 0.0 {
            (b, d, at_d) = (d, c.clone(), at_c);
            c = inner(&a, &b, 1.0 - ratio);
            at_c = size(&c);
        } else {
            (a, c, at_c) = (c, d.clone(), at_d);
            d = inner(&a, &b, ratio);
            at_d = size(&d);
        }
    }
    let ends = [0.0, 1.0].map(|t| (size(&number(t)), t));
    let inside = (at_c, c.approx());
    let most = ends
        .into_iter()
        .chain([inside])
        .reduce(|best, next| if (&next.0 - &best.0).middle().approx() > 0.0 { next } else { best });
    let (most, at) = most.unwrap();
    Peak { most: most.approx(), at, one_way, paper }
}

/// All solutions, those of the paper first.
pub(crate) fn peaks(theta: [f64; 2], given: Given) -> Vec<Peak> {
    assert!(theta.iter().all(|t| t.abs() <= PI));
    let mut all = vec![];
    for paper in [true, false] {
        let (first, last) = (unit(theta[0]), times(&unit(theta[1]), if paper { 1.0 } else { -1.0 }));
        let size = match given {
            Given::Speeds(l0, l1) => [number(l0), number(l1)],
            Given::Length(wanted) => {
                let z = speed_of(&first, &last, wanted).unwrap();
                [z.clone(), z]
            }
        };
        let scaled = |unit: &Complex, size: &Iv| {
            let root = size.sqrt().middle();
            middle(&[&unit[0] * &root, &unit[1] * &root])
        };
        let both = preimages(&scaled(&first, &size[0]), &scaled(&last, &size[1]));
        all.extend(both.iter().map(|w| peak(w, paper)));
    }
    all
}
