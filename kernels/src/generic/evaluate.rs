//! Any output by its name, laid out as generated kernels lay it out.

use std::vec::Vec;

use nalgebra::Vector6;

use super::arm::Arm;
use super::textbook::Textbook;
use super::{
    by_joints, deflection, dynamics, dynamics_by, jacobian, kinematics, parameters, stiffness,
    weight,
};
use crate::{Output, Unstable};

/// By output, from the tables beside the definitions; an output without one does not compile.
const TEXTBOOK: [Textbook; Output::EACH.len()] = Output::one_each(&[
    by_joints::TEXTBOOK,
    deflection::TEXTBOOK,
    dynamics::TEXTBOOK,
    dynamics_by::TEXTBOOK,
    jacobian::TEXTBOOK,
    kinematics::TEXTBOOK,
    parameters::TEXTBOOK,
    stiffness::TEXTBOOK,
    weight::TEXTBOOK,
]);

impl Arm {
    /// `output` at a state under the wrench `w` (N, N·m; base axes, at the tool origin) as one column-major
    /// block of [`Output::shape`]. The state is the joint values (rad, m), and behind them what more of the
    /// joints the output takes, as [`Output::state`] says.
    ///
    /// # Errors
    /// [`Unstable`] as from [`Arm::deflection`] and [`Arm::deflection_with_gravity`].
    pub fn evaluate(
        &self,
        output: Output,
        state: &[f64],
        w: &[f64; 6],
    ) -> Result<Vec<f64>, Unstable> {
        TEXTBOOK[output as usize](self, state, &Vector6::from_column_slice(w))
    }
}
