//! The engine against a CPU twin of a shader that hashes everything it is given, on every adapter there is.

use crate::adapters::labels;
use spiral_atlas::error::Error;
use spiral_atlas::eval::gpu::{Engine, RunStats, Settings, adapters as all_adapters, select};
use spiral_atlas::family::{Code, Kernel, Shader, ShaderInputs};
use spiral_atlas::grid::{Axis, Grid, MAX_COUNT, Spacing};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

const SHADER: &str = "
fn mix(hash: u32, x: u32) -> u32 {
    return (hash ^ x) * 16777619u;
}

fn evaluate(index: vec4<u32>) -> u32 {
    var hash = mix(SALT, u32(inputs[index.x - params.offsets.x]));
    hash = mix(hash, u32(inputs[params.offsets.y + index.y]));
    hash = mix(hash, u32(inputs[params.offsets.z + index.z]));
    hash = mix(hash, u32(inputs[params.offsets.w + index.w]));
    hash = mix(mix(mix(mix(hash, index.x), index.y), index.z), index.w);
    return (hash >> 16u) ^ hash;
}
";
const SALT: u32 = 2166136261;

/// Hashes indices and a table per axis. The first axis's table is cut to the chunk, so that inputs differ from chunk to
/// chunk.
struct Hash<'g> {
    grid: &'g Grid,
    salt: u32,
    shader: &'static str,
    /// Bytes of ballast for each node of a chunk.
    ballast: u64,
}

impl<'g> Hash<'g> {
    fn new(grid: &'g Grid) -> Hash<'g> {
        Hash { grid, salt: SALT, shader: SHADER, ballast: 0 }
    }

    /// What the table of an axis holds: whole numbers below 2^16, exact in f32.
    fn entry(axis: usize, i: usize) -> u32 {
        (i as u32).wrapping_mul(2654435761).rotate_left(5 * axis as u32) % 65521
    }

    /// The CPU twin of the shader.
    fn code(&self, node: u64) -> Code {
        let index = self.grid.index(node);
        let mix = |hash: u32, x: u32| (hash ^ x).wrapping_mul(16777619);
        let entries = (0..4).map(|axis| Hash::entry(axis, index[axis]));
        let hash = entries.chain(index[..4].iter().map(|i| *i as u32)).fold(self.salt, mix);
        Code(((hash >> 16) ^ hash) as u16)
    }
}

impl Kernel for Hash<'_> {
    fn shader(&self) -> Shader {
        Shader { constants: format!("const SALT: u32 = {}u;", self.salt), fragments: vec![("hash.wgsl", self.shader)] }
    }
    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        let (first, last) = (self.grid.index(start)[0], self.grid.index(start + len - 1)[0]);
        let mut words: Vec<f32> = (first..=last).map(|i| Hash::entry(0, i) as f32).collect();
        let mut offsets = [first as u32, 0, 0, 0];
        for (axis, offset) in offsets.iter_mut().enumerate().skip(1) {
            *offset = words.len() as u32;
            let count = self.grid.shape().get(axis).copied().unwrap_or(1);
            words.extend((0..count).map(|i| Hash::entry(axis, i) as f32));
        }
        words.resize(words.len() + (self.ballast * len / 4) as usize, f32::NAN);
        ShaderInputs { words, offsets }
    }
}

fn grid(counts: &[usize]) -> Grid {
    let axis = |(i, n): (usize, &usize)| {
        Axis::new(["u", "v", "w", "x"][i], Spacing::Values((0..*n).map(|k| k as f64).collect())).unwrap()
    };
    Grid::new(counts.iter().enumerate().map(axis).collect()).unwrap()
}

/// What the sink saw: for each node how often it was written, and its code.
struct Seen {
    range: Range<u64>,
    times: Vec<u8>,
    codes: Vec<Code>,
}

impl Seen {
    fn new(range: Range<u64>) -> Seen {
        let n = (range.end - range.start) as usize;
        Seen { range, times: vec![0; n], codes: vec![Code(0x5a5a); n] }
    }

    fn take(&mut self, start: u64, codes: &[Code]) {
        let at = (start - self.range.start) as usize;
        self.codes[at..at + codes.len()].copy_from_slice(codes);
        self.times[at..at + codes.len()].iter_mut().for_each(|t| *t += 1);
    }

    /// Nodes that were not written once, or whose code is not the twin's.
    fn differences(&self, table: &Hash) -> Vec<u64> {
        assert!(!self.codes.is_empty(), "nothing was compared");
        let wrong = |(i, node): &(usize, u64)| self.times[*i] != 1 || self.codes[*i] != table.code(*node);
        self.range.clone().enumerate().filter(wrong).map(|(_, node)| node).collect()
    }
}

fn run(engine: &mut Engine, range: Range<u64>) -> (Seen, RunStats) {
    let mut seen = Seen::new(range.clone());
    let mut next = range.start;
    let stats = engine
        .run(range, &AtomicBool::new(false), |start, codes| {
            assert_eq!(start, next, "chunks come in order");
            next += codes.len() as u64;
            seen.take(start, codes);
            Ok(())
        })
        .unwrap();
    assert_eq!(stats.nodes, seen.codes.len() as u64);
    (seen, stats)
}

fn settings(words_per_thread: u32, chunk_nodes: u64, groups_per_dimension: u32) -> Settings {
    Settings { words_per_thread, chunk_nodes, groups_per_dimension }
}

#[test]
fn codes_equal_the_cpu_twin_in_all_shapes_and_cuts() {
    // Counts that differ, that are no multiple of a thread's or a group's nodes, and 1 in every place.
    let shapes: [&[usize]; 9] = [
        &[7],
        &[10_007],
        &[13, 5],
        &[1, 997],
        &[997, 1],
        &[11, 3, 7],
        &[19, 11, 3, 7],
        &[2, 3, 1, 1001],
        &[129, 1, 127, 2],
    ];
    let cuts = [settings(1, 1000, 65535), settings(3, 127, 2), settings(8, 1 << 23, 65535), settings(16, 2048, 1)];
    for label in labels() {
        for (shape, cut) in shapes.iter().flat_map(|s| cuts.iter().map(move |c| (s, c))) {
            let grid = grid(shape);
            let table = Hash::new(&grid);
            let mut engine = Engine::new(Some(&label), &table, &grid, cut).unwrap();
            let (seen, stats) = run(&mut engine, 0..grid.len());
            assert_eq!(seen.differences(&table), [0; 0], "{label}, {shape:?}, {cut:?}");
            assert!(stats.largest_chunk <= cut.chunk_nodes && stats.chunks >= grid.len().div_ceil(cut.chunk_nodes));
        }
    }
}

#[test]
fn chunks_of_one_two_and_three_nodes_and_parts_of_a_grid() {
    let grid = grid(&[3, 2, 5, 4]);
    let table = Hash::new(&grid);
    for label in labels() {
        for nodes in 1..=3 {
            let mut engine = Engine::new(Some(&label), &table, &grid, &settings(4, nodes, 65535)).unwrap();
            for range in [0..grid.len(), 17..18, 1..grid.len() - 1, 119..120, 39..81] {
                let (seen, _) = run(&mut engine, range.clone());
                assert_eq!(seen.differences(&table), [0; 0], "{label}, {range:?} by {nodes}");
            }
            assert_eq!(run(&mut engine, 5..5).1, RunStats::default());
        }
    }
}

#[test]
fn ten_million_nodes_in_chunks_of_growing_size() {
    let grid = grid(&[103, 31, 101, 33]);
    let table = Hash::new(&grid);
    for label in labels() {
        let mut engine = Engine::new(Some(&label), &table, &grid, &Settings::default()).unwrap();
        let (seen, stats) = run(&mut engine, 0..grid.len());
        assert_eq!(seen.differences(&table).len(), 0, "{label}");
        assert!(stats.chunks > 2 && stats.largest_chunk > 1 << 16, "{label}: {stats:?}");
        assert_eq!(stats.device_seconds.is_some(), engine.adapter().timestamps, "{label}");
        assert!(stats.device_seconds.is_none_or(|s| s > 0.0 && s < 600.0), "{label}: {stats:?}");
    }
}

/// The longest axis there may be, where carries and the largest indices meet.
#[test]
fn the_longest_axis_carries() {
    let long = Axis::new("v", Spacing::Linear { lo: 0.0, hi: 1.0, count: MAX_COUNT }).unwrap();
    let grid = Grid::new(vec![grid(&[5]).axes()[0].clone(), long]).unwrap();
    let table = Hash::new(&grid);
    let row = MAX_COUNT as u64;
    for label in labels() {
        let mut engine = Engine::new(Some(&label), &table, &grid, &Settings::default()).unwrap();
        for range in [4 * row - 5001..4 * row + 3001, 5 * row - 777..5 * row] {
            let (seen, _) = run(&mut engine, range.clone());
            assert_eq!(seen.differences(&table), [0; 0], "{label}, {range:?}");
        }
    }
}

#[test]
fn the_comparison_reports_a_flipped_bit_a_gap_and_a_repeat() {
    let grid = grid(&[5, 3, 2, 7]);
    let table = Hash::new(&grid);
    let mut engine = Engine::new(Some(&labels()[0]), &table, &grid, &Settings::default()).unwrap();
    let (mut seen, _) = run(&mut engine, 0..grid.len());
    assert_eq!(seen.differences(&table), [0; 0]);
    for bit in 0..16 {
        seen.codes[101].0 ^= 1 << bit;
        assert_eq!(seen.differences(&table), [101]);
        seen.codes[101].0 ^= 1 << bit;
    }
    (seen.times[7], seen.times[8]) = (0, 2);
    assert_eq!(seen.differences(&table), [7, 8]);
    assert_eq!(Seen::new(0..grid.len()).differences(&table).len() as u64, grid.len(), "nothing arrived");
}

/// The codes come from the shader, not from the twin: another salt there, and almost every code differs.
#[test]
fn another_shader_gives_other_codes() {
    let grid = grid(&[50, 40]);
    let (table, other) = (Hash::new(&grid), Hash { salt: 1, ..Hash::new(&grid) });
    let mut engine = Engine::new(Some(&labels()[0]), &other, &grid, &Settings::default()).unwrap();
    let (seen, _) = run(&mut engine, 0..grid.len());
    assert!(seen.differences(&table).len() > 1900);
    assert_eq!(seen.differences(&other), [0; 0]);
}

/// Only the low 16 bits of what `evaluate` returns count: a stray high bit must not spoil the neighbour.
#[test]
fn high_bits_of_a_code_do_not_leak() {
    let grid = grid(&[257]);
    let shader = "fn evaluate(index: vec4<u32>) -> u32 { return SALT - SALT + index.x + 0xabcd0000u; }";
    let table = Hash { shader, ..Hash::new(&grid) };
    let mut engine = Engine::new(Some(&labels()[0]), &table, &grid, &Settings::default()).unwrap();
    let (seen, _) = run(&mut engine, 0..257);
    assert!(seen.codes.iter().enumerate().all(|(i, code)| code.0 == i as u16));
}

/// Nodes with few rounds of a loop, and every fifth with many.
const ROUNDS: &str = "
fn evaluate(index: vec4<u32>) -> u32 {
    let rounds = select(7u, 30000u, index.y % 5u == 0u);
    var hash = SALT;
    for (var i = 0u; i < rounds; i += 1u) {
        hash = (hash ^ i) * 16777619u;
    }
    return hash & 0x7fffu;
}
";

#[test]
fn a_driver_that_cuts_loops_short_leaves_nodes_undecided_never_wrong() {
    let grid = grid(&[40, 500]);
    let table = Hash { shader: ROUNDS, ..Hash::new(&grid) };
    let truth = |node: u64| {
        let rounds = if grid.index(node)[1].is_multiple_of(5) { 30_000 } else { 7 };
        Code((0..rounds).fold(SALT, |hash: u32, i: u32| (hash ^ i).wrapping_mul(16777619)) as u16 & 0x7fff)
    };
    for label in labels() {
        let mut engine = Engine::new(Some(&label), &table, &grid, &Settings::default()).unwrap();
        let (seen, _) = run(&mut engine, 0..grid.len());
        let open = seen.codes.iter().filter(|code| **code == Code::UNDECIDED).count();
        let wrong =
            (0..).zip(&seen.codes).filter(|(node, code)| **code != Code::UNDECIDED && **code != truth(*node)).count();
        println!("{label}: {open} of {} nodes left open", grid.len());
        assert_eq!(wrong, 0, "{label}");
        assert!(seen.times.iter().all(|n| *n == 1) && open < seen.codes.len(), "{label}: {open} open");
        // The limit is there, or this test shows nothing.
        assert!(!label.contains("llvmpipe") || open > 0, "{label} ran all loops to their end");
    }
}

#[test]
fn inputs_that_are_too_large_shrink_the_chunk_or_are_refused() {
    let grid = grid(&[30, 10]);
    // 2 MiB a node: at most 63 of them in the default limit of 128 MiB.
    let table = Hash { ballast: 2 << 20, ..Hash::new(&grid) };
    let label = &labels()[0];
    let mut engine = Engine::new(Some(label), &table, &grid, &Settings::default()).unwrap();
    let (seen, stats) = run(&mut engine, 0..100);
    assert_eq!(seen.differences(&table), [0; 0]);
    assert!(stats.largest_chunk < 64, "{stats:?}");

    let table = Hash { ballast: 300 << 20, ..Hash::new(&grid) };
    let mut engine = Engine::new(Some(label), &table, &grid, &Settings::default()).unwrap();
    let error = engine.run(7..8, &AtomicBool::new(false), |_, _| Ok(())).unwrap_err().to_string();
    assert!(error.contains("inputs of node 7") && error.contains("--backend cpu"), "{error}");
}

#[test]
fn an_interrupt_stops_between_chunks_and_the_engine_lives_on() {
    let grid = grid(&[100, 100]);
    let table = Hash::new(&grid);
    for label in labels() {
        let mut engine = Engine::new(Some(&label), &table, &grid, &settings(2, 100, 65535)).unwrap();
        let stop = AtomicBool::new(false);
        let mut chunks = 0;
        let result = engine.run(0..grid.len(), &stop, |_, _| {
            chunks += 1;
            stop.store(chunks == 5, Ordering::Relaxed);
            Ok(())
        });
        assert!(matches!(result, Err(Error::Interrupted)) && chunks < 10, "{label}: {result:?} after {chunks}");
        let result = engine.run(0..grid.len(), &AtomicBool::new(false), |start, _| {
            if start >= 300 { Err(Error::invalid("disk full")) } else { Ok(()) }
        });
        assert!(matches!(result, Err(Error::Domain(_))), "{label}: {result:?}");
        let (seen, _) = run(&mut engine, 0..grid.len());
        assert_eq!(seen.differences(&table), [0; 0], "{label}");
    }
}

#[test]
fn a_range_outside_the_grid_is_refused() {
    let grid = grid(&[4, 5]);
    let table = Hash::new(&grid);
    let mut engine = Engine::new(Some(&labels()[0]), &table, &grid, &Settings::default()).unwrap();
    #[expect(clippy::reversed_empty_ranges, reason = "the wrong range is what is tested")]
    for range in [0..21, 21..21, 3..2] {
        let result = engine.run(range, &AtomicBool::new(false), |_, _| unreachable!());
        assert!(matches!(&result, Err(Error::Domain(what)) if what.to_string().contains("grid of 20")), "{result:?}");
    }
}

#[test]
fn an_unknown_adapter_is_an_error_that_lists_those_there_are() {
    let error = select(Some("no such adapter")).unwrap_err().to_string();
    assert!(error.contains("`no such adapter`"), "{error}");
    for label in labels() {
        assert!(error.contains(&label), "{error}");
        assert_eq!(select(Some(&label.to_uppercase())).unwrap().label(), label);
    }
}

#[test]
fn auto_never_takes_a_software_adapter() {
    labels();
    match select(None) {
        Ok(facts) => assert!(["discrete", "integrated"].contains(&facts.kind), "{facts:?}"),
        Err(e) => {
            assert!(all_adapters().iter().all(|a| !["discrete", "integrated"].contains(&a.kind)));
            assert!(e.to_string().contains("--adapter"), "{e}");
        }
    }
}

#[test]
fn a_wrong_shader_is_an_error_at_its_own_line() {
    let grid = grid(&[4]);
    let table =
        Hash { shader: "\n\nfn evaluate(index: vec4<u32>) -> u32 {\n    return jndex.x;\n}\n", ..Hash::new(&grid) };
    let error =
        Engine::new(Some(&labels()[0]), &table, &grid, &Settings::default()).err().expect("the shader is wrong");
    assert!(error.to_string().contains("hash.wgsl:4:"), "{error}");
}

/// By hand: `cargo test --release --test gpu -- --ignored --nocapture measure`.
#[test]
#[ignore = "a measurement"]
fn measure_words_per_thread() {
    // About 500 operations, and branches that differ between neighbours.
    const HEAVY: &str = "
fn evaluate(index: vec4<u32>) -> u32 {
    let a = inputs[params.offsets.y + index.y] * 1e-5;
    let b = inputs[params.offsets.z + index.z] * 1e-5;
    var x = inputs[params.offsets.w + index.w] * 1e-5;
    for (var i = 0u; i < 60u; i += 1u) {
        x = x - (x * x * x - a * x - b) * 0.25 + a * (x - b) * 0.01;
        if x < 0.1 { x += 0.5 * a; }
    }
    return SALT - SALT + u32(clamp(x, 0.0, 1.0) * 65535.0);
}
";
    let grid = grid(&[103, 31, 101, 33]);
    for label in labels() {
        for (kind, shader) in [("light", SHADER), ("heavy", HEAVY)] {
            for words in [1, 2, 4, 8, 16, 32] {
                let table = Hash { shader, ..Hash::new(&grid) };
                let mut engine = Engine::new(Some(&label), &table, &grid, &settings(words, 1 << 23, 65535)).unwrap();
                let begin = std::time::Instant::now();
                let runs = 3;
                let mut stats = RunStats::default();
                for _ in 0..runs {
                    stats = engine.run(0..grid.len(), &AtomicBool::new(false), |_, _| Ok(())).unwrap();
                }
                let rate = |seconds: f64| grid.len() as f64 / seconds / 1e6;
                let wall = rate(begin.elapsed().as_secs_f64() / f64::from(runs));
                let device = stats.device_seconds.map_or(f64::NAN, rate);
                println!(
                    "{label} {kind} {words:2} words: Mnodes a second {wall:6.1} of wall, {device:6.1} of device \
                     (largest chunk {})",
                    stats.largest_chunk
                );
            }
        }
    }
}
