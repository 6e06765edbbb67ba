//! Atlas files, written block by block.

use crate::error::raise;
use numpy::{Element, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use spiral_atlas::atlas;
use spiral_atlas::eval::Chunk;
use std::sync::{Mutex, PoisonError};

/// An atlas file in the making: it appears, whole, with `finish`, and goes with the object without.
#[pyclass(frozen, module = "spiral_atlas._core")]
pub struct Writer {
    /// With the node that comes next.
    state: Mutex<Option<(atlas::Writer, u64)>>,
}

impl Writer {
    pub fn new(writer: atlas::Writer) -> Writer {
        Writer { state: Mutex::new(Some((writer, 0))) }
    }
}

fn values<T: Element + Clone>(array: &PyReadonlyArray1<'_, T>) -> Vec<T> {
    array.as_array().to_vec()
}

fn finished() -> PyErr {
    PyValueError::new_err("the file is finished")
}

#[pymethods]
impl Writer {
    /// Writes the fields of the next nodes, in flat order.
    fn put(
        &self,
        py: Python<'_>,
        flags: PyReadonlyArray1<'_, u8>,
        solutions: PyReadonlyArray1<'_, u8>,
        scalars: Vec<PyReadonlyArray1<'_, f32>>,
    ) -> PyResult<()> {
        let (flags, solutions, scalars) = (values(&flags), values(&solutions), scalars.iter().map(values).collect());
        py.detach(|| {
            let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
            let (writer, next) = state.as_mut().ok_or_else(finished)?;
            let chunk = Chunk { start: *next, flags, solutions, scalars };
            writer.put(&chunk).map_err(raise)?;
            *next += chunk.len() as u64;
            Ok(())
        })
    }

    /// Puts the file in its place.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| {
            let state = self.state.lock().unwrap_or_else(PoisonError::into_inner).take();
            state.ok_or_else(finished)?.0.finish().map(drop).map_err(raise)
        })
    }
}

/// BLAKE3 of bytes (a uint8 array of one axis): 32 bytes.
#[pyfunction]
pub(crate) fn blake3(py: Python<'_>, bytes: PyReadonlyArray1<'_, u8>) -> PyResult<[u8; 32]> {
    let bytes = bytes.as_slice().map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(*py.detach(|| ::blake3::hash(bytes)).as_bytes())
}
