//! The joint twists in proportion to its torque.
//!
//! Dumas et al. 2011, eqs. 4 and 20-21.

use stiffarm_kernels::generic::{Arm, Joint};

use crate::effects::{
    About, Carrier, Curve, Effect, Group, Over, Parameter, ParameterReport, Place, Quantity, Scene,
    Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// Compliance of a joint, added to what the arm's model has there.
#[derive(Clone, Copy, Debug)]
pub struct JointCompliance;

impl Effect for JointCompliance {
    fn identifier(&self) -> &'static str {
        "joint_compliance"
    }

    fn about(&self) -> About {
        About {
            reality: "The joint twists in proportion to its torque.",
            signature: "A turn about the joint's axis, in proportion to the moment of loads and \
                        weights about it.",
            confused_with: "`link_compliance` of its link, which moves the tool by almost the same \
                            twist when the load comes from beyond the link's end; \
                            `base_compliance` (joint 1); a wrong weight.",
            separated_by: "Loads in several directions at folded and at stretched poses.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    /// One: the added compliance. The joint as a whole cannot be less than rigid, so the least is
    /// minus what the model has.
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let joint = &arm.joints[spot.row()];
        let quantity =
            Quantity::of(joint.motion, [Quantity::AnglePerMoment, Quantity::LengthPerForce]);
        // 0.0 − c, and not −c, for a rigid joint's 0 to be positive.
        vec![Parameter::at_least("compliance", quantity, 0.0 - joint.compliance)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let joint = &mut actual.arm.to_mut().joints[spot.row()];
        joint.compliance = (joint.compliance + v[0]).max(0.0);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.state.torque[spot.row()]);
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the joint"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Elastic)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let yields = if told.numbers.iter().any(|p| p.unit == "m/N") { "yields" } else { "twists" };
        let compared = told.by_sign("less", "more");
        format!("{} {yields} {} {compared} than modelled", told.place, told.size())
    }

    fn spring<'a>(&self, arm: &'a Arm, place: Place) -> Option<&'a Joint> {
        arm.joints.get(place.row())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let compliance = numbers.first()?.value;
        let value = Box::new(move |torque| compliance * torque);
        Some(Curve { over: Over::Torque, proportional: true, value })
    }
}
