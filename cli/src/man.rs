//! `stiffarm man`: the manual pages.

use std::path::PathBuf;

use clap::{Command, CommandFactory as _};
use clap_mangen::Man;

use super::{Cli, Verdict};
use crate::host::Host;
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm man | man -l -
  stiffarm man --out ~/.local/share/man/man1";

/// The manual page to standard output, or a page per command into a folder
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Write stiffarm.1, stiffarm-eval.1, … into this folder, which is made if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let mut whole = Cli::command();
    whole.build();
    let Some(folder) = &args.out else {
        host.print(&page(whole)?)?;
        return Ok(Verdict::Good);
    };
    let make = std::fs::create_dir_all(folder);
    make.map_err(|error| Failure::io("make the folder", folder, &error))?;
    let commands = whole.get_subcommands().filter(|c| c.get_name() != "help");
    let mut pages: Vec<Command> = commands.cloned().collect();
    pages.push(whole.clone());
    for command in pages {
        let name = command.get_display_name().unwrap_or(command.get_name()).replace(' ', "-");
        let file = folder.join(format!("{name}.1"));
        host.write(&Target::File(file), &page(command)?)?;
    }
    Ok(Verdict::Good)
}

fn page(command: Command) -> Result<String, Failure> {
    let mut text = Vec::new();
    let made = Man::new(command).render(&mut text);
    made.map_err(|error| Failure::new(format!("cannot write the manual: {error}")))?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}
