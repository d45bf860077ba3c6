//! What reality does that the sim does not: a place and a shape of error, one file each.
//!
//! An effect has laws: how it acts at rest ([`AtRest`]), and in motion on a log's torques or positions
//! ([`InMotion`]). Each declares what is known of it as [`Facts`]. A new effect is one file in `catalogue/`, with a line
//! in the lists there and, if the independent plant is to plant it, its law in the plant; a program
//! that uses the crate puts its own beside them with [`Laws::with`]. Nothing else asks which
//! effect it has before it: the identifier stands in the effect's own file and nowhere else.

mod at_place;
mod at_rest;
mod body;
mod carrier;
mod catalogue;
mod curve;
mod displacement;
mod draw;
mod facts;
mod in_motion;
mod kind;
mod known;
mod laws;
mod numbers;
mod parameter;
mod place;
mod prelude;
mod robot_file;
mod scene;
#[cfg(test)]
mod tests;
mod told;

pub use stiffarm_table::robot::beyond::Quantity;

pub use at_place::{at_place, cannot_act};
pub use at_rest::{AtRest, Gives};
pub use carrier::Carrier;
pub use catalogue::*;
pub use curve::{Curve, Over};
pub use draw::Draw;
pub use facts::{At, Facts, Law, Moves};
pub use in_motion::{Carried, InMotion};
pub use kind::{Depends, Forms, Group, MOST_ORDERS};
pub use known::{Known, KnownError};
pub(crate) use known::{advice, file_name, si, table};
pub use laws::{Entry, Laws};
pub use parameter::Parameter;
pub use place::{Place, Spot};
pub(crate) use robot_file::significant;
pub use robot_file::{RobotFile, Row as RobotRow};
pub use scene::Scene;
pub use told::Told;

pub use crate::report::Parameter as ParameterReport;

pub use at_rest::AtRest as Effect;
pub use catalogue::AT_REST as CATALOGUE;

/// The laws that a campaign is asked for.
pub type Catalogue = Laws<dyn AtRest>;
