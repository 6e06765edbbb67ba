//! Curves in the user's units, as objects.

use crate::error::raise;
use crate::given;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyImportError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;
use spiral_atlas::path::Course;
use spiral_atlas::transition::{self, Ends, Piece, Station, direction_of, stations};

/// A curve of one or more pieces, in your own unit of length. Made by `fit`, `join` and `Curve.from_dict`.
#[pyclass(frozen, eq, module = "spiral_atlas")]
#[derive(PartialEq)]
pub struct Curve {
    /// At least one.
    pub pieces: Vec<Piece>,
}

/// A curve as a dictionary, of either form.
#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Pieces { pieces: Vec<Piece> },
    Piece(Box<Piece>),
}

type Points<'py> = PyResult<Bound<'py, PyArray2<f64>>>;

fn array<'py>(py: Python<'py>, points: &[[f64; 2]]) -> Points<'py> {
    points.as_flattened().to_vec().into_pyarray(py).reshape([points.len(), 2])
}

impl From<Piece> for Curve {
    fn from(piece: Piece) -> Curve {
        Curve { pieces: vec![piece] }
    }
}

impl Curve {
    fn at_equal_lengths(&self, py: Python<'_>, n: usize) -> PyResult<Vec<Station>> {
        py.detach(|| stations(&self.pieces, n)).map_err(raise)
    }
}

#[pymethods]
impl Curve {
    /// Makes a curve of what `to_dict`, `curve` under `pieces`, or `join` says: one piece, or {"pieces": [..]}.
    #[staticmethod]
    fn from_dict(dict: &Bound<'_, PyAny>) -> PyResult<Curve> {
        let wrong = |what: String| PyValueError::new_err(format!("this is no curve: {what}"));
        let pieces = match pythonize::depythonize(dict).map_err(|e| wrong(e.to_string()))? {
            Written::Pieces { pieces } => pieces,
            Written::Piece(piece) => vec![*piece],
        };
        // A course is a path whose pieces join.
        let course = Course::new(pieces).map_err(|e| wrong(e.to_string()))?;
        Ok(Curve { pieces: course.pieces().to_vec() })
    }

    /// All that rebuilds the curve exactly, as JSON has it: the piece, or {"pieces": [..]} of several.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.pieces[..] {
            [piece] => Ok(pythonize::pythonize(py, piece)?),
            pieces => {
                let dict = PyDict::new(py);
                dict.set_item("pieces", pythonize::pythonize(py, pieces)?)?;
                Ok(dict.into_any())
            }
        }
    }

    /// Its pieces, each a curve.
    #[getter]
    fn pieces(&self) -> Vec<Curve> {
        self.pieces.iter().cloned().map(Curve::from).collect()
    }

    /// "cubic", "ph-quintic", "trig-quintic", "involute", "clothoid", "line" or "arc"; "path" of several pieces.
    #[getter]
    fn kind(&self) -> &'static str {
        if let [piece] = &self.pieces[..] { piece.kind().name() } else { "path" }
    }

    /// Arc length.
    #[getter]
    fn length(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// Where it starts: (x, y).
    #[getter]
    fn start(&self) -> (f64, f64) {
        self.pieces[0].start().into()
    }

    /// Where it ends: (x, y).
    #[getter]
    fn end(&self) -> (f64, f64) {
        self.pieces[self.pieces.len() - 1].end().into()
    }

    /// The control points, a float64 array of shape (degree + 1, 2); None for what has none: an involute, a clothoid, a
    /// line, an arc, and a curve of several pieces.
    #[getter]
    fn control_points<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let [piece] = &self.pieces[..] else { return Ok(None) };
        piece.control_points().map(|points| array(py, &points)).transpose()
    }

    /// `n` points at equal arc lengths, both ends included: a float64 array of shape (n, 2).
    fn points<'py>(&self, py: Python<'py>, n: &Bound<'py, PyAny>) -> Points<'py> {
        let points: Vec<[f64; 2]> = self.at_equal_lengths(py, given::points(n)?)?.iter().map(|s| [s.x, s.y]).collect();
        array(py, &points)
    }

    /// The signed curvature at the same `n` points, positive to the left: a float64 array of shape (n,).
    fn curvature<'py>(&self, py: Python<'py>, n: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let all: Vec<f64> = self.at_equal_lengths(py, given::points(n)?)?.iter().map(|s| s.curvature).collect();
        Ok(all.into_pyarray(py))
    }

    /// All that is known at `n` points at equal arc lengths: float64 arrays of shape (n,) by the names `station`
    /// (length from the start), `x`, `y`, `heading` (radians), `curvature`.
    fn stations<'py>(&self, py: Python<'py>, n: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let all = self.at_equal_lengths(py, given::points(n)?)?;
        let columns = PyDict::new(py);
        for (i, name) in Station::COLUMNS.iter().enumerate() {
            let column: Vec<f64> = all.iter().map(|s| s.numbers()[i]).collect();
            columns.set_item(name, column.into_pyarray(py))?;
        }
        Ok(columns)
    }

    /// `n` points at a signed distance to the left of the points of `points(n)`: an array of shape (n, 2).
    fn offset<'py>(&self, py: Python<'py>, distance: f64, n: &Bound<'py, PyAny>) -> Points<'py> {
        if !distance.is_finite() {
            return Err(PyValueError::new_err(format!("the distance is {distance}; it must be finite")));
        }
        let points: Vec<[f64; 2]> =
            self.at_equal_lengths(py, given::points(n)?)?.iter().map(|s| s.beside(distance)).collect();
        array(py, &points)
    }

    /// Draws the curve with matplotlib, by `n` points, on `ax` (by default the current axes), and returns the axes.
    /// Other arguments go to `Axes.plot`.
    #[pyo3(signature = (ax = None, *, n = None, **kwargs), text_signature = "($self, ax=None, *, n=200, **kwargs)")]
    fn plot<'py>(
        &self,
        py: Python<'py>,
        ax: Option<Bound<'py, PyAny>>,
        n: Option<&Bound<'py, PyAny>>,
        kwargs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let missing =
            |e: PyErr| PyImportError::new_err(format!("plot needs matplotlib: pip install spiral-atlas[plot] ({e})"));
        let ax = match ax {
            Some(ax) => ax,
            None => py.import("matplotlib.pyplot").map_err(missing)?.call_method0("gca")?,
        };
        let all = self.at_equal_lengths(py, n.map_or(Ok(200), given::points)?)?;
        let column = |f: fn(&Station) -> f64| all.iter().map(f).collect::<Vec<f64>>().into_pyarray(py);
        ax.call_method("plot", (column(|s| s.x), column(|s| s.y)), kwargs)?;
        ax.call_method1("set_aspect", ("equal",))?;
        Ok(ax)
    }

    fn __repr__(&self) -> String {
        let (start, end) = (self.start(), self.end());
        format!("<spiral_atlas.Curve {} from {start:?} to {end:?}, length {:?}>", self.kind(), self.length())
    }
}

/// What `fit` found; it is true where there is a spiral.
#[pyclass(frozen, module = "spiral_atlas")]
pub struct Fit {
    /// The chosen spiral, or None.
    #[pyo3(get)]
    curve: Option<Py<Curve>>,
    /// Every curve of the family with these ends, spirals or not.
    #[pyo3(get)]
    solutions: Vec<Py<Curve>>,
    /// Which of `solutions` are spirals, proved.
    #[pyo3(get)]
    spirals: Vec<bool>,
    /// Why there is no spiral, in a sentence; None where there is one.
    #[pyo3(get)]
    reason: Option<String>,
}

#[pymethods]
impl Fit {
    fn __bool__(&self) -> bool {
        self.curve.is_some()
    }

    fn __repr__(&self) -> String {
        match &self.reason {
            None => format!("<spiral_atlas.Fit: a spiral, of {} solutions>", self.solutions.len()),
            Some(why) => format!("<spiral_atlas.Fit: none, {why}>"),
        }
    }
}

/// A direction: an angle in radians or a vector.
#[derive(FromPyObject)]
pub(crate) enum Direction {
    /// Radians from the x axis.
    Angle(f64),
    /// Of any length but 0.
    Vector([f64; 2]),
}

impl Direction {
    fn angle(self) -> PyResult<f64> {
        match self {
            Direction::Angle(angle) => Ok(angle),
            Direction::Vector(vector) => direction_of(vector).map_err(raise),
        }
    }
}

/// The transition curve of monotone curvature between two ends anywhere in the plane, in your own unit of length.
///
/// Args:
///     start, end: points (x, y).
///     start_direction, end_direction: directions of travel: an angle from the x axis in radians, or a vector.
///     start_curvature, end_curvature: signed curvatures, 1 / length, positive to the left.
///     family: "cubic" (of several spirals the one with the largest margin), "ph-quintic" (that of least bending
///     energy) or "involute" (the image of an involute of a circle, which exists whenever any spiral does).
///     longest: a curve longer than this counts as none.
///
/// Returns:
///     A `Fit`. That there is no spiral is no error: the fit is false, and `reason` says which condition fails.
///
/// Raises:
///     ValueError: a value is not finite, both points are one, or the like.
#[pyfunction]
#[pyo3(signature = (
    start, end, start_direction, end_direction, start_curvature, end_curvature, *, family = "cubic", longest = None
))]
#[expect(clippy::too_many_arguments, reason = "two ends have six values; in Python all of them have names")]
pub(crate) fn fit(
    py: Python<'_>,
    start: [f64; 2],
    end: [f64; 2],
    start_direction: Direction,
    end_direction: Direction,
    start_curvature: f64,
    end_curvature: f64,
    family: &str,
    longest: Option<f64>,
) -> PyResult<Fit> {
    let (start_direction, end_direction) = (start_direction.angle()?, end_direction.angle()?);
    let ends = Ends { start, end, start_direction, end_direction, start_curvature, end_curvature };
    let kind = transition::fitted("family", family).map_err(raise)?;
    let found = py.detach(|| transition::fit(&ends, kind, longest.unwrap_or(f64::INFINITY))).map_err(raise)?;
    let solutions: Vec<Py<Curve>> =
        found.solutions.into_iter().map(|p| Py::new(py, Curve::from(p))).collect::<PyResult<_>>()?;
    let (curve, reason) = match found.outcome {
        Ok(i) => (solutions.get(i).map(|curve| curve.clone_ref(py)), None),
        Err(why) => (None, Some(why)),
    };
    Ok(Fit { curve, solutions, spirals: found.spirals, reason })
}
