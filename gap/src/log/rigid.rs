//! What rigid links ask of the joints' drives, in proportion to their moments of mass.
//!
//! Ten numbers a link, as [`Arm::torque_regressor`] has them: mass, first moments, and xx, xy, yy, xz, yz, zz of
//! the tensor of inertia about the origin of the row's frame. Not all of them are seen, whatever the motion:
//! the [`Base`] is a set of columns that the others are sums of.

pub(super) mod report;
pub mod works;

use nalgebra::{DMatrix, Isometry3, Matrix3, Vector3};
use stiffarm_kernels::generic::{Arm, BaseParameter};

/// Entries of a tensor in the order of the numbers.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)];

fn tensor(numbers: &[f64]) -> Matrix3<f64> {
    let mut tensor = Matrix3::zeros();
    for ((row, column), value) in ENTRIES.into_iter().zip(&numbers[4..]) {
        (tensor[(row, column)], tensor[(column, row)]) = (*value, *value);
    }
    tensor
}

/// The numbers of a body in a frame, told in the frame that `frame` is given in.
pub fn moved(frame: &Isometry3<f64>, numbers: &[f64]) -> [f64; 10] {
    let (turn, at) = (frame.rotation.to_rotation_matrix().into_inner(), frame.translation.vector);
    let mass = numbers[0];
    let first = turn * Vector3::new(numbers[1], numbers[2], numbers[3]);
    let about = |a: &Vector3<f64>, b: &Vector3<f64>| {
        Matrix3::identity() * a.dot(b) - 0.5 * (a * b.transpose() + b * a.transpose())
    };
    let second = turn * tensor(numbers) * turn.transpose()
        + 2.0 * about(&at, &first)
        + mass * about(&at, &at);
    let first = first + mass * at;
    let mut told = [mass, first.x, first.y, first.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    told[4..].iter_mut().zip(ENTRIES).for_each(|(to, at)| *to = second[at]);
    told
}

/// The numbers of a body: mass, centre of mass, and inertia about that centre.
pub fn body(mass: f64, com: &Vector3<f64>, inertia: &Matrix3<f64>) -> [f64; 10] {
    let entries = ENTRIES.map(|at| inertia[at]);
    let mut numbers = [0.0; 10];
    numbers[0] = mass;
    numbers[4..].copy_from_slice(&entries);
    moved(&Isometry3::translation(com.x, com.y, com.z), &numbers)
}

/// Columns of the regressor that do not depend on each other, whatever the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// Their indices, rising.
    pub columns: Vec<usize>,
    /// What each column of the regressor, all of them, is of these.
    pub mix: DMatrix<f64>,
    /// The sums of moments whose columns these are.
    pub sums: Vec<BaseParameter>,
}

impl Base {
    /// Of an arm.
    pub fn of(arm: &Arm) -> Base {
        let parameters = arm.base_parameters();
        let mut mix = DMatrix::zeros(parameters.len(), 10 * arm.dof());
        for (k, parameter) in parameters.iter().enumerate() {
            mix[(k, parameter.moment)] = 1.0;
            parameter.others.iter().for_each(|(moment, times)| mix[(k, *moment)] = *times);
        }
        let columns = parameters.iter().map(|parameter| parameter.moment).collect();
        Base { columns, mix, sums: parameters }
    }

    /// Numbers of all links, ten each, that ask the same as these values of the base columns.
    pub fn numbers(&self, values: &[f64]) -> Vec<f64> {
        let mut numbers = vec![0.0; self.mix.ncols()];
        self.columns.iter().zip(values).for_each(|(at, value)| numbers[*at] = *value);
        numbers
    }
}

#[cfg(test)]
mod tests;
