//! A quantity over two joints, the others held: data, not a picture.

use nalgebra::DMatrix;
use stiffarm_kernels::generic::Arm;

use super::{DexterityError, check_posture};
use crate::parallel;

/// Most cells of a map.
const MOST_CELLS: f64 = 1e7;

/// Two joints that move over a grid, the others standing still.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// All joint values; those of the two moving joints are not read.
    pub posture: Vec<f64>,
    /// The two moving joints, from 0.
    pub joints: [usize; 2],
    /// Values of the first, ascending.
    pub first: Vec<f64>,
    /// Values of the second, ascending.
    pub second: Vec<f64>,
}

/// Where a map is highest or lowest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// There.
    pub value: f64,
    /// Value of the first joint.
    pub first: f64,
    /// Value of the second joint.
    pub second: f64,
}

/// Values over a [`Plane`].
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Where.
    pub plane: Plane,
    /// Row i, column j: at `plane.first[i]`, `plane.second[j]`.
    pub values: DMatrix<f64>,
}

impl Plane {
    /// The two `joints` (from 0) from lower to upper limit in steps of `step`, the last step left
    /// out where it would pass the limit.
    ///
    /// # Errors
    /// [`DexterityError::Posture`]; [`DexterityError::Unlimited`] if a joint has no limits;
    /// [`DexterityError::Setting`] if a joint does not exist or the step gives no sensible grid.
    pub fn over_limits(
        arm: &Arm,
        posture: &[f64],
        joints: [usize; 2],
        step: f64,
    ) -> Result<Plane, DexterityError> {
        check_posture(arm, posture)?;
        let values = |joint: usize| -> Result<Vec<f64>, DexterityError> {
            let Some(row) = arm.joints.get(joint) else {
                let (what, expected) = ("a joint of the map, from 0", "one of the arm's");
                return Err(DexterityError::Setting { what, found: joint as f64, expected });
            };
            let [low, high] = row.limits.ok_or(DexterityError::Unlimited { joint: joint + 1 })?;
            // A limit that is a whole number of steps away is on the grid in spite of rounding.
            let count = ((high - low) / step + 1e-9).floor();
            if !(step > 0.0 && (0.0..MOST_CELLS).contains(&count)) {
                let (what, expected) = ("the step of the map", "a part of the joint's range");
                return Err(DexterityError::Setting { what, found: step, expected });
            }
            Ok((0..=count as usize).map(|k| low + k as f64 * step).collect())
        };
        let (first, second) = (values(joints[0])?, values(joints[1])?);
        if joints[0] == joints[1] || first.len() as f64 * second.len() as f64 > MOST_CELLS {
            let (what, expected) = ("the second joint of the map", "another one, and fewer cells");
            return Err(DexterityError::Setting { what, found: joints[1] as f64, expected });
        }
        Ok(Plane { posture: posture.to_vec(), joints, first, second })
    }

    /// All joint values of the cell (i, j).
    ///
    /// # Panics
    /// If there is no such cell, or the plane was put together by hand with a joint that its
    /// posture does not have.
    pub fn at(&self, i: usize, j: usize) -> Vec<f64> {
        let mut q = self.posture.clone();
        q[self.joints[0]] = self.first[i];
        q[self.joints[1]] = self.second[j];
        q
    }

    /// The map of `value`, which is given all joint values, on all cores.
    ///
    /// # Errors
    /// That of the first cell that has one.
    pub fn map<E: Send>(&self, value: impl Fn(&[f64]) -> Result<f64, E> + Sync) -> Result<Map, E> {
        let (rows, columns) = (self.first.len(), self.second.len());
        let of_cell = |k: usize| value(&self.at(k % rows, k / rows));
        let values: Vec<Result<f64, E>> = parallel::map(rows * columns, &of_cell);
        let values = values.into_iter().collect::<Result<Vec<f64>, E>>()?;
        Ok(Map { plane: self.clone(), values: DMatrix::from_vec(rows, columns, values) })
    }
}

impl Map {
    /// The highest cell; none of an empty map.
    pub fn max(&self) -> Option<Peak> {
        self.cells().max_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// The lowest cell; none of an empty map.
    pub fn min(&self) -> Option<Peak> {
        self.cells().min_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// All cells, the first joint running fastest.
    pub fn cells(&self) -> impl Iterator<Item = Peak> + '_ {
        let (rows, columns) = self.values.shape();
        (0..columns).flat_map(move |j| {
            (0..rows).map(move |i| Peak {
                value: self.values[(i, j)],
                first: self.plane.first[i],
                second: self.plane.second[j],
            })
        })
    }
}
