//! A panic ends a run instead of hanging it, and an error of the sink is what the caller gets.

use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::family::cubic::Cubic;
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::channel;
use std::time::Duration;

fn run(sink: impl FnMut(spiral_atlas::eval::Chunk) -> Result<()>) -> Result<()> {
    let axis = |name: &str, lo: f64, hi: f64, count| Axis::new(name, Spacing::Linear { lo, hi, count }).unwrap();
    // Forty pieces: more than the gate lets through at once.
    let axes = vec![
        axis("phi0", 0.1, 0.9, 80),
        axis("phi1", 0.2, 1.6, 64),
        axis("kappa0", -0.5, 0.0, 32),
        axis("kappa1", 0.1, 1.0, 32),
    ];
    let grid = Grid::new(axes).unwrap();
    let job = Job { family: &Cubic, grid: &grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 2, &AtomicBool::new(false), sink).map(drop)
}

/// Fails when `work` does not end within a minute.
fn within_a_minute<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (done, result) = channel();
    std::thread::spawn(move || done.send(work()));
    result.recv_timeout(Duration::from_secs(60)).expect("the run hangs")
}

#[test]
fn a_panicking_sink_gets_through() {
    let outcome = within_a_minute(|| catch_unwind(AssertUnwindSafe(|| run(|_| panic!("on purpose")))).is_err());
    assert!(outcome);
}

#[test]
fn an_error_of_the_sink_ends_the_run() {
    let error = within_a_minute(|| run(|_| Err(Error::invalid("on purpose"))).unwrap_err());
    assert_eq!(error.to_string(), "on purpose");
}

#[test]
fn chunks_come_in_order_and_whole() {
    let nodes = within_a_minute(|| {
        let mut next = 0;
        run(|chunk| {
            assert_eq!(chunk.start, next);
            next += chunk.len() as u64;
            Ok(())
        })
        .unwrap();
        next
    });
    assert_eq!(nodes, 80 * 64 * 32 * 32);
}
