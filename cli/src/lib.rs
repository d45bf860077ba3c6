//! The command line: `stiffarm --help` says what it does. [`main`] runs it; [`run`] and [`diagnose_inside`]
//! do the same for another program, which hands over files and takes what is told ([`inside`]).
//!
//! One file per command; what they share lies in rooms: `input` (robots, data, numbers as they are given), `terminal` (text, errors, progress,
//! files written), `document` (what a command reports, printed to a screen or as a page), `plot`.
#![forbid(unsafe_code)]

mod check;
mod compensate;
mod completions;
mod diagnose;
mod document;
#[cfg(test)]
mod documented;
mod effects;
mod eval;
mod generate;
mod identify;
mod import;
mod input;
pub mod inside;
mod man;
mod map;
mod measurements;
mod motion;
mod papers;
mod plot;
mod poses;
mod predict;
mod robots;
mod simulate;
mod terminal;
mod withhold;

use std::process::ExitCode;
use std::sync::Arc;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use terminal::{interrupt, output};

pub use diagnose::{
    Campaign, Catalogues, Format, Found, Motion, Predicted, PredictedLog, Together,
};
pub use input::source::{RobotArgs, Source};
use inside::{Ended, Host};
pub use map::Axes;
pub use terminal::failure::{Failure, Remark};
pub use terminal::json;
pub use terminal::whole::Whole;

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Yellow.on_default().bold())
    .usage(AnsiColor::Yellow.on_default().bold())
    .literal(AnsiColor::Green.on_default())
    .placeholder(AnsiColor::Cyan.on_default());

const ABOUT: &str = "From a robot arm's Denavit-Hartenberg table: closed-form elastostatics, and \
                     why the real arm is not where the model says";

const AFTER: &str = "\
A ROBOT is a robot file (TOML), a URDF of one serial chain, the id of a built-in robot (`stiffarm robots` lists them), or a
diagnosis in JSON: the robot with what it found.
Units are SI (m, rad, N, N·m, kg) unless one stands beside a number: 30deg, 12in, 50lbf.

Exit status: 0 well; 1 a check failed; 2 an argument or a file could not be used, and nothing was
written; 3 the measurements are no arm's, and no mistake explains why (diagnose); 130 interrupted by Ctrl-C: what was found until then is told and written.";

/// The whole command line.
#[derive(Parser)]
#[command(name = "stiffarm", version, about = ABOUT, after_help = AFTER, styles = STYLES)]
#[command(subcommand_required = true, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print neither remarks nor progress, only results and errors
    #[arg(long, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    Eval(eval::Args),
    Check(check::Args),
    Robots(robots::Args),
    Import(import::Args),
    Generate(generate::Args),
    Map(map::Args),
    Measurements(measurements::Args),
    Poses(poses::Args),
    Identify(identify::Args),
    Diagnose(Box<diagnose::Args>),
    Effects(effects::Args),
    Predict(predict::Args),
    Simulate(simulate::Args),
    Withhold(withhold::Args),
    Compensate(compensate::Args),
    Papers(papers::Args),
    Completions(completions::Args),
    Man(man::Args),
}

/// How a command that could do its work ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// As it should.
    Good,
    /// What was to be checked is not so.
    Failed,
    /// What was measured is no arm's, and nothing explains why.
    Unexplained,
}

/// Runs the command line that this process was started with.
pub fn main() -> ExitCode {
    let given = Cli::command().get_matches();
    let Cli { command, quiet } = Cli::from_arg_matches(&given).unwrap_or_else(|error| error.exit());
    let ended = apart(&given).and_then(|()| execute(command, quiet));
    match ended {
        Ok(_) if interrupt::is_asked() => ExitCode::from(interrupt::INTERRUPTED),
        Ok(Verdict::Good) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(1),
        Ok(Verdict::Unexplained) => ExitCode::from(3),
        Err(failure) => {
            failure.print();
            ExitCode::from(2)
        }
    }
}

/// Runs the command that the host's words are, and tells whether everything was as it should.
///
/// # Errors
/// [`Failure`] as at a terminal, of wrong words too; [`Ended`] if the host asked for the end.
pub fn run(host: &Arc<Host>) -> Result<Result<bool, Failure>, Ended> {
    host.run(|| {
        let Cli { command, quiet } = read(host)?;
        execute(command, quiet).map(|verdict| verdict == Verdict::Good)
    })
}

/// Diagnoses as the host's words say, `diagnose` being the first, with the effects of `catalogues`; outputs that are
/// named among them are not written.
///
/// # Errors
/// [`Failure`] as at a terminal, of wrong words too; [`Ended`] if the host asked for the end.
pub fn diagnose_inside(
    host: &Arc<Host>,
    catalogues: Catalogues,
) -> Result<Result<Found, Failure>, Ended> {
    host.run(|| match read(host)? {
        Cli { command: Command::Diagnose(args), quiet } => diagnose::find(&args, catalogues, quiet),
        _ => Err(Failure::new("found another command, expected diagnose")),
    })
}

/// The command of the host's words.
fn read(host: &Host) -> Result<Cli, Failure> {
    let wrong = |error: clap::Error| {
        let text = error.to_string();
        let first = text.split("\n\n").next().unwrap_or_default();
        Failure::new(first.trim_start_matches("error: ").trim_end())
    };
    let words = std::iter::once("stiffarm").chain(host.words.iter().map(String::as_str));
    let given = Cli::command().try_get_matches_from(words).map_err(wrong)?;
    apart(&given)?;
    Cli::from_arg_matches(&given).map_err(wrong)
}

/// Refuses outputs of the command that are one, or that it reads.
fn apart(given: &ArgMatches) -> Result<(), Failure> {
    let all = Cli::command();
    let chosen =
        given.subcommand().and_then(|(name, given)| Some((all.find_subcommand(name)?, given)));
    chosen.map_or(Ok(()), |(command, given)| output::apart(command, given))
}

fn execute(command: Command, quiet: bool) -> Result<Verdict, Failure> {
    match command {
        Command::Eval(args) => eval::run(&args, quiet),
        Command::Check(args) => check::run(&args, quiet),
        Command::Robots(args) => robots::run(&args),
        Command::Import(args) => import::run(&args, quiet),
        Command::Generate(args) => generate::run(&args, quiet),
        Command::Map(args) => map::run(&args, quiet),
        Command::Measurements(args) => measurements::run(&args, quiet),
        Command::Poses(args) => poses::run(&args, quiet),
        Command::Identify(args) => identify::run(&args, quiet),
        Command::Diagnose(args) => diagnose::run(&args, quiet),
        Command::Effects(args) => effects::run(&args),
        Command::Predict(args) => predict::run(&args, quiet),
        Command::Simulate(args) => simulate::run(&args, quiet),
        Command::Withhold(args) => withhold::run(&args, quiet),
        Command::Compensate(args) => compensate::run(&args, quiet),
        Command::Papers(args) => papers::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
    }
}
