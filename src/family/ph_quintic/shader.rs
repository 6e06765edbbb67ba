use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
pub(super) fn shader() -> Shader { Shader { constants: "const UNDECIDED: u32 = 65535u;\n".into(), fragments: vec![("ph_quintic.wgsl", include_str!("../../../shaders/ph_quintic.wgsl"))] } }
pub(super) fn inputs(_grid: &Grid, _start: u64, _len: u64) -> ShaderInputs { ShaderInputs { words: vec![0.0], offsets: [0; 4] } }
