//! From a grid to fields: evaluators, the ladder, and the agreement report.

pub mod agree;
#[cfg(feature = "gpu")]
pub mod gpu;
mod job;
mod pipeline;
mod report;

pub use job::{Backend, Job};
pub use pipeline::evaluate;
pub use report::{DeviceReport, Report};

/// The fields of a run of nodes, in flat order.
#[derive(Debug, Clone, PartialEq)]
pub struct Chunk {
    /// Flat index of the first node.
    pub start: u64,
    /// The `flags` byte of each node.
    pub flags: Vec<u8>,
    /// The `solutions` byte of each node.
    pub solutions: Vec<u8>,
    /// One array for each scalar of the recipe, in recipe order; [`crate::family::NO_VALUE`] where there is none.
    pub scalars: Vec<Vec<f32>>,
}

impl Chunk {
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.flags.len()
    }

    /// Whether it holds no node.
    pub fn is_empty(&self) -> bool {
        self.flags.is_empty()
    }
}
