//! Atlases from recipes.

use crate::atlas::Atlas;
use crate::cells::Cells;
use crate::error::raise;
use crate::given;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use spiral_atlas::atlas::{Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::recipe::{AtlasPlan, Recipe};
use spiral_atlas::{Result, cells};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How often Ctrl-C is looked for.
const TICK: Duration = Duration::from_millis(50);

/// What a recipe's plan makes.
#[derive(IntoPyObject)]
pub(crate) enum Made {
    Nodes(Atlas),
    Cells(Cells),
}

/// Makes the atlases of a recipe.
///
/// Args:
///     recipe: a dictionary, or the path of a TOML file.
///     folder: where NAME.atlas.safetensors goes for each atlas of the recipe; created when missing. Without it the
///         atlases are arrays alone: their files are hidden among the system's temporary files, and go with the
///         objects.
///     threads: workers; by default as many as the machine has cores.
///     progress: called with (name, done, in all) from time to time: nodes of an atlas; of cells those divided so far,
///         with None because their number is not known before.
///
/// Returns:
///     A list of `Atlas` and, for atlases of the kind "cells", `Cells`, in the recipe's order. For a TOML file the
///     bytes are those that the command `generate` writes.
///
/// Raises:
///     ValueError: the recipe is wrong, or a grid leaves its family's domain.
///     OSError: the system refuses to write.
///     KeyboardInterrupt: Ctrl-C. No half-written file is left, as after any exception.
#[pyfunction]
#[pyo3(signature = (recipe, folder = None, *, threads = None, progress = None))]
pub(crate) fn generate(
    py: Python<'_>,
    recipe: &Bound<'_, PyAny>,
    folder: Option<PathBuf>,
    threads: Option<&Bound<'_, PyAny>>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Vec<Made>> {
    let recipe = read(recipe)?;
    let threads = given::threads(threads)?;
    if let Some(folder) = &folder {
        std::fs::create_dir_all(folder)
            .map_err(|e| raise(spiral_atlas::Error::Io { path: folder.clone(), source: e }))?;
    }
    let make = |plan: &AtlasPlan| {
        let job = Work { recipe: &recipe, plan, folder: folder.as_ref(), threads };
        let report = |done: u64| match &progress {
            Some(progress) => {
                progress.call1((&plan.name, done, plan.cells.is_none().then(|| plan.grid.len()))).map(drop)
            }
            None => Ok(()),
        };
        Ok(match plan.cells {
            Some(budget) => Made::Cells(Cells(watched(py, report, |stop, done| job.cells(budget, stop, done))?)),
            None => Made::Nodes(Atlas(watched(py, report, |stop, done| job.nodes(stop, done))?)),
        })
    };
    recipe.atlases.iter().map(make).collect()
}

/// One atlas that is to be made.
struct Work<'a> {
    recipe: &'a Recipe,
    plan: &'a AtlasPlan,
    folder: Option<&'a PathBuf>,
    threads: usize,
}

impl Work<'_> {
    fn path(&self) -> PathBuf {
        let name = format!("{}.atlas.safetensors", self.plan.name);
        self.folder.map_or_else(std::env::temp_dir, PathBuf::clone).join(name)
    }

    fn nodes(&self, stop: &AtomicBool, done: &Sender<u64>) -> Result<spiral_atlas::atlas::Atlas> {
        let AtlasPlan { name, family, grid, scalars, .. } = self.plan;
        let (family, path) = (*family, self.path());
        let spec = Spec { name, family, grid, scalars, recipe: &self.recipe.text };
        let mut writer = Writer::create(&path, &spec)?;
        evaluate(&Job { family, grid, scalars }, &Backend::Cpu, self.threads, stop, |chunk| {
            writer.put(&chunk)?;
            // Who does not listen any more has set `stop`.
            let _ = done.send(chunk.start + chunk.len() as u64);
            Ok(())
        })?;
        match self.folder {
            Some(_) => writer.finish().and_then(|_| spiral_atlas::atlas::Atlas::open(&path)),
            None => writer.open(),
        }
    }

    fn cells(&self, budget: u64, stop: &AtomicBool, done: &Sender<u64>) -> Result<cells::Cells> {
        let AtlasPlan { name, family, grid, .. } = self.plan;
        let spec = cells::Spec { name, family: *family, grid, budget, recipe: &self.recipe.text };
        let built = cells::build(&spec, self.threads, stop, &|divided| {
            let _ = done.send(divided);
        })?;
        if self.folder.is_none() {
            return cells::Cells::from_bytes(&cells::bytes(&spec, &built)?);
        }
        cells::write(&self.path(), &spec, &built)?;
        cells::Cells::open(self.path())
    }
}

/// A recipe from a dictionary or the path of a TOML file.
pub(crate) fn read(recipe: &Bound<'_, PyAny>) -> PyResult<Recipe> {
    if let Ok(dict) = recipe.cast::<PyDict>() {
        let wrong = |e: &dyn std::fmt::Display| PyValueError::new_err(format!("the recipe: {e}"));
        let table: toml::Table = pythonize::depythonize(dict).map_err(|e| wrong(&e))?;
        return Recipe::parse(&toml::to_string(&table).map_err(|e| wrong(&e))?).map_err(raise);
    }
    let path: PathBuf = recipe
        .extract()
        .map_err(|_| PyTypeError::new_err("the recipe must be a dictionary or the path of a TOML file"))?;
    Recipe::read(path).map_err(raise)
}

/// Works in another thread, so that this one hears Ctrl-C and reports the progress.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    report: impl Fn(u64) -> PyResult<()>,
    work: impl FnOnce(&AtomicBool, &Sender<u64>) -> Result<T> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    let (sender, receiver) = channel();
    // Only this thread receives; the lock shows the compiler so.
    let receiver = Mutex::new(receiver);
    let receive = || receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(TICK);
    let watch = || -> PyResult<()> {
        loop {
            match py.detach(receive) {
                Ok(done) => report(done)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
            py.check_signals()?;
        }
    };
    std::thread::scope(|scope| {
        let stop = &stop;
        let worker = scope.spawn(move || work(stop, &sender));
        let heard = watch();
        if heard.is_err() {
            stop.store(true, Ordering::Relaxed);
        }
        let made = py.detach(|| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        heard?;
        made.map_err(raise)
    })
}
