//! The program `spiral-atlas`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
