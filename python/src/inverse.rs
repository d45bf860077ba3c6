//! The inverse kinematics of an arm that Python holds, pose after pose.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use stiffarm_codegen::derive::{AnyArm, AnyBranch, Given, any_arm};
use stiffarm_codegen::robot::{ClosedForm, Family, Refused, Robot};
use stiffarm_kernels::Pose;

use crate::arrays::{lead, numbers, shape};

/// The arm's closed form, or that of the nearest table with the steps behind it.
pub struct Inverse {
    arm: Box<dyn AnyArm>,
    form: ClosedForm,
    dof: usize,
}

/// Every branch of every pose: `q`, `distance`, `angle`, `within_limits`, and what the bits of a branch's number choose.
pub type Found<'py> = (
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyAny>,
    Vec<&'static str>,
);

impl Inverse {
    /// Of a robot as kernels are made of it, with this given of seven joints where it is chosen.
    pub fn new(robot: &Robot, given: Option<&str>) -> Result<Inverse, String> {
        let mut robot = robot.clone();
        let refused = |Refused { message, help }| format!("{message}: {help}");
        given.map_or(Ok(()), |given| robot.give(given)).map_err(refused)?;
        let form = robot.nearest_closed_form().map_err(refused)?;
        Ok(Inverse { arm: any_arm(&robot, form), form, dof: robot.dof() })
    }

    /// Every branch at poses, homogeneous matrices; readings `near`, one for all or one for each; the loaded arm where there is a
    /// wrench.
    pub fn found<'py>(
        &self,
        py: Python<'py>,
        pose: &Bound<'py, PyAny>,
        near: Option<&Bound<'py, PyAny>>,
        (wrench, given): (Option<[f64; 6]>, &Given),
    ) -> PyResult<Found<'py>> {
        let (poses, _) = numbers("pose", pose)?;
        let batch = match poses.shape() {
            [batch @ .., 4, 4] => batch.to_vec(),
            found => {
                let found = shape(found);
                return Err(PyValueError::new_err(format!(
                    "pose: found the shape {found}, expected (4, 4) or (batch, 4, 4)"
                )));
            }
        };
        let count: usize = batch.iter().product();
        let near = match near {
            Some(near) => {
                let (near, _) = numbers("near", near)?;
                let leads = lead("near", &near, self.dof)?;
                if !leads.is_empty() && leads != batch {
                    let (found, expected) = (shape(&leads), shape(&batch));
                    return Err(PyValueError::new_err(format!(
                        "near: found a batch of {found}, expected {expected} as the poses have, or none"
                    )));
                }
                near.try_readonly()?.as_slice()?.to_vec()
            }
            None => {
                let elbow = self.form.family == Family::ElbowAngle && given.elbow_angle.is_none();
                let kept = self.form.given.map(|joint| format!("joint {}", joint + 1));
                if let Some(kept) = kept.or_else(|| elbow.then(|| "the elbow angle".to_owned())) {
                    return Err(PyValueError::new_err(format!(
                        "near: found none, and the pose leaves one of {} joints free: every branch has {kept} as near has it",
                        self.dof
                    )));
                }
                vec![0.0; self.dof]
            }
        };
        let matrices = poses.try_readonly()?.as_slice()?.to_vec();
        for (name, values) in [("pose", &matrices), ("near", &near)] {
            if values.iter().any(|value| !value.is_finite()) {
                let text = format!("{name}: found a value that is not finite, expected numbers");
                return Err(PyValueError::new_err(text));
            }
        }
        let solve = |k: usize| -> Vec<AnyBranch> {
            let at = &matrices[16 * k..][..16];
            let column = |column: usize| core::array::from_fn(|row| at[4 * row + column]);
            let rotation = [column(0), column(1), column(2)];
            let pose = Pose { rotation, position: column(3) };
            let first = if near.len() > self.dof { k * self.dof } else { 0 };
            self.arm.branches(given, &pose, &near[first..][..self.dof], wrench.as_ref())
        };
        let all: Vec<AnyBranch> =
            py.detach(|| (0..count).into_par_iter().flat_map_iter(solve).collect());
        let branches = self.form.branches();
        let each = [&batch[..], &[branches]].concat();
        let q: Vec<f64> = all.iter().flat_map(|branch| branch.q.iter().copied()).collect();
        let array =
            |values: Vec<f64>, shape: Vec<usize>| PyArray1::from_vec(py, values).reshape(shape);
        let within = PyArray1::from_vec(py, all.iter().map(|branch| branch.within).collect());
        Ok((
            array(q, [&each[..], &[self.dof]].concat())?,
            array(all.iter().map(|branch| branch.distance).collect(), each.clone())?,
            array(all.iter().map(|branch| branch.tilt).collect(), each.clone())?,
            within.reshape(each)?.into_any(),
            self.form.bits(),
        ))
    }
}
