//! The command line: `stiffarm --help` says what it does. [`main`] runs it; [`run`] and [`diagnose`]
//! do the same for another program, which hands over files and takes what is told ([`host`]).
//!
//! One file per command; what they share lies in rooms: `input` (robots, data, numbers as they are given), `terminal` (text, errors, progress,
//! files written). What a diagnosis reports is a document of `stiffarm-document`.
#![forbid(unsafe_code)]

mod check;
mod compensate;
mod completions;
mod controller;
mod diagnose;
#[cfg(test)]
mod documented;
mod effects;
mod eval;
mod generate;
pub mod host;
mod identify;
mod import;
mod input;
mod man;
mod map;
mod measurements;
mod motion;
mod papers;
mod poses;
mod predict;
mod robots;
mod simulate;
mod terminal;
mod withhold;

use std::any::TypeId;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Arg, ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use terminal::interrupt;
use terminal::output::{self, Target};

pub use diagnose::{
    Campaign, Catalogues, Format, Found, Motion, Predicted, PredictedLog, Settings, Together,
    diagnose,
};
use host::{Ended, Host};
pub use input::source::{RobotArgs, Source};
pub use map::Axes;
pub use stiffarm_document::TOP;
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

/// Each command has a module, in which `Args` is what it takes and `run` what it does.
macro_rules! commands {
    ($($command:ident in $module:ident,)*) => {
        #[derive(Subcommand)]
        enum Command {
            $($command(Box<$module::Args>),)*
        }

        fn execute(command: Command, host: &Host) -> Result<Verdict, Failure> {
            match command {
                $(Command::$command(args) => $module::run(&args, host),)*
            }
        }
    };
}

commands! {
    Eval in eval,
    Check in check,
    Robots in robots,
    Import in import,
    Generate in generate,
    Map in map,
    Measurements in measurements,
    Poses in poses,
    Identify in identify,
    Diagnose in diagnose,
    Effects in effects,
    Predict in predict,
    Simulate in simulate,
    Withhold in withhold,
    Compensate in compensate,
    Controller in controller,
    Papers in papers,
    Completions in completions,
    Man in man,
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
    let ended = apart(&given).and_then(|()| execute(command, &Host::default().quiet(quiet)));
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
pub fn run(host: &Host) -> Result<Result<bool, Failure>, Ended> {
    host.run(|| {
        let Cli { command, quiet } = read(host)?;
        execute(command, &host.quiet(quiet)).map(|verdict| verdict == Verdict::Good)
    })
}

/// The options of a command that read and write no file and are not of joint logs, and whether a value stands behind
/// each: what may be asked of a machine that is not one's own.
pub fn options_without_files(command: &str) -> Vec<(String, bool)> {
    let all = match command {
        "diagnose" => Asked::command(),
        other => Cli::command().find_subcommand(other).cloned().unwrap_or_default(),
    };
    let names_none = |option: &&Arg| {
        let kind = option.get_value_parser().type_id();
        kind != TypeId::of::<PathBuf>()
            && kind != TypeId::of::<Target>()
            && option.get_help_heading() != Some(diagnose::IN_MOTION)
    };
    let described = |option: &Arg| {
        Some((format!("--{}", option.get_long()?), option.get_action().takes_values()))
    };
    all.get_arguments().filter(names_none).filter_map(described).collect()
}

/// A robot and what is chosen of its diagnosis, in words.
#[derive(Parser)]
#[command(no_binary_name = true)]
struct Asked {
    #[command(flatten)]
    robot: RobotArgs,
    #[command(flatten)]
    settings: Settings,
}

/// What a robot and options behind it, as of `stiffarm diagnose`, ask for.
///
/// # Errors
/// [`Failure`]: words that are no such options.
pub fn asked(words: &[String]) -> Result<(RobotArgs, Settings), Failure> {
    let Asked { robot, settings } = Asked::try_parse_from(words).map_err(wrong)?;
    Ok((robot, settings))
}

fn wrong(error: clap::Error) -> Failure {
    let text = error.to_string();
    let first = text.split("\n\n").next().unwrap_or_default();
    Failure::new(first.trim_start_matches("error: ").trim_end())
}

/// The command of the host's words.
fn read(host: &Host) -> Result<Cli, Failure> {
    let words = std::iter::once("stiffarm".to_owned()).chain(host.words());
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
