//! What is asked for is what is least: no answer is beaten by the answer to another objective.

use super::check::check;
use super::{FAMILIES, Random};
use spiral_atlas::transition::join::{Join, Objective, Request, join};

const OBJECTIVES: [Objective; 4] =
    [Objective::Length, Objective::GreatestCurvature, Objective::GreatestRate, Objective::BendingEnergy];

fn value(join: &Join, objective: Objective) -> f64 {
    let m = &join.measures;
    match objective {
        Objective::Length => m.length,
        Objective::GreatestCurvature => m.greatest_curvature,
        Objective::GreatestRate => m.greatest_rate(),
        Objective::BendingEnergy => m.bending_energy,
    }
}

/// Asks for each objective, checks the answers, and compares them.
fn compare(asked: &Request) {
    let answers = OBJECTIVES.map(|objective| {
        let request = Request { objective, ..*asked };
        let answer = join(&request).unwrap().ok();
        if let Some(answer) = &answer {
            check(&request, answer).unwrap_or_else(|e| panic!("{request:?}: {e}"));
        }
        answer
    });
    for (objective, answer) in OBJECTIVES.into_iter().zip(&answers) {
        for (other, by_other) in OBJECTIVES.into_iter().zip(&answers) {
            let values = [answer, by_other].map(|join| join.as_ref().map(|join| value(join, objective)));
            let [Some(value), Some(by_other)] = values else {
                assert_eq!(values, [None, None], "{asked:?}");
                continue;
            };
            assert!(value <= by_other * (1.0 + 1e-9), "{asked:?}: {objective:?} is {value}, {by_other} of {other:?}");
        }
    }
}

#[test]
fn no_answer_is_beaten_by_that_to_another_objective() {
    let mut random = Random(21);
    for (family, count) in FAMILIES.into_iter().zip([600, 200, 30, 60, 600]) {
        for _ in 0..count {
            let size = [3.0, 10.0, 30.0][(3.0 * random.next()) as usize];
            let (from, to) = (random.state(size), random.state(size));
            compare(&Request { family, ..Request::new(from, to, 1.0) });
        }
    }
}

/// Of lines and circles neither, with a bound on length or without.
#[test]
fn none_is_beaten_between_lines_and_circles() {
    let mut random = Random(22);
    for (family, count) in FAMILIES.into_iter().zip([400, 200, 12, 60, 400]) {
        for _ in 0..count {
            let size = [1.0, 10.0, 100.0][(3.0 * random.next()) as usize];
            let (from, to) = (random.shape(size), random.shape(size));
            let longest = [f64::INFINITY, 30.0 * size][(2.0 * random.next()) as usize];
            compare(&Request { family, longest, ..Request::new(from, to, 1.0) });
        }
    }
}
