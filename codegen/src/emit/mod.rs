//! Printers of the derived graph (Rust, C, LaTeX, dot) and of the arm itself (URDF, MJCF). Each is one file
//! or folder.

mod angles;
#[cfg(feature = "urdf")]
mod bodies;
mod c;
mod constants;
mod docs;
mod dot;
mod expression;
mod latex;
mod lines;
mod literal;
#[cfg(feature = "urdf")]
mod mjcf;
mod plan;
mod posture;
mod readings;
mod rust;
#[cfg(feature = "urdf")]
mod urdf;

pub use c::{CFiles, COptions, Precision, Sines, SymbolicTable, c, c_name};
pub use dot::dot;
pub use latex::{flexible_latex, latex};
#[cfg(feature = "urdf")]
pub use mjcf::mjcf;
pub use rust::{FILE_HEAD, RustOptions, flexible_rust, rust};
#[cfg(feature = "urdf")]
pub use urdf::urdf;

use crate::derive::Output;
use crate::robot::Robot;

/// How a command asks for the outputs of a robot, where they are not all of them.
fn asked(robot: &Robot) -> String {
    let names: Vec<&str> = robot.generated().into_iter().map(Output::name).collect();
    if robot.outputs.is_empty() { String::new() } else { format!(" --outputs {}", names.join(",")) }
}

/// What the functions of a module compute: each of `outputs` by itself, and `all` what can be had together.
fn sets(outputs: &[Output]) -> Vec<Vec<Output>> {
    let together: Vec<Output> = outputs.iter().copied().filter(|o| o.is_fused()).collect();
    let singles = outputs.iter().map(|output| vec![*output]);
    singles.chain((together.len() > 1).then_some(together)).collect()
}
