//! `stiffarm generate`: the closed form as text.

use std::path::PathBuf;

use clap::ValueEnum;
use stiffarm_codegen::derive::{Displacements, Output};
use stiffarm_codegen::emit::{RustOptions, dot, flexible_latex, flexible_rust, latex, rust};

use super::Verdict;
use super::failure::Failure;
use super::output::{Target, print};
use super::source::{self, Source};
use super::text::{bad, dim, good};

const EXAMPLES: &str = "\
Examples:
  stiffarm generate ur5 --emit rust --out src/ur5.rs
  stiffarm generate ur5 --emit rust --check src/ur5.rs     (exit status 1 if it differs)
  stiffarm generate arm.toml --emit latex --output jacobian --output deflection > arm.tex
  stiffarm generate arm.toml --emit dot | dot -Tsvg > arm.svg
  stiffarm generate jweeg_two_link --emit latex --flexible dx,dy,dphi > flexible.tex";

/// The kernels as Rust, or the closed form as LaTeX or as a graph
///
/// The Rust text is what the macro `robot!` compiles; the same table always gives the same bytes.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// A robot file (TOML), or the id of a built-in robot
    robot: String,
    /// What to write
    #[arg(long, value_enum)]
    emit: Emit,
    /// An output to write, may be repeated [default: all of them as LaTeX, the Jacobian as dot]
    #[arg(long = "output", value_name = "NAME", value_parser = outputs())]
    outputs: Vec<String>,
    /// The pose with displacements in the chain instead, exact and in both approximations: a list
    /// of dx, dy, dz (m), dpsi, dbeta, dphi (rad, about x, y, z), of every link, or of one place
    /// like dphi1, 0 is the base [all of them everywhere if there is no LIST]
    #[arg(long, value_name = "LIST", num_args = 0..=1, default_missing_value = "")]
    #[arg(conflicts_with = "outputs")]
    flexible: Option<String>,
    /// Path of the kernels crate in the Rust text [default: ::stiffarm::kernels]
    #[arg(long, value_name = "PATH")]
    kernels: Option<String>,
    /// Write into this file (`-`: to standard output)
    #[arg(long, value_name = "FILE")]
    out: Option<Target>,
    /// Compare with this file, byte by byte, and write nothing
    #[arg(long, value_name = "FILE", conflicts_with = "out")]
    check: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// A module with a function per output
    Rust,
    /// A document to lay beside a paper
    Latex,
    /// The expression graph, for Graphviz
    Dot,
}

fn outputs() -> Vec<&'static str> {
    Output::EACH.map(Output::name).to_vec()
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the robot, options that do not go together, a file that cannot be read or written.
pub fn run(args: &Args, quiet: bool) -> Result<Verdict, Failure> {
    args.go_together()?;
    let source = source::open(&args.robot, quiet)?;
    let text = match &args.flexible {
        Some(list) => args.flexible(list, &source)?,
        None => args.text(&source),
    };
    match (&args.check, &args.out) {
        (Some(file), _) => args.check(file, &text, quiet),
        (None, Some(target)) => target.write(&text).map(|()| Verdict::Good),
        (None, None) => print(&text).map(|()| Verdict::Good),
    }
}

impl Args {
    fn go_together(&self) -> Result<(), Failure> {
        match self.emit {
            Emit::Rust if !self.outputs.is_empty() => {
                Err(Failure::new("--output is for latex and dot: the Rust module has every output"))
            }
            Emit::Dot if self.flexible.is_some() => {
                Err(Failure::new("--flexible is for rust and latex"))
            }
            Emit::Latex | Emit::Dot if self.kernels.is_some() => {
                Err(Failure::new("--kernels is for rust: latex and dot use no crate"))
            }
            _ => Ok(()),
        }
    }

    fn text(&self, Source { robot, .. }: &Source) -> String {
        let asked = Output::EACH.into_iter();
        let asked = asked.filter(|o| self.outputs.iter().any(|name| name == o.name()));
        let asked: Vec<Output> = asked.collect();
        let or =
            |default: &[Output]| if asked.is_empty() { default.to_vec() } else { asked.clone() };
        match self.emit {
            Emit::Latex => latex(robot, &or(&Output::EACH)),
            Emit::Dot => dot(robot, &or(&[Output::Jacobian])),
            Emit::Rust => rust(robot, &self.options()),
        }
    }

    fn options(&self) -> RustOptions {
        let kernels = self.kernels.clone();
        kernels.map_or_else(RustOptions::default, |kernels| RustOptions { kernels })
    }

    fn flexible(&self, list: &str, Source { robot, .. }: &Source) -> Result<String, Failure> {
        let displacements = match list {
            "" => Displacements::all(robot.dof()),
            list => Displacements::read(list, robot.dof()).map_err(Failure::new)?,
        };
        Ok(match self.emit {
            Emit::Rust => flexible_rust(robot, &displacements, &self.options()),
            Emit::Latex | Emit::Dot => flexible_latex(robot, &displacements),
        })
    }

    fn check(&self, file: &PathBuf, text: &str, quiet: bool) -> Result<Verdict, Failure> {
        let found = std::fs::read(file).map_err(|error| Failure::io("read", file, &error))?;
        let name = file.display();
        if found == text.as_bytes() {
            if !quiet {
                print(&format!("{} {name} is what {} gives\n", good("✓"), self.robot))?;
            }
            return Ok(Verdict::Good);
        }
        let found = String::from_utf8_lossy(&found);
        let (line, expected, found) = first_difference(text, &found);
        let head = format!("{} {name} is not what {} gives", bad("✗"), self.robot);
        let (want, have) = (dim("expected"), dim("   found"));
        print(&format!("{head}, first in line {line}:\n  {want} {expected}\n  {have} {found}\n"))?;
        Ok(Verdict::Failed)
    }
}

/// The first line that differs, from 1, as it is in either text.
fn first_difference(expected: &str, found: &str) -> (usize, String, String) {
    // With their ends, for a missing one is a difference too.
    let (mut left, mut right) = (expected.split_inclusive('\n'), found.split_inclusive('\n'));
    let mut line = 1;
    loop {
        match (left.next(), right.next()) {
            (Some(a), Some(b)) if a == b => line += 1,
            (a, b) => return (line, shown(a, b), shown(b, a)),
        }
    }
}

/// A line as it can be printed; its end only where that is the difference.
fn shown(line: Option<&str>, other: Option<&str>) -> String {
    let Some(line) = line else { return dim("(the file has ended)") };
    let bare = line.trim_end_matches(['\r', '\n']);
    let same = other.is_some_and(|other| other.trim_end_matches(['\r', '\n']) == bare);
    // What cannot be seen must not steer the terminal.
    let visible = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
    if same { format!("{line:?}") } else { bare.chars().map(visible).collect() }
}
