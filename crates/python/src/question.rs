//! Questions beyond yes and no: ranges, the nearest datum, outlines.

use crate::error::raise;
use crate::family::{datum, known};
use crate::given;
use numpy::PyArray2;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat};
use spiral_atlas::question::{self, Property};
use std::collections::HashMap;

/// A property, the datum, and the places of the coordinates that vary, which are not given.
fn asked(
    py: Python<'_>,
    family: &str,
    flag: Option<&str>,
    coordinates: Option<&Bound<'_, PyDict>>,
    free: &[&str],
) -> PyResult<(Property, Vec<f64>, Vec<usize>)> {
    let family = known(family)?;
    let about = family.about();
    let mut given: Vec<(String, Bound<'_, PyAny>)> = match coordinates {
        Some(all) => all.iter().map(|(name, x)| Ok((name.extract()?, x))).collect::<PyResult<_>>()?,
        None => Vec::new(),
    };
    if let Some(name) = free.iter().find(|name| given.iter().any(|(other, _)| other == *name)) {
        return Err(PyTypeError::new_err(format!("{name} is given, but it is what varies; leave it out")));
    }
    given.extend(free.iter().map(|name| ((*name).to_owned(), PyFloat::new(py, 0.0).into_any())));
    let (chart, point) = datum(family, &given)?;
    let axes = about.charts[chart].axes;
    let property = Property::new(about.name, axes, flag).map_err(raise)?;
    let places = free.iter().filter_map(|name| axes.iter().position(|axis| axis == name)).collect();
    Ok((property, point, places))
}

/// All intervals of one coordinate in which a property holds, the others being given:
/// `ranges("cubic", "kappa1", (0, 100), phi0=0.7, phi1=1.4, kappa0=0.4)`.
///
/// Args:
///     family: its name.
///     axis: the name of the coordinate.
///     within: where to look, (from, to).
///     flag: the property; by default the one that says that a spiral exists.
///     coordinates: the other axes of a chart, by name; angles are radians, or text such as "40deg".
///
/// Returns:
///     A dictionary as `query --ranges --json` prints it: `ranges`, each with `ends`, `cut` (true for an end that is
///     only that of `within`), `inner` and `outer`; `open`; and `boxes`.
///
/// Raises:
///     TypeError: coordinates that are no chart of the family.
///     ValueError: an unknown family or flag, or an interval that is none.
///     UndecidedError: not proved at the precision cap.
#[pyfunction]
#[pyo3(signature = (family, axis, within, *, flag = None, **coordinates))]
pub(crate) fn ranges<'py>(
    py: Python<'py>,
    family: &str,
    axis: &str,
    within: [f64; 2],
    flag: Option<&str>,
    coordinates: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (property, point, places) = asked(py, family, flag, coordinates, &[axis])?;
    let found = py.detach(|| question::ranges(&property, &point, places[0], within)).map_err(raise)?;
    Ok(pythonize::pythonize(py, &found)?)
}

/// The nearest datum that has a property: `nearest("cubic", phi0=0.7, phi1=1.4, kappa0=1, kappa1=2)`.
///
/// Args:
///     family, flag: as for `ranges`.
///     weights: weights of coordinates in the distance, by name, 1 unless given; `math.inf` keeps one as it is.
///     coordinates: the datum.
///
/// Returns:
///     A dictionary: `point` (a dictionary of coordinates, or None), `distance`, `at_least` (proved: no datum with the
///     property is nearer; None where none has it) and `boxes`.
///
/// Raises:
///     As `ranges`.
#[pyfunction]
#[pyo3(signature = (family, *, flag = None, weights = None, **coordinates))]
pub(crate) fn nearest<'py>(
    py: Python<'py>,
    family: &str,
    flag: Option<&str>,
    weights: Option<HashMap<String, f64>>,
    coordinates: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (property, point, _) = asked(py, family, flag, coordinates, &[])?;
    let weights = weights.unwrap_or_default();
    if let Some(name) = weights.keys().find(|name| !property.axes().contains(&&name[..])) {
        let axes = property.axes().join(", ");
        return Err(PyValueError::new_err(format!("a weight is of {name:?}; the coordinates are {axes}")));
    }
    let all: Vec<f64> = property.axes().iter().map(|axis| weights.get(*axis).copied().unwrap_or(1.0)).collect();
    let found = py.detach(|| question::nearest(&property, &point, &all)).map_err(raise)?;
    let told = PyDict::new(py);
    let place = match &found.point {
        Some(point) => {
            let place = PyDict::new(py);
            for (axis, x) in property.axes().iter().zip(point) {
                place.set_item(axis, x)?;
            }
            Some(place)
        }
        None => None,
    };
    told.set_item("point", place)?;
    told.set_item("distance", found.distance)?;
    told.set_item("at_least", found.at_least.is_finite().then_some(found.at_least))?;
    told.set_item("boxes", found.boxes)?;
    Ok(told)
}

/// The outline of a property in a slice: `boundary("cubic", ("kappa0", "kappa1"), ((0, 0.8), (0, 20)), phi0=0.7,
/// phi1=1.4)`.
///
/// Args:
///     family, flag: as for `ranges`.
///     axes: the names of the two coordinates that vary.
///     within: where to look, (from, to) for each.
///     cells: cells along each side, a power of two up to 4096.
///     coordinates: the other axes of a chart.
///
/// Returns:
///     A dictionary: `outlines`, a list of pairs (float64 array of shape (n, 2), whether it is closed); `open`, `cell`
///     and `boxes` as `query --boundary --json` prints them.
///
/// Raises:
///     As `ranges`.
#[pyfunction]
#[pyo3(
    signature = (family, axes, within, *, cells = None, flag = None, **coordinates),
    text_signature = "(family, axes, within, *, cells=256, flag=None, **coordinates)"
)]
pub(crate) fn boundary<'py>(
    py: Python<'py>,
    family: &str,
    axes: [String; 2],
    within: [[f64; 2]; 2],
    cells: Option<&Bound<'py, PyAny>>,
    flag: Option<&str>,
    coordinates: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let cells = given::cells(cells)?;
    let [first, second] = &axes;
    let (property, point, places) = asked(py, family, flag, coordinates, &[first, second])?;
    let sides = [places[0], places[1]];
    let found = py.detach(|| question::boundary(&property, &point, sides, within, cells)).map_err(raise)?;
    let outline = |outline: &question::Outline| {
        let rows: Vec<Vec<f64>> = outline.points.iter().map(|p| p.to_vec()).collect();
        Ok((PyArray2::from_vec2(py, &rows)?, outline.closed))
    };
    let told = PyDict::new(py);
    told.set_item("outlines", found.outlines.iter().map(outline).collect::<PyResult<Vec<_>>>()?)?;
    told.set_item("open", found.open)?;
    told.set_item("cell", found.cell)?;
    told.set_item("boxes", found.boxes)?;
    Ok(told)
}
