//! What reality does that the sim does not: a place and a shape of error, one file each.
//!
//! A new effect is one file that implements [`Effect`]. In this crate it stands in `catalogue/`, with
//! one line in [`CATALOGUE`] and, if the independent plant is to plant it, its law there; a program
//! that uses the crate puts its own beside them with [`Catalogue::with`]. Nothing else asks which
//! effect it has before it: the identifier stands in the effect's own file and nowhere else.

mod about;
mod at_place;
mod carrier;
mod catalogue;
mod curve;
mod draw;
mod effect;
mod kind;
mod known;
mod numbers;
mod parameter;
mod place;
mod robot_file;
mod scene;
#[cfg(test)]
mod tests;
mod told;

use nalgebra::Vector6;
pub use stiffarm_codegen::robot::beyond::Quantity;
use stiffarm_kernels::generic::Arm;

use crate::displacement::Displacement;

pub use about::About;
pub(crate) use at_place::{at_place, cannot_act, did_you_mean};
pub use carrier::Carrier;
pub use catalogue::*;
pub use curve::{Curve, Over};
pub use draw::Draw;
pub use effect::Effect;
pub use kind::{Depends, Forms, Group, MOST_ORDERS};
pub use known::{Known, KnownError};
pub(crate) use known::{advice, file_name, si, table};
pub use parameter::Parameter;
pub use place::{Place, Spot};
pub(crate) use robot_file::significant;
pub use robot_file::{RobotFile, Row as RobotRow};
pub use scene::Scene;
pub use told::Told;
// alias: old path
pub use crate::report::Parameter as ParameterReport;

/// The six numbers of a displacement.
fn displacement([length, angle]: [Quantity; 2]) -> Vec<Parameter> {
    let one = |(k, name): (usize, &'static str)| {
        Parameter::free(name, if k < 3 { length } else { angle }).usually(0.05)
    };
    SIX.into_iter().enumerate().map(one).collect()
}

/// One displacement of a frame and then, in the frame that it leads to, another; six numbers each.
fn one_after_other(first: &[f64], then: &[f64]) -> Vec<f64> {
    let [first, then] = [first, then].map(|v| Displacement::new(&Vector6::from_column_slice(v)));
    first.then(&then).vector().iter().copied().collect()
}

/// Names of a displacement's components.
const SIX: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// The joints of an arm as places.
fn joints(arm: &Arm) -> Vec<Place> {
    (1..=arm.dof()).map(Place::Joint).collect()
}

/// The links of an arm as places.
fn links(arm: &Arm) -> Vec<Place> {
    (1..=arm.dof()).map(Place::Link).collect()
}
