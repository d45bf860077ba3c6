//! The simulator: the arm at static equilibrium under its links' weight and a row's wrench, on the
//! deformed geometry.
//!
//! [`Site`]s are the places of the chain at which something can give; [`Actual`] is the arm as it
//! is in one row; [`rest`] brings it to rest, and a [`State`] is how it stands then. What the
//! instrument reads of it is a [`Reading`].

mod actual;
mod beam;
mod moment;
mod rest;
mod sim;
mod site;
mod state;
mod stream;
mod tangent;
#[cfg(test)]
mod tests;
mod walk;

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use crate::measurement::{Kind, Row};

pub use actual::{Actual, Law, axis};
pub use beam::chord;
pub use moment::{Moment, Moments, moments};
pub use rest::{beyond_first_order, by_laws, rest};
pub use sim::{Reading, Sim};
pub use site::Site;
pub use state::State;
pub use stream::{Stream, is_stream};

/// The arm at rest at the readings `q` (n, rad; m if prismatic) under `wrench` (base axes, tool
/// origin, N and N·m) and its weights.
///
/// # Errors
/// [`Unstable`] if no stable equilibrium is found near `q`.
///
/// # Panics
/// If `q` has not as many values as the arm has joints.
pub fn equilibrium(arm: &Arm, q: &[f64], wrench: &Vector6<f64>) -> Result<State, Unstable> {
    assert_eq!(q.len(), arm.dof(), "as many joint values as the arm has joints");
    rest(&Actual::new(arm, q, wrench), None)
}

/// Simulates one row with the arm as its table has it. An unknown marker offset counts as zero, and an
/// unknown place of the bench as the origin of the measuring frame.
///
/// # Errors
/// [`Unstable`] if the arm has no stable equilibrium under the row's load.
pub fn simulate(arm: &Arm, row: &Row, kind: Kind) -> Result<Sim, Unstable> {
    let [x, y, z] = row.offset.unwrap_or_default();
    let sim = Sim::of(kind, Isometry3::translation(x, y, z), None, |loaded| {
        Actual::new(arm, &row.q, &if loaded { row.wrench } else { Vector6::zeros() })
    });
    Ok(sim?.seen_by(row.view(kind)))
}

/// The first three components of a twist, or of a displacement.
pub fn translation(twist: &Vector6<f64>) -> Vector3<f64> {
    twist.fixed_rows::<3>(0).into_owned()
}

/// The last three.
pub fn rotation(twist: &Vector6<f64>) -> Vector3<f64> {
    twist.fixed_rows::<3>(3).into_owned()
}
