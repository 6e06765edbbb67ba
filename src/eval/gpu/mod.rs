//! The f32 step on a GPU, by wgpu compute: chunks in flight on reused buffers, codes delivered in order.
//!
//! The engine knows nothing of any family's mathematics. It runs `evaluate(index)` of the family's shader at every node
//! and hands out the codes; what the shader does not prove is [`Code::UNDECIDED`] and climbs the ladder. Memory of a
//! run is bounded: three sets of buffers, each with at most 16 MiB of codes on the device, as much for reading
//! them back, and the family's inputs for one chunk.

mod adapter;
mod assemble;
mod pace;
mod program;
mod slot;
#[cfg(test)]
mod tests;

pub use adapter::{AdapterFacts, adapters, select};
#[doc(hidden)]
pub use assemble::{Assembled, SourceMap, assemble, validate};

use crate::error::{Error, Result};
use crate::family::{Code, Kernel, ShaderInputs};
use crate::grid::Grid;
use adapter::Gpu;
use pace::Pace;
use program::Program;
use slot::{Flight, Slot};
use std::cell::Cell;
use std::collections::VecDeque;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Invocations of a workgroup: every adapter has at least 128, and this suits all widths of subgroups.
pub const GROUP_SIZE: u32 = 64;
/// Chunks on their way at once: one computed, one queued, one being taken by the caller.
const IN_FLIGHT: usize = 3;
/// Most nodes of a chunk: 16 MiB of codes. Below 2^26, so that no index in the shader overflows.
const MOST_NODES: u64 = 1 << 23;
/// How long to wait before looking again whether the user asked to stop.
const PATIENCE: Duration = Duration::from_millis(500);

thread_local! {
    static CATCHING: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic on this thread, at this moment, would be caught and become an [`Error::Gpu`].
///
/// The panic hook of a program may then stay silent: the error says more. (The library must not set a hook, which
/// belongs to the program.)
pub fn panic_becomes_error() -> bool {
    CATCHING.get()
}

/// Calls wgpu where it is known to panic on failures of the driver; none when it did.
fn caught<T>(call: impl FnOnce() -> T) -> Option<T> {
    CATCHING.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(call));
    CATCHING.set(false);
    outcome.ok()
}

/// How work is cut up. It changes speed, never a bit of the result; the defaults are measured (see ARCHITECTURE.md).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Settings {
    /// Words (of two codes) that one invocation produces, 1 to 64.
    pub words_per_thread: u32,
    /// Most nodes of a chunk, 1 to 2^23; smaller ones are chosen where time or the adapter's limits ask for it.
    pub chunk_nodes: u64,
    /// Most workgroups along one dimension of a dispatch, 1 to 65535; the adapter's own limit holds too.
    pub groups_per_dimension: u32,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings { words_per_thread: 8, chunk_nodes: MOST_NODES, groups_per_dimension: 65535 }
    }
}

impl Settings {
    /// The settings within their ranges and the adapter's limits.
    fn clamped(&self, limits: &wgpu::Limits) -> Settings {
        let dimension = limits.max_compute_workgroups_per_dimension.clamp(1, 65535);
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        Settings {
            words_per_thread: self.words_per_thread.clamp(1, 64),
            // Two bytes a node, and room for two timestamps behind the codes.
            chunk_nodes: self.chunk_nodes.clamp(1, MOST_NODES.min((bytes.saturating_sub(32) / 2).max(1))),
            groups_per_dimension: self.groups_per_dimension.clamp(1, dimension),
        }
    }

    fn nodes_per_group(&self) -> u64 {
        u64::from(2 * GROUP_SIZE * self.words_per_thread)
    }

    /// Most nodes that one dispatch may have.
    fn most_nodes(&self) -> u64 {
        let groups = u64::from(self.groups_per_dimension).pow(2);
        groups.saturating_mul(self.nodes_per_group()).min(self.chunk_nodes)
    }
}

/// What a run did.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct RunStats {
    /// Nodes evaluated.
    pub nodes: u64,
    /// Chunks they were cut into.
    pub chunks: u64,
    /// Nodes of the largest chunk.
    pub largest_chunk: u64,
    /// Seconds of the device's own clock, without transfers; `None` where the adapter does not report it.
    pub device_seconds: Option<f64>,
}

/// A family's shader on one adapter and one grid.
pub struct Engine<'t> {
    kernel: &'t dyn Kernel,
    grid: &'t Grid,
    gpu: Gpu,
    program: Program,
    pace: Pace,
    free: Vec<Slot>,
}

impl<'t> Engine<'t> {
    /// Opens the adapter of a choice (see [`select`]) and compiles the kernel's shader for it.
    ///
    /// # Errors
    /// [`Error::Gpu`] when no adapter fits, it does not open, or the shader does not compile.
    pub fn new(
        choice: Option<&str>,
        kernel: &'t dyn Kernel,
        grid: &'t Grid,
        settings: &Settings,
    ) -> Result<Engine<'t>> {
        let gpu = Gpu::open(choice)?;
        let program = Program::new(&gpu, &kernel.shader(), settings.clamped(&gpu.limits))?;
        let pace = Pace::new(program.settings.most_nodes().min(grid.len()));
        Ok(Engine { kernel, grid, gpu, program, pace, free: Vec::new() })
    }

    /// The adapter in use.
    pub fn adapter(&self) -> &AdapterFacts {
        &self.gpu.facts
    }

    /// Evaluates the nodes of a range of flat indices. `sink` gets every chunk's first node and codes, in order, while
    /// the device works on the next chunks; chunks cover the range without gap or overlap.
    ///
    /// # Errors
    /// [`Error::Domain`] for a range outside the grid; [`Error::Interrupted`] soon after `stop` is set; [`Error::Gpu`]
    /// when the device fails, or the inputs of a single node exceed its limits; whatever `sink` returns. After an error
    /// of the device every further run fails too; after the others the engine is ready for another run.
    pub fn run(
        &mut self,
        range: Range<u64>,
        stop: &AtomicBool,
        mut sink: impl FnMut(u64, &[Code]) -> Result<()>,
    ) -> Result<RunStats> {
        if range.start > range.end || range.end > self.grid.len() {
            let what = format!("nodes {} to {} are not in a grid of {}", range.start, range.end, self.grid.len());
            return Err(Error::invalid(what));
        }
        self.gpu.check()?;
        // Slots of chunks that an error leaves in flight are dropped with this queue; only landed ones are reused.
        let mut flights: VecDeque<(Slot, Flight)> = VecDeque::new();
        let mut next = range.start;
        let mut codes = Vec::new();
        let mut stats = RunStats::default();
        self.pace.begin();
        loop {
            while next < range.end && flights.len() < IN_FLIGHT {
                fail_if_stopped(stop)?;
                let (slot, flight) = self.launch(next, range.end)?;
                next += u64::from(flight.nodes);
                flights.push_back((slot, flight));
            }
            let Some((slot, flight)) = flights.pop_front() else { return Ok(stats) };
            let waited = self.wait(&flight, stop)?;
            let seconds = slot.take(&self.gpu, flight.nodes, &mut codes)?;
            self.free.push(slot);
            self.pace.land(flight.nodes.into(), flight.submitted, waited, seconds);
            stats.add(flight.nodes.into(), seconds);
            sink(flight.start, &codes)?;
        }
    }

    /// Sends the chunk that begins at `start`.
    fn launch(&mut self, start: u64, end: u64) -> Result<(Slot, Flight)> {
        let (nodes, inputs) = self.inputs(start, self.pace.nodes().min(end - start))?;
        let slot = match self.free.pop().filter(|slot| slot.fits(nodes, inputs.words.len())) {
            Some(slot) => slot,
            None => self.slot(nodes, inputs.words.len()),
        };
        let flight = slot.submit(&self.gpu, &self.program, self.grid, start, nodes, &inputs);
        self.gpu.check()?;
        Ok((slot, flight))
    }

    /// A slot with some room to grow, so that few are made.
    fn slot(&self, nodes: u32, words: usize) -> Slot {
        let most = self.program.settings.most_nodes() as u32;
        let most_words = (self.most_input_bytes() / 4) as usize;
        let (room, words_room) = (nodes.next_power_of_two().min(most), words.next_power_of_two().min(most_words));
        Slot::new(&self.gpu, &self.program, room, words_room)
    }

    /// The inputs of at most `nodes` nodes; of fewer, when theirs would not fit the adapter.
    fn inputs(&mut self, start: u64, mut nodes: u64) -> Result<(u32, ShaderInputs)> {
        let most = self.most_input_bytes();
        loop {
            let inputs = self.kernel.inputs(start, nodes);
            let bytes = inputs.words.len() as u64 * 4;
            match nodes {
                _ if bytes <= most => return Ok((nodes as u32, inputs)),
                0 | 1 => {
                    let what = format!(
                        "the inputs of node {start} have {bytes} bytes and the adapter takes {most}; use the CPU \
                         (`--backend cpu`)"
                    );
                    return Err(self.gpu.error(&what));
                }
                _ => nodes = nodes.div_ceil(2),
            }
            self.pace.limit(nodes);
        }
    }

    fn most_input_bytes(&self) -> u64 {
        self.gpu.limits.max_storage_buffer_binding_size.min(self.gpu.limits.max_buffer_size)
    }

    /// Waits until a chunk has landed; false when it already had.
    fn wait(&self, flight: &Flight, stop: &AtomicBool) -> Result<bool> {
        self.poll(wgpu::PollType::Poll)?;
        let mut waited = false;
        while !flight.landed(&self.gpu)? {
            waited = true;
            fail_if_stopped(stop)?;
            self.poll(wgpu::PollType::Wait { submission_index: Some(flight.index.clone()), timeout: Some(PATIENCE) })?;
        }
        Ok(waited)
    }

    fn poll(&self, how: wgpu::PollType) -> Result<()> {
        // wgpu panics when the wait itself fails, as it does on a device lost by a driver's reset.
        let outcome = caught(|| self.gpu.device.poll(how));
        self.gpu.check()?;
        match outcome {
            Some(Ok(_) | Err(wgpu::PollError::Timeout)) => Ok(()),
            Some(Err(e)) => Err(self.gpu.error(&e.to_string())),
            None => Err(self.gpu.error("the device failed while it was waited for")),
        }
    }
}

impl RunStats {
    fn add(&mut self, nodes: u64, seconds: Option<f64>) {
        self.nodes += nodes;
        self.chunks += 1;
        self.largest_chunk = self.largest_chunk.max(nodes);
        if let Some(seconds) = seconds {
            *self.device_seconds.get_or_insert(0.0) += seconds;
        }
    }
}

/// Fails when the user asked to stop.
fn fail_if_stopped(stop: &AtomicBool) -> Result<()> {
    if stop.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
}
