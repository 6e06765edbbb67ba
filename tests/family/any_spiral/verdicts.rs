//! Flags against the oracle: random data, both sides of boundaries, degenerate and extreme data.

use super::judge::judge;
use super::{Datum, Random, codes_of};
use spiral_atlas::family::any_spiral::{EXISTS, INFLECTION, RISING};
use spiral_atlas::family::{Code, NO_VALUE, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::{FRAC_PI_2, PI};

/// Every step that is not what the oracle says.
fn faults(want: u8, (fast, exact): (Code, Code)) -> usize {
    let want = Code::new(want, 0);
    usize::from(fast != Code::UNDECIDED && fast != want) + usize::from(exact != want)
}

#[derive(Default)]
struct Tally {
    nodes: usize,
    exist: usize,
    abstained: usize,
    wrong: Vec<Datum>,
}

impl Tally {
    fn case(&mut self, datum: Datum) -> u8 {
        let (want, codes) = (judge(datum), codes_of(datum));
        self.nodes += 1;
        self.exist += usize::from(want & EXISTS != 0);
        self.abstained += usize::from(codes.0 == Code::UNDECIDED);
        if faults(want, codes) > 0 {
            self.wrong.push(datum);
        }
        want
    }

    fn finish(&self, name: &str) {
        println!(
            "{name}: {} nodes, {} with a spiral, {} abstained, {} wrong",
            self.nodes,
            self.exist,
            self.abstained,
            self.wrong.len()
        );
        assert!(self.wrong.is_empty(), "{name}: {} wrong, such as {:?}", self.wrong.len(), self.wrong.first());
    }
}

#[test]
fn random_data() {
    let (mut r, mut tally) = (Random(1), Tally::default());
    for _ in 0..4_000 {
        tally.case(r.likely());
        let datum = [r.uniform(-PI, PI), r.uniform(-PI, PI), r.signed_decades(-3.0, 3.0), r.signed_decades(-3.0, 3.0)];
        tally.case(datum);
    }
    tally.finish("random data");
    assert!(tally.exist > 3_500 && tally.exist < 6_000 && tally.abstained < 10);
}

/// A double as an integer in the order of the doubles, and back.
fn key(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

fn double(key: i64) -> f64 {
    f64::from_bits(if key < 0 { i64::MIN - key } else { key } as u64)
}

/// Neighbouring doubles between which the exact code changes, by bisection, and some doubles around them.
#[test]
fn both_sides_of_boundaries() {
    let (mut r, mut tally, mut met) = (Random(2), Tally::default(), 0);
    while met < 1_500 {
        let (datum, which) = (r.likely(), r.below(4) as usize);
        let moved = |x: f64| {
            let mut datum = datum;
            datum[which] = x;
            datum
        };
        let to = if which < 2 { r.uniform(-PI, PI) } else { datum[which] * r.uniform(-1.0, 3.0) };
        let (mut low, mut high) = (key(datum[which]), key(to));
        let code = |k: i64| codes_of(moved(double(k))).1;
        let first = code(low);
        if code(high) == first {
            continue;
        }
        while low.abs_diff(high) > 1 {
            let middle = low.midpoint(high);
            if code(middle) == first { low = middle } else { high = middle }
        }
        let verdicts = [low, high].map(|k| tally.case(moved(double(k))));
        assert_ne!(verdicts[0], verdicts[1]);
        tally.case(moved(double(low + r.below(9) as i64 - 4)));
        met += 1;
    }
    tally.finish("boundaries");
    assert!(tally.exist > 1_000 && tally.nodes - tally.exist > 1_000 && tally.abstained > 1_000);
}

/// Equal and opposite angles and curvatures, zeros, half turns, and numbers at the ends of their range.
#[test]
fn degenerate_data() {
    let angles =
        [0.0, -0.0, 1e-300, -1e-300, 1e-17, 0.3, -0.3, 0.3 + f64::EPSILON, FRAC_PI_2, -FRAC_PI_2, 2.0, PI, -PI];
    let k = [0.0, -0.0, 5e-324, -1e-300, 1e-30, -1e-17, 0.3, -0.3, 1.0, -1.0, 1.0 + f64::EPSILON, -1e17, 1e200, -1e300];
    let mut tally = Tally::default();
    for alpha in angles {
        for beta in angles {
            for k1 in k {
                for k2 in k {
                    tally.case([alpha, beta, k1, k2]);
                }
            }
        }
    }
    tally.finish("degenerate data");
    assert!(tally.exist > 2_000 && tally.abstained < tally.nodes / 3);
    // Biarcs and circles, where Q is exactly 0.
    for datum in [[0.0, 0.0, 0.0, 1.0], [0.3, 0.3, 0.0, 0.0], [-FRAC_PI_2, FRAC_PI_2, 1.0, 1.0], [0.0, 0.0, -1.0, 0.0]]
    {
        assert_eq!(codes_of(datum).1.flags() & EXISTS, 0);
    }
}

/// Data so close to Q = 0 that only high precision decides: k2 on the boundary to the last bit.
#[test]
fn close_to_touching_circles() {
    let (mut r, mut tally) = (Random(3), Tally::default());
    for _ in 0..3_000 {
        let scale = 10f64.powf(r.uniform(-12.0, 0.4));
        let (alpha, beta) = (scale * r.uniform(-1.0, 1.0), scale * r.uniform(-1.0, 1.0));
        let side = if alpha + beta > 0.0 { 1.0 } else { -1.0 };
        let room = r.signed_decades(-6.0, 3.0).abs();
        let k2 = side * (0.5 * (alpha + beta)).sin().powi(2) / room + beta.sin();
        let k2 = double(key(k2) + r.below(7) as i64 - 3);
        tally.case([alpha, beta, -side * room - alpha.sin(), k2]);
    }
    tally.finish("close to touching circles");
    assert!(tally.exist > 500 && tally.nodes - tally.exist > 500);
}

/// The two charts say the same, a grid says what its nodes say, and pieces of a grid are the grid's.
#[test]
fn charts_and_pieces() {
    let values = |lo: f64, hi: f64, count: usize| Spacing::Linear { lo, hi, count };
    let grid = |names: [&str; 4], first: Spacing| {
        let spacings = [first, values(-3.0, 3.1, 7), values(-2.0, 2.0, 9), values(-2.0, 3.0, 11)];
        let axes = names.into_iter().zip(spacings).map(|(n, s)| Axis::new(n, s).unwrap());
        Grid::new(axes.collect()).unwrap()
    };
    let chord = grid(["alpha", "beta", "k1", "k2"], values(-3.1, 2.9, 5));
    let shared = grid(["phi0", "phi1", "kappa0", "kappa1"], values(-2.9, 3.1, 5));
    let family = by_name("any-spiral").unwrap();
    let tables = [family.table(&chord).unwrap(), family.table(&shared).unwrap()];
    let mut codes = vec![vec![Code(0x5aa5); chord.len() as usize]; 2];
    for (table, codes) in tables.iter().zip(&mut codes) {
        table.filter(0, codes);
        let mut piece = [Code(0x5aa5); 50];
        table.filter(333, &mut piece);
        assert_eq!(piece, codes[333..383]);
    }
    let per_alpha = codes[0].len() / 5;
    let mut exist = 0;
    for (node, code) in codes[0].iter().enumerate() {
        // alpha = -phi0 runs the other way.
        let (i, rest) = (node / per_alpha, node % per_alpha);
        let [alpha, beta, k1, k2, ..] = chord.node(node as u64);
        assert!((alpha + shared.node(((4 - i) * per_alpha) as u64)[0]).abs() < 1e-14);
        assert_eq!(*code, codes[1][(4 - i) * per_alpha + rest]);
        assert_eq!(*code, codes_of([alpha, beta, k1, k2]).1);
        exist += usize::from(code.flags() & EXISTS != 0);
    }
    assert!(exist > 300 && exist < codes[0].len() / 2, "{exist}");
}

#[test]
fn a_flipped_bit_is_noticed() {
    let datum = [0.5, 0.6, -2.0, 3.0];
    let (want, codes) = (judge(datum), codes_of(datum));
    assert_eq!((want, faults(want, codes)), (EXISTS | RISING | INFLECTION, 0));
    for bit in 0..16 {
        let wrong = Code(codes.1.0 ^ 1 << bit);
        assert_eq!(faults(want, (codes.0, wrong)), 1);
        assert_eq!(faults(want, (wrong, codes.1)), 1);
    }
    // And the oracle notices another datum.
    assert!(faults(want, codes_of([0.5, 0.6, -2.0, 0.6])) > 0);
}

#[test]
fn the_domain_is_checked() {
    let family = by_name("any-spiral").unwrap();
    let grid = |names: [&str; 4], values: Datum| {
        let axes = names.into_iter().zip(values).map(|(n, x)| Axis::new(n, Spacing::Values(vec![x])).unwrap());
        Grid::new(axes.collect()).unwrap()
    };
    let chord = ["alpha", "beta", "k1", "k2"];
    let message = |grid: &Grid| family.table(grid).err().expect("outside the domain").to_string();
    assert!(message(&grid(chord, [PI.next_up(), 0.1, 0.0, 1.0])).starts_with("alpha is 3.14159265358979"));
    assert!(
        message(&grid(chord, [0.1, -4.0, 0.0, 1.0]))
            .starts_with("beta is -4 (-229.183118 degrees); it must be -pi to pi")
    );
    assert!(message(&grid(["phi0", "phi1", "a", "k"], [0.1; 4])).contains("are no chart of `any-spiral`"));
    assert!(family.table(&grid(chord, [PI, -PI, 0.0, 1.0])).is_ok());
}

#[test]
fn nodes_without_a_spiral_have_no_theta() {
    let grid = super::grid_of([0.5, 0.6, -2.0, 0.6]);
    let table = by_name("any-spiral").unwrap().table(&grid).unwrap();
    let mut out = [0.0; 4];
    table.scalars(0, table.exact(0).unwrap().0, &[0, 1, 2, 3], &mut out).unwrap();
    assert_eq!(out[1..], [0.55f32, NO_VALUE, NO_VALUE]);
    assert!(out[0] > 0.0);
}

/// The double nearest to a half turn lies just inside: flags, numbers and curves of an answer are those of it alike.
#[test]
fn an_answer_beside_a_half_turn_is_one_of_the_doubles_given() {
    use spiral_atlas::family::Value;
    for [alpha, beta] in [[PI, -PI], [-PI, -PI], [-PI, PI], [-PI, 0.3], [-0.5, -PI], [PI, 0.2]] {
        for [k1, k2] in [[-0.15, 0.5], [0.5, -0.15]] {
            let answer = by_name("any-spiral").unwrap().answer(0, &[alpha, beta, k1, k2]).unwrap();
            let exists = answer.code.flags() & EXISTS != 0;
            assert_eq!(exists, !answer.solutions.is_empty(), "{alpha} {beta} {k1} {k2}");
            let omega = answer.derived.iter().find(|(name, _)| *name == "omega").map(|(_, x)| x.clone());
            assert_eq!(omega, Some(Value::from(0.5 * (alpha + beta) + 0.0)), "{alpha} {beta}");
        }
    }
}
