//! How many nodes the next chunk has: as many as keep one dispatch short on this adapter.

use std::time::Instant;

/// Aim for the device's time per chunk, seconds: long enough to hide submission, far below the 2 s after which
/// operating systems reset a GPU, and short enough that a desktop stays usable and an interrupt is prompt.
const TARGET: f64 = 0.05;
/// Nodes of the first chunk, before anything is known about the adapter.
const FIRST: u64 = 1 << 16;
/// No chunk is made smaller for speed's sake: one workgroup or so.
const LEAST: u64 = 1 << 10;
/// Growth from one chunk to the next, so that one odd measurement cannot make a dispatch of seconds.
const GROWTH: f64 = 4.0;

/// The chunk size, adapted to measured times.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    nodes: u64,
    most: u64,
    /// When the previous chunk landed, if that was seen as it happened.
    landed: Option<Instant>,
}

impl Pace {
    /// Starts small; never above `most` nodes.
    pub(super) fn new(most: u64) -> Pace {
        Pace { nodes: FIRST.min(most), most, landed: None }
    }

    /// Nodes for the next chunk.
    pub(super) fn nodes(&self) -> u64 {
        self.nodes
    }

    /// Never again more than `most` nodes (their inputs would not fit).
    pub(super) fn limit(&mut self, most: u64) {
        self.most = self.most.min(most);
        self.nodes = self.nodes.min(most);
    }

    /// A run begins: the device is idle.
    pub(super) fn begin(&mut self) {
        self.landed = Some(Instant::now());
    }

    /// A chunk landed. Without the device's own time, the wall clock serves when the device was the bottleneck, that is
    /// when this chunk and the one before were waited for: then it worked on this one from the later of submission and
    /// the previous landing until now.
    pub(super) fn land(&mut self, nodes: u64, submitted: Instant, waited: bool, device_seconds: Option<f64>) {
        let now = Instant::now();
        let wall = self.landed.filter(|_| waited).map(|previous| (now - previous.max(submitted)).as_secs_f64());
        self.landed = waited.then_some(now);
        if let Some(seconds) = device_seconds.or(wall) {
            self.observe(nodes, seconds);
        }
    }

    /// Takes a chunk's time into account. A chunk that was cut short says little about rates, so it is passed over.
    fn observe(&mut self, nodes: u64, seconds: f64) {
        if nodes * 2 < self.nodes {
            return;
        }
        let factor = (TARGET / seconds.max(1e-9)).min(GROWTH);
        let ideal = (nodes as f64 * factor) as u64 / LEAST * LEAST;
        self.nodes = ideal.max(LEAST).min(self.most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs chunks at `rate` nodes per second until the size is steady.
    fn settle(pace: &mut Pace, rate: f64) -> f64 {
        for _ in 0..20 {
            let nodes = pace.nodes();
            pace.observe(nodes, nodes as f64 / rate);
        }
        pace.nodes() as f64 / rate
    }

    #[test]
    fn settles_near_the_target_and_within_the_limit() {
        let mut pace = Pace::new(1 << 23);
        let seconds = settle(&mut pace, 33e6);
        assert!((0.8 * TARGET..=TARGET).contains(&seconds), "{seconds}");
        let seconds = settle(&mut pace, 1e6);
        assert!((0.8 * TARGET..=TARGET).contains(&seconds), "{seconds}");
        settle(&mut pace, 1e10);
        assert_eq!(pace.nodes(), 1 << 23);
        pace.limit(1000);
        settle(&mut pace, 1e10);
        assert_eq!(pace.nodes(), 1000);
    }

    #[test]
    fn grows_by_steps_and_ignores_remainders() {
        let mut pace = Pace::new(1 << 23);
        pace.observe(FIRST, 1e-12);
        assert_eq!(pace.nodes(), 4 * FIRST);
        pace.observe(7, 1.0);
        assert_eq!(pace.nodes(), 4 * FIRST);
        pace.observe(4 * FIRST, f64::INFINITY);
        assert_eq!(pace.nodes(), LEAST);
    }
}
