//! Ends that hardly turn: changes of lanes, and roads that are nearly straight.

use super::check::check;
use super::{FAMILIES, Random, found, state};
use spiral_atlas::transition::join::Request;

/// The path between states that lie nearly ahead of each other is hardly longer than the straight line, whatever the
/// limit of curvature has room for.
#[test]
fn what_hardly_turns_is_hardly_longer() {
    let mut random = Random(11);
    for (family, count) in FAMILIES.into_iter().zip([1000, 1000, 200, 1000, 1000]) {
        let mut worst = 0.0f64;
        for i in 0..count {
            let apart = [1000.0, 100.0][i % 2];
            let limit = 0.01 * 20f64.powf(random.next());
            let mut small = |most: f64| most * random.between(-1.0, 1.0) * 10f64.powf(random.between(-6.0, 0.0));
            let [aside, from, to] = [small(0.05 * apart), small(0.05), small(0.05)];
            let request =
                Request { family, ..Request::new(state(0.0, 0.0, from, 0.0), state(apart, aside, to, 0.0), limit) };
            let join = found(&request);
            check(&request, &join).unwrap_or_else(|e| panic!("{request:?}: {e}: {join:?}"));
            let ratio = join.measures.length / apart.hypot(aside);
            worst = worst.max(ratio);
        }
        println!("{family:?}: {worst}");
        assert!(worst < 1.001, "{family:?}: {worst}");
    }
}
