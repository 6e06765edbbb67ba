//! Errors of the library as Python exceptions that keep the message.

use pyo3::create_exception;
use pyo3::exceptions::{PyArithmeticError, PyException, PyKeyboardInterrupt, PyOSError, PyValueError};
use pyo3::prelude::*;
use spiral_atlas::Error;

create_exception!(spiral_atlas, AtlasError, PyValueError, "A file is not a valid atlas.");
create_exception!(
    spiral_atlas,
    UndecidedError,
    PyArithmeticError,
    "A verdict could not be proved at the precision cap."
);
create_exception!(
    spiral_atlas,
    NoPathError,
    PyException,
    "There is no path such as was asked for; the message is the reason."
);

/// Puts the exceptions into the module.
pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("AtlasError", py.get_type::<AtlasError>())?;
    module.add("UndecidedError", py.get_type::<UndecidedError>())?;
    module.add("NoPathError", py.get_type::<NoPathError>())
}

/// The exception of an error. A value outside its domain and a recipe that is wrong are `ValueError`. What the system
/// refuses is `OSError` with its number, so that Python makes a `FileNotFoundError` or the like of it.
pub(crate) fn raise(error: Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::Io { path, source } => match source.raw_os_error() {
            // Python puts number and path beside the words.
            Some(number) => {
                let words = text.strip_prefix(&format!("{}: ", path.display())).unwrap_or(&text);
                let words = words.replace(&format!(" (os error {number})"), "");
                PyOSError::new_err((number, words, path.into_os_string()))
            }
            None => PyOSError::new_err(text),
        },
        Error::Atlas { .. } => AtlasError::new_err(text),
        Error::Undecided { .. } => UndecidedError::new_err(text),
        Error::NoPath(_) => NoPathError::new_err(text),
        Error::Interrupted => PyKeyboardInterrupt::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// [`raise`] for one row of an array.
pub(crate) fn raise_row(py: Python<'_>, row: usize, error: Error) -> PyErr {
    let raised = raise(error);
    PyErr::from_type(raised.get_type(py), format!("row {row}: {}", raised.value(py)))
}
