use super::Kind;
use crate::family::{Shader, ShaderInputs};
use crate::grid::Grid;
pub(super) fn shader(_kind: Kind) -> Shader { Shader { constants: String::new(), fragments: vec![] } }
pub(super) fn inputs(_kind: Kind, _grid: &Grid, _start: u64, _len: u64) -> ShaderInputs { ShaderInputs { words: vec![], offsets: [0;4] } }
