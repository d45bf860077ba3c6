use crate::effects::prelude::*;

/// The whole width of the dead band; the joint rests half of it behind the direction of approach.
#[derive(Clone, Copy, Debug)]
pub struct Backlash;

const AT_REST: &Facts = &Facts {
    identifier: "backlash",
    reality: "A dead band: the joint rests at one side or the other by the direction of approach.",
    signature: "The same size at every load, of the sign of the last move.",
    confused_with: "`joint_offset` if every pose is approached from one side; \
        `friction_hysteresis` if the joint's torque hardly changes.",
    separated_by: "Each pose approached from both sides, under more than one load.",
    formula: "q → q − ½ width · direction",
    parameters: &[Parameter::at_least("width", Quantity::Angle, 0.0).usually(5e-3)],
    moves: Moves::Joint,
    idle: "no direction of approach is given for the joint",
    group: Some(Group::Direction),
    depends: Depends::Direction,
    ..Facts::NONE
};

impl Law for Backlash {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Backlash {
    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        each(-0.5 * direction(row, spot.row()));
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} has {} of backlash", told.place, told.size())
    }

    /// Half the dead band to either side, against the approach.
    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let width = numbers.first()?.value;
        let value = Box::new(move |direction| -0.5 * width * direction);
        Some(Curve { over: Over::Direction, proportional: false, value })
    }
}

/// The joint stands until its servo, which is where it was to be as late as commands are followed, has gone
/// half of `width` ahead of it, and is dragged behind from there (the play of Krasnosel'skii & Pokrovskii 1989).
#[derive(Clone, Copy, Debug)]
pub struct BacklashInMotion;

/// Widths from which the search begins, rad or m.
const WIDTHS: [f64; 6] = [6e-4, 2e-3, 6e-3, 2e-2, 6e-2, 2e-1];

const POSITION: &Facts = &Facts {
    identifier: "backlash",
    reality: "A joint stops short of where it is driven to: teeth with play, or a servo that \
        friction holds back.",
    signature: "The joint stands while its command turns round, and then lags by as much either \
        way.",
    confused_with: "`tracking_lag` of a joint that always moves equally fast.",
    separated_by: "Approaches from both sides, at two speeds.",
    formula: "q = clamp(q, servo ± ½ width)",
    parameters: &[Parameter::at_least("width", Quantity::Angle, 0.0)],
    bends: true,
    ..Facts::POSITION
};

impl Law for BacklashInMotion {
    fn facts(&self) -> &'static Facts {
        POSITION
    }
}

impl InMotion for BacklashInMotion {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let (joint, width) = (spot.row(), values[0]);
        let [less, more] =
            [1.0 - SLOPE_STEP, 1.0 + SLOPE_STEP].map(|by| dragged(scene, joint, by * width));
        let slope = 1.0 / (2.0 * SLOPE_STEP * width);
        vec![scene.column(joint, |k| slope * (more[k] - less[k]))]
    }

    fn value(&self, scene: &LogScene<'_>, spot: Spot, values: &[f64]) -> Column {
        let joint = spot.row();
        let behind = dragged(scene, joint, values[0]);
        scene.column(joint, |k| behind[k])
    }

    fn probes(&self, _: &LogScene<'_>, _: Spot) -> Vec<Vec<f64>> {
        WIDTHS.iter().map(|width| vec![*width]).collect()
    }

    /// Files of earlier versions have the half width.
    fn number(&self, key: &str) -> Option<(&'static Parameter, f64)> {
        let [width] = POSITION.parameters else { return None };
        [(width.key, 1.0), ("half_width", 2.0)]
            .into_iter()
            .find_map(|(name, times)| (name == key).then_some((width, times)))
    }
}

/// By how much the joint is ahead of its servo. Where a span begins it is where it was measured.
fn dragged(scene: &LogScene<'_>, joint: usize, width: f64) -> Vec<f64> {
    let (signals, half_width) = (scene.signals, 0.5 * width);
    let servo = scene.ago(joint, scene.loads.delay);
    let mut ahead = Vec::with_capacity(servo.len());
    for span in &signals.spans {
        let mut at = signals.q[joint][span.fine.start];
        ahead.extend(servo[span.fine.clone()].iter().map(|servo| {
            at = at.clamp(servo - half_width, servo + half_width);
            at - servo
        }));
    }
    ahead
}
