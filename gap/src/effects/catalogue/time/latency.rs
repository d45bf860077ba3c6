use crate::effects::prelude::*;

/// How much older than the readings beside it a measured position is: it shows the arm at
/// `q(t − delay)`, which is read from the stream of readings.
#[derive(Clone, Copy, Debug)]
pub struct Latency;

const AT_REST: &Facts = &Facts {
    identifier: "latency",
    reality: "Positions and readings of one row were not taken at one time: two clocks, a filter, \
        a buffer.",
    signature: "An error along the path, in proportion to the speed of the joints, and none where \
        they rest.",
    confused_with: "`settling_lag` where rows are evenly spaced, since the last move is the speed \
        then; a wrong ratio of a joint that swings about one angle.",
    separated_by: "One path at two speeds, forth and back; a pause on the way.",
    formula: "q → q(t − delay)",
    parameters: &[Parameter::free("delay", Quantity::Time).usually(0.5)],
    at: At::Instrument,
    idle: "the joints do not move while they are measured",
    group: Some(Group::Direction),
    depends: Depends::LastMove,
    ..Facts::NONE
};

impl Law for Latency {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Latency {
    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, _: Spot, v: &[f64]) {
        let Some(stream) = &when.stream else { return };
        for (joint, moved) in stream.moved(when.clock, when.clock - v[0]).into_iter().enumerate() {
            actual.turn(joint, moved);
        }
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let Some(stream) = &scene.when.stream else { return Matrix6xX::zeros(1) };
        let rates = DVector::from_vec(stream.rates(scene.when.clock));
        Matrix6xX::from_columns(&[-(scene.state.jacobian() * rates)])
    }

    fn excluded(&self, data: &Measurements) -> Option<&'static str> {
        if data.kind.is_difference() {
            return Some("a displacement is measured at rest: nothing moves between two clocks");
        }
        (!data.sessions().all(is_stream)).then_some(
            "the rows are not a stream: latency needs rows in the order of their `time`, most of them \
             within a second of the one before",
        )
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let side = told.by_sign("younger", "older");
        format!("positions are {} {side} than the joint values of their rows", told.size())
    }
}

/// All torques are those of `delay` ago.
#[derive(Clone, Copy, Debug)]
pub struct TorqueLatency;

const TORQUE: &Facts = &Facts {
    identifier: "latency",
    reality: "Torques are logged later than positions: another bus, another filter.",
    signature: "All torques are those that the motion asked for some time ago.",
    confused_with: "`viscous_friction`, as weights go with the speed; `rotor_inertia`, \
        `presliding`, where the delay is short.",
    separated_by: "Two speeds and reversals.",
    formula: "τ → τ(t − delay)",
    parameters: &[Parameter::free("delay", Quantity::Time)],
    at: At::Interface,
    bends: true,
    ..Facts::TORQUE
};

impl Law for TorqueLatency {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueLatency {
    fn too_slow(&self, pace: &Pace<'_>, _: Spot, found: Option<&[f64]>) -> Option<String> {
        held(pace, found)
    }

    fn columns(&self, scene: &LogScene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        let signals = scene.signals;
        let of = |joint: usize| {
            let loads = scene.loads.rigid[joint].iter().zip(&scene.loads.friction[joint]);
            let whole: Vec<f64> = loads.map(|(rigid, friction)| -(rigid + friction)).collect();
            // What is filtered has the rate of what it is filtered of; steps have none.
            signals.filtered(&rate(&whole, signals.period))
        };
        vec![Column { parts: (0..signals.joints()).map(|joint| (joint, of(joint))).collect() }]
    }

    /// The torque of now less that which belongs to the motion of now, as it is told `delay` later. What is
    /// shifted is the logged torque, with all that no effect explains: its noise stays as large as it is.
    fn value(&self, scene: &LogScene<'_>, _: Spot, values: &[f64]) -> Column {
        shifted(scene, values[0])
    }

    /// None, and the one that a scan over all delays has found.
    fn probes(&self, scene: &LogScene<'_>, _: Spot) -> Vec<Vec<f64>> {
        let found = Some(scene.loads.delay).filter(|delay| *delay != 0.0);
        [0.0].into_iter().chain(found).map(|delay| vec![delay]).collect()
    }
}

/// All torques are those of one delay ago, which is not fitted: what a scan over delays asks for.
#[derive(Clone, Copy, Debug)]
pub struct TorqueShift;

impl Law for TorqueShift {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for TorqueShift {
    fn columns(&self, _: &LogScene<'_>, _: Spot, values: &[f64]) -> Vec<Column> {
        vec![Column::default(); values.len()]
    }

    fn value(&self, scene: &LogScene<'_>, _: Spot, values: &[f64]) -> Column {
        shifted(scene, values[0])
    }
}

/// Torques of now less those of `delay` later, at the rows.
fn shifted(scene: &LogScene<'_>, delay: f64) -> Column {
    let signals = scene.signals;
    let of = |joint: usize| {
        let (now, later) = signals.drive_and_later(joint, delay);
        let less: Vec<f64> = now.iter().zip(later).map(|(now, later)| now - later).collect();
        signals.kept(&less)
    };
    Column { parts: (0..signals.joints()).map(|joint| (joint, of(joint))).collect() }
}

/// Joints go where they were to be `delay` ago: a bus, a buffer, an interpolator.
#[derive(Clone, Copy, Debug)]
pub struct CommandLatency;

/// Delays from which the search begins, s.
const STARTS: [f64; 10] = [0.0, 0.01, 0.02, 0.035, 0.06, 0.1, 0.14, 0.2, 0.28, 0.4];

/// A recorder holds a value for up to a step: below this step, s, no arm's delay is shorter.
const SHORT: f64 = 0.01;

const POSITION: &Facts = &Facts {
    identifier: "latency",
    reality: "A command is followed later than it is logged: a bus, a buffer, an interpolator.",
    signature: "All joints are where they were to be some time ago.",
    confused_with: "`tracking_lag`, where all joints have the same.",
    separated_by: "Two speeds and reversals: a delay keeps the path's corners, a lag rounds them.",
    formula: "q = q_cmd(t − delay)",
    parameters: &[Parameter::at_least("delay", Quantity::Time, 0.0)],
    at: At::Interface,
    bends: true,
    ..Facts::POSITION
};

impl Law for CommandLatency {
    fn facts(&self) -> &'static Facts {
        POSITION
    }
}

impl InMotion for CommandLatency {
    fn columns(&self, scene: &LogScene<'_>, _: Spot, values: &[f64]) -> Vec<Column> {
        let step = scene.signals.period;
        let rate = |joint: usize| {
            let [before, after] = [-0.5, 0.5].map(|by| scene.ago(joint, values[0] + by * step));
            let pairs = before.iter().zip(&after);
            pairs.map(|(before, after)| (after - before) / step).collect::<Vec<f64>>()
        };
        vec![whole(scene, rate)]
    }

    fn too_slow(&self, pace: &Pace<'_>, _: Spot, found: Option<&[f64]>) -> Option<String> {
        held(pace, found)
    }

    fn value(&self, scene: &LogScene<'_>, _: Spot, values: &[f64]) -> Column {
        whole(scene, |joint| {
            let commands = &scene.signals.command[joint];
            let then = scene.ago(joint, values[0]);
            then.iter().zip(commands).map(|(then, now)| then - now).collect()
        })
    }

    fn probes(&self, _: &LogScene<'_>, _: Spot) -> Vec<Vec<f64>> {
        STARTS.iter().map(|delay| vec![*delay]).collect()
    }
}

fn whole(scene: &LogScene<'_>, of: impl Fn(usize) -> Vec<f64>) -> Column {
    let joints = 0..scene.signals.joints();
    Column { parts: joints.map(|joint| (joint, scene.signals.filtered(&of(joint)))).collect() }
}

/// Why a delay cannot be told from the recorder's, where this one is `found`.
fn held(pace: &Pace<'_>, found: Option<&[f64]>) -> Option<String> {
    let period = pace.period;
    let told = found.is_some_and(|values| values[0].abs() > 0.5 * period);
    (period >= SHORT && !told).then(|| {
        format!(
            "a sample every {} ms is held for as long: a delay of less than half of that may be the recorder's",
            round(1e3 * period)
        )
    })
}
