//! The program `stiffarm`: the library's command line.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    stiffarm_cli::main()
}
