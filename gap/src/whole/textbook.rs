//! A corrected arm as its kernels tell it: the textbook on the table as it is in a situation, and what gives
//! beyond the table, by the effects' own laws.

use nalgebra::{DMatrix, Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Output, Unstable};

use super::{Situation, Whole};
use crate::displacement::Displacement;
use crate::effects::Known;
use crate::simulate::{Actual, Site, by_laws, rotation, translation};

/// Part of a load, and a load, N and N·m, so small that what goes with its cube is none beside what is in
/// proportion: by its square.
const SMALL: f64 = 1e-6;

impl Whole<'_> {
    /// `output` at the readings `q` (n, rad; m if prismatic), as the arm's kernels have it: one column-major
    /// block in the world's axes, told of the joint values that the readings mean.
    ///
    /// The table's springs are on the loaded geometry as the textbook has them. What gives beyond the table does
    /// so to first order in its displacement, as beams do: under the loads of the undeformed arm. A force of
    /// `at` that hangs is not told from another here.
    ///
    /// `None` of what is the derivative of such an output by the joints: [`Whole::slopes`] tells it.
    ///
    /// # Errors
    /// [`Unstable`] as from [`Arm::evaluate`].
    pub fn evaluate(
        &self,
        output: Output,
        state: &[f64],
        at: &Situation,
    ) -> Result<Option<Vec<f64>>, Unstable> {
        let (q, beside) = state.split_at(self.arm.dof());
        match output {
            // What has nothing beyond the table is the table, and its copy would be most of the work.
            output if self.known.is_empty() => {
                let w = turned(&self.arm.base, &at.load);
                self.arm.evaluate(output, state, &w.into()).map(Some)
            }
            Output::ComplianceByJoints | Output::DeflectionByJoints => Ok(None),
            output => told(self.actual(q, at), beside, output).map(Some),
        }
    }
}

impl<'a> Whole<'a> {
    /// The first effect of which [`Whole::evaluate`] tells not everything at the readings `q`: it bends the
    /// arm between joints whatever the load, turns a joint by a torque that no load makes, or is the
    /// instrument's or another simulator's.
    pub fn untold(&self, q: &[f64], at: &Situation) -> Option<&'a Known> {
        self.known.iter().find(|one| {
            let alone = Whole { arm: self.arm, known: core::slice::from_ref(*one) };
            let actual = alone.actual(q, at);
            let tool = Site::Tool.index(self.arm.dof());
            let mut sites = actual.fixed.iter().enumerate();
            sites.any(|(site, by)| site != tool && *by != Vector6::zeros())
                || !actual.preload.is_empty()
                || (actual.metre, actual.loaded_geometry) != (1.0, 0.0)
        })
    }
}

/// An output of the arm as it is.
fn told(mut actual: Actual<'_>, beside: &[f64], output: Output) -> Result<Vec<f64>, Unstable> {
    let fixed = Displacement::new(&actual.fixed[Site::Tool.index(actual.arm.dof())]);
    let tool = actual.arm.tool * fixed.transform();
    let tool_rotation_vector = match fixed == Displacement::ZERO {
        true => actual.arm.tool_rotation_vector,
        false => tool.rotation.scaled_axis(),
    };
    let base = actual.base;
    let arm = Arm { base, tool, tool_rotation_vector, ..actual.arm.clone().into_owned() };
    let loaded = Arm {
        tool: tool
            * Isometry3::from_parts(
                Translation3::from(actual.load_point),
                UnitQuaternion::identity(),
            ),
        ..arm.clone()
    };
    let joints = &actual.joints.clone();
    let w = turned(&base, &actual.wrench).into();
    // The twist of the point where the force acts is the tool's but for the lever between the two.
    let lever = -(arm.pose(joints).rotation * actual.load_point);
    let to_tool = |block: Vec<f64>| -> Vec<f64> {
        let columns = block.chunks(6).map(Vector6::from_column_slice);
        columns.flat_map(|c| moved(&c, &lever).as_slice().to_vec()).collect()
    };
    let plus = |block: Vec<f64>, twist: Vector6<f64>| -> Vec<f64> {
        block.iter().zip(turned(&base, &twist).iter()).map(|(a, b)| a + b).collect()
    };
    Ok(match output {
        Output::JointTorque | Output::ComplementaryStiffness => {
            loaded.evaluate(output, joints, &w)?
        }
        Output::ComplianceRegressor => to_tool(loaded.evaluate(output, joints, &w)?),
        Output::DeflectionFirstOrder | Output::Deflection => {
            let block = to_tool(loaded.evaluate(output, joints, &w)?);
            actual.arm.to_mut().gravity = Vector3::zeros();
            let part = if output == Output::Deflection { 1.0 } else { SMALL };
            actual.wrench *= part;
            plus(block, by_laws(&actual) / part)
        }
        Output::DeflectionWithGravity => {
            plus(to_tool(loaded.evaluate(output, joints, &w)?), by_laws(&actual))
        }
        Output::Compliance => {
            let block = arm.evaluate(output, joints, &w)?;
            let each = block.chunks(6).enumerate();
            actual.arm.to_mut().gravity = Vector3::zeros();
            actual.load_point = Vector3::zeros();
            let mut under = |unit: Vector6<f64>| {
                actual.wrench = turned(&base.inverse(), &unit) * SMALL;
                by_laws(&actual) / SMALL
            };
            // What does not go with the load's sign is no compliance.
            let mut column = |k| (under(Vector6::ith(k, 1.0)) - under(Vector6::ith(k, -1.0))) / 2.0;
            each.flat_map(|(k, block)| plus(block.to_vec(), column(k))).collect()
        }
        _ => arm.evaluate(output, &[joints, beside].concat(), &w)?,
    })
}

/// Step of differences, rad and m: its square and the rounding of its reciprocal are of a size.
const STEP: f64 = 1e-5;

impl Whole<'_> {
    /// What an output must be by central differences of another by the joint values; `None` where none says
    /// it. The differences are by the readings: how joint values go with these is taken out of them.
    pub fn slopes(&self, output: Output, state: &[f64], at: &Situation) -> Option<Vec<f64>> {
        let of = match output {
            Output::Jacobian => Output::Pose,
            Output::ComplementaryStiffness => Output::JointTorque,
            Output::WeightStiffness => Output::WeightTorque,
            Output::ComplianceByJoints => Output::Compliance,
            Output::DeflectionByJoints => Output::Deflection,
            _ => return None,
        };
        let n = self.arm.dof();
        let (mut changes, mut moved) = (Vec::new(), Vec::new());
        for j in 0..n {
            let end = |by: f64| {
                let mut q = state[..n].to_vec();
                q[j] += by;
                let actual = self.actual(&q, at);
                let joints = actual.joints.clone();
                Some((told(actual, &[], of).ok()?, joints))
            };
            let ((low, before), (high, after)) = (end(-STEP)?, end(STEP)?);
            match output {
                Output::Jacobian => changes.extend(twist(&low, &high)),
                _ => changes.extend(low.iter().zip(&high).map(|(low, high)| high - low)),
            }
            moved.extend(before.iter().zip(&after).map(|(before, after)| after - before));
        }
        let changes = DMatrix::from_vec(changes.len() / n, n, changes);
        let by_joints = changes * DMatrix::from_vec(n, n, moved).try_inverse()?;
        Some(by_joints.as_slice().to_vec())
    }
}

/// From one pose to another, as a twist: axes x, y, z, then the origin.
fn twist(low: &[f64], high: &[f64]) -> Vec<f64> {
    let turn = |pose: &[f64]| UnitQuaternion::from_matrix(&Matrix3::from_column_slice(&pose[..9]));
    let turned = (turn(high) * turn(low).inverse()).scaled_axis();
    let moved = (9..12).map(|k| high[k] - low[k]);
    moved.chain(turned.iter().copied()).collect()
}

/// A twist or a wrench in the axes that a frame stands in.
fn turned(frame: &Isometry3<f64>, six: &Vector6<f64>) -> Vector6<f64> {
    let (v, w) = (frame.rotation * translation(six), frame.rotation * rotation(six));
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}

/// A twist at a point that lies by a lever from where it is told.
fn moved(twist: &Vector6<f64>, lever: &Vector3<f64>) -> Vector6<f64> {
    let w = rotation(twist);
    let v = translation(twist) + w.cross(lever);
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}
