//! The command line: `stiffarm --help` says what it does.
#![forbid(unsafe_code)]

mod cli;
mod import;
mod parity;
mod plot;
mod report;

fn main() -> std::process::ExitCode {
    cli::main()
}
