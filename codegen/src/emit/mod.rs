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

use crate::robot::Robot;

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
