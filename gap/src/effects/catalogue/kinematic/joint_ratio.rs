use crate::effects::prelude::*;

/// `(1 + ratio) · q` is true.
#[derive(Clone, Copy, Debug)]
pub struct JointRatio;

const AT_REST: &Facts = &Facts {
    identifier: "joint_ratio",
    reality: "The joint turns more or less than its reading, in proportion: a wrong gear ratio or \
        encoder count.",
    signature: "A joint is off in proportion to its own reading.",
    confused_with: "`joint_offset` where the joint moves little; `transmission_error` of low \
        order over less than a turn.",
    separated_by: "The whole range of the joint.",
    formula: "q → (1 + ratio) q",
    parameters: &[Parameter::free("ratio", Quantity::Ratio).usually(0.01)],
    moves: Moves::Joint,
    idle: "the joint stands at zero throughout",
    group: Some(Group::Constant),
    ..Facts::NONE
};

impl Law for JointRatio {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for JointRatio {
    fn turns_with(&self, joint: usize, of: usize) -> Option<Spot> {
        (joint == of).then(|| Spot::of_joint(joint))
    }

    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        each(row.q[spot.row()]);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let compared = told.by_sign("less", "more");
        format!("{} turns {} {compared} than its reading", told.place, told.size())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let ratio = numbers.first()?.value;
        Some(Curve {
            over: Over::Reading,
            proportional: false,
            value: Box::new(move |q| ratio * q),
        })
    }
}
