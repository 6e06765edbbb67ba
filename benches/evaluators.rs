//! How fast each evaluator is, in one run, as a table; with a peer's results beside (see `benches/run`) also the ratio
//! to it.
//!
//! Every line is the best of a few rounds, so that other work on the machine disturbs it little.

use fearless_simd::Level;
use spiral_atlas::atlas::{Atlas, Spec, Writer};
use spiral_atlas::eval::{Backend, Chunk, Job, evaluate};
use spiral_atlas::family::cubic::{ANY_SPIRAL, Cubic, Datum, SPIRAL, solve};
use spiral_atlas::family::{Code, Family, Table};
use spiral_atlas::grid::{Axis, Grid, MAX_AXES, Spacing};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Nodes that the filter gets at a time, as in a run.
const PIECE: usize = 1 << 17;
/// Data of the single answers.
const SAMPLE: usize = 4096;

fn main() -> Outcome<()> {
    let grid = grid([37, 41, 39, 43])?;
    let peer = Peer::read(&grid)?;
    let codes = filtered(&*Cubic.table(&grid)?, &grid)?;
    describe(&grid, &codes, peer.as_ref());

    println!("\n{:44} {:>12} {:>10}", "whole grids", "Mnodes/s", "x NumPy");
    let line = |name: &str, seconds: f64| {
        let rate = grid.len() as f64 / seconds;
        let ratio = peer.as_ref().map_or("-".into(), |p| format!("{:.1}", rate / p.rate));
        println!("{name:44} {:12.2} {ratio:>10}", rate / 1e6);
    };
    if let Some(peer) = &peer {
        line("NumPy, nothing proved", grid.len() as f64 / peer.rate);
    }
    for (name, level) in levels() {
        let table = Cubic.table_at(&grid, level)?;
        let mut out = vec![Code::UNDECIDED; PIECE];
        line(&format!("f64 step, one thread, {name}"), best(5, || sweep(&*table, &grid, &mut out)));
    }
    for threads in [1, 2] {
        line(&format!("whole ladder, cpu, threads: {threads}"), run(&grid, &[], &Backend::Cpu, threads, 5)?);
    }
    line("  with f0, f1, threads: 1", run(&grid, &[0, 1], &Backend::Cpu, 1, 1)?);
    line("  with f0, f1, margin, threads: 1", run(&grid, &[0, 1, 2], &Backend::Cpu, 1, 1)?);
    gpu(&grid, line)?;

    println!("\n{:44} {:>12}", "single answers", "ns each");
    let line = |name: &str, seconds: f64, count: usize| println!("{name:44} {:12.1}", seconds / count as f64 * 1e9);
    answers(&grid, &codes, line)?;
    lookups(line)
}

/// A grid like quickstart's.
fn grid([n0, n1, n2, n3]: [usize; 4]) -> Outcome<Grid> {
    let linear = |name, lo, hi, count| Axis::new(name, Spacing::Linear { lo, hi, count });
    Ok(Grid::new(vec![
        linear("phi0", 0.1, 1.2, n0)?,
        linear("phi1", 0.2, 1.5, n1)?,
        linear("kappa0", 0.02, 1.0, n2)?,
        Axis::new("kappa1", Spacing::Log { lo: 1.0, hi: 100.0, count: n3 })?,
    ])?)
}

/// Each SIMD level this machine has, narrowest first.
fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let levels = [
            ("SSE2", best.as_sse2().map(Level::Sse2)),
            ("SSE4.2", best.as_sse4_2().map(Level::Sse4_2)),
            ("AVX2", best.as_avx2().map(Level::Avx2)),
            ("AVX-512", best.as_avx512().map(Level::Avx512)),
        ];
        levels.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    vec![("widest SIMD", best)]
}

/// Seconds of the fastest of some rounds.
fn best(rounds: u32, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let started = Instant::now();
        work();
        started.elapsed().as_secs_f64()
    };
    (0..rounds).map(time).fold(f64::INFINITY, f64::min)
}

/// Works through all items, keeping the compiler from leaving any out.
fn each<T, R>(items: &[T], work: impl Fn(&T) -> R) {
    for item in items {
        black_box(work(black_box(item)));
    }
}

/// The f64 step over the whole grid, a piece at a time into the same buffer.
fn sweep(table: &dyn Table, grid: &Grid, out: &mut [Code]) {
    for start in (0..grid.len()).step_by(out.len()) {
        let len = (grid.len() - start).min(out.len() as u64) as usize;
        table.filter(start, black_box(&mut out[..len]));
    }
}

/// All codes of a grid.
fn filtered(table: &dyn Table, grid: &Grid) -> Outcome<Vec<Code>> {
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    table.filter(0, &mut codes);
    for (node, code) in codes.iter_mut().enumerate().filter(|(_, code)| **code == Code::UNDECIDED) {
        *code = table.exact(node as u64)?.0;
    }
    Ok(codes)
}

/// Seconds of a run through the whole pipeline.
fn run(grid: &Grid, scalars: &[usize], backend: &Backend, threads: usize, rounds: u32) -> spiral_atlas::Result<f64> {
    let job = Job { family: &Cubic, grid, scalars };
    let mut failed = None;
    let seconds = best(rounds, || {
        let sink = |chunk: Chunk| {
            black_box(&chunk);
            Ok(())
        };
        if let Err(error) = evaluate(&job, backend, threads, &AtomicBool::new(false), sink) {
            failed = Some(error);
        }
    });
    failed.map_or(Ok(seconds), Err)
}

/// Every adapter, software ones too; each leaves what it cannot prove to one thread.
#[cfg(feature = "gpu")]
fn gpu(grid: &Grid, line: impl Fn(&str, f64)) -> Outcome<()> {
    let adapters = spiral_atlas::eval::gpu::adapters();
    if adapters.is_empty() {
        println!("whole ladder, gpu: no adapter here");
    }
    for adapter in adapters.iter().filter(|a| a.unusable.is_none()) {
        let name = adapter.label();
        let short: String = adapter.name.chars().take(16).collect();
        line(
            &format!("whole ladder, gpu: {short} ({})", adapter.kind),
            run(grid, &[], &Backend::Gpu(Some(name)), 1, 3)?,
        );
    }
    Ok(())
}

#[cfg(not(feature = "gpu"))]
fn gpu(_: &Grid, _: impl Fn(&str, f64)) -> Outcome<()> {
    println!("whole ladder, gpu: built without it");
    Ok(())
}

/// Numbers below `limit`, always the same (splitmix64).
fn random(limit: u64) -> impl Iterator<Item = u64> {
    let mut state = 0u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % limit
    })
}

/// One datum at a time: the library call behind `query`, and the interval step.
fn answers(grid: &Grid, codes: &[Code], line: impl Fn(&str, f64, usize)) -> Outcome<()> {
    let table = Cubic.table(grid)?;
    let kinds: [(&str, u8); 3] =
        [("any node", 0), ("nodes with some spiral", ANY_SPIRAL), ("nodes with a cubic spiral", SPIRAL)];
    for (name, flag) in kinds {
        let nodes: Vec<u64> =
            random(grid.len()).filter(|node| codes[*node as usize].flags() & flag == flag).take(SAMPLE).collect();
        let data: Vec<Datum> = nodes.iter().map(|node| datum(grid.node(*node))).collect();
        let solved = || each(&data, solve);
        line(&format!("solve, {name}"), best(5, solved), SAMPLE);
        let some = &nodes[..SAMPLE / 8];
        let exact = || each(some, |node| table.exact(*node));
        line(&format!("interval step, {name}"), best(2, exact), some.len());
    }
    Ok(())
}

fn datum([phi0, phi1, kappa0, kappa1, _]: [f64; MAX_AXES]) -> Datum {
    Datum { phi0, phi1, kappa0, kappa1 }
}

/// Lookups in an atlas that fits the cache, by index and by nearest node.
fn lookups(line: impl Fn(&str, f64, usize)) -> Outcome<()> {
    let folder = tempfile::tempdir()?;
    let grid = grid([11, 13, 12, 14])?;
    let path = folder.path().join("small.safetensors");
    let mut writer =
        Writer::create(&path, &Spec { name: "small", family: &Cubic, grid: &grid, scalars: &[], recipe: "" })?;
    let job = Job { family: &Cubic, grid: &grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 1, &AtomicBool::new(false), |chunk| writer.put(&chunk))?;
    writer.finish()?;
    let atlas = Atlas::open(&path)?;

    let indices: Vec<[usize; MAX_AXES]> = random(grid.len()).map(|node| grid.index(node)).take(SAMPLE).collect();
    let at = || each(&indices, |index| atlas.at(&index[..4]));
    line("atlas lookup by index", best(50, at), SAMPLE);
    let mut unit = random(1 << 53).map(|bits| bits as f64 / (1u64 << 53) as f64);
    let mut between = |axis: &Axis| {
        axis.values()[0] + unit.next().unwrap_or(0.5) * (axis.values()[axis.values().len() - 1] - axis.values()[0])
    };
    let mut point = |_| -> Outcome<[f64; 4]> {
        let point: Vec<f64> = grid.axes().iter().map(&mut between).collect();
        Ok(point.as_slice().try_into()?)
    };
    let points = (0..SAMPLE).map(&mut point).collect::<Outcome<Vec<[f64; 4]>>>()?;
    let nearest = || each(&points, |point| atlas.nearest(point));
    line("atlas lookup by nearest node", best(50, nearest), SAMPLE);
    Ok(())
}

/// What the NumPy script found on the same grid.
struct Peer {
    rate: f64,
    flags: Vec<u8>,
    solutions: Vec<u8>,
}

impl Peer {
    /// Reads the folder that `SPIRAL_ATLAS_PEER` names, if it does.
    fn read(grid: &Grid) -> Outcome<Option<Peer>> {
        let Some(folder) = std::env::var_os("SPIRAL_ATLAS_PEER").map(PathBuf::from) else { return Ok(None) };
        let field = |name: &str| read_field(&folder.join(name), grid.len());
        let (flags, solutions) = (field("flags")?, field("solutions")?);
        let seconds: f64 = std::fs::read_to_string(folder.join("seconds"))?.trim().parse()?;
        Ok(Some(Peer { rate: grid.len() as f64 / seconds, flags, solutions }))
    }
}

fn read_field(path: &Path, nodes: u64) -> Outcome<Vec<u8>> {
    let bytes = std::fs::read(path)?;
    if bytes.len() as u64 == nodes {
        return Ok(bytes);
    }
    Err(format!("{} has {} bytes, the grid {nodes} nodes: the script's grid is another", path.display(), bytes.len())
        .into())
}

/// Nodes of each flag, and how many the peer has otherwise.
fn describe(grid: &Grid, codes: &[Code], peer: Option<&Peer>) {
    println!("{} nodes, {:?}", grid.len(), grid.shape());
    println!("{:44} {:>12} {:>10}", "flag", "nodes", "NumPy off");
    let line = |name: &str, yes: usize, off: Option<usize>| {
        println!("{name:44} {yes:12} {:>10}", off.map_or("-".into(), |n| n.to_string()));
    };
    for (bit, flag) in Cubic.about().flags.iter().enumerate() {
        let yes = codes.iter().filter(|c| c.flags() >> bit & 1 == 1).count();
        let off = |p: &Peer| codes.iter().zip(&p.flags).filter(|(c, f)| (c.flags() ^ **f) >> bit & 1 == 1).count();
        line(flag.name, yes, peer.map(off));
    }
    for count in Cubic.about().counts {
        let sum = codes.iter().map(|c| usize::from(count.of(c.counts()))).sum();
        let off =
            |p: &Peer| codes.iter().zip(&p.solutions).filter(|(c, s)| count.of(c.counts()) != count.of(**s)).count();
        line(count.name, sum, peer.map(off));
    }
}
