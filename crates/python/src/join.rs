//! Joins of two states.

use crate::curve::Curve;
use crate::error::raise;
use crate::given;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use spiral_atlas::transition::join::{self as joins, End, Request, State};

/// What `join` found; it is true where there is a join.
#[pyclass(frozen, get_all, module = "spiral_atlas")]
pub struct Join {
    /// The path, or None.
    curve: Option<Py<Curve>>,
    /// Arc length.
    length: f64,
    /// Least and greatest signed curvature.
    curvature_range: (f64, f64),
    /// Least and greatest dκ/ds inside the pieces.
    rate_range: (f64, f64),
    /// The integral of the squared curvature over arc length.
    bending_energy: f64,
    /// Why none was found, in a sentence; None where one was.
    reason: Option<String>,
}

#[pymethods]
impl Join {
    fn __bool__(&self) -> bool {
        self.curve.is_some()
    }

    fn __repr__(&self) -> String {
        match &self.reason {
            None => format!("<spiral_atlas.Join of length {:?}>", self.length),
            Some(why) => format!("<spiral_atlas.Join: none, {why}>"),
        }
    }
}

/// A path of proved spirals, arcs and lines from one state to another, with continuous curvature and a limit of it.
///
/// Args:
///     start, end: states (x, y, direction, curvature): direction in radians from the x axis, curvature positive to the
///         left.
///     greatest_curvature: the limit of |curvature|, above 0.
///     family: what its spirals are: "cubic", "ph-quintic", "trig-quintic", "involute" or "clothoid".
///     objective: what is least among the joins tried: "length", "greatest-curvature", "greatest-rate" (of change of
///         curvature) or "bending-energy".
///     longest: a longer join counts as none.
///     most_pieces: a join of more pieces counts as none.
///
/// Returns:
///     A `Join`. That none was found is no error: the join is false, and `reason` says why.
///
/// Raises:
///     ValueError: a value is not finite or not above 0, or a name is unknown.
#[pyfunction]
#[pyo3(signature = (
    start, end, greatest_curvature, *, family = "cubic", objective = "length", longest = None, most_pieces = None
))]
#[expect(clippy::too_many_arguments, reason = "in Python the options have names")]
pub(crate) fn join(
    py: Python<'_>,
    start: [f64; 4],
    end: [f64; 4],
    greatest_curvature: f64,
    family: &str,
    objective: &str,
    longest: Option<f64>,
    most_pieces: Option<&Bound<'_, PyAny>>,
) -> PyResult<Join> {
    let state = |[x, y, direction, curvature]: [f64; 4]| End::State(State { point: [x, y], direction, curvature });
    let plain = Request::new(state(start), state(end), greatest_curvature);
    let request = Request {
        family: named("family", family)?,
        objective: named("objective", objective)?,
        longest: longest.unwrap_or(plain.longest),
        most_pieces: most_pieces.map_or(Ok(plain.most_pieces), given::most_pieces)?,
        ..plain
    };
    Ok(match py.detach(|| joins::join(&request)).map_err(raise)? {
        Ok(found) => {
            let m = found.measures;
            Join {
                curve: Some(Py::new(py, Curve { pieces: found.pieces })?),
                length: m.length,
                curvature_range: m.curvature_range.into(),
                rate_range: m.rate_range.into(),
                bending_energy: m.bending_energy,
                reason: None,
            }
        }
        Err(why) => Join {
            curve: None,
            length: f64::NAN,
            curvature_range: (f64::NAN, f64::NAN),
            rate_range: (f64::NAN, f64::NAN),
            bending_energy: f64::NAN,
            reason: Some(why),
        },
    })
}

/// A choice by its name in JSON.
fn named<T: for<'de> Deserialize<'de>>(what: &str, name: &str) -> PyResult<T> {
    let read: Result<T, serde::de::value::Error> = T::deserialize(name.into_deserializer());
    read.map_err(|e| PyValueError::new_err(format!("the {what} is `{name}`: {e}")))
}
