//! Joins, checked from the numbers that are printed by code that does not know how they were made.

mod check;
mod corner;
mod dubins;
mod gentle;
#[cfg(feature = "export")]
mod lattice;
mod objectives;
mod shapes;

use check::{Checked, check};
use spiral_atlas::transition::join::{Family, Join, Objective, Request, State, join};
use std::f64::consts::{FRAC_PI_2, PI};

const FAMILIES: [Family; 5] =
    [Family::Cubic, Family::PhQuintic, Family::Involute, Family::TrigQuintic, Family::Clothoid];

/// Uniform numbers in [0, 1), the same each time (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A multiple of a number, from -2 to 2 times, or something at a distance from one of 1e-17 to 1.
    fn near_multiple(&mut self, whole: f64) -> f64 {
        let off = 10f64.powf(self.between(-17.0, 0.0)) * self.between(-1.0, 1.0);
        whole * (self.between(-2.0, 3.0).floor()) + if self.next() < 0.5 { off } else { 0.0 }
    }

    fn state(&mut self, size: f64) -> State {
        let mut place = || size * self.between(-0.5, 0.5);
        let point = [place(), place()];
        State { point, direction: self.between(-PI, PI), curvature: self.between(-1.0, 1.0) }
    }
}

fn state(x: f64, y: f64, direction: f64, curvature: f64) -> State {
    State { point: [x, y], direction, curvature }
}

fn found(request: &Request) -> Join {
    match join(request).unwrap() {
        Ok(join) => join,
        Err(why) => panic!("{request:?}: {why}"),
    }
}

/// Every pair within 10 least radii is joined; a join is hardly longer than the shortest path without spirals, and
/// never shorter.
#[test]
fn random_states_are_joined() {
    let mut random = Random(1);
    for (family, count) in FAMILIES.into_iter().zip([2000, 500, 200, 500, 2000]) {
        let (mut joined, mut ratios) = (0, Vec::new());
        for _ in 0..count {
            let (from, to) = (random.state(10.0), random.state(10.0));
            let request = Request { family, ..Request::new(from, to, 1.0) };
            let Ok(join) = join(&request).unwrap() else { continue };
            joined += 1;
            let Checked { length, .. } = check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}"));
            let least = dubins::length(&from, &to, 1.0);
            assert!(length >= least * (1.0 - 1e-12), "{request:?}: {length} is below {least}");
            ratios.push(length / least);
        }
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[(share * (ratios.len() - 1) as f64) as usize];
        println!(
            "{family:?}: {joined} of {count}; over Dubins: median {}, 90 % {}, 99 % {}",
            at(0.5),
            at(0.9),
            at(0.99)
        );
        assert!(joined * 1000 >= count * 995, "{family:?}: {joined} of {count}");
        // Trigonometric spirals are long for what they turn.
        let most = if family == Family::TrigQuintic { 1.7 } else { 1.2 };
        assert!(at(0.5) < most, "{family:?}: {}", at(0.5));
    }
}

/// Joins do not care for the unit of length, nor for the place.
#[test]
fn units_and_places_do_not_matter() {
    let (from, to) = (state(0.0, 0.0, 0.3, 0.5), state(4.0, -3.0, 2.0, -0.25));
    let one = found(&Request::new(from, to, 1.0));
    for power in [-20, -7, 9, 30] {
        let unit = 2f64.powi(power);
        let sized = |s: State| State { point: s.point.map(|x| x * unit), curvature: s.curvature / unit, ..s };
        let request = Request::new(sized(from), sized(to), 1.0 / unit);
        let join = found(&request);
        check(&request, &join).unwrap();
        assert!((join.measures.length / unit - one.measures.length).abs() < 1e-12 * one.measures.length);
        assert_eq!(join.pieces.len(), one.pieces.len());
    }
}

#[test]
fn degenerate_states() {
    let cases = [
        (state(0.0, 0.0, 0.0, 0.0), state(5.0, 0.0, 0.0, 0.0)),
        (state(0.0, 0.0, 0.0, 0.0), state(5.0, 0.0, PI, 0.0)),
        (state(0.0, 0.0, 0.0, 0.0), state(0.0, 0.0, PI, 0.0)),
        (state(0.0, 0.0, 0.0, 1.0), state(0.0, 0.0, 0.0, -1.0)),
        (state(0.0, 0.0, 0.0, 1.0), state(0.0, 2.0, PI, 1.0)),
        (state(0.0, 0.0, 0.0, 0.5), state(2.0, 2.0, FRAC_PI_2, 0.5)),
        (state(0.0, 0.0, 0.0, 1e-20), state(3.0, 4.0, 1.0, -1e-9)),
        (state(0.0, 0.0, 0.0, 0.999_999), state(0.0, 1e-3, 0.0, 1.0)),
        (state(0.0, 0.0, -PI, 0.0), state(1e-9, 0.0, PI, 0.0)),
        (state(0.0, 0.0, 7.0 * PI, 0.5), state(1e6, 0.0, -5.0, 0.5)),
    ];
    for family in FAMILIES {
        for (from, to) in cases {
            let request = Request { family, ..Request::new(from, to, 1.0) };
            check(&request, &found(&request)).unwrap_or_else(|e| panic!("{request:?}: {e}"));
        }
    }
    let line = found(&Request::new(cases[0].0, cases[0].1, 1.0));
    assert_eq!((line.pieces.len(), line.measures.length), (1, 5.0));
    let arc = found(&Request::new(cases[4].0, cases[4].1, 1.0));
    assert!(arc.pieces.len() == 1 && (arc.measures.length - PI).abs() < 1e-15);
}

/// Two straight roads with a given place to leave each: two spirals, though the legs to the corner are unequal.
#[test]
fn corners_with_unequal_legs() {
    for family in FAMILIES {
        for degrees in [1.0f64, 30.0, 60.0, 100.0, -60.0, -120.0] {
            for leg in [100.0, 105.0, 120.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let (from, to) =
                    (state(0.0, 0.0, 0.0, 0.0), state(100.0 + leg * cos, leg * sin, degrees.to_radians(), 0.0));
                let request = Request { family, most_pieces: 2, ..Request::new(from, to, 0.1) };
                let join = found(&request);
                check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}"));
                assert_eq!(join.pieces.len(), 2);
            }
        }
    }
}

#[test]
fn objectives_and_bounds() {
    let (from, to) = (state(0.0, 0.0, 0.0, 0.0), state(9.0, 5.0, 1.0, 0.0));
    let of = |objective| {
        let request = Request { objective, ..Request::new(from, to, 1.0) };
        let join = found(&request);
        check(&request, &join).unwrap();
        join.measures
    };
    let shortest = of(Objective::Length);
    assert!(of(Objective::GreatestCurvature).greatest_curvature < 0.5 * shortest.greatest_curvature);
    assert!(of(Objective::GreatestRate).greatest_rate() < 0.5 * shortest.greatest_rate());
    assert!(of(Objective::BendingEnergy).bending_energy < shortest.bending_energy);
    let bound = Request { longest: shortest.length * 0.9, ..Request::new(from, to, 1.0) };
    let Err(why) = join(&bound).unwrap() else { panic!("too long") };
    assert!(why.contains("keeps to a length of 9.34"), "{why}");
    let few = Request { most_pieces: 1, ..Request::new(from, to, 1.0) };
    assert!(join(&few).unwrap().is_err());
}

#[test]
fn hostile_numbers_are_refused_by_name() {
    let fine = state(0.0, 0.0, 0.0, 0.0);
    let says = |from, to, limit, what: &str| {
        let e = join(&Request::new(from, to, limit)).unwrap_err().to_string();
        assert!(e.contains(what), "{e}");
    };
    says(state(f64::NAN, 0.0, 0.0, 0.0), fine, 1.0, "start x is NaN");
    says(fine, state(0.0, 0.0, f64::INFINITY, 0.0), 1.0, "end direction is inf");
    says(fine, fine, 0.0, "the greatest curvature is 0;");
    says(fine, fine, f64::NAN, "the greatest curvature is NaN");
    let beyond = join(&Request::new(state(0.0, 0.0, 0.0, 2.0), fine, 1.0)).unwrap();
    assert!(matches!(beyond, Err(why) if why.contains("start curvature 2.0")));
    for (x, limit) in [(1e300, 1e300), (1e300, 1.0), (5e-324, 1e-300), (1e-300, 1e300)] {
        // An answer or an error, and no panic.
        let _ = join(&Request::new(fine, state(x, 0.0, 1.0, 0.0), limit));
    }
}

/// Sizes from 1e-6 to 1e9, ends that are degenerate or nearly so: what is found is right.
#[test]
fn nearly_degenerate_states_of_all_sizes() {
    let mut random = Random(5);
    for (family, count) in FAMILIES.into_iter().zip([1500, 400, 60, 300, 1500]) {
        let mut joined = 0;
        for _ in 0..count {
            let limit = 10f64.powf(random.between(-9.0, 6.0));
            let mut near = |whole: f64| random.near_multiple(whole);
            let mut state = || {
                let point = [near(2.0), near(2.0)].map(|x| x / limit);
                State { point, direction: near(FRAC_PI_2), curvature: near(0.5).clamp(-1.0, 1.0) * limit }
            };
            let request = Request { family, ..Request::new(state(), state(), limit) };
            if let Ok(join) = join(&request).unwrap() {
                joined += 1;
                check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
            }
        }
        println!("{family:?}: {joined} of {count}");
        assert!(joined * 100 >= count * 99, "{family:?}: {joined} of {count}");
    }
}

/// The checker sees what is wrong.
#[test]
fn the_checker_can_fail() {
    let (from, to) = (state(0.0, 0.0, 0.3, 0.5), state(4.0, -3.0, 2.0, -0.25));
    let request = Request::new(from, to, 1.0);
    let good = found(&request);
    assert!(check(&request, &good).is_ok());
    assert!(check(&Request { greatest_curvature: 0.1, ..request }, &good).unwrap_err().contains("limit"));
    let mut short = good.clone();
    short.pieces.pop();
    assert!(check(&request, &short).unwrap_err().contains("end"));
    let mut gap = good.clone();
    gap.pieces.remove(1);
    assert!(check(&request, &gap).unwrap_err().contains("joint"));
    let other = Request { from: State { direction: 0.3 + 1e-9, ..from }.into(), ..request };
    assert!(check(&other, &good).unwrap_err().contains("start"));
}

#[test]
fn objectives_have_the_names_of_json() {
    for objective in Objective::ALL {
        assert_eq!(serde_json::to_value(objective).unwrap(), objective.name());
        assert_eq!(Objective::by_name(objective.name()).unwrap(), objective);
    }
    assert!(Objective::by_name("beauty").is_err());
}
