use crate::effects::prelude::*;

/// The joint is still this part of its last move behind its reading.
#[derive(Clone, Copy, Debug)]
pub struct SettlingLag;

const AT_REST: &Facts = &Facts {
    identifier: "settling_lag",
    reality: "The reading was taken before the joint came to rest: an error in proportion to the \
        last move.",
    signature: "Of the sign and size of the last move, which is read from the order of the rows.",
    confused_with: "`backlash` and `friction_hysteresis` where moves are alike in size; \
        `joint_ratio` where every move starts from one pose; `latency` in a stream.",
    separated_by: "Moves of many sizes from many poses; a longer wait makes it vanish.",
    formula: "q → q − fraction · (last move)",
    parameters: &[Parameter::free("fraction", Quantity::Ratio).usually(0.02).one_sided()],
    moves: Moves::Joint,
    idle: "the joint never moves between rows",
    group: Some(Group::Direction),
    depends: Depends::LastMove,
    ..Facts::NONE
};

impl Law for SettlingLag {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for SettlingLag {
    fn moves_by(&self, _: &Row, when: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        each(-when.last_move[spot.row()]);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let part = told.sized(told.first());
        format!("{} is read {part} of its last move before it rests", told.place)
    }
}
