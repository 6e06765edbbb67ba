//! Separation of two motions.

use super::*;
use spiral_atlas::curve::{EqualLength, equal_length};
use spiral_atlas::path::{Closest, Motion, Separation, Verdict, separation, separations, spline};

fn line(from: [f64; 2], to: [f64; 2]) -> Vec<PhQuintic> {
    spline(&[from, to], false).unwrap().spans
}

fn path(row: &Value, length: f64) -> PhQuintic {
    let ends = EqualLength {
        start: point(&row[0]),
        end: point(&row[1]),
        start_direction: number(&row[2]),
        end_direction: number(&row[3]),
        length,
    };
    let choice = equal_length(&ends).unwrap();
    choice.candidates[EqualLength::paper(&choice)].curve
}

fn enclosed(found: &Separation, least: f64, tolerance: f64) -> bool {
    let closest = found.closest;
    closest.at_least <= least + tolerance
        && least - tolerance <= closest.at_most
        && closest.at_most - closest.at_least < tolerance
}

#[test]
fn published_closest_approaches() {
    let all = published("separation");
    let cases = all["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 8);
    for case in cases {
        let motion = |path_key: &str, length_key: &str| {
            let length = number(&case[length_key]);
            Motion::new(vec![path(&case[path_key], length)], 1.0, 0.0).unwrap()
        };
        let (a, b) = (motion("A", "SA"), motion("B", "SB"));
        let least = number(&case["min"]);
        let found = separation(&a, &b, least).unwrap();
        assert!(enclosed(&found, least, 1e-8), "{found:?} {least}");
        assert!((found.closest.time - number(&case["s_at_min"])).abs() < 1e-4, "{found:?} {case}");
        // A hair to either side is decided.
        let verdict = |minimum: f64| separation(&a, &b, minimum).unwrap().verdict;
        assert_eq!(
            (verdict(least * (1.0 - 1e-9)), verdict(least * (1.0 + 1e-9))),
            (Verdict::Yes, Verdict::No),
            "{case}"
        );
        assert!(!enclosed(&found, least * 1.001 + 1e-6, 1e-8));
    }
}

/// Where a curve is after a length, by a fine polygon.
pub(crate) struct Polygon(Vec<(f64, [f64; 2])>);

/// Points of a part of a path in between, both ends included.
const FINE: i32 = 4000;

impl Polygon {
    /// On the Bézier form.
    fn new(spans: &[PhQuintic]) -> Polygon {
        Polygon::through(
            spans.iter().flat_map(|span| (0..=FINE).map(|i| bezier(span, f64::from(i) / f64::from(FINE)).point)),
        )
    }

    pub(crate) fn through(points: impl IntoIterator<Item = [f64; 2]>) -> Polygon {
        let (mut all, mut length) = (vec![], 0.0);
        for p in points {
            let last = all.last().map_or(p, |(_, p): &(f64, [f64; 2])| *p);
            length += (p[0] - last[0]).hypot(p[1] - last[1]);
            all.push((length, p));
        }
        Polygon(all)
    }

    fn at(&self, s: f64) -> [f64; 2] {
        let i = self.0.partition_point(|(l, _)| *l < s).clamp(1, self.0.len() - 1);
        let ((s0, p0), (s1, p1)) = (self.0[i - 1], self.0[i]);
        let share = if s1 > s0 { ((s - s0) / (s1 - s0)).clamp(0.0, 1.0) } else { 0.0 };
        [p0[0] + share * (p1[0] - p0[0]), p0[1] + share * (p1[1] - p0[1])]
    }
}

/// The closest approach, which samples confirm; one starts at time 0.
pub(crate) fn sampled([a, b]: [&Motion; 2], [p, q]: [&Polygon; 2], [v1, v2, t2]: [f64; 3]) -> Closest {
    // Before its start and after its arrival a polygon stays at its ends.
    let events = [a.times(), b.times()].concat();
    let (from, to) = (events[0].min(events[2]), events[1].max(events[3]));
    let gap = |t: f64| {
        let (p, q) = (p.at(v1 * t), q.at(v2 * (t - t2)));
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    let n = 20_000;
    let least = (0..=n).map(|k| gap(from + (to - from) * f64::from(k) / f64::from(n))).fold(f64::INFINITY, f64::min);
    let found = separation(a, b, 0.0).unwrap();
    let closest = found.closest;
    // Samples lie `2 (to - from) / n` apart at worst; the polygon is short by 1e-6 or so.
    assert!(closest.at_least <= least + 2e-5 && least <= closest.at_most + 1e-3, "{least} {closest:?}");
    assert!(
        closest.at_most - closest.at_least <= 1e-8 && (gap(closest.time) - closest.at_most).abs() < 2e-5,
        "{closest:?}"
    );
    closest
}

#[test]
fn random_motions_agree_with_dense_sampling() {
    let mut noise = Noise(21);
    let mut ends = 0;
    for i in 0..40 {
        let mut spans = || match i % 2 {
            0 => vec![PhQuintic::new(noise.point(), [noise.point(), noise.point(), noise.point()])],
            _ => {
                spline(&[0.0, 1.0, 2.0, 3.0, 4.0].map(|x| [x + 0.3 * noise.next(), noise.next()]), false).unwrap().spans
            }
        };
        let (one, two) = (spans(), spans());
        let (v1, v2, t2) = (1.0 + 0.5 * noise.next(), 1.0 + 0.5 * noise.next(), 0.1 * noise.next());
        let (a, b) = (Motion::new(one.clone(), v1, 0.0).unwrap(), Motion::new(two.clone(), v2, t2).unwrap());
        let closest = sampled([&a, &b], [&Polygon::new(&one), &Polygon::new(&two)], [v1, v2, t2]);
        let events = [a.times(), b.times()].concat();
        ends += usize::from(events.contains(&closest.time));
    }
    assert!(ends > 2 && ends < 35);
}

#[test]
fn samples_that_miss_the_meeting_fool_nobody() {
    // Both cross the origin, fast, one a little later: 1e-4 apart, for some 1e-7 of the time.
    let late = 1e-4 * 2f64.sqrt();
    let a = Motion::new(line([-1000.0, 0.0], [1000.0, 0.0]), 1.0, 0.0).unwrap();
    let b = Motion::new(line([0.0, -777.0], [0.0, 1111.0]), 1.0, 223.0 + late).unwrap();
    let sampled = |t: f64| (t - 1000.0).hypot(t - 1000.0 - late);
    assert!((0..1000).map(|k| sampled(f64::from(k) * 1.9997)).all(|d| d > 0.05));
    let verdict = |minimum: f64| separation(&a, &b, minimum).unwrap();
    assert!(enclosed(&verdict(1e-4), 1e-4, 1e-6), "{:?}", verdict(1e-4));
    assert_eq!((verdict(1.001e-4).verdict, verdict(0.999e-4).verdict), (Verdict::No, Verdict::Yes));
    // Dead on time: they meet, which keeps no distance at all.
    let b = Motion::new(line([0.0, -777.0], [0.0, 1111.0]), 1.0, 223.0).unwrap();
    let met = separation(&a, &b, 1e-9).unwrap();
    assert!(met.verdict == Verdict::No && met.closest.at_least == 0.0);
}

#[test]
fn moving_in_step_and_behind_each_other() {
    let a = Motion::new(line([0.0, 0.0], [10.0, 0.0]), 2.0, 0.0).unwrap();
    let beside = Motion::new(line([0.0, 1.0], [10.0, 1.0]), 2.0, 0.0).unwrap();
    let verdict = |b: &Motion, minimum: f64| separation(&a, b, minimum).unwrap().verdict;
    assert_eq!((verdict(&beside, 1.0 - 1e-9), verdict(&beside, 1.0 + 1e-9)), (Verdict::Yes, Verdict::No));
    // Exactly the minimum: doubles cannot decide, and it says so.
    assert_eq!(verdict(&beside, 1.0), Verdict::Undecided);
    // The same path half a unit of time later: it waits where the other one starts.
    let behind = Motion::new(line([0.0, 0.0], [10.0, 0.0]), 2.0, 0.5).unwrap();
    assert_eq!((verdict(&behind, 1e-9), verdict(&behind, 0.0)), (Verdict::No, Verdict::Yes));
    let behind = Motion::new(line([-1.0, 0.0], [9.0, 0.0]), 2.0, 0.0).unwrap();
    assert_eq!((verdict(&behind, 0.999_999), verdict(&behind, 1.000_001)), (Verdict::Yes, Verdict::No));
    // The same motion.
    assert_eq!((verdict(&a.clone(), 1e-6), verdict(&a.clone(), 0.0)), (Verdict::No, Verdict::Yes));
    // One moment in common.
    let relay = Motion::new(line([13.0, 4.0], [20.0, 0.0]), 2.0, 5.0).unwrap();
    let found = separation(&a, &relay, 4.9).unwrap();
    assert!(found.verdict == Verdict::Yes && enclosed(&found, 5.0, 1e-11), "{found:?}");
    // Bent curves in step.
    let bent = PhQuintic::new([0.0, 0.0], [[1.0, 0.0], [1.0, 0.7], [0.5, 1.0]]);
    let moved = PhQuintic::new([0.3, 0.4], bent.preimage);
    let pair = [bent, moved].map(|c| Motion::new(vec![c], 1.0, 0.0).unwrap());
    let found = separation(&pair[0], &pair[1], 0.5 - 1e-8).unwrap();
    assert!(found.verdict == Verdict::Yes && enclosed(&found, 0.5, 1e-8), "{found:?}");
}

#[test]
fn vehicles_that_wait_or_have_arrived_are_in_the_way() {
    let a = Motion::new(line([0.0, 0.0], [10.0, 0.0]), 2.0, 0.0).unwrap();
    let found = |from: [f64; 2], to: [f64; 2], start: f64| {
        let b = Motion::new(line(from, to), 1.0, start).unwrap();
        let found = [separation(&a, &b, 0.3).unwrap(), separation(&b, &a, 0.3).unwrap()];
        assert!(
            (found[0].closest.at_most - found[1].closest.at_most).abs() < 1e-9 && found[0].verdict == found[1].verdict
        );
        found[0]
    };
    // It waits 0.1 beside the way, 7 from its start; it leaves before the other comes; it has arrived there; it is not
    // there yet.
    let waits = found([7.0, 0.1], [7.0, 5.0], 100.0);
    assert!(
        waits.verdict == Verdict::No && enclosed(&waits, 0.1, 1e-8) && (waits.closest.time - 3.5).abs() < 1e-3,
        "{waits:?}"
    );
    let leaves = found([7.0, 0.1], [7.0, 5.0], -10.0);
    assert!(leaves.verdict == Verdict::Yes && enclosed(&leaves, 5.0, 1e-7), "{leaves:?}");
    let arrived = found([7.0, 5.0], [7.0, 0.1], -100.0);
    assert!(arrived.verdict == Verdict::No && enclosed(&arrived, 0.1, 1e-8), "{arrived:?}");
    let late = found([7.0, 5.0], [7.0, 0.1], 100.0);
    assert!(late.verdict == Verdict::Yes && enclosed(&late, (3f64 * 3.0 + 0.1 * 0.1).sqrt(), 1e-8), "{late:?}");
    // Neither moves while the other does: the nearest is where one stood and the other one stands.
    let relay = found([10.0, 0.25], [20.0, 0.25], 5.1);
    assert!(relay.verdict == Verdict::No && enclosed(&relay, 0.25, 1e-8), "{relay:?}");
    let apart = found([10.0, 4.0], [20.0, 4.0], 5.1);
    assert!(
        apart.verdict == Verdict::Yes && enclosed(&apart, 4.0, 1e-8) && !enclosed(&apart, 4.001, 1e-8),
        "{apart:?}"
    );
    // A corner on its way does not matter to one that stands.
    let corner = [line([7.0, 1.0], [7.0, 2.0]), line([7.0, 2.0], [9.0, 2.0])].concat();
    let b = Motion::new(corner, 1.0, 50.0).unwrap();
    let found = separation(&a, &b, 0.9999).unwrap();
    assert!(found.verdict == Verdict::Yes && enclosed(&found, 1.0, 1e-8), "{found:?}");
}

#[test]
fn curves_that_stand_still_and_corners_are_bounded_by_speed() {
    let cusp = PhQuintic::new([0.0, 0.0], [[-0.5, 0.0], [0.0, -0.25], [0.5, 0.5]]);
    let a = Motion::new(vec![cusp], 1.0, 0.0).unwrap();
    let b = Motion::new(line([1.0, 1.0], [2.0, 1.0]), 1.0, 0.0).unwrap();
    assert_ne!(separation(&a, &b, 0.5).unwrap().verdict, Verdict::Undecided);
    let corner = [line([0.0, 0.0], [1.0, 0.0]), line([1.0, 0.0], [1.0, 1.0])].concat();
    let a = Motion::new(corner, 1.0, 0.0).unwrap();
    let b = Motion::new(line([2.0, 0.0], [0.0, 0.0]), 1.0, 0.0).unwrap();
    let found = separation(&a, &b, 1e-3).unwrap();
    assert!(found.verdict == Verdict::No && found.closest.at_most < 1e-7, "{found:?}");
}

#[test]
fn motions_that_make_no_sense_are_named() {
    let says = |spans: Vec<PhQuintic>, speed: f64, start: f64, parts: &[&str]| {
        let error = Motion::new(spans, speed, start).unwrap_err().to_string();
        assert!(parts.iter().all(|p| error.contains(p)), "{error}");
    };
    let fine = || line([0.0, 0.0], [1.0, 0.0]);
    says(fine(), 0.0, 0.0, &["`speed` is 0;"]);
    says(fine(), -1.0, 0.0, &["`speed` is -1;"]);
    says(fine(), f64::NAN, 0.0, &["`speed`", "NaN"]);
    says(fine(), 1.0, f64::INFINITY, &["`start_time`", "inf"]);
    says(vec![], 1.0, 0.0, &["`pieces` is empty"]);
    says(
        vec![PhQuintic::new([0.0, 0.0], [[0.0; 2]; 3])],
        1.0,
        0.0,
        &["pieces[0] is 0.0 long", "change the unit of length"],
    );
    says([fine(), line([1.0, 1e-9], [2.0, 0.0])].concat(), 1.0, 0.0, &["pieces[0] ends at [1.0, 0.0]", "[1.0, 1e-9]"]);
    // It is never under way, or no number says when it arrives.
    says(fine(), 1.0, 1e200, &["from time 1e200 to 1e200", "change the unit of time"]);
    says(fine(), 1e-200, 0.0, &["to 1e200", "`speed` 1e-200"]);
    says(fine(), 1e-320, 0.0, &["to inf"]);
    let a = Motion::new(fine(), 1.0, 0.0).unwrap();
    assert!(separation(&a, &a, -1.0).unwrap_err().to_string().contains("`minimum` is -1;"));
    assert!(separation(&a, &a, f64::NAN).is_err());
    assert_eq!(
        separations(&[a.clone(), a.clone(), a], 0.0).unwrap().iter().map(|p| (p.0, p.1)).collect::<Vec<_>>(),
        [(0, 1), (0, 2), (1, 2)]
    );
}
