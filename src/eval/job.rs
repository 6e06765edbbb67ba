//! What a run is to do.

use crate::family::Family;
use crate::grid::Grid;

/// What to evaluate.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// The family.
    pub family: &'static dyn Family,
    /// The grid.
    pub grid: &'a Grid,
    /// Which of the family's scalars, by index.
    pub scalars: &'a [usize],
}

/// Who takes the first step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Backend {
    /// SIMD on the processor, f64 first.
    Cpu,
    /// A GPU, f32 first: the adapter whose label contains the text, or the best hardware adapter.
    #[cfg(feature = "gpu")]
    Gpu(Option<String>),
}
