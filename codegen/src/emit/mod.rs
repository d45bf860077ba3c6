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
mod lost;
#[cfg(feature = "urdf")]
mod mjcf;
mod plan;
mod posture;
mod readings;
mod rust;
#[cfg(feature = "urdf")]
mod urdf;

pub(crate) use c::c_with;
pub use c::{CFiles, COptions, Precision, Sines, SymbolicTable, c, c_name};
pub use dot::dot;
pub use latex::{flexible_latex, latex};
#[cfg(feature = "urdf")]
pub use lost::{lost_in_mjcf, lost_in_urdf};
#[cfg(feature = "urdf")]
pub use mjcf::mjcf;
pub(crate) use rust::rust_with;
pub use rust::{FILE_HEAD, RustOptions, flexible_rust, rust};
#[cfg(feature = "urdf")]
pub use urdf::urdf;

use crate::derive::{Output, Program, derive_at, derive_each};
use crate::robot::Robot;

/// How a command asks for the outputs of a robot, where they are not all of its tool's.
fn asked(robot: &Robot) -> String {
    let names = robot.asked().join(",");
    match (names.is_empty(), robot.at.is_empty()) {
        (true, _) => String::new(),
        (false, true) => format!(" --outputs {names}"),
        // A name behind `at` makes spaces.
        (false, false) => format!(" --outputs '{names}'"),
    }
}

/// Functions of the tool, or of a frame or marker by its name.
struct Functions {
    place: Option<String>,
    /// The outputs that have a function of their own.
    outputs: Vec<Output>,
    /// Of each function what it computes.
    programs: Vec<Program>,
}

/// What is generated of a robot: the tool's functions, then those of each place at which some are asked for.
fn functions(robot: &Robot) -> Vec<Functions> {
    let outputs = robot.generated();
    let programs = derive_each(robot, &sets(&outputs));
    let tool = Functions { place: None, outputs, programs };
    let at = robot.places().into_iter().map(|(place, outputs)| {
        let programs =
            outputs.iter().filter_map(|output| derive_at(robot, place, *output)).collect();
        Functions { place: Some(place.to_owned()), outputs, programs }
    });
    core::iter::once(tool).chain(at).collect()
}

/// What the functions of a module compute: each of `outputs` by itself, and `all` what can be had together.
fn sets(outputs: &[Output]) -> Vec<Vec<Output>> {
    let together: Vec<Output> = outputs.iter().copied().filter(|o| o.is_fused()).collect();
    let singles = outputs.iter().map(|output| vec![*output]);
    singles.chain((together.len() > 1).then_some(together)).collect()
}
