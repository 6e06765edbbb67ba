//! Atlases without their fields, for stores that keep those in another way: blocks of nodes, files, pictures.

use crate::atlas::Atlas;
use crate::error::raise;
use crate::generate::{read, watched};
use crate::given::{self, Rows};
use crate::legend;
use crate::picture::Picture;
use crate::writer::Writer;
use numpy::ndarray::ArrayD;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use serde::Serialize;
use spiral_atlas::atlas::{self, Spec};
use spiral_atlas::eval::{Backend, Chunk, Job, Report, evaluate};
use spiral_atlas::picture;
use spiral_atlas::recipe::{AtlasPlan, Recipe};
use spiral_atlas::{Error, Result};
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What an atlas of nodes says about itself, and its axes: all of it but the fields.
#[pyclass(frozen, module = "spiral_atlas._core")]
pub struct Outline(Arc<atlas::Outline>);

impl Outline {
    fn new(outline: Result<atlas::Outline>) -> PyResult<Outline> {
        outline.map(|outline| Outline(Arc::new(outline))).map_err(raise)
    }
}

/// The atlas of a recipe that has this name or, without a name, its only one.
fn plan<'a>(recipe: &'a Recipe, name: Option<&str>) -> PyResult<&'a AtlasPlan> {
    let names: Vec<&str> = recipe.atlases.iter().map(|plan| &plan.name[..]).collect();
    let found = match (name, &recipe.atlases[..]) {
        (None, [one]) => Ok(one),
        (None, _) => {
            Err(format!("the recipe has several atlases, and a store holds one; choose among {}", names.join(", ")))
        }
        (Some(name), all) => {
            let missing = || format!("the recipe has no atlas `{name}`; it has {}", names.join(", "));
            all.iter().find(|plan| plan.name == name).ok_or_else(missing)
        }
    };
    let plan = found.map_err(PyValueError::new_err)?;
    if plan.cells.is_some() {
        let what = format!("the atlas `{}` is of cells; a store holds nodes. `generate` makes cells", plan.name);
        return Err(PyValueError::new_err(what));
    }
    Ok(plan)
}

#[pymethods]
impl Outline {
    /// That of an atlas of a recipe (a dictionary, or the path of a TOML file); `name` chooses among several.
    ///
    /// Raises:
    ///     ValueError: the recipe is wrong, its grid leaves the family's domain, or the atlas is none of nodes.
    #[staticmethod]
    #[pyo3(signature = (recipe, name = None))]
    fn of_recipe(recipe: &Bound<'_, PyAny>, name: Option<&str>) -> PyResult<Outline> {
        let recipe = read(recipe)?;
        let AtlasPlan { name, family, grid, scalars, .. } = plan(&recipe, name)?;
        // Whether the grid lies in the family's domain, before any work; a part of it then does, too.
        family.table(grid).map_err(raise)?;
        let spec = Spec { name, family: *family, grid, scalars, recipe: &recipe.text };
        Outline::new(atlas::Outline::of(&spec))
    }

    /// That of an atlas.
    #[staticmethod]
    fn of_atlas(atlas: &Atlas) -> PyResult<Outline> {
        Outline::new(atlas::Outline::of_atlas(&atlas.0))
    }

    /// That with these metadata and values of axes, from a place that messages name.
    ///
    /// Raises:
    ///     AtlasError: they are not those of an atlas of nodes.
    #[staticmethod]
    fn of_metadata(
        place: PathBuf,
        metadata: HashMap<String, String>,
        axes: HashMap<String, PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Outline> {
        let values = |name: &str| axes.get(name).map(|values| values.as_array().to_vec());
        Outline::new(atlas::Outline::read(place, metadata, values))
    }

    /// The metadata of the file, without its hashes: text by name.
    #[getter]
    fn metadata<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.0.metadata().map_err(raise)?.into_py_dict(py)
    }

    /// Axes by name, slowest first.
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.0.grid().axes().iter().map(|axis| (axis.name(), axis.values().to_vec().into_pyarray(py))).into_py_dict(py)
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

    /// Flat index of the node nearest to each point, int64; -1 outside the grid by more than half a step.
    fn nearest<'py>(&self, py: Python<'py>, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let points = Rows::of_grid(points, self.0.grid(), "the atlas has")?;
        let mut nodes = points.room()?;
        points.each(py, |point| {
            nodes.push(self.0.nearest(point).map_or(-1, |node| node as i64));
            Ok(())
        })?;
        Ok(nodes.into_pyarray(py))
    }

    /// Computes the fields of a block of nodes, from an index of each axis on.
    ///
    /// Args:
    ///     start, shape: first node and number of nodes along each axis.
    ///     threads: workers; by default as many as there are cores.
    ///
    /// Returns:
    ///     (fields, report): arrays of the block's shape by name, and numbers of nodes: `nodes`, `undecided_f64`,
    ///     `most_bits`, and `yes`, by flag. The GIL is released.
    ///
    /// Raises:
    ///     ValueError: the block leaves the grid.
    ///     UndecidedError: naming the node.
    #[pyo3(signature = (start, shape, *, threads = None))]
    fn block<'py>(
        &self,
        py: Python<'py>,
        start: Vec<usize>,
        shape: Vec<usize>,
        threads: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyAny>)> {
        let threads = given::threads(threads)?;
        let nodes: Vec<Vec<usize>> =
            start.iter().zip(&shape).map(|(from, count)| (*from..from + count).collect()).collect();
        let (chunk, report) = watched(py, |_| Ok(()), |stop, _| self.compute(&nodes, threads, stop))?;
        let fields = PyDict::new(py);
        let shaped = |e: numpy::ndarray::ShapeError| PyValueError::new_err(e.to_string());
        for (name, bytes) in [("flags", chunk.flags), ("solutions", chunk.solutions)] {
            fields.set_item(name, ArrayD::from_shape_vec(shape.clone(), bytes).map_err(shaped)?.into_pyarray(py))?;
        }
        for (scalar, values) in self.0.about().scalars.iter().zip(chunk.scalars) {
            let values = ArrayD::from_shape_vec(shape.clone(), values).map_err(shaped)?;
            fields.set_item(&scalar.name, values.into_pyarray(py))?;
        }
        Ok((fields, pythonize::pythonize(py, &report)?))
    }

    /// Opens a file for an atlas of this outline.
    fn create(&self, path: PathBuf) -> PyResult<Writer> {
        self.0.create(&path).map(Writer::new).map_err(raise)
    }

    /// The pictures of the atlas: those of the recipe that it carries, or of another one for the same axes.
    ///
    /// Raises:
    ///     ValueError: the recipe is wrong, or has no atlas of this name and these axes.
    #[pyo3(signature = (recipe = None))]
    fn pictures(&self, recipe: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Picture>> {
        let outline = &self.0;
        let plans = match recipe {
            None => picture::plans(outline.about(), outline.grid()).map_err(raise)?,
            Some(recipe) => {
                let recipe = read(recipe)?;
                let plan = plan(&recipe, Some(&outline.about().name))?;
                if plan.grid != *outline.grid() {
                    return Err(PyValueError::new_err(format!(
                        "the axes of `{}` are not those of the recipe",
                        plan.name
                    )));
                }
                plan.pictures.clone()
            }
        };
        Ok(plans.into_iter().map(|plan| Picture { outline: outline.clone(), plan }).collect())
    }
}

impl Outline {
    fn compute(&self, nodes: &[Vec<usize>], threads: usize, stop: &AtomicBool) -> Result<(Chunk, Tally)> {
        let (family, scalars) = self.0.family()?;
        let (whole, grid) = (self.0.grid(), self.0.grid().pick(nodes)?);
        let mut all =
            Chunk { start: 0, flags: Vec::new(), solutions: Vec::new(), scalars: vec![Vec::new(); scalars.len()] };
        let count = grid.len() as usize;
        all.flags.reserve_exact(count);
        all.solutions.reserve_exact(count);
        all.scalars.iter_mut().for_each(|scalar| scalar.reserve_exact(count));
        let job = Job { family, grid: &grid, scalars: &scalars };
        let report = evaluate(&job, &Backend::Cpu, threads, stop, |chunk| {
            all.flags.extend_from_slice(&chunk.flags);
            all.solutions.extend_from_slice(&chunk.solutions);
            all.scalars.iter_mut().zip(&chunk.scalars).for_each(|(all, part)| all.extend_from_slice(part));
            Ok(())
        });
        let report = report.map_err(|error| match error {
            // The message counts the nodes of the whole grid.
            Error::Undecided { node: Some(node), coordinates, what, bits } => {
                let index: Vec<usize> = grid.index(node).iter().zip(nodes).map(|(i, chosen)| chosen[*i]).collect();
                Error::Undecided { node: whole.flat(&index), coordinates, what, bits }
            }
            other => other,
        })?;
        let Report { nodes, yes, undecided_f64, most_bits, .. } = report;
        Ok((all, Tally { nodes, yes, undecided_f64, most_bits }))
    }
}

/// What is reported of the nodes of a block.
#[derive(Serialize)]
struct Tally {
    nodes: u64,
    yes: BTreeMap<&'static str, u64>,
    undecided_f64: u64,
    most_bits: usize,
}
