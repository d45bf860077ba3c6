//! What hangs on the tool, by the name that the robot file gives it.

use nalgebra::{Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::Row;
use super::cells::unknown;
use crate::io::Fault;

/// In a `payload` column: nothing hangs on the tool.
pub(crate) const NONE: &str = "none";

/// A body that the tool carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The name that the `payload` column uses.
    pub name: String,
    /// kg.
    pub mass: f64,
    /// Its centre of mass in the tool frame, m.
    pub com: Vector3<f64>,
}

/// All bodies of a robot file, and the arm that carries them.
#[derive(Clone, Debug, PartialEq)]
pub struct Payloads {
    /// At least one.
    pub bodies: Vec<Body>,
    /// Its gravity, and its postures, say which way and where they pull.
    pub arm: Arm,
}

/// What hangs on the tool in one row.
#[derive(Clone, Debug, PartialEq)]
pub struct Hung {
    /// As the row names it.
    pub name: String,
    /// Its part of the row's wrench, base axes, at the tool origin, N and N·m.
    pub weight: Vector6<f64>,
}

impl Payloads {
    /// What a cell names, not yet weighed.
    pub(super) fn named(all: Option<&Payloads>, found: &str) -> Result<Hung, Fault> {
        let bodies = all.map_or(&[][..], |all| &all.bodies);
        if found != NONE && bodies.iter().all(|body| body.name != found) {
            let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            return Err(unknown("payload", found, &names, "name one of them, or `none`,"));
        }
        Ok(Hung { name: found.to_owned(), weight: Vector6::zeros() })
    }

    /// Adds the weight of what hangs on the tool to a row's wrench: at its centre of mass, where the
    /// rigid arm of the robot file holds it at the row's readings.
    pub(super) fn hang(&self, row: &mut Row) {
        let Some(hung) = &mut row.payload else { return };
        let Some(body) = self.bodies.iter().find(|body| body.name == hung.name) else { return };
        let force = body.mass * self.arm.gravity;
        let tool = self.arm.base.rotation.inverse() * self.arm.pose(&row.q).rotation;
        let lever = tool * body.com;
        let moment = lever.cross(&force);
        hung.weight = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        row.wrench += hung.weight;
    }
}
