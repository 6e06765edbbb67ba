//! Atlases from recipes.

use crate::atlas::Atlas;
use crate::error::raise;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use spiral_atlas::Result;
use spiral_atlas::atlas::{Spec, Writer};
use spiral_atlas::eval::{Backend, Job, evaluate};
use spiral_atlas::recipe::{AtlasPlan, Recipe};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How often Ctrl-C is looked for.
const TICK: Duration = Duration::from_millis(50);

/// Makes the atlases of a recipe.
///
/// Args:
///     recipe: a dictionary, or the path of a TOML file.
///     folder: where NAME.atlas.safetensors goes for each atlas of the recipe; created when missing. Without it the
///         atlases are arrays alone: their files are hidden among the system's temporary files, and go with the `Atlas`
///         objects.
///     threads: workers; by default as many as the machine has cores.
///     progress: called with (name, nodes done, nodes in all) from time to time.
///
/// Returns:
///     A list of `Atlas`, in the recipe's order. For a TOML file the bytes are those that the command `generate` writes.
///
/// Raises:
///     ValueError: the recipe is wrong, or a grid leaves its family's domain.
///     OSError: the system refuses to write.
///     KeyboardInterrupt: Ctrl-C. No half-written file is left, as after any exception.
#[pyfunction]
#[pyo3(signature = (recipe, folder = None, *, threads = None, progress = None))]
pub fn generate(
    py: Python<'_>,
    recipe: &Bound<'_, PyAny>,
    folder: Option<PathBuf>,
    threads: Option<NonZero<usize>>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Vec<Atlas>> {
    let recipe = read(recipe)?;
    let threads = threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZero::get);
    if let Some(folder) = &folder {
        std::fs::create_dir_all(folder)?;
    }
    let mut all = Vec::with_capacity(recipe.atlases.len());
    for plan in &recipe.atlases {
        let place = folder.clone().unwrap_or_else(std::env::temp_dir);
        let path = place.join(format!("{}.atlas.safetensors", plan.name));
        let writer = watched(py, &recipe, plan, &path, threads, progress.as_ref())?;
        let kept = folder.is_some();
        let atlas = py.detach(|| match kept {
            true => writer.finish().and_then(|_| spiral_atlas::atlas::Atlas::open(&path)),
            false => writer.open(),
        });
        all.push(Atlas(atlas.map_err(raise)?));
    }
    Ok(all)
}

fn read(recipe: &Bound<'_, PyAny>) -> PyResult<Recipe> {
    if let Ok(dict) = recipe.cast::<PyDict>() {
        let wrong = |e: &dyn std::fmt::Display| PyValueError::new_err(format!("the recipe: {e}"));
        let table: toml::Table = pythonize::depythonize(dict).map_err(|e| wrong(&e))?;
        return Recipe::parse(&toml::to_string(&table).map_err(|e| wrong(&e))?).map_err(raise);
    }
    let path: PathBuf =
        recipe.extract().map_err(|_| PyTypeError::new_err("the recipe must be a dictionary or the path of a TOML file"))?;
    Recipe::read(path).map_err(raise)
}

/// Evaluates in another thread, so that this one hears Ctrl-C and reports the progress.
fn watched(
    py: Python<'_>,
    recipe: &Recipe,
    plan: &AtlasPlan,
    path: &Path,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Writer> {
    let stop = AtomicBool::new(false);
    let (sender, receiver) = channel();
    // Only this thread receives; the lock tells the compiler so.
    let receiver = Mutex::new(receiver);
    let receive = || receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(TICK);
    let watch = || -> PyResult<()> {
        loop {
            match py.detach(receive) {
                Ok(done) => {
                    if let Some(progress) = progress {
                        progress.call1((&plan.name, done, plan.grid.len()))?;
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
            py.check_signals()?;
        }
    };
    std::thread::scope(|scope| {
        let worker = scope.spawn(|| write(recipe, plan, path, threads, &stop, sender));
        let heard = watch();
        if heard.is_err() {
            stop.store(true, Ordering::Relaxed);
        }
        let written = py.detach(|| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        heard?;
        written.map_err(raise)
    })
}

fn write(recipe: &Recipe, plan: &AtlasPlan, path: &Path, threads: usize, stop: &AtomicBool, done: Sender<u64>) -> Result<Writer> {
    let job = Job { family: plan.family, grid: &plan.grid, scalars: &plan.scalars };
    let spec = Spec { name: &plan.name, family: plan.family, grid: &plan.grid, scalars: &plan.scalars, recipe: &recipe.text };
    let mut writer = Writer::create(path, &spec)?;
    evaluate(&job, &Backend::Cpu, threads, stop, |chunk| {
        writer.put(&chunk)?;
        // Who does not listen any more has set `stop`.
        let _ = done.send(chunk.start + chunk.len() as u64);
        Ok(())
    })?;
    Ok(writer)
}
