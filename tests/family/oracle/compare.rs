//! What the library says of a case, and how that differs from the verdict.

use super::data::Case;
use super::{Ends, RootVerdict, Verdict, judge_ends};
use spiral_atlas::family::cubic::{Datum, Root, Solutions, solve};
use spiral_atlas::family::{Code, NO_VALUE, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

const FLAG_NAMES: [&str; 8] =
    ["SOLVABLE", "THEOREM31", "THEOREM31_ANY", "SPIRAL", "ANY_SPIRAL", "bit 5", "bit 6", "bit 7"];

/// Every field in which a code differs from the verdict.
pub(crate) fn code_faults(want: &Verdict, code: Code) -> Vec<String> {
    let mut faults = vec![];
    for (bit, name) in FLAG_NAMES.iter().enumerate() {
        let (want, got) = (want.flags >> bit & 1, code.flags() >> bit & 1);
        if want != got {
            faults.push(format!("{name} is {got}, must be {want}"));
        }
    }
    for (name, shift, mask) in [("roots", 0, 3), ("spirals", 2, 3), ("counts above", 4, 15)] {
        let (want, got) = (want.solutions() >> shift & mask, code.counts() >> shift & mask);
        if want != got {
            faults.push(format!("{name} are {got}, must be {want}"));
        }
    }
    faults
}

/// The library's exact answer, taken apart so that it can be compared and, in tests of the comparison, falsified.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub flags: u8,
    pub roots: Vec<Root>,
    pub chosen: Option<Root>,
}

impl From<&Solutions> for Answer {
    fn from(s: &Solutions) -> Answer {
        Answer { flags: s.flags(), roots: s.roots().to_vec(), chosen: s.chosen().copied() }
    }
}

/// A verdict on a root in the library's own type.
pub(crate) fn root_of(r: &RootVerdict) -> Root {
    Root { f0: r.f0, f1: r.f1, theorem31: r.theorem31, spiral: r.spiral, margin: r.margin }
}

/// What `solve` promises of f0 and f1, absolute.
pub(crate) const ROOT_ACCURACY: f64 = 1.0 / (1u64 << 34) as f64;
/// What `solve` promises of the margin, absolute.
pub(crate) const MARGIN_ACCURACY: f64 = 1.0 / (1u64 << 30) as f64;

/// Every field in which an answer differs from the verdict; the numbers may differ by what `solve` allows itself.
pub(crate) fn answer_faults(want: &Verdict, got: &Answer) -> Vec<String> {
    let spirals = got.roots.iter().filter(|r| r.spiral).count() as u8;
    let mut faults = code_faults(want, Code::new(got.flags, got.roots.len() as u8 | spirals << 2));
    for (i, (want, got)) in want.roots.iter().zip(&got.roots).enumerate() {
        for (name, want, got) in [("theorem31", want.theorem31, got.theorem31), ("spiral", want.spiral, got.spiral)] {
            if want != got {
                faults.push(format!("root {i}: {name} is {got}, must be {want}"));
            }
        }
        let numbers = [("f0", want.f0, got.f0, ROOT_ACCURACY), ("f1", want.f1, got.f1, ROOT_ACCURACY)];
        for (name, want, got, near) in numbers.into_iter().chain([("margin", want.margin, got.margin, MARGIN_ACCURACY)])
        {
            if (want - got).abs().partial_cmp(&near).is_none_or(|order| order.is_gt()) {
                faults.push(format!("root {i}: {name} is {got:?}, must be {want:?}"));
            }
        }
    }
    let best = want.chosen().and_then(|c| want.roots.iter().position(|r| r == c));
    let chosen = got.chosen.and_then(|c| got.roots.iter().position(|r| *r == c));
    if best != chosen || chosen.is_some() != got.chosen.is_some() {
        faults.push(format!("root {chosen:?} is chosen, must be {best:?}"));
    }
    faults
}

/// The scalars f0, f1 and margin of the chosen spiral that differ from the nearest singles.
pub(crate) fn scalar_faults(want: &Verdict, got: [f32; 3]) -> Vec<String> {
    let best = want.chosen();
    let value = |of: fn(&RootVerdict) -> f64| best.map_or(NO_VALUE, |r| of(r) as f32);
    let want = [value(|r| r.f0), value(|r| r.f1), value(|r| r.margin)];
    let names = ["f0", "f1", "margin"];
    let differ = (0..3).filter(|i| want[*i].to_bits() != got[*i].to_bits());
    differ.map(|i| format!("scalar {} is {:?}, must be {:?}", names[i], got[i], want[i])).collect()
}

/// The axes of one case: one value each, in the chart of its ends.
pub(crate) fn grid_of(case: &Case) -> Grid {
    let (names, ends) = match case.ends {
        Ends::Curvature { kappa0, kappa1 } => (["phi0", "phi1", "kappa0", "kappa1"], [kappa0, kappa1]),
        Ends::Normalised { a, k } => (["phi0", "phi1", "a", "k"], [a, k]),
    };
    let values = [case.phi0, case.phi1, ends[0], ends[1]];
    let axes = names.iter().zip(values).map(|(n, x)| Axis::new(n, Spacing::Values(vec![x])).expect("a finite value"));
    Grid::new(axes.collect()).expect("four axes")
}

/// The library's proved code of a case; `None` when it refuses the case.
pub(crate) fn code_of(case: &Case) -> Option<Code> {
    let grid = grid_of(case);
    let table = by_name("cubic").ok()?.table(&grid).ok()?;
    table.exact(0).ok().map(|(code, _)| code)
}

/// What was compared, and what was wrong.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub nodes: usize,
    pub filtered: usize,
    pub abstained: usize,
    pub solved: usize,
    pub spirals: usize,
    pub several: usize,
    pub faults: Vec<String>,
}

impl Tally {
    /// Compares the filter, the interval step, the scalars and, for plain curvatures, the solver with the oracle.
    pub(crate) fn case(&mut self, case: &Case) -> Verdict {
        let want = judge_ends(case.phi0, case.phi1, case.ends);
        self.nodes += 1;
        self.spirals += usize::from(want.solutions() >> 2 > 0);
        self.several += usize::from(want.roots.len() > 1);
        let mut report = |step: &str, found: Vec<String>| {
            self.faults.extend(found.into_iter().map(|f| format!("{step} at {case:?}: {f}")));
        };
        let grid = grid_of(case);
        match by_name("cubic").expect("the family").table(&grid) {
            Err(e) => report("table", vec![e.to_string()]),
            Ok(table) => {
                let mut fast = [Code(0x5aa5)];
                table.filter(0, &mut fast);
                if fast[0] == Code::UNDECIDED {
                    self.abstained += 1;
                } else {
                    self.filtered += 1;
                    report("filter", code_faults(&want, fast[0]));
                }
                match table.exact(0) {
                    Ok((code, _)) => report("exact", code_faults(&want, code)),
                    Err(e) => report("exact", vec![e.to_string()]),
                }
                let mut scalars = [0.5f32; 3];
                match table.scalars(0, Code::new(want.flags, want.solutions()), &[0, 1, 2], &mut scalars) {
                    Ok(()) => report("scalars", scalar_faults(&want, scalars)),
                    Err(e) => report("scalars", vec![e.to_string()]),
                }
            }
        }
        if let Ends::Curvature { kappa0, kappa1 } = case.ends {
            self.solved += 1;
            match solve(&Datum { phi0: case.phi0, phi1: case.phi1, kappa0, kappa1 }) {
                Ok(got) => report("solve", answer_faults(&want, &Answer::from(&got))),
                Err(e) => report("solve", vec![e.to_string()]),
            }
        }
        want
    }

    /// Prints the line of a data set and fails when anything was wrong, or when nothing was compared.
    pub(crate) fn finish(&self, name: &str, least: usize) {
        println!(
            "{name}: {} nodes ({} with a spiral, {} with several roots); filter proved {}, abstained {}; solved {}; \
             wrong {}",
            self.nodes,
            self.spirals,
            self.several,
            self.filtered,
            self.abstained,
            self.solved,
            self.faults.len()
        );
        let few: Vec<&str> = self.faults.iter().take(12).map(String::as_str).collect();
        assert!(few.is_empty(), "{name}: {} wrong, the first ones:\n{}", self.faults.len(), few.join("\n"));
        assert!(self.nodes >= least, "{name}: only {} compared, {least} were meant", self.nodes);
    }
}
