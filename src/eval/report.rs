//! What a run reports about itself: everything that may differ between machines, kept out of the atlas.

use super::{Backend, Chunk, Job};
use serde::Serialize;
use std::collections::BTreeMap;

/// A GPU's part of a [`Report`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeviceReport {
    /// The adapter.
    #[cfg(feature = "gpu")]
    pub adapter: super::gpu::AdapterFacts,
    /// What it did.
    #[cfg(feature = "gpu")]
    pub run: super::gpu::RunStats,
}

/// What a run did, for the file beside the atlas.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Version of the generator.
    pub version: &'static str,
    /// `cpu` or `gpu`.
    pub backend: &'static str,
    /// Worker threads.
    pub threads: usize,
    /// The GPU, when one took part.
    pub device: Option<DeviceReport>,
    /// Counts of the axes.
    pub shape: Vec<usize>,
    /// Number of nodes.
    pub nodes: u64,
    /// Nodes with a Yes, by flag.
    pub yes: BTreeMap<&'static str, u64>,
    /// Nodes that the f32 step left undecided; `None` when there was no such step.
    pub undecided_f32: Option<u64>,
    /// Nodes that the f64 step left undecided.
    pub undecided_f64: u64,
    /// Nodes undecided at the top: always 0, as such a node ends the run with an error.
    pub undecided: u64,
    /// Highest precision that any verdict needed, bits; 0 when doubles sufficed.
    pub most_bits: usize,
    /// Wall time of evaluation and writing.
    pub seconds: f64,
    #[serde(skip)]
    names: Vec<&'static str>,
}

impl Report {
    pub(super) fn new(job: &Job, backend: &Backend, threads: usize) -> Report {
        let names: Vec<&'static str> = job.family.about().flags.iter().map(|f| f.name).collect();
        let gpu = !matches!(backend, Backend::Cpu);
        Report {
            version: env!("CARGO_PKG_VERSION"),
            backend: if gpu { "gpu" } else { "cpu" },
            threads,
            device: None,
            shape: job.grid.shape(),
            nodes: 0,
            yes: names.iter().map(|name| (*name, 0)).collect(),
            undecided_f32: gpu.then_some(0),
            undecided_f64: 0,
            undecided: 0,
            most_bits: 0,
            seconds: 0.0,
            names,
        }
    }

    pub(super) fn add(&mut self, chunk: &Chunk, tally: &Tally) {
        self.nodes += chunk.len() as u64;
        if let Some(count) = &mut self.undecided_f32 {
            *count += tally.undecided_f32;
        }
        self.undecided_f64 += tally.undecided_f64;
        self.most_bits = self.most_bits.max(tally.most_bits);
        for (name, count) in self.names.iter().zip(tally.flags) {
            *self.yes.entry(name).or_default() += count;
        }
    }
}

/// What happened in a chunk.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub undecided_f32: u64,
    pub undecided_f64: u64,
    pub most_bits: usize,
    pub flags: [u64; 8],
}
