//! The joint twists in proportion to its torque (Dumas et al. 2011, eqs. 4 and 20-21).

use nalgebra::Matrix6xX;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Effect, Parameter, Place};
use crate::measurement::Row;
use crate::simulate::State;

/// Compliance of a joint, added to what the arm's model has there.
#[derive(Clone, Copy, Debug)]
pub struct JointCompliance;

fn index(place: Place) -> Option<usize> {
    match place {
        Place::Joint(number) => number.checked_sub(1),
        _ => None,
    }
}

impl Effect for JointCompliance {
    fn identifier(&self) -> &'static str {
        "joint_compliance"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        (1..=arm.dof()).map(Place::Joint).collect()
    }

    /// One: the added compliance. The joint as a whole cannot be less than rigid, so the least is
    /// minus what the model has.
    fn parameters(&self, arm: &Arm, place: Place, reach: f64) -> Vec<Parameter> {
        let Some(joint) = index(place).and_then(|j| arm.joints.get(j)) else { return Vec::new() };
        // 0.0 − c, and not −c, for a rigid joint's 0 to be positive.
        let (name, least) = ("compliance", 0.0 - joint.compliance);
        vec![match joint.motion {
            Motion::Revolute => Parameter { name, unit: "rad/(N·m)", least, scale: 1.0 },
            Motion::Prismatic => Parameter { name, unit: "m/N", least, scale: reach * reach },
        }]
    }

    fn apply(&self, arm: &mut Arm, _: &mut Row, place: Place, values: &[f64]) {
        if let Some(joint) = index(place).and_then(|j| arm.joints.get_mut(j)) {
            joint.compliance = (joint.compliance + values[0]).max(0.0);
        }
    }

    /// `J_i τ_i` with the torque of wrench and weights, the other springs yielding to the change.
    fn block(&self, _: &Arm, _: &Row, state: &State, place: Place) -> Matrix6xX<f64> {
        let mut block = Matrix6xX::zeros(1);
        if let Some(j) = index(place) {
            block.set_column(0, &(state.twist_of_joint(j) * state.torque[j]));
        }
        block
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{bent, row, springy};
    use crate::measurement::Kind;
    use crate::simulate::simulate;
    use nalgebra::Vector6;

    /// Largest error of the block against small differences of the exact model, relative to the
    /// largest entry.
    fn error_against_differences(arm: &Arm, kind: Kind) -> f64 {
        let w = Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0);
        let mut r = row(&[0.3, -0.7, 0.4], w);
        r.offset = Some([0.05, 0.1, 0.2]);
        let sim = simulate(arm, &r, kind).unwrap();
        let mut worst: f64 = 0.0;
        for place in JointCompliance.places(arm) {
            let block = sim.change(|s| JointCompliance.block(arm, &r, s, place));
            let step = 1e-9;
            let at = |value| {
                let (mut arm, mut r) = (arm.clone(), r.clone());
                JointCompliance.apply(&mut arm, &mut r, place, &[value]);
                simulate(&arm, &r, kind).unwrap().reading()
            };
            let (low, high) = (at(0.0), at(step));
            let turn = (high.rotation * low.rotation.inverse()).scaled_axis();
            let shift = high.position - low.position;
            let difference = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z) / step;
            worst = worst.max((block.column(0) - difference).amax() / difference.amax());
        }
        worst
    }

    #[test]
    fn the_block_is_the_derivative_of_the_exact_model() {
        let pose = Kind::Pose { orientation: true };
        let displacement = Kind::Displacement { components: [true; 6] };
        assert!(error_against_differences(&springy(), pose) < 1e-4);
        assert!(error_against_differences(&springy(), displacement) < 1e-4);
        // Links bend in the posture that the joints take: of second order, and left out of the
        // block.
        assert!(error_against_differences(&bent(), pose) < 2e-2);
    }

    #[test]
    fn a_joint_is_at_most_rigid() {
        let arm = springy();
        let parameter = JointCompliance.parameters(&arm, Place::Joint(2), 1.0)[0];
        assert_eq!(parameter.least, -arm.joints[1].compliance);
        let mut rigid = arm.clone();
        let mut r = row(&[0.0; 3], Vector6::zeros());
        JointCompliance.apply(&mut rigid, &mut r, Place::Joint(2), &[-1.0]);
        assert_eq!(rigid.joints[1].compliance, 0.0);
    }
}
