//! Whether stored fields are what a backend computes: every byte of every field, with no tolerance.

use super::{Backend, Chunk, Job, Report, evaluate};
use crate::error::{Error, Result};
use serde::Serialize;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

/// Most differences that an [`Agreement`] describes; all are counted.
pub const SHOWN: usize = 20;

/// The fields of a whole grid, in flat order, as an atlas stores them.
#[derive(Debug, Clone)]
pub struct Stored<'a> {
    /// The `flags` byte of each node.
    pub flags: &'a [u8],
    /// The `solutions` byte of each node.
    pub solutions: &'a [u8],
    /// One array for each scalar of the job, in the job's order.
    pub scalars: Vec<&'a [f32]>,
}

/// One stored value that differs from the recomputed one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// Flat index.
    pub node: u64,
    /// The node's coordinates in words.
    pub coordinates: String,
    /// The field's name.
    pub field: &'static str,
    /// What is stored.
    pub stored: Value,
    /// What was computed now.
    pub recomputed: Value,
}

/// A value of a field, exactly.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Of `flags` or `solutions`.
    Byte(u8),
    /// Of a scalar. Equal are those with equal bits.
    Scalar(f32),
}

impl PartialEq for Value {
    fn eq(&self, other: &Value) -> bool {
        match (self, other) {
            (Value::Byte(a), Value::Byte(b)) => a == b,
            (Value::Scalar(a), Value::Scalar(b)) => a.to_bits() == b.to_bits(),
            _ => false,
        }
    }
}

/// The outcome of a comparison that compared something.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Nodes compared.
    pub nodes: u64,
    /// Values compared: nodes times fields.
    pub values: u64,
    /// Values that differ.
    pub differences: u64,
    /// The first [`SHOWN`] of them, by node and field.
    pub first: Vec<Difference>,
}

impl Agreement {
    /// Whether all values agree.
    pub fn holds(&self) -> bool {
        self.differences == 0
    }
}

/// Recomputes a whole grid and compares it with what is stored.
///
/// A GPU that leaves every node to the CPU would agree with anything that the CPU computed, so that is an error.
///
/// # Arguments
/// - `progress`: gets the number of nodes compared so far.
///
/// # Errors
/// Those of [`evaluate`]; [`Error::Domain`] when a stored field has not one value for each node; [`Error::Gpu`] when
/// the GPU decided no node itself.
pub fn compare(
    job: &Job,
    stored: &Stored,
    backend: &Backend,
    threads: usize,
    stop: &AtomicBool,
    progress: impl Fn(u64),
) -> Result<(Agreement, Report)> {
    let mut comparison = Comparison::new(job, stored)?;
    let report = evaluate(job, backend, threads, stop, |chunk| {
        comparison.put(&chunk)?;
        progress(comparison.found.nodes);
        Ok(())
    })?;
    if comparison.found.nodes != job.grid.len() {
        let compared = comparison.found.nodes;
        return Err(Error::invalid(format!("{compared} of {} nodes were compared; all must be", job.grid.len())));
    }
    let agreement = comparison.finish()?;
    if report.undecided_f32 == Some(agreement.nodes) {
        return Err(Error::Gpu(format!(
            "none of {} nodes was decided on the GPU, so nothing was compared with it",
            agreement.nodes
        )));
    }
    Ok((agreement, report))
}

/// Recomputes about `count` nodes, spread evenly, by the top of the ladder alone.
///
/// One node is taken from each of `count` equal parts of the grid, at a place that shifts from part to part (by the
/// golden ratio), so that no axis is sampled at one index alone. A grid of fewer nodes is recomputed whole.
///
/// # Errors
/// [`Error::Domain`] as [`compare`] has it or when `count` is 0, [`Error::Undecided`], [`Error::Interrupted`].
pub fn sample(job: &Job, stored: &Stored, count: u64, stop: &AtomicBool, progress: impl Fn(u64)) -> Result<Agreement> {
    let table = job.family.table(job.grid)?;
    let mut comparison = Comparison::new(job, stored)?;
    for node in spread(job.grid.len(), count) {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let named = |e| super::pipeline::name_node(e, node, job.grid);
        let (code, _) = table.exact(node).map_err(named)?;
        let mut scalars = vec![0.0; job.scalars.len()];
        if !scalars.is_empty() {
            table.exact_scalars(node, code, job.scalars, &mut scalars).map_err(named)?;
        }
        let scalars = scalars.iter().map(|v| vec![*v]).collect();
        comparison.put(&Chunk { start: node, flags: vec![code.flags()], solutions: vec![code.counts()], scalars })?;
        progress(comparison.found.nodes);
    }
    comparison.finish()
}

/// One node of each of `count` equal parts of `0 .. nodes`.
fn spread(nodes: u64, count: u64) -> impl Iterator<Item = u64> {
    /// `2^32` over the golden ratio.
    const STEP: u32 = 0x9E37_79B9;
    let count = count.min(nodes);
    let start = move |i: u64| (u128::from(i) * u128::from(nodes) / u128::from(count)) as u64;
    (0..count).map(move |i| {
        let part = u64::from((i as u32).wrapping_mul(STEP));
        let length = start(i + 1) - start(i);
        start(i) + ((u128::from(length) * u128::from(part)) >> 32) as u64
    })
}

/// Compares chunks with what is stored, one after another.
struct Comparison<'a> {
    job: &'a Job<'a>,
    stored: &'a Stored<'a>,
    found: Agreement,
}

impl<'a> Comparison<'a> {
    fn new(job: &'a Job<'a>, stored: &'a Stored<'a>) -> Result<Comparison<'a>> {
        let nodes = job.grid.len();
        let lengths =
            [stored.flags.len(), stored.solutions.len()].into_iter().chain(stored.scalars.iter().map(|s| s.len()));
        if let Some(length) = lengths.into_iter().find(|length| *length as u64 != nodes) {
            return Err(Error::invalid(format!("a stored field has {length} values; the grid has {nodes} nodes")));
        }
        if stored.scalars.len() != job.scalars.len() {
            let (stored, asked) = (stored.scalars.len(), job.scalars.len());
            return Err(Error::invalid(format!(
                "{stored} scalars are stored and {asked} asked for; compare the same ones"
            )));
        }
        Ok(Comparison { job, stored, found: Agreement { nodes: 0, values: 0, differences: 0, first: Vec::new() } })
    }

    fn put(&mut self, chunk: &Chunk) -> Result<()> {
        let (start, len) = (chunk.start, chunk.len());
        let outside = || Error::invalid(format!("nodes {start} + {len} lie outside the stored fields"));
        let from = usize::try_from(start).map_err(|_| outside())?;
        let range = from..from.checked_add(len).filter(|end| *end <= self.stored.flags.len()).ok_or_else(outside)?;
        let fields = 2 + self.job.scalars.len();
        let whole = chunk.solutions.len() == len && chunk.scalars.iter().all(|s| s.len() == len);
        if !whole || chunk.scalars.len() + 2 != fields {
            return Err(Error::invalid(format!("the chunk at node {start} has not {len} values of {fields} fields")));
        }
        self.found.nodes += len as u64;
        self.found.values += len as u64 * fields as u64;
        let stored = self.stored;
        let scalars = || stored.scalars.iter().zip(&chunk.scalars);
        let bits = |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits();
        let same = stored.flags[range.clone()] == chunk.flags
            && stored.solutions[range.clone()] == chunk.solutions
            && scalars().all(|(a, b)| a[range.clone()].iter().zip(b).all(bits));
        if !same {
            (0..len).for_each(|i| self.node(from + i, chunk, i));
        }
        Ok(())
    }

    /// Compares the fields of one node.
    fn node(&mut self, node: usize, chunk: &Chunk, i: usize) {
        let stored = self.stored;
        self.value(node, "flags", Value::Byte(stored.flags[node]), Value::Byte(chunk.flags[i]));
        self.value(node, "solutions", Value::Byte(stored.solutions[node]), Value::Byte(chunk.solutions[i]));
        for (which, (old, new)) in self.job.scalars.iter().zip(stored.scalars.iter().zip(&chunk.scalars)) {
            let field = self.job.family.about().scalars.get(*which).map_or("?", |s| s.name);
            self.value(node, field, Value::Scalar(old[node]), Value::Scalar(new[i]));
        }
    }

    fn value(&mut self, node: usize, field: &'static str, stored: Value, recomputed: Value) {
        if stored == recomputed {
            return;
        }
        self.found.differences += 1;
        if self.found.first.len() < SHOWN {
            let (node, coordinates) = (node as u64, self.job.grid.describe(node as u64));
            self.found.first.push(Difference { node, coordinates, field, stored, recomputed });
        }
    }

    /// A comparison of nothing proves nothing, so it is an error.
    fn finish(self) -> Result<Agreement> {
        match self.found.values {
            0 => Err(Error::invalid("nothing was compared; at least one node must be")),
            _ => Ok(self.found),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Byte(byte) => write!(f, "{byte:#010b}"),
            Value::Scalar(value) => write!(f, "{value:?} ({:#010x})", value.to_bits()),
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { node, coordinates, field, stored, recomputed } = self;
        write!(f, "node {node} ({coordinates}): `{field}` is stored as {stored}, recomputed as {recomputed}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family::by_name;
    use crate::grid::{Axis, Grid, Spacing};
    use std::collections::BTreeSet;

    static NEVER: AtomicBool = AtomicBool::new(false);

    fn grid() -> Grid {
        let axis = |name, lo, hi, count| Axis::new(name, Spacing::Linear { lo, hi, count }).unwrap();
        let axes = vec![
            axis("phi0", 0.3, 0.9, 3),
            axis("phi1", 0.9, 1.5, 4),
            axis("kappa0", 0.05, 0.6, 7),
            axis("kappa1", 1.0, 9.0, 5),
        ];
        Grid::new(axes).unwrap()
    }

    fn job(grid: &Grid) -> Job<'_> {
        Job { family: by_name("cubic").unwrap(), grid, scalars: &[2, 0] }
    }

    /// All fields of a job, from a sentinel on.
    fn fields(job: &Job) -> (Vec<u8>, Vec<u8>, Vec<Vec<f32>>) {
        let n = job.grid.len() as usize;
        let mut all = (vec![0xAA; n], vec![0xAA; n], vec![vec![-7.5f32; n]; job.scalars.len()]);
        evaluate(job, &Backend::Cpu, 2, &NEVER, |chunk| {
            let at = chunk.start as usize..chunk.start as usize + chunk.len();
            all.0[at.clone()].copy_from_slice(&chunk.flags);
            all.1[at.clone()].copy_from_slice(&chunk.solutions);
            for (all, part) in all.2.iter_mut().zip(&chunk.scalars) {
                all[at.clone()].copy_from_slice(part);
            }
            Ok(())
        })
        .unwrap();
        all
    }

    fn stored((flags, solutions, scalars): &(Vec<u8>, Vec<u8>, Vec<Vec<f32>>)) -> Stored<'_> {
        Stored { flags, solutions, scalars: scalars.iter().map(|s| &s[..]).collect() }
    }

    #[test]
    fn what_was_computed_agrees_and_each_flipped_bit_is_found_alone() {
        let grid = grid();
        let job = job(&grid);
        let good = fields(&job);
        let both = |all: &_| {
            let stored = stored(all);
            let (whole, report) = compare(&job, &stored, &Backend::Cpu, 2, &NEVER, |_| ()).unwrap();
            let sampled = sample(&job, &stored, u64::MAX, &NEVER, |_| ()).unwrap();
            assert_eq!((whole.nodes, whole.values, report.nodes), (420, 1680, 420));
            assert_eq!(whole, sampled);
            whole
        };
        assert!(both(&good).holds());
        assert!(good.2[0].iter().any(|m| *m > 0.0), "no spiral, so scalars were not tested");
        for node in [0, 123, 419] {
            for field in ["flags", "solutions", "margin", "f0"] {
                let mut bad = good.clone();
                match field {
                    "flags" => bad.0[node] ^= 8,
                    "solutions" => bad.1[node] ^= 1,
                    "margin" => bad.2[0][node] = f32::from_bits(bad.2[0][node].to_bits() ^ 1),
                    _ => bad.2[1][node] = f32::from_bits(bad.2[1][node].to_bits() ^ 0x8000_0000),
                }
                let found = both(&bad);
                assert_eq!((found.differences, found.first.len()), (1, 1), "{field} of {node}: {found:?}");
                assert_eq!((found.first[0].node, found.first[0].field), (node as u64, field));
                assert!(found.first[0].to_string().contains(&grid.describe(node as u64)));
                assert_ne!(found.first[0].stored, found.first[0].recomputed);
            }
        }
        let all = both(&(vec![0xFF; 420], good.1.clone(), good.2.clone()));
        assert_eq!((all.differences, all.first.len()), (420, SHOWN));
    }

    #[test]
    fn nothing_or_too_little_compared_is_an_error() {
        let grid = grid();
        let job = job(&grid);
        let good = fields(&job);
        let none = sample(&job, &stored(&good), 0, &NEVER, |_| ()).unwrap_err();
        assert!(none.to_string().contains("nothing was compared"), "{none}");
        let mut short = good.clone();
        short.2[1].pop();
        let error = compare(&job, &stored(&short), &Backend::Cpu, 1, &NEVER, |_| ()).unwrap_err();
        assert!(error.to_string().contains("419 values"), "{error}");
        let missing = (good.0.clone(), good.1.clone(), vec![good.2[0].clone()]);
        assert!(compare(&job, &stored(&missing), &Backend::Cpu, 1, &NEVER, |_| ()).is_err());
        let stopped = AtomicBool::new(true);
        assert!(matches!(sample(&job, &stored(&good), 9, &stopped, |_| ()), Err(Error::Interrupted)));
    }

    #[test]
    fn samples_are_spread_over_all_axes() {
        let grid = grid();
        for count in [1, 7, 60, 420, 10_000] {
            let nodes: BTreeSet<u64> = spread(420, count).collect();
            assert_eq!(nodes.len() as u64, count.min(420));
            assert!(nodes.iter().all(|n| *n < 420));
        }
        // 60 samples of a grid whose last axes make 35: every index of every axis occurs.
        let indices: Vec<_> = spread(420, 60).map(|n| grid.index(n)).collect();
        for (axis, count) in grid.shape().into_iter().enumerate() {
            let seen: BTreeSet<usize> = indices.iter().map(|i| i[axis]).collect();
            assert_eq!(seen.len(), count, "axis {axis}");
        }
        assert_eq!(spread(1 << 48, 3).count(), 3);
    }
}
