//! Compensation of force errors: joint corrections with which a flexible arm puts the wanted wrench
//! on its environment (Bicchi & Melchiorri, sections 3-5).
//!
//! A wrist sensor gives the wrench in the displaced tool. In the base frame it is `w = K_E ᴱw`
//! ([`Loaded`]), which depends on the posture and on all deformations; wanted is `w_d`.
//! [`compensate`] moves the joints by the paper's [`law`] until `V = eᵀ P e/2`, `e = w_d − w`, is
//! small enough.
//!
//! * Wrenches are in base axes about the base's origin, N and N·m, and act *on* the robot.
//! * Only as many components of e can be brought to zero as the joints move independently, and the
//!   size of a force that turns with the tool never changes: what remains is reported.

pub mod case;
pub mod law;
mod recursion;

use nalgebra::{DVector, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_study::dexterity::DexterityError;

pub use recursion::Loaded;

/// Why no compensation could be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForceError {
    /// Joint values that do not fit the arm.
    #[error(transparent)]
    Posture(#[from] DexterityError),
    /// Another kind of table.
    #[error("the recursion is that of a standard table of revolute joints")]
    Table,
    /// A number that is infinite or not a number.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which number.
        what: &'static str,
    },
}

/// What is wanted of the arm.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The arm: its springs and beams give way.
    pub arm: &'a Arm,
    /// ᴱw: what acts on the tool, in its displaced axes, N and N·m.
    pub load: Vector6<f64>,
    /// w_d: what is wanted in the base, base axes, about its origin, N and N·m.
    pub target: Vector6<f64>,
    /// The diagonal of P.
    pub weights: Vector6<f64>,
}

impl Task<'_> {
    /// e = w_d − w at the joint values `q` (eq. 8), base axes, N and N·m.
    ///
    /// # Errors
    /// Those of [`Loaded::new`].
    pub fn error(&self, q: &[f64]) -> Result<Vector6<f64>, ForceError> {
        Ok(self.target - Loaded::new(self.arm, q, &self.load)?.base_wrench())
    }
}

/// What the search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Joint values, rad: the set-points to command.
    pub q: Vec<f64>,
    /// e = w_d − w there, base axes, N and N·m: what remains.
    pub error: Vector6<f64>,
    /// V there.
    pub value: f64,
    /// Steps taken.
    pub steps: usize,
}

/// Moves the joints from `start` by eqs. 14 and 15 until V is at most `value`, in at most `steps`
/// steps; `limit` is what S limits the elements of `Gᵀ P e` to. The search ends where there is no
/// descent. Near singular postures it converges slowly, and its number of steps there depends on
/// details.
///
/// # Errors
/// Those of [`Loaded::new`]: a step may lead to joint values that are not finite.
pub fn compensate(
    task: &Task<'_>,
    start: &[f64],
    limit: Option<f64>,
    value: f64,
    steps: usize,
) -> Result<Outcome, ForceError> {
    if !task.target.iter().all(|component| component.is_finite()) {
        return Err(ForceError::NotFinite { what: "a component of the wanted wrench" });
    }
    let (mut q, mut taken) = (DVector::from_column_slice(start), 0);
    loop {
        let loaded = Loaded::new(task.arm, q.as_slice(), &task.load)?;
        let error = task.target - loaded.base_wrench();
        let reached = law::value(&task.weights, &error);
        let step = law::step(&loaded.gradient(), &task.weights, &error, limit);
        let Some(step) = step.filter(|_| reached > value && taken < steps) else {
            return Ok(Outcome { q: q.as_slice().to_vec(), error, value: reached, steps: taken });
        };
        q += step;
        taken += 1;
    }
}
