//! The f32 step of a family, for a GPU: plain data, whoever runs it.

use super::record::Record;
use super::{Code, Flag};
use crate::grid::Grid;
use crate::num::COVER;

/// A family's f32 step on one grid.
pub trait Kernel: Sync {
    /// The family's part of the compute shader.
    fn shader(&self) -> Shader;

    /// The f32 inputs for the nodes `start .. start + len`; the layout is the shader's own business.
    fn inputs(&self, start: u64, len: u64) -> ShaderInputs;
}

/// The family's part of a compute shader. It must define `fn evaluate(index: vec4<u32>) -> u32`,
/// which returns a [`Code`] for the node with these axis indices, and may read `inputs` and `params.offsets`.
pub struct Shader {
    /// Constants generated from Rust.
    pub constants: String,
    /// `(file name, text)` of the fragments, in order.
    pub fragments: Vec<(&'static str, &'static str)>,
}

/// What a chunk of nodes reads on the GPU.
pub struct ShaderInputs {
    /// All tables, one after another.
    pub words: Vec<f32>,
    /// Where each table begins, and whatever else the family wants to say.
    pub offsets: [u32; 4],
}

/// A shader's constants in WGSL: flags by their bits, whole numbers, numbers, and what all shaders know.
pub(super) fn constants(flags: &[Flag], counts: &[(&str, usize)], numbers: &[(&str, f64)]) -> String {
    let whole = |name: &str, value: usize| format!("const {name}: u32 = {value}u;\n");
    let mut text = whole("UNDECIDED", Code::UNDECIDED.0.into());
    // What every question in a shader answers: OPEN where f32 cannot decide.
    text.extend(["NO", "YES", "OPEN"].iter().zip(0..).map(|(name, value)| whole(name, value)));
    text.extend(flags.iter().enumerate().map(|(bit, flag)| whole(flag.name, 1 << bit)));
    text.extend(counts.iter().map(|(name, count)| whole(name, *count)));
    let numbers = [("COVER", COVER)].iter().chain(numbers);
    text.extend(numbers.map(|(name, value)| format!("const {name}: f32 = {value:e};\n")));
    text
}

/// A shader's tables: the records that the nodes `start .. start + len` need, by the index of their first `A` axes,
/// then the words of each further axis, by index.
///
/// The offsets: the first of these indices, then where each further axis begins; the rest is the family's own, and 0
/// here.
pub(super) fn tables<const A: usize, R: Record>(
    grid: &Grid,
    (start, len): (u64, u64),
    records: impl Fn([f64; A]) -> R,
    words_of: &[&dyn Fn(f64) -> Vec<f32>],
) -> ShaderInputs {
    let (angles, further) = grid.axes().split_at(A);
    let each = further.iter().map(|axis| axis.values().len() as u64).product::<u64>();
    let (first, last) = (start / each, (start + len.max(1) - 1) / each);
    let mut words = Vec::new();
    for at in first..=last {
        let mut rest = at as usize;
        let mut node = [0.0; A];
        for (slot, axis) in node.iter_mut().zip(angles).rev() {
            *slot = axis.values()[rest % axis.values().len()];
            rest /= axis.values().len();
        }
        records(node).push(&mut words);
    }
    // The first index wraps as the shader's own does.
    let mut offsets = [first as u32, 0, 0, 0];
    for ((axis, offset), words_of) in further.iter().zip(&mut offsets[1..]).zip(words_of) {
        *offset = words.len() as u32;
        words.extend(axis.values().iter().flat_map(|v| words_of(*v)));
    }
    ShaderInputs { words, offsets }
}

/// Names a file below `shaders/`, with its text.
macro_rules! fragment {
    ($name:literal) => {
        ($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $name)))
    };
}
pub(super) use fragment;
