//! Any output by its name, laid out as generated kernels lay it out.

use std::vec::Vec;

use nalgebra::Vector6;

use super::arm::Arm;
use super::{deflection, jacobian, kinematics, parameters, stiffness, weight};
use crate::{Output, Unstable};

/// How an output is evaluated: its numbers column by column.
pub(super) type Textbook = fn(&Arm, &[f64], &Vector6<f64>) -> Result<Vec<f64>, Unstable>;

/// By output, from the tables beside the definitions; an output without one does not compile.
const TEXTBOOK: [Textbook; Output::EACH.len()] = Output::one_each(&[
    deflection::TEXTBOOK,
    jacobian::TEXTBOOK,
    kinematics::TEXTBOOK,
    parameters::TEXTBOOK,
    stiffness::TEXTBOOK,
    weight::TEXTBOOK,
]);

/// The numbers of a matrix, column by column.
pub(super) fn block<R, C, S>(matrix: nalgebra::Matrix<f64, R, C, S>) -> Vec<f64>
where
    R: nalgebra::Dim,
    C: nalgebra::Dim,
    S: nalgebra::RawStorage<f64, R, C>,
{
    matrix.iter().copied().collect()
}

impl Arm {
    /// `output` at the joint values `q` (rad, m) under the wrench `w` (N, N·m; base axes, at the tool
    /// origin) as one column-major block of [`Output::shape`].
    ///
    /// # Errors
    /// [`Unstable`] as from [`Arm::deflection`] and [`Arm::deflection_with_gravity`].
    pub fn evaluate(&self, output: Output, q: &[f64], w: &[f64; 6]) -> Result<Vec<f64>, Unstable> {
        TEXTBOOK[output as usize](self, q, &Vector6::from_column_slice(w))
    }
}
