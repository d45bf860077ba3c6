//! Printers of the statement tree (Rust, C, CUDA, Python, LaTeX), of the graph (dot) and of the arm itself (URDF, MJCF). Each is one file
//! or folder.

#[cfg(feature = "urdf")]
mod bodies;
mod c;
mod cells;
mod cuda;
mod docs;
mod dot;
mod hash;
mod latex;
mod legend;
mod lines;
mod literal;
#[cfg(feature = "urdf")]
mod lost;
#[cfg(feature = "urdf")]
mod mjcf;
mod python;
mod rust;
#[cfg(feature = "urdf")]
mod urdf;

pub(crate) use c::c_with;
pub use c::{CFiles, COptions, Precision, Sines, SymbolicTable, c, c_name};
pub(crate) use cuda::cuda_with;
pub use cuda::{CudaOptions, cuda};
pub use dot::dot;
pub use latex::{flexible_latex, latex};
#[cfg(feature = "urdf")]
pub use lost::{lost_in_mjcf, lost_in_urdf};
#[cfg(feature = "urdf")]
pub use mjcf::mjcf;
pub use python::python;
pub(crate) use python::python_with;
pub(crate) use rust::rust_with;
pub use rust::{FILE_HEAD, RustOptions, flexible_rust, rust};
#[cfg(feature = "urdf")]
pub use urdf::urdf;

use core::fmt;

use crate::robot::Robot;

/// What a language's text is not written of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotWritten {
    /// C and CUDA: a table with parameters without numbers.
    Symbolic(SymbolicTable),
    /// An inverse kinematics that is no closed form of the arm itself.
    Inverse {
        /// What it is.
        is: &'static str,
        /// The languages that have it.
        written: &'static str,
    },
}

impl fmt::Display for NotWritten {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotWritten::Symbolic(table) => table.fmt(f),
            NotWritten::Inverse { is, written } => write!(
                f,
                "`inverse_kinematics` of this arm is {is}, and is written as {written} alone"
            ),
        }
    }
}

impl core::error::Error for NotWritten {}

impl From<SymbolicTable> for NotWritten {
    fn from(table: SymbolicTable) -> Self {
        NotWritten::Symbolic(table)
    }
}

/// How a command asks for the outputs of a robot, where they are not all of its tool's.
fn asked(robot: &Robot) -> String {
    let names = robot.asked().join(",");
    match names.as_str() {
        "" => String::new(),
        // What stands behind `at` and `given`.
        names if names.contains(' ') => format!(" --outputs '{names}'"),
        names => format!(" --outputs {names}"),
    }
}
