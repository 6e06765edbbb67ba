//! The ladder over a whole grid: a producer, workers that prove what is left, and chunks in order to a sink.
//!
//! Memory is bounded whatever the grid: at most `2 threads + 2` pieces of [`PIECE`] nodes exist at once, each with two
//! bytes of codes, two bytes of fields and four bytes a scalar a node (and, on a GPU, the engine's own buffers).

use super::report::Tally;
use super::{Backend, Chunk, Job, Report};
use crate::error::{Error, Result};
use crate::family::{Code, Table};
use crate::grid::Grid;
use crate::num::demand_ieee;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Instant;

/// Nodes a worker takes at a time.
const PIECE: u64 = 1 << 17;

/// Evaluates all nodes of a job; `sink` gets every chunk in flat order.
///
/// # Arguments
/// - `threads`: workers; at least 1.
/// - `stop`: when set, the run ends soon with [`Error::Interrupted`].
///
/// # Errors
/// What the family's [`crate::family::Family::table`] says of the grid, [`Error::Undecided`] naming a node,
/// [`Error::Gpu`], [`Error::Interrupted`], and whatever `sink` returns.
pub fn evaluate(
    job: &Job,
    backend: &Backend,
    threads: usize,
    stop: &AtomicBool,
    mut sink: impl FnMut(Chunk) -> Result<()>,
) -> Result<Report> {
    demand_ieee()?;
    let table = job.family.table(job.grid)?;
    let started = Instant::now();
    let mut report = Report::new(job, backend, threads);
    let gate = Gate::new(2 * threads as u64 + 2);
    let halt = Halt { ours: AtomicBool::new(false), users: stop };
    let release = || Release { halt: &halt, gate: &gate };
    std::thread::scope(|scope| {
        let (tasks, queue) = sync_channel::<Task>(threads);
        let (results, finished) = sync_channel::<Result<(Chunk, Tally)>>(threads);
        // Workers own the receiving end together: when all have left, the producer's next send fails.
        let queue = Arc::new(Mutex::new(queue));
        for _ in 0..threads {
            let (queue, results, halt, table, release) = (queue.clone(), results.clone(), &halt, &*table, release());
            scope.spawn(move || {
                let _release = release;
                work(job, table, &queue, &results, halt);
            });
        }
        drop((queue, results));
        let (gate_in, halt_in, table_in) = (&gate, &halt, &*table);
        let producer = scope.spawn(move || produce(job, backend, table_in, &tasks, gate_in, halt_in));
        let _release = release();
        let outcome = collect(&finished, &gate, &mut report, &mut sink);
        if outcome.is_err() {
            // The producer may wait at the gate and workers at the channel: let all of them run dry.
            halt.ours.store(true, Ordering::Relaxed);
            gate.open();
            finished.iter().for_each(drop);
        }
        let produced = producer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        // A failed device ends the stream early; its word comes before the workers' "interrupted".
        let facts = match (produced, outcome) {
            (Ok(facts), Ok(())) => facts,
            (Err(Error::Interrupted), Err(e)) | (Ok(_), Err(e)) | (Err(e), _) => return Err(e),
        };
        report.device = facts;
        Ok(())
    })?;
    if stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    report.seconds = started.elapsed().as_secs_f64();
    Ok(report)
}

/// A run of nodes for a worker, with codes when a GPU has taken the first step.
struct Task {
    start: u64,
    len: usize,
    codes: Option<Vec<Code>>,
}

struct Halt<'s> {
    ours: AtomicBool,
    users: &'s AtomicBool,
}

impl Halt<'_> {
    fn check(&self) -> Result<()> {
        let stop = self.ours.load(Ordering::Relaxed) || self.users.load(Ordering::Relaxed);
        if stop { Err(Error::Interrupted) } else { Ok(()) }
    }
}

/// Ends the run when its holder panics, so that nobody waits for ever and the panic gets through.
struct Release<'r> {
    halt: &'r Halt<'r>,
    gate: &'r Gate,
}

impl Drop for Release<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.halt.ours.store(true, Ordering::Relaxed);
            self.gate.open();
        }
    }
}

/// Lets the producer run only so far ahead of the writer.
struct Gate {
    window: u64,
    state: Mutex<(u64, bool)>,
    moved: Condvar,
}

impl Gate {
    fn new(window: u64) -> Gate {
        Gate { window, state: Mutex::new((0, false)), moved: Condvar::new() }
    }

    /// Waits until fewer than `window` pieces are between this one and the writer.
    fn pass(&self, piece: u64) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        while !state.1 && piece >= state.0 + self.window {
            state = self.moved.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn written(&self) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).0 += 1;
        self.moved.notify_all();
    }

    fn open(&self) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).1 = true;
        self.moved.notify_all();
    }
}

/// What the producer knows of its device at the end.
pub(super) type Device = Option<super::DeviceReport>;

#[cfg_attr(not(feature = "gpu"), expect(unused_variables, reason = "only a GPU needs the table here"))]
fn produce(
    job: &Job,
    backend: &Backend,
    table: &dyn Table,
    tasks: &SyncSender<Task>,
    gate: &Gate,
    halt: &Halt,
) -> Result<Device> {
    let mut pieces = 0;
    let mut push = |start: u64, codes: Option<&[Code]>, len: u64| {
        for from in (0..len).step_by(PIECE as usize) {
            halt.check()?;
            gate.pass(pieces);
            pieces += 1;
            let len = PIECE.min(len - from) as usize;
            let codes = codes.map(|c| c[from as usize..from as usize + len].to_vec());
            // Workers leave only when the run ends early.
            tasks.send(Task { start: start + from, len, codes }).map_err(|_| Error::Interrupted)?;
        }
        Ok(())
    };
    match backend {
        Backend::Cpu => push(0, None, job.grid.len()).map(|()| None),
        #[cfg(feature = "gpu")]
        Backend::Gpu(choice) => {
            let mut engine = super::gpu::Engine::new(choice.as_deref(), table, job.grid, &Default::default())?;
            let stats = engine
                .run(0..job.grid.len(), halt.users, |start, codes| push(start, Some(codes), codes.len() as u64))?;
            Ok(Some(super::DeviceReport { adapter: engine.adapter().clone(), run: stats }))
        }
    }
}

fn work(
    job: &Job,
    table: &dyn Table,
    queue: &Mutex<Receiver<Task>>,
    results: &SyncSender<Result<(Chunk, Tally)>>,
    halt: &Halt,
) {
    loop {
        let task = queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok(task) = task else { return };
        let done = halt.check().and_then(|()| finish(job, table, task, halt));
        if results.send(done).is_err() {
            return;
        }
    }
}

/// Takes a piece up the ladder and turns its codes into fields.
fn finish(job: &Job, table: &dyn Table, task: Task, halt: &Halt) -> Result<(Chunk, Tally)> {
    let mut tally = Tally::default();
    let mut codes = match task.codes {
        Some(mut codes) => {
            tally.undecided_f32 = retry(&mut codes, |i, code| table.filter(task.start + i as u64, code));
            codes
        }
        None => {
            let mut codes = vec![Code::UNDECIDED; task.len];
            table.filter(task.start, &mut codes);
            codes
        }
    };
    for (i, code) in codes.iter_mut().enumerate().filter(|(_, code)| **code == Code::UNDECIDED) {
        halt.check()?;
        let node = task.start + i as u64;
        let (exact, bits) = table.exact(node).map_err(|e| name_node(e, node, job.grid))?;
        tally.undecided_f64 += 1;
        tally.most_bits = tally.most_bits.max(bits);
        *code = exact;
    }
    let mut chunk = Chunk {
        start: task.start,
        flags: codes.iter().map(|c| c.flags()).collect(),
        solutions: codes.iter().map(|c| c.counts()).collect(),
        scalars: vec![Vec::with_capacity(if job.scalars.is_empty() { 0 } else { codes.len() }); job.scalars.len()],
    };
    for (bit, count) in tally.flags.iter_mut().enumerate() {
        // Sums of bytes that cannot overflow, so that many are taken at a time.
        let ones = |some: &[u8]| some.iter().fold(0u8, |sum, flags| sum + (flags >> bit & 1));
        *count = chunk.flags.chunks(u8::MAX.into()).map(|some| u64::from(ones(some))).sum();
    }
    if !job.scalars.is_empty() {
        let mut values = vec![0.0; job.scalars.len()];
        for (i, code) in codes.iter().enumerate() {
            if i % 1024 == 0 {
                halt.check()?;
            }
            let node = task.start + i as u64;
            table.scalars(node, *code, job.scalars, &mut values).map_err(|e| name_node(e, node, job.grid))?;
            for (field, value) in chunk.scalars.iter_mut().zip(&values) {
                field.push(*value);
            }
        }
    }
    Ok((chunk, tally))
}

/// Evaluates the undecided codes again, runs of neighbours together; returns how many there were.
fn retry(codes: &mut [Code], mut again: impl FnMut(usize, &mut [Code])) -> u64 {
    let (mut at, mut count) = (0, 0);
    while at < codes.len() {
        let run = codes[at..].iter().take_while(|c| **c == Code::UNDECIDED).count();
        if run > 0 {
            again(at, &mut codes[at..at + run]);
            count += run as u64;
        }
        at += run.max(1);
    }
    count
}

pub(super) fn name_node(error: Error, node: u64, grid: &Grid) -> Error {
    match error {
        Error::Undecided { what, bits, .. } => {
            Error::Undecided { node: Some(node), coordinates: grid.describe(node), what, bits }
        }
        other => other,
    }
}

/// Puts chunks in order and hands them on.
fn collect(
    finished: &Receiver<Result<(Chunk, Tally)>>,
    gate: &Gate,
    report: &mut Report,
    sink: &mut impl FnMut(Chunk) -> Result<()>,
) -> Result<()> {
    let mut waiting: BTreeMap<u64, (Chunk, Tally)> = BTreeMap::new();
    let mut next = 0;
    for done in finished {
        let (chunk, tally) = done?;
        waiting.insert(chunk.start, (chunk, tally));
        while let Some((chunk, tally)) = waiting.remove(&next) {
            next += chunk.len() as u64;
            report.add(&chunk, &tally);
            sink(chunk)?;
            gate.written();
        }
    }
    Ok(())
}
