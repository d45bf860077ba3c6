//! `stiffarm completions`: for the shell's Tab key.

use clap::CommandFactory as _;
use clap_complete::{Shell, generate};

use super::{Cli, Verdict};
use crate::host::Host;
use crate::terminal::failure::Failure;

const EXAMPLES: &str = "\
Examples:
  stiffarm completions bash > ~/.local/share/bash-completion/completions/stiffarm
  stiffarm completions fish > ~/.config/fish/completions/stiffarm.fish";

/// Completions for a shell, to standard output
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Which shell
    #[arg(value_enum)]
    shell: Shell,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let mut text = Vec::new();
    generate(args.shell, &mut Cli::command(), "stiffarm", &mut text);
    host.print(&String::from_utf8_lossy(&text))?;
    Ok(Verdict::Good)
}
