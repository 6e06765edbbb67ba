//! The GPU's fields are the CPU's, byte for byte, on every adapter; and what the f32 step decides is right by itself.
//!
//! These tests fail where there is no adapter; `tests/run` installs a software one.

use spiral_atlas::eval::gpu::{Engine, Settings};
use spiral_atlas::eval::{Backend, Chunk, Job, Report, evaluate};
use spiral_atlas::family::{self, Code, Family};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::sync::atomic::AtomicBool;

mod any_spiral;
mod cubic;
mod ph_path;
mod ph_quintic;
mod reach;
mod trig_quintic;

/// What is compared for one family.
struct Subject {
    family: &'static dyn Family,
    /// Grids of unlike counts, by name; the first is an ordinary one.
    grids: Vec<(&'static str, Grid)>,
    /// Nodes in all, at least.
    nodes: u64,
    /// On the first grid f32 leaves open at most one node in this many.
    rare: u64,
    /// A flag that f32 proves there, at one node in `often` at least.
    flag: u8,
    often: u64,
}

/// Two tests for each family.
macro_rules! families {
    ($($name:ident => $subject:expr,)*) => {
        $(mod $name {
            #[test]
            fn every_byte_is_the_cpus_on_every_adapter() {
                super::every_byte($subject);
            }
            #[test]
            fn few_nodes_climb_from_f32_and_none_is_wrong_before_the_climb() {
                super::few_nodes($subject);
            }
        })*

        #[test]
        fn every_family_is_compared() {
            let compared = [$($subject.family.about().name),*];
            assert!(family::all().iter().all(|f| compared.contains(&f.about().name)), "{compared:?}");
        }
    };
}

families! {
    on_cubic => crate::agreement::cubic::subject(),
    on_ph_quintic => crate::agreement::ph_quintic::subject(),
    on_any_spiral => crate::agreement::any_spiral::subject(),
    on_reach_cubic => crate::agreement::reach::cubic(),
    on_reach_ph => crate::agreement::reach::ph(),
    on_trig_quintic => crate::agreement::trig_quintic::subject(),
    on_ph_equal_length => crate::agreement::ph_path::equal_length(),
    on_ph_hermite => crate::agreement::ph_path::hermite(),
}

fn lin(name: &str, lo: f64, hi: f64, count: usize) -> Axis {
    Axis::new(name, Spacing::Linear { lo, hi, count }).unwrap()
}

fn log(name: &str, lo: f64, hi: f64, count: usize) -> Axis {
    Axis::new(name, Spacing::Log { lo, hi, count }).unwrap()
}

fn values(name: &str, values: &[f64]) -> Axis {
    Axis::new(name, Spacing::Values(values.to_vec())).unwrap()
}

fn grid(axes: Vec<Axis>) -> Grid {
    Grid::new(axes).unwrap()
}

fn all_chunks(job: &Job, backend: &Backend) -> (Vec<Chunk>, Report) {
    let mut chunks = Vec::new();
    let report = evaluate(job, backend, 2, &AtomicBool::new(false), |chunk| {
        chunks.push(chunk);
        Ok(())
    });
    (chunks, report.unwrap())
}

/// Number of bytes that differ and number compared.
fn differences(one: &[Chunk], two: &[Chunk]) -> (usize, usize) {
    // Field after field, as in a file: the chunks of two backends end at different nodes.
    let bytes = |chunks: &[Chunk]| -> Vec<u8> {
        let flags = chunks.iter().flat_map(|c| &c.flags);
        flags.chain(chunks.iter().flat_map(|c| &c.solutions)).copied().collect()
    };
    let (one, two) = (bytes(one), bytes(two));
    assert_eq!(one.len(), two.len());
    (one.iter().zip(&two).filter(|(a, b)| a != b).count(), one.len())
}

fn every_byte(subject: Subject) {
    let Subject { family, grids, nodes: least, .. } = subject;
    let mut nodes = 0;
    for (name, grid) in grids {
        let name = format!("{}, {name}", family.about().name);
        let job = Job { family, grid: &grid, scalars: &[] };
        let (cpu, report) = all_chunks(&job, &Backend::Cpu);
        println!(
            "{name}: {} nodes, {} undecided after f64, {} bits",
            grid.len(),
            report.undecided_f64,
            report.most_bits
        );
        for adapter in crate::adapters::labels() {
            let (gpu, report) = all_chunks(&job, &Backend::Gpu(Some(adapter.clone())));
            let f32 = report.undecided_f32.unwrap();
            println!("  {adapter}: {f32} undecided after f32, {:.1e} of all", f32 as f64 / grid.len() as f64);
            let (different, compared) = differences(&cpu, &gpu);
            assert_eq!(compared as u64, 2 * grid.len());
            assert_eq!(different, 0, "{name}, {adapter}");
        }
        nodes += grid.len();
        // The comparison notices one flipped bit, and only that.
        let mut flipped = cpu.clone();
        let at = flipped.len() / 2;
        let node = flipped[at].len() / 3;
        flipped[at].flags[node] ^= 16;
        assert_eq!(differences(&cpu, &flipped).0, 1);
    }
    assert!(nodes >= least, "{}: {nodes} nodes", family.about().name);
}

fn few_nodes(subject: Subject) {
    let Subject { family, grids, rare, flag, often, .. } = subject;
    let grid = &grids[0].1;
    let table = family.table(grid).unwrap();
    let mut truth = vec![Code::UNDECIDED; grid.len() as usize];
    table.filter(0, &mut truth);
    for adapter in crate::adapters::labels() {
        let name = format!("{}, {adapter}", family.about().name);
        let mut engine = Engine::new(Some(&adapter), &*table, grid, &Settings::default()).unwrap();
        let (mut open, mut wrong, mut yes) = (0u64, 0u64, 0u64);
        let stats = engine
            .run(0..grid.len(), &AtomicBool::new(false), |start, codes| {
                for (code, truth) in codes.iter().zip(&truth[start as usize..]) {
                    open += u64::from(*code == Code::UNDECIDED);
                    // What doubles leave open, the byte-for-byte comparison judges.
                    wrong += u64::from(*code != Code::UNDECIDED && *truth != Code::UNDECIDED && code != truth);
                    yes += u64::from(*code != Code::UNDECIDED && code.flags() & flag != 0);
                }
                Ok(())
            })
            .unwrap();
        println!("{name}: {open} of {} open after f32, {yes} with the flag", grid.len());
        assert_eq!((stats.nodes, wrong), (grid.len(), 0), "{name}");
        assert!(open > 0 && open * rare <= grid.len(), "{name}: {open} of {} open", grid.len());
        assert!(yes * often > grid.len(), "{name}: only {yes} with the flag");
    }
}
