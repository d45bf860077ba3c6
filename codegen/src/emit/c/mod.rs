//! The C printer: one header and one source per robot, C99, for firmware.
//!
//! The text is the Rust module's, operation by operation: the same plan, the same order, the same
//! polynomial for sines and cosines. Compiled without fused products and without fast-math it gives the
//! same bits.

mod comment;
mod function;
mod hash;
mod header;
mod name;
mod posture;
mod solve;
mod source;
mod style;
mod trigonometry;

pub use name::c_name;

use core::fmt;

use self::function::Function;
use self::posture::Entrance;
use super::constants::Constants;
use super::functions;
use super::plan::Plan;
use super::posture::{Needs, Posture};
use super::readings::Stage;
use crate::derive::Program;
use crate::robot::Robot;

/// How the C text is to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct COptions {
    /// What every name begins with, and what the two files are called: see [`c_name`].
    pub name: String,
    /// The numbers' type.
    pub precision: Precision,
    /// Where sines and cosines come from.
    pub sines: Sines,
}

/// The type of all numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `float`.
    F32,
    /// `double`.
    #[default]
    F64,
}

/// Where sines and cosines come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sines {
    /// The polynomial of the Rust kernels, as a function of the source: no branch, no library.
    #[default]
    Polynomial,
    /// `sin` and `cos` of `math.h`.
    Math,
    /// The caller: only the functions that take sines and cosines are written.
    Given,
}

/// The text of both files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CFiles {
    /// `<name>.h`.
    pub header: String,
    /// `<name>.c`.
    pub source: String,
}

/// The table has parameters without numbers: C is written of numbers only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SymbolicTable {
    /// The parameters' names.
    pub parameters: Vec<String>,
}

impl fmt::Display for SymbolicTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.parameters.join(", ");
        write!(f, "found no number for {names}, expected a table of numbers")
    }
}

impl core::error::Error for SymbolicTable {}

/// The kernels of a robot as C99. The same table and options always give the same bytes.
///
/// # Errors
/// [`SymbolicTable`] where a cell of the table is no number.
pub fn c(robot: &Robot, options: &COptions) -> Result<CFiles, SymbolicTable> {
    c_with(robot, &[], options)
}

/// The same with functions of one's own.
pub(crate) fn c_with(
    robot: &Robot,
    own: &[&Program],
    options: &COptions,
) -> Result<CFiles, SymbolicTable> {
    let symbols = robot.symbols();
    if !symbols.is_empty() {
        return Err(SymbolicTable { parameters: symbols.into_iter().map(|s| s.name).collect() });
    }
    let all = functions(robot);
    let (tool, places) = all.split_at(1);
    let of_tool = tool.iter().flat_map(|of| &of.programs).chain(own.iter().copied());
    let of_tool = of_tool.map(|program| (None, program));
    let of_places = places
        .iter()
        .flat_map(|of| of.programs.iter().map(|program| (of.place.as_deref(), program)));
    let (each, programs): (Vec<_>, Vec<_>) = of_tool.chain(of_places).unzip();
    let plan = |program| Plan::new(program, &mut Constants::default());
    let plans: Vec<Plan> = programs.into_iter().map(plan).collect();
    let language = style::C { precision: options.precision };
    let mut posture = Posture::default();
    let needs: Vec<Needs> = plans.iter().map(|plan| posture.admit(plan, &language)).collect();
    let stage = Stage::of(robot);
    let entrance = Entrance { stage: &stage, language: &language, name: &options.name };
    let functions = plans.iter().zip(each).zip(&needs);
    let functions: Vec<Function> = functions
        .map(|((plan, place), needs)| {
            let (language, entrance) = (&language, &entrance);
            Function { plan, place, needs, language, entrance }
        })
        .collect();
    let (language, entrance) = (&language, &entrance);
    let module = Module { robot, options, language, entrance, posture, functions };
    let table = hash::table(robot);
    let source = source::source(&module, &table);
    let header = header::header(&module, &table, &source);
    Ok(CFiles { header, source })
}

/// Everything that both files are written from.
struct Module<'a> {
    robot: &'a Robot,
    options: &'a COptions,
    language: &'a style::C,
    entrance: &'a Entrance<'a>,
    posture: Posture,
    functions: Vec<Function<'a>>,
}

impl Module<'_> {
    fn name(&self) -> &str {
        &self.options.name
    }

    /// A macro of the header: `UR10_JOINTS`.
    fn constant(&self, suffix: &str) -> String {
        format!("{}_{suffix}", self.name().to_uppercase())
    }
}
