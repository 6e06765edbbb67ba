//! Certified cells: verdicts at every point of a box.

use crate::error::raise;
use crate::given::{self, Rows};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use std::path::PathBuf;

/// Certified cells, mapped into memory. Made by `open_cells`.
///
/// The box of the file is divided into cells. Of each flag a cell says that it holds at every point, at none, or that
/// this is not known.
#[pyclass(frozen, module = "spiral_atlas")]
pub struct Cells(pub spiral_atlas::cells::Cells);

/// Opens a file of cells and checks its header, axes and trees; `Cells.check` reads the hashes too.
///
/// Raises:
///     OSError: the file cannot be opened.
///     AtlasError: it is not a valid file of cells.
#[pyfunction]
pub(crate) fn open_cells(path: PathBuf) -> PyResult<Cells> {
    spiral_atlas::cells::Cells::open(path).map(Cells).map_err(raise)
}

type Masks<'py> = Bound<'py, PyArray1<u8>>;

#[pymethods]
impl Cells {
    /// The path it was opened from.
    #[getter]
    fn path(&self) -> PathBuf {
        self.0.path().to_owned()
    }

    /// The family's name.
    #[getter]
    fn family(&self) -> &str {
        self.0.family().about().name
    }

    /// First and last value of each axis, by name, in the order of the coordinates.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ends = |values: &[f64]| (values[0], values[values.len() - 1]);
        self.0.grid().axes().iter().map(|axis| (axis.name(), ends(axis.values()))).into_py_dict(py)
    }

    /// Cells along each axis.
    #[getter]
    fn resolution(&self) -> usize {
        self.0.resolution()
    }

    /// Names and meanings of the bits of the masks, bit 0 first.
    #[getter]
    fn flag_docs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.0.about().flags.iter().map(|flag| (flag.name.clone(), flag.doc.clone())).into_py_dict(py)
    }

    /// What the cell of each point says, in nanoseconds a point.
    ///
    /// Args:
    ///     points: numbers of shape (n, number of axes); a float64 array is not copied.
    ///
    /// Returns:
    ///     (inside, outside): two uint8 arrays of shape (n,), masks of flags. A flag in `inside` holds at every point
    ///     of the cell, a flag in `outside` at none. A flag in neither is not known; outside the box none is.
    fn lookup<'py>(&self, py: Python<'py>, points: &Bound<'py, PyAny>) -> PyResult<(Masks<'py>, Masks<'py>)> {
        let points = Rows::of_grid(points, self.0.grid(), "the cells have")?;
        let (mut inside, mut outside) = (points.room()?, points.room()?);
        points.each(py, |point| {
            let known = self.0.lookup(point).unwrap_or_default();
            inside.push(known.inside);
            outside.push(known.outside);
            Ok(())
        })?;
        Ok((inside.into_pyarray(py), outside.into_pyarray(py)))
    }

    /// The truth at each point: from its cell where that says it, or else from the family itself, also outside the box.
    ///
    /// Args:
    ///     points: numbers of shape (n, number of axes); a float64 array is not copied.
    ///     flags: mask of the flags that are wanted. Fewer wanted flags are known to more cells.
    ///
    /// Returns:
    ///     uint8 array of shape (n,): those of the wanted flags that hold.
    ///
    /// Raises:
    ///     ValueError: naming the row and the value, when a point lies outside the family's domain.
    ///     UndecidedError: naming the row.
    #[pyo3(signature = (points, flags = None), text_signature = "($self, points, flags=255)")]
    fn verdict<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        flags: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Masks<'py>> {
        let wanted = given::mask(flags)?;
        let points = Rows::of_grid(points, self.0.grid(), "the cells have")?;
        let mut held = points.room()?;
        points.each(py, |point| {
            held.push(self.0.verdict(point, wanted)?);
            Ok(())
        })?;
        Ok(held.into_pyarray(py))
    }

    /// Reads the whole file and checks the hash of every array.
    ///
    /// Raises:
    ///     AtlasError: naming the first array that is damaged.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.0.check_hashes()).map_err(raise)
    }

    fn __repr__(&self) -> String {
        format!("<spiral_atlas.Cells of {}: {} along each axis>", self.0.family().about().name, self.0.resolution())
    }
}
