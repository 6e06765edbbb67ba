//! The reachable regions against the oracle: random end points, and every place where a verdict is hard. Nothing may be
//! wrong.

use crate::oracle::data::Random;
use crate::oracle::reach::{Verdict, judge};
use spiral_atlas::family::reach::{Datum, Kind, Level, Reach, Segment, solve};
use spiral_atlas::family::{Code, Family, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::{FRAC_PI_2, PI};

const KINDS: [Kind; 2] = [Kind::Cubic, Kind::Ph];

fn most(kind: Kind) -> f64 {
    if kind == Kind::Cubic { FRAC_PI_2 } else { PI }
}

fn grid(theta: f64, xi: f64, eta: f64) -> Grid {
    let axis = |name, x| Axis::new(name, Spacing::Values(vec![x])).unwrap();
    Grid::new(vec![axis("theta", theta), axis("xi", xi), axis("eta", eta)]).unwrap()
}

fn flags(want: &Verdict) -> u8 {
    want[0].map_or(0, |s| s.flags) | want[1].map_or(0, |s| s.flags) << 4
}

fn code_faults(want: &Verdict, code: Code) -> Vec<String> {
    let (want, got) = (flags(want), code.flags());
    let mut faults: Vec<String> = vec![];
    if want != got {
        faults.push(format!("flags {got:08b}, must be {want:08b}"));
    }
    if code.counts() != 0 {
        faults.push(format!("counts {}", code.counts()));
    }
    faults
}

fn scalar_faults(want: &Verdict, got: [f32; 4]) -> Vec<String> {
    let single = |x: f64| (x as f32).min(f32::MAX);
    let want = want.map(|s| s.map_or([NO_VALUE; 2], |s| [single(s.m), single(s.q)]));
    let want = [want[0][0], want[0][1], want[1][0], want[1][1]];
    let names = ["m1", "q1", "m2", "q2"];
    let differ = (0..4).filter(|i| want[*i].to_bits() != got[*i].to_bits());
    differ.map(|i| format!("{} is {:?}, must be {:?}", names[i], got[i], want[i])).collect()
}

fn segment_faults(want: &Verdict, got: [Option<Segment>; 2]) -> Vec<String> {
    let level =
        |flags: u8| [Level::Exists, Level::Exact, Level::Theorem, Level::Paper][flags.count_ones() as usize - 1];
    let same = (0..2).all(|i| want[i].map(|s| Segment { m: s.m, q: s.q, level: level(s.flags) }) == got[i]);
    if same { vec![] } else { vec![format!("solved {got:?}, must be {want:?}")] }
}

#[derive(Debug, Default)]
struct Tally {
    nodes: usize,
    abstained: usize,
    levels: [usize; 5],
    faults: Vec<String>,
}

impl Tally {
    fn case(&mut self, kind: Kind, theta: f64, xi: f64, eta: f64) -> Verdict {
        let want = judge(kind, theta, xi, eta);
        self.nodes += 1;
        for case in want {
            self.levels[case.map_or(0, |s| s.flags.count_ones() as usize)] += 1;
            // Each level contains the next.
            assert!(
                case.is_none_or(|s| [1, 3, 7, 15].contains(&s.flags)),
                "{kind:?} {theta:?} {xi:?} {eta:?}: {want:?}"
            );
        }
        let mut report = |step: &str, found: Vec<String>| {
            self.faults.extend(found.into_iter().map(|f| format!("{step}, {kind:?} at {theta:?} {xi:?} {eta:?}: {f}")));
        };
        let grid = grid(theta, xi, eta);
        let family = Reach(kind);
        let table = family.table(&grid).unwrap();
        let mut fast = [Code(0x5aa5)];
        table.filter(0, &mut fast);
        if fast[0] == Code::UNDECIDED {
            self.abstained += 1;
        } else {
            report("filter", code_faults(&want, fast[0]));
        }
        match table.exact(0) {
            Ok((code, _)) => report("exact", code_faults(&want, code)),
            Err(e) => report("exact", vec![e.to_string()]),
        }
        let mut scalars = [0.5f32; 4];
        match table.scalars(0, Code::new(flags(&want), 0), &[0, 1, 2, 3], &mut scalars) {
            Ok(()) => report("scalars", scalar_faults(&want, scalars)),
            Err(e) => report("scalars", vec![e.to_string()]),
        }
        let representable = want.iter().flatten().all(|s| s.m.is_finite() && s.q.is_finite());
        match solve(kind, &Datum { theta, xi, eta }) {
            Ok(found) => report("solve", segment_faults(&want, [found.case1, found.case2])),
            Err(_) if !representable => {}
            Err(e) => report("solve", vec![e.to_string()]),
        }
        want
    }

    fn finish(&self, name: &str, least: usize) {
        let Tally { nodes, abstained, levels, faults } = self;
        println!("{name}: {nodes} nodes, filter abstained {abstained}, levels {levels:?}, wrong {}", faults.len());
        let few: Vec<&str> = faults.iter().take(12).map(String::as_str).collect();
        assert!(few.is_empty(), "{name}: {} wrong, the first ones:\n{}", faults.len(), few.join("\n"));
        assert!(*nodes >= least, "{name}: only {nodes} compared, {least} were meant");
    }
}

/// The end point of a shape in doubles; see (6), (20).
fn end(kind: Kind, case: usize, t: f64, m: f64, q: f64) -> (f64, f64) {
    let (s, c) = t.sin_cos();
    let (a, b) = match kind {
        Kind::Cubic => (q * s / 3.0, (1.0 + m) * q * q / 6.0),
        Kind::Ph => {
            let f = 2.0 + 3.0 * m + 3.0 * m * m;
            (q * ((3.0 + m) * q + 12.0 * s) / 60.0, q * q * (f * q / (0.5 * t).tan() + 2.0 * (3.0 + m)) / 120.0)
        }
    };
    let (eta, h) = if case == 0 { (a, b) } else { (b, a) };
    ((h + eta * c) / s, eta)
}

fn scale(kind: Kind, t: f64) -> f64 {
    if kind == Kind::Cubic { t.tan() } else { (0.5 * t).tan() }
}

/// An end point of a segment drawn by its shape, around the thresholds.
fn drawn(r: &mut Random, kind: Kind, t: f64) -> (f64, f64) {
    let m = match r.below(4) {
        0 => r.uniform(0.0, 1.0),
        1 => r.decades(-6.0, 3.0),
        2 => r.uniform(0.1, 0.45),
        _ => r.uniform(0.4, 0.9),
    };
    let least = (if kind == Kind::Cubic { (4.0 + m) / 3.0 } else { (6.0 + m) / 2.0 }) * scale(kind, t);
    let q = least * if r.below(3) == 0 { r.decades(-2.0, 3.0) } else { r.uniform(0.7, 2.5) };
    end(kind, r.below(2) as usize, t, m, q)
}

#[test]
fn random_windows() {
    let (mut r, mut tally) = (Random(11), Tally::default());
    for i in 0..12_000 {
        let kind = KINDS[i % 2];
        let t = r.uniform(0.02, 0.99 * most(kind));
        let (xi, eta) = match r.below(3) {
            0 => (r.uniform(0.0, 4.0), r.uniform(0.0, 4.0)),
            1 => (r.uniform(-4.0, 20.0), r.uniform(-1.0, 9.0)),
            _ => drawn(&mut r, kind, t),
        };
        tally.case(kind, t, xi, eta);
    }
    tally.finish("random windows", 12_000);
    assert!(tally.levels.iter().all(|n| *n > 100) && tally.abstained < 100, "{tally:?}");
}

/// A double as an integer in the order of the doubles, and back.
fn key(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

fn double(key: i64) -> f64 {
    f64::from_bits(if key < 0 { i64::MIN - key } else { key } as u64)
}

fn code(kind: Kind, [theta, xi, eta]: [f64; 3]) -> Code {
    Reach(kind).table(&grid(theta, xi, eta)).unwrap().exact(0).unwrap().0
}

#[test]
fn boundaries_between_neighbouring_doubles() {
    let (mut r, mut tally) = (Random(12), Tally::default());
    let mut changed = 0u8;
    for i in 0..1_500 {
        let kind = KINDS[i % 2];
        let t = r.uniform(0.05, 0.97 * most(kind));
        let (xi, eta) = drawn(&mut r, kind, t);
        let (datum, which) = ([t, xi, eta], r.below(3) as usize);
        let moved = |x: f64| {
            let mut datum = datum;
            datum[which] = x;
            datum
        };
        let to = datum[which] * (1.0 + r.uniform(-0.3, 0.3));
        let (mut lo, mut hi) = (key(datum[which]), key(to));
        if which == 0 && to >= most(kind) || code(kind, moved(to)) == code(kind, datum) {
            continue;
        }
        let first = code(kind, datum);
        while lo.abs_diff(hi) > 1 {
            let mid = lo.midpoint(hi);
            if code(kind, moved(double(mid))) == first { lo = mid } else { hi = mid }
        }
        let [one, two] = [lo, hi].map(|k| {
            let [t, xi, eta] = moved(double(k));
            flags(&tally.case(kind, t, xi, eta))
        });
        assert_ne!(one, two);
        changed |= one ^ two;
    }
    tally.finish("neighbouring doubles", 800);
    assert_eq!(changed, 0xff, "each flag had its boundary");
}

#[test]
fn degenerate_data() {
    let (mut r, mut tally) = (Random(13), Tally::default());
    for i in 0..3_000 {
        let kind = KINDS[i % 2];
        let t = match r.below(5) {
            0 => r.decades(-300.0, -1.0),
            1 => r.decades(-12.0, -1.0),
            2 => {
                let near = [0, 3, 1 << 20, 1 << 40][r.below(4) as usize];
                f64::from_bits(most(kind).to_bits() - r.below(near + 1))
            }
            3 => FRAC_PI_2.min(most(kind)) - r.decades(-15.0, -1.0),
            _ => r.uniform(0.1, 0.9 * most(kind)),
        };
        let (xi, eta) = match r.below(4) {
            0 => drawn(&mut r, kind, t),
            1 => (r.uniform(0.0, 4.0), r.decades(-300.0, 0.0)),
            2 => (r.decades(-30.0, 30.0), r.decades(-30.0, 30.0)),
            _ => {
                let eta = r.decades(-3.0, 1.0);
                let near = 1 << r.below(40);
                (r.nudge(eta / t.tan(), near), eta)
            }
        };
        if xi.is_finite() && eta.is_finite() {
            tally.case(kind, t, xi, eta);
        }
    }
    for kind in KINDS {
        for (xi, eta) in [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (-1.0, -1.0), (0.0, -0.0), (1.0, f64::from_bits(1))] {
            tally.case(kind, 0.7, xi, eta);
        }
    }
    tally.finish("degenerate", 2_500);
    assert!(tally.levels.iter().all(|n| *n > 50), "{:?}", tally.levels);
}

/// m within a few doubles of m*, of the least m of a spiral, and of 0.
#[test]
fn shapes_near_the_special_m() {
    let (mut r, mut tally) = (Random(14), Tally::default());
    for i in 0..2_000 {
        let kind = KINDS[i % 2];
        let special = match kind {
            Kind::Cubic => [0.5797958971132712, 0.1429904826, 0.3, 0.0],
            Kind::Ph => [0.707778735729046, 0.2598341983, 3.0 / 7.0, 0.0],
        };
        let t = r.uniform(0.05, 0.95 * most(kind));
        let m = special[r.below(4) as usize] + r.decades(-16.0, -4.0) * (r.uniform(-1.0, 1.0)).signum();
        let q = scale(kind, t) * r.uniform(1.5, 6.0);
        let (xi, eta) = end(kind, r.below(2) as usize, t, m, q);
        tally.case(kind, t, xi, eta);
    }
    tally.finish("special m", 2_000);
}

#[test]
fn the_comparison_notices_every_flipped_bit() {
    let want = judge(Kind::Ph, 1.0, 1.6, 0.9);
    let both = [(Kind::Cubic, PI / 4.0, 2.0, 0.5), (Kind::Ph, PI / 3.0, 2.5, 0.9)];
    for (kind, t, xi, eta) in both {
        let want = judge(kind, t, xi, eta);
        assert!(want.iter().any(Option::is_some), "{want:?}");
        let code = Code::new(flags(&want), 0);
        assert!(code_faults(&want, code).is_empty());
        for bit in 0..16 {
            assert!(!code_faults(&want, Code(code.0 ^ 1 << bit)).is_empty(), "bit {bit}");
        }
        let mut scalars = [0.0; 4];
        Reach(kind).table(&grid(t, xi, eta)).unwrap().scalars(0, code, &[0, 1, 2, 3], &mut scalars).unwrap();
        assert!(scalar_faults(&want, scalars).is_empty());
        for i in 0..4 {
            let mut wrong = scalars;
            wrong[i] = f32::from_bits(wrong[i].to_bits() ^ 1);
            assert_eq!(scalar_faults(&want, wrong).len(), 1);
        }
        let found = solve(kind, &Datum { theta: t, xi, eta }).unwrap();
        let mut wrong = [found.case1, found.case2];
        assert!(segment_faults(&want, wrong).is_empty());
        for case in wrong.iter_mut().flatten() {
            case.m = f64::from_bits(case.m.to_bits() ^ 1);
        }
        assert!(!segment_faults(&want, wrong).is_empty());
    }
    assert_ne!(flags(&want), flags(&judge(Kind::Ph, 1.0, 1.6, 0.1)));
}
