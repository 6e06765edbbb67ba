//! The commands: arguments in, text, JSON and files out. No mathematics here.
//!
//! Exit status: 0 yes or done, 1 no, 2 an error, 130 interrupted. Reports go to standard output, progress and errors to
//! standard error.

mod adapters;
mod backend;
mod cells;
mod curve;
mod datum;
mod draw;
mod export;
mod generate;
mod info;
mod join;
mod legend;
mod numbers;
mod output;
mod path;
mod points;
mod query;
mod question;
mod render;
mod verify;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};
use spiral_atlas::{Error, Result};
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Proved atlases of spiral regions: is there a transition curve with monotone curvature between two ends, and which
/// one?
///
/// Angles are radians, or degrees when written like 40deg or 40°. Beyond a full turn the unit must be named: 40deg or
/// 40rad.
#[derive(Parser)]
#[command(name = "spiral-atlas", version, arg_required_else_help = true, after_help = EXIT_STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// What a command reports by its exit status.
const EXIT_STATUS: &str = "\
Exit status:
  0    yes: what was asked for exists, holds or was done
  1    no: there is no such curve or path, or a check found a difference; the output says why
  2    an error: the command line, a file or a number is wrong, or the system refused; standard error says what
  130  interrupted by Ctrl-C; nothing is left half-written";

#[derive(Subcommand)]
enum Command {
    Generate(generate::Args),
    Verify(verify::Args),
    Render(render::Args),
    Info(info::Args),
    Adapters(adapters::Args),
    Query(query::Args),
    Curve(curve::Args),
    Join(Box<join::Args>),
    Path(path::Args),
    Export(export::Args),
    /// Print shell completions.
    #[command(after_help = "Example:\n  \
                  spiral-atlas completions bash > ~/.local/share/bash-completion/completions/spiral-atlas")]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

/// How a command ended that has said all it had to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// Yes, or simply done: exit status 0.
    Fine,
    /// The answer is no: exit status 1.
    Bad,
    /// Some of its input was wrong; it went on with the rest and said so: exit status 2.
    Failed,
}

/// Runs the program with the process's arguments.
pub(crate) fn main() -> ExitCode {
    #[cfg(feature = "gpu")]
    tell_errors_without_panics();
    let done = match parse().command {
        Command::Generate(args) => generate::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Adapters(args) => adapters::run(&args),
        Command::Query(args) => query::run(&args),
        Command::Curve(args) => curve::run(&args),
        Command::Join(args) => join::run(&args),
        Command::Path(args) => path::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Completions { shell } => completions(shell),
    };
    match done {
        Ok(Outcome::Fine) => ExitCode::SUCCESS,
        Ok(Outcome::Bad) => ExitCode::from(1),
        Ok(Outcome::Failed) => ExitCode::from(2),
        // An answer, which another command gave: no error.
        Err(Error::NoPath(reason)) => {
            output::note(&reason);
            ExitCode::from(1)
        }
        Err(error) => {
            output::complain(&error.to_string());
            ExitCode::from(if matches!(error, Error::Interrupted) { 130 } else { 2 })
        }
    }
}

fn completions(shell: clap_complete::Shell) -> Result<Outcome> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "spiral-atlas", &mut text);
    output::print(&String::from_utf8_lossy(&text)).map(|()| Outcome::Fine)
}

/// Keeps panics of the GPU library silent where they become errors: a backtrace before a good message only hides it.
#[cfg(feature = "gpu")]
fn tell_errors_without_panics() {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !spiral_atlas::eval::gpu::panic_becomes_error() {
            hook(panic);
        }
    }));
}

/// Ends the program as for arguments that clap itself refuses, with the usage of the command that was given.
fn refuse(what: &str) -> ! {
    let mut command = given();
    let error = command.error(ErrorKind::ArgumentConflict, what);
    end(&error, &command)
}

/// The arguments, or the end of the program with help or an error. An error always shows the usage of the command that
/// was given; clap leaves it out where a single value is wrong.
fn parse() -> Cli {
    Cli::try_parse_from(words()).unwrap_or_else(|mut error| {
        // Help that was asked for, or that stands where a subcommand is missing.
        if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            error.exit();
        }
        let mut command = given();
        if error.get(ContextKind::Usage).is_none() {
            error.insert(ContextKind::Usage, ContextValue::StyledStr(command.render_usage()));
        }
        if error.kind() == ErrorKind::InvalidSubcommand && error.get(ContextKind::SuggestedSubcommand).is_none() {
            let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
            let known = StyledStr::from(format!("there are {}", names.join(", ")));
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![known]));
        }
        end(&error, &command)
    })
}

/// Ends the program with an error of the command line. The hint at its end names the command: clap's is a bare
/// `--help`, which is that of the whole program.
fn end(error: &clap::Error, command: &clap::Command) -> ! {
    let text = error.render().ansi().to_string();
    let name = command.get_bin_name().unwrap_or("spiral-atlas");
    let named = text.rsplit_once("--help").map(|(before, after)| format!("{before}{name} --help{after}"));
    anstream::eprint!("{}", named.unwrap_or(text));
    std::process::exit(error.exit_code())
}

/// The words of the command line.
fn words() -> Vec<OsString> {
    curve::modern(std::env::args_os().collect())
}

/// The command that the first words of the command line name.
fn given() -> clap::Command {
    let mut command = Cli::command();
    command.build();
    for word in words().into_iter().skip(1) {
        let Some(next) = word.to_str().and_then(|name| command.find_subcommand(name)) else { break };
        command = next.clone();
    }
    command
}

/// A flag that Ctrl-C (and a polite request to end) sets; long work looks at it and cleans up after itself.
fn stop_flag() -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    let set = flag.clone();
    ctrlc::set_handler(move || set.store(true, std::sync::atomic::Ordering::Relaxed))
        .map_err(|e| Error::invalid(format!("Ctrl-C cannot be watched: {e}")))?;
    Ok(flag)
}
