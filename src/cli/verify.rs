//! `verify`: recompute an atlas with every backend there is, and compare every byte.

use super::Outcome;
use super::backend::{self, BackendArgs};
use super::cells::{self, Opened};
use super::legend::faults;
use super::output::{self, grouped};
use spiral_atlas::Result;
use spiral_atlas::atlas::verify;
use spiral_atlas::eval::agree::{self, Agreement, Stored};
use spiral_atlas::eval::{Backend, Job};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Recompute an atlas and compare every byte.
///
/// Cells are made anew by the CPU. They are also compared with the family's exact verdicts at a million points.
///
/// By default with the CPU and with every GPU adapter there is, hardware and software. Where there is no adapter, the
/// CPU alone recomputes it, and the output says so. The exit status is 1 when anything differs: a hash, the legend, the
/// recipe, or a value of a node.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
              spiral-atlas verify out/quickstart.atlas.safetensors\n  \
              spiral-atlas verify out/quickstart.atlas.safetensors --adapter llvmpipe --json\n  \
              spiral-atlas verify out/quickstart.atlas.safetensors --require-adapter")]
pub(super) struct Args {
    /// The atlas.
    atlas: PathBuf,
    /// Fail, with status 2, unless a GPU adapter can recompute it too.
    #[arg(long)]
    require_adapter: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    backend: BackendArgs,
}

/// A comparison with what one backend computes.
#[derive(Debug, Clone, serde::Serialize)]
pub(super) struct Compared {
    /// Who recomputed.
    pub with: String,
    /// Wall time.
    pub seconds: f64,
    /// Nodes that a GPU left to the CPU.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub undecided_f32: Option<u64>,
    /// What was found.
    #[serde(flatten)]
    pub agreement: Agreement,
}

#[derive(serde::Serialize)]
struct Verified {
    atlas: PathBuf,
    id: String,
    /// What is wrong before any node is looked at; empty is good.
    faults: Vec<String>,
    comparisons: Vec<Compared>,
    /// Why no GPU recomputed it; null when one did.
    no_gpu: Option<String>,
    good: bool,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    let atlas = match Opened::open(&args.atlas)? {
        Opened::Nodes(atlas) => atlas,
        Opened::Cells(found) => return cells::verify(&found, args.backend.threads(), args.json),
    };
    let family = atlas.about().family()?;
    let scalars = verify::scalars(&atlas, family)?;
    let job = Job { family, grid: atlas.grid(), scalars: &scalars };
    let (stored, (backends, no_gpu)) = (verify::stored(&atlas)?, args.backend.all(args.require_adapter)?);
    let stop = super::stop_flag()?;
    let faults = verify::faults(&atlas, family);
    let threads = args.backend.threads();
    let compare = |b: &Backend| compared(&job, &stored, b, threads, &stop);
    let comparisons = backends.iter().map(compare).collect::<Result<Vec<_>>>()?;
    let good = faults.is_empty() && !comparisons.is_empty() && comparisons.iter().all(Compared::holds);
    let id = atlas.id().to_hex().to_string();
    let verified = Verified { atlas: args.atlas.clone(), id, faults, comparisons, no_gpu, good };
    if args.json {
        output::print_json(&verified)?
    } else {
        output::print(&verified.text())?
    }
    if !good {
        output::complain(&format!("{}: verification failed", args.atlas.display()));
    }
    Ok(if good { Outcome::Fine } else { Outcome::Bad })
}

/// Compares all nodes with what a backend computes.
pub(super) fn compared(
    job: &Job,
    stored: &Stored,
    backend: &Backend,
    threads: usize,
    stop: &AtomicBool,
) -> Result<Compared> {
    let with = backend::describe(backend);
    let bar = output::progress(format!("against {with}"), job.grid.len());
    let found = agree::compare(job, stored, backend, threads, stop, |nodes| bar.set_position(nodes));
    bar.finish_and_clear();
    let (agreement, report) = found?;
    Ok(Compared { with, seconds: report.seconds, undecided_f32: report.undecided_f32, agreement })
}

/// Compares some nodes with what the top of the ladder computes.
pub(super) fn sampled(job: &Job, stored: &Stored, count: u64, stop: &AtomicBool) -> Result<Compared> {
    let bar = output::progress("against intervals".into(), count.min(job.grid.len()));
    let started = std::time::Instant::now();
    let agreement = agree::sample(job, stored, count, stop, |nodes| bar.set_position(nodes));
    bar.finish_and_clear();
    let with = "intervals of high precision, evenly spread nodes".into();
    Ok(Compared { with, seconds: started.elapsed().as_secs_f64(), undecided_f32: None, agreement: agreement? })
}

impl Compared {
    /// Whether all values agree.
    pub(super) fn holds(&self) -> bool {
        self.agreement.holds()
    }

    /// A line, and one more for each difference.
    pub(super) fn text(&self) -> String {
        let Agreement { nodes, values, differences, first } = &self.agreement;
        let verdict = if *differences == 0 { "all agree".into() } else { format!("{} DIFFER", grouped(*differences)) };
        let left = self.undecided_f32.map(|n| format!(", {} nodes left to the CPU", grouped(n))).unwrap_or_default();
        let mut text = format!(
            "against {}: {} values of {} nodes, {verdict} ({:.2} s{left})\n",
            self.with,
            grouped(*values),
            grouped(*nodes),
            self.seconds
        );
        for difference in first {
            text += &format!("    {difference}\n");
        }
        if *differences > first.len() as u64 {
            text += &format!("    and {} more\n", grouped(differences - first.len() as u64));
        }
        text
    }
}

impl Verified {
    fn text(&self) -> String {
        let mut text = faults(&self.atlas, &self.id, &self.faults);
        for compared in &self.comparisons {
            text += &format!("  {}", compared.text());
        }
        if let Some(why) = &self.no_gpu {
            text += &format!("  NOT compared with any GPU ({why})\n");
        }
        text
    }
}
