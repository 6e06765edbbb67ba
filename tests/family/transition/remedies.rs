//! What a reason says would help does help, and a little less does not, read off the printed numbers.

use super::sides::ends;
use crate::oracle::random::Random;
use spiral_atlas::family::any_spiral::Split;
use spiral_atlas::transition::{Bound, Ends, NoSpiral, Remedy, Which, Why, involute_between, ph_spiral, spiral};

/// Ends anywhere: `alpha` and `beta` against the chord, curvatures by half of it.
fn anywhere(random: &mut Random, [alpha, beta, k1, k2]: [f64; 4]) -> Ends {
    let (half, chord) = (10f64.powf(random.uniform(-6.0, 9.0)), random.uniform(-3.0, 3.0));
    let start = [random.uniform(-5.0, 5.0) * half, random.uniform(-5.0, 5.0) * half];
    Ends {
        start,
        end: [start[0] + 2.0 * half * chord.cos(), start[1] + 2.0 * half * chord.sin()],
        start_direction: chord + alpha,
        end_direction: chord + beta,
        start_curvature: k1 / half,
        end_curvature: k2 / half,
    }
}

fn with(ends: &Ends, which: Which, curvature: f64) -> Ends {
    match which {
        Which::Start => Ends { start_curvature: curvature, ..*ends },
        Which::End => Ends { end_curvature: curvature, ..*ends },
    }
}

fn any_spiral(ends: &Ends, turns: [u32; 2]) -> bool {
    involute_between(ends, turns).unwrap().0.curve().is_some()
}

/// Of a number of six digits the one that is `units` of the last digit further up.
fn further(x: f64, units: i32) -> f64 {
    let text = format!("{x:.5e}");
    let (digits, power) = text.split_once('e').unwrap();
    let last = (digits.replace('.', "").parse::<f64>().unwrap() + f64::from(units), power.parse::<i32>().unwrap() - 5);
    format!("{}e{}", last.0, last.1).parse().unwrap()
}

/// The number that a sentence has after some words.
fn number_after(text: &str, words: &str) -> f64 {
    let at = text.find(words).unwrap_or_else(|| panic!("{words}: {text}")) + words.len();
    let number = text[at..].split([' ', ',', ')']).next().unwrap_or_default();
    number.parse().unwrap_or_else(|_| panic!("{number}: {text}"))
}

#[test]
fn curvatures_past_the_printed_bound_give_a_spiral() {
    let mut random = Random(41);
    let mut seen = std::collections::BTreeMap::new();
    for _ in 0..20_000 {
        let angles = [random.uniform(-3.1, 3.1), random.uniform(-3.1, 3.1)];
        let curvatures = [random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)];
        let ends = anywhere(&mut random, [angles[0], angles[1], curvatures[0], curvatures[1]]);
        let rising = ends.start_curvature < ends.end_curvature;
        let Some(none) = NoSpiral::of(&ends).unwrap() else {
            assert!(any_spiral(&ends, [0, 0]), "{ends:?}");
            continue;
        };
        assert!(!any_spiral(&ends, [0, 0]), "{none}: {ends:?}");
        let text = none.to_string();
        let kind = match &none {
            NoSpiral::EqualCurvatures { .. } => panic!("{ends:?}"),
            NoSpiral::WrongSide { turns, .. } => {
                // Advised is what the involute does.
                let (found, _) = involute_between(&ends, turns.unwrap_or([0, 1])).unwrap();
                let asked = found.outcome.as_ref().is_ok_and(|image| image.split == Split::Asked);
                assert_eq!((found.curve().is_some(), asked), (turns.is_some(), turns.is_some()), "{none}: {ends:?}");
                let [start, end] = turns.unwrap_or([0, 0]);
                assert_eq!(text.contains(&format!("--turns {start},{end}`")), turns.is_some(), "{none}");
                *seen.entry(format!("turns {start},{end}")).or_insert(0) += 1;
                "side"
            }
            NoSpiral::CirclesCross { needs, alone } => {
                assert!(needs.len() == if *alone { needs.len().clamp(1, 2) } else { 2 }, "{needs:?}");
                let mut both = ends;
                for need in needs {
                    let (verb, sign) = if matches!(need.bound, Bound::Above(_)) { ("above", 1) } else { ("below", -1) };
                    let must = if *alone { " must be" } else { "" };
                    let words = format!("the {} curvature {:?}{must} {verb} ", need.which, need.curvature);
                    let told = number_after(&text, &words);
                    assert!((told / need.bound.value() - 1.0).abs() < 2e-5, "{need:?}: {text}");
                    if *alone {
                        let (more, less) = (further(told, sign), further(told, -2 * sign));
                        assert!(any_spiral(&with(&ends, need.which, more), [0, 0]), "{more}: {text}: {ends:?}");
                        assert!(!any_spiral(&with(&ends, need.which, less), [0, 0]), "{less}: {text}: {ends:?}");
                        *seen.entry(format!("{} {verb}", need.which)).or_insert(0) += 1;
                    }
                    both = with(&both, need.which, further(told, sign));
                }
                assert!(any_spiral(&both, [0, 0]), "{text}: {ends:?}");
                if *alone { "one" } else { "both" }
            }
        };
        *seen.entry(format!("{kind} {}", if rising { "rising" } else { "falling" })).or_insert(0) += 1;
    }
    assert!(seen.len() == 13 && seen.values().all(|n| *n >= 50), "{seen:?}");
}

/// The bound of some spiral of any kind, at which curvatures instead are measured: where the circles of curvature
/// touch.
fn bound(ends: &Ends, which: Which) -> f64 {
    let chord = [ends.end[0] - ends.start[0], ends.end[1] - ends.start[1]];
    let (half, along) = (0.5 * chord[0].hypot(chord[1]), chord[1].atan2(chord[0]));
    let sign = if ends.start_curvature < ends.end_curvature { 1.0 } else { -1.0 };
    let [alpha, beta] = [ends.start_direction, ends.end_direction].map(|d| sign * (d - along));
    let [k1, k2] = [ends.start_curvature, ends.end_curvature].map(|k| sign * k * half);
    let [alpha, beta] = [alpha, beta].map(|a| a.sin().atan2(a.cos()));
    let product = (0.5 * (alpha + beta)).sin().powi(2);
    let frame = match which {
        Which::Start => -alpha.sin() - product / (k2 - beta.sin()),
        Which::End => beta.sin() + product / (k1 + alpha.sin()).abs(),
    };
    sign * frame / half
}

/// Checks what would help against the family's own verdict; how many of them.
fn check(ends: &Ends, remedies: &[Remedy], text: &str, exists: impl Fn(&Ends) -> bool) -> usize {
    for remedy in remedies {
        let Remedy { which, curvature, instead } = *remedy;
        let words = format!(" in place of the {which} curvature {curvature:?}");
        let at = text.find(&words).unwrap_or_else(|| panic!("{words}: {text}"));
        let told: f64 = text[..at].rsplit(' ').next().unwrap().parse().unwrap();
        assert!(told == instead && exists(&with(ends, which, told)), "{told} {instead}: {text}: {ends:?}");
        // It is given by its distance from the bound, as a power of 2 in steps of 1/256; the step before was tried.
        let bound = bound(ends, which);
        let power = ((instead - bound) / (curvature - bound)).log2();
        let before = bound + (curvature - bound) * (((256.0 * power).round() - power.signum()) / 256.0).exp2();
        let six: f64 = format!("{before:.5e}").parse().unwrap();
        // Six digits must tell one step from the next by far.
        if (before - instead).abs() > 1e-3 * instead.abs() {
            assert!(!exists(&with(ends, which, six)), "{six}, {power} {bound}, {instead}: {text}: {ends:?}");
        }
    }
    remedies.len()
}

#[test]
fn curvatures_named_instead_give_a_spiral() {
    let mut random = Random(42);
    let (mut cubic, mut ph) = ([0, 0], [0, 0]);
    for n in 0..400 {
        let phi0 = random.uniform(0.05, 1.3);
        let phi1 = random.uniform(phi0, 1.6);
        let kappa0 = phi0.sin() * random.uniform(0.05, 0.95);
        let kappa1 = phi1.sin() * (1.0 + random.uniform(0.0, 6.0).exp2());
        let half = 10f64.powf(random.uniform(-6.0, 9.0));
        let ends = ends([phi0, phi1, kappa0, kappa1], random.uniform(-3.0, 3.0), half, n % 2 == 1, n % 4 > 1);
        let has = |ends: &Ends| spiral(ends).unwrap().chosen().is_some();
        let found = spiral(&ends).unwrap().with_remedies().unwrap();
        if let Err(why @ (Why::NoRoot { remedies, .. } | Why::NotMonotone { remedies, .. })) = &found.outcome {
            cubic[0] += 1;
            cubic[1] += usize::from(check(&ends, remedies, &why.to_string(), has) > 0);
        }
        if n % 4 != n / 4 % 4 {
            continue;
        }
        let has = |ends: &Ends| ph_spiral(ends).unwrap().chosen().is_some();
        let found = ph_spiral(&ends).unwrap().with_remedies().unwrap();
        if let Err(why @ (Why::NoPhQuintic { remedies } | Why::NoPhSpiral { remedies, .. })) = &found.outcome {
            ph[0] += 1;
            ph[1] += usize::from(check(&ends, remedies, &why.to_string(), has) > 0);
        }
    }
    // One curvature alone cannot always help.
    assert!(cubic[0] > 50 && ph[0] > 10 && 3 * cubic[1] > cubic[0] && 3 * ph[1] > ph[0], "{cubic:?} {ph:?}");
}
