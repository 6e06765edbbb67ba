//! Atlas files as objects with NumPy arrays over the mapped memory.

use crate::error::raise;
use crate::given::Rows;
use crate::legend;
use numpy::ndarray::{ArrayView, IxDyn};
use numpy::{Element, IntoPyArray, PyArray};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyTuple};
use std::path::PathBuf;

/// An atlas file, mapped into memory. Made by `open` and `generate`.
///
/// Its arrays are views of the file: nothing is copied, and they keep the file mapped. Do not change the file while it
/// is open.
#[pyclass(frozen, module = "spiral_atlas")]
pub struct Atlas(pub spiral_atlas::atlas::Atlas);

/// Opens an atlas file and checks its header and axes; `Atlas.check` reads the fields too.
///
/// Raises:
///     OSError: the file cannot be opened.
///     AtlasError: it is not a valid atlas.
#[pyfunction]
pub(crate) fn open(path: PathBuf) -> PyResult<Atlas> {
    spiral_atlas::atlas::Atlas::open(path).map(Atlas).map_err(raise)
}

/// A read-only array over memory that `owner` keeps.
fn view<'py, T: Element>(owner: &Bound<'py, Atlas>, shape: &[usize], values: &[T]) -> PyResult<Bound<'py, PyAny>> {
    let array = ArrayView::from_shape(IxDyn(shape), values).map_err(|e| PyValueError::new_err(e.to_string()))?;
    // SAFETY: the memory belongs to the atlas, which never moves or changes it (the class is frozen), and the array
    // holds a reference to the atlas. The array is made read-only before anyone sees it.
    let array = unsafe { PyArray::borrow_from_array(&array, owner.clone().into_any()) }.into_any();
    array.call_method("setflags", (), Some(&[("write", false)].into_py_dict(owner.py())?))?;
    Ok(array)
}

impl Atlas {
    fn shape(&self) -> Vec<usize> {
        self.0.grid().axes().iter().map(|axis| axis.values().len()).collect()
    }
}

#[pymethods]
impl Atlas {
    /// The path it was opened from, or would have had.
    #[getter]
    fn path(&self) -> PathBuf {
        self.0.path().to_owned()
    }

    /// The family's name.
    #[getter]
    fn family(&self) -> &str {
        self.0.family_name()
    }

    /// The chart's name.
    #[getter]
    fn chart(&self) -> &str {
        self.0.chart_name()
    }

    /// BLAKE3 that stands for the whole atlas, 64 hexadecimal digits.
    #[getter]
    fn id(&self) -> String {
        self.0.id().to_hex().to_string()
    }

    /// The recipe's text.
    #[getter]
    fn recipe(&self) -> &str {
        self.0.recipe_text()
    }

    /// All metadata of the file: text by name.
    #[getter]
    fn metadata<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.0.metadata().clone().into_py_dict(py)
    }

    /// Axes by name, slowest first: read-only float64 arrays.
    #[getter]
    fn axes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let axes = PyDict::new(slf.py());
        for axis in slf.get().0.grid().axes() {
            axes.set_item(axis.name(), view(slf, &[axis.values().len()], axis.values())?)?;
        }
        Ok(axes)
    }

    /// Names of the axes that are angles, in radians.
    #[getter]
    fn angles(&self) -> Vec<&str> {
        legend::angles(self.0.grid())
    }

    /// Names and meanings of the bits of `flags`, bit 0 first.
    #[getter]
    fn flag_docs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        legend::flag_docs(py, self.0.about())
    }

    /// Numbers in a `solutions` byte: name to (shift, bits).
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        legend::counts(py, self.0.about())
    }

    /// Names and meanings of the scalar fields.
    #[getter]
    fn scalar_docs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        legend::scalar_docs(py, self.0.about())
    }

    /// The `flags` byte of every node: a read-only uint8 array of the grid's shape.
    #[getter]
    fn flags<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        view(slf, &slf.get().shape(), slf.get().0.flags())
    }

    /// The `solutions` byte of every node: a read-only uint8 array of the grid's shape.
    #[getter]
    fn solutions<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        view(slf, &slf.get().shape(), slf.get().0.solutions())
    }

    /// A scalar field: a read-only float32 array of the grid's shape; `NO_VALUE` where a node has none.
    fn scalar<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let atlas = &slf.get().0;
        let values = atlas.scalar(name).ok_or_else(|| {
            let known: Vec<&str> = atlas.scalar_names().collect();
            PyKeyError::new_err(format!("the atlas has no scalar `{name}`; it has: {}", known.join(", ")))
        })?;
        view(slf, &slf.get().shape(), values)
    }

    /// The nearest node of each point.
    ///
    /// Args:
    ///     points: numbers of shape (n, number of axes); a float64 array is not copied, in the order of `axes`.
    ///
    /// Returns:
    ///     (nodes, flags, solutions): arrays of shape (n,), of int64, uint8 and uint8. `nodes` has flat indices
    ///     (`numpy.unravel_index` makes indices of each axis of them), and -1 for a point outside the grid by more than
    ///     half a step, whose bytes are 0.
    fn lookup<'py>(&self, py: Python<'py>, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyTuple>> {
        let points = Rows::of_grid(points, self.0.grid(), "the atlas has")?;
        let (mut nodes, mut flags, mut solutions) = (points.room()?, points.room()?, points.room()?);
        points.each(py, |point| {
            let (node, flag, count) = match self.0.nearest(point) {
                Some((node, entry)) => (node as i64, entry.flags, entry.solutions),
                None => (-1, 0, 0),
            };
            nodes.push(node);
            flags.push(flag);
            solutions.push(count);
            Ok(())
        })?;
        (nodes.into_pyarray(py), flags.into_pyarray(py), solutions.into_pyarray(py)).into_pyobject(py)
    }

    /// Reads the whole file and checks the hash of every array.
    ///
    /// Raises:
    ///     AtlasError: naming the first array that is damaged.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.0.check_hashes()).map_err(raise)
    }

    /// The atlas as an `xarray.Dataset` with named axes and CF attributes.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("spiral_atlas.xarray_backend")?.call_method1("to_dataset", (slf,))
    }

    fn __repr__(&self) -> String {
        let axes: Vec<String> =
            self.0.grid().axes().iter().map(|a| format!("{} {}", a.name(), a.values().len())).collect();
        format!("<spiral_atlas.Atlas of {}: {}>", self.0.family_name(), axes.join(" x "))
    }
}
