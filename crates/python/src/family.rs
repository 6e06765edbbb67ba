//! Families, and the exact answers for one datum or many.

use crate::error::raise;
use crate::given::{self, Rows};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde::Serialize;
use spiral_atlas::family::{self, Answer, Chart, Family, Value};
use spiral_atlas::recipe::parse_coordinate;

/// What a family is, for `families()`.
#[derive(Serialize)]
struct About {
    name: &'static str,
    title: &'static str,
    conventions: &'static str,
    charts: Vec<ChartAbout>,
    flags: Vec<Named>,
    counts: Vec<Packed>,
    scalars: Vec<Named>,
    control_points: usize,
}

#[derive(Serialize)]
struct ChartAbout {
    name: &'static str,
    axes: &'static [&'static str],
    doc: &'static str,
}

#[derive(Serialize)]
struct Named {
    name: &'static str,
    doc: &'static str,
}

#[derive(Serialize)]
struct Packed {
    name: &'static str,
    doc: &'static str,
    shift: u32,
    bits: u32,
}

/// Every family: a list of dictionaries with `name`, `title`, `conventions`, `charts`, `flags`, `counts`, `scalars` and
/// `control_points`, the number of those of a curve (0 where a curve has none).
///
/// A chart is a set of coordinates that the family accepts, with its units. Bit `i` of a `flags` byte is `flags[i]`; a
/// count is `solutions >> shift & (2**bits - 1)`.
#[pyfunction]
pub(crate) fn families(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let all: Vec<About> = family::all().iter().map(|family| about(*family)).collect();
    Ok(pythonize::pythonize(py, &all)?)
}

fn about(family: &dyn Family) -> About {
    let charts = family.about().charts.iter().map(|c| ChartAbout { name: c.name, axes: c.axes, doc: c.doc }).collect();
    let packed = |c: &family::Count| Packed { name: c.name, doc: c.doc, shift: c.shift, bits: c.bits };
    About {
        name: family.about().name,
        title: family.about().title,
        conventions: family.about().conventions,
        charts,
        flags: family.about().flags.iter().map(|f| Named { name: f.name, doc: f.doc }).collect(),
        counts: family.about().counts.iter().map(packed).collect(),
        scalars: family.about().scalars.iter().map(|s| Named { name: s.name, doc: s.doc }).collect(),
        control_points: family.about().control_points,
    }
}

/// The exact answer for one datum of a family: `solve("cubic", phi0=0.7, phi1=1.4, kappa0=0.4, kappa1=4)`.
///
/// Args:
///     family: its name; see `families()`.
///     coordinates: the axes of one of the family's charts, by name. Numbers; angles are radians, or text such as
///     "40deg".
///
/// Returns:
///     A dictionary: the coordinates; `flags` (name to bool, proved); `counts`; `derived`; `solutions` (all curves with
///     these ends); and `chosen` (an index into `solutions`, or None). The numbers are those of `query --json`.
///
/// Raises:
///     TypeError: coordinates that are no chart of the family.
///     ValueError: an unknown family, or a value outside the domain.
///     UndecidedError: not proved at the precision cap.
#[pyfunction]
#[pyo3(signature = (family, **coordinates))]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    family: &str,
    coordinates: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let family = known(family)?;
    let given = match coordinates {
        Some(all) => all.iter().map(|(name, x)| Ok((name.extract()?, x))).collect::<PyResult<_>>()?,
        None => Vec::new(),
    };
    let (chart, point) = datum(family, &given)?;
    let answer = py.detach(|| family.answer(chart, &point)).map_err(raise)?;
    let told = PyDict::new(py);
    for (axis, x) in family.about().charts[chart].axes.iter().zip(&point) {
        told.set_item(axis, x)?;
    }
    told.set_item("flags", flags(py, family, &answer)?)?;
    let counts = PyDict::new(py);
    for count in family.about().counts {
        counts.set_item(count.name, count.of(answer.code.counts()))?;
    }
    told.set_item("counts", counts)?;
    told.set_item("derived", values(py, &answer.derived)?)?;
    let solutions = answer.solutions.iter().map(|s| values(py, s)).collect::<PyResult<Vec<_>>>()?;
    told.set_item("solutions", solutions)?;
    told.set_item("chosen", answer.chosen)?;
    Ok(told)
}

fn flags<'py>(py: Python<'py>, family: &dyn Family, answer: &Answer) -> PyResult<Bound<'py, PyDict>> {
    let flags = PyDict::new(py);
    for (bit, flag) in family.about().flags.iter().enumerate() {
        flags.set_item(flag.name, answer.code.flags() >> bit & 1 == 1)?;
    }
    Ok(flags)
}

fn values<'py>(py: Python<'py>, all: &[(&'static str, Value)]) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, value) in all {
        dict.set_item(name, pythonize::pythonize(py, value)?)?;
    }
    Ok(dict)
}

/// The family of a name.
pub(crate) fn known(name: &str) -> PyResult<&'static dyn Family> {
    family::by_name(name).map_err(raise)
}

/// Chart and coordinates of a datum that was given by name.
pub(crate) fn datum(family: &dyn Family, given: &[(String, Bound<'_, PyAny>)]) -> PyResult<(usize, Vec<f64>)> {
    let fits = |chart: &Chart| {
        chart.axes.len() == given.len() && given.iter().all(|(name, _)| chart.axes.contains(&&name[..]))
    };
    let chart = family.about().charts.iter().position(fits).ok_or_else(|| {
        let known: Vec<String> = family.about().charts.iter().map(|c| c.axes.join(", ")).collect();
        let names: Vec<&str> = given.iter().map(|(name, _)| &name[..]).collect();
        let names = if names.is_empty() { "no coordinates".into() } else { names.join(", ") };
        PyTypeError::new_err(format!("`{}` has {}; given: {names}", family.about().name, known.join(" | ")))
    })?;
    let point = family.about().charts[chart].axes.iter().map(|axis| {
        let value = given.iter().find(|(name, _)| name == axis).map(|(_, value)| value);
        coordinate(axis, value.ok_or_else(|| PyTypeError::new_err(format!("{axis} is missing")))?)
    });
    Ok((chart, point.collect::<PyResult<_>>()?))
}

fn coordinate(axis: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    match value.extract::<String>() {
        Ok(text) => parse_coordinate(axis, &text).map_err(|e| PyValueError::new_err(format!("{axis}: {e}"))),
        Err(_) => value.extract().map_err(|_| PyTypeError::new_err(format!("{axis} is {value}; it must be a number"))),
    }
}

/// The proved verdicts of many data and, where they are asked for, their curves.
///
/// Args:
///     family: its name.
///     data: numbers of shape (n, k); a float64 array is not copied; a row for each datum, in the order of the chart's
///     axes.
///     chart: the name of the chart; by default the first with k axes.
///     threads: workers; by default as many as the machine has cores.
///     curves: whether curves are wanted, too.
///
/// Returns:
///     (flags, solutions): two uint8 arrays of shape (n,), as an atlas stores them; see `families()` for bits and
///     counts. With `curves`, (flags, solutions, control_points): the last is a float64 array of shape (n, m, 2), of
///     the curve that `solve` calls `chosen`, in the family's frame, NaN where there is none. `m` is `control_points`
///     of `families()`.
///
/// Raises:
///     ValueError: naming the row and the value, when a datum lies outside the family's domain; or curves are asked for
///     of a family whose curves have no control points.
///     UndecidedError: naming the row.
#[pyfunction]
#[pyo3(signature = (family, data, *, chart = None, threads = None, curves = false))]
pub(crate) fn solve_batch<'py>(
    py: Python<'py>,
    family: &str,
    data: &Bound<'py, PyAny>,
    chart: Option<&str>,
    threads: Option<&Bound<'py, PyAny>>,
    curves: bool,
) -> PyResult<Bound<'py, PyTuple>> {
    let family = known(family)?;
    let threads = given::threads(threads)?;
    let data = Rows::new(data, "data", "k")?;
    let fits = |c: &Chart| c.axes.len() == data.columns() && chart.is_none_or(|name| c.name == name);
    let chart = family.about().charts.iter().position(fits).ok_or_else(|| {
        let known: Vec<String> =
            family.about().charts.iter().map(|c| format!("{} ({})", c.name, c.axes.join(", "))).collect();
        let asked = chart.map_or(String::new(), |name| format!(", the chart asked for is `{name}`"));
        PyValueError::new_err(format!(
            "`{}` has the charts {}; the data have {} columns{asked}",
            family.about().name,
            known.join(" | "),
            data.columns()
        ))
    })?;
    let each = family.about().control_points;
    if curves && each == 0 {
        let what = format!("the answers of `{}` have no control points; ask for verdicts alone", family.about().name);
        return Err(PyValueError::new_err(what));
    }
    let (mut flags, mut counts) = (data.room()?, data.room()?);
    let mut points: Vec<[f64; 2]> = if curves { data.room_for(each)? } else { Vec::new() };
    let solve = |rows: &[f64]| {
        let codes = if curves {
            let found = family::solve_batch(family, chart, rows, threads)?;
            points.extend(found.control_points);
            found.codes
        } else {
            family::verdicts(family, chart, rows, threads)?
        };
        flags.extend(codes.iter().map(|code| code.flags()));
        counts.extend(codes.iter().map(|code| code.counts()));
        Ok(())
    };
    data.in_blocks(py, solve)?;
    let mut arrays = vec![flags.into_pyarray(py).into_any(), counts.into_pyarray(py).into_any()];
    if curves {
        let shape = [data.count(), each, 2];
        arrays.push(points.into_flattened().into_pyarray(py).reshape(shape)?.into_any());
    }
    PyTuple::new(py, arrays)
}
