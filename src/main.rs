//! The command line: `stiffarm --help` says what it does.
#![forbid(unsafe_code)]

mod cli;
mod parity;

fn main() -> std::process::ExitCode {
    cli::main()
}
