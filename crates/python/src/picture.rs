//! Pictures of atlases, drawn of no more nodes than they show.

use crate::error::raise;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use spiral_atlas::atlas::Outline;
use spiral_atlas::picture::{self, Part};
use spiral_atlas::recipe::PicturePlan;
use std::sync::Arc;

/// A picture of an atlas that is to be drawn.
#[pyclass(frozen, module = "spiral_atlas._core")]
pub struct Picture {
    pub outline: Arc<Outline>,
    pub plan: PicturePlan,
}

#[pymethods]
impl Picture {
    /// The nodes of each axis that it shows: `draw` wants the fields of their products.
    #[getter]
    fn nodes(&self) -> Vec<Vec<usize>> {
        picture::shown(self.outline.grid(), &self.plan)
    }

    /// The scalar that it shows, where it shows one.
    #[getter]
    fn scalar(&self) -> Option<&'static str> {
        self.plan.levels.as_ref().map(|levels| levels.field)
    }

    /// Draws it: the bytes of a PNG file. Fields are in flat order, the last axis fastest.
    #[pyo3(signature = (flags, scalar = None))]
    fn draw<'py>(
        &self,
        py: Python<'py>,
        flags: PyReadonlyArray1<'py, u8>,
        scalar: Option<PyReadonlyArray1<'py, f32>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let apart = |e: numpy::AsSliceError| PyValueError::new_err(e.to_string());
        let (nodes, flags) = (self.nodes(), flags.as_slice().map_err(apart)?);
        let values = scalar.as_ref().map(|values| values.as_slice()).transpose().map_err(apart)?;
        let scalars = self.scalar().into_iter().zip(values).collect();
        let draw = || picture::draw(&Part::new(&self.outline, &nodes, flags, scalars)?, &self.plan)?.png();
        let png = py.detach(draw).map_err(raise)?;
        Ok(PyBytes::new(py, &png))
    }
}
