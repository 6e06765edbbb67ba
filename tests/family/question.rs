//! Ranges, nearest data and outlines, against exact verdicts and the oracle at points.

use crate::any_spiral;
use crate::oracle::random::Random;
use crate::oracle::{in_domain, judge, ph};
use spiral_atlas::family::{self, verdict};
use spiral_atlas::question::{Property, boundary, nearest, ranges};
use std::f64::consts::PI;

/// Whether a property holds at a point.
type Holds = Box<dyn Fn(&[f64]) -> bool>;

/// The property of a name, and its verdict at a point as a grid of one node has it.
struct Asked {
    property: Property,
    holds: Holds,
}

fn asked(family: &str, chart: usize, flag: &str) -> Asked {
    let found = family::by_name(family).unwrap();
    let about = found.about();
    let bit = about.flags.iter().position(|f| f.name == flag).unwrap();
    let holds = move |point: &[f64]| verdict(found, chart, point).is_ok_and(|code| code.flags() >> bit & 1 == 1);
    Asked { property: Property::new(family, about.charts[chart].axes, flag).unwrap(), holds: Box::new(holds) }
}

/// Data of families in half chords, near those that have spirals.
fn datum(r: &mut Random) -> Vec<f64> {
    let phi1 = r.uniform(0.2, 2.0);
    let phi0 = r.uniform(0.05, 0.9) * phi1.min(3.1 - phi1);
    vec![phi0, phi1, r.uniform(0.0, 1.2) * phi0.sin(), phi1.sin() * (1.0 + r.uniform(-0.2, 3.0))]
}

fn with(point: &[f64], axis: usize, x: f64) -> Vec<f64> {
    let mut point = point.to_vec();
    point[axis] = x;
    point
}

/// Where the other angle is near π, this one is less than what the double of π leaves: none of its doubles is lost.
#[test]
fn no_datum_at_the_end_of_the_domain_is_lost() {
    for (family, flag, point, within, probes) in [
        ("cubic", "SOLVABLE", [0.0, PI, 1e-17, 1e18], [4e-17, 1e-16], &[5e-17][..]),
        ("cubic", "ANY_SPIRAL", [0.0, 3.0, 0.01, 100.0], [0.14, 0.15], &[0.141, 0.14159265358979323]),
        ("cubic", "ANY_SPIRAL", [0.0, 3.0, 0.01, 100.0], [0.14159265358979318, 0.15], &[0.14159265358979323]),
        ("ph-quintic", "ANY_SPIRAL", [0.0, 3.0, 0.01, 100.0], [0.14, 0.15], &[0.141, 0.14159265358979323]),
    ] {
        let Asked { property, holds } = asked(family, 0, flag);
        let answer = ranges(&property, &point, 0, within).unwrap();
        for x in probes {
            assert!(holds(&with(&point, 0, *x)), "{family} {flag} {x:?}");
            let told = answer.ranges.iter().any(|s| s.outer[0] <= *x && *x <= s.outer[1]);
            assert!(told || answer.open.iter().any(|s| s[0] <= *x && *x <= s[1]), "{family} {flag} {x:?}: {answer:?}");
        }
    }
}

/// Inside it holds, outside it fails, the ends are where it changes, and the work is bounded.
#[test]
fn ranges_are_true_at_every_point() {
    let mut r = Random(71);
    let subjects =
        [("cubic", "SPIRAL", 60), ("cubic", "SOLVABLE", 30), ("any-spiral", "EXISTS", 40), ("ph-quintic", "SPIRAL", 6)];
    let (mut found, mut wide, mut cuts) = (0, 0, 0);
    for (family, flag, count) in subjects {
        let chart = usize::from(family == "any-spiral");
        let Asked { property, holds } = asked(family, chart, flag);
        for _ in 0..count {
            let (point, axis) = (datum(&mut r), r.below(4) as usize);
            let within = if axis < 2 { [0.0, 3.0] } else { [0.0, 20.0] };
            let answer = ranges(&property, &point, axis, within).unwrap();
            let place = format!("{family} {flag} {point:?} {axis}: {answer:?}");
            assert!(answer.boxes <= 4_000, "{place}");
            let inside = |x: f64| answer.ranges.iter().any(|s| s.inner[0] <= x && x <= s.inner[1]);
            let edge = |x: f64| {
                let near = |s: &[f64; 2]| s[0] <= x && x <= s[1];
                answer.ranges.iter().any(|s| near(&[s.outer[0], s.inner[0]]) || near(&[s.inner[1], s.outer[1]]))
                    || answer.open.iter().any(near)
            };
            for _ in 0..40 {
                let x = r.uniform(within[0], within[1]);
                if !edge(x) {
                    assert_eq!(holds(&with(&point, axis, x)), inside(x), "{x:?} {place}");
                }
            }
            for range in &answer.ranges {
                found += 1;
                for (side, outwards) in [f64::next_down as fn(f64) -> f64, f64::next_up].into_iter().enumerate() {
                    let (end, gap) = (range.ends[side], (range.outer[side] - range.inner[side]).abs());
                    wide += usize::from(gap > 1e-9 * end.abs().max(1e-100));
                    assert!(holds(&with(&point, axis, end)), "{end:?} {place}");
                    let goes_on = holds(&with(&point, axis, outwards(end)));
                    let cut = end == within[side] && goes_on;
                    assert!(range.cut[side] == cut && (cut || end == range.outer[side] || !goes_on), "{end:?} {place}");
                    cuts += usize::from(cut);
                    assert!(holds(&with(&point, axis, range.inner[side])), "{place}");
                }
            }
        }
    }
    assert!(found > 60 && wide * 10 < found && cuts > 0, "{found} {wide} {cuts}");
}

/// What is asked of each family, in half chords and angles from the chord.
const SUBJECTS: [(&str, &str); 3] = [("cubic", "SPIRAL"), ("any-spiral", "EXISTS"), ("ph-quintic", "SPIRAL")];

/// The same property by code that knows nothing of boxes and shares no formula with the library, in as many digits as
/// it takes: 50 at least.
fn judged(family: &str, p: &[f64]) -> bool {
    let [phi0, phi1, kappa0, kappa1] = [p[0], p[1], p[2], p[3]];
    match family {
        "any-spiral" => any_spiral::judge([-phi0, phi1, kappa0, kappa1]) & family::any_spiral::EXISTS != 0,
        _ if !in_domain(phi0, phi1) => false,
        "cubic" => judge(phi0, phi1, kappa0, kappa1).flags & family::cubic::SPIRAL != 0,
        _ => ph::judge([phi0, phi1, kappa0, kappa1]).flags & family::ph_quintic::SPIRAL != 0,
    }
}

/// Data beside a boundary of the property, and degenerate ones: a straight end, equal angles, both.
fn special((family, flag): (&str, &str), r: &mut Random) -> Vec<f64> {
    let mut point = datum(r);
    match r.below(4) {
        0 => point[2] = 0.0,
        1 => point[0] = point[1].min(1.5),
        2 => (point[0], point[2]) = (point[1].min(1.5), 0.0),
        _ => {
            let property = asked(family, usize::from(family == "any-spiral"), flag).property;
            let axis = r.below(3) as usize;
            let within = if axis < 2 { [0.0, 3.0] } else { [0.0, 20.0] };
            if let Some(range) = ranges(&property, &point, axis, within).unwrap().ranges.first() {
                point[axis] = range.inner[r.below(2) as usize];
            }
        }
    }
    point
}

#[test]
fn ends_of_ranges_agree_with_the_oracle() {
    let mut r = Random(72);
    for ((family, flag), count) in SUBJECTS.into_iter().zip([40, 60, 12]) {
        let property = asked(family, usize::from(family == "any-spiral"), flag).property;
        let mut compared = 0;
        for i in 0..count {
            let point = if i % 2 == 0 { datum(&mut r) } else { special((family, flag), &mut r) };
            let axis = if i % 3 == 0 { 3 } else { r.below(4) as usize };
            let within = if axis < 2 { [0.0, 3.0] } else { [0.0, 20.0] };
            let answer = ranges(&property, &point, axis, within).unwrap();
            let place = format!("{family} {point:?} {axis}: {answer:?}");
            let left_out = |x: f64| {
                let known = answer.ranges.iter().map(|s| s.outer).chain(answer.open.iter().copied());
                x >= within[0] && x <= within[1] && !known.into_iter().any(|s| s[0] <= x && x <= s[1])
            };
            for range in &answer.ranges {
                for (side, outwards) in [f64::next_down as fn(f64) -> f64, f64::next_up].into_iter().enumerate() {
                    assert!(judged(family, &with(&point, axis, range.ends[side])), "{place}");
                    assert!(judged(family, &with(&point, axis, range.inner[side])), "{place}");
                    let beyond = outwards(range.outer[side]);
                    if left_out(beyond) {
                        assert!(!judged(family, &with(&point, axis, beyond)), "{place}");
                        compared += 1;
                    }
                }
            }
            for _ in 0..4 {
                let x = r.uniform(within[0], within[1]);
                assert!(!left_out(x) || !judged(family, &with(&point, axis, x)), "{x:?} {place}");
            }
        }
        assert!(compared >= 8, "{family}: {compared}");
    }
}

/// What is returned is feasible and nothing nearer is, for the oracle, too.
#[test]
fn nearest_data_agree_with_the_oracle() {
    let mut r = Random(75);
    for ((family, flag), count) in SUBJECTS.into_iter().zip([6, 6, 2]) {
        let property = asked(family, usize::from(family == "any-spiral"), flag).property;
        let (mut found, mut there) = (0, 0);
        for i in 0..count {
            let mut point = special((family, flag), &mut r);
            // From a boundary of the property, or from farther away.
            point[3] *= if i % 2 == 0 { 1.0 } else { r.uniform(0.1, 0.6) };
            let weights = [f64::INFINITY, f64::INFINITY, 1.0, 0.5];
            let answer = nearest(&property, &point, &weights).unwrap();
            let place = format!("{family} {point:?}: {answer:?}");
            if let Some(nearest) = &answer.point {
                assert!(judged(family, nearest), "{place}");
                found += 1;
            }
            there += usize::from(answer.distance == Some(0.0));
            assert_eq!(answer.distance == Some(0.0), judged(family, &point), "{place}");
            for _ in 0..20 {
                let (sin, cos) = r.uniform(0.0, 2.0 * PI).sin_cos();
                let reach = answer.at_least.min(1e3) * r.uniform(0.5, 0.9999);
                let moved = [point[0], point[1], point[2] + reach * cos, point[3] + 2.0 * reach * sin];
                assert!(reach == 0.0 || !judged(family, &moved), "{moved:?} {place}");
            }
        }
        println!("{family}: {found} of {count}, {there} of them there already");
        assert!(found > 0, "{family}");
    }
}

/// Of outlines of all families: on either side of one the oracle says otherwise, and away from all it says one thing.
#[test]
fn outlines_agree_with_the_oracle() {
    let mut r = Random(76);
    for (family, flag) in SUBJECTS {
        let property = asked(family, usize::from(family == "any-spiral"), flag).property;
        let mut compared = 0;
        for [phi0, phi1] in [[0.7, 1.4], [1.0, 1.0], [0.01, 3.1]] {
            let point = [phi0, phi1, 0.0, 0.0];
            let within = [[0.0, phi0], [0.0, 12.0]];
            let told = boundary(&property, &point, [2, 3], within, 64).unwrap();
            let at = |[x, y]: [f64; 2]| judged(family, &[phi0, phi1, x, y]);
            let points: Vec<[f64; 2]> = told.outlines.iter().flat_map(|outline| outline.points.clone()).collect();
            for p in points.iter().step_by(16) {
                let differs = |i: usize| {
                    let (mut a, mut b) = (*p, *p);
                    a[i] -= 2e-6 * told.cell[i];
                    b[i] += 2e-6 * told.cell[i];
                    at(a) != at(b)
                };
                assert!(differs(0) || differs(1), "{family} {point:?} {p:?}");
                compared += 1;
            }
            let cell_of = |p: [f64; 2]| [0, 1].map(|i| ((p[i] - within[i][0]) / told.cell[i]).floor());
            let open = told.open.iter().map(|[low, high]| [0, 1].map(|i| 0.5 * low[i] + 0.5 * high[i]));
            let passed: Vec<[f64; 2]> = points.iter().copied().chain(open).map(cell_of).collect();
            for _ in 0..20 {
                let p = [0, 1].map(|i| r.uniform(within[i][0], within[i][1]));
                let cell = cell_of(p);
                // On an edge of the lattice an outline passes both cells beside it.
                if passed.iter().all(|other| (0..2).any(|i| (other[i] - cell[i]).abs() > 1.0)) {
                    let other = [0, 1].map(|i| within[i][0] + told.cell[i] * (cell[i] + r.uniform(0.0, 1.0)));
                    assert_eq!(at(p), at(other), "{family} {p:?} {other:?}");
                }
            }
        }
        println!("{family}: {compared}");
        assert!(compared > 4, "{family}: {compared}");
    }
}

/// What is returned has the property, and nothing nearer than `at_least` has.
#[test]
fn nothing_is_nearer_than_said() {
    let mut r = Random(73);
    let (mut close, mut all) = (0, 0);
    for (family, flag, count) in [("cubic", "SPIRAL", 8), ("any-spiral", "EXISTS", 8), ("ph-quintic", "SPIRAL", 1)] {
        let chart = usize::from(family == "any-spiral");
        let Asked { property, holds } = asked(family, chart, flag);
        for k in 0..count {
            let point: Vec<f64> =
                vec![r.uniform(0.2, 1.4), r.uniform(0.2, 1.4), r.uniform(0.5, 2.0), r.uniform(0.0, 2.0)];
            // Of half of them the directions stay.
            let weights = if k % 2 == 0 { [f64::INFINITY, f64::INFINITY, 1.0, 0.5] } else { [1.0, 2.0, 1.0, 0.5] };
            let answer = nearest(&property, &point, &weights).unwrap();
            let place = format!("{family} {point:?} {weights:?}: {answer:?}");
            assert!(answer.boxes <= 30_000, "{place}");
            if let (Some(found), Some(distance)) = (&answer.point, answer.distance) {
                assert!(holds(found), "{place}");
                let kept = |i: usize| weights[i].is_finite() || found[i] == point[i];
                assert!((0..4).all(kept) && distance >= answer.at_least, "{place}");
                all += 1;
                close += usize::from(distance <= 1.002 * answer.at_least);
            }
            let reach = answer.at_least.min(1e3);
            for _ in 0..300 {
                let step: Vec<f64> =
                    (0..4).map(|i| if weights[i].is_finite() { r.uniform(-1.0, 1.0) } else { 0.0 }).collect();
                let size = step
                    .iter()
                    .zip(weights)
                    .filter(|(s, _)| **s != 0.0)
                    .map(|(s, w)| (s * w).powi(2))
                    .sum::<f64>()
                    .sqrt();
                let share = reach * r.uniform(0.5, 0.9999) / size;
                let moved: Vec<f64> = point.iter().zip(&step).map(|(x, s)| x + share * s).collect();
                assert!(reach == 0.0 || !holds(&moved), "{moved:?} {place}");
            }
        }
    }
    assert!(all > 8 && 2 * close > all, "{close} of {all}");
}

/// Points on either side of an outline differ, and beside cells that it passes nothing changes.
#[test]
fn outlines_part_what_holds_from_what_fails() {
    let mut r = Random(74);
    let Asked { property, holds } = asked("cubic", 0, "SPIRAL");
    let point = [0.7, 1.4, 0.0, 0.0];
    let (within, cells) = ([[0.0, 0.8], [0.0, 12.0]], 128);
    let found = boundary(&property, &point, [2, 3], within, cells).unwrap();
    let at = |[x, y]: [f64; 2]| holds(&[point[0], point[1], x, y]);
    let cell_of = |p: [f64; 2]| [0, 1].map(|i| ((p[i] - within[i][0]) / found.cell[i]).floor() as i64);
    let mut passed = std::collections::HashSet::new();
    for outline in &found.outlines {
        for p in &outline.points {
            // On an edge of the lattice: both cells beside it.
            for off in [[-1e-9, -1e-9], [1e-9, 1e-9], [1e-9, -1e-9], [-1e-9, 1e-9]] {
                passed.insert(cell_of([p[0] + off[0], p[1] + off[1]]));
            }
            let differs = |i: usize| {
                let (mut a, mut b) = (*p, *p);
                a[i] -= 2e-6 * found.cell[i];
                b[i] += 2e-6 * found.cell[i];
                at(a) != at(b)
            };
            assert!(differs(0) || differs(1), "{p:?}");
        }
    }
    passed.extend(found.open.iter().map(|[low, high]| cell_of([0, 1].map(|i| 0.5 * low[i] + 0.5 * high[i]))));
    assert!(passed.len() > 100, "{}", passed.len());
    for _ in 0..3000 {
        let p = [r.uniform(0.0, 0.8), r.uniform(0.0, 12.0)];
        let cell = cell_of(p);
        if !passed.contains(&cell) {
            let corner = [0, 1].map(|i| within[i][0] + found.cell[i] * (cell[i] as f64 + r.uniform(0.0, 1.0)));
            assert_eq!(at(p), at(corner), "{p:?} {corner:?}");
        }
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let axes = &["phi0", "phi1", "kappa0", "kappa1"];
    let told = |e: spiral_atlas::Error| e.to_string();
    for (family, axes, flag, what) in [
        ("nothing", &axes[..], "SPIRAL", "nothing"),
        ("cubic", &axes[..3], "SPIRAL", "the axes are phi0, phi1, kappa0; for"),
        ("cubic", &axes[..], "LOOP", "LOOP"),
        ("trig-quintic", &axes[..], "SPIRAL", "trig-quintic"),
    ] {
        assert!(told(Property::new(family, axes, flag).unwrap_err()).contains(what));
    }
    let spiral = Property::new("cubic", axes, "SPIRAL").unwrap();
    // Without a name it is the flag that says yes, where there is one.
    assert_eq!(Property::new("cubic", axes, None::<&str>).unwrap().name(), "SPIRAL");
    let several = Property::new("reach-cubic", &["theta", "xi", "eta"], None::<&str>);
    assert!(told(several.unwrap_err()).contains("name the property, such as CASE1_EXACT or CASE2_EXACT"));
    let point = [0.7, 1.4, 0.4, 4.0];
    // Wide intervals do not spend the work on huge numbers, and huge weights do not overflow.
    assert_eq!(ranges(&spiral, &point, 3, [-1e308, 1e308]).unwrap().ranges.len(), 1);
    assert!(told(nearest(&spiral, &point, &[1e60; 4]).unwrap_err()).contains("1e-50 to 1e50"));
    assert!(told(nearest(&spiral, &[0.7, 1.4, 1e300, 4.0], &[1.0; 4]).unwrap_err()).contains("kappa0 is 1e300"));
    assert!(told(ranges(&spiral, &point, 4, [0.0, 1.0]).unwrap_err()).contains("number 4"));
    assert!(told(ranges(&spiral, &point, 3, [1.0, 1.0]).unwrap_err()).contains("1.0 to 1.0"));
    assert!(told(ranges(&spiral, &point[..3], 2, [0.0, 1.0]).unwrap_err()).contains("is 3; it must be 4"));
    assert!(told(nearest(&spiral, &[f64::NAN, 1.4, 0.4, 4.0], &[1.0; 4]).unwrap_err()).contains("phi0 is NaN"));
    assert!(told(nearest(&spiral, &point, &[1.0, 0.0, 1.0, 1.0]).unwrap_err()).contains("weight of phi1"));
    assert!(told(boundary(&spiral, &point, [2, 2], [[0.0, 1.0]; 2], 64).unwrap_err()).contains("numbers 2 and 2"));
    assert!(
        told(boundary(&spiral, &point, [2, 3], [[0.0, 1.0], [0.0, f64::INFINITY]], 64).unwrap_err()).contains("kappa1")
    );
    assert!(told(boundary(&spiral, &point, [2, 3], [[0.0, 1.0]; 2], 65).unwrap_err()).contains("65"));
}

/// From far out of the region, where a search that only divides boxes finds a far datum or none.
#[test]
fn a_near_datum_is_found_from_far_out() {
    let far = [([1.0, 2.0, -1.0, 5.0], 1.25), ([0.01, 3.0, -5.0, 0.1], 5.75)];
    for (point, most) in far {
        for family in ["cubic", "ph-quintic"] {
            let Asked { property, holds } = asked(family, 0, "SPIRAL");
            let answer = nearest(&property, &point, &[1.0; 4]).unwrap();
            let found = answer.point.as_ref().is_some_and(|found| holds(found));
            assert!(found && answer.distance.is_some_and(|x| x < most), "{family} {point:?}: {answer:?}");
        }
    }
}
