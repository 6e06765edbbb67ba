//! The path tools: JSON in, JSON out.

use crate::error::raise;
use pyo3::prelude::*;
use spiral_atlas::tools;

/// The answer of a path tool to a request, both as JSON. `spiral_atlas.path` has fields instead of a text.
#[pyfunction]
pub(crate) fn path(py: Python<'_>, tool: &str, request: &str) -> PyResult<String> {
    py.detach(|| tools::answer(tool, request)).map_err(raise)
}
