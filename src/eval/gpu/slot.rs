//! One set of buffers: the inputs and codes of a chunk in flight.

use super::adapter::Gpu;
use super::program::Program;
use super::{GROUP_SIZE, Settings};
use crate::error::Result;
use crate::family::{Code, ShaderInputs};
use crate::grid::Grid;
use bytemuck::{Pod, Zeroable};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Instant;
use wgpu::BufferUsages as Usage;

/// The uniform `params` of `lib/main.wgsl`, field for field.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub(super) struct Params {
    shape: [u32; 4],
    first: [u32; 4],
    one: [u32; 4],
    hop: [u32; 4],
    offsets: [u32; 4],
    count: u32,
    /// 2.
    two: u32,
    // A uniform's size is a multiple of 16 bytes.
    padding: [u32; 2],
}

impl Params {
    /// The chunk of `count` nodes from `start` on.
    pub(super) fn new(grid: &Grid, start: u64, count: u32, offsets: [u32; 4]) -> Params {
        // Shaders have four digits: of five axes the first two are one to them.
        let mut shape = [1; 4];
        for (slot, n) in shape.iter_mut().zip(&grid.shape()[grid.axes().len().saturating_sub(4)..]) {
            *slot = *n as u32;
        }
        let mut first = digits(&shape, 0);
        let mut rest = start;
        for (slot, n) in first.iter_mut().zip(&shape).skip(1).rev() {
            *slot = (rest % u64::from(*n)) as u32;
            rest /= u64::from(*n);
        }
        // It wraps, as the shaders' own arithmetic does.
        first[0] = rest as u32;
        Params {
            shape,
            first,
            one: digits(&shape, 1),
            hop: digits(&shape, 2 * GROUP_SIZE - 2),
            offsets,
            count,
            two: 2,
            padding: [0; 2],
        }
    }
}

/// A number in the mixed radix of a shape, last digit fastest; the first digit may run past its count, because
/// past the end of the grid there is nothing to index.
fn digits(shape: &[u32; 4], mut number: u32) -> [u32; 4] {
    let mut digits = [0; 4];
    for i in (1..4).rev() {
        digits[i] = number % shape[i];
        number /= shape[i];
    }
    digits[0] = number;
    digits
}

/// Words that hold the codes of so many nodes.
fn words(nodes: u32) -> u64 {
    u64::from(nodes).div_ceil(2)
}

/// Workgroups in x and y for so many nodes (at most [`Settings::most_nodes`]), neither above the settings' limit.
fn groups(nodes: u32, settings: &Settings) -> (u32, u32) {
    let groups = u64::from(nodes).div_ceil(settings.nodes_per_group()).max(1) as u32;
    let x = groups.min(settings.groups_per_dimension);
    (x, groups.div_ceil(x))
}

/// A chunk that the device works on.
pub(super) struct Flight {
    pub start: u64,
    pub nodes: u32,
    pub submitted: Instant,
    pub index: wgpu::SubmissionIndex,
    /// Whether the read-back buffer could be mapped, once that is known.
    mapped: Receiver<bool>,
}

impl Flight {
    /// Whether the codes have arrived; an error when they never will.
    pub(super) fn landed(&self, gpu: &Gpu) -> Result<bool> {
        match self.mapped.try_recv() {
            Ok(true) => Ok(true),
            Err(TryRecvError::Empty) => Ok(false),
            Ok(false) | Err(TryRecvError::Disconnected) => {
                gpu.check()?;
                Err(gpu.error("its results could not be read back"))
            }
        }
    }
}

/// Buffers for one chunk, enlarged when a chunk needs it, and otherwise reused.
pub(super) struct Slot {
    params: wgpu::Buffer,
    inputs: wgpu::Buffer,
    codes: wgpu::Buffer,
    readback: wgpu::Buffer,
    bind: wgpu::BindGroup,
    timer: Option<Timer>,
}

struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
}

/// Bytes after the codes in the read-back buffer: two timestamps.
const TIMER_BYTES: u64 = 16;

impl Slot {
    /// Buffers for `nodes` nodes and `inputs` words.
    pub(super) fn new(gpu: &Gpu, program: &Program, nodes: u32, inputs: usize) -> Slot {
        let buffer = |label, size, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        // Timestamps are read as u64 after the codes: keep them aligned.
        let bytes = (words(nodes) * 4).next_multiple_of(8).max(8);
        let params = buffer("params", size_of::<Params>() as u64, Usage::UNIFORM | Usage::COPY_DST);
        let inputs = buffer("inputs", (inputs as u64 * 4).max(4), Usage::STORAGE | Usage::COPY_DST);
        let codes = buffer("codes", bytes, Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST);
        let readback = buffer("readback", bytes + TIMER_BYTES, Usage::MAP_READ | Usage::COPY_DST);
        let entries = [&params, &inputs, &codes];
        let bind = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("chunk"),
            layout: &program.layout,
            entries: &std::array::from_fn::<_, 3, _>(|i| wgpu::BindGroupEntry {
                binding: i as u32,
                resource: entries[i].as_entire_binding(),
            }),
        });
        let timer = gpu.facts.timestamps.then(|| Timer {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("chunk"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer("timestamps", TIMER_BYTES, Usage::QUERY_RESOLVE | Usage::COPY_SRC),
        });
        Slot { params, inputs, codes, readback, bind, timer }
    }

    /// Whether a chunk of so many nodes and input words fits.
    pub(super) fn fits(&self, nodes: u32, inputs: usize) -> bool {
        words(nodes) * 4 <= self.codes.size() && inputs as u64 * 4 <= self.inputs.size()
    }

    /// Sends the chunk of `nodes` nodes from `start` on to the device.
    pub(super) fn submit(
        &self,
        gpu: &Gpu,
        program: &Program,
        grid: &Grid,
        start: u64,
        nodes: u32,
        inputs: &ShaderInputs,
    ) -> Flight {
        let params = Params::new(grid, start, nodes, inputs.offsets);
        gpu.queue.write_buffer(&self.params, 0, bytemuck::bytes_of(&params));
        gpu.queue.write_buffer(&self.inputs, 0, bytemuck::cast_slice(&inputs.words));
        let bytes = words(nodes) * 4;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("chunk") });
        // Zero says undecided: what a faulty driver does not write climbs the ladder, and no earlier chunk shines
        // through.
        encoder.clear_buffer(&self.codes, 0, Some(bytes));
        {
            let timestamp_writes = self.timer.as_ref().map(|timer| wgpu::ComputePassTimestampWrites {
                query_set: &timer.queries,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            });
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("chunk"), timestamp_writes });
            pass.set_pipeline(&program.pipeline);
            pass.set_bind_group(0, &self.bind, &[]);
            let (x, y) = groups(nodes, &program.settings);
            pass.dispatch_workgroups(x, y, 1);
        }
        encoder.copy_buffer_to_buffer(&self.codes, 0, &self.readback, 0, bytes);
        if let Some(timer) = &self.timer {
            encoder.resolve_query_set(&timer.queries, 0..2, &timer.resolved, 0);
            encoder.copy_buffer_to_buffer(&timer.resolved, 0, &self.readback, self.codes.size(), TIMER_BYTES);
        }
        let submitted = Instant::now();
        let index = gpu.queue.submit([encoder.finish()]);
        let (send, mapped) = channel();
        // The receiver may be gone by then (an interrupted run): nothing to report to anyone.
        self.readback.map_async(wgpu::MapMode::Read, .., move |result| {
            let _ = send.send(result.is_ok());
        });
        Flight { start, nodes, submitted, index, mapped }
    }

    /// Takes the codes of a landed chunk, and the device's seconds where it reports them.
    pub(super) fn take(&self, gpu: &Gpu, nodes: u32, codes: &mut Vec<Code>) -> Result<Option<f64>> {
        let seconds = {
            let view = self.readback.get_mapped_range(..).map_err(|e| gpu.error(&e.to_string()))?;
            codes.clear();
            let pairs = view.chunks_exact(2).take(nodes as usize);
            codes.extend(pairs.map(|b| Code(!u16::from_le_bytes([b[0], b[1]]))));
            self.timer.as_ref().and_then(|_| seconds(gpu, view.get(self.codes.size() as usize..)?))
        };
        self.readback.unmap();
        Ok(seconds)
    }
}

/// Seconds between two timestamps; `None` when the device's clock was reset between them.
fn seconds(gpu: &Gpu, bytes: &[u8]) -> Option<f64> {
    let (begin, rest) = bytes.split_first_chunk()?;
    let (end, _) = rest.split_first_chunk()?;
    let ticks = u64::from_le_bytes(*end).checked_sub(u64::from_le_bytes(*begin))?;
    Some(ticks as f64 * f64::from(gpu.queue.get_timestamp_period()) * 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_add_up() {
        for shape in [[3, 5, 7, 2], [1, 1, 1, 1], [9, 1, 1, 1], [1 << 24, 1 << 24, 1, 1], [2, 3, 1, 1000]] {
            for number in [0, 1, 126, 1_000_003] {
                let digits = digits(&shape, number);
                let flat = digits.iter().zip(shape).fold(0u64, |flat, (d, n)| flat * u64::from(n) + u64::from(*d));
                assert_eq!(flat, u64::from(number), "{shape:?}");
                assert!((1..4).all(|i| digits[i] < shape[i]));
            }
        }
    }

    #[test]
    fn groups_cover_the_nodes_within_the_limit() {
        for limit in [1, 2, 5, 65535] {
            let settings = Settings { words_per_thread: 4, groups_per_dimension: limit, ..Settings::default() };
            let (group, most) = (settings.nodes_per_group() as u32, settings.most_nodes() as u32);
            for nodes in
                [1, group - 1, group, group + 1, 3 * group + 1, most - 1, most].into_iter().filter(|n| *n <= most)
            {
                let (x, y) = groups(nodes, &settings);
                assert!(x <= limit && y <= limit && x * y * group >= nodes, "{nodes} nodes, limit {limit}: {x} {y}");
                assert!((x * y - x) * group < nodes, "idle rows: {nodes} nodes, limit {limit}: {x} {y}");
            }
        }
    }
}
