//! What Python gives: rows of numbers and whole numbers, refused in sentences that name the value.

use crate::error::raise_row;
use numpy::{
    PyArray2, PyArrayDescrMethods, PyArrayMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::exceptions::{PyMemoryError, PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use spiral_atlas::Result;
use spiral_atlas::family::RowError;
use spiral_atlas::grid::Grid;
use spiral_atlas::transition::MOST_SAMPLES;
use std::ops::RangeInclusive;

/// Rows that are worked at before Ctrl-C is looked for: milliseconds of the fast families, seconds of the slow ones.
const BLOCK: usize = 1 << 16;

/// More threads than this are a mistake.
const MOST_THREADS: usize = 4096;

/// Rows of real numbers, one after another in memory. An array of float64 that lies so is not copied.
pub(crate) struct Rows<'py>(PyReadonlyArray2<'py, f64>);

impl<'py> Rows<'py> {
    /// Of an array, or of what NumPy makes one of. `columns` says how many there must be: "4", or "k" where that is not
    /// known yet.
    ///
    /// # Errors
    /// `TypeError` where there are no real numbers; `ValueError` for another shape, and what NumPy says of lists that
    /// are no array.
    pub(crate) fn new(given: &Bound<'py, PyAny>, what: &str, columns: &str) -> PyResult<Rows<'py>> {
        let py = given.py();
        if given.hasattr("filled")? {
            return Err(PyTypeError::new_err(format!("the {what} are a masked array; fill it, or choose its rows")));
        }
        if let Ok(array) = given.cast::<PyArray2<f64>>()
            && array.is_c_contiguous()
            && array.data().is_aligned()
        {
            return Ok(Rows(array.try_readonly()?));
        }
        let numpy = py.import("numpy")?;
        let array = numpy.call_method1("asarray", (given,))?.cast_into::<PyUntypedArray>()?;
        if array.ndim() != 2 {
            let shape = array.getattr("shape")?;
            let form = format!("it must be (n, {columns}), a row for each");
            return Err(PyValueError::new_err(format!("the {what} have the shape {shape}; {form}")));
        }
        // Complex numbers, texts and times would become numbers in silence.
        if !b"biufO".contains(&array.dtype().kind()) {
            let kind = array.dtype();
            return Err(PyTypeError::new_err(format!("the {what} are of the type {kind}; they must be real numbers")));
        }
        let array = numpy.call_method1("require", (array, dtype::<f64>(py), ["C", "A", "E"]))?;
        Ok(Rows(array.cast_into::<PyArray2<f64>>()?.try_readonly()?))
    }

    /// Points of a grid, whose number of columns is that of axes.
    pub(crate) fn of_grid(given: &Bound<'py, PyAny>, grid: &Grid, whose: &str) -> PyResult<Rows<'py>> {
        let axes = grid.axes().len();
        let rows = Rows::new(given, "points", &axes.to_string())?;
        if rows.columns() == axes {
            return Ok(rows);
        }
        Err(PyValueError::new_err(format!("the points have {} columns; {whose} {axes} axes", rows.columns())))
    }

    /// How many rows there are.
    pub(crate) fn count(&self) -> usize {
        self.0.shape()[0]
    }

    /// How many numbers a row has.
    pub(crate) fn columns(&self) -> usize {
        self.0.shape()[1]
    }

    /// Room for a result of each row.
    pub(crate) fn room<T>(&self) -> PyResult<Vec<T>> {
        self.room_for(1)
    }

    /// Room for some results of each row.
    ///
    /// # Errors
    /// `MemoryError`, where Rust would end the process.
    pub(crate) fn room_for<T>(&self, each: usize) -> PyResult<Vec<T>> {
        let mut all = Vec::new();
        match all.try_reserve_exact(self.count().saturating_mul(each)) {
            Ok(()) => Ok(all),
            Err(_) => Err(PyMemoryError::new_err(format!("{} rows need more memory; take fewer", self.count()))),
        }
    }

    /// Works at the rows in blocks with the GIL released, and hears Ctrl-C between them.
    pub(crate) fn in_blocks(
        &self,
        py: Python<'_>,
        mut work: impl FnMut(&[f64]) -> Result<(), RowError> + Send,
    ) -> PyResult<()> {
        // Rows without numbers are those of no family and no grid.
        let length = BLOCK * self.columns().max(1);
        for (i, block) in self.0.as_slice()?.chunks(length).enumerate() {
            let done = py.detach(|| work(block));
            done.map_err(|fault| raise_row(py, i * BLOCK + fault.row, fault.error))?;
            py.check_signals()?;
        }
        Ok(())
    }

    /// The same, row by row.
    pub(crate) fn each(&self, py: Python<'_>, mut work: impl FnMut(&[f64]) -> Result<()> + Send) -> PyResult<()> {
        let columns = self.columns();
        self.in_blocks(py, |block| {
            let mut rows = block.chunks_exact(columns).enumerate();
            rows.try_for_each(|(row, numbers)| work(numbers).map_err(|error| RowError { row, error }))
        })
    }
}

/// A whole number.
fn whole(name: &str, given: &Bound<'_, PyAny>, within: RangeInclusive<usize>) -> PyResult<usize> {
    match given.extract() {
        Ok(count) if within.contains(&count) => return Ok(count),
        Err(e) if !e.is_instance_of::<PyOverflowError>(given.py()) => {
            return Err(PyTypeError::new_err(format!("{name} is {given}; it must be a whole number")));
        }
        _ => {}
    }
    let range = match within.into_inner() {
        (least, usize::MAX) => format!("{least} or more"),
        (least, most) => format!("from {least} to {most}"),
    };
    Err(PyValueError::new_err(format!("{name} is {given}; it must be {range}")))
}

/// How many points of a curve.
pub(crate) fn points(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole("n", given, 2..=MOST_SAMPLES as usize)
}

/// Workers: as many as were asked for, or as there are cores.
pub(crate) fn threads(given: Option<&Bound<'_, PyAny>>) -> PyResult<usize> {
    match given {
        Some(given) => whole("threads", given, 1..=MOST_THREADS),
        None => Ok(std::thread::available_parallelism().map_or(1, std::num::NonZero::get)),
    }
}

/// Most pieces of a join.
pub(crate) fn most_pieces(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole("most_pieces", given, 1..=usize::MAX)
}

/// Cells along a side of a slice.
pub(crate) fn cells(given: Option<&Bound<'_, PyAny>>) -> PyResult<usize> {
    given.map_or(Ok(256), |given| whole("cells", given, 1..=4096))
}

/// A mask of flags: all of them, where none are named.
pub(crate) fn mask(given: Option<&Bound<'_, PyAny>>) -> PyResult<u8> {
    given.map_or(Ok(u8::MAX), |given| whole("flags", given, 0..=255).map(|mask| mask as u8))
}
