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

#[test]
fn no_answer_is_beaten_by_that_to_another_objective() {
    let mut random = Random(21);
    for (family, count) in FAMILIES.into_iter().zip([600, 200, 30, 60, 600]) {
        for _ in 0..count {
            let size = [3.0, 10.0, 30.0][(3.0 * random.next()) as usize];
            let (from, to) = (random.state(size), random.state(size));
            let answers = OBJECTIVES.map(|objective| {
                let request = Request { family, objective, ..Request::new(from, to, 1.0) };
                let answer = join(&request).unwrap().ok();
                if let Some(answer) = &answer {
                    check(&request, answer).unwrap_or_else(|e| panic!("{request:?}: {e}"));
                }
                answer
            });
            for (objective, answer) in OBJECTIVES.into_iter().zip(&answers) {
                for (asked, other) in OBJECTIVES.into_iter().zip(&answers) {
                    let values = [answer, other].map(|join| join.as_ref().map(|join| value(join, objective)));
                    let [Some(value), Some(other)] = values else {
                        assert_eq!(values, [None, None], "{family:?} from {from:?} to {to:?}");
                        continue;
                    };
                    assert!(
                        value <= other * (1.0 + 1e-9),
                        "{family:?} from {from:?} to {to:?}: {objective:?} is {value}, {other} of {asked:?}"
                    );
                }
            }
        }
    }
}
