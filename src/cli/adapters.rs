//! `adapters`: which GPUs there are.

use super::{Outcome, output};
use spiral_atlas::Result;
#[cfg(feature = "gpu")]
use spiral_atlas::files::size;

/// List the GPU adapters: type, driver, limits.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas adapters --json")]
pub(super) struct Args {
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
#[cfg(feature = "gpu")]
pub(super) fn run(args: &Args) -> Result<Outcome> {
    use spiral_atlas::eval::gpu;
    let all = gpu::adapters();
    if args.json {
        return output::print_json(&all).map(|()| Outcome::Fine);
    }
    if all.is_empty() {
        let none = gpu::select(None).err().map(|e| e.to_string()).unwrap_or_default();
        return output::print(&format!("{none}\n")).map(|()| Outcome::Fine);
    }
    let auto = gpu::select(None).ok().map(|a| a.label());
    let mut text = String::new();
    for adapter in &all {
        let label = adapter.label();
        let role = match &adapter.unusable {
            Some(why) => format!("cannot be used: {why}"),
            None if auto.as_ref() == Some(&label) => "what `--backend auto` takes".into(),
            None => "used when named with `--adapter`".into(),
        };
        text += &format!(
            "{label}\n  {role}\n  storage buffers to {}, buffers to {}; {} workgroups a dimension, {} invocations \
             each; timestamps: {}\n",
            size(adapter.max_storage_bytes),
            size(adapter.max_buffer_bytes),
            output::grouped(adapter.max_groups.into()),
            output::grouped(adapter.max_group_size.into()),
            if adapter.timestamps { "yes" } else { "no" }
        );
    }
    if auto.is_none() {
        text += "`--backend auto` takes the CPU: there is no hardware adapter.\n";
    }
    output::print(&text).map(|()| Outcome::Fine)
}

/// Runs the command.
#[cfg(not(feature = "gpu"))]
pub fn run(args: &Args) -> Result<Outcome> {
    let text = if args.json { "[]\n" } else { "none: this program was built without the feature `gpu`\n" };
    output::print(text).map(|()| Outcome::Fine)
}
