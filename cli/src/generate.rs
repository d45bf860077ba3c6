//! `stiffarm generate`: the closed form as text.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use stiffarm_codegen::derive::{Displacements, Output};
use stiffarm_codegen::emit::{
    CFiles, COptions, CudaOptions, FILE_HEAD, NotWritten, Precision, RustOptions, Sines,
    SymbolicTable, c, c_name, cuda, dot, flexible_latex, flexible_rust, latex, mjcf, python, rust,
    urdf,
};
use stiffarm_codegen::robot::{Refused, Robot, Wanted};
use stiffarm_document::text::{bad, dim, good};
use stiffarm_kernels::generic::BaseParameter;

use super::Verdict;
use crate::host::Host;
use crate::input::source::{self, Source};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm generate ur5 --emit rust --out src/ur5.rs
  stiffarm generate ur5 --emit rust --check src/ur5.rs     (exit status 1 if it differs)
  stiffarm generate ur5 --emit rust --fused --out src/ur5_fused.rs
  stiffarm generate ur5 --emit c --precision f32 --out firmware/
  stiffarm generate ur5 --emit c --precision f32 --check firmware/
  stiffarm generate ur5 --emit python --out ur5.py
  stiffarm generate ur5 --emit cuda --outputs jacobian --out ur5.cu
  stiffarm generate arm.toml --emit latex --outputs jacobian,deflection > arm.tex
  stiffarm generate ur5 --emit rust --outputs pose,jacobian --out src/ur5.rs
  stiffarm generate better.toml --emit urdf --out better.urdf
  stiffarm generate ur5 --emit base
  stiffarm generate arm.toml --emit dot | dot -Tsvg > arm.svg
  stiffarm generate jweeg_two_link --emit latex --flexible dx,dy,dphi > flexible.tex";

/// The kernels as Rust, C, CUDA or Python, the closed form as LaTeX or as a graph, the arm as URDF or MJCF
///
/// The Rust text is what the macro `robot!` compiles, headed so that in a file of its own (`mod arm;`)
/// rustfmt and lints leave it alone; the C text gives the same bits. The CUDA text has a kernel for each
/// function, one posture a thread; the Python text needs NumPy alone and takes batches. The same table
/// always gives the same bytes.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// A robot file (TOML), or the id of a built-in robot
    robot: String,
    /// What to write
    #[arg(long, value_enum)]
    emit: Emit,
    /// What to write: outputs, separated by commas, of a named frame or a marker as in `pose at elbow`, of seven joints
    /// with one given as in `inverse_kinematics given 1` or `given elbow_angle` [default: what the robot file says, else
    /// all of the tool; of dot the Jacobian]
    #[arg(long, alias = "output", value_name = "LIST", value_delimiter = ',')]
    #[arg(value_parser = |text: &str| Wanted::read(text).map_err(told))]
    outputs: Vec<Wanted>,
    /// The pose with displacements in the chain instead, exact and in both approximations: a list
    /// of dx, dy, dz (m), dpsi, dbeta, dphi (rad, about x, y, z), of every link, or of one place
    /// like dphi1, 0 is the base [all of them everywhere if there is no LIST]
    #[arg(long, value_name = "LIST", num_args = 0..=1, default_missing_value = "")]
    #[arg(conflicts_with = "outputs")]
    flexible: Option<String>,
    /// Path of the kernels crate in the Rust text [default: ::stiffarm::kernels]
    #[arg(long, value_name = "PATH")]
    kernels: Option<String>,
    /// Fuse products into sums in Rust: faster where the target has the instruction and the kernels' feature
    /// `fma` asks for it, and not the same bits everywhere
    #[arg(long)]
    #[arg(conflicts_with = "flexible")]
    fused: bool,
    /// Type of the numbers in C and CUDA [default: f64]
    #[arg(long, value_enum)]
    precision: Option<Real>,
    /// Where sines and cosines come from in C [default: polynomial]
    #[arg(long, value_enum)]
    sines: Option<SinesFrom>,
    /// What the names in C and CUDA begin with, and both files of C [default: the robot's id or file name]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Write into this file (`-`: to standard output); C: both files into this folder. A missing
    /// folder is made
    #[arg(long, value_name = "PATH")]
    out: Option<Target>,
    /// Compare with this file, byte by byte, and write nothing; C: with both files of this folder
    #[arg(long, value_name = "PATH", conflicts_with = "out")]
    check: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// A module with a function per output
    Rust,
    /// A header and a source, C99, with a function per output
    C,
    /// CUDA C: one file with a kernel per output, one posture a thread
    Cuda,
    /// A module with a function per output on NumPy's arrays, batches first
    Python,
    /// A document to lay beside a paper
    Latex,
    /// The expression graph, for Graphviz
    Dot,
    /// The arm as links and joints, for simulators and controllers
    Urdf,
    /// The arm as bodies with its joints' springs, for MuJoCo
    Mjcf,
    /// Which sums of the links' moments of mass its torques can tell: base parameters, a line each
    Base,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Real {
    /// float
    F32,
    /// double
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SinesFrom {
    /// The Rust kernels' own, written along: no library
    Polynomial,
    /// math.h
    Math,
    /// The caller: only the functions that take sines and cosines
    Given,
}

/// The base parameters, each with the column of the torque regressor that is its own, from 1.
fn base(robot: &Robot) -> Result<String, Failure> {
    let arm = stiffarm_gap::robot::arm(robot)?;
    let sums = arm.base_parameters();
    let count = sums.len();
    let head = format!(
        "{}: {count} base parameters of {} moments of mass\ncolumn  sum\n",
        robot.name,
        10 * robot.dof()
    );
    let line = |sum: &BaseParameter| format!("{:>6}  {sum}\n", sum.moment + 1);
    Ok(sums.iter().map(line).fold(head, |text, line| text + &line))
}

/// What a parser of the command line can say.
fn told(Refused { message, help }: Refused) -> String {
    format!("{message}; {help}")
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    args.go_together()?;
    let mut source = source::open(&args.robot, host)?;
    source.robot = source.for_kernels()?;
    args.fits(&source.robot)?;
    if !args.outputs.is_empty() {
        let robot = &mut source.robot;
        robot.want_nothing();
        for wanted in &args.outputs {
            let refused =
                |no: Refused| Failure::with_help(format!("--outputs: {}", no.message), no.help);
            robot.want(wanted).map_err(refused)?;
        }
    }
    let all = &source.robot.outputs;
    source.refuse_motion(if all.is_empty() { &Output::EACH } else { all })?;
    let mut verdict = Verdict::Good;
    for (name, text) in args.files(&source)? {
        // One text is the file that was named, several are in the folder that was named.
        let place = |path: &Path| name.as_ref().map_or(path.to_path_buf(), |n| path.join(n));
        match (&args.check, &args.out) {
            (Some(path), _) if args.check(&place(path), &text, host)? == Verdict::Failed => {
                verdict = Verdict::Failed;
            }
            (Some(_), _) => {}
            (None, Some(Target::File(path))) => {
                let file = place(path);
                if let Some(folder) = file.parent().filter(|_| !host.owns(&file)) {
                    std::fs::create_dir_all(folder)
                        .map_err(|error| Failure::io("write", &file, &error))?;
                }
                host.write(&Target::File(file), &text)?;
            }
            (None, Some(Target::Stdout) | None) => host.print(&text)?,
        }
    }
    Ok(verdict)
}

impl Args {
    fn go_together(&self) -> Result<(), Failure> {
        let named = self.precision.is_some() || self.name.is_some();
        match self.emit {
            other if !matches!(other, Emit::C | Emit::Cuda) && named => {
                Err(Failure::new("--precision and --name are for c and cuda"))
            }
            other if other != Emit::C && self.sines.is_some() => {
                Err(Failure::new("--sines is for c"))
            }
            other if !matches!(other, Emit::Rust | Emit::Latex) && self.flexible.is_some() => {
                Err(Failure::new("--flexible is for rust and latex"))
            }
            other if other != Emit::Rust && self.kernels.is_some() => {
                Err(Failure::new("--kernels is for rust: what else is written uses no crate"))
            }
            other if other != Emit::Rust && self.fused => {
                Err(Failure::new("--fused is for rust: the C text gives the Rust text's bits"))
            }
            Emit::Urdf | Emit::Mjcf | Emit::Base if !self.outputs.is_empty() => Err(Failure::new(
                "--outputs is not for urdf, mjcf and base, which are of the arm itself",
            )),
            Emit::C if matches!(self.out, None | Some(Target::Stdout)) && self.check.is_none() => {
                Err(Failure::with_help(
                    "found no folder to write into: C is two files, a header and a source",
                    "name the folder: --out FOLDER",
                ))
            }
            _ => Ok(()),
        }
    }

    /// What shows the joints as they are, and not their readings, is not made of an arm of which these differ.
    fn fits(&self, robot: &Robot) -> Result<(), Failure> {
        let inverse = self.outputs.iter().any(|w| matches!(w, Wanted::InverseKinematics(_)));
        if inverse && self.emit == Emit::Dot {
            return Err(Failure::with_help(
                "--outputs: `inverse_kinematics` is not for dot",
                "it is written as rust, c, cuda, python or latex",
            ));
        }
        let what = match (self.emit, &self.flexible, self.sines) {
            (Emit::Urdf, ..) => "--emit urdf",
            (Emit::Mjcf, ..) => "--emit mjcf",
            (_, Some(_), _) => "--flexible",
            (Emit::C, _, Some(SinesFrom::Given)) => "--sines given",
            _ => return Ok(()),
        };
        let Some(effect) = robot.effects.first() else { return Ok(()) };
        let (name, place) = (effect.id.value.replace('_', " "), &effect.place.value);
        Err(Failure::with_help(
            format!("{what} has no place for the {name} at {place}"),
            "kernels have: --emit rust, python, cuda, or c with its own sines",
        ))
    }

    /// What is to be written; C has two files, with names of their own.
    fn files(&self, source: &Source) -> Result<Vec<(Option<String>, String)>, Failure> {
        let robot = &source.robot;
        let text = match (self.emit, &self.flexible) {
            (Emit::C, _) => return self.c(source),
            (_, Some(list)) => self.flexible(list, source)?,
            (Emit::Latex, None) => {
                latex(robot, &robot.generated()).map_err(|error| refused(robot, &error))?
            }
            (Emit::Dot, None) => match robot.outputs.as_slice() {
                [] => dot(robot, &[Output::Jacobian]),
                outputs => dot(robot, outputs),
            },
            (Emit::Urdf, None) => urdf(robot).map_err(|error| symbolic(robot, &error))?,
            (Emit::Mjcf, None) => mjcf(robot).map_err(|error| symbolic(robot, &error))?,
            (Emit::Base, None) => base(robot)?,
            (Emit::Rust, None) => rust(robot, &self.options()),
            (Emit::Python, None) => python(robot),
            (Emit::Cuda, None) => {
                let options =
                    CudaOptions { name: self.c_name(source)?, precision: self.precision() };
                cuda(robot, &options).map_err(|error| refused(robot, &error))?
            }
        };
        let head = if self.emit == Emit::Rust { FILE_HEAD } else { "" };
        Ok(vec![(None, format!("{head}{text}"))])
    }

    /// The header and the source.
    fn c(&self, source: &Source) -> Result<Vec<(Option<String>, String)>, Failure> {
        let options = self.c_options(source)?;
        let CFiles { header, source: text } =
            c(&source.robot, &options).map_err(|error| refused(&source.robot, &error))?;
        let file = |end: &str| Some(format!("{}.{end}", options.name));
        Ok(vec![(file("c"), text), (file("h"), header)])
    }

    fn c_options(&self, source: &Source) -> Result<COptions, Failure> {
        let sines = match self.sines {
            Some(SinesFrom::Polynomial) | None => Sines::Polynomial,
            Some(SinesFrom::Math) => Sines::Math,
            Some(SinesFrom::Given) => Sines::Given,
        };
        Ok(COptions { name: self.c_name(source)?, precision: self.precision(), sines })
    }

    fn precision(&self) -> Precision {
        match self.precision {
            Some(Real::F32) => Precision::F32,
            Some(Real::F64) | None => Precision::F64,
        }
    }

    /// What names in C begin with.
    fn c_name(&self, source: &Source) -> Result<String, Failure> {
        match &self.name {
            Some(name) if *name != c_name(name) => Err(Failure::with_help(
                format!("--name: found `{name}`, expected lower-case letters, digits and _"),
                format!("`{}` would do", c_name(name)),
            )),
            Some(name) => Ok(name.clone()),
            None => {
                let stem = Path::new(&source.given).file_stem().unwrap_or_default();
                Ok(c_name(&stem.to_string_lossy()))
            }
        }
    }

    fn options(&self) -> RustOptions {
        let kernels = self.kernels.clone().unwrap_or_else(|| RustOptions::default().kernels);
        RustOptions { kernels, fused: self.fused }
    }

    fn flexible(&self, list: &str, Source { robot, .. }: &Source) -> Result<String, Failure> {
        let displacements = match list {
            "" => Displacements::all(robot.dof()),
            list => Displacements::read(list, robot.dof()).map_err(Failure::new)?,
        };
        Ok(match self.emit {
            Emit::Rust => flexible_rust(robot, &displacements, &self.options()),
            _ => flexible_latex(robot, &displacements),
        })
    }

    fn check(&self, file: &Path, text: &str, host: &Host) -> Result<Verdict, Failure> {
        let found = std::fs::read(file).map_err(|error| Failure::io("read", file, &error))?;
        let name = file.display();
        if found == text.as_bytes() {
            if !host.is_quiet() {
                host.print(&format!("{} {name} is what {} gives\n", good("✓"), self.robot))?;
            }
            return Ok(Verdict::Good);
        }
        let found = String::from_utf8_lossy(&found);
        let (line, expected, found) = first_difference(text, &found);
        let head = format!("{} {name} is not what {} gives", bad("✗"), self.robot);
        let (want, have) = (dim("expected"), dim("   found"));
        host.print(&format!(
            "{head}, first in line {line}:\n  {want} {expected}\n  {have} {found}\n"
        ))?;
        Ok(Verdict::Failed)
    }
}

fn symbolic(robot: &Robot, error: &SymbolicTable) -> Failure {
    let message = format!("{}: {error}", robot.name);
    Failure::with_help(message, "write the numbers into a copy of the robot file")
}

fn refused(robot: &Robot, error: &NotWritten) -> Failure {
    match error {
        NotWritten::Symbolic(table) => symbolic(robot, table),
        NotWritten::Inverse { written, .. } => Failure::with_help(
            error.to_string(),
            format!("write {written}, or leave it out of the outputs"),
        ),
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
