//! What an atlas says about its axes and fields, for all classes that have them.

use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use spiral_atlas::atlas::About;
use spiral_atlas::grid::Grid;
use spiral_atlas::recipe::is_angle;

/// Names of the axes that are angles.
pub(crate) fn angles(grid: &Grid) -> Vec<&str> {
    grid.axes().iter().map(|axis| axis.name()).filter(|name| is_angle(name)).collect()
}

/// Names and meanings of the bits of `flags`, bit 0 first.
pub(crate) fn flag_docs<'py>(py: Python<'py>, about: &About) -> PyResult<Bound<'py, PyDict>> {
    about.flags.iter().map(|flag| (&flag.name[..], &flag.doc[..])).into_py_dict(py)
}

/// Numbers in a `solutions` byte: name to (shift, bits).
pub(crate) fn counts<'py>(py: Python<'py>, about: &About) -> PyResult<Bound<'py, PyDict>> {
    about.counts.iter().map(|count| (&count.name[..], (count.shift, count.bits))).into_py_dict(py)
}

/// Names and meanings of the scalar fields.
pub(crate) fn scalar_docs<'py>(py: Python<'py>, about: &About) -> PyResult<Bound<'py, PyDict>> {
    about.scalars.iter().map(|scalar| (&scalar.name[..], &scalar.doc[..])).into_py_dict(py)
}
