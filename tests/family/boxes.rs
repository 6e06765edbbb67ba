//! What tests of verdicts over boxes share: no point of a box, and no corner, face or neighbour of one inside it, may
//! have another verdict than its box.

use crate::oracle::random::Random;
use spiral_atlas::error::Error;
use spiral_atlas::family::{Code, Facts, Family, verdict};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// A family in one of its charts, with boxes of all kinds, by a running number.
pub(crate) struct Subject<const N: usize> {
    pub family: &'static dyn Family,
    pub chart: usize,
    pub draw: fn(&mut Random, u64) -> [[f64; 2]; N],
}

/// Both ends, their neighbours inside, and so many numbers between them, increasing.
fn places(r: &mut Random, [low, high]: [f64; 2], between: usize) -> Vec<f64> {
    let mut all = vec![low, low.next_up(), high.next_down(), high];
    all.extend((0..between).map(|_| r.uniform(low, high)));
    all.retain(|x| (low..=high).contains(x));
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// A point of a box: each coordinate is an end or anywhere.
fn place<const N: usize>(r: &mut Random, sides: &[[f64; 2]; N]) -> [f64; N] {
    sides.map(|side| match r.below(4) {
        0 => side[0],
        1 => side[1],
        _ => r.uniform(side[0], side[1]),
    })
}

impl<const N: usize> Subject<N> {
    pub(crate) fn facts(&self, sides: &[[f64; 2]; N]) -> Facts {
        let [low, high] = [0, 1].map(|end| sides.map(|side| side[end]));
        self.family.region().facts(self.chart, &low, &high, u8::MAX)
    }

    /// Of a box some flags are known; beyond the domain, and where a number is none, nothing is said.
    pub(crate) fn says_nothing_outside(&self, all: [[f64; 2]; N], known: u32, outside: &[(usize, [f64; 2])]) {
        assert_eq!((self.facts(&all).inside | self.facts(&all).outside).count_ones(), known);
        for (which, side) in outside {
            let mut sides = all;
            sides[*which] = *side;
            let facts = self.facts(&sides);
            assert_eq!((facts.inside, facts.outside), (0, 0), "{side:?}");
        }
    }

    /// The flags of all nodes of a product of values, by the ladder; none of those outside the family's domain.
    fn flags(&self, values: &[Vec<f64>; N]) -> Vec<Option<u8>> {
        let names = self.family.about().charts[self.chart].axes;
        let axes =
            names.iter().zip(values).map(|(name, values)| Axis::new(name, Spacing::Values(values.clone())).unwrap());
        let grid = Grid::new(axes.collect()).unwrap();
        let Ok(table) = self.family.table(&grid) else {
            let single = |i: u64| match verdict(self.family, self.chart, &grid.node(i)[..N]) {
                Ok(code) => Some(code.flags()),
                Err(Error::Domain(_)) => None,
                Err(e) => panic!("{values:?}: {e}"),
            };
            return (0..grid.len()).map(single).collect();
        };
        let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
        table.filter(0, &mut codes);
        let exact =
            |(i, code): (usize, Code)| if code == Code::UNDECIDED { table.exact(i as u64).unwrap().0 } else { code };
        codes.into_iter().enumerate().map(exact).map(|code| Some(code.flags())).collect()
    }

    /// Draws boxes and compares what is said of them with the flags at their corners, on their faces, beside both and
    /// inside. So many points must have been met at least, and each flag so often INSIDE and OUTSIDE.
    pub(crate) fn attack(&self, seed: u64, boxes: u64, between: usize, least: usize, each: u64) {
        let (points, inside, outside) = self.attacked(seed, boxes, between);
        assert!(points >= least && inside.iter().chain(&outside).all(|n| *n > each), "{points} {inside:?} {outside:?}");
    }

    /// Draws boxes, and compares what is said of each that is `wanted` with a judge of the tests' own, at so many
    /// points. `wanted` looks at what is said, and at how many boxes were judged before. The judge gives all flags that
    /// a point may have, and none where it is no datum; a box without a datum does not count.
    ///
    /// # Returns
    /// What is said of the boxes.
    pub(crate) fn confirm(
        &self,
        seed: u64,
        [boxes, points]: [usize; 2],
        mut wanted: impl FnMut(&Facts, usize) -> bool,
        judge: impl Fn([f64; N]) -> Vec<u8>,
    ) -> Vec<Facts> {
        let (mut r, mut judged, mut round) = (Random(seed), Vec::new(), 0);
        while judged.len() < boxes {
            round += 1;
            let sides = (self.draw)(&mut r, round);
            let facts = self.facts(&sides);
            let known = facts.inside | facts.outside;
            if !wanted(&facts, judged.len()) {
                continue;
            }
            let mut met = false;
            for _ in 0..points {
                let point = place(&mut r, &sides);
                let may = judge(point);
                let agree = may.iter().any(|flags| flags & known == facts.inside);
                assert!(may.is_empty() || agree, "{sides:?} at {point:?}: {may:?}, but {facts:?}");
                met |= agree;
            }
            if met {
                judged.push(facts);
            }
        }
        judged
    }

    /// The same as [`Subject::attack`], for whoever judges the numbers: points, and of each flag how often it was
    /// INSIDE and OUTSIDE.
    pub(crate) fn attacked(&self, seed: u64, boxes: u64, between: usize) -> (usize, Vec<u64>, Vec<u64>) {
        let mut r = Random(seed);
        let count = self.family.about().flags.len();
        let (mut points, mut inside, mut outside) = (0, vec![0u64; count], vec![0u64; count]);
        for round in 0..boxes {
            let sides = (self.draw)(&mut r, round);
            let facts = self.facts(&sides);
            assert_eq!(facts.inside & facts.outside, 0, "{sides:?}");
            let known = facts.inside | facts.outside;
            for bit in 0..count {
                inside[bit] += u64::from(facts.inside >> bit & 1);
                outside[bit] += u64::from(facts.outside >> bit & 1);
            }
            if known == 0 {
                continue;
            }
            let values = sides.map(|side| places(&mut r, side, between));
            let found = self.flags(&values);
            for (i, flags) in found.iter().enumerate().filter_map(|(i, flags)| Some((i, flags.as_ref()?))) {
                assert!(flags & known == facts.inside, "{sides:?} node {i} of {values:?}: {flags:#b}, but {facts:?}");
            }
            points += found.iter().flatten().count();
        }
        println!(
            "{}: {points} points; {boxes} boxes, inside {inside:?}, outside {outside:?}",
            self.family.about().name
        );
        (points, inside, outside)
    }
}
