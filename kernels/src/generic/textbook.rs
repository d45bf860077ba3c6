//! How the definitions are listed beside the outputs that they define.

use std::vec::Vec;

use nalgebra::{Dim, Matrix, RawStorage, Vector6};

use super::arm::Arm;
use crate::Unstable;

/// An output at a state under a wrench: its numbers column by column.
pub(super) type Textbook = fn(&Arm, &[f64], &Vector6<f64>) -> Result<Vec<f64>, Unstable>;

/// The numbers of a matrix, column by column.
pub(super) fn block<R: Dim, C: Dim, S: RawStorage<f64, R, C>>(
    matrix: Matrix<f64, R, C, S>,
) -> Vec<f64> {
    matrix.iter().copied().collect()
}
