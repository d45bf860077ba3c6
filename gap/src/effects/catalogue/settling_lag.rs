//! The reading was taken before the joint came to rest: an error in proportion to the last move.

use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Carrier, Depends, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told, joints,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// The joint is still this part of its last move behind its reading.
#[derive(Clone, Copy, Debug)]
pub struct SettlingLag;

impl Effect for SettlingLag {
    fn identifier(&self) -> &'static str {
        "settling_lag"
    }

    fn about(&self) -> About {
        About {
            reality: "The reading was taken before the joint came to rest: an error in proportion \
                      to the last move.",
            signature: "Of the sign and size of the last move, which is read from the order of the \
                        rows.",
            confused_with: "`backlash` and `friction_hysteresis` where moves are alike in size; \
                            `joint_ratio` where every move starts from one pose; `latency` in a \
                            stream.",
            separated_by: "Moves of many sizes from many poses; a longer wait makes it vanish.",
        }
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        joints(arm)
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::free("fraction", Quantity::Ratio).usually(0.02).one_sided()]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, spot: Spot, v: &[f64]) {
        actual.turn(spot.row(), -v[0] * when.last_move[spot.row()]);
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(-scene.when.last_move[spot.row()]);
    }

    fn idle(&self) -> &'static str {
        "the joint never moves between rows"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Direction)
    }

    fn depends(&self) -> Depends {
        Depends::LastMove
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let part = told.sized(told.first());
        format!("{} is read {part} of its last move before it rests", told.place)
    }
}
