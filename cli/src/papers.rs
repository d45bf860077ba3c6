//! `stiffarm papers`: printed equations and tables against what can be derived.

#[cfg(feature = "papers")]
mod judged;

use std::path::PathBuf;

#[cfg(feature = "papers")]
pub use judged::run;

use crate::terminal::output::Target;
#[cfg(not(feature = "papers"))]
use crate::{Verdict, host::Host, terminal::failure::Failure};

const EXAMPLES: &str = "\
Examples:
  stiffarm papers                        the ledger of the five built-in papers
  stiffarm papers --report ledger.html
  stiffarm papers my_paper/*.toml        another paper's equations
  stiffarm papers --figure growth --svg growth.svg";

/// Each printed equation and table cell of a paper: agrees, misprint and its correction, reproduced
///
/// Without files, the five papers that stiffarm was built on. A file holds equations in LaTeX as
/// they are printed, and what each is an equation of.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Files of printed equations (TOML)
    files: Vec<PathBuf>,
    /// Write the ledger as Markdown to OUT (standard output if there is no OUT)
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    #[arg(conflicts_with_all = ["html", "json"])]
    markdown: Option<Target>,
    /// Write it as one self-contained page
    #[arg(long = "report", visible_alias = "html", value_name = "OUT.html")]
    #[arg(num_args = 0..=1, default_missing_value = "-")]
    #[arg(conflicts_with = "json")]
    html: Option<Target>,
    /// Write it as JSON
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    json: Option<Target>,
    /// Instead of the ledger, what a paper says of but does not show, as a table
    #[arg(long, value_enum, conflicts_with_all = ["files", "markdown", "html", "json"])]
    figure: Option<Figure>,
    /// Write the figure as a picture
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    #[arg(requires = "figure")]
    svg: Option<Target>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Figure {
    /// Jweeg & Al-Khafaji: how the error of the approximate kinematics grows with flexibility
    Growth,
}

/// Says how to get the command.
#[cfg(not(feature = "papers"))]
pub fn run(_: &Args, _: &Host) -> Result<Verdict, Failure> {
    Err(Failure::new(
        "this build of stiffarm does not judge papers, and one with the feature `papers` does: \
         cargo install --path cli --features papers",
    ))
}
