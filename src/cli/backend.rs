//! Which evaluator takes the first step: `--backend`, `--adapter`, `--threads`.

use spiral_atlas::Result;
use spiral_atlas::eval::Backend;
use std::num::NonZero;

/// Who evaluates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Choice {
    /// What is best here: a hardware GPU, else the CPU (to verify: all there are).
    Auto,
    /// The processor.
    Cpu,
    /// A GPU.
    Gpu,
}

/// The options of all commands that evaluate grids.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct BackendArgs {
    /// Who evaluates; the result is the same, bit for bit.
    #[arg(long, value_enum, default_value_t = Choice::Auto)]
    pub backend: Choice,
    /// A part of the GPU adapter's name; needed for a software one. `spiral-atlas adapters` lists them.
    #[arg(long, value_name = "SUBSTRING")]
    pub adapter: Option<String>,
    /// Worker threads [default: one for each processor].
    #[arg(long, value_name = "N", value_parser = super::numbers::count::<1, 1024>)]
    threads: Option<u32>,
}

impl BackendArgs {
    /// Number of worker threads.
    pub(super) fn threads(&self) -> usize {
        let all = || std::thread::available_parallelism().map_or(1, NonZero::get);
        self.threads.map_or_else(all, |threads| threads as usize)
    }

    /// The one backend to compute with.
    ///
    /// # Errors
    /// [`Error::Gpu`] when a GPU is asked for and none fits.
    pub(super) fn one(&self) -> Result<Backend> {
        self.check();
        match (self.backend, &self.adapter) {
            (Choice::Cpu, _) => Ok(Backend::Cpu),
            (Choice::Auto, None) => Ok(select(None).unwrap_or(Backend::Cpu)),
            (_, adapter) => select(adapter.as_deref()),
        }
    }

    /// All backends to verify with: the one asked for, or the CPU and every GPU adapter that can compute. Where no GPU
    /// is among them, the reason comes with them.
    ///
    /// # Errors
    /// [`Error::Gpu`] when a GPU is asked for, as `required` does, and none fits.
    pub(super) fn all(&self, required: bool) -> Result<(Vec<Backend>, Option<String>)> {
        self.check();
        if required && self.backend == Choice::Cpu {
            super::refuse("`--require-adapter` asks for a GPU; it does not go with `--backend cpu`");
        }
        let gpus = match (self.backend, &self.adapter) {
            (Choice::Cpu, _) => return Ok((vec![Backend::Cpu], Some("only the CPU was asked for".into()))),
            (_, Some(adapter)) => return Ok((vec![select(Some(adapter))?], None)),
            (_, None) => every_gpu(),
        };
        let mut backends = if self.backend == Choice::Auto { vec![Backend::Cpu] } else { Vec::new() };
        match gpus {
            Err(why) if self.backend == Choice::Auto && !required => Ok((backends, Some(why.to_string()))),
            gpus => {
                backends.extend(gpus?);
                Ok((backends, None))
            }
        }
    }

    fn check(&self) {
        if self.backend == Choice::Cpu && self.adapter.is_some() {
            super::refuse("`--adapter` names a GPU; it does not go with `--backend cpu`");
        }
    }
}

/// The backends that check what `made` computed: those it did not use.
///
/// # Errors
/// [`Error::Gpu`], saying what to install, when the CPU made it and there is no GPU adapter.
pub(super) fn others(made: &Backend) -> Result<Vec<Backend>> {
    if *made == Backend::Cpu { every_gpu() } else { Ok(vec![Backend::Cpu]) }
}

/// A backend in words.
pub(super) fn describe(backend: &Backend) -> String {
    match backend {
        Backend::Cpu => "the CPU".into(),
        #[cfg(feature = "gpu")]
        Backend::Gpu(adapter) => adapter.as_deref().unwrap_or("a GPU").into(),
    }
}

#[cfg(feature = "gpu")]
fn select(adapter: Option<&str>) -> Result<Backend> {
    spiral_atlas::eval::gpu::select(adapter).map(|facts| Backend::Gpu(Some(facts.label())))
}

#[cfg(feature = "gpu")]
fn every_gpu() -> Result<Vec<Backend>> {
    use spiral_atlas::eval::gpu::{adapters, select};
    let all = adapters();
    let usable: Vec<_> = all.iter().filter(|a| a.unusable.is_none()).map(|a| Backend::Gpu(Some(a.label()))).collect();
    if !usable.is_empty() {
        return Ok(usable);
    }
    // The empty text is part of every name, so this error says what is wrong with the first, or how to get one.
    select(Some("")).map(|_| Vec::new())
}

#[cfg(not(feature = "gpu"))]
fn select(_: Option<&str>) -> Result<Backend> {
    Err(none())
}

#[cfg(not(feature = "gpu"))]
fn every_gpu() -> Result<Vec<Backend>> {
    Err(none())
}

#[cfg(not(feature = "gpu"))]
fn none() -> spiral_atlas::Error {
    spiral_atlas::Error::Gpu("this program was built without the feature `gpu`; build it with default features".into())
}
