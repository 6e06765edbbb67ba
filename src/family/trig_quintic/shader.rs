//! What the shader `trig_quintic.wgsl` reads.
use crate::family::{Code, Shader, ShaderInputs};
use crate::grid::Grid;
pub(super) fn shader() -> Shader {
    Shader {
        constants: format!("const UNDECIDED: u32 = {}u;\n", Code::UNDECIDED.0),
        fragments: vec![("trig_quintic.wgsl", include_str!("../../../shaders/trig_quintic.wgsl"))],
    }
}
pub(super) fn inputs(_grid: &Grid, _start: u64, _len: u64) -> ShaderInputs {
    ShaderInputs { words: vec![0.0], offsets: [0; 4] }
}
