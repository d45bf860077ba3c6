//! The C printer: one header and one source per robot, C99, for firmware.
//!
//! The text is the Rust module's, operation by operation: the same plan, the same order, the same
//! polynomial for sines and cosines. Compiled without fused products and without fast-math it gives the
//! same bits.

mod arctangent;
pub(super) mod comment;
mod function;
pub(super) mod header;
mod name;
mod posture;
pub(super) mod set_points;
mod solve;
pub(super) mod source;
pub(super) mod style;
mod trigonometry;

pub use name::c_name;

use core::fmt;

use self::function::Function;
pub(super) use self::function::may_fail;
use self::style::C;
use super::{NotWritten, hash};
use crate::derive::Program;
use crate::ir;
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
/// [`NotWritten`] where a cell of the table is no number.
pub fn c(robot: &Robot, options: &COptions) -> Result<CFiles, NotWritten> {
    c_with(robot, &[], options)
}

/// The same with functions of one's own.
pub(crate) fn c_with(
    robot: &Robot,
    own: &[&Program],
    options: &COptions,
) -> Result<CFiles, NotWritten> {
    let module = Module::new(robot, own, options, false)?;
    let table = hash::table(robot);
    let source = source::source(&module, &table);
    let header = header::header(&module, &table, &source);
    Ok(CFiles { header, source })
}

/// Everything that both files are written from.
pub(super) struct Module<'a> {
    pub ir: ir::Module<'a>,
    options: &'a COptions,
    pub language: C,
}

impl<'a> Module<'a> {
    /// `device`: for CUDA's.
    pub fn new(
        robot: &'a Robot,
        own: &[&Program],
        options: &'a COptions,
        device: bool,
    ) -> Result<Self, SymbolicTable> {
        let symbols = robot.symbols();
        if !symbols.is_empty() {
            return Err(SymbolicTable {
                parameters: symbols.into_iter().map(|s| s.name).collect(),
            });
        }
        let math = device || options.sines == Sines::Math;
        let language = C { precision: options.precision, device, math };
        Ok(Module { ir: ir::Module::new(robot, own, false), options, language })
    }

    pub fn name(&self) -> &str {
        &self.options.name
    }

    /// A macro of the header: `UR10_JOINTS`.
    pub fn constant(&self, suffix: &str) -> String {
        format!("{}_{suffix}", self.name().to_uppercase())
    }

    pub fn functions(&self) -> impl Iterator<Item = Function<'_>> {
        self.ir.functions().map(|of| Function { of, module: self })
    }
}
