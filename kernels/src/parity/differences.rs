//! Central differences of the textbook.

use std::vec::Vec;

use crate::Output;
use crate::generic::Arm;
use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};

/// Step, rad and m: its square and the rounding of its reciprocal are of a size.
const STEP: f64 = 1e-5;

/// What an output must be by the differences of another; `None` where none says it. `arm` is
/// changed and changed back.
pub fn of(arm: &mut Arm, output: Output, q: &[f64], w: &[f64; 6]) -> Option<Vec<f64>> {
    let wrench = Vector6::from_column_slice(w);
    Some(match output {
        Output::Jacobian => twists(arm, q).concat(),
        Output::JacobianTool => {
            let turn = arm.pose(q).rotation.inverse();
            let in_tool_axes = |t: &[f64; 6]| {
                let (v, r) =
                    (turn * Vector3::new(t[0], t[1], t[2]), turn * Vector3::new(t[3], t[4], t[5]));
                [v.x, v.y, v.z, r.x, r.y, r.z]
            };
            twists(arm, q).iter().flat_map(in_tool_axes).collect()
        }
        Output::JacobianSpatial => {
            let p = arm.pose(q).translation.vector;
            let at_origin = |t: [f64; 6]| {
                let v = p.cross(&Vector3::new(t[3], t[4], t[5]));
                [t[0] + v.x, t[1] + v.y, t[2] + v.z, t[3], t[4], t[5]]
            };
            twists(arm, q).into_iter().flat_map(at_origin).collect()
        }
        Output::JointTorque => {
            let work = |t: &[f64; 6]| t.iter().zip(w).map(|(t, w)| t * w).sum();
            twists(arm, q).iter().map(work).collect()
        }
        Output::ComplementaryStiffness => {
            slopes(q, |q| arm.joint_torque(q, &wrench).as_slice().to_vec())
        }
        Output::WeightStiffness => slopes(q, |q| arm.weight_torque(q).as_slice().to_vec()),
        // Linear in the load, and in each spring: the step does not matter.
        Output::Compliance => {
            let column = |k| arm.deflection_first_order(q, &Vector6::ith(k, 1.0));
            (0..6).flat_map(|k| column(k).as_slice().to_vec()).collect()
        }
        Output::ComplianceRegressor => regressor(arm, q, &wrench),
        Output::ParameterJacobian => parameters(arm, q),
        Output::Hessian => slopes(q, |q| arm.jacobian(q).as_slice().to_vec()),
        Output::JacobianRate => {
            let (q, rates) = q.split_at(arm.dof());
            let moved = |by: f64| q.iter().zip(rates).map(|(q, rate)| q + by * rate).collect();
            let [low, high] = [-STEP, STEP].map(|by| arm.jacobian(&moved(by) as &Vec<f64>));
            ((high - low) / (2.0 * STEP)).as_slice().to_vec()
        }
        Output::ComplianceByJoints => slopes(q, |q| arm.compliance(q).as_slice().to_vec()),
        Output::DeflectionByJoints => {
            // Beside a load that is borne one that is not: there is nothing to compare with.
            let borne = |q: &[f64]| arm.deflection(q, &wrench).map(|d| d.as_slice().to_vec());
            let all = slopes(q, |q| borne(q).unwrap_or_else(|_| vec![f64::NAN; 6]));
            return all.iter().all(|x| x.is_finite()).then_some(all);
        }
        Output::InverseDynamicsByJoints => {
            let (q, motion) = q.split_at(arm.dof());
            let (rates, accelerations) = motion.split_at(arm.dof());
            slopes(q, |q| arm.inverse_dynamics(q, rates, accelerations).as_slice().to_vec())
        }
        Output::InverseDynamicsByRates => {
            let (q, rates) = q.split_at(arm.dof());
            let mut smooth = arm.clone();
            smooth.joints.iter_mut().for_each(|joint| joint.drive.coulomb = 0.0);
            slopes(rates, |rates| smooth.bias(q, rates).as_slice().to_vec())
        }
        Output::ManipulabilityByJoints => {
            // Within a step of a singular posture, where the measure turns back: there is nothing to compare with.
            let (here, of) = (arm.manipulability(q), |q: &[f64]| arm.manipulability(q));
            let change = |joint, by| (of(&moved(q, joint, by)) - here).abs();
            if (0..q.len()).any(|j| change(j, -STEP).max(change(j, STEP)) > here) {
                return None;
            }
            slopes(q, |q| Vec::from([of(q)]))
        }
        _ => return None,
    })
}

/// Twist of the tool from one pose to the other, over the step between them.
fn twist(from: &Isometry3<f64>, to: &Isometry3<f64>) -> [f64; 6] {
    let moved = (to.translation.vector - from.translation.vector) / (2.0 * STEP);
    let turned = (to.rotation * from.rotation.inverse()).scaled_axis() / (2.0 * STEP);
    [moved.x, moved.y, moved.z, turned.x, turned.y, turned.z]
}

fn twists(arm: &Arm, q: &[f64]) -> Vec<[f64; 6]> {
    let pose = |joint: usize, by: f64| arm.pose(&moved(q, joint, by));
    (0..q.len()).map(|j| twist(&pose(j, -STEP), &pose(j, STEP))).collect()
}

fn moved(q: &[f64], joint: usize, by: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    q[joint] += by;
    q
}

/// Columns of the derivative by each joint value.
fn slopes(q: &[f64], of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let column = |joint| {
        let (low, high) = (of(&moved(q, joint, -STEP)), of(&moved(q, joint, STEP)));
        low.into_iter().zip(high).map(|(low, high)| (high - low) / (2.0 * STEP))
    };
    (0..q.len()).flat_map(column).collect()
}

fn regressor(arm: &mut Arm, q: &[f64], w: &Vector6<f64>) -> Vec<f64> {
    let mut columns = Vec::with_capacity(6 * q.len());
    for j in 0..q.len() {
        let own = arm.joints[j].compliance;
        let mut with = |compliance| {
            arm.joints[j].compliance = compliance;
            arm.deflection_first_order(q, w)
        };
        columns.extend_from_slice((with(1.0) - with(0.0)).as_slice());
        arm.joints[j].compliance = own;
    }
    columns
}

fn parameters(arm: &mut Arm, q: &[f64]) -> Vec<f64> {
    let mut columns = Vec::with_capacity(6 * (4 * q.len() + 6));
    for j in 0..q.len() {
        for cell in [theta, d, a, alpha] {
            let own = *cell(arm, j);
            let mut at = |value| {
                *cell(arm, j) = value;
                arm.pose(q)
            };
            columns.extend_from_slice(&twist(&at(own - STEP), &at(own + STEP)));
            *cell(arm, j) = own;
        }
    }
    let (tool, turn) = (arm.tool, arm.tool_rotation_vector);
    let mut at = |shift: Vector3<f64>, spin: Vector3<f64>| {
        arm.tool.translation.vector = tool.translation.vector + shift;
        arm.tool.rotation = UnitQuaternion::from_scaled_axis(turn + spin);
        arm.pose(q)
    };
    let none = Vector3::zeros();
    for k in 0..6 {
        let by = Vector3::ith(k % 3, STEP);
        let [low, high] =
            if k < 3 { [at(-by, none), at(by, none)] } else { [at(none, -by), at(none, by)] };
        columns.extend_from_slice(&twist(&low, &high));
    }
    arm.tool = tool;
    columns
}

fn theta(arm: &mut Arm, j: usize) -> &mut f64 {
    &mut arm.joints[j].theta
}

fn d(arm: &mut Arm, j: usize) -> &mut f64 {
    &mut arm.joints[j].d
}

fn a(arm: &mut Arm, j: usize) -> &mut f64 {
    &mut arm.joints[j].a
}

fn alpha(arm: &mut Arm, j: usize) -> &mut f64 {
    &mut arm.joints[j].alpha
}
